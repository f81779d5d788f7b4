"""Which tokens belong to which part of a plan."""

from __future__ import annotations

import json
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner_ft.confidence.parts import Choice, Choices, parts, spans

MISSION = (
    '{"tasks":[{"title":"Transit","parameters":{"target_position":[4,-2]},"task_prompt":"Go."},'
    ' {"title":"PerformOrbit","parameters":{"center":[4,-2],"radius":12},"task_prompt":"Circle."}],'
    '"assumptions":["Home is [0, 0]."],"constraints":[]}'
)
SKILLS = (
    '{"skill_sequence":[{"navigation_skill":{"name":"GoToXY","parameters":{"x":4,"y":-2}},'
    '"filter_skills":[],"perception_skills":[{"name":"GetSeabedDepth","parameters":{}}],'
    '"stop_conditions":["There."],"failure_modes":[],"expected_outputs":[]}]}'
)


def letters(text: str, unlikely: str = "") -> Choices:
    """A token per letter; those of `unlikely` were hardly chosen."""
    at = text.index(unlikely) if unlikely else -1
    doubtful = range(at, at + len(unlikely))
    return tuple(
        Choice(
            1, -3.0 if place in doubtful else -0.001, (("?", -1.0 if place in doubtful else -9.0),)
        )
        for place in range(len(text))
    )


def test_the_parts_of_a_mission() -> None:
    found = parts("mission", MISSION, letters(MISSION))
    assert [part.kind for part in found if part.path[:2] != ("tasks", 1)] == [
        *("plan", "entry", "value", "value")
    ]
    assert [part.path for part in found if part.path[:2] == ("tasks", 1)] == [
        ("tasks", 1),
        ("tasks", 1, "title"),
        ("tasks", 1, "parameters", "center"),
        ("tasks", 1, "parameters", "radius"),
    ]


def test_the_parts_of_a_skill_sequence() -> None:
    paths = [part.path for part in parts("task", SKILLS, letters(SKILLS)) if part.kind == "entry"]
    step = ("skill_sequence", 0)
    assert paths == [(*step, "navigation_skill"), (*step, "perception_skills", 0)]


@pytest.mark.parametrize(
    ("unlikely", "doubted"),
    [
        ("12", {(), ("tasks", 1), ("tasks", 1, "parameters", "radius")}),
        ("Orbit", {(), ("tasks", 1), ("tasks", 1, "title")}),
        ('"center"', {(), ("tasks", 1), ("tasks", 1, "parameters", "center")}),
        ("Circle", set()),
        ("Home", set()),
        ("}]", {()}),
    ],
)
def test_a_doubt_is_that_of_its_parts(unlikely: str, doubted: set[tuple[Any, ...]]) -> None:
    found = parts("mission", MISSION, letters(MISSION, unlikely))
    assert {part.path for part in found if part.features()["lowest"] < -1} == doubted
    assert {part.path for part in found if part.features()["overruled"]} == doubted


VALUES = st.recursive(
    st.none() | st.booleans() | st.integers() | st.text(max_size=4),
    lambda inner: (
        st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=3), inner, max_size=3)
    ),
)


@given(VALUES, st.sampled_from([None, 1]))
def test_every_value_is_found_where_it_stands(value: Any, indent: int | None) -> None:
    text = json.dumps(value, indent=indent)
    for path, span in spans(text).items():
        wanted = value
        for key in path:
            wanted = wanted[key]
        assert json.loads(text[span.start : span.end]) == wanted
