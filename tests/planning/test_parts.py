"""A long command is planned in parts where the plan of the whole has lost more."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import pytest

from planner_ft.confidence.calibration import Judgement
from planner_ft.document.losses import lost
from planner_ft.planning.parts import MOST_WORDS, joined, parts_of
from planner_ft.planning.planner import Planner
from planner_ft.planning.result import Answer
from planner_ft.planning.settings import PlanSettings
from planner_ft.vocabulary import load_vocabulary
from tests.planning.conftest import Known, said, task

USV = load_vocabulary()
LONG = (
    "Go to 10,20 and hold position there for five minutes, so that everybody who waits ashore has the "
    "time to see you. Then go to 30,40 and hold position there for two minutes, so that the others "
    "see you, too."
)


def mission(*tasks: dict[str, Any]) -> dict[str, Any]:
    return {"tasks": [*tasks], "assumptions": [], "constraints": []}


def hold(x: int, y: int, seconds: int) -> list[dict[str, Any]]:
    return [
        task("Transit", f"Go to [{x}, {y}].", target_position=[x, y]),
        task("KeepStation", f"Hold position at [{x}, {y}].", duration=seconds),
    ]


FIRST, SECOND = hold(10, 20, 300), hold(30, 40, 120)


def test_sentences_with_few_words_stay_together() -> None:
    assert parts_of("Go home. Hold there.\nDive at 0.5 m/s; wait!") == [
        "Go home. Hold there. Dive at 0.5 m/s; wait!"
    ]
    parts = parts_of(LONG)
    assert len(parts) == 2 and " ".join(parts) == LONG
    one = " ".join(["word"] * (2 * MOST_WORDS))
    assert parts_of(f"{one}. {one}.") == [f"{one}.", f"{one}."]
    assert parts_of("") == []


@pytest.mark.parametrize(
    ("whole", "parts", "taken"),
    [
        (FIRST, [FIRST, SECOND], "parts"),
        ([*FIRST, *SECOND], [FIRST, FIRST], "whole"),  # nothing lost: no part is asked for
        (FIRST, [FIRST, FIRST], "whole"),  # nothing found
        (FIRST, [FIRST, SECOND * 9], "whole"),  # more than what was lost can be
        (FIRST, [FIRST, "no plan"], "whole"),
    ],
)
def test_the_plan_that_has_lost_less_is_taken(
    known: Known, whole: list[Any], parts: list[Any], taken: str
) -> None:
    plans = [one if isinstance(one, str) else mission(*one) for one in (whole, *parts)]
    known().texts["mission"] = list(map(said, plans))
    settings = PlanSettings(configuration="base", mission_only=True)
    planned = Planner(settings, lost=lost).plan(LONG)
    titles = [(one.title, one.parameters) for one in planned.tasks]
    wanted = [*FIRST, *SECOND] if taken == "parts" or whole == [*FIRST, *SECOND] else FIRST
    assert titles == [(one["title"], one["parameters"]) for one in wanted]
    assert any("in 2 parts" in note for note in planned.mission.notes) is (taken == "parts")
    asked = 1 if whole == [*FIRST, *SECOND] else 3
    assert planned.mission.forward_passes == 6 * asked


def test_without_a_judge_the_plan_of_the_whole_stands(known: Known) -> None:
    known(mission(*FIRST))
    planner = Planner(PlanSettings(configuration="base", mission_only=True))
    assert planner.plan(LONG).mission.forward_passes == 6


def test_answers_are_joined_with_their_costs_and_what_they_are_sure_of() -> None:
    plans = [mission(*FIRST), {**mission(*SECOND), "assumptions": ["Home is [0, 0]."]}]
    sure = Judgement("", {(): 0.9, ("tasks", 1): 0.8, ("tasks", 1, "title"): 0.7})
    given = [Answer("", plan, (), (), 5, 10, 6, 0.5, judged=sure) for plan in plans]
    one = joined([*given, given[1]], USV)
    assert one.plan and len(one.plan["tasks"]) == 5  # no way to [30, 40] from there
    assert one.plan["assumptions"] == ["Home is [0, 0]."]
    assert (one.prompt_tokens, one.tokens, one.forward_passes, one.seconds) == (15, 30, 18, 1.5)
    assert one.judged.parts[()] == pytest.approx(0.9**3)
    assert one.judged.parts["tasks", 3, "title"] == 0.7 and ("tasks", 2) not in one.judged.parts
    unclear = replace(given[1], judged=Judgement("no calibration"))
    unknown = joined([given[0], unclear], USV)
    assert unknown.judged.reason == "no calibration" and not unknown.judged.parts


def test_a_plan_that_has_all_of_a_command_has_lost_nothing() -> None:
    assert lost(LONG, mission(*FIRST, *SECOND), USV) == 0
    assert lost(LONG, mission(*FIRST), USV) > 0


def test_parts_lead_nowhere_where_the_vehicle_is() -> None:
    home = [task("Transit", "Return home to [0, 0].", target_position=[0, 0])]
    sure = Judgement("", {(): 0.5, ("tasks", 0): 0.8, ("tasks", 0, "title"): 0.7})
    given = [
        Answer("", mission(*tasks), (), (), 1, 1, 1, 0.1, judged=sure)
        for tasks in (home, FIRST, FIRST, [*SECOND, *home], home)
    ]
    one = joined(given, USV)
    places = [task["parameters"].get("target_position") for task in (one.plan or {})["tasks"]]
    assert places == [[10, 20], None, None, [30, 40], None, [0, 0]]
    assert [path for path in one.judged.parts if len(path) == 2] == [("tasks", 0), ("tasks", 3)]
