r"""The form in which whole commands are written by hand: `TEXT => INTENT; INTENT; ...`, one
template a line.

`(a|b|c)` picks one alternative and `(x|)` leaves x out now and then; `{T1}`, `{duration}` and the
like are slots; `\(`, `\|` and `\{` are plain characters. Intents stand in the order of execution. A
slot `{+x}` says nothing: an intent that has `+x` among its arguments is there only where the chosen
alternative holds that slot. Targets of the kind `pair` share their noun and differ in their look:
`{look T1}` is "red", `{one T1}` "the red one", `{nouns T1}` "buoys". What TEXT says in fixed words
stands after `=`: `arc=180`, `S=north`, `F=name_board`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from random import Random
from typing import Any

OBJECTS = ("ID", "T", "P", "F", "S", "K", "L")
"""Slots for targets, positions, features, sides, docking marks, ids and data items; a number tells
those of one command apart.
"""
KINDS = ("structure", "boat", "buoy", "cable", "area", "landing", "dock", "thing", "pair")
VALUES = {
    "KeepStation": ("duration",),
    "PerformOrbit": ("radius", "speed", "arc"),
    "DriftAudit": ("duration",),
    "HorizontalPanorama": ("sectors", "overlap", "wait"),
    "FeatureStare": ("duration",),
    "GlareFreeApproach": (),
    "ParallelStructurePass": ("length", "distance", "speed"),
    "SurveyTarget": ("radius",),
    "BathymetryGridSurvey": ("width", "length", "spacing"),
    "SubseaCableTrack": ("heading", "max_dist"),
    "ThermalHotspotLocalizer": ("scan",),
    "ThermalTimeLapse": ("duration", "interval"),
    "VisualDockingApproach": ("distance",),
    "Transit": (),
    "FollowTarget": (),
    "SearchAndDetect": (),
    "DockingApproach": (),
    "BoatLandingClearanceSweep": (),
    "Diagnostics": (),
    "AutoGenerateReportSummary": (),
    "SmartDataHarvest": (),
    "Home": (),
    "Nothing": (),
}
"""The value slots that each task has; `Home` is the return, `Nothing` a command that asks for
nothing.
"""
VALUE_NAMES = frozenset(name for names in VALUES.values() for name in names)
PARTED = ("SurveyTarget", "ThermalHotspotLocalizer", "ThermalTimeLapse")
"""Tasks for which a feature or a side is a part of the target, which no parameter holds."""
HOLDS = {
    "FeatureStare": "F",
    "GlareFreeApproach": "F",
    "ParallelStructurePass": "S",
    "VisualDockingApproach": "K",
    "SmartDataHarvest": "L",
    "FollowTarget": "ID",
    **dict.fromkeys(PARTED, "FS"),
}
PLACELESS = frozenset(
    (
        "Diagnostics",
        "AutoGenerateReportSummary",
        "SmartDataHarvest",
        "VisualDockingApproach",
        "Home",
        "Nothing",
    )
)
REMARKS = ("Not", "Cannot", "Note", "Assume")
PARAMETER_OF = {"scan": "scan_width_degrees"}


class FormatError(ValueError):
    """What is wrong with a template, in words."""


@dataclass(frozen=True)
class Slot:
    """`{~a T1:boat located}`: name "T1", base "T", kind "boat", article "a", mode "located", wrong
    True.
    """

    name: str
    base: str
    kind: str = ""
    article: str = ""
    mode: str = ""
    wrong: bool = False


@dataclass(frozen=True)
class Choice:
    """One of `options` is said."""

    options: tuple[tuple[Node, ...], ...]


Node = str | Slot | Choice


@dataclass(frozen=True)
class Line:
    """An intent as written: a title with the slots that belong to it; `remark` is the text of a
    Not, Cannot, Note or Assume.
    """

    title: str
    slots: tuple[str, ...] = ()
    fixed: tuple[tuple[str, int | float | str], ...] = ()
    here: bool = False
    near: str = ""
    tag: str = ""
    remark: tuple[Node, ...] = ()

    def of(self, *bases: str) -> tuple[str, ...]:
        """Its slots with one of these bases."""
        return tuple(name for name in self.slots if base_of(name) in bases)


@dataclass(frozen=True)
class Template:
    """One line of a file. `kinds` holds the kind of each target, `wrong` the slots that are taken
    back by a correction.
    """

    text: tuple[Node, ...]
    lines: tuple[Line, ...]
    subject: str
    number: int
    kinds: dict[str, str]
    places: dict[str, str]
    wrong: frozenset[str]

    @property
    def tasks(self) -> tuple[Line, ...]:
        """The intents that stand for tasks."""
        return tuple(line for line in self.lines if line.title not in (*REMARKS, "Nothing"))


def picked(nodes: Iterable[Node], rng: Random) -> Iterator[str | Slot]:
    """The parts of the text with one alternative of each choice."""
    for node in nodes:
        if isinstance(node, Choice):
            yield from picked(node.options[int(rng.random() * len(node.options))], rng)
        else:
            yield node


SLOT = re.compile(
    r"(?P<w>~)?(?:(?P<a>a|an|bare|one|look|nouns)"
    r" )?(?P<v>~)?(?P<name>[A-Za-z_]+\d*)(?::(?P<kind>[a-z]+))?(?:"
    r" (?P<mode>located|lost|adj|bare))?"
)
MARK = re.compile(r"[(|){}\\]")


def base_of(name: str) -> str:
    """ "T" for "T2", "duration" for "duration2"."""
    return name.rstrip("0123456789")


def parse_slot(text: str) -> Slot:
    """The slot that stands between braces."""
    if text.startswith("+"):
        return Slot(text, "+")
    match = SLOT.fullmatch(text.strip())
    if match is None:
        raise FormatError(
            f"{{{text}}} is no slot: write {{T1}}, {{a T1}}, {{T1:boat}}, {{P1}}, {{duration}},"
            " {duration adj} or {~P1}"
        )
    name, base = match["name"], base_of(match["name"])
    kind, mode, article = match["kind"] or "", match["mode"] or "", match["a"] or ""
    if mode == "bare":
        article, mode = "bare", ""
    if base in OBJECTS and name == base:
        raise FormatError(f"{{{text}}} has no number: write {{{name}1}}")
    if base not in OBJECTS and base not in VALUE_NAMES:
        raise FormatError(
            f"{{{text}}} is no slot: objects are {', '.join(f'{item}1' for item in OBJECTS)},"
            f" values {', '.join(sorted(VALUE_NAMES))}"
        )
    if kind and kind not in (
        ("words", "degrees") if base == "heading" else KINDS if base == "T" else ()
    ):
        raise FormatError(
            f"{{{text}}}: no kind {kind!r} there; targets have {', '.join(KINDS)}, a heading has"
            " words or degrees"
        )
    if (mode in ("located", "lost") or article) and base != "T" and article != "bare":
        raise FormatError(f"{{{text}}}: only a target is indefinite, located or lost")
    return Slot(
        name, base, kind, "a" if article == "an" else article, mode, bool(match["w"] or match["v"])
    )


def parse_text(text: str) -> tuple[Node, ...]:
    """The nodes of a text. Raises FormatError where brackets do not match or a slot is unknown."""
    nodes, end = _sequence(text, 0, nested=False)
    if end < len(text):
        raise FormatError(f"a bracket or bar too many before {text[end : end + 25]!r}")
    return nodes


def _sequence(text: str, start: int, *, nested: bool) -> tuple[tuple[Node, ...], int]:
    nodes: list[Node] = []
    plain, index = "", start
    while index < len(text):
        mark = MARK.search(text, index)
        plain += text[index : mark.start() if mark else len(text)]
        if mark is None:
            index = len(text)
            break
        index = mark.start()
        if mark[0] == "\\":
            plain += text[index + 1 : index + 2]
            index += 2
            continue
        if mark[0] in "|)":
            break
        nodes, plain = ([*nodes, plain] if plain else nodes), ""
        node, index = _slot(text, index) if mark[0] == "{" else _choice(text, index)
        nodes.append(node)
    if nested and index >= len(text):
        raise FormatError(f"a bracket is open: {text[max(0, start - 1) : start + 25]!r}")
    return tuple([*nodes, plain] if plain else nodes), index


def _slot(text: str, start: int) -> tuple[Node, int]:
    if text[start] == "}" or (end := text.find("}", start)) < 0:
        raise FormatError(f"a brace without its other half near {text[start : start + 25]!r}")
    return parse_slot(text[start + 1 : end]), end + 1


def _choice(text: str, start: int) -> tuple[Node, int]:
    if text[start] == "}":
        raise FormatError(f"a brace without its other half near {text[start : start + 25]!r}")
    options, index = [], start
    while True:
        option, index = _sequence(text, index + 1, nested=True)
        options.append(option)
        if text[index] == ")":
            break
    if len(options) == 1:
        raise FormatError(
            f"{text[start : index + 1]!r} has no alternative: write (x|) for what may be left out,"
            " \\( and \\) for brackets"
        )
    return Choice(tuple(options)), index + 1


def parse_line(text: str) -> Line:
    """One intent. Raises FormatError for unknown titles and arguments that the task does not
    have.
    """
    title, _, rest = text.strip().partition(" ")
    if title in REMARKS:
        return _remark(title, rest.strip())
    if title not in VALUES:
        raise FormatError(f"no task {title!r}: {', '.join((*VALUES, *REMARKS))}")
    slots: list[str] = []
    known: dict[str, Any] = {}
    fixed: list[tuple[str, int | float | str]] = []
    words = rest.split()
    for index, word in enumerate(words):
        if word in ("here", "near"):
            known |= (
                {"here": True}
                if word == "here"
                else {"near": words[index + 1] if index + 1 < len(words) else ""}
            )
        elif word.startswith("+"):
            known["tag"] = word
        elif "=" in word:
            fixed.append(_fixed(title, word))
        elif word != known.get("near"):
            slots.append(_argument(title, word))
    line = Line(title, tuple(slots), tuple(fixed), **known)
    _check_line(line)
    return line


def _remark(title: str, rest: str) -> Line:
    if not rest:
        raise FormatError(f"{title} says nothing")
    if title != "Not":
        return Line(title, remark=parse_text(rest))
    if rest not in VALUES:
        raise FormatError(f"no task {rest!r} to rule out: {', '.join(VALUES)}")
    return Line(title, (rest,))


def _fixed(title: str, word: str) -> tuple[str, int | float | str]:
    name, _, value = word.partition("=")
    if name in ("F", "S", "K") and name in HOLDS.get(title, "") and title not in PARTED:
        return name, value.replace("_", " ")
    if name not in VALUES[title]:
        raise FormatError(
            f"{title} has no {name}: it has {', '.join(VALUES[title]) or 'no values'}"
        )
    try:
        return name, float(value) if "." in value else int(value)
    except ValueError:
        raise FormatError(f"{word}: not a number") from None


def _argument(title: str, word: str) -> str:
    name = word.removeprefix("~")
    base = base_of(name)
    if base in VALUE_NAMES:
        if base not in VALUES[title]:
            raise FormatError(
                f"{title} has no {base}: it has {', '.join(VALUES[title]) or 'no values'}"
            )
    elif base not in OBJECTS or name == base:
        raise FormatError(f"{title}: no argument {word!r}")
    elif base in ("T", "P") and title in PLACELESS:
        raise FormatError(f"{title} has no place of its own ({word})")
    elif base not in ("T", "P") and base not in HOLDS.get(title, ""):
        raise FormatError(f"{title} has no {word}")
    return word


def _check_line(line: Line) -> None:
    right = [name for name in line.slots if not name.startswith("~")]
    for base in {base_of(name) for name in right} - {"L"}:
        if sum(base_of(name) == base for name in right) > 1:
            raise FormatError(
                f"{line.title} has {base} twice; write one intent per target or value"
            )
    placed = line.here or any(base_of(name) in ("T", "P") for name in right)
    if (
        line.title not in PLACELESS
        and not placed
        and not (line.title == "FollowTarget" and any(name.startswith("ID") for name in right))
    ):
        raise FormatError(
            f"{line.title} has no place: give it T1 or P1, or `here` where the command names none"
        )
    if line.title == "SearchAndDetect" and not any(name.startswith("T") for name in right):
        raise FormatError("SearchAndDetect needs a target, T1")
    if line.near and base_of(line.near) != "P":
        raise FormatError(f"{line.title}: near what? Write near P1")
