"""Whether a predicted value is the stated one, by the type of its parameter."""

import math
from collections.abc import Sequence
from typing import Any

from planner_ft.facts import is_number, is_place, normalised
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.units import converted
from planner_ft.vocabulary import Parameter, Vocabulary

RELATIVE, ABSOLUTE = 0.02, 0.005
"""Tolerances of numbers: 2 % as the labelling rules allow, half a unit of the second decimal."""
FARTHEST = 0.5  # metres that a position may lie off: another whole metre is another place
ROUNDING = 1e-9
LONGEST = 40  # characters of a text that is read as one quantity


def values_agree(
    given: Any, stated: Any, known: Parameter | None, vocabulary: Vocabulary, *, loose: bool = False
) -> bool:
    """Whether a predicted value is the stated one.

    - Numbers: within 2 % of the stated one, or half a unit of the second decimal.
    - Positions: by distance, within 2 % of the stated position's distance from the origin, but half
      a metre at most. The unresolved location agrees with itself alone.
    - Polygons: as rings, from any corner in either direction, closed or not.
    - Texts: without regard to case, spacing and a leading article. An identifier may be a number or
      its text.
    - Lists: in order, which is that of urgency.

    `loose` asks for the content and not for the form: a list of texts is a set, and a text with a
    unit ("5 min") is the number that it means in the parameter's unit.
    """
    kind = known.type if known is not None else None
    if kind == "polygon":
        return _rings_agree(given, stated, vocabulary)
    if loose and kind == "texts" and all(map(_are_texts, (given, stated))):
        return set(map(normalised, given)) == set(map(normalised, stated))
    if kind == "id":
        given, stated = str(given), str(stated)
    if loose and known is not None and isinstance(given, str) and is_number(stated):
        given = _measured(given, known.unit)
    if is_place(given) and is_place(stated):
        return _places_agree(given, stated, vocabulary)
    if isinstance(stated, list):
        if not isinstance(given, list) or len(given) != len(stated):
            return False
        pairs = zip(given, stated, strict=True)
        return all(values_agree(ours, theirs, None, vocabulary) for ours, theirs in pairs)
    if is_number(stated):
        return is_number(given) and abs(given - stated) <= tolerance(abs(stated))
    if isinstance(stated, str):
        return isinstance(given, str) and normalised(given) == normalised(stated)
    return bool(type(given) is type(stated) and given == stated)


def _places_agree(given: Sequence[float], stated: Sequence[float], vocabulary: Vocabulary) -> bool:
    unresolved = list(vocabulary.unresolved)
    if (list(given) == unresolved) != (list(stated) == unresolved):
        return False
    return math.dist(given, stated) <= min(tolerance(math.hypot(*stated)), FARTHEST + ROUNDING)


def tolerance(size: float) -> float:
    """How far a number may lie off a stated one of this size."""
    return max(RELATIVE * size, ABSOLUTE) + ROUNDING


def _measured(text: str, unit: str | None) -> float | None:
    """The number that a text means in `unit`; None when it is not one quantity in that unit."""
    text = text.strip()
    found = read_numbers(text) if len(text) <= LONGEST else ()
    if len(found) != 1 or (found[0].start, found[0].end) != (0, len(text)):
        return None
    number = found[0]
    return number.value if number.unit is None else converted(number.value, number.unit, unit)


def _rings_agree(given: Any, stated: Any, vocabulary: Vocabulary) -> bool:
    if not isinstance(given, list) or not isinstance(stated, list):
        return False
    # A ring may repeat its first corner at its end.
    given, stated = (
        ring[:-1] if len(ring) > 3 and ring[0] == ring[-1] else ring for ring in (given, stated)
    )
    starts = range(len(given))
    turns = (ring[at:] + ring[:at] for ring in (given, given[::-1]) for at in starts)
    return given == stated or any(values_agree(turn, stated, None, vocabulary) for turn in turns)


def _are_texts(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(item, str) for item in value)
