"""Prompt look-up: tokens that are likely to follow, found where the last ones stood before.

A plan copies names, phrases and numbers from the command and repeats its own structure. The model
verifies a draft in one forward pass; where it chooses another token, the rest is taken back.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from pathlib import Path
from typing import Any

from planner_ft.data.task.steps import plan_step
from planner_ft.support.files import compact_json, read_jsonl
from planner_ft.vocabulary import Skill, Task, Vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import Level

LONGEST_MATCH, NEARER = 8, 1
"""Tokens at the end of the answer that are looked up at most, and those by which a match in the
prompt and the answer may be shorter than one in the base. The longest match wins.
"""
LONGEST_DRAFT = 7
"""With the token chosen, eight positions: a pass over eight costs a CPU little more than one."""
LONGEST_SURE = 28
"""Behind drafts that were right throughout, up to this."""

Likeness = Callable[[int], Hashable]


class Lookup:
    """Drafts for one answer, from its prompt and the answer so far, then from `base`. `likeness`
    maps a token to what is compared, so that a word at the start of a string matches the one after
    a space; a base has its own.
    """

    def __init__(
        self, prompt: Sequence[int] = (), likeness: Likeness = int, base: Lookup | None = None
    ) -> None:
        self._likeness: Likeness = base._likeness if base else likeness
        self._base = base
        self._likes: list[Hashable] = []
        self._followers: dict[tuple[Hashable, ...], int] = {}
        for token in prompt:
            self.extend(token)

    def extend(self, token: int) -> None:
        """The text goes on with `token`."""
        for length in range(1, min(LONGEST_MATCH, len(self._likes)) + 1):
            self._followers[tuple(self._likes[-length:])] = token
        self._likes.append(self._likeness(token))

    def propose(self, count: int, after: Sequence[int] = ()) -> list[int]:
        """At most `count` tokens that may follow the text and the tokens `after` it."""
        likes, draft = [*self._likes[-LONGEST_MATCH:], *map(self._likeness, after)], list[int]()
        while len(draft) < count and (token := self._likely(likes)) is not None:
            draft.append(token)
            likes.append(self._likeness(token))
        return draft

    def _likely(self, likes: list[Hashable]) -> int | None:
        """The token that followed the longest end of some tokens."""
        length, token = self._follower(likes)
        if self._base is not None and length + NEARER < LONGEST_MATCH:
            other, likely = self._base._follower(likes)
            if not length or other > length + NEARER:
                return likely
        return token

    def _follower(self, likes: list[Hashable]) -> tuple[int, int | None]:
        """The longest end of some tokens that the text has, and what followed it."""
        for length in range(min(LONGEST_MATCH, len(likes)), 0, -1):
            if (before := tuple(likes[-length:])) in self._followers:
                return length, self._followers[before]
        return 0, None


def usual_plans(level: Level, vocabulary: Vocabulary) -> list[str]:
    """Plans of a level as text, which show how answers are put together: a few training plans of
    the default vehicle, of another one a plan that has every task or skill once.
    """
    if vocabulary.name == DEFAULT:
        lines = read_jsonl(Path(__file__).with_name("plans.jsonl"))
        return [line["plan"] for line in lines if line["level"] == level]
    if level == "mission":
        rest = {"task_prompt": "."}
        tasks = [{"title": one.title, "parameters": _blank(one)} | rest for one in vocabulary.tasks]
        return [compact_json({"tasks": tasks, "assumptions": [], "constraints": []})]
    first, steps = vocabulary.skills_in_role("navigation")[0].name, []
    for skill in vocabulary.skills:
        named = {"name": skill.name, "parameters": _blank(skill)}
        name, values = (skill.name, _blank(skill)) if skill.role == "navigation" else (first, {})
        filters, perceptions = ([named] * (skill.role == of) for of in ("filter", "perception"))
        steps.append(plan_step(name, values, filters, perceptions, vocabulary))
    return [compact_json({"skill_sequence": steps})]


def _blank(owner: Task | Skill) -> dict[str, Any]:
    """The parameters of a task or skill, with values that say nothing."""
    values = {"text": "", "id": "", "texts": [""], "position": [0, 0], "polygon": [[0, 0]]}
    return {item.name: values.get(item.type, 0) for item in owner.parameters}
