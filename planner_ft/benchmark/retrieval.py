"""The most similar text: TF-IDF over words, pairs of words and characters within words, cosine similarity."""

from __future__ import annotations

import functools
import itertools
import math
import re
from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from scipy.sparse import csr_array

TOKEN = re.compile(r"\w+|[^\w\s]")
CHARACTERS = (3, 4, 5)
"""Lengths of the pieces of a word, its borders included."""
ROWS = 256
"""Queries that are compared at a time."""


class Index:
    """Texts to look up. Weights are those of Salton and Buckley 1988 with smoothed idf: tf (ln((1 + n) / (1 + df)) + 1), of length 1."""

    def __init__(self, texts: Sequence[str]) -> None:
        counts = [Counter(features(text)) for text in texts]
        self.ids = {feature: index for index, feature in enumerate(dict.fromkeys(feature for count in counts for feature in count))}
        documents = Counter(feature for count in counts for feature in count)
        self.idf = np.array([math.log((1 + len(texts)) / (1 + documents[feature])) + 1 for feature in self.ids])
        self.matrix = self._rows(counts)

    def nearest(self, texts: Sequence[str]) -> list[tuple[int, float]]:
        """For each text the index of the most similar one, the first of those that are equally similar, and the similarity, 0 to 1."""
        queries = self._rows([Counter(features(text)) for text in texts])
        found: list[tuple[int, float]] = []
        for start in range(0, len(texts), ROWS):
            # Rounded, because equal texts may differ in their last bit.
            similarity: NDArray[np.float64] = (queries[start : start + ROWS] @ self.matrix.T).toarray().round(9)
            best = similarity.argmax(1)
            found += [(int(index), float(row[index])) for index, row in zip(best, similarity, strict=True)]
        return found

    def _rows(self, counts: Sequence[Counter[str]]) -> csr_array:
        from scipy.sparse import csr_array

        known = [[(self.ids[feature], count) for feature, count in row.items() if feature in self.ids] for row in counts]
        ends = np.cumsum([0, *(len(row) for row in known)])
        columns = np.array([column for row in known for column, _count in row], dtype=np.int64)
        values = np.array([count for row in known for _column, count in row], dtype=float) * (self.idf[columns] if len(columns) else 1)
        rows = np.repeat(np.arange(len(counts)), np.diff(ends))
        lengths = np.sqrt(np.bincount(rows, values**2, minlength=len(counts)))[rows]
        return csr_array((values / lengths, columns, ends), shape=(len(counts), len(self.ids)))


def features(text: str) -> list[str]:
    """What a text is compared by: its words in lower case, their pairs, and the characters of each."""
    words = TOKEN.findall(text.lower())
    return [*(feature for word in words for feature in _of_word(word)), *(f"{one} {other}" for one, other in itertools.pairwise(words))]


@functools.lru_cache(maxsize=100_000)
def _of_word(word: str) -> tuple[str, ...]:
    padded = f"<{word}>"
    return (word, *(padded[start : start + length] for length in CHARACTERS for start in range(len(padded) - length + 1)))
