"""The steps that each mention of a skill is for: by the scope of its item, else by the movement of
its item, else by what its clause leaves no choice of.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.rows.movement_rows import Row
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.own_sentences import SOMEWHERE
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import Mention
from planner_ft.decoding.constraints.reading.scopes.text_items import (
    Span,
    clauses,
    items,
    sentences,
)
from planner_ft.decoding.constraints.reading.scopes.where import EVERYWHERE, Anchor, Where

JOINT = re.compile(r",? ?(?:and|or|as well as|plus)? ?(?:also )?")
"""What stands between two scopes of one phrase."""


@dataclass(frozen=True)
class _Place:
    """Where a mention stands in its text: its item, clause and sentence, all `anchors` of the text,
    and the one that heads the clauses.
    """

    text: str
    mention: Mention
    item: Span
    clause: Span
    sentence: Span
    anchors: Sequence[Anchor]
    head: Anchor | None
    row: Row

    @functools.cached_property
    def near(self) -> list[Anchor]:
        """The anchors of the item that can hold for the mention."""
        return [
            anchor
            for anchor in _inside(self.anchors, self.clause)
            if self.item[0] <= anchor.start < self.item[1]
            and (self.mention.denied or not anchor.denied)
        ]

    @functools.cached_property
    def usable(self) -> list[Anchor]:
        """The anchors of the clause."""
        return [anchor for anchor in _inside(self.anchors, self.clause) if not anchor.denied]

    @functools.cached_property
    def ahead(self) -> list[Anchor]:
        """Those before the mention."""
        return [anchor for anchor in self.usable if anchor.end <= self.mention.start]

    @functools.cached_property
    def behind(self) -> list[Anchor]:
        """Those behind it."""
        return [anchor for anchor in self.usable if self.mention.end <= anchor.start]

    def up_to(self, anchor: Anchor) -> str:
        """The words between the mention and an anchor behind it."""
        return self.text[self.mention.end : anchor.start]

    def since(self, anchor: Anchor) -> str:
        """The words between an anchor and the mention behind it."""
        return self.text[anchor.end : self.mention.start]


Rule = Callable[[_Place], Iterator[Where | None]]
"""Yields the steps of a mention where it can tell them, None for steps that are not known, and
nothing where another rule is to tell.
"""


def placed(
    text: str, mentions: Sequence[Mention], anchors: Sequence[Anchor], row: Row
) -> Iterator[tuple[Mention, Where | None, Span]]:
    """Each mention of a skill with the steps that are meant, and its item."""
    for sentence in sentences(text, anchors):
        head: Anchor | None = None
        for clause in clauses(text, sentence, anchors):
            parts = items(text, clause, anchors)
            head = _heading(text, clause, anchors) or head
            for mention in mentions:
                if clause[0] <= mention.start < clause[1]:
                    item = next(
                        (begin, end)
                        for begin, end in parts
                        if begin <= mention.start < end or end >= clause[1]
                    )
                    place = _Place(text, mention, item, clause, sentence, anchors, head, row)
                    yield (
                        mention,
                        next((where for rule in _RULES for where in rule(place)), None),
                        item,
                    )


def _inside(anchors: Sequence[Anchor], clause: Span) -> list[Anchor]:
    return [anchor for anchor in anchors if clause[0] <= anchor.start < clause[1]]


def _heading(text: str, clause: Span, anchors: Sequence[Anchor]) -> Anchor | None:
    """The scope that opens a clause before a colon: it heads the following clauses as well."""
    inside, colon = _inside(anchors, clause), text.find(":", *clause)
    heads = (
        colon > 0
        and inside
        and inside[0].is_scope
        and inside[0].end <= colon
        and not text[clause[0] : inside[0].start].strip(" ,")
    )
    return inside[0] if heads else None


# ---------------------------------------------------------------- by the item


def _by_scope(place: _Place) -> Iterator[Where | None]:
    """ "A fix on the inner leg"."""
    scopes = [anchor for anchor in place.near if anchor.is_scope]
    if not scopes:
        return
    if re.search(r"\b(?:already|even)\b", place.text[slice(*place.item)]):
        yield None
    else:
        yield scopes[0].where if len(scopes) == 1 else _joined(place.text, scopes)


def _unread(place: _Place) -> Iterator[None]:
    """Words beside the anchors that say where in another way."""
    rest = place.text[slice(*place.item)]
    for anchor in place.near:
        rest = rest.replace(place.text[anchor.start : anchor.end], " ")
    if s.UNREAD.search(rest):
        yield None


def _by_movement(place: _Place) -> Iterator[Where | None]:
    """ "Hold for a minute taking a fix"."""
    if place.near:
        ahead = [anchor for anchor in place.near if anchor.end <= place.mention.start]
        yield ahead[-1].where if ahead else place.near[0].where if len(place.near) == 1 else None


# ---------------------------------------------------------------- by what heads it


def _by_heading(place: _Place) -> Iterator[Where | None]:
    """ "On the way back: a fix, and soundings"."""
    if place.head is not None:
        yield place.head.where


def _by_headed_movement(place: _Place) -> Iterator[Where | None]:
    """ "Hold for a minute: a fix, and soundings"."""
    colon = place.text.rfind(":", place.sentence[0], place.mention.start)
    headed = [
        anchor
        for anchor in place.anchors
        if not anchor.is_scope and place.sentence[0] <= anchor.start < colon
    ]
    if len(headed) > 1:
        yield None
    elif (
        headed
        and headed[0].start >= place.clause[0]
        and not any(colon < anchor.start < place.mention.start for anchor in place.anchors)
    ):
        yield headed[0].where


# ---------------------------------------------------------------- by the clause


def _by_exception(place: _Place) -> Iterator[Where | None]:
    """ "Film, and take soundings, except on the turn"."""
    left_out = [anchor for anchor in place.behind if anchor.kind == "except"]
    if (
        left_out
        and sum(anchor.is_scope for anchor in place.usable) == 1
        and not s.UNREAD.search(place.up_to(left_out[0]))
    ):
        closes = (
            place.behind[0] is left_out[0]
            and re.search(r"[a-z]", place.text[left_out[0].end : place.clause[1]]) is None
        )
        yield left_out[0].where if closes else None


def _by_what_comes(place: _Place) -> Iterator[Where | None]:
    """ "A fix while you hold"."""
    if place.behind and re.fullmatch(
        r"[^,;:]*\b(?:while|when|as|only) (?:(?:she|you|it) )?(?:is |are )?",
        place.up_to(place.behind[0]),
    ):
        yield place.behind[0].where


def _by_own_sentence(place: _Place) -> Iterator[Where | None]:
    """A sentence of its own, that names no steps."""
    if place.usable:
        return
    said, (begin, end) = place.text[slice(*place.sentence)], place.sentence
    named = (
        any(begin <= anchor.start < end for anchor in place.anchors)
        or SOMEWHERE.search(said)
        or s.UNREAD.search(said)
        or ":" in said
    )
    units = place.row.units
    yield EVERYWHERE if not named and units and units[-1].start < begin else None


def _by_opening(place: _Place) -> Iterator[Where | None]:
    """ "On the inner leg film, and take soundings"."""
    text, first = place.text, place.usable[0]
    if not first.is_scope or re.search(
        r"[a-z]{3,}",
        re.sub(r"\b(?:and|but|with|while|so)\b", "", text[place.clause[0] : first.start]),
    ):
        return
    ahead = [anchor for anchor in place.ahead if anchor.is_scope]
    if not ahead or _moved_since(ahead[-1], place) or s.UNREAD.search(place.since(ahead[-1])):
        yield None
        return
    joined = [
        anchor
        for anchor in ahead
        if anchor is ahead[-1]
        or re.fullmatch(r",? ?(?:and|or|as well as) ?", text[anchor.end : ahead[-1].start])
    ]
    yield _joined(text, joined) if len(joined) > 1 else ahead[-1].where


def _moved_since(scope: Anchor, place: _Place) -> bool:
    """Whether a movement stands between a scope and the mention."""
    moved = [
        anchor
        for anchor in place.usable
        if not anchor.is_scope and scope.end <= anchor.start < place.mention.start
    ]
    # "From there on to the goal position no margin is needed."
    goes_on = bool(moved) and scope.kind == "onwards" and moved[0].start - scope.end <= 2
    return len(moved) > goes_on


def _by_the_only_one(place: _Place) -> Iterator[Where | None]:
    """A clause with one anchor alone."""
    if len(place.usable) > 1:
        return
    only, begin = place.usable[0], place.clause[0]
    if only.is_scope:
        behind = place.up_to(only)
        tells = bool(place.behind) and (
            "," not in behind or re.search(r"\band\b", behind) is not None
        )
    else:
        tells = (
            only.start < place.mention.start
            or re.match(
                r"\s*(?:with|while|keeping|staying|under|\w+ing)\b",
                place.text[begin : place.clause[1]],
            )
            is not None
        )
    yield only.where if tells else None


def _by_closing(place: _Place) -> Iterator[Where | None]:
    """ "Run to the pier and hold there, with a fix, only on the way out"."""
    scope = next((anchor for anchor in place.behind if anchor.is_scope), None)
    if (
        scope
        and re.fullmatch(r"[^,;:]*,? ?(?:and |but |though )?", place.up_to(scope))
        and _closes(place.text, scope)
    ):
        yield scope.where


def _by_the_last(place: _Place) -> Iterator[Where | None]:
    """The scope or the movement right before the mention."""
    last = place.ahead[-1] if place.ahead else None
    if last is None:
        return
    if last.is_scope and re.search(
        r"(?:^|[,;:.]|\band|\bbut) ?(?:and |but )?$", place.text[: last.start]
    ):
        yield last.where
    elif not any(anchor.is_scope for anchor in place.usable) and "," not in place.since(last):
        yield (
            last.where
            if re.match(r"\s*(?:with|while|and|plus)\b", place.text[slice(*place.item)])
            else None
        )


_RULES: tuple[Rule, ...] = (
    _by_scope,
    _unread,
    _by_movement,
    _by_heading,
    _by_headed_movement,
    _by_exception,
    _by_what_comes,
    _by_own_sentence,
    _by_opening,
    _by_the_only_one,
    _by_closing,
    _by_the_last,
)
"""In their order: the first that can tell the steps of a mention does."""


def _closes(text: str, scope: Anchor) -> bool:
    """Whether a scope is the end of its clause, behind a comma, with "only" or for all of it."""
    whole = scope.kind in ("all", "everywhere") and re.fullmatch(
        r"all (?:the|along).*|throughout|the whole (?:way|time)", text[scope.start : scope.end]
    )
    return re.match(r"(?: only| alone)?(?=[.;]|$)", text[scope.end :]) is not None and (
        whole is not None
        or re.search(r", (?:and |but )?(?:only |just )?$|, $", text[: scope.start]) is not None
    )


def _joined(text: str, scopes: Sequence[Anchor]) -> Where | None:
    """Several scopes of one item, if they are one phrase."""
    for one, other in itertools.pairwise(scopes):
        if not JOINT.fullmatch(text[one.end : other.start]):
            return None
    units = [
        anchor.where.units for anchor in scopes if anchor.where and anchor.where.units is not None
    ]
    return Where(frozenset().union(*units)) if len(units) == len(scopes) else None
