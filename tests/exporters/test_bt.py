"""Plans as behaviour trees: valid, complete, and run as the plan says."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from lxml import etree

from planner_ft.exporters import DRAFT, PlanExport, load_format

from .bt_reader import Runner, numbers, read
from .plans import BUOY, DRONE, MAST, USV, document, documents, step, task

SEARCH = step(
    "StationKeep",
    {"time": 30},
    filters=[("ObstacleAvoidance", {"min_distance": 5})],
    perception=[("DetectObjects", {"class_list": ["buoy"]}), ("CaptureGeoSnapshot", {})],
    stop_conditions=["buoy seen"],
    failure_modes=["position lost", "margin violated"],
    expected_outputs=["detections", "a sketch"],
)
ONE_STEP = [task("SearchAndDetect", {"target_description": "buoy"}, [SEARCH])]


def tree(
    plan: dict[str, Any], vocabulary: Any = USV, approval: str | None = "approved by Ada"
) -> Any:
    return read(load_format("bt").write(PlanExport(plan, vocabulary, None, approval)).text)


def run(answers: dict[str, Any], tasks: list[dict[str, Any]] = ONE_STEP) -> tuple[str, list[str]]:
    """How a plan ends and which leaves began, when leaves answer so; a list is answered tick by
    tick, all else succeeds at once.
    """

    def answer(name: str, _ports: dict[str, str]) -> str:
        given = answers.get(name, "S")
        return (
            str(given)
            if isinstance(given, str)
            else str(given.pop(0))
            if len(given) > 1
            else str(given[0])
        )

    runner = Runner(tree(document(tasks)), answer)
    return runner.run(), runner.done


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_every_skill_comes_back_with_its_parameters(vocabulary: Any) -> None:
    @settings(max_examples=30, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary))
    def check(plan: dict[str, Any]) -> None:
        plan_export = PlanExport(plan, vocabulary)
        written = load_format("bt").write(plan_export)
        trees = {found.get("ID"): found for found in read(written.text).findall("BehaviorTree")}
        for index, entry in enumerate(plan["tasks"]):
            found = [
                node
                for node in trees[f"{entry['id']}_{entry['title']}"].iter()
                if node.tag in vocabulary.skill
            ]
            said = [
                (key, number, skill)
                for number, one in enumerate(entry["skill_sequence"] or ())
                for key, skill in [
                    *(
                        (("filter_skills", n), skill)
                        for n, skill in enumerate(one["filter_skills"])
                    ),
                    *(
                        (("perception_skills", n), skill)
                        for n, skill in enumerate(one["perception_skills"])
                    ),
                    (("navigation_skill",), one["navigation_skill"]),
                ]
            ]
            assert [node.tag for node in found] == [skill["name"] for _key, _number, skill in said]
            for node, (key, number, skill) in zip(found, said, strict=True):
                for name, value in skill["parameters"].items():
                    path = ("tasks", index, "skill_sequence", number, *key, "parameters", name)
                    assert (
                        path in written.account.changed_paths
                        or back(node.get(name), vocabulary.skill[skill["name"]].by_name[name].type)
                        == value
                    )

    check()


def back(text: str, kind: str) -> Any:
    """A parameter's value from its attribute."""
    if kind in ("number", "integer"):
        return float(text)
    if kind == "position":
        return numbers(text)
    if kind == "polygon":
        flat = numbers(text)
        return [list(pair) for pair in zip(flat[::2], flat[1::2], strict=True)]
    if kind == "texts":
        return (
            json.loads(text.removeprefix("json:")) if text.startswith("json:") else text.split(";")
        )
    return text


def test_the_words_of_conditions_failures_and_prompts_are_attributes() -> None:
    root = tree(
        document(
            [
                task(
                    "KeepStation",
                    {"duration": 90},
                    [SEARCH],
                    'Hold "here" <now> & wait\nthere -- please',
                )
            ]
        )
    )
    assert root.find(".//SubTree").get("task_prompt") == 'Hold "here" <now> & wait\nthere -- please'
    assert root.find(".//SubTree").get("duration") == "90"
    assert [node.get("text") for node in root.iter("StopCondition")] == ["buoy seen"]
    assert [node.get("mode") for node in root.iter("HandleFailure")] == [
        "position lost",
        "margin violated",
    ]
    assert [node.get("text") for node in root.iter("ReportOutput")] == ["a sketch"]
    assert root.find(".//DetectObjects[@class_list]").get("detections") == "{detections}"


def test_a_text_in_braces_is_no_blackboard_entry() -> None:
    written = load_format("bt").write(
        PlanExport(
            document(
                [task("Diagnostics", {}, [step("StationKeep", stop_conditions=["{x}", "="])])]
            ),
            USV,
        )
    )
    assert [node.get("text") for node in read(written.text).iter("StopCondition")] == ["(x)", "(=)"]
    assert [loss.what for loss in written.account.changed if "braces" in loss.why] == [
        "stop condition: {x} (step 1); stop condition: = (step 1)"
    ]


def test_a_list_whose_entries_hold_semicolons_is_json() -> None:
    lists = [["a", "b"], ["a; b", "c"], ["json:x"]]
    steps = [
        step("StationKeep", perception=[("DetectObjects", {"class_list": names})])
        for names in lists
    ]
    found = [
        node.get("class_list")
        for node in tree(document([task("Diagnostics", {}, steps)])).iter("DetectObjects")
        if node.get("class_list")
    ]
    assert found == ["a;b", 'json:["a; b", "c"]', 'json:["json:x"]']


@pytest.mark.parametrize("steps", [None, ONE_STEP[0]["skill_sequence"]], ids=["open", "planned"])
def test_whole_numbers_have_no_point_where_the_port_is_of_whole_numbers(steps: Any) -> None:
    plan = document([task("HorizontalPanorama", {"sectors": 5.0}, steps)])
    text = load_format("bt").write(PlanExport(plan, USV)).text
    assert 'sectors="5"' in text and 'sectors="5.0"' not in text


def test_what_is_said_of_the_plan_stands_in_comments() -> None:
    plan = document(
        MAST,
        command="Go -- now -->",
        assumptions=["calm sea -"],
        constraints=["before dark"],
        warnings=[("t1", "far out")],
    )
    text = " ".join(str(comment.text) for comment in tree(plan).iter(etree.Comment))
    assert all(
        said in text
        for said in (
            "command: Go - - now - ->",
            "assumption: calm sea -",
            "constraint: before dark",
            "warning: far out",
            "approved by Ada",
        )
    )


def test_a_draft_is_called_one_where_the_tree_begins() -> None:
    root = tree(document(MAST), approval=None)
    assert root.get("main_tree_to_execute").startswith("DRAFT_NOT_APPROVED_plan_")
    assert root.find("BehaviorTree/Sequence").get("name").startswith(DRAFT)


@pytest.mark.parametrize(
    ("answers", "ending", "began"),
    [
        ({"StationKeep": ["R", "R", "S"], "ObstacleAvoidance": "R"}, "S", []),
        ({"StationKeep": ["R", "R", "S"], "DetectObjects": "F"}, "S", []),
        ({"StationKeep": "R", "StopCondition": ["F", "F", "S"]}, "S", []),
        ({"StationKeep": ["R", "F"]}, "S", ["HandleFailure"]),
        (
            {"StationKeep": ["R", "F"], "HandleFailure": ["F", "S"]},
            "S",
            ["HandleFailure", "HandleFailure"],
        ),
        (
            {"StationKeep": "R", "ObstacleAvoidance": ["R", "F"], "HandleFailure": "F"},
            "F",
            ["HandleFailure", "HandleFailure"],
        ),
    ],
    ids=[
        "movement ends",
        "perception may fail",
        "stop condition",
        "movement fails",
        "second handler",
        "filter fails",
    ],
)
def test_what_ends_a_step(answers: dict[str, Any], ending: str, began: list[str]) -> None:
    answered, done = run({"StopCondition": "F", **answers})
    assert answered == ending
    assert [name for name in done if name == "HandleFailure"] == began
    assert ("ReportOutput" in done) == (ending == "S")


def test_beside_a_movement_perception_is_done_once_and_filters_are_asked_again() -> None:
    _ending, done = run({"StopCondition": "F", "StationKeep": ["R", "R", "R", "S"]})
    assert done.count("DetectObjects") == done.count("CaptureGeoSnapshot") == 1
    assert done.count("ObstacleAvoidance") == 4


def test_a_stop_condition_is_asked_after_its_movement_began() -> None:
    """What held at the end of the step before must not end the next one."""
    _ending, done = run({"StopCondition": "S", "StationKeep": "R"})
    assert done.index("StopCondition") > done.index("StationKeep")


def test_a_search_puts_an_open_place_on_the_blackboard() -> None:
    written = load_format("bt").write(PlanExport(document(BUOY), USV))
    root = read(written.text)
    trees = {found.get("ID"): found for found in root.findall("BehaviorTree")}
    locate = trees["t1_SearchAndDetect"].find(".//LocatePlace")
    assert dict(locate.attrib) == {"place": "green buoy", "position": "{green_buoy}"}
    assert trees["t2_Transit"].find(".//PlanTransit").get("target_position") == "{green_buoy}"
    orbit = trees["t3_PerformOrbit"].find(".//PlanPerformOrbit")
    assert dict(orbit.attrib) == {
        "center": "{green_buoy}",
        "radius": "12",
        "task_prompt": "Circle the green buoy.",
    }
    remapped = {
        node.get("ID"): node.get("green_buoy") for node in root.find("BehaviorTree").iter("SubTree")
    }
    assert remapped == {
        "t1_SearchAndDetect": "{green_buoy}",
        "t2_Transit": "{green_buoy}",
        "t3_PerformOrbit": "{green_buoy}",
        "t4_Transit": None,
    }
    assert run({"StopCondition": "F"}, BUOY) == (
        "S",
        [
            "DetectObjects",
            "StationKeep",
            "LocatePlace",
            "PlanTransit",
            "PlanPerformOrbit",
            "GoToXY",
        ],
    )
    assert run({"StopCondition": "F", "LocatePlace": "F"}, BUOY)[1][-1] == "LocatePlace"
    assert not written.account.lost


def test_a_place_that_nothing_searches_is_asked_for_before_the_task_that_needs_it() -> None:
    dock = task("DockingApproach", {"goal_position": [-99, -99]}, None, "Dock at the west berth.")
    assert run({}, [*MAST[3:], dock])[1] == ["GoToXY", "LocatePlace", "PlanDockingApproach"]


def test_a_place_is_not_called_as_a_port_is() -> None:
    search, *others = BUOY
    named = [
        {**search, "parameters": {"target_description": "detections"}},
        *({**entry, "task_prompt": "Go there."} for entry in others),
    ]
    assert tree(document(named)).find(".//LocatePlace").get("position") == "{detections_2}"


def test_the_model_lists_the_vocabularys_skills_with_their_ports() -> None:
    model = tree(document(MAST)).find("TreeNodesModel")
    assert {skill.name for skill in USV.skills} < {leaf.get("ID") for leaf in model}
    go = model.find("Action[@ID='GoToXY']")
    assert [
        (port.get("name"), port.get("type"), port.text) for port in go.findall("input_port")
    ] == [
        ("x", "double", "east, m"),
        ("y", "double", "north, m"),
        ("yaw", "double", "heading on arrival, deg"),
    ]
    assert go.find("description").text == "Navigates to given coordinates"
    assert model.find("Condition").get("ID") == "StopCondition"


def test_names_that_the_library_or_another_node_has_are_changed() -> None:
    sleep = replace(
        USV.skill["StationKeep"],
        name="Sleep",
        parameters=(replace(USV.skill["StationKeep"].parameters[0], name="name"),),
    )
    odd = replace(USV.skill["StationKeep"], name="Keep here/now", parameters=())
    vocabulary = replace(USV, skills=(*USV.skills, sleep, odd))
    plan = document([task("Diagnostics", {}, [step("Sleep", {"name": 5}), step("Keep here/now")])])
    root = tree(plan, vocabulary)
    assert [dict(node.attrib) for node in root.iter("Sleep_2")] == [{"name_2": "5"}]
    assert len(list(root.iter("Keep_here_now"))) == 1


def test_a_plan_without_tasks_is_a_tree() -> None:
    assert run({}, []) == ("S", [])
