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

from planner_ft.facts.geographic import Geographic as Geographic
from planner_ft.facts.inputs import Input as Input
from planner_ft.facts.inputs import read_input as read_input
from planner_ft.facts.places import Position as Position
from planner_ft.facts.reading import SCORING as SCORING
from planner_ft.facts.reading import WAYPOINT as WAYPOINT
from planner_ft.facts.reading import Evidence as Evidence
from planner_ft.facts.reading import Facts as Facts
from planner_ft.facts.reading import is_number as is_number
from planner_ft.facts.reading import is_place as is_place
from planner_ft.facts.reading import near as near
from planner_ft.facts.reading import read as read
from planner_ft.facts.together import Number as Number
from planner_ft.facts.words import Span as Span
from planner_ft.facts.words import corrections as corrections
from planner_ft.facts.words import is_known as is_known
from planner_ft.facts.words import missing_words as missing_words
from planner_ft.facts.words import normalised as normalised
from planner_ft.facts.words import unknown_words as unknown_words
from planner_ft.facts.words import words as words
