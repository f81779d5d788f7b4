"""Which answers can be carried out: the expected plans of the data, and answers beside them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.benchmark.metrics.answers import executable
from planner_ft.data.missions import sample_missions
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.replay import Stop, replay
from tests.missions import OPEN, REPORT, STARE, Task, find, go, send

USV = load_vocabulary()
DATA = Path(__file__).parents[2] / "data" / "mission"


def plan(*tasks: Task) -> dict[str, Any]:
    return {
        "tasks": [
            {"title": title, "parameters": parameters, "task_prompt": ""}
            for title, parameters in tasks
        ],
        "assumptions": [],
        "constraints": [],
    }


def without(whole: dict[str, Any], title: str) -> dict[str, Any]:
    return {**whole, "tasks": [task for task in whole["tasks"] if task["title"] != title]}


@pytest.mark.parametrize("name", ["train", "validation", "test", "challenge"])
def test_every_expected_plan_runs_to_its_end(name: str) -> None:
    records = [json.loads(line) for line in (DATA / f"{name}.jsonl").read_text().splitlines()]
    assert [
        (record["id"], stop)
        for record in records
        if (stop := executable(record["expected"], record["expected"], USV))
    ] == []


def test_expected_plans_hardly_need_data_on_board() -> None:
    """Given nothing at the start, all but the one that sends "radar pictures" from before run to
    their end: the data condition is met, not waived.
    """
    records = [
        json.loads(line)
        for name in ("train", "validation", "test")
        for line in (DATA / f"{name}.jsonl").read_text().splitlines()
    ]
    stopped = [replay(record["expected"], USV) for record in records]
    assert [stop.title for stop in stopped if stop] == ["SmartDataHarvest"]


def test_synthetic_plans_run_to_their_end() -> None:
    expected = [record["expected"] for record in sample_missions(11, 300)]
    assert [one for one in expected if executable(one, one, USV)] == []


def test_curated_plans_without_their_searches_or_the_ways_after_them_stop() -> None:
    records = [
        json.loads(line)
        for name in ("train", "validation", "test")
        for line in (DATA / f"{name}.jsonl").read_text().splitlines()
    ]
    located = [
        record["expected"]
        for record in records
        if "SearchAndDetect" in [task["title"] for task in record["expected"]["tasks"]]
    ]
    used = [
        whole
        for whole in located
        if any(
            OPEN in task["parameters"].values() and task["title"] != "DockingApproach"
            for task in whole["tasks"]
        )
    ]
    stops = [executable(without(whole, "SearchAndDetect"), whole, USV) for whole in used]
    assert len(stops) > 40
    assert {stop.condition if stop else None for stop in stops} == {"target located"}
    gone = [
        whole
        for whole in used
        if {"target_position": OPEN}
        in [task["parameters"] for task in whole["tasks"] if task["title"] == "Transit"]
    ]
    stops = [executable(without(whole, "Transit"), whole, USV) for whole in gone]
    assert len(stops) > 30
    assert {stop.condition if stop else None for stop in stops} == {"vehicle at the place"}


FOUND = plan(find("green buoy"), go(*OPEN), STARE, REPORT, go(0, 0))


def test_data_that_the_expected_plan_has_on_board_may_be_sent() -> None:
    early = plan(send("depth soundings"), ("BathymetryGridSurvey", {"center": [1, 2]}))
    assert replay(early, USV) is not None
    assert executable(early, early, USV) is None
    assert executable(plan(send("Depth soundings"), go(3, 4)), early, USV) is None
    collected = plan(("BathymetryGridSurvey", {"center": [1, 2]}), send("depth soundings"))
    stop = executable(early, collected, USV)
    assert stop is not None
    assert (stop.index, stop.condition) == (0, "data collected")


def test_a_report_on_what_is_on_board_needs_no_collecting() -> None:
    assert executable(plan(go(1, 2), REPORT), plan(REPORT), USV) is None


@pytest.mark.parametrize(
    ("answer", "expected", "reason"),
    [
        (None, plan(), "the answer does not parse"),
        (plan(), plan(), ""),
        (plan(), FOUND, "nothing is planned"),
        ({"tasks": 3}, FOUND, "nothing is planned"),
        ({}, plan(), "nothing is planned"),
    ],
)
def test_no_plan_is_not_executable_unless_none_is_wanted(
    answer: dict[str, Any] | None, expected: dict[str, Any], reason: str
) -> None:
    stop = executable(answer, expected, USV)
    assert stop == (Stop(0, "", "plan given", reason) if reason else None)
