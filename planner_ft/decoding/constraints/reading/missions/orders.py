"""What a command says of the order: tasks that come before others ("ahead of the contact a depth
grid"), places in another row than they are told in ("the farthest from home first", "do this list
from the bottom up", "on the way from one to the other").
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from planner_ft.data.numerals import signed
from planner_ft.decoding.constraints.reading.missions.apart import (
    PLACE,
    SENTENCE,
    named_places,
    sentences,
)
from planner_ft.decoding.constraints.reading.missions.spoken import SAYS

Position = tuple[float, float]
_DATA = re.compile(r"\b(?:upload|send|sent|transmit|beam)", re.IGNORECASE)
_TIME = r"(?! (?:\d|an? |half|\w+ (?:minutes|seconds|hours)))"
ONLY_THEN = re.compile(
    r"\b(?:but |though |and |however )?(?:only|not|no sooner|not sooner|no earlier|never)"
    r" (?:once|when|after|until|till|before|than)(?: after)?\b"
    rf"|\b(?:has|have|is|are) to wait (?:until|till|for)\b{_TIME}|\bwaits?"
    rf" (?:until|till|for)\b{_TIME}",
    re.IGNORECASE,
)
"""What stands between a task and the one that comes before it."""
_WAITS = re.compile(
    r"\b(?:that|that one|this|this one|it|which) (?:\w+ ){0,2}(?:has|is|will have) to wait"
    r" (?:until|till|for)\b|\b(?:that|which"
    r"|it)(?: one)? waits? (?:until|till|for)\b",
    re.IGNORECASE,
)
_AHEAD = re.compile(
    r"(?:^|[.;:!?,–—-] ?|\band )(?:but )?(?:ahead of|before|prior to) (?P<later>[^.;:,]{3,60}?)(?:,"
    r" | (?=an? |the |do |run |make ))",
    re.IGNORECASE,
)
_BEHIND = re.compile(
    r"(?:^|[.;:!?] ?)(?:after|once|when|following) (?P<earlier>[^.;:,]{3,60}?),", re.IGNORECASE
)
_BEFORE = re.compile(
    r" (?:ahead of|before|prior to|in advance of) (?!that\b|you\b|it\b|leaving|going|noon|dark|the"
    r" (?:tide|storm|weather))",
    re.IGNORECASE,
)
_NO_ORDER = re.compile(
    r"\b(?:not|no|never|don['’]?t|unless|if|or|again|twice|both|each|every|instead|last"
    r" time|yesterday)\b",
    re.IGNORECASE,
)
_REST = re.compile(r"[.;:,!?]|\band\b|\bthen\b", re.IGNORECASE)
_BETWEEN = re.compile(
    r"\s*(?:,|and|, and|&|;)\s*(?:(?:at|to|the one at|one at|then) )?", re.IGNORECASE
)
_FAR = r"(?:farthest|furthest|most distant|remotest|outermost)"
_NEAR = r"(?:nearest|closest|innermost)"
_ONE = (
    r"(?: one| stop| point| place)?(?: (?:out|away|off))?(?: (?:from|of|to) (?:home|base))?(?:"
    r" comes| goes)?"
)


def _sorted_by(first: str, last: str, inwards: str) -> re.Pattern[str]:
    """Words for a row from one end to the other."""
    ways = (
        rf"{first}{_ONE} first",
        rf"{last}{_ONE} last",
        rf"(?:start|begin)(?:ing)? (?:with|at|from) the {first}",
        rf"from (?:the )?{first} {inwards}",
    )
    return re.compile(rf"\b(?:{'|'.join(ways)})\b", re.IGNORECASE)


def _side(name: str) -> str:
    return rf"{name}(?:ern(?:most)?)?"


def _distance(place: Position) -> float:
    return place[0] ** 2 + place[1] ** 2


_SORTED: tuple[tuple[re.Pattern[str], Callable[[Position], float]], ...] = (
    (
        _sorted_by(_FAR, _NEAR, rf"(?:one )?(?:inwards?|in|to the {_NEAR})"),
        lambda place: -_distance(place),
    ),
    (_sorted_by(_NEAR, _FAR, rf"(?:one )?(?:outwards?|out|to the {_FAR})"), _distance),
    (
        _sorted_by(
            _side("north"), r"southern(?:most)?", rf"(?:southwards?|to (?:the )?{_side('south')})"
        ),
        lambda place: -place[1],
    ),
    (
        _sorted_by(
            _side("south"), r"northern(?:most)?", rf"(?:northwards?|to (?:the )?{_side('north')})"
        ),
        lambda place: place[1],
    ),
    (
        _sorted_by(
            _side("east"), r"western(?:most)?", rf"(?:westwards?|to (?:the )?{_side('west')})"
        ),
        lambda place: -place[0],
    ),
    (
        _sorted_by(
            _side("west"), r"eastern(?:most)?", rf"(?:eastwards?|to (?:the )?{_side('east')})"
        ),
        lambda place: place[0],
    ),
)
_REVERSED = re.compile(
    r"\b(?:in (?:the )?(?:reverse|opposite|inverse)(?:d)? order|in reverse|from (?:the )?last to"
    r" (?:the )?first|last (?:one )?first|back to front|"
    r"from (?:the )?bottom (?:up|to (?:the )?top)|from the end(?: to the (?:start|beginning))?|from"
    r" back to front|bottom up|backwards through (?:the"
    r"|this) list)\b",
    re.IGNORECASE,
)
_ITEM = re.compile(r"(?:^|\n|(?<=[:;.,]) ?)\s*(?:\(?(?P<number>\d{1,2})[.)]|[-*•])\s+")
_ORDER = re.compile(
    r"\b(?:before|after|first|last|until|till|ahead|prior|finally|reverse|once"
    r" (?!more)|when|both|each)\b",
    re.IGNORECASE,
)
_CONTACT = re.compile(r"\bcontact\b", re.IGNORECASE)
_FOLLOWED = re.compile(
    r"\bfollow\w* (?:the )?contact|\bcontact\b.{0,12}\bto (?:follow|shadow|tail)\b", re.IGNORECASE
)
_TWO = re.compile(
    r"\b(?:on the way|en route|half-?way|in between|between) (?:from |between )?(?:(?:the"
    r" )?(?:one|first|former) (?:to|and) (?:the )?(?:other|second"
    r"|latter|next)|the two|them|these two)\b",
    re.IGNORECASE,
)


@dataclass(frozen=True)
class Orders:
    """Pairs of tasks and of places of which the first comes before the second."""

    titles: frozenset[tuple[str, str]] = frozenset()
    places: frozenset[tuple[Position, Position]] = frozenset()
    after: frozenset[tuple[str, Position]] = frozenset()
    """Tasks with the places that are gone to behind them."""

    def titles_before(self, title: str) -> list[str]:
        """What comes before a task."""
        return sorted(one for one, other in self.titles if other == title)

    def places_before(self, place: Position) -> list[Position]:
        """What comes before a place."""
        return sorted(one for one, other in self.places if other == place)


@functools.lru_cache(maxsize=64)
def read_orders(text: str) -> Orders:
    """The order that a text tells beyond doubt; a contradiction is none."""
    titles, places = set(_titles(text)), set(_places(text))
    return Orders(
        frozenset((one, other) for one, other in titles if (other, one) not in titles),
        frozenset((one, other) for one, other in places if (other, one) not in places),
        frozenset(_after(text)),
    )


def asked(text: str) -> set[str]:
    """The tasks that a part of a sentence speaks of: what is sent may have the name of one."""
    return (
        {"SmartDataHarvest"}
        if _DATA.search(text)
        else {title for title, words in SAYS.items() if words.search(text)}
    )


def _titles(text: str) -> Iterator[tuple[str, str]]:
    """Pairs of tasks, where one task is spoken of on either side."""
    for sentence in sentences(text):
        for earlier, later in _parts(sentence, text):
            if len(earlier) == len(later) == 1 and earlier != later:
                one, other = next(iter(earlier)), next(iter(later))
                # A dock is a place as well, and what is not known yet is searched for unasked.
                if (
                    one != "DockingApproach"
                    and other != "SearchAndDetect"
                    and _once(one, text)
                    and _once(other, text)
                ):
                    yield one, other
    for first, second in combinations([titles for titles, _held in _from_the_end(text)], 2):
        yield from ((one, other) for one in first for other in second)


def _once(title: str, text: str) -> bool:
    return len(SAYS[title].findall(text)) <= 2


def _parts(sentence: str, text: str) -> Iterator[tuple[set[str], set[str]]]:
    if "?" in sentence:
        return
    only = list(ONLY_THEN.finditer(sentence))
    for match in only:
        behind = sentence[match.end() :].partition(", and ")[0]
        before = sentence[: match.start()].rpartition(", and ")[2]
        yield asked(behind), asked(before)
    for match in _WAITS.finditer(sentence):
        earlier = [one for one in only if one.end() < match.start()]
        if earlier:
            yield asked(sentence[match.end() :]), asked(sentence[earlier[-1].end() : match.start()])
    if _NO_ORDER.search(sentence):
        return
    for match in _AHEAD.finditer(sentence):
        rest = _REST.split(sentence[match.end() :])[0]
        yield (
            asked(rest),
            asked(match["later"])
            or (
                {"FollowTarget"}
                if _CONTACT.search(match["later"]) and _FOLLOWED.search(text)
                else set()
            ),
        )


def _places(text: str) -> Iterator[tuple[Position, Position]]:
    found = [(_position(match), match.start(), match.end()) for match in PLACE.finditer(text)]
    if len({place for place, _start, _end in found}) != len(found) or not 2 <= len(found) <= 12:
        return
    yield from _in_a_row(text, found)
    yield from _listed(text)
    yield from _labelled(text, found)
    yield from _between(text, found)


Found = Sequence[tuple[Position, int, int]]


def _in_a_row(text: str, found: Found) -> Iterator[tuple[Position, Position]]:
    """The places of the only list, sorted or reversed as the text says."""
    rows: list[list[Position]] = [[found[0][0]]]
    for one, two in pairwise(found):
        if _BETWEEN.fullmatch(text[one[2] : two[1]]):
            rows[-1].append(two[0])
        else:
            rows.append([two[0]])
    rows = [row for row in rows if len(row) > 1]
    keys = [key for words, key in _SORTED if words.search(text)]
    turned = _REVERSED.search(text) is not None and not _items(text)
    if (
        len(rows) != 1
        or len(keys) + turned != 1
        or re.search(r"\b(?:not|no need|never)\b[^.;]{0,20}\b(?:order|first)", text)
    ):
        return
    row = list(reversed(rows[0])) if turned else sorted(rows[0], key=keys[0])
    if turned or len({keys[0](place) for place in row}) == len(row):
        yield from combinations(row, 2)


def _items(text: str) -> list[tuple[int, int]]:
    """Where the items of the only list of a text begin and end."""
    marks = list(_ITEM.finditer(text))
    numbers = [match["number"] for match in marks]
    if (
        len(marks) < 2
        or (numbers[0] and numbers != [str(number) for number in range(1, len(marks) + 1)])
        or (numbers[0] is None and any(numbers))
    ):
        return []
    ends = [*(match.start() for match in marks[1:]), len(text)]
    return [(match.end(), end) for match, end in zip(marks, ends, strict=True)]


def _from_the_end(text: str) -> list[tuple[list[str], list[Position]]]:
    """The tasks, spoken of once each, and the places of the items of a list that is to be done from
    its end, in that order.
    """
    items, said = _items(text), _REVERSED.search(text)
    if not items or said is None or any(start <= said.start() < end for start, end in items[:-1]):
        return []
    found = []
    for first, last in reversed(items):
        titles = sorted(
            title
            for title in asked(text[first:last])
            if title != "DockingApproach" and len(SAYS[title].findall(text)) == 1
        )
        found.append((titles, [_position(match) for match in PLACE.finditer(text, first, last)]))
    return found


def _after(text: str) -> Iterator[tuple[str, Position]]:
    """Tasks of a list that is to be done from its end, with the places of the items behind them."""
    for (titles, before), (_later, places) in combinations(_from_the_end(text), 2):
        yield from ((title, place) for title in titles for place in places if place not in before)


def _listed(text: str) -> Iterator[tuple[Position, Position]]:
    """The places of a list that is to be done from its end."""
    for one, two in combinations([places for _titles_, places in _from_the_end(text)], 2):
        yield from ((first, second) for first in one for second in two)


def _labelled(text: str, found: Found) -> Iterator[tuple[Position, Position]]:
    """Places that get a label each before anything is done there: "spot A is [1, 2], spot B is [3,
    4]. At B ..., at A ...".
    """
    names = {key[1]: place for key, place in named_places(text, found)}
    if len(names) != len(found) or _ORDER.search(text, found[-1][2]):
        return
    spoken = re.compile(
        r"\b(?:at|to|from|near|by|on|in|of|then|{nouns})s?"
        rf" (?P<id>{'|'.join(map(re.escape, names))})\b".replace(
            "{nouns}", "spot|point|place|site|stop|position"
        )
    )
    row = dict.fromkeys(names[match["id"]] for match in spoken.finditer(text, found[-1][2]))
    if len(row) == len(names):
        yield from combinations(row, 2)


def _between(text: str, found: Found) -> Iterator[tuple[Position, Position]]:
    """What is done on the way from the first of two places to the second: "on the way from one to
    the other stop at the light tower at [0, 20]".
    """
    match = _TWO.search(text)
    if match is None:
        return
    before = [place for place, start, _end in found if start < match.start()]
    end = min((stop.start() for stop in SENTENCE.finditer(text, match.end())), default=len(text))
    behind = [place for place, start, _end in found if match.end() <= start < end]
    if len(before) == 2 and len(behind) == 1:
        yield before[0], behind[0]
        yield behind[0], before[1]
        yield before[0], before[1]


def _position(match: re.Match[str]) -> Position:
    x, y = (signed(part) for part in match.groups())
    return x, y
