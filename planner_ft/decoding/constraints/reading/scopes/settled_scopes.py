"""What the scopes of a text mean, with what its movements say of them: "the second leg", "on the
way back", "all but the last hold".
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from planner_ft.decoding.constraints.reading.rows import movement_words as m
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.scope_clauses import (
    TOLD,
    Clause,
    Mark,
    kinds_of,
)
from planner_ft.decoding.constraints.reading.scopes.scope_parts import EVERYWHERE, Part


@dataclass(frozen=True)
class TextReading:
    """What holds for the whole text.

    moves: the navigation skills of its movements; counted: each is one step; ordered: they are done
    as they are told; whole: none may have been missed; scoped: a skill may be meant for some steps
    only; runs: words for places to go to; stops: it stops somewhere; homewards: it comes back;
    elliptic: a step is like one before; kinds: scopes name kinds of movement; paused: it stops at
    each of several places.
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
        return (
            self.moves
            if self.counted and self.ordered and self.whole and len(self.moves) > 1
            else ()
        )


def settled(mark: Mark, before: int, clause: Clause, reading: TextReading) -> Part | None:
    """The steps of a scope, with what the movements of the text say of it; `before`: how many of
    them stand before the clause.
    """
    part, word = mark.part, clause.text[mark.start : mark.end].strip()
    if mark.value in TOLD or (mark.value == "several" and part is None):
        return None if w.GOES_ON.match(clause.text[mark.end :]) else _told(mark, reading, clause)
    if w.GOES_ON.match(clause.text[mark.end :]) or (
        mark.value == "ordinal" and w.TO_OWN_PLACE.match(clause.text[mark.end :])
    ):
        return None
    if mark.value == "that" and len(clause.of("move")) > 1:
        return None
    if mark.value == "that":
        return _pointed_at(
            part, before + sum(other.start < mark.start for other in clause.of("move")) - 1, reading
        )
    if mark.value == "bare":
        return (
            EVERYWHERE
            if part
            and reading.counted
            and w.BARE_COUNTS.get(word.split()[-1]) == len(reading.moves)
            else None
        )
    if part is None or (mark.value == "way" and m.GOTO not in reading.moves):
        return None
    if part.sure or part.maybe:
        return part if part.which is not None else _ofkinds_of(part, mark.value, word, reading)
    if (
        part.which is None
        and mark.value == "all"
        and (w.COUNTS.keys() & set(word.split()))
        and reading.script
    ):
        # "For both moves" where three things are done.
        return (
            part
            if len(reading.script) in {w.COUNTS[name] for name in word.split() if name in w.COUNTS}
            else None
        )
    if part.which is None or w.STEP.search(word):
        return part
    # "the second part" is a movement, and "in the second" may go on about holds spoken of before.
    if w.BARE.search(word) and reading.kinds:
        return None
    return replace(
        part, counted=part.counted and bool(reading.script), script=reading.script, by_movement=True
    )


# ---------------------------------------------------------------- told by the row of movements


def _told(mark: Mark, reading: TextReading, clause: Clause) -> Part | None:
    """The steps of a scope that only the movements of the text tell: "from the second leg on",
    "everywhere but on the bend".
    """
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
        found = (
            range(place, count)
            if number == "1"
            else range(place + 1, count)
            if number == "4"
            else range(place + 1)
        )
    elif mark.value == "but":
        barred = _barred(script, said)
        found = [index for index in range(count) if index not in barred] if barred else ()
    elif mark.value == "return":
        found = (
            [count - 1]
            if script[-1] == m.GOTO
            and reading.homewards
            and (w.HOME.search(mark.said["whole"] or "") or script.count(m.GOTO) == 2)
            else ()
        )
    else:
        found = _row(script, mark, said)
    which = frozenset(found)
    return Part(which=which, script=script) if which else None


def _place(script: Sequence[str], order: str | None, noun: str) -> int | None:
    """Which movement is "the turn" or "the second hold"."""
    kinds = frozenset[str]().union(*kinds_of(noun))
    places = [index for index, name in enumerate(script) if not kinds or name in kinds]
    if (
        any(script[index] not in kinds_of(noun)[0] for index in places)
        and len({script[index] for index in places}) > 1
        and kinds
    ):
        return None
    if order is None:
        return places[0] if len(places) == 1 else None
    number = w.ORDINAL[order.strip()]
    return places[number] if -len(places) <= number < len(places) else None


def _barred(script: Sequence[str], said: Mapping[str, str | None]) -> list[int]:
    """The movements that a scope leaves out."""
    noun = said.get("noun")
    gerund = next((name for name in ("drift", "face", "hold", "goto") if said.get(name)), "")
    sure, maybe = (
        kinds_of(noun)
        if noun
        else (frozenset({w.GERUNDS[gerund][0]}), frozenset(w.GERUNDS[gerund][1]))
    )
    barred = [index for index, name in enumerate(script) if name in sure | maybe]
    if len({script[index] for index in barred}) > 1 or (
        noun and len(barred) > 1 and not noun.endswith("s")
    ):
        return []
    return barred


def _row(script: Sequence[str], mark: Mark, said: Mapping[str, str | None]) -> Iterable[int]:
    """The outer, inner, middle or last ones of movements of one kind."""
    kinds = frozenset[str]().union(*kinds_of(said.get("noun") or "step"))
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


def _pointed_at(part: Part | None, index: int, reading: TextReading) -> Part | None:
    """ "During this hold": the movement spoken of last."""
    if not 0 <= index < len(reading.script) or (
        part and part.sure and reading.moves[index] not in part.sure
    ):
        return None
    return Part(which=frozenset({index}), script=reading.script)


# ---------------------------------------------------------------- told by the kind of a movement


def _ofkinds_of(part: Part, value: str, word: str, reading: TextReading) -> Part:
    """All steps of a kind of movement: which kinds a word such as "turn" means, and whether it
    means all such steps, depends on what is asked for.
    """
    moves = reading.moves
    if reading.paused and not part.sure & {m.HOLD, m.WAIT}:
        part = replace(part, maybe=part.maybe | {m.HOLD, m.WAIT})
    turns = (
        (part.sure | part.maybe) & {m.FACE, m.NUDGE, m.ARC}
        if part.maybe & {m.FACE, m.NUDGE}
        else frozenset()
    )
    if turns:
        turned = [name for name in moves if name in turns]
        sure = (
            turns
            if len(turned) == 1 or (len(set(turned)) == 1 and word.endswith("s"))
            else frozenset[str]()
        )
        part = replace(part, sure=sure, maybe=(part.maybe | turns) - sure)
    if part.sure == {m.HOLD} and m.HOLD not in moves and m.VISUAL in moves and value != "all":
        part = replace(part, sure=frozenset({m.HOLD, m.VISUAL}), maybe=frozenset())
    return (
        replace(part, sure=frozenset(), maybe=part.sure | part.maybe)
        if _some_only(part, value, word, reading)
        else part
    )


def _some_only(part: Part, value: str, word: str, reading: TextReading) -> bool:
    """Whether a word for a kind of movement may mean some of its steps only."""
    meant = sum(name in part.sure for name in reading.moves)
    points = part.sure == {m.GOTO} and m.HOLD in part.maybe
    if points and (reading.stops or reading.homewards or meant > 1):
        return True
    said = next((count for number, count in w.COUNTS.items() if number in word.split()), None)
    if value == "all":
        return said is not None and meant > said
    several = meant > 1 or (m.GOTO in part.sure and (not reading.counted or reading.runs > 1))
    return several and (
        value in ("way", "while") or "lane" in word or (value == "kind" and not word.endswith("s"))
    )
