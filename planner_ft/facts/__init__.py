"""The one reader of an English text: which values it states, and where a value is from.

    from planner_ft.facts import Input, read, read_input

    facts = read("Circle the red buoy at [120, -35], 40 feet off, for half an hour, then go home.")
    facts.numbers("m")     # Number(value=12.19, unit="m", said=40, start, end, rank), every reading
    facts.numbers("s")     # 1800
    facts.positions        # Position(120, -35, start, end, certain=True)
    facts.geographic       # positions in degrees, which are neither positions in metres nor numbers
    facts.bearings, facts.turns, facts.counts
    facts.phrases.spans("red buoy"), facts.phrases.missing("green buoy")
    facts.unread, facts.loose   # what could not be read with certainty

    facts.evidence(1800, parameter)                # Evidence("converted", spans of "half an hour")
    facts.evidence(12, parameter, tolerance=0.02)  # scoring allows 2 %

    source = read_input(record, vocabulary)        # the text with the vehicle, a task's parameters
    source.evidence(value, parameter)              # may be "derived" or "vehicle" as well
    source.evidence([10, 30], WAYPOINT, before=[(10.0, 0.0)])
    source.ground                                  # what waypoints follow from

Everything is cached by the text. No word list of a vehicle, no task name and no reading of what a
sentence asks for is in here: only what it states.
"""

from planner_ft.facts.inputs import Input, read_input
from planner_ft.facts.numbers import Number
from planner_ft.facts.places import Geographic, Position
from planner_ft.facts.reading import (
    EXACT,
    SCORING,
    WAYPOINT,
    Evidence,
    Facts,
    is_number,
    is_place,
    near,
    read,
    same_place,
)
from planner_ft.facts.words import (
    Phrases,
    Span,
    corrections,
    edit_distance,
    is_known,
    missing_words,
    normalised,
    phrases,
    unknown_words,
    words,
)

__all__ = [
    "EXACT",
    "SCORING",
    "WAYPOINT",
    "Evidence",
    "Facts",
    "Geographic",
    "Input",
    "Number",
    "Phrases",
    "Position",
    "Span",
    "corrections",
    "edit_distance",
    "is_known",
    "is_number",
    "is_place",
    "missing_words",
    "near",
    "normalised",
    "phrases",
    "read",
    "read_input",
    "same_place",
    "unknown_words",
    "words",
]
