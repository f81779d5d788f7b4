"""Scoring anybody's predictions, through the command."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from planner_ft.cli.bench import score
from planner_ft.support.errors import PlannerError

SAMPLES = [
    {
        "id": "s1",
        "prompt": "go to 5 5",
        "expected": {"tasks": [{"title": "Transit", "parameters": {"target_position": [5, 5]}}]},
    },
    {
        "id": "s2",
        "prompt": "check then home",
        "expected": {
            "tasks": [
                {"title": "Diagnostics"},
                {"title": "Transit", "parameters": {"target_position": [0, 0]}},
            ]
        },
    },
    {"id": "s3", "prompt": "do a barrel roll", "expected": {"tasks": []}},
    {
        "id": "s4",
        "prompt": "stay",
        "expected": {"tasks": [{"title": "KeepStation", "parameters": {"duration": 60}}]},
    },
]


def plan(*tasks: tuple[str, dict[str, Any]]) -> dict[str, Any]:
    return {
        "tasks": [
            {"title": title, "parameters": parameters, "task_prompt": ""}
            for title, parameters in tasks
        ],
        "assumptions": [],
        "constraints": [],
    }


ANSWERS = {
    "s1": plan(("Transit", {"target_position": [5, 5]})),
    "s2": plan(("Transit", {"target_position": [0, 0]})),
    "s3": plan(),
    "s4": plan(("Hover", {"duration": 60})),
}


@pytest.fixture
def data(tmp_path: Path) -> Path:
    path = tmp_path / "data.jsonl"
    path.write_text("".join(json.dumps(sample) + "\n" for sample in SAMPLES))
    return path


def predictions(folder: Path, *lines: dict[str, Any], name: str = "mine.jsonl") -> Path:
    path = folder / name
    path.write_text("".join(json.dumps(line) + "\n" for line in lines))
    return path


def run(*arguments: str | Path) -> Any:
    app = typer.Typer()
    app.command()(score)
    result = CliRunner().invoke(app, ["--level", "mission", *map(str, arguments)])
    if isinstance(result.exception, PlannerError):
        raise result.exception
    assert result.exit_code == 0, result.output
    return result


def results(folder: Path) -> dict[str, Any]:
    value: dict[str, Any] = json.loads((folder / "results.json").read_text())
    return value


def test_figures_of_a_small_set_by_hand(tmp_path: Path, data: Path) -> None:
    run(
        "--predictions",
        predictions(
            tmp_path,
            *({"id": key, "output": json.dumps(answer)} for key, answer in ANSWERS.items()),
        ),
        "--data",
        data,
        "--out",
        tmp_path / "out",
    )
    (row,) = results(tmp_path / "out")["rows"]
    metrics = {name: figure["value"] for name, figure in row["metrics"].items()}
    assert (row["candidate"], row["configuration"], row["n"]) == ("mine", "submitted", 4)
    assert metrics["f1"] == pytest.approx((1 + 2 / 3 + 1 + 0) / 4)
    assert metrics["hallucination"] == metrics["hallucination_with_unparsed"] == 1 / 4
    assert metrics["schema_valid"] == 1.0
    assert metrics["strict_valid"] == 3 / 4
    assert metrics["exact_sequence"] == 2 / 4
    assert metrics["parameters"] == 1.0
    assert metrics["latency_s"] is None
    assert {kind: count for kind, count in row["failures"].items() if count} == {
        "prerequisite omission": 1,
        "hallucination": 1,
    }
    assert row["metrics"]["schema_valid"]["low"] == pytest.approx(0.510, abs=1e-3)


def test_results_have_the_documented_form(tmp_path: Path, data: Path) -> None:
    run(
        "--predictions",
        predictions(tmp_path, {"id": "s1", "output": ANSWERS["s1"]}),
        "--data",
        data,
        "--out",
        tmp_path / "out",
    )
    value = results(tmp_path / "out")
    assert list(value) == [
        "level",
        "data",
        "rows",
        "changes",
        "groups",
        "comparisons",
        "baselines",
        "training",
        "manifest",
    ]
    assert value["data"] == {
        "path": str(data),
        "sha256": value["manifest"]["inputs"]["data"]["sha256"],
        "n": 4,
    }
    assert {"f1", "hallucination", "schema_valid", "strict_valid", "latency_s", "tokens"} <= set(
        value["rows"][0]["metrics"]
    )
    assert all(
        list(figure) == ["value", "low", "high"] for figure in value["rows"][0]["metrics"].values()
    )
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "results.json",
        "scores.jsonl",
        "baselines.jsonl",
        "table.md",
        "table.csv",
        "table.tex",
    }


def test_outputs_may_be_objects_or_text(tmp_path: Path, data: Path) -> None:
    for name, answers in (
        ("text", {key: json.dumps(answer) for key, answer in ANSWERS.items()}),
        ("object", ANSWERS),
    ):
        lines = [
            {
                "id": key,
                "output": answer,
                "tokens": 10,
                "latency_s": 0.5,
                "candidate": "c",
                "configuration": "lora",
            }
            for key, answer in answers.items()
        ]
        run(
            "--predictions", predictions(tmp_path, *lines), "--data", data, "--out", tmp_path / name
        )
    text, objects = results(tmp_path / "text"), results(tmp_path / "object")
    assert text["rows"] == objects["rows"]
    assert text["rows"][0]["metrics"]["tokens"]["value"] == 10
    assert text["rows"][0]["metrics"]["latency_s"]["value"] == 0.5


def test_missing_predictions_count_as_empty_outputs_and_are_named(
    tmp_path: Path, data: Path
) -> None:
    given = predictions(
        tmp_path, {"id": "s1", "output": ANSWERS["s1"]}, {"id": "s2", "output": None}
    )
    shown = run("--predictions", given, "--data", data, "--out", tmp_path / "out")
    assert "no prediction for s3, s4" in shown.stderr
    (row,) = results(tmp_path / "out")["rows"]
    assert row["missing"] == ["s3", "s4"]
    assert row["n"] == 4
    # Nothing is expected of s3, and yet no answer is no right refusal.
    assert row["metrics"]["f1"]["value"] == 1 / 4
    assert row["metrics"]["schema_valid"]["value"] == 1 / 4
    assert row["metrics"]["hallucination"]["value"] == 3 / 4
    assert row["metrics"]["hallucination_without_unparsed"]["value"] == 0


@pytest.mark.parametrize(
    ("lines", "problem"),
    [
        (
            [{"id": "s1", "output": ""}, {"id": "s1", "output": ""}],
            "mine.jsonl:2: id 's1' has a prediction on line 1 already",
        ),
        ([{"id": "s9", "output": ""}], "mine.jsonl:1: id 's9' is not in the test data"),
        ([{"output": ""}], "mine.jsonl:1: id is missing"),
        ([{"id": "s1"}], "mine.jsonl:1: output is missing"),
        ([{"id": "s1", "output": 3}], "mine.jsonl:1: output is missing, or neither"),
        (["s1"], "mine.jsonl:1: a JSON object is expected"),
        ([], "holds no predictions"),
        ([{"id": "s1", "output": "", "tokens": "many"}], "tokens is no number from 0"),
        ([{"id": "s1", "output": "", "tokens": -5}], "tokens is no number from 0"),
        ([{"id": "s1", "output": "", "tokens": True}], "tokens is no number from 0"),
        ([{"id": "s1", "output": "", "latency_s": "fast"}], "latency_s is no number from 0"),
    ],
)
def test_bad_predictions_are_named_by_line(
    tmp_path: Path, data: Path, lines: list[Any], problem: str
) -> None:
    with pytest.raises(PlannerError, match=problem):
        run("--predictions", predictions(tmp_path, *lines), "--data", data)


def test_rubbish_is_no_refusal_and_a_number_is_an_invented_name(tmp_path: Path, data: Path) -> None:
    answers = {"s3": "I cannot do that.", "s1": {**plan(), "tasks": [{"title": 5}]}}
    lines = [{"id": name, "output": output} for name, output in answers.items()]
    run("--predictions", predictions(tmp_path, *lines), "--data", data, "--out", tmp_path / "out")
    text = (tmp_path / "out" / "scores.jsonl").read_text()
    scores = {line["id"]: line for line in map(json.loads, text.splitlines())}
    names = ("f1", "multiset_f1", "lcs_f1", "edge_f1", "right_refusal", "exact_sequence")
    assert [scores["s3"][name] for name in names] == [0, 0, 0, 0, False, False]
    assert scores["s1"]["hallucination_without_unparsed"] and scores["s1"]["precision"] == 0


def test_the_same_id_may_stand_once_per_candidate_and_configuration(
    tmp_path: Path, data: Path
) -> None:
    lines = [
        {"id": "s1", "output": "", "candidate": candidate, "configuration": configuration}
        for candidate in "ab"
        for configuration in ("base", "lora")
    ]
    run("--predictions", predictions(tmp_path, *lines), "--data", data, "--out", tmp_path / "out")
    assert [
        (row["candidate"], row["configuration"]) for row in results(tmp_path / "out")["rows"]
    ] == [("a", "base"), ("a", "lora"), ("b", "base"), ("b", "lora")]


def test_results_are_not_overwritten_unasked(tmp_path: Path, data: Path) -> None:
    arguments = (
        "--predictions",
        predictions(tmp_path, {"id": "s1", "output": ""}),
        "--data",
        data,
        "--out",
        tmp_path / "out",
    )
    run(*arguments)
    before = (tmp_path / "out" / "results.json").read_bytes()
    with pytest.raises(PlannerError, match="--overwrite"):
        run(*arguments)
    assert (tmp_path / "out" / "results.json").read_bytes() == before
    run(*arguments, "--overwrite")


def test_bad_places_and_flags_are_one_sentence(tmp_path: Path, data: Path) -> None:
    given = predictions(tmp_path, {"id": "s1", "output": ""})
    (tmp_path / "file").write_text("")
    for arguments, problem in (
        (("--predictions", tmp_path / "none", "--data", data), "no such file"),
        (("--predictions", given, "--data", tmp_path / "none"), "no such file"),
        (("--predictions", given, "--data", data, "--out", tmp_path / "file"), "give a folder"),
        (
            ("--predictions", given, "--data", data, "--out", tmp_path / "file" / "below"),
            "give a folder",
        ),
        (("--predictions", given, "--data", data, "--vocabulary", "none"), "--vocabulary none"),
        (("--level", "fleet", "--predictions", given, "--data", data), "--level fleet"),
    ):
        with pytest.raises(PlannerError, match=problem):
            run(*arguments)


def test_predictions_of_a_stand_in_stay_marked(tmp_path: Path, data: Path) -> None:
    lines = [
        {
            "id": "s1",
            "output": "",
            "candidate": "Llama-3.2-3B-Instruct",
            "configuration": "base",
            "standin": True,
        }
    ]
    shown = run(
        "--predictions", predictions(tmp_path, *lines), "--data", data, "--out", tmp_path / "out"
    )
    assert "Llama-3.2-3B-Instruct (stand-in)" in (tmp_path / "out" / "table.md").read_text()
    assert "published" not in (tmp_path / "out" / "table.csv").read_text()
    assert "stand-in" in shown.output


def test_scoring_imports_no_torch() -> None:
    code = (
        "import planner_ft.cli.bench, planner_ft.benchmark.submission, planner_ft.benchmark.tables,"
        " planner_ft.benchmark.layout, sys;sys.exit(any(name in sys.modules for name in ('torch',"
        " 'transformers', 'scipy', 'datasets')))"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
