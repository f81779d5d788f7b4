"""Plans as behaviour files of the MOOS-IvP helm: every movement in turn, and words that do no
harm.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner_ft.exporters import DRAFT, Origin, PlanExport, load_format

from .moos_reader import Behaviour, File, Helm, read
from .plans import BUOY, DRONE, MAST, USV, document, documents, step, task

SQUARE = [[0, 0], [50, 0], [50, 50], [0, 50]]
HARM = [
    '"',
    "\\",
    "//",
    "{",
    "}",
    "\n",
    "\r",
    "$[OWNSHIP]",
    "$(X)",
    "%(X)",
    "[if] A=1",
    "#include <x>",
    "=",
    ",",
    "\x07",
    " ",
    "a",
    "Behavior = BHV_Loiter",
]


def written(tasks: list[dict[str, Any]], **more: Any) -> tuple[str, Any]:
    done = load_format("moos").write(
        PlanExport(document(tasks, **more), USV, None, "approved by Ada")
    )
    return done.text, done.account


def file(tasks: list[dict[str, Any]], **more: Any) -> File:
    return read(written(tasks, **more)[0])


def move(name: str, parameters: dict[str, Any], **more: Any) -> Behaviour:
    """The only behaviour of a plan with one step."""
    (behaviour,) = file([task("Diagnostics", {}, [step(name, parameters, **more)])]).moving()
    return behaviour


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_every_waypoint_comes_back_to_the_millimetre(vocabulary: Any) -> None:
    @settings(max_examples=30, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary))
    def check(plan: dict[str, Any]) -> None:
        plan_export = PlanExport(plan, vocabulary)
        behaviours = {
            one.name: one for one in read(load_format("moos").write(plan_export).text).moving()
        }
        for entry in plan["tasks"][: plan_export.ready]:
            for number, one in enumerate(entry["skill_sequence"] or (), start=1):
                skill, motion = (
                    one["navigation_skill"],
                    vocabulary.motion.of(one["navigation_skill"]["name"]),
                )
                if motion.kind == "go":
                    goal = (skill["parameters"]["x"], skill["parameters"]["y"])
                    assert behaviours[f"{entry['id']}_{number}_move"].corners()[
                        -1
                    ] == pytest.approx(goal, abs=0.001)

    check()


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_the_helm_goes_through_all_movements_in_the_plans_order(vocabulary: Any) -> None:
    @settings(max_examples=30, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary))
    def check(plan: dict[str, Any]) -> None:
        found = read(load_format("moos").write(PlanExport(plan, vocabulary)).text)
        helm = Helm(found)
        went = [name for name in helm.run() if not name.startswith("SKILL_")]
        assert went == [one.name for one in found.moving() if one.kind != "BHV_ConstantSpeed"]

    check()


def test_a_mission_ends_when_its_last_movement_does() -> None:
    helm = Helm(file(MAST))
    assert helm.run()[-1] == "t4_1_move"
    assert (helm.values["MISSION"], helm.values["DEPLOY"], helm.values["MISSION_STEP"]) == (
        "complete",
        "false",
        "5",
    )


def test_a_plan_that_waits_for_a_place_ends_before_it() -> None:
    text, account = written(
        [
            task("Transit", {"target_position": [9, 9]}, [step("GoToXY", {"x": 9, "y": 9})]),
            *BUOY[1:],
        ]
    )
    helm = Helm(read(text))
    assert [name for name in helm.run() if not name.startswith("SKILL_")] == ["t1_1_move"]
    assert helm.values["MISSION"] == "partly"
    assert {loss.task for loss in account.lost} == {None, "t2", "t3", "t4"}


def test_a_transit_without_skills_is_a_waypoint() -> None:
    (only,) = file([task("Transit", {"target_position": [12.5, -3]}, None)]).behaviours
    assert (only.kind, only.corners()) == ("BHV_Waypoint", [(12.5, -3.0)])


@pytest.mark.parametrize(
    ("name", "parameters", "kind", "said"),
    [
        ("GoToXY", {"x": 3, "y": 4}, "BHV_Waypoint", {"speed": "1.5", "points": "3,4"}),
        (
            "StationKeep",
            {"time": 60, "radius": 8},
            "BHV_StationKeep",
            {"duration": "60", "inner_radius": "4", "outer_radius": "8", "center_activate": "true"},
        ),
        ("WaitForStability", {"time": 20}, "BHV_StationKeep", {"duration": "20"}),
        (
            "DriftWithCurrent",
            {"time": 300},
            "BHV_FullStop",
            {"duration": "300", "delay_complete": "300"},
        ),
        ("NudgeYaw", {"delta_yaw": -30}, "BHV_FixedTurn", {"fix_turn": "30", "turn_dir": "port"}),
        ("NudgeYaw", {"delta_yaw": 30}, "BHV_FixedTurn", {"fix_turn": "30", "turn_dir": "star"}),
    ],
)
def test_what_skills_become(
    name: str, parameters: dict[str, Any], kind: str, said: dict[str, str]
) -> None:
    found = move(name, parameters)
    assert found.kind == kind
    assert {key: found.one(key) for key in said} == said


@pytest.mark.parametrize(
    ("name", "parameters", "radii"),
    [
        ("GoToXY", {"x": 30, "y": 40}, ["2", "6"]),
        ("GoToXY", {"x": 0, "y": 8}, ["2", "6"]),
        ("GoToXY", {"x": 0, "y": 2}, ["0.5", "1.5"]),
        ("GoToXY", {"x": 0, "y": 0.01}, ["0.01", "0.01"]),
        ("GoToXY", {"x": 0, "y": 0}, ["2", "6"]),
        ("ArcTurn", {"radius": 8, "delta_yaw": 360}, ["2", "6"]),
        ("ArcTurn", {"radius": 0.5, "delta_yaw": 360}, ["0.125", "0.375"]),
    ],
)
def test_waypoints_are_not_reached_from_where_the_way_to_them_begins(
    name: str, parameters: dict[str, Any], radii: list[str]
) -> None:
    go = step("GoToXY", {"x": 0, "y": 0})
    *_, found = file([task("Diagnostics", {}, [go, step(name, parameters)])]).moving()
    assert [found.one(key) for key in ("capture_radius", "slip_radius")] == radii


@pytest.mark.parametrize(("cruise_speed", "speed"), [(0.05, "0.05"), (1.5, "0.5")])
def test_a_turn_is_no_faster_than_the_vehicle(cruise_speed: float, speed: str) -> None:
    turns = [step("NudgeYaw", {"delta_yaw": 30}), step("RotateToHeading", {"heading": 90})]
    plan = document([task("Diagnostics", {}, turns)])
    plan["vehicle"]["cruise_speed"] = cruise_speed
    done = load_format("moos").write(PlanExport(plan, USV))
    found = read(done.text).moving()
    assert [one.one("speed") for one in found if one.all("speed")] == [speed, speed]
    assert any(f"at {speed} m/s" in loss.why for loss in done.account.changed)


def test_a_turn_to_a_heading_asks_for_a_speed_too() -> None:
    heading, speed = file(
        [task("Diagnostics", {}, [step("RotateToHeading", {"heading": 360})])]
    ).moving()
    assert (heading.kind, heading.one("heading")) == ("BHV_ConstantHeading", "0")
    assert (speed.kind, speed.all("condition")) == ("BHV_ConstantSpeed", heading.all("condition"))


def test_an_orbit_goes_round_the_target_at_the_stated_speed() -> None:
    orbit = next(one for one in file(MAST).behaviours if one.name == "t2_1_move")
    assert orbit.one("speed") == "1.2"
    assert [((x - 120) ** 2 + (y + 35) ** 2) ** 0.5 for x, y in orbit.corners()] == pytest.approx(
        [25.0] * len(orbit.corners()), abs=0.01
    )
    assert len(orbit.corners()) == 19


def test_a_hold_without_a_time_lasts_until_somebody_says_so() -> None:
    held = move("VisualStationKeep", {}, perception=[("DetectObjects", {})])
    assert held.one("perpetual") == "true"
    assert held.all("endflag") == [] and held.flags("idleflag") == [("SKILL_DETECT_OBJECTS", "off")]
    _text, account = written([task("Diagnostics", {}, [step("VisualStationKeep")])])
    assert any("posts the next MISSION_STEP" in loss.why for loss in account.changed)


def test_skills_beside_a_movement_are_switched_on_and_off() -> None:
    beside = [
        ("DetectObjects", {"class_list": ["buoy", "boat"]}),
        ("GetSectorDistance", {"bearing": 45}),
        ("GetSectorDistance", {"bearing": 90}),
    ]
    search = task(
        "SearchAndDetect",
        {},
        [
            step("StationKeep", {"time": 5}, perception=beside),
            step("StationKeep", {"time": 5}, filters=[("LockHeading", {})]),
        ],
    )
    assert Helm(file([search])).run() == [
        "t1_1_move",
        "SKILL_DETECT_OBJECTS=on; class_list=['buoy','boat']",
        "SKILL_GET_SECTOR_DISTANCE=on; bearing=45",
        "SKILL_GET_SECTOR_DISTANCE=on; bearing=90",
        "SKILL_DETECT_OBJECTS=off",
        "SKILL_GET_SECTOR_DISTANCE=off",
        "t1_2_move",
        "SKILL_LOCK_HEADING=on",
        "SKILL_LOCK_HEADING=off",
    ]


def test_whole_numbers_are_posted_without_a_point() -> None:
    zoom, number = USV.skill["DetectObjects"], USV.skill["StationKeep"].parameters[0]
    levels = (replace(number, name="levels", type="integer"), replace(number, name="gain"))
    vocabulary = replace(USV, skills=(*USV.skills, replace(zoom, name="Zoom", parameters=levels)))
    beside = [("Zoom", {"levels": 5.0, "gain": 2.0})]
    plan = document([task("Diagnostics", {}, [step("StationKeep", perception=beside)])], vocabulary)
    text = load_format("moos").write(PlanExport(plan, vocabulary)).text
    assert "on; levels=5; gain=2.0" in text


def test_boundaries_and_clearances_stand_for_the_steps_that_have_them() -> None:
    fence, clear = (
        ("BoundaryEnforcement", {"poly_coords": SQUARE}),
        ("ObstacleAvoidance", {"min_distance": 6}),
    )
    steps = [
        step("StationKeep", {"time": 5}, filters=filters)
        for filters in ([fence], [fence, clear], [], [fence])
    ]
    guarding = [
        one
        for one in file([task("Diagnostics", {}, steps)]).behaviours
        if one.kind in ("BHV_OpRegionV24", "BHV_AvoidObstacleV24")
    ]
    assert [(one.kind, one.all("condition")[1]) for one in guarding] == [
        ("BHV_OpRegionV24", "(MISSION_STEP >= 1) and (MISSION_STEP <= 2)"),
        ("BHV_AvoidObstacleV24", "MISSION_STEP = 2"),
        ("BHV_OpRegionV24", "MISSION_STEP = 4"),
    ]
    assert guarding[0].corners("save_poly") == [tuple(map(float, corner)) for corner in SQUARE]
    assert guarding[1].one("min_util_cpa_dist") == "6"


def test_the_vehicles_area_is_a_boundary_of_the_whole_mission() -> None:
    text, account = written(MAST, area=[[-200, -200], [300, -200], [300, 200], [-200, 200]])
    regions = [one for one in read(text).behaviours if one.kind == "BHV_OpRegionV24"]
    assert regions[0].all("condition")[1] == "(MISSION_STEP >= 1) and (MISSION_STEP <= 4)"
    assert ("vehicle", "area") not in account.changed_paths
    text, account = written(MAST, area=[[0, 0], [300, 0], [10, 10], [0, 300]])
    assert len([one for one in read(text).behaviours if one.kind == "BHV_OpRegionV24"]) == 1
    assert ("vehicle", "area") in account.changed_paths


@pytest.mark.parametrize(
    "polygon",
    [[*SQUARE, SQUARE[0]], [SQUARE[0], [25, 0], *SQUARE[1:]], [SQUARE[0], *SQUARE]],
    ids=["closed", "on a side", "twice"],
)
def test_corners_that_the_helm_may_refuse_are_left_out(polygon: list[list[float]]) -> None:
    found = file(
        [
            task(
                "Diagnostics",
                {},
                [
                    step(
                        "StationKeep",
                        {"time": 5},
                        filters=[("BoundaryEnforcement", {"poly_coords": polygon})],
                    )
                ],
            )
        ]
    )
    assert sorted(found.behaviours[0].corners("save_poly")) == sorted(
        tuple(map(float, corner)) for corner in SQUARE
    )


@pytest.mark.parametrize(
    "polygon",
    [
        [[0, 0], [50, 0], [10, 10], [0, 50]],
        [[0, 0], [50, 0]],
        [[0, 3], [2, -3], [-3, 1], [3, 1], [-2, -3]],
        [[1, 1], [1, 1], [1, 1]],
        [],
    ],
    ids=["dent", "no area", "star", "a point", "none"],
)
def test_a_boundary_that_the_helm_refuses_is_no_behaviour_and_the_account_says_so(
    polygon: list[list[float]],
) -> None:
    text, account = written(
        [
            task(
                "Diagnostics",
                {},
                [
                    step(
                        "StationKeep",
                        {"time": 5},
                        filters=[("BoundaryEnforcement", {"poly_coords": polygon})],
                    )
                ],
            )
        ]
    )
    assert [one.kind for one in read(text).behaviours] == ["BHV_StationKeep"]
    assert any(
        "SKILL_ variable alone" in loss.why and "BoundaryEnforcement" in loss.what
        for loss in account.changed
    )


def test_an_arc_whose_radius_is_not_known_is_lost_and_the_mission_goes_on() -> None:
    text, account = written(
        [
            task(
                "GlareFreeApproach",
                {},
                [step("ArcTurn", {"delta_yaw": 40}), step("GoToXY", {"x": 5, "y": 5})],
            )
        ]
    )
    assert Helm(read(text)).run() == ["t1_2_move"]
    assert any("does not say the movement" in loss.why for loss in account.lost)


def test_what_the_helm_cannot_do_is_lost() -> None:
    _text, account = written(MAST)
    assert [(loss.task, loss.what) for loss in account.lost] == [("t1", "GoToXY yaw = 90 (step 1)")]


def test_a_radius_of_nothing_leaves_the_helms_own() -> None:
    assert not move("StationKeep", {"time": 5, "radius": 0}).all("outer_radius")


def test_the_origin_is_named_for_the_moos_file() -> None:
    text = load_format("moos").write(PlanExport(document(MAST), USV, Origin(59.9, -10.75))).text
    assert "// in the .moos file: LatOrigin = 59.90000000, LongOrigin = -10.75000000\n" in text


def test_a_draft_says_so_in_a_variable() -> None:
    text = load_format("moos").write(PlanExport(document(MAST), USV)).text
    assert read(text).variables["MISSION_NAME"].startswith(DRAFT)
    assert text.startswith(f"// {DRAFT}")


@settings(max_examples=100)
@given(
    st.lists(st.sampled_from(HARM), max_size=8).map("".join),
    st.lists(st.sampled_from(HARM), max_size=6).map("".join),
)
def test_words_change_no_statement(prompt: str, note: str) -> None:
    def plan(prompt: str, note: str) -> File:
        beside = [("CaptureGeoSnapshot", {"note": note or "."})]
        entry = task(
            "SearchAndDetect",
            {"target_description": note or "."},
            [step("StationKeep", {"time": 5}, perception=beside, stop_conditions=[prompt])],
            prompt,
        )
        return file([entry], command=prompt, assumptions=[prompt, note])

    said, plain = plan(prompt, note), plan("x", "x")
    assert said.variables.keys() == plain.variables.keys()
    assert [[key for key, _value in one.settings] for one in said.behaviours] == [
        [key for key, _value in one.settings] for one in plain.behaviours
    ]
    assert [one.all("endflag") for one in said.behaviours] == [
        one.all("endflag") for one in plain.behaviours
    ]


def test_words_that_are_changed_are_told() -> None:
    _text, account = written(
        [
            task(
                "Diagnostics",
                {},
                [
                    step(
                        "StationKeep",
                        perception=[
                            ("CaptureGeoSnapshot", {"note": "a // b"}),
                            ("LogLidarSlice", {}),
                        ],
                    )
                ],
            )
        ]
    )
    assert [loss.what for loss in account.changed if "were replaced" in loss.why] == [
        "CaptureGeoSnapshot (step 1); CaptureGeoSnapshot note = a // b (step 1)"
    ]


def test_long_values_are_continued() -> None:
    note = "x" * 20_000
    assert move("StationKeep", {}, perception=[("CaptureGeoSnapshot", {"note": note})]).flags(
        "activeflag"
    ) == [("SKILL_CAPTURE_GEO_SNAPSHOT", f"on; note={note}")]
