"""The mentions of skills that another scope behind them may go on about: "a pin in the first hold;
another in the third".
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner_ft.decoding.constraints.reading.scopes.mention_places import JOINT
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import Mention, sentence_at
from planner_ft.decoding.constraints.reading.scopes.where import Anchor

_NOTHING = re.compile(r"^[,:]? ?(?:\w+ ){0,2}(?:nothing|none|without|no\b|not\b)")
"""What follows a scope in which nothing runs."""


def loose_mentions(
    text: str, mentions: Sequence[Mention], anchors: Sequence[Anchor]
) -> list[Mention]:
    """Those whose steps are not told by where they stand."""
    found = [
        mention
        for mention in mentions
        if mention.name == "DetectObjects"
        and "sonar" in text[slice(*sentence_at(text, mention.start))]
    ]
    found += [
        mention
        for mention in mentions
        if mention.name == "LockHeading"
        and "swing" in text[max(0, mention.start - 25) : mention.end + 25]
    ]
    for number, anchor in enumerate(anchors):
        if anchor.is_scope and not anchor.denied and anchor.kind != "thither":
            found += _spoken_of(text, anchor, anchors[number + 1 : number + 2], mentions, anchors)
    return found


def _spoken_of(
    text: str,
    scope: Anchor,
    following: Sequence[Anchor],
    mentions: Sequence[Mention],
    anchors: Sequence[Anchor],
) -> list[Mention]:
    """The mentions before a scope that it may go on about, since its sentence has none behind
    it.
    """
    begin = max(
        (match.end() for match in re.finditer(r"[.;:!?]\s", text[: scope.start])), default=0
    )
    end = (
        next(
            (match.start() for match in re.finditer(r"[.;!?](?=\s|$)", text[scope.end :])),
            len(text) - scope.end,
        )
        + scope.end
    )
    inside = [other for other in anchors if begin <= other.start < end]
    moved = any(not other.is_scope for other in inside)
    behind = any(scope.end <= mention.start < end for mention in mentions)
    if moved or behind or _NOTHING.match(text[scope.end : end]):
        return []
    before = [mention for mention in mentions if mention.end <= scope.start]
    near = [mention for mention in before if mention.start >= begin]
    found = (
        before[-1:]
        if not _points(text, following)
        and (not near or _told_before(text, near[-1], scope, anchors))
        else []
    )
    return found + near if _closes_row(text, begin, scope, inside) else found


def _points(text: str, following: Sequence[Anchor]) -> bool:
    """Whether the next anchor goes on about the scope before it, and has something done there."""
    return any(
        anchor.kind in ("that", "then", "ordinal") and not _NOTHING.match(text[anchor.end :])
        for anchor in following
    )


def _told_before(text: str, mention: Mention, scope: Anchor, anchors: Sequence[Anchor]) -> bool:
    """Whether another scope, that is no phrase with this one, stands between a mention and it."""
    return any(
        other.is_scope
        and mention.end <= other.start < scope.start
        and not other.denied
        and not JOINT.fullmatch(text[other.end : scope.start])
        for other in anchors
    )


def _closes_row(text: str, begin: int, scope: Anchor, inside: Sequence[Anchor]) -> bool:
    """Whether a scope is the last of several in a sentence that opens with one."""
    opens = [other for other in inside if other.is_scope]
    return (
        len(opens) > 1
        and opens[-1] is scope
        and opens[0].kind != "except"
        and not text[begin : opens[0].start].strip(" ,")
    )
