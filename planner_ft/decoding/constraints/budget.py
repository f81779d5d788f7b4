"""How many tokens close an answer from wherever it stands.

A grammar bounds every list and text, but the sum of the bounds is far above any limit, so the last
tokens of the limit are kept for closing what is open. A text that must follow takes at most
`most_spelt` tokens wherever it was begun; where there is a choice, no token is shorter than a byte.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.grammar import SKILL_OPENS, TASK_OPENS, key, mission_opens
from planner_ft.decoding.constraints.patterns import DECIMALS, WHOLE_DIGITS
from planner_ft.decoding.constraints.spans import LONGEST_WORD
from planner_ft.decoding.constraints.tokens import Tokens
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level

_NUMBER = 2 + WHOLE_DIGITS + DECIMALS
_POSITION = 2 * _NUMBER + 3
_BYTES = {
    "number": _NUMBER,
    "integer": _NUMBER,
    "position": _POSITION,
    "polygon": 3 * (_POSITION + 1) + 1,
}
"""Bytes that a value takes at most when everything that can be left out is."""


def reserve(level: Level, vocabulary: Vocabulary, tokens: Tokens) -> int:
    """Tokens that close a plan from wherever it stands: the task or step that was begun."""
    spelt = tokens.most_spelt
    if level == "mission":
        begun = max(_owner(task.title, task, tokens) for task in vocabulary.tasks)
        lists = sum(spelt(f",{key(name)}[") + 1 for name in MISSION_KEYS[1:])
        prompt = spelt("," + TASK_OPENS) + spelt("}," + key("task_prompt") + '"')
        return begun + prompt + lists + 6 + LONGEST_WORD
    begun = max(_owner(skill.name, skill, tokens) for skill in vocabulary.skills)
    lists = sum(spelt("}," + key(name) + "[") + 2 for name in STEP_KEYS[1:])
    return begun + lists + spelt(",{" + key(STEP_KEYS[0]) + SKILL_OPENS) + 4 + LONGEST_WORD


def least_limit(level: Level, vocabulary: Vocabulary, tokens: Tokens) -> int:
    """The smallest limit within which every answer ends, its beginning and end token included."""
    opens = mission_opens() if level == "mission" else "{" + key("skill_sequence") + "["
    return reserve(level, vocabulary, tokens) + tokens.most_spelt(opens) + 1


def _owner(name: str, owner: Task | Skill, tokens: Tokens) -> int:
    """Tokens of a name and the parameters that must be written, or the one that was begun."""
    sizes = [
        tokens.most_spelt("," + key(item.name)) + _BYTES.get(item.type, LONGEST_WORD + 2)
        for item in owner.parameters
    ]
    needed = bool(owner.require_any) or any(item.required for item in owner.parameters)
    opens = len(compact_json(name).encode()) + tokens.most_spelt(f'",{key("parameters")}{{')
    return opens + (sum(sizes) if needed else max(sizes, default=0))
