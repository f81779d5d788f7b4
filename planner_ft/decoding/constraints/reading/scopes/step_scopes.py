"""In which steps a filter or perception skill runs, told against the row of the text's movements.

The text is cut into items at commas and conjunctions. A skill belongs to the scope of its item ("on
the inner leg", "as long as she floats", "from that moment on"), else to the movement of its item,
else to what its clause leaves no choice of. Words of denial ("no detector under way") say where it
does not run. A plan that does not go by the row is told what holds for kinds of movement only.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from planner_ft.data.quantities import quantities
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row, plain
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.anchors import anchors_of
from planner_ft.decoding.constraints.reading.scopes.loose_mentions import loose_mentions
from planner_ft.decoding.constraints.reading.scopes.mention_places import placed
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import (
    CLEARANCE,
    Mention,
    mentions_of,
    sentence_at,
)
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.decoding.constraints.reading.scopes.step_rows import goes_by, scopes_and_row
from planner_ft.decoding.constraints.reading.scopes.text_items import Span
from planner_ft.decoding.constraints.reading.scopes.where import EVERYWHERE, Anchor, Where
from planner_ft.decoding.constraints.reading.skills.evidence import NEGATION, asks_for
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class StepScope:
    """The steps in which a skill runs and those in which it does not; of the others nothing is
    known unless it is `closed`.
    """

    row: Row | None
    runs: tuple[Where, ...] = ()
    rests: tuple[Where, ...] = ()
    closed: bool = False
    values: tuple[tuple[Where, float], ...] = ()
    """The values that a skill has in some steps, where they differ."""

    def value(self, names: Sequence[str]) -> float | None:
        """The value of the skill in the last of some steps; None where it is not told for this
        step.
        """
        found = {value for where, value in self.values if where.holds(names, self.row)}
        return found.pop() if len(found) == 1 else None

    def allows(self, names: Sequence[str]) -> bool | None:
        """Whether the skill must run (True) or must not (False) in the last of some steps; None:
        not known.
        """
        rests = [where.holds(names, self.row) for where in self.rests]
        if True in rests:
            return False
        runs = [where.holds(names, self.row) for where in self.runs]
        if True in runs:
            return None if None in rests else True
        return None if None in runs or not self.closed else False


@dataclass(frozen=True)
class StepReading:
    """What an input says of the steps of its skills; `asked` are those that it asks for beyond
    doubt in some of them.
    """

    scopes: dict[str, StepScope] = field(default_factory=dict)
    asked: frozenset[str] = frozenset()


@dataclass(frozen=True)
class _Told:
    """A mention of a skill, the steps that it is for (None: not known), its item, and whether that
    asks for the skill `plainly`, or beyond any doubt.
    """

    mention: Mention
    where: Where | None
    item: Span
    plainly: bool
    asked: bool


_LISTED = re.compile(r"\bthen @ in (?:that|this|the given|the stated) order\b")
"""Places in a list, of which the last may be taken for a movement of its own."""
_SENSOR_ONLY = re.compile(
    r"GetSeabedDepth|CheckLensClearness|GetGPSLocation|SetStreamRecording|DetectSonarFeature"
)


def read_step_scopes(text: str, names: Iterable[str], vocabulary: Vocabulary) -> StepReading:
    """The steps of those of some filter and perception skills of which the text leaves no doubt."""
    said = plain(text)
    if (
        not said.text
        or w.CHANGED.search(said.text)
        or " STOP " in text
        or text.endswith(" STOP")
        or _LISTED.search(said.text)
    ):
        return StepReading()
    found, counted = scopes_and_row(said)
    row = counted if goes_by(said, counted, found) else None
    anchors = anchors_of(said, found, counted, row is not None)
    mentions = mentions_of(said.text, [name for name in names if name in SKILL_WORDS], anchors)
    told: dict[str, list[_Told]] = {}
    for one in _told(said, mentions, anchors, counted, fenced=without_fences(text) != text):
        told.setdefault(one.mention.name, []).append(one)
    limits = [
        sentence_at(said.text, anchor.start)
        for anchor in anchors
        if anchor.is_scope and anchor.where != EVERYWHERE
    ]
    scopes = {
        name: scope
        for name, places in told.items()
        if (scope := _scope(places, row, limits)) is not None
    }
    if CLEARANCE in scopes:
        scopes[CLEARANCE] = replace(scopes[CLEARANCE], values=_values(text, said, told[CLEARANCE]))
    if [unit.steps for unit in counted.units] == [1] and not limits:
        # In the one step of a text everything runs: what it denies is all that is to be told.
        return StepReading({name: scope for name, scope in scopes.items() if not scope.runs})
    return StepReading(
        scopes, frozenset(name for name in scopes if any(one.asked for one in told[name]))
    )


def _told(
    said: Plain, mentions: Sequence[Mention], anchors: Sequence[Anchor], row: Row, *, fenced: bool
) -> Iterator[_Told]:
    """Each mention with what is told of it; `fenced`: the text states a boundary."""
    loose = loose_mentions(said.text, mentions, anchors)
    for mention, meant, item in placed(said.text, mentions, anchors, row):
        where = None if mention in loose else meant
        plainly = asks_for(said.text[slice(*item)], mention.name) or (
            mention.name == "BoundaryEnforcement" and fenced
        )
        asked = (
            where is not None
            and not mention.denied
            and plainly
            and not NEGATION.search(_without(said.text, item, anchors, mentions))
        )
        yield _Told(mention, where, item, plainly, asked)


def _scope(places: Sequence[_Told], row: Row | None, limits: Sequence[Span]) -> StepScope | None:
    """The steps of a skill; `limits` are the sentences that tell steps."""
    if any(one.where not in (None, EVERYWHERE) and not one.mention.denied for one in places):
        # "Use the bow sounder" says nothing of where.
        places = [
            one
            for one in places
            if one.where not in (None, EVERYWHERE)
            or one.plainly
            or not _SENSOR_ONLY.fullmatch(one.mention.name)
        ]
    if all(one.mention.denied and not _limited(one.mention, limits) for one in places):
        return StepScope(row, (), (EVERYWHERE,))
    runs = tuple(dict.fromkeys(one.where for one in places if one.where and not one.mention.denied))
    rests = tuple(dict.fromkeys(one.where for one in places if one.where and one.mention.denied))
    unread = any(one.where is None for one in places)
    if (not runs and not rests) or (EVERYWHERE in runs and (unread or len(runs) > 1)):
        return None
    return StepScope(row, runs, rests, closed=bool(runs) and not unread)


def _limited(mention: Mention, limits: Sequence[Span]) -> bool:
    """Whether the sentence of words that deny a skill tells steps, or may tell some in words that
    are not read.
    """
    return mention.bound or any(begin <= mention.start < end for begin, end in limits)


def _values(text: str, said: Plain, places: Iterable[_Told]) -> tuple[tuple[Where, float], ...]:
    """The clearances of items, if each has one length and they differ."""
    found: dict[Span, tuple[Where, float]] = {}
    for one in places:
        if one.where is None or one.mention.denied:
            continue
        begin, end = one.item
        lengths = [
            quantity.value
            for quantity in quantities(text[said.origin[begin] : said.origin[end - 1] + 1])
            if quantity.unit == "m"
        ]
        if len(lengths) != 1:
            return ()
        found[one.item] = one.where, lengths[0]
    return tuple(found.values()) if len({value for _where, value in found.values()}) > 1 else ()


def _without(text: str, item: Span, anchors: Sequence[Anchor], mentions: Sequence[Mention]) -> str:
    """An item without its scopes and movements, what it denies of other skills ("no recording") and
    "instead" at its end.
    """
    inside = [(anchor.start, anchor.end) for anchor in anchors if item[0] <= anchor.start < item[1]]
    for mention in mentions:
        refused = (
            re.search(r"\b(?:no|without) (?:\w+ )?$", text[item[0] : mention.start])
            if mention.denied and item[0] <= mention.start < item[1]
            else None
        )
        if refused and not any(
            item[0] + refused.start() < end and start < mention.end for start, end in inside
        ):
            inside.append((item[0] + refused.start(), mention.end))
    inside.sort()
    ends = [item[0], *(end for _start, end in inside)]
    left = " ".join(
        text[begin:end]
        for begin, end in zip(ends, [*(start for start, _end in inside), item[1]], strict=True)
    )
    return re.sub(r"\binstead\W*$", " ", left)
