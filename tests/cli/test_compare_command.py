"""`plannerft compare` on folders that `plannerft score` has written."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from planner_ft.benchmark.folder import write_results
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.benchmark.submission import score_predictions
from planner_ft.cli.bench import compare
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary

RIGHT = {
    "tasks": [{"title": "Transit", "parameters": {}, "task_prompt": "Go."}],
    "assumptions": [],
    "constraints": [],
}


def write_data(path: Path, count: int, start: int = 0) -> Path:
    records = [
        {"id": f"s{index}", "prompt": f"Go {index}.", "expected": RIGHT}
        for index in range(start, start + count)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


def run(
    folder: Path,
    data: Path,
    systems: dict[str, set[int]],
    limit: int | None = None,
    leave_out: str = "",
) -> Path:
    """A run in which each system ("candidate configuration") is right on these samples."""
    vocabulary = load_vocabulary("usv")
    samples = load_bench_data(data, "mission", vocabulary, limit)
    lines = []
    for system, right in systems.items():
        candidate, configuration = system.split()
        for sample in samples.samples:
            output = RIGHT if int(sample.id[1:]) in right else ""
            lines += (
                []
                if sample.id == leave_out
                else [
                    {
                        "id": sample.id,
                        "candidate": candidate,
                        "configuration": configuration,
                        "output": output,
                    }
                ]
            )
    predictions = folder.with_suffix(".jsonl")
    predictions.write_text("".join(json.dumps(line) + "\n" for line in lines))
    write_results(folder, score_predictions(predictions, samples, vocabulary))
    return folder


@pytest.fixture
def data(tmp_path: Path) -> Path:
    return write_data(tmp_path / "data.jsonl", 20)


def invoke(*arguments: Any) -> Any:
    app = typer.Typer()
    app.command()(compare)
    result = CliRunner().invoke(app, [str(argument) for argument in arguments])
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return result


def figures(*arguments: Any) -> dict[str, Any]:
    return json.loads(invoke(*arguments, "--json").stdout)  # type: ignore[no-any-return]


def test_a_real_difference_is_told_from_none(tmp_path: Path, data: Path) -> None:
    first = run(tmp_path / "first", data, {"a base": set(range(2))})
    second = run(tmp_path / "second", data, {"b base": set(range(20)), "c base": {0, 1, 2}})
    found = figures(first, second, "--metric", "whole_plan")
    real, chance = (one for one in found["comparisons"] if one["second"] in ("b base", "c base"))
    # 18 samples were won and none lost: 2 / 2**18; one won and none lost: 1.
    assert (real["first"], real["n"], real["first_value"], real["second_value"]) == (
        "a base",
        20,
        0.1,
        1.0,
    )
    assert (
        real["p"] == real["p_mcnemar"] == pytest.approx(2 / 2**18) and real["verdict"] == "better"
    )
    assert (
        real["difference"]["value"] == pytest.approx(0.9)
        and 0.7 < real["difference"]["low"] < 0.9 < real["difference"]["high"] <= 1
    )
    assert chance["p"] == 1 and chance["verdict"] == "not told apart"
    # Both runs bring their baselines; Holm's adjustment is over all rows.
    assert len(found["comparisons"]) == 6 and real["p_adjusted"] == pytest.approx(6 * 2 / 2**18)
    assert found["method"]["seed"] == 0
    assert figures(first, second, "--metric", "whole_plan") == found
    text = invoke(first, second).stdout
    assert "b base against a base" in text and "▲ better" in text and "· not told apart" in text


def test_rows_are_chosen_by_name_and_same_names_told_apart(tmp_path: Path, data: Path) -> None:
    runs = [
        run(tmp_path / name, data, {"a base": right, "a lora": set(range(20))})
        for name, right in (("old", {1}), ("new", {1, 2, 3}))
    ]
    pairs = {
        (one["first"], one["second"])
        for one in figures(*runs, "--same", "--metric", "f1")["comparisons"]
    }
    assert pairs == {("old: a base", "new: a base"), ("old: a lora", "new: a lora")}
    against = {
        one["first"]
        for one in figures(*runs, "--against", "new: a lora", "--metric", "f1")["comparisons"]
    }
    assert against == {"new: a lora"}
    with pytest.raises(
        PlannerError, match="--against a lora: is the name of several rows; there are old: a base"
    ):
        invoke(*runs, "--against", "a lora")
    with pytest.raises(PlannerError, match="--against x: is no row"):
        invoke(*runs, "--against", "x")
    with pytest.raises(PlannerError, match="give one of them"):
        invoke(*runs, "--against", "x", "--same")


def test_different_data_is_refused_or_compared_by_common_ids(tmp_path: Path, data: Path) -> None:
    other = write_data(tmp_path / "other.jsonl", 20, start=15)
    runs = [
        run(tmp_path / "first", data, {"a base": {1}}),
        run(tmp_path / "second", other, {"b base": {15, 16}}),
    ]
    with pytest.raises(PlannerError, match=r"not the same data; give --common"):
        invoke(*runs)
    found = figures(*runs, "--common", "--metric", "f1", "--against", "a base")
    row = next(one for one in found["comparisons"] if one["second"] == "b base")
    assert row["n"] == 5 and any(
        "b base lacks 15 samples (s0, s1, s2, s3, s4, ...) of a base" in note
        for note in found["notes"]
    )
    apart = run(
        tmp_path / "third", write_data(tmp_path / "far.jsonl", 5, start=90), {"c base": set()}
    )
    with pytest.raises(PlannerError, match="no sample in common"):
        invoke(runs[0], apart, "--common")


def test_samples_that_a_run_left_out_are_named(tmp_path: Path, data: Path) -> None:
    whole = run(tmp_path / "whole", data, {"a base": {1}}, leave_out="s7")
    part = run(tmp_path / "part", data, {"b base": {1}}, limit=18)
    notes = figures(whole, part, "--metric", "f1", "--metric", "latency_s")["notes"]
    assert "b base lacks 2 samples (s18, s19) of a base: left out." in notes
    assert "a base: no prediction for 1 sample (s7), counted as empty outputs." in notes
    assert "latency_s of b base against a base was not measured in both." in notes


def test_files_are_written_once(tmp_path: Path, data: Path) -> None:
    runs = [
        run(tmp_path / "first", data, {"a_1 base": {1}}),
        run(tmp_path / "second", data, {"b base": set(range(20))}),
    ]
    invoke(*runs, "--out", tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "comparison.json",
        "comparison.md",
        "comparison.csv",
        "comparison.tex",
    }
    table = (tmp_path / "out" / "comparison.csv").read_text().splitlines()
    assert table[0].startswith("first,second,metric,n,families") and table[1].startswith(
        "a_1 base,"
    )
    assert "**b base against a_1 base**" in (tmp_path / "out" / "comparison.md").read_text()
    assert "b base against a\\_1 base" in (tmp_path / "out" / "comparison.tex").read_text()
    with pytest.raises(PlannerError, match="--overwrite"):
        invoke(*runs, "--out", tmp_path / "out")
    invoke(*runs, "--out", tmp_path / "out", "--overwrite")


def test_what_is_no_run_is_one_sentence(tmp_path: Path, data: Path) -> None:
    good = run(tmp_path / "good", data, {"a base": {1}})
    with pytest.raises(PlannerError, match=r"nowhere: no results\.json"):
        invoke(good, tmp_path / "nowhere")
    with pytest.raises(PlannerError, match="--metric speed: unknown; there are f1"):
        invoke(good, "--metric", "speed")
    broken = run(tmp_path / "broken", data, {"a base": {1}})
    path = broken / "scores.jsonl"
    path.write_text(path.read_text() + path.read_text().splitlines()[0] + "\n")
    with pytest.raises(PlannerError, match=r"scores\.jsonl:21: a base has a score of 's0' already"):
        invoke(good, broken)
    path.write_text('{"id": "s0", "candidate": []}\n' * 2)
    with pytest.raises(PlannerError, match=r"scores\.jsonl:2: .* has a score of 's0' already"):
        invoke(good, broken)
    path.write_text('{"id": "s0"')
    with pytest.raises(PlannerError, match=r"scores\.jsonl:1: not JSON"):
        invoke(good, broken)
    results = json.loads((broken / "results.json").read_text())
    (broken / "results.json").write_text(json.dumps({**results, "level": "task"}))
    run(tmp_path / "broken2", data, {"a base": {1}})
    path.write_text((tmp_path / "broken2" / "scores.jsonl").read_text())
    with pytest.raises(PlannerError, match=r"of the mission level and .* of the task level"):
        invoke(good, broken)
    (broken / "results.json").write_text("[]")
    with pytest.raises(PlannerError, match="is no result"):
        invoke(broken)
