"""Numbers, lengths, times, angles and positions as people say them."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from planner_ft.data.task.geometry import Point, tidy

ONES = [
    "zero",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
    "thirteen",
    "fourteen",
    "fifteen",
    "sixteen",
    "seventeen",
    "eighteen",
    "nineteen",
]
TENS = "zero ten twenty thirty forty fifty sixty seventy eighty ninety".split()  # noqa: SIM905
COMPASS = {
    0: "north",
    45: "north-east",
    90: "east",
    135: "south-east",
    180: "south",
    225: "south-west",
    270: "west",
    315: "north-west",
}
FINE_COMPASS = {
    22.5: "north-north-east",
    67.5: "east-north-east",
    112.5: "east-south-east",
    157.5: "south-south-east",
    202.5: "south-south-west",
    247.5: "west-south-west",
    292.5: "west-north-west",
    337.5: "north-north-west",
}
FRACTIONS: dict[int, tuple[str, ...]] = {
    30: ("half a minute",),
    45: ("three quarters of a minute", "forty-five seconds"),
    60: ("a minute", "one minute"),
    75: ("a minute and a quarter", "1 minute 15 seconds"),
    90: (
        "a minute and a half",
        "one and a half minutes",
        "1 min 30 s",
        "1 minute 30 seconds",
        "one minute thirty",
    ),
    150: ("two and a half minutes", "2 min 30 s", "two minutes thirty"),
    210: ("three and a half minutes", "3 min 30 s"),
    270: ("four and a half minutes",),
    900: ("a quarter of an hour",),
    1800: ("half an hour",),
    2700: ("three quarters of an hour",),
    3600: ("an hour", "one hour"),
    5400: ("an hour and a half", "one and a half hours"),
    7200: ("two hours", "a couple of hours"),
}
KILOMETRES = {
    500: ("half a kilometre", "0.5 km"),
    1000: ("a kilometre", "one kilometre", "1 km"),
    1500: ("one and a half kilometres", "1.5 km", "a kilometre and a half"),
    2000: ("two kilometres", "2 km"),
    2500: ("two and a half kilometres", "2.5 km"),
    250: ("a quarter of a kilometre",),
}


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


def count_text(value: float, rng: random.Random) -> str:
    """The number in figures or, now and then and where that is short, in words."""
    if isinstance(value, int) and 0 <= value <= 20 and rng.random() < 0.32:
        return in_words(value)
    if isinstance(value, int) and 20 < value < 1000:
        short = (value % 10 == 0 and value < 100) or value % 100 == 0
        if rng.random() < (0.17 if short else 0.05):
            words = in_words(value)
            return (
                f"a{words[3:]}" if words.startswith("one hundred") and rng.random() < 0.5 else words
            )
    if isinstance(value, float) and value % 1 == 0.5 and 1 < value < 20 and rng.random() < 0.22:
        return f"{ONES[int(value)]} and a half"
    return digits(value)


def _one_of(options: tuple[str, ...], rng: random.Random) -> str:
    return options[int(rng.random() * len(options))]


def length(value: float, rng: random.Random) -> Value:
    """Metres: "12 m", "twelve metres", "1.5 km"; short: "12-metre"."""
    figure = digits(value)
    spelt = (
        in_words(value)
        if isinstance(value, int) and 0 < value <= 20 and rng.random() < 0.15
        else figure
    )
    short = f"{spelt}-metre" if spelt != figure or rng.random() < 0.6 else f"{figure} m"
    if value in KILOMETRES and rng.random() < 0.5:
        return Value(value, _one_of(KILOMETRES[int(value)], rng), short)
    if value == 0.5 and rng.random() < 0.4:
        return Value(value, "half a metre", short)
    if value >= 1000 and value % 100 == 0 and rng.random() < 0.5:
        kilometres = f"{digits(value / 1000)} {'km' if rng.random() < 0.6 else 'kilometres'}"
        return Value(value, kilometres, short)
    roll = rng.random()
    if roll < 0.5:
        text = f"{figure} m"
    elif roll < 0.58:
        text = f"{figure}m"
    elif roll < 0.95:
        spoken = count_text(value, rng)
        text = f"{spoken} metre{'' if value == 1 else 's'}"
    else:
        text = f"{figure} meter{'' if value == 1 else 's'}"
    return Value(value, text, short)


def duration(value: float, rng: random.Random) -> Value:
    """Seconds: "90 s", "two minutes", "half an hour"; short: "90-second"."""
    roll = rng.random()
    whole_minutes = value % 60 == 0 and value < 7200
    size, unit = (
        (value // 60, "minute") if whole_minutes and value and roll < 0.5 else (value, "second")
    )
    short = (
        f"{in_words(int(size)) if 0 < size <= 20 and rng.random() < 0.15 else digits(size)}-{unit}"
    )
    if value in FRACTIONS and roll < 0.4:
        text = _one_of(FRACTIONS[int(value)], rng)
    elif value % 3600 == 0 and value and roll < 0.75:
        text = f"{count_text(value // 3600, rng)} hour{'' if value == 3600 else 's'}"
    elif whole_minutes and value and roll < 0.75:
        minutes = value // 60
        text = (
            f"{digits(minutes)} min"
            if rng.random() < 0.25
            else f"{count_text(minutes, rng)} minute{'' if minutes == 1 else 's'}"
        )
    elif value > 60 and value % 60 and value % 15 == 0 and value < 900 and roll < 0.43:
        first, second = (
            (" min", " s")
            if rng.random() < 0.5
            else (" minutes" if value >= 120 else " minute", " seconds")
        )
        text = (
            f"{digits(value // 60)}{first}{' and' if rng.random() < 0.3 else ''}"
            f" {digits(value % 60)}{second}"
        )
    elif value % 30 == 0 and 60 < value < 900 and roll < 0.5:
        text = f"{digits(value / 60)} minutes"
    else:
        text = (
            f"{digits(value)} {'s' if rng.random() < 0.85 else 'sec'}"
            if rng.random() < 0.42
            else f"{count_text(value, rng)} second{'' if value == 1 else 's'}"
        )
    return Value(value, text, short)


def bearing(value: float, rng: random.Random) -> Value:
    """A heading: "090", "east", "90 degrees"; short: figures only, never a compass word."""
    roll = rng.random()
    figures = f"{int(value):03d}" if roll < 0.35 and isinstance(value, int) else digits(value)
    figures += " degrees" if 0.5 < roll < 0.8 else "°" if roll > 0.95 else ""
    name = COMPASS.get(int(value) if value % 45 == 0 else -1) or FINE_COMPASS.get(value)
    if isinstance(value, int) and rng.random() < 0.03:
        return Value(value, f"{in_words(value)} degrees", figures, way=name)
    if name and rng.random() < 0.55:
        return Value(value, name if rng.random() < 0.8 else f"due {name}", figures, way=name)
    return Value(value, figures, figures, way=name)


def angle(value: float, rng: random.Random) -> Value:
    """A size in degrees without direction; short: "15-degree"."""
    text = (
        f"{count_text(value, rng)} degree{'' if value == 1 else 's'}"
        if rng.random() < 0.85
        else f"{digits(value)}°"
    )
    return Value(value, text, f"{digits(value)}-degree")


_RIGHT = ("to the right", "clockwise", "to starboard", "right")
_LEFT = ("to the left", "anticlockwise", "to port", "left", "counter-clockwise")


def rotation(value: float, rng: random.Random) -> Value:
    """A signed angle, clockwise positive: "15 degrees to the left"; short: "-15 degrees"; noun: "a
    half circle to port".
    """
    size = abs(value)
    unit = "°" if rng.random() < 0.1 else f" degree{'' if size == 1 else 's'}"
    ways = _RIGHT if value > 0 else _LEFT
    way = ways[int(rng.random() * len(ways))]
    signed = f"{'-' if value < 0 else '+' if rng.random() < 0.3 else ''}{digits(size)}{unit}"
    if value < 0 and rng.random() < 0.3:
        signed = f"minus {digits(size)}{unit}"
    spoken = f"{count_text(size, rng)}{unit}" if unit != "°" else f"{digits(size)}°"
    full = signed if rng.random() < 0.12 else f"{spoken} {way}"
    by = f"{way} by {spoken}" if rng.random() < 0.6 else f"{way} {spoken}"
    noun = {
        360: "a full circle",
        180: "a half circle",
        90: "a quarter circle",
        270: "three quarters of a circle",
        720: "two full circles",
    }.get(int(size))
    if noun is None or rng.random() < 0.4:
        noun = f"an arc of {spoken}" if rng.random() < 0.7 else f"a {digits(size)}-degree arc"
    if value < 0 or rng.random() < 0.7:
        noun = f"{noun} to the {way}" if way in ("left", "right") else f"{noun} {way}"
    return Value(value, full, signed, noun, by)


def temperature(value: float, rng: random.Random) -> Value:
    """Degrees Celsius."""
    return Value(
        value,
        f"{digits(value)} {rng.choice(('degrees', '°C', 'degrees Celsius', 'C', 'degC'))}".replace(
            " °C", " °C"
        ),
    )


def percent(value: float, rng: random.Random) -> Value:
    """A share."""
    return Value(
        value,
        f"{digits(value)}"
        f" {'%' if rng.random() < 0.4 else 'percent' if rng.random() < 0.7 else 'per cent'}".replace(
            " %", "%"
        ),
    )


def position(value: Point, rng: random.Random) -> Value:
    """A position in one of the forms in which operators give coordinates; short: always in
    brackets.
    """
    x, y = digits(value[0]), digits(value[1])
    short = f"[{x}, {y}]" if rng.random() < 0.75 else f"({x}, {y})"
    roll = rng.random()
    if roll < 0.5:
        text = f"[{x}, {y}]"
    elif roll < 0.68:
        text = f"({x}, {y})"
    elif roll < 0.76:
        text = f"x={x}, y={y}" if rng.random() < 0.5 else f"x={x} y={y}"
    elif roll < 0.83:
        text = f"x {x}{',' if rng.random() < 0.5 else ''} y {y}"
    elif roll < 0.88:
        text = f"{x}, {y}".replace("-", "minus ")
    elif roll < 0.91:
        text = f"[{x},{y}]"
    elif (
        roll < 0.92
        and isinstance(value[0], int)
        and isinstance(value[1], int)
        and max(map(abs, value)) < 1000
    ):
        text = f"{_signed_words(value[0])}, {_signed_words(value[1])}"
    elif roll < 0.96 and value[0] and value[1]:
        text = _compass_position(value, rng)
    else:
        text = f"{x} {y}" if rng.random() < 0.4 and "-" not in y else f"({x},{y})"
    return Value(list(value), text, short)


def _signed_words(value: float) -> str:
    return ("minus " if value < 0 else "") + in_words(abs(int(value)))


def _compass_position(value: Point, rng: random.Random) -> str:
    sides = ("east" if value[0] > 0 else "west", "north" if value[1] > 0 else "south")
    unit = rng.choice((" m", " metres", ""))
    joint = rng.choice((" and ", ", ", " "))
    return (
        f"{digits(abs(value[0]))}{unit} {sides[0]}{joint}{digits(abs(value[1]))}{unit} {sides[1]}"
    )


def polygon(value: list[Point], rng: random.Random) -> Value:
    """The corners, one after the other; noun, for a box that starts in the south-west: "the box
    from [0, 0] to [50, 40]".
    """
    mark = "[{}, {}]" if rng.random() < 0.7 else "({}, {})"
    corners = [mark.format(digits(x), digits(y)) for x, y in value]
    noun = None
    if len(value) == 4 and value[0][0] < value[2][0] and value[0][1] == value[1][1] < value[2][1]:
        noun = (
            f"the {'box' if rng.random() < 0.6 else 'rectangle'} from {corners[0]} to {corners[2]}"
        )
        half = (value[2][0] - value[0][0]) / 2
        if value[2][1] - value[0][1] == 2 * half and rng.random() < 0.8:
            center = mark.format(digits(value[0][0] + half), digits(value[0][1] + half))
            noun = (
                f"a {digits(half)}{'-metre' if rng.random() < 0.7 else ' m'} square around {center}"
            )
    plain = [list(corner) for corner in value]
    if rng.random() < 0.2:
        return Value(plain, f"[{', '.join(corners)}]", noun=noun)
    joint = ", " if rng.random() < 0.5 else " and "
    return Value(plain, ", ".join(corners[:-1]) + joint + corners[-1], noun=noun)


SENSES: dict[str, Callable[[float, random.Random], Value]] = {
    "length": length,
    "duration": duration,
    "bearing": bearing,
    "angle": angle,
    "rotation": rotation,
    "temperature": temperature,
    "percent": percent,
}


def plain_number(value: float, rng: random.Random, unit: str = "") -> Value:
    """A number with its unit as it stands, in figures or words."""
    return Value(value, f"{count_text(value, rng)}{f' {unit}' if unit else ''}")
