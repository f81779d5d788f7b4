"""Lines of a behaviour file as the helm of MOOS-IvP reads them.

A line ends a statement; "//" begins a comment anywhere in it; a backslash at its end, even a
comment's, takes the next line in; a line holds fewer than 5000 characters
(https://oceanai.mit.edu/ivpman, "The Helm Behavior File"; lib_helmivp/Populator_BehaviorSet.cpp and
lib_mbutil/FileBuffer.cpp of MOOS-IvP). `$[NAME]` in a flag is a macro of the helm, `$(NAME)` and
`%(NAME)` are macros of nsplug.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence

WIDTH, POINTS_PER_LINE, LONGEST_LINE = 160, 20, 4000
CONTROL = re.compile("[\x00-\x1f\x7f\x85\u2028\u2029\ud800-\udfff]+")
MACRO = re.compile(r"([$%])(?=[\[({])")

Point = tuple[float, float]
Settings = Sequence[tuple[str, str]]
"""Keys and values in order; a key may stand there several times."""


def block(kind: str, name: str, settings: Settings) -> list[str]:
    """The lines of a behaviour such as BHV_Waypoint, broken where the helm joins them again."""
    lines = [f"  {key} = {value}" for key, value in (("name", name), *settings)]
    cuts = (range(0, len(line), LONGEST_LINE) for line in lines)
    parts = (
        "\\\n".join(line[start : start + LONGEST_LINE] for start in found)
        for line, found in zip(lines, cuts, strict=True)
    )
    return [f"Behavior = {kind}", "{", *parts, "}"]


def words(text: str) -> str:
    """Text without line ends, comments, continuations, macros and conditions of the helm."""
    plain = MACRO.sub(r"\1 ", CONTROL.sub(" ", text).replace("\\", "/")).replace("[if]", "[ if ]")
    while "//" in plain:
        plain = plain.replace("//", "/ /")
    return plain


def quoted(text: str) -> str:
    """Text as the value of a flag or a variable."""
    return '"{}"'.format(words(text).replace('"', "'"))


def comment(text: str) -> list[str]:
    """Text as comment lines."""
    lines = textwrap.wrap(words(text), WIDTH - 3, break_on_hyphens=False)
    return [f"// {line}" for line in lines] or ["//"]


def number(value: float) -> str:
    """A number to the millimetre, without an exponent."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def points(corners: Iterable[Point]) -> str:
    """Points as "x,y : x,y", broken into lines that the helm joins again."""
    found = [f"{number(x)},{number(y)}" for x, y in corners]
    starts = range(0, len(found), POINTS_PER_LINE)
    return " : \\\n    ".join(" : ".join(found[one : one + POINTS_PER_LINE]) for one in starts)


def variable(name: str) -> str:
    """A MOOS variable for a skill: "DetectObjects" is SKILL_DETECT_OBJECTS."""
    snake = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()
    return "SKILL_" + re.sub(r"[^A-Z0-9]+", "_", snake).strip("_")
