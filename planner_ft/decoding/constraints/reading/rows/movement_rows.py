"""The movements of a task input as a row: in which of them a step of a plan is, found by the plan's own movements.

A movement of the text is one step where it goes to a place or turns once, and as many as it takes where it runs a grid or a line.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.data.quantities import positions
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.scopes import scope_words as w


@dataclass(frozen=True)
class Unit:
    """A movement of the text: its navigation skill, where its words stand, of how many steps it is (None: not known), and the place that it goes to.

    One that is `chained` is a place that the one before it is followed by.
    """

    kind: str
    start: int
    end: int
    steps: int | None = 1
    place: tuple[float, float] | None = None
    chained: bool = False

    @property
    def single(self) -> bool:
        return self.steps == 1


@dataclass(frozen=True)
class Row:
    """The movements of a text in their order."""

    units: tuple[Unit, ...]

    def unit(self, names: Sequence[str]) -> int | None:
        """In which movement the last of some steps is; None where the steps are not those of the text."""
        at, done = -1, 0
        for name in names:
            unit = self.units[at] if at >= 0 else None
            if unit is not None and name == unit.kind and (unit.steps is None or done < unit.steps):
                if unit.steps is None and at + 1 < len(self.units) and self.units[at + 1].kind == name:
                    return None
                done += 1
                continue
            at, done = at + 1, 1
            if at >= len(self.units) or self.units[at].kind != name or (unit is not None and unit.steps is not None and unit.steps > 1 and unit.kind == name):
                return None
        return at if at >= 0 else None

    def of(self, kinds: frozenset[str]) -> tuple[int, ...]:
        """The movements of some kinds."""
        return tuple(index for index, unit in enumerate(self.units) if unit.kind in kinds)


@dataclass(frozen=True)
class Plain:
    """A text in small letters with signs for places and quotations, the places, and where each letter stood."""

    text: str
    places: dict[int, tuple[float, float]]
    origin: tuple[int, ...]


_SIGN = re.compile(r"(?:\b(?:x|minus|\+)\s*=?\s*|[\[({]\s?|[-−–](?=~))*~(?:\s?[\])}])*")
_WRITTEN = re.compile(r"^(?!.*(?:minute|second|hour|metre|meter)).*(?:\d|\b[xy]\b|minus)", re.DOTALL)
_NAMED = re.compile(r"\b(?:position|waypoint|point)\s+(?=~)")
_LITERAL = re.compile(r"\s*@\s*")


def plain(text: str) -> Plain:
    """The text as `Plain`: ~ for a place while it is made, @ in the end."""
    made, origin = without_fences(text).lower(), tuple(range(len(text)))
    if len(made) != len(text):
        return Plain("", {}, ())
    made, origin = _put(made, origin, [(match.start(), match.end(), " at ") for match in _LITERAL.finditer(made)])
    found, behind = [], len(made)
    for x, y, start, end in sorted(positions(made), key=lambda place: -place[2]):
        if end <= behind and not w.COUNTED.search(made[:start]) and _WRITTEN.search(made[start:end]):
            found.append((start, end, (float(x), float(y))))
            behind = start
    found.reverse()
    made, origin = _put(made, origin, [(start, end, "~") for start, end, _place in found])
    for pattern, sign in (
        (w.QUOTED, " q "),
        (_NAMED, ""),
        (_SIGN, "@"),
        (w.SENSORS, " cam "),
        (re.compile(r"\s+(?=[,.;:!?])"), ""),
        (re.compile(r"[ \t]+"), " "),
    ):
        made, origin = _put(made, origin, [(match.start(), match.end(), sign) for match in pattern.finditer(made)])
    signs = [match.start() for match in re.finditer("@", made)]
    places = {sign: place for sign, (_start, _end, place) in zip(signs, found, strict=True)} if len(signs) == len(found) else {}
    return Plain(made, places, origin)


def _put(text: str, origin: tuple[int, ...], parts: list[tuple[int, int, str]]) -> tuple[str, tuple[int, ...]]:
    """A text with other words in some parts, and where its letters stood."""
    made: list[str] = []
    where: list[int] = []
    end = 0
    for start, stop, sign in parts:
        made += [text[end:start], sign]
        where += [*origin[end:start], *[origin[start] if start < len(origin) else 0] * len(sign)]
        end = stop
    return "".join([*made, text[end:]]), (*where, *origin[end:])


_TO_PLACE = re.compile(r"@|\bthe (?:target|goal|start\w*) (?:position|point)\b")
_PLACES = re.compile(rf",? ?(?:and |then |and then |to |finally |lastly |via |, ){{0,3}}(?:{_TO_PLACE.pattern})")
"""A place behind another one, to go to next."""
_SEVERAL_TURNS = re.compile(
    r"\b(?:times|twice|each|every|steps of|in (?:\w+ ){0,3}(?:steps|stages|parts)|sectors|evenly|points|repeat\w*|headings|bearings|in turn|"
    r"one after the other|all round)\b|"
    r"(?:,|,? and|,? then|,? and then) (?:to )?(?:\d{1,3}|(?:north|south|east|west)[\w-]*)\b(?! ?(?:m|s|min\w*|sec\w*|met\w*|feet)\b)"
)
_NEXT_TURN = re.compile(
    r"(?<=[\dth°])(?:°| degrees)?(?:,? and then|,? then|,? and|,)(?: to| on to| onto)? (?:due )?"
    r"(?:\d{1,3}\b(?! ?(?:m|s|min\w*|sec\w*|met\w*|feet|hours?|percent|times|x)\b)(?!\.\d)|(?:north|south|east|west)(?:[ -]?(?:north|south|east|"
    r"west))*\b(?! (?:of|side|end|corner)))"
)
"""A turn behind another one, told by its heading alone."""
_SEVERAL_ARCS = re.compile(r"\b(?:times|twice|each|every|repeat\w*|arcs|turns|bends|alternat\w*)\b")
_ONE_PLACE = re.compile(r"@$|\b(?:home|base|target|goal|berth|dock|centre|center|point|position|start\w*)$")
_GRID = re.compile(r"\b(?:grid|lawn-?mow\w*|square|lanes|lines|transects?|cable|pipeline|track|sides|area|circle)\b")
_ON_THE_WAY = re.compile(
    r"\b(?:(?:coming|running|going|heading|driving|steaming|sailing|moving|getting|motoring|closing) (?:in|out|over|up|down|back|there|on)?,? ?to @|"
    r"(?:way|leg|run|approach|transit|passage|trip|crossing|stretch|drive|course)(?: (?:in|out|over|across|up|down|back|on))?,? (?:to|towards) @|"
    r"approaching @|between (?:@|there|here) and @)"
)
"""Words for the way to a place, that do not ask for a movement beside another one to it."""
_THROUGH = re.compile(r"\b(?:through|via|by way of) @$")
_ONWARDS = re.compile(
    r"\b(?:from (?:there|here)(?: on(?:wards?)?)?,?|(?:on|during|for) the (?:final |last )?(?:run|leg|approach|stretch)(?: in)?) "
    r"(?P<leg>to the (?:target|goal) (?:position|point))\b"
)
_OWN_PLACE = re.compile(r"\b(?:target|goal) (?:position|point)\b")
"""A leg to the task's own place, told by where it begins."""
_GETTING_THERE = re.compile(r"@,? (?:so |and |with |but )?[^.;@]{0,40}\b(?:getting|going|coming|heading|driving|on the way) (?:there|in)\b")


_MORE = (
    (
        w.ARC,
        re.compile(r"(?<!the )(?<!that )(?<!this )\b(?:an? |one |make |do |take |sail |another )*(?:wide |sweeping |arc )+(?:turn|arc|curve)\b[^.;,]{0,40}"),
    ),
    (w.GOTO, re.compile(r"\b(?:just|then|first|next|finally|lastly) @")),
    (w.GOTO, re.compile(r"\b(?:follow|track|trac|zig-?zag|weav|thread|work|run|com|go)\w* [^.;,@]{0,40}\b(?:through|via|by way of) @")),
    (w.GOTO, re.compile(r"\b(?:as far as|up to|until you reach|until you are at) @")),
    (
        w.GOTO,
        re.compile(
            r"\b(?:pass|run|follow|track|trace|sail|go) (?:along |down |past )?(?:the |its )[^.;,@]{0,50}\bfor (?:\d+|[a-z]+(?:-[a-z]+)?) ?(?:m|"
            r"met\w+|km|yards?)\b"
        ),
    ),
    (w.ARC, re.compile(r"(?<!the )\borbit(?:s|ing)?\b")),
    (w.HOLD, re.compile(r"\bthen (?:just |simply )?(?:hold|wait|stop|stay)(?=[,;.]|$| and)")),
    (
        w.DRIFT,
        re.compile(
            r"(?<!the )(?<!that )(?<!this )(?<!each )\b(?:drift|float) (?=(?:for )?(?:\d|an? |half|one|two|three|four|five|six|ten|twelve|fifteen|"
            r"twenty|thirty))"
        ),
    ),
    (w.GOTO, re.compile(r"\b(?:wpt|wp|waypoint|point|leg|mark|pt)[ #]?[1-9a-f]\b\)?[:=,]? @")),
    (
        w.GOTO,
        re.compile(
            r"\b(?:(?:stop|halt|finish|end|be|arrive|call) (?:at|in|by) |(?:out |off |over |down |up |back |on |home )?(?:towards?|"
            r"to) (?:the [\w' -]{1,25}[,:]? )?)@"
        ),
    ),
)


_NO_WORDS = re.compile(
    r"\b(?:once|when|as soon as|after) (?:she|it|the boat|you|we) (?:is|has|are|lies|have) (?:\w+ ){0,2}(?:steady|stable|settled|still|calm|quiet|at rest)\b|"
    r"\b(?:relative|pose) to (?:home|base)\b|\bcent(?:red|ered) (?:on|at|about|round|around)\b|\b(?:closer|nearer) (?:to|than)\b|\b(?:to|of|in|"
    r"from|the|a|video|image) frame\b|\b(?:the|(?<!after )that|"
    r"this|each|every|both|its) (?:turn|pan|nudge|drift|hold|swing|orbit)s?\b"
)


def row_of(text: Plain, taken: Sequence[tuple[int, int]]) -> Row:
    """The movements that a text tells; nothing in the parts `taken`."""
    found: list[Unit] = []

    def free(start: int, end: int) -> bool:
        return all(end <= begin or stop <= start for begin, stop in taken) and all(end <= unit.start or unit.end <= start for unit in found)

    taken = [*taken, *(match.span() for match in _NO_WORDS.finditer(text.text))]
    hidden = text.text
    for begin, stop in taken:
        hidden = hidden[:begin] + "·" * (stop - begin) + hidden[stop:]
    ways = list(_ON_THE_WAY.finditer(text.text))
    for match in ways:
        found.append(Unit(w.GOTO, match.start(), match.end(), place=text.places.get(match.end() - 1)))
    for match in _GETTING_THERE.finditer(text.text):
        if free(match.start(), match.start() + 1):
            found.append(Unit(w.GOTO, match.start(), match.start() + 1, place=text.places.get(match.start())))
    for match in _ONWARDS.finditer(text.text):
        if free(*match.span("leg")) and len(_OWN_PLACE.findall(text.text)) == 1:
            found.append(Unit(w.GOTO, *match.span("leg")))
    for kind, pattern in (*_MORE, *w.MOVEMENTS):
        for match in pattern.finditer(hidden):
            begins = match.start() + (max((verb.end() for verb in _KEEPS.finditer(match[0])), default=0) if kind == w.VISUAL else 0)
            if free(begins, match.end()):
                found.append(Unit(kind, begins, match.end(), place=text.places.get(match.end() - 1)))
    for unit in [unit for unit in found if unit.kind == w.FACE]:
        end = unit.end
        while (more := _NEXT_TURN.match(text.text, end)) and free(more.start(), more.end()):
            found.append(Unit(w.FACE, more.start(), more.end(), chained=True))
            end = more.end()
    for match in _TO_PLACE.finditer(text.text):
        if free(match.start(), match.end()) and any(unit.kind == w.GOTO and _PLACES.fullmatch(text.text, unit.end, match.end()) for unit in found):
            found.append(Unit(w.GOTO, match.start(), match.end(), place=text.places.get(match.start()), chained=True))
    found = _merged(text.text, sorted((unit for unit in found if not _NO_MOVEMENT.search(text.text[: unit.start])), key=lambda unit: unit.start))
    kept: list[Unit] = []
    for number, unit in enumerate(found):
        behind = found[number + 1].start if number + 1 < len(found) else len(text.text)
        if kept and unit.place and any(unit.place == other.place for other in kept) and any(unit.start == match.start() for match in ways):
            continue
        steps = unit.steps if unit.steps != 1 else 1 if _single(text.text, unit, behind) else None
        if unit.kind == w.GOTO and re.search(r"\b(?:from|between) @,? (?:and )?$", text.text[: unit.start]):
            steps = None
        last = kept[-1] if kept else None
        bare = text.text[unit.start : unit.end].strip(" ,") == "@" and last is not None and last.kind == w.GOTO
        chained = unit.chained or (bare and last is not None and _PLACES.fullmatch(text.text, last.end, unit.end) is not None)
        kept.append(Unit(unit.kind, unit.start, unit.end, steps, unit.place, chained))
    return Row(tuple(kept))


_NO_MOVEMENT = re.compile(r"\b(?:nothing|no one|nobody|not|never|don't|none|no)(?: [a-z]+){0,3} $")
_NEXT = re.compile(r",|\band\b|\bthen\b|[.;:]")
_TIMED = re.compile(r"\d|\b(?:an?|one|two|three|four|five|six|seven|eight|nine|ten|twelve|fifteen|twenty|thirty|forty|half|hour|minutes?|seconds?)\b")
_BEGINS = re.compile(r"\b(?:start|begin)\w*\b[^.;]*$|\bfrom (?:the start )?@$")


_KEEPS = re.compile(r"(?:, |\band |\bthen )(?=(?:keep|hold|stay|cent(?:re|er)|frame|fix|follow)\b)")
"""What stands before the words that keep a target in the picture, where an earlier verb was taken for theirs."""
_WAITS = re.compile(r"(?:wait|stay|stop|hold)\w* (?:there|here)\b[^.;]*(?:until|till)?\b")


def _merged(text: str, units: Sequence[Unit]) -> list[Unit]:
    """Units without those that go on about the one before: "cut the engines and float", "stop and hold for a minute", "start at @ and follow the cable"."""
    kept: list[Unit] = []
    for number, unit in enumerate(units):
        last = kept[-1] if kept else None
        if last is not None and (last.kind, unit.kind) == (w.HOLD, w.WAIT) and _WAITS.match(text[last.start : unit.start + 5]):
            kept[-1] = Unit(unit.kind, last.start, unit.end)
            continue
        if last is not None and last.kind == unit.kind:
            between = text[last.end : unit.start]
            ends = units[number + 1].start if number + 1 < len(units) else len(text)
            one = not _NEXT.search(between) and "@" not in text[unit.start : unit.end]
            if unit.kind in (w.HOLD, w.DRIFT, w.WAIT, w.VISUAL) and not re.search(r"\b(?:then|again|more|another|second)\b", text[last.start : unit.end]):
                untimed = not (_TIMED.search(text[last.start : unit.start]) and _TIMED.search(text[unit.start : ends].split(".")[0]))
                one = one or untimed
            one = one and not unit.chained
            if unit.kind == w.GOTO and not unit.place and "." not in between and _BEGINS.search(re.split(r"[.;]", text[: last.end])[-1]):
                one = True
            if one:
                run = unit.kind == w.GOTO and last.place is not None
                steps = (
                    1
                    if not run
                    else 2
                    if re.search(r"\d ?(?:m|met\w+|km|yards?)$", text[: unit.end]) and not _GRID.search(text[unit.start : unit.end])
                    else None
                )
                kept[-1] = Unit(last.kind, last.start, unit.end, steps, None if run else last.place)
                continue
        kept.append(unit)
    return kept


def _single(text: str, unit: Unit, behind: int) -> bool:
    """Whether a movement is one step."""
    said = re.sub(r"^[\s,]*(?:(?:and|then|to|on) )*", "", text[unit.start : unit.end])
    rest = re.split(r"[.;]", text[unit.end : behind], maxsplit=1)[0]
    if unit.kind == w.GOTO and _THROUGH.search(said):
        return True
    if unit.kind == w.GOTO:
        return _ONE_PLACE.search(said) is not None and not _GRID.search(said)
    if unit.kind == w.ARC:
        return not _SEVERAL_ARCS.search(said + rest)
    if unit.kind in (w.FACE, w.NUDGE):
        return not _SEVERAL_TURNS.search(said + rest)
    return True


def unread_places(text: Plain, row: Row, bounds: Sequence[tuple[int, int]] = ()) -> bool:
    """Whether a text names places that no movement of its row goes to, and that are no centres nor stand in some `bounds`."""
    seen: set[tuple[float, float]] = set()
    for unit in row.units:
        if unit.place in seen and re.search(r"\b(?:from|between) @,? (?:and )?$", text.text[: unit.start]):
            return True
        seen |= {unit.place} if unit.place else set()
    return any(
        not any(unit.start <= match.start() < unit.end for unit in row.units)
        and not any(start <= match.start() < end for start, end in bounds)
        and not _CENTRE.search(text.text[: match.start()])
        for match in re.finditer("@", text.text)
    )


_CENTRE = re.compile(
    r"\b(?:round|around|about|cent\w+(?: on| at| in| is| point)?|of|at|from|on|for|between|with|near|as)(?: the| a| its| their)?(?: [\w-]+){0,3}[,:]? $"
    r"(?<!\bend at )(?<!\bit at )(?<!\bfinish at )(?<!up at )"
)
