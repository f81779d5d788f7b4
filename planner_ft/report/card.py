"""The measured figures of an adapter in its model card, in the Hub's format (model-index)."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import heading
from planner_ft.candidates.adapters import CONFIG, MANIFEST, WEIGHTS
from planner_ft.report.contents import failure_words
from planner_ft.report.metrics import MAIN, column, estimate, figure_cell
from planner_ft.report.runs import Record, System, TestSet, load_test_sets
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, sha256_tree, write_text
from planner_ft.support.tables import Table, TableRow, markdown_table

CARD = "README.md"
START, END = (
    "<!-- measured figures, written by plannerft report --card -->",
    "<!-- end of measured figures -->",
)
TASK_TYPE = "text-generation"

Measured = tuple[TestSet, System]


def write_card(adapter: Path, runs: Sequence[Path]) -> int:
    """Write what these runs measured with exactly this adapter into its card; figures of an earlier
    call are replaced.

    Returns how many figures were written. Raises PlannerError when the folder has no card, or no
    run measured these very weights.
    """
    if not (adapter / CARD).is_file() or not (adapter / WEIGHTS).is_file():
        raise PlannerError(
            f"--card {adapter}: no adapter with a model card there ({CARD} and {WEIGHTS} are"
            " expected)"
        )
    digest = sha256_tree(adapter, (WEIGHTS, CONFIG))
    measured = [
        (tests, system)
        for tests in load_test_sets(runs)
        for system in tests.systems
        if adapter_of(system) == digest
    ]
    if not measured:
        raise PlannerError(
            f"--card {adapter}: no row of these runs was measured with this adapter (its weights"
            " have another digest)"
        )
    manifest = read_json(adapter / MANIFEST) if (adapter / MANIFEST).is_file() else {}
    text, count = card_with(read_text(adapter / CARD), measured, _model_name(adapter, manifest))
    write_text(adapter / CARD, text)
    return count


def adapter_of(system: System) -> str | None:
    """The digest of the adapter that a row was measured with, as the run recorded it; None without
    one and for baselines.
    """
    if system.is_baseline:
        return None
    wanted = (system.row.get("candidate"), system.row.get("configuration"))
    for job in system.jobs.values():
        if isinstance(job, dict) and (job.get("candidate"), job.get("configuration")) == wanted:
            return str(job["adapter"]) if job.get("adapter") else None
    return None


def card_with(text: str, measured: Sequence[Measured], model: str) -> tuple[str, int]:
    """A card with its model-index and its section of figures replaced, and the number of
    figures.
    """
    from huggingface_hub import ModelCard

    card = ModelCard(_with_section(text, _section(measured)), ignore_metadata_errors=True)
    results = [result for tests, system in measured for result in eval_results(tests, system)]
    card.data.model_name, card.data.eval_results = model, results
    return str(card).rstrip("\n") + "\n", len(results)


def eval_results(tests: TestSet, system: System) -> list[Any]:
    """A row's figures as huggingface_hub.EvalResult: rates as shares, the interval and the number
    of samples among the arguments.
    """
    from huggingface_hub import EvalResult

    vehicle = tests.vocabulary.name if tests.vocabulary else "unknown"
    data = {
        "dataset_type": f"planner_ft-{vehicle}-{tests.level}",
        "dataset_name": Path(tests.path).name,
        "dataset_revision": tests.sha256,
        "dataset_args": {"samples": tests.n},
    }
    found = []
    for name in system.row.get("metrics", {}):
        figure = estimate(system, name)
        if figure.value is None:
            continue
        interval = (
            None
            if figure.low is None
            else {"low": figure.low, "high": figure.high, "confidence": 0.95}
        )
        label = column(name).heading.removesuffix(" (%)")
        found.append(
            EvalResult(
                task_type=TASK_TYPE,
                task_name=f"{tests.level} planning",
                metric_type=name,
                metric_name=label,
                metric_value=figure.value,
                metric_config=str(system.row.get("configuration")),
                metric_args=interval,
                verified=False,
                **data,
            )
        )
    return found


def _section(measured: Sequence[Measured]) -> str:
    tables = []
    for key in dict.fromkeys(tests.key for tests, _system in measured):
        rows = [(tests, system) for tests, system in measured if tests.key == key]
        names = [
            name
            for name in MAIN
            if any(estimate(system, name).value is not None for _tests, system in rows)
        ]
        shown = [column(name) for name in names]
        body = tuple(
            TableRow(
                heading(str(system.row.get("configuration"))),
                tuple(figure_cell(one, estimate(system, one.name)) for one in shown),
            )
            for _t, system in rows
        )
        heads = tuple(f"{one.heading} {one.better}".strip() for one in shown)
        tables.append(
            markdown_table(
                Table(
                    key,
                    f"{rows[0][0].title}.",
                    "In brackets 95 % intervals.",
                    "Configuration",
                    heads,
                    body,
                )
            )
        )
        tables += [f"- {text}" for text in _limits(rows)]
        tables.append("")
    return "\n".join(["## Measured", "", *tables]).rstrip("\n")


def _limits(rows: Sequence[Measured]) -> list[str]:
    """The limits of the figures, and how the wrong answers were wrong."""
    tests = rows[0][0]
    found = [
        f"{tests.n} samples of {Path(tests.path).name} (SHA-256 {tests.sha256[:12]}…): a difference"
        " smaller than the intervals is not known."
    ]
    for _tests, system in rows:
        kinds = failure_words(system)
        words = f"wrong answers by kind: {kinds}." if kinds else "no wrong answer."
        found.append(f"{heading(system.configuration)}: {words}")
    return found


def _with_section(text: str, section: str) -> str:
    """The text with the section between the marks replaced, or put before the section on
    training.
    """
    block = f"{START}\n{section}\n{END}"
    if START in text and END in text:
        return text[: text.index(START)] + block + text[text.index(END) + len(END) :]
    place = text.find("\n## Training\n")
    return (
        f"{text.rstrip()}\n\n{block}\n"
        if place < 0
        else f"{text[: place + 1]}{block}\n\n{text[place + 1 :]}"
    )


def _model_name(adapter: Path, manifest: Record) -> str:
    base, level = manifest.get("base", {}).get("name"), manifest.get("level")
    return f"{base} {level} adapter" if base and level else adapter.resolve().name
