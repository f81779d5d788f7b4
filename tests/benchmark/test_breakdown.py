"""A row taken apart, and the tables made of it, through the scoring of predictions."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.folder import write_results
from planner_ft.benchmark.metrics.answers import FAILURES
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.benchmark.submission import score_predictions
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

from .plans import mission, step, steps

HOME = ("Transit", {"target_position": [0, 0]})
ORBIT = ("PerformOrbit", {"center": [9, 9], "radius": 20})
EXPECTED = {
    "right": mission(ORBIT, HOME),
    "swapped": mission(ORBIT, HOME),
    "other": mission(ORBIT, HOME),
    "lost": mission(HOME, ORBIT, HOME),
    "none": mission(),
    "broken": mission(HOME),
}
ANSWERS: dict[str, Any] = {
    "right": mission(ORBIT, HOME),
    "swapped": mission(HOME, ORBIT),
    "other": mission(("SurveyTarget", {"radius": 20}), HOME),
    "lost": mission(ORBIT, HOME),
    "none": mission(),
    "broken": "Sure! Here is your plan",
}


def scored(
    folder: Path, level: Level, expected: dict[str, Any], answers: dict[str, Any]
) -> dict[str, Any]:
    """results.json of these answers, written with its tables into the folder."""
    data, predictions = folder / "data.jsonl", folder / "answers.jsonl"
    data.write_text(
        "".join(
            json.dumps(
                {"id": name, "prompt": name, "task": "Transit", "parameters": {}, "expected": plan}
            )
            + "\n"
            for name, plan in expected.items()
        )
    )
    predictions.write_text(
        "".join(
            json.dumps({"id": name, "output": answer}) + "\n" for name, answer in answers.items()
        )
    )
    vocabulary = load_vocabulary()
    write_results(
        folder, score_predictions(predictions, load_bench_data(data, level, vocabulary), vocabulary)
    )
    row: dict[str, Any] = json.loads((folder / "results.json").read_text())["rows"][0]
    return row


@pytest.fixture
def row(tmp_path: Path) -> dict[str, Any]:
    return scored(tmp_path, "mission", EXPECTED, ANSWERS)


def value(row: dict[str, Any], metric: str) -> float:
    found: float = row["metrics"][metric]["value"]
    return found


def test_figures_by_hand_and_an_answer_that_does_not_parse_is_an_empty_plan(
    row: dict[str, Any],
) -> None:
    """Trap: skipping the answer that does not parse would lift every mean."""
    assert value(row, "f1") == pytest.approx((1 + 1 + 1 / 2 + 1 + 1 + 0) / 6)
    assert value(row, "multiset_f1") == pytest.approx((1 + 1 + 1 / 2 + 4 / 5 + 1 + 0) / 6)
    assert value(row, "multiset_recall") == pytest.approx((1 + 1 + 1 / 2 + 2 / 3 + 1 + 0) / 6)
    assert value(row, "edit_distance") == pytest.approx((0 + 1 + 1 / 2 + 1 / 3 + 0 + 1) / 6)
    assert value(row, "lcs_f1") == pytest.approx((1 + 1 / 2 + 1 / 2 + 4 / 5 + 1 + 0) / 6)
    # lost: its only Transit is the first, which the expected plan has before the orbit.
    assert value(row, "edge_f1") == pytest.approx((1 + 0 + 0 + 0 + 1 + 0) / 6)
    assert (value(row, "whole_plan"), value(row, "whole_plan_unordered")) == (2 / 6, 3 / 6)
    # Values of matched entries: 3 and 3, then 1, then 3 again; expected in all: 3 + 3 + 3 + 4 + 0 +
    # 1; predicted: 3 + 3 + 2 + 3.
    assert value(row, "parameter_values_f1") == 1
    assert value(row, "parameter_values_overall_f1") == pytest.approx(2 * 10 / (14 + 11))


def test_every_figure_has_an_interval_and_certainty_is_never_claimed(row: dict[str, Any]) -> None:
    """Trap: a bootstrap of all ones is [1, 1], though six samples prove little."""
    assert row["metrics"]["parameter_values_f1"]["low"] < 0.7
    for name, figure in row["metrics"].items():
        assert figure["value"] is None or figure["low"] < figure["high"], name
    for entry in row["per_name"]:
        assert all(
            entry[part]["low"] < entry[part]["high"]
            for part in ("precision", "recall", "f1")
            if entry[part]["value"] is not None
        )


def test_per_name_with_support(row: dict[str, Any]) -> None:
    names = {entry["name"]: entry for entry in row["per_name"]}
    assert [(names["Transit"][key]) for key in ("expected", "predicted", "right", "samples")] == [
        6,
        4,
        4,
        5,
    ]
    assert (
        names["Transit"]["precision"]["value"],
        names["Transit"]["recall"]["value"],
    ) == pytest.approx((1, 4 / 6))
    assert (
        names["SurveyTarget"]["expected"],
        names["SurveyTarget"]["recall"]["value"],
        names["SurveyTarget"]["precision"]["value"],
    ) == (0, None, 0)
    assert row["per_name"][0]["name"] == "Transit"
    assert "per_role" not in row


def test_substitutions_types_and_examples(row: dict[str, Any]) -> None:
    pairs = {(pair["expected"], pair["predicted"]): pair["n"] for pair in row["substitutions"]}
    assert pairs == {("PerformOrbit", "SurveyTarget"): 1, ("Transit", None): 2}
    assert {entry["type"]: (entry["right"], entry["expected"]) for entry in row["per_type"]} == {
        "position": (7, 7),
        "number": (3, 3),
    }
    assert row["failure_examples"] == {
        "prerequisite omission": ["lost"],
        "substitution": ["other"],
        "wrong order": ["swapped"],
        "invalid output": ["broken"],
    }
    assert sum(row["failures"].values()) == 4 and list(row["failures"]) == list(FAILURES)


def test_scores_hold_the_alignment_and_all_values(tmp_path: Path, row: dict[str, Any]) -> None:
    lines = {
        line["id"]: line
        for line in map(json.loads, (tmp_path / "scores.jsonl").read_text().splitlines())
    }
    assert lines["swapped"]["alignment"] == {"pairs": [[0, 1], [1, 0]], "missing": [], "extra": []}
    assert lines["lost"]["alignment"]["missing"] == [0]
    assert (
        lines["swapped"]["whole_plan"],
        lines["swapped"]["whole_plan_unordered"],
        lines["swapped"]["edit_distance"],
    ) == (False, True, 1)


def test_the_tables_show_names_order_and_parameters_apart(
    tmp_path: Path, row: dict[str, Any]
) -> None:
    text = (tmp_path / "table.md").read_text()
    for start in (
        "| Names | Configuration | n | Set precision",
        "| Order | Configuration | n |",
        "| Parameters of matched entries | Configuration | n |",
        "| PerformOrbit | SurveyTarget | 1 |",
        "| Transit | 6 | 0.80",
    ):
        assert any(line.startswith(start) for line in text.splitlines()), start
    assert "Navigation F1" not in text
    assert "multiset_f1_low" in (tmp_path / "table.csv").read_text().splitlines()[0]


def test_an_invented_name_cannot_break_the_table(tmp_path: Path) -> None:
    scored(
        tmp_path, "mission", {"a": mission(HOME)}, {"a": mission("Go | there\n| now |", "x" * 500)}
    )
    lines = [line for line in (tmp_path / "table.md").read_text().splitlines() if "there" in line]
    assert lines and all(
        line.startswith("| ") and line.endswith(" |") and "\\| now \\|" in line for line in lines
    )
    assert "x" * 200 not in (tmp_path / "table.md").read_text()


def test_the_task_level_has_figures_per_role_and_of_steps(tmp_path: Path) -> None:
    held = step("StationKeep", filters=("LockHeading",), perception=("DetectObjects",))
    expected = steps(held, step("GoToXY"), held)
    row = scored(
        tmp_path,
        "task",
        {"a": expected, "b": steps(held)},
        {"a": steps(held, step("GoToXY"), step("StationKeep")), "b": steps(held)},
    )
    assert value(row, "navigation_f1") == 1
    assert value(row, "filter_f1") == pytest.approx(2 * 2 / (3 + 2))
    assert value(row, "step_edit_distance") == pytest.approx((1 / 3 + 0) / 2)
    assert value(row, "edit_distance") == pytest.approx((2 / 7 + 0) / 2)
    assert {entry["role"]: (entry["expected"], entry["right"]) for entry in row["per_role"]} == {
        "navigation": (4, 4),
        "filter": (3, 2),
        "perception": (3, 2),
    }
    assert "| F1 per role ↑ | expected |" in (tmp_path / "table.md").read_text()
