"""Plan documents for tests: from plain tasks, and random ones of any vocabulary."""

from __future__ import annotations

import math
from typing import Any

from hypothesis import strategies as st

from planner_ft.document import build, document_digest
from planner_ft.exporters import Origin
from planner_ft.planning.locations import open_places
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import Parameter

USV, DRONE = load_vocabulary("usv"), load_vocabulary("inspection_drone")
TEXTS = st.characters(exclude_categories=("Cs", "Z")) | st.sampled_from(
    [
        'say "stop"',
        "a // b",
        "#define X ${Y}",
        "<b>&amp;</b>",
        "line\nbreak",
        "${X}",
        "tab\there",
        "früh",
        "]]>",
        "| * _ `",
    ]
)


def step(
    name: str,
    parameters: dict[str, Any] | None = None,
    *,
    filters: Any = (),
    perception: Any = (),
    **texts: list[str],
) -> dict[str, Any]:
    """A step; `filters` and `perception` are (name, parameters)."""
    skills = [
        [{"name": skill, "parameters": given} for skill, given in group]
        for group in (filters, perception)
    ]
    lists = {
        key: texts.get(key, []) for key in ("stop_conditions", "failure_modes", "expected_outputs")
    }
    return {
        "navigation_skill": {"name": name, "parameters": parameters or {}},
        "filter_skills": skills[0],
        "perception_skills": skills[1],
        **lists,
    }


def task(
    title: str,
    parameters: dict[str, Any],
    steps: list[dict[str, Any]] | None,
    prompt: str = "Do it.",
) -> dict[str, Any]:
    return {
        "title": title,
        "parameters": parameters,
        "task_prompt": prompt,
        "skill_sequence": steps,
    }


def built(
    tasks: list[dict[str, Any]], vocabulary: Vocabulary = USV, *, command: str = "Do it."
) -> dict[str, Any]:
    """The document of a command that was planned as `tasks`, as planning makes it; a task at an
    open place has no skills.
    """
    plan = {
        "tasks": [
            {key: value for key, value in entry.items() if key != "skill_sequence"}
            for entry in tasks
        ],
        "assumptions": [],
        "constraints": [],
    }
    places = open_places(plan, vocabulary)
    waiting = {number: place.name for place in places for number in place.tasks}
    planned = [
        PlannedTask(
            entry["title"],
            entry["parameters"],
            entry["task_prompt"],
            answer=None
            if number in waiting or entry["skill_sequence"] is None
            else _answer({"skill_sequence": entry["skill_sequence"]}),
            waits_for=waiting.get(number),
        )
        for number, entry in enumerate(tasks, start=1)
    ]
    manifest = build_manifest(
        "plan", seed=None, configuration={}, agents={"mission": {"candidate": "embedded"}}
    )
    use = AgentUse("embedded", "lora", None, 0.0, 1, 1, 1, 1, 1.0)
    return build(
        Planned(
            command, _answer(plan), tuple(planned), tuple(places), {}, {"mission": use}, 1, manifest
        ),
        vocabulary,
    )


def document(
    tasks: list[dict[str, Any]],
    vocabulary: Vocabulary = USV,
    *,
    command: str = "Do it.",
    area: Any = None,
    warnings: Any = (),
    assumptions: Any = (),
    constraints: Any = (),
) -> dict[str, Any]:
    """As `built`, put together by hand: any texts, no analysis. `warnings` are (task id or None,
    text).
    """
    places = open_places({"tasks": tasks}, vocabulary)
    waiting = {number: place.name for place in places for number in place.tasks}
    entries = [
        {
            "id": f"t{number}",
            **entry,
            **({"waits_for": waiting[number], "skill_sequence": None} if number in waiting else {}),
        }
        for number, entry in enumerate(tasks, start=1)
    ]
    plan = {
        "command": command,
        "vocabulary": {"name": vocabulary.name, "sha256": vocabulary.sha256},
        "vehicle": {
            "name": "boat",
            "cruise_speed": 1.5,
            "endurance": 7200,
            "turn_rate": 20,
            "orbit_angle": 360,
            "area": area,
        },
        "tasks": entries,
        "assumptions": list(assumptions),
        "constraints": list(constraints),
        "located": {},
        "open_places": [{"name": place.name, "tasks": list(place.tasks)} for place in places],
        "warnings": [
            {"id": f"w{n}", "kind": "odd", "task": where, "parameter": None, "text": text}
            for n, (where, text) in enumerate(warnings)
        ],
    }
    return {**plan, "digest": document_digest(plan)}


def _answer(plan: dict[str, Any]) -> Answer:
    return Answer("", plan, (), (), 1, 1, 1, 1.0)


BUOY = [
    task(
        "SearchAndDetect",
        {"target_description": "green buoy"},
        [
            step(
                "StationKeep",
                {},
                perception=[("DetectObjects", {"class_list": ["green buoy"]})],
                stop_conditions=["hold complete"],
            )
        ],
    ),
    task("Transit", {"target_position": [-99, -99]}, None, "Go to the green buoy."),
    task("PerformOrbit", {"center": [-99, -99], "radius": 12}, None, "Circle the green buoy."),
    task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})], "Come home."),
]
"""A plan that has to wait for the position of a buoy."""
MAST = [
    task(
        "Transit",
        {"target_position": [120, -35]},
        [
            step(
                "GoToXY",
                {"x": 120, "y": -35, "yaw": 90},
                filters=[("ObstacleAvoidance", {"min_distance": 5})],
            )
        ],
    ),
    task(
        "PerformOrbit",
        {"center": [120, -35], "radius": 25, "speed": 1.2, "arc": 180},
        [
            step(
                "ArcTurn",
                {"radius": 25, "delta_yaw": 180},
                perception=[("SetStreamRecording", {"sensor_id": "video"})],
                expected_outputs=["recording"],
            )
        ],
    ),
    task(
        "KeepStation",
        {"duration": 90},
        [
            step(
                "StationKeep",
                {"time": 90, "radius": 3},
                filters=[
                    (
                        "BoundaryEnforcement",
                        {"poly_coords": [[-50, -100], [200, -100], [200, 50], [-50, 50]]},
                    ),
                    ("LockHeading", {}),
                ],
                failure_modes=["position lost"],
            )
        ],
    ),
    task("Transit", {"target_position": [0, 0]}, [step("GoToXY", {"x": 0, "y": 0})], "Come home."),
]
"""A plan in which every place is known."""


@st.composite
def documents(
    draw: st.DrawFn, vocabulary: Vocabulary = USV, reach: float = 2000.0
) -> dict[str, Any]:
    """Random valid plans: any titles, skills in their roles, parameters given or left out, places
    known or open.
    """
    tasks = draw(st.lists(_tasks(vocabulary, reach), min_size=1, max_size=4))
    texts = st.lists(TEXTS, max_size=2)
    warnings = [(draw(st.sampled_from([None, "t1"])), text) for text in draw(texts)]
    return document(
        tasks,
        vocabulary,
        command=draw(TEXTS),
        warnings=warnings,
        assumptions=draw(texts),
        constraints=draw(texts),
    )


@st.composite
def _tasks(draw: st.DrawFn, vocabulary: Vocabulary, reach: float) -> dict[str, Any]:
    known = draw(st.sampled_from(vocabulary.tasks))
    parameters = draw(_parameters(known, vocabulary, reach))
    if known.position_parameter in parameters and draw(st.integers(0, 7)) == 0:
        parameters[known.position_parameter] = list(vocabulary.unresolved)
    steps = (
        draw(st.none() | st.lists(_steps(vocabulary, reach), max_size=3))
        if draw(st.integers(0, 5)) == 0
        else draw(st.lists(_steps(vocabulary, reach), min_size=1, max_size=3))
    )
    extra = {
        "assumptions": draw(st.lists(TEXTS, min_size=1, max_size=2)),
        "stale": True,
        "located": {name: draw(TEXTS) for name in parameters},
    }
    return {
        **task(known.title, parameters, steps, draw(TEXTS)),
        **{key: value for key, value in extra.items() if draw(st.integers(0, 3)) == 0},
    }


@st.composite
def _steps(draw: st.DrawFn, vocabulary: Vocabulary, reach: float) -> dict[str, Any]:
    navigation = draw(st.sampled_from(vocabulary.skills_in_role("navigation")))
    beside = {
        role: [
            (skill.name, draw(_parameters(skill, vocabulary, reach)))
            for skill in draw(
                st.lists(st.sampled_from(vocabulary.skills_in_role(role)), max_size=2)
            )
        ]
        for role in ("filter", "perception")
    }
    texts = {
        key: draw(st.lists(TEXTS, max_size=2))
        for key in ("stop_conditions", "failure_modes", "expected_outputs")
    }
    return step(
        navigation.name,
        draw(_parameters(navigation, vocabulary, reach)),
        filters=beside["filter"],
        perception=beside["perception"],
        **texts,
    )


@st.composite
def _parameters(
    draw: st.DrawFn, owner: Any, vocabulary: Vocabulary, reach: float
) -> dict[str, Any]:
    given = {}
    for parameter in owner.parameters:
        needed = parameter.required or parameter.name in owner.require_any
        if needed or draw(st.booleans()):
            given[parameter.name] = draw(_values(parameter, reach))
    return given


def origins() -> st.SearchStrategy[Origin]:
    """Anywhere but the poles, the antimeridian more often than chance has it."""
    longitude = st.floats(-180, 180, allow_nan=False) | st.sampled_from(
        [-180.0, 180.0, 179.999, -179.999]
    )
    return st.builds(Origin, st.floats(-89, 89, allow_nan=False), longitude)


def _values(parameter: Parameter, reach: float) -> st.SearchStrategy[Any]:
    number = st.floats(-reach, reach, allow_nan=False).map(lambda value: round(value, 3))
    position = st.tuples(number, number).map(list)
    if parameter.type in ("number", "integer"):
        low, high = (
            (math.ceil(parameter.minimum), math.floor(parameter.maximum))
            if parameter.minimum is not None and parameter.maximum is not None
            else (0, 1000)
        )
        low, high = (max(low, -reach), min(high, reach)) if parameter.unit == "m" else (low, high)
        whole = st.integers(int(low), int(high))
        return (
            whole
            if parameter.type == "integer"
            else whole | st.floats(low, high, allow_nan=False).map(lambda value: round(value, 3))
        )
    square = position.map(
        lambda corner: [
            corner,
            [corner[0] + 40, corner[1]],
            [corner[0] + 40, corner[1] + 30],
            [corner[0], corner[1] + 30],
        ]
    )
    return {
        "position": position,
        "polygon": square,
        "texts": st.lists(TEXTS, min_size=1, max_size=3),
    }.get(parameter.type, TEXTS)
