"""Strength grounded: a value that nobody said cannot be written, and every right plan can."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.missions import sample_missions
from planner_ft.data.rules import rule_problems
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.task.steps import plan_step
from planner_ft.facts import missing_words
from planner_ft.facts.geometry import lawnmower
from planner_ft.prompts import completion_text
from planner_ft.support.files import compact_json, read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, named_entries, plan_problems

from .conftest import ADVERSARIAL, LIMITS, answer_ids, decoded, make_factory, random_answer, taken
from .test_schema import CURATED

COMMAND = (
    "Orbit the met mast at [120, -35] 25 metres off for half a circle, drift there for half an"
    " hour, then inspect the red buoy and come home."
)
UNKNOWN = [-99, -99]


def admitted(
    tokenizer: Any, *entries: tuple[str, dict[str, Any]], prompt: str = COMMAND, sentence: str = ""
) -> bool:
    tasks = [
        {"title": title, "parameters": parameters, "task_prompt": sentence}
        for title, parameters in entries
    ]
    ids = answer_ids(
        tokenizer, compact_json({"tasks": tasks, "assumptions": [], "constraints": []})
    )
    factory = make_factory(tokenizer, "mission", load_vocabulary(), "grounded")
    return taken(factory.start({"prompt": prompt}), ids) == len(ids)


@pytest.mark.parametrize(
    "entry",
    [
        ("SurveyTarget", {"target_position": [120, -35], "radius": 25}),
        ("SurveyTarget", {"target_position": [0, 0]}),
        ("SearchAndDetect", {"target_description": "red buoy"}),
        ("KeepStation", {"duration": 1800}),
        ("ThermalHotspotLocalizer", {"scan_width_degrees": 180}),
        ("SmartDataHarvest", {"target_list": ["met mast", "red buoy"]}),
        ("DockingApproach", {"goal_position": UNKNOWN}),
    ],
)
def test_what_was_said_can_be_written(embedded: Any, entry: tuple[str, dict[str, Any]]) -> None:
    assert admitted(embedded, entry)


@pytest.mark.parametrize(
    "entry",
    [
        ("SurveyTarget", {"target_position": [120, 35]}),
        ("SurveyTarget", {"target_position": [-35, 120]}),
        ("SurveyTarget", {"target_position": [120, -35], "radius": 30}),
        ("SurveyTarget", {"target_position": [120, -35], "radius": 1800}),
        ("SurveyTarget", {"target_position": [120, -35], "radius": 120}),
        ("SearchAndDetect", {"target_description": "green buoy"}),
        ("SearchAndDetect", {"target_description": "the red buoy"}),
        ("KeepStation", {"duration": 30}),
        ("KeepStation", {"duration": 25}),
        ("ThermalHotspotLocalizer", {"scan_width_degrees": 90}),
        ("SmartDataHarvest", {"target_list": ["met mast", "photos"]}),
    ],
)
def test_what_nobody_said_cannot(embedded: Any, entry: tuple[str, dict[str, Any]]) -> None:
    assert not admitted(embedded, entry)


@pytest.mark.parametrize(
    ("prompt", "parameters", "possible"),
    [
        ("panorama here, sixteen sectors, waiting 5", {"sectors": 16, "wait": 5}, True),
        ("panorama here, sixteen sectors, waiting 5", {"wait": 16}, False),
        (
            "panorama of the two buoys from here, 8 headings, hour at each",
            {"sectors": 8, "wait": 3600},
            True,
        ),
        ("panorama of the two buoys from here, 8 headings, hour at each", {"wait": 2}, False),
        ("panorama of this one and that one, a quarter overlap", {"overlap": 25}, True),
        ("panorama of this one and that one, a quarter overlap", {"wait": 1}, False),
        ("panorama, waiting hour and half each", {"wait": 5400}, True),
        ("panorama, waiting minute and a half each", {"wait": 90}, True),
    ],
)
def test_a_number_that_counts_things_is_no_measure(
    embedded: Any, prompt: str, parameters: dict[str, Any], possible: bool
) -> None:
    assert admitted(embedded, ("HorizontalPanorama", parameters), prompt=prompt) is possible


@pytest.mark.parametrize(
    ("prompt", "seconds", "possible"),
    [
        ("hold twelve minutes at the lock, then at the weir four", 240, True),
        ("stay for 3 h and later two more", 7200, True),
        ("follow course 075, then hold", 75, False),
        ("steer 120 and wait", 120, False),
        ("hold here for niner-zero seconds", 90, True),
        ("hold one-five minutes", 900, True),
    ],
)
def test_durations_as_they_are_said(
    embedded: Any, prompt: str, seconds: float, possible: bool
) -> None:
    assert admitted(embedded, ("KeepStation", {"duration": seconds}), prompt=prompt) is possible


def survey(radius: float) -> tuple[str, dict[str, Any]]:
    return "SurveyTarget", {"target_position": [0, 0], "radius": radius}


def hold(seconds: float) -> tuple[str, dict[str, Any]]:
    return "KeepStation", {"duration": seconds}


def go(x: float, y: float) -> tuple[str, dict[str, Any]]:
    return "Transit", {"target_position": [x, y]}


@pytest.mark.parametrize(
    ("prompt", "possible", "impossible"),
    [
        # Numbers are rounded to two or four decimals, places to two.
        ("survey home at 10.123456 m off", survey(10.12), survey(10.123)),
        ("survey home at 10.123456 m off", survey(10.1235), survey(10.12346)),
        ("go to [12.346, 5]", go(12.35, 5), go(12.346, 5)),
        # The bounds of a parameter, and of a number that can be written.
        ("hold for 604800 s", hold(604800), hold(604801)),
        ("hold for 0 s or 604801 s", hold(0), hold(604801)),
        ("go to [9999999, 5] or [10000000, 5]", go(9999999, 5), go(10000000, 5)),
        (
            "panorama, 8 sectors or 9.5 sectors",
            ("HorizontalPanorama", {"sectors": 8}),
            ("HorizontalPanorama", {"sectors": 9}),
        ),
    ],
)
def test_stated_numbers_are_written_as_parameters_take_them(
    embedded: Any,
    prompt: str,
    possible: tuple[str, dict[str, Any]],
    impossible: tuple[str, dict[str, Any]],
) -> None:
    assert admitted(embedded, possible, prompt=prompt)
    assert not admitted(embedded, impossible, prompt=prompt)


def test_places_lie_a_stated_way_off(embedded: Any) -> None:
    prompt = "A panorama from a spot forty metres due south of home."
    assert admitted(embedded, ("Transit", {"target_position": [0, -40]}), prompt=prompt)


BOX = "Chart the box 20,20 / 80,20 / 80,60 / 20,60, lanes 5 m apart."


@pytest.mark.parametrize(
    ("command", "center", "sides", "possible"),
    [
        (BOX, [50, 40], (60, 40), True),
        (BOX, [50, 40], (40, 60), False),
        (BOX, [50, 40], (60, 5), False),
        (BOX, [20, 20], (80, 20), False),
        (BOX, [80, 60], (20, 20), False),
        (f"{BOX[:-1]}, so 60 m wide, 40 m long.", [50, 40], (60, 40), True),
        (f"{BOX[:-1]}, so 60 m wide, 40 m long.", [20, 20], (60, 40), False),
        ("Chart 10 by 5 m at 20,20, 80,20, 80,60 and 20,60.", [20, 20], (10, 5), True),
        (f"Stay in {BOX[10:41]}. Chart at 30,30, width 8, length 12.", [30, 30], (8, 12), True),
        ("Chart the box 20,20 / 80,25 / 80,60 / 20,60.", [20, 20], (80, 20), True),
    ],
)
def test_an_area_of_four_corners_is_written_whole(
    embedded: Any, command: str, center: list[float], sides: tuple[float, float], possible: bool
) -> None:
    given = {"center": center, "width": sides[0], "length": sides[1]}
    assert admitted(embedded, ("BathymetryGridSurvey", given), prompt=command) is possible


def test_an_area_of_four_corners_is_surveyed_once_and_not_round_home(embedded: Any) -> None:
    survey = ("BathymetryGridSurvey", {"center": [50, 40], "width": 60, "length": 40})
    look = ("SurveyTarget", {"target_position": [80, 60]})
    assert admitted(embedded, survey, look, prompt=BOX)
    assert not admitted(embedded, survey, survey, prompt=BOX)
    assert not admitted(embedded, (survey[0], {**survey[1], "center": [0, 0]}), prompt=BOX)


def test_the_logic_of_the_plan_holds_as_well(embedded: Any) -> None:
    go: tuple[str, dict[str, Any]] = ("Transit", {"target_position": [120, -35]})
    assert admitted(
        embedded,
        go,
        ("PerformOrbit", {"center": [120, -35], "radius": 25, "arc": 180}),
        ("DriftAudit", {"duration": 1800}),
    )
    assert not admitted(embedded, go, ("PerformOrbit", {"center": [0, 0]}))
    assert not admitted(embedded, ("Transit", {"target_position": UNKNOWN}))
    assert not admitted(embedded, ("PerformOrbit", {"center": [120, -35]}))


def test_sentences_have_no_numbers_that_nobody_said(embedded: Any) -> None:
    entry = ("KeepStation", {"duration": 1800})
    assert admitted(embedded, entry, sentence="Hold at [120, -35] for 1800 seconds, 25 m off.")
    assert admitted(embedded, entry, sentence='Say "hold" at -99 or home, 0.')
    assert not admitted(embedded, entry, sentence="Hold for 31 minutes.")
    assert not admitted(embedded, entry, sentence="Hold for 1801 seconds.")
    digits = "1234567890123456"
    for number, possible in ((digits, True), (digits + "7", False)):
        command = f"hold for 1800 s at contact {number}"
        assert admitted(embedded, entry, prompt=command, sentence=number) is possible


def test_where_facts_cannot_be_read_there_is_room_and_a_note(embedded: Any) -> None:
    factory = make_factory(embedded, "mission", load_vocabulary(), "grounded")

    def notes(prompt: str) -> str:
        return " ".join(factory.start({"prompt": prompt}).notes)

    assert notes(COMMAND) == ""
    assert notes("Be done by 14:00 and report, next week we repair the landing.") == ""
    assert "another script" in notes("请检查位于[12, -40]的红色浮标")
    assert "not known" in notes(
        "Fahren Sie bitte sofort zum roten Seezeichen und umkreisen Sie es dreimal"
    )
    assert "1.000.000" in notes("hold at the buoy for 1.000.000 seconds")
    assert "boat lengths" in notes("circle the buoy at two boat lengths")
    assert "coordinates" in notes("go to the place with easting 40, the other number you know")
    assert admitted(
        embedded,
        ("KeepStation", {"duration": 777}),
        prompt="hold at the buoy for 1.000.000 seconds",
    )
    assert not admitted(
        embedded, ("KeepStation", {"duration": 777}), prompt="hold at the buoy for 1000 seconds"
    )


@pytest.mark.parametrize("name", ADVERSARIAL)
@pytest.mark.parametrize("level", LEVELS)
def test_any_command_gives_valid_answers_that_end(tokenizer: Any, level: Level, name: str) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, "grounded")
    record = {
        "prompt": ADVERSARIAL[name],
        "task": "FollowTarget",
        "parameters": {"target_id": 'say "x"', "target_position": [5, 7]},
    }
    for seed in range(2):
        constraint = factory.start(record)
        plan = decoded(
            tokenizer,
            random_answer(constraint, LIMITS[level], seed, busy=tokenizer if seed else None),
        )
        assert plan_problems(level, plan, vocabulary, strict=True) == []
    if level == "mission" and not constraint.notes:
        assert rule_problems(plan, vocabulary) == [] or all(
            "return" in problem or "its place" in problem
            for problem in rule_problems(plan, vocabulary)
        )
        texts = [
            text
            for _name, values in named_entries(level, plan)
            for value in values.values()
            for text in (value if isinstance(value, list) else [value])
        ]
        assert not any(
            missing_words(ADVERSARIAL[name], text, misspelt=True)
            for text in texts
            if isinstance(text, str)
        )


@pytest.mark.parametrize("level", LEVELS)
def test_right_plans_can_be_written(embedded: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(embedded, level, vocabulary, "grounded")
    curated = [*read_jsonl(CURATED / "train.jsonl"), *read_jsonl(CURATED / "validation.jsonl")]
    drawn = list(
        itertools.islice(sample_missions(9), 120)
        if level == "mission"
        else sample_tasks(vocabulary, 9, 100, "train")
    )
    for records, share in (
        (curated if level == "mission" else [], 1.0),
        (drawn, 0.98 if level == "mission" else 0.94),
    ):
        refused = []
        for record in records:
            ids = answer_ids(embedded, completion_text(level, record["expected"], vocabulary))
            if taken(factory.start(record, 4096), ids) < len(ids):
                refused.append(record["prompt"])
        assert len(refused) <= (1 - share) * len(records), refused


def test_a_grid_of_stated_size_is_written_whole_or_not_at_all(embedded: Any) -> None:
    vocabulary = load_vocabulary()
    sizes = {"center": [0, 0], "width": 20, "length": 20, "spacing": 5}
    record = {"task": "BathymetryGridSurvey", "prompt": "Survey the depths.", "parameters": sizes}
    lanes = lawnmower((0, 0), 20, 20, 5)
    steps = [plan_step("GoToXY", {"x": x, "y": y}, [], [], vocabulary) for x, y in lanes]
    factory = make_factory(embedded, "task", vocabulary, "grounded")
    for count in (8, 10):
        text = completion_text("task", {"skill_sequence": steps[:count]}, vocabulary)
        ids = answer_ids(embedded, text)
        assert (taken(factory.start(record), ids) == len(ids)) is (count == len(lanes))


def turned(prompt: str, *movements: tuple[str, dict[str, float]]) -> dict[str, Any]:
    """A task input that says which way to turn, and the movements that it asks for."""
    steps = [
        plan_step(name, parameters, [], [], load_vocabulary())
        for name, parameters in (("GoToXY", {"x": 5, "y": -12}), *movements)
    ]
    return {
        "task": "Transit",
        "parameters": {"target_position": [5, -12]},
        "prompt": prompt,
        "expected": {"skill_sequence": steps},
    }


# All of a turn is known but what runs beside it: its text ends within a token of the embedded
# candidate's tokenizer.
TURNED = [
    turned(
        "Drive to [5, -12], turn to 270 degrees, then hold within one metre.",
        ("RotateToHeading", {"heading": 270}),
        ("StationKeep", {"radius": 1}),
    ),
    turned(
        "Go to [5, -12] and turn 5 degrees to port. Hold for 30 seconds.",
        ("NudgeYaw", {"delta_yaw": -5}),
        ("StationKeep", {"time": 30}),
    ),
]


@pytest.mark.parametrize("level", LEVELS)
def test_expected_tokens_are_those_of_training(tokenizer: Any, level: Level) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, level, vocabulary, "grounded")
    right = count = 0
    records = read_jsonl(CURATED / "validation.jsonl")[:12] if level == "mission" else TURNED
    for record in records:
        ids = answer_ids(tokenizer, completion_text(level, record["expected"], vocabulary))
        constraint = factory.start(record, 4096)
        for place, token in enumerate(ids):
            expected = constraint.expected()
            pairs = zip(expected, ids[place:], strict=False)
            right += sum(1 for _ in itertools.takewhile(lambda pair: pair[0] == pair[1], pairs))
            count += len(expected)
            constraint.accept(token)
    assert right > 0.4 * count > 0, (right, count)


def test_a_fence_has_corners_that_the_input_states(embedded: Any) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(embedded, "task", vocabulary, "grounded")
    record = {
        "task": "DriftAudit",
        "parameters": {},
        "prompt": (
            "Float. Fence corners, in kilometres: [-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5,"
            " 0.5]."
        ),
    }
    answer = '{"skill_sequence":[{"navigation_skill":{"name":"DriftWithCurrent","parameters":{}},"filter_skills":[{"name":"BoundaryEnforcement",'
    answer += '"parameters":{"poly_coords":%s'
    right = answer_ids(embedded, answer % "[[-500,-500],[500,-500],[500,500],[-500,500]]")
    assert taken(factory.start(record), right) == len(right)
    wrong = answer_ids(embedded, answer % "[[-500,-500],[400,-500],[500,500]]")
    assert taken(factory.start(record), wrong) < len(wrong)
    # Up to eight known places, home among them, have corners in between.
    between = answer_ids(embedded, answer % "[[1,10],[2,20],[1,20]]")
    for count, possible in ((7, True), (8, False)):
        corners = ", ".join(f"[{place}, {10 * place}]" for place in range(1, count + 1))
        many = {**record, "prompt": f"Float. Fence corners {corners}."}
        assert (taken(factory.start(many), between) == len(between)) is possible


@pytest.mark.parametrize(
    ("words", "seconds", "possible"),
    [("twice as long", 120, True), ("half the time", 30, True), ("for as long", 120, False)],
)
def test_a_time_may_be_told_by_another_one(
    embedded: Any, words: str, seconds: float, possible: bool
) -> None:
    vocabulary = load_vocabulary()
    prompt = f"Hold 60 s at [5, -12], then move to [9, 4] and stay there {words}."
    places, times = ({"x": 5, "y": -12}, {"x": 9, "y": 4}), ({"time": 60}, {"time": seconds})
    moves = [
        (name, given)
        for pair in zip(places, times, strict=True)
        for name, given in zip(("GoToXY", "StationKeep"), pair, strict=True)
    ]
    plan = {
        "skill_sequence": [
            plan_step(name, dict(given), [], [], vocabulary) for name, given in moves
        ]
    }
    ids = answer_ids(embedded, completion_text("task", plan, vocabulary))
    record = {"task": "Transit", "parameters": {"target_position": [5, -12]}, "prompt": prompt}
    constraint = make_factory(embedded, "task", vocabulary, "grounded").start(record, 4096)
    assert (taken(constraint, ids) == len(ids)) is possible


def test_a_value_that_the_model_insists_on_is_released_and_noted(embedded: Any) -> None:
    vocabulary = load_vocabulary()
    record = {"task": "KeepStation", "parameters": {}, "prompt": "Hold for 12 s within 4 m."}
    begun = '{"skill_sequence":[{"navigation_skill":{"name":"StationKeep","parameters":{"time":'
    constraint = make_factory(embedded, "task", vocabulary, "grounded").start(record, 2048)
    logic = make_factory(embedded, "task", vocabulary, "state").start(record, 2048)
    for token in embedded.encode(begun, add_special_tokens=False):
        constraint.accept(token)
        logic.accept(token)
    (nine,) = embedded.encode("9", add_special_tokens=False)
    (letter,) = embedded.encode("x", add_special_tokens=False)
    assert not constraint.allows(nine) and logic.allows(nine)
    assert not constraint.release(letter) and not constraint.allows(nine)
    assert constraint.release(nine) and constraint.allows(nine)
    constraint.accept(nine)
    assert any("StationKeep" in note for note in constraint.notes)
    assert not logic.release(nine)


def test_degrees_are_no_place_in_metres(embedded: Any) -> None:
    record = {"prompt": "Go to 54.3217 N, 10.1412 E and hold."}
    constraint = make_factory(embedded, "mission", load_vocabulary(), "grounded").start(record)
    begun = '{"tasks":[{"title":"Transit","parameters":{"target_position":['
    for token in embedded.encode(begun, add_special_tokens=False):
        constraint.accept(token)
    (five,) = embedded.encode("5", add_special_tokens=False)
    assert not constraint.allows(five) and not constraint.release(five)
