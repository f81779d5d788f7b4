"""How much of a test split is already in the training split: duplicates, near duplicates, and a
retrieval baseline.

Near duplicates are prompts whose word-pair shingles have a Jaccard similarity of NEAR or more. The
baseline answers a test prompt with the expected plan of the most similar training prompt (TF-IDF
over words and word pairs, cosine): a model has to be better than that.
"""

import functools
import itertools
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from planner_ft.facts.words import SMALL
from planner_ft.support.files import compact_json, sha256_text
from planner_ft.vocabulary.plans import Level, named_entries

NEAR = 0.8
"""Jaccard similarity of word-pair shingles from which two prompts are near duplicates."""
MEMORY_TEST = 0.8
"""Share of exact name sequences from which a split is called a memory test."""
ROWS = 256
"""Prompts that are compared at a time."""

METHOD = {
    "shingles": "word pairs, lower case",
    "near": NEAR,
    "masked": "numbers and names replaced by a placeholder",
    "baseline": "most similar training prompt, TF-IDF of words and word pairs, cosine",
}

Records = Sequence[Mapping[str, Any]]
Shingles = frozenset[tuple[str, str]]
Matrix = Any
"""A sparse matrix of scipy, in rows (scipy has no types)."""


def leakage_report(
    level: Level,
    splits: Mapping[str, Records],
    progress: Callable[[str], None] = lambda _step: None,
) -> dict[str, Any]:
    """Overlaps between all pairs of splits and the baseline on every split but train, as JSON
    values.

    An overlap counts the records of `split` whose prompt, as written or masked, occurs in `other`,
    exactly or nearly, the phrasing families that both have, and the ids of up to five near pairs.
    """
    written = {name: [str(record["prompt"]) for record in splits[name]] for name in splits}
    same = {name: [*zip(*map(forms, texts), strict=True)] for name, texts in written.items()}
    families = {
        name: {record["family"] for record in records if "family" in record}
        for name, records in splits.items()
    }
    progress("near duplicates")
    near = near_pairs(written)
    near_masked = near_pairs({name: masked for name, (_exact, masked) in same.items()})
    overlaps = []
    for (second, first), pairs in near.items():
        places = itertools.islice(pairs.items(), 5)
        exact, exact_masked = map(_shared, same[second], same[first])
        overlap = {
            "split": second,
            "other": first,
            "exact": exact,
            "near": len(pairs),
            "exact_masked": exact_masked,
            "near_masked": len(near_masked[second, first]),
            "families": len(families[second] & families[first]),
            "examples": [
                (str(splits[second][here]["id"]), str(splits[first][there]["id"]))
                for here, there in places
            ],
        }
        overlaps.append(overlap)
    progress("nearest-neighbour baseline")
    others = ((name, records) for name, records in splits.items() if name != "train")
    baselines = [nearest_neighbour(level, name, splits["train"], other) for name, other in others]
    return {
        "level": level,
        "method": METHOD,
        "counts": {name: len(records) for name, records in splits.items()},
        "duplicates_within": {name: len(of) - len(set(of)) for name, of in written.items()},
        "overlaps": overlaps,
        "baseline": baselines,
        "memory_test": {item["split"]: item["sequence"] >= MEMORY_TEST for item in baselines},
    }


def near_duplicate(prompt: str, records: Records) -> str | None:
    """The id of the first record whose prompt, or its phrasing, is (nearly) that one; or None."""
    wanted = [_shingles(text) for text in (prompt, mask(prompt))]
    for record in records:
        text = str(record["prompt"])
        for one, other in zip(wanted, map(_shingles, (text, mask(text))), strict=True):
            if len(one & other) >= NEAR * len(one | other):
                return str(record["id"])
    return None


def input_digest(text: str) -> str:
    """What two inputs share that say the same: a digest of their words and numbers."""
    return sha256_text(" ".join(shingle_words(text)))[:16]


def forms(prompt: str) -> tuple[str, str]:
    """The text and its phrasing: a prompt that has either of them from another is its duplicate."""
    return prompt.lower(), mask(prompt).lower()


def _shared(texts: Sequence[str], others: Sequence[str]) -> int:
    known = set(others)
    return sum(text in known for text in texts)


@functools.lru_cache(maxsize=1 << 15)
def _shingles(text: str) -> Shingles:
    return frozenset(itertools.pairwise(["^", *shingle_words(text), "$"]))


def _most_similar(
    queries: Matrix, documents: Matrix, sizes: Sequence[Any] = ()
) -> Iterator[tuple[int, float]]:
    """For each query the place of the most similar document, the first of equals, and how similar
    it is: by their product or, with the sizes of the sets that both are, by Jaccard.
    """
    for start in range(0, queries.shape[0], ROWS):
        rows = slice(start, start + ROWS)
        similar = (queries[rows] @ documents.T).toarray()
        if sizes:
            similar = similar / (sizes[0][rows, None] + sizes[1] - similar)
        # Rounded, so that the choice among equals does not depend on the order of summation.
        similar = np.round(similar, 9)
        yield from zip(similar.argmax(1).tolist(), similar.max(1).tolist(), strict=True)


def near_pairs(splits: Mapping[str, Sequence[str]]) -> dict[tuple[str, str], dict[int, int]]:
    """By (later split, earlier one): a text's place to that of its most similar near duplicate."""
    from sklearn.feature_extraction.text import CountVectorizer

    counter: Any = CountVectorizer(analyzer=_shingles)
    counter.fit(itertools.chain(*splits.values()))
    sets = {name: counter.transform(texts) for name, texts in splits.items()}
    found: dict[tuple[str, str], dict[int, int]] = {}
    for second, first in ((b, a) for place, b in enumerate(splits) for a in [*splits][:place]):
        sizes = [np.diff(sets[name].indptr) for name in (second, first)]
        near = enumerate(_most_similar(sets[second], sets[first], sizes))
        found[second, first] = {here: there for here, (there, like) in near if like >= NEAR}
    return found


def nearest_neighbour(level: Level, split: str, train: Records, test: Records) -> dict[str, Any]:
    """Score the expected plan of the most similar training prompt as the answer to each test
    prompt: mean F1 of the name sets, shares of exact name sequences and of exact plans, and the
    median cosine similarity to that prompt.
    """
    from sklearn.feature_extraction.text import TfidfVectorizer

    weights: Any = TfidfVectorizer(analyzer=_terms)
    documents = weights.fit_transform(train)
    found = list(_most_similar(weights.transform(test), documents))
    scores = []
    for record, (neighbour, _similarity) in zip(test, found, strict=True):
        expected, answer = (
            list(named_entries(level, item["expected"])) for item in (record, train[neighbour])
        )
        names, answered = [name for name, _ in expected], [name for name, _ in answer]
        scores.append((set_f1(answered, names), names == answered, expected == answer))
    f1, sequence, plan = (round(float(mean), 4) for mean in np.mean(scores, axis=0))
    median = round(float(np.median([similarity for _best, similarity in found])), 4)
    figures = {"f1": f1, "sequence": sequence, "plan": plan, "similarity": median}
    return {"split": split, "n": len(test), **figures}


def set_f1(answered: Sequence[str], expected: Sequence[str]) -> float:
    """F1 of two sets of names; two empty sets agree."""
    shared = len(set(answered) & set(expected))
    return 2 * shared / (len(set(answered)) + len(set(expected))) if answered or expected else 1.0


def _terms(record: Mapping[str, Any]) -> list[str]:
    """Words and word pairs of what the model is given, at task level with title and parameters."""
    text = str(record["prompt"])
    if "task" in record:
        text = f"{record['task']} {compact_json(record.get('parameters', {}))} {text}"
    words = shingle_words(text)
    return [*words, *(f"{first} {second}" for first, second in itertools.pairwise(words))]


# ---------------------------------------------------------------- words of a prompt

NUMBER, NAME = "#", "@"
_NUMBER_WORDS = {*SMALL, "hundred", "thousand", "half", "quarter"} - {"oh", "couple"}
_SHINGLE = re.compile(r"[#@]|-?\d+(?:\.\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)?")
_CODE = re.compile(r"\b(?=[^\W\d]*+\d)(?=\w*[A-Za-z])[\w-]+\b")
_NAME = re.compile(r"(?<![.!?:;]\s)(?<!^)(?<![\w\"])[A-Z][\w'’-]*(?:\s+(?:[A-Z][\w'’-]*|#))*")
_NUMBER = re.compile(r"-?\d+(?:[.,]\d+)*")


def shingle_words(text: str) -> list[str]:
    """Words and numbers of a text in lower case, a sign kept with its number."""
    return _SHINGLE.findall(text.lower())


@functools.lru_cache(maxsize=1 << 15)
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
