"""Repeats: estimators by hand and by enumeration, and runs that sample."""

from __future__ import annotations

import itertools
import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.figures import all_of, any_of, pass_figures
from planner_ft.benchmark.runner import run_bench
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.submission import score_predictions, score_run
from planner_ft.benchmark.tables import repeat_tables
from planner_ft.support.errors import PlannerError
from planner_ft.support.tables import markdown_table
from planner_ft.vocabulary import load_vocabulary

NAME = "Llama-3.2-1B-Instruct"


def lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_the_estimators_are_the_shares_of_all_draws() -> None:
    for right, k in itertools.product(range(6), range(1, 6)):
        draws = list(itertools.combinations([True] * right + [False] * (5 - right), k))
        assert all_of(right, 5, k) == pytest.approx(sum(all(draw) for draw in draws) / len(draws))
        assert any_of(right, 5, k) == pytest.approx(sum(any(draw) for draw in draws) / len(draws))


def test_pass_figures_are_means_over_samples() -> None:
    failures = {"a": [None, None, "omission"], "b": ["omission"] * 3}
    scores = [
        {"id": name, "family": name, "failure": failure}
        for name, found in failures.items()
        for failure in found
    ]
    figures = pass_figures(scores, 0)
    assert figures["k"] == 3
    # Sample a: 2 of 3 right, so 2/3, 1/3 and 0 of the draws are all right; b: none.
    assert [figures["all_of_k"][k]["value"] for k in "123"] == pytest.approx([1 / 3, 1 / 6, 0])
    assert [figures["any_of_k"][k]["value"] for k in "123"] == pytest.approx([1 / 3, 1 / 2, 1 / 2])
    text = "\n".join(map(markdown_table, repeat_tables({"x, LoRA": figures})))
    assert (
        "pass^2" in text
        and "| x, LoRA, 3 answers per sample | 33.3 [0.0, 66.7] | 16.7 [0.0, 33.3] | 0.0 [0.0, 0.0] | 50.0"
        in text
    )
    assert list(repeat_tables({"x": {}})) == []


@pytest.fixture
def data(tmp_path: Path, models: Path) -> Path:
    path = tmp_path / "data.jsonl"
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index}" + " and look" * index,
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(3)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


def settings(data: Path, out: Path, **changes: Any) -> BenchSettings:
    values: dict[str, Any] = {
        "level": "mission",
        "candidates": (NAME,),
        "configurations": ("base",),
        "data": data,
        "out": out,
        "device": "cpu",
        "batch_size": 2,
        "max_new_tokens": 5,
        "latency_samples": 1,
        "repeats": 2,
        "temperature": 1.0,
    }
    return BenchSettings(**{**values, **changes})


def test_a_repeated_run_goes_on_and_does_not_depend_on_batches(data: Path, tmp_path: Path) -> None:
    results = run_bench(settings(data, tmp_path / "out"))
    path = tmp_path / "out" / "predictions.jsonl"
    written = lines(path)
    outputs = {(line["repeat"], line["id"]): line["output"] for line in written}
    assert sorted(outputs) == [(repeat, f"m{index}") for repeat in (1, 2) for index in range(3)]
    assert len(set(outputs.values())) == 6 and len({line["key"] for line in written}) == 2
    (row,) = results.rows
    assert (row.n, sum(row.failures.values()), row.latency_n) == (3, 6, 1)
    assert row.repeats is not None and row.repeats["k"] == 2
    found = json.loads((tmp_path / "out" / "results.json").read_text())
    assert found["rows"][0]["repeats"]["all_of_k"]["2"]["value"] == 0
    assert found["manifest"]["configuration"]["decoding"] == {
        "temperature": 1.0,
        "top_p": 1.0,
        "repeats": 2,
    }
    # Killed after the second answer, in the middle of a line: the rest is made, in other batches,
    # and is the same.
    path.write_bytes(
        b"".join(line + b"\n" for line in path.read_bytes().split(b"\n")[:2]) + b'{"id": "m'
    )
    again = run_bench(settings(data, tmp_path / "out", resume=True, batch_size=3))
    assert {(line["repeat"], line["id"]): line["output"] for line in lines(path)} == outputs
    assert again.rows[0].metrics == row.metrics
    # Scored again without the model, from the run and from the file of its predictions.
    assert score_run(tmp_path / "out").rows[0].to_json() == again.rows[0].to_json()
    vocabulary = load_vocabulary("usv")
    scored = score_predictions(path, load_bench_data(data, "mission", vocabulary), vocabulary)
    assert [(one.n, one.repeats, one.metrics) for one in scored.rows] == [
        (3, row.repeats, row.metrics)
    ]
    with pytest.raises(PlannerError, match="another temperature"):
        run_bench(settings(data, tmp_path / "out", resume=True, temperature=0.5))


def test_double_predictions_need_a_repeat(tmp_path: Path, data: Path) -> None:
    vocabulary = load_vocabulary("usv")
    samples = load_bench_data(data, "mission", vocabulary)
    path = tmp_path / "answers.jsonl"
    path.write_text('{"id": "m0", "output": ""}\n{"id": "m0", "output": ""}\n')
    with pytest.raises(PlannerError, match=r"answers\.jsonl:2: .*need a number as repeat"):
        score_predictions(path, samples, vocabulary)
    path.write_text('{"id": "m0", "output": "", "repeat": 0}\n')
    with pytest.raises(PlannerError, match="repeat must be a whole number"):
        score_predictions(path, samples, vocabulary)
    path.write_text(
        "".join(
            json.dumps({"id": f"m{index}", "output": "", "repeat": repeat}) + "\n"
            for repeat in (1, 2, 3)
            for index in range(3)
        )
    )
    (row,) = score_predictions(path, samples, vocabulary).rows
    assert row.repeats is not None and row.repeats["k"] == 3


@pytest.mark.parametrize(
    ("changes", "problem"),
    [
        ({"repeats": 3, "temperature": 0.0}, "--repeats 3: greedy answers are all the same"),
        ({"repeats": 0}, "--repeats 0"),
        ({"temperature": -1.0}, "--temperature -1"),
        ({"top_p": 0.0}, "--top-p 0"),
        ({"top_p": 0.5, "temperature": 0.0, "repeats": 1}, "--top-p 0.5: greedy"),
    ],
)
def test_settings_that_make_no_sense_are_one_sentence(
    tmp_path: Path, changes: dict[str, Any], problem: str
) -> None:
    with pytest.raises(PlannerError, match=problem):
        settings(tmp_path / "data.jsonl", tmp_path / "out", **changes)
