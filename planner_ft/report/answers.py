"""Every sample with its answers, packed for the page: an index to filter by, and details in
compressed parts that are opened when needed.
"""

from __future__ import annotations

import base64
import gzip
import json
from collections.abc import Iterator
from typing import Any

from planner_ft.benchmark.metrics.entries import Entry, plan_entries
from planner_ft.report.differences import Difference, differences, entries_of, shown
from planner_ft.report.runs import Record, System, TestSet
from planner_ft.vocabulary.outputs import parse_output
from planner_ft.vocabulary.plans import Level

PART = 200
"""Samples in a part; a part is unpacked as a whole when one of its samples is opened."""
RIGHT = "right"
LONGEST_OUTPUT = 20_000
"""Characters of a raw output that are shown."""


def script_json(value: Any) -> str:
    """JSON that can stand inside a script element: no character of it can end the element, begin a
    comment or break a line.
    """
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def packed(value: Any) -> str:
    """JSON, compressed with gzip and written in base64."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"))
    return base64.b64encode(gzip.compress(text.encode("utf-8", "replace"), 6, mtime=0)).decode(
        "ascii"
    )


def sample_ids(tests: TestSet) -> list[str]:
    """The samples in the order of the data, else of the scores."""
    return list(tests.samples) or list(
        dict.fromkeys(name for system in tests.systems for name in system.scores)
    )


def index(tests: TestSet) -> dict[str, Any]:
    """What the page filters by: systems, outcomes, names, and per sample id, command, group, family
    and (outcome, F1, names) per system.
    """
    outcomes, names = _Numbers([RIGHT]), _Numbers()
    rows = []
    for name in sample_ids(tests):
        record = tests.samples.get(name, {})
        answers = [_brief(tests, system, name, outcomes, names) for system in tests.candidates]
        group = record.get("group") or next(
            (system.scores[name].get("group") for system in tests.systems if name in system.scores),
            None,
        )
        rows.append(
            [
                name,
                _command(tests.level, record),
                str(group or ""),
                str(record.get("family") or ""),
                answers,
            ]
        )
    return {
        "title": tests.title,
        "level": tests.level,
        "systems": [system.name for system in tests.candidates],
        "outcomes": outcomes.values,
        "names": names.values,
        "samples": rows,
        "part": PART,
    }


def parts(tests: TestSet) -> Iterator[str]:
    """Details of `PART` samples after the other: [expected entries, [entries or None, differences,
    problem, raw output] per system].
    """
    ids = sample_ids(tests)
    for start in range(0, len(ids), PART):
        yield packed([_details(tests, name) for name in ids[start : start + PART]])


class _Numbers:
    """Texts by number, so that the index says each once."""

    def __init__(self, values: list[str] | None = None) -> None:
        self.values = values or []
        self.known = {value: number for number, value in enumerate(self.values)}

    def of(self, value: str) -> int:
        if value not in self.known:
            self.known[value] = len(self.values)
            self.values.append(value)
        return self.known[value]


def _command(level: Level, record: Record) -> str:
    prompt = str(record.get("prompt") or "")
    return f"{record['task']}: {prompt}" if level == "task" and record.get("task") else prompt


def _brief(
    tests: TestSet, system: System, name: str, outcomes: _Numbers, names: _Numbers
) -> list[Any] | None:
    score = system.scores.get(name)
    if score is None:
        return None
    f1 = score.get("f1")
    found = {names.of(entry.name) for entry in entries_of(tests, name, system)}
    return [
        outcomes.of(str(score.get("failure") or RIGHT)),
        round(f1, 3) if isinstance(f1, int | float) else None,
        sorted(found),
    ]


def _details(tests: TestSet, name: str) -> list[Any]:
    record = tests.samples.get(name, {})
    expected = entries_of(tests, name)
    given = {key: record[key] for key in ("task", "parameters") if key in record}
    entries = [shown(tests.level, record.get("expected"), entry) for entry in expected]
    return [entries, [_answer(tests, system, name, expected) for system in tests.candidates], given]


def _answer(
    tests: TestSet, system: System, name: str, expected: tuple[Entry, ...]
) -> list[Any] | None:
    answer = system.answers.get(name)
    if answer is None:
        return None
    output = answer.get("output")
    raw = output if isinstance(output, str) else json.dumps(output, ensure_ascii=False)
    parsed = parse_output(output)
    entries = plan_entries(tests.level, parsed.plan)
    lines = (
        differences(tests.level, expected, entries, tests.vocabulary)
        if name in tests.samples and tests.vocabulary
        else []
    )
    cut = raw if len(raw) <= LONGEST_OUTPUT else f"{raw[:LONGEST_OUTPUT]}… ({len(raw)} characters)"
    return [
        [shown(tests.level, parsed.plan, entry) for entry in entries],
        [_line(line) for line in lines],
        parsed.problem,
        cut,
    ]


def _line(line: Difference) -> list[Any]:
    return [line.mark, line.expected, line.predicted, list(line.changed)]
