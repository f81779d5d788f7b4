"""From chosen parts to a text: articles, spaces and capitals; values are marked.

A value stands between VALUE_OPEN and VALUE_CLOSE until the text is finished, so that noise leaves
it alone and a text without its values (its skeleton) can be compared with others.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

from planner_ft.data.numbers import COMPASS, ONES, TENS, words

VALUE_OPEN, VALUE_CLOSE = "\x02", "\x03"
PIECE = tuple[str, bool]

_ARTICLES = ("a ", "an ", "the ")
_DETERMINERS = frozenset(words("the a an this that each every its any"))
_EVERY = frozenset(words("every each last past recent latest preceding per"))
_CONSONANT = ("uni", "use", "usu", "uti", "one ", "one-", "once", "eu", "u-")
_SPELT = frozenset(words("LED ROV RIB SAR NATO USV UAV RTK"))
_SPOKEN = frozenset([*ONES, *TENS, *COMPASS.values(), *words("the a an due half minus")])
_ABBREVIATED = frozenset(
    words(
        "approx. no. nr. e.g. i.e. ca. vs. ref. dr. mr. mrs. ms. st. capt. pos. brg. hdg. min."
        " max. sec. deg. att. re. lt. sgt. prof. ..."
    )
)
_GAP = re.compile(r" +(?=[ ,;?!):]|\. )|(?<=\() +")
_DOUBLED = re.compile(r",+(?=[,.;:)?!])|(?<=[?!])\.")
_START = re.compile(r'(^[^\w\x02]*|\n|[^ ]*[.?!]["”)\x03]* )(\x02?)([^\W\d_][^\W\d_]*)')


def article_for(text: str) -> str:
    """ "a" or "an", by the sound of `text`."""
    word = text.split(" ", 1)[0].strip("\"'“(,.")
    if not word:
        return "a"
    if word[0].isdigit():
        number = word.split("-")[0].split(".")[0]
        return "an" if number[0] == "8" or number in ("11", "18") else "a"
    if word[0].isupper() and (len(word) == 1 or not word[1].islower()):
        spelt = word.strip("0123456789-") in _SPELT
        return "an" if word[0] in "AEFHILMNORSX" and not spelt else "a"
    low = word.lower()
    vowel = low[0] in "aeiouåøöäé" and not f"{low} ".startswith(_CONSONANT)
    return "an" if vowel or low.startswith(("hour", "honest")) else "a"


def bare(text: str) -> str:
    """The text without its article."""
    return text.partition(" ")[2] if text.startswith(_ARTICLES) else text


def _last_word(text: str) -> str:
    """The word before the space that ends the text; empty where no space does."""
    return text[-12:-1].rpartition(" ")[2] if text.endswith(" ") else ""


def after_article(text: str) -> bool:
    """Whether a determiner ends the text: "the ", "every "."""
    return _last_word(text).lower() in _DETERMINERS


def joined(pieces: Iterable[PIECE], *, small: bool = False) -> str:
    """One text of (text, whether it is a value): articles fit what follows, gaps are closed, and
    sentences begin with capitals unless the template is `small`, written without them.
    """
    text = ""
    for piece, value in pieces:
        if not piece:
            continue
        last = _last_word(text)
        low = last.lower().strip("(\"'")
        indefinite = low in _EVERY and piece.startswith(("a ", "an "))
        if value and (low in _DETERMINERS or indefinite):
            piece = bare(piece)
        if low in ("a", "an") and piece[0] != " ":
            text = f"{text[: -len(last) - 1]}{last[:-1] if low == 'an' else last}"
            text += f"{article_for(piece)[1:]} "
        text += f"{VALUE_OPEN}{piece}{VALUE_CLOSE}" if value else piece
    # No doubled spaces or commas, no space before a mark, no comma before a stop.
    text = _DOUBLED.sub("", _GAP.sub("", text)).strip(" ,")
    text = f"{text[:-2]}." if text.endswith(" .") else text
    return text if small else _START.sub(_raised, text)


def _raised(match: re.Match[str]) -> str:
    """The start of a sentence with a capital; names and other text values stay as they are."""
    before, mark, word = match.groups()
    ended = before.rstrip(f' "”){VALUE_CLOSE}').lower().lstrip("(")
    if ended in _ABBREVIATED or (len(word) == 1 and word != "a") or (mark and word not in _SPOKEN):
        return match[0]
    return f"{before}{mark}{word[0].upper()}{word[1:]}"


def plain(text: str) -> str:
    """The text without the marks."""
    return text.replace(VALUE_OPEN, "").replace(VALUE_CLOSE, "")


def segments(text: str) -> list[PIECE]:
    """The text by what is and what is not a value; values with their marks left out."""
    first, *rest = text.split(VALUE_OPEN)
    found = [(first, False)]
    for piece in rest:
        value, _close, after = piece.partition(VALUE_CLOSE)
        found += [(value, True), (after, False)]
    return [(piece, value) for piece, value in found if piece or value]


def skeleton(text: str) -> str:
    """The text with each value replaced by an underscore."""
    return "".join("_" if value else piece for piece, value in segments(text))
