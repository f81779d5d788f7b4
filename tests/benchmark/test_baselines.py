"""Baselines: retrieval and the majority plan by hand, where the training split is found, and that
they are no candidates.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.baselines import features, majority_plan, make_baselines, nearest
from planner_ft.benchmark.compare import run_rows
from planner_ft.benchmark.folder import read_results, write_results
from planner_ft.benchmark.results import Results
from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.benchmark.submission import score_predictions
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED


def mission(name: str, prompt: str, *titles: str, **parameters: Any) -> dict[str, Any]:
    tasks = [
        {"title": title, "parameters": parameters, "task_prompt": "Do it."} for title in titles
    ]
    return {
        "id": name,
        "prompt": prompt,
        "expected": {"tasks": tasks, "assumptions": [], "constraints": []},
    }


TRAIN = [
    mission("a", "Orbit the red buoy.", "Transit", "PerformOrbit", radius=10),
    mission("b", "Come home.", "Transit", target_position=[0, 0]),
    mission("c", "Circle the wreck at twenty metres.", "Transit", "PerformOrbit", radius=20),
    mission("d", "Orbit the green buoy.", "Transit", "PerformOrbit", radius=20),
]


def write(path: Path, records: list[dict[str, Any]]) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


def data(
    folder: Path, records: list[dict[str, Any]], train: list[dict[str, Any]] | None = None
) -> BenchData:
    if train is not None:
        write(folder / "train.jsonl", train)
    return load_bench_data(write(folder / "test.jsonl", records), "mission", load_vocabulary("usv"))


def answers(lines: Any) -> dict[str, Any]:
    return {name: json.loads(line["output"]) for name, line in lines.items()}


def test_weights_and_similarity_by_hand() -> None:
    texts = ["a b", "a c", "d"]
    known = {"a", "<a>", "b", "<b>", "a b", "c", "<c>", "a c", "d", "<d>"}
    assert {feature for text in texts for feature in features(text)} == known
    common, rare = math.log(4 / 3) + 1, math.log(4 / 2) + 1
    # Against "a": one of "a b"'s three words or pairs and its characters are known.
    length = math.sqrt(2 * common**2 + 3 * rare**2)
    (place, similarity), (nothing, none) = nearest(["a", "x"], texts)
    assert (place, similarity) == (0, pytest.approx(math.sqrt(2) * common / length, abs=1e-8))
    assert (nothing, none) == (0, 0.0)


def test_the_nearest_of_many_is_found_and_the_first_of_equals() -> None:
    texts = [f"survey field {index} at noon" for index in range(600)] + ["survey field 5 at noon"]
    assert nearest(["survey field 555 at noon", "Survey field 5 at NOON"], texts) == [
        (555, pytest.approx(1)),
        (5, pytest.approx(1)),
    ]


def test_the_majority_plan_has_the_most_frequent_names_and_parameters() -> None:
    plan = majority_plan(
        "mission", [Sample(record["id"], record["id"], record) for record in TRAIN]
    )
    assert [(task["title"], task["parameters"]) for task in plan["tasks"]] == [
        ("Transit", {"radius": 20}),
        ("PerformOrbit", {"radius": 20}),
    ]
    assert TRAIN[0]["expected"]["tasks"][0]["parameters"] == {"radius": 10}


def test_the_majority_plan_of_a_task_is_that_of_the_same_task(tmp_path: Path) -> None:
    def task(name: str, title: str, skill: str) -> dict[str, Any]:
        steps = [{"navigation_skill": {"name": skill, "parameters": {}}}]
        return {
            "id": name,
            "task": title,
            "parameters": {},
            "prompt": "go",
            "expected": {"skill_sequence": steps},
        }

    train = [
        task("a", "KeepStation", "StationKeep"),
        task("b", "Transit", "GoToWaypoint"),
        task("c", "Transit", "GoToWaypoint"),
    ]
    known = list(load_vocabulary("usv").skill)
    train[1]["expected"]["skill_sequence"][0]["navigation_skill"]["name"] = train[2]["expected"][
        "skill_sequence"
    ][0]["navigation_skill"]["name"] = known[0]
    write(tmp_path / "train.jsonl", train)
    test = write(
        tmp_path / "test.jsonl",
        [task("x", "KeepStation", "StationKeep"), task("y", "FollowTarget", "StationKeep")],
    )
    majority = make_baselines(
        load_bench_data(test, "task", load_vocabulary("usv")), load_vocabulary("usv")
    ).answers["majority plan"]
    chosen = {
        name: plan["skill_sequence"][0]["navigation_skill"]["name"]
        for name, plan in answers(majority).items()
    }
    assert chosen == {"x": "StationKeep", "y": known[0]}


def test_the_training_split_beside_the_data_is_used_and_named(tmp_path: Path) -> None:
    found = make_baselines(
        data(
            tmp_path, [mission("x", "Orbit the red buoy twice.", "Transit", "PerformOrbit")], TRAIN
        ),
        load_vocabulary("usv"),
    )
    nearest = found.answers["nearest neighbour"]
    assert nearest["x"]["neighbour"] == "a" and answers(nearest)["x"] == TRAIN[0]["expected"]
    assert (
        found.training is not None
        and found.training["path"] == str(tmp_path / "train.jsonl")
        and found.training["n"] == 4
    )
    assert (
        "majority plan" in found.answers and "4 samples" in found.notes[0] and len(found.notes) == 1
    )


def test_samples_of_the_training_split_are_flagged_and_the_split_itself_refused(
    tmp_path: Path,
) -> None:
    both = [
        mission("x", "orbit the RED buoy", "Transit"),
        mission("y", "Something else.", "Transit"),
    ]
    assert (
        "1 of 2 test inputs stand in the training split"
        in make_baselines(data(tmp_path, both, TRAIN), load_vocabulary("usv")).notes[1]
    )
    same = make_baselines(data(tmp_path, TRAIN, TRAIN), load_vocabulary("usv"))
    assert same.answers == {} and "is the training split itself" in same.notes[0]


def test_without_a_training_split_the_note_says_so(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.toml").write_text((BUNDLED / "inspection_drone.toml").read_text())
    drone = load_vocabulary(tmp_path / "mine.toml")
    test = load_bench_data(
        write(tmp_path / "a" / "test.jsonl", [mission("x", "Fly.", next(iter(drone.task)))]),
        "mission",
        drone,
    )
    assert "no training split of the mission level" in make_baselines(test, drone).notes[0]
    write(tmp_path / "a" / "train.jsonl", TRAIN)
    assert "the training split cannot be used" in make_baselines(test, drone).notes[0]


@pytest.fixture
def results(tmp_path: Path) -> Results:
    test = [
        mission(f"t{index}", f"Orbit buoy number {index}.", "Transit", "PerformOrbit", radius=index)
        for index in range(12)
    ]
    samples = data(tmp_path, test, TRAIN)
    lines = []
    for record in test:
        lines.append(
            {
                "id": record["id"],
                "output": record["expected"],
                "candidate": "good",
                "configuration": "lora",
            }
        )
        lines.append(
            {"id": record["id"], "output": "", "candidate": "good", "configuration": "base"}
        )
        lines.append(
            {
                "id": record["id"],
                "output": record["expected"] if record["id"] != "t1" else "",
                "candidate": "fair",
                "configuration": "lora",
            }
        )
    return score_predictions(write(tmp_path / "p.jsonl", lines), samples, load_vocabulary("usv"))


def test_baselines_are_rows_of_their_own(results: Results, tmp_path: Path) -> None:
    assert [row.candidate for row in results.rows] == ["good", "good", "fair"]
    assert [(row.candidate, row.to_json()["is_baseline"]) for row in results.baselines] == [
        ("majority plan", True),
        ("nearest neighbour", True),
    ]
    assert all(
        row.metrics["f1"].value == 1 and row.metrics["schema_valid"].value == 1
        for row in results.baselines
    )
    write_results(tmp_path / "out", results)
    written = json.loads((tmp_path / "out" / "results.json").read_text())
    assert [row["is_baseline"] for row in written["rows"] + written["baselines"]] == [
        False,
        False,
        False,
        True,
        True,
    ]
    assert {
        line["candidate"]
        for line in map(json.loads, (tmp_path / "out" / "baselines.jsonl").read_text().splitlines())
    } == {"majority plan", "nearest neighbour"}
    read, _record = read_results(tmp_path / "out")
    assert [row.is_baseline for row in run_rows(tmp_path / "out", read)] == [
        False,
        False,
        False,
        True,
        True,
    ]


def test_tables_mark_what_is_real(results: Results, tmp_path: Path) -> None:
    from planner_ft.benchmark.contrasts import contrast_notes, marks
    from planner_ft.benchmark.tables import render_tables

    found = marks(results.contrasts)
    # In the order of the data: base answers nothing, so LoRA is better beyond chance than whichever
    # comes first.
    assert (
        found["good base", "whole_plan"].startswith("▼")
        and found["good lora", "whole_plan"] == "★"
        and found["fair lora", "whole_plan"] == "★"
    )
    sentences = contrast_notes(results.contrasts)
    assert any(
        text.startswith("good lora beats the majority plan (whole plan: p")
        and "not shown to beat the majority plan (f1" in text
        for text in sentences
    )
    texts = render_tables(results)
    assert (
        "*majority plan (baseline)* | – | 12 |" in texts["table.md"]
        and "| Against the baselines |" in texts["table.md"]
        and "▼" in texts["table.md"]
    )
    assert (
        "$\\blacktriangledown$" in texts["table.tex"]
        and "majority plan (baseline),baseline,,12" in texts["table.csv"]
    )
    assert "whole_plan_mark" in texts["table.csv"].splitlines()[0]
    widths = {len(line.split(",")) for line in texts["table.csv"].splitlines()}
    assert len(widths) == 1


def test_comparisons_are_adjusted_within_each_question(results: Results) -> None:
    from planner_ft.benchmark.paired import holm

    found = results.contrasts
    assert {(one.first, one.second) for one in found["configuration"]} == {
        ("good lora", "good base")
    }
    assert {(one.first, one.second) for one in found["best"]} == {("good lora", "fair lora")}
    assert len(found["baseline"]) == 2 * 3 * 2
    for comparisons in found.values():
        assert [one.p_adjusted for one in comparisons] == holm([one.p for one in comparisons])
