"""The words that commands are known to use, and what a word that is none of them can be a
misspelling of.

They are gathered from the package's own lists and phrases: lexicon modules, command and prompt
templates, vocabulary files, and things.txt, which names things and how they look beside those that
the generator draws. A word that none of them has is a name, or misspelt.
"""

from __future__ import annotations

import functools
import re
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planner_ft.data.numerals import FRACTIONS, SCALES, SMALL, UNITS
from planner_ft.data.words import edit_distance
from planner_ft.vocabulary.definition import BUNDLED, UNHASHED

_WORD = re.compile(r"[^\W\d_]{2,}")
MISSPELT = "# misspelt"
"""The first line of a template file whose words can be misspelt on purpose, so that none of them is
known by it.
"""
_ENDINGS = ("'s", "s", "es", "ed", "d", "ing", "ly", "er")


def is_known(word: str) -> bool:
    """Whether a word, or the word without a usual ending, is in the lists."""
    lowered = word.lower()
    known = known_words()
    return lowered in known or any(
        lowered.endswith(ending) and lowered.removesuffix(ending) in known for ending in _ENDINGS
    )


@functools.lru_cache(maxsize=4096)
def corrections(word: str, most: int = 6) -> tuple[str, ...]:
    """Known words that `word` can be a misspelling or a shortening of, the nearest first; none for
    a known word.

    Words up to five letters may differ by one edit, longer ones by two, and so may those of five
    that nothing else is near and that begin alike; neighbouring letters that are swapped are one
    edit. A word without vowels is also the consonants of another: "thrml" is thermal.
    """
    lowered = word.lower()
    if len(lowered) < 3 or lowered in known_words():
        return ()
    found = sorted(
        [
            *_misspelt(lowered, 1 if len(lowered) < 6 else 2),
            *(_shortened(lowered) if not set(lowered) & set("aeiou") else ()),
        ]
    )
    if not found and len(lowered) == 5:
        found = sorted(item for item in _misspelt(lowered, 2) if item[2][0] == lowered[0])
    return tuple(dict.fromkeys(candidate for _distance, _count, candidate in found))[:most]


def _misspelt(word: str, limit: int) -> Iterator[tuple[int, int, str]]:
    """(edits, -frequency, known word) of the known words of three letters or more that `limit`
    edits make of `word`.
    """
    letters = _letters(word)
    for length in range(max(3, len(word) - limit), len(word) + limit + 1):
        for candidate, others in _by_length().get(length, ()):
            # Every edit changes two letters of the sets at most.
            if (letters ^ others).bit_count() <= 2 * limit:
                distance = edit_distance(word, candidate, limit)
                if distance <= limit:
                    yield distance, -known_words()[candidate], candidate


def _shortened(word: str) -> Iterator[tuple[int, int, str]]:
    """The known words that have the letters of `word` in this order, the first one first, and at
    most as many others.
    """
    for length in range(len(word) + 1, 2 * len(word) + 1):
        for candidate, _letters_of in _by_length().get(length, ()):
            rest = iter(candidate)
            if candidate[0] == word[0] and all(letter in rest for letter in word):
                yield 1, -known_words()[candidate], candidate


@functools.cache
def known_words() -> dict[str, int]:
    """Every known word in lower case, with how often the lists have it."""
    counts: Counter[str] = Counter()
    # What stands once in the templates can be misspelt there on purpose.
    templates = (
        path.read_text(encoding="utf-8") for path in sorted(Path(__file__).parent.rglob("*.txt"))
    )
    counts.update(
        word for text in templates if not text.startswith(MISSPELT) for word in _words(text)
    )
    known = Counter({word: count for word, count in counts.items() if count > 1})
    known.update(_words((Path(__file__).parent / "things.txt").read_text(encoding="utf-8")))
    for path in sorted(path for path in BUNDLED.glob("*.toml") if not path.name.endswith(UNHASHED)):
        known.update(_words(path.read_text(encoding="utf-8")))
    known.update(word for text in _texts(_lexicon()) for word in _words(text))
    known.update([*UNITS, *SMALL, *SCALES, *FRACTIONS])
    return dict(known)


def _lexicon() -> dict[str, Any]:
    from planner_ft.data.mission.synthetic import lexicon

    return {name: getattr(lexicon, name) for name in lexicon.__all__}


def _texts(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        yield from _texts([*value.keys(), *value.values()])
    elif isinstance(value, list | tuple | set | frozenset):
        for item in value:
            yield from _texts(item)


def _words(text: str) -> list[str]:
    return _WORD.findall(text.lower())


@functools.cache
def _by_length() -> dict[int, list[tuple[str, int]]]:
    lengths = defaultdict(list)
    for word in known_words():
        lengths[len(word)].append((word, _letters(word)))
    return lengths


def _letters(word: str) -> int:
    """The set of letters of a word, as bits."""
    bits = 0
    for letter in word:
        bits |= 1 << (ord(letter) & 31)
    return bits
