"""The tasks or skills of plans in one row, whether a predicted value is the stated one, and which
predicted entry stands for which expected one: an optimal assignment over equal names (Kuhn 1955, as
scipy's linear_sum_assignment computes it).
"""

from __future__ import annotations

import math
from collections import Counter, defaultdict
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.facts import is_number, is_place, normalised
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.units import converted
from planner_ft.vocabulary import Parameter, Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, step_skills

Pair = tuple[int, int]
Substitution = tuple[str | None, str | None]
"""(expected name, predicted name); None where nothing stands for it."""
TASK = "task"  # the role of every entry of a mission plan
LEADING = (TASK, "navigation")  # roles of entries that are paired first: one of them makes a step
COMPANY, NEARNESS = 1e-2, 1e-4
"""Weights that decide between equals, over all pairs, beside 1 for a pair's parameters."""

RELATIVE, ABSOLUTE = 0.02, 0.005
"""Tolerances of numbers: 2 % as the labelling rules allow, half a unit of the second decimal."""
FARTHEST = 0.5  # metres that a position may lie off: another whole metre is another place
ROUNDING = 1e-9
LONGEST = 40  # characters of a text that is read as one quantity


@dataclass(frozen=True)
class Entry:
    """A task or skill; `step`: index of its task or step; `stated`: parameters are given."""

    name: str
    role: str
    step: int
    parameters: dict[str, Any]
    stated: bool

    def known(self, vocabulary: Vocabulary) -> dict[str, Parameter]:
        """The parameters that it may have; none for a name outside the vocabulary."""
        is_task = self.role == TASK
        owner = vocabulary.task.get(self.name) if is_task else vocabulary.skill.get(self.name)
        return owner.by_name if owner else {}

    def agreeing(self, given: Entry, vocabulary: Vocabulary, *, loose: bool = True) -> list[str]:
        """Parameters that have the same content, or value (`values_agree`), in a given entry."""
        if self.parameters == given.parameters:
            return list(self.parameters)
        known, ours, theirs = self.known(vocabulary), self.parameters, given.parameters
        return [
            key
            for key in ours
            if key in theirs
            and values_agree(theirs[key], ours[key], known.get(key), vocabulary, loose=loose)
        ]

    def changed(self, given: Entry, vocabulary: Vocabulary) -> tuple[str, ...]:
        """Parameters that a given entry has with another value, and those of one alone."""
        same = self.agreeing(given, vocabulary, loose=False)
        every = dict.fromkeys([*self.parameters, *given.parameters])
        return tuple(key for key in every if key not in same)


Entries = tuple[Entry, ...]


def plan_entries(level: Level, plan: Any) -> Entries:
    """The entries of any JSON value in order, without those that have no name."""
    items = plan.get(list_key(level)) if isinstance(plan, dict) else None
    key = "title" if level == "mission" else "name"
    found = []
    for step, item in enumerate(items if isinstance(items, list) else ()):
        for role, owner in [(TASK, item)] if level == "mission" else step_skills(item):
            name = owner.get(key) if isinstance(owner, dict) else None
            if isinstance(name, str | int | float):  # a number is a name, too, of no vocabulary
                given = owner.get("parameters")
                known = given if isinstance(given, dict) else {}
                found.append(Entry(str(name), role, step, known, known is given))
    return tuple(found)


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


@dataclass(frozen=True)
class Alignment:
    """Entries of an expected and a predicted plan: `pairs` of (expected, predicted) indices in the
    order of the expected ones; `missing` and `extra` are the indices without a partner.
    """

    expected: Entries
    predicted: Entries
    pairs: tuple[Pair, ...]

    @property
    def missing(self) -> tuple[int, ...]:
        return self._alone(self.expected, 0)

    @property
    def extra(self) -> tuple[int, ...]:
        return self._alone(self.predicted, 1)

    def _alone(self, entries: Entries, side: int) -> tuple[int, ...]:
        paired = {pair[side] for pair in self.pairs}
        return tuple(index for index in range(len(entries)) if index not in paired)

    def matched(self) -> list[tuple[Entry, Entry]]:
        """(expected, predicted) entries."""
        return [(self.expected[ours], self.predicted[theirs]) for ours, theirs in self.pairs]

    def to_json(self) -> dict[str, list[Any]]:
        """Indices into the entries of the expected and the predicted plan (`plan_entries`)."""
        pairs = [list(pair) for pair in self.pairs]
        return {"pairs": pairs, "missing": list(self.missing), "extra": list(self.extra)}


def align(expected: Entries, predicted: Entries, vocabulary: Vocabulary) -> Alignment:
    """Pair as many entries of equal name as there are, each at most once, so that the sum of their
    likeness is greatest.

    Likeness counts, in this order: parameters that are all right; the share of key-value pairs that
    agree; the same company (tasks: the same neighbours; navigation skills: the same other skills in
    their step; other skills: a step whose navigation skill is paired with that of theirs); nearness
    in the plan. Roles do not count.
    """
    if expected == predicted:
        same = tuple((index, index) for index in range(len(expected)))
        return Alignment(expected, predicted, same)
    leading = {entry.name for entry in expected if entry.role in LEADING}
    ours, theirs = _surroundings(expected), _surroundings(predicted)
    size, steps = max(len(expected), len(predicted)), set[Pair]()

    def company(one: int, other: int) -> float:
        if expected[one].name not in leading:
            return float((expected[one].step, predicted[other].step) in steps)
        most = max(ours[one].total(), theirs[other].total())
        return (ours[one] & theirs[other]).total() / most

    def weight(one: int, other: int) -> float:
        far = ((one - other) / size) ** 2
        likeness = _likeness(expected[one], predicted[other], size, vocabulary)
        return likeness + (COMPANY * company(one, other) - NEARNESS * far) / size

    pairs: list[Pair] = []
    for lead in (True, False):
        named, given = (_by_name(entries, leading, lead) for entries in (expected, predicted))
        pairs += _assigned(named, given, weight)
        steps.update((expected[one].step, predicted[other].step) for one, other in pairs)
    return Alignment(expected, predicted, tuple(sorted(pairs)))


def _surroundings(entries: Entries) -> list[Counter[str]]:
    """The neighbours of each entry: the titles before and after a task, the skills of a step."""
    if any(entry.role == TASK for entry in entries):
        names = ["", *(entry.name for entry in entries), ""]
        around = zip(names, names[2:], strict=False)
        return [Counter((f"after {before}", f"before {after}")) for before, after in around]
    steps: dict[int, Counter[str]] = defaultdict(Counter)
    for entry in entries:
        steps[entry.step][f"{entry.role} {entry.name}"] += 1
    return [steps[entry.step] for entry in entries]


def _assigned(
    ours: dict[str, list[int]], theirs: dict[str, list[int]], weight: Callable[[int, int], float]
) -> list[Pair]:
    """The best pairs of each name."""
    from scipy.optimize import linear_sum_assignment

    pairs: list[Pair] = []
    for name, rows in ours.items():
        columns = theirs.get(name, [])
        if len(rows) == len(columns) == 1:
            pairs.append((rows[0], columns[0]))
        elif columns:
            weights = [[weight(one, other) for other in columns] for one in rows]
            best = zip(*linear_sum_assignment(weights, maximize=True), strict=True)
            pairs += [(rows[row], columns[column]) for row, column in best]
    return pairs


def _likeness(ours: Entry, theirs: Entry, size: int, vocabulary: Vocabulary) -> float:
    """F1 of key-value pairs, and more than all those together where all parameters are right."""
    if not ours.stated:
        return 0.0
    agreeing = ours.agreeing(theirs, vocabulary)
    total = len(ours.parameters) + len(theirs.parameters)
    share = 2 * len(agreeing) / total if total else 1.0
    return share + size * (share == 1.0 and not ours.changed(theirs, vocabulary))


def _by_name(entries: Entries, leading: set[str], lead: bool) -> dict[str, list[int]]:
    found: dict[str, list[int]] = defaultdict(list)
    for index, entry in enumerate(entries):
        if (entry.name in leading) == lead:
            found[entry.name].append(index)
    return found


def replaced(alignment: Alignment) -> dict[int, int]:
    """Unaligned entries in pairs, by indices: a predicted one stands for an expected one of its
    role that has the same aligned neighbours before and after, or one of them (a plan's beginning
    and end count as neighbours).
    """
    expected, predicted = alignment.expected, alignment.predicted
    ours = _neighbours(alignment.pairs, len(expected), 0)
    theirs = _neighbours(alignment.pairs, len(predicted), 1)
    found: dict[int, int] = {}
    for shared in (2, 1):
        for one in (one for one in alignment.missing if one not in found):
            for other in (other for other in alignment.extra if other not in found.values()):
                alike = predicted[other].role == expected[one].role
                if alike and len(ours[one] & theirs[other]) == shared:
                    found[one] = other
                    break
    return found


def substitutions(alignment: Alignment) -> list[Substitution]:
    """Names that stand for others; None for what was omitted (predicted), added (expected)."""
    pairs = replaced(alignment)
    given = [entry.name for entry in alignment.predicted]
    named: list[Substitution] = [
        (alignment.expected[one].name, given[pairs[one]] if one in pairs else None)
        for one in alignment.missing
    ]
    added = [other for other in alignment.extra if other not in pairs.values()]
    return named + [(None, given[other]) for other in added]


def _neighbours(pairs: Sequence[Pair], size: int, side: int) -> list[set[tuple[str, int]]]:
    """For each entry of one side, the numbers of the aligned pairs next to it, before and after."""
    number = {pair[side]: index for index, pair in enumerate(pairs)}
    found: list[set[tuple[str, int]]] = [set() for _ in range(size)]
    for way, order in (("before", range(size)), ("after", range(size - 1, -1, -1))):
        last = -1
        for index in order:
            found[index].add((way, last))
            last = number.get(index, last)
    return found
