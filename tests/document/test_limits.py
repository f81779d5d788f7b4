"""Limits among the constraints: filters in the steps, words of the command, and what breaks them."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import apply, differences, undo
from planner_ft.planning.limits import with_limits, with_return, without_limits
from planner_ft.support.errors import PlannerError
from tests.documents import DRONE, USV, document, step, task

FENCE = "The vehicle stays inside [0, 0], [200, 0], [200, 200], [0, 200]."
PLATFORM = "The vehicle stays at least 70 m from the platform at [260, 80]."


def transit(x: float, y: float) -> dict[str, Any]:
    go = step("GoToXY", {"x": x, "y": y})
    return task("Transit", {"target_position": [x, y]}, [go], f"Go to [{x}, {y}].")


def broken(*constraints: str, tasks: Any = None, **how: Any) -> list[str]:
    plan = document(tasks or [transit(100, 50), transit(0, 0)], constraints=constraints, **how)
    return [one["text"] for one in plan["warnings"] if one["kind"] == "limit-broken"]


def test_a_limit_is_a_filter_in_every_step_that_moves() -> None:
    hold = task("KeepStation", {}, [step("StationKeep")])
    plan = document([transit(100, 50), hold], constraints=[FENCE, "Be careful."])
    (limit,) = plan["limits"]
    assert (limit["kind"], limit["filter"]) == ("fence", "BoundaryEnforcement")
    assert limit["tasks"] == [1, 2]
    (own,) = plan["tasks"][0]["skill_sequence"][0]["filter_skills"]
    corners = [[0, 0], [200, 0], [200, 200], [0, 200]]
    assert own == {"name": "BoundaryEnforcement", "parameters": {"poly_coords": corners}}
    assert plan["tasks"][0]["added"][0]["kind"] == "limit"
    assert plan["tasks"][1]["skill_sequence"][0]["filter_skills"] == []
    assert not [one for one in plan["warnings"] if one["kind"] == "skill-value-not-said"]


def test_a_limit_of_one_task_is_carried_into_that_task_alone() -> None:
    cable = task("SubseaCableTrack", {"start": [50, 50]}, [step("GoToXY", {"x": 50, "y": 90})])
    text = "The vehicle keeps at least 10 m from every obstacle during SubseaCableTrack."
    plan = document([transit(100, 50), cable], constraints=[text])
    assert [limit["tasks"] for limit in plan["limits"]] == [[2]]
    filters = [one["skill_sequence"][0]["filter_skills"] for one in plan["tasks"]]
    assert [len(own) for own in filters] == [0, 1]
    inside = FENCE.replace("200", "60").replace(".", " during SubseaCableTrack.")
    assert broken(inside, tasks=[cable])
    assert len(broken(inside, tasks=[transit(100, 50), cable, transit(0, 0)])) == 1


def test_a_limit_of_one_task_goes_into_its_prompt() -> None:
    text = "The vehicle goes no faster than 1 m/s during SubseaCableTrack."
    tasks = [{"title": title, "task_prompt": "Go."} for title in ("Transit", "SubseaCableTrack")]
    told = with_limits({"tasks": tasks, "constraints": [text]}, USV)
    prompts = [one["task_prompt"] for one in told["tasks"]]
    assert prompts == ["Go.", "Go. Go no faster than 1 m/s."]
    assert told["constraints"] == [text]
    alone = with_limits({"tasks": tasks[:1], "constraints": [text]}, USV)
    assert "no faster" in alone["tasks"][0]["task_prompt"]


def test_a_limit_of_one_task_that_others_are_told_holds_for_all() -> None:
    text = "The vehicle keeps at least 12 m from every obstacle during KeepStation."
    kept = "Keep at least 12 m from every obstacle."
    titles = ("Transit", "KeepStation", "Diagnostics")
    tasks = [{"title": title, "task_prompt": f"Go. {kept}"} for title in titles[:2]]
    told = with_limits({"tasks": tasks, "constraints": [text]}, USV)
    assert told["constraints"] == ["The vehicle keeps at least 12 m from every obstacle."]
    alone = [{"title": titles[2], "task_prompt": "Go."}, tasks[1]]
    assert with_limits({"tasks": alone, "constraints": [text]}, USV)["constraints"] == [text]


def test_a_sentence_of_a_task_prompt_stands_once() -> None:
    said = (
        "Sound it. Start in the north-west corner. Start in the north-west corner. Log the depth."
    )
    told = with_limits({"tasks": [{"title": "Transit", "task_prompt": said}]}, USV)
    (prompt,) = (one["task_prompt"] for one in told["tasks"])
    assert prompt == "Sound it. Start in the north-west corner. Log the depth."


def test_a_filter_that_is_there_is_kept_when_it_is_as_strict() -> None:
    moving = transit(100, 50)
    strict = {"name": "ObstacleAvoidance", "parameters": {"min_distance": 15}}
    moving["skill_sequence"][0]["filter_skills"] = [strict]
    for metres, count in ((5, 1), (15, 1), (25, 2)):
        text = f"The vehicle keeps at least {metres} m from every obstacle."
        plan = document([moving], constraints=[text])
        assert len(plan["tasks"][0]["skill_sequence"][0]["filter_skills"]) == count


def test_a_filter_of_a_step_that_holds_on_to_a_target_takes_the_limit_too() -> None:
    text = "The vehicle keeps at least 30 m from every obstacle."
    follow, hold = step("VisualStationKeep"), step("StationKeep")
    follow["filter_skills"] = [{"name": "ObstacleAvoidance", "parameters": {"min_distance": 15}}]
    plan = document([task("FollowTarget", {"target_id": "9"}, [follow, hold])], constraints=[text])
    kept, none = (one["filter_skills"] for one in plan["tasks"][0]["skill_sequence"])
    assert [one["parameters"]["min_distance"] for one in kept] == [15, 30] and none == []


def test_the_words_of_the_command_are_found() -> None:
    command = "Go to 100,50, but never leave the area 0,0 200,0 200,200 0,200, then come home."
    (limit,) = document([transit(100, 50)], command=command, constraints=[FENCE])["limits"]
    assert limit["words"] == "never leave the area 0,0 200,0 200,200 0,200"
    start, end = limit["spans"][0]
    assert command[start:end] == limit["words"]


def test_the_words_of_a_limit_reach_from_its_first_value_to_its_last() -> None:
    command = "Go to 100,50. Keep at least 70 m, and I mean it, from the platform at 260,80. Hurry."
    (limit,) = document([transit(100, 50)], command=command, constraints=[PLATFORM])["limits"]
    assert limit["words"].startswith("Keep at least 70 m") and "260,80" in limit["words"]
    assert "100,50" not in limit["words"] and "Hurry" not in limit["words"]


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("The vehicle stays inside [0, 0], [80, 0], [80, 80], [0, 80].", "goes to [100, 50]"),
        ("The vehicle stays outside [80, 0], [110, 0], [110, 80], [80, 80].", "enters it"),
        ("The vehicle stays at least 30 m from the wreck at [120, 50].", "within 20 m"),
        ("The vehicle stays within 100 m of home.", "112 m away"),
        ("The mission takes at most 60 s.", "takes about"),
    ],
)
def test_what_the_track_breaks_is_told(text: str, words: str) -> None:
    (found,) = broken(text)
    assert words in found and text.rstrip(".") in found


@pytest.mark.parametrize(
    "text",
    [
        FENCE,
        PLATFORM,
        "The vehicle stays outside [40, 80], [60, 80], [60, 90], [40, 90].",
        "The vehicle stays outside [40, 0], [60, 0], [60, 80], [40, 80].",
        "The vehicle stays within 120 m of home.",
        "The mission takes at most 600 s.",
        "The vehicle goes no faster than 2 m/s.",
        "The vehicle is back by 16:30.",
        "Nothing is recorded.",
    ],
)
def test_what_holds_is_not_told(text: str) -> None:
    assert broken(text) == []


def test_a_leg_is_led_round_what_it_must_keep_away_from() -> None:
    text = "The vehicle stays at least 20 m from the wreck at [50, 25]."
    command = "Go to [100, 50] and keep 20 m from the wreck at [50, 25]."
    plan = document([transit(100, 50)], constraints=[text], command=command)
    assert len(plan["tasks"][0]["skill_sequence"]) > 1
    assert [one["kind"] for one in plan["warnings"]] == []


def test_speed_and_recording_are_checked_in_tasks_and_steps() -> None:
    arc = step("ArcTurn", {"radius": 20, "delta_yaw": 90})
    arc["perception_skills"] = [{"name": "SetStreamRecording", "parameters": {}}]
    given = {"center": [100, 50], "radius": 20, "speed": 2}
    tasks = [transit(100, 50), task("PerformOrbit", given, [arc], "Circle the marina.")]
    assert "2 m/s" in broken("The vehicle goes no faster than 1 m/s.", tasks=tasks)[0]
    assert "SetStreamRecording" in broken("Nothing is recorded.", tasks=tasks)[0]
    assert broken("Nothing is recorded near the marina.", tasks=tasks)
    assert not broken("Nothing is recorded near the pier.", tasks=tasks)


def test_no_video_rules_out_no_stills() -> None:
    stills = step("GoToXY", {"x": 9, "y": 9})
    stills["perception_skills"] = [{"name": "CaptureGeoSnapshot", "parameters": {}}]
    tasks = [task("Transit", {"target_position": [9, 9]}, [stills], "Go to [9, 9].")]
    for command, count in (("Go to 9,9, stills on the way, no video.", 0), ("To 9,9.", 1)):
        assert len(broken("Nothing is recorded.", tasks=tasks, command=command)) == count


def test_a_time_of_return_that_is_a_duration_is_checked_against_the_plan() -> None:
    tasks = [
        transit(100, 50),
        task("KeepStation", {"duration": 3000}, [step("StationKeep", {"time": 3000})]),
    ]
    assert "takes about" in broken("The vehicle is back by 40 minutes.", tasks=tasks)[0]
    assert not broken("The vehicle is back by two hours.", tasks=tasks)
    plan = document(tasks, constraints=["The vehicle is back by 40 minutes."])
    assert not plan["limits"][0].get("unchecked")
    assert "takes about" in broken("The vehicle is back within 40 minutes.", tasks=tasks)[0]


def test_a_time_of_return_that_is_a_duration_is_one_to_be_back_within() -> None:
    tasks = [{"title": "Transit", "parameters": {}, "task_prompt": "Go home. Be back by an hour."}]
    told = {"tasks": tasks, "constraints": ["The vehicle is back by an hour."]}
    plan = with_limits(told, USV, "Look round and be back within an hour.")
    assert plan["constraints"] == ["The vehicle is back within an hour."]
    assert plan["tasks"][0]["task_prompt"] == "Go home. Be back within an hour."
    assert without_limits(plan["tasks"][0]["task_prompt"], USV) == "Go home."


def test_what_cannot_be_checked_is_said() -> None:
    texts = ["The vehicle is back by 16:30.", "The vehicle stays at least 9 m from the ferry."]
    plan = document([transit(100, 50)], constraints=texts)
    assert [bool(limit["unchecked"]) for limit in plan["limits"]] == [True, True]


def test_a_limit_that_stands_twice_is_told_once() -> None:
    text = "The vehicle stays at least 8 m from the cages."
    plan = with_limits({"tasks": [task("Diagnostics", {}, [])], "constraints": [text, text]}, USV)
    assert plan["constraints"] == [text]
    assert plan["tasks"][0]["task_prompt"].count("8 m") == 1


def test_limits_reach_all_task_prompts_and_not_the_task_agent() -> None:
    own = {"title": "Transit", "parameters": {}, "task_prompt": "Go to [1, 2]."}
    told = {**own, "task_prompt": "Go to [3, 4]. Stay within 90 m of home."}
    text = "The vehicle stays within 90 m of home."
    plan = with_limits({"tasks": [own, told], "constraints": [text]}, USV)
    prompts = [entry["task_prompt"] for entry in plan["tasks"]]
    assert prompts == ["Go to [1, 2]. Stay within 90 m of home.", told["task_prompt"]]
    assert without_limits(prompts[0], USV) == "Go to [1, 2]."
    assert (
        without_limits("Fly to [1, 2]. Stay inside [0, 0], [9, 0], [9, 9].", DRONE)
        == "Fly to [1, 2]."
    )


def test_a_limit_of_one_prompt_holds_for_the_mission_and_times_nobody_said_for_none() -> None:
    tasks = [
        {
            "title": "Transit",
            "parameters": {},
            "task_prompt": "Go to [1, 2]. Stay within 90 m of home. Be back by sun.",
        }
    ]
    told = {"tasks": tasks, "constraints": ["The vehicle is back by sun.", "Take care."]}
    plan = with_limits(told, USV, "Stay within 90 m and be back here.")
    assert plan["constraints"] == ["Take care.", "The vehicle stays within 90 m of home."]
    assert plan["tasks"][0]["task_prompt"] == "Go to [1, 2]. Stay within 90 m of home."
    said = {"tasks": tasks, "constraints": ["The vehicle is back by 16:30."]}
    kept = with_limits(said, USV, "Be back by 16:30.")["constraints"]
    assert kept[0] == "The vehicle is back by 16:30."


def test_an_area_with_a_corner_twice_is_the_row_of_the_command() -> None:
    command = "Stay in 0,0 150,0 150,150 0,150. Go to 9,9, then home."
    wrong = "inside [0, 0], [150, 0], [150, 0], [150, 0]."
    tasks = [{"title": "Transit", "parameters": {}, "task_prompt": f"Go to [9, 9]. Stay {wrong}"}]
    told = {"tasks": tasks, "constraints": [f"The vehicle stays {wrong}"]}
    plan = with_limits(told, USV, command)
    whole = "[0, 0], [150, 0], [150, 150], [0, 150]."
    assert plan["constraints"] == [f"The vehicle stays inside {whole}"]
    assert plan["tasks"][0]["task_prompt"] == f"Go to [9, 9]. Stay inside {whole}"
    for other in ("Stay in 0,0 90,0 90,90 0,90.", f"{command} Not 0,0 150,0 150,9."):
        assert with_limits(told, USV, other)["constraints"] == told["constraints"]
    closed = {"tasks": [], "constraints": [FENCE.replace("[0, 200].", "[0, 200], [0, 0].")]}
    assert with_limits(closed, USV, "Stay in 0,0 200,0 200,200 0,200 9,9.") == closed


def test_an_area_that_lacks_a_corner_is_the_row_of_the_command() -> None:
    lacks = "The vehicle stays inside [0, 0], [9, 0], [5, 9], [0, 9]."
    plan = with_limits(
        {"tasks": [], "constraints": [lacks]}, USV, "Stay in 0,0 9,0 9,5 5,5 5,9 0,9."
    )
    whole = "The vehicle stays inside [0, 0], [9, 0], [9, 5], [5, 5], [5, 9], [0, 9]."
    assert plan["constraints"] == [whole]


def test_a_constraint_is_edited_and_its_filters_follow() -> None:
    plan = document([transit(100, 50)], constraints=["Be careful.", FENCE])
    plan = apply(plan, {"kind": "constraint", "at": 1}, USV)
    assert plan["constraints"] == ["Be careful."] and "limits" not in plan
    assert plan["tasks"][0]["skill_sequence"][0]["filter_skills"] == []
    text = "The vehicle keeps at least 5 m from every obstacle."
    plan = apply(plan, {"kind": "constraint", "at": 1, "text": text}, USV)
    (own,) = plan["tasks"][0]["skill_sequence"][0]["filter_skills"]
    assert own["name"] == "ObstacleAvoidance"
    assert [change.kind for change in differences(plan)].count("constraint") == 2
    assert undo(undo(plan, USV), USV)["constraints"] == ["Be careful.", FENCE]
    first = apply(plan, {"kind": "constraint", "at": 0, "text": "Hurry."}, USV)
    assert first["constraints"][0] == "Hurry."
    for wrong in ({"at": 9}, {"at": -1}, {"at": 0, "text": " "}):
        with pytest.raises(PlannerError, match="constraint"):
            apply(plan, {"kind": "constraint", **wrong}, USV)


@pytest.mark.parametrize(
    ("command", "others"),
    [
        ("Barges lie at 40,30 and 80,30. Keep 20 m off both on the way to 120,60.", ["[80, 30]"]),
        ("Go to 120,60, 20 m clear of nets at 20,5, 40,30 and 70,9.", ["[20, 5]", "[70, 9]"]),
        # A task leads there, or the place stands alone elsewhere.
        ("Keep 20 m off the barge at 40,30, 120,60 is where you go.", []),
        ("Pass 40,30 and 80,30 on the way to 120,60. Keep 20 m off the barge at 40,30.", []),
        ("Keep 20 m off the barge at 40,30 and go to 120,60.", []),
    ],
)
def test_what_is_kept_off_at_one_place_of_a_row_is_at_the_others(command, others) -> None:
    text = "The vehicle stays at least 20 m from the barge at {}."
    way = task("Transit", {"target_position": [120, 60]}, None, "Go to [120, 60].")
    plan = {"tasks": [way], "constraints": [text.format("[40, 30]")]}
    told = with_limits(plan, USV, command)
    assert told["constraints"] == [text.format(at) for at in ("[40, 30]", *others)]
    for at in others:
        assert f"Keep at least 20 m from the barge at {at}." in told["tasks"][0]["task_prompt"]


def test_the_origin_of_a_plan_locates_its_geographic_places() -> None:
    words = "54.3217 N, 10.1412 E"
    go = task("Transit", {"target_position": [-99, -99]}, None, f"Go to {words}.")
    plan = document([go], command=f"Go to {words}.")
    assert plan["open_places"][0]["name"] == words
    assert "--origin" in plan["warnings"][0]["text"]
    edit = {"kind": "origin", "place": "54.32,10.14"}
    located = apply(plan, edit, USV)
    assert located["tasks"][0]["parameters"]["target_position"] == [78.1, 189.2]
    assert located["origin"] == {"latitude": 54.32, "longitude": 10.14}
    assert "origin" not in undo(located, USV)
    with pytest.raises(PlannerError, match="plan anew"):
        apply(located, edit, USV)


@pytest.mark.parametrize(
    ("words", "kinds"),
    [
        ("but keep at least 50 m from the boat at 54.3217 N, 10.1412 E", ["limit-lost"]),
        ("then to 54.3217 N, 10.1412 E", ["value-lost"]),
        ("then to 54.3217 N, 10.1412 E, no, scratch that", []),
    ],
)
def test_geographic_places_that_the_plan_has_nowhere(words: str, kinds: list[str]) -> None:
    go = task("Transit", {"target_position": [80, 40]}, [], "Go to [80, 40].")
    found = document([go], command=f"Go to 80, 40, {words}.")["warnings"]
    assert [one["kind"] for one in found if "54.3217" in one["text"]] == kinds


def moving() -> dict[str, Any]:
    """Steps that move but for the second."""
    steps = [
        step("GoToXY", {"x": 3, "y": 4}),
        step("StationKeep"),
        step("DriftWithCurrent", {"time": 3}),
    ]
    return task(
        "Transit",
        {"target_position": [3, 4]},
        [*steps, step("ArcTurn", {"radius": 3, "delta_yaw": 90})],
    )


@pytest.mark.parametrize(
    ("command", "text", "words"),
    [
        (
            "Go; stay within 90 m of home, please.",
            "The vehicle stays within 90 m of home.",
            "stay within 90 m of home",
        ),
        (
            "Go to [3, 4], at most 2 m/s fast.",
            "The vehicle goes no faster than 2 m/s.",
            "at most 2 m/s fast",
        ),
        ("Take at most 600 s.", "The mission takes at most 600 s.", "Take at most 600 s"),
        (
            "Go to [3, 4], keep 9 m from [50, 50], go on.",
            "The vehicle stays at least 9 m from [50, 50].",
            "keep 9 m from [50, 50]",
        ),
        (
            "Stay off the ferry.",
            "The vehicle stays at least 9 m from the Ferry.",
            "Stay off the ferry",
        ),
        ("Stay off.", "The vehicle stays at least 9 m from the ferry.", None),
    ],
)
def test_the_words_of_a_limit_are_its_clause(command: str, text: str, words: str | None) -> None:
    (limit,) = document([transit(3, 4)], command=command, constraints=[text])["limits"]
    assert limit.get("words") == words
    if words:
        ((start, end),) = limit["spans"]
        assert command[start:end] == words


def test_a_filter_stands_in_every_step_that_moves_and_is_marked_there() -> None:
    texts = [f"The vehicle keeps at least {far} m from every obstacle." for far in (5, 9)]
    (entry,) = document([moving()], constraints=texts)["tasks"]
    filters = [one["filter_skills"] for one in entry["skill_sequence"]]
    assert [[own["parameters"]["min_distance"] for own in one] for one in filters] == [
        [5, 9],
        [],
        [5, 9],
        [5, 9],
    ]
    assert [(mark["step"], mark["note"]) for mark in entry["added"]] == [
        (at, text) for at in (0, 2, 3) for text in texts
    ]
    assert entry["skill_sequence"][0]["failure_modes"] == ["margin violated"]
    (same,) = document([moving()], constraints=texts[::-1])["tasks"]
    assert [len(one["filter_skills"]) for one in same["skill_sequence"]] == [1, 0, 1, 1]


def test_a_filter_without_a_value_takes_the_limits_and_gives_it_back() -> None:
    text = "The vehicle keeps at least 5 m from every obstacle."
    going = transit(3, 4)
    going["skill_sequence"][0]["filter_skills"] = [{"name": "ObstacleAvoidance", "parameters": {}}]
    plan = document([going], constraints=[text, "Hurry."])
    (own,) = plan["tasks"][0]["skill_sequence"][0]["filter_skills"]
    assert own["parameters"] == {"min_distance": 5}
    (mark,) = plan["tasks"][0]["added"]
    assert (mark["parameter"], mark["kind"]) == ("min_distance", "limit")
    less = apply(plan, {"kind": "constraint", "at": 0}, USV)["tasks"][0]
    assert less["skill_sequence"][0]["filter_skills"] == [
        {"name": "ObstacleAvoidance", "parameters": {}}
    ]
    assert "added" not in less


def test_another_fence_is_a_second_boundary() -> None:
    other = FENCE.replace("200", "300")
    for texts, count in (((FENCE, FENCE), 1), ((FENCE, other), 2)):
        (entry,) = document([transit(100, 50)], constraints=texts)["tasks"]
        assert len(entry["skill_sequence"][0]["filter_skills"]) == count


def test_a_limit_holds_for_the_tasks_that_it_names_and_stale_skills_stay_as_they_are() -> None:
    plan = document([transit(100, 50), transit(9, 9)], constraints=[FENCE])
    assert plan["limits"][0]["tasks"] == [1, 2]
    plan = apply(plan, {"kind": "prompt", "task": "t1", "text": "Go."}, USV)
    plan = apply(plan, {"kind": "constraint", "at": 0, "text": FENCE.replace("200", "300")}, USV)
    first, second = (one["skill_sequence"][0]["filter_skills"] for one in plan["tasks"])
    assert (len(first), len(second)) == (0, 1)


@pytest.mark.parametrize(
    ("title", "values", "limit", "titles"),
    [
        ("Transit", [9, 9], "The vehicle is back within 40 minutes.", ["Transit", "Transit"]),
        ("Transit", [0, 0], "The vehicle is back within 40 minutes.", ["Transit"]),
        ("DockingApproach", [9, 9], "The vehicle is back by 14:30.", ["DockingApproach"]),
        ("Transit", [9, 9], "The mission takes at most 600 s.", ["Transit"]),
    ],
)
def test_a_time_of_return_brings_the_way_home(
    title: str, values: list[int], limit: str, titles: list[str]
) -> None:
    name = "goal_position" if title == "DockingApproach" else "target_position"
    one = {"title": title, "parameters": {name: values}, "task_prompt": "Do it."}
    plan = with_return({"tasks": [one], "constraints": [limit]}, USV)
    assert [task["title"] for task in plan["tasks"]] == titles
    assert plan["tasks"][-1]["parameters"] == {name: values if len(titles) == 1 else [0, 0]}
