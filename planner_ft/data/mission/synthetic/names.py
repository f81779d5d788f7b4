"""Names, codes and call signs: real-looking ones, and now and then an invented word, so that
copying is learnt.
"""

from __future__ import annotations

from random import Random

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.lexicon_names import (
    PLACE_ENDS,
    PLACE_STARTS,
    SHIP_ENDS,
    SHIP_STARTS,
)

ONSETS = (
    "b",
    "c",
    "d",
    "f",
    "g",
    "h",
    "j",
    "k",
    "l",
    "m",
    "n",
    "p",
    "r",
    "s",
    "t",
    "v",
    "w",
    "bl",
    "br",
    "ch",
    "cl",
    "cr",
    "dr",
    "fl",
    "fr",
    "gl",
    "gr",
    "kl",
    "kr",
    "pl",
    "pr",
    "sh",
    "sk",
    "sl",
    "sm",
    "sn",
    "sp",
    "st",
    "str",
    "sw",
    "tr",
)
NUCLEI = (*"aeiou" * 4, "ai", "au", "ea", "ee", "ie", "oa", "oo", "y", "å", "ø", "ö")
CODAS = (
    "d",
    "g",
    "k",
    "l",
    "m",
    "n",
    "p",
    "r",
    "s",
    "t",
    "ck",
    "ld",
    "lm",
    "nd",
    "ng",
    "nk",
    "rd",
    "rk",
    "rm",
    "rn",
    "st",
)
NAME_ENDINGS = (
    "",
    "",
    "a",
    "a",
    "e",
    "o",
    "en",
    "er",
    "ia",
    "is",
    "us",
    "on",
    "ley",
    "ton",
    "vik",
    "holm",
    "berg",
    "sen",
)
WORD_ENDINGS = ("", "", "er", "el", "le", "ock", "ard", "ette", "ing", "ler")
ROMAN = ("I", "II", "III", "IV", "V", "VI")
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
GREEK = (
    "Alpha",
    "Beta",
    "Gamma",
    "Delta",
    "Echo",
    "Bravo",
    "Charlie",
    "Foxtrot",
    "Golf",
    "Hotel",
    "Kilo",
    "Lima",
    "Mike",
    "November",
    "Oscar",
    "Papa",
    "Romeo",
    "Sierra",
    "Tango",
    "Victor",
    "Whisky",
    "Zulu",
)
CODES = (
    *("@#",) * 6,
    *("#",) * 5,
    *("##",) * 5,
    *("@-##",) * 5,
    *("@@-##",) * 4,
    *("@##",) * 3,
    *("@-#",) * 2,
    *("#@",) * 3,
    *("##@",) * 2,
    "@@##",
    "@@-#",
    "@@ ##",
    "@#-##",
    "@##-#",
    "@@@-##",
    "@@-###",
    "##-##",
    "###",
    "###",
    "@/##",
    "@@#",
    "@# ##",
    "KP #.#",
    "KP ##.#",
    "KP ##",
    "No. #",
    "@",
)
PATTERNS = tuple(
    pattern
    for pattern in lexicon.CALLSIGN_PATTERNS
    if not pattern.lower().startswith(("id ", "number", "contact number"))
)


def pseudo_word(rng: Random, endings: tuple[str, ...] = WORD_ENDINGS) -> str:
    """A word that no dictionary has but anybody could say."""
    text = ""
    for _ in range(rng.choice((1, 1, 2))):
        text += (
            rng.choice(ONSETS)
            + rng.choice(NUCLEI)
            + (rng.choice(CODAS) if rng.random() < 0.4 else "")
        )
    text += rng.choice(endings)
    return text if len(text) > 3 else text + "mel"


def place_name(rng: Random) -> str:
    """A place name of two elements, such as Sandvik or Cuxhaven."""
    return rng.choice(PLACE_STARTS) + rng.choice(PLACE_ENDS)


def ship_name(rng: Random) -> str:
    """A ship name of two words, such as Nordic Star."""
    return f"{rng.choice(SHIP_STARTS)} {rng.choice(SHIP_ENDS)}"


def proper_name(rng: Random) -> str:
    """A name of a vessel, a place or a structure, with its capitals."""
    roll = rng.random()
    if roll < 0.5:
        name = rng.choice(lexicon.PROPER_NAMES)
    elif roll < 0.72:
        name = place_name(rng)
    elif roll < 0.88:
        name = ship_name(rng)
    else:
        name = pseudo_word(rng, NAME_ENDINGS).capitalize()
    roll = rng.random()
    if roll < 0.06:
        name += f" {rng.choice(ROMAN)}"
    elif roll < 0.14:
        name += f" {rng.randint(1, 12) if rng.random() < 0.8 else rng.randint(13, 40)}"
    elif roll < 0.15:
        name += f" {rng.choice(GREEK[:6])}"
    return name


def person(rng: Random) -> str:
    """Somebody's name."""
    title = rng.choice(("", "", "", "", "Mr ", "Ms ", "Captain "))
    return title + rng.choice(lexicon.PROPER_NAMES).split(" ")[0]


def code(rng: Random) -> str:
    """A code such as T-14, B3, 7A or KP 12.4."""
    return fill_pattern(rng.choice(CODES), rng)


def fill_pattern(pattern: str, rng: Random) -> str:
    """`pattern` with each # a digit and each @ a capital letter; a number of one digit is not
    zero.
    """
    if "#" in pattern and "##" not in pattern:
        pattern = pattern.replace("#", rng.choice("123456789"), 1)
    return "".join(
        rng.choice("0123456789") if mark == "#" else rng.choice(LETTERS) if mark == "@" else mark
        for mark in pattern
    )


def call_sign(rng: Random) -> tuple[str, str | None]:
    """An id or call sign to follow, and what is said ahead of it ("call sign")."""
    text = _identity(rng)
    for ahead in ("call sign ", "callsign "):
        if text.startswith(ahead):
            return text.removeprefix(ahead), ahead.strip()
    return text, (
        "call sign" if not text[0].isdigit() and text[0].isupper() and rng.random() < 0.06 else None
    )


def _identity(rng: Random) -> str:
    roll = rng.random()
    if roll < 0.76:
        return fill_pattern(rng.choice(PATTERNS), rng)
    if roll < 0.86:
        return f"{rng.choice(GREEK)} {rng.randint(1, 40)}"
    if roll < 0.92:
        name = (
            rng.choice(lexicon.PROPER_NAMES)
            if rng.random() < 0.8
            else pseudo_word(rng, NAME_ENDINGS).capitalize()
        )
        return f"{name} {rng.randint(1, 99)}"
    return code_id(rng) if roll < 0.97 else str(rng.randint(2, 999))


def code_id(rng: Random) -> str:
    """A code that can stand for a vessel."""
    return fill_pattern(
        rng.choice(("@#", "@##", "@-##", "@@-##", "@@##", "@@@-##", "##@", "@@-###", "###")), rng
    )
