"""In which steps a skill runs, told by places on a path that is known: "at the middle of the south side", "on the last lane", "from the start point onwards".

Each sentence, or part of one between semicolons, that tells such places has its skills run there and nowhere else. Words that only rule out the rest
("elsewhere not", "not on the way there") say nothing more. What is told in two ways is not read.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from planner_ft.data.task import geometry as g
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, plain
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import Mention, mentions_of, sentence_at
from planner_ft.decoding.constraints.reading.scopes.step_meanings import Anchor
from planner_ft.decoding.constraints.reading.skills.evidence import asks_for

Path = Sequence[g.Point]
Holds = Callable[[Path], bool | None]
"""Whether a scope holds at the last of some waypoints."""


@dataclass(frozen=True)
class PathScope:
    """The waypoints at which a skill runs; `plainly`: it is asked for there beyond doubt."""

    holds: tuple[Holds, ...]
    plainly: bool

    def allows(self, path: Path) -> bool | None:
        """Whether the skill must run (True) or must not (False) on the way to the last of some waypoints; None: not known."""
        verdicts = [holds(path) for holds in self.holds]
        runs = True in verdicts
        return None if (runs and not self.plainly) or (not runs and None in verdicts) else runs


@dataclass(frozen=True)
class Spot:
    """Words for places on a path, and where they are; `ruled_out`: the skill does not run there."""

    start: int
    end: int
    holds: Holds
    ruled_out: bool


_POINTS = r"(?:waypoints?|points?|wpts?|wps?|positions?|stops?|stations?)"
_SIDE = r"(?P<side>north|south|east|west)(?:ern)? (?:side|edge)\b"
_CORNER = r"(?P<corner>(?:north|south)[ -]?(?:east|west))(?:ern)? (?:corner|(?:corner )?waypoint|(?:corner )?point)\b"
_MID = r"(?:middle|mid-?point|centre|midway point)(?: waypoint| point)?"
_LINE = r"(?:lanes?|transects?|swaths?|rows?)"
_SQUARE: tuple[tuple[str, str], ...] = (
    ("mid", rf"\b(?:at|on|in|for|from) (?:the )?{_MID} (?:of|on) (?:the |its ){_SIDE}"),
    ("mid", rf"\b(?:at|on|in|for) (?:the |its )?{_SIDE.replace('(?:side|edge)', 'mid-?(?:side|point)')}"),
    ("side", rf"\b(?:at|on|along|for|over) (?:all )?(?:the )?(?:three |3 )?(?:{_POINTS} (?:of|on|along) )?(?:the |its ){_SIDE}"),
    ("corner", rf"\b(?:at|on|in|for) (?:the |its ){_CORNER}"),
    (
        "corners",
        r"\b(?:at|on|in|for) (?:only |just )?(?:all |each |every |any )?(?:of )?(?:the |its )?(?:four |4 )?corners?(?: (?:waypoints?|points?))?\b(?! of)",
    ),
    (
        "mids",
        r"\b(?:at|on|in|for) (?:only |just )?(?:all |each |every )?(?:of )?(?:the |its )?(?:four |4 )?(?:mid-? ?(?:sides?|points?)|"
        r"side (?:middles|centres|mid-?points)|"
        r"(?:middles?|centres?|mid-?points?) of (?:the |each |every |all )(?:four )?(?:sides?|edges?))\b",
    ),
)
"""Places of a survey square."""
_GRID: tuple[tuple[str, str], ...] = (
    (
        "lane ends",
        rf"\b(?:at|on|for) (?:both |the two |all )?(?:of )?(?:the )?(?:two )?(?:{_POINTS}|ends) (?:of|on) (?:the )?(?P<ord>{w.ORD}) {_LINE}\b",
    ),
    (
        "lane run",
        rf"\b(?:on|during|for) the (?:run|way|leg) (?:from the (?:start|beginning) of the (?P<ord>{w.ORD}) {_LINE} to its end|"
        rf"along the (?P<ord2>{w.ORD}) {_LINE})\b",
    ),
)
"""Places of a grid."""
_START = r"(?:the |its )?(?:start(?:ing)?(?: (?:point|waypoint|position|end))?|(?:first|start) (?:waypoint|point|end|lane|position|station|corner)|beginning)"
_WAY = r"(?:way|run|leg|transit|approach|passage|trip|drive|transfer|ride)"
_POINT = r"(?:point|waypoint|position|end|station)"
_ANY: tuple[tuple[str, str], ...] = (
    ("start", rf"\b(?:on|during|for|in) the {_WAY} (?:out |over |up |in )?(?:to|towards) {_START}\b"),
    (
        "start",
        rf"\b(?:while (?:you |she |it )?)?(?:go|goes|going|driving|running|heading|coming|steaming|getting|moving) (?:out |over |up )?(?:to|"
        rf"towards) {_START}\b",
    ),
    ("start", rf"\b(?:the|its) {_WAY} (?:out |over |up |in )?to {_START}\b"),
    ("start", rf"\b(?:until|till|before|up to|as far as) {_START}(?: (?:is|has been) reached| lies (?:behind|astern))?"),
    ("start", rf"\b(?:until|till|before) (?:you|she|it) (?:reach|reaches|have reached|has reached|are at|is at) {_START}\b"),
    (
        "beyond",
        rf"(?<!metres )(?<!meters )(?<!\dm )(?<!\d m )"
        rf"\b(?:from|beyond|past|after|starting (?:at|from)) {_START}(?: on(?:wards?|(?=[,.;]|$))| to the (?:very )?end\b|(?=,))",
    ),
    ("beyond", rf"\bonce (?:{_START} (?:is|has been) (?:reached|passed)|(?:you|she) (?:have|has|are|is) (?:reached|passed|at|past) {_START})\b"),
    ("first", rf"\b(?:at|on) (?:the |its )?(?:very )?(?:(?:start(?:ing)?|first) {_POINT}|first one|start)\b(?! (?:of|to)\b)"),
    ("final", rf"\b(?:at|on) (?:the |its )?(?:very )?(?:(?:end|last|final|finishing) {_POINT}|(?:last|final) one)\b(?! (?:of|to)\b)"),
    ("home", r"\b(?:on|during|for|in) the (?:(?:way|run|leg|trip|drive|passage) (?:back )?home|way back|(?:homeward|return) (?:leg|run|trip|way))\b(?! to)"),
    (
        "shape",
        r"\b(?:on|along|over|during|for|in|throughout) (?:the |its )(?:whole |entire |full )?(?:(?:survey )?square|grid|lanes|survey|transects|circuit)\b"
        r"(?: itself| proper)?(?:,? (?:including|and) (?:its|the) (?:closing|last|final) (?:point|leg|waypoint))?(?: only| alone)?"
        r"(?! (?:of|at|from|about|around|round|over|with|to|as)\b)",
    ),
    ("between", r"\bfrom (?:the moment (?:you are at |you leave )?)?@ (?:to|until(?: you reach)?|till(?: you reach)?|up to) @"),
    ("between", r"\bbetween @ and @"),
    ("second", r"\b(?:on|in|over|during|for) (?:that|this) (?:run|leg|pass|line|track|stretch|cable|course)\b(?! (?:to|back|home))(?: only| alone| itself)?"),
    ("second", r"\b(?:in )?between the two(?: points| ends| waypoints)?\b|\bbetween (?:them|these two)\b"),
    ("second", r"\b(?:on|along|over|during) the (?:cable|track|pass|pipe\w*|line) (?:itself|proper|only|alone)\b|\bthere, (?:and )?not before\b"),
    (
        "bound",
        r"\b(?:on the )?(?P<way>north|south|east|west)(?:bound|wards?)(?: (?:run|leg|pass|lane)s?)?\b|\bon the (?:way|run|leg) (?P<way2>north|"
        r"south|east|west)\b",
    ),
    ("legs", r"\b(?:on|during|for|in) legs? (?P<cards>[1-9](?:(?:, [1-9])*(?:,? and | & |\+)[1-9])?)\b(?! ?(?:m|met\w+)\b)"),
    ("last", r"\b(?:on|during|for|in) the (?:last|final) leg\b|\bat the (?:last|final) (?:waypoint|point|position)\b"),
)
"""Places of any path."""
_EVERYWHERE = re.compile(
    rf"\b(?:at|on) (?:every(?: single)?|each|all)(?: of)?(?: the| these| its)?(?: (?:two|three|four|five|six|seven|eight|nine|ten|"
    rf"\d+))?(?: {_POINTS}\b|(?=[.,;]|$| (?:and|only)\b))|"
    r"\bthroughout\b|\ball the (?:time|way|while)\b|\bthe whole (?:time|way)\b|\bfrom start to finish\b|\bat all times\b|\ball along\b"
)
_LED_TO = ("line", "pass", "lawnmower", "square")
"""Patterns of tasks that begin where their path does, whatever that is."""
_BEGINS = re.compile(r"\b(?:start\w*|begin\w*|clockwise|first|enter\w*|commenc\w+|from)(?:,? (?:at|on|in|from|with|is|the|it|being))*,? ?$")
"""Words before a place that say where the path begins."""
_RULED_OUT = re.compile(
    r"\b(?:not|nor|never|none|neither|nothing|no|without|nowhere|no \w+|not \w+|neither of them)(?:,? (?:while|when|yet|either|at|it|them|of))*,? ?$"
)
_RULES_OUT = re.compile(
    r"^,?(?: (?:it|they|she|you|we|i|that|is|are|log|take|run|record|use|have|do|want|need|goes|go))*,? ?"
    r"(?:not\b(?! (?:only|before|otherwise|on|in|at|while|elsewhere))|(?:none|nothing|no|without|off)\b(?! (?:\w+ )?(?:afterwards|thereafter|"
    r"elsewhere|otherwise|else|"
    r"after|before|between|on|in|at|during)\b)|rests?\b|sleeps?\b)"
)
_TIED = re.compile(r"\b(?:if|unless|every (?:other|second|third)|alternat\w*|half|instead of the (?:grid|square))\b")
_DONE = re.compile(r"\b(?:run|pass|go|head|track|follow|sail|then|drive|turn)\b|@")
_STAYS = re.compile(r"\b(?:hold|wait|stay|stop|halt|pause|drift|float|keep station|turn|rotate|face|pan)(?:s|ing|ping)?\b")
"""Words of movements that go nowhere: what a sentence with one of them says may be about that."""
_LIMITS = ("BoundaryEnforcement", "ObstacleAvoidance", "LockHeading")
_PARTS = re.compile(r",|\b(?:and|but|while)\b")


def read_path_scopes(text: str, names: Iterable[str], paths: Sequence[Path], pattern: str) -> dict[str, PathScope]:
    """Where on the one path of a task, that may be any of some `paths` of one shape, filter and perception skills run, by their names."""
    said = plain(text)
    if not said.text or w.CHANGED.search(said.text) or len({len(path) for path in paths}) > 1 or (paths and len(paths[0]) < 2):
        return {}
    if not paths and pattern not in _LED_TO:
        return {}
    spots = list(_spots(said, paths, pattern))
    if not spots:
        return {}
    mentions = mentions_of(said.text, [name for name in names if name in w.SKILL_WORDS], [Anchor(spot.start, spot.end, True, None) for spot in spots])
    found: dict[str, list[tuple[Holds | None, bool]]] = {}
    latest: set[str] = set()
    for begin, end in _sentences(said.text):
        here = [mention for mention in mentions if begin <= mention.start < end]
        inside = [spot for spot in spots if begin <= spot.start < end]
        if (
            inside
            and not here
            and any(not spot.ruled_out for spot in inside)
            and re.search(r"\d|\bten\b|\b\w+ (?:metres|will do|is enough)\b|ditto|too\b|also", said.text[begin:end])
        ):
            # "Twenty metres up to the first point; from there to the end, ten."
            for name in latest:
                found.setdefault(name, []).append((None, True))
        latest = {mention.name for mention in here} or latest
        for mention, holds in _placed(said.text, begin, end, here, inside):
            holds = None if _STAYS.search(said.text[begin:end]) else holds
            clause = said.text[max(begin, said.text.rfind(",", begin, mention.start)) : end]
            found.setdefault(mention.name, []).append((holds, asks_for(clause, mention.name) or asks_for(said.text[begin:end], mention.name)))
    scopes = {}
    for name, places in found.items():
        told = [place for place in places if place[0] is not None]
        titles = len(places) - len(told)
        # A word for a skill elsewhere may ask for it there, except in what the task is called: "depth grid".
        if told and (not titles or (titles == 1 and places[0][0] is None and not places[0][1])):
            scopes[name] = PathScope(tuple(holds for holds, _plainly in told if holds), any(plainly for _holds, plainly in told))
    return scopes


def _sentences(text: str) -> Iterator[tuple[int, int]]:
    begin = 0
    for match in re.finditer(r"[.;!?](?=\s|$)", text):
        yield begin, match.start()
        begin = match.end()
    yield begin, len(text)


def _placed(text: str, begin: int, end: int, mentions: Sequence[Mention], spots: Sequence[Spot]) -> Iterator[tuple[Mention, Holds | None]]:
    """Each mention of a sentence with the places that are meant."""
    positive = [spot for spot in spots if not spot.ruled_out]
    if not positive and spots and not _TIED.search(text[begin:end]):
        # "Not on the way to the start": everywhere else.
        everywhere_else = _but([spot.holds for spot in spots])
        for mention in mentions:
            yield mention, everywhere_else
        return
    if _TIED.search(text[begin:end]) or not positive:
        for mention in mentions:
            if not mention.denied or not spots:
                yield mention, None
        return
    if len(positive) == 1:
        for mention in mentions:
            closer = [other for other in mentions if mention.end <= other.start < positive[0].start and "," in text[mention.end : other.start]]
            if mention.name in _LIMITS and closer:
                # "Inside @, pin q at the last point."
                yield mention, None
                continue
            yield mention, _less(positive[0].holds, [spot.holds for spot in spots if spot.ruled_out])
        return
    if len(positive) == 2 and _JOINT.fullmatch(text[positive[0].end : positive[1].start]):
        for mention in mentions:
            near = "," not in text[mention.end : positive[0].start] + text[positive[1].end : mention.start]
            yield mention, _either(positive[0].holds, positive[1].holds) if near else None
        return
    parts = _parts(text, begin, end, positive)
    for mention in mentions:
        own = next((spot for (first, last), spot in parts if first <= mention.start < last), None)
        yield mention, own.holds if own else None


_JOINT = re.compile(r",? (?:and|or|as well as|and also|and again) ")


def _either(one: Holds, other: Holds) -> Holds:
    """What holds at one of two places: "both at the start point and at the end point"."""

    def holds(path: Path) -> bool | None:
        found = one(path), other(path)
        return True if True in found else None if None in found else False

    return holds


def _less(where: Holds, barred: Sequence[Holds]) -> Holds:
    """A place without others: "on the northbound run, not on the way to its start"."""
    return (lambda path: False if any(one(path) for one in barred) else where(path)) if barred else where


def _but(spots: Sequence[Holds]) -> Holds:
    def holds(path: Path) -> bool | None:
        # Elsewhere it may be meant for some ways only.
        return False if any(one(path) for one in spots) else None

    return holds


def _parts(text: str, begin: int, end: int, spots: Sequence[Spot]) -> list[tuple[tuple[int, int], Spot | None]]:
    """The parts of a sentence that tell one place each."""
    cuts = [begin]
    for one, other in itertools.pairwise(spots):
        # The part ends at the last separator before the next place, or at the first behind this one where the places end their parts.
        between = list(_PARTS.finditer(text, one.end, other.start))
        opens = not text[begin : one.start].strip(" ,")
        if not between:
            return []
        cuts.append((between[-1] if opens else between[0]).start())
    cuts.append(end)
    return [((first, last), spot) for first, last, spot in zip(cuts, cuts[1:], spots, strict=False)]


def _spots(said: Plain, paths: Sequence[Path], pattern: str) -> Iterator[Spot]:
    text = said.text
    found: list[tuple[int, int]] = []
    spots: list[Spot] = []
    tables = (_SQUARE if pattern == "square" else _GRID if pattern == "lawnmower" else ()), _ANY
    for kind, words in (*tables[0], *tables[1]):
        if kind == "second" and pattern in ("square", "lawnmower"):
            continue
        for match in re.finditer(words, text):
            if any(match.start() < end and start < match.end() for start, end in found):
                continue
            found.append(match.span())
            before = text[: match.start()]
            if kind in ("mid", "side", "corner", "corners", "mids", "first", "final") and _BEGINS.search(re.split(r"[.;]", before)[-1]):
                continue
            holds = _holds(kind, match, said, paths)
            if holds is not None:
                ruled_out = bool(_RULED_OUT.search(re.split(r"[.;]", before)[-1]) or _RULES_OUT.match(re.split(r"[.;]", text[match.end() :])[0]))
                spots.append(Spot(match.start(), match.end(), holds, ruled_out))
    for match in _EVERYWHERE.finditer(text):
        if spots and not any(match.start() < end and start < match.end() for start, end in found):
            spots.append(Spot(match.start(), match.end(), lambda path: True, False))
    yield from sorted(spots, key=lambda spot: spot.start)


def _holds(kind: str, match: re.Match[str], said: Plain, paths: Sequence[Path]) -> Holds | None:
    """Where a place on the path is; None where that cannot be told."""
    count, groups = len(paths[0]) if paths else 0, match.groupdict()
    if kind == "start":
        return _numbers(frozenset({0}))
    if kind == "beyond":
        return lambda path: len(path) > 1
    if kind == "legs":
        started = re.search(r"\bstart(?:ing)? (?:point|position|at|from)\b.*\bleg 1\b[:=,.]? ", said.text)
        wanted = frozenset(map(int, re.findall(r"\d", groups["cards"] or "")))
        return _numbers(wanted) if started and (not count or max(wanted) < count) else None
    if kind in ("home", "shape"):
        # The way home is the one that the text asks for, behind all others.
        going = _GOES_HOME.search(said.text) and not _NOT_ALL.search(said.text[slice(*sentence_at(said.text, match.start()))])
        return (lambda path: _is_home(path) == (kind == "home")) if going else None
    if kind == "first":
        return _numbers(frozenset({0}))
    if kind == "final" and not paths:
        return lambda path: None if len(path) > 1 else False
    if not paths:
        # A run has one leg behind its start.
        alone = kind == "second" and not re.search(r"\b(?:back|return|legs|runs|passes|twice|again|second)\b|\bleg \d", said.text)
        return (lambda path: len(path) > 1) if alone else None
    if kind in ("mid", "side", "corner", "corners", "mids"):
        return _on_square(kind, groups, paths)
    if kind.startswith("lane"):
        number = w.ORDINAL[groups.get("ord") or groups.get("ord2") or ""]
        number = number if number >= 0 else count // 2 + number
        wanted = frozenset({2 * number, 2 * number + 1} if kind == "lane ends" else {2 * number + 1})
        return _numbers(wanted) if count % 2 == 0 and max(wanted) < count else None
    if kind == "second":
        return _numbers(frozenset({1})) if count == 2 else None
    if kind in ("last", "final"):
        return _numbers(frozenset({count - 1}))
    if kind == "between":
        signs = [match.start() + sign.start() for sign in re.finditer("@", match[0])]
        one, other = (said.places.get(sign) for sign in signs)
        path = [tuple(map(float, point)) for point in paths[0]]
        steps = [index for index in range(1, count) if (path[index - 1], path[index]) == (one, other)]
        begin, end = sentence_at(said.text, match.start())
        alone = len(paths) == 1 and len(steps) == 1 and not _DONE.search(said.text[begin : match.start()] + said.text[match.end() : end])
        return _numbers(frozenset(steps)) if alone else None
    begin, end = sentence_at(said.text, match.start())
    sentence = said.text[begin:end]
    way = {"north": (0, 1), "south": (0, -1), "east": (1, 0), "west": (-1, 0)}[groups.get("way") or groups.get("way2") or ""]
    # "Run it northbound" is a movement.
    both = re.search(r"\bnorth\w*\b.*\bsouthbound|\bsouth\w*\b.*\bnorthbound|\beast\w*\b.*\bwestbound|\bwest\w*\b.*\beastbound", said.text) or re.search(
        r"\b(?:northbound|northwards?)\b.*\bsouth|\bsouth\w*\b.*\bnorth|\beast\w*\b.*\bwest|\bwest\w*\b.*\beast", sentence
    )
    return _bound(way) if both and not _DONE.search(_BOUND_WAY.sub(" ", sentence)) else None


_GOES_HOME = re.compile(
    r"\b(?:come|head|go|return|run|back|sail|steam|motor|drive)\w*(?: (?:straight|back|directly|on|over|in|then|for)){0,2} (?:home|(?:to )?base)\b"
)
_NOT_ALL = re.compile(r"\b(?:between|hops|turns|across|hold\w*|stop\w*|half|first|second|third|except|but)\b")
"""Words by which a sentence about a grid or square is about a part of it."""
_HOME = (0.0, 0.0)


def _is_home(path: Path) -> bool:
    """Whether the last of several waypoints is where the vehicle started."""
    return len(path) > 1 and (float(path[-1][0]), float(path[-1][1])) == _HOME


def _numbers(wanted: frozenset[int]) -> Holds:
    return lambda path: len(path) - 1 in wanted


_BOUND_WAY = re.compile(r"\b(?:north|south|east|west)bound (?:run|leg|pass|lane)s?\b|\bon the way to (?:its|the) start\b")
"""Words for a way that no movement is asked for by."""


def _bound(way: tuple[int, int]) -> Holds:
    """On ways towards a point of the compass; that to the first waypoint is not known."""

    def holds(path: Path) -> bool | None:
        if len(path) < 2:
            return None
        east, north = path[-1][0] - path[-2][0], path[-1][1] - path[-2][1]
        along, across = east * way[0] + north * way[1], east * way[1] + north * way[0]
        return along > abs(across) * 2

    return holds


def _on_square(kind: str, groups: dict[str, str | None], paths: Sequence[Path]) -> Holds | None:
    """The places of a survey square, the same for every way round it."""
    boxes = {tuple(round(bound(point[axis] for point in path), 2) for axis in (0, 1) for bound in (min, max)) for path in paths}
    if len(boxes) != 1 or len(set(paths[0])) != 8:
        return None
    left, right, bottom, top = boxes.pop()
    sides = {"north": (1, top), "south": (1, bottom), "east": (0, right), "west": (0, left)}

    def on(side: str) -> Holds:
        axis, value = sides[side]
        return lambda path: abs(path[-1][axis] - value) < 0.02

    def corner(path: Path) -> bool:
        return sum(bool(on(side)(path)) for side in sides) == 2

    if kind == "corners":
        return corner
    if kind == "mids":
        return lambda path: not corner(path)
    if kind == "corner":
        named = [side for side in sides if side in (groups["corner"] or "")]
        return lambda path: all(on(side)(path) for side in named)
    side = groups["side"] or ""
    return on(side) if kind == "side" else lambda path: on(side)(path) and not corner(path)
