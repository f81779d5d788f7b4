"""How much of a test split is already in the training split: duplicates, near duplicates, and a
retrieval baseline.

Near duplicates are found with MinHash (Broder 1997): signatures of word-pair shingles, compared by
locality-sensitive hashing in bands and verified by their exact Jaccard similarity. The baseline
answers a test prompt with the expected plan of the most similar training prompt (TF-IDF over words
and word pairs, cosine): a model has to be better than that.
"""

from __future__ import annotations

import itertools
import re
import zlib
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from planner_ft.facts.lists import SMALL
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.plans import Level, named_entries

NEAR = 0.8
"""Jaccard similarity of word-pair shingles from which two prompts are near duplicates."""
BANDS, ROWS = 20, 5
PRIME = np.uint64((1 << 61) - 1)
MEMORY_TEST = 0.8
"""Share of exact name sequences from which a split is called a memory test."""

Records = Sequence[Mapping[str, Any]]
Shingles = frozenset[int]


@dataclass(frozen=True)
class Overlap:
    """Between two splits: records of the first whose prompt, as written or masked, (nearly) occurs
    in the second.
    """

    split: str
    other: str
    exact: int
    near: int
    exact_masked: int
    near_masked: int
    families: int
    """Phrasing families of the first split that the second one has too."""
    examples: tuple[tuple[str, str], ...]
    """Ids of up to five near pairs, as written."""


@dataclass(frozen=True)
class Baseline:
    """Nearest-neighbour retrieval from the training split: mean name-set F1, share of exact name
    sequences and of exact plans.
    """

    split: str
    n: int
    f1: float
    sequence: float
    plan: float
    similarity: float
    """Median cosine similarity to the nearest training prompt."""


def leakage_report(
    level: Level,
    splits: Mapping[str, Records],
    progress: Callable[[str], None] = lambda _step: None,
) -> dict[str, Any]:
    """Overlaps between all pairs of splits and the baseline on every split but train, as JSON
    values.
    """
    names = list(splits)
    written = {name: [str(record["prompt"]) for record in splits[name]] for name in names}
    families = {
        name: {record["family"] for record in splits[name] if "family" in record} for name in names
    }
    masked = {name: [mask(text) for text in texts] for name, texts in written.items()}
    progress("near duplicates")
    near, near_masked = _near_pairs(written), _near_pairs(masked)
    overlaps = [
        Overlap(
            split=second,
            other=first,
            exact=_shared(written[second], written[first]),
            near=len(near[second, first]),
            exact_masked=_shared(masked[second], masked[first]),
            near_masked=len(near_masked[second, first]),
            families=len(families[second] & families[first]),
            examples=tuple(
                (str(splits[second][here]["id"]), str(splits[first][there]["id"]))
                for here, there in list(near[second, first].items())[:5]
            ),
        )
        for position, second in enumerate(names)
        for first in names[:position]
    ]
    progress("nearest-neighbour baseline")
    baselines = [
        nearest_neighbour(level, name, splits["train"], splits[name])
        for name in names
        if name != "train"
    ]
    return {
        "level": level,
        "method": {
            "shingles": "word pairs, lower case",
            "minhash": {"permutations": BANDS * ROWS, "bands": BANDS},
            "near": NEAR,
            "masked": "numbers and names replaced by a placeholder",
            "baseline": "most similar training prompt, TF-IDF of words and word pairs, cosine",
        },
        "counts": {name: len(records) for name, records in splits.items()},
        "duplicates_within": {
            name: len(texts) - len(set(texts)) for name, texts in written.items()
        },
        "overlaps": [asdict(overlap) for overlap in overlaps],
        "baseline": [asdict(baseline) for baseline in baselines],
        "memory_test": {baseline.split: baseline.sequence >= MEMORY_TEST for baseline in baselines},
    }


def near_duplicate(prompt: str, records: Records) -> str | None:
    """The id of the first record whose prompt, as written or masked, is that one or nearly so (see
    NEAR); None where none is.
    """
    wanted = [_shingles(text) for text in (prompt, mask(prompt))]
    for record in records:
        text = str(record["prompt"])
        if any(
            jaccard(mine, _shingles(other)) >= NEAR
            for mine, other in zip(wanted, (text, mask(text)), strict=True)
        ):
            return str(record["id"])
    return None


def _input_text(record: Mapping[str, Any]) -> str:
    """What the model is given: at task level the title and the parameters belong to it."""
    if "task" not in record:
        return str(record["prompt"])
    return f"{record['task']} {compact_json(record.get('parameters', {}))} {record['prompt']}"


def _shared(texts: Sequence[str], others: Sequence[str]) -> int:
    known = {text.lower() for text in others}
    return sum(text.lower() in known for text in texts)


# ---------------------------------------------------------------- near duplicates


def _near_pairs(splits: Mapping[str, Sequence[str]]) -> dict[tuple[str, str], dict[int, int]]:
    """For each pair of splits (later, earlier): index of a text to the index of its most similar
    near duplicate.
    """
    shingles = {name: [_shingles(text) for text in texts] for name, texts in splits.items()}
    signatures = {name: _band_keys(sets) for name, sets in shingles.items()}
    names = list(splits)
    return {
        (second, first): _matches(
            shingles[second], signatures[second], shingles[first], signatures[first]
        )
        for position, second in enumerate(names)
        for first in names[:position]
    }


def _shingles(text: str) -> Shingles:
    words = shingle_words(text)
    return frozenset(
        zlib.crc32(f"{first} {second}".encode())
        for first, second in zip(["^", *words], [*words, "$"], strict=True)
    )


def _band_keys(sets: Sequence[Shingles]) -> npt.NDArray[np.uint64]:
    """MinHash signatures folded into one key per band: (texts, bands)."""
    if not sets:
        return np.zeros((0, BANDS), np.uint64)
    unique, inverse = np.unique(
        np.fromiter((item for items in sets for item in items), np.uint64), return_inverse=True
    )
    starts = np.cumsum([0, *(len(items) for items in sets[:-1])])
    random = np.random.default_rng(0x5EED)
    factors, offsets = random.integers(1, 1 << 31, (2, BANDS * ROWS), dtype=np.uint64)
    signature = np.empty((len(sets), BANDS * ROWS), np.uint64)
    for column in range(BANDS * ROWS):
        hashed = (unique * factors[column] + offsets[column]) % PRIME
        signature[:, column] = np.minimum.reduceat(hashed[inverse], starts)
    keys = np.zeros((len(sets), BANDS), np.uint64)
    for row in range(ROWS):
        keys = keys * np.uint64(0x9E3779B97F4A7C15) + signature[:, row::ROWS]
    return keys


def _matches(
    sets: Sequence[Shingles],
    keys: npt.NDArray[np.uint64],
    other_sets: Sequence[Shingles],
    other_keys: npt.NDArray[np.uint64],
) -> dict[int, int]:
    buckets: list[dict[int, list[int]]] = [{} for _ in range(BANDS)]
    distinct: dict[Shingles, int] = {}
    for index, row in enumerate(other_keys.tolist()):
        if distinct.setdefault(other_sets[index], index) != index:
            continue
        for band, key in enumerate(row):
            buckets[band].setdefault(key, []).append(index)
    found = {}
    for index, row in enumerate(keys.tolist()):
        candidates = sorted(
            {other for band, key in enumerate(row) for other in buckets[band].get(key, ())}
        )
        best = max(
            ((jaccard(sets[index], other_sets[other]), -other) for other in candidates),
            default=(0.0, 0),
        )
        if best[0] >= NEAR:
            found[index] = -best[1]
    return found


def jaccard(first: Shingles, second: Shingles) -> float:
    """Size of the intersection over size of the union."""
    shared = len(first & second)
    return shared / (len(first) + len(second) - shared)


# ---------------------------------------------------------------- retrieval


def nearest_neighbour(level: Level, split: str, train: Records, test: Records) -> Baseline:
    """Score the expected plan of the most similar training prompt as the answer to each test
    prompt.
    """
    neighbours, similarities = _nearest(
        [_terms(record) for record in train], [_terms(record) for record in test]
    )
    scores = []
    for record, neighbour in zip(test, neighbours, strict=True):
        expected, answer = (
            list(named_entries(level, item["expected"])) for item in (record, train[neighbour])
        )
        names, answered = [name for name, _ in expected], [name for name, _ in answer]
        scores.append(
            (set_f1(answered, names), float(names == answered), float(expected == answer))
        )
    f1, sequence, plan = (
        (round(float(mean), 4) for mean in np.mean(scores, axis=0)) if scores else (0.0, 0.0, 0.0)
    )
    return Baseline(
        split,
        len(test),
        f1,
        sequence,
        plan,
        round(float(np.median(similarities)), 4) if similarities else 0.0,
    )


def set_f1(answered: Sequence[str], expected: Sequence[str]) -> float:
    """F1 of two sets of names; two empty sets agree."""
    shared = len(set(answered) & set(expected))
    return 2 * shared / (len(set(answered)) + len(set(expected))) if answered or expected else 1.0


def _terms(record: Mapping[str, Any]) -> Counter[str]:
    words = shingle_words(_input_text(record))
    return Counter([*words, *(f"{first} {second}" for first, second in itertools.pairwise(words))])


def _nearest(
    documents: Sequence[Counter[str]], queries: Sequence[Counter[str]]
) -> tuple[list[int], list[float]]:
    """Index and cosine similarity of the nearest document for each query; the first one where
    several are as near.
    """
    postings: dict[str, list[int]] = {}
    counts: dict[str, list[int]] = {}
    for index, document in enumerate(documents):
        for term, count in document.items():
            postings.setdefault(term, []).append(index)
            counts.setdefault(term, []).append(count)
    rarity = {
        term: np.log((1 + len(documents)) / (1 + len(found))) + 1
        for term, found in postings.items()
    }
    weights = {
        term: (np.array(found), np.array(counts[term]) * rarity[term])
        for term, found in postings.items()
    }
    norms = np.zeros(len(documents))
    for found, weight in weights.values():
        norms[found] += weight**2
    norms = np.sqrt(np.maximum(norms, 1e-12))
    unknown = np.log(1 + len(documents)) + 1
    neighbours, similarities = [], []
    for query in queries:
        scores = np.zeros(len(documents))
        length = 0.0
        for term, count in query.items():
            weight = count * rarity.get(term, unknown)
            length += weight**2
            if term in weights:
                found, of_documents = weights[term]
                scores[found] += weight * of_documents
        scores /= norms * np.sqrt(max(length, 1e-12))
        # Rounded, so that the choice among equals does not depend on the order of summation.
        best = int(np.argmax(scores.round(9)))
        neighbours.append(best)
        similarities.append(float(scores[best]))
    return neighbours, similarities


# ---------------------------------------------------------------- phrasings of a text

NUMBER, NAME = "#", "@"
_NUMBER_WORDS = frozenset(
    [
        *(word for word in SMALL if word not in ("oh", "couple")),
        "hundred",
        "thousand",
        "half",
        "quarter",
    ]
)
_SHINGLE = re.compile(r"[#@]|-?\d+(?:\.\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)?")
_CODE = re.compile(r"\b(?=\w*\d)(?=\w*[A-Za-z])[\w-]+\b")
_NAME = re.compile(r"(?<![.!?:;]\s)(?<!^)(?<![\w\"])[A-Z][\w'’-]*(?:\s+(?:[A-Z][\w'’-]*|#))*")
_NUMBER = re.compile(r"-?\d+(?:[.,]\d+)*")


def shingle_words(text: str) -> list[str]:
    """Words and numbers of a text in lower case, a sign kept with its number."""
    return _SHINGLE.findall(text.lower())


def mask(text: str) -> str:
    """The text with its numbers, in figures or words, and its names replaced: what is left is the
    phrasing.

    Names are capitalised words inside a sentence and codes of letters and digits; runs of numbers
    become one.
    """
    text = _NAME.sub(NAME, _NUMBER.sub(NUMBER, _CODE.sub(NAME, text)))
    masked = [
        NUMBER if word.lower() in _NUMBER_WORDS else word
        for word in re.findall(r"[#@]|[^\W_]+(?:['’][^\W_]+)*", text)
    ]
    return " ".join(
        word
        for index, word in enumerate(masked)
        if index == 0 or word not in (NUMBER, NAME) or word != masked[index - 1]
    )
