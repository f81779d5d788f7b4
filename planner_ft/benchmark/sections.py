"""The parts of table.md behind the published layout: names, order and parameters apart, figures per
name, what stood for what, examples.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from planner_ft.benchmark.layout import NOTHING, Column, system_name
from planner_ft.benchmark.metrics import FAILURES
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.statistics import Estimate

NAMES = (
    Column("f1", "Set F1", "↑"),
    Column("precision", "Set precision", "↑"),
    Column("recall", "Set recall", "↑"),
    Column("multiset_f1", "Multiset F1", "↑"),
    Column("multiset_precision", "Multiset precision", "↑"),
    Column("multiset_recall", "Multiset recall", "↑"),
    Column("navigation_f1", "Navigation F1", "↑"),
    Column("filter_f1", "Filter F1", "↑"),
    Column("perception_f1", "Perception F1", "↑"),
)
ORDER = (
    Column("exact_sequence", "Exact sequence (%)", "↑", 100, 1, 1),
    Column("edit_distance", "Edit distance", "↓"),
    Column("step_edit_distance", "Edit distance, steps", "↓"),
    Column("lcs_f1", "Common subsequence F1", "↑"),
    Column("edge_f1", "Edge F1", "↑"),
)
PARAMETERS = (
    Column("parameters", "All right (%)", "↑", 100, 1, 1),
    Column("parameter_keys_f1", "Keys F1", "↑"),
    Column("parameter_values_f1", "Values F1", "↑"),
    Column("parameter_keys_overall_f1", "Keys F1, whole plan", "↑"),
    Column("parameter_values_overall_f1", "Values F1, whole plan", "↑"),
)
WHOLE = (
    Column("whole_plan", "In order (%)", "↑", 100, 1, 1),
    Column("whole_plan_unordered", "In any order (%)", "↑", 100, 1, 1),
)
FACTS = (
    Column("slots_in_parameters", "Stated facts in the right parameter (%)", "↑", 100, 1, 1),
    Column("slots_in_prompt", "Stated facts in the task prompt (%)", "↑", 100, 1, 1),
    Column("grounded", "Answers without a value that nobody gave (%)", "↑", 100, 1, 1),
    Column("grounded_values", "Values that somebody gave (%)", "↑", 100, 1, 1),
)
LOGIC = (
    Column("executable", "Runs to the end (%)", "↑", 100, 1, 1),
    Column("right_refusal", "Impossible commands refused (%)", "↑", 100, 1, 1),
    Column("wrong_refusal", "Possible commands refused (%)", "↓", 100, 1, 1),
    Column("worst_f1", "F1, worst of a family", "↑"),
    Column("paraphrases_right", "Families all right (%)", "↑", 100, 1, 1),
)
SECTIONS: tuple[tuple[str, tuple[Column, ...]], ...] = (
    ("Names", NAMES),
    ("Order", ORDER),
    ("Parameters of matched entries", PARAMETERS),
    ("Whole plan right", WHOLE),
    ("Facts of the command", FACTS),
    ("Logic of the plan", LOGIC),
)
"""Tables with a line per system. A column that no system has a figure for is left out."""
SHOWN_PAIRS = 15
SHOWN_IDS = 3
SHOWN_OTHERS = 10
LONGEST_CELL = 80


def section_columns() -> list[Column]:
    """Every column of the sections."""
    return [column for _title, columns in SECTIONS for column in columns]


def sections_markdown(results: Results) -> list[str]:
    """A table per section, baselines at its end."""
    systems = [(system_name(row), row) for row in results.rows] + [
        (row.system.label, row) for row in results.baselines
    ]
    lines: list[str] = []
    for title, columns in SECTIONS:
        known = [
            column
            for column in columns
            if any(_estimate(row, column).value is not None for row in results.rows)
        ]
        if known:
            heads = (f"{column.heading} {column.better}" for column in known)
            rows = (
                [name, str(row.n), *(_cell(_estimate(row, column), column) for column in known)]
                for name, row in systems
            )
            lines += _table([title, "n", *heads], rows)
    return lines


def names_markdown(results: Results) -> list[str]:
    """F1 of each name with its interval, and its support: the occurrences expected. Precision and
    recall are in results.json, and so are all names that were predicted and nowhere expected.
    """
    lines: list[str] = []
    for part, heading in (("per_role", "role"), ("per_name", "name")):
        figures = [
            {entry[heading]: entry for entry in row.breakdown.get(part, ())} for row in results.rows
        ]
        support = {
            name: entry["expected"] for names in reversed(figures) for name, entry in names.items()
        }
        ordered = sorted(support, key=lambda name: (-support[name], name))
        ordered = [name for name in ordered if support[name]] + [
            name for name in ordered if not support[name]
        ][:SHOWN_OTHERS]
        columns = [system_name(row) for row in results.rows]
        rows = (
            [name, str(support[name]), *(_f1(names.get(name)) for names in figures)]
            for name in ordered
        )
        if ordered:
            lines += _table([f"F1 per {heading} ↑", "expected", *columns], rows)
    return lines


def substitutions_markdown(results: Results) -> list[str]:
    """The most frequent pairs of expected and predicted name that differ."""
    figures = [
        {
            (pair["expected"], pair["predicted"]): pair["n"]
            for pair in row.breakdown.get("substitutions", ())
        }
        for row in results.rows
    ]
    total = sum((Counter(pairs) for pairs in figures), Counter())
    if not total:
        return []
    frequent = sorted(total, key=lambda pair: (-total[pair], pair[0] or "", pair[1] or ""))[
        :SHOWN_PAIRS
    ]
    rows = (
        [
            one or "(nothing)",
            other or "(nothing)",
            *(str(pairs.get((one, other), 0)) for pairs in figures),
        ]
        for one, other in frequent
    )
    return _table(
        ["Expected", "predicted", *(system_name(row) for row in results.rows)], rows, texts=2
    )


def examples_markdown(results: Results) -> list[str]:
    """Ids of wrong answers by kind."""
    figures = [row.breakdown.get("failure_examples", {}) for row in results.rows]
    kinds = [kind for kind in FAILURES if any(kind in examples for examples in figures)]
    rows = (
        [kind, *(", ".join(examples.get(kind, [])[:SHOWN_IDS]) or NOTHING for examples in figures)]
        for kind in kinds
    )
    columns = [system_name(row) for row in results.rows]
    return (
        _table(["Examples of wrong answers", *columns], rows, texts=1 + len(columns))
        if kinds
        else []
    )


def stops_markdown(results: Results) -> list[str]:
    """Where mission plans stop when they are replayed."""
    figures = [
        {(stop["condition"], stop["title"]): stop["n"] for stop in row.breakdown.get("stops", ())}
        for row in results.rows
    ]
    total = sum((Counter(stops) for stops in figures), Counter())
    frequent = sorted(total, key=lambda stop: (-total[stop], *stop))[:SHOWN_PAIRS]
    rows = (
        [
            condition,
            title or "(no plan)",
            *(str(stops.get((condition, title), 0)) for stops in figures),
        ]
        for condition, title in frequent
    )
    return (
        _table(
            ["Stops for want of", "at", *(system_name(row) for row in results.rows)], rows, texts=2
        )
        if total
        else []
    )


PARTS: tuple[Callable[[Results], list[str]], ...] = (
    sections_markdown,
    names_markdown,
    substitutions_markdown,
    stops_markdown,
    examples_markdown,
)


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]], texts: int = 1) -> list[str]:
    """A table in Markdown, its first `texts` columns left-aligned, with an empty line behind it."""
    lines = ["| " + " | ".join(heads) + " |", "|" + "---|" * texts + "---:|" * (len(heads) - texts)]
    return [*lines, *("| " + " | ".join(map(_plain, row)) + " |" for row in rows), ""]


def _plain(text: str) -> str:
    """A text on one line that cannot end its cell: names come from models."""
    text = " ".join(text.split()).replace("|", "\\|")
    return text if len(text) <= LONGEST_CELL else f"{text[:LONGEST_CELL]}…"


def _estimate(row: Row, column: Column) -> Estimate:
    return row.metrics.get(column.metric, Estimate(None))


def _cell(estimate: Estimate, column: Column) -> str:
    return f"{column.text(estimate.value)} {column.interval(estimate)}".strip()


def _f1(entry: dict[str, Any] | None) -> str:
    return _cell(Estimate(**entry["f1"]), Column("f1", "F1", "↑")) if entry else NOTHING
