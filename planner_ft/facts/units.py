"""Units of parameters and of texts, and what one of them is in another (units.toml).

Every unit has a base: metres, seconds, degC, Pa, kg ... "L/min" has the base "m3/s".
"""

import functools
import re
import tomllib
from collections.abc import Mapping

from planner_ft.facts.words import FOLDER, UNITS, Unit, is_known
from planner_ft.vocabulary import Entry, Parameter

FEWEST = 4  # letters from which a spelling is a word, in any case and with a plural
COUNT = ""  # the base of what is counted
_PER = r"(?:\s?/\s?|\s+(?:per|an?)\s+)"
_LIKE = re.compile(r"\s?([^\W\d_]+(?:\^?[23])?(?:/[^\W\d_]+(?:\^?[23])?)?)(?![\w'’-])")
_MIXED = re.compile(r"[a-zµμ][A-Z]|[\^23²³]")
"""What hardly a word has: "mWs", "cm³"."""


@functools.lru_cache(maxsize=256)
def named(name: str | None) -> Unit | None:
    """The unit that a definition names; None for one that is not known, and for none."""
    if not name:
        return None
    exact, anyhow = _spellings()
    name = name.strip()
    found = exact.get(name) or anyhow.get(name.lower()) or UNITS.get(name.lower())
    parts = [] if found else re.split(_PER, name, maxsplit=1)
    if len(parts) == 2 and (above := named(parts[0])) and (below := named(parts[1])):
        return _ratio(above, below)
    return found


def base_of(name: str | None) -> str | None:
    """The base of a unit; the name itself where it is not known, None for a count and for none."""
    unit = named(name)
    return (unit.base or None) if unit else name


def converted(value: float, unit: str | None, other: str | None) -> float | None:
    """A value in another unit; None where the units are of two kinds."""
    one, two = named(unit), named(other)
    if unit == other or not one or not two:
        return value if unit == other else None
    return two.of_base(one.in_base(value)) if one.base == two.base else None


def in_base_units(values: Entry, known: Mapping[str, Parameter]) -> list[float]:
    """The numbers among the values of parameters, in base units where theirs is another."""
    given = [(value, named(known[name].unit)) for name, value in values.items() if name in known]
    numbers = [(value, unit) for value, unit in given if isinstance(value, int | float)]
    return [unit.in_base(value) for value, unit in numbers if unit and unit[1:] != (1, 0)]


def unit_at(text: str, start: int, *, letters: bool) -> tuple[Unit, int] | None:
    """The unit of units.toml that a text has at a place, and where it ends; None for none. A single
    letter is one only with `letters`, or as a part of a rate: "20 L/ha".
    """
    match = _pattern(letters).match(text, start)
    if match is None:
        return None
    if match["above"]:
        above, below = named(match["above"]), named(match["below"])
        # Metres per second are read elsewhere, and "90 degrees a minute later" is no rate.
        apart = ("m", "s", "deg", "%") if match["per"].strip() in ("a", "an") else ("m", "s")
        if above and below and above.base not in apart:
            return _ratio(above, below), match.end()
        return None
    unit = named(match["one"])
    return (unit, match.end()) if unit else None


def unknown_at(text: str, start: int, own: str | None) -> str | None:
    """A word right behind a number that is like a unit, and none that is known: "mWs/cm²"; None
    for a parameter whose `own` unit is not known.
    """
    match = _LIKE.match(text, start)
    if match is None or named(match[1]) or not named(own):
        return None
    parts = [part for part in match[1].split("/") if not named(part) and not is_known(part)]
    like = ("/" in match[1] or _MIXED.search(part) for part in parts)
    return match[1] if match[1][1:] and any(like) else None


def _ratio(above: Unit, below: Unit) -> Unit:
    return Unit(f"{above.base}/{below.base}", above.factor / below.factor)


def _is_word(spelling: str) -> bool:
    return sum(map(str.isalpha, spelling)) >= FEWEST


@functools.cache
def _spellings() -> tuple[dict[str, Unit], dict[str, Unit]]:
    """The units by spelling as it stands, and by words in lower case with their plurals."""
    raw = tomllib.loads((FOLDER / "units.toml").read_text(encoding="utf-8"))
    exact = {
        spelling.strip(): Unit(base, float(factor), *map(float, added))
        for base, rows in raw.items()
        for factor, spellings, *added in rows
        for spelling in spellings.split(",")
    }
    words = {name.lower(): unit for name, unit in exact.items() if _is_word(name)}
    plurals = {f"{name}s": unit for name, unit in words.items() if name[-1].isalpha()}
    return exact, {**plurals, **words}


@functools.cache
def _pattern(letters: bool) -> re.Pattern[str]:
    exact, anyhow = _spellings()
    said = [name for name in exact if exact[name].base != COUNT and not _is_word(name)]
    one = [name for name in said if letters or len(name) > 1 or not name.isalpha()]
    words = [name for name in anyhow if anyhow[name].base != COUNT]
    spoken = f"(?i:{_any(words)})"
    every = f"(?:{_any(said)}|{spoken}|(?i:{_any(list(UNITS))}))"
    return re.compile(
        rf"(?:(?P<above>{every})(?P<per>{_PER})(?P<below>{every})|(?P<one>{_any(one)}|{spoken}))(?!\w)"
    )


def _any(names: list[str]) -> str:
    return "|".join(re.escape(name) for name in sorted(names, key=len, reverse=True))
