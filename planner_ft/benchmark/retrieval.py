"""The most similar text: TF-IDF over words, pairs of words and characters within words, cosine
similarity.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Sequence

TOKEN = re.compile(r"\w+|[^\w\s]")
CHARACTERS = (3, 4, 5)
"""Lengths of the pieces of a word, its borders included."""
ROWS = 256
"""Queries that are compared at a time."""


class Index:
    """Texts to look up. Weights are those of Salton and Buckley 1988 with smoothed idf."""

    def __init__(self, texts: Sequence[str]) -> None:
        from sklearn.feature_extraction.text import TfidfVectorizer

        self.vectorizer = TfidfVectorizer(analyzer=_features)
        self.matrix = self.vectorizer.fit_transform(texts)

    def nearest(self, texts: Sequence[str]) -> list[tuple[int, float]]:
        """For each text the index of the most similar one, the first of those that are equally
        similar, and the similarity, 0 to 1.
        """
        queries = self.vectorizer.transform(texts)
        found: list[tuple[int, float]] = []
        for start in range(0, len(texts), ROWS):
            # Rounded, because equal texts may differ in their last bit.
            similarity = (queries[start : start + ROWS] @ self.matrix.T).toarray().round(9)
            best = similarity.argmax(1).tolist()
            found += zip(best, similarity.max(1).tolist(), strict=True)
        return found


def _features(text: str) -> list[str]:
    words = TOKEN.findall(text.lower())
    pairs = (f"{one} {other}" for one, other in itertools.pairwise(words))
    return [*itertools.chain.from_iterable(map(_pieces, words)), *pairs]


@functools.lru_cache(maxsize=65_536)
def _pieces(word: str) -> tuple[str, ...]:
    padded = f"<{word}>"
    pieces = (
        padded[start : start + length]
        for length in CHARACTERS
        for start in range(len(padded) - length + 1)
    )
    return (word, *pieces)
