"""English numerals and units in a row of tokens: "ninety-five", "one point two", "a hundred and
twenty metres". Where a row can be read in several ways, each is given, the plain one first:
"seventy one hundred and eighty" is 71 180, or 70 and 180.
"""

from __future__ import annotations

import bisect
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from planner_ft.facts import words as lists
from planner_ft.facts.units import unit_at
from planner_ft.facts.words import DIGITS, FRACTIONS, PARTS, SCALES, SMALL, UNITS, WORDS, Unit

AND, SAID = WORDS["and"], {**DIGITS, **lists.PRONOUNCED}
MIXED = {"1/2": 0.5, "1/4": 0.25, "3/4": 0.75}
TURNED = ("of", "turn", "turns", "circle", "circles")
NUMERALS = frozenset([*SMALL, *SCALES, *PARTS, *lists.TURNS])
COUNTED = frozenset([*WORDS["articles"], *SMALL, *SCALES, *FRACTIONS, "-", "/", "of"])
BEHIND_ANOTHER = ("comma", "minus", "negative", "plus", "point", "by", "x", ",", *AND)
"""What stands before a number that others stand before."""
PASSED = 3  # words between a number and its unit: "quarter of a nautical mile"

_TOKEN = re.compile(
    r"\d{1,3}(?:,\d{3})+(?=\s?(?:m|metres|meters|s|seconds)\b)"
    r"|(?<![\d.,])(?:0,\d{1,2}(?=\s?(?:k?m|nm)\b)"
    r"|\d{1,2},\d(?=\s?(?:m/s|kn|kts?|knots|m|met(?:re|er)s?|min(?:ute)?s?|h(?:ours)?)\b))"
    rf"|(?:\d+\s?)?[{''.join(lists.VULGAR)}]|(?<![\w.])\d+(?:\.\d+)?e\+?\d{{1,2}}(?!\w)"
    r"|(?:1/[2-9]|2/[3579]|3/[4578]|4/5|5/[68]|7/8)(?!\d)|(?:\d+|(?<!\.))\.\d+|\d+"
    r"|[a-z°µμΩ]+(?:'[a-z]+)?|(?<![a-z])[-−–]|[-−–](?![a-z])|[^\s\w−–-]",
    re.IGNORECASE,
)
"""A hyphen between letters is no token: "ninety-five" is ninety five."""
_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3}(?:,\d{3})+(?![\d.])")

Span = tuple[int, int]
Reading = tuple[float, int]  # a number, and the index behind it


class Token(NamedTuple):
    word: str
    start: int
    end: int


_IN_FULL = re.compile(r"(?:(?:o|n|yo?)t)?(?:oh)?(?:a?(?:o|n|yo?))?")


class Row:
    """The tokens of a text: numbers, words in lower case, signs; "5m" are two."""

    def __init__(self, text: str, tokens: list[Token], *, letters: bool = False) -> None:
        self.text, self.tokens, self.letters = text, tokens, letters

    @classmethod
    def of(cls, text: str, *, letters: bool = False) -> Row:
        """A text as it stands; "right angle" is one word, "tree minutes" are three. With `letters`,
        a single letter can be a unit.
        """
        tokens = [Token(match[0].lower(), *match.span()) for match in _TOKEN.finditer(text)]
        row = cls(text, tokens, letters=letters)
        for index, (word, start, end) in enumerate(row.tokens):
            before, following = row.word(index - 1), row.word(index + 1)
            if word in lists.PRONOUNCED and (
                following in SAID
                or (len(following) > 3 and following in UNITS)
                or (before in SAID and row.gap(index) == "-")
            ):
                row._write(index, lists.PRONOUNCED[word])
            elif word in ("angle", "angles") and before == "right":
                row.tokens[index - 1 : index + 1] = [Token("rightangle", start, end)]
            elif (before, word) == ("every", "other") and len(following) > 2 and following in UNITS:
                row._write(index, "two")
            elif word.endswith("'s") and word[:-2] in UNITS:  # "one minute's hold"
                row._write(index, word[:-2])
        return row

    def mended(self, until: int, choice: int = 0, *, numerals: bool = True) -> Row:
        """The row with misspelt units, and `numerals`, put right up to a place of the text, by the
        likeliest word or another `choice`: "quartesr", "two hous"; "secotrs" are no seconds.
        """
        other, behind = Row(self.text, list(self.tokens), letters=self.letters), False
        for index, (word, start, _end) in enumerate(self.tokens):
            if start >= until:
                break
            meant = lists.corrections(word) if word.isalpha() and word not in UNITS else ()
            likely = len(word) > 3 and numerals
            known = [one for one in meant if one in NUMERALS] if likely else []
            if behind and (units := [one for one in meant if one in UNITS]):
                known = list(dict.fromkeys((units[0], meant[0], *units)))
            elif not known and meant[:1] and meant[0] in WORDS["bare_units"]:
                known = [meant[0]]
            if known and word not in NUMERALS:
                other._write(index, known[choice % len(known)])
            passed = behind and word in WORDS["beside_unit"]
            behind = passed or word[0].isdigit() or word in NUMERALS or word in WORDS["articles"]
        return other

    def _write(self, index: int, word: str) -> None:
        self.tokens[index] = self.tokens[index]._replace(word=word)

    def word(self, index: int) -> str:
        """The token's text, or an empty one outside the row."""
        return self.tokens[index].word if 0 <= index < len(self.tokens) else ""

    def written(self, index: int) -> str:
        """A token as it stands in the text."""
        return self.text[self.tokens[index].start : self.tokens[index].end]

    def gap(self, index: int) -> str:
        """The text before a token."""
        return self.text[self.tokens[index - 1].end : self.tokens[index].start] if index else ""

    def numerals(self, index: int) -> Iterator[Reading]:
        """The numbers that begin at `index`, the plain one first."""
        word, following = self.word(index), self.word(index + 1)
        if (figure := _figure(word)) is not None:
            if word.isdigit() and following in MIXED and self.unit(index + 2)[0]:
                yield figure + MIXED[following], index + 2
                return
            yield from self._with_fraction(figure, index + 1)
            _word, start, end = self.tokens[index]
            if (whole := _THOUSANDS.match(self.text, start)) and whole.end() > end:  # "1,250"
                yield float(whole[0].replace(",", "")), index + 1 + 2 * whole[0].count(",")
        elif word in FRACTIONS:
            dozen = index + 1 + (following in ("a", "of"))
            if self.word(dozen) == "dozen":
                yield 12 * FRACTIONS[word], dozen + 1
            else:
                yield FRACTIONS[word], index + 1
        elif word in ("a", "an", "per", "each", "every"):
            if self._is_part(index + 1):
                yield lists.ORDINALS[following], index + 2
            elif following in SCALES or following == "couple":
                yield from self._in_words(index + 1)
            # A letter alone is rather a name or an article than a unit.
            elif (
                len(following) > 2
                and (unit := self.unit(index + 1)[0])
                and (self.letters or unit.base in lists.SPOKEN)
            ):
                yield 1.0, index + 1
        elif word in SMALL or word in SCALES:
            yield from self._spoken(index)
        elif (tenths := self._tenths(index)) and (unit := self.unit(index + 1 + len(tenths))[0]):
            # "At point five knots", but "at the centre point five minutes".
            decimal = self.word(index - 1) not in WORDS["before_point"]
            if decimal:
                yield float(f"0.{tenths}"), index + 1 + len(tenths)
            if not (decimal and unit.base == "m/s"):
                yield float(tenths), index + 1 + len(tenths)

    def half(self, index: int) -> Reading:
        """What "and a half", "and three quarters" add at `index`, and the index behind it."""
        nothing = (0.0, index)
        if self.word(index) not in AND:
            return nothing
        first, second, third = (self.word(index + place) for place in (1, 2, 3))
        several = {"three": 3, "two": 2}.get(first, 0)
        if several and second.startswith(("quarter", "third")) and several * PARTS[second] < 1:
            # "And three quarters of a turn" is something else.
            whole = third not in TURNED and (second.endswith("s") or third in UNITS)
            return (several * PARTS[second], index + 3) if whole else nothing
        if first in MIXED:
            return MIXED[first], index + 2
        place = index + 1 + (first in ("a", "one"))
        behind = self.word(place + 1)
        # "Nine minutes and half an hour" are two, and "a third one" is a thing.
        if self.word(place) not in FRACTIONS or behind in ("a", "an", "one"):
            return nothing
        # So are "80 seconds and a quarter of an hour".
        if behind == "of" and self.word(place + 2) in ("a", "an") and self.unit(place + 3)[0]:
            return nothing
        return FRACTIONS[self.word(place)], place + 1

    def unit(self, index: int) -> tuple[Unit | None, int]:
        """The unit at `index` and the index behind it; words that may stand before are passed."""
        for passed in range(PASSED + 1):
            start = self.tokens[index].start if index < len(self.tokens) else len(self.text)
            if found := unit_at(self.text, start, letters=self.letters):
                behind = bisect.bisect_left(self.tokens, found[1], key=lambda token: token.start)
                return found[0], behind
            dash = self.word(index) == "-" and self.word(index + 1) in ("a", "an")
            index += passed < PASSED and self.word(index) in WORDS["beside_unit"] and not dash
        return UNITS.get(self.word(index)), index + 1

    def bare_unit(self, index: int) -> bool:
        """Whether a unit without a number begins here: "wait minute at each", "full mnute"."""
        at = index + (self.word(index) in WORDS["whole"])
        word, before = self.word(at), self.word(index - 1)
        counted = before in COUNTED or before in WORDS["whole"] or before[:1].isdigit()
        return word in WORDS["bare_units"] and not counted

    def _spoken(self, index: int) -> Iterator[Reading]:
        """A number in words: "one two zero" as over the radio, or "one hundred and twenty"."""
        said = self._digits(index)
        if len(said) > 2 and self.word(index + len(said)) in SCALES:
            said = said[:-1]  # "zero nine zero two hundred metres"
        radio = [(float(said[:count]), index + count) for count in range(len(said), 1, -1)]
        words = list(self._in_words(index))
        joined = len(said) == 2 and self.gap(index + 1) == "-" and int(said[1]) != int(said[0]) + 1
        two = len(said) == 2 and said[0] != "0"
        tenths = self._tenths(index + len(said))
        if len(said) > 1 and tenths:  # "six zero decimal five"
            yield float(f"{said}.{tenths}"), index + len(said) + 1 + len(tenths)
            return
        if two and said[1] == "0" and self.unit(index + 2)[0]:  # "one-zero minutes"
            yield radio[0]
            return
        # "Two five minute holds" may be two.
        sure = two and (said[1] == "0" or joined or self.unit(index + 2)[0] is None)
        value, after = words[0]
        part = self.word(after)
        for hundreds in self._hundreds(index):  # "at one sixty comma one ten"
            behind = hundreds[1] + (self.word(hundreds[1]) in ("metres", "meters", "metre"))
            if (
                self.word(index - 1) in WORDS["before_hundreds"]
                or self.word(behind) in WORDS["behind_hundreds"]
            ):
                yield hundreds
        if len(said) > 2 or sure:
            yield radio[0]
        elif (part in PARTS and (part != "half" or value == 1)) or self._is_part(after):
            yield value * {**lists.ORDINALS, **PARTS}[part], after + 1
        else:
            yield from self._with_fraction(value, after)
        for number, behind in (*radio, *words):
            if len(said) == 2 or self._splits(behind):
                yield number, behind
        yield from self._hundreds(index)

    def _hundreds(self, index: int) -> Iterator[Reading]:
        """ "One eighty" as 180, "two twenty-five" as 225."""
        first, tens, ones = (SMALL.get(self.word(index + place), 0) for place in range(3))
        if 0 < first < 10 <= tens:
            more = tens >= 20 and 0 < ones < 10
            yield 100 * first + tens + more * ones, index + 2 + more
            behind = self.word(index + 3)
            # "One fifty / one fifty", "one twenty / four times".
            if more and (SMALL.get(behind, 0) >= 10 or behind in SCALES or behind == "times"):
                yield 100 * first + tens, index + 2

    def _in_words(self, start: int) -> Iterator[Reading]:
        """A number in words ("one point two"), then those that its first words are alone."""
        index, total, current, found = start, 0.0, 0.0, list[Reading]()
        while True:
            word, skip = self.word(index), 0
            if index > start and word in AND and (current >= 100 or (total and not current)):
                word, skip = self.word(index + 1), 1
            if word in SMALL and (index == start or _joins(current, SMALL[word], total)):
                current += SMALL[word]
            elif word == "thousand":
                total, current = total + max(current, 1) * 1000, 0.0
            elif word == "hundred" and current >= 100 and found[1:]:
                # "Two hundred and one hundred" are two.
                found.pop()
                break
            elif word in SCALES:
                current = max(current, 1) * SCALES[word]
            else:
                break
            index += 1 + skip
            found.append((total + current, index))
        decimals = self._tenths(index)
        if decimals:
            found[-1] = total + current + float(f"0.{decimals}"), index + 1 + len(decimals)
        yield found.pop()
        yield from (one for one in reversed(found) if self._splits(one[1]))

    def _digits(self, index: int) -> str:
        """The digits in words from `index` on, as figures."""
        found = ""
        while self.word(index + len(found)) in DIGITS:
            found += DIGITS[self.word(index + len(found))]
        return found

    def _tenths(self, index: int) -> str:
        """The digits behind "point" at `index`, as figures."""
        return self._digits(index + 1) if self.word(index) in ("point", "decimal") else ""

    def _splits(self, index: int) -> bool:
        """Whether one number can end before a token and another begin: "seventy / one hundred"."""
        apart = self.word(index) in SMALL and self.gap(index)
        return bool(apart) and str(apart).isspace() and "\n" not in str(apart)

    def _with_fraction(self, value: float, index: int) -> Iterator[Reading]:
        fraction, behind = self.half(index)
        yield value + fraction, behind
        # "At 4 and a half hour of film".
        if self.word(behind) in WORDS["bare_units"] and behind > index:
            yield value, index

    def _is_part(self, index: int) -> bool:
        """Whether an ordinal is a part of a unit: "tenth of an hour", "eighth of a turn"."""
        word, of, article = (self.word(index + place) for place in range(3))
        return word in lists.ORDINALS and of == "of" and article in ("a", "an", "the")


def _figure(word: str) -> float | None:
    """The value of a token in figures: "1,200", "2/3", "1½", "1e3"."""
    if word[:2] == "0," or len(word) < len("1,250"):
        word = word.replace(",", ".")
    if word[-1:] in lists.VULGAR:
        return float(word[:-1] or 0) + lists.VULGAR[word[-1]]
    if not word[-1:].isdigit():
        return None
    above, _, below = word.replace(",", "").partition("/")
    return float(above) / float(below or 1)


def _joins(current: float, following: float, total: float) -> bool:
    """Whether a number goes on: five after twenty, twenty after a hundred, six after a thousand."""
    if current == 0:
        return total > 0
    if current >= 100 and current % 100 == 0:
        return 0 < following < 100
    return current >= 20 and current % 10 == 0 and 0 < following < 10


def spoken_whole(tokens: Sequence[Token]) -> Iterator[Span]:
    """The spans of words in a row that make one number, as it is said in full: "twenty two", "one
    thousand five hundred"; not "one twenty four", which can be two, nor behind another number:
    "forty comma twenty two".
    """
    row, before = list[Token](), ""
    for token in (*tokens, Token("", 0, 0)):
        joins = token.word in AND and bool(row) and row[-1].word in SCALES
        if _kind(token.word) or joins:
            row.append(token)
            continue
        kinds = "".join(_kind(one.word) or "a" for one in row)
        if len(row) > 1 and before not in BEHIND_ANOTHER and _IN_FULL.fullmatch(kinds):
            yield row[0].start, row[-1].end
        row, before = [], token.word


def _kind(word: str) -> str:
    """What a word adds to a number, in a letter: ones, teens, tens, hundred, thousand."""
    if word in ("hundred", "thousand"):
        return word[0]
    value = lists.SMALL.get(word, 0)
    known = word in lists.SMALL and word != "couple"
    return ("o" if value < 10 else "n" if value < 20 else "y") if known and value else ""
