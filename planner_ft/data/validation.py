"""Checking datasets, predictions and plans against form, vocabulary and labelling rules.

A file is JSON Lines (or one JSON object) whose objects are told apart by what they hold: `expected`
makes a dataset record, `output` a prediction, `tasks` or `skill_sequence` a plan. Every problem is
reported, not the first alone.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.data.labels import completeness_problems, step_problems, tag_problems
from planner_ft.data.rules import rule_problems
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, decode_json, read_text
from planner_ft.vocabulary import Vocabulary, plans
from planner_ft.vocabulary.plans import LEVELS, STEP_KEYS, Level, list_key, plan_problems
from planner_ft.vocabulary.schema import ELEMENTS, FORMAT

Kind = Literal["record", "prediction", "plan"]
RECORD_KEYS = ("id", "family", "task", "parameters", "prompt", "expected", "spans", "tags")
"""The order in which a record's keys are written; others follow."""
LONGEST = 500_000
"""Characters of one record; the rules read every number and word of it."""


@dataclass(frozen=True)
class Problem:
    """What is wrong at a line of a file."""

    path: Path
    line: int
    text: str

    def __str__(self) -> str:
        return f"{self.path}:{self.line}: {self.text}"


@dataclass(frozen=True)
class Report:
    """What a file holds, by kind ("mission record", ...), and everything wrong with it."""

    path: Path
    counts: dict[str, int]
    problems: tuple[Problem, ...]


def validate_file(
    path: Path,
    vocabulary: Vocabulary,
    level: Level | None = None,
    *,
    complete: bool = False,
    canonical: bool = True,
) -> Report:
    """Check every object of a file. `complete` asks of dataset records what the curated set has:
    family, spans, tags, all texts and, unless told otherwise, `canonical` form.

    Raises PlannerError when the file is missing, unreadable, not UTF-8 or empty.
    """
    counts: Counter[str] = Counter()
    problems: list[Problem] = []
    lines: dict[str, int] = {}
    for line, value, problem in file_values(path):
        if problem or not isinstance(value, dict):
            text = problem or f"a JSON object is expected, not {type(value).__name__}"
            problems.append(Problem(path, line, text))
            continue
        kind, found, texts = object_problems(value, vocabulary, level, complete=complete)
        counts[" ".join(filter(None, (found, kind or "unknown object")))] += 1
        audited = complete and canonical and kind == "record" and not texts
        if audited and found and canonical_record(found, value, vocabulary) != compact_json(value):
            texts.append(
                "not in canonical form: order of keys or parameters, or a whole number written"
                " with a point"
            )
        # Unique is the id, of predictions of several systems with candidate and configuration.
        key = compact_json([str(value.get(key)) for key in ("id", "candidate", "configuration")])
        if kind != "plan" and key in lines:
            texts.append(f"id {value.get('id')!r} stands in line {lines[key]} already")
        lines.setdefault(key, line)
        problems += [Problem(path, line, text) for text in texts]
    return Report(path, dict(counts), tuple(problems))


def canonical_record(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The line of a valid record as gen-data writes it: keys in order, canonical plan."""
    values = {**record, "expected": plans.canonical_plan(level, record["expected"], vocabulary)}
    if level == "task":
        owner = vocabulary.task[record["task"]]
        values["parameters"] = plans.canonical_parameters(record["parameters"], owner)
    known = [key for key in RECORD_KEYS if key in values]
    return compact_json({key: values[key] for key in dict.fromkeys((*known, *values))})


def file_values(path: Path) -> Iterator[tuple[int, Any, str | None]]:
    """(line, value, None) or (line, None, what is wrong) for each object, one a line or whole."""
    text = read_text(path)
    if not text.strip():
        raise PlannerError(f"{path}: is empty; a dataset, predictions or a plan is expected")
    first = text.lstrip().split("\n", 1)[0]
    whole = path.suffix == ".json" or first.strip() in ("{", "[")
    for number, line in enumerate([text] if whole else text.split("\n"), 1):
        if len(line) > LONGEST:
            size = f"{len(line):,} characters, at most {LONGEST:,} are expected in one record"
            yield number, None, size
        elif line.strip():
            value, place, problem = decode_json(line, unique=True)
            yield (place or number) if whole else number, value, problem


def object_problems(
    value: dict[str, Any],
    vocabulary: Vocabulary,
    level: Level | None = None,
    *,
    complete: bool = False,
) -> tuple[Kind | None, Level | None, list[str]]:
    """Kind, level (`level`, if given) and problems of an object."""
    kind: Kind
    if value.get("format") == FORMAT:
        return None, level, ["a plan document, which `plannerft review FILE --show` checks"]
    if "expected" in value:
        kind, plan, key = "record", value["expected"], "expected: "
    elif "output" in value:
        kind, plan, key = "prediction", value["output"], "output: "
    elif any(list_key(known) in value for known in LEVELS):
        kind, plan, key = "plan", value, ""
    else:
        what = "a dataset record (expected), a prediction (output), a plan (tasks, skill_sequence)"
        return None, level, [f"none of {what}"]
    problems = _identifier_problems(value, ("id",)) if kind == "prediction" else []
    if kind == "prediction" and isinstance(plan, str):
        plan, _line, problem = decode_json(plan)
        if problem:
            return kind, level, [*problems, f"output: {problem}"]
    known_keys = plan.keys() if isinstance(plan, dict) else ()
    found = next((known for known in LEVELS if list_key(known) in known_keys), level)
    if found is None:
        return kind, None, [*problems, f"{key}holds neither tasks nor skill_sequence"]
    if level not in (None, found):
        problems.insert(0, f"a {level} plan is expected, this is a {found} plan")
    if kind == "record":
        problems += record_problems(found, value, vocabulary, complete=complete)
        return kind, found, problems
    texts = plan_problems(found, plan, vocabulary, strict=True)
    if found == "mission":
        prompt = value.get("prompt")
        texts += rule_problems(plan, vocabulary, prompt if isinstance(prompt, str) else None)
    return kind, found, [*problems, *(f"{key}{text}" for text in texts)]


# ---------------------------------------------------------------- dataset records


def record_problems(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary, *, complete: bool = False
) -> list[str]:
    """What is wrong with a record; only if `complete`, `expected` needs its texts."""
    family = ("family",) if complete or "family" in record else ()
    problems = _identifier_problems(record, ("id", "prompt", *family))
    if level == "task":
        problems += _task_problems(record, vocabulary)
    expected, prompt, tags = (record.get(key) for key in ("expected", "prompt", "tags"))
    whole = expected if complete else _filled(level, expected)
    form = plan_problems(level, whole, vocabulary, strict=True)
    problems += [f"expected: {text}" for text in form]
    if not isinstance(prompt, str) or not isinstance(expected, dict):
        return problems
    if level == "task":
        problems += [f"expected: {text}" for text in step_problems(record, vocabulary)]
        return problems
    known = isinstance(tags, list) and all(isinstance(tag, str) for tag in tags)
    found = rule_problems(expected, vocabulary, prompt, tags if known else None)
    problems += [f"expected: {text}" for text in found]
    problems += _annotation_problems(record, prompt, vocabulary, complete=complete)
    if complete and not form:
        problems += completeness_problems(record, vocabulary)
    return problems


def _identifier_problems(record: dict[str, Any], keys: tuple[str, ...]) -> list[str]:
    return [
        f"{key} is {'missing' if key not in record else 'no text'}"
        for key in keys
        if not (isinstance(record.get(key), str) and record[key].strip())
    ]


def _filled(level: Level, expected: Any) -> Any:
    """The plan with what an outsider may leave out: texts, and empty lists and parameters."""
    if not isinstance(expected, dict) or not isinstance(expected.get(list_key(level)), list):
        return expected
    entries = expected[list_key(level)]
    if level == "mission":
        tasks = [_with({"parameters": {}, "task_prompt": ""}, task) for task in entries]
        return {"assumptions": [], "constraints": [], **expected, "tasks": tasks}
    steps = []
    for entry in entries:
        step = _with({key: [] for key in STEP_KEYS[1:]}, entry)
        for key, skills in step.items() if isinstance(step, dict) else ():
            if key == STEP_KEYS[0]:
                step[key] = _with({"parameters": {}}, skills)
            elif key.endswith("_skills") and isinstance(skills, list):
                step[key] = [_with({"parameters": {}}, skill) for skill in skills]
        steps.append(step)
    return {**expected, "skill_sequence": steps}


def _with(defaults: dict[str, Any], entry: Any) -> Any:
    return {**defaults, **entry} if isinstance(entry, dict) else entry


def _task_problems(record: dict[str, Any], vocabulary: Vocabulary) -> list[str]:
    """What is wrong with the input of a task record: its title and parameters."""
    missing = [f"{key} is missing" for key in ("task", "parameters") if key not in record]
    if missing:
        return missing
    task = {"title": record["task"], "parameters": record["parameters"], "task_prompt": ""}
    plan = {"tasks": [task], "assumptions": [], "constraints": []}
    found = plan_problems("mission", plan, vocabulary, strict=True)
    places = ("tasks[0].parameters", "parameters"), ("tasks[0]", "task")
    return [text.replace(*places[0]).replace(*places[1]) for text in found]


def _annotation_problems(
    record: dict[str, Any], prompt: str, vocabulary: Vocabulary, *, complete: bool
) -> list[str]:
    problems = [f"{key} is missing" for key in ("spans", "tags") if complete and key not in record]
    for key in ("spans", "tags"):
        if not isinstance(record.get(key, []), list):
            return [*problems, f"{key} is no list"]
    for index, span in enumerate(record.get("spans", [])):
        problems += [f"spans[{index}]: {text}" for text in _span_problems(span, prompt)]
    if all(isinstance(tag, str) for tag in record.get("tags", [])):
        return problems + (list(tag_problems(record, vocabulary)) if "tags" in record else [])
    return [*problems, "tags holds something else than texts"]


def _span_problems(span: Any, prompt: str) -> Iterator[str]:
    if not isinstance(span, dict) or set(span) != {"element", "start", "end", "text"}:
        yield "an object with element, start, end and text is expected"
        return
    if span["element"] not in ELEMENTS:
        yield f"element {span['element']!r} is none of {', '.join(ELEMENTS)}"
    start, end = span["start"], span["end"]
    whole = all(type(bound) is int for bound in (start, end))
    if not whole or not 0 <= start < end <= len(prompt):
        yield f"{start!r} to {end!r} lies outside the prompt"
    elif prompt[start:end] != span["text"]:
        yield f"text is {span['text']!r}, but the prompt has {prompt[start:end]!r} there"
