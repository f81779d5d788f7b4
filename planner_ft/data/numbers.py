"""The number speaker: numbers, lengths, times, angles, speeds and positions as people say them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from random import Random
from typing import Any, TypeVar

from planner_ft.facts.geometry import Point, tidy

T = TypeVar("T")


def words(text: str) -> tuple[str, ...]:
    """The words of a text, for lists that would fill a line each."""
    return tuple(text.split())


ONES = words(
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen"
    " fifteen sixteen seventeen eighteen nineteen"
)
TENS = words("zero ten twenty thirty forty fifty sixty seventy eighty ninety")
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
    60: ("a minute", "one minute", "a full minute"),
    75: ("a minute and a quarter", "1 minute 15 seconds"),
    90: (
        *("a minute and a half", "one and a half minutes", "1 min 30 s", "1 minute 30 seconds"),
        "one minute thirty",
    ),
    120: ("a couple of minutes", "two minutes"),
    150: ("two and a half minutes", "2 min 30 s", "two minutes thirty"),
    210: ("three and a half minutes", "3 min 30 s"),
    270: ("four and a half minutes",),
    900: ("a quarter of an hour",),
    1800: ("half an hour", "a half hour"),
    2700: ("three quarters of an hour",),
    3600: ("an hour", "one hour", "a full hour"),
    4500: ("an hour and a quarter",),
    5400: ("an hour and a half", "one and a half hours"),
    7200: ("two hours", "a couple of hours"),
    9000: ("two and a half hours",),
}
KILOMETRES = {
    250: ("a quarter of a kilometre",),
    500: ("half a kilometre", "0.5 km"),
    1000: ("a kilometre", "one kilometre", "1 km"),
    1500: ("one and a half kilometres", "1.5 km", "a kilometre and a half"),
    2000: ("two kilometres", "2 km"),
    2500: ("two and a half kilometres", "2.5 km"),
}
CIRCLES = {
    360: ("a full circle", "one full circle", "a complete circle", "a full orbit", "a full lap"),
    180: ("a half circle", "half a circle", "half a lap", "a semicircle", "half an orbit"),
    90: ("a quarter circle", "a quarter of a circle", "a quarter lap"),
    270: ("three quarters of a circle", "three quarters of a lap"),
    720: ("two full circles",),
}
WRITTEN = (
    *("[{x}, {y}]",) * 10,
    *("({x}, {y})",) * 4,
    *("x={x}, y={y}", "x={x} y={y}", "x {x} y {y}", "x {x}, y {y}", "[{x},{y}]", "({x},{y})"),
    *("x: {x}, y: {y}", "X{x} Y{y}", "{x}, {y}", "{x}/{y}", "{x} {y}", "({x} {y})"),
)
"""Forms of a written position, the usual ones more often."""


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
    figure = digits(value)
    spelt = figure
    if isinstance(value, int) and 0 < value <= 20 and rng.random() < 0.15:
        spelt = in_words(value)
    short = f"{spelt}-metre" if spelt != figure or rng.random() < 0.6 else f"{figure} m"
    if value in KILOMETRES and rng.random() < 0.5:
        return Value(value, pick(KILOMETRES[int(value)], rng), short)
    if value == 0.5 and rng.random() < 0.4:
        return Value(value, "half a metre", short)
    if value >= 1000 and value % 100 == 0 and rng.random() < 0.5:
        unit = "km" if rng.random() < 0.6 else "kilometres"
        return Value(value, f"{digits(value / 1000)} {unit}", short)
    roll = rng.random()
    if roll < 0.5:
        text = f"{figure} m"
    elif roll < 0.58:
        text = f"{figure}m"
    else:
        unit = "metre" if roll < 0.95 else "meter"
        text = f"{count_text(value, rng)} {many(value, unit)}"
    return Value(value, text, short)


def feet(rng: Random, low: float, high: float) -> Value | None:
    """A length of whole feet from `low` to `high` metres; None where no round one fits."""
    fitting = [n for n in range(10, 501, 5) if low <= n * 0.3048 <= high]
    if not fitting:
        return None
    number = fitting[int(rng.random() * len(fitting))]
    text = f"{number} {'ft' if rng.random() < 0.5 else 'feet'}"
    return Value(tidy(round(number * 0.3048, 2)), text, f"{number}-foot")


def duration(value: float, rng: Random) -> Value:
    """Seconds: "90 s", "two minutes", "half an hour", "1 h 20 min"; short: "90-second"."""
    roll = rng.random()
    size, unit = value, "second"
    if value and value % 60 == 0 and value < 7200 and roll < 0.5:
        size, unit = value // 60, "minute"
    spelt = 0 < size <= 20 and size == int(size) and rng.random() < 0.15
    short = f"{in_words(int(size)) if spelt else digits(size)}-{unit}"
    if value in FRACTIONS and roll < 0.4:
        return Value(value, pick(FRACTIONS[int(value)], rng), short)
    return Value(value, _time(value, roll, rng), short)


def _time(value: float, roll: float, rng: Random) -> str:
    """A duration that no fraction says."""
    hours, minutes, seconds = int(value // 3600), int(value % 3600 // 60), value % 60
    if value and value % 3600 == 0 and roll < 0.75:
        unit = "h" if rng.random() < 0.2 else many(hours, "hour")
        return f"{hours if unit == 'h' else count_text(hours, rng)} {unit}"
    if hours and minutes and not seconds and roll < 0.5:
        form = pick(("{} h {} min", "{}h {}min", "{} hours {} minutes"), rng).format(hours, minutes)
        return form.replace("hours", "hour") if hours == 1 else form
    if value and not seconds and value < 7200 and roll < 0.75:
        number = value // 60
        if rng.random() < 0.25:
            return f"{digits(number)}{' ' if rng.random() < 0.8 else ''}min"
        return f"{count_text(number, rng)} {many(number, 'minute')}"
    if 60 < value < 900 and seconds and value % 15 == 0 and roll < 0.43:
        first, second = (" min", " s") if rng.random() < 0.5 else (many(minutes, " minute"), "")
        joint = " and" if second and rng.random() < 0.3 else ""
        return f"{minutes}{first}{joint} {digits(seconds)}{second or ' seconds'}"
    if value % 30 == 0 and 60 < value < 900 and roll < 0.5:
        return f"{digits(value / 60)} minutes"
    if rng.random() < 0.42:
        return f"{digits(value)}{pick((' s', ' s', ' s', 's', ' sec'), rng)}"
    return f"{count_text(value, rng)} {many(value, 'second')}"


def bearing(value: float, rng: Random) -> Value:
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


def angle(value: float, rng: Random) -> Value:
    """A size in degrees without direction; short: "15-degree"; noun: "half a circle"."""
    text = f"{digits(value)}°"
    if rng.random() < 0.85:
        text = f"{count_text(value, rng)} {many(value, 'degree')}"
    short = f"{digits(value)}-degree"
    noun = pick((f"a {short} arc", f"an arc of {text}"), rng)
    if value in CIRCLES and rng.random() < 0.85:
        noun = pick(CIRCLES[int(value)], rng)
    return Value(value, text, short, noun)


_RIGHT = ("to the right", "clockwise", "to starboard", "right")
_LEFT = ("to the left", "anticlockwise", "to port", "left", "counter-clockwise")


def rotation(value: float, rng: Random) -> Value:
    """A signed angle, clockwise positive: "15 degrees to the left"; short: "-15 degrees"; noun: "a
    half circle to port".
    """
    size = abs(value)
    unit = "°" if rng.random() < 0.1 else f" {many(size, 'degree')}"
    way = pick(_RIGHT if value > 0 else _LEFT, rng)
    sign = "-" if value < 0 else "+" if rng.random() < 0.3 else ""
    if value < 0 and rng.random() < 0.3:
        sign = "minus "
    signed = f"{sign}{digits(size)}{unit}"
    spoken = f"{count_text(size, rng)}{unit}" if unit != "°" else f"{digits(size)}°"
    full = signed if rng.random() < 0.12 else f"{spoken} {way}"
    by = f"{way} by {spoken}" if rng.random() < 0.6 else f"{way} {spoken}"
    if size in CIRCLES and rng.random() < 0.6:
        noun = CIRCLES[int(size)][0]
    else:
        noun = f"an arc of {spoken}" if rng.random() < 0.7 else f"a {digits(size)}-degree arc"
    if value < 0 or rng.random() < 0.7:
        noun = f"{noun} to the {way}" if way in ("left", "right") else f"{noun} {way}"
    return Value(value, full, signed, noun, by)


def temperature(value: float, rng: Random) -> Value:
    """Degrees Celsius."""
    return Value(
        value, digits(value) + pick((" degrees", " °C", " degrees Celsius", " C", " degC"), rng)
    )


def percent(value: float, rng: Random) -> Value:
    """A share."""
    return Value(value, digits(value) + pick(("%", "%", " percent", " percent", " per cent"), rng))


def speed(value: float, rng: Random) -> Value:
    """Metres a second: "1.5 m/s", "half a metre per second"; short: "1.5 m/s"."""
    figure, short = digits(value), f"{digits(value)} m/s"
    roll = rng.random()
    if value == 0.5 and roll < 0.3:
        return Value(value, "half a metre per second", short)
    if roll < 0.7:
        return Value(value, short if roll < 0.6 else f"{figure}m/s", short)
    number = count_text(value, rng) if isinstance(value, int) else figure
    return Value(value, f"{number} {many(value, 'metre')} {pick(('per', 'a'), rng)} second", short)


def knots(rng: Random) -> Value:
    """A speed in knots, m/s in the plan."""
    number = (1, 2, 3, 4, 5, 0.5, 1.5, 2.5)[int(rng.random() * 8)]
    text = f"{number} {many(number, 'knot') if rng.random() < 0.8 else 'kn'}"
    return Value(tidy(round(number * 0.514444, 2)), text, f"{number}-knot")


def position(value: Point, rng: Random, form: str | None = None) -> Value:
    """A position in one of the forms in which operators give coordinates, `form` of them where it
    is given; short: always in brackets.
    """
    x, y = digits(value[0]), digits(value[1])
    short = f"[{x}, {y}]" if rng.random() < 0.75 else f"({x}, {y})"
    roll = rng.random()
    if form is None and roll < 0.05 and value[0] and value[1]:
        text = _compass_position(value, rng)
    elif form is None and roll < 0.08:
        text = _spoken_position(value, rng)
    else:
        text = (form or pick(WRITTEN, rng)).format(x=x, y=y)
        if "-" in text and text[0] not in "[(xX" and ("/" not in text):
            text = f"{x}, {y}".replace("-", "minus ") if rng.random() < 0.5 else short
    return Value(list(value), text, short)


def _spoken_position(value: Point, rng: Random) -> str:
    words = [
        ("minus " if number < 0 else "")
        + (in_words(abs(number)) if isinstance(number, int) and abs(number) < 1000 else "")
        for number in value
    ]
    if any(word.endswith("minus ") or not word for word in words):
        return ", ".join(digits(number).replace("-", "minus ") for number in value)
    return pick((", ", " comma ", ", "), rng).join(words)


def _compass_position(value: Point, rng: Random) -> str:
    sides = ("east" if value[0] > 0 else "west", "north" if value[1] > 0 else "south")
    unit, joint = pick((" m", " metres", ""), rng), pick((" and ", ", ", " "), rng)
    x, y = digits(abs(value[0])), digits(abs(value[1]))
    return f"{x}{unit} {sides[0]}{joint}{y}{unit} {sides[1]}"


def polygon(value: list[Point], rng: Random) -> Value:
    """The corners, one after the other; noun, for a box that starts in the south-west: "the box
    from [0, 0] to [50, 40]".
    """
    mark = "[{}, {}]" if rng.random() < 0.7 else "({}, {})"
    corners = [mark.format(digits(x), digits(y)) for x, y in value]
    noun = None
    if len(value) == 4 and value[0][0] < value[2][0] and value[0][1] == value[1][1] < value[2][1]:
        kind = "box" if rng.random() < 0.6 else "rectangle"
        noun = f"the {kind} from {corners[0]} to {corners[2]}"
        half = (value[2][0] - value[0][0]) / 2
        if value[2][1] - value[0][1] == 2 * half and rng.random() < 0.8:
            center = mark.format(digits(value[0][0] + half), digits(value[0][1] + half))
            unit = "-metre" if rng.random() < 0.7 else " m"
            noun = f"a {digits(half)}{unit} square around {center}"
    points = [list(corner) for corner in value]
    if rng.random() < 0.2:
        return Value(points, f"[{', '.join(corners)}]", noun=noun)
    joint = ", " if rng.random() < 0.5 else " and "
    return Value(points, ", ".join(corners[:-1]) + joint + corners[-1], noun=noun)


SENSES: dict[str, Callable[[float, Random], Value]] = {
    "length": length,
    "duration": duration,
    "bearing": bearing,
    "angle": angle,
    "rotation": rotation,
    "temperature": temperature,
    "percent": percent,
    "speed": speed,
}


def say_number(value: float, sense: str | None, unit: str | None, rng: Random) -> Value:
    """The number said in the way of its sense, or plainly with its unit."""
    if sense in SENSES:
        return SENSES[sense](value, rng)
    number = count_text(value, rng)
    return Value(value, number if unit in (None, "count") else f"{number} {unit}")
