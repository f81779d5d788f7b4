"""Copies of a mission sample with other values: command and plan change together."""

from __future__ import annotations

from random import Random
from typing import Any

import pytest

from planner_ft.data.varying import varied, with_heading, with_lost_words
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

DRONE = load_vocabulary("inspection_drone")


def record(prompt: str, *tasks: tuple[str, dict[str, Any], str]) -> dict[str, Any]:
    keys = ("title", "parameters", "task_prompt")
    plan = [dict(zip(keys, task, strict=True)) for task in tasks]
    return {
        "id": "one",
        "prompt": prompt,
        "expected": {"tasks": plan, "assumptions": [], "constraints": []},
    }


def copies(made: dict[str, Any], count: int = 12) -> list[dict[str, Any]]:
    found = [varied(made, DRONE, Random(seed)) for seed in range(count)]
    assert all(found)
    return found


def test_a_position_and_a_length_are_the_same_in_command_and_plan() -> None:
    tower = record(
        "Orbit the tower at [12, -40] 25 metres off.",
        ("FlyToPoint", {"target_position": [12, -40]}, "Fly to the tower at [12, -40]."),
        ("TowerOrbit", {"center": [12, -40], "radius": 25}, "Orbit [12, -40] at 25 m."),
    )
    seen = set()
    for copy in copies(tower):
        first, second = copy["expected"]["tasks"]
        (x, y), radius = first["parameters"]["target_position"], second["parameters"]["radius"]
        assert copy["prompt"] == f"Orbit the tower at [{x}, {y}] {radius} metres off."
        assert second["parameters"]["center"] == [x, y]
        assert second["task_prompt"] == f"Orbit [{x}, {y}] at {radius} m."
        assert not plan_problems("mission", copy["expected"], DRONE, strict=True)
        seen.add((x, y, radius))
    assert len(seen) > 6


def test_a_converted_value_is_converted_again() -> None:
    hover = record(
        "Hover here for 4 minutes.", ("HoverWatch", {"duration": 240}, "Hover for 240 seconds.")
    )
    for copy in copies(hover):
        seconds = copy["expected"]["tasks"][0]["parameters"]["duration"]
        assert copy["prompt"] == f"Hover here for {seconds // 60} minutes."
        assert copy["expected"]["tasks"][0]["task_prompt"] == f"Hover for {seconds} seconds."


def test_a_number_in_words_stays_in_words() -> None:
    hover = record(
        "Hover for twenty seconds.", ("HoverWatch", {"duration": 20}, "Hover for twenty seconds.")
    )
    prompts = {copy["prompt"] for copy in copies(hover)}
    assert "Hover for seven seconds." in prompts or "Hover for nine seconds." in prompts
    assert not any(sign.isdigit() for prompt in prompts for sign in prompt)


def test_a_thing_is_another_thing_everywhere() -> None:
    find = record(
        "Find the rusty ladder.",
        ("FindAsset", {"target_description": "rusty ladder"}, "Search for the rusty ladder."),
    )
    found = [copy for seed in range(20) if (copy := varied(find, DRONE, Random(seed)))]
    assert len(found) > 5
    for copy in found:
        task = copy["expected"]["tasks"][0]
        thing = task["parameters"]["target_description"]
        assert thing != "rusty ladder"
        assert copy["prompt"] == f"Find the {thing}."
        assert task["task_prompt"] == f"Search for the {thing}."


@pytest.mark.parametrize(
    ("prompt", "duration"),
    [
        ("Hover for a while.", 30),  # nobody said it
        ("Hover for half an hour.", 1800),  # no figure to change
        ("Hover until 14:30, 20 s at least.", 870),  # the plan's number comes from elsewhere
    ],
)
def test_what_cannot_be_changed_with_certainty_stays(prompt: str, duration: int) -> None:
    hover = record(prompt, ("HoverWatch", {"duration": duration}, "Hover."))
    assert not any(varied(hover, DRONE, Random(seed)) for seed in range(5))


def test_home_and_the_unresolved_place_stay() -> None:
    scan = record(
        "Scan the roof 30 by 40 m.",
        (
            "RoofScan",
            {"center": [-99, -99], "width": 30, "length": 40},
            "Scan it over 30 m by 40 m.",
        ),
    )
    for copy in copies(scan):
        assert copy["expected"]["tasks"][0]["parameters"]["center"] == [-99, -99]


def test_a_command_loses_words_but_nothing_that_its_plan_or_meaning_needs() -> None:
    find = record(
        "Please never search the harbour again for the rusty ladder at eleven.",
        ("FindAsset", {"target_description": "rusty ladder"}, "Search for the rusty ladder."),
    )
    found = [with_lost_words(find, Random(seed)) for seed in range(30)]
    prompts = {copy["prompt"] for copy in found if copy}
    assert len(prompts) > 6
    for words in ("never", "again", "rusty ladder", "eleven"):
        assert all(words in prompt for prompt in prompts)
    assert any("search" not in prompt for prompt in prompts)
    assert any("harbour" not in prompt for prompt in prompts)
    assert all(copy["expected"] is find["expected"] for copy in found if copy)


def test_a_command_loses_no_word_that_takes_a_part_of_it_back() -> None:
    for word in ("skip", "cancel", "omit"):
        find = record(
            f"Search the harbour for the rusty ladder and {word} the scheduled picture.",
            ("FindAsset", {"target_description": "rusty ladder"}, "Search for the rusty ladder."),
        )
        found = [with_lost_words(find, Random(seed)) for seed in range(30)]
        assert all(word in copy["prompt"] for copy in found if copy)


def test_a_command_of_few_words_loses_none() -> None:
    hover = record("Hover 20 s.", ("HoverWatch", {"duration": 20}, "Hover for 20 seconds."))
    assert with_lost_words(hover, Random(1)) is None


def test_a_heading_stands_before_the_command_and_leaves_the_plan() -> None:
    hover = record("Hover 20 s.", ("HoverWatch", {"duration": 20}, "Hover for 20 seconds."))
    headed = with_heading(hover, Random(1))
    heading, command = headed["prompt"].split(": ")
    assert command == "Hover 20 s."
    assert heading.split()[1].isdigit()
    assert headed["expected"] is hover["expected"]
