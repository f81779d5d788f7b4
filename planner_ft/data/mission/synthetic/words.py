"""Targets, features, names and items: from the lexicon, and made up from syllables so that copying is learnt."""

from __future__ import annotations

from random import Random

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.positions import Position, draw_position

ONSETS = (
    "b", "c", "d", "f", "g", "h", "j", "k", "l", "m", "n", "p", "r", "s", "t", "v", "w", "z", "bl", "br", "ch", "cl", "cr", "dr", "fj", "fl", "fr",
    "gl", "gr", "kl", "kn", "kr", "pl", "pr", "qu", "sc", "sch", "sh", "sk", "sl", "sm", "sn", "sp", "st", "str", "sv", "sw", "th", "tr", "tw", "vr",
    "y",
)  # fmt: skip
NUCLEI = (
    "a", "e", "i", "o", "u", "a", "e", "i", "o", "u", "a", "e", "i", "o", "u", "a", "e", "i", "o", "u", "ai", "au", "ea", "ee", "ei", "ie", "oa",
    "oo", "ou", "y", "å", "ø", "ö", "é",
)  # fmt: skip
CODAS = (
    "b", "ck", "d", "f", "g", "k", "l", "m", "n", "p", "r", "s", "t", "x", "ld", "lf", "lk", "lm", "ln", "lt", "mb", "mp", "nd", "ng", "nk", "nn",
    "nt", "rd", "rg", "rk", "rm", "rn", "rst", "rt", "sk", "ss", "st", "th", "tt", "ts",
)  # fmt: skip
ENDINGS = (
    "",
    "",
    "",
    "a",
    "e",
    "o",
    "en",
    "er",
    "y",
    "ing",
    "el",
    "ar",
    "um",
    "is",
    "us",
    "on",
    "ley",
    "ton",
    "vik",
    "sund",
    "holm",
    "berg",
    "fjord",
    "stad",
    "by",
    "gate",
)
WORD_ENDINGS = ("", "", "er", "el", "le", "ing", "ed", "y", "ish", "al", "ane", "ock", "ard", "ette", "ic", "ous", "board", "line", "head", "post", "ing")
ROMAN = ("I", "II", "III", "IV", "V", "VI", "VII", "IX")
LETTERS = "ABCDEFGHJKLMNPQRSTUVWXYZ"
ITEMS = tuple(item for item in lexicon.DATA_ITEMS if "report" not in item and item != "summary")
PATTERNS = tuple(pattern for pattern in lexicon.CALLSIGN_PATTERNS if not pattern.lower().startswith(("id ", "number", "contact number")))
MARKS = ("cross", "board", "lamp", "marker", "triangle", "square", "tag", "beacon", "disc", "panel", "diamond", "circle")
RECORDINGS = ("log", "pictures", "files", "scan", "video", "readings", "frames", "list", "data", "stills", "clips", "track")
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


def pseudo_word(rng: Random, endings: tuple[str, ...] = WORD_ENDINGS) -> str:
    """A word that no dictionary has, made of one to three syllables."""
    text = ""
    for _ in range(rng.choice((1, 1, 2, 2, 3))):
        text += rng.choice(ONSETS) + rng.choice(NUCLEI) + (rng.choice(CODAS) if rng.random() < 0.6 else "")
    text += rng.choice(endings)
    return text if len(text) > 2 else text + "mel"


def proper_name(rng: Random) -> str:
    """A name of a vessel, a place or a structure, with its capitals."""
    roll = rng.random()
    if roll < 0.45:
        name = rng.choice(lexicon.PROPER_NAMES)
    else:
        name = pseudo_word(rng, ENDINGS).capitalize()
        if roll > 0.9:
            name += " " + pseudo_word(rng, ENDINGS).capitalize()
    roll = rng.random()
    if roll < 0.1:
        name += f" {rng.choice(ROMAN)}"
    elif roll < 0.24:
        name += f" {rng.randint(1, 30)}"
    elif roll < 0.28:
        name += f" {rng.choice(GREEK)}"
    return name


def person(rng: Random) -> str:
    """Somebody's name."""
    title = rng.choice(("", "", "", "", "Mr ", "Ms ", "Captain "))
    return title + (rng.choice(lexicon.PROPER_NAMES).split(" ")[0] if rng.random() < 0.7 else pseudo_word(rng, ENDINGS).capitalize())


def code(rng: Random) -> str:
    """A code such as KX-07, B12 or ZB-31."""
    pattern = rng.choice(("@@-##", "@@-#", "@##", "@-##", "@@##", "@#", "@@ ##", "@##-#", "@@@-##", "@@-###", "##@", "@ #", "##", "#"))
    return fill_pattern(pattern, rng)


def fill_pattern(pattern: str, rng: Random) -> str:
    """`pattern` with each # a digit and each @ a capital letter."""
    return "".join(rng.choice("0123456789") if mark == "#" else rng.choice(LETTERS) if mark == "@" else mark for mark in pattern)


def call_sign(rng: Random) -> tuple[str, str | None]:
    """An id or call sign to follow, and what is said ahead of it ("call sign")."""
    text = _identity(rng)
    for ahead in ("call sign ", "callsign "):
        if text.startswith(ahead):
            return text.removeprefix(ahead), ahead.strip()
    return text, "call sign" if not text[0].isdigit() and text[0].isupper() and rng.random() < 0.06 else None


def _identity(rng: Random) -> str:
    roll = rng.random()
    if roll < 0.7:
        return fill_pattern(rng.choice(PATTERNS), rng)
    if roll < 0.8:
        return f"{rng.choice(GREEK)} {rng.randint(1, 40)}"
    if roll < 0.9:
        return f"{pseudo_word(rng, ENDINGS).capitalize()} {rng.randint(1, 99)}"
    return code(rng) if roll < 0.95 else str(rng.randint(2, 999))


def noun(rng: Random) -> str:
    """A thing on the water or ashore."""
    roll = rng.random()
    if roll < 0.88:
        return rng.choice(lexicon.TARGET_NOUNS)
    return pseudo_word(rng) if roll < 0.95 else f"{pseudo_word(rng)} {rng.choice(lexicon.TARGET_NOUNS).split()[-1]}"


def adjective(rng: Random) -> str:
    """A word that tells one thing from another."""
    return rng.choice(lexicon.TARGET_ADJECTIVES) if rng.random() < 0.92 else pseudo_word(rng)


def description(rng: Random, base: str) -> tuple[str, bool]:
    """A target description on the noun `base`, and whether texts put "the" before it."""
    roll = rng.random()
    if roll < 0.34:
        return f"{adjective(rng)} {base}", True
    if roll < 0.42:
        first, second = adjective(rng), adjective(rng)
        return (f"{first} {second} {base}" if first != second else f"{first} {base}"), True
    if roll < 0.56:
        return f"{base} {proper_name(rng)}", rng.random() < 0.7
    if roll < 0.66:
        return f"{base} {code(rng)}", rng.random() < 0.25
    if roll < 0.7:
        return f"{proper_name(rng)} {base}", True
    if roll < 0.8:
        extra = with_phrase(rng)
        return (f"{adjective(rng)} {base} {extra}" if rng.random() < 0.3 else f"{base} {extra}"), True
    if roll < 0.83:
        return f"{adjective(rng)} {base} {proper_name(rng)}", True
    return base, True


def with_phrase(rng: Random) -> str:
    """A "with ..." phrase that belongs to a description."""
    if rng.random() < 0.75:
        return rng.choice(lexicon.WITH_PHRASES)
    return rng.choice((f"with the {adjective(rng)} {noun(rng).split()[-1]}", f"with {adjective(rng)} stripes", f"with the {pseudo_word(rng)} mark"))


def structure(rng: Random, key: int, *, located: bool) -> Target:
    """A structure or vessel, with coordinates when `located`."""
    base = noun(rng)
    text, article = description(rng, base)
    return Target(key, text, _place(rng, located), article, noun=base, whereabouts="" if located or rng.random() > 0.22 else rng.choice(lexicon.WHEREABOUTS))


def moving_thing(rng: Random, key: int, *, located: bool) -> Target:
    """Something that drifts or sails and can be stayed with."""
    base = rng.choice(lexicon.MOVING_TARGETS)
    text, article = (base, True) if rng.random() < 0.3 else description(rng, base.split()[-1] if rng.random() < 0.3 else base)
    return Target(
        key,
        text,
        _place(rng, located),
        article,
        movable=True,
        noun=base.split()[-1],
        whereabouts="" if located or rng.random() > 0.3 else rng.choice(lexicon.WHEREABOUTS),
    )


def _place(rng: Random, located: bool) -> Position | None:
    return draw_position(rng) if located else None


def dock_spot(rng: Random) -> str:
    """A docking place by name, without article."""
    roll = rng.random()
    if roll < 0.6:
        return rng.choice(lexicon.DOCK_SPOTS)
    kind = rng.choice(("berth", "pontoon", "jetty", "quay", "slip", "pier", "dock", "mooring", "float", "wharf"))
    if roll < 0.72:
        return f"{kind} {rng.randint(1, 30)}"
    if roll < 0.8:
        return f"{kind} {rng.choice(LETTERS)}{rng.choice(('', '', str(rng.randint(1, 9))))}"
    return f"{adjective(rng)} {kind}" if roll < 0.9 else f"{proper_name(rng)} {kind}"


def feature(rng: Random) -> str:
    """A part of a structure that a camera can look at, without article."""
    roll = rng.random()
    base = rng.choice(lexicon.FEATURES) if roll < 0.9 else pseudo_word(rng) if roll < 0.96 else f"{pseudo_word(rng)} {rng.choice(lexicon.FEATURES).split()[-1]}"
    if rng.random() < 0.28:
        base = f"{adjective(rng)} {base}"
    return f"{base} {rng.choice(lexicon.FEATURE_PHRASES)}" if rng.random() < 0.13 else base


def dock_mark(rng: Random) -> str:
    """A mark that guides a docking by camera."""
    if rng.random() < 0.7:
        return rng.choice(lexicon.DOCK_MARKS)
    return f"{adjective(rng)} {rng.choice((*MARKS, pseudo_word(rng)))}"


def side(rng: Random) -> str:
    """A side of a structure, one bare word."""
    return rng.choice(lexicon.SIDES)


def data_item(rng: Random) -> str:
    """Something to send, without article."""
    if rng.random() < 0.8:
        return rng.choice(ITEMS)
    return f"{pseudo_word(rng) if rng.random() < 0.5 else adjective(rng)} {rng.choice(RECORDINGS)}"
