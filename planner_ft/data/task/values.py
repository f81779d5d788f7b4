"""The space of each parameter: what values it is drawn from and how they are said.

Derived from the parameter's type, unit and range; the phrase file narrows it under
[skill.NAME.values.PARAMETER] or [task.TITLE.values.PARAMETER]: `typical` ([low, high]), `sense`
(bearing, rotation, angle, length, duration, temperature, percent), `choices`, `words` (a word
list), `quote` (said in quotation marks).
"""

from __future__ import annotations

import random
from collections.abc import Callable
from typing import Any

from planner_ft.data.numbers import SENSES, Value, plain_number, polygon, position
from planner_ft.data.task.geometry import Point, point, tidy
from planner_ft.data.task.words import Lexicon
from planner_ft.vocabulary.definition import Parameter

Draw = Callable[[random.Random], Value]

UNIT_SENSE = {
    "m": "length",
    "s": "duration",
    "deg": "angle",
    "degC": "temperature",
    "%": "percent",
    "m/s": "speed",
}
UNIT_TYPICAL = {
    "m": (1, 60),
    "s": (5, 900),
    "deg": (5, 180),
    "degC": (20, 120),
    "%": (10, 60),
    "m/s": (0.5, 5),
}
SPAN = 220  # metres from home within which most positions lie


def value_space(parameter: Parameter, config: dict[str, Any], lexicon: Lexicon) -> Draw:
    """A function that draws a value of this parameter."""
    if parameter.type in ("number", "integer"):
        return number_space(parameter, config)
    if parameter.type == "position":
        return lambda rng: position(draw_point(rng), rng)
    if parameter.type == "polygon":
        return lambda rng: polygon(draw_polygon(rng), rng)
    words = config.get("words", "things" if parameter.type == "texts" else "thing")
    if parameter.type == "texts":
        return lambda rng: lexicon.several(
            words,
            rng,
            1 + int(rng.random() ** 1.5 * config.get("most", 4)),
            article=config.get("article", False),
        )
    if config.get("quote"):
        return lambda rng: lexicon.quoted(words, rng)
    return lambda rng: lexicon.noun(words, rng)


def sense_of(parameter: Parameter, config: dict[str, Any]) -> str | None:
    """How the number is said: from the phrase file, else from name, unit and range."""
    if "sense" in config:
        return str(config["sense"])
    if parameter.unit == "deg":
        if parameter.name in ("heading", "bearing", "yaw", "course"):
            return "bearing"
        if parameter.minimum is not None and parameter.minimum < 0:
            return "rotation"
    return UNIT_SENSE.get(parameter.unit or "")


def number_space(parameter: Parameter, config: dict[str, Any]) -> Draw:
    """A function that draws a number of this parameter."""
    sense = sense_of(parameter, config)
    low, high = config.get("typical") or _default_range(parameter, sense)
    whole = parameter.type == "integer"
    choices = config.get("choices")

    def draw(rng: random.Random) -> Value:
        if sense == "bearing":
            number = draw_bearing(rng)
        elif sense == "rotation":
            number = draw_rotation(rng, high)
        elif choices and rng.random() < 0.5:
            number = choices[int(rng.random() * len(choices))]
        elif sense == "duration":
            number = draw_duration(rng, low, high)
        else:
            number = draw_number(rng, low, high, whole=whole)
        return say_number(number, sense, parameter.unit, rng)

    return draw


def say_number(number: float, sense: str | None, unit: str | None, rng: random.Random) -> Value:
    """The number as a value said in the way of its sense, or plainly with its unit."""
    if sense in SENSES:
        return SENSES[sense](number, rng)
    return plain_number(number, rng, "" if unit in (None, "count") else str(unit))


def _default_range(parameter: Parameter, sense: str | None) -> tuple[float, float]:
    low, high = UNIT_TYPICAL.get(parameter.unit or "", (1, 20))
    if sense == "rotation":
        return 5, 180
    if parameter.minimum is not None:
        low = max(low, parameter.minimum)
    return low, max(low, min(high, parameter.maximum)) if parameter.maximum is not None else high


def draw_number(rng: random.Random, low: float, high: float, *, whole: bool = False) -> float:
    """A number as people choose them: mostly round ones, sometimes with a decimal."""
    raw = low + (high - low) * rng.random() ** 1.6
    roll = rng.random()
    if not whole and ((raw < 5 and roll < 0.3) or roll > 0.97):
        number = round(raw * 2) / 2 if rng.random() < 0.7 else round(raw, 1)
    elif raw > 100 and roll < 0.8:
        number = round(raw / 50) * 50 if rng.random() < 0.5 else round(raw / 10) * 10
    elif raw > 10 and roll < 0.6:
        number = round(raw / 5) * 5
    else:
        number = round(raw)
    return tidy(min(high, max(low, number)))


def draw_duration(rng: random.Random, low: float, high: float) -> int:
    """Seconds: round seconds, minutes, hours within the range."""
    for _ in range(8):
        roll = rng.random()
        if roll < 0.45:
            number = rng.choice(
                (5, 8, 10, 12, 15, 20, 25, 30, 40, 45, 50, 60, 75, 80, 90, 100, 110)
            )
        elif roll < 0.85:
            number = 60 * rng.choice((1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 20, 25, 30, 40, 45))
        elif roll < 0.93:
            number = rng.choice((90, 150, 210, 270, 3600, 5400, 7200, 10800, 200, 250, 400, 500))
        else:
            number = rng.randrange(3, 1000)
        if low <= number <= high:
            return number
    return int(tidy(round(low + (high - low) * rng.random())))


def draw_bearing(rng: random.Random) -> float:
    """A heading from 0 to 359 or, seldom, with half a degree."""
    roll = rng.random()
    if roll < 0.5:
        return rng.randrange(8) * 45
    if roll < 0.58:
        return tidy(22.5 + 45 * rng.randrange(8)) if rng.random() < 0.3 else rng.randrange(36) * 10
    return rng.randrange(24) * 15 if roll < 0.75 else rng.randrange(360)


def draw_rotation(rng: random.Random, high: float) -> float:
    """A signed angle up to `high` degrees, never zero."""
    roll = rng.random()
    if high >= 360 and roll < 0.3:
        size: float = rng.choice((360, 180, 90, 270, 360, 180))
    elif roll < 0.7:
        size = 5 * rng.randrange(1, max(2, int(high // 5) + 1))
    else:
        size = rng.randrange(1, int(high) + 1)
    return size if rng.random() < 0.5 else -size


def draw_point(rng: random.Random) -> Point:
    """A position, mostly with whole coordinates near home."""
    span = SPAN if rng.random() < 0.85 else 1200 if rng.random() < 0.4 else 30
    coordinates = []
    for _ in range(2):
        number = rng.randrange(-span, span + 1)
        roll = rng.random()
        if roll < 0.45:
            number = 5 * round(number / 5)
        coordinates.append(
            number if roll < 0.93 else round(number + rng.choice((0.5, 0.25, 0.1, 0.75, -0.4)), 2)
        )
    return point(coordinates[0], coordinates[1])


def draw_polygon(rng: random.Random) -> list[Point]:
    """The corners of a fence: mostly a rectangle, at times a triangle or a five-sided one."""
    x, y = 10 * rng.randrange(-15, 10), 10 * rng.randrange(-15, 10)
    width, height = 10 * rng.randrange(2, 20), 10 * rng.randrange(2, 20)
    if rng.random() < 0.15:
        height = width
    ring = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)]
    roll = rng.random()
    if roll < 0.2:
        return [point(*corner) for corner in (ring[0], ring[1], rng.choice((ring[2], ring[3])))]
    if roll < 0.3:
        return [
            point(*corner) for corner in (*ring[:3], (x + width // 2, y + height + 20), ring[3])
        ]
    if roll < 0.5:
        ring = [ring[0], *reversed(ring[1:])]
    return [point(*corner) for corner in ring]
