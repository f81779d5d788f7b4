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
from dataclasses import dataclass

WIDTH = 160
POINTS_PER_LINE = 20
LONGEST_LINE = 4000
CHANGED = "characters that the helm reads as its own were replaced"
CONTROL = re.compile("[\x00-\x1f\x7f\x85\u2028\u2029\ud800-\udfff]+")
MACRO = re.compile(r"([$%])(?=[\[({])")

Point = tuple[float, float]


@dataclass(frozen=True)
class Behaviour:
    """A behaviour: its kind, such as BHV_Waypoint, its name, and its settings in order; a key may
    stand there several times.
    """

    kind: str
    name: str
    settings: Sequence[tuple[str, str]]

    def lines(self) -> list[str]:
        """The block in the file."""
        return [
            f"Behavior = {self.kind}",
            "{",
            *(
                _continued(f"  {key} = {value}")
                for key, value in (("name", self.name), *self.settings)
            ),
            "}",
        ]


def _continued(line: str) -> str:
    """A line, broken where it would be longer than the helm reads; the helm joins the parts
    again.
    """
    return "\\\n".join(
        line[start : start + LONGEST_LINE] for start in range(0, len(line), LONGEST_LINE)
    )


def words(text: str) -> str:
    """Text without what the helm reads as its own: line ends, comments, continuations, macros,
    conditions.
    """
    plain = MACRO.sub(r"\1 ", CONTROL.sub(" ", text).replace("\\", "/")).replace("[if]", "[ if ]")
    while "//" in plain:
        plain = plain.replace("//", "/ /")
    return plain


def quoted(text: str) -> str:
    """Text as the value of a flag or a variable."""
    return '"{}"'.format(words(text).replace('"', "'"))


def is_changed(text: str) -> bool:
    """Whether `quoted` gives another text."""
    return quoted(text) != f'"{text}"'


def comment(text: str) -> list[str]:
    """Text as comment lines."""
    return [
        f"// {line}" for line in textwrap.wrap(words(text), WIDTH - 3, break_on_hyphens=False)
    ] or ["//"]


def number(value: float) -> str:
    """A number to the millimetre, without an exponent."""
    text = f"{value:.3f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def points(corners: Iterable[Point]) -> str:
    """Points as "x,y : x,y", broken into lines that the helm joins again."""
    told = [f"{number(x)},{number(y)}" for x, y in corners]
    parts = [
        " : ".join(told[start : start + POINTS_PER_LINE])
        for start in range(0, len(told), POINTS_PER_LINE)
    ]
    return " : \\\n    ".join(parts)


def variable(name: str) -> str:
    """A MOOS variable for a skill: "DetectObjects" is SKILL_DETECT_OBJECTS."""
    return "SKILL_" + re.sub(
        r"[^A-Z0-9]+", "_", re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).upper()
    ).strip("_")
