"""Data that commands demand, from the command to the skills."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from planner_ft.benchmark.field.cases import DEMANDS, Case, Outcome, load_demands
from planner_ft.benchmark.field.run import Demands, Row, judge
from planner_ft.cli.app import app
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from tests.documents import USV, document, step, task

RECORD = {
    "id": "a",
    "prompt": "Map the depth at [10, 10], recording video.",
    "skills": [
        {"task": "BathymetryGridSurvey", "skills": ["GetSeabedDepth", "SetStreamRecording"]}
    ],
}


def planned(_case: Case) -> Outcome:
    one = step("GoToXY", {"x": 10, "y": 0})
    one["perception_skills"] = [{"name": "GetSeabedDepth", "parameters": {}}]
    made = document([task("BathymetryGridSurvey", {"center": [10, 10]}, [one])], command="Map it.")
    mark = {"step": 0, "role": "perception", "name": "GetSeabedDepth", "kind": "vehicle"}
    made["tasks"][0]["added"] = [mark]
    made["warnings"] = [{"kind": "data-not-planned", "text": "No video."}]
    return Outcome(made)


@pytest.mark.parametrize(
    "arguments",
    [("--level", "both"), ("--gate", "eval/gates/ci.toml"), ("--suite", "eval/suites/ci.toml")],
)
def test_a_file_of_the_checkout_is_told_where_it_is(
    arguments: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    refused = CliRunner().invoke(app, ["bench", *arguments, "--out", str(tmp_path / "out")])
    assert isinstance(refused.exception, PlannerError)
    assert "start in a checkout" in str(refused.exception)
    assert not any(tmp_path.iterdir())


def test_what_the_vehicle_adds_is_counted_apart_from_the_agents(tmp_path: Path) -> None:
    path = tmp_path / "demands.jsonl"
    path.write_text(json.dumps(RECORD) + "\n")
    cases = load_demands([path], USV)
    judged = judge(cases, [planned(case) for case in cases], USV)
    row = Row("embedded", "lora", USV, judged)
    assert [(one["skill"], one["agents"], one["plan"]) for one in Demands().lines(row)] == [
        ("GetSeabedDepth", False, True),
        ("SetStreamRecording", False, False),
    ]
    assert [rate.value for rate in Demands().rates(row).values()] == [0, 0.5, 0]
    found = Demands().record(row)
    assert (found["records"], found["warned"]) == (1, 1)


@pytest.mark.parametrize(
    ("record", "said"),
    [
        ({"id": "b"}, "a record with the texts id and prompt is expected"),
        ({**RECORD, "skils": []}, "unknown key 'skils'"),
        ({**RECORD, "skills": ["GoToXY"]}, "skills must be a list of"),
        ({**RECORD, "skills": [{"task": "Transit", "skills": 7}]}, "skills must be a list of"),
        ({**RECORD, "skills": [{"task": "Sail", "skills": []}]}, "'Sail' is no task"),
        ({**RECORD, "skills": [{"task": "Transit", "skills": ["Dive"]}]}, "'Dive' is no skill"),
    ],
)
def test_a_bad_record_is_named_by_file_and_line(tmp_path: Path, record: Any, said: str) -> None:
    path = tmp_path / "demands.jsonl"
    path.write_text(json.dumps(RECORD) + "\n" + json.dumps(record) + "\n")
    with pytest.raises(PlannerError) as error:
        load_demands([path], USV)
    assert str(error.value).startswith(f"{path}:2: ") and said in str(error.value)


def test_both_agents_are_scored_from_the_shell(tmp_path: Path) -> None:
    assert len(load_demands([DEMANDS], USV)) == 20
    words = ["bench", "--level", "both", "--limit", "1", "--out", str(tmp_path)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    (row,) = read_json(tmp_path / "results.json")["rows"]
    assert row["records"] == 1 and row["demands"] == 1
    assert "--overwrite" in str(CliRunner().invoke(app, words).exception)
    refused = CliRunner().invoke(app, [*words, "--repeats", "2"])
    assert "--level both plans whole commands; leave out --repeats" in str(refused.exception)
