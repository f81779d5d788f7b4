"""The ways in which a text can be meant, each written out as another text.

People drop articles ("for hour or so"), write "4" for "for", misspell units and say two numbers in
a row, so that "seventy one hundred and eighty" is 71 180 or 70 and 180. A variant knows where each
of its characters stands in the text itself.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from planner_ft.facts.lists import (
    DIGITS,
    FRACTIONS,
    PARTS,
    PRONOUNCED,
    SCALES,
    SMALL,
    TURNS,
    UNITS,
    VULGAR,
    WORDS,
)
from planner_ft.facts.numerals import Token, number_at, tokenize, unit_of, word_at
from planner_ft.facts.words import corrections

MOST_VARIANTS = 24
NUMERALS = frozenset([*SMALL, *SCALES, *PARTS, *TURNS])
COUNTED = frozenset([*WORDS["articles"], *SMALL, *SCALES, *FRACTIONS, "-", "/", "of"])
Edit = tuple[int, int, str]
"""Start, end, and what stands there instead."""


@dataclass(frozen=True)
class Variant:
    """A text as it can be meant; `starts` and `ends` say where each character is from."""

    text: str
    starts: tuple[int, ...]
    ends: tuple[int, ...]

    def origin(self, start: int, end: int) -> tuple[int, int]:
        """The span of the original text that a span of this one is from."""
        inside = range(start, max(start + 1, min(end, len(self.starts))))
        kept = [place for place in inside if self.starts[place] < self.ends[place]] or [start]
        return self.starts[kept[0]], self.ends[kept[-1]]

    def edited(self, edits: Iterable[Edit]) -> Variant:
        """The variant with some parts written in another way."""
        texts, starts, ends, done = [], list[int](), list[int](), 0
        for start, end, new in sorted(edits):
            first = self.starts[start] if start < len(self.starts) else self.ends[-1]
            last = self.ends[end - 1] if end > start else first
            texts += [self.text[done:start], new]
            starts += [*self.starts[done:start], *[first] * len(new)]
            ends += [*self.ends[done:start], *[last] * len(new)]
            done = end
        return Variant(
            "".join([*texts, self.text[done:]]),
            (*starts, *self.starts[done:]),
            (*ends, *self.ends[done:]),
        )


def plain(text: str) -> Variant:
    """The text as it stands, with signs and digits in words written in figures: "1½", "1e3",
    "one-eight-zero", "wun zero".
    """
    variant = Variant(text, tuple(range(len(text))), tuple(range(1, len(text) + 1)))
    for rule in ALWAYS:
        for edits in _by_rule(rule, variant.text):
            variant = variant.edited(edits)
    return variant


def variants(text: str) -> tuple[Variant, ...]:
    """The plain variant and those that differ from it, at most MOST_VARIANTS."""
    first = plain(text)
    found = {first.text: first}
    for maker in MAKERS:
        # There may be many places to cut a row of numbers at.
        known = list(found.values())[: 3 if maker is _cuts else None]
        for variant in known:
            for edits in itertools.islice(maker(variant.text), MOST_VARIANTS):
                other = variant.edited(edits)
                found.setdefault(other.text, other)
    return tuple(itertools.islice(found.values(), MOST_VARIANTS))


# ---------------------------------------------------------------- rules

Rule = tuple[re.Pattern[str], Callable[[re.Match[str]], str]]


def _rule(pattern: str, new: Callable[[re.Match[str]], str]) -> Rule:
    return re.compile(pattern, re.IGNORECASE), new


def _by_rule(rule: Rule, text: str) -> Iterator[list[Edit]]:
    """The edits that carry out a rule wherever it applies."""
    pattern, new = rule
    edits = [(*match.span(), new(match)) for match in pattern.finditer(text)]
    if edits:
        yield edits


def _spoken(word: str) -> str:
    """The figure of a digit in words, pronounced as over the radio or not."""
    return DIGITS[PRONOUNCED.get(word.lower(), word.lower())]


def _pair(match: re.Match[str]) -> str:
    """ "three-zero" in figures; "two-three" is a choice."""
    first, second = _spoken(match[1]), _spoken(match[2])
    return match[0] if int(second) == int(first) + 1 or first == "0" else first + second


def _span(match: re.Match[str]) -> str:
    """The seconds between two times of the day, the second one on the next day if need be."""
    hours, minutes, end, more = (int(match[name]) for name in (1, 2, 3, 4))
    return f"{((end - hours) * 60 + more - minutes) % (24 * 60) * 60} seconds"


def _hundreds(match: re.Match[str]) -> str:
    hundreds, tens, ones = (part.lower() if part else "zero" for part in match.groups())
    return str(int(100 * SMALL[hundreds] + SMALL[tens] + SMALL[ones]))


_DIGIT = "|".join(DIGITS)
_SAID = "|".join([*DIGITS, *PRONOUNCED])
_ONE_TO_NINE = "|".join(word for word in DIGITS if word not in ("zero", "oh"))
_TEENS = "|".join(word for word, value in SMALL.items() if value >= 10)
_LONG_UNITS = "|".join(unit for unit in UNITS if len(unit) > 2)
_BARE_UNIT = "|".join(WORDS["bare_units"])

ALWAYS: tuple[Rule, ...] = (
    _rule(
        rf"(\d*)\s?([{''.join(VULGAR)}])",
        lambda found: f" {float(found[1] or 0) + VULGAR[found[2]]:g}",
    ),
    _rule(r"(?<![\w.])\d+(?:\.\d+)?e\+?\d{1,2}(?!\w)", lambda found: f"{float(found[0]):.2f}"),
    _rule(rf"(?<![\w-])({_SAID})-({_SAID})(?![\w-])", _pair),
    _rule(rf"\b({_SAID})-(?=(?:{_SAID})\b)", lambda found: f"{found[1]} "),
    _rule(r"\bright[ -]angles?\b", lambda _: "rightangle"),
    _rule(rf"\bevery other (?=(?:{_LONG_UNITS})\b)", lambda _: "every two "),
    # A tree is a tree where neither a digit nor a unit follows.
    _rule(
        rf"\b({'|'.join(PRONOUNCED)})(?= (?:{_SAID}|[a-z]*(?:metres?|meters?|minutes?|seconds?"
        r"|degrees?|hours?))\b)",
        lambda found: PRONOUNCED[found[1].lower()],
    ),
)
ALTERNATIVES: tuple[Rule, ...] = (
    _rule(r"(?<![\d.,])\d{1,3}(?:,\d{3})+(?![\d.])", lambda found: found[0].replace(",", "")),
    _rule(r"(?<![\d:])(\d{1,3}):([0-5]\d)(?![\d:])", lambda m: f"{m[1]} minutes {m[2]} seconds"),
    _rule(r"(?<![\d:])(\d{1,3}):([0-5]\d)(?![\d:])", lambda m: f"{m[1]} hours {m[2]} minutes"),
    # "From 11:10 to 11:30" are twenty minutes.
    _rule(r"(?<![\d:])(\d{1,2}):([0-5]\d)\b\D{1,9}\b(\d{1,2}):([0-5]\d)(?![\d:])", _span),
    # "33w 15s" are coordinates and no seconds.
    _rule(
        r"(?<=\d)(\s?)s(?![a-z])(?=\W{1,5}\d+(?:\.\d+)?\s?[ew](?![a-z]))"
        r"|(?<=[ew])(\W{1,5}\d+(?:\.\d+)?\s?)s(?![a-z])",
        lambda found: f"{found[1] or found[2] or ''}S",
    ),
    # "At 4 m and a half hour of film": half an hour; "from 22/0 a kilometre": a kilometre.
    _rule(rf"\band (?:a )?half[ -]({_BARE_UNIT})\b", lambda found: f", half an {found[1]}"),
    _rule(rf"(?<=\d) (?=an? (?:{_BARE_UNIT})\b)", lambda found: ", "),
    # "4 an hour", "2 the pier".
    _rule(
        rf"(?<![\w.,-])[24](?= (?:an?|the|another|total|space|\d|{'|'.join([*SMALL, *FRACTIONS])})\b)",
        lambda found: "for" if found[0] == "4" else "to",
    ),
    # "Lanes one five metres apart", "x five five".
    _rule(
        rf"\b({_DIGIT}) ({_DIGIT})(?= (?:{_LONG_UNITS})\b)", lambda m: _spoken(m[1]) + _spoken(m[2])
    ),
    _rule(
        rf"\b([xy] (?:minus |negative )?)({_DIGIT}) ({_DIGIT})\b(?! (?:{_DIGIT})\b)",
        lambda found: found[1] + _spoken(found[2]) + _spoken(found[3]),
    ),
    # "One eighty" is 180, "two twenty-five" 225.
    _rule(rf"\b({_ONE_TO_NINE})[ -]({_TEENS})(?:[ -]({_ONE_TO_NINE}))?\b", _hundreds),
)


# ---------------------------------------------------------------- words that are put right or added


def _numerals(text: str) -> Iterator[list[Edit]]:
    """Number words with their spelling put right: "quartesr", "thrity", "onec"; and "secotrs",
    which are no seconds.
    """
    for word, start, end in tokenize(text):
        if len(word) > 3 and word.isalpha() and word not in UNITS:
            meant = corrections(word)
            numerals = [other for other in meant if other in NUMERALS]
            if not numerals and unit_of(word) and meant and meant[0] not in UNITS:
                numerals = [meant[0]]
            yield from ([(start, end, numeral)] for numeral in numerals)


def _units(text: str) -> Iterator[list[Edit]]:
    """Units behind a number or an article that are misspelt beyond what `unit_of` takes: "two
    hous", "500 fewt", "a full hur".
    """
    tokens, index = tokenize(text), 0
    while index < len(tokens):
        used = number_at(tokens, index)[1]
        index += used or 1
        if used or word_at(tokens, index - 1) in WORDS["articles"]:
            place = index
            while word_at(tokens, place) in WORDS["beside_unit"] and place < index + 3:
                place += 1
            yield from _unit_spellings(tokens[place : place + 1])


def _unit_spellings(tokens: list[Token]) -> Iterator[list[Edit]]:
    for word, start, end in tokens:
        if not unit_of(word):
            yield from ([(start, end, unit)] for unit in corrections(word) if unit in UNITS)


def _articles(text: str) -> Iterator[list[Edit]]:
    """Telegram style with its articles: "wait minute at each" as "wait a minute at each"."""
    tokens, edits = tokenize(text), []
    for index, (word, _start, _end) in enumerate(tokens):
        misspelt = word not in UNITS and not word.endswith("s")
        if len(word) < 3 or not unit_of(word) or not (word in WORDS["bare_units"] or misspelt):
            continue
        first = index - 1 if word_at(tokens, index - 1) in WORDS["whole"] else index
        before = word_at(tokens, first - 1)
        counted = before in COUNTED or before[:1].isdigit()
        if not counted and not (first and number_at(tokens, first - 1)[1]):
            edits.append((tokens[first][1], tokens[first][1], "a "))
    if edits:
        yield edits


def _cuts(text: str) -> Iterator[list[Edit]]:
    """Numbers in words that stand in a row, apart: "seventy one hundred and eighty" as "seventy /
    one hundred and eighty".
    """
    for (word, _start, end), (following, start, _end) in itertools.pairwise(tokenize(text)):
        apart = text[end:start].isspace() and "\n" not in text[end:start]
        if apart and (word in SMALL or word in SCALES) and following in SMALL:
            yield [(end, start, " / ")]


MAKERS: tuple[Callable[[str], Iterator[list[Edit]]], ...] = (
    _numerals,
    _units,
    _articles,
    *(functools.partial(_by_rule, rule) for rule in ALTERNATIVES),
    _cuts,
)
