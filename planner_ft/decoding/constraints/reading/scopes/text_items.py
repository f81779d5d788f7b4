"""The sentences, clauses and items of a text, none cut within a phrase that says where something is
done.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.where import Anchor

Span = tuple[int, int]

_CLAUSE = re.compile(
    r";|\s[-–—]\s|,?\s*\b(?:and |but )?(?:(?<!by )(?<!until )(?<!till )(?<!from )then(?=,?"
    r" \w)|next(?=,)|after which|finally|lastly|subsequently)\b,?|\b\d\) "
)
_ITEM = re.compile(r"[,:()]|\b(?:and|but|while|with|without|plus|yet|so)\b")
_GOES_ON = re.compile(
    r" (?:drop|take|log|read|check|measure|record|save|mark|pin|run|detect|track|note|get|keep|enter|register|switch|a|an|the|seabed|gps|no|nothing|only "
    r"(?:take|log|read|drop))\b"
)
"""What is done in a scope that it stands behind."""


def sentences(text: str, anchors: Sequence[Anchor]) -> list[Span]:
    return _pieces(text, w.SENTENCE, (0, len(text)), anchors)


def clauses(text: str, sentence: Span, anchors: Sequence[Anchor]) -> list[Span]:
    return _pieces(text, _CLAUSE, sentence, anchors)


def items(text: str, clause: Span, anchors: Sequence[Anchor]) -> list[Span]:
    return _pieces(text, _ITEM, clause, anchors)


def _pieces(
    text: str, pattern: re.Pattern[str], span: Span, anchors: Sequence[Anchor]
) -> list[Span]:
    """The parts of a text between separators that stand in no anchor."""
    pieces, (begin, end) = [], span
    for match in pattern.finditer(text, *span):
        stands_in = any(
            anchor.start < match.end() and match.start() < anchor.end for anchor in anchors
        )
        if match.start() > begin and not stands_in and not _joins(text, match, begin, anchors):
            pieces.append((begin, match.start()))
            begin = match.start() if match[0].strip().isalpha() else match.end()
    return [*pieces, (begin, end)]


def _joins(text: str, separator: re.Match[str], begin: int, anchors: Sequence[Anchor]) -> bool:
    """Whether a separator joins the scopes on both sides of it to one phrase, in a piece that
    begins at `begin`.
    """
    scopes = [anchor for anchor in anchors if anchor.is_scope]
    before = next(
        (
            scope
            for scope in scopes
            if scope.end <= separator.start() and not text[scope.end : separator.start()].strip()
        ),
        None,
    )
    behind = next(
        (
            scope
            for scope in scopes
            if separator.end() <= scope.start and not text[separator.end() : scope.start].strip()
        ),
        None,
    )
    if before is None or behind is None or ";" in separator[0]:
        return False
    # "A fix at the first point and at the last drop a pin."
    return not (
        re.search(r"[a-z]", text[begin : before.start]) and _GOES_ON.match(text[behind.end :])
    )
