"""How an answer is led to its end when its limit comes near.

A grammar bounds every list and text, but the sum of the bounds is far above any limit. So the last
`reserve` tokens of the limit are kept for closing what is open: texts end, lists and objects close
as soon as the grammar lets them, and what must follow is written with as few tokens as there can
be.
"""

from __future__ import annotations

from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.constraints.grammar import SKILL_OPENS, TASK_OPENS, key, mission_opens
from planner_ft.decoding.constraints.patterns import DECIMALS, WHOLE_DIGITS
from planner_ft.decoding.constraints.tokens import Tokens, allows
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level

LONGEST_WORD = 64
"""Bytes of a word that a text can be made to end behind, quotation marks included."""
_NUMBER = 2 + WHOLE_DIGITS + DECIMALS
_POSITION = 2 * _NUMBER + 3


class Budget:
    """Tokens that close an answer of one level, counted with the tokenizer that spells it.

    A text that must follow takes at most `most_spelt` tokens wherever it was begun; where there is
    a choice, no token is shorter than a byte.
    """

    def __init__(self, level: Level, vocabulary: Vocabulary, tokens: Tokens) -> None:
        self._level, self._vocabulary, self._tokens = level, vocabulary, tokens

    def reserve(self) -> int:
        """Tokens that close a plan from wherever it stands: the task or step that was begun."""
        if self._level == "mission":
            task = max(self._owner(task.title, task) for task in self._vocabulary.tasks)
            lists = sum(self._spelt(f",{key(name)}[") + 1 for name in MISSION_KEYS[1:])
            return (
                task
                + self._spelt("," + TASK_OPENS)
                + self._spelt("}," + key("task_prompt") + '"')
                + lists
                + 6
                + LONGEST_WORD
            )
        begun = max(self._owner(skill.name, skill) for skill in self._vocabulary.skills)
        return begun + self._step + LONGEST_WORD

    def least_limit(self) -> int:
        """The smallest limit within which every answer ends: what closes it, its beginning, and the
        end token.
        """
        opens = mission_opens() if self._level == "mission" else "{" + key("skill_sequence") + "["
        return self.reserve() + self._spelt(opens) + 1

    @property
    def _step(self) -> int:
        """Tokens of a step apart from its skill."""
        return (
            sum(self._spelt("}," + key(name) + "[") + 2 for name in STEP_KEYS[1:])
            + self._spelt(",{" + key(STEP_KEYS[0]) + SKILL_OPENS)
            + 4
        )

    def _owner(self, name: str, owner: Task | Skill) -> int:
        """Tokens of a task's or skill's name and parameters: those that must be written and may
        stand before them, or the one that was begun.
        """
        sizes = [self._spelt("," + key(item.name)) + _shortest(item) for item in owner.parameters]
        needed = bool(owner.require_any) or any(item.required for item in owner.parameters)
        return (
            len(compact_json(name).encode())
            + self._spelt(f'",{key("parameters")}{{')
            + (sum(sizes) if needed else max(sizes, default=0))
        )

    def _spelt(self, text: str) -> int:
        return self._tokens.most_spelt(text)


def _shortest(parameter: Parameter) -> int:
    """Bytes that a value takes at most when everything that can be left out is."""
    sizes = {
        "number": _NUMBER,
        "integer": _NUMBER,
        "position": _POSITION,
        "polygon": 3 * (_POSITION + 1) + 1,
    }
    return sizes.get(parameter.type, LONGEST_WORD + 2)


class Closing:
    """Follows the bytes of an answer and says which token closes what is open."""

    def __init__(self, tokens: Tokens) -> None:
        self._tokens = tokens
        self._inside = self._escape = False

    def copy(self) -> Closing:
        """The same state, apart."""
        other = Closing(self._tokens)
        other._inside, other._escape = self._inside, self._escape
        return other

    def read(self, text: bytes) -> None:
        """The answer goes on with `text`."""
        for byte in text:
            if self._escape:
                self._escape = False
            elif byte == 0x5C:
                self._escape = self._inside
            elif byte == 0x22:
                self._inside = not self._inside

    def narrow(self, mask: Mask, must_follow: bytes) -> Mask:
        """The part of a mask that leads to the end: the longest way through what must follow, else
        a sign that closes, where one is allowed.
        """
        if must_follow:
            return self._tokens.mask_of((self._tokens.shortest(must_follow)[0],))
        for sign in '"' if self._inside else "]},":
            token = self._tokens.byte[sign]
            if token is not None and allows(mask, token):
                return self._tokens.mask_of((token,))
        return mask
