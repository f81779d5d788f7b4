"""plan_problems and the JSON Schemas are the same rules; the canonical form is one."""

from __future__ import annotations

import functools
import json
import math
import sys
from typing import Any

import jsonschema
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Parameter, Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import Skill, Task
from planner_ft.vocabulary.plans import (
    Level,
    canonical_plan,
    check_level,
    plan_names,
    plan_problems,
    task_problems,
    value_problem,
    without_working,
)
from planner_ft.vocabulary.schema import plan_schema

USV, DRONE = load_vocabulary(), load_vocabulary("inspection_drone")
NUMBER = st.one_of(
    st.integers(-1000, 1000),
    st.floats(-1000, 1000, allow_nan=False),
    st.sampled_from([0, 360, 1e6, 10**30]),
)
POSITION = st.lists(NUMBER, min_size=2, max_size=2)
TEXT = st.sampled_from(["buoy", "x", "", " ", "\u2003", "\x1c", "Sierra 2"])
JUNK = st.one_of(
    st.none(),
    st.booleans(),
    NUMBER,
    TEXT,
    st.lists(NUMBER, max_size=3),
    st.lists(POSITION, max_size=3),
    st.just({}),
)
ANY: dict[str, st.SearchStrategy[Any]] = {
    "position": POSITION,
    "polygon": st.lists(POSITION, min_size=2, max_size=4),
    "number": NUMBER,
    "integer": st.one_of(st.integers(0, 400), NUMBER),
    "text": TEXT,
    "id": st.one_of(TEXT, NUMBER),
    "texts": st.lists(TEXT, max_size=2),
}


@functools.cache
def validator(
    level: Level, vocabulary: Vocabulary, strict: bool
) -> jsonschema.Draft202012Validator:
    return jsonschema.Draft202012Validator(plan_schema(level, vocabulary, strict=strict))


def sometimes(
    strategy: st.SearchStrategy[Any], otherwise: st.SearchStrategy[Any]
) -> st.SearchStrategy[Any]:
    return st.integers(0, 11).flatmap(lambda roll: otherwise if roll == 0 else strategy)


def dropping(value: dict[str, Any]) -> st.SearchStrategy[dict[str, Any]]:
    """Mostly the object as it is; now and then a key is missing or one too many."""
    without = st.sampled_from(sorted(value)).map(
        lambda gone: {key: item for key, item in value.items() if key != gone}
    )
    return st.integers(0, 9).flatmap(
        lambda roll: without if roll == 0 else st.just({**value, "more": 1} if roll == 1 else value)
    )


def parameters(owner: Task | Skill) -> st.SearchStrategy[dict[str, Any]]:
    def value(parameter: Parameter) -> st.SearchStrategy[Any]:
        return sometimes(ANY[parameter.type], JUNK)

    optional = {
        parameter.name: value(parameter) for parameter in owner.parameters if not parameter.required
    }
    required = {
        parameter.name: value(parameter) for parameter in owner.parameters if parameter.required
    }
    return st.fixed_dictionaries(required, optional=optional).flatmap(
        lambda given: dropping(given) if given else st.just(given)
    )


def named(key: str, owners: tuple[Any, ...]) -> st.SearchStrategy[dict[str, Any]]:
    def of(owner: Any) -> st.SearchStrategy[dict[str, Any]]:
        return st.fixed_dictionaries(
            {
                key: sometimes(st.just(getattr(owner, key)), JUNK),
                "parameters": sometimes(parameters(owner), JUNK),
            }
        )

    return st.sampled_from(owners).flatmap(of)


TEXTS = sometimes(st.lists(TEXT, max_size=2), JUNK)


def mission_plans(vocabulary: Vocabulary) -> st.SearchStrategy[Any]:
    task = (
        st.tuples(named("title", vocabulary.tasks), sometimes(st.just("Go."), JUNK))
        .map(lambda pair: {**pair[0], "task_prompt": pair[1]})
        .flatmap(dropping)
    )
    tasks = sometimes(st.lists(sometimes(task, JUNK), max_size=3), JUNK)
    return sometimes(
        st.fixed_dictionaries({"tasks": tasks, "assumptions": TEXTS, "constraints": TEXTS}).flatmap(
            dropping
        ),
        JUNK,
    )


def skill_plans(vocabulary: Vocabulary) -> st.SearchStrategy[Any]:
    def skills(role: Any) -> st.SearchStrategy[Any]:
        fitting = named("name", vocabulary.skills_in_role(role)).flatmap(dropping)
        return sometimes(fitting, st.one_of(JUNK, named("name", vocabulary.skills)))

    several = {
        f"{role}_skills": sometimes(st.lists(skills(role), max_size=2), JUNK)
        for role in ("filter", "perception")
    }
    texts = dict.fromkeys(("stop_conditions", "failure_modes", "expected_outputs"), TEXTS)
    step = st.fixed_dictionaries(
        {"navigation_skill": skills("navigation"), **several, **texts}
    ).flatmap(dropping)
    return sometimes(
        st.fixed_dictionaries(
            {"skill_sequence": sometimes(st.lists(step, max_size=2), JUNK)}
        ).flatmap(dropping),
        JUNK,
    )


PLANS: list[tuple[Level, Vocabulary, st.SearchStrategy[Any]]] = [
    (level, vocabulary, strategy(vocabulary))
    for vocabulary in (USV, DRONE)
    for level, strategy in (("mission", mission_plans), ("task", skill_plans))  # type: ignore[misc]
]


@pytest.mark.parametrize("strict", [False, True])
@pytest.mark.parametrize(
    ("level", "vocabulary", "plans"),
    PLANS,
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_plan_problems_agrees_with_the_schema(
    level: Level, vocabulary: Vocabulary, plans: st.SearchStrategy[Any], strict: bool
) -> None:
    verdicts = set()

    @settings(max_examples=150, derandomize=True)
    @given(plans)
    def agree(plan: Any) -> None:
        problems = plan_problems(level, plan, vocabulary, strict=strict)
        valid = validator(level, vocabulary, strict).is_valid(plan)
        assert (not problems) == valid, (plan, problems)
        verdicts.add(valid)

    agree()
    assert verdicts == {True, False}


def go(**more: Any) -> dict[str, Any]:
    return {
        "tasks": [
            {
                "title": "Transit",
                "parameters": {"target_position": [1, 2]},
                "task_prompt": "Go.",
                **more,
            }
        ],
        "assumptions": [],
        "constraints": [],
    }


@pytest.mark.parametrize(
    ("plan", "problem"),
    [
        (go(title="Teleport"), "tasks[0]: 'Teleport' is no task title of the vocabulary"),
        (go(parameters={}), "tasks[0]: Transit needs target_position"),
        (
            go(parameters={"target_position": [1]}),
            "tasks[0].parameters.target_position: [1] is no position [x, y]",
        ),
        (
            go(parameters={"target_position": [1, 2], "speed": 3}),
            "tasks[0].parameters.speed: is no parameter of Transit",
        ),
        (
            go(title="FollowTarget", parameters={}),
            "tasks[0]: FollowTarget needs target_id or target_position",
        ),
        (
            go(title="PerformOrbit", parameters={"center": [0, 0], "radius": -1}),
            "tasks[0].parameters.radius: -1 is not between 0 and 10000",
        ),
        ({"tasks": []}, "assumptions is missing"),
        ([], "a JSON object is expected, not a list"),
    ],
)
def test_problems_say_where_and_what(plan: Any, problem: str) -> None:
    assert problem in plan_problems("mission", plan, USV, strict=True)


def step(**more: Any) -> dict[str, Any]:
    return {
        "skill_sequence": [
            {
                "navigation_skill": {"name": "StationKeep", "parameters": {}},
                **{key: [] for key in ("filter_skills", "perception_skills")},
                **{key: [] for key in ("stop_conditions", "failure_modes", "expected_outputs")},
                **more,
            }
        ]
    }


STEP, SKILL = "skill_sequence[0]", {"name": "GoToXY", "parameters": {"x": 1, "y": 2}}


@pytest.mark.parametrize(
    ("level", "plan", "problems"),
    [
        ("mission", go(), []),
        ("mission", None, ["a JSON object is expected, not null"]),
        ("mission", 3, ["a JSON object is expected, not a number"]),
        ("task", "x", ["a JSON object is expected, not a string"]),
        ("mission", {**go(), "more": 1}, ["unknown key 'more'"]),
        ("mission", {**go(), "tasks": 1.5}, ["tasks: a list is expected, not a number"]),
        ("mission", {**go(), "tasks": [True]}, ["tasks[0]: an object is expected, not a boolean"]),
        (
            "mission",
            {**go(), "constraints": {}},
            ["constraints: a list is expected, not an object"],
        ),
        (
            "mission",
            {**go(), "constraints": ["x", 1]},
            ["constraints[1]: a string is expected, not a number"],
        ),
        ("mission", go(task_prompt=None), ["tasks[0].task_prompt: a string is expected, not null"]),
        ("mission", go(title=3), ["tasks[0].title: a string is expected, not a number"]),
        ("mission", go(parameters=[]), ["tasks[0].parameters: an object is expected, not a list"]),
        ("mission", go(note=""), ["tasks[0]: unknown key 'note'"]),
        ("task", step(), []),
        ("task", {"skill_sequence": {}}, ["skill_sequence: a list is expected, not an object"]),
        ("task", step(navigation_skill=SKILL), []),
        (
            "task",
            step(navigation_skill=3),
            [f"{STEP}.navigation_skill: an object is expected, not a number"],
        ),
        (
            "task",
            step(filter_skills=[SKILL]),
            [
                f"{STEP}.filter_skills[0]: GoToXY cannot stand as filter skill, only as navigation"
                " skill"
            ],
        ),
        (
            "task",
            step(perception_skills=[{"name": "Warp", "parameters": {}}]),
            [f"{STEP}.perception_skills[0]: 'Warp' is no skill name of the vocabulary"],
        ),
        (
            "task",
            step(navigation_skill={"name": "GoToXY", "parameters": {"x": True, "y": 2}}),
            [f"{STEP}.navigation_skill.parameters.x: True is no number"],
        ),
        (
            "task",
            step(stop_conditions=[None]),
            [f"{STEP}.stop_conditions[0]: a string is expected, not null"],
        ),
    ],
)
def test_all_problems_of_a_plan_are_said_once(level: Level, plan: Any, problems: list[str]) -> None:
    assert plan_problems(level, plan, USV, strict=True) == problems


def test_problems_of_one_task_are_said_without_its_place() -> None:
    (task,) = go()["tasks"]
    assert task_problems({**task, "id": "t1"}, USV) == []
    assert task_problems({**task, "title": "Sail"}, USV) == [
        "'Sail' is no task title of the vocabulary"
    ]
    assert task_problems({**task, "parameters": {"target_position": [1]}}, USV) == [
        "parameters.target_position: [1] is no position [x, y]"
    ]


LARGEST = sys.float_info.max


@pytest.mark.parametrize(
    ("kind", "right", "wrong"),
    [
        (
            "number",
            (0, -1.5, LARGEST, -LARGEST),
            (True, "1", None, math.inf, -math.inf, math.nan, 10**309),
        ),
        ("integer", (3, 3.0, -2), (3.5, True, "3")),
        ("text", ("x", " x "), ("", " ", 3)),
        ("id", ("x", 3, 4.0), ("", 3.5, True)),
        ("texts", ([], ["x"]), ("x", [""], [3])),
        ("position", ([1, 2],), ([1], [1, 2, 3], ["1", 2], {"x": 1, "y": 2}, (1, 2))),
        ("polygon", ([[0, 0]] * 3, [[0, 0]] * 4), ([[0, 0]] * 2, [[0, 0]] * 2 + [[0]], "abc")),
    ],
)
def test_a_value_is_of_its_type(kind: Any, right: tuple[Any, ...], wrong: tuple[Any, ...]) -> None:
    one = Parameter("it", kind)
    assert [value_problem(value, one) for value in right] == [None] * len(right)
    assert all(value_problem(value, one) for value in wrong)


def test_the_working_before_a_skill_sequence_is_taken_apart() -> None:
    text = ' {"working":"1+1=2","skill_sequence":[]}'
    assert without_working(text) == ('{"skill_sequence":[]}', "1+1=2")
    for other in ('{"skill_sequence":[]}', '{"working":"x","tasks":[]}', ""):
        assert without_working(other) == (other, "")


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=["usv", "drone"])
def test_bounds_belong_to_the_range(vocabulary: Vocabulary) -> None:
    owners: list[Task | Skill] = [*vocabulary.tasks, *vocabulary.skills]
    bounded = [one for owner in owners for one in owner.parameters if one.minimum is not None]
    assert bounded
    for one in bounded:
        assert one.minimum is not None and one.maximum is not None
        inside, outside = (one.minimum, one.maximum), (one.minimum - 1, one.maximum + 1)
        assert [value_problem(value, one) for value in inside] == [None, None]
        assert all(value_problem(value, one) for value in outside)


def test_an_invented_name_is_schema_valid_but_not_strictly_valid() -> None:
    plan = go(title="Berthing")
    assert plan_problems("mission", plan, USV, strict=False) == []
    assert plan_problems("mission", plan, USV, strict=True) != []


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 10**400])
def test_numbers_that_cannot_be_calculated_with_are_none(value: float) -> None:
    assert plan_problems(
        "mission", go(parameters={"target_position": [value, 0]}), USV, strict=True
    )


def test_canonical_form_orders_keys_and_parameters_and_writes_whole_numbers_without_point() -> None:
    plan = {
        "constraints": [],
        "tasks": [
            {
                "task_prompt": "Circle.",
                "parameters": {"arc": 360.0, "radius": 12.5, "center": [1.0, 2.5]},
                "title": "PerformOrbit",
            }
        ],
    }
    assert (
        compact_json(canonical_plan("mission", plan, USV))
        == '{"tasks":[{"title":"PerformOrbit","parameters":{"center":[1,2.5],"radius":12.5,"arc":360},"task_prompt":"Circle."}],"assumptions":[],"constraints":[]}'
    )


@settings(max_examples=60)
@given(skill_plans(USV))
def test_the_canonical_form_of_a_valid_plan_is_valid_and_stays_as_it_is(plan: Any) -> None:
    if plan_problems("task", plan, USV, strict=True):
        return
    canonical = canonical_plan("task", plan, USV)
    assert plan_problems("task", canonical, USV, strict=True) == []
    assert compact_json(
        canonical_plan("task", json.loads(compact_json(canonical)), USV)
    ) == compact_json(canonical)


def test_names_are_read_in_order_and_strange_entries_passed_over() -> None:
    assert plan_names(
        "mission", {"tasks": [{"title": "Transit"}, 3, {"title": None}, {"title": "KeepStation"}]}
    ) == ["Transit", "KeepStation"]
    step = {
        "navigation_skill": {"name": "GoToXY"},
        "filter_skills": [{"name": "LockHeading"}],
        "perception_skills": None,
    }
    assert plan_names("task", {"skill_sequence": [step, None]}) == ["GoToXY", "LockHeading"]
    assert plan_names("mission", "nothing") == []


def test_an_unknown_level_is_refused() -> None:
    with pytest.raises(PlannerError, match="--level skill: must be mission or task"):
        check_level("skill")
