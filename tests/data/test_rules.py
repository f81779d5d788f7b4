"""Each labelling rule catches the mistake it is about, for the vehicle and for another one."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.rules import rule_problems
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary()
HERE = [-99, -99]


def plan(*tasks: tuple[str, dict[str, Any]]) -> dict[str, Any]:
    return {
        "tasks": [
            {"title": title, "parameters": parameters, "task_prompt": ""}
            for title, parameters in tasks
        ]
    }


def go(x: float, y: float) -> tuple[str, dict[str, Any]]:
    return "Transit", {"target_position": [x, y]}


def find(what: str) -> tuple[str, dict[str, Any]]:
    return "SearchAndDetect", {"target_description": what}


SURVEY = ("SurveyTarget", {"target_position": HERE})
HOLD = ("KeepStation", {"duration": 300})

RIGHT = [
    ("Inspect the green barrel.", plan(find("green barrel"), SURVEY)),
    ("Find the green barrel.", plan(find("green barrel"))),
    ("Hold at [10, 20] for five minutes and come home.", plan(go(10, 20), HOLD, go(0, 0))),
    ("Hold for five minutes right where you are.", plan(HOLD)),
    (
        "Go home and dock by camera on the red lamp.",
        plan(go(0, 0), ("VisualDockingApproach", {"target_feature": "red lamp"})),
    ),
    ("Dock at berth 7.", plan(("DockingApproach", {"goal_position": HERE}))),
    (
        "Proceed to [18, 7] and survey it.",
        plan(go(18, 7), ("SurveyTarget", {"target_position": [18, 7]})),
    ),
    (
        "Sound 80 by 50 around [5, 5].",
        plan(("BathymetryGridSurvey", {"center": [5, 5], "width": 80, "length": 50})),
    ),
    (
        "Find the red buoy and the green barrel, then hold five minutes at the one and the other.",
        plan(find("red buoy"), find("green barrel"), go(*HERE), HOLD, go(*HERE), HOLD),
    ),
]
WRONG = [
    ("Inspect the green barrel.", plan(SURVEY), "no SearchAndDetect comes before"),
    (
        "Inspect the green barrel.",
        plan(find("green barrel"), SURVEY, find("Green barrel"), SURVEY),
        "one search per structure",
    ),
    (
        "Inspect the buoy at [4, 5].",
        plan(find("buoy"), ("SurveyTarget", {"target_position": [4, 5]})),
        "tasks[0] SearchAndDetect: nothing unresolved follows ... gives coordinates for 'buoy'",
    ),
    (
        "Circle the buoy at [4, 5].",
        plan(find("buoy"), go(-99, -99), ("PerformOrbit", {"center": HERE})),
        "gives coordinates for 'buoy'",
    ),
    (
        "Hold by the green barrel for five minutes.",
        plan(find("green barrel"), HOLD),
        "nothing unresolved follows ... tasks[1] KeepStation: SearchAndDetect does not arrive",
    ),
    ("Circle [4, 5].", plan(("PerformOrbit", {"center": [4, 5]})), "no Transit there comes before"),
    (
        "Track the cable from [4, 5], hold at the start for five minutes.",
        plan(("SubseaCableTrack", {"start": [4, 5]}), HOLD),
        "does not end at its place",
    ),
    (
        "Survey [18, 7].",
        plan(go(18, 7), ("SurveyTarget", {"target_position": [18, 7]})),
        "by itself",
    ),
    (
        "Circle [4, 5], then hold five minutes.",
        plan(go(4, 5), ("PerformOrbit", {"center": [4, 5]}), go(4, 5), HOLD),
        "is at [4, 5] already",
    ),
    (
        "Come home and dock at berth 7.",
        plan(go(0, 0), ("DockingApproach", {"goal_position": HERE})),
        "is that task alone",
    ),
    (
        "Hold at [4, 5] for five minutes before you come home.",
        plan(go(0, 0), go(4, 5), HOLD),
        "tasks[1] Transit: comes after the return home ... tasks[2] KeepStation: comes after",
    ),
    (
        "Follow contact 4.",
        plan(
            find("contact 4"), ("FollowTarget", {"target_id": "contact 4", "target_position": HERE})
        ),
        "needs no place",
    ),
    ("Hold for eight minutes.", plan(("KeepStation", {"duration": 8})), "8 s does not follow"),
    (
        "Circle [4, 5].",
        plan(go(4, 5), ("PerformOrbit", {"center": [4, 5], "radius": 20})),
        "20 m does not follow",
    ),
    (
        "Circle [4, 5].",
        plan(go(4, 5), ("PerformOrbit", {"center": [4, 5], "arc": 360})),
        "360 deg does not follow",
    ),
    ("Go to [4, 5].", plan(go(5, 4)), "coordinates [5, 4] are not in the command"),
    ("Inspect the green barrel.", plan(find("the green barrel"), SURVEY), "begins with an article"),
    ("Inspect the green barrel.", plan(find("red barrel"), SURVEY), "'red' of 'red barrel'"),
    ("Inspect the green barrel.", plan(find("green barrel."), SURVEY), "blank or punctuation"),
    (
        "Buoy at [4, 5]: circle it.",
        plan(find("buoy"), go(-99, -99), ("PerformOrbit", {"center": HERE})),
        "gives coordinates for 'buoy'",
    ),
    (
        "Sound 80 by 50 around [5, 5].",
        plan(("BathymetryGridSurvey", {"center": [5, 5], "width": 50, "length": 80})),
        "not the other way round",
    ),
    (
        "Sound 80 by 50.",
        plan(("BathymetryGridSurvey", {"width": 50, "length": 80})),
        "not the other way round",
    ),
    (
        "Find the green barrel, hold there for five minutes, then hold again.",
        plan(find("green barrel"), go(*HERE), HOLD, go(*HERE), HOLD),
        "at [-99, -99] already",
    ),
]


@pytest.mark.parametrize(("prompt", "expected"), RIGHT, ids=[prompt for prompt, _ in RIGHT])
def test_a_right_plan_has_no_problem(prompt: str, expected: dict[str, Any]) -> None:
    assert rule_problems(expected, USV, prompt) == []
    assert rule_problems(expected, USV) == []


@pytest.mark.parametrize(
    ("prompt", "expected", "problem"), WRONG, ids=[problem for *_, problem in WRONG]
)
def test_a_wrong_plan_is_caught(prompt: str, expected: dict[str, Any], problem: str) -> None:
    found = rule_problems(expected, USV, prompt)
    parts = problem.split(" ... ")
    assert len(found) == len(parts), found
    assert all(part in text for part, text in zip(parts, found, strict=True)), found


GRID = ("BathymetryGridSurvey", {"center": [4, 5]})
ORBIT = ("PerformOrbit", {"center": [4, 5]})
REPORT = ("AutoGenerateReportSummary", {})
DOCK = ("DockingApproach", {"goal_position": HERE})
ASKED = "nothing unresolved follows and the command asks for no search"
AWAY = "performed at [4, 5], but no Transit there comes before it"
LEFT = "the task before does not end at its place, so Transit comes before this task"
HOME = "comes after the return home, which is the last Transit"
GIVEN = "the command gives coordinates for 'pier', so it is not searched"
TURNED = "80 by 50 is width 80 and length 50, not the other way round"


def area(width: float, length: float) -> tuple[str, dict[str, Any]]:
    return "BathymetryGridSurvey", {"center": [5, 5], "width": width, "length": length}


@pytest.mark.parametrize(
    ("prompt", "tasks", "tags", "problems"),
    [
        # What only the command's words, or a tag, allow; without both it may be so.
        ("Find the pier.", [find("pier")], None, []),
        ("Find the pier.", [find("pier")], [], [f"tasks[0] SearchAndDetect: {ASKED}"]),
        ("Find the pier.", [find("pier")], ["rule.search-on-request"], []),
        ("The pier.", [find("pier")], None, [f"tasks[0] SearchAndDetect: {ASKED}"]),
        (None, [find("pier")], None, []),
        # A search is used until the next one.
        (
            "The red buoy and the pier.",
            [find("red buoy"), find("pier"), SURVEY],
            None,
            [f"tasks[0] SearchAndDetect: {ASKED}"],
        ),
        (
            "Find it.",
            [("SearchAndDetect", {}), ("SearchAndDetect", {})],
            None,
            ["tasks[1] SearchAndDetect: '' was searched by tasks[0] SearchAndDetect already"],
        ),
        (
            "Follow it.",
            [("FollowTarget", {"target_position": HERE})],
            None,
            ["tasks[0] FollowTarget"],
        ),
        (
            "T4 at [4, 5].",
            [("FollowTarget", {"target_id": "T4", "target_position": [4, 5]})],
            None,
            [],
        ),
        # Coordinates right behind a target are its own; sides of an area are none.
        (
            "The pier at [4, 5].",
            [find("pier"), SURVEY],
            None,
            [f"tasks[0] SearchAndDetect: {GIVEN}"],
        ),
        (
            "The pier lying near minus 4, 5.",
            [find("pier"), SURVEY],
            None,
            [f"tasks[0] SearchAndDetect: {GIVEN}"],
        ),
        ("The pier by the buoy at [4, 5].", [find("pier"), SURVEY], None, []),
        ("The pier 20 by 30 m.", [find("pier"), SURVEY], None, []),
        ("At [4, 5] the pier.", [find("pier"), SURVEY], None, []),
        # Where the vehicle is.
        ("To [4, 5], [6, 7].", [go(4, 5), go(6, 7)], None, []),
        (
            "To [4, 5].",
            [go(4, 5), go(4, 5)],
            None,
            ["tasks[1] Transit: the vehicle is at [4, 5] already"],
        ),
        ("To [4, 5].", [GRID, go(4, 5)], None, []),
        ("To [4, 5].", [GRID, go(4, 5), ORBIT], None, []),
        ("To [4, 5].", [GRID, ORBIT], None, [f"tasks[1] PerformOrbit: {LEFT}"]),
        ("To [4, 5].", [GRID, ORBIT], ["rule.no-transit"], [f"tasks[1] PerformOrbit: {AWAY}"]),
        (None, [GRID, ORBIT], None, [f"tasks[1] PerformOrbit: {AWAY}"]),
        (None, [GRID, REPORT, ORBIT], [], [f"tasks[2] PerformOrbit: {LEFT}"]),
        (None, [ORBIT], None, [f"tasks[0] PerformOrbit: {AWAY}"]),
        (None, [("Transit", {}), go(4, 5), ORBIT], None, []),
        (
            None,
            [find("red buoy"), go(*HERE), HOLD, go(*HERE)],
            None,
            ["tasks[3] Transit: the vehicle is at [-99, -99] already"],
        ),
        (None, [find("red buoy"), find("pier"), go(*HERE), HOLD, go(*HERE)], None, []),
        (
            None,
            [go(4, 5), ("SurveyTarget", {"target_position": [4, 5]})],
            [],
            ["tasks[0] Transit: SurveyTarget goes to [4, 5] by itself"],
        ),
        (None, [go(4, 5), ("SurveyTarget", {"target_position": [4, 6]})], [], []),
        (None, [go(4, 5), go(4, 5)], [], ["tasks[1] Transit: the vehicle is at [4, 5] already"]),
        # The way home.
        (None, [go(0, 0), REPORT], None, []),
        (
            None,
            [go(0, 0), DOCK],
            None,
            ["tasks[0] Transit: a return that ends in DockingApproach is that task alone"],
        ),
        (None, [go(0, 0), REPORT, DOCK], None, []),
        (
            None,
            [go(0, 0), go(4, 5), HOLD],
            None,
            [f"tasks[1] Transit: {HOME}", f"tasks[2] KeepStation: {HOME}"],
        ),
        (None, [go(0, 0), go(4, 5), go(0, 0)], None, []),
        ("To [0, 0], then [4, 5].", [go(0, 0), go(4, 5)], None, []),
        (
            None,
            [REPORT],
            ["rule.return"],
            ["the tag rule.return needs a Transit to [0, 0] or a docking"],
        ),
        (
            None,
            [go(4, 5)],
            ["rule.return"],
            ["the tag rule.return needs a Transit to [0, 0] or a docking"],
        ),
        # Width by length, unless the sides are named.
        ("Sound 80 by 50 at [5, 5].", [area(80, 50)], None, []),
        (
            "Sound 80 x 50 at [5, 5].",
            [area(50, 80)],
            None,
            [f"tasks[0] BathymetryGridSurvey: {TURNED}"],
        ),
        (
            "Sound 80 times 50 at [5, 5].",
            [area(50, 80)],
            [],
            [f"tasks[0] BathymetryGridSurvey: {TURNED}"],
        ),
        ("Sound 80 and 50 at [5, 5].", [area(50, 80)], None, []),
        ("Sound 50 x 50 at [5, 5].", [area(50, 50)], None, []),
        ("Sound 80 by 50, 80 long, at [5, 5].", [area(50, 80)], None, []),
        ("Sound 70 by 50, 80 at [5, 5].", [area(50, 80)], None, []),
        # Values.
        (
            "Hold.",
            [HOLD],
            None,
            ["tasks[0] KeepStation, duration: 300 s does not follow from the command"],
        ),
        (None, [HOLD], [], []),
    ],
)
def test_every_problem_of_a_plan_is_said_once(
    prompt: str | None, tasks: Any, tags: list[str] | None, problems: list[str]
) -> None:
    found = rule_problems(plan(*tasks), USV, prompt, tags)
    assert len(found) == len(problems), found
    assert all(text.startswith(part) for part, text in zip(problems, found, strict=True)), found


def test_spelling_put_right_needs_the_tag_where_a_record_has_tags() -> None:
    expected = plan(find("green barrel"), SURVEY)
    prompt = "inspect teh grean barell"
    assert rule_problems(expected, USV, prompt) == []
    assert rule_problems(expected, USV, prompt, ["param.spelling"]) == []
    assert any("param.spelling" in text for text in rule_problems(expected, USV, prompt, []))


@pytest.mark.parametrize(
    ("tasks", "right"),
    [([HOLD], False), ([HOLD, go(0, 0)], True), ([("DockingApproach", {})], True)],
)
def test_a_tagged_return_is_a_way_home_or_a_docking(tasks: Any, right: bool) -> None:
    problems = rule_problems(plan(*tasks), USV, "Hold five minutes and come home.", ["rule.return"])
    assert any("the tag rule.return needs" in text for text in problems) != right


def test_an_exception_is_believed_by_its_tag_alone() -> None:
    expected = plan(go(18, 7), ("SurveyTarget", {"target_position": [18, 7]}))
    assert (
        rule_problems(expected, USV, "Proceed to [18, 7] and survey it.", ["rule.explicit-go"])
        == []
    )
    assert rule_problems(expected, USV, "Proceed to [18, 7] and survey it.", []) != []


@pytest.mark.parametrize(
    "broken",
    [
        None,
        [],
        {"tasks": 3},
        {
            "tasks": [
                1,
                {"title": 2},
                {"title": "Teleport"},
                {"title": "Transit", "parameters": [1]},
            ]
        },
    ],
)
def test_a_broken_plan_is_left_to_the_schema(broken: Any) -> None:
    assert rule_problems(broken, USV, "Go.") == []


def test_the_rules_hold_for_another_vehicle() -> None:
    drone = load_vocabulary("inspection_drone")
    at_place = next(task for task in drone.tasks if task.arrival == "transit")
    required = {
        parameter.name: list(drone.unresolved)
        for parameter in at_place.parameters
        if parameter.required
    }
    text = {
        parameter.name: "roof"
        for parameter in drone.task[drone.locate].parameters
        if parameter.type == "text"
    }
    problems = rule_problems(
        plan((drone.locate, text), (at_place.title, required)), drone, "Look at the roof."
    )
    assert any("does not arrive" in problem for problem in problems)
