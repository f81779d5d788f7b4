"""Text values: words of the trade from the phrase file, and made-up names that can only be copied.

A word list holds entries such as "the {colour} ladder", "camera {n}" or "weld {code}". An entry
that begins with "the " is said with its article and stored without it, and what stands before a bar
is said and not stored ("sensor |{code}"), nor are quotation marks behind it. Made-up slots: {n} a
number, {code} "KX-07", {low} a small letter, {name} a pseudo-word, {tag} a file tag; any other slot
is an entry of the list of that name.
"""

from __future__ import annotations

import random
import re
from collections.abc import Callable, Mapping, Sequence

from planner_ft.data.numbers import Value

_SLOT = re.compile(r"\{([a-z_]+)\}")
_ARTICLE = re.compile(r"^(the|a|an) ")
_ONSETS = "b br c d dr f fl g gr h j k kl l m n p pr r s sk st t tr v w z th sch v".split()  # noqa: SIM905
_VOWELS = "a e i o u a e i o ei au y oa ie".split()  # noqa: SIM905
_CODAS = "n r l s t m d ck nd rk st x lm ff  ng rn".split(" ")  # noqa: SIM905
_ENDINGS = ("", "", "a", "o", "en", "berg", "vik", "sund", "ton", "i", "ey", "holm")
_QUOTED = re.compile(r"(['\"])(.+?)\1")
LETTERS = "ABCDEFGHJKLMNPRSTVWXZ"

FALLBACK: Mapping[str, Sequence[str]] = {
    "thing": (
        "the {name}",
        "the {name} tower",
        "unit {code}",
        "the {name} panel",
        "{name} {n}",
        "the {name} gate",
    ),
    "things": ("boats", "people", "birds", "vehicles", "{name}s", "poles", "signs"),
}


def _pick(items: Sequence[str], rng: random.Random) -> str:
    return items[int(rng.random() * len(items))]


def made_up_name(rng: random.Random) -> str:
    """A pronounceable name that means nothing: "Skarberg", "Tolvik"."""
    word = "".join(
        _pick(_ONSETS, rng) + _pick(_VOWELS, rng) + _pick(_CODAS, rng)
        for _ in range(1 if rng.random() < 0.5 else 2)
    )
    return (word + _pick(_ENDINGS, rng)).capitalize()


def made_up_code(rng: random.Random) -> str:
    """A code as structures bear them: "KX-07", "B12", "T-4"."""
    roll = rng.random()
    letters = _pick(LETTERS, rng) + (_pick(LETTERS, rng) if roll < 0.5 else "")
    number = rng.randrange(1, 100)
    if roll < 0.35:
        return f"{letters}-{number:02d}"
    return f"{letters}{number}" if roll < 0.7 else f"{letters}-{number}"


def made_up_tag(rng: random.Random) -> str:
    """A file tag: "run_4", "skarberg-07", "dive12"."""
    stem = _pick(
        (
            "run",
            "pass",
            "leg",
            "survey",
            "dive",
            "hull",
            "pier",
            "test",
            "log",
            "video",
            "scan",
            "site",
            "day",
            "mission",
            "base",
            "night",
        ),
        rng,
    )
    if rng.random() < 0.45:
        stem = made_up_name(rng).lower()
    joint = _pick(("_", "-", "", "_"), rng)
    roll = rng.random()
    if roll < 0.5:
        return f"{stem}{joint}{rng.randrange(1, 100)}"
    if roll < 0.75:
        return f"{stem}{joint}{_pick(('north', 'south', 'east', 'west', 'a', 'b', 'am', 'pm', 'final', 'raw', 'left', 'right', 'upper', 'close'), rng)}"
    return made_up_code(rng) if roll < 0.85 else stem


MADE_UP: dict[str, Callable[[random.Random], str]] = {
    "name": made_up_name,
    "code": made_up_code,
    "tag": made_up_tag,
    "n": lambda rng: str(rng.randrange(1, 10) if rng.random() < 0.75 else rng.randrange(10, 100)),
    "letter": lambda rng: _pick("ABCDEF", rng),
    "low": lambda rng: _pick("abcdef", rng),
}


class Lexicon:
    """The word lists of a vocabulary."""

    def __init__(self, lists: Mapping[str, Sequence[str]]) -> None:
        self.lists = {**FALLBACK, **lists}

    def entry(self, name: str, rng: random.Random) -> str:
        """A filled entry of the list, article included."""
        text = _pick(self.lists[name], rng)
        while "{" in text:
            text = _SLOT.sub(lambda match: self._fill(match.group(1), rng), text)
        return text

    def _fill(self, name: str, rng: random.Random) -> str:
        return MADE_UP[name](rng) if name in MADE_UP else _pick(self.lists[name], rng)

    def noun(self, name: str, rng: random.Random) -> Value:
        """A thing: stored without its article, said with it."""
        return self.as_value(self.entry(name, rng))

    @staticmethod
    def as_value(entry: str) -> Value:
        """An entry with its article as a value without; what stands before a bar is said alone."""
        kind, bar, name = entry.partition("|")
        if bar:
            quoted_name = _QUOTED.match(name)
            return Value(quoted_name[2] if quoted_name else name, kind + name)
        bare = _ARTICLE.sub("", entry)
        return Value(bare, entry, bare)

    def quoted(self, name: str, rng: random.Random) -> Value:
        """A text to be written down word for word: mostly in quotation marks, a single word also
        without.
        """
        bare = self.as_value(self.entry(name, rng)).value
        mark = _pick(("'", '"', "'", '"', ""), rng)
        mark = mark or ("" if " " not in bare else '"')
        return Value(bare, f"{mark}{bare}{mark}")

    def several(self, name: str, rng: random.Random, count: int, *, article: bool = False) -> Value:
        """A list of different things as it is said: "boats, buoys and people"."""
        entries = list(dict.fromkeys(self.entry(name, rng) for _ in range(count)))
        bare = [self.as_value(entry).value for entry in entries]
        said = entries if article else bare
        joint = " and " if rng.random() < 0.85 else " as well as "
        if len(said) > 2 and rng.random() < 0.3:
            joint = f",{joint}"
        return Value(bare, ", ".join(said[:-1]) + joint + said[-1] if len(said) > 1 else said[0])
