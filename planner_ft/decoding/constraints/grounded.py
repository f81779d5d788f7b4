"""The values that the facts of an input allow: what nobody said cannot be written.

A number stands in the text, in its unit or another, or follows from what stands there; a place is
stated, or a stated length and bearing away from one that is; a text is a span, its words in their
order, as they stand or spelt right. A task input's own parameters are facts like those of its
prompt.

A span neither begins nor ends with a function word, unless it is quoted, nor with the possessive
of what follows. It may be dropped, a comma or a hyphen be a blank, a word in capitals be written
small, and a word that no list knows be replaced by a known one that is near.
"""

import functools
import itertools
import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from planner_ft.decoding.constraints import TOO_LONG, UNPAIRED, patterns
from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grammar import Grammar, Symbol, Values
from planner_ft.decoding.constraints.patterns import literal, quoted, regex
from planner_ft.facts import Input, corrections
from planner_ft.facts.geometry import Area, corners_of
from planner_ft.facts.numbers import read_rows
from planner_ft.facts.numerals import spoken_whole
from planner_ft.facts.places import written_positions
from planner_ft.facts.words import WORDS
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter
from planner_ft.vocabulary.plans import STEP_KEYS, value_problem

MOST_WORDS = 2000
"""Words of a command that spans are made of; compiling more takes longer than an answer."""
MOST_UNENDING = 4
"""Function words in a row behind which a span may end all the same: an answer must be able to."""
LONGEST_WORD = 64
"""Bytes of a word that a text can be made to end behind, quotation marks included."""
FUNCTION_WORDS, ELLIPSES = frozenset(WORDS["function_words"]), frozenset(WORDS["ellipses"])
"""Words that a value does not begin or end with, and those that stand for words left out ("the red
buoy and the green one"): with these, a value may be two spans, and a plural its singular.
"""
QUOTES = ('"', "'", "“", "‘", "«")

_UNSPACED = "\u0e00-\u0eff\u3040-\u30ff\u3400-\u9fff\uf900-\ufaff"
"""Scripts without blanks between words: each letter counts as a word."""
_PIECE = re.compile(rf"[{_UNSPACED}]|(?:(?![{_UNSPACED}])[^\W_])+")
_INSIDE = frozenset("-‐–'’./&+_")
_AROUND = re.compile(r""" ?[-–,"“”'’&/] ?|[,'’"”] ["“]?|, ["“]""")


class Piece(NamedTuple):
    """A word: its forms in a value, and the next words as (gap, number of the word)."""

    forms: tuple[str, ...]
    begins: bool
    ends: bool
    following: list[tuple[str, int]]


class Spans:
    """The spans of some texts: a command or task prompt, and the texts of a task's parameters."""

    def __init__(self, texts: Sequence[str]) -> None:
        self._pieces: list[Piece] = []
        said = {word.lower() for text in texts for word in _PIECE.findall(text)}
        self._loose = not said.isdisjoint(ELLIPSES)
        self._latest: tuple[Grammar | None, str | None] = None, None
        for text in texts:
            self._read(text)

    @property
    def too_long(self) -> bool:
        """Whether the texts have more words than spans can be made of."""
        return len(self._pieces) > MOST_WORDS

    def terminal(self, grammar: Grammar, without: Sequence[str] = ()) -> str | None:
        """The terminal of a quoted span, none of `without`; None where no span is left."""
        barred = {quoted(text).lower() for text in without}
        alone = (form for piece in self._pieces if piece.ends for form in piece.forms)
        if without and all(form.lower() in barred for form in alone):
            return None
        if self._latest[0] is not grammar:
            self._latest = grammar, self._span(grammar)
        span = self._latest[1]
        return grammar.terminal(span + lark.none_of_texts(without)) if span and without else span

    def _span(self, grammar: Grammar) -> str | None:
        names: dict[int, str] = {}
        for index, piece in reversed(list(enumerate(self._pieces))):
            after = ((gap, names[place]) for gap, place in piece.following if place in names)
            following = [f"{literal(gap)} {name}" for gap, name in after]
            if piece.forms and (following or piece.ends):
                forms = " | ".join(map(literal, piece.forms))
                behind = f"({' | '.join(following)})" if following else ""
                optional = "?" if piece.ends and following else ""
                names[index] = grammar.terminal(f"({forms}) {behind}{optional}")
        starts = {name for index, name in names.items() if self._pieces[index].begins}
        if not starts:
            return None
        marks, one = literal('"'), grammar.terminal(" | ".join(sorted(starts)))
        more = f'(" " {one})?' if self._loose else ""
        return grammar.terminal(f"{marks} {one} {more} {marks}")

    def _read(self, text: str) -> None:
        first, matches, run = len(self._pieces), list(_PIECE.finditer(text)), 0
        wholes = list(spoken_whole(read_rows(text)[0].tokens))
        gaps = [text[one.end() : two.start()] for one, two in itertools.pairwise(matches)]
        for number, match in enumerate(matches):
            word, before = match[0], text[match.start() - 1 : match.start()]
            after, more = gaps[number : number + 2], matches[number + 1 : number + 3]
            # In "camera A" and "cam_a" the letter is a name.
            plain = word.lower() in FUNCTION_WORDS and word != "A" and before not in ("_", "-", ".")
            run = run + 1 if plain else 0
            # "Region a, top left" has no article there.
            letter = word.lower() == "a" and bool(after) and not after[0].isspace()
            begins = letter or ((before in QUOTES or not plain) and before != "_")
            ends = run % MOST_UNENDING == 0 and text[match.end() : match.end() + 1] != "_"
            ends = ends and not (after and word.lower() == "s" and before in ("'", "’"))
            # No name ends within "ninety one".
            own = [at for at in wholes if at[0] <= match.start() < at[1]]
            begins &= all(match.start() == at[0] for at in own)
            ends &= all(match.end() == at[1] for at in own)
            following = [(gap, 1) for gap in _written_gaps(after[0], word)] if after else []
            if after[1:] and after[0] in ("'", "’") and more[0][0].lower() == "s":
                following += [(gap, 2) for gap in _written_gaps(after[1], "s")]
            behind = [(quoted(gap), first + number + far) for gap, far in following]
            self._pieces.append(Piece(self._forms(word), begins, letter or ends, behind))

    def _forms(self, word: str) -> tuple[str, ...]:
        """The ways to write a word in a value."""
        if len(quoted(word).encode()) > LONGEST_WORD // 2:
            return ()
        forms = [word, word.lower(), *corrections(word)]
        if word.isupper() and len(word) > 1:
            forms.append(word.title())
        if self._loose and len(word) > 3 and word.endswith("s") and not word.endswith("ss"):
            forms.append(word[:-1])
        return tuple(map(quoted, dict.fromkeys(forms)))


def _written_gaps(gap: str, before: str) -> list[str]:
    """The ways to write the gap between two words; none where a value cannot go on."""
    if not gap:
        return [""]
    if gap.isspace():
        return [] if "\n" in gap else [" "]
    if gap in _INSIDE:
        return [gap, " "] if gap in "-‐/" else [gap]
    if gap == ". " and len(before) <= 3:
        return [gap, " "]
    collapsed = " ".join(gap.split(" "))
    return [collapsed, " "] if _AROUND.fullmatch(collapsed) else []


LONGEST_NUMBER = 16
"""Digits of a number in a sentence: an identity at sea has nine."""
MOST_CROSSED = 8
LARGEST = 10**patterns.WHOLE_DIGITS
REPORTS = dict(zip(STEP_KEYS[3:], ("stop", "failure", "output"), strict=True))
"""Fields of a skill with the wording of a step's reports."""


class GroundedValues(Values):
    """The values of a plan that its input states or gives by arithmetic. With `free_waypoints`, a
    coordinate of a destination can be any number.
    """

    def __init__(self, source: Input, *, free_waypoints: bool) -> None:
        self._source, self._facts, self._vocabulary = source, source.facts, source.vocabulary
        self._spans = Spans([source.facts.text, *source.texts])
        self._sure = not (source.facts.unread or source.facts.loose)
        coordinates = [item for skill in self._vocabulary.skills for item in skill.coordinates]
        self._numbers: dict[Parameter, list[str] | None] = {}
        self._numbers |= dict.fromkeys(coordinates if free_waypoints else ())
        stated = ((place.x, place.y) for place in source.facts.positions)
        found = ((round(x, 2), round(y, 2)) for x, y in (*stated, *source.worked_places))
        usable = (place for place in found if max(map(abs, place)) < LARGEST)
        own = self._vocabulary.home, self._vocabulary.unresolved
        self._places = list(dict.fromkeys([*own, *usable]))
        # A long command gives thousands, and they are written before every value.
        self._text = functools.cache(lark.written)
        self.notes = list(source.facts.unread)
        self.notes += [UNPAIRED] if source.facts.loose else []
        self.notes += [TOO_LONG] if self._spans.too_long else []

    def number(
        self, grammar: Grammar, parameter: Parameter, without: Sequence[float] = ()
    ) -> Symbol:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().number(grammar, parameter, without)
        barred = {lark.written(number) for number in without}
        return grammar.one_of(number for number in numbers if number not in barred)

    def has_number(self, parameter: Parameter, value: float) -> bool:
        numbers = self._written_numbers(parameter)
        if numbers is None:
            return super().has_number(parameter, value)
        return lark.written(value) in numbers

    def position(self, grammar: Grammar, without: Sequence[Sequence[float]] = ()) -> Symbol:
        if not self._sure:
            return super().position(grammar, without)
        places: Iterable[tuple[float, ...]] = self._places
        if self._source.is_task:
            known = [place for place in self._places if place != self._vocabulary.unresolved]
            # "The box from (0, 0) to (40, 20)" has the corners in between.
            crossed = len(known) <= MOST_CROSSED
            places = itertools.product(*zip(*known, strict=True)) if crossed else known
        barred = set(map(tuple, without))
        return grammar.one_of(self._text(place) for place in places if place not in barred)

    @property
    def areas(self) -> Sequence[Area]:
        return self._source.rectangles if self._sure else ()

    def middle(self, grammar: Grammar, without: Sequence[Sequence[float]] = ()) -> Symbol:
        if not self.areas:
            return self.position(grammar, without)
        stated = ((at.x, at.y) for at in written_positions(self._facts.text))
        corners = {at for area in self.areas for at in (area[0], *corners_of(*area))}
        known = [self._vocabulary.unresolved, *stated]
        return grammar.one_of(lark.written(at) for at in known if at not in {*corners, *without})

    def text(self, grammar: Grammar, without: Sequence[str] = ()) -> Symbol:
        if self._spans.too_long:
            return super().text(grammar, without)
        return self._spans.terminal(grammar, without)

    def identity(self, grammar: Grammar) -> Symbol:
        return self.text(grammar)

    def prose(self, grammar: Grammar) -> str:
        return grammar.terminal(self._prose) if self._sure else super().prose(grammar)

    def step_texts(self, grammar: Grammar, key: str) -> str:
        # Reports of a step are the vocabulary's own wording.
        known = {getattr(skill, REPORTS[key]) for skill in self._vocabulary.skills} - {None}
        if not known:
            return super().step_texts(grammar, key)
        return grammar.items(grammar.one_of(map(compact_json, sorted(known))))

    def _written_numbers(self, parameter: Parameter) -> list[str] | None:
        """Texts of a parameter's number, smallest first; None where any number can be meant."""
        if parameter not in self._numbers and self._facts.unread:
            self._numbers[parameter] = None
        elif parameter not in self._numbers:
            values = (one for one in self._source.values(parameter) if abs(one) < LARGEST)
            found = sorted({round(value, digits) for value in values for digits in (2, 4)})
            fitting = (one for one in found if value_problem(one, parameter) is None)
            self._numbers[parameter] = list(map(lark.written, fitting))
        return self._numbers[parameter]

    @functools.cached_property
    def _prose(self) -> str:
        """Sentences, with the numbers of the command and those of every value."""
        known = set(re.findall(r"\d+(?:\.\d+)?", self._facts.text))
        for parameter in (item for task in self._vocabulary.tasks for item in task.parameters):
            if parameter.type in ("number", "integer"):
                known |= {text.lstrip("-") for text in self._written_numbers(parameter) or ()}
                said = (abs(number.said) for number in self._facts.numbers(parameter.unit))
                known |= set(map(lark.written, said))
        known |= {lark.written(abs(value)) for place in self._places for value in place}
        return prose(number for number in known if len(number) <= LONGEST_NUMBER)


def prose(numbers: Iterable[str]) -> str:
    """A JSON string as sentences have it, with no other numbers than these."""
    other = r'([^"\\0-9\x00-\x1f\x7f]|\\["\\bfnrt])'
    known = "|".join(sorted(patterns.escaped(number) for number in numbers))
    number = f"({known})?" if known else ""
    return regex(f'"({number}{other}){{0,{lark.LONGEST_PROSE}}}{number}"')
