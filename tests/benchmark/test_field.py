"""Field cases: what a case may hold, what its checks mean, and the run from the shell."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from planner_ft.benchmark.field.cases import Outcome, load_cases, passes
from planner_ft.cli.app import app
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_jsonl
from tests.documents import USV, document, step, task

GO = [step("GoToXY", {"x": 10, "y": 0}), step("GoToXY", {"x": 10, "y": 20})]
GO[0]["perception_skills"] = [{"name": "GetSeabedDepth", "parameters": {}}]
GRID = {"center": [10, 10], "width": 20, "length": 20, "spacing": 5}
PLAN = Outcome(
    document(
        [
            task("BathymetryGridSurvey", GRID, GO),
            task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})]),
        ],
        command="Map the depth at [10, 10], 20 by 20 at 5 m, and come home.",
    )
)
REFUSED = Outcome({}, "--locate reef: no such place is open")


@pytest.mark.parametrize(
    ("check", "holds"),
    [
        ({"titles": ["BathymetryGridSurvey", "Transit"]}, True),
        ({"titles": ["Transit"]}, False),
        ({"has": "BathymetryGridSurvey", "with": {"center": [10.4, 10], "width": 20.3}}, True),
        ({"has": "BathymetryGridSurvey", "with": {"width": 21}}, False),
        ({"lacks": "PerformOrbit"}, True),
        ({"skill": "GetSeabedDepth", "under": "BathymetryGridSurvey"}, True),
        ({"skill": "GetSeabedDepth", "under": "BathymetryGridSurvey", "on": "all"}, False),
        ({"waypoints": 2, "under": "BathymetryGridSurvey"}, True),
        ({"visits": [[10, 1], [10, 20], [0, 0]]}, True),
        ({"visits": [[10, 20], [10, 0]]}, False),
        ({"never_at": [10, 20.5]}, False),
        ({"clear": [10, 10, 2]}, False),
        ({"clear": [15, 10, 5.4]}, True),
        ({"outcome": "home"}, True),
        ({"outcome": "dock"}, False),
        ({"quiet": 3}, True),
        ({"any": [{"outcome": "dock"}, {"outcome": [0, 0.5]}]}, True),
    ],
)
def test_a_check_says_what_the_plan_does(check: dict[str, Any], holds: bool) -> None:
    assert passes(check, PLAN, USV) is holds


def test_a_refusal_says_something_and_does_nothing() -> None:
    assert passes({"warns": "no such PLACE"}, REFUSED, USV)
    assert passes({"never_at": [0, 0]}, REFUSED, USV)
    assert not passes({"quiet": 5}, REFUSED, USV)
    assert not passes({"titles": []}, REFUSED, USV)
    assert not REFUSED.silent


GOOD = {"id": "a", "kind": "ordinary", "command": "Go to [40, 20].", "expect": [{"quiet": 1}]}


def write(path: Path, *cases: Any) -> Path:
    path.write_text("".join(json.dumps(case) + "\n" for case in cases))
    return path


@pytest.mark.parametrize(
    ("case", "said"),
    [
        (GOOD, "id 'a' is given twice"),
        ({**GOOD, "id": "b", "expect": []}, "expect: [] "),
        ({**GOOD, "id": "b", "expect": [{"skil": "GoToXY"}]}, "is no check; there is titles, has"),
        ({**GOOD, "id": "b", "expect": [{"lacks": "Sail"}]}, "'Sail' is no task of this vehicle"),
        ({**GOOD, "id": "b", "expect": [{"says": "("}]}, "'(' is no regular expression"),
        ({**GOOD, "id": "b", "locate": {"buoy": [1]}}, "locate.buoy: [1] is too short"),
        (
            {**GOOD, "id": "b", "expect": [{"has": "Transit", "with": {"speed": 1}}]},
            "with: 'speed' is no parameter there",
        ),
        ([1], "the case: [1] is not of type 'object'"),
    ],
)
def test_a_bad_case_is_named_by_file_and_line(tmp_path: Path, case: Any, said: str) -> None:
    path = write(tmp_path / "cases.jsonl", GOOD, case)
    with pytest.raises(PlannerError) as error:
        load_cases([path], USV)
    assert str(error.value).startswith(f"{path}:2: ") and said in str(error.value)


def test_every_case_that_ships_can_be_run() -> None:
    files = sorted(Path("eval/field").rglob("*.jsonl"))
    assert len(load_cases(files, USV)) == 1118


def test_cases_are_run_from_the_shell(tmp_path: Path) -> None:
    wrong = {**GOOD, "id": "b", "kind": "limit", "expect": [{"lacks": "Transit"}], "danger": True}
    lost = {**GOOD, "id": "c", "locate": {"reef": [1, 2]}, "expect": [{"says": "reef"}]}
    cases, out = write(tmp_path / "cases.jsonl", GOOD, wrong, lost), tmp_path / "run"
    words = ["bench", "--field", str(cases), "--out", str(out)]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    results = read_json(out / "results.json")
    (row,) = results["rows"]
    assert (row["right"], row["of"]) == (2, 3)
    assert row["kinds"]["limit"]["right"] == 0 and row["kinds"]["ordinary"]["right"] == 2
    assert results["manifest"]["inputs"][str(cases)]["sha256"]
    assert len(read_jsonl(out / "plans.jsonl")) == 3
    assert "b (limit)" in (out / "table.md").read_text()
    plans, table = (out / "plans.jsonl").read_text(), (out / "table.md").read_text()
    assert CliRunner().invoke(app, [*words, "--resume"]).exit_code == 0
    assert (out / "plans.jsonl").read_text() == plans and (out / "table.md").read_text() == table
    write(cases, {**GOOD, "command": "Go to [41, 20]."})
    other = CliRunner().invoke(app, [*words, "--resume"])
    assert "are not of this run; give --overwrite" in str(other.exception)
    write(cases, GOOD, wrong, lost)
    again = CliRunner().invoke(app, words)
    assert again.exit_code != 0 and "--resume to go on" in str(again.exception)
    for flags in (["--level", "task"], ["--repeats", "2"], ["--data", str(cases)]):
        refused = CliRunner().invoke(app, [*words, *flags])
        assert "leave out" in str(refused.exception)
    assert "stand behind --field" in str(CliRunner().invoke(app, ["bench", str(cases)]).exception)
