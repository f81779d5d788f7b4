"""From chosen parts to a text: articles, spaces and capitals; values are marked.

A value stands between VALUE_OPEN and VALUE_CLOSE until the text is finished, so that noise leaves
it alone and a text without its values (its skeleton) can be compared with others.
"""

from __future__ import annotations

from collections.abc import Iterable

from planner_ft.data.numbers import COMPASS, ONES, TENS, words
from planner_ft.data.templates.grammar import Nodes

VALUE_OPEN, VALUE_CLOSE = "\x02", "\x03"
PIECE = tuple[str, bool]

_ARTICLES = ("a ", "an ", "the ")
_DETERMINERS = frozenset(words("the a an this that each every its any"))
_EVERY = frozenset(words("every each last past recent latest preceding per"))
_CONSONANT = ("uni", "use", "usu", "uti", "one ", "one-", "once", "eu", "u-")
_SPELT = frozenset(words("LED ROV RIB SAR NATO USV UAV RTK"))
_SPOKEN = frozenset([*ONES, *TENS, *COMPASS.values(), "the", "a", "an", "due", "half", "minus"])
_ABBREVIATED = frozenset(
    words(
        "approx. no. nr. e.g. i.e. ca. vs. ref. dr. mr. mrs. ms. st. capt. pos. brg. hdg. min."
        " max. sec. deg. att. re. lt. sgt. prof."
    )
)
_SPACES = (
    *(("  ", " "), (" ,", ","), (" ;", ";"), (" ?", "?"), (" !", "!"), (",,", ","), (",.", ".")),
    *((",;", ";"), (",:", ":"), (",)", ")"), (",?", "?"), (",!", "!"), ("?.", "?"), ("!.", "!")),
    *((" )", ")"), (" . ", ". "), ("( ", "("), (" :", ":")),
)


def article_for(text: str) -> str:
    """ "a" or "an", by the sound of `text`."""
    word = text.split(" ", 1)[0].strip("\"'“(,.")
    if not word:
        return "a"
    if word[0].isdigit():
        number = word.split("-")[0].split(".")[0]
        return "an" if number[0] == "8" or number in ("11", "18") else "a"
    if word[0].isupper() and (len(word) == 1 or not word[1].islower()):
        if word.strip("0123456789-") in _SPELT:
            return "a"
        return "an" if word[0] in "AEFHILMNORSX" else "a"
    low = word.lower()
    if low.startswith(("hour", "honest")):
        return "an"
    return "an" if low[0] in "aeiouåøöäé" and not f"{low} ".startswith(_CONSONANT) else "a"


def bare(text: str) -> str:
    """The text without its article."""
    for article in _ARTICLES:
        if text.startswith(article):
            return text[len(article) :]
    return text


def joined(pieces: Iterable[PIECE], *, small: bool = False) -> str:
    """One text of (text, whether it is a value): articles fit what follows, gaps are closed, and
    sentences begin with capitals unless the template is `small`, written without them.
    """
    text = ""
    for piece, value in pieces:
        if not piece:
            continue
        last = text[-12:].rpartition(" ")[0].rpartition(" ")[2] if text.endswith(" ") else ""
        low = last.lower().strip("(\"'")
        if (value and low in _DETERMINERS) or (
            value and low in _EVERY and piece.startswith(("a ", "an "))
        ):
            piece = bare(piece)
        if low in ("a", "an") and piece[0] != " ":
            text = f"{text[: -len(last) - 1]}{last[:-1] if low == 'an' else last}"
            text += f"{article_for(piece)[1:]} "
        text += f"{VALUE_OPEN}{piece}{VALUE_CLOSE}" if value else piece
    return tidied(text) if small else capitalised(tidied(text))


def is_small(nodes: Nodes) -> bool:
    """Whether a template begins with a small letter of its own."""
    return bool(nodes) and isinstance(nodes[0], str) and nodes[0][:1].islower()


def tidied(text: str) -> str:
    """No doubled spaces or commas, no space before a mark, no comma before a stop."""
    for wrong, right in _SPACES:
        while wrong in text:
            text = text.replace(wrong, right)
    text = text.strip(" ,")
    return f"{text[:-2]}." if text.endswith(" .") else text


def capitalised(text: str) -> str:
    """A capital at the start of every sentence; names and other text values stay as they are."""
    start = 0
    while start < len(text) and not text[start].isalnum() and text[start] != VALUE_OPEN:
        start += 1
    letters = list(text)
    places = [start]
    for place, mark in enumerate(text):
        if mark == "\n" or (mark == " " and place and _ends_sentence(text, place)):
            places.append(place + 1)
    for place in places:
        _raise(text, letters, place)
    return "".join(letters)


def _ends_sentence(text: str, place: int) -> bool:
    before = text[max(0, place - 12) : place].rstrip('"”)' + VALUE_CLOSE)
    if not before or before[-1] not in ".?!" or before.endswith("..."):
        return False
    return before.rpartition(" ")[2].lower().lstrip("(") not in _ABBREVIATED


def _raise(text: str, letters: list[str], place: int) -> None:
    value = text[place : place + 1] == VALUE_OPEN
    place += value
    end = place
    while end < len(text) and (text[end].isalpha() or text[end] == "'"):
        end += 1
    word = text[place:end]
    if not word or not word[0].islower() or (len(word) == 1 and word != "a"):
        return
    if not value or word in _SPOKEN:
        letters[place] = word[0].upper()


def plain(text: str) -> str:
    """The text without the marks."""
    return text.replace(VALUE_OPEN, "").replace(VALUE_CLOSE, "")


def segments(text: str) -> list[PIECE]:
    """The text by what is and what is not a value; values with their marks left out."""
    found: list[PIECE] = []
    for piece in text.split(VALUE_OPEN):
        value, closed, rest = piece.partition(VALUE_CLOSE)
        if closed:
            found.append((value, True))
            found.append((rest, False))
        else:
            found.append((piece, False))
    return [(piece, value) for piece, value in found if piece or value]


def skeleton(text: str) -> str:
    """The text with each value replaced by an underscore."""
    return "".join("_" if value else piece for piece, value in segments(text))
