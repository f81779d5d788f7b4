"""One mission sample behind another, or at several places."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from planner_ft.data.recombining import FIRST as AHEAD
from planner_ft.data.recombining import LINKS, at_several, joined
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

DRONE = load_vocabulary("inspection_drone")
HOVER = ("HoverWatch", {"duration": 60}, "Hover for 60 seconds.")
HOME = ("FlyToPoint", {"target_position": [0, 0]}, "Fly home.")


def record(prompt: str, *tasks: tuple[str, dict[str, Any], str], rules: str = "") -> dict[str, Any]:
    keys = ("title", "parameters", "task_prompt")
    plan = [dict(zip(keys, task, strict=True)) for task in tasks]
    constraints = [rules] if rules else []
    expected = {"tasks": plan, "assumptions": [prompt], "constraints": constraints}
    return {"id": prompt, "prompt": prompt, "expected": expected}


def fly(x: float, y: float) -> tuple[str, dict[str, Any], str]:
    return ("FlyToPoint", {"target_position": [x, y]}, f"Fly to [{x}, {y}].")


FIRST = record("Fly to [40, 18].", fly(40, 18))
SECOND = record("Hover at [9, 3] for a minute.", fly(9, 3), HOVER)


@pytest.mark.parametrize("seed", range(12))
def test_the_second_plan_stands_behind_the_first_whatever_is_said_first(seed: int) -> None:
    made = joined(FIRST, SECOND, DRONE, Random(seed))
    assert made is not None
    assert [task["title"] for task in made["expected"]["tasks"]] == [
        "FlyToPoint",
        "FlyToPoint",
        "HoverWatch",
    ]
    assert made["expected"]["assumptions"] == [FIRST["prompt"], SECOND["prompt"]]
    texts = {
        f"Fly to [40, 18]{link}{'H' if link == '. ' else 'h'}over at [9, 3] for a minute."
        for link in LINKS
    }
    texts |= {f"Hover at [9, 3] for a minute{link}fly to [40, 18]." for link in AHEAD}
    assert made["prompt"] in texts
    assert not plan_problems("mission", made["expected"], DRONE, strict=True)


@pytest.mark.parametrize(
    ("first", "second"),
    [
        pytest.param(record("Fly home.", HOME), SECOND, id="the return comes last"),
        pytest.param(FIRST, record("Go to [40, 18].", fly(40, 18)), id="the same place twice"),
        pytest.param(FIRST, record("Paint it.", rules="No task for that."), id="nothing to do"),
        pytest.param(
            record("Fly to [1, 1], no report.", fly(1, 1), rules="No report."),
            SECOND,
            id="a rule for the whole command",
        ),
    ],
)
def test_samples_that_do_not_go_together_are_not_joined(
    first: dict[str, Any], second: dict[str, Any]
) -> None:
    assert all(joined(first, second, DRONE, Random(seed)) is None for seed in range(8))


@pytest.mark.parametrize("seed", range(6))
def test_the_same_is_done_at_every_place_in_the_order_of_the_command(seed: int) -> None:
    made = at_several(SECOND_ALONE, DRONE, Random(seed))
    assert made is not None
    places = [task["parameters"]["target_position"] for task in made["expected"]["tasks"][::2]]
    holds = made["expected"]["tasks"][1::2]
    assert 2 <= len(places) <= 4
    assert places[0] == [9, 3]
    assert [made["prompt"].index(str(place)) for place in places] == sorted(
        made["prompt"].index(str(place)) for place in places
    )
    assert {task["title"] for task in holds} == {"HoverWatch"}
    assert [task["task_prompt"] for task in made["expected"]["tasks"][::2]] == [
        f"Fly to {place}." for place in places
    ]
    assert not plan_problems("mission", made["expected"], DRONE, strict=True)


SECOND_ALONE = {**SECOND, "expected": {**SECOND["expected"], "assumptions": []}}


@pytest.mark.parametrize(
    "one",
    [
        pytest.param(SECOND, id="an assumption"),
        pytest.param(record("Fly home.", HOME), id="no place"),
        pytest.param(record("[1, 2], then [3, 4].", fly(1, 2), fly(3, 4)), id="two places"),
    ],
)
def test_other_plans_stay_at_their_places(one: dict[str, Any]) -> None:
    assert at_several(one, DRONE, Random(1)) is None
