"""Values by skill and parameter that an input tells beyond doubt: names, clearances and fences."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field

from planner_ft.decoding.constraints.facts import Reading, usable
from planner_ft.decoding.constraints.grammar import written, written_number
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.values.clearances import clearances
from planner_ft.decoding.constraints.reading.values.described_values import read_described_values
from planner_ft.decoding.constraints.reading.values.fences import fences
from planner_ft.decoding.constraints.reading.values.named_values import DOUBT, read_named_values
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

CLEARANCE, FENCE = ("ObstacleAvoidance", "min_distance"), ("BoundaryEnforcement", "poly_coords")
STARTED_AND_STOPPED = "SetStreamRecording"
"""The skill that runs twice with different values in one step, where recordings begin and end."""


@dataclass(frozen=True)
class Told:
    """By skill and parameter the `values` in JSON, as plans write them, that it has one of; those
    `needed` are always written.
    """

    values: Mapping[tuple[str, str], frozenset[str]] = field(default_factory=dict)
    needed: frozenset[tuple[str, str]] = frozenset()


def read_told_values(reading: Reading, spoken: Collection[str], vocabulary: Vocabulary) -> Told:
    """What the text of a reading tells of the values of the skills that it speaks of.

    What stands behind the words for a skill is certainly its own; a name behind the word for its
    kind may be another skill's.
    """
    text = reading.text
    described = read_described_values(text, spoken, vocabulary)
    told = {
        key: frozenset(map(compact_json, values))
        for key, values in (described | read_named_values(text, spoken, vocabulary)).items()
    }
    needed = {key for key in described if key[0] != STARTED_AND_STOPPED}
    if len(text) <= LONGEST and not reading.numbers_free and not reading.loose:
        counted = {
            CLEARANCE: _clearances(text, vocabulary),
            FENCE: (f"[{','.join(map(written, corners))}]" for corners in fences(text)),
        }
        found = {
            key: frozenset(values)
            for key, values in counted.items()
            if key[0] in spoken and key[0] in vocabulary.skill
        }
        told |= {key: values for key, values in found.items() if values}
        needed |= {key for key, values in found.items() if values}
    return Told(told, frozenset(needed))


def _clearances(text: str, vocabulary: Vocabulary) -> Iterator[str]:
    skill, name = CLEARANCE
    if not DOUBT.search(text) and skill in vocabulary.skill:
        yield from map(
            written_number, usable(clearances(text), vocabulary.skill[skill].by_name[name])
        )
