"""A vehicle of one's own: the files to start from, and what they lack for which command."""

import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.data.borrowing import like_tasks
from planner_ft.data.curated import SPLITS, curated_folder
from planner_ft.data.labels import unchecked_tags
from planner_ft.data.templates.checking import checked_templates
from planner_ft.data.templates.records import Kind, template_files, templates
from planner_ft.data.validation import validate_file
from planner_ft.document.language import language
from planner_ft.document.vehicle import load_vehicle
from planner_ft.facts.units import named
from planner_ft.support.alone import alone, staging
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl, read_text, write_text, writing
from planner_ft.support.terminal import Report, silent
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import (
    BUNDLED,
    ESSENTIALS,
    MISSIONS,
    READ_WITH_IT,
    bundled_vocabularies,
    read_beside,
)
from planner_ft.vocabulary.essentials import load_essentials
from planner_ft.vocabulary.limits import load_limits
from planner_ft.vocabulary.plans import plan_names

SKELETON, EXAMPLE = BUNDLED / "skeleton", "my_vehicle"
NAME = re.compile(r"[a-z][a-z0-9_]*")
State = Literal["ready", "missing", "wrong"]
SYNTHETIC = "gen-data --synthetic, train --augment"
FILES: tuple[tuple[str, str, str, Callable[[Vocabulary], Any] | None], ...] = (
    ("phrases", "gen-data --level task", "prompts use names and descriptions", None),
    ("missions", SYNTHETIC, "no synthetic or borrowed missions", lambda known: _missions(known)),
    ("vehicle", "plan", "plan stops: give --vehicle FILE", lambda known: load_vehicle(None, known)),
    ("essentials", "plan", "nothing is added to a task or asked", lambda known: _unlisted(known)),
    ("ontology", "plan, review", "commands are checked less closely", language),
    ("limits", "plan, review", "limits of a command are not checked", load_limits),
    ("motion", "review, export", "there is no track, estimate or exported movement", None),
    (
        "simulation",
        "simulate",
        "figures are derived from the profile, skills measure nothing",
        None,
    ),
    ("logic", "bench", "only places are checked when a plan is replayed", None),
)
"""Files beside a definition: the commands that read one, what is so without it, and what reads it
where that is not done with the definition.
"""


SLOT = re.compile(r"\{(\w+)\}")
SLOTS = (
    *("name", "place", "at", "thing", "of"),
    *("whereabouts", "position", "found", "feature", "part"),
)
"""What sentences of NAME.missions.toml can say of every task, beside its parameters."""
LIMIT = "Limit"  # stands in NAME.missions.toml for the limits of a command, beside the tasks
INDENT = 38  # columns before the text of a part
PATTERNS = (
    *("goto", "hold", "orbit", "square", "lawnmower", "pass", "line", "approach", "follow"),
    *("drift", "rotate", "visual", "sectors", "sweep", "arc"),
)
"""Patterns of tasks that mean something."""


@dataclass(frozen=True)
class Part:
    """A file of a vehicle, the commands that it serves, and how it is; a line for each problem."""

    file: str
    serves: str
    state: State
    text: str

    def __str__(self) -> str:
        first, *others = self.text.split("\n")
        text = [f"{self.state:8} {self.file:28} {first} ({self.serves})", *others]
        return f"\n{' ' * INDENT}".join(text)


def new_vehicle(name: str, out: Path | None = None) -> list[Path]:
    """Write the commented files of a vehicle, all or none, into `out`, else a new folder NAME;
    returns them. Raises PlannerError for a name or a folder that cannot be taken.
    """
    if not NAME.fullmatch(name) or name in bundled_vocabularies():
        why = "a bundled vehicle has it" if NAME.fullmatch(name) else "a name has a-z, 0-9 and _"
        raise PlannerError(f"{name}: {why}; take another one, such as my_rover")
    folder = out or Path(name)
    if folder.exists():
        raise PlannerError(f"{folder} exists; give a new folder with --out")
    spaced, written = EXAMPLE.replace("_", " "), []
    free = writing(f"--out {folder}", "choose another folder")
    with free, alone(folder, "--out", "vehicle new"), staging(folder) as staged:
        for path in sorted(SKELETON.rglob("*.*")):
            place = path.relative_to(SKELETON)
            if place.parent == Path():
                place = Path(f"{name}.{path.name}".replace(".definition.", "."))
            text = read_text(path).replace(EXAMPLE, name)
            write_text(staged / place, text.replace(spaced, name.replace("_", " ")))
            written.append(folder / place)
        staged.replace(folder)
    return written


def check_vehicle(
    source: str, simulation: Callable[[Vocabulary], Any] | None = None, report: Report = silent
) -> list[Part]:
    """Every file of a vehicle, with what is wrong or lacking; `simulation` reads that file. Raises
    PlannerError for a definition that is not there.
    """
    source = _definition(source)
    broken, wrong = _wrong(source)
    if broken:
        own = Part(Path(source).name, "every command", "wrong", broken)
        return [own, *_alone(Path(source), wrong)]
    vocabulary = load_vocabulary(source, without=tuple(wrong))
    path = vocabulary.path
    assert path is not None
    size = f"{len(vocabulary.tasks)} tasks, {len(vocabulary.skills)} skills"
    doubts = "".join(f"; {doubt}" for doubt in _doubts(vocabulary))
    return [
        Part(path.name, "every command", "ready", size + doubts),
        _part("mission/", "gen-data, train and bench --level mission", _mission_set, vocabulary),
        _part(
            f"{Path(vocabulary.source).stem}.commands.jsonl",
            SYNTHETIC,
            lambda known: _templates(known, report),
            vocabulary,
        ),
        *_beside(vocabulary, path, wrong, simulation),
    ]


def _wrong(source: str) -> tuple[str, dict[str, str]]:
    """What is wrong with a definition, and with each file that is read with it, by ending."""
    broken, wrong = _problem(source, READ_WITH_IT), dict[str, str]()
    for ending in READ_WITH_IT:
        found = _problem(source, tuple(one for one in READ_WITH_IT if one != ending))
        # The definition's own problems come first, where there are any.
        if found != broken:
            wrong[ending] = found.removeprefix(f"{broken}; ")
    return broken, wrong


def _problem(source: str, without: tuple[str, ...]) -> str:
    try:
        load_vocabulary(source, without=without)
    except PlannerError as error:
        return str(error)
    return ""


def _alone(path: Path, wrong: dict[str, str]) -> Iterator[Part]:
    """The files beside a broken definition that are wrong by themselves."""
    for kind, serves, _without, _reader in FILES:
        file, ending = path.with_suffix(f".{kind}.toml").name, f".{kind}.toml"
        try:
            read_beside(path, ending, path.stem)
            text = wrong.get(ending)
        except PlannerError as error:
            text = str(error)
        if text:
            yield Part(file, serves, "wrong", text)


def _part(
    file: str, serves: str, look: Callable[[Vocabulary], tuple[State, str]], vocabulary: Vocabulary
) -> Part:
    try:
        return Part(file, serves, *look(vocabulary))
    except PlannerError as error:
        return Part(file, serves, "wrong", str(error))


def _definition(source: str) -> str:
    """The definition that is meant: a file, a bundled vehicle, or the one of a folder."""
    if source in bundled_vocabularies() or Path(source).is_file():
        return source
    found = [path for path in Path(source).glob("*.toml") if "." not in path.stem]
    if len(found) != 1:
        what = f"holds {len(found)} definitions" if Path(source).is_dir() else "no such file"
        raise PlannerError(f"{source}: {what}; give the TOML file of a vehicle, or its folder")
    return str(found[0])


def _doubts(vocabulary: Vocabulary) -> Iterator[str]:
    """What a definition may have and hardly means."""
    listed = {name for task in vocabulary.tasks for names in task.skills.values() for name in names}
    if unused := [name for name in vocabulary.skill if name not in listed]:
        yield f"no task lists the skill {', '.join(unused)}"
    owners = [*vocabulary.tasks, *vocabulary.skills]
    for task in (one for one in vocabulary.tasks if one.pattern not in PATTERNS):
        yield f"the pattern {task.pattern!r} of {task.title} means nothing to planning"
    strange = {one.unit for owner in owners for one in owner.parameters if not named(one.unit)}
    for unit in sorted(filter(None, strange)):
        yield f"the unit {unit!r} is not known: numbers are taken as they are said"


def _beside(
    vocabulary: Vocabulary,
    path: Path,
    wrong: dict[str, str],
    simulation: Callable[[Vocabulary], Any] | None,
) -> Iterator[Part]:
    """The files beside a definition that is read, without those that are `wrong`."""
    for kind, serves, without, reader in FILES:
        load = simulation if kind == "simulation" else reader
        file = path.with_suffix(f".{kind}.toml")
        state: State = "ready" if file.is_file() else "missing"
        try:
            if problem := wrong.get(f".{kind}.toml"):
                raise PlannerError(problem)
            if unknown := _undefined(vocabulary.beside(f".{kind}.toml"), vocabulary):
                named_so = f"{', '.join(unknown)}: the definition has no such name"
                raise PlannerError(f"{file.name}: {named_so}; correct it, or remove the table")
            read = load(vocabulary) if load and file.is_file() else ()
            doubts = read if isinstance(read, list) else []
            text = "; ".join(["read", *doubts]) if file.is_file() else f"without it, {without}"
        except PlannerError as error:
            state, text = "wrong", str(error)
        yield Part(file.name, serves, state, text)


def _missions(vocabulary: Vocabulary) -> None:
    """Raises PlannerError for demands and slots that name nothing."""
    raw = vocabulary.beside(MISSIONS)
    like_tasks(vocabulary)
    problems = [
        f"[demand] names {name!r}, which is no skill"
        for name in raw.get("demand", {})
        if name not in vocabulary.skill
    ]
    for title, own in raw.get("task", {}).items():
        known = {*SLOTS, *(vocabulary.task[title].by_name if title in vocabulary.task else ())}
        used = SLOT.findall(" ".join([*own.get("prompt", ()), *own.get("before", ())]))
        problems += [
            f"[task.{title}]: {{{name}}} is no parameter, and none of {', '.join(SLOTS)}"
            for name in dict.fromkeys(used)
            if name not in known
        ]
    if problems:
        raise PlannerError(f"{vocabulary.name}{MISSIONS}: {'; '.join(problems)}")


def _unlisted(vocabulary: Vocabulary) -> list[str]:
    """Skills that the essentials add to a task whose definition does not list them. Raises
    PlannerError for values that a skill takes from a task in another unit.
    """
    known = load_essentials(vocabulary)
    for title, own in known.items():
        for name, takes in own.takes.items():
            for key, given in takes.items():
                one = vocabulary.skill[name].by_name[key].unit
                two = vocabulary.task[title].by_name[given].unit
                if named(one) and named(two) and named(one) != named(two):
                    problem = f"takes: {name}.{key} is in {one}, and {given} of the task in {two}"
                    where = f"{vocabulary.name}{ESSENTIALS}: [task.{title}]"
                    raise PlannerError(f"{where}: {problem}; give both one unit")
    return [
        f"{name} does not fit {title}, which does not list it: it is added all the same"
        for title, own in known.items()
        for name in own.skills
        if not any(name in fit for fit in vocabulary.task[title].skills.values())
    ]


def _undefined(raw: dict[str, Any], vocabulary: Vocabulary) -> list[str]:
    """The tables of tasks and skills in a file that the definition does not have."""
    known: dict[str, Iterable[str]] = {"task": vocabulary.task, "skill": vocabulary.skill}
    tables = ((kind, raw[kind]) for kind in known if isinstance(raw.get(kind), dict))
    return [
        f"[{kind}.{name}]"
        for kind, table in tables
        for name in table
        if name not in known[kind] and name != LIMIT
    ]


def _templates(vocabulary: Vocabulary, report: Report) -> tuple[State, str]:
    """The command and prompt templates, and the tasks that none asks for."""
    commands = [one for group in templates(vocabulary, "commands") for one in group]
    kinds: tuple[Kind, ...] = ("commands", "clauses", "prompts")
    of_all = [group for kind in kinds for group in templates(vocabulary, kind)]
    problems, total = list[str](), sum(map(len, of_all))
    for done, (_template, _drawn, error) in enumerate(checked_templates(vocabulary), 1):
        report("templates", done, total)
        problems += [str(error)] if error else []
    if problems:
        return "wrong", "\n".join(problems)
    if not template_files(vocabulary, "commands"):
        return "missing", "without it, there are no synthetic missions"
    asked = {step.call.name for one in commands for step in one.steps}
    prompts = sum(map(len, templates(vocabulary, "prompts")))
    size = f"{len(commands)} command and {prompts} prompt templates"
    return "ready", size + _unused(vocabulary, "no command asks for", asked)


def _mission_set(vocabulary: Vocabulary) -> tuple[State, str]:
    """The curated commands, and the tasks that are in none of them."""
    folder = curated_folder(vocabulary) or vocabulary.data / "mission"
    paths = [folder / f"{split}.jsonl" for split in SPLITS]
    if absent := [path.name for path in paths if not path.is_file()]:
        return "missing", f"{', '.join(absent)}: commands with their plans, written by people"
    reports = [validate_file(path, vocabulary, "mission", complete=True) for path in paths]
    if problems := [str(problem) for report in reports for problem in report.problems]:
        return "wrong", "\n".join(problems)
    records = [record for path in paths for record in read_jsonl(path)]
    found = Counter(name for one in records for name in plan_names("mission", one["expected"]))
    text = f"{len(records)} commands" + _unused(vocabulary, "none has", found)
    if tags := unchecked_tags(records, vocabulary):
        text += f"; tags about tasks of other vehicles are not checked: {', '.join(tags)}"
    return "ready", text


def _unused(vocabulary: Vocabulary, words: str, used: Iterable[str]) -> str:
    """The tasks beside those used; the transit follows from the rules."""
    titles = [title for title in vocabulary.task if title not in {*used, vocabulary.transit}]
    return f"; {words} {', '.join(titles)}" if titles else ""
