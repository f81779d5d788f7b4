"""The most similar text: TF-IDF over words, pairs of words and characters within words, cosine
similarity.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Sequence
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
    """Texts to look up. Weights are those of Salton and Buckley 1988 with smoothed idf: tf (ln((1 +
    n) / (1 + df)) + 1), of length 1.
    """

    def __init__(self, texts: Sequence[str]) -> None:
        self.ids: dict[str, int] = {}
        self.words: dict[str, list[int]] = {}
        counts = self._counts([self._features(text, grow=True) for text in texts])
        documents = np.bincount(counts.indices, minlength=len(self.ids))
        self.idf = np.log((1 + len(texts)) / (1 + documents)) + 1
        self.matrix = self._weighted(counts)

    def nearest(self, texts: Sequence[str]) -> list[tuple[int, float]]:
        """For each text the index of the most similar one, the first of those that are equally
        similar, and the similarity, 0 to 1.
        """
        queries = self._weighted(self._counts([self._features(text, grow=False) for text in texts]))
        found: list[tuple[int, float]] = []
        for start in range(0, len(texts), ROWS):
            # Rounded, because equal texts may differ in their last bit.
            similarity: NDArray[np.float64] = (
                (queries[start : start + ROWS] @ self.matrix.T).toarray().round(9)
            )
            best = similarity.argmax(1)
            found += [
                (int(index), float(row[index])) for index, row in zip(best, similarity, strict=True)
            ]
        return found

    def _features(self, text: str, *, grow: bool) -> list[int]:
        """The ids of its words in lower case, of their characters, and of pairs of words; those not
        known yet are added with `grow`, else left out.
        """
        words = TOKEN.findall(text.lower())
        found = [feature for word in words for feature in self._of_word(word, grow=grow)]
        return found + self._known(
            (f"{one} {other}" for one, other in itertools.pairwise(words)), grow=grow
        )

    def _of_word(self, word: str, *, grow: bool) -> list[int]:
        if word not in self.words:
            padded = f"<{word}>"
            pieces = [
                padded[start : start + length]
                for length in CHARACTERS
                for start in range(len(padded) - length + 1)
            ]
            self.words[word] = self._known([word, *pieces], grow=grow)
        return self.words[word]

    def _known(self, features: Iterable[str], *, grow: bool) -> list[int]:
        if grow:
            return [self.ids.setdefault(feature, len(self.ids)) for feature in features]
        return [self.ids[feature] for feature in features if feature in self.ids]

    def _counts(self, rows: Sequence[Sequence[int]]) -> csr_array:
        from scipy.sparse import csr_array

        columns = np.fromiter(itertools.chain.from_iterable(rows), dtype=np.int64)
        ends = np.cumsum([0, *map(len, rows)])
        counts = csr_array((np.ones(len(columns)), columns, ends), shape=(len(rows), len(self.ids)))
        counts.sum_duplicates()
        return counts

    def _weighted(self, counts: csr_array) -> csr_array:
        """Counts times idf, each row of length 1."""
        from scipy.sparse import csr_array

        values = counts.data * self.idf[counts.indices]
        rows = np.repeat(np.arange(counts.shape[0]), np.diff(counts.indptr))
        lengths = np.sqrt(np.bincount(rows, values**2, minlength=counts.shape[0]))[rows]
        return csr_array((values / lengths, counts.indices, counts.indptr), shape=counts.shape)
