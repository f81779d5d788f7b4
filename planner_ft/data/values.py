"""The space of each parameter, what values it is drawn from and how they are said, and word lists.

A space is derived from the parameter's type, unit and range; the phrase file narrows it under
[skill.NAME.values.PARAMETER] or [task.TITLE.values.PARAMETER]: `typical` ([low, high]), `sense`
(bearing, rotation, angle, length, duration, temperature, percent), `choices`, `words` (a word
list), `quote` (said in quotation marks).

An entry of a word list is a text such as "the {colour} ladder", "camera {n}" or "weld {code}" that
refers to other lists; a list that is a table gives each entry a weight. An entry that begins with
"the " is said with its article and stored without it; what stands before a bar is said and not
stored ("sensor |{code}"), nor are the quotation marks behind it. Every vehicle has the lists of
values.toml: {n} a number, {code} "KX-07", {low} a small letter, {letter} a capital, {digit} a
digit, {word} and {name} what no dictionary has, {tag} a file tag, {any_thing} a thing's name from
things.txt.
"""

import functools
import itertools
import math
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.numbers import Draw, Value, pick, polygon, position, say_number, words
from planner_ft.data.templates.render import bare as without_article
from planner_ft.facts.geometry import Point, point, tidy
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.definition import Parameter

TABLE: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
ORDERS = words(TABLE["orders"])
_PARTS = {name: words(text) for name, text in TABLE["parts"].items()}
FALLBACK: Mapping[str, Sequence[str] | Mapping[str, float]] = {**TABLE["lists"], **_PARTS}
Weighted = tuple[Sequence[str], Sequence[float] | None]
Bounds = Sequence[tuple[float, float]]
"""The least and the greatest x, and y."""
SPAN = 220
"""Metres from home within which most positions lie."""
ANYWHERE: Bounds = ((-math.inf, math.inf),) * 2


def made_up_name(rng: Random) -> str:
    """A pronounceable name that means nothing: "Skarberg", "Tolvik"."""
    return f"{OWN.entry('word', rng)}{pick(TABLE['endings'], rng)}".capitalize()


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


def joined(parts: Sequence[str], last: str = " and ") -> str:
    """The parts with commas between and `last` before the last one."""
    return ", ".join(parts[:-1]) + last + parts[-1] if len(parts) > 1 else "".join(parts)


class WordLists:
    """The word lists of a vehicle. Raises PlannerError for one that is not there, or has itself."""

    def __init__(self, *groups: Mapping[str, Sequence[str] | Mapping[str, float]]) -> None:
        self.lists: dict[str, Weighted] = {}
        for name, entries in itertools.chain(*(group.items() for group in (FALLBACK, *groups))):
            if list(entries) == [f"{{{name}}}"]:
                continue  # The list that every vehicle has.
            weights = None
            if isinstance(entries, Mapping):
                weights = list(itertools.accumulate(entries.values()))
            self.lists[name] = (list(entries), weights)
        named = {
            name: set(re.findall(r"\{([^}]*)\}", " ".join(entries))) - MADE_UP.keys()
            for name, (entries, _weights) in self.lists.items()
        }
        for name, others in named.items():
            for other in sorted(others - self.lists.keys()):
                raise PlannerError(f"[words] {name}: there is no word list {other!r}; add it")
        try:
            TopologicalSorter(named).prepare()
        except CycleError as error:
            raise PlannerError(f"[words] {' names '.join(error.args[1])}: leave one out") from None

    def __contains__(self, name: str) -> bool:
        return name in self.lists or name in MADE_UP

    def entry(self, name: str, rng: Random) -> str:
        """A filled entry of the list, article included."""
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


OWN = WordLists()
"""The word lists that every vehicle has."""


# ---------------------------------------------------------------- spaces


def value_space(parameter: Parameter, config: dict[str, Any], lexicon: WordLists) -> Draw:
    """A function that draws a value of this parameter."""
    kind, several = parameter.type, parameter.type == "texts"
    if kind in ("number", "integer"):
        return number_space(parameter, config)
    if kind == "position":
        return draw_position
    if kind == "polygon":
        return lambda rng: polygon(draw_polygon(rng), rng)
    words = config.get("words", "things" if several else "thing")
    if several:
        most, article = config.get("most", 4), config.get("article", False)
        return lambda rng: lexicon.several(
            words, rng, 1 + int(rng.random() ** 1.5 * most), article=article
        )
    say = lexicon.quoted if config.get("quote") else lexicon.noun
    return lambda rng: say(words, rng)


def number_space(parameter: Parameter, config: dict[str, Any]) -> Draw:
    """A function that draws a number of this parameter; how it is said and its range are those of
    the phrase file, else they follow from name, unit and range.
    """
    least, most = parameter.minimum, parameter.maximum
    sense, low, high = TABLE["units"].get(parameter.unit or "", (None, 1, 20))
    if parameter.unit == "deg" and parameter.name in ("heading", "bearing", "yaw", "course"):
        sense = "bearing"
    elif parameter.unit == "deg" and least is not None and least < 0:
        sense = "rotation"
    sense = config.get("sense", sense)
    if typical := config.get("typical"):
        low, high = typical
    elif sense == "rotation":
        low, high = 5, 180
    else:
        low = low if least is None else max(low, least)
        high = high if most is None else max(low, min(high, most))
    choices = config.get("choices")

    def draw(rng: Random) -> Value:
        number: float
        if sense == "bearing":
            number = draw_bearing(rng)
        elif sense == "rotation":
            number = draw_rotation(rng, high)
        elif choices and rng.random() < 0.5:
            number = pick(choices, rng)
        elif sense == "duration":
            number = draw_duration(rng, low, high)
        else:
            number = draw_number(rng, low, high, whole=parameter.type == "integer")
        return say_number(number, sense, parameter.unit, rng)

    return draw


def draw_number(rng: Random, low: float, high: float, *, whole: bool = False) -> float:
    """A number as people choose them: mostly round ones, sometimes with a decimal."""
    raw = low + (high - low) * rng.random() ** 1.6
    roll = rng.random()
    if not whole and ((raw < 5 and roll < 0.3) or roll > 0.97):
        number = round(raw * 2) / 2 if rng.random() < 0.7 else round(raw, 1)
    elif raw > 10 and roll < (0.8 if raw > 100 else 0.6):
        step = 5 if raw < 100 else pick((10, 50), rng)
        number = step * round(raw / step)
    else:
        number = round(raw)
    return tidy(min(high, max(low, number)))


def draw_duration(rng: Random, low: float, high: float) -> int:
    """Seconds: round seconds, minutes, hours within the range."""
    tables, weights = list(TABLE["seconds"].values()), (0.48, 0.43, 0.09)
    for _ in range(8):
        number = pick(rng.choices(tables, weights)[0], rng)
        number = number if rng.random() < 0.93 else rng.randrange(3, 1000)
        if low <= number <= high:
            return int(number)
    return round(low + (high - low) * rng.random())


def draw_bearing(rng: Random) -> float:
    """A heading from 0 to 359 or, seldom, with half a degree."""
    roll = rng.random()
    if roll < 0.5:
        return rng.randrange(8) * 45
    if roll < 0.53:
        return tidy(22.5 + 45 * rng.randrange(8))
    step = 10 if roll < 0.58 else 15 if roll < 0.75 else 1
    return step * rng.randrange(360 // step)


def draw_rotation(rng: Random, high: float) -> float:
    """A signed angle up to `high` degrees, never zero."""
    roll, size = rng.random(), 0.0
    if high >= 360 and roll < 0.3:
        size = pick((360, 180, 90, 270, 360, 180), rng)
    elif roll < 0.7:
        size = 5 * rng.randrange(1, max(2, int(high // 5) + 1))
    else:
        size = rng.randrange(1, int(high) + 1)
    return size if rng.random() < 0.5 else -size


def draw_point(rng: Random, bounds: Bounds = ANYWHERE) -> Point:
    """A position, mostly with whole coordinates near home, and within the bounds."""
    span = SPAN if rng.random() < 0.85 else pick((1200, 30), rng)
    coordinates: list[float] = []
    for low, high in bounds:
        number: float = rng.randrange(-span, span + 1)
        roll = rng.random()
        number = 5 * round(number / 5) if roll < 0.45 else number
        part = pick((0.5, 0.25, 0.1, 0.75, -0.4), rng) if roll >= 0.93 else 0
        if not low <= number + part <= high:
            least, most = max(low, min(high, 0) - SPAN), min(high, max(low, 0) + SPAN)
            number, part = min(high, max(low, round(rng.uniform(least, most)))), 0
        coordinates.append(number + part)
    return point(*coordinates)


def draw_position(rng: Random, bounds: Bounds = ANYWHERE) -> Value:
    """A position as it is said."""
    return position(draw_point(rng, bounds), rng)


def draw_polygon(rng: Random) -> list[Point]:
    """Three to six corners of a fence: mostly those of a rectangle, at times one at home."""
    x, y = (0, 0) if rng.random() < 0.1 else (10 * rng.randrange(-15, 10) for _ in range(2))
    width = 10 * rng.randrange(2, 30)
    height = width if rng.random() < 0.15 else 10 * rng.randrange(2, 30)
    outline = pick(TABLE["outlines"], rng)
    return [point(x + round(width * dx), y + round(height * dy)) for dx, dy in outline]
