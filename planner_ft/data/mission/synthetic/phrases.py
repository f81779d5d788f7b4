"""The form in which the language of a task is written down.

Slots: `{target}` is a place or an object, with its article ("the green buoy at [18, 7]", "it",
"[18, 7]"); after "at", "to", "from", "round" and the like a bare coordinate fits too. Text
parameters are slots of the core: `{feature_type}`, `{target_feature}`, `{target_description}`,
`{target_list}` with their articles, `{target_id}` and `{side_id}` as bare words. Values come with
their unit ("12 metres", "four minutes", "30 degrees", "25 percent"), `{sectors}` as a bare number.
`{interval}` fits after "every" ("minute"). `{name_compound}` is the value as an attribute
("12-metre"), `{arc_noun}` one of the adjuncts "arc_noun:DEGREES" or "arc_noun". A phrase can be
used when each of its slots has something to say.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field


@dataclass(frozen=True)
class TaskPhrases:
    """How operators ask for one task.

    imperatives: verb phrases ("circle {target}"); noun_phrases: "an orbit of {target}"; gerunds:
    "circling {target}". adjuncts: how a parameter is added, by parameter name ("at {radius}").
    "width+length" says both; "arc:360" is said for that value; "heading:word" for a compass point
    in words. here_imperatives: the place is where the vehicle is ("hold position right here").
    bare_imperatives, bare_noun_phrases, bare_gerunds: no place is said ("hold position"); for a
    vehicle that is at its place, or just got there. valued_imperatives, valued_noun_phrases: values
    stand inside the phrase ("{duration} of drifting at {target}").
    """

    imperatives: tuple[str, ...]
    noun_phrases: tuple[str, ...]
    gerunds: tuple[str, ...]
    adjuncts: dict[str, tuple[str, ...]] = field(default_factory=dict)
    here_imperatives: tuple[str, ...] = ()
    bare_imperatives: tuple[str, ...] = ()
    bare_noun_phrases: tuple[str, ...] = ()
    bare_gerunds: tuple[str, ...] = ()
    valued_imperatives: tuple[str, ...] = ()
    valued_noun_phrases: tuple[str, ...] = ()


def listed(text: str) -> tuple[str, ...]:
    """The phrases of a block of text, which stand between semicolons and line ends."""
    return tuple(phrase for phrase in (part.strip() for part in re.split(r"[;\n]", text)) if phrase)


def pairs(text: str) -> tuple[tuple[str, str], ...]:
    """The pairs of a block of text, one a line, their halves parted by " => "."""
    halves = (line.split(" => ") for line in text.strip().splitlines() if line.strip())
    return tuple((left.strip(), right.strip()) for left, right in halves)
