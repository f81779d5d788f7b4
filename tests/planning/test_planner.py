"""What planning makes of the agents' answers: places, skills, validity, costs, and the JSON
form.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import jsonschema
import pytest

from planner_ft.confidence.calibration import NO_LOGPROBS
from planner_ft.document import build
from planner_ft.document.tree import plan_tree
from planner_ft.planning.locations import KEPT_CLEAR
from planner_ft.planning.planner import Planner, SkillsKnown, TasksKnown
from planner_ft.planning.result import Planned
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary import load_vocabulary

from .conftest import FIND_AND_ORBIT, HOLD, SKILLS, mission, task

if TYPE_CHECKING:
    from .conftest import Known

COMMAND = "Find the green buoy, circle it at 12 m, come home."
SCHEMA = jsonschema.Draft202012Validator(
    read_json(Path(__file__).parents[2] / "schemas" / "plan.schema.json")
)


def as_json(planned: Planned) -> dict[str, Any]:
    value = build(planned, load_vocabulary())
    SCHEMA.validate(value)
    return value


def test_tasks_at_an_open_place_wait_and_the_others_get_their_skills(known: Known) -> None:
    engine = known()
    planned = Planner.load(configuration="base").plan(COMMAND)
    assert [record.get("task", "mission") for _level, record in engine.asked] == [
        "mission",
        "SearchAndDetect",
        "Transit",
    ]
    assert engine.asked[0] == ("mission", {"prompt": COMMAND})
    assert engine.asked[2] == (
        "task",
        {"task": "Transit", "parameters": {"target_position": [0, 0]}, "prompt": "Return home."},
    )
    value = as_json(planned)
    assert value["open_places"] == [{"name": "green buoy", "tasks": [2, 3]}]
    assert (value["valid"], value["complete"]) == (True, False)
    assert [entry["skill_sequence"] for entry in value["tasks"]] == [[HOLD], None, None, [HOLD]]
    assert [entry.get("waits_for") for entry in value["tasks"]] == [
        None,
        "green buoy",
        "green buoy",
        None,
    ]


def test_places_are_filled_in_before_the_task_agent_is_asked(known: Known) -> None:
    engine = known()
    planned = Planner.load(configuration="base").plan(COMMAND, {"the green buoy": (120.0, -35.0)})
    assert engine.asked[2][1]["parameters"] == {"target_position": [120, -35]}
    vehicles = {"arc": 360}
    assert engine.asked[3][1]["parameters"] == {"center": [120, -35], "radius": 12, **vehicles}
    value = as_json(planned)
    assert (
        value["complete"]
        and value["open_places"] == []
        and value["located"] == {"green buoy": [120, -35]}
    )
    assert "Located: green buoy at [120,-35]" in plan_tree(as_json(planned))


def test_a_location_that_the_plan_does_not_leave_open_is_a_note_and_the_others_are_used(
    known: Known,
) -> None:
    known()
    planned = Planner.load(configuration="base").plan(
        COMMAND, {"lighthouse": (1.0, 2.0), "buoy": (120.0, -35.0), "green buoy": (3.0, 4.0)}
    )
    value = as_json(planned)
    assert value["located"] == {"green buoy": [3, 4]} and value["complete"]
    assert value["assumptions"][-2:] == [
        'Not used for a task: --locate lighthouse: no such place is open; there is "green buoy".'
        + KEPT_CLEAR,
        'Not used for a task: --locate buoy: "green buoy" is located by "green buoy" already; leave'
        " one of them out." + KEPT_CLEAR,
    ]


def test_who_watches_hears_of_the_tasks_before_any_skills_and_of_the_skills_one_by_one(
    known: Known,
) -> None:
    engine = known()
    heard: list[tuple[int, TasksKnown | SkillsKnown]] = []
    planned = Planner.load(configuration="base").plan(
        COMMAND, on_event=lambda event: heard.append((len(engine.asked), event))
    )
    (asked, tasks), *skills = heard
    assert asked == 1 and isinstance(tasks, TasksKnown)
    assert [(task.title, task.waits_for) for task in tasks.tasks] == [
        (task.title, task.waits_for) for task in planned.tasks
    ]
    assert all(task.answer is None for task in tasks.tasks)
    assert skills == [
        (2, SkillsKnown(1, planned.tasks[0].answer)),
        (3, SkillsKnown(4, planned.tasks[3].answer)),
    ]


def test_what_a_watcher_raises_ends_planning(known: Known) -> None:
    engine = known()

    def stop(_event: object) -> None:
        raise InterruptedError

    with pytest.raises(InterruptedError):
        Planner.load(configuration="base").plan(COMMAND, on_event=stop)
    assert len(engine.asked) == 1


def test_the_skills_of_one_task_are_asked_for_alone(known: Known) -> None:
    engine = known()
    answer = Planner.load(configuration="base").skills(FIND_AND_ORBIT["tasks"][3])
    assert answer.plan == SKILLS
    assert engine.asked == [
        (
            "task",
            {
                "task": "Transit",
                "parameters": {"target_position": [0, 0]},
                "prompt": "Return home.",
            },
        )
    ]


def test_no_skills_for_a_task_at_an_open_place_or_without_a_task_agent(known: Known) -> None:
    engine = known()
    with pytest.raises(
        PlannerError, match=r"Transit: its place is open, .*; say where it is first"
    ):
        Planner.load(configuration="base").skills(FIND_AND_ORBIT["tasks"][1])
    with pytest.raises(PlannerError, match="there is no Task Agent with --mission-only"):
        Planner.load(configuration="base", mission_only=True).skills(FIND_AND_ORBIT["tasks"][3])
    assert engine.asked == []


def test_costs_are_summed_per_agent(known: Known) -> None:
    known()
    usage = as_json(Planner.load(configuration="base").plan(COMMAND))["usage"]
    assert (
        usage["mission"]["queries"],
        usage["mission"]["tokens"],
        usage["mission"]["forward_passes"],
        usage["mission"]["seconds"],
    ) == (1, 10, 6, 0.25)
    assert (
        usage["task"]["queries"],
        usage["task"]["tokens"],
        usage["task"]["forward_passes"],
        usage["task"]["seconds"],
    ) == (2, 20, 12, 0.5)
    assert usage["mission"]["prompt_tokens"] == 3 and usage["mission"]["adapter"] is None


def test_notes_of_the_constraint_are_assumptions(known: Known) -> None:
    known(notes=("The height of 'a bit' is not known.",))
    planned = Planner.load(configuration="base").plan(COMMAND)
    value = as_json(planned)
    assert value["assumptions"] == ["Home is [0, 0].", "The height of 'a bit' is not known."]
    assert value["tasks"][0]["assumptions"] == ["The height of 'a bit' is not known."]
    assert " - The height of 'a bit' is not known." in plan_tree(as_json(planned))


def test_a_plan_that_was_led_to_its_end_at_the_limit_says_so(known: Known) -> None:
    known(cut=True)
    value = as_json(Planner.load(configuration="base").plan(COMMAND))
    assert (
        value["valid"]
        and "met its limit of tokens and was ended after 10" in value["assumptions"][-1]
    )


@pytest.mark.parametrize(
    ("answer", "generation", "problem"),
    [
        ('{"tasks": [', {}, "not JSON"),
        (mission(task("Teleport", "Go.")), {}, "'Teleport' is no task title of the vocabulary"),
        (mission(task("Transit", "Go.")), {}, "Transit needs target_position"),
        ('{"tasks": [', {"finish_reason": "length"}, "cut at the limit of 10 tokens"),
    ],
)
def test_a_mission_answer_that_is_not_valid_is_shown_with_its_problems(
    known: Known, answer: Any, generation: dict[str, Any], problem: str
) -> None:
    engine = known(answer, **generation)
    planned = Planner.load(configuration="base").plan(COMMAND, {"green buoy": (1.0, 2.0)})
    value = as_json(planned)
    assert not planned.valid and value["tasks"] == [] and len(engine.asked) == 1
    assert any(problem in text for text in value["problems"])
    assert value["output"] == planned.mission.text
    assert "the Mission Agent's answer is not a valid plan: " in plan_tree(
        as_json(planned)
    ) and problem in plan_tree(as_json(planned))


def test_a_task_answer_that_is_not_valid_is_shown_and_the_others_are_kept(known: Known) -> None:
    known(FIND_AND_ORBIT, SKILLS, "no JSON at all " * 100)
    planned = Planner.load(configuration="base").plan(COMMAND)
    value = as_json(planned)
    assert not value["valid"] and value["tasks"][0]["skill_sequence"] == [HOLD]
    assert value["tasks"][3]["skill_sequence"] is None and value["tasks"][3]["output"].startswith(
        "no JSON at all"
    )
    assert (
        "(1500 characters; --json prints all)" in plan_tree(as_json(planned))
        and len(plan_tree(as_json(planned))) < 3000
    )


def test_a_command_that_nothing_can_be_done_about_gives_a_plan_without_tasks(known: Known) -> None:
    known({"tasks": [], "assumptions": [], "constraints": ["The vehicle cannot fly."]})
    planned = Planner.load(configuration="base").plan("Fly over the pier.")
    assert as_json(planned)[
        "complete"
    ] and "no tasks\nConstraints:\n - The vehicle cannot fly." in plan_tree(as_json(planned))


def test_the_mission_agent_alone_gives_tasks_without_skills(known: Known) -> None:
    engine = known()
    planned = Planner.load(configuration="base", mission_only=True).plan(COMMAND)
    value = as_json(planned)
    assert len(engine.asked) == 1 and list(value["usage"]) == ["mission"]
    assert value["valid"] and not value["complete"]
    assert (
        all(entry["skill_sequence"] is None for entry in value["tasks"])
        and "waits_for" not in value["tasks"][0]
    )


def test_the_tree_shows_steps_places_costs_and_that_no_adapter_is_used(known: Known) -> None:
    known()
    assert plan_tree(as_json(Planner.load(configuration="base").plan(COMMAND))).startswith(
        f"""{COMMAND}
How sure: not known (Mission Agent: {NO_LOGPROBS})
 1 SearchAndDetect(target_description="green buoy")
   Find the green buoy.
    1. StationKeep(time=30) + DetectObjects(class_list=["buoy"])
 2 Transit(target_position=[-99,-99])
   Go to the green buoy once it is found.
   (skills wait for the position of green buoy)
"""
    )
    tree = plan_tree(as_json(Planner.load(configuration="base").plan(COMMAND)))
    assert 'Open places (fill in with --locate "NAME=x,y"):\n - green buoy: tasks 2, 3\n' in tree
    assert (
        "Mission Agent  embedded base, no adapter: 1 answer, 10 tokens, 6 forward passes, 0.25 s"
        in tree
    )
    assert (
        "Task Agent  embedded base, no adapter: 2 answers, 20 tokens, 12 forward passes, 0.50 s"
        in tree
    )


def test_no_control_character_of_a_command_reaches_a_terminal(known: Known) -> None:
    known()
    tree = plan_tree(as_json(Planner.load(configuration="base").plan("Go\x1b[2J home\r\nat once")))
    assert tree.startswith("Go\\u001b[2J home\\r\\nat once\n")


@pytest.mark.parametrize(
    ("command", "message"), [(" \n", "the command is empty"), ("go \udcff", "not UTF-8 text")]
)
def test_a_command_that_is_none_is_refused(known: Known, command: str, message: str) -> None:
    known()
    with pytest.raises(PlannerError, match=message):
        Planner.load(configuration="base").plan(command)


def test_a_command_that_the_model_cannot_hold_is_refused_in_one_sentence(known: Known) -> None:
    known(
        "",
        ids=(),
        finish_reason="error",
        error="the prompt of 9000 tokens leaves no room in the model's context of 4096",
    )
    with pytest.raises(
        PlannerError,
        match=r"^embedded: the prompt of 9000 tokens leaves no room .*; shorten the command",
    ):
        Planner.load(configuration="base").plan("go " * 9000)


def test_the_manifest_says_what_the_plan_depended_on(known: Known) -> None:
    known()
    manifest = as_json(Planner.load(configuration="base").plan(COMMAND))["manifest"]
    assert manifest["kind"] == "plan" and manifest["device"] and manifest["versions"]["torch"]
    assert (
        manifest["configuration"]["vocabulary"]["name"] == "usv"
        and len(manifest["configuration"]["vocabulary"]["sha256"]) == 64
    )
    for agent in manifest["agents"].values():
        assert (
            agent["candidate"],
            agent["configuration"],
            agent["adapter"],
            agent["quantization"],
        ) == ("embedded", "base", None, "nf4")
        assert len(agent["weights_sha256"]) == 64 and agent["vocabulary_in_the_prompt"] is False
