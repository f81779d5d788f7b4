"""How an answer is led to its end when its limit comes near.

A grammar bounds every list and text, but the sum of the bounds is far above any limit. So the last `reserve` tokens of
the limit are kept for closing what is open: texts end, lists and objects close as soon as the grammar lets them.
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


def reserve(level: Level, vocabulary: Vocabulary) -> int:
    """Tokens that close a plan from wherever it stands: no token is shorter than a byte."""
    if level == "mission":
        task = max(_owner(task.title, task) for task in vocabulary.tasks) + len(TASK_OPENS + "," + key("task_prompt") + '""},')
        return task + len("]," + ",".join(key(name) + "[]" for name in MISSION_KEYS[1:]) + "}") + LONGEST_WORD
    skill = max(_owner(skill.name, skill) for skill in vocabulary.skills) + len(SKILL_OPENS)
    return skill + sum(len(key(name) + "[],") for name in STEP_KEYS) + len("}]}") + LONGEST_WORD


def least_limit(level: Level, vocabulary: Vocabulary) -> int:
    """The smallest limit within which every answer ends: what closes it, its beginning, and the end token."""
    return reserve(level, vocabulary) + len(mission_opens()) + len("{" + key("skill_sequence") + "[") + 1


def _owner(name: str, owner: Task | Skill) -> int:
    """Bytes of a task's or skill's name and parameters: those that must be written and may stand before them, or the one that was begun."""
    sizes = [len(("," + key(item.name)).encode()) + _shortest(item) for item in owner.parameters]
    needed = owner.require_any or any(item.required for item in owner.parameters)
    return len(f"{compact_json(name)},{key('parameters')}{{}}".encode()) + (sum(sizes) if needed else max(sizes, default=0))


def _shortest(parameter: Parameter) -> int:
    """Bytes that a value takes at most when everything that can be left out is."""
    sizes = {"number": _NUMBER, "integer": _NUMBER, "position": _POSITION, "polygon": 3 * (_POSITION + 1) + 1}
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

    def narrow(self, mask: Mask) -> Mask:
        """The part of a mask that leads to the end: a sign that closes, where one is allowed."""
        for sign in '"' if self._inside else "]},":
            token = self._tokens.byte[sign]
            if token is not None and allows(mask, token):
                return self._tokens.mask_of((token,))
        return mask
