"""The measured figures of an adapter in its model card, in the Hub's format (model-index)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.layout import metric_table
from planner_ft.benchmark.results import Row, heading
from planner_ft.candidates.adapters import MANIFEST, WEIGHTS, adapter_sha256
from planner_ft.report.contents import MAIN, failure_words
from planner_ft.report.runs import TestSet, load_test_sets, within
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, write_text
from planner_ft.support.tables import markdown_table

CARD = "README.md"
START = "<!-- measured figures, written by plannerft report --card -->"
END = "<!-- end of measured figures -->"
TRAINING = "\n## Training\n"

Measured = tuple[TestSet, Row]


def write_card(adapter: Path, runs: Sequence[Path]) -> int:
    """Write what these runs measured with exactly this adapter into its card; figures of an earlier
    call are replaced. Returns how many figures were written. Raises PlannerError when the folder
    has no card, or no run measured these very weights.
    """
    from huggingface_hub import ModelCard

    if not (adapter / CARD).is_file() or not (adapter / WEIGHTS).is_file():
        expected = f"{CARD} and {WEIGHTS} are expected"
        raise PlannerError(f"--card {adapter}: no adapter with a model card there ({expected})")
    digest = adapter_sha256(adapter)
    every = [(tests, row) for tests in load_test_sets(runs) for row in tests.results.rows]
    measured = [(tests, row) for tests, row in every if tests.adapters.get(row.key) == digest]
    if not measured:
        why = "no row of these runs was measured with this adapter"
        raise PlannerError(f"--card {adapter}: {why} (its weights have another digest)")
    manifest = read_json(adapter / MANIFEST) if (adapter / MANIFEST).is_file() else {}
    base, level = within(manifest, "base", "name"), manifest.get("level")
    model = f"{base} {level} adapter" if base and level else adapter.resolve().name
    text = _with_section(read_text(adapter / CARD), _section(measured))
    card = ModelCard(text, ignore_metadata_errors=True)
    results = [result for tests, row in measured for result in _eval_results(tests, row)]
    card.data.model_name, card.data.eval_results = model, results
    write_text(adapter / CARD, str(card).rstrip("\n") + "\n")
    return len(results)


def _eval_results(tests: TestSet, row: Row) -> Iterator[Any]:
    """A row's figures as huggingface_hub.EvalResult: rates as shares, intervals as arguments."""
    from huggingface_hub import EvalResult

    vehicle = tests.vocabulary.name if tests.vocabulary else "unknown"
    for name, figure in row.metrics.items():
        interval = {"low": figure.low, "high": figure.high, "confidence": 0.95}
        if figure.value is not None:
            yield EvalResult(
                task_type="text-generation",
                task_name=f"{tests.level} planning",
                dataset_type=f"planner_ft-{vehicle}-{tests.level}",
                dataset_name=Path(tests.path).name,
                dataset_revision=tests.sha256,
                dataset_args={"samples": tests.n},
                metric_type=name,
                metric_name=METRIC[name].heading.removesuffix(" (%)") if name in METRIC else name,
                metric_value=figure.value,
                metric_config=row.system.configuration,
                metric_args=None if figure.low is None else interval,
                verified=False,
            )


def _section(measured: Sequence[Measured]) -> str:
    parts = ["## Measured"]
    sets = {tests.key: tests for tests, _row in reversed(measured)}
    for key in dict.fromkeys(tests.key for tests, _row in measured):
        rows = [row for tests, row in measured if tests.key == key]
        how = "In brackets 95 % intervals."
        table = replace(metric_table(MAIN, rows), title=f"{sets[key].title}.", caption=how)
        limits = [f"- {text}" for text in _limits(sets[key], rows)]
        parts += [markdown_table(table) + "\n".join(limits)]
    return "\n\n".join(parts)


def _limits(tests: TestSet, rows: Sequence[Row]) -> Iterator[str]:
    """The limits of the figures, and how the wrong answers were wrong."""
    data = f"{tests.n} samples of {Path(tests.path).name} (SHA-256 {tests.sha256[:12]}…)"
    yield f"{data}: a difference smaller than the intervals is not known."
    for row in rows:
        kinds = failure_words(row)
        words = f"wrong answers by kind: {kinds}." if kinds else "no wrong answer."
        yield f"{heading(row.system.configuration)}: {words}"


def _with_section(text: str, section: str) -> str:
    """The text with the section between the marks replaced, or put before that on training."""
    block = f"{START}\n{section}\n{END}"
    if START in text and END in text:
        return text[: text.index(START)] + block + text[text.index(END) + len(END) :]
    before, training, after = text.partition(TRAINING)
    if not training:
        return f"{text.rstrip()}\n\n{block}\n"
    return f"{before}\n{block}\n{training}{after}"
