"""Another vehicle is another definition file: the inspection drone goes through gen-data, train and
bench.
"""

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from planner_ft.cli.app import app
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary

DRONE = load_vocabulary("inspection_drone")
CANDIDATE = "Llama-3.2-1B-Instruct"


def run(*arguments: Any) -> str:
    result = CliRunner().invoke(
        app, [str(argument) for argument in arguments], catch_exceptions=False
    )
    assert result.exit_code == 0, result.output
    return result.output


def mission(number: int) -> dict[str, Any]:
    """A curated drone mission: fly somewhere, circle the tower, report."""
    x, y = 10 + number, 5 * number
    return {
        "id": f"drone-{number}",
        "family": f"family-{number}",
        "prompt": f"Fly to the mast at [{x}, {y}], circle it at 8 metres and send the report.",
        "expected": {
            "tasks": [
                {
                    "title": "FlyToPoint",
                    "parameters": {"target_position": [x, y]},
                    "task_prompt": f"Fly to the mast at [{x}, {y}].",
                },
                {
                    "title": "TowerOrbit",
                    "parameters": {"center": [x, y], "radius": 8},
                    "task_prompt": f"Circle the mast at [{x}, {y}] at 8 m.",
                },
                {"title": "SendReport", "parameters": {}, "task_prompt": "Send the report."},
            ],
            "assumptions": [],
            "constraints": [],
        },
        "spans": [],
        "tags": ["rule.transit"],
    }


@pytest.fixture(scope="module")
def data(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("drone")
    source = folder / "source"
    source.mkdir()
    for split, numbers in {
        "train": range(6),
        "validation": range(6, 8),
        "test": range(8, 10),
    }.items():
        (source / f"{split}.jsonl").write_text(
            "".join(json.dumps(mission(number)) + "\n" for number in numbers), encoding="utf-8"
        )
    run(
        "gen-data",
        "--level",
        "mission",
        "--vocabulary",
        "inspection_drone",
        "--source",
        source,
        "--out",
        folder / "data",
    )
    run(
        "gen-data",
        "--level",
        "task",
        "--vocabulary",
        "inspection_drone",
        "--out",
        folder / "data",
        "--train",
        12,
        "--validation",
        3,
        "--test",
        3,
    )
    return folder / "data"


@pytest.mark.parametrize("level", ["mission", "task"])
def test_the_drone_is_trained_and_benchmarked(
    level: str, data: Path, models: Path, tmp_path: Path
) -> None:
    common = ("--level", level, "--vocabulary", "inspection_drone")
    run(
        "train",
        *common,
        "--candidate",
        CANDIDATE,
        "--data-dir",
        data / level,
        "--output",
        tmp_path / "adapter",
        "--max-steps",
        2,
    )
    bench = (
        *common,
        "--candidates",
        CANDIDATE,
        "--data",
        data / level / "test.jsonl",
        "--adapter",
        tmp_path / "adapter",
    )
    bench += ("--out", tmp_path / "bench", "--max-new-tokens", 8, "--latency-samples", 1)
    run("bench", *bench, *(["--no-report"] if level == "task" else []))
    results = json.loads((tmp_path / "bench" / "results.json").read_text())
    assert [row["configuration"] for row in results["rows"]] == ["base", "lora"]
    assert all(row["n"] == 3 - (level == "mission") for row in results["rows"])
    manifest = json.loads((tmp_path / "adapter" / "manifest.json").read_text())
    assert DRONE.sha256 in json.dumps(manifest)


def test_perfect_answers_score_one_with_the_drones_names(data: Path, tmp_path: Path) -> None:
    records = read_jsonl(data / "task" / "test.jsonl")
    answers = tmp_path / "answers.jsonl"
    answers.write_text(
        "".join(
            json.dumps({"id": record["id"], "output": json.dumps(record["expected"])}) + "\n"
            for record in records
        ),
        encoding="utf-8",
    )
    arguments = (
        "--level",
        "task",
        "--predictions",
        answers,
        "--data",
        data / "task" / "test.jsonl",
    )
    run("score", *arguments, "--vocabulary", "inspection_drone", "--out", tmp_path / "drone")
    metrics = json.loads((tmp_path / "drone" / "results.json").read_text())["rows"][0]["metrics"]
    assert metrics["f1"]["value"] == metrics["strict_valid"]["value"] == 1
    with pytest.raises(PlannerError, match="is no task of the vocabulary usv"):
        run("score", *arguments, "--out", tmp_path / "boat")
