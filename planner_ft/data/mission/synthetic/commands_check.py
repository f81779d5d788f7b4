"""Templates read from files, with everything that is wrong about them: file, line and what to
do.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from planner_ft.data.mission.synthetic.commands_format import (
    REMARKS,
    Choice,
    FormatError,
    Line,
    Node,
    Slot,
    Template,
    base_of,
    parse_line,
    parse_text,
)
from planner_ft.support.errors import PlannerError

FOLDER = Path(__file__).parent / "commands"


@dataclass(frozen=True)
class Problem:
    """What is wrong with one line of a file."""

    path: Path
    number: int
    text: str

    def __str__(self) -> str:
        return f"{self.path}:{self.number}: {self.text}"


def read_templates(path: Path) -> tuple[list[Template], list[Problem]]:
    """The templates of a file and its problems. Raises PlannerError when the file cannot be
    read.
    """
    try:
        rows = path.read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise PlannerError(
            f"{path}: cannot be read as UTF-8 text ({error}); name a file of command templates"
        ) from None
    templates, problems = [], []
    for number, row in enumerate(rows, 1):
        if not row.strip() or row.lstrip().startswith("#"):
            continue
        try:
            templates.append(parse_template(row, path.stem, number))
        except FormatError as error:
            problems.append(Problem(path, number, str(error)))
    return templates, problems


@cache
def shipped_templates() -> tuple[Template, ...]:
    """The templates of the package, by file name and line; lines with a mistake, which the check
    names, are left out.
    """
    return tuple(
        template for path in sorted(FOLDER.glob("*.txt")) for template in read_templates(path)[0]
    )


def parse_template(row: str, subject: str, number: int) -> Template:
    """The template of one line. Raises FormatError."""
    text, arrow, intents = row.strip().rpartition("=>")
    if not arrow:
        raise FormatError("no ` => ` between the text and the intents")
    nodes = parse_text(text.strip())
    lines = tuple(parse_line(part) for part in intents.split(";") if part.strip())
    if not lines:
        raise FormatError("no intents: write `=> Nothing` for a command that asks for nothing")
    slots = list(all_slots(nodes))
    wrong = _wrong(slots, lines)
    lines = tuple(_right(line) for line in lines)
    _check_slots(nodes, slots, lines, wrong)
    return built_template(nodes, lines, subject, number, wrong)


def built_template(
    nodes: tuple[Node, ...],
    lines: tuple[Line, ...],
    subject: str,
    number: int = 0,
    wrong: frozenset[str] = frozenset(),
) -> Template:
    """The template of a text and its intents, which fit together."""
    slots = list(all_slots(nodes))
    return Template(nodes, lines, subject, number, _kinds(slots, lines), _bound(lines), wrong)


def all_slots(nodes: Iterable[Node]) -> Iterator[Slot]:
    """Every slot, of every alternative."""
    for node in nodes:
        if isinstance(node, Slot):
            yield node
        elif isinstance(node, Choice):
            for option in node.options:
                yield from all_slots(option)


def always_said(nodes: Iterable[Node]) -> set[str]:
    """The names of the slots that every alternative holds, wrong ones left out."""
    said: set[str] = set()
    for node in nodes:
        if isinstance(node, Slot) and not node.wrong:
            said.add(node.name)
        elif isinstance(node, Choice):
            said |= set.intersection(*(always_said(option) for option in node.options))
    return said


def _wrong(slots: list[Slot], lines: tuple[Line, ...]) -> frozenset[str]:
    """Names that are said only to be taken back: `~T1` among the arguments of an intent."""
    return frozenset(name[1:] for line in lines for name in line.slots if name.startswith("~"))


def _right(line: Line) -> Line:
    return Line(
        line.title,
        tuple(name for name in line.slots if not name.startswith("~")),
        line.fixed,
        line.here,
        line.near,
        line.tag,
        line.remark,
    )


def _check_slots(
    nodes: tuple[Node, ...], slots: list[Slot], lines: tuple[Line, ...], wrong: frozenset[str]
) -> None:
    said = {slot.name for slot in slots if not slot.wrong}
    wanted = {name for line in lines if line.title != "Not" for name in line.slots} | {
        line.near for line in lines if line.near
    }
    tags = {line.tag for line in lines if line.tag}
    noted = {slot.name for line in lines for slot in all_slots(line.remark)}
    for name in sorted((wanted | tags | noted | wrong) - said):
        raise FormatError(f"{name} belongs to an intent, but TEXT has no {{{name}}}")
    for name in sorted(said - wanted - tags - noted - wrong):
        raise FormatError(
            f"{{{name}}} is said, but belongs to no intent; a wrong value is {{~{name}}}"
        )
    for slot in slots:
        if slot.wrong and slot.name not in wanted | noted:
            raise FormatError(
                f"{{~{slot.name}}} is taken back, but no intent has the right {slot.name}"
            )
    always = always_said(nodes)
    for line in lines:
        for name in line.of("T", "P") if line.title not in REMARKS and not line.tag else ():
            optional = base_of(name) == "P" and (line.of("T") or line.of("ID"))
            if name not in always and not optional:
                raise FormatError(
                    f"{line.title} needs {{{name}}}, which not every alternative says"
                )


def _bound(lines: tuple[Line, ...]) -> dict[str, str]:
    """The position that a target or id is said to have, where it stands in a slot of its own:
    `PerformOrbit T1 P1`.
    """
    placed = [
        (of, line.of("P")[0])
        for line in lines
        if line.title not in REMARKS and line.of("P")
        for of in (*line.of("T"), *line.of("ID"))
    ]
    return dict(placed)


def _kinds(slots: list[Slot], lines: tuple[Line, ...]) -> dict[str, str]:
    """The kind of every target: as a slot says, or what its tasks are about."""
    kinds: dict[str, str] = {}
    for slot in slots:
        if slot.base == "T" and slot.kind and kinds.setdefault(slot.name, slot.kind) != slot.kind:
            raise FormatError(f"{slot.name} is of two kinds, {kinds[slot.name]} and {slot.kind}")
    for slot in slots:
        if slot.base == "T" and slot.name not in kinds:
            titles = {line.title for line in lines if slot.name in line.slots}
            kinds[slot.name] = next(
                (kind for title, kind in USUAL.items() if title in titles), "structure"
            )
    for line in lines:
        if (
            line.title == "KeepStation"
            and any(kinds.get(name) == "boat" for name in line.of("T"))
            and not line.of("duration")
            and not line.fixed
        ):
            raise FormatError(
                "staying with a boat for no stated time is FollowTarget; give KeepStation a"
                " duration"
            )
    return kinds


USUAL = {
    "FollowTarget": "boat",
    "SubseaCableTrack": "cable",
    "DockingApproach": "dock",
    "BoatLandingClearanceSweep": "landing",
}
