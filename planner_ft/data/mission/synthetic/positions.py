"""Positions as operators write and say them."""

from __future__ import annotations

from random import Random

from planner_ft.data.mission.synthetic.numbers import Number, Style, number_words, tidy

Position = tuple[Number, Number]


def draw_coordinate(rng: Random) -> Number:
    """One coordinate in metres: mostly two digits, also three and four, zero, decimals."""
    roll = rng.random()
    if roll < 0.42:
        value: float = rng.randint(-99, 99)
    elif roll < 0.62:
        value = rng.randint(-20, 40) * 5
    elif roll < 0.82:
        value = rng.randint(-450, 450)
    elif roll < 0.87:
        value = rng.randint(-1500, 2500)
    elif roll < 0.9:
        value = rng.choice((0, 0, rng.randint(-9, 9)))
    elif roll < 0.97:
        value = rng.randint(-120, 240) + 0.5
    else:
        value = rng.randint(-2000, 3000) / 10 if roll < 0.99 else rng.randint(-9000, 20000) / 100
    return tidy(value)


def draw_position(rng: Random) -> Position:
    """A position that is neither home nor the unresolved location."""
    while True:
        position = (draw_coordinate(rng), draw_coordinate(rng))
        if position not in ((0, 0), (-99, -99)):
            return position


def plan_position(position: Position) -> list[Number]:
    """The position as the plan holds it."""
    return [tidy(position[0]), tidy(position[1])]


def position_words(position: Position) -> str:
    """The position as the plan's texts hold it: "[45, 10]"."""
    return f"[{tidy(position[0])}, {tidy(position[1])}]"


def say_position(position: Position, rng: Random, style: Style, *, spoken: bool = False) -> str:
    """The position in the speaker's form; `spoken` keeps to forms that can be dictated."""
    x, y = position
    if spoken or (style.spelled >= 0.6 and rng.random() < 0.6):
        return _spoken(x, y, rng, style)
    form = style.coordinate if rng.random() < 0.9 else rng.randrange(32)
    if form < 7:
        return f"[{x}, {y}]"
    if form < 9:
        return f"[{_decimal(x)}, {_decimal(y)}]"
    if form < 12:
        return f"({x}, {y})"
    if form < 30:
        return WRITTEN[form - 12].format(
            x=x,
            y=y,
            east=_side(x, "east", "west", " "),
            north=_side(y, "north", "south", " "),
            e=_side(x, "E", "W", ""),
            n=_side(y, "N", "S", ""),
        )
    return _spoken(x, y, rng, style)


WRITTEN = (
    "x={x} y={y}",
    "x {x} y {y}",
    "{x} {y}",
    "{x}, {y}",
    "{x}/{y}",
    "{east} {north}",
    "{e} {n}",
    "x={x}, y={y}",
    "[{x},{y}]",
    "({x} {y})",
    "{x},{y}",
    "x:{x} y:{y}",
    "({x},{y})",
    "{east}, {north}",
    "{north} {east}",
    "x: {x}, y: {y}",
    "X{x} Y{y}",
    "x={x}/y={y}",
)


def _decimal(value: Number) -> str:
    return f"{float(value)}"


def _side(value: Number, positive: str, negative: str, gap: str) -> str:
    return f"{abs(value)}{gap}{negative if value < 0 else positive}"


def _spoken(x: Number, y: Number, rng: Random, style: Style) -> str:
    def say(value: Number) -> str:
        if style.spelled < 0.3 or abs(value) >= 2000:
            return f"minus {abs(value)}" if value < 0 else str(value)
        return number_words(value, rng, style.hyphen)

    roll = rng.random()
    if roll < 0.3:
        east, north = ("west" if x < 0 else "east"), ("south" if y < 0 else "north")
        metres = rng.choice(("", "", "", f" {style.metre}s"))
        return (
            f"{say(abs(x))}{metres}"
            f" {east}{rng.choice((' ', ' ', ', ', ' and '))}{say(abs(y))}{metres} {north}"
        )
    if roll < 0.45:
        return f"x {say(x)} y {say(y)}"
    if roll < 0.65:
        return f"{say(x)} comma {say(y)}"
    return f"{say(x)}{rng.choice((', ', ', ', ' ', ' by '))}{say(y)}"
