"""Values by skill and parameter that an input tells beyond doubt: names, clearances and fences."""

from __future__ import annotations

from collections.abc import Collection

from planner_ft.decoding.constraints.facts import Reading, usable
from planner_ft.decoding.constraints.grammar import written, written_number
from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.clearances import clearances
from planner_ft.decoding.constraints.reading.described_values import read_described_values
from planner_ft.decoding.constraints.reading.fences import fences
from planner_ft.decoding.constraints.reading.named_values import DOUBT, read_named_values
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary

Told = dict[tuple[str, str], frozenset[str]]
"""By skill and parameter the values in JSON, as plans write them, that it has one of."""

CLEARANCE, FENCE = ("ObstacleAvoidance", "min_distance"), ("BoundaryEnforcement", "poly_coords")


def read_told_values(reading: Reading, spoken: Collection[str], vocabulary: Vocabulary) -> Told:
    """What the text of a reading tells of the values of the skills that it speaks of."""
    text = reading.text
    named = read_described_values(text, spoken, vocabulary) | read_named_values(text, spoken, vocabulary)
    told: Told = {key: frozenset(map(compact_json, values)) for key, values in named.items()}
    if len(text) > LONGEST or reading.numbers_free or reading.loose:
        return told
    if CLEARANCE[0] in spoken and CLEARANCE[0] in vocabulary.skill and not DOUBT.search(text):
        parameter = vocabulary.skill[CLEARANCE[0]].by_name[CLEARANCE[1]]
        values = usable(clearances(text), parameter)
        told |= {CLEARANCE: frozenset(map(written_number, values))} if values else {}
    if FENCE[0] in spoken and FENCE[0] in vocabulary.skill:
        lists = frozenset(f"[{','.join(map(written, corners))}]" for corners in fences(text))
        told |= {FENCE: lists} if lists else {}
    return told
