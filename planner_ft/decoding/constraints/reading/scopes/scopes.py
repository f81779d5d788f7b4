"""In which steps of its plan a filter or perception skill runs, where a task input says so plainly.

The text is cut into clauses. In each stand words for skills, for scopes ("on the second leg only") and for movements. A scope holds for the skills that
stand next to it; a skill in the clause of a movement runs in that movement. What could be meant in two ways is not read: the model decides.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace

from planner_ft.data.quantities import positions
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class Part:
    """Some steps: those of `sure` navigation skills (and perhaps of those of `maybe`), any where both are empty; of these the `which`-th, or all."""

    sure: frozenset[str] = frozenset()
    maybe: frozenset[str] = frozenset()
    which: frozenset[int] | None = None
    excepted: bool = False
    counted: bool = True
    """Whether steps can be counted: False where one movement of the text may be several of them."""
    script: tuple[str, ...] = ()
    """The navigation skills of the text's movements, where `which` counts these: it holds while the plan goes by them."""
    others: bool = False
    """What holds for movements of other kinds: "in all but the last hold" is in these as well."""
    by_movement: bool = False
    """Whether `which` counts the movements of the text, that may be of several steps each."""

    def holds(self, earlier: Sequence[str] | None, index: int, skill: str, is_last: bool | None) -> bool | None:
        if self.by_movement:
            if index and (earlier is None or (*earlier, skill) != self.script[: index + 1]):
                return None
            return self._counts(index, is_last, overall=True)
        if self.script:
            followed = earlier is not None and (*earlier, skill) == self.script[: index + 1]
            return index in (self.which or ()) if followed else None
        if not (self.sure or self.maybe):
            return self._counts(index, is_last, overall=True)
        if skill in self.maybe:
            return None
        if skill not in self.sure:
            return self.others
        if self.which is None:
            return True
        kinds = self.sure | self.maybe
        return self._counts(sum(name in kinds for name in earlier), is_last, overall=False) if earlier is not None else None

    def _counts(self, index: int, is_last: bool | None, *, overall: bool) -> bool | None:
        if self.which is None:
            return True
        named = self._named(index, is_last, overall)
        return None if named is None else named != self.excepted

    def _named(self, index: int, is_last: bool | None, overall: bool) -> bool | None:
        assert self.which is not None
        if not self.counted and index > 0:
            return True if w.LAST in self.which and is_last else None
        if index in self.which:
            return True
        # A plan of which a last step is spoken of has more than one.
        if w.LAST not in self.which or index == 0:
            return False
        return is_last if overall or is_last else None


@dataclass(frozen=True)
class Scope:
    """The steps in which a skill runs: those of any of `parts`, and perhaps others where the text is `open`."""

    parts: tuple[Part, ...]
    open: bool = False
    source: str = ""
    script: tuple[str, ...] = ()

    def allows(self, step_index: int, navigation_skill: str, is_last: bool | None = None, earlier: Sequence[str] | None = None) -> bool | None:
        """Whether the skill must run (True) or must not (False) in the step; None: not known.

        `is_last` is None where it is not known whether the step ends the plan, `earlier` the navigation skills of the steps before it.
        """
        if is_last is None and earlier is not None and self.script and (*earlier, navigation_skill) == self.script[: step_index + 1]:
            is_last = step_index + 1 == len(self.script)
        found = [part.holds(earlier, step_index, navigation_skill, is_last) for part in self.parts]
        if True in found:
            return True
        return None if self.open or None in found else False


EVERYWHERE = Part()
_STARTED = re.compile(r"\bstart(?:ing)? (?:point|position|at|from)\b.*\bleg (?:1|one)\b")
_RETURN = dict(w.SCOPES)["return"]
_TOLD = ("range", "but", "middle", "return")
"""Scopes that only the movements of the text tell."""


@dataclass(frozen=True)
class Mark:
    """A word of a clause that counts: of a skill, a scope or a movement."""

    start: int
    end: int
    kind: str
    value: str
    part: Part | None = None
    negated: bool = False
    said: Mapping[str, str | None] = field(default_factory=dict)
    """The words of a scope that is told by the movements of the text."""


@dataclass(frozen=True)
class Clause:
    """A clause with its marks in order; `head`: the scope that a heading before it gives to all of it."""

    text: str
    marks: tuple[Mark, ...]
    head: Part | None = None

    def of(self, kind: str) -> list[Mark]:
        return [mark for mark in self.marks if mark.kind == kind]


@dataclass(frozen=True)
class Reading:
    """What holds for the whole text.

    moves: the navigation skills of its movements; counted: each is one step; ordered: they are done as they are told;
    whole: none may have been missed; scoped: a skill may be meant for some steps only; runs: words for places to go to;
    stops: it stops somewhere; homewards: it comes back; elliptic: a step is like one before; kinds: scopes name kinds of movement;
    paused: it stops at each of several places.
    """

    moves: tuple[str, ...]
    counted: bool
    ordered: bool
    whole: bool
    scoped: bool
    runs: int
    stops: bool
    homewards: bool
    elliptic: bool
    kinds: bool
    paused: bool

    @property
    def script(self) -> tuple[str, ...]:
        return self.moves if self.counted and self.ordered and self.whole and len(self.moves) > 1 else ()


def read_scopes(text: str, vocabulary: Vocabulary) -> dict[str, Scope]:
    """The skills of a task input of which it is plain where they run; empty where nothing is."""
    plain = plain_form(text)
    if w.CHANGED.search(plain):
        return {}
    names = [skill.name for role in ("filter", "perception") for skill in vocabulary.skills_in_role(role) if skill.name in w.SKILL_WORDS]
    counted = _counted(plain)
    clauses = _clauses(plain, names, counted)
    reading = _reading(plain, clauses, counted)
    found: dict[str, list[tuple[Part | None, str]]] = {}
    before = 0
    latest: set[str] = set()
    for clause in clauses:
        for name, part, source in _placed(clause, before, reading):
            found.setdefault(name, []).append((part, source))
        # "While turning, have the detector look for ferries; while holding, too": the scope is for the skill before.
        if clause.of("scope") and not clause.of("skill") and not clause.of("move") and not w.REFUSED.search(clause.text):
            for name in latest:
                found.setdefault(name, []).append((None, "unread"))
        latest = {mark.value for mark in clause.of("skill")} or latest
        before += len(clause.of("move"))
    scopes = {name: scope for name, places in found.items() if (scope := _scope(places, reading)) is not None}
    # Legs that are numbered behind a start point are not the first steps.
    return {name: scope for name, scope in scopes.items() if "numbered" not in scope.source or not _STARTED.search(plain)}


def _reading(plain: str, clauses: Sequence[Clause], counted: bool) -> Reading:
    moves = tuple(mark.value for clause in clauses for mark in clause.of("move"))
    scopes = [mark for clause in clauses for mark in clause.of("scope")]
    return Reading(
        moves=moves,
        counted=counted,
        ordered=not w.UNORDERED.search(plain),
        whole=len(w.HOME.findall(_RETURN.sub(" ", plain))) < 2
        and all(clause.marks or clause.head or w.IDLE.match(clause.text) for clause in clauses)
        and all(clause.text.count("@") <= len(clause.marks) for clause in clauses),
        scoped=bool(scopes or w.SCOPED.search(plain)) or any(clause.head for clause in clauses),
        runs=len(w.RUNS.findall(plain)),
        stops=w.HOLD in moves or bool(w.STOPS.search(plain)),
        homewards=bool(w.HOMEWARDS.search(plain)),
        elliptic=bool(w.ELLIPTIC.search(plain)),
        kinds=any(mark.value in ("kind", "all") and mark.part is not None and bool(mark.part.sure | mark.part.maybe) for mark in scopes),
        paused=bool(w.PAUSED.search(plain)),
    )


def _scope(places: list[tuple[Part | None, str]], reading: Reading) -> Scope | None:
    parts = tuple(dict.fromkeys(part for part, _source in places if part is not None))
    # Spoken of in different ways: one of them may be meant for another skill.
    unread = any(part is None for part, _source in places)
    if not parts or (unread and EVERYWHERE in parts) or len({source for part, source in places if part is not None}) > 1:
        return None
    return Scope(
        parts,
        open=reading.elliptic or any(part is None for part, _source in places),
        source="+".join(sorted({source for part, source in places if part is not None})),
        script=reading.script,
    )


def plain_form(text: str) -> str:
    """The text in small letters, with marks for quotations and places and without corners of boundaries and names of cameras."""
    plain = w.QUOTED.sub(" q ", without_fences(text))
    behind = len(plain)
    for _x, _y, start, end in sorted(positions(plain), key=lambda found: -found[2]):
        if end <= behind and not w.COUNTED.search(plain[:start]):
            plain, behind = plain[:start] + "@" + plain[end:], start
    return w.SPACES.sub(_closed, w.SENSORS.sub(" cam ", w.PLACE.sub(" @ ", plain.lower())))


def _closed(match: re.Match[str]) -> str:
    """A space, or the mark that stood behind spaces."""
    return match[1] or " "


def _counted(plain: str) -> bool:
    """Whether each movement of a text is one step, as far as its words tell."""
    rest = w.PERIOD.sub(" ", plain)
    for kind, pattern in w.SCOPES:
        if kind in ("all", "except", "everywhere", "ordinal", "numbered", "while"):
            rest = pattern.sub(" ", rest)
    return not (w.MANY.search(rest) or w.RUN_ON.search(plain))


def _clauses(plain: str, names: Sequence[str], counted: bool) -> list[Clause]:
    clauses: list[Clause] = []
    for sentence in w.SENTENCE.split(plain):
        head: Part | None = None
        for text in w.CLAUSE.split(sentence):
            if not text.strip() or w.TWO_STEPS.match(text):
                continue
            clause = Clause(text, tuple(marks_of(text, names, counted)))
            header = w.HEADER.match(text)
            first = clause.marks[0] if clause.marks else None
            if header and first and first.kind == "scope" and first.end <= header.end():
                head = first.part
            elif head is not None and not clause.of("scope"):
                clause = replace(clause, head=head)
            clauses.append(clause)
    return clauses


def marks_of(text: str, names: Sequence[str], counted: bool) -> list[Mark]:
    scopes = list(
        _free(
            (
                Mark(match.start(), match.end(), "scope", kind, _part(kind, match, counted), _negated(text, match), match.groupdict() | {"whole": match[0]})
                for kind, pattern in w.SCOPES
                for match in pattern.finditer(text)
            ),
            [],
        )
    )
    moves = list(
        _free(
            (Mark(match.start(), match.end(), "move", name) for name, pattern in w.MOVEMENTS for match in pattern.finditer(text)),
            [mark for mark in scopes if mark.value != "to"],
        )
    )
    scopes = [mark for mark in _free(scopes, moves) if not (moves and mark.value == "to" and w.AFTER_THAT.match(text[: mark.end]))]
    skills = [
        Mark(match.start(), match.end(), "skill", name, None, bool(w.NEGATED.search(text[: match.start()]) or w.LAPSED.match(text[match.end() :])))
        for name in names
        for match in w.SKILL_WORDS[name].finditer(text)
        if not w.FREE.search(match[0])
    ]
    skills = [mark for mark in skills if not any(other.start <= mark.start and mark.end <= other.end for other in (*scopes, *moves))]
    return sorted([*scopes, *moves, *skills], key=lambda mark: (mark.start, mark.end))


def _free(marks: Iterable[Mark], taken: Iterable[Mark]) -> Iterator[Mark]:
    """Those that lie apart from all before them."""
    kept = list(taken)
    for mark in marks:
        if all(mark.end <= other.start or other.end <= mark.start for other in kept):
            kept.append(mark)
            yield mark


def _negated(text: str, match: re.Match[str]) -> bool:
    return w.NOT_BEFORE.search(text[: match.start()]) is not None


def _part(kind: str, match: re.Match[str], counted: bool) -> Part | None:
    """The steps that a scope means; None where it is not read."""
    if kind in ("to", "place", *_TOLD):
        return None
    if kind == "bare":
        return EVERYWHERE
    if kind == "way":
        return Part(frozenset({w.GOTO}))
    if kind == "everywhere":
        return EVERYWHERE
    if kind == "while":
        gerund = next(name for name, value in match.groupdict().items() if value and name != "gerund")
        meant, others = w.GERUNDS[gerund]
        return Part(frozenset({meant}), frozenset(others))
    groups = match.groupdict()
    sure, maybe = _kind(groups.get("noun") or "step")
    if kind == "ordinal" and str(groups.get("noun")).startswith("of "):
        return None
    part = Part(sure, maybe, counted=counted)
    if kind == "kind" and not part.sure and not part.maybe:
        return None
    if kind == "except" and groups.get("before"):
        sure, maybe = _kind(groups["before"] or "")
        part = replace(part, sure=sure, maybe=maybe)
    elif kind == "except" and part.sure | part.maybe:
        part = replace(part, others=True)
    if kind == "several":
        return replace(part, which=frozenset(range(w.COUNTS[groups["count"]]))) if groups["side"] == "first" else None
    if groups.get("cards"):
        cards = re.findall(r"\b(?:[a-f]|[1-9]|[a-z]{3,5})\b", groups["cards"])
        return replace(part, which=frozenset(w.CARDINAL[word] for word in cards if word in w.CARDINAL))
    if groups.get("ords"):
        return replace(part, which=frozenset(w.ORDINAL[word] for word in re.findall(rf"\b{w.ORD}\b", groups["ords"])), excepted=kind == "except")
    return part


def _kind(noun: str) -> tuple[frozenset[str], frozenset[str]]:
    return next((kinds for pattern, kinds in zip(w.MOVEMENT_KINDS, w.NOUNS.values(), strict=True) if pattern.fullmatch(noun)), (frozenset(), frozenset()))


def _placed(clause: Clause, before: int, reading: Reading) -> Iterator[tuple[str, Part | None, str]]:
    """Each skill of a clause with its steps and how they were found; None for steps that are not known."""
    skills, scopes, moved = clause.of("skill"), clause.of("scope"), clause.of("move")
    if not skills:
        return
    if scopes:
        yield from _governed(clause, before, reading)
        return
    for mark in skills:
        if mark.negated:
            continue
        if clause.head is not None:
            yield mark.value, clause.head, "head"
        elif (
            len(moved) == 1
            and not w.NO_MOVE.search(clause.text)
            and ":" not in clause.text[mark.end : moved[0].start]
            and (mark.start > moved[0].start or "," not in clause.text[mark.end : moved[0].start] or w.BESIDES.match(clause.text))
        ):
            yield mark.value, _movement(before, reading), "move"
        elif not moved and not reading.scoped and len(reading.moves) < 2 and reading.runs < 3:
            yield mark.value, EVERYWHERE, "default"
        else:
            yield mark.value, None, "unread"


def _movement(index: int, reading: Reading) -> Part | None:
    """The steps of one movement of the text."""
    if reading.script:
        return Part(which=frozenset({index}), script=reading.script)
    name = reading.moves[index]
    if len(reading.moves) < 2 or reading.moves.count(name) > 1:
        return None
    return Part(frozenset({name}), w.KINDS - {name}) if name not in (w.GOTO, w.FACE, w.NUDGE) and reading.whole and reading.ordered else None


def _settled(mark: Mark, before: int, clause: Clause, reading: Reading) -> Part | None:
    """The steps of a scope, with what the movements of the text say of it; `before`: how many of them stand before the clause."""
    part, word = mark.part, clause.text[mark.start : mark.end].strip()
    if mark.value in _TOLD or (mark.value == "several" and part is None):
        return None if w.GOES_ON.match(clause.text[mark.end :]) else _told(mark, reading, clause)
    if w.GOES_ON.match(clause.text[mark.end :]) or (mark.value == "ordinal" and w.TO_OWN_PLACE.match(clause.text[mark.end :])):
        return None
    if mark.value == "that" and len(clause.of("move")) > 1:
        return None
    if mark.value == "that":
        return _pointed_at(part, before + sum(other.start < mark.start for other in clause.of("move")) - 1, reading)
    if mark.value == "bare":
        return EVERYWHERE if part and reading.counted and w.BARE_COUNTS.get(word.split()[-1]) == len(reading.moves) else None
    if part is None or (mark.value == "way" and w.GOTO not in reading.moves):
        return None
    if part.sure or part.maybe:
        return part if part.which is not None else _of_kind(part, mark.value, word, reading)
    if part.which is None and mark.value == "all" and (w.COUNTS.keys() & set(word.split())) and reading.script:
        # "For both moves" where three things are done.
        return part if len(reading.script) in {w.COUNTS[name] for name in word.split() if name in w.COUNTS} else None
    if part.which is None or w.STEP.search(word):
        return part
    # "the second part" is a movement, and "in the second" may go on about holds spoken of before.
    if w.BARE.search(word) and reading.kinds:
        return None
    return replace(part, counted=part.counted and bool(reading.script), script=reading.script, by_movement=True)


def _told(mark: Mark, reading: Reading, clause: Clause) -> Part | None:
    """The steps of a scope that only the movements of the text tell: "from the second leg on", "everywhere but on the bend"."""
    script, said = reading.script, mark.said
    if not script or clause.of("move"):
        return None
    count = len(script)
    found: Iterable[int] = ()
    if mark.value == "range":
        number = next(number for number in "1234" if said.get(f"noun{number}"))
        place = _place(script, said.get(f"ord{number}"), said[f"noun{number}"] or "")
        if place is None:
            return None
        found = range(place, count) if number == "1" else range(place + 1, count) if number == "4" else range(place + 1)
    elif mark.value == "but":
        barred = _barred(script, said)
        found = [index for index in range(count) if index not in barred] if barred else ()
    elif mark.value == "return":
        found = [count - 1] if script[-1] == w.GOTO and reading.homewards and (w.HOME.search(mark.said["whole"] or "") or script.count(w.GOTO) == 2) else ()
    else:
        found = _row(script, mark, said)
    which = frozenset(found)
    return Part(which=which, script=script) if which else None


def _place(script: Sequence[str], order: str | None, noun: str) -> int | None:
    """Which movement is "the turn" or "the second hold"."""
    kinds = frozenset[str]().union(*_kind(noun))
    places = [index for index, name in enumerate(script) if not kinds or name in kinds]
    if any(script[index] not in _kind(noun)[0] for index in places) and len({script[index] for index in places}) > 1 and kinds:
        return None
    if order is None:
        return places[0] if len(places) == 1 else None
    number = w.ORDINAL[order.strip()]
    return places[number] if -len(places) <= number < len(places) else None


def _barred(script: Sequence[str], said: Mapping[str, str | None]) -> list[int]:
    """The movements that a scope leaves out."""
    noun = said.get("noun")
    gerund = next((name for name in ("drift", "face", "hold", "goto") if said.get(name)), "")
    sure, maybe = _kind(noun) if noun else (frozenset({w.GERUNDS[gerund][0]}), frozenset(w.GERUNDS[gerund][1]))
    barred = [index for index, name in enumerate(script) if name in sure | maybe]
    if len({script[index] for index in barred}) > 1 or (noun and len(barred) > 1 and not noun.endswith("s")):
        return []
    return barred


def _row(script: Sequence[str], mark: Mark, said: Mapping[str, str | None]) -> Iterable[int]:
    """The outer, inner, middle or last ones of movements of one kind."""
    kinds = frozenset[str]().union(*_kind(said.get("noun") or "step"))
    places = [index for index, name in enumerate(script) if not kinds or name in kinds]
    if len({script[index] for index in places}) > 1:
        return ()
    if mark.value == "middle":
        return places[len(places) // 2 :][:1] if len(places) % 2 and len(places) > 1 else ()
    many = w.COUNTS[said["count"] or ""]
    if said["side"] == "outer":
        return (places[0], places[-1]) if many == 2 and len(places) > 2 else ()
    if said["side"] == "inner":
        return places[1:-1] if len(places) == many + 2 else ()
    return places[-many:] if said["side"] in ("last", "final") and len(places) > many else ()


def _pointed_at(part: Part | None, index: int, reading: Reading) -> Part | None:
    """ "During this hold": the movement spoken of last."""
    if not 0 <= index < len(reading.script) or (part and part.sure and reading.moves[index] not in part.sure):
        return None
    return Part(which=frozenset({index}), script=reading.script)


def _of_kind(part: Part, value: str, word: str, reading: Reading) -> Part:
    """All steps of a kind of movement: which kinds a word such as "turn" means, and whether it means all such steps, depends on what is asked for."""
    moves = reading.moves
    if reading.paused and not part.sure & {w.HOLD, w.WAIT}:
        part = replace(part, maybe=part.maybe | {w.HOLD, w.WAIT})
    turns = (part.sure | part.maybe) & {w.FACE, w.NUDGE, w.ARC} if part.maybe & {w.FACE, w.NUDGE} else frozenset()
    if turns:
        turned = [name for name in moves if name in turns]
        sure = turns if len(turned) == 1 or (len(set(turned)) == 1 and word.endswith("s")) else frozenset[str]()
        part = replace(part, sure=sure, maybe=(part.maybe | turns) - sure)
    if part.sure == {w.HOLD} and w.HOLD not in moves and w.VISUAL in moves and value != "all":
        part = replace(part, sure=frozenset({w.HOLD, w.VISUAL}), maybe=frozenset())
    return replace(part, sure=frozenset(), maybe=part.sure | part.maybe) if _some_only(part, value, word, reading) else part


def _some_only(part: Part, value: str, word: str, reading: Reading) -> bool:
    """Whether a word for a kind of movement may mean some of its steps only."""
    meant = sum(name in part.sure for name in reading.moves)
    points = part.sure == {w.GOTO} and w.HOLD in part.maybe
    if points and (reading.stops or reading.homewards or meant > 1):
        return True
    said = next((count for number, count in w.COUNTS.items() if number in word.split()), None)
    if value == "all":
        return said is not None and meant > said
    several = meant > 1 or (w.GOTO in part.sure and (not reading.counted or reading.runs > 1))
    return several and (value in ("way", "while") or "lane" in word or (value == "kind" and not word.endswith("s")))


def _governed(clause: Clause, before: int, reading: Reading) -> Iterator[tuple[str, Part | None, str]]:
    groups = _groups(clause)
    moved = clause.of("move")
    held = [(mark, _governor(clause, mark, groups, moved)) for mark in clause.of("skill")]
    # "a pin in the first hold and an entry in the second, another in the third": what runs in the third is not said.
    idle = len(groups) > 1 and any(all(group is not other for _mark, other in held) for group in groups)
    for mark, group in held:
        if mark.negated and group is None:
            continue
        parts = _meant(group, before, clause, reading) if group and not mark.negated and not idle else None
        if parts is None:
            yield mark.value, None, "unread"
        for part in parts or ():
            yield mark.value, part, group[0].value if group else ""


def _groups(clause: Clause) -> list[list[Mark]]:
    """The scopes of a clause, those that are one phrase together."""
    groups: list[list[Mark]] = []
    last: Mark | None = None
    for mark in clause.marks:
        if mark.kind == "scope":
            if (
                last is not None
                and last.kind == "scope"
                and w.JOINT.match(clause.text[last.end : mark.start])
                and not clause.text[: mark.end].endswith(f", and {clause.text[mark.start : mark.end]}")
            ):
                groups[-1].append(mark)
            else:
                groups.append([mark])
        last = mark
    return groups


def _meant(group: Sequence[Mark], before: int, clause: Clause, reading: Reading) -> list[Part] | None:
    """The parts that a phrase names; what it rules out besides says nothing new, unless it takes one of them away."""
    named = [part for mark in group if not mark.negated for part in (_settled(mark, before, clause, reading),)]
    ruled_out = [mark.part for mark in group if mark.negated and mark.part is not None]
    if not named or any(part is None for part in named):
        return None
    parts = [part for part in named if part is not None]
    whole = any(part.which is None for part in parts)
    if ruled_out and whole and any(not part.sure or not other.sure or part.sure & other.sure for part in ruled_out if part for other in parts):
        return None
    return parts


def _reaches(text: str, skill: Mark, group: Sequence[Mark]) -> bool:
    """Whether a phrase that does not open its clause can hold for a skill: no new item of a list stands between them."""
    if not text[: group[0].start].strip(" ,:"):
        return True
    if skill.start >= group[-1].end:
        between = text[group[-1].end : skill.start]
        return "," not in (w.INSERTED.sub("", between) if re.search(r"(?:,|\band)\s*$", text[: group[0].start]) else between)
    if text[group[0].start :].startswith("the ") and text[: group[0].start].rstrip().endswith(","):
        return False
    *_, behind = text[skill.end : group[0].start].split(",")
    same_item = behind == text[skill.end : group[0].start]
    return same_item or re.search(r"\b(?:and|or)\b", behind) is not None or not re.search(r"\b(?!but\b)\w{3,}", behind)


def _governor(clause: Clause, skill: Mark, groups: list[list[Mark]], moved: Sequence[Mark]) -> list[Mark] | None:
    """The phrase that holds for a skill; None where it is not plain."""
    if len(groups) == 1:
        group = groups[0]
        if not _reaches(clause.text, skill, group):
            return None
        between = [mark for mark in moved if min(skill.start, group[0].start) < mark.start < max(skill.start, group[0].start)]
        if not moved:
            return group
        if group[0] is clause.marks[0] and len(moved) == 1 and group[0].part is not EVERYWHERE:
            # "At each corner drift with the logger on" is about what is done there.
            part = group[0].part
            return None if part and w.HOLD in part.maybe and moved[0].value not in (w.GOTO, w.HOLD) else group
        return group if not between and group[0].part is not EVERYWHERE else None
    if moved:
        return None
    order = [mark for mark in clause.marks if mark.kind != "move"]
    if order[0].kind == "scope" and order[-1].kind == "skill":
        return next((group for group in reversed(groups) if group[-1].end <= skill.start), None)
    if order[0].kind == "skill" and order[-1].kind == "scope":
        return next((group for group in groups if group[0].start >= skill.end), None)
    return None
