"""What the scopes of a text mean: the movements of its row, kinds of movement, or every other waypoint of a survey square."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s


@dataclass(frozen=True)
class Where:
    """Some steps: those of movements of the text, of kinds of movement, or every other waypoint."""

    units: frozenset[int] | None = None
    kinds: frozenset[str] | None = None
    parity: int | None = None
    beginning: bool | None = None
    """Whether they are the first waypoint, or all others."""

    def holds(self, names: Sequence[str], row: Row | None) -> bool | None:
        """Whether the last of some steps is one of these."""
        if self.parity is not None:
            return names[-1] == s.GOTO and (names.count(s.GOTO) - 1) % 2 == self.parity
        if self.beginning is not None:
            return names[-1] == s.GOTO and (names.count(s.GOTO) == 1) == self.beginning
        unit = row.unit(names) if row is not None else None
        if unit is not None and self.units is not None:
            return unit in self.units
        return names[-1] in self.kinds if self.kinds is not None else None


EVERYWHERE = Where(kinds=s.ANY)


@dataclass(frozen=True)
class Anchor:
    """A scope or a movement of the text, with the steps that it means (None: not read)."""

    start: int
    end: int
    is_scope: bool
    where: Where | None
    denied: bool = False
    kind: str = ""


_DENIED_SCOPE = re.compile(
    r"\b(?:not|never|nor|none|neither|nothing|nowhere|no|without|no one|nobody|needs nothing)(?: (?!(?:and|but|with)\b)[\w-]+){0,2},? ?(?:(?:and|"
    r"but) )?$|\bno other(?: \w+)?$"
)


_MOVES = re.compile(
    r"\b(?:on|back|out|over) $|\b(?:go|goes|come|comes|move|pass|head|sail|proceed|drive|steam|motor|follow|track|continue|carry|return|"
    r"run (?:along|on|up|out|back|past|down|straight|in|it))\b[^.;,@]*$"
)
"""Words for a movement that a place behind them is the end of."""


def scopes_of(text: str) -> Iterator[tuple[str, re.Match[str]]]:
    """The scopes of a text, none over another."""
    taken: list[tuple[int, int]] = []
    found = []
    for kind, pattern in s.SCOPES:
        for match in pattern.finditer(text):
            if kind == "upto" and re.match("up|as", match[0]) and _MOVES.search(text[: match.start()]):
                continue
            if all(match.end() <= start or end <= match.start() for start, end in taken):
                taken.append(match.span())
                found.append((kind, match))
    yield from sorted(found, key=lambda one: one[1].start())


def anchors_of(said: Plain, found: Sequence[tuple[str, re.Match[str]]], row: Row, counted: bool) -> list[Anchor]:
    """The movements and scopes of a text in their order, each with what it means."""
    anchors = [Anchor(unit.start, unit.end, False, Where(_chain(row, index)) if counted else None) for index, unit in enumerate(row.units)]
    for kind, match in found:
        if any(anchor.start < match.end() and match.start() < anchor.end for anchor in anchors):
            continue
        before = sorted((anchor for anchor in anchors if anchor.end <= match.start() and not anchor.denied), key=lambda anchor: anchor.start)
        clause = re.split(r"[.;:!?]", said.text[: match.start()])[-1]
        where = _resolved(kind, match, row, before, said) if counted or kind in _BY_KIND else None
        if kind == "everywhere" and where is None and counted and {unit.kind for unit in row.units} == {s.GOTO}:
            where = EVERYWHERE
        where = _bounded(where, said.text[: match.start()], said.text[match.end() :], len(row.units))
        if where is not None and where.units and where.kinds is None:
            kinds = frozenset(row.units[index].kind for index in where.units)
            whole = row.of(kinds) == tuple(sorted(where.units)) and kinds <= {s.HOLD, s.DRIFT, s.ARC, s.VISUAL, s.WAIT}
            where = Where(where.units, kinds) if whole else where
        if where is not None and not counted:
            where = Where(kinds=where.kinds, parity=where.parity) if where.kinds is not None or where.parity is not None else None
        anchors.append(Anchor(match.start(), match.end(), True, where, _DENIED_SCOPE.search(clause) is not None, kind))
    return sorted(anchors, key=lambda anchor: anchor.start)


def _bounded(where: Where | None, before: str, behind: str, count: int) -> Where | None:
    """What a word before a scope makes of it: "once the first hold is over", "up to the end of the second leg"."""
    bound = _BOUND.search(before)
    if bound is None or where is None:
        return where
    if where.units is None or bound["words"]:
        return None
    over = _OVER.match(behind) is not None
    if bound["after"] and (over or bound["after"] in ("after", "from the end of")):
        units = range(max(where.units) + 1, count)
    elif bound["until"] and (over or "end" in bound["until"] or "includ" in bound["until"]):
        units = range(max(where.units) + 1)
    elif bound["before"] or bound["until"] == "until":
        units = range(min(where.units))
    else:
        return None
    return Where(frozenset(units)) if units else None


_BOUND = re.compile(
    r"\b(?:(?P<after>once|after|as soon as|when|from the end of)|(?P<until>until|till|up to(?: and including| the end of)?|until the end of|"
    r"to the end of|through to)|(?P<before>before)|"
    r"(?P<other>(?:since|by|than|as|like|unlike|past|beyond|between|from|towards?)(?= $)))(?P<words>(?: (?!the\b|and\b|but\b)\w+){0,2}) ?$"
)
_OVER = re.compile(r" (?:is|has been|was) (?:over|done|finished|through|complete\w*|behind)\b")


def _chain(row: Row, index: int) -> frozenset[int]:
    """A movement with those that are named in one list with it."""
    first = index
    while row.units[first].chained and first:
        first -= 1
    last = index
    while last + 1 < len(row.units) and row.units[last + 1].chained:
        last += 1
    return frozenset(range(first, last + 1))


_BY_KIND = ("kind", "all", "while", "everywhere", "corner", "both", "that")


def _kinds(noun: str) -> frozenset[str]:
    return next(kinds for pattern, kinds in s.NOUNS if re.fullmatch(pattern, noun))


def _of(row: Row, kinds: frozenset[str]) -> list[int]:
    """The movements of some kinds; a hold may be one that keeps a target in the picture."""
    units = list(row.of(kinds))
    return list(row.of(frozenset({s.VISUAL}))) if not units and kinds == {s.HOLD} else units


def _all_of(row: Row, kinds: frozenset[str]) -> Where | None:
    units = _of(row, kinds)
    if kinds == {s.HOLD} and row.of(frozenset({s.HOLD})) and row.of(frozenset({s.VISUAL})):
        # One that keeps a target in the picture may be meant as well.
        return None
    meant = frozenset(row.units[index].kind for index in units) if kinds == {s.HOLD} else kinds
    return Where(frozenset(units), meant or kinds) if units else None


def _resolved(kind: str, match: re.Match[str], row: Row, before: Sequence[Anchor], said: Plain) -> Where | None:
    """The steps that a scope means."""
    groups = match.groupdict()
    last = before[-1].where if before else None
    passed = [index for index, unit in enumerate(row.units) if unit.end <= match.start()]
    count = len(row.units)
    if kind == "everywhere":
        alone = any(not anchor.is_scope and not re.search(r"[.;]", said.text[anchor.end : match.start()]) for anchor in before)
        return None if alone and re.search(r"way|always|continuously", match[0]) and count > 1 else EVERYWHERE
    if kind == "both":
        number = next((value for word, value in w.BARE_COUNTS.items() if word in match[0]), None)
        topic = last.units if last and last.units and len(last.units) > 1 else frozenset(range(count))
        return Where(topic, EVERYWHERE.kinds if len(topic) == count else None) if number in (len(topic), None) and (number or count > 1) else None
    if kind == "each":
        several = sorted(last.units) if last and last.units and len(last.units) > 1 else list(range(count))
        return Where(frozenset(several)) if len(several) > 1 and len({row.units[index].kind for index in several}) == 1 else None
    if kind == "ordered":
        begins = max(said.text.rfind(sign, 0, match.start()) for sign in ".;!?")
        told = frozenset(index for index in passed if row.units[index].start > begins)
        return Where(told) if len(told) > 1 else None
    if kind == "corner":
        return _corner(said.text, groups.get("corner") is not None)
    if kind in ("that", "then"):
        return _pointed(match, row, last, passed, kind)
    if kind == "all":
        kinds = _kinds(groups["noun"] or "")
        said_number = next((value for word, value in w.COUNTS.items() if word in match[0].split()), None)
        if kinds == s.ANY and said_number not in (None, count) and row.units:
            # "Both moves" where three things are done: those that go somewhere, if they are as many.
            goes = row.of(frozenset({s.GOTO}))
            return Where(frozenset(goes)) if (groups["noun"] or "").startswith("move") and len(goes) == said_number else None
        if kinds == s.ANY:
            return EVERYWHERE
        number = next((value for word, value in w.COUNTS.items() if word in match[0].split()), None)
        return _all_of(row, kinds) if number in (None, len(_of(row, kinds))) or not all(unit.single for unit in row.units) else None
    if kind == "while":
        name = next(name.rstrip("2") for name, value in groups.items() if value)
        name = "hold" if name == "wait" and not row.of(s.GERUNDS[name]) else name
        where = _all_of(row, s.GERUNDS[name])
        if name == "goto" and where and (len({row.units[index].single for index in where.units or ()}) > 1 or row.of(frozenset({s.ARC}))):
            return None
        if name == "goto" and where and not row.units[min(where.units or (0,))].single and len(where.units or ()) < count:
            return None
        if where and where.units is not None and name == "hold":
            return Where(where.units, s.GERUNDS[name])
        return where
    if (
        kind in ("kind", "that")
        and len(row.of(frozenset({s.GOTO}))) < 2
        and _TO_ITS_START.search(said.text)
        and re.search(r"\b(?:run|pass|line|track|leg)s?\b", match[0])
    ):
        return Where(beginning=False)
    if kind == "kind":
        return _one_kind(match, groups["noun"] or "", row, last)
    if kind == "beyond":
        places = [index for index in row.of(frozenset({s.GOTO})) if row.units[index].single]
        if "@" in match[0]:
            at = [index for index in places if row.units[index].place == said.places.get(match.start() + match[0].find("@"))]
        else:
            at = _numbered(row, "points", groups.get("ords")) if groups.get("ords") else []
        return Where(frozenset(range(at[0] + 1, count))) if len(at) == 1 and at[0] + 1 < count else None
    if kind == "onwards":
        first = max(last.units) if last and last.units else None
        if first is not None and first + 1 < count and "there" in match[0] and row.units[first].kind == s.GOTO and row.units[first].place:
            # What begins at a place is not on the way to it.
            first += 1
        return Where(frozenset(range(first, count))) if first is not None else None
    if kind == "since":
        first_one = _numbered(row, groups.get("noun") or groups.get("noun2") or "", groups.get("ords"))
        return Where(frozenset(range(first_one[0], count))) if len(first_one) == 1 else None
    if kind == "rest":
        ahead = frozenset(range(max(passed) + 1, count)) if passed else frozenset()
        if not ahead and before and before[-1].kind == "beyond":
            return last
        return Where(ahead) if ahead else None
    if kind == "numbered":
        return _cards(match, row)
    if kind == "ordinal":
        again = _again(match, row, before[-1], said.text) if before else None
        return again or _ordinal(match, row, None if groups["noun"] is None and before and before[-1].kind == "several" else last, passed)
    if kind == "several":
        places, many = _of(row, _kinds(groups["noun"] or "")), w.COUNTS[groups["count"] or ""]
        fits = len(places) > many and all(row.units[index].single for index in places)
        return Where(frozenset(places[:many] if groups["side"] == "first" else places[-many:])) if fits else None
    if kind == "outer":
        places = _of(row, _kinds(groups["noun"] or ""))
        return Where(frozenset({places[0 if groups["side"] == "outer" else 1]})) if len(places) == 2 else None
    if kind in ("but", "except"):
        return _but(kind, match, row)
    goes = row.of(frozenset({s.GOTO}))
    if kind == "back":
        return Where(frozenset({goes[-1]})) if len(goes) > 1 else None
    if kind == "out":
        return Where(frozenset({goes[0]})) if goes else None
    if kind == "thither":
        near = [index for index in goes if row.units[index].end <= match.end()]
        return Where(frozenset({goes[0] if len(goes) == 1 else near[-1]})) if len(goes) == 1 or (near and near[-1] == max(passed)) else None
    if kind == "upto":
        at = [index for index in goes if row.units[index].place == said.places.get(match.start() + match[0].find("@"))]
        return Where(frozenset(range(at[0] + 1))) if len(at) == 1 else None
    if kind == "place":
        place = said.places.get(match.start() + match[0].find("@")) if "@" in match[0] else None
        fitting = [index for index, unit in enumerate(row.units) if unit.kind == s.GOTO and unit.place == place] if place else list(goes[-1:])
        return Where(frozenset(fitting)) if len(fitting) == 1 else None
    return None


_TO_ITS_START = re.compile(
    r"\b(?:not|nor|never|none|nothing|no \w+) (?:on|during|for|in) the (?:way|leg|run|approach|transit|trip) (?:out )?to (?:its|the|where (?:it|"
    r"the \w+)) (?:start|begin)\w*\b"
)


def _pointed(match: re.Match[str], row: Row, last: Where | None, passed: Sequence[int], kind: str) -> Where | None:
    """ "In this hold", "in it", "meanwhile", "there": what was spoken of last."""
    noun = match.groupdict().get("noun") or match.groupdict().get("noun2")
    if kind == "then" and passed and row.units[passed[-1]].kind == s.GOTO and passed[-1] + 1 < len(row.units):
        return None
    before = match.string[: match.start()].rstrip()
    if noun is None and before.endswith((".", "!", "?")) and re.match("meanwhile|in the meantime", match[0]):
        # A sentence of its own goes on about all of the one before.
        told = frozenset(index for index in passed if row.units[index].start > max(before[:-1].rfind(sign) for sign in ".!?"))
        return Where(told, s.ANY if len(told) == len(row.units) else None) if told else None
    if noun is None:
        return last
    kinds = _kinds(noun)
    if kinds != s.ANY and noun.endswith("s") and row.of(kinds) and not noun.startswith(("pass", "cross")):
        units = [index for index in (last.units or ()) if row.units[index].kind in kinds] if last else []
        return Where(frozenset(units)) if len(units) > 1 else _all_of(row, kinds)
    if kinds == s.ANY or last is None or last.units is None:
        return last if not noun.endswith("s") or noun.startswith("pass") else None
    fitting = [index for index in last.units if row.units[index].kind in kinds or (kinds == {s.HOLD} and row.units[index].kind == s.VISUAL)]
    if noun.endswith("s") and len(last.units) == 1:
        return _all_of(row, kinds)
    if not fitting and passed:
        earlier = [index for index in passed if row.units[index].kind in kinds]
        fitting = earlier[-1:] if len(earlier) == 1 else []
    return Where(frozenset(fitting)) if fitting else None


def _one_kind(match: re.Match[str], noun: str, row: Row, last: Where | None) -> Where | None:
    """ "In the hold": the only one, or all holds where several are meant."""
    kinds = _kinds(noun)
    units = _of(row, kinds)
    if not units and noun.endswith("s") and kinds in ({s.DRIFT}, {s.ARC}):
        return Where(kinds=kinds)
    if not units or kinds == s.ANY or (re.match("lane|transect", noun) and len({row.units[index].single for index in units}) > 1):
        return None
    if len(units) == 1 or noun.endswith("s"):
        if len(units) == 1 and noun.endswith("s") and row.units[units[0]].single:
            return None
        return _all_of(row, kinds) if kinds != {s.GOTO} or len(units) == 1 else Where(frozenset(units), kinds)
    near = [index for index in units if last and last.units and index in last.units]
    return Where(frozenset(near)) if len(near) == 1 else None


def _numbered(row: Row, noun: str, ords: str | None, among: Sequence[int] | None = None) -> list[int]:
    """The movements that ordinals name among those of a noun."""
    places = list(among) if among is not None else _of(row, _kinds(noun))
    if ords is None:
        return places if len(places) == 1 else []
    if "middle" in ords and (len(places) % 2 == 0 or len(places) < 3):
        return []
    numbers = [len(places) // 2 if word == "middle" else w.ORDINAL[word] for word in re.findall(rf"\b(?:{w.ORD}|middle)\b", ords)]
    if any(not row.units[index].single for index in places) or any(not -len(places) <= number < len(places) for number in numbers):
        return []
    return [places[number] for number in numbers]


def _again(match: re.Match[str], row: Row, last: Anchor, text: str) -> Where | None:
    """ "In the first hold ...; in the second ...": the noun that was said before."""
    noun = re.search(rf" ({s.NOUN})(?: only| alone)?$", text[last.start : last.end])
    if match["noun"] is not None or last.kind != "ordinal" or noun is None or not noun[1].isalpha() or noun[1].startswith("one"):
        return None
    places = _numbered(row, noun[1], match["ords"])
    return Where(frozenset(places)) if places else None


def _ordinal(match: re.Match[str], row: Row, last: Where | None, passed: Sequence[int]) -> Where | None:
    noun, ords = match["noun"], match["ords"]
    if noun is not None and not noun.startswith(("one", "of ")) and _kinds(noun) == s.ANY and any(unit.chained and unit.kind == s.FACE for unit in row.units):
        # "The first part" may be all turns of a list.
        return None
    if noun is None or noun.startswith(("one", "of ")):
        # The second of what was spoken of: several at once, else all movements if they are of one kind.
        among = sorted(last.units) if last and last.units and len(last.units) > 1 else list(range(len(row.units)))
        number = next((value for word, value in w.COUNTS.items() if noun and word in noun.split()), None)
        if number == len(row.units):
            among = list(range(number))
        elif len({row.units[index].kind for index in among}) > 1 and not {row.units[index].kind for index in among} <= s.TURNS:
            return None
        if noun is None and len(among) < 2:
            return None
        places = _numbered(row, "", ords, among)
    else:
        places = _numbered(row, noun, ords)
        if len(_of(row, _kinds(noun))) < 2:
            places = []
    return Where(frozenset(places)) if places else None


def _cards(match: re.Match[str], row: Row) -> Where | None:
    places = _of(row, _kinds(re.sub(r"^(?:w(?:pt|p)s?|marks?|waypoints?|points?)$", "points", match["noun"])))
    numbers = [w.CARDINAL[word] for word in re.findall(r"\w+", match["cards"]) if word in w.CARDINAL]
    if any(number >= len(places) for number in numbers) or any(not row.units[index].single for index in places):
        return None
    return Where(frozenset(places[number] for number in numbers)) if numbers else None


def _but(kind: str, match: re.Match[str], row: Row) -> Where | None:
    """All but some movements."""
    groups = match.groupdict()
    if kind == "but":
        noun = groups["all"] or groups["noun"] or "step"
        among = _of(row, _kinds(noun))
        if groups["cards"]:
            numbers = [w.CARDINAL[word] for word in re.findall(r"\w+", groups["cards"]) if word in w.CARDINAL]
            barred = [among[number] for number in numbers if number < len(among)]
        else:
            barred = _numbered(row, noun, groups["ords"])
    else:
        among = list(range(len(row.units)))
        gerund = next((name for name in s.GERUNDS if groups.get(name)), None)
        kinds = s.GERUNDS[gerund] if gerund else _kinds(groups["noun"] or "")
        barred = _of(row, kinds)
        if groups.get("ords"):
            barred = _numbered(row, groups["noun"] or "", groups["ords"])
        elif not gerund and len(barred) > 1 and not (groups["noun"] or "").endswith("s"):
            barred = []
    left = frozenset(among) - frozenset(barred)
    return Where(left) if barred and left else None


_FROM_CORNER = re.compile(r"\b(?:start|begin|from|first|enter)\w*\b[^.;]{0,30}\bcorner\b")
_FROM_MIDDLE = re.compile(r"\b(?:start|begin|from|first)\w*\b[^.;]{0,30}\b(?:middle|mid|centre of the|due (?:north|south|east|west))")


def _corner(text: str, corner: bool) -> Where | None:
    """The corners of a survey square, or the middles of its sides: every other waypoint."""
    if not re.search(r"\bsquare\b|\binspect\w*|\bsurvey\b", text) or text.count("@") > 2 or re.search(r"\bgrid|\blanes?\b|lawn", text):
        return None
    begins = _FROM_CORNER.search(text) is not None and not re.search(r"\bat (?:the |each |every |all )?(?:four )?corners?\b[^.;]{0,10}$", text)
    if begins and _FROM_MIDDLE.search(text):
        return None
    return Where(parity=0 if corner == begins else 1)
