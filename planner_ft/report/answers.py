"""Every sample with its answers and what differs, packed for the page: an index, and details."""

import base64
import gzip
import json
from collections import defaultdict
from collections.abc import Iterator
from typing import Any, Literal, NamedTuple

from rapidfuzz.distance import LCSseq

from planner_ft.benchmark.metrics.alignment import Entries, Entry, align, plan_entries, replaced
from planner_ft.benchmark.results import Row
from planner_ft.report.runs import TestSet
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, parse_output

PART = 200  # samples in a part, which is unpacked as a whole
RIGHT = "right"
LONGEST_OUTPUT = 20_000  # characters of a raw output that are shown


def script_json(value: Any) -> str:
    """JSON for a script element, which it cannot end; no comment, no line end."""
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def packed(value: Any) -> str:
    """JSON, compressed with gzip and written in base64."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    compressed = gzip.compress(text.encode("utf-8", "replace"), 6, mtime=0)
    return base64.b64encode(compressed).decode("ascii")


def index(tests: TestSet) -> dict[str, Any]:
    """What the page filters by: per sample id, command, group, family, and a brief per system."""
    outcomes, names = {RIGHT: 0}, dict[str, int]()

    def brief(system: Row, sample: str) -> list[Any] | None:
        score = tests.scores.get(system.key, {}).get(sample)
        if score is None:
            return None
        outcome = outcomes.setdefault(str(score.get("failure") or RIGHT), len(outcomes))
        output = tests.answers.get(system.key, {}).get(sample, {}).get("output")
        entries = plan_entries(tests.level, parse_output(output).plan)
        found = {names.setdefault(entry.name, len(names)) for entry in entries}
        f1 = score.get("f1")
        return [outcome, round(f1, 3) if isinstance(f1, int | float) else None, sorted(found)]

    rows = []
    for name in _sample_ids(tests):
        record = tests.samples.get(name, {})
        scores = [of_system[name] for of_system in tests.scores.values() if name in of_system]
        group = record.get("group") or next((score.get("group") for score in scores), None)
        command = str(record.get("prompt") or "")
        if tests.level == "task" and record.get("task"):
            command = f"{record['task']}: {command}"
        briefs = [brief(system, name) for system in tests.results.rows]
        rows.append([name, command, str(group or ""), str(record.get("family") or ""), briefs])
    systems = [system.name for system in tests.results.rows]
    found: dict[str, Any] = {"title": tests.title, "level": tests.level, "systems": systems}
    found |= {"outcomes": list(outcomes), "names": list(names)}
    return {**found, "samples": rows, "part": PART}


def parts(tests: TestSet) -> Iterator[str]:
    """Parts of PART samples: [expected, [entries, differences, problem, output] per system]."""
    ids = _sample_ids(tests)
    for start in range(0, len(ids), PART):
        yield packed([_details(tests, name) for name in ids[start : start + PART]])


def _sample_ids(tests: TestSet) -> list[str]:
    """The samples in the order of the data, else of the scores."""
    scored = dict.fromkeys(name for of_system in tests.scores.values() for name in of_system)
    return list(tests.samples or scored)


def _details(tests: TestSet, name: str) -> list[Any]:
    record = tests.samples.get(name, {})
    plan = record.get("expected")
    expected = plan_entries(tests.level, plan)
    given = {key: record[key] for key in ("task", "parameters") if key in record}
    answers = [_answer(tests, system, name, expected) for system in tests.results.rows]
    return [[_shown(tests.level, plan, entry) for entry in expected], answers, given]


def _answer(tests: TestSet, system: Row, name: str, expected: Entries) -> list[Any] | None:
    answer = tests.answers.get(system.key, {}).get(name)
    if answer is None:
        return None
    output = answer.get("output")
    raw = output if isinstance(output, str) else json.dumps(output, ensure_ascii=False)
    parsed = parse_output(output)
    entries = plan_entries(tests.level, parsed.plan)
    lines = []
    if name in tests.samples and tests.vocabulary:
        lines = differences(tests.level, expected, entries, tests.vocabulary)
    return [
        [_shown(tests.level, parsed.plan, entry) for entry in entries],
        lines,
        parsed.problem,
        raw if len(raw) <= LONGEST_OUTPUT else f"{raw[:LONGEST_OUTPUT]}… ({len(raw)} characters)",
    ]


def _shown(level: Level, plan: Any, entry: Entry) -> list[Any]:
    """An entry as the page shows it: name, parameters, place, and the task prompt of a task."""
    if level == "task":
        return [entry.name, entry.parameters, f"{entry.step + 1} {entry.role}", ""]
    prompt = plan["tasks"][entry.step].get("task_prompt")
    text = prompt if isinstance(prompt, str) else ""
    return [entry.name, entry.parameters, str(entry.step + 1), text]


Mark = Literal["same", "changed", "moved", "missing", "extra", "substituted"]


class Difference(NamedTuple):
    """Indices into the expected and the predicted entries, and the parameters that differ."""

    mark: Mark
    expected: int | None
    predicted: int | None
    changed: tuple[str, ...] = ()


def differences(
    level: Level, expected: Entries, predicted: Entries, vocabulary: Vocabulary
) -> list[Difference]:
    """The lines of a side-by-side view; additions stand where the answer has them."""
    alignment = align(expected, predicted, vocabulary)
    steady = _in_order([theirs for _ours, theirs in alignment.pairs])
    lines = {}
    for pair in alignment.pairs:
        one, other = expected[pair[0]], predicted[pair[1]]
        moved = pair[1] not in steady
        if level == "task":
            moved = (one.step, one.role) != (other.step, other.role)
        changed: tuple[str, ...] = ()
        if one.stated:
            changed = one.changed(other, vocabulary)
        mark: Mark = "changed" if changed else "moved" if moved else "same"
        lines[pair[0]] = Difference(mark, *pair, changed)
    for ours, theirs in replaced(alignment).items():
        lines[ours] = Difference("substituted", ours, theirs)
    beside = {line.predicted: ours for ours, line in lines.items()}
    after: dict[int, list[Difference]] = defaultdict(list)
    last = -1
    for index in range(len(predicted)):
        if index in beside:
            last = beside[index]
        else:
            after[last].append(Difference("extra", None, index))
    ordered = after[-1]
    for index in range(len(expected)):
        ordered += [lines.get(index, Difference("missing", index, None)), *after[index]]
    return ordered


def _in_order(numbers: list[int]) -> set[int]:
    """A longest increasing subsequence of different numbers: the others have moved."""
    blocks = LCSseq.opcodes(numbers, sorted(numbers))
    equal = [block for block in blocks if block.tag == "equal"]
    return {number for one in equal for number in numbers[one.src_start : one.src_end]}
