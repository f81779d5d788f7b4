"""The number speaker: numbers, lengths, times, angles, speeds and positions as people say them."""

import functools
import itertools
import re
import tomllib
from bisect import bisect
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from random import Random
from typing import Any, TypeVar

from planner_ft.facts.geometry import Point, tidy
from planner_ft.facts.words import COMPASS as POINTS
from planner_ft.facts.words import SMALL

T = TypeVar("T")
_FIELD = re.compile(r"\{(\w+)\}")


def words(text: str) -> tuple[str, ...]:
    """The words of a text, for lists that would fill a line each."""
    return tuple(text.split())


_SAID: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
ONES = tuple(SMALL)[:20]
TENS = ("zero", "ten", *tuple(SMALL)[20:28])
COMPASS = {45 * number: name for number, name in enumerate(POINTS[::2])}
PLACES: dict[str, tuple[str, ...]] = {
    sense: tuple(form for form, often in forms.items() for _ in range(often))
    for sense, forms in _SAID["places"].items()
}
WRITTEN = PLACES["written"]
"""Forms of a written position, the usual ones more often; of the place of a target that is `known`
or `doubtful`.
"""


WORDINGS = {"adj": "short", "num": "short", "noun": "noun", "way": "way"}
"""The wording that an option of a slot asks for."""


@dataclass(frozen=True)
class Value:
    """A value of a plan and how it is said; a wording that is None cannot be said of this value.

    `text` in full; `short` as an adjective or without an article; `noun` as a thing ("a half circle
    to port"); `way` as a direction ("left by 15 degrees", "east").
    """

    value: Any
    text: str
    short: str | None = None
    noun: str | None = None
    way: str | None = None

    def _asked(self, options: frozenset[str]) -> list[str | None]:
        return [getattr(self, WORDINGS[option]) for option in WORDINGS if option in options]

    def has(self, options: frozenset[str]) -> bool:
        """Whether the value can be worded in the way that a slot's options ask for."""
        return None not in self._asked(options)

    def worded(self, options: frozenset[str]) -> str:
        """The wording that a slot's options ask for, where the value has it."""
        return next(filter(None, self._asked(options)), self.text)


Draw = Callable[[Random], Value]


def digits(value: float) -> str:
    """The number in figures."""
    return str(tidy(value))


def in_words(value: int) -> str:
    """An integer from 0 to 999 in words."""
    if value >= 100:
        rest = value % 100
        return f"{ONES[value // 100]} hundred" + (f" and {in_words(rest)}" if rest else "")
    if value < 20:
        return ONES[value]
    return TENS[value // 10] + (f"-{ONES[value % 10]}" if value % 10 else "")


def count_text(value: float, rng: Random) -> str:
    """The number in figures or, now and then and where that is short, in words."""
    if isinstance(value, int) and 0 <= value <= 20 and rng.random() < 0.32:
        return in_words(value)
    if isinstance(value, int) and 20 < value < 1000:
        short = (value % 10 == 0 and value < 100) or value % 100 == 0
        if rng.random() < (0.17 if short else 0.05):
            words = in_words(value)
            hundred = words.startswith("one hundred") and rng.random() < 0.5
            return f"a{words[3:]}" if hundred else words
    if isinstance(value, float) and value % 1 == 0.5 and 1 < value < 20 and rng.random() < 0.22:
        return f"{ONES[int(value)]} and a half"
    return digits(value)


def pick(options: Sequence[T], rng: Random) -> T:
    """One of the options."""
    return options[int(rng.random() * len(options))]


# ---------------------------------------------------------------- numbers.toml


@functools.lru_cache(maxsize=1024)
def _forms(sense: str, known: frozenset[str]) -> dict[str, tuple[list[str], list[float]]]:
    """By wording ("text", "short", ...) the forms of a sense whose fields are known, and their
    weights, added up.
    """
    found = {}
    for wording, forms in _SAID["forms"][sense].items():
        able = [form for form in forms if known.issuperset(_FIELD.findall(form))]
        if able:
            found[wording] = able, list(itertools.accumulate(forms[form] for form in able))
    return found


def _worded(sense: str, value: Any, fields: dict[str, str], rng: Random) -> Value:
    """The value in forms of its sense whose fields are given."""
    said = {
        wording: forms[bisect(weights, rng.random() * weights[-1])].format_map(fields)
        for wording, (forms, weights) in _forms(sense, frozenset(fields)).items()
    }
    return Value(value, **said)


def _ending(number: float) -> str:
    return "" if number == 1 else "s"


def _size(value: float, rng: Random, unit: str = "") -> dict[str, str]:
    """Fields of a size: {n} in figures, {c} as a count, {w} a small one in words, {s} the ending of
    the unit; `unit` is put behind their names.
    """
    fields = {"n": digits(value), "c": count_text(value, rng), "s": _ending(value)}
    if isinstance(value, int) and 0 < value <= 20:
        fields["w"] = in_words(value)
    return {key + unit: text for key, text in fields.items()} if unit else fields


def _own(value: float, rng: Random, table: str) -> dict[str, str]:
    """A wording that the value has for itself in a table: "half an hour"."""
    wordings = _SAID["own"][table].get(digits(value))
    return {"own": pick(wordings, rng)} if wordings else {}


def length(value: float, rng: Random) -> Value:
    """Metres: "12 m", "twelve metres", "1.5 km", "40 feet"; short: "12-metre"."""
    fields = _size(value, rng) | _own(value, rng, "lengths")
    if value >= 1000 and value % 100 == 0:
        fields["km"] = digits(value / 1000)
    return _worded("length", value, fields, rng)


def duration(value: float, rng: Random) -> Value:
    """Seconds: "90 s", "two minutes", "half an hour", "1 h 20 min"; short: "90-second"."""
    fields = _size(value, rng) | _own(value, rng, "durations")
    hours, minutes, seconds = int(value // 3600), int(value % 3600 // 60), value % 60
    if value and value % 3600 == 0:
        fields |= _size(hours, rng, "_h")
    elif value and not seconds and value < 7200:
        fields |= _size(int(value // 60), rng, "_min")
    if hours and minutes and not seconds:
        fields |= {"hours": str(hours), "minutes": str(minutes), "s_h": _ending(hours)}
    elif 60 < value < 900 and seconds and value % 15 == 0:
        fields |= {"minutes": str(minutes), "seconds": digits(seconds), "s_min": _ending(minutes)}
    if 60 < value < 900 and value % 30 == 0:
        fields["halves"] = digits(value / 60)
    return _worded("duration", value, fields, rng)


def bearing(value: float, rng: Random) -> Value:
    """A heading: "090", "east", "90 degrees"; short: figures only, never a compass word."""
    fields = {"n": digits(value)}
    if isinstance(value, int):
        fields |= {"three": f"{value:03d}", "words": in_words(value)}
    if value % 22.5 == 0:
        fields["name"] = POINTS[int(value % 360 / 22.5)]
    return _worded("bearing", value, fields, rng)


def angle(value: float, rng: Random) -> Value:
    """A size in degrees without direction; short: "15-degree"; noun: "half a circle"."""
    return _worded("angle", value, _size(value, rng) | _own(value, rng, "circles"), rng)


def rotation(value: float, rng: Random) -> Value:
    """A signed angle, clockwise positive: "15 degrees to the left"; short: "-15 degrees"."""
    side = "right" if value > 0 else "left"
    way = pick(_SAID["ways"][side], rng)
    fields = _size(abs(value), rng) | _own(abs(value), rng, "circles")
    fields |= {"sign": pick(_SAID["signs"][side], rng), "way": way}
    around = f" to the {way}" if way in ("left", "right") else f" {way}"
    fields["around"] = around if value < 0 or rng.random() < 0.7 else ""
    return _worded("rotation", value, fields, rng)


def speed(value: float, rng: Random) -> Value:
    """Metres a second: "1.5 m/s", "half a metre per second"; short: "1.5 m/s"."""
    return _worded("speed", value, _size(value, rng) | _own(value, rng, "speeds"), rng)


def feet(rng: Random, low: float, high: float) -> Value | None:
    """A length of whole feet from `low` to `high` metres; None where no round one fits."""
    fitting = [n for n in range(10, 501, 5) if low <= n * 0.3048 <= high]
    if not fitting:
        return None
    number = pick(fitting, rng)
    return _worded("feet", tidy(number * 0.3048), {"n": str(number)}, rng)


def knots(rng: Random) -> Value:
    """A speed in knots, m/s in the plan."""
    number = pick((1, 2, 3, 4, 5, 0.5, 1.5, 2.5), rng)
    return _worded("knots", tidy(number * 0.514444), _size(number, rng), rng)


def position(value: Point, rng: Random, form: str | None = None) -> Value:
    """A position as operators give coordinates, in `form` if given and fit; short: in brackets."""
    x, y = digits(value[0]), digits(value[1])
    fields, roll = {"x": x, "y": y}, rng.random()
    if min(value) >= 0:
        fields |= {"plain_x": x, "plain_y": y}
    else:
        fields |= {"minus_x": x.replace("-", "minus "), "minus_y": y.replace("-", "minus ")}
    if roll < 0.05 and value[0] and value[1]:
        sides = ("east" if value[0] > 0 else "west", "north" if value[1] > 0 else "south")
        fields |= {"size_x": x.lstrip("-"), "size_y": y.lstrip("-")}
        fields |= {"side_x": sides[0], "side_y": sides[1]}
    elif roll < 0.08 and all(isinstance(one, int) and abs(one) < 1000 for one in value):
        spoken = ("minus " * (one < 0) + in_words(int(abs(one))) for one in value)
        fields |= zip(("words_x", "words_y"), spoken, strict=True)
    said = _worded("position", list(value), fields, rng)
    fits = form is not None and fields.keys() >= set(_FIELD.findall(form))
    return replace(said, text=form.format_map(fields)) if form is not None and fits else said


def polygon(value: list[Point], rng: Random) -> Value:
    """The corners, one after the other in one of many notations; noun, for a box that starts in the
    south-west: "the box from [0, 0] to [50, 40]".
    """
    form, joint = pick(_SAID["polygon"]["corners"], rng), pick(_SAID["polygon"]["joints"], rng)
    if joint == " " and form[-1] not in ")]":
        joint = ", "
    corners = [form.format(x=digits(x), y=digits(y)) for x, y in value]
    text = joint.join(corners)
    if joint == " and ":
        text = ", ".join(corners[:-1]) + joint + corners[-1]
    elif form[0] == "[" and rng.random() < 0.3:
        text = f"[{', '.join(corners)}]"
    points, noun = [list(corner) for corner in value], None
    if len(value) == 4 and value[0][0] < value[2][0] and value[0][1] == value[1][1] < value[2][1]:
        mark = "[{}, {}]" if rng.random() < 0.7 else "({}, {})"
        first, last = (mark.format(*map(digits, value[place])) for place in (0, 2))
        noun = pick(_SAID["polygon"]["boxes"], rng).format(first, last)
        half = (value[2][0] - value[0][0]) / 2
        if value[2][1] - value[0][1] == 2 * half and rng.random() < 0.8:
            center = mark.format(digits(value[0][0] + half), digits(value[0][1] + half))
            unit = "-metre" if rng.random() < 0.7 else " m"
            noun = f"a {digits(half)}{unit} square around {center}"
    return Value(points, text, noun=noun)


SENSES: dict[str, Callable[[float, Random], Value]] = {
    sense.__name__: sense for sense in (length, duration, bearing, angle, rotation, speed)
}


def say_number(value: float, sense: str | None, unit: str | None, rng: Random) -> Value:
    """The number said in the way of its sense, or plainly with its unit."""
    if sense in SENSES:
        return SENSES[sense](value, rng)
    if sense in _SAID["forms"]:
        return _worded(str(sense), value, {"n": digits(value)}, rng)
    number = count_text(value, rng)
    return Value(value, number if unit in (None, "count") else f"{number} {unit}")
