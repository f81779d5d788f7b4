"""Cases, a line of JSON each: field cases (schemas/field.schema.json), and demands; and what a plan
document must do and say to pass them.

A command that was refused has no document but a sentence; only checks of what is said, and of what
must not be in a plan, can hold for it.

A demand record is {"id", "prompt", "skills": [{"task": TITLE, "skills": [NAME, ...]}], "locate"}: a
demand is met when some step of a task of the title has the skill.
"""

import functools
import json
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl, read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import is_number, is_position, step_skills
from planner_ft.vocabulary.schema import SHAPES

CASES, DEMANDS = Path("eval/field"), Path("eval/both/demands.jsonl")
"""The folder of cases, and the file of demands, where no file is named."""
Point = tuple[float, float]
CHECKS = (
    *("titles", "has", "lacks", "skill", "waypoints", "visits", "never_at", "clear", "outcome"),
    *("says", "warns", "quiet", "any"),
)
"""What an object of `expect` is told by."""
KEYS = ("id", "prompt", "skills", "locate", "expected")
Check = Mapping[str, Any]
Find = Callable[[Any, Vocabulary], str | None]
PLACED = {"never_at", "clear", "visits", "outcome"}
RELATIVE, LEAST = 0.02, 0.011
"""How far a number may be from the wanted one: a share of it, and at least so much."""
POSITION, VISITED, AT, SLACK = 0.6, 1.5, 1.0, 0.5
"""Metres: between positions, from a place that is visited, from one that is not, off a distance."""


@dataclass(frozen=True)
class Case:
    """A command with places (metres), origin (degrees) and checks; silent `danger` counts apart."""

    id: str
    kind: str
    command: str
    expect: tuple[Check, ...]
    locate: dict[str, Point] = field(default_factory=dict)
    origin: Point | None = None
    danger: bool = False


def case_files(files: Sequence[Path]) -> list[Path]:
    """The files, eval/field/*.jsonl without any. Raises PlannerError when there is none."""
    paths = list(files) or sorted(CASES.glob("*.jsonl"))
    if not paths:
        raise PlannerError(f"--field: there is no {CASES}/*.jsonl here; name a file of cases")
    return paths


def demands_file() -> Path:
    """The file of demands where none is named. Raises PlannerError when it is not here."""
    if not DEMANDS.is_file():
        way_out = "give --data FILE, or start in a checkout, which has it"
        raise PlannerError(f"--level both: there is no {DEMANDS} here; {way_out}")
    return DEMANDS


def load_cases(files: Sequence[Path], vocabulary: Vocabulary) -> list[Case]:
    """The cases of files. Raises PlannerError with file and line."""
    cases = []
    for value in _checked(files, vocabulary, _case_problem):
        origin = tuple(value["origin"]) if "origin" in value else None
        known = {"expect": tuple(value["expect"]), "locate": _places(value), "origin": origin}
        cases.append(Case(**{**value, **known}))
    return cases


def load_demands(files: Sequence[Path], vocabulary: Vocabulary) -> list[Case]:
    """The records of files as cases, a check per demand. Raises PlannerError with file and line."""
    cases = []
    for record in _checked(files, vocabulary, _demand_problem):
        expect = tuple(_demanded(record.get("skills", [])))
        cases.append(Case(record["id"], "both", record["prompt"], expect, _places(record)))
    if not any(case.expect for case in cases):
        raise PlannerError(f"{files[0]}: demands no skills; give records the key skills")
    return cases


def _checked(files: Sequence[Path], vocabulary: Vocabulary, find: Find) -> Iterator[Any]:
    """The values of files. Raises PlannerError at the first problem that `find` names."""
    seen = set[str]()
    for path in files:
        number = 0
        for number, value, problem in iterate_jsonl(path):
            problem = problem or find(value, vocabulary)
            if value is not None and not problem and value["id"] in seen:
                problem = f"id {value['id']!r} is given twice; give every case its own"
            if problem or value is None:
                raise PlannerError(f"{path}:{number}: {problem}")
            seen.add(value["id"])
            yield value
        if not number:
            raise PlannerError(f"{path}: holds no cases")


def _places(value: dict[str, Any]) -> dict[str, tuple[float, float]]:
    return {name: (x, y) for name, (x, y) in value.get("locate", {}).items()}


def _case_problem(value: Any, vocabulary: Vocabulary) -> str | None:
    """What is wrong with a case: its form, a name that the vehicle has not, or an expression."""
    from jsonschema.exceptions import best_match

    expect = value.get("expect") if isinstance(value, dict) else None
    for check in expect if isinstance(expect, list) else ():
        if isinstance(check, dict) and not check.keys() & {*CHECKS}:
            return f"expect: {str(check)[:80]} is no check; there is {', '.join(CHECKS)}"
    if found := best_match(_validator().iter_errors(value)):
        where = found.json_path.removeprefix("$").lstrip(".") or "the case"
        return f"{where}: {found.message[:200]}"
    return next((text for one in value["expect"] for text in check_problems(one, vocabulary)), None)


def _demand_problem(value: Any, vocabulary: Vocabulary) -> str | None:
    if not isinstance(value, dict) or not all(isinstance(value.get(key), str) for key in KEYS[:2]):
        return "a record with the texts id and prompt is expected"
    if unknown := [key for key in value if key not in KEYS]:
        return f"unknown key {unknown[0]!r}; there is {', '.join(KEYS)}"
    entries = value.get("skills", [])
    if not isinstance(entries, list) or not all(map(_is_demand, entries)):
        return 'skills must be a list of {"task": TITLE, "skills": [NAME, ...]}'
    checks = [*({"under": entry["task"]} for entry in entries), *_demanded(entries)]
    problems = (text for check in checks for text in check_problems(check, vocabulary))
    return next((f"skills: {text}" for text in problems), None)


def _demanded(entries: Sequence[dict[str, Any]]) -> list[dict[str, str]]:
    return [{"skill": name, "under": one["task"]} for one in entries for name in one["skills"]]


def _is_demand(entry: Any) -> bool:
    if not isinstance(entry, dict) or entry.keys() != {"task", "skills"}:
        return False
    names = entry["skills"] if isinstance(entry["skills"], list) else [None]
    return all(isinstance(name, str) for name in (entry["task"], *names))


def check_problems(check: Check, vocabulary: Vocabulary) -> Iterator[str]:
    """Names of a check that the vehicle has not, and bad regular expressions."""
    for inner in check.get("any", ()):
        yield from check_problems(inner, vocabulary)
    named = [check[key] for key in ("has", "lacks", "under") if key in check]
    for title in (*check.get("titles", ()), *named):
        if title not in vocabulary.task:
            yield f"{title!r} is no task of this vehicle"
    owner: Any = vocabulary.task.get(check.get("has", ""))
    if "skill" in check:
        owner = vocabulary.skill.get(check["skill"])
        if owner is None:
            yield f"{check['skill']!r} is no skill of this vehicle"
    for name in check.get("with", {}) if owner else ():
        if name not in owner.by_name:
            yield f"with: {name!r} is no parameter there"
    for key in ("says", "warns"):
        try:
            re.compile(check.get(key, ""))
        except re.error as error:
            yield f"{key}: {check[key]!r} is no regular expression ({error})"


@functools.cache
def _validator() -> Any:
    import jsonschema

    schema = json.loads(read_text(SHAPES / "field.schema.json"))
    return jsonschema.Draft202012Validator(schema)


@dataclass(frozen=True)
class Outcome:
    """What a command came to: the plan document ({} for none), and the refusal."""

    document: Mapping[str, Any]
    error: str | None = None

    @property
    def tasks(self) -> list[dict[str, Any]]:
        return list(self.document.get("tasks", ()))

    @property
    def warnings(self) -> list[str]:
        return [warning["text"] for warning in self.document.get("warnings", ())]

    @property
    def silent(self) -> bool:
        """Whether the plan came without a warning."""
        return self.error is None and not self.warnings

    def texts(self) -> list[str]:
        """The refusal, warnings, assumptions, constraints and questions."""
        found = [*([self.error] if self.error else []), *self.warnings]
        for key in ("assumptions", "constraints", "questions"):
            found += self.document.get(key, ())
        return found + list(self.document.get("ontology", {}).get("questions", ()))


def passes(check: Check, outcome: Outcome, vocabulary: Vocabulary) -> bool:
    """Whether a plan, or the refusal to plan, passes a check."""
    if "any" in check:
        return any(passes(one, outcome, vocabulary) for one in check["any"])
    heard = {"says": outcome.texts(), "warns": [outcome.error or "", *outcome.warnings]}
    for key in heard.keys() & check.keys():
        return re.search(check[key], "\n".join(heard[key]), re.IGNORECASE) is not None
    points = waypoints(outcome, vocabulary) if PLACED & check.keys() else []
    if "quiet" in check:
        return outcome.error is None and len(outcome.warnings) <= int(check["quiet"])
    if "never_at" in check:
        return all(math.dist(point, check["never_at"]) > AT for point in points)
    if "clear" in check:
        x, y, away = check["clear"]
        return _distance((x, y), points, vocabulary) >= float(away) - SLACK
    if "lacks" in check:
        return all(task["title"] != check["lacks"] for task in outcome.tasks)
    return outcome.error is None and _does(check, outcome, points, vocabulary)


def _does(check: Check, outcome: Outcome, points: list[Point], vocabulary: Vocabulary) -> bool:
    """Checks of what only a plan can do."""
    if "titles" in check:
        return bool([task["title"] for task in outcome.tasks] == check["titles"])
    if "has" in check:
        named = [task for task in outcome.tasks if task["title"] == check["has"]]
        return any(_fits(task["parameters"], check.get("with", {})) for task in named)
    if "waypoints" in check:
        return len(waypoints(outcome, vocabulary, check["under"])) == int(check["waypoints"])
    if "visits" in check:
        along = iter(points)  # goes on behind each place: they come in this order
        places = check["visits"]
        return all(any(math.dist(point, place) <= VISITED for point in along) for place in places)
    if "outcome" in check:
        return _ends(check["outcome"], outcome, points, vocabulary)
    tasks = (task for task in outcome.tasks if task["title"] == check["under"])
    hits = [_has_skill(step, check) for task in tasks for step in _steps(task)]
    return bool(hits) and (all(hits) if check.get("on") == "all" else any(hits))


def waypoints(outcome: Outcome, vocabulary: Vocabulary, title: str | None = None) -> list[Point]:
    """Where the steps of the tasks (of one title) go, in order."""
    found = []
    for task in (task for task in outcome.tasks if title in (None, task["title"])):
        for skill in (step["navigation_skill"] for step in _steps(task)):
            known = vocabulary.skill[skill["name"]].coordinates
            if names := [parameter.name for parameter in known]:
                x, y = (skill["parameters"][name] for name in names)
                found.append((x, y))
    return found


def _steps(task: Mapping[str, Any]) -> list[Any]:
    return list(task.get("skill_sequence") or ())


def _has_skill(step: Any, check: Check) -> bool:
    skills = (skill for _role, skill in step_skills(step) if skill["name"] == check["skill"])
    return any(_fits(skill["parameters"], check.get("with", {})) for skill in skills)


def _ends(wanted: Any, outcome: Outcome, points: list[Point], vocabulary: Vocabulary) -> bool:
    if wanted == "dock":
        last = vocabulary.task.get(outcome.tasks[-1]["title"]) if outcome.tasks else None
        visual = last is not None and (last.arrival, last.pattern) == ("none", "visual")
        return visual or (last is not None and last.docks)
    place = vocabulary.home if wanted == "home" else wanted
    return bool(points) and math.dist(points[-1], place) <= AT


def _distance(place: Point, points: list[Point], vocabulary: Vocabulary) -> float:
    """Metres between a place and the straight legs from home through the points."""
    from shapely import LineString
    from shapely import Point as Dot

    legs = [vocabulary.home, *points]
    return float(LineString(legs).distance(Dot(place))) if points else math.inf


def _fits(given: Mapping[str, Any], wanted: Mapping[str, Any]) -> bool:
    return all(key in given and _same(given[key], value) for key, value in wanted.items())


def _same(value: Any, wanted: Any) -> bool:
    """Numbers nearly, positions within POSITION, texts by containment, lists item by item."""
    if isinstance(wanted, str):
        return wanted.casefold() in str(value).casefold()
    if is_position(wanted):
        return is_position(value) and math.dist(value, wanted) <= POSITION
    if isinstance(wanted, list):
        alike = isinstance(value, list) and len(value) == len(wanted)
        return alike and all(map(_same, value, wanted))
    if is_number(wanted):
        return is_number(value) and abs(value - wanted) <= max(RELATIVE * abs(wanted), LEAST)
    return bool(value == wanted)
