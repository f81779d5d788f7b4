"""The movements that a text tells one after the other, found by their words, and whether all places
of the text are among theirs.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row, Unit

_TO_PLACE = re.compile(r"@|\bthe (?:target|goal|start\w*) (?:position|point)\b")
_PLACES = re.compile(
    rf",? ?(?:and |then |and then |to |finally |lastly |via |, ){{0,3}}(?:{_TO_PLACE.pattern})"
)
"""A place behind another one, to go to next."""
_SEVERAL_TURNS = re.compile(
    r"\b(?:times|twice|each|every|steps of|in (?:\w+"
    r" ){0,3}(?:steps|stages|parts)|sectors|evenly|points|repeat\w*|headings|bearings|in turn|"
    r"one after the other|all round)\b|"
    r"(?:,|,? and|,? then|,? and then) (?:to )?(?:\d{1,3}|(?:north|south|east|west)[\w-]*)\b(?!"
    r" ?(?:m|s|min\w*|sec\w*|met\w*|feet)\b)"
)
_NEXT_TURN = re.compile(
    r"(?<=[\dth°])(?:°| degrees)?(?:,? and then|,? then|,? and|,)(?: to| on to| onto)? (?:due )?"
    r"(?:\d{1,3}\b(?!"
    r" ?(?:m|s|min\w*|sec\w*|met\w*|feet|hours?|percent|times|x)\b)(?!\.\d)|(?:north|south|east|west)(?:["
    r" -]?(?:north|south|east|"
    r"west))*\b(?! (?:of|side|end|corner)))"
)
"""A turn behind another one, told by its heading alone."""
_SEVERAL_ARCS = re.compile(r"\b(?:times|twice|each|every|repeat\w*|arcs|turns|bends|alternat\w*)\b")
_ONE_PLACE = re.compile(
    r"@$|\b(?:home|base|target|goal|berth|dock|centre|center|point|position|start\w*)$"
)
_GRID = re.compile(
    r"\b(?:grid|lawn-?mow\w*|square|lanes|lines|transects?|cable|pipeline|track|sides|area|circle)\b"
)
_ON_THE_WAY = re.compile(
    r"\b(?:(?:coming|running|going|heading|driving|steaming|sailing|moving|getting|motoring|closing)"
    r" (?:in|out|over|up|down|back|there|on)?,? ?to @|"
    r"(?:way|leg|run|approach|transit|passage|trip|crossing|stretch|drive|course)(?:"
    r" (?:in|out|over|across|up|down|back|on))?,? (?:to|towards) @|"
    r"approaching @|between (?:@|there|here) and @)"
)
"""Words for the way to a place, that do not ask for a movement beside another one to it."""
_THROUGH = re.compile(r"\b(?:through|via|by way of) @$")
_ONWARDS = re.compile(
    r"\b(?:from (?:there|here)(?: on(?:wards?)?)?,?|(?:on|during|for) the (?:final |last"
    r" )?(?:run|leg|approach|stretch)(?: in)?) "
    r"(?P<leg>to the (?:target|goal) (?:position|point))\b"
)
_OWN_PLACE = re.compile(r"\b(?:target|goal) (?:position|point)\b")
"""A leg to the task's own place, told by where it begins."""
_GETTING_THERE = re.compile(
    r"@,? (?:so |and |with |but )?[^.;@]{0,40}\b(?:getting|going|coming|heading|driving|on the way)"
    r" (?:there|in)\b"
)
_MORE = (
    (
        m.ARC,
        re.compile(
            r"(?<!the )(?<!that )(?<!this )\b(?:an? |one |make |do |take |sail |another )*(?:wide"
            r" |sweeping |arc )+(?:turn|arc|curve)\b[^.;,]{0,40}"
        ),
    ),
    (m.GOTO, re.compile(r"\b(?:just|then|first|next|finally|lastly) @")),
    (
        m.GOTO,
        re.compile(
            r"\b(?:follow|track|trac|zig-?zag|weav|thread|work|run|com|go)\w*"
            r" [^.;,@]{0,40}\b(?:through|via|by way of) @"
        ),
    ),
    (m.GOTO, re.compile(r"\b(?:as far as|up to|until you reach|until you are at) @")),
    (
        m.GOTO,
        re.compile(
            r"\b(?:pass|run|follow|track|trace|sail|go) (?:along |down |past )?(?:the |its"
            r" )[^.;,@]{0,50}\bfor (?:\d+|[a-z]+(?:-[a-z]+)?) ?(?:m|"
            r"met\w+|km|yards?)\b"
        ),
    ),
    (m.ARC, re.compile(r"(?<!the )\borbit(?:s|ing)?\b")),
    (m.HOLD, re.compile(r"\bthen (?:just |simply )?(?:hold|wait|stop|stay)(?=[,;.]|$| and)")),
    (
        m.DRIFT,
        re.compile(
            r"(?<!the )(?<!that )(?<!this )(?<!each )\b(?:drift|float) (?=(?:for )?(?:\d|an?"
            r" |half|one|two|three|four|five|six|ten|twelve|fifteen|"
            r"twenty|thirty))"
        ),
    ),
    (m.GOTO, re.compile(r"\b(?:wpt|wp|waypoint|point|leg|mark|pt)[ #]?[1-9a-f]\b\)?[:=,]? @")),
    (
        m.GOTO,
        re.compile(
            r"\b(?:(?:stop|halt|finish|end|be|arrive|call) (?:at|in|by) |(?:out |off |over |down"
            r" |up |back |on |home )?(?:towards?|"
            r"to) (?:the [\w' -]{1,25}[,:]? )?)@"
        ),
    ),
)
_NO_WORDS = re.compile(
    r"\b(?:once|when|as soon as|after) (?:she|it|the boat|you|we) (?:is|has|are|lies|have) (?:\w+"
    r" ){0,2}(?:steady|stable|settled|still|calm|quiet|at rest)\b|"
    r"\b(?:relative|pose) to (?:home|base)\b|\bcent(?:red|ered)"
    r" (?:on|at|about|round|around)\b|\b(?:closer|nearer) (?:to|than)\b|\b(?:to|of|in|"
    r"from|the|a|video|image) frame\b|\b(?:the|(?<!after )that|"
    r"this|each|every|both|its) (?:turn|pan|nudge|drift|hold|swing|orbit)s?\b"
)
_NO_MOVEMENT = re.compile(r"\b(?:nothing|no one|nobody|not|never|don't|none|no)(?: [a-z]+){0,3} $")
_NEXT = re.compile(r",|\band\b|\bthen\b|[.;:]")
_TIMED = re.compile(
    r"\d|\b(?:an?|one|two|three|four|five|six|seven|eight|nine|ten|twelve|fifteen|twenty|thirty|forty|half|hour|minutes?|seconds?)\b"
)
_BEGINS = re.compile(r"\b(?:start|begin)\w*\b[^.;]*$|\bfrom (?:the start )?@$")
_KEEPS = re.compile(r"(?:, |\band |\bthen )(?=(?:keep|hold|stay|cent(?:re|er)|frame|fix|follow)\b)")
"""What stands before the words that keep a target in the picture, where an earlier verb was taken
for theirs.
"""
_WAITS = re.compile(r"(?:wait|stay|stop|hold)\w* (?:there|here)\b[^.;]*(?:until|till)?\b")
_CENTRE = re.compile(
    r"\b(?:round|around|about|cent\w+(?: on| at| in| is|"
    r" point)?|of|at|from|on|for|between|with|near|as)(?: the| a| its| their)?(?:"
    r" [\w-]+){0,3}[,:]? $"
    r"(?<!\bend at )(?<!\bit at )(?<!\bfinish at )(?<!up at )"
)


def row_of(text: Plain, taken: Sequence[tuple[int, int]]) -> Row:
    """The movements that a text tells; nothing in the parts `taken`."""
    search = _Search(text, [*taken, *(match.span() for match in _NO_WORDS.finditer(text.text))])
    for rule in _RULES:
        for unit in rule(search):
            search.found.append(unit)
    told = (unit for unit in search.found if not _NO_MOVEMENT.search(text.text[: unit.start]))
    return Row(
        tuple(_settled(text.text, _merged(text.text, sorted(told, key=lambda unit: unit.start))))
    )


@dataclass
class _Search:
    """A text, the parts of it that are taken, and the movements that were found so far."""

    text: Plain
    taken: list[tuple[int, int]]
    found: list[Unit] = field(default_factory=list)

    def free(self, start: int, end: int) -> bool:
        """Whether a part of the text is neither taken nor a movement."""
        apart = all(end <= begin or stop <= start for begin, stop in self.taken)
        return apart and all(end <= unit.start or unit.end <= start for unit in self.found)

    def unit(
        self, kind: str, start: int, end: int, place_at: int | None = None, *, chained: bool = False
    ) -> Unit:
        """A movement, to the place whose sign stands at `place_at`."""
        return Unit(
            kind,
            start,
            end,
            place=self.text.places.get(place_at) if place_at is not None else None,
            chained=chained,
        )


def _on_the_way(search: _Search) -> Iterator[Unit]:
    for match in _ON_THE_WAY.finditer(search.text.text):
        yield search.unit(m.GOTO, match.start(), match.end(), match.end() - 1)


def _getting_there(search: _Search) -> Iterator[Unit]:
    for match in _GETTING_THERE.finditer(search.text.text):
        if search.free(match.start(), match.start() + 1):
            yield search.unit(m.GOTO, match.start(), match.start() + 1, match.start())


def _onwards(search: _Search) -> Iterator[Unit]:
    for match in _ONWARDS.finditer(search.text.text):
        if search.free(*match.span("leg")) and len(_OWN_PLACE.findall(search.text.text)) == 1:
            yield search.unit(m.GOTO, *match.span("leg"))


def _by_words(search: _Search) -> Iterator[Unit]:
    """Movements by the words for them, outside of what is taken."""
    hidden = search.text.text
    for begin, stop in search.taken:
        hidden = hidden[:begin] + "·" * (stop - begin) + hidden[stop:]
    for kind, pattern in (*_MORE, *m.MOVEMENTS):
        for match in pattern.finditer(hidden):
            begins = match.start() + (
                max((verb.end() for verb in _KEEPS.finditer(match[0])), default=0)
                if kind == m.VISUAL
                else 0
            )
            if search.free(begins, match.end()):
                yield search.unit(kind, begins, match.end(), match.end() - 1)


def _next_turns(search: _Search) -> Iterator[Unit]:
    """Turns behind another one: "turn to 040, to 080 and to 120"."""
    for unit in [unit for unit in search.found if unit.kind == m.FACE]:
        end = unit.end
        while (more := _NEXT_TURN.match(search.text.text, end)) and search.free(
            more.start(), more.end()
        ):
            yield search.unit(m.FACE, more.start(), more.end(), chained=True)
            end = more.end()


def _next_places(search: _Search) -> Iterator[Unit]:
    """Places behind another one: "go to @, @ and @"."""
    text = search.text.text
    for match in _TO_PLACE.finditer(text):
        behind = any(
            unit.kind == m.GOTO and _PLACES.fullmatch(text, unit.end, match.end())
            for unit in search.found
        )
        if behind and search.free(match.start(), match.end()):
            yield search.unit(m.GOTO, match.start(), match.end(), match.start(), chained=True)


_RULES: tuple[Callable[[_Search], Iterator[Unit]], ...] = (
    _on_the_way,
    _getting_there,
    _onwards,
    _by_words,
    _next_turns,
    _next_places,
)
"""In their order: what one finds is not free for those behind it."""


def _settled(text: str, units: Sequence[Unit]) -> list[Unit]:
    """Units with what is known of their steps, without ways to a place that another one goes to."""
    kept: list[Unit] = []
    ways = {match.start() for match in _ON_THE_WAY.finditer(text)}
    for unit, behind in zip(units, [*(unit.start for unit in units[1:]), len(text)], strict=False):
        if unit.place and unit.start in ways and any(unit.place == other.place for other in kept):
            continue
        kept.append(
            Unit(
                unit.kind,
                unit.start,
                unit.end,
                _steps(text, unit, behind),
                unit.place,
                unit.chained or _is_next(text, unit, kept[-1:]),
            )
        )
    return kept


def _steps(text: str, unit: Unit, behind: int) -> int | None:
    """Of how many steps a movement is, with the words up to the one `behind` it; None: not
    known.
    """
    if unit.kind == m.GOTO and re.search(r"\b(?:from|between) @,? (?:and )?$", text[: unit.start]):
        return None
    return unit.steps if unit.steps != 1 else 1 if _single(text, unit, behind) else None


def _is_next(text: str, unit: Unit, before: Sequence[Unit]) -> bool:
    """Whether a movement is a bare place in a list with the one before it."""
    goes = text[unit.start : unit.end].strip(" ,") == "@" and before and before[-1].kind == m.GOTO
    return bool(goes) and _PLACES.fullmatch(text, before[-1].end, unit.end) is not None


def _merged(text: str, units: Sequence[Unit]) -> list[Unit]:
    """Units without those that go on about the one before: "cut the engines and float", "stop and
    hold for a minute", "start at @ and follow the cable".
    """
    kept: list[Unit] = []
    for number, unit in enumerate(units):
        last = kept[-1] if kept else None
        if (
            last is not None
            and (last.kind, unit.kind) == (m.HOLD, m.WAIT)
            and _WAITS.match(text[last.start : unit.start + 5])
        ):
            kept[-1] = Unit(unit.kind, last.start, unit.end)
            continue
        if last is not None and last.kind == unit.kind:
            between = text[last.end : unit.start]
            ends = units[number + 1].start if number + 1 < len(units) else len(text)
            one = not _NEXT.search(between) and "@" not in text[unit.start : unit.end]
            if unit.kind in (m.HOLD, m.DRIFT, m.WAIT, m.VISUAL) and not re.search(
                r"\b(?:then|again|more|another|second)\b", text[last.start : unit.end]
            ):
                untimed = not (
                    _TIMED.search(text[last.start : unit.start])
                    and _TIMED.search(text[unit.start : ends].split(".")[0])
                )
                one = one or untimed
            one = one and not unit.chained
            if (
                unit.kind == m.GOTO
                and not unit.place
                and "." not in between
                and _BEGINS.search(re.split(r"[.;]", text[: last.end])[-1])
            ):
                one = True
            if one:
                run = unit.kind == m.GOTO and last.place is not None
                steps = (
                    1
                    if not run
                    else (
                        2
                        if re.search(r"\d ?(?:m|met\w+|km|yards?)$", text[: unit.end])
                        and not _GRID.search(text[unit.start : unit.end])
                        else None
                    )
                )
                kept[-1] = Unit(last.kind, last.start, unit.end, steps, None if run else last.place)
                continue
        kept.append(unit)
    return kept


def _single(text: str, unit: Unit, behind: int) -> bool:
    """Whether a movement is one step."""
    said = re.sub(r"^[\s,]*(?:(?:and|then|to|on) )*", "", text[unit.start : unit.end])
    rest = re.split(r"[.;]", text[unit.end : behind], maxsplit=1)[0]
    if unit.kind == m.GOTO and _THROUGH.search(said):
        return True
    if unit.kind == m.GOTO:
        return _ONE_PLACE.search(said) is not None and not _GRID.search(said)
    if unit.kind == m.ARC:
        return not _SEVERAL_ARCS.search(said + rest)
    if unit.kind in (m.FACE, m.NUDGE):
        return not _SEVERAL_TURNS.search(said + rest)
    return True


def unread_places(text: Plain, row: Row, bounds: Sequence[tuple[int, int]] = ()) -> bool:
    """Whether a text names places that no movement of its row goes to, and that are no centres nor
    stand in some `bounds`.
    """
    seen: set[tuple[float, float]] = set()
    for unit in row.units:
        if unit.place in seen and re.search(
            r"\b(?:from|between) @,? (?:and )?$", text.text[: unit.start]
        ):
            return True
        seen |= {unit.place} if unit.place else set()
    return any(
        not any(unit.start <= match.start() < unit.end for unit in row.units)
        and not any(start <= match.start() < end for start, end in bounds)
        and not _CENTRE.search(text.text[: match.start()])
        for match in re.finditer("@", text.text)
    )
