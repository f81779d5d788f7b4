"""Commands that people wrote to the surface vehicle, translated for another vehicle.

How people correct themselves, put things in order, limit and dictate hardly depends on the vehicle.
A command is borrowed where each of its tasks is one that the other vehicle has: tasks that
NAME.missions.toml says to be `like` one of the surface vehicle, and beside them the way somewhere
and a search.
"""

import re
from collections.abc import Iterable, Mapping
from pathlib import Path
from random import Random
from typing import Any

import planner_ft
from planner_ft.data.mission_plan import say
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.units import named
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Task, Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import MISSIONS
from planner_ft.vocabulary.essentials import load_essentials
from planner_ft.vocabulary.plans import is_number, plan_problems

OPERATORS = ("train.jsonl", "things.jsonl", "more.jsonl")
"""Commands to the surface vehicle (data/operators)."""
BUNDLED = Path(__file__).parent / "curated" / "operators"
"""Where a wheel carries them."""
_FIXED = {
    "found": "once it has been found",
    "whereabouts": "around .+?",
    **dict.fromkeys(("number", "integer"), r"-?\d+(?:\.\d+)?"),
    "position": r"\[[^\]]+\]",
}
"""What slots say, by name or the parameter's type; the others say anything."""
WITHOUT_LIKE = 2
"""Tasks known from the definition: commands with the way and the search alone teach nothing."""
Record = dict[str, Any]
_SLOT = re.compile(r"\\\{(\w+)\\\}")
_ORIGIN = re.compile(r"(?<![\d.])0, ?0\b")
"""Home as coordinates, which another vehicle has elsewhere."""
_SENTENCE = re.compile(r"(.+?\.)(?: ([A-Z].*))?")


def borrowed(vocabulary: Vocabulary, count: int, seed: int) -> list[Record]:
    """At most `count` mission records for `vocabulary`, drawn from the commands to the surface
    vehicle (for that vehicle all of them); none for a vehicle without a task that is `like` one.
    Raises PlannerError for a task that is `like` none, and where the commands are missing.
    """
    alike = like_tasks(vocabulary)
    if len(alike) <= WITHOUT_LIKE:
        return []
    translator = _Translator(load_vocabulary(), vocabulary, alike)
    records = [record for path in operators_files() for record in read_jsonl(path)]
    Random(f"borrow {seed}").shuffle(records)
    made: list[Record] = []
    for record in records:
        if len(made) == count:
            break
        if translated := translator.record(record):
            made.append(translated)
    return made


def like_tasks(vocabulary: Vocabulary) -> dict[str, Task]:
    """The tasks of `vocabulary` by the title of the surface vehicle's task that they are like.
    Raises PlannerError for a title that it does not have.
    """
    source = load_vocabulary()
    if vocabulary.source == source.source:
        return dict(vocabulary.task)
    alike = {
        source.transit: vocabulary.task[vocabulary.transit],
        source.locate: vocabulary.task[vocabulary.locate],
    }
    for title, entry in vocabulary.beside(MISSIONS).get("task", {}).items():
        if (other := entry.get("like")) is None or title not in vocabulary.task:
            continue
        if other not in source.task:
            known = ", ".join(source.task)
            raise PlannerError(
                f"{vocabulary.name}{MISSIONS}: [task.{title}] like = {other!r} is no task of the"
                f" surface vehicle: give one of {known}"
            )
        alike[other] = vocabulary.task[title]
    return alike


def operators_files() -> list[Path]:
    """The commands to the surface vehicle, in the checkout or the package. Raises PlannerError."""
    checkout = Path(planner_ft.__file__).parent.parent / "data" / "operators"
    for folder in (checkout, BUNDLED):
        if all((folder / name).is_file() for name in OPERATORS):
            return [folder / name for name in OPERATORS]
    raise PlannerError(f"--borrow: the commands are neither in {checkout} nor in the package")


class _Translator:
    """Makes records of one vehicle records of another one."""

    def __init__(self, source: Vocabulary, own: Vocabulary, alike: Mapping[str, Task]) -> None:
        self.source, self.own, self.alike = source, own, alike
        self._said, self._texts = source.beside(MISSIONS), own.beside(MISSIONS)
        self._essentials = load_essentials(source)
        self._places = {
            str(list(source.home)): list(own.home),
            str(list(source.unresolved)): list(own.unresolved),
        }

    def record(self, record: Record) -> Record | None:
        """The record for the other vehicle; None where that has no such task, or the command may
        state a value that only its tasks have.
        """
        plan = record["expected"]
        if list(self.own.home) != list(self.source.home) and _ORIGIN.search(record["prompt"]):
            return None
        tasks = list(filter(None, map(self._task, plan["tasks"])))
        if not tasks or len(tasks) < len(plan["tasks"]) or self._unused(record, tasks):
            return None
        beside = ("assumptions", "constraints")
        texts = {key: [self._placed(text) for text in plan[key]] for key in beside}
        expected = {"tasks": tasks, **texts}
        if plan_problems("mission", expected, self.own, strict=True):
            return None
        return {**record, "id": f"borrowed-{record['id']}", "expected": expected}

    def _task(self, task: Record) -> Record | None:
        """The task under the other vehicle's names."""
        own = self.alike.get(task["title"])
        if own is None:
            return None
        names = _names(self.source.task[task["title"]], own)
        known = self._essentials.get(task["title"])
        defaults = known.defaults if known else {}
        values = {
            name: value
            for name, value in task["parameters"].items()
            if name in names or defaults.get(name) != value
        }
        if not values.keys() <= names.keys():
            return None
        given = {names[name]: self._places.get(str(value), value) for name, value in values.items()}
        prompt = self._prompt(task, own, names)
        made = {"title": own.title, "parameters": given, "task_prompt": prompt}
        return made if prompt else None

    def _prompt(self, task: Record, own: Task, names: Mapping[str, str]) -> str | None:
        """The task prompt in the other vehicle's words; what stands behind its first sentence
        (data, limits) stays.
        """
        parts = _SENTENCE.fullmatch(task["task_prompt"])
        if parts is None or self._foreign(parts[2] or ""):
            return None
        home = task["parameters"].get(self.source.task[task["title"]].position_parameter or "")
        tables = [config["home"] for config in (self._said, self._texts) if "home" in config]
        if home == list(self.source.home) and len(tables) == 2 and "home" in parts[1]:
            text = tables[1]["prompt"][0].replace("\\", "")
        else:
            forms = self._said["task"][task["title"]]["prompt"]
            slots = _read(self.source.task[task["title"]], forms, parts[1])
            sources = self._texts.get("task", {}).get(own.title, {}).get("prompt", [])
            if slots is None or say(forms, slots) != parts[1]:
                return None
            said = {names.get(name, name): value for name, value in slots.items()}
            if place := said.get("place") or said.get("thing"):
                said |= {"place": place, "thing": place}
            text = say(sources, said) or ""
            if not text:
                return None
        return self._placed(" ".join(filter(None, (text, parts[2]))))

    def _foreign(self, sentences: str) -> bool:
        """Whether they ask for data in words that the other vehicle has not."""
        own = set(self._texts.get("demand", {}).values())
        asked = set(self._said["demand"].values()) - own
        return any(sentence.startswith(tuple(asked)) for sentence in sentences.split(". "))

    def _placed(self, text: str) -> str:
        """The text with the other vehicle's home and unresolved place."""
        for place, other in self._places.items():
            text = text.replace(place, str(other))
        return text

    def _unused(self, record: Record, tasks: list[Record]) -> bool:
        """Whether the command may state a value of a parameter that only the other vehicle's tasks
        have: a number of its unit that the plan does not hold.
        """
        free = {
            parameter.unit
            for task in tasks
            for parameter in self.own.task[task["title"]].parameters
            if parameter.name not in task["parameters"] and named(parameter.unit)
        }
        held = {
            value for task in tasks for value in task["parameters"].values() if is_number(value)
        }
        return any(
            number.unit in free and round(number.value, 2) not in held
            for number in read_numbers(record["prompt"])
        )


def _names(source: Task, own: Task) -> dict[str, str]:
    """The parameters of `own` by those of `source`: of the same name, else alone of their kind."""
    names = {one.name: one.name for one in source.parameters if one.name in own.by_name}
    for one in source.parameters:
        kinds = [two.name for two in own.parameters if (two.type, two.unit) == (one.type, one.unit)]
        same = [two for two in source.parameters if (two.type, two.unit) == (one.type, one.unit)]
        if one.name not in names and len(kinds) == len(same) == 1:
            names[one.name] = kinds[0]
    return names


def _read(task: Task, sources: Iterable[str], text: str) -> dict[str, str] | None:
    """The slots of a sentence that one of the forms of `task` wrote; None where none did."""
    for source in sources:
        escaped = re.escape(source).replace(r"\[", "(?:").replace(r"\]", ")?")
        pattern = _SLOT.sub(lambda slot: f"(?P<{slot[1]}>{_said(task, slot[1])})", escaped)
        if match := re.fullmatch(pattern, text):
            return {name: value for name, value in match.groupdict().items() if value}
    return None


def _said(task: Task, slot: str) -> str:
    """What a slot says, as a pattern."""
    kind = task.by_name[slot].type if slot in task.by_name else ""
    return _FIXED.get(slot) or _FIXED.get(kind, ".+?")
