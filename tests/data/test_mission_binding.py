"""A command template is bound to a vehicle: what fills its tasks, and mistakes in their words."""

from __future__ import annotations

from dataclasses import replace
from random import Random
from typing import Any

import pytest

from planner_ft.data.mission_binding import Bound, bind, slots_of
from planner_ft.data.missions import MissionSampler, mission_sampler
from planner_ft.data.templates.grammar import TemplateError
from planner_ft.data.templates.records import Template
from planner_ft.vocabulary import Parameter, load_vocabulary

USV = load_vocabulary()
SAMPLER = mission_sampler(USV)


def bound(text: str, plan: str, **more: Any) -> Bound:
    return bind(Template("made-1", "train", text, plan, "made.jsonl:1", **more), SAMPLER)


@pytest.mark.parametrize(
    ("text", "plan", "objects", "fills", "slots"),
    [
        ("Hold at {P1} for {duration}.", "KeepStation P1 duration", "P1", {"duration": "duration"},
         "P1 duration"),
        ("Orbit {T1:boat} at {P1}, {radius2}.", "PerformOrbit T1 P1 radius=radius2", "T1 P1",
         {"radius": "radius2"}, "P1 T1 radius2"),
        ("Follow {ID1}.", "FollowTarget ID1", "ID1", {}, "ID1"),
        ("Hold.", "KeepStation here duration=5.0", "", {"duration": 5}, ""),
        ("Hold.", "KeepStation here duration=2.5", "", {"duration": 2.5}, ""),
        ("Home.", "Home", "", {}, ""),
        ("Hold {mark1}.", "KeepStation here ~mark1", "", {}, ""),
        ("Survey {T1} near {T2}.", "SurveyTarget T1 near=T2", "T1", {}, "T1 T2"),
        ("Hold {~duration}, no {duration}.", "KeepStation here duration", "",
         {"duration": "duration"}, "duration"),
        ("Check.", "Diagnostics", "", {}, ""),
    ],
)  # fmt: skip
def test_what_fills_a_task(
    text: str, plan: str, objects: str, fills: dict[str, Any], slots: str
) -> None:
    (step,) = bound(text, plan).tasks
    call = step.call
    assert call.name == plan.split()[0]
    assert " ".join(call.of("object")) == objects and call.of("clause") == []
    filled = {one.name: one.value for one in call.arguments if one.kind in ("slot", "literal")}
    assert filled == fills
    assert [type(value) for value in filled.values()] == [type(value) for value in fills.values()]
    assert sorted(slots_of(call)) == slots.split()
    assert bool(call.of("here")) == (" here" in plan)
    assert call.of("near") == (["T2"] if "near=" in plan else [])


def test_a_parameter_may_be_called_as_an_argument_of_the_grammar_is() -> None:
    dock = USV.task["DockingApproach"]
    more = replace(dock, parameters=(*dock.parameters, Parameter("part", "text")))
    vehicle = replace(USV, tasks=tuple(more if one is dock else one for one in USV.tasks))
    template = Template("made-1", "train", "Dock at {P1}.", 'DockingApproach P1 part="bow"', "a:1")
    (step,) = bind(template, MissionSampler(vehicle)).tasks
    named = [(one.kind, one.name, one.value) for one in step.call.arguments if one.name]
    assert named == [("literal", "part", "bow")]


def test_owners_kinds_and_places_of_slots() -> None:
    found = bound("Orbit {T1:boat} at {P1}, {radius2}.", "PerformOrbit T1 P1 radius=radius2")
    assert (found.kinds, found.places) == ({"T1": "boat"}, {"T1": "P1"})
    assert found.draws.keys() == {"radius2"}
    # A value outside the plan is that of the first task with such a parameter; of two tasks that
    # have it, the first one of the plan.
    said = bound("Hold {radius}.", "KeepStation here", constraints=("No {radius}.",))
    assert _drawn(said) == _drawn(found, "radius2")
    both = bound("{T1}: {radius}.", "SurveyTarget T1 radius; PerformOrbit T1 radius")
    survey = bound("{T1}: {radius}.", "SurveyTarget T1 radius")
    assert _drawn(both) == _drawn(survey) != _drawn(said) and both.places == {}
    (step,) = bound("Hold{?now}.", "KeepStation?now here &GetGPSLocation").tasks
    assert step.call.label == "now"
    assert [call.name for call in step.perceptions] == ["GetGPSLocation"]


def _drawn(of: Bound, key: str = "radius") -> list[Any]:
    return [of.draws[key](Random(seed)).value for seed in range(200)]


@pytest.mark.parametrize(
    ("text", "plan", "problem"),
    [
        ("Hold.", "Hold here", "there is no task Hold"),
        (
            "Hold for {radius}.",
            "KeepStation here radius",
            "KeepStation has no parameter radius (it has duration)",
        ),
        ("Check.", "Diagnostics speed=5", "Diagnostics has no parameter speed (it has none)"),
        ("Hold.", "KeepStation", "KeepStation has no place: T1, P1, or here"),
        (
            "Hold for {duration}.",
            "KeepStation here",
            "{duration} belongs to no task, limit or demand; a wrong value is {~duration}",
        ),
        (
            "Hold at {P1}.",
            "KeepStation P1 duration",
            "duration stands in the plan and not in the text",
        ),
        ("Hold.", "KeepStation P1", "P1 stands in the plan and not in the text"),
        ("Check.", "Diagnostics P1", "P1 stands in the plan and not in the text"),
        ("Hold {~P1}.", "KeepStation P1", "P1 stands in the plan and not in the text"),
        (
            "Survey ({T1}|it).",
            "SurveyTarget T1",
            "{T1} is needed, and not every alternative says it",
        ),
        ("Survey {T1:ghost}.", "SurveyTarget T1", "there is no word list ghost for targets"),
        ("Find.", "SearchAndDetect", "SearchAndDetect has no place: T1, P1, or here"),
        ("Find.", "SearchAndDetect here", "SearchAndDetect needs a target, T1"),
        ("Find {P1}.", "SearchAndDetect P1", "SearchAndDetect needs a target, T1"),
        ("Hold {zork}.", "KeepStation here ~zork", "{zork} is no target, parameter or word list"),
        ("Hold.", "KeepStation here &Fly", "there is no skill Fly"),
        ("Hold {P1}.", "KeepStation mid(P1,P2)", "P2 stands in the plan and not in the text"),
        ("Hold {P1}.", "KeepStation amid(P1)", "amid stands in the plan and not in the text"),
        ("Hold {P1}.", "KeepStation mid(P1,,P1)", "mid(P1,,P1) is no formula"),
        ("Hold {P1}.", "KeepStation P1; keep_out T1", "T1 stands in the plan and not in the text"),
    ],
)
def test_mistakes_are_named(text: str, plan: str, problem: str) -> None:
    with pytest.raises(TemplateError) as error:
        bound(text, plan)
    assert str(error.value) == problem


def test_what_is_ruled_out_or_remarked_is_known() -> None:
    with pytest.raises(TemplateError, match="there is no task Sail to rule out"):
        bound("Hold.", "KeepStation here", excluded=("Sail",))
    assert bound("Hold.", "KeepStation here", excluded=("Home", "Transit")).tasks
    with pytest.raises(TemplateError, match="radius stands in the plan and not in the text"):
        bound("Hold.", "KeepStation here", constraints=("No {radius}.",))
    # A target of a labelled task may be missing where the label is.
    assert bound("Hold( at {T1}{?a}|).", "KeepStation?a T1").tasks[0].call.label == "a"
