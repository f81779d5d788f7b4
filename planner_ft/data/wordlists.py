"""Word lists: things, names and texts drawn from lists whose entries refer to other lists.

An entry is a text such as "the {colour} ladder", "camera {n}" or "weld {code}"; a list that is a
table gives each entry a weight. An entry that begins with "the " is said with its article and
stored without it; what stands before a bar is said and not stored ("sensor |{code}"), nor are the
quotation marks behind it. Every vehicle has the lists of wordlists.toml: {n} a number, {code}
"KX-07", {low} a small letter, {letter} a capital, {digit} a digit, {word} and {name} what no dictionary has,
{tag} a file tag, {any_thing} a thing's name from things.txt.
"""

from __future__ import annotations

import functools
import itertools
import tomllib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.numbers import Value, pick, words
from planner_ft.data.templates.render import bare as without_article

_TABLE: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
ORDERS = words(_TABLE["orders"])
_PARTS = {name: words(text) for name, text in _TABLE["parts"].items()}
FALLBACK: Mapping[str, Sequence[str] | Mapping[str, float]] = {**_TABLE["lists"], **_PARTS}
Weighted = tuple[Sequence[str], Sequence[float] | None]


def pseudo_word(rng: Random) -> str:
    """A word that no dictionary has but anybody could say: "skarb"."""
    return _made_up().entry("word", rng)


def made_up_name(rng: Random) -> str:
    """A pronounceable name that means nothing: "Skarberg", "Tolvik"."""
    return f"{pseudo_word(rng)}{pick(_TABLE['endings'], rng)}".capitalize()


@functools.cache
def any_things() -> tuple[str, ...]:
    """The names of things, of three letters or more."""
    text = (Path(__file__).parent / "things.txt").read_text(encoding="utf-8")
    found = dict.fromkeys(word for word in text.split() if len(word) > 2 and word.isalpha())
    return tuple(word for word in found if not word.startswith(ORDERS))


MADE_UP: dict[str, Callable[[Random], str]] = {
    "name": made_up_name,
    "lower_name": lambda rng: made_up_name(rng).lower(),
    "any_thing": lambda rng: pick(any_things(), rng),
}


@functools.cache
def _made_up() -> WordLists:
    return WordLists()


def joined(parts: Sequence[str], last: str = " and ") -> str:
    """The parts with commas between and `last` before the last one."""
    return ", ".join(parts[:-1]) + last + parts[-1] if len(parts) > 1 else "".join(parts)


class WordLists:
    """The word lists of a vehicle."""

    def __init__(self, *groups: Mapping[str, Sequence[str] | Mapping[str, float]]) -> None:
        self.lists: dict[str, Weighted] = {}
        for name, entries in itertools.chain(*(group.items() for group in (FALLBACK, *groups))):
            if list(entries) == [f"{{{name}}}"]:
                continue  # The list that every vehicle has.
            weights = None
            if isinstance(entries, Mapping):
                weights = list(itertools.accumulate(entries.values()))
            self.lists[name] = (list(entries), weights)

    def __contains__(self, name: str) -> bool:
        return name in self.lists or name in MADE_UP

    def entry(self, name: str, rng: Random) -> str:
        """A filled entry of the list, article included. Raises KeyError for an unknown list."""
        if name not in self.lists:
            return MADE_UP[name](rng)
        entries, weights = self.lists[name]
        text = rng.choices(entries, cum_weights=weights)[0] if weights else pick(entries, rng)
        return text if "{" not in text else self.fill(text, rng)

    def fill(self, text: str, rng: Random) -> str:
        """The text with an entry of each list that it names in braces."""
        head, *rest = text.split("{")
        for piece in rest:
            name, _brace, tail = piece.partition("}")
            filled = MADE_UP[name](rng) if name in MADE_UP else self.entry(name, rng)
            # An article stays where the reference is all there is.
            head += (without_article(filled) if head or tail or len(rest) > 1 else filled) + tail
        return head

    def noun(self, name: str, rng: Random) -> Value:
        """A thing: stored without its article, said with it."""
        return self.as_value(self.entry(name, rng))

    @staticmethod
    def as_value(entry: str) -> Value:
        """An entry with its article as a value without; what stands before a bar is said alone."""
        kind, bar, name = entry.partition("|")
        if bar:
            quoted = name[:1] in "'\"" and name[:1] in name[1:]
            stored = name[1:].partition(name[0])[0] if quoted else name
            return Value(stored, kind + name)
        stored = without_article(entry)
        return Value(stored, entry, stored)

    def quoted(self, name: str, rng: Random) -> Value:
        """A text to be written down word for word, mostly in quotation marks."""
        stored = self.noun(name, rng).value
        mark = pick(("'", '"', "'", '"', ""), rng) or ("" if " " not in stored else '"')
        return Value(stored, f"{mark}{stored}{mark}")

    def several(self, name: str, rng: Random, count: int, *, article: bool = False) -> Value:
        """A list of different things as it is said: "boats, buoys and people"."""
        entries = list(dict.fromkeys(self.entry(name, rng) for _ in range(count)))
        stored = [self.as_value(entry).value for entry in entries]
        spoken = entries if article else stored
        joint = " and " if rng.random() < 0.85 else " as well as "
        if len(spoken) > 2 and rng.random() < 0.3:
            joint = f",{joint}"
        return Value(stored, joined(spoken, joint))
