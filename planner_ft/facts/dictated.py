"""Positions as speech recognisers write them: "at one ten minus fifty" is [110, -50], "ten comma
fifty thirty comma fifty" are two.
"""

import functools
import itertools
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from planner_ft.facts.numbers import read_all, read_rows
from planner_ft.facts.numerals import AND, Token
from planner_ft.facts.together import Number
from planner_ft.facts.words import SCALES, SMALL, WORDS

SIGNS = ("minus", "negative", "plus", "comma")
BINDING = (*range(10), *range(20, 100, 10))  # words that a digit behind them belongs to
LEAST = 10  # the first number before a "comma" that is no name
MOST_WORDS, MOST_BARE, LONGEST_ROW = 12, 16, 60
"""Words of one place, of several in a row, and of a row with commas, that are looked at."""
_AT = re.compile(
    r"(?:@|\b(?:at|to|for|via|near|around|from|between|on|visit|pos|cent(?:re|er)"
    r"|(?:position|waypoint)(?:\s+is)?))\s+(?:plus\s+)?$",
    re.IGNORECASE,
)
_OTHER = re.compile(r"\b(?:the|that|this|other|another|first|last|next)\s+$", re.IGNORECASE)
_X = re.compile(r"(?<![a-z])x\s+(?:(?:is|equals|of)\s+)?$", re.IGNORECASE)
_Y = re.compile(r",?\s+(?:and\s+)?y\s+(?:(?:is|equals|of)\s+)?", re.IGNORECASE)
_JOINT = re.compile(r"\s+(?:(?:comma|plus)\s+)*")
_COMMA = re.compile(r"\s+comma\s+")
_INSTEAD = "|".join(sorted(WORDS["instead"])).replace("_", r"\s+")
_BESIDE = re.compile(rf"(?:\s*,)?\s+(?:(?:and|then|and then|to)\s+|(?:(?:{_INSTEAD}),?\s+)+)?")
_BY = re.compile(r"\s+by\s")
TIMES = re.compile(r"\s+(?:more|times|laps?|rounds|circuits?|loops|orbits|circles|turns)\b")
_LAST_ONE = re.compile(r"\s+one$", re.IGNORECASE)
_SINGLE = re.compile(
    r"\s+(?:full )?(?:minute|second|hour|met(?:re|er)|knot|lap|round|circle|loop)\b"
)
_SCALE = re.compile(rf"(?:{'|'.join(SCALES)})\b", re.I)

Pair = tuple[float, float, int, int]  # x, y, start, end


class Run(NamedTuple):
    """A row of words of numbers: the numbers by their start, the spans between its commas, and
    whether it is more than one number.
    """

    start: int
    end: int
    numbers: dict[int, list[Number]]
    parts: tuple[tuple[int, int], ...]
    is_no_number: bool


@functools.lru_cache(maxsize=4096)
def dictated_pairs(text: str) -> tuple[Pair, ...]:
    """The coordinates whose words can be said in one way: behind "at" or "to" two numbers, or two
    and a third one with a unit, of a size or a count ("at one ten eighty fifty metres off"), and
    those of a row ("twenty ten then forty ten", "ten comma fifty thirty comma fifty").
    """
    known = {text[start:end].casefold() for _x, _y, start, end in _pairs(text, set())}
    return tuple(_pairs(text, known) if known else ())


def _pairs(text: str, known: set[str]) -> list[Pair]:
    """The coordinates of a text, those of words that are known to be coordinates elsewhere, too."""
    found = list[Pair]()
    for group in _groups(text):
        # "One hundred thirty" can be one number or two; in "ten fifty and one hundred thirty" two.
        sure = len(group) > 1 and any(run.is_no_number for run in group)
        for run in group:
            row = _row(text, run) if sure or len(run.parts) > 2 else []
            follows = bool(found) and _BESIDE.fullmatch(text, found[-1][3], run.start)
            words = text[run.start : run.end].casefold()
            before = _AT.search(text, max(0, run.start - 24), run.start)
            at = follows or before or words in known or _has_comma(text, run)
            found += _by_axes(text, run)
            found += row or (_place(text, run) if at and len(run.parts) < 3 else [])
    return found


def _has_comma(text: str, run: Run) -> bool:
    """Whether a row of words is a number of ten and more, "comma" and a number: "seven comma three"
    can be a name and something else, and "the other one fifty comma ten" another one.
    """
    if len(run.parts) != 2 or _OTHER.search(text, max(0, run.start - 24), run.start):
        return False
    paths = list(_at_comma(text, run))
    bare = all(len(path) == 2 and not (path[1].unit or path[1].counts) for path in paths)
    return bare and bool(paths) and abs(paths[0][0].said) >= LEAST


def _place(text: str, run: Run) -> list[Pair]:
    """The coordinates of a row of words, and a number behind them where something measures or
    counts; none where they can be said in several ways.
    """
    start, end = run.start, run.end
    if len(text[start:end].split()) > MOST_WORDS:
        return []
    paths = list(_paths(text, run.numbers, start, end))
    times = TIMES.match(text, end) is not None
    whole = list(_at_comma(text, run)) if len(run.parts) == 2 else []
    pairs = {(path[0].said, path[1].said, start, path[1].stop) for path in whole}
    if len(pairs) == 1 and not any(path[1].unit or path[1].counts for path in whole):
        return list(pairs)  # "one ten comma minus sixty / fifteen"
    alone = not text[end:].lstrip().startswith(",")
    if alone and len(paths) == 2 and all(number.said in range(10) for number in paths[1]):
        paths = paths[1:]  # "dock at five five"
    counted = times or any(path[-1].counts for path in paths)
    measured = any(path[-1].unit for path in paths) or _BY.match(text, end) is not None
    more = measured or counted
    if not more and any(len(path) == 1 for path in paths):
        return []  # "turn to one hundred ninety"
    sizes = (2, 3) if counted and not (measured or times) else (2 + more,)
    whole = [path for path in paths if len(path) in sizes]
    for plain in (_has_no_lone_digit, *(() if counted else (_is_even, _binds))):
        whole = [path for path in whole if plain(text, path)] or whole
    pairs = {(path[0].said, path[1].said, start, path[1].stop) for path in whole}
    return list(pairs) if len(pairs) == 1 else []


def _by_axes(text: str, run: Run) -> list[Pair]:
    """The coordinates of a row of words behind "x" and a number behind "y": "x one eighty y forty";
    none where the second can be another number.
    """
    between = (
        _Y.match(text, run.end) if _X.search(text, max(0, run.start - 24), run.start) else None
    )
    firsts = [path[0] for path in _paths(text, run.numbers, run.start, run.end, 1)]
    others = [one for one in read_all(text) if between and one.start == between.end()]
    plain = [one for one in others if not (one.unit or TIMES.match(text, one.stop))]
    longest = max((one.stop for one in plain), default=0)
    seconds = {one.said for one in plain if one.stop == longest}
    if len(firsts) != 1 or len(seconds) != 1 or any(one.unit == "m" for one in others):
        return []
    return [(firsts[0].said, seconds.pop(), run.start, longest)]


def _at_comma(text: str, run: Run) -> Iterator[list[Number]]:
    """The ways to read a row of words with one comma: a number before it, and behind it one that is
    all of it, or several.
    """
    before, behind = run.parts
    firsts = list(_paths(text, run.numbers, *before, 1))
    seconds = list(_paths(text, run.numbers, *behind, 2))
    more = [path for path in seconds if len(path) == 2 and _has_no_lone_digit(text, path)]
    alone = [path for path in seconds if len(path) == 1]
    times = TIMES.match(text, run.end) is not None
    # "Fifty comma one twenty / four times", "ten comma forty / five minutes".
    if times or (alone and all(path[0].unit not in (None, "m") for path in alone)):
        plain = more
    else:
        plain = [path for path in alone if not path[0].unit] or seconds
    for first in firsts:
        yield from (first + second for second in plain)


def _row(text: str, run: Run) -> list[Pair]:
    """The coordinates of a row, with a comma in each or with none; none where their words can be
    said in several ways.
    """
    numbers = list[Number]()
    bare = len(run.parts) == 1
    if bare and len(text[run.start : run.end].split()) > MOST_BARE:
        return []
    if TIMES.match(text, run.end) or _BY.match(text, run.end):
        return []
    for place, (start, end) in enumerate(run.parts):
        inner = 0 < place < len(run.parts) - 1
        counts = (2, 4, 6, 8) if bare else (2,) if inner else (1,)
        paths = _paths(text, run.numbers, start, end, counts[-1])
        whole = [path for path in paths if len(path) in counts]
        for plain in (_has_no_lone_digit, _binds):
            kept = [path for path in whole if plain(text, path)]
            whole = kept if kept or bare else whole
        if len(whole) != 1 or any(one.unit or one.counts for one in whole[0]):
            return []
        numbers += whole[0]
    two = zip(numbers[::2], numbers[1::2], strict=True)
    return [(one.said, other.said, one.start, other.stop) for one, other in two]


def _groups(text: str) -> Iterator[list[Run]]:
    """The rows of words of numbers, those with "and" or "then" between them together."""
    group = list[Run]()
    for start, end in _runs(text):
        numbers = dict[int, list[Number]]()
        for number in read_all(text):
            if start <= number.start < number.stop <= end:
                numbers.setdefault(number.start, []).append(number)
        bounds = [start, *itertools.chain(*map(re.Match.span, _COMMA.finditer(text, start, end)))]
        parts = tuple(zip(bounds[::2], [*bounds[1::2], end], strict=True))
        alone = any(one.stop == end for one in numbers.get(start, ()))
        if group and not _BESIDE.fullmatch(text, group[-1].end, start):
            yield group
            group = []
        group.append(Run(start, end, numbers, parts, is_no_number=not alone))
    if group:
        yield group


def _runs(text: str) -> Iterator[tuple[int, int]]:
    """Where words of numbers stand in a row: two words at least, and no figures."""
    row: list[tuple[int, int]] = []
    tokens = [*read_rows(text)[0].tokens, Token("", len(text), len(text))]
    for place, (word, start, end) in enumerate(tokens):
        numeral = word in SMALL or word in SCALES
        comma = any(text[slice(*span)] == "comma" for span in row)
        joined = bool(row) and word in AND and _goes_on(tokens, place, behind_comma=comma)
        if numeral or joined or (word in SIGNS and (row or word in SIGNS[:2])):
            row.append((start, end))
            continue
        if word in WORDS["behind_one"] and len(row) > 2 and text[slice(*row[-1])].lower() == "one":
            row.pop()  # "two piers: one at forty comma sixty one at ninety comma ten"
        if 1 < len(row) <= LONGEST_ROW:
            yield row[0][0], row[-1][1]
        row = []


def _goes_on(tokens: Sequence[Token], place: int, *, behind_comma: bool) -> bool:
    """Whether the "and" at a place is part of a number: "one hundred and six", but not in "ten
    comma one hundred and six comma forty", which are two positions.
    """
    numeral = [*SMALL, *SCALES]
    ahead = itertools.takewhile(lambda one: one.word in numeral, tokens[place + 1 :])
    count = sum(1 for _ in ahead)
    other = behind_comma and tokens[place + 1 + count].word == "comma"
    return tokens[place - 1].word in SCALES and count > 0 and not other


def _has_no_lone_digit(text: str, path: list[Number]) -> bool:
    """Whether no digit stands alone before its tens: "one / twenty / sixty"."""
    return not any(0 < last < 10 <= first for last, first, words in _gaps(text, path) if words == 1)


def _binds(text: str, path: list[Number]) -> bool:
    """Whether no number ends where a digit behind belongs to it: "twenty / five sixty", not "thirty
    / zero", "zero / zero".
    """
    return not any(
        last in BINDING and (0 < first < 10 or (first == 0 < last < 10))
        for last, first, _ in _gaps(text, path)
    )


def _gaps(text: str, path: list[Number]) -> Iterator[tuple[float, float, int]]:
    """The words on both sides of the blanks between numbers, and how many the first one has."""
    for one, two in itertools.pairwise(path):
        if text[one.stop : two.start].isspace():
            words, behind = text[one.start : one.stop].lower().split(), text[two.start :].lower()
            yield SMALL.get(words[-1], -1), SMALL.get(behind.split()[0], -1), len(words)


def _is_even(text: str, path: list[Number]) -> bool:
    """Whether both coordinates have as many words, two at least: "eight zero / eight zero"."""
    said = (text[one.start : one.stop].lower().split() for one in path[:2])
    first, second = (sum(word not in SIGNS for word in words) for words in said)
    return first == second > 1


def _paths(
    text: str, starts: dict[int, list[Number]], place: int, end: int, most: int = 3
) -> Iterator[list[Number]]:
    """The ways to read a row of words whole, as up to `most` numbers."""
    for number in starts.get(place, ()):
        # "One fifty one / hundred", "one / fifty one hundred".
        large = abs(number.said) >= 1000 and "thousand" not in text[place : number.stop].lower()
        # "Forty / one minute".
        lone = _LAST_ONE.search(text, place, number.stop) and _SINGLE.match(text, number.stop)
        if _SCALE.match(text, place) or large or lone:
            continue
        if number.stop == end:
            yield [number]
        elif most > 1 and number.unit is None and (joint := _JOINT.match(text, number.stop)):
            for path in _paths(text, starts, joint.end(), end, most - 1):
                yield [number, *path]
