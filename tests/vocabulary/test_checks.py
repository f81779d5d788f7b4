"""Each mistake in a definition or a file beside it is said once, in its own words, and nothing else
is said.
"""

from __future__ import annotations

import copy
import dataclasses
import math
import tomllib
from pathlib import Path
from typing import Any

import pytest

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED, build_vocabulary
from planner_ft.vocabulary.essentials import load_essentials
from planner_ft.vocabulary.limits import load_limits

DRONE: dict[str, Any] = tomllib.loads((BUNDLED / "inspection_drone.toml").read_text())
GONE = object()
"""Stands for a key that is taken out."""


def changed(*changes: tuple[str, Any]) -> dict[str, Any]:
    """The drone's definition with values at paths like "task.0.title"."""
    raw = copy.deepcopy(DRONE)
    for path, value in changes:
        *parts, last = (int(part) if part.isdigit() else part for part in path.split("."))
        place: Any = raw
        for part in parts:
            place = place[part]
        if value is GONE:
            del place[last]
        elif isinstance(place, list) and last == len(place):
            place.append(value)
        else:
            place[last] = value
    return raw


def said(raw: dict[str, Any], phrases: Any = None, **beside: Any) -> list[str]:
    try:
        build_vocabulary(raw, {} if phrases is None else phrases, "mine", **beside)
    except PlannerError as error:
        return str(error).removeprefix("mine: ").split("; ")
    return []


def parameter(**more: Any) -> list[tuple[str, Any]]:
    return [("task.0.parameters", [{"name": "it", "type": "number", **more}])]


FIRST = "task PreflightCheck"
IT = f"{FIRST}, parameter it"
APART = f"{IT}: minimum and maximum stand together, the smaller one first"
TABLES = f"{FIRST}: parameters must be a list of tables"
PLACELESS = "brings the vehicle to a place and needs a parameter of type position"


@pytest.mark.parametrize(
    ("changes", "problems"),
    [
        ([], []),
        ([("extra", 1)], ["unknown key 'extra'"]),
        ([("vehicle", 3)], ["a table [vehicle] is needed"]),
        ([("vehicle.title", " ")], ["[vehicle]: title = ' ' must be a text"]),
        (
            [("skill.0.name", "Fly\n")],
            ["skill Fly\n: name = 'Fly\\n' must be a text in one line, without blanks at its ends"],
        ),
        ([("vehicle.title", 7)], ["[vehicle]: title = 7 must be a text"]),
        ([("vehicle.frame", GONE), ("vehicle.title", GONE)], ["[vehicle]: lacks title, frame"]),
        ([("vehicle.home", [-99, -99])], ["[vehicle]: home and unresolved are the same position"]),
        *(
            ([("vehicle.home", wrong)], [f"[vehicle]: home = {wrong!r} must be a position [x, y]"])
            for wrong in (
                [1],
                [1, 2, 3],
                [1, "a"],
                [True, 1],
                [1, math.inf],
                "ab",
                {"x": 1, "y": 2},
            )
        ),
        ([("task", [])], ["at least one [[task]] is needed"]),
        ([("task", {"a": {}})], ["at least one [[task]] is needed"]),
        ([("skill", [3])], ["at least one [[skill]] is needed"]),
        ([("skill", GONE)], ["at least one [[skill]] is needed"]),
        ([("task.0.title", GONE)], ["task 1: lacks title"]),
        ([("skill.1.name", GONE)], ["skill 2: lacks name"]),
        ([("task.0.leaves", 1)], [f"{FIRST}: leaves = 1 must be true or false"]),
        ([("task.0.leaves", False)], []),
        (
            [("task.0.arrival", "teleport")],
            [f"{FIRST}: arrival = 'teleport' must be one of transit, self, none"],
        ),
        ([("task.0.colour", "red")], [f"{FIRST}: unknown key 'colour'"]),
        ([("task.0.require_any", "it")], [f"{FIRST}: require_any = 'it' must be a list of names"]),
        (
            [("task.0.require_any", [" "])],
            [f"{FIRST}: require_any = [' '] must be a list of names"],
        ),
        ([("task.0.parameters", 3)], [TABLES]),
        ([("task.0.parameters", [3])], [TABLES]),
        ([("task.0.parameters", {"it": {}})], [TABLES]),
        (parameter(), []),
        ([("task.0.parameters", [{"type": "number"}])], [f"{FIRST}, parameter None: lacks name"]),
        (
            [("task.0.parameters", [{"name": "it", "type": "number"}] * 2)],
            [f"{FIRST}: parameter it is defined twice"],
        ),
        (parameter(minimum=5, maximum=5), []),
        (parameter(minimum=0.5, maximum=1, type="integer"), []),
        (parameter(minimum=5.5, maximum=5), [APART]),
        (parameter(minimum=5), [APART]),
        (parameter(maximum=5), [APART]),
        (parameter(minimum="low", maximum=5), [f"{IT}: minimum = 'low' must be a number"]),
        (parameter(minimum=True, maximum=5), [f"{IT}: minimum = True must be a number"]),
        (
            parameter(minimum=1, maximum=5, type="text"),
            [f"{IT}: only numbers have a minimum and a maximum"],
        ),
        ([("task.0.skills", 3)], [f"{FIRST}: skills must be a table of lists by role"]),
        ([("task.0.skills", GONE)], [f"{FIRST}: skills must be a table of lists by role"]),
        (
            [("task.0.skills.pilot", [])],
            [f"{FIRST}: skills.pilot is none of navigation, filter, perception"],
        ),
        ([("task.0.skills.filter", "x")], [f"{FIRST}: skills.filter must be a list of names"]),
        ([("task.0.skills.navigation", [])], [f"{FIRST}: needs at least one navigation skill"]),
        ([("task.0.skills.navigation", GONE)], [f"{FIRST}: needs at least one navigation skill"]),
        ([("task.8", DRONE["task"][7])], ["task SendReport is defined twice"]),
        ([("skill.12", DRONE["skill"][11])], ["skill LogPosition is defined twice"]),
        ([("vehicle.locate", "Guess")], ["[vehicle] locate = 'Guess' is no task"]),
        ([("vehicle.transit", "Beam")], ["[vehicle] transit = 'Beam' is no task"]),
        ([("vehicle.transit", "SendReport")], [f"task SendReport: {PLACELESS}"]),
        ([("vehicle.locate", "SendReport")], []),  # an own vehicle may load so
        (
            [("task.1.require_any", ["speed"])],
            ["task FlyToPoint: require_any names 'speed', which is no parameter"],
        ),
        (
            [("skill.1.require_any", ["speed"])],
            ["skill Hover: require_any names 'speed', which is no parameter"],
        ),
        ([("task.1.require_any", ["target_position"])], []),
        ([("task.0.skills.filter", ["Warp"])], [f"{FIRST}: skill 'Warp' is not defined"]),
        (
            [("task.0.skills.filter", ["Hover"])],
            [f"{FIRST}: skill 'Hover' has the role navigation, not filter"],
        ),
    ],
)
def test_a_definition(changes: list[tuple[str, Any]], problems: list[str]) -> None:
    assert said(changed(*changes)) == problems


@pytest.mark.parametrize(
    ("phrases", "problems"),
    [
        ({"task": {"RoofScan": {}}, "skill": {"Hover": {}}}, []),
        ({"task": 3}, ["the phrase file needs tables [task.NAME]"]),
        ({"task": []}, ["the phrase file needs tables [task.NAME]"]),
        ({"skill": {"Hover": 3}}, ["the phrase file needs tables [skill.NAME]"]),
        (
            {"task": {"Sail": {}, "RoofScan": {}}, "skill": {"Dive": {}}},
            [
                "the phrase file has phrases for task 'Sail', which is not defined",
                "the phrase file has phrases for skill 'Dive', which is not defined",
            ],
        ),
    ],
)
def test_a_phrase_file(phrases: dict[str, Any], problems: list[str]) -> None:
    assert said(changed(), phrases) == problems


FACTS = {"data": {"lacking": "nothing"}}
GIVEN = {"fact": FACTS, "task": {"RoofScan": {"gives": ["data"]}}}


def logic(**entries: Any) -> dict[str, Any]:
    return {**GIVEN, "task": {**GIVEN["task"], **entries}}


SENDS = "the logic file: task SendReport: sends = {!r} must name a parameter of type texts"
UNGIVEN = "the logic file: no task gives the fact 'data'"


@pytest.mark.parametrize(
    ("raw", "problems"),
    [
        (GIVEN, []),
        (logic(SendReport={"needs": ["data"], "yields": ["anything"]}), []),
        ({**GIVEN, "facts": {}}, ["the logic file has an unknown key 'facts'"]),
        ({"fact": []}, ["the logic file needs tables [fact.NAME] and [task.TITLE]"]),
        ({"fact": {"data": 3}}, ["the logic file needs tables [fact.NAME] and [task.TITLE]"]),
        ({"task": {"RoofScan": 3}}, ["the logic file needs tables [fact.NAME] and [task.TITLE]"]),
        ({"fact": FACTS}, [UNGIVEN]),
        ({"fact": FACTS, "task": {"RoofScan": {"needs": ["data"]}}}, [UNGIVEN]),
        *(
            (
                {**GIVEN, "fact": {"data": wrong}},
                ["the logic file: fact data must have a text lacking, and nothing else"],
            )
            for wrong in ({}, {"lacking": " "}, {"lacking": "a", "more": "b"})
        ),
        (logic(Sail={"gives": []}), ["the logic file: task Sail: it is not defined"]),
        (
            logic(SendReport={"brings": ["data"]}),
            ["the logic file: task SendReport: unknown key 'brings'"],
        ),
        (
            logic(SendReport={"needs": "data"}),
            ["the logic file: task SendReport: needs = 'data' must be a list of names"],
        ),
        (
            logic(SendReport={"needs": ["pictures"]}),
            [
                "the logic file: task SendReport: needs names the fact 'pictures', which is not"
                " declared"
            ],
        ),
        (logic(SendReport={"sends": "items"}), [SENDS.format("items")]),
        (logic(SendReport={"sends": ["items"]}), [SENDS.format(["items"])]),
        (
            logic(RoofScan={"gives": ["data"], "sends": "width"}),
            [SENDS.format("width").replace("SendReport", "RoofScan")],
        ),
    ],
)
def test_a_logic_file(raw: dict[str, Any], problems: list[str]) -> None:
    assert said(changed(), logic=raw) == problems


MOVES = "the motion file: skill "


@pytest.mark.parametrize(
    ("raw", "problems"),
    [
        ({"skill": {"FlyToXY": {"motion": "go", "x": "x", "y": "y", "altitude": "altitude"}}}, []),
        ({"skill": {"KeepClearance": {"motion": "clearance", "distance": "distance"}}}, []),
        ({"skill": {"StayInGeofence": {"motion": "boundary", "polygon": "corners"}}}, []),
        ({"task": {"TowerOrbit": {"center": "center", "radius": "radius"}}}, []),
        ({"skills": {}}, ["the motion file has an unknown key 'skills'"]),
        ({"skill": 3}, ["the motion file needs tables [skill.NAME]"]),
        ({"task": {"TowerOrbit": 3}}, ["the motion file needs tables [task.NAME]"]),
        ({"skill": {"Sail": {"motion": "go"}}}, [f"{MOVES}Sail: it is not defined"]),
        ({"task": {"Sail": {}}}, ["the motion file: task Sail: it is not defined"]),
        (
            {"skill": {"Hover": {"motion": ["hold"]}}},
            [
                f"{MOVES}Hover: motion = ['hold'] must be one of go, hold, turn-to, turn-by, arc,"
                " drift, wait, boundary, clearance, heading"
            ],
        ),
        (
            {"skill": {"Hover": {"motion": "heading"}}},
            [f"{MOVES}Hover: motion = 'heading' does not fit the role navigation"],
        ),
        (
            {"skill": {"KeepClearance": {"motion": "wait"}}},
            [f"{MOVES}KeepClearance: motion = 'wait' does not fit the role filter"],
        ),
        (
            {"skill": {"FlyToXY": {"motion": "go", "x": "x"}}},
            [f"{MOVES}FlyToXY: go needs y = the name of a parameter"],
        ),
        (
            {"skill": {"Hover": {"motion": "hold", "speed": "time"}}},
            [f"{MOVES}Hover: unknown key 'speed'"],
        ),
        (
            {"skill": {"Hover": {"motion": "turn-to", "heading": "time"}}},
            [
                f"{MOVES}Hover: heading = 'time' is in s, and movements are in deg: define it, its"
                " bounds and its templates so"
            ],
        ),
        ({"task": {"HoverWatch": {"time": "duration"}}}, []),
        (
            {"task": {"HoverWatch": {"speed": "duration", "time": "length"}}},
            [
                "the motion file: task HoverWatch: time = 'length' must name a parameter of type number"
            ],
        ),
        (
            {"skill": {"StayInGeofence": {"motion": "boundary", "polygon": "corner"}}},
            [f"{MOVES}StayInGeofence: polygon = 'corner' must name a parameter of type polygon"],
        ),
        (
            {"task": {"TowerOrbit": {"center": "radius", "radius": "center"}}},
            [
                "the motion file: task TowerOrbit: center = 'radius' must name a parameter of type"
                " position",
                "the motion file: task TowerOrbit: radius = 'center' must name a parameter of type"
                " number",
            ],
        ),
        (
            {"task": {"TowerOrbit": {"center": "center"}}},
            [
                "the motion file: task TowerOrbit: a stand-off needs radius = the name of a"
                " parameter"
            ],
        ),
    ],
)
def test_a_motion_file(raw: dict[str, Any], problems: list[str]) -> None:
    assert said(changed(), motion=raw) == problems


ROOF = "[task.RoofScan]: "
SIZES = "there is center, width, length, spacing"
SKILL_TABLE = "must be a table of skills with their parameters: { SKILL = {} }"
TAKES = "must name a parameter of the skill, then one of the task"


@pytest.mark.parametrize(
    ("essentials", "problems"),
    [
        ('[task.RoofScan]\nskills = { TakePhoto = { note = "roof" } }\n', []),
        ('[task.RoofScan]\ntakes = { FlyToXY = { altitude = "width" } }\n', []),
        ('[task.RoofScan]\nduring = ["goto"]\ndefaults = { width = 5 }\nasks = ["length"]\n', []),
        ("[fact.data]\n", ["unknown key 'fact'", "there are tables [task.TITLE]"]),
        ("task = 3\n", ["needs tables [task.TITLE]"]),
        ("[task.Sail]\n", ["[task.Sail]: the vehicle has no such task"]),
        (
            "[task]\nRoofScan = 3\n",
            [f"{ROOF}must be a table with skills, during, takes, defaults, asks"],
        ),
        ("[task.RoofScan]\nneeds = []\n", [f"{ROOF}unknown key 'needs'"]),
        ("[task.RoofScan]\nskills = []\n", [f"{ROOF}skills {SKILL_TABLE}"]),
        ("[task.RoofScan]\nskills = { Hover = 3 }\n", [f"{ROOF}skills {SKILL_TABLE}"]),
        (
            "[task.RoofScan]\nskills = { Dive = {} }\n",
            [f"{ROOF}skills: the vehicle has no skill 'Dive'"],
        ),
        (
            "[task.RoofScan]\nskills = { LogPosition = { at = 1 } }\n",
            [f"{ROOF}skills: LogPosition: no parameter 'at'", "there is none"],
        ),
        (
            "[task.RoofScan]\nskills = { Hover = { time = -1 } }\n",
            [f"{ROOF}skills: Hover: time = -1 is not between 0 and 3600"],
        ),
        (
            '[task.RoofScan]\ntakes = { FlyToXY = { altitude = "depth" } }\n',
            [f"{ROOF}takes: FlyToXY.altitude = 'depth' {TAKES}"],
        ),
        (
            '[task.RoofScan]\ntakes = { FlyToXY = { depth = "width" } }\n',
            [f"{ROOF}takes: FlyToXY.depth = 'width' {TAKES}"],
        ),
        (
            '[task.RoofScan]\nduring = ["swim"]\n',
            [
                f"{ROOF}during: 'swim' is not a motion of skills",
                "there is goto, hold, turn_to, turn_by, arc, drift, visual, wait",
            ],
        ),
        (
            '[task.RoofScan]\nasks = "width"\n',
            ["task.RoofScan.asks: 'width' is not of type 'array'"],
        ),
        ("[task.RoofScan]\nasks = [[]]\n", ["task.RoofScan.asks[0]: [] is not of type 'string'"]),
        ('[task.RoofScan]\nasks = ["depth"]\n', [f"{ROOF}asks: 'depth' is not a parameter", SIZES]),
        (
            '[task.SendReport]\nasks = ["depth"]\n',
            ["[task.SendReport]: asks: 'depth' is not a parameter", "there is none"],
        ),
        (
            "[task.RoofScan]\ndefaults = []\n",
            [f"{ROOF}defaults must be a table of parameters with their values"],
        ),
        (
            "[task.RoofScan]\ndefaults = { depth = 1 }\n",
            [f"{ROOF}defaults: no parameter 'depth'", SIZES],
        ),
        (
            '[task.RoofScan]\ndefaults = { width = 1 }\nasks = ["width"]\n',
            [f"{ROOF}width has a default and is asked for: leave one of them out"],
        ),
    ],
)
def test_an_essentials_file(tmp_path: Path, essentials: str, problems: list[str]) -> None:
    (tmp_path / "mine.essentials.toml").write_text(essentials)
    drone = dataclasses.replace(load_vocabulary("inspection_drone"), path=tmp_path / "mine.toml")
    found = []
    try:
        load_essentials(drone)
    except PlannerError as error:
        found = str(error).removeprefix("inspection_drone.essentials.toml: ").split("; ")
    assert found == problems


FENCE = '[fence]\nsentences = ["Inside {polygon}."]\nprompts = ["In {polygon}."]\n'


@pytest.mark.parametrize(
    ("limits", "problem"),
    [
        (FENCE, ""),
        (FENCE + 'filter = "StayInGeofence"\nparameters = { corners = "polygon" }\n', ""),
        (FENCE + 'forbids = ["RecordVideo"]\n', ""),
        (FENCE.replace("fence", "fency"), "[fency]: no such kind of limit; there is fence,"),
        (FENCE.replace("In {polygon}", "In {area}"), "[fence]: no value area; there is polygon,"),
        ('[fence]\nsentences = ["a"]\n', "[fence]: sentences and prompts are needed"),
        ('[fence]\nprompts = ["a"]\n', "[fence]: sentences and prompts are needed"),
        (FENCE + 'filter = "Fence"\n', "[fence]: Fence is no skill with these parameters"),
        (
            FENCE + 'filter = "StayInGeofence"\nparameters = { area = "polygon" }\n',
            "[fence]: StayInGeofence is no skill with these parameters",
        ),
        (FENCE + 'forbids = ["Film"]\n', "[fence]: forbids Film, which is no skill"),
        (FENCE.replace("{polygon}", "{polygon"), "fence.sentences[0]: 'Inside {polygon.' does not"),
        ("fence = 3\n", "fence: 3 is not of type 'object'"),
    ],
)
def test_a_limits_file(tmp_path: Path, limits: str, problem: str) -> None:
    (tmp_path / "mine.limits.toml").write_text(limits)
    drone = dataclasses.replace(load_vocabulary("inspection_drone"), path=tmp_path / "mine.toml")
    found = ""
    try:
        assert set(load_limits(drone)) == {"fence"}
    except PlannerError as error:
        found = str(error)
    assert found.startswith(problem and f"inspection_drone.limits.toml: {problem}")
    assert bool(found) == bool(problem)
