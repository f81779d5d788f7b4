"""Numbers, quantities and positions as operators say them, each with the value that the plan holds.

Every `say_*` function draws a value and one of its surface forms: metres, seconds, m/s, degrees,
percent and counts, converted where the surface has another unit.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from random import Random

Number = int | float

ONES = (
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
)
TENS = ("", "", "twenty", "thirty", "forty", "fifty", "sixty", "seventy", "eighty", "ninety")


@dataclass(frozen=True)
class Said:
    """A value with its words: `text` stands alone ("20 metres"), `attributive` stands before a noun
    ("20 metre").
    """

    value: Number | str
    text: str
    attributive: str


@dataclass(frozen=True)
class Style:
    """How one speaker writes numbers: share of number words, unit form (long, short, tight),
    spelling, hyphens, coordinate form.
    """

    spelled: float
    unit: str
    metre: str
    hyphen: str
    coordinate: int


def tidy(value: float) -> Number:
    """At most two decimals, whole numbers as integers."""
    rounded = round(value, 2)
    return int(rounded) if rounded == int(rounded) else rounded


def integer_words(n: int, hyphen: str = " ") -> str:
    """Number words below 10,000: `hyphen` joins tens and ones."""
    if n < 20:
        return ONES[n]
    if n < 100:
        return TENS[n // 10] + (hyphen + ONES[n % 10] if n % 10 else "")
    if n < 1000:
        return f"{ONES[n // 100]} hundred" + (
            f" and {integer_words(n % 100, hyphen)}" if n % 100 else ""
        )
    rest = n % 1000
    joint = " and " if 0 < rest < 100 else " "
    return f"{integer_words(n // 1000, hyphen)} thousand" + (
        joint + integer_words(rest, hyphen) if rest else ""
    )


def number_words(value: Number, rng: Random, hyphen: str = " ") -> str:
    """`value` in words: "minus twelve", "twelve point five", "twelve and a half"."""
    if value < 0:
        return f"minus {number_words(-value, rng, hyphen)}"
    whole = int(value)
    rest = round(value - whole, 2)
    if not rest:
        return integer_words(whole, hyphen)
    if rest == 0.5 and whole and rng.random() < 0.5:
        return f"{integer_words(whole, hyphen)} and a half"
    digits = f"{rest:.2f}"[2:].rstrip("0")
    return f"{integer_words(whole, hyphen)} point {' '.join(ONES[int(digit)] for digit in digits)}"


def number_text(value: Number, rng: Random, style: Style) -> str:
    """`value` in digits or in words, as the speaker does."""
    if style.spelled and rng.random() < style.spelled and abs(value) < 2000:
        return number_words(value, rng, style.hyphen)
    return str(tidy(value))


def draw_style(rng: Random) -> Style:
    """A speaker's way with numbers."""
    return Style(
        spelled=rng.choice((0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.3, 0.6, 1.0)),
        unit=rng.choice(("long", "long", "short", "short", "tight")),
        metre=rng.choice(("metre", "metre", "meter")),
        hyphen=rng.choice((" ", "-", "-")),
        coordinate=rng.randrange(32),
    )


def plainer(rng: Random, style: Style) -> Style:
    """The same speaker, who more often writes figures and bracketed coordinates."""
    roll = rng.random()
    if roll < 0.4:
        return replace(style, spelled=0.0, coordinate=0 if roll < 0.3 else 9)
    return replace(style, spelled=min(style.spelled, 0.1)) if roll < 0.6 else style


UNITS = {
    "metre": ("m", "metre"),
    "kilometre": ("km", "kilometre"),
    "second": ("s", "second"),
    "minute": ("min", "minute"),
    "hour": ("h", "hour"),
    "foot": ("ft", "foot"),
    "mile": ("nm", "nautical mile"),
}


def quantity(number: Number, unit: str, value: Number, rng: Random, style: Style) -> Said:
    """`number` of `unit`, meaning `value` in the plan's unit."""
    short, long = UNITS[unit]
    long = long.replace("metre", style.metre)
    spelled = number_text(number, rng, style)
    in_words = not spelled[-1].isdigit()
    if spelled.startswith("one hundred") and rng.random() < 0.35:
        spelled = f"a{spelled.removeprefix('one')}"
    if not in_words and style.unit != "long" and rng.random() < 0.85:
        if unit == "second" and rng.random() < 0.3:
            short = "sec"
        text = f"{spelled}{'' if style.unit == 'tight' else ' '}{short}"
        return Said(tidy(value), text, text)
    many = "feet" if unit == "foot" else f"{long}s"
    text = f"{spelled} {long if number == 1 else many}"
    if number == 1 and in_words and rng.random() < 0.6:
        text = f"{'an' if unit == 'hour' else 'a'} {long}"
    return Said(tidy(value), text, f"{spelled}{rng.choice(' -')}{long}")


def say_length(rng: Random, style: Style, low: int, high: int, *, far: bool = False) -> Said:
    """A length in metres, `low` to `high`; `far` lets it be said in kilometres or nautical miles
    too.
    """
    roll = rng.random()
    if far and roll < 0.35:
        return _say_far(rng, style)
    if roll > 0.975:
        feet = rng.choice(
            [
                feet
                for feet in (10, 15, 20, 25, 30, 40, 50, 60, 80, 100, 150, 200, 250, 300, 400, 500)
                if low <= feet * 0.3048 <= high
            ]
            or [30]
        )
        return quantity(feet, "foot", feet * 0.3048, rng, style)
    if roll < 0.55:
        step = 5 if high <= 200 else 10
        number: Number = max(low, rng.randrange(low // step * step, high + 1, step)) or low
    elif roll < 0.85 or high > 200:
        number = rng.randint(low, high)
    else:
        number = tidy(rng.randint(low, min(high, 60)) + rng.choice((0.5, 0.5, 0.25, 0.2, 0.8)))
    return quantity(number, "metre", number, rng, style)


def _say_far(rng: Random, style: Style) -> Said:
    roll = rng.random()
    if roll < 0.12:
        return Said(500, f"half a kilo{style.metre}", f"half-kilo{style.metre}")
    if roll < 0.2:
        return Said(
            1500,
            rng.choice((f"one and a half kilo{style.metre}s", f"a kilo{style.metre} and a half")),
            f"one and a half kilo{style.metre}",
        )
    if roll < 0.23:
        return Said(1852, "a nautical mile", "one mile")
    number: Number = rng.randint(1, 6) if roll < 0.6 else tidy(rng.randint(3, 48) / 10)
    return quantity(number, "kilometre", number * 1000, rng, style)


COMMON_DURATIONS = (
    ("half an hour", "half-hour", 1800),
    ("a quarter of an hour", "quarter-hour", 900),
    ("quarter of an hour", "quarter-hour", 900),
    ("three quarters of an hour", "three-quarter-hour", 2700),
    ("an hour and a half", "hour-and-a-half", 5400),
    ("half a minute", "half-minute", 30),
    ("a minute and a half", "minute-and-a-half", 90),
    ("an hour", "one-hour", 3600),
    ("a minute", "one-minute", 60),
    ("two and a half hours", "two-and-a-half-hour", 9000),
    ("a couple of minutes", "two-minute", 120),
    ("one and a half hours", "one-and-a-half-hour", 5400),
    ("a full hour", "one-hour", 3600),
    ("a full minute", "one-minute", 60),
    ("an hour and a quarter", "hour-and-a-quarter", 4500),
    ("half a minute", "half-minute", 30),
    ("three quarters of a minute", "45-second", 45),
    ("a half hour", "half-hour", 1800),
)


HOURS_AND_MINUTES = (
    "{} h {} min",
    "{}h{}",
    "{} hr {} min",
    "{} h {}",
    "{} hours {} minutes",
    "{}h {}min",
    "{} hours and {} minutes",
)


def say_duration(rng: Random, style: Style, *, brief: bool = False) -> Said:
    """A duration in seconds; `brief` keeps it to a few minutes."""
    roll = rng.random()
    if roll < 0.16:
        text, attributive, seconds = rng.choice(COMMON_DURATIONS)
        return Said(seconds, text, attributive)
    if roll < (0.55 if brief else 0.28):
        seconds = rng.choice(
            (10, 15, 20, 30, 40, 45, 50, 60, 75, 80, 90, 100, 120, 150, 180, rng.randint(5, 300))
        )
        return quantity(seconds, "second", seconds, rng, style)
    if roll > 0.99 and not brief:
        whole, minutes = rng.randint(1, 3), rng.choice((5, 10, 15, 20, 30, 40, 45, 50))
        text = rng.choice(HOURS_AND_MINUTES).format(whole, minutes)
        return Said(
            3600 * whole + 60 * minutes, text if whole > 1 else text.replace("hours", "hour"), ""
        )
    if roll > 0.965 and not brief:
        hours = rng.choice((1, 2, 3, 4, 6, 8, 12, 1.5, 2.5, 0.5))
        return quantity(hours, "hour", hours * 3600, rng, style)
    if roll > 0.92:
        minutes, rest = rng.randint(1, 6), rng.choice((10, 15, 20, 30, 45))
        text = (
            f"{number_text(minutes, rng, style)} minute{'s' if minutes > 1 else ''}"
            f" {number_text(rest, rng, style)}"
        )
        text += rng.choice((" seconds", " seconds", ""))
        return Said(60 * minutes + rest, text, text.removesuffix("s"))
    if roll > 0.87:
        halves = rng.randint(1, 9) + 0.5
        return quantity(halves, "minute", halves * 60, rng, style)
    minutes = (
        rng.randint(1, 12)
        if brief
        else rng.choice((rng.randint(1, 30), rng.randint(2, 12) * 5, rng.randint(1, 95)))
    )
    return quantity(minutes, "minute", minutes * 60, rng, style)


def say_interval(rng: Random, style: Style) -> Said:
    """The time between two measurements in seconds; the text fits after "every"."""
    roll = rng.random()
    if roll < 0.16:
        return Said(60, "minute", "one-minute")
    if roll < 0.22:
        return Said(30, "half minute", "half-minute")
    if roll < 0.25:
        return (
            Said(3600, "hour", "one-hour") if roll < 0.235 else Said(1800, "half hour", "half-hour")
        )
    if roll < 0.65:
        seconds = rng.choice((5, 10, 12, 15, 20, 25, 30, 40, 45, 60, 90, 120, rng.randint(2, 150)))
        return quantity(seconds, "second", seconds, rng, style)
    minutes: Number = rng.randint(2, 15) if roll < 0.95 else rng.choice((1.5, 2.5))
    return quantity(minutes, "minute", minutes * 60, rng, style)


KNOTS = (1, 2, 3, 4, 5, 0.5, 1.5, 2.5)


def say_speed(rng: Random, style: Style) -> Said:
    """A speed in m/s."""
    roll = rng.random()
    if roll < 0.04:
        knots = rng.choice(KNOTS)
        number = number_text(knots, rng, style)
        return Said(
            tidy(knots * 0.514444),
            f"{number} {'knot' if knots == 1 else rng.choice(('knots', 'knots', 'kn'))}",
            f"{number} knot",
        )
    if roll < 0.07:
        hourly = rng.choice((1.8, 3.6, 2, 3, 4, 5, 7.2, 9))
        return Said(tidy(hourly / 3.6), f"{number_text(hourly, rng, style)} km/h", f"{hourly} km/h")
    if roll < 0.14:
        return Said(0.5, f"half a {style.metre} per second", "0.5 m/s")
    if roll < 0.18:
        return Said(
            1, rng.choice((f"a {style.metre} per second", f"one {style.metre} a second")), "1 m/s"
        )
    speed = tidy(
        rng.choice(
            (
                rng.randint(2, 25) / 10,
                rng.randint(2, 12) / 10,
                rng.randint(1, 5),
                rng.randint(1, 60) / 20,
            )
        )
    )
    number = number_text(speed, rng, style)
    if number[-1].isdigit() and rng.random() < 0.75:
        text = f"{number}{'' if style.unit == 'tight' else ' '}m/s"
        return Said(speed, text, text)
    return Said(
        speed,
        f"{number} {style.metre}{'' if speed == 1 else 's'} {rng.choice(('per', 'per', 'a'))}"
        " second",
        f"{number} m/s",
    )


def say_degrees(rng: Random, style: Style, choices: tuple[int, ...]) -> Said:
    """An angle in degrees."""
    angle = (
        rng.choice(choices)
        if rng.random() < 0.75
        else rng.randint(3, 70) * 5
        if rng.random() < 0.7
        else rng.randint(20, 350)
    )
    number = number_text(angle, rng, style)
    word = (
        rng.choice((" deg", "°", " degrees"))
        if number[-1].isdigit() and style.unit != "long"
        else " degrees"
    )
    return Said(
        angle,
        number + word,
        number + ("°" if word == "°" else rng.choice((" degree", "-degree", " deg"))),
    )


COMPASS = {
    "north": 0,
    "north-east": 45,
    "east": 90,
    "south-east": 135,
    "south": 180,
    "south-west": 225,
    "west": 270,
    "north-west": 315,
}
POINTS = {"NE": 45, "SE": 135, "SW": 225, "NW": 315, "N": 0, "E": 90, "S": 180, "W": 270}
FINE_POINTS = {
    "north-north-east": 22.5,
    "east-north-east": 67.5,
    "east-south-east": 112.5,
    "south-south-east": 157.5,
    "south-south-west": 202.5,
    "west-south-west": 247.5,
    "west-north-west": 292.5,
    "north-north-west": 337.5,
}


def say_heading(rng: Random, style: Style) -> Said:
    """A bearing in degrees clockwise from north, as a compass word or in degrees; the text fits
    after "heading".
    """
    roll = rng.random()
    if roll < 0.5:
        name, angle = rng.choice(tuple(COMPASS.items()))
        name = rng.choice((name, name, name.replace("-", ""), name.replace("-", " ")))
        if rng.random() < 0.12 and "-" not in name and " " not in name and len(name) < 6:
            name = f"due {name}"
        return Said(angle, name, name)
    if roll < 0.56:
        name, angle = rng.choice(tuple(POINTS.items()))
        return Said(angle, name, name)
    if roll < 0.59:
        name, fine = rng.choice(tuple(FINE_POINTS.items()))
        return Said(fine, name, name)
    angle = rng.choice((rng.randint(0, 71) * 5, rng.randint(0, 359)))
    if roll < 0.66:
        digits = f"{angle:03d}"
        text = digits if rng.random() < 0.5 else " ".join(ONES[int(digit)] for digit in digits)
        return Said(angle, text, text)
    number = number_text(angle, rng, style)
    text = number + rng.choice(
        ("", " degrees", " degrees" if style.unit == "long" or not number[-1].isdigit() else "°")
    )
    return Said(angle, text, text)


def say_percent(rng: Random, style: Style) -> Said:
    """A share in percent."""
    share = rng.choice((10, 15, 20, 25, 30, 35, 40, 50, 60, rng.randint(5, 70)))
    number = number_text(share, rng, style)
    text = number + (
        rng.choice(("%", " %", " percent", " per cent"))
        if number[-1].isdigit()
        else rng.choice((" percent", " per cent"))
    )
    return Said(share, text, text)


def say_count(rng: Random, style: Style) -> Said:
    """A small count, words more often than digits."""
    count = rng.choice((4, 5, 6, 7, 8, 9, 10, 12, 14, 15, 16, 18, 20, 24, 36, rng.randint(3, 40)))
    if count == 12 and rng.random() < 0.1:
        return Said(12, "a dozen", "dozen")
    spelled = count <= 12 and rng.random() < 0.45
    text = number_words(count, rng, style.hyphen) if spelled else number_text(count, rng, style)
    return Said(count, text, text)
