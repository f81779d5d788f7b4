"""How much of everything an answer may have, and what may stand how often: at the bound and behind
it.
"""

from __future__ import annotations

import json
from typing import Any

import pytest

from planner_ft.decoding.configurations import Strength
from planner_ft.prompts import completion_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import load_vocabulary
from tests.values import changeable

from .conftest import allowed, answer_ids, make_factory, taken

USV = load_vocabulary()
Skill = tuple[str, dict[str, Any]]
HOLD: Skill = ("StationKeep", {"time": 60})


def begins(tokenizer: Any, text: str, strength: Strength = "schema", **record: Any) -> bool:
    """Whether an answer may be this text, or begin with it."""
    level = "mission" if text.startswith('{"tasks') else "task"
    factory = make_factory(tokenizer, level, USV, strength, limit=20000)
    ids = answer_ids(tokenizer, text)
    return taken(factory.start({"prompt": "x", **record}), ids) == len(ids)


def mission(*tasks: Skill, prompts: str = "", **more: Any) -> str:
    written = [
        {"title": title, "parameters": given, "task_prompt": prompts} for title, given in tasks
    ]
    return compact_json({"tasks": written, "assumptions": [], "constraints": [], **more})


def step(move: Skill = HOLD, filters: Any = (), seen: Any = (), **texts: Any) -> dict[str, Any]:
    def named(skills: Any) -> list[dict[str, Any]]:
        return [{"name": name, "parameters": given} for name, given in skills]

    return {
        "navigation_skill": named([move])[0],
        "filter_skills": named(filters),
        "perception_skills": named(seen),
        **{key: texts.get(key, []) for key in ("stop_conditions", "failure_modes")},
        "expected_outputs": texts.get("expected_outputs", []),
    }


def sequence(*steps: dict[str, Any]) -> str:
    return compact_json({"skill_sequence": list(steps)})


def test_what_constrains_an_answer_cannot_be_changed() -> None:
    names = ("answer", "grammar", "scripts", "tokens", "waypoints")
    assert changeable(*(f"planner_ft.decoding.constraints.{name}" for name in names)) == []


CHECK: Skill = ("Diagnostics", {})
WORDS = [str(number) for number in range(17)]


@pytest.mark.parametrize(
    ("inside", "outside"),
    [
        (mission(*[CHECK] * 32), mission(*[CHECK] * 33)),
        (mission(CHECK, prompts="x" * 400), mission(CHECK, prompts="x" * 401)),
        (mission(CHECK, assumptions=WORDS[1:]), mission(CHECK, assumptions=WORDS)),
        (mission(CHECK, constraints=WORDS[1:]), mission(CHECK, constraints=WORDS)),
        (
            mission(("GlareFreeApproach", {"target_feature": "x" * 200})),
            mission(("GlareFreeApproach", {"target_feature": "x" * 201})),
        ),
        (
            mission(("SmartDataHarvest", {"target_list": WORDS[1:]})),
            mission(("SmartDataHarvest", {"target_list": WORDS})),
        ),
        (
            mission(("FollowTarget", {"target_id": 1234567})),
            mission(("FollowTarget", {"target_id": 12345678})),
        ),
        (
            mission(("Transit", {"target_position": [1234567, -0.1234]})),
            mission(("Transit", {"target_position": [12345678, 0]})),
        ),
        (
            mission(("Transit", {"target_position": [0, -0.1234]})),
            mission(("Transit", {"target_position": [0, -0.12345]})),
        ),
        (
            mission(("PerformOrbit", {"center": [0, 0], "arc": 0})),
            mission(("PerformOrbit", {"center": [0, 0], "arc": 3601})),
        ),
        (mission(("FollowTarget", {"target_id": "a"})), mission(("FollowTarget", {}))),
        (mission(("Transit", {"target_position": [0, 0]})), mission(("Transit", {}))),
        (mission(), '{"tasks":[],"constraints":[]}'),
        (sequence(*[step()] * 128), sequence(*[step()] * 129)),
        (sequence(), '{"skill_sequence":[{}]}'),
        (
            sequence(step(filters=[("LockHeading", {})] * 16)),
            sequence(step(filters=[("LockHeading", {})] * 17)),
        ),
        (
            sequence(step(seen=[("GetGPSLocation", {})] * 16)),
            sequence(step(seen=[("GetGPSLocation", {})] * 17)),
        ),
        *(
            (sequence(step(**{key: WORDS[1:]})), sequence(step(**{key: WORDS})))
            for key in ("stop_conditions", "failure_modes", "expected_outputs")
        ),
        *(
            (
                sequence(step(filters=[("BoundaryEnforcement", {"poly_coords": [[0, 0]] * some})])),
                sequence(step(filters=[("BoundaryEnforcement", {"poly_coords": [[0, 0]] * most})])),
            )
            for some, most in ((3, 2), (32, 33))
        ),
        (sequence(step(("GoToXY", {"x": 1, "y": 2}))), sequence(step(("GoToXY", {"x": 1})))),
        (
            sequence().replace("{", '{"working":"' + "1" * 600 + '",', 1),
            sequence().replace("{", '{"working":"' + "1" * 601 + '",', 1),
        ),
        (
            sequence().replace("{", '{"working":"xy0.9+-/=;",', 1),
            sequence().replace("{", '{"working":"1*2",', 1),
        ),
    ],
    ids=lambda text: text[:60],
)
def test_an_answer_is_bounded(embedded: Any, inside: str, outside: str) -> None:
    assert begins(embedded, inside)
    assert not begins(embedded, outside)


def turns(count: int) -> list[dict[str, Any]]:
    return [step(("NudgeYaw", {"delta_yaw": place + 1})) for place in range(count)]


def watch(*texts: str) -> dict[str, Any]:
    return step(seen=[("CreateMapMarker", {"label": text}) for text in texts])


@pytest.mark.parametrize(
    ("steps", "possible"),
    [
        # The same movement stands twelve times in a row; another one begins the count anew.
        ([step()] * 12, True),
        ([step()] * 13, False),
        ([*[step()] * 12, step(("NudgeYaw", {"delta_yaw": 5})), step()], True),
        ([step(("GoToXY", {"x": 1, "y": 2})), *[step()] * 12], True),
        ([step(("GoToXY", {"x": 5, "y": 2}))] * 12, True),
        ([step(("GoToXY", {"x": 5, "y": 2}))] * 13, False),
        # A movement that goes nowhere stands 36 times.
        (turns(36), True),
        (turns(37), False),
        ([*turns(36), step(("GoToXY", {"x": 1, "y": 2})), *turns(1)], True),
        ([step(("GoToXY", {"x": place, "y": 2})) for place in range(40)], True),
        # A skill stands in a step once, or up to four times with other values.
        ([step(seen=[("GetGPSLocation", {})])] * 2, True),
        ([step(seen=[("GetGPSLocation", {})] * 2)], False),
        ([step(filters=[("LockHeading", {})] * 2)], False),
        ([step(filters=[("LockHeading", {})], seen=[("GetGPSLocation", {})])], True),
        ([watch("a", "b", "c", "d")], True),
        ([watch("a", "b", "c", "d", "e")], False),
        ([watch("a", "A")], False),
        ([watch("a"), watch("a")], True),
        ([step(seen=[("CreateMapMarker", {"label": "a"}), ("CreateMapMarker", {})])], False),
        ([step(seen=[("CreateMapMarker", {}), ("CreateMapMarker", {"label": "a"})])], False),
        ([step(seen=[("LogLidarSlice", {"scan_angle": 5}), ("LogLidarSlice", {"scan_angle": 6})])],
         True),
        ([step(seen=[("LogLidarSlice", {"scan_angle": 5}), ("LogLidarSlice", {"scan_angle": 5})])],
         False),
        ([step(seen=[("TrackObjects", {"object_id": "a"}), ("TrackObjects", {"object_id": "a"})])],
         False),
        # Both parameters: the first tells one use from the other.
        ([step(seen=[("CaptureGeoSnapshot", {"sensor_id": "a", "note": "x"}),
                     ("CaptureGeoSnapshot", {"sensor_id": "b", "note": "x"})])], True),
        ([step(seen=[("CaptureGeoSnapshot", {"sensor_id": "a", "note": "x"}),
                     ("CaptureGeoSnapshot", {"sensor_id": "a", "note": "y"})])], False),
        # No unresolved corner, and no unresolved destination.
        ([step(filters=[("BoundaryEnforcement", {"poly_coords": [[0, 0]] * 3})])], True),
        ([step(filters=[("BoundaryEnforcement", {"poly_coords": [[-99, -99], [0, 0], [1, 1]]})])],
         False),
        ([step(("GoToXY", {"x": -99, "y": 0}))], True),
        ([step(("GoToXY", {"x": -99, "y": -99}))], False),
        ([step(("GoToXY", {"x": 0, "y": -99, "yaw": 5}))], True),
    ],
)  # fmt: skip
def test_what_may_stand_how_often(
    embedded: Any, steps: list[dict[str, Any]], possible: bool
) -> None:
    text = sequence(*steps)
    assert begins(embedded, text, "state", task="KeepStation", parameters={}) is possible
    assert begins(embedded, text), "the schema alone allows it"


@pytest.mark.parametrize(
    ("vehicle", "mission_tokens", "task_tokens"),
    [("usv", 303, 392), ("inspection_drone", 282, 383)],
)
def test_the_smallest_limits_that_an_operator_can_set(
    embedded: Any, vehicle: str, mission_tokens: int, task_tokens: int
) -> None:
    """Bytes of the longest task or skill with what must be written of it, and of what closes it."""
    known = load_vocabulary(vehicle)
    assert make_factory(embedded, "mission", known, "state").least_tokens == mission_tokens
    assert make_factory(embedded, "task", known, "state").least_tokens == task_tokens


def test_a_limit_that_is_too_small_is_one_sentence(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", USV, "state")
    least = factory.least_tokens
    assert factory.start({"prompt": "x"}, least) is not None
    with pytest.raises(PlannerError) as error:
        factory.start({"prompt": "x"}, least - 1)
    assert str(error.value) == (
        f"--max-new-tokens {least - 1}: at strength state a mission plan of this vocabulary needs"
        f" room for {least} tokens; give at least that, or a shorter prompt"
    )
    with pytest.raises(PlannerError, match=f"--max-new-tokens {least - 1}: "):
        make_factory(embedded, "mission", USV, "state", limit=least - 1)


def test_the_last_tokens_of_the_limit_close_what_is_open(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", USV, "schema")
    begun = answer_ids(embedded, mission(CHECK, prompts="x y " * 40).partition(' "}]')[0])
    (quote,) = answer_ids(embedded, '"')
    kept = factory.reserve + len(begun)
    for limit, closing in ((kept, True), (kept + 1, False)):
        answer = factory.start({"prompt": "x"}, limit)
        for token in begun:
            answer.accept(token)
        assert (allowed(answer.mask()) == [quote]) is answer.cut is closing


def test_with_a_number_of_entries_an_answer_has_no_more_and_no_logic(embedded: Any) -> None:
    for level, text in (("mission", mission(CHECK, CHECK)), ("task", sequence(step(), step()))):
        factory = make_factory(embedded, level, USV, "grounded")
        ids = answer_ids(embedded, text)
        for most, possible in ((2, True), (1, False)):
            found = taken(factory.start({"prompt": "x", "task": "KeepStation"}, most=most), ids)
            assert (found == len(ids)) is possible
    free = answer_ids(embedded, mission(("Transit", {"target_position": [-99, -99]})))
    factory = make_factory(embedded, "mission", USV, "state")
    assert taken(factory.start({"prompt": "x"}), free) < len(free)
    assert taken(factory.start({"prompt": "x"}, most=1), free) == len(free)


def test_an_answer_is_complete_at_its_end_and_takes_an_end_token_alone(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", USV, "state")
    answer, text = factory.start({"prompt": "x"}), mission(CHECK)
    for token in answer_ids(embedded, text):
        assert not answer.ended
        answer.accept(token)
    (end,) = factory.tokens.end_ids[:1]
    other = answer_ids(embedded, "x")[0]
    assert answer.ended and answer.notes == [] and answer.expected() == []
    assert answer.allows(end) and not answer.allows(other)
    assert not answer.release(other) and answer.ends_text() is None
    with pytest.raises(ValueError, match=f"token {other} .* complete answer"):
        answer.accept(other)
    answer.accept(end)


def test_a_token_that_is_not_allowed_is_named(embedded: Any) -> None:
    answer = make_factory(embedded, "mission", USV, "state").start({"prompt": "x"})
    (wrong,) = answer_ids(embedded, "]")
    with pytest.raises(ValueError, match=rf"token {wrong} \(b'\]'\) is not allowed here"):
        answer.accept(wrong)


def test_the_token_that_ends_a_text_is_known_inside_texts_alone(embedded: Any) -> None:
    answer = make_factory(embedded, "mission", USV, "schema").start({"prompt": "x"})
    (quote,) = answer_ids(embedded, '"')
    begun = '{"tasks":[{"title":"GlareFreeApproach","parameters":{"target_feature":"'
    for token in answer_ids(embedded, begun):
        answer.accept(token)
    assert answer.ends_text() is None, "a text must not be blank"
    for token in answer_ids(embedded, "a\\\\"):
        answer.accept(token)
    assert answer.ends_text() == quote
    answer.accept(quote)
    assert answer.ends_text() is None


def test_a_plan_that_carries_a_working_can_be_written(embedded: Any) -> None:
    text = completion_text("task", json.loads(sequence(step())), USV)
    assert begins(embedded, text) and begins(embedded, '{"working":"1+1=2",' + text[1:])
