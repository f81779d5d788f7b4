"""The metrics that read the command and replay the plan, as `plannerft score` writes them."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from planner_ft.benchmark.metrics.alignment import plan_entries
from planner_ft.benchmark.results import Measured, Results, System, score_system
from planner_ft.benchmark.samples import BenchData, Sample
from planner_ft.benchmark.tables import tables
from planner_ft.facts import read_input
from planner_ft.support.tables import markdown_table
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
DATA = Path(__file__).parents[2] / "data" / "mission"
RECORDS = [json.loads(line) for line in (DATA / "test.jsonl").read_text().splitlines()]
SAMPLES = [Sample(record["id"], record["family"], record) for record in RECORDS]


def scored(change: Any) -> tuple[Results, list[dict[str, Any]]]:
    """Results of the expected plans of the test split, each changed by `change(plan)`, which may
    give None for an answer that does not parse.
    """
    lines = {
        record["id"]: {"output": change(record["expected"]) or "not a plan"} for record in RECORDS
    }
    data = BenchData(Path("d"), "", "mission", tuple(SAMPLES), frozenset())
    measured = Measured(System("mine", "lora", "mine"), lines)
    row, scores = score_system(data, [measured], USV, 0)
    return Results("mission", {}, (row,), {}, tuple(scores)), scores


def figures(results: Results) -> dict[str, float | None]:
    names = (
        "executable",
        "grounded",
        "grounded_values",
        "slots_in_parameters",
        "slots_in_prompt",
        "right_refusal",
        "wrong_refusal",
        "worst_f1",
        "paraphrases_right",
    )
    return {name: results.rows[0].metrics[name].value for name in names}


def tasks(plan: dict[str, Any], change: Any) -> dict[str, Any]:
    return {**plan, "tasks": [changed for task in plan["tasks"] if (changed := change(task))]}


def test_the_expected_plans_have_the_best_figures_with_intervals() -> None:
    results, _scores = scored(lambda plan: plan)
    assert figures(results) == {
        name: 0 if name == "wrong_refusal" else 1 for name in figures(results)
    }
    for name in figures(results):
        estimate = results.rows[0].metrics[name]
        assert estimate.low is not None
        assert estimate.high is not None
        assert estimate.low < estimate.high
    assert results.rows[0].breakdown["stops"] == []


def test_answers_that_do_not_parse_are_no_plans_and_no_refusals() -> None:
    results, scores = scored(lambda _plan: None)
    expected = {"grounded_values": None, "wrong_refusal": 0}
    assert figures(results) == {name: expected.get(name, 0) for name in figures(results)}
    assert {score["stop"]["condition"] for score in scores if score["executable"] is False} == {
        "plan given"
    }


def test_refusing_everything_is_seen() -> None:
    results, _scores = scored(lambda plan: {**plan, "tasks": []})
    found = figures(results)
    empty = sum(not record["expected"]["tasks"] for record in RECORDS)
    assert (found["right_refusal"], found["wrong_refusal"], found["slots_in_parameters"]) == (
        1,
        1,
        0,
    )
    assert found["executable"] == empty / len(RECORDS)


def test_plans_without_searches_stop_and_the_table_says_where() -> None:
    results, scores = scored(
        lambda plan: tasks(plan, lambda task: task if task["title"] != "SearchAndDetect" else None)
    )
    stopped = [score["id"] for score in scores if score["stop"]]
    assert figures(results)["executable"] == 1 - len(stopped) / len(RECORDS)
    assert sum(stop["n"] for stop in results.rows[0].breakdown["stops"]) == len(stopped) > 3
    lines = "\n".join(map(markdown_table, tables(results))).splitlines()
    assert any(line.startswith("| target located | Transit |") for line in lines)
    assert any(line.startswith("| Logic of the plan |") for line in lines)


def test_values_that_nobody_gave_and_facts_that_got_lost_are_counted_by_kind() -> None:
    def wrong(task: dict[str, Any]) -> dict[str, Any]:
        given = {
            key: 12345.6 if key == "radius" else value for key, value in task["parameters"].items()
        }
        return {**task, "parameters": given, "task_prompt": ""}

    results, scores = scored(lambda plan: tasks(plan, wrong))
    radii = {
        record["id"]: sum(
            "radius" in entry.parameters for entry in plan_entries("mission", record["expected"])
        )
        for record in RECORDS
    }
    # Where the numbers of a command cannot be read with certainty, none is called invented.
    unread = {record["id"] for record in RECORDS if read_input(record, USV).facts.unread}
    moved = sum(radii.values())
    assert {score["id"]: len(score["ungrounded"]) for score in scores} == {
        name: 0 if name in unread else count for name, count in radii.items()
    }
    assert moved > 2
    assert {value["parameter"] for score in scores for value in score["ungrounded"]} == {"radius"}
    lines = {line["kind"]: line for line in results.rows[0].breakdown["slots"]}
    assert lines["lengths"]["stated"] - lines["lengths"]["in_parameters"] == moved
    assert lines["names"]["in_parameters"] == lines["names"]["stated"] > 0
    assert lines["names"]["in_prompt"] == 0
    assert figures(results)["slots_in_prompt"] == 0


def test_one_wrong_phrasing_makes_its_family_wrong() -> None:
    families = [record["family"] for record in RECORDS]
    several = sorted({family for family in families if families.count(family) > 1})
    victim = next(
        record
        for record in RECORDS
        if record["family"] == several[0] and record["expected"]["tasks"]
    )
    results, _scores = scored(
        lambda plan: plan if plan is not victim["expected"] else {**plan, "tasks": []}
    )
    assert figures(results)["paraphrases_right"] == 1 - 1 / len(several)
    assert figures(results)["worst_f1"] == 1 - 1 / len(several)


def test_task_level_has_no_replay_and_no_task_prompts() -> None:
    step = {
        "navigation_skill": {"name": "StationKeep", "parameters": {"time": 60}},
        "filter_skills": [],
        "perception_skills": [],
    }
    step |= {"stop_conditions": [], "failure_modes": [], "expected_outputs": []}
    record = {
        "id": "a",
        "prompt": "Hold for a minute.",
        "task": "KeepStation",
        "parameters": {},
        "expected": {"skill_sequence": [step]},
    }
    data = BenchData(Path("d"), "", "task", (Sample("a", "a", record),), frozenset())
    measured = Measured(System("mine", "lora", "mine"), {"a": {"output": record["expected"]}})
    row, scores = score_system(data, [measured], USV, 0)
    assert (
        row.metrics["executable"].value,
        row.metrics["slots_in_prompt"].value,
        row.metrics["slots_in_parameters"].value,
    ) == (None, None, 1)
    assert scores[0]["slots"] == {"durations": [1, 1, None]}
    assert row.breakdown["slots"][0].keys() == {
        "kind",
        "stated",
        "in_parameters",
        "in_parameters_share",
    }
