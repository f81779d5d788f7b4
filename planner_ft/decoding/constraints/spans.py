"""Text values as spans of a command: its words in their order, as they stand or with their spelling
put right.

A span begins with no article and ends at a word's end. A possessive may be dropped, a comma or a
hyphen be a blank, a word in capitals be written small, and a word that no list knows be replaced by
a known one that is near. Where the command leaves words out ("the red buoy and the green one"), a
value may be two spans, and a plural its singular.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Sequence
from dataclasses import dataclass, field

from planner_ft.decoding.constraints.budget import LONGEST_WORD
from planner_ft.decoding.constraints.grammar import Grammar, none_of_texts
from planner_ft.decoding.constraints.patterns import QUOTE, escaped, literal, quoted, regex
from planner_ft.facts import corrections, edit_distance, is_known

IDENTIFIER = r"(?:[A-Za-z]+(?=[\w-]*[\d_])[\w-]*\w|\d+(?=[\w-]*[A-Za-z_])[\w-]*\w)"
MOST_WORDS = 2000
"""Words of a command that spans are made of; compiling more takes longer than an answer."""
BLOCK = 60
"""Words that a span can have at least: the engine follows a row of words by recursion, so that long
rows are cut.
"""

ARTICLES = frozenset({"the", "a", "an"})
UNBEGINNING = ARTICLES | frozenset(
    (
        "and",
        "or",
        "of",
        "to",
        "at",
        "in",
        "on",
        "for",
        "from",
        "by",
        "with",
        "then",
        "now",
        "is",
        "are",
        "be",
        "it",
        "as",
        "so",
        "if",
        "but",
        "than",
    )
)
"""Words that no value begins with."""
PICTURES = ("snapshot", "snapshots", "picture", "pictures", "still", "stills", "image", "images")
NO_NAME_BEGINS = UNBEGINNING | frozenset(
    (
        *(
            "both",
            "between",
            "each",
            "every",
            "any",
            "there",
            "here",
            "this",
            "that",
            "while",
            "during",
            "until",
            "when",
            "once",
            "only",
            "also",
            "not",
            "its",
        ),
        *PICTURES,
    )
)
"""Words that no name begins with."""
UNENDING = frozenset(
    {
        "the",
        "an",
        "and",
        "or",
        "of",
        "with",
        "then",
        "to",
        "from",
        "for",
        "now",
        "is",
        "are",
        "be",
        "if",
        "but",
        "than",
    }
)
"""Words that no value ends with."""
UNCROSSED = frozenset(
    (
        *(
            "is",
            "are",
            "was",
            "were",
            "be",
            "been",
            "has",
            "have",
            "had",
            "shall",
            "should",
            "must",
            "would",
            "could",
        ),
        *(
            "then",
            "when",
            "while",
            "before",
            "after",
            "until",
            "if",
            "because",
            "so",
            "but",
            "please",
            "there",
            "here",
        ),
    )
)
"""Words that no description goes on over, written small: with them another clause has begun."""
FILLERS = frozenset({"uh", "um", "er", "erm", "uhm", "umm", "hm", "hmm"})
"""Sounds of a speaker who thinks, which stand in no description."""
_FILLED = re.compile(
    rf"(?:[ ,.…–—-]{{1,3}}(?:{'|'.join(sorted(FILLERS))})\b){{1,4}}[ ,.…–—-]{{1,3}}", re.IGNORECASE
)
QUOTES = ('"', "'", "“", "‘", "«")
"""Signs behind which a value begins with any word: a note "as found"."""
KINDS = frozenset(
    (
        *(
            "region",
            "regions",
            "stream",
            "streams",
            "camera",
            "cameras",
            "sensor",
            "sensors",
            "cloud",
            "label",
            "labels",
            "note",
            "notes",
            "tag",
            "tags",
        ),
        *("leg", "legs", "step", "steps", "hold", "course", "data"),
        *PICTURES,
    )
)
"""Words for what has a name or is done, and are none."""
_NAMED_KIND = re.compile(
    rf"(?:{'|'.join(sorted(KINDS))}|objects?|sounder|sonde|roi|target|marker|file)\s+{IDENTIFIER}",
    re.IGNORECASE,
)
"""Such a word before an identifier: the value is "quad_2" in "camera quad_2"; "camera 2" stays
whole.
"""
MOST_UNENDING = 4
"""As many of them in a row are no English; a value may end there, since an answer must be able
to.
"""

_ONE_LETTER_SCRIPTS = "\u0e00-\u0eff\u3040-\u30ff\u3400-\u9fff\uf900-\ufaff"
"""Scripts without blanks between words: each letter counts as a word."""
_PIECE = re.compile(rf"[{_ONE_LETTER_SCRIPTS}]|(?:(?![{_ONE_LETTER_SCRIPTS}])[^\W_])+")
_INSIDE = re.compile(r"[-‐–'’./&+_]")
_AROUND = re.compile(r""" ?[-–,"“”'’&/] ?|[,'’"”] ["“]?|, ["“]""")
_QUOTED = re.compile(r"""["“”«»]|[‘'’]\W*\s|\s\W*[‘'’]""")
"""What stands between two words one of which begins or ends a quotation."""
_ELLIPSIS = re.compile(
    r"\b(?:ones?|others?|same|both|two|three|four|pair|another|second|latter|former|likewise|ditto|respectively|and"
    r" (?:the |a )?\w+ \w+s)\b",
    re.IGNORECASE,
)


@dataclass
class Piece:
    """A word: what may be written for it, whether it can be a value `alone`, and what may follow,
    as (gap, number of the next word).
    """

    forms: tuple[str, ...]
    begins: bool = True
    ends: bool = True
    alone: bool = True
    following: list[tuple[str, int]] = field(default_factory=list)


class Spans:
    """The spans of some texts: a command, and what else values may come from.

    With `named`, values are names: what stands in quotation marks is apart from what stands before
    and behind it, and a word for the kind of thing ("region", "camera") is none.
    """

    def __init__(self, texts: Sequence[str], *, named: bool = False) -> None:
        self._named = named
        self.loose = any(_ELLIPSIS.search(text) for text in texts)
        self._twice: list[str] = []
        """Words that a value does not begin with twice."""
        self._pieces: list[Piece] = []
        for text in texts:
            self._read(text)

    @property
    def too_long(self) -> bool:
        """Whether the texts have more words than spans can be made of."""
        return len(self._pieces) > MOST_WORDS

    def terminal(self, grammar: Grammar, without: Sequence[str] = ()) -> str | None:
        """The terminal of a span in quotation marks, none of `without`; None where there is no
        span, or no word beside these.
        """
        if without and not self._has_word_beside(without):
            return None
        starts = self._chain(grammar, 0)
        if len(self._pieces) > BLOCK:
            starts |= self._chain(grammar, BLOCK // 2)
        if not starts:
            return None
        span, marks = grammar.terminal(" | ".join(sorted(starts))), literal('"')
        joined = f'(" " {span})?' if self.loose else ""
        whole = grammar.terminal(f"{marks} {span} {joined} {marks}")
        if self.loose and self._twice and len(self._pieces) <= BLOCK:
            words = "|".join(
                dict.fromkeys(
                    f"{escaped(quoted(word))} {escaped(quoted(word))}" for word in self._twice
                )
            )
            stammer = regex(rf'(?i:{QUOTE}({words})( [^"]*)?")')
            whole = grammar.terminal(f"{whole} & ~{stammer}")
        return grammar.terminal(f"{whole}{none_of_texts(without)}") if without else whole

    def _has_word_beside(self, without: Sequence[str]) -> bool:
        """Whether a single word is a span and none of these texts: what they leave is not empty
        then.
        """
        barred = {quoted(text).lower() for text in without}
        return any(
            form.lower() not in barred
            for piece in self._pieces
            if piece.begins and piece.ends and piece.alone
            for form in piece.forms
        )

    def _chain(self, grammar: Grammar, offset: int) -> set[str]:
        """The terminals of the spans from each word on; rows are cut at every BLOCK words from
        `offset`.
        """
        cut = len(self._pieces) > BLOCK
        names: dict[int, str] = {}
        behind_of: dict[int, list[str]] = {}
        for index in range(len(self._pieces) - 1, -1, -1):
            piece = self._pieces[index]
            block = (index + offset) // BLOCK
            following = [
                f"{literal(gap)} {names[place]}"
                for gap, place in piece.following
                if place in names and not (cut and (place + offset) // BLOCK != block)
            ]
            if piece.forms and (following or piece.ends):
                forms = " | ".join(literal(form) for form in piece.forms)
                behind = (
                    f"({' | '.join(following)}){'?' if piece.ends else ''}" if following else ""
                )
                names[index] = grammar.terminal(f"({forms}) {behind}")
                behind_of[index] = following
        found = set()
        for index, name in names.items():
            piece = self._pieces[index]
            if piece.begins and piece.alone:
                found.add(name)
            elif piece.begins and behind_of[index]:
                found.add(
                    grammar.terminal(
                        f"({' | '.join(literal(form) for form in piece.forms)})"
                        f" ({' | '.join(behind_of[index])})"
                    )
                )
        return found

    def _read(self, text: str) -> None:
        first, matches, run = len(self._pieces), list(_PIECE.finditer(text)), 0
        slips = self._named and sum(_misspelt(match.group()) for match in matches) > 2
        titled = not self._named and _in_titles(text)
        if not self._named:
            self._twice += dict.fromkeys(
                match.group() for match in matches if len(match.group()) > 1
            )
        for match in matches:
            word = match.group()
            forms = self._spellings(match, text, slips=slips, titled=titled)
            # In "camera A" and "cam_a" the letter is a name.
            named = word == "A" or text[match.start() - 1 : match.start()] in ("_", "-", ".")
            run = 0 if named or word.lower() not in UNENDING else run + 1
            quoted_here = text[match.start() - 1 : match.start()] in QUOTES
            barred = word.lower() in (
                NO_NAME_BEGINS if self._named else UNBEGINNING
            ) or self._named_kind(text, match)
            begins = (quoted_here or not barred) and text[match.start() - 1 : match.start()] != "_"
            ends = run % MOST_UNENDING == 0 and text[match.end() : match.end() + 1] != "_"
            self._pieces.append(
                Piece(
                    forms,
                    begins,
                    ends,
                    alone=quoted_here or not (self._named and word.lower() in KINDS),
                )
            )
        gaps = [text[one.end() : two.start()] for one, two in itertools.pairwise(matches)]
        for number, gap in enumerate(gaps):
            place = first + number
            if self._named and _QUOTED.search(gap):
                continue
            if not self._named and any(
                match.group() in UNCROSSED for match in matches[number : number + 2]
            ):
                continue
            # "A-40" and "region a, top left" have no article.
            if not gap.isspace() and matches[number].group().lower() == "a":
                self._pieces[place].begins = self._pieces[place].ends = True
            self._link(place, _written_gaps(gap, matches[number].group()), place + 1)
            behind = number + 1
            while (
                not self._named
                and behind < len(gaps)
                and matches[behind].group().lower() in FILLERS
            ):
                behind += 1
            if behind > number + 1 and _FILLED.fullmatch(
                text, matches[number].end(), matches[behind].start()
            ):
                self._link(place, [" "], first + behind)
            if (
                gap in ("'", "’")
                and matches[number + 1].group().lower() == "s"
                and number + 1 < len(gaps)
            ):
                self._link(place, _written_gaps(gaps[number + 1], "s"), place + 2)

    def _named_kind(self, text: str, match: re.Match[str]) -> bool:
        """Whether a word says of what kind the identifier behind it is. A task's own values are
        taken as they are.
        """
        return (
            self._named and match.start() > 0 and _NAMED_KIND.match(text, match.start()) is not None
        )

    def _link(self, place: int, gaps: list[str], following: int) -> None:
        self._pieces[place].following += [(quoted(gap), following) for gap in gaps]

    def _spellings(
        self, match: re.Match[str], text: str, *, slips: bool, titled: bool
    ) -> tuple[str, ...]:
        """How a word may be written in a value: put right in a text that is full of slips, a name
        with its capital, a filler not at all.
        """
        word = match.group()
        right = (
            _put_right(word)
            if slips and text[match.start() - 1 : match.start()] not in (*QUOTES, "_", "-")
            else ""
        )
        if right:
            return (quoted(right),)
        if len(quoted(word).encode()) > LONGEST_WORD // 2 or (
            not self._named and word.lower() in FILLERS
        ):
            return ()
        forms = self._forms(word)
        if not titled and not self._named and _is_name(word, text, match.start()):
            return tuple(form for form in forms if form != word.lower())
        return forms

    def _forms(self, word: str) -> tuple[str, ...]:
        forms = [word, word.lower()]
        if word.isupper() and len(word) > 1:
            forms.append(word.title())
        forms += corrections(word)
        if self.loose:
            forms += [single for form in list(forms) for single in _singular(form)]
        return tuple(dict.fromkeys(quoted(form) for form in forms))


def _misspelt(word: str) -> bool:
    """Whether a word in small letters is in no list and near to a known one."""
    return (
        len(word) > 3
        and word.isascii()
        and word.islower()
        and not is_known(word)
        and bool(corrections(word))
    )


def _put_right(word: str) -> str:
    """The one known word that a long word in small letters is a letter away from, as in a text that
    is full of such words; empty if there is none.
    """
    if len(word) < 6 or not _misspelt(word):
        return ""
    near = [candidate for candidate in corrections(word) if edit_distance(word, candidate, 1) <= 1]
    return near[0] if len(near) == 1 else ""


def _in_titles(text: str) -> bool:
    """Whether a text writes most of its words with a capital."""
    words = [
        match.group()
        for match in _PIECE.finditer(text)
        if len(match.group()) > 3 and match.group().isalpha()
    ]
    return 4 * sum(word[0].isupper() for word in words) > 3 * len(words)


def _is_name(word: str, text: str, start: int) -> bool:
    """Whether a word keeps its capital in a description: no list knows it, or it stands within a
    clause.
    """
    if not word[0].isupper() or word.isupper() or not word.isalpha():
        return False
    return (
        not word[0].isascii()
        or not is_known(word.lower())
        or (text[start - 2 : start - 1].isalnum() and text[start - 1 : start] == " ")
    )


def _written_gaps(gap: str, before: str) -> list[str]:
    """What may stand between two words that have `gap` between them; nothing where a value cannot
    go on.
    """
    if not gap:
        return [""]
    if gap.isspace():
        return [] if "\n" in gap else [" "]
    collapsed = " ".join(gap.split(" "))
    if _INSIDE.fullmatch(gap):
        return [gap, " "] if gap in "-‐/" else [gap]
    if gap == ". " and len(before) <= 3:
        return [gap, " "]
    return [collapsed, " "] if _AROUND.fullmatch(collapsed) else []


def _singular(word: str) -> list[str]:
    """The singulars that an English plural can have."""
    if len(word) < 4 or not word.endswith("s") or word.endswith("ss"):
        return []
    forms = [word[:-1]]
    if word.endswith("ies"):
        forms.append(word[:-3] + "y")
    elif word.endswith("es"):
        forms.append(word[:-2])
    return forms
