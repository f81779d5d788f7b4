"""The state of one constrained answer: a row of grammars, each made from the text before it; and
what starts it, for a strength.
"""

from __future__ import annotations

import copy
import functools
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints import RELEASED, Mask
from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grounded import LONGEST_WORD, GroundedValues
from planner_ft.decoding.constraints.patterns import DECIMALS, WHOLE_DIGITS
from planner_ft.decoding.constraints.scripts import MissionScript, TaskScript
from planner_ft.decoding.constraints.tokens import Tokens, allows, tokens_of
from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level

if TYPE_CHECKING:
    from llguidance import LLMatcher

_NUMBER = 2 + WHOLE_DIGITS + DECIMALS
_POSITION = 2 * _NUMBER + 3
_BYTES = {"number": _NUMBER, "integer": _NUMBER, "position": _POSITION}
_BYTES["polygon"] = 3 * (_POSITION + 1) + 1
"""Bytes that a value takes at most when everything that can be left out is."""
QUOTE = re.compile(rb'(?:\\.|[^"\\])*"', re.DOTALL)
Notes = Callable[[str], list[str]]
"""Sentences on an answer so far, given as text."""


class Answer:
    """An answer that follows a script and ends within `limit` tokens.

    The last `reserve` of them are for closing what is open: texts end, lists and objects close as
    soon as the grammar lets them; `cut` says so. `without_facts` is the same script without the
    facts of the input: a part of the answer is released to it where the model finds no value with
    evidence likely.
    """

    def __init__(
        self,
        tokens: Tokens,
        script: lark.Script,
        limit: int,
        reserve: int,
        notes: Notes = lambda _: [],
        without_facts: lark.Script | None = None,
    ) -> None:
        self.cut = False
        self._tokens, self._left, self._reserve, self._notes = tokens, limit, reserve, notes
        self._script, self._loose_script = script, without_facts
        self._matcher: LLMatcher | None = tokens.compile(script.opening())
        self._loose = tokens.compile(without_facts.opening()) if without_facts else None
        self._released: dict[str, None] = {}
        self._ids: list[int] = []
        self._begun = 0
        self._mask = tokens.mask_of(())

    @property
    def notes(self) -> list[str]:
        """Sentences for the plan's assumptions: what could not be read from the command, and values
        without evidence in it that were left to the model.
        """
        text = self._tokens.text_of(self._ids).decode(errors="ignore")
        return [*self._notes(text), *(RELEASED.format(name=name) for name in self._released)]

    @property
    def ended(self) -> bool:
        """The answer is complete: only an end token may follow, or has followed."""
        return self._matcher is None

    def mask(self) -> Mask:
        """The tokens that may follow; end tokens among them where the answer may end. The array is
        the caller's until the next call.
        """
        if self._matcher is None:
            return self._tokens.mask_of(self._tokens.end_ids)
        self._matcher.unsafe_compute_mask_ptr(self._mask.ctypes.data, self._mask.nbytes)
        if not self._hurried:
            growing = self._tokens.growing(self._ids, self._matcher)
            return self._tokens.mask_of(tuple(growing)) if growing else self._mask
        narrowed = self._closing(self._mask)
        self.cut = self.cut or not np.array_equal(narrowed, self._mask)
        return narrowed

    def expected(self) -> list[int]:
        """Tokens that probably follow, since their text must. The state is unchanged."""
        if self._matcher is None or self._hurried:
            return []
        return self._tokens.spelt(self._ids, self._matcher)[: self._left - self._reserve - 1]

    def ends_text(self) -> int | None:
        """The token that ends the text that is being written; None where none may."""
        token = self._tokens.byte['"']
        return token if self._inside and allows(self.mask(), token) else None

    def release(self, token: int) -> bool:
        """Leave the value that is being written to the model, which would go on with `token`, a
        token without evidence. False where more than evidence forbids it.
        """
        open_ = self._matcher is not None and not self._hurried
        if not open_ or self._loose is None or not self._loose.validate_tokens([token]):
            return False
        self._matcher, chosen = self._loose.deep_copy(), self._script.chosen
        if chosen is not None:
            self._released[lark.name_of(chosen)] = None
        return True

    def accept(self, token: int) -> None:
        """A token was chosen. Raises ValueError when it is not allowed."""
        if self._matcher is None:
            if token not in self._tokens.end_ids:
                raise ValueError(f"token {token} follows a complete answer")
            return
        barred = self._hurried and not allows(self.mask(), token)
        if barred or not (
            self._matcher.validate_tokens([token]) and self._matcher.consume_token(token)
        ):
            said = self._tokens.bytes_of(token)
            raise ValueError(f"token {token} ({said!r}) is not allowed here")
        if self._loose is not None and not self._loose.consume_token(token):
            self._loose = None
        self._ids.append(token)
        self._left -= 1
        if self._matcher.is_accepting():
            self._advance()

    def admits(self, tokens: Sequence[int]) -> int:
        """How many of these tokens in a row are allowed from here. The state is unchanged."""
        if self._matcher is None:
            return int(bool(tokens) and tokens[0] in self._tokens.end_ids)
        room = max(self._left - self._reserve - 1, 0)
        within = self._matcher.validate_tokens(list(tokens[:room]))
        if within == len(tokens):
            return within
        # Behind the end of this grammar, or near the limit: step by step, on a copy.
        ahead = copy.copy(self)
        ahead._matcher, ahead._mask = self._matcher.deep_copy(), self._tokens.mask_of(())
        ahead._loose = None if self._loose is None else self._loose.deep_copy()
        ahead._released, ahead._ids = dict(self._released), list(self._ids)
        for count, token in enumerate(tokens):
            try:
                ahead.accept(token)
            except ValueError:
                return count
            if ahead.ended:
                return count + 1 + ahead.admits(tokens[count + 1 :][:1])
        return len(tokens)

    @property
    def _hurried(self) -> bool:
        return self._left <= self._reserve

    @property
    def _inside(self) -> bool:
        """Whether the answer stands within a text."""
        return len(QUOTE.findall(self._tokens.text_of(self._ids))) % 2 == 1

    def _closing(self, mask: Mask) -> Mask:
        """The part of a mask that leads to the end: a sign that closes, if there is one."""
        for sign in '"' if self._inside else "]},":
            token = self._tokens.byte[sign]
            if token is not None and allows(mask, token):
                return self._tokens.mask_of((token,))
        return mask

    def _advance(self) -> None:
        """Go on to the next grammar, with the text that the last one matched."""
        text = self._tokens.text_of(self._ids[self._begun :]).decode()
        following = self._script.following(text)
        loose = self._loose_script.following(text) if self._loose_script and following else None
        self._loose = self._tokens.compile(loose[0]) if loose else None
        self._loose_script = loose[1] if loose else None
        self._matcher, self._begun = None, len(self._ids)
        if following is not None:
            self._matcher, self._script = self._tokens.compile(following[0]), following[1]


def constraint_factory(
    tokenizer: Any,
    level: Level,
    vocabulary: Vocabulary,
    strength: Strength,
    end_ids: tuple[int, ...],
    limit: int,
    n_vocab: int | None = None,
) -> Factory | None:
    """What answers are constrained with; None at strength free.

    `end_ids` are the tokens that may end an answer, `limit` the tokens that it may have, `n_vocab`
    the width of the model's logits (None takes the tokenizer's size). Raises PlannerError for a
    limit within which an answer cannot be guaranteed to end.
    """
    if strength == "free":
        return None
    tokens = tokens_of(tokenizer, tuple(end_ids), n_vocab)
    return Factory(tokens, level, vocabulary, strength, limit)


@dataclass(frozen=True, eq=False)
class Factory:
    """Starts constraints of one strength, over one tokenizer, for one level and vocabulary."""

    tokens: Tokens
    level: Level
    vocabulary: Vocabulary
    strength: Strength
    limit: int

    def __post_init__(self) -> None:
        self._check(self.limit)

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Answer:
        """The state before the first token of the answer to `record` ({"prompt", ...}), which
        always ends within `limit` tokens, its end token included.

        None takes the factory's limit. With `most`, the answer has at most that many tasks or steps
        and is held to the schema alone. Raises PlannerError when `limit` is under `least_tokens`.
        """
        limit = self.limit if limit is None else limit
        self._check(limit)
        given, unresolved = record.get("parameters"), list(self.vocabulary.unresolved)
        open_place = isinstance(given, dict) and unresolved in given.values()
        logical = self.strength != "schema" and not (self.level == "task" and open_place)
        kind = MissionScript if self.level == "mission" else TaskScript
        script = kind(self.vocabulary, lark.Values(), logical=logical and most is None)
        script = script if most is None else replace(script, most=most)
        if self.strength != "grounded" or not script.logical:
            return Answer(self.tokens, script, limit, self.reserve)
        return self._grounded(record, limit, script)

    @functools.cached_property
    def reserve(self) -> int:
        """Tokens that close a plan from wherever it stands: the longest task or skill, begun where
        another one ends, and what stands behind it.

        A grammar bounds every list and text, but the sum of the bounds is far above any limit, so
        the last tokens of the limit are kept for it. No token is shorter than a byte.
        """
        mission = self.level == "mission"
        owners = self.vocabulary.tasks if mission else self.vocabulary.skills
        lists = {name: list[Any]() for name in (MISSION_KEYS[1:] if mission else STEP_KEYS)}
        rest = compact_json([lists, {"task_prompt": ""}])
        return max(map(_most_bytes, owners)) + len(rest) + LONGEST_WORD + 8

    @property
    def least_tokens(self) -> int:
        """The smallest limit within which every answer ends, beginning and end token included."""
        sequence = "{" + lark.key("skill_sequence") + "["
        opens = lark.mission_opens() if self.level == "mission" else sequence
        return self.reserve + len(opens) + 1

    def _check(self, limit: int) -> None:
        if limit < self.least_tokens:
            raise PlannerError(
                f"--max-new-tokens {limit}: at strength {self.strength} a {self.level} plan of this"
                f" vocabulary needs room for {self.least_tokens} tokens; give at least that, or a"
                " shorter prompt"
            )

    def _grounded(
        self, record: dict[str, Any], limit: int, script: MissionScript | TaskScript
    ) -> Answer:
        found = read_waypoints(record, self.vocabulary) if self.level == "task" else None
        free = [found] if isinstance(found, str) else []
        values = GroundedValues(self.level, record, self.vocabulary, free_waypoints=bool(free))
        skills = self.vocabulary.skills
        goes = [lark.SKILL_OPENS + skill.name for skill in skills if skill.coordinates]

        def notes(text: str) -> list[str]:
            return [*values.notes, *(free if any(name in text for name in goes) else [])]

        if not isinstance(script, TaskScript):
            # A mission's places are stated or unresolved, its other values can be left out.
            return Answer(self.tokens, replace(script, values=values), limit, self.reserve, notes)
        known = found if isinstance(found, Waypoints) else None
        steps = replace(script, values=values, waypoints=known, whole=known)
        # The lanes of a grid follow from the task's own parameters: the model is not left to write
        # others.
        own = known if known and known.whole else None
        loose = replace(script, waypoints=own, whole=known)
        return Answer(self.tokens, steps, limit, self.reserve, notes, loose)


def _most_bytes(owner: Task | Skill) -> int:
    """Bytes of a name and the parameters that must be written, or the one that was begun."""
    every = owner.parameters
    keys = (len(f",{lark.key(item.name)}".encode()) for item in every)
    sizes = [own + _BYTES.get(of.type, LONGEST_WORD) for own, of in zip(keys, every, strict=True)]
    needed = bool(owner.require_any) or any(item.required for item in every)
    opens = len(compact_json({"name": lark.name_of(owner), "parameters": {}}).encode())
    return opens + (sum(sizes) if needed else max(sizes, default=0))
