"""What the vehicle adds between the agents and behind the Task Agent, and what it asks."""

from __future__ import annotations

import pytest

from planner_ft.document import apply, build, undo
from planner_ft.document.tree import plan_tree
from planner_ft.planning import Planner
from planner_ft.planning.essentials import missing_defaults, performing, with_essentials
from planner_ft.planning.limits import last_away, time_left
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from tests.documents import USV, document, step, task
from tests.planning.conftest import SKILLS, Known, mission
from tests.planning.conftest import task as proposed

AT = [50, 30]
GO = {"skill_sequence": [step("GoToXY", {"x": 40, "y": 20}), step("GoToXY", {"x": 50, "y": 20})]}
SURVEY = mission(proposed("SurveyTarget", "Inspect the wreck at [50, 30].", target_position=AT))


def test_defaults_reach_the_task_agent_and_skills_are_added_behind_it(known: Known) -> None:
    engine = known(SURVEY, GO)
    made = build(Planner.load(configuration="base").plan("Inspect the wreck at [50, 30]."), USV)
    assert engine.asked[1][1]["parameters"] == {"target_position": AT, "radius": 10}
    survey = made["tasks"][0]
    assert survey["sources"]["radius"]["kind"] == "vehicle"
    for one in survey["skill_sequence"]:
        names = [skill["name"] for skill in one["perception_skills"]]
        assert names == ["SetStreamRecording", "GetGPSLocation"]
    assert {mark["kind"] for mark in survey["added"]} == {"vehicle"}
    shown = plan_tree(made)
    assert "(the vehicle's: radius 10; SetStreamRecording, GetGPSLocation in every step)" in shown
    assert made["complete"] and made["questions"] == []
    assert not [one for one in made["warnings"] if one["kind"].endswith("value-not-said")]


@pytest.mark.parametrize(
    ("limit", "radius"),
    [
        ("Keep at least 25 m from the wreck at [50, 30].", 25),
        ("Keep at least 25 m from the wreck.", 25),
        ("Keep at least 4 m from the wreck.", 10),
        ("Keep at least 25 m from the divers at [150, 30].", 10),
        ("Keep at least 25 m from the divers.", 10),
    ],
)
def test_a_stand_off_that_nobody_states_is_what_limits_want(limit: str, radius: float) -> None:
    survey = proposed("SurveyTarget", f"Inspect the wreck. {limit}", target_position=AT)
    assert missing_defaults(survey, USV) == {"radius": radius}
    stated = proposed("SurveyTarget", f"Inspect it. {limit}", target_position=AT, radius=20)
    assert missing_defaults(stated, USV) == {}


def test_a_stated_value_stays(known: Known) -> None:
    stated = mission(proposed("SurveyTarget", "Inspect it.", target_position=AT, radius=20))
    known(stated, GO)
    made = build(Planner.load(configuration="base").plan("Inspect [50, 30] at 20 m."), USV)
    assert made["tasks"][0]["parameters"]["radius"] == 20
    assert "defaults" not in made["tasks"][0]


def test_what_must_be_asked_keeps_the_task_waiting_with_one_question(known: Known) -> None:
    grid = mission(proposed("BathymetryGridSurvey", "Map the depth.", center=AT))
    engine = known(grid, GO)
    planner = Planner.load(configuration="base")
    made = build(planner.plan("Map the depth around [50, 30]."), USV)
    assert len(engine.asked) == 1
    assert made["tasks"][0]["skill_sequence"] is None and not made["complete"]
    assert len(made["questions"]) == 1 and "width" in made["questions"][0]
    assert "in m, 0 to 100000)" in made["questions"][0]
    assert [one["kind"] for one in made["warnings"]].count("value-asked") == 1
    assert "(skills wait for width and length)" in plan_tree(made)
    with pytest.raises(PlannerError, match="width and length must be known"):
        planner.skills(made["tasks"][0])
    answered = made
    for name in ("width", "length"):
        edit = {"kind": "parameter", "task": "t1", "name": name, "value": 20}
        answered = apply(answered, edit, USV)
    assert answered["questions"] == []
    assert planner.skills(answered["tasks"][0]).plan is not None


def test_an_open_place_is_not_asked_twice(known: Known) -> None:
    known(mission(proposed("Transit", "Go to the buoy.", target_position=[-99, -99])), SKILLS)
    made = build(Planner.load(configuration="base").plan("Go to the buoy."), USV)
    assert made["questions"] == [] and made["open_places"]


def test_an_approach_is_no_performing_step() -> None:
    steps = [step("GoToXY", {"x": 1, "y": 2}), step("VisualStationKeep"), step("StationKeep")]
    given = {"title": "FeatureStare", "parameters": {"duration": 60}}
    completed, added = with_essentials(given, steps, USV)
    recording = [bool(one["perception_skills"]) for one in completed]
    assert recording == [False, True, True]
    assert completed[2]["navigation_skill"]["parameters"] == {"time": 60}
    assert not steps[1]["perception_skills"]
    alone, _added = with_essentials(given, steps[:1], USV)
    assert alone[0]["perception_skills"]
    assert [mark["step"] for mark in added if "parameter" in mark] == [2]


def test_a_skill_of_the_model_keeps_its_values_and_takes_those_that_it_lacks() -> None:
    own = step("StationKeep", {"radius": 5})
    completed, _added = with_essentials(
        {"title": "KeepStation", "parameters": {"duration": 90}}, [own], USV
    )
    assert completed[0]["navigation_skill"]["parameters"] == {"radius": 5, "time": 90}


@pytest.mark.parametrize(
    ("prompt", "names"),
    [
        ("Inspect the wreck. Record nothing.", ["GetGPSLocation"]),
        ("Inspect the wreck. Record nothing near the wreck.", ["GetGPSLocation"]),
        (
            "Inspect the wreck. Record nothing near the marina.",
            ["SetStreamRecording", "GetGPSLocation"],
        ),
    ],
)
def test_what_a_limit_forbids_is_not_added(prompt: str, names: list[str]) -> None:
    given = {"title": "SurveyTarget", "parameters": {}, "task_prompt": prompt}
    completed, _added = with_essentials(given, GO["skill_sequence"][:1], USV)
    assert [skill["name"] for skill in completed[0]["perception_skills"]] == names


def test_another_vehicle_has_its_own() -> None:
    drone = load_vocabulary("inspection_drone")
    steps = [step("FlyToXY", {"x": 1, "y": 2})]
    completed, _added = with_essentials({"title": "RoofScan", "parameters": {}}, steps, drone)
    assert completed[0]["perception_skills"] == [{"name": "TakePhoto", "parameters": {}}]


def test_the_operator_takes_the_vehicles_skills_and_values_out() -> None:
    steps, added = with_essentials(
        {"title": "SurveyTarget", "parameters": {}}, GO["skill_sequence"], USV
    )
    made = document([task("SurveyTarget", {"target_position": AT}, None)], command="Inspect it.")
    answer = {"skill_sequence": steps, "added": added, "defaults": {"radius": 10}}
    made = apply(made, {"kind": "skills", "task": "t1", **answer}, USV)
    assert made["tasks"][0]["sources"]["radius"]["kind"] == "vehicle"
    drop = {"kind": "drop", "task": "t1", "name": "GetGPSLocation", "step": 0}
    fewer = apply(made, drop, USV)["tasks"][0]
    assert len(fewer["skill_sequence"][0]["perception_skills"]) == 1
    assert len(fewer["added"]) == 3
    del drop["step"]
    none = apply(made, drop, USV)
    assert {mark["name"] for mark in none["tasks"][0]["added"]} == {"SetStreamRecording"}
    changed = apply(none, {"kind": "parameter", "task": "t1", "name": "radius", "value": 15}, USV)
    assert changed["tasks"][0]["sources"]["radius"]["kind"] == "operator"
    assert "defaults" not in changed["tasks"][0]
    assert undo(undo(changed, USV), USV)["tasks"] == made["tasks"]
    with pytest.raises(PlannerError, match="no filter or perception skill GoToXY"):
        apply(made, {"kind": "drop", "task": "t1", "name": "GoToXY"}, USV)


def test_the_ways_of_a_task_do_not_perform_it_unless_it_is_made_of_them() -> None:
    steps = [step("GoToXY", {"x": 9, "y": 9}), step("StationKeep", {"time": 9})]
    assert performing("KeepStation", steps, USV) == [1]
    assert performing("SurveyTarget", steps, USV) == [0]


def test_the_last_task_somewhere_is_found_unless_it_ends_at_home_or_at_a_berth() -> None:
    def at(title: str, **values: object) -> dict[str, object]:
        return {"title": title, "parameters": values}

    survey = at("SurveyTarget", target_position=[9, 9])
    report, check = at("AutoGenerateReportSummary"), at("Diagnostics")
    assert last_away([check, survey, report], USV) is survey
    assert last_away([survey, at("Transit", target_position=[0, 0]), report], USV) is None
    assert last_away([survey, at("DockingApproach", goal_position=[5, 5])], USV) is None
    assert last_away([check], USV) is None


def test_a_time_of_return_is_a_span_or_a_time_of_day() -> None:
    assert time_left({"within": "40 minutes"}) == 2400
    assert time_left({"time": "16:30"}) is None
