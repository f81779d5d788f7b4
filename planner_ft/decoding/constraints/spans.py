"""Text values as spans of a text: its words in their order, as they stand or spelt right.

A span neither begins nor ends with a function word, unless it is quoted. A possessive may be
dropped, a comma or a hyphen be a blank, a word in capitals be written small, and a word that no
list knows be replaced by a known one that is near.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from planner_ft.decoding.constraints.grammar import Grammar, none_of_texts
from planner_ft.decoding.constraints.patterns import literal, quoted
from planner_ft.facts import corrections
from planner_ft.facts.lists import WORDS

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


@dataclass
class Piece:
    """A word: its forms in a value, and the next words as (gap, number of the word)."""

    forms: tuple[str, ...]
    begins: bool
    ends: bool
    following: list[tuple[str, int]] = field(default_factory=list)


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
        if without and not any(form.lower() not in barred for form in alone):
            return None
        if self._latest[0] is not grammar:
            self._latest = grammar, self._span(grammar)
        span = self._latest[1]
        return grammar.terminal(f"{span}{none_of_texts(without)}") if span and without else span

    def _span(self, grammar: Grammar) -> str | None:
        names: dict[int, str] = {}
        for index in range(len(self._pieces) - 1, -1, -1):
            piece = self._pieces[index]
            following = [
                f"{literal(gap)} {names[place]}" for gap, place in piece.following if place in names
            ]
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
        for match in matches:
            word, before = match.group(), text[match.start() - 1 : match.start()]
            # In "camera A" and "cam_a" the letter is a name.
            plain = word.lower() in FUNCTION_WORDS and word != "A" and before not in ("_", "-", ".")
            run = run + 1 if plain else 0
            begins = (before in QUOTES or not plain) and before != "_"
            ends = run % MOST_UNENDING == 0 and text[match.end() : match.end() + 1] != "_"
            self._pieces.append(Piece(self._forms(word), begins, ends))
        for number, (one, two) in enumerate(itertools.pairwise(matches)):
            gap = text[one.end() : two.start()]
            if one.group().lower() == "a" and not gap.isspace():
                # "Region a, top left" has no article there.
                self._pieces[first + number].begins = self._pieces[first + number].ends = True
            self._link(first + number, _written_gaps(gap, one.group()), first + number + 1)
            possessive = gap in ("'", "’") and two.group().lower() == "s"
            if possessive and number + 2 < len(matches):
                gap = text[two.end() : matches[number + 2].start()]
                self._link(first + number, _written_gaps(gap, "s"), first + number + 2)

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

    def _link(self, place: int, gaps: list[str], following: int) -> None:
        self._pieces[place].following += [(quoted(gap), following) for gap in gaps]


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
