"""What a reviewer is told about a plan, and what not."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from planner_ft.document import PlanDocument, apply, revise
from planner_ft.document.vehicle import check_area
from planner_ft.document.warnings import KINDS, NOTES
from planner_ft.document.warnings.route import MOST_LISTED
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Vocabulary

from ...documents import DRONE, USV, document, step, task

GO = step("GoToXY", {"x": 30, "y": 40})
HOME = task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})], "Go home.")
SURVEY = task("SurveyTarget", {"target_position": [30, 40], "radius": 20}, [GO], "Survey.")
THERE = task("Transit", {"target_position": [30, 40]}, [GO], "Go to [30, 40].")
OPEN = [-99, -99]


def kinds(plan: PlanDocument, *, notes: bool = False) -> list[str]:
    return [item["kind"] for item in plan["warnings"] if notes or item["kind"] not in NOTES]


def planned(
    command: str, *tasks: dict[str, Any], vocabulary: Vocabulary = USV, **changes: Any
) -> PlanDocument:
    return revise({**document(tasks, vocabulary, command=command), **changes}, vocabulary)


def text_of(plan: PlanDocument, kind: str) -> str:
    return next(item["text"] for item in plan["warnings"] if item["kind"] == kind)


def fenced(x: float, y: float, corners: list[list[float]]) -> dict[str, Any]:
    return step("GoToXY", {"x": x, "y": y}) | {
        "filter_skills": [{"name": "BoundaryEnforcement", "parameters": {"poly_coords": corners}}]
    }


def test_a_right_plan_has_no_warning() -> None:
    assert planned("Go to [30, 40] and come home.", THERE, HOME)["warnings"] == []


# ---------------------------------------------------------------- values


def test_a_value_that_the_command_never_said() -> None:
    plan = planned("Go to [30, 41] and come home.", THERE, HOME)
    assert "value-not-said" in kinds(plan)
    assert (
        text_of(plan, "value-not-said")
        == "Task 1, Transit: target_position is [30, 40], which the command does not say."
    )


def test_a_skill_s_value_that_neither_command_nor_task_leads_to() -> None:
    wrong = {**THERE, "skill_sequence": [GO, step("StationKeep", {"time": 45})]}
    plan = planned("Go to [30, 40] and come home.", wrong, HOME)
    assert kinds(plan) == ["skill-value-not-said"] and "45 s" in text_of(
        plan, "skill-value-not-said"
    )


def test_a_skill_s_value_that_the_operator_set_is_not_questioned() -> None:
    hold = {
        **THERE,
        "task_prompt": "Go to [30, 40] and hold for 60 s.",
        "skill_sequence": [GO, step("StationKeep", {"time": 60})],
    }
    plan = planned("Go to [30, 40], hold for 60 s and come home.", hold, HOME)
    edited = apply(
        plan,
        {
            "kind": "skill",
            "task": "t1",
            "step": 1,
            "role": "navigation",
            "index": 0,
            "name": "time",
            "value": 45,
        },
        USV,
    )
    assert "skill-value-not-said" not in kinds(edited)


def test_waypoints_that_follow_from_the_task_are_no_invention() -> None:
    square = [(50, 40), (50, 60), (30, 60), (10, 60), (10, 40), (10, 20), (30, 20), (50, 20)]
    steps = [step("GoToXY", {"x": x, "y": y}) for x, y in square]
    survey = task(
        "SurveyTarget",
        {"target_position": [30, 40], "radius": 20},
        steps,
        "Survey the pier at [30, 40] on a square with a radius of 20 m.",
    )
    assert (
        kinds(planned("Survey the pier at [30, 40] from 20 m and come home.", survey, HOME)) == []
    )


@pytest.mark.parametrize(
    ("command", "lost"),
    [
        ("Go to [30, 40], hold for five minutes and come home.", "five minutes"),
        ("Go to [30, 40], then to [70, 80], and come home.", "70, 80"),
        ("Go to [30, 40] on a heading of 95 and come home.", "95"),
    ],
)
def test_a_value_that_reached_no_task(command: str, lost: str) -> None:
    assert f'"{lost}"' in text_of(planned(command, THERE, HOME), "value-lost")


@pytest.mark.parametrize(
    "command",
    [
        "Go to [31, 41], no, make that [30, 40], and come home.",
        (
            "Go to [30, 40] and come home. We have 3 boats and contact 17 here since 14 o'clock, or"
            " 10 hours UTC."
        ),
        "Go to [30, 40] and come home, and skip the five minutes of waiting.",
    ],
)
def test_counts_ids_hours_and_what_is_taken_back_are_not_lost(command: str) -> None:
    assert "value-lost" not in kinds(planned(command, THERE, HOME))


# ---------------------------------------------------------------- order


def test_an_open_place_is_told_once_and_keeps_its_id_when_something_else_is_edited() -> None:
    search = task(
        "SearchAndDetect",
        {"target_description": "green buoy"},
        [step("StationKeep")],
        "Find the green buoy.",
    )
    tasks = [
        search,
        task("Transit", {"target_position": OPEN}, None, "Go to the green buoy."),
        HOME,
    ]
    plan = planned("Find the green buoy, go there and come home.", *tasks)
    assert [item["id"] for item in plan["warnings"]] == ["unresolved-location:green buoy"]
    assert (
        plan["warnings"][0]["task"] == "t2"
        and plan["warnings"][0]["parameter"] == "target_position"
    )
    moved = apply(
        plan,
        {
            "kind": "insert",
            "at": 0,
            "title": "Diagnostics",
            "parameters": {},
            "task_prompt": "Check.",
        },
        USV,
    )
    assert plan["warnings"][0]["id"] in [item["id"] for item in moved["warnings"]]
    assert "unresolved-location" not in kinds(
        apply(plan, {"kind": "locate", "name": "green buoy", "position": [1, 2]}, USV)
    )


def test_a_target_that_is_used_before_it_is_found() -> None:
    plan = planned(
        "Go to the green buoy.",
        task("Transit", {"target_position": OPEN}, None, "Go to the green buoy."),
    )
    assert "used-before-found" in kinds(plan)


def test_a_task_at_a_place_where_the_vehicle_is_not() -> None:
    orbit = task("PerformOrbit", {"center": [70, 80]}, [], "Circle it.")
    assert "not-at-place" in kinds(
        planned("Go to [30, 40], circle [70, 80] and come home.", THERE, orbit, HOME)
    )
    hold = task("KeepStation", {}, [], "Hold position at [70, 80].")
    assert "not-at-place" in kinds(
        planned("Go to [30, 40], hold at [70, 80] and come home.", THERE, hold, HOME)
    )


# ---------------------------------------------------------------- space, time, return


def test_a_waypoint_outside_of_its_boundary() -> None:
    corners = [[0, 0], [50, 0], [50, 50], [0, 50]]
    inside, outside = (
        {
            **THERE,
            "task_prompt": f"Go to [30, 40] inside {corners}.",
            "skill_sequence": [fenced(30, y, corners)],
        }
        for y in (40, 90)
    )
    assert "outside-boundary" not in kinds(planned("Go to [30, 40].", inside))
    assert "[30, 90]" in text_of(planned("Go to [30, 40].", outside), "outside-boundary")


def test_a_boundary_of_the_plan_holds_for_every_task() -> None:
    plan = planned(
        "Go to [30, 40] and come home.",
        THERE,
        HOME,
        constraints=["Stay inside [0, 0], [20, 0], [20, 20], [0, 20]."],
    )
    assert [item["task"] for item in plan["warnings"] if item["kind"] == "limit-broken"] == ["t1"]


def test_corners_with_crossing_sides_are_no_error() -> None:
    crossed = {**THERE, "skill_sequence": [fenced(30, 40, [[0, 0], [50, 50], [50, 0], [0, 50]])]}
    assert "outside-boundary" not in kinds(planned("Go to [30, 40].", crossed))


def test_the_vehicle_s_area_and_its_reach() -> None:
    plan = document([THERE, HOME], command="Go to [30, 40] and come home.")
    area = [list(corner) for corner in check_area([[-5, -5], [20, -5], [20, 20], [-5, 20]])]
    assert kinds(revise({**plan, "vehicle": {**plan["vehicle"], "area": area}}, USV)) == [
        "outside-area"
    ]
    assert kinds(revise({**plan, "vehicle": {**plan["vehicle"], "endurance": 60}}, USV)) == [
        "out-of-reach",
        "over-endurance",
    ]


def test_an_edited_place_that_is_too_far() -> None:
    plan = planned("Go to [30, 40] and come home.", THERE, HOME)
    edited = apply(
        plan,
        {"kind": "parameter", "task": "t1", "name": "target_position", "value": [90000, 0]},
        USV,
    )
    assert "out-of-reach" in kinds(edited) and "stale-skills" in kinds(edited)


def test_unknown_parts_are_told_when_the_known_part_is_long() -> None:
    hold = task(
        "KeepStation",
        {"duration": 4000},
        [step("StationKeep", {"time": 4000}), step("VisualStationKeep")],
        "Hold for 4000 s.",
    )
    assert "endurance-open" in kinds(planned("Hold for 4000 s.", hold), notes=True)


def test_a_plan_may_last_as_long_as_the_vehicle_and_names_what_is_not_known() -> None:
    plan = document([THERE, HOME], command="Go to [30, 40] and come home.")
    lasts = {"endurance": plan["estimate"]["seconds"]}
    assert kinds(revise({**plan, "vehicle": {**plan["vehicle"], **lasts}}, USV)) == []
    follow = task("KeepStation", {}, [step("VisualStationKeep")], "Hold.")
    for count, words in ((MOST_LISTED, "and 1 more"), (MOST_LISTED + 2, "and 2 more")):
        plan = document([THERE, *[follow] * count, HOME], command="Go to [30, 40] and come home.")
        short = {**plan, "vehicle": {**plan["vehicle"], "endurance": 1}}
        assert (words in text_of(revise(short, USV), "over-endurance")) == (count > MOST_LISTED)


def test_an_unsaid_value_of_a_skill_is_told_once_for_a_task() -> None:
    hold = step("StationKeep", {"time": 45})
    wrong = {**THERE, "skill_sequence": [GO, hold, hold]}
    assert kinds(planned("Go to [30, 40] and come home.", wrong, HOME)) == ["skill-value-not-said"]


def test_a_return_that_is_missing() -> None:
    assert kinds(planned("Go to [30, 40] and come home.", THERE)) == ["missing-return"]
    assert kinds(planned("Go to [30, 40].", THERE), notes=True) == []
    assert kinds(planned("Go to [30, 40] and stay there.", THERE), notes=True) == []
    assert kinds(planned("Go to [30, 40], don't come home.", THERE), notes=True) == []


# ---------------------------------------------------------------- the command, the answers


def test_an_instruction_that_no_task_answers() -> None:
    plan = planned("Go to [30, 40], take a panorama, and come home.", THERE, HOME)
    assert kinds(plan) == ["not-planned"] and "panorama" in text_of(plan, "not-planned")
    assert kinds(planned("Go to [30, 40], tow the dinghy, and come home.", THERE, HOME)) == [
        "not-planned"
    ]


@pytest.mark.parametrize(
    "command",
    [
        "Go to [30, 40] and come home. Skip the panorama.",
        "Go to [30, 40] and come home without a panorama.",
        "Panorama, no, scratch that, go to [30, 40] and come home.",
    ],
)
def test_what_is_ruled_out_or_taken_back_need_not_be_planned(command: str) -> None:
    assert "not-planned" not in kinds(planned(command, THERE, HOME))


def test_what_a_plan_declines_need_not_be_planned() -> None:
    plan = planned(
        "Go to [30, 40], weld the rail and come home.",
        THERE,
        HOME,
        constraints=["The vehicle has no task to weld the rail."],
    )
    assert kinds(plan) == ["left-out"]
    text = "The plan leaves something out: The vehicle has no task to weld the rail."
    assert plan["warnings"][0]["text"] == text


def test_the_radius_of_a_hold_is_no_answer_to_a_limit() -> None:
    hold = step("StationKeep", {"time": 600, "radius": 2})
    plan = document(
        [task("KeepStation", {"duration": 600}, [hold])],
        command="Hold 10 minutes, never with less than 2 m under the keel.",
    )
    revised = revise(plan, USV)
    assert any("2 m" in item["text"] for item in revised["warnings"])


def test_answers_that_cannot_be_used() -> None:
    plan = planned("Go to [30, 40] and come home.", THERE, HOME)
    broken = copy.deepcopy(plan)
    broken["tasks"][0] |= {"skill_sequence": None, "problems": ["not JSON"], "output": "{"}
    assert kinds(revise(broken, USV)) == ["invalid-answer"]
    assert (
        kinds(revise({**plan, "tasks": [], "problems": ["not JSON"], "output": "{"}, USV))[0]
        == "invalid-answer"
    )
    assert "empty-plan" in kinds(revise({**plan, "tasks": []}, USV), notes=True)
    assert kinds(
        planned("Go to [30, 40] and come home.", {**THERE, "skill_sequence": None}, HOME)
    ) == ["no-skills"]


def test_a_command_that_cannot_be_read_is_said_once() -> None:
    assert kinds(planned("去 [30, 40] 然后返回", THERE, HOME), notes=True) == ["unknown-language"]


# ---------------------------------------------------------------- all of them


def test_warnings_are_unique_and_the_most_serious_come_first() -> None:
    plan = planned(
        "Hold for 9 hours, orbit it, and come home.",
        THERE,
        task("PerformOrbit", {"center": OPEN, "radius": 9}, None, "Circle it."),
    )
    found = [item["kind"] for item in plan["warnings"]]
    assert (
        found == sorted(found, key=KINDS.index)
        and len({item["id"] for item in plan["warnings"]}) == len(found) > 3
    )


def test_notes_stand_behind_what_is_serious() -> None:
    assert KINDS[-len(NOTES) :] == NOTES


def test_warnings_of_one_kind_stand_in_the_order_of_the_plan() -> None:
    plan = planned(
        "Go to [30, 40] and come home.",
        *({**THERE, "skill_sequence": None} for _number in range(3)),
        HOME,
    )
    assert [item["task"] for item in plan["warnings"]] == ["t1", "t2", "t3"]


def test_expected_plans_raise_no_false_alarm() -> None:
    for record in read_jsonl("data/mission/validation.jsonl"):
        expected = record["expected"]
        texts = {key: expected[key] for key in ("assumptions", "constraints")}
        plan = planned(
            record["prompt"],
            *({**entry, "skill_sequence": []} for entry in expected["tasks"]),
            **texts,
        )
        assert [
            kind for kind in kinds(plan) if kind not in ("unresolved-location", "no-skills")
        ] == [], record["id"]


def test_another_vehicle() -> None:
    there = task(
        "FlyToPoint",
        {"target_position": [30, 40]},
        [step("FlyToXY", {"x": 30, "y": 44})],
        "Fly to [30, 40].",
    )
    plan = planned("Fly to [30, 40], orbit the tower and return.", there, vocabulary=DRONE)
    assert kinds(plan) == ["missing-return", "not-planned", "skill-value-not-said"]


def test_laps_that_cut_across_their_round_are_told() -> None:
    corners = [(20, 20), (80, 20), (80, 80), (20, 80)]
    command = "Two laps of the square 20,20 - 80,20 - 80,80 - 20,80, then home."
    closed = "Sail 20,20 then 80,20 then 80,80 then 20,80 and back to 20,20, two laps, then home."

    def told(order: list[int], command: str) -> bool:
        ways = [task("Transit", {"target_position": [*corners[at]]}, None, "Go.") for at in order]
        home = task("Transit", {"target_position": [0, 0]}, None, "Return home.")
        plan = document([*ways, home], command=command)
        return any("no neighbours" in one["text"] for one in plan["warnings"])

    assert not told([0, 1, 2, 3, 0, 1, 2, 3], command)
    assert not told([0, 3, 2, 1, 0, 3, 2, 1, 0], command)
    assert not told([0, 1, 2, 3, 0, 1, 2, 3, 0], closed)
    assert told([0, 1, 2, 3, 0, 2, 1, 3], command)


def test_a_corrected_value_that_a_task_has_all_the_same_is_told() -> None:
    command = "Survey the pile at 60,40 at 25 metres, no, 20 metres. Hold for 25 seconds there."

    def told(command: str, *radii: float) -> bool:
        rounds = [
            task("SurveyTarget", {"target_position": [60, 40], "radius": radius}, None, "Survey.")
            for radius in radii
        ]
        plan = document(rounds, command=command)
        return any("SurveyTarget is in the plan" in one["text"] for one in plan["warnings"])

    assert told(command, 20, 25) and not told(command, 20)
    assert not told("Survey the pile at 60,40 at 25 metres, the buoy at 20 metres.", 25, 20)


def test_data_to_be_sent_that_a_list_lacks_is_told() -> None:
    def told(command: str, *names: str) -> list[str]:
        send = task("SmartDataHarvest", {"target_list": [*names]}, None, "Upload.")
        plan = document([send], command=command)
        return [one["text"] for one in plan["warnings"] if "sends no" in one["text"]]

    assert "sends no video" in told("Upload the video first.", "stills")[0]
    assert not told("Upload the video first.", "stills", "video")
    assert not told("Film it on video and upload the stills.", "stills")
    assert not told("Upload the data.", "stills")


def test_a_feature_that_is_left_out_again_is_told() -> None:
    stare = task("FeatureStare", {"feature_type": "ladder of the pontoon"}, None, "Film it.")
    for command, wanted in (
        ("Film the ladder for a minute. Actually, leave the ladder out.", True),
        ("Film the ladder for a minute, but forget the report.", False),
        ("Don't film the rail but the ladder.", False),
    ):
        plan = document([stare], command=command)
        told = [one["text"] for one in plan["warnings"] if one["kind"] == "contradiction"]
        assert any("FeatureStare is in the plan" in text for text in told) is wanted, command


def test_a_round_of_a_bare_place_beside_a_thing_that_is_left_alone_is_told() -> None:
    lies = "The pontoon lies at 60,40. Go to 20,40 and circle it at 15 m."
    ring = task("PerformOrbit", {"center": [20, 40], "radius": 15, "arc": 360}, None, "Circle.")
    right = task("PerformOrbit", {"center": [60, 40], "radius": 15, "arc": 360}, None, "Circle.")
    for command, done, wanted in (
        (lies, [ring], True),
        (lies, [right], False),
        ("Circle 20,40 at 15 m.", [ring], False),
        ("Go to the buoy at 60,40. Circle 20,40 at 15 m.", [right, ring], False),
    ):
        plan = document(done, command=command)
        told = [one["text"] for one in plan["warnings"] if "goes round" in one["text"]]
        assert bool(told) is wanted, command
    limit = "The vehicle stays at least 20 m from the pontoon at [60, 40]."
    plan = document([ring], command=lies, constraints=[limit])
    assert not any("goes round" in one["text"] for one in plan["warnings"])


def test_a_thing_that_a_prompt_puts_where_the_command_has_another_is_named() -> None:
    command = "Survey the pier at [40, 10], then film the ramp at [80, 10]."
    survey = task(
        "SurveyTarget", {"target_position": [40, 10]}, [], prompt="Survey the pier at [40, 10]."
    )
    go = task("Transit", {"target_position": [80, 10]}, [], prompt="Go to the pier at [80, 10].")
    right = task("Transit", {"target_position": [80, 10]}, [], prompt="Go to the ramp at [80, 10].")
    assert "contradiction" not in kinds(document([survey, right], command=command))
    texts = [item["text"] for item in document([survey, go], command=command)["warnings"]]
    assert (
        "Task 2, Transit speaks of the pier at [80, 10], and the command has the ramp there."
        in texts
    )


def test_a_place_that_is_worked_out_is_named_in_a_plan_that_has_lost_one() -> None:
    command = (
        "Go to [25, 75], then to [75, 75], follow the cable from [0, 50] heading 90 for 200 m."
    )
    cable = task("SubseaCableTrack", {"start": [0, 50], "heading": 90, "max_dist": 200}, [])
    tasks = [
        task("Transit", {"target_position": place}, []) for place in ([25, 75], [75, 75], [75, 275])
    ]
    assert "value-not-said" not in kinds(document([*tasks[:2], tasks[2], cable], command=command))
    lost = document([tasks[0], tasks[2], cable], command=command)
    assert "worked out and not said" in str(lost["warnings"])


def test_a_number_that_the_command_says_as_a_coordinate_alone_is_named() -> None:
    around = task(
        "PerformOrbit", {"center": [200, 140], "radius": 140}, [], prompt="Circle at 140 m."
    )
    told = document([around], command="Circle the mussel lines by 200,140.")["warnings"]
    assert "radius is 140 m, which the command says as a coordinate alone" in str(told)
    told = document([around], command="Circle the lines at 200,140 at 140 m.")["warnings"]
    assert "as a coordinate alone" not in str(told)


def test_a_value_that_the_task_prompt_contradicts_is_named() -> None:
    command = "Circle the tower at [200, 200] at 20 m."
    given = {"center": [200, 200], "radius": 20}
    right, wrong = (
        document([task("PerformOrbit", given, [], prompt=text)], command=command)
        for text in ("Circle [200, 200] at 20 m.", "Circle [200, 200] at 200 m.")
    )
    assert "contradiction" not in kinds(right)
    assert 'radius is 20 m, and its prompt is "Circle' in str(wrong["warnings"])


def test_what_would_hurt_is_named_whatever_is_planned() -> None:
    for tasks in ([THERE, HOME], []):
        assert "harm-asked" in kinds(planned("Ram the dinghy at [30, 40].", *tasks))
        assert "harm-asked" not in kinds(planned("Do not ram the dinghy at [30, 40].", *tasks))
        assert "harm-asked" in kinds(planned("It won't leave [30, 40], so ram it.", *tasks))
        assert "harm-asked" not in kinds(planned("Run down the quay at [30, 40].", *tasks))


def test_a_place_that_goes_by_its_letter_can_be_left_out() -> None:
    points = [(10, 20), (30, 25), (50, 20)]
    tasks = [
        task("Transit", {"target_position": [x, y]}, [step("GoToXY", {"x": x, "y": y})])
        for x, y in points
    ]
    plan = planned("Points: A 10,20, B 30,25, C 50,20. Forget B, there is eelgrass.", *tasks)
    assert kinds(plan) == ["contradiction"]
    kept = planned("Points: A 10,20, B 30,25, C 50,20. Forget B.", tasks[0], tasks[2])
    assert kinds(kept) == []


def test_a_shuttle_goes_to_its_places_again() -> None:
    ways = {
        x: task("Transit", {"target_position": [x, 30]}, [step("GoToXY", {"x": x, "y": 30})])
        for x in (30, 60)
    }
    command = "Go back and forth between 30,30 and 60,30."
    once = planned(command, ways[30], ways[60])
    again = planned(command, *([ways[30], ways[60]] * 2))
    assert ("repeat-lost" in kinds(once), "repeat-lost" in kinds(again)) == (True, False)


@pytest.mark.parametrize(
    ("command", "tasks", "kind"),
    [
        (
            "Survey the wreck at 30,40 at 20 m ... scratch that. Come home.",
            [SURVEY, HOME],
            "contradiction",
        ),
        (
            'Come home. The mail said "go to 30,40 at once", ignore it.',
            [THERE, HOME],
            "value-not-said",
        ),
        ("Go to 30,40 and hold half a cable due east of it.", [THERE], "value-lost"),
        ("Go to 30,40. Come home if wind goes over 12 m/s.", [THERE, HOME], "condition-lost"),
    ],
)
def test_what_is_taken_back_quoted_or_lost(command: str, tasks: list[Any], kind: str) -> None:
    constraints = ["The vehicle goes no faster than 12 m/s."]
    assert kind in kinds(planned(command, *tasks, constraints=constraints))


def test_a_quoted_place_that_is_said_elsewhere_is_meant() -> None:
    plan = planned('Go to 30,40. The sign there says "berth 30,40 here". Come home.', THERE, HOME)
    assert "value-not-said" not in kinds(plan)
