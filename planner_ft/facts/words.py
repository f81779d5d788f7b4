"""Words of a text: how near one is to another, which are known, and where a phrase is said; the
word lists of english.toml.

`known_words.txt` is a frozen list of the words that commands use, with how often the templates have
them (scripts/freeze_words.py wrote it). A word that it lacks is a name, or misspelt.
"""

import bisect
import functools
import re
import tomllib
from collections import defaultdict
from pathlib import Path
from typing import NamedTuple

from rapidfuzz import process
from rapidfuzz.distance import OSA

FOLDER = Path(__file__).parent
_ENGLISH = tomllib.loads((FOLDER / "english.toml").read_text(encoding="utf-8"))
_NUMERALS = _ENGLISH["numerals"]


class Unit(NamedTuple):
    """A unit: what one of it is in the base unit, and what is added to that (degrees)."""

    base: str
    factor: float
    added: float = 0.0

    def in_base(self, value: float) -> float:
        return value * self.factor + self.added

    def of_base(self, value: float) -> float:
        return (value - self.added) / self.factor


UNITS: dict[str, Unit] = {
    word: Unit(row["unit"], float(factor))
    for row in _ENGLISH["units"]
    for factor, words in row["words"].items()
    for word in words.split()
}
"""Word to the unit that parameters have and the factor to it."""
SPOKEN = (None, *dict.fromkeys(unit.base for unit in UNITS.values()))
"""Their bases. Beside these, a letter behind a number is no unit, and "a bar" is none."""

SMALL: dict[str, float] = {
    **{word: float(value) for value, word in enumerate(_NUMERALS["ones"].split())},
    **{word: 10.0 * value for value, word in enumerate(_NUMERALS["tens"].split(), 2)},
    **{word: float(value) for word, value in _NUMERALS["others"].items()},
}
DIGITS = {word: str(int(value)) for word, value in SMALL.items() if value < 10 and word != "couple"}
SCALES: dict[str, float] = _NUMERALS["scales"]
FRACTIONS: dict[str, float] = _NUMERALS["fractions"]
PARTS = {**FRACTIONS, "quarters": 0.25, "thirds": 1 / 3}
ORDINALS = {
    form: 1 / value
    for value, word in [
        *enumerate(_NUMERALS["ordinals"].split(), 5),
        *((3, "third"), (20, "twentieth")),
    ]
    for form in (word, f"{word}s")
}
"""Parts of a unit: "a tenth of an hour". Elsewhere these words count steps."""
VULGAR: dict[str, float] = _NUMERALS["vulgar"]
PRONOUNCED: dict[str, str] = _NUMERALS["pronounced"]
TURNS = {word: float(value) for value, words in _ENGLISH["turns"].items() for word in words.split()}
"""Words for a part or a number of full circles."""
COMPASS = tuple(_ENGLISH["compass"]["names"].split())
SHORT = tuple(_ENGLISH["compass"]["short"].split())
"""Compass points in steps of 22.5 degrees from north."""
_SHORT = {short: name for short, name in zip(SHORT, COMPASS, strict=True) if len(short) < 3}
WORDS = {name: tuple(words.split()) for name, words in _ENGLISH["words"].items()}
TIMES: dict[str, float] = _ENGLISH["times"]  # words for how often
MULTIPLES: dict[str, float] = _ENGLISH["multiples"]
"""Words for a time or length by another one: "hold twice as long", "half the distance"."""

Span = tuple[int, int]
FARTHEST = 120  # characters between the words of one phrase
MOST_PLACES = 100  # places of a word that are looked at
FEW_WORDS = 400
"""Different words of a text up to which each can be a misspelling; of more, only unknown ones."""
ENDINGS = ("'s", "s", "es", "ed", "d", "ing", "ly", "er")
_WORD = re.compile(r"[^\W_]+(?:[-'’.][^\W_]+)*")
_INNER = re.compile(r"[-'.]")


def words(text: str) -> list[str]:
    """The words of a text in lower case; hyphens, apostrophes and dots inside a word are kept."""
    return [word.lower().replace("’", "'") for word in _WORD.findall(text)]


def normalised(text: str) -> str:
    """A text in lower case, with single spaces and without a leading article."""
    first, *rest = text.casefold().split() or [""]
    return " ".join(rest if first in ("the", "a", "an") and rest else [first, *rest])


def edit_distance(first: str, second: str, limit: int) -> int:
    """Levenshtein distance with transpositions of neighbours, or `limit` + 1 where it is larger."""
    return OSA.distance(first, second, score_cutoff=limit)


@functools.cache
def known_words() -> dict[str, int]:
    """Every known word in lower case, with how often the templates have it."""
    lines = (FOLDER / "known_words.txt").read_text(encoding="utf-8").splitlines()
    return {word: int(count) for word, count in (line.rsplit(" ", 1) for line in lines)}


@functools.lru_cache(maxsize=8192)
def is_known(word: str) -> bool:
    """Whether a word, or the word without a usual ending, is in the list."""
    known, lowered = known_words(), word.lower()
    stems = (lowered.removesuffix(end) for end in ENDINGS if lowered.endswith(end))
    return lowered in known or any(stem in known for stem in stems)


def unknown_words(text: str) -> tuple[list[str], float]:
    """The words of two letters and more that are not known, and their share of all such words."""
    found = [word for word in words(text) if len(word) > 1 and not any(map(str.isdigit, word))]
    unknown = [word for word in found if not all(map(is_known, _INNER.split(word)))]
    return unknown, len(unknown) / max(len(found), 1)


@functools.lru_cache(maxsize=8192)
def corrections(word: str, most: int = 6) -> tuple[str, ...]:
    """Known words that `word` can be a misspelling or a shortening of, the nearest first; none for
    a known word.

    Words up to five letters may differ by one edit, longer ones by two, and so may those of five
    that nothing else is near and that begin alike. A word without vowels is also the consonants of
    another: "thrml" is thermal.
    """
    lowered, known = word.lower(), known_words()
    if len(lowered) < 3 or lowered in known:
        return ()
    found = near_words(lowered, 1 if len(lowered) < 6 else 2)
    if not set(lowered) & set("aeiou"):
        found += [(1, -known[other], other) for other in known if _shortens(lowered, other)]
    if not found and len(lowered) == 5:
        found = [item for item in near_words(lowered, 2) if item[2][0] == lowered[0]]
    return tuple(dict.fromkeys(other for _distance, _count, other in sorted(found)))[:most]


def near_words(word: str, limit: int) -> list[tuple[int, int, str]]:
    """(edits, -frequency, known word) of the known words that `limit` edits make of `word`."""
    known = known_words()
    found = process.extract(
        word, _long_words(), scorer=OSA.distance, score_cutoff=limit, limit=None
    )
    return [(int(distance), -known[other], other) for other, distance, _index in found]


@functools.cache
def _long_words() -> list[str]:
    return [word for word in known_words() if len(word) >= 3]


def _shortens(word: str, whole: str) -> bool:
    """Whether a word has half of the letters of `whole` at least, in order, the first one first."""
    letters = iter(whole)
    sized = whole[0] == word[0] and len(word) < len(whole) <= 2 * len(word)
    return sized and all(letter in letters for letter in word)


def _resembles(written: str, meant: str) -> bool:
    """Whether a word can be a misspelling of another. "T142" is none of "T143"."""
    if len(meant) < 3 or len(written) < 2 or any(letter.isdigit() for letter in meant):
        return False
    limit = max(1, len(meant) // 3)
    return edit_distance(written, meant, limit) <= limit or _shortens(written, meant)


class Phrases:
    """The words of a text by every form of them: without possessive ending, in parts."""

    def __init__(self, text: str) -> None:
        self.text = text
        self._lower = text.lower()
        self._spans: dict[str, list[Span]] = defaultdict(list)
        for match in _WORD.finditer(text):
            word = match[0].lower().replace("’", "'")
            forms = {word, word.removesuffix("'s"), word.rstrip("'"), *_INNER.split(word)}
            forms |= {_SHORT[match[0]]} if match[0] in _SHORT else set()
            for form in forms - {""}:
                self._spans[form].append(match.span())
        few = len(self._spans) <= FEW_WORDS
        self._uncertain = [word for word in self._spans if few or not is_known(word)]
        self._places: dict[str, list[Span]] = {}

    def missing(self, phrase: str, *, misspelt: bool = True) -> list[str]:
        """Words of a phrase that the text lacks; with `misspelt`, a resembling one counts."""
        said = self.places if misspelt else self._exact
        return [word for word in words(phrase) if not said(word)]

    def spans(self, phrase: str) -> list[tuple[Span, ...]]:
        """The places of a phrase, word for word or near each other; none if half is not said."""
        whole = self._whole(normalised(phrase))
        if whole:
            return [(span,) for span in whole]
        options = [self.places(word) for word in words(phrase)]
        found = [places for places in options if places]
        return [self._joined(_nearest(found))] if found and 2 * len(found) >= len(options) else []

    def places(self, word: str) -> list[Span]:
        """Where a word is said, put right where it is misspelt; at most MOST_PLACES."""
        if word not in self._places:
            self._places[word] = self._exact(word) or sorted(
                span
                for other in self._uncertain
                if _resembles(other, word)
                for span in self._spans[other]
            )
        return self._places[word][:MOST_PLACES]

    def _exact(self, word: str) -> list[Span]:
        forms = dict.fromkeys((word, f"{word}s", word.removesuffix("s")))
        found = [span for form in forms for span in self._spans.get(form, ())]
        parts = [part for part in re.split(r"[-.]", word) if part != word] if "-" in word else []
        if not found and parts and all(part in self._spans for part in parts):
            found = [span for part in parts for span in self._spans[part]]
        return sorted(found)[:MOST_PLACES]

    def _whole(self, wanted: str) -> list[Span]:
        found: list[Span] = []
        start = self._lower.find(wanted) if wanted and len(self._lower) == len(self.text) else -1
        while start >= 0 and len(found) < MOST_PLACES:
            end = start + len(wanted)
            beside = self._lower[start - 1 : start] if start else "", self._lower[end : end + 1]
            if not any(letter.isalnum() for letter in beside):
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


@functools.lru_cache(maxsize=2048)
def phrases(text: str) -> Phrases:
    """The words of a text, indexed once."""
    return Phrases(text)


def missing_words(text: str, phrase: str, *, misspelt: bool) -> list[str]:
    """Words of `phrase` that `text` does not say (Phrases.missing)."""
    return phrases(text).missing(phrase, misspelt=misspelt)


def _nearest(options: list[list[Span]]) -> list[Span]:
    """One place per word so that all stand near one of the last word, mostly a noun."""
    found = [[_closest(places, anchor) for places in options] for anchor in options[-1]]
    best = min(found, key=lambda spans: max(span[1] for span in spans) - min(spans)[0])
    return [span for span in best if abs(span[0] - best[-1][0]) <= FARTHEST]


def _closest(places: list[Span], anchor: Span) -> Span:
    index = bisect.bisect_left(places, anchor)
    return min(places[max(0, index - 1) : index + 1], key=lambda span: abs(span[0] - anchor[0]))
