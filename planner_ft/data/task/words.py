"""Text values: words of the trade from the phrase file, and made-up names that can only be copied.

A word list holds entries such as "the {colour} ladder", "camera {n}" or "weld {code}". An entry
that begins with "the " is said with its article and stored without it, and what stands before a bar
is said and not stored ("sensor |{code}"), nor are quotation marks behind it. Made-up slots: {n} a
number, {code} "KX-07", {low} a small letter, {name} a pseudo-word, {tag} a file tag; any other slot
is an entry of the list of that name.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Mapping, Sequence

from planner_ft.data.numbers import Value, pick
from planner_ft.data.templates.render import bare

_ONSETS = "b br c d dr f fl g gr h j k kl l m n p pr r s sk st t tr v w z th sch v".split()  # noqa: SIM905
_VOWELS = "a e i o u a e i o ei au y oa ie".split()  # noqa: SIM905
_CODAS = "n r l s t m d ck nd rk st x lm ff  ng rn".split(" ")  # noqa: SIM905
_ENDINGS = ("", "", "a", "o", "en", "berg", "vik", "sund", "ton", "i", "ey", "holm")
_STEMS = [
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
]
_TAILS = "north south east west a b am pm final raw left right upper close".split()  # noqa: SIM905
LETTERS = "ABCDEFGHJKLMNPRSTVWXZ"
FALLBACK: Mapping[str, Sequence[str]] = {
    "thing": ("the {name}", "the {name} tower", "unit {code}", "the {name} panel", "{name} {n}"),
    "things": ("boats", "people", "birds", "vehicles", "{name}s", "poles", "signs"),
}


def made_up_name(rng: random.Random) -> str:
    """A pronounceable name that means nothing: "Skarberg", "Tolvik"."""
    syllables = 1 if rng.random() < 0.5 else 2
    parts = [pick(part, rng) for _ in range(syllables) for part in (_ONSETS, _VOWELS, _CODAS)]
    return ("".join(parts) + pick(_ENDINGS, rng)).capitalize()


def made_up_code(rng: random.Random) -> str:
    """A code as structures bear them: "KX-07", "B12", "T-4"."""
    letters = pick(LETTERS, rng) + pick((pick(LETTERS, rng), ""), rng)
    return letters + pick(("-{:02d}", "{}", "-{}"), rng).format(rng.randrange(1, 100))


def made_up_tag(rng: random.Random) -> str:
    """A file tag: "run_4", "skarberg-07", "dive12"."""
    stem = made_up_name(rng).lower() if rng.random() < 0.45 else pick(_STEMS, rng)
    roll = rng.random()
    if roll < 0.75:
        tail = str(rng.randrange(1, 100)) if roll < 0.5 else pick(_TAILS, rng)
        return stem + pick(("_", "-", "", "_"), rng) + tail
    return made_up_code(rng) if roll < 0.85 else stem


MADE_UP: dict[str, Callable[[random.Random], str]] = {
    "name": made_up_name,
    "code": made_up_code,
    "tag": made_up_tag,
    "n": lambda rng: str(rng.randrange(1, 10) if rng.random() < 0.75 else rng.randrange(10, 100)),
    "letter": lambda rng: str(pick("ABCDEF", rng)),
    "low": lambda rng: str(pick("abcdef", rng)),
}


class Lexicon:
    """The word lists of a vocabulary."""

    def __init__(self, lists: Mapping[str, Sequence[str]]) -> None:
        self.lists = {**FALLBACK, **lists}

    def entry(self, name: str, rng: random.Random) -> str:
        """A filled entry of the list, or a made-up word; article included."""
        if name in MADE_UP and name not in self.lists:
            return MADE_UP[name](rng)
        first, *rest = str(pick(self.lists[name], rng)).split("{")
        slots = (part.partition("}") for part in rest)
        return first + "".join(
            (MADE_UP[slot](rng) if slot in MADE_UP else self.entry(slot, rng)) + behind
            for slot, _brace, behind in slots
        )

    def noun(self, name: str, rng: random.Random) -> Value:
        """A thing: stored without its article, said with it; what stands before a bar is said
        alone.
        """
        entry = self.entry(name, rng)
        kind, bar, rest = entry.partition("|")
        if bar:
            quoted = rest[:1] in ("'", '"') and rest[0] in rest[1:]
            return Value(rest[1:].partition(rest[0])[0] if quoted else rest, kind + rest)
        return Value(bare(entry), entry, bare(entry))

    def quoted(self, name: str, rng: random.Random) -> Value:
        """A text to be written down word for word: mostly in quotation marks, a single word also
        without.
        """
        text = self.noun(name, rng).value
        mark = pick(("'", '"', "'", '"', '"' if " " in text else ""), rng)
        return Value(text, f"{mark}{text}{mark}")

    def several(self, name: str, rng: random.Random, count: int, *, article: bool = False) -> Value:
        """A list of different things as it is said: "boats, buoys and people"."""
        found = {item.text: item for item in (self.noun(name, rng) for _ in range(count))}
        values = [item.value for item in found.values()]
        said = list(found) if article else values
        joint = " and " if rng.random() < 0.85 else " as well as "
        if len(said) > 2 and rng.random() < 0.3:
            joint = f",{joint}"
        return Value(values, joined(said, joint))


def joined(parts: Sequence[str], last: str = " and ") -> str:
    """The parts with commas between and `last` before the last one."""
    return ", ".join(parts[:-1]) + last + parts[-1] if len(parts) > 1 else "".join(parts)
