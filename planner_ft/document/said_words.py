"""The words of a command, found by what they say: texts of a plan, word by word."""

from __future__ import annotations

import bisect
import functools
import re
from collections import defaultdict

from planner_ft.benchmark.metrics.values import normalised
from planner_ft.data.lexicon import is_known
from planner_ft.data.words import says, words

Span = tuple[int, int]
FARTHEST = 120
"""Characters between the words of one text value."""
MOST_PLACES = 100
"""Places of a word that are looked at."""
FEW_WORDS = 400
"""Different words up to which each can be a misspelling of another; of more, only those that are
not known.
"""
_WORD = re.compile(r"[^\W_]+(?:[-'’.][^\W_]+)*")


class WordIndex:
    """The words of a command by every form that `planner_ft.data.words.says` takes for the same."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._lower = text.lower()
        self._spans: dict[str, list[Span]] = defaultdict(list)
        for match in _WORD.finditer(text):
            word = match[0].lower().replace("’", "'")
            for form in {
                word,
                word.removesuffix("'s"),
                word.rstrip("'"),
                *re.split(r"[-'.]", word),
            }:
                self._spans[form].append(match.span())

    def states(self, text: str) -> bool:
        """Whether every word of a text is said, put right where it is misspelt."""
        return all(self.places(word) for word in words(text))

    def spans(self, text: str) -> list[tuple[Span, ...]]:
        """The places of a text: where it stands word for word, else its words near each other; none
        where half of them are not said.
        """
        whole = self._whole(normalised(text))
        if whole:
            return [(span,) for span in whole]
        options = [self.places(word) for word in words(text)]
        found = [places for places in options if places]
        return [self._joined(_nearest(found))] if found and 2 * len(found) >= len(options) else []

    def places(self, word: str) -> list[Span]:
        """Where a word is said, at most MOST_PLACES of them."""
        return self._exact(word) or self._misspelt(word)

    def _exact(self, word: str) -> list[Span]:
        forms = (word, f"{word}s", word.removesuffix("s"))
        found = [
            span
            for form in dict.fromkeys(forms)
            if form in self._spans
            for span in self._spans[form][:MOST_PLACES]
        ]
        parts = re.split(r"[-.]", word) if "-" in word else []
        if not found and parts and all(part in self._spans for part in parts):
            found = [span for part in parts for span in self._spans[part][:MOST_PLACES]]
        return sorted(found)[:MOST_PLACES]

    @functools.cached_property
    def _uncertain(self) -> list[str]:
        return (
            list(self._spans)
            if len(self._spans) <= FEW_WORDS
            else [word for word in self._spans if not is_known(word)]
        )

    def _misspelt(self, word: str) -> list[Span]:
        if word not in self._corrected:
            self._corrected[word] = sorted(
                span
                for other in self._uncertain
                if other and not says(other, word, misspelt=True)
                for span in self._spans[other]
            )
        return self._corrected[word][:MOST_PLACES]

    @functools.cached_property
    def _corrected(self) -> dict[str, list[Span]]:
        return {}

    def _whole(self, wanted: str) -> list[Span]:
        found: list[Span] = []
        start = self._lower.find(wanted) if wanted and len(self._lower) == len(self.text) else -1
        while start >= 0 and len(found) < MOST_PLACES:
            end = start + len(wanted)
            if not (
                self._lower[start - 1 : start].isalnum() or self._lower[end : end + 1].isalnum()
            ):
                found.append((start, end))
            start = self._lower.find(wanted, end)
        return found

    def _joined(self, spans: list[Span]) -> tuple[Span, ...]:
        """Spans in order; those with nothing but blanks between them as one."""
        joined: list[Span] = []
        for start, end in sorted(set(spans)):
            if joined and not self.text[joined[-1][1] : start].strip():
                joined[-1] = (joined[-1][0], end)
            else:
                joined.append((start, end))
        return tuple(joined)


def _nearest(options: list[list[Span]]) -> list[Span]:
    """One place per word so that they stand near each other: all near one of the last word, mostly
    a noun.
    """
    best: list[Span] = []
    for anchor in options[-1]:
        chosen = [_near(places, anchor) for places in options]
        if not best or _width(chosen) < _width(best):
            best = chosen
    return [span for span in best if abs(span[0] - best[-1][0]) <= FARTHEST]


def _near(places: list[Span], anchor: Span) -> Span:
    index = bisect.bisect_left(places, anchor)
    return min(places[max(0, index - 1) : index + 1], key=lambda span: abs(span[0] - anchor[0]))


def _width(spans: list[Span]) -> int:
    return max(end for _start, end in spans) - min(start for start, _end in spans)
