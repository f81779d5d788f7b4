"""The number speaker: numbers, lengths, times, angles, speeds and positions as people say them."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any, TypeVar

from planner_ft.facts.geometry import Point, tidy
from planner_ft.facts.lists import COMPASS as POINTS

T = TypeVar("T")


def words(text: str) -> tuple[str, ...]:
    """The words of a text, for lists that would fill a line each."""
    return tuple(text.split())


_FILE = Path(__file__).with_suffix(".toml")
_SAID: dict[str, dict[str, Any]] = tomllib.loads(_FILE.read_text("utf-8"))
ONES = words(
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen"
    " fifteen sixteen seventeen eighteen nineteen"
)
TENS = words("zero ten twenty thirty forty fifty sixty seventy eighty ninety")
COMPASS = {45 * number: name for number, name in enumerate(POINTS[::2])}
ENDINGS: dict[str, list[str]] = _SAID["endings"]
WRITTEN = tuple(form for form, often in _SAID["written"].items() for _ in range(often))
"""Forms of a written position, the usual ones more often."""
CORNERS, JOINTS, BOXES = (list(_SAID["polygon"][key]) for key in ("corners", "joints", "boxes"))


def _wordings(table: str, value: float) -> list[str]:
    """Wordings of its own that the value has in numbers.toml."""
    return list(_SAID[table].get(digits(value), ()))


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

    def has(self, options: frozenset[str]) -> bool:
        """Whether the value can be worded in the way that a slot's options ask for."""
        asked = {"num": self.short, "adj": self.short, "noun": self.noun, "way": self.way}
        return all(asked.get(option, "") is not None for option in options)

    def worded(self, options: frozenset[str]) -> str:
        """The wording that a slot's options ask for, where the value has it."""
        if self.short and ("adj" in options or "num" in options):
            return self.short
        if self.noun and "noun" in options:
            return self.noun
        return self.way if self.way and "way" in options else self.text


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


def many(number: float, unit: str) -> str:
    """The unit, in the plural unless there is one."""
    return unit if number == 1 else f"{unit}s"


def length(value: float, rng: Random) -> Value:
    """Metres: "12 m", "twelve metres", "1.5 km", "40 feet"; short: "12-metre"."""
    spelt = figure = digits(value)
    if isinstance(value, int) and 0 < value <= 20 and rng.random() < 0.15:
        spelt = in_words(value)
    short = f"{spelt}-metre" if spelt != figure or rng.random() < 0.6 else f"{figure} m"
    if (own := _wordings("lengths", value)) and rng.random() < 0.5:
        return Value(value, pick(own, rng), short)
    if value == 0.5 and rng.random() < 0.4:
        return Value(value, "half a metre", short)
    if value >= 1000 and value % 100 == 0 and rng.random() < 0.5:
        unit = "km" if rng.random() < 0.6 else "kilometres"
        return Value(value, f"{digits(value / 1000)} {unit}", short)
    roll = rng.random()
    if roll < 0.58:
        return Value(value, f"{figure} m" if roll < 0.5 else f"{figure}m", short)
    return Value(value, _some(value, "metre" if roll < 0.95 else "meter", rng), short)


def feet(rng: Random, low: float, high: float) -> Value | None:
    """A length of whole feet from `low` to `high` metres; None where no round one fits."""
    fitting = [n for n in range(10, 501, 5) if low <= n * 0.3048 <= high]
    if not fitting:
        return None
    number = pick(fitting, rng)
    text = f"{number} {'ft' if rng.random() < 0.5 else 'feet'}"
    return Value(tidy(round(number * 0.3048, 2)), text, f"{number}-foot")


def duration(value: float, rng: Random) -> Value:
    """Seconds: "90 s", "two minutes", "half an hour", "1 h 20 min"; short: "90-second"."""
    roll, size, unit = rng.random(), value, "second"
    if value and value % 60 == 0 and value < 7200 and roll < 0.5:
        size, unit = value // 60, "minute"
    spelt = 0 < size <= 20 and size == int(size) and rng.random() < 0.15
    short = f"{in_words(int(size)) if spelt else digits(size)}-{unit}"
    own = _wordings("durations", value)
    return Value(value, pick(own, rng) if own and roll < 0.4 else _time(value, roll, rng), short)


def _time(value: float, roll: float, rng: Random) -> str:
    """A duration that has no wording of its own."""
    hours, minutes, seconds = int(value // 3600), int(value % 3600 // 60), value % 60
    if value and value % 3600 == 0 and roll < 0.75:
        return f"{hours} h" if rng.random() < 0.2 else _some(hours, "hour", rng)
    if hours and minutes and not seconds and roll < 0.5:
        form = pick(("{} h {} min", "{}h {}min", "{} hours {} minutes"), rng).format(hours, minutes)
        return form.replace("hours", "hour") if hours == 1 else form
    if value and not seconds and value < 7200 and roll < 0.75:
        if rng.random() < 0.25:
            return f"{digits(value // 60)}{' ' if rng.random() < 0.8 else ''}min"
        return _some(value // 60, "minute", rng)
    if 60 < value < 900 and seconds and value % 15 == 0 and roll < 0.43:
        joint = pick((" min {} s", many(minutes, " minute") + " {} seconds"), rng)
        return f"{minutes}{joint.format(digits(seconds))}"
    if value % 30 == 0 and 60 < value < 900 and roll < 0.5:
        return f"{digits(value / 60)} minutes"
    if rng.random() < 0.42:
        return f"{digits(value)}{pick((' s', ' s', ' s', 's', ' sec'), rng)}"
    return _some(value, "second", rng)


def _some(number: float, unit: str, rng: Random) -> str:
    return f"{count_text(number, rng)} {many(number, unit)}"


def bearing(value: float, rng: Random) -> Value:
    """A heading: "090", "east", "90 degrees"; short: figures only, never a compass word."""
    roll = rng.random()
    figures = f"{int(value):03d}" if roll < 0.35 and isinstance(value, int) else digits(value)
    figures += " degrees" if 0.5 < roll < 0.8 else "°" if roll > 0.95 else ""
    name = POINTS[int(value / 22.5)] if value % 22.5 == 0 else None
    if isinstance(value, int) and rng.random() < 0.03:
        return Value(value, f"{in_words(value)} degrees", figures, way=name)
    if name and rng.random() < 0.55:
        return Value(value, name if rng.random() < 0.8 else f"due {name}", figures, way=name)
    return Value(value, figures, figures, way=name)


def angle(value: float, rng: Random) -> Value:
    """A size in degrees without direction; short: "15-degree"; noun: "half a circle"."""
    text = f"{digits(value)}°"
    if rng.random() < 0.85:
        text = _some(value, "degree", rng)
    short = f"{digits(value)}-degree"
    noun = pick((f"a {short} arc", f"an arc of {text}"), rng)
    if (own := _wordings("circles", value)) and rng.random() < 0.85:
        noun = pick(own, rng)
    return Value(value, text, short, noun)


def rotation(value: float, rng: Random) -> Value:
    """A signed angle, clockwise positive: "15 degrees to the left"; short: "-15 degrees"."""
    size = abs(value)
    unit = "°" if rng.random() < 0.1 else f" {many(size, 'degree')}"
    way = pick(ENDINGS["right" if value > 0 else "left"], rng)
    sign = "-" if value < 0 else "+" if rng.random() < 0.3 else ""
    if value < 0 and rng.random() < 0.3:
        sign = "minus "
    signed = f"{sign}{digits(size)}{unit}"
    spoken = f"{count_text(size, rng)}{unit}" if unit != "°" else f"{digits(size)}°"
    full = signed if rng.random() < 0.12 else f"{spoken} {way}"
    by = f"{way} by {spoken}" if rng.random() < 0.6 else f"{way} {spoken}"
    noun = f"an arc of {spoken}" if rng.random() < 0.7 else f"a {digits(size)}-degree arc"
    if (own := _wordings("circles", size)) and rng.random() < 0.6:
        noun = own[0]
    if value < 0 or rng.random() < 0.7:
        noun = f"{noun} to the {way}" if way in ("left", "right") else f"{noun} {way}"
    return Value(value, full, signed, noun, by)


def speed(value: float, rng: Random) -> Value:
    """Metres a second: "1.5 m/s", "half a metre per second"; short: "1.5 m/s"."""
    figure, roll = digits(value), rng.random()
    short = f"{figure} m/s"
    if value == 0.5 and roll < 0.3:
        return Value(value, "half a metre per second", short)
    if roll < 0.7:
        return Value(value, short if roll < 0.6 else f"{figure}m/s", short)
    number = count_text(value, rng) if isinstance(value, int) else figure
    return Value(value, f"{number} {many(value, 'metre')} {pick(('per', 'a'), rng)} second", short)


def knots(rng: Random) -> Value:
    """A speed in knots, m/s in the plan."""
    number = pick((1, 2, 3, 4, 5, 0.5, 1.5, 2.5), rng)
    text = f"{number} {many(number, 'knot') if rng.random() < 0.8 else 'kn'}"
    return Value(tidy(round(number * 0.514444, 2)), text, f"{number}-knot")


def position(value: Point, rng: Random, form: str | None = None) -> Value:
    """A position as operators give coordinates, in `form` if given; short: in brackets."""
    x, y = digits(value[0]), digits(value[1])
    short = f"[{x}, {y}]" if rng.random() < 0.75 else f"({x}, {y})"
    roll = rng.random()
    if form is None and roll < 0.05 and value[0] and value[1]:
        sides = ("east" if value[0] > 0 else "west", "north" if value[1] > 0 else "south")
        unit, joint = pick((" m", " metres", ""), rng), pick((" and ", ", ", " "), rng)
        east, north = (f"{digits(abs(one))}{unit}" for one in value)
        text = f"{east} {sides[0]}{joint}{north} {sides[1]}"
    elif form is None and roll < 0.08:
        if all(isinstance(one, int) and abs(one) < 1000 for one in value):
            spoken = ["minus " * (one < 0) + in_words(int(abs(one))) for one in value]
            text = pick((", ", " comma ", ", "), rng).join(spoken)
        else:
            text = f"{x}, {y}".replace("-", "minus ")
    else:
        text = (form or pick(WRITTEN, rng)).format(x=x, y=y)
        if "-" in text and text[0] not in "[(xX" and "/" not in text:
            text = f"{x}, {y}".replace("-", "minus ") if rng.random() < 0.5 else short
    return Value(list(value), text, short)


def polygon(value: list[Point], rng: Random) -> Value:
    """The corners, one after the other in one of many notations; noun, for a box that starts in the
    south-west: "the box from [0, 0] to [50, 40]".
    """
    form, joint = pick(CORNERS, rng), pick(JOINTS, rng)
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
        noun = pick(BOXES, rng).format(first, last)
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
    if sense in ENDINGS:
        return Value(value, digits(value) + pick(ENDINGS[sense], rng))
    number = count_text(value, rng)
    return Value(value, number if unit in (None, "count") else f"{number} {unit}")
