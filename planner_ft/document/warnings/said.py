"""Measures and limits that the command says and the plan has not.

Facts of the text are compared with values of the plan; which words limit is data
(planner_ft/document/english.toml).
"""

import dataclasses
import functools
import itertools
import re
from collections import Counter
from collections.abc import Iterator

from planner_ft.document.language import ends_with
from planner_ft.document.warnings.case import LONGER, Case, Warning, lost, quoted, warning
from planner_ft.document.warnings.limits import AXIS, is_lost
from planner_ft.facts import Number, near
from planner_ft.facts.clock import read_times
from planner_ft.facts.inputs import SIDES
from planner_ft.facts.places import is_course, read_bearings, read_positions, rows_of_sizes
from planner_ft.facts.together import REREAD, neighbours
from planner_ft.facts.units import named
from planner_ft.vocabulary import Vocabulary

CLOCK = re.compile(r"\s*(?:o['’]?clock|am\b|pm\b|utc\b|gmt\b|zulu\b|local\b|ago\b)", re.IGNORECASE)
MOMENT = re.compile(r"(?:an? (?:\w+ )?)?(?:second|minute|moment|day)", re.IGNORECASE)
"""Words that are no time to be kept: "a second", "a good day"."""
SIZES = re.compile(r"\d\s?(?:m\b|met(?:re|er)s?)?\s?(?:wide|long)?\s?[x×*]\s?$")
"""Stands before the later sizes of "20 x 20 x 5" and "40 m wide x 20 m long"."""
SIDE = re.compile(rf"\b(?:{'|'.join(SIDES)})(?: (?:of|is))?\s*[:=]?\s*$", re.IGNORECASE)
HOUR = re.compile(r"(?:[01]\d|2[0-3])[0-5]\d")
BY = re.compile(r"\b(?:by|before|until|till) $", re.IGNORECASE)
ID = 100000
LONGEST_NAME = 24  # characters in which the name of a parameter stands before its value
NO = re.compile(r"\W*\bno\b(?!\.)\W*", re.IGNORECASE)
"""Stands between a value and its correction: "45 minutes, no, ten minutes"."""
NOT = re.compile(r",?\s+(?:and )?(?:not|instead of|rather than)\s+", re.IGNORECASE)
CORRECTED = 30  # characters between a value and its correction
AT = re.compile(r"\bat $", re.IGNORECASE)
OFF = re.compile(r" off (?:it|her|him|them|the|that|this)\b", re.IGNORECASE)
NEAR = 12  # characters before words in which they are ruled out
APART = 0.5  # metres beyond a line
WAY = 16  # characters between a length and the direction in which it lies
HOURS = 12  # the last one: "at six" is a time of day
REPEATED = 3  # words behind a count of which one says what is repeated: "two right hand laps"
THING = re.compile(r"[ -]([a-z]{3,})", re.IGNORECASE)
WORD = re.compile(r"\S+")
"""The first or second behind a count says what is repeated: "three full revolutions"."""


def measures(case: Case) -> Iterator[Warning]:
    """Measures and courses, but for those that are ruled out, taken back or only told of.

    One that a later clause replaces by a value that the plan has is taken back. Sizes that are said
    together must be values of one task. Those of limits that are lost are told by `limits`.
    """
    if case.source.facts.unread:
        return
    text, instead = case.text, _instead(case)
    measured = [one for one in case.numbers if _is_measure(text, one)]
    limiting = [clause for clause in case.clauses if is_lost(clause, case)]
    joined = functools.cache(functools.partial(neighbours, case.numbers))
    apart = {size.start for row in rows_of_sizes(text) for size in case.plan.missing_sizes(row)}
    for number, following in itertools.zip_longest(case.numbers, case.numbers[1:]):
        if not _is_measure(text, number) or not case.wants(number.start):
            continue
        if number.start not in apart and case.is_coordinate(number):
            continue
        between = text[number.end : following.start] if following else ""
        replaced = case.words["correction"].search(between) or NO.fullmatch(between)
        if replaced and len(between) <= CORRECTED:
            continue
        wholes = [*joined(number.unit), number]
        wholes = [one for one in wholes if one.start <= number.start and number.end <= one.end]
        if number.start not in apart and any(_is_in_plan(one, case) for one in wholes):
            continue
        if case.clause_at(number.start) in limiting:
            continue
        # A later number of the unit stands for it, or one without that comes right behind it.
        later = [one for one in instead if one.start > number.end]
        after = next((one.start for one in measured if one.start > number.end), len(text))
        later = [one for one in later if one.unit or one.start <= after]
        other = next((one for one in later if one.unit in (None, number.unit)), None)
        if other is None:
            found, bounds = case.lost(wholes[0].start, wholes[0].end), _exceeded(wholes[0], case)
            told = warning("value-lost", "bounds", text=found["text"].rstrip("."), bounds=bounds)
            yield {**found, "text": told["text"]} if bounds else found
        else:
            instead.remove(other)


def _exceeded(number: Number, case: Case) -> str:
    """The bounds of the first task whose every parameter in the unit of a number ends before it."""
    for task in case.tasks:
        known = case.vocabulary.task[task["title"]].parameters
        own = [(one, unit) for one in known if one.bounds and (unit := named(one.unit))]
        own = [(one, unit) for one, unit in own if unit.base == number.unit]
        beyond = ((one.maximum or 0) < unit.of_base(number.value) for one, unit in own)
        if own and all(beyond):
            listed = ", ".join(f"{one.name} is {one.bounds} {one.unit}" for one, _unit in own)
            return f"{task['title']} has bounds: {listed}"
    return ""


def harm(case: Case) -> Iterator[Warning]:
    """Words for what would hurt somebody, or for leaving out rules and warnings."""
    for clause in case.typed:
        found = case.words["harm"].search(clause.text)
        before = clause.text[max(0, found.start() - NEAR) : found.start()] if found else ""
        if found and not case.words["exclusion"].search(before) and not clause.corrected:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("harm-asked", about=words.casefold(), words=words)


def unclear(case: Case) -> Iterator[Warning]:
    """Clauses that change a value and say none: "double it", "the first was right"."""
    for clause in case.clauses:
        own = [one for one in case.numbers if clause.start <= one.start < clause.end]
        said = any(number.value != 1 or number.unit for number in own)
        if case.words["changed"].search(clause.text) and clause.start and not said:
            words = quoted(clause.text.strip(" ,;."))
            yield warning("value-lost", "unclear", about=words.casefold(), words=words)


def clock_times(case: Case) -> Iterator[Warning]:
    """Times such as "14:30" that are in no text of the plan, nor as a length among its values;
    those of limits are judged by `limits`.
    """
    readings = [*read_times(case.text), *_hours(case)]
    kept = [(one.start, one.end) for one in readings if case.plan.says(one.value)]
    for start, end in dict.fromkeys((one.start, one.end) for one in readings if not one.said):
        words, clause = case.text[start:end], case.clause_at(start)
        covered = any(first <= start and end <= last for first, last in kept)
        limit = clause is not None and case.words["limit"].search(clause.text)
        if case.wants(start) and not (covered or limit or words in case.plan.texts):
            yield lost(words)


def _hours(case: Case) -> Iterator[Number]:
    """Four digits that are a time of day: "by 1430"."""
    for number in (one for one in case.numbers if one.unit is None):
        before, digits = case.text[: number.start], case.text[number.start : number.end]
        if HOUR.fullmatch(digits) and BY.search(before[-NEAR:]):
            yield dataclasses.replace(number, said=0)


def _is_in_plan(number: Number, case: Case) -> bool:
    """Whether the plan has a number; a length off something in a parameter or a limit, since
    sentences keep nobody off.
    """
    off = OFF.match(case.text, number.end)
    known = (*case.plan.numbers, *case.plan.limited) if off else case.plan.anywhere
    signed = off or (number.value < 0 and number.unit == "m")
    return any(near(number.value, one) for one in known) if signed else case.plan.says(number.value)


def _instead(case: Case) -> list[Number]:
    """Numbers of clauses that replace something, which are values of the plan."""
    found = []
    for number in case.numbers:
        clause = case.clause_at(number.start)
        if clause and case.words["replaced"].search(clause.text):
            factors = (1, 60, 3600) if number.unit is None else (1,)
            known = [number.value * factor for factor in factors]
            if any(near(one, other) for one in known for other in case.plan.numbers):
                found.append(number)
    return found


def bare_numbers(case: Case) -> Iterator[Warning]:
    """Numbers without a unit that are values all the same: below 0, behind the name of a parameter
    ("radius 15"), in a row of sizes ("20x20x5"), before a side ("80 long"), in place of an earlier
    value ("4, no, 14"), or at the end of a clause ("give it five", "at 35"); and the last one that
    counts a parameter ("12 sectors").
    """
    plain = [one for one in case.numbers if one.unit is None and case.wants(one.start)]
    counted = {}
    for number in plain:
        if match := _counts(case.vocabulary).match(case.text, number.end):
            counted[match[1].casefold()] = number
    last_counted = list(counted.values())
    apart = {one.start for row in _sizes(case) for one in case.plan.missing_sizes(row)}
    behind_no = {
        two.start
        for one, two in itertools.pairwise(case.numbers)
        if NO.fullmatch(case.text, one.end, two.start)
    }
    for number in plain:
        clause = case.clause_at(number.start)
        inside = any(place.start <= number.start < place.end for place in case.positions)
        if inside or (number.start not in apart and case.is_coordinate(number)):
            continue
        before = case.text[max(0, number.start - LONGEST_NAME) : number.start]
        limits_it = clause is not None and case.words["limit"].search(clause.text)
        named = _parameters(case.vocabulary).search(before)
        bare = named or SIZES.search(before) or (AXIS.search(before) and not limits_it)
        replacing = case.words["replaced"]
        instead = clause and number.value != 1 and replacing.match(clause.text.strip(" ,"))
        last = clause and not case.text[number.end : clause.end].strip(" ,.;:!?")
        behind = ends_with(replacing, before) or number in last_counted
        behind = behind or _shots(number, case) or number.start in behind_no
        extent = case.words["extent"].match(case.text[number.end :].lstrip()) is not None
        behind = behind or extent
        if last and number.value >= 2:
            behind = behind or ends_with(case.words["measured"], before)
        behind = behind or (number.value > HOURS and AT.search(before) is not None)
        known = case.plan.says(number.value) or case.plan.says(number.value * 60)
        if number.value >= ID:  # digits of an id are the same, or another one's
            known = f"{number.said:.0f}" in case.plan.texts
        elif number.value < 0:
            known = any(near(number.value, other) for other in case.plan.anywhere)
        elif extent or SIDE.search(
            before
        ):  # a coordinate that follows from others is no "width 50"
            known = any(near(number.value, one) for one in case.plan.numbers)
        bare = bare or number.value < 0 or _is_distance(number, case)
        if number.start in apart or ((bare or instead or behind) and not known):
            yield case.lost(number.start, number.end)


def uncounted(case: Case) -> Iterator[Warning]:
    """Numbers of orders right before a word for a thing ("6 oxygen bottles") that nothing in the
    plan has, and that count neither its tasks nor the places of the command.
    """
    titles = Counter(task["title"] for task in case.tasks)
    known = {len(case.positions), *titles.values()}
    known.add(len(case.tasks) - titles[case.vocabulary.transit] - titles[case.vocabulary.locate])
    for number in () if case.source.facts.unread else case.numbers:
        many = number.unit is None and number.value >= 2 and number.value.is_integer()
        told = number.value in known or not case.wants(number.start)
        counts = many and not told and _is_before_thing(number, case)
        if counts and not case.plan.says(number.value):
            yield case.lost(number.start, number.end)


def _is_before_thing(number: Number, case: Case) -> bool:
    """Whether a number of an order, no coordinate, stands right before a word that is no small
    one.
    """
    start, end = number.start, number.end
    thing, clause = THING.match(case.text, end), case.clause_at(start)
    if not thing or not clause or any(one.start == thing.start(1) for one in case.numbers):
        return False
    before = case.text[clause.start : start]
    if len(before.split()) > 1 and not case.words["verb"].search(before):
        return False  # "We have 3 boats" is no order
    small = ("boundary", "determiner", "nothing", "verb", "extent", "shots", "off_it")
    behind = itertools.islice(WORD.finditer(case.text, end, clause.end), REPEATED)
    repeated = any(case.words["repeats"].match(case.text, one.start()) for one in behind)
    if repeated or any(case.words[name].match(thing[1]) for name in small):
        return False
    # "0930 diagnostics": a time of day begins what is done then.
    begins = not case.text[clause.start : start].strip()
    timed = CLOCK.match(case.text, end) or (begins and HOUR.fullmatch(case.text[start:end]))
    inside = any(place.start <= start < place.end for place in case.positions)
    return not (timed or inside or case.is_coordinate(number))


def instead_of(case: Case) -> Iterator[Warning]:
    """Values that the command wants in place of another one, which a task has: "35 m, not 10 m"."""
    known = [*itertools.chain(*case.plan.owners)]
    for one, other in itertools.pairwise(case.numbers):
        between = NOT.fullmatch(case.text, one.end, other.start)
        had, wanted = (any(near(at.value, by) for by in known) for at in (other, one))
        if between and one.unit in (None, other.unit) and had and not wanted:
            yield case.lost(one.start, other.end)


def _sizes(case: Case) -> Iterator[list[Number]]:
    """The rows of sizes that no later one corrects: "thirty by thirty, no, thirty by fifty"."""
    rows = rows_of_sizes(case.text)
    for place, row in enumerate(rows):
        later = (one for one in rows[place + 1 :] if len(one) == len(row))
        between = (case.text[row[-1].end : one[0].start] for one in later)
        changes = [NO, case.words["correction"], case.words["replaced"]]
        if not any(words.search(text) for text in between for words in changes):
            yield row


def crossed(case: Case) -> Iterator[Warning]:
    """A line such as "x = 100" on both sides of which the plan goes: it may be a limit."""
    paired = [(place.start, place.end) for place in read_positions(case.text)]
    for number in (one for one in case.numbers if one.unit in (None, "m")):
        before = case.text[max(0, number.start - LONGEST_NAME) : number.start]
        axis = None if SIZES.search(before) else AXIS.search(before)
        if axis and not any(start <= number.start < end for start, end in paired):
            at = "xy".index(axis[0][0].lower())
            points = [point[at] for leg in case.path.legs for point in leg.points]
            beyond = [one - number.value for one in points]
            if beyond and min(beyond) < -APART and max(beyond) > APART:
                words = case.text[number.start - len(axis[0]) : number.end]
                yield warning("limit-lost", "crossed", about=words.casefold(), words=words)


def _is_distance(number: Number, case: Case) -> bool:
    """Whether a number that may count things is a length to keep, which the plan has not: "half a
    cable off her", "half a cable due east".
    """
    lengths = case.source.facts.numbers("m")
    read = [one for one in lengths if one.start == number.start and one.rank >= REREAD]
    clause = case.clause_at(number.start)
    off = clause and case.words["off_it"].search(case.text, number.end, clause.end)
    ways = (way.start - number.end for way in read_bearings(case.text))
    off_or_along = bool(off) or any(0 <= way <= WAY for way in ways)
    return bool(read and off_or_along) and not any(case.plan.says(one.value) for one in read)


def _shots(number: Number, case: Case) -> bool:
    """Whether a number counts the pictures of something that the plan has in sectors."""
    around = any(case.vocabulary.task[one["title"]].pattern == "sectors" for one in case.tasks)
    behind = case.text[number.end :].lstrip(" -")
    return around and case.words["shots"].match(behind) is not None


@functools.lru_cache(maxsize=16)
def _parameters(vocabulary: Vocabulary) -> re.Pattern[str]:
    """The names of number parameters, at the end of what stands before their value."""
    parameters = [one for task in vocabulary.tasks for one in task.parameters if one.unit]
    names = sorted({re.escape(one.name).replace("_", r"[ _]") for one in parameters})
    return re.compile(rf"(?i)\b(?:{'|'.join(names)})(?: (?:of|is|at))?\s*[:=]?\s*$")


@functools.lru_cache(maxsize=16)
def _counts(vocabulary: Vocabulary) -> re.Pattern[str]:
    """The names of parameters that count, behind their value."""
    parameters = [one for task in vocabulary.tasks for one in task.parameters]
    names = {re.escape(one.name).replace("_", "[ _]") for one in parameters if one.unit == "count"}
    return re.compile(rf"(?i)[ -]({'|'.join(sorted(names))})\b" if names else r"(?!)")


def _is_measure(text: str, number: Number) -> bool:
    """Whether a number is a measure or a course. Counts, ids, parts and times of day are none."""
    moment = MOMENT.fullmatch(text, number.start, number.end)
    if moment or number.unit == "%" or CLOCK.match(text, number.end):
        return False
    return number.unit is not None or is_course(text, number.start)


def devices(case: Case) -> Iterator[Warning]:
    """Cameras that a word tells from others ("the port camera") of which the plan has no word."""
    known = [case.words[name] for name in ("determiner", "boundary", "verb", "nothing")]
    known += [case.spoken.sensors, *(data.said for data in case.spoken.data)]
    for clause in (one for one in case.clauses if not one.corrected):
        for start, end in clause.spans(case.words["device"]):
            before = WORD.findall(case.text[clause.start : start])[-1:]
            own = [one for one in before if LONGER.fullmatch(one)]
            new = [one for one in own if not any(words.fullmatch(one) for words in known)]
            if new and new[0].casefold() not in case.plan.words:
                yield lost(f"{new[0]} {case.text[start:end]}")
