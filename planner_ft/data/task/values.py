"""The space of each parameter: what values it is drawn from and how they are said.

Derived from the parameter's type, unit and range; the phrase file narrows it under
[skill.NAME.values.PARAMETER] or [task.TITLE.values.PARAMETER]: `typical` ([low, high]), `sense`
(bearing, rotation, angle, length, duration, temperature, percent), `choices`, `words` (a word
list), `quote` (said in quotation marks).
"""

from __future__ import annotations

import random
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

from planner_ft.data.numbers import Value, pick, polygon, position, say_number
from planner_ft.data.wordlists import WordLists
from planner_ft.facts.geometry import Point, point, tidy
from planner_ft.vocabulary.definition import Parameter

Draw = Callable[[random.Random], Value]

TABLE: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
SPAN = 220
"""Metres from home within which most positions lie."""


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

    def draw(rng: random.Random) -> Value:
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


def draw_number(rng: random.Random, low: float, high: float, *, whole: bool = False) -> float:
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


def draw_duration(rng: random.Random, low: float, high: float) -> int:
    """Seconds: round seconds, minutes, hours within the range."""
    tables, weights = list(TABLE["seconds"].values()), (0.48, 0.43, 0.09)
    for _ in range(8):
        number = pick(rng.choices(tables, weights)[0], rng)
        number = number if rng.random() < 0.93 else rng.randrange(3, 1000)
        if low <= number <= high:
            return int(number)
    return round(low + (high - low) * rng.random())


def draw_bearing(rng: random.Random) -> float:
    """A heading from 0 to 359 or, seldom, with half a degree."""
    roll = rng.random()
    if roll < 0.5:
        return rng.randrange(8) * 45
    if roll < 0.53:
        return tidy(22.5 + 45 * rng.randrange(8))
    step = 10 if roll < 0.58 else 15 if roll < 0.75 else 1
    return step * rng.randrange(360 // step)


def draw_rotation(rng: random.Random, high: float) -> float:
    """A signed angle up to `high` degrees, never zero."""
    roll, size = rng.random(), 0.0
    if high >= 360 and roll < 0.3:
        size = pick((360, 180, 90, 270, 360, 180), rng)
    elif roll < 0.7:
        size = 5 * rng.randrange(1, max(2, int(high // 5) + 1))
    else:
        size = rng.randrange(1, int(high) + 1)
    return size if rng.random() < 0.5 else -size


def draw_point(rng: random.Random) -> Point:
    """A position, mostly with whole coordinates near home."""
    span = SPAN if rng.random() < 0.85 else pick((1200, 30), rng)
    coordinates: list[float] = []
    for _ in range(2):
        number, roll = rng.randrange(-span, span + 1), rng.random()
        number = 5 * round(number / 5) if roll < 0.45 else number
        part = pick((0.5, 0.25, 0.1, 0.75, -0.4), rng) if roll >= 0.93 else 0
        coordinates.append(number + part)
    return point(*coordinates)


def draw_position(rng: random.Random) -> Value:
    """A position as it is said."""
    return position(draw_point(rng), rng)


def draw_polygon(rng: random.Random) -> list[Point]:
    """Three to six corners of a fence: mostly those of a rectangle, at times one at home."""
    x, y = (0, 0) if rng.random() < 0.1 else (10 * rng.randrange(-15, 10) for _ in range(2))
    width = 10 * rng.randrange(2, 30)
    height = width if rng.random() < 0.15 else 10 * rng.randrange(2, 30)
    outline = pick(TABLE["outlines"], rng)
    return [point(x + round(width * dx), y + round(height * dy)) for dx, dy in outline]
