"""A strict reader of behaviour files, and a helm that takes movements as done.

No registry has a reader of MOOS-IvP's behaviour files. This one follows the helm's documentation
and its parser (the sources are named in planner_ft.exporters.moos_behaviours): continued lines are
joined, "//" begins a comment, a statement stands on a line of its own.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

LONGEST = 4999
GENERAL = {
    "name",
    "pwt",
    "condition",
    "activeflag",
    "idleflag",
    "endflag",
    "duration",
    "perpetual",
    "updates",
    "templating",
}
SETTINGS = {
    "BHV_Waypoint": {"speed", "capture_radius", "slip_radius", "points"},
    "BHV_StationKeep": {
        "center_activate",
        "outer_speed",
        "transit_speed",
        "inner_radius",
        "outer_radius",
    },
    "BHV_FullStop": {"delay_complete"},
    "BHV_ConstantHeading": {"heading", "complete_thresh"},
    "BHV_ConstantSpeed": {"speed"},
    "BHV_FixedTurn": {"fix_turn", "turn_dir", "speed", "timeout"},
    "BHV_OpRegionV24": {"save_poly"},
    "BHV_AvoidObstacleV24": {
        "min_util_cpa_dist",
        "max_util_cpa_dist",
        "pwt_inner_dist",
        "pwt_outer_dist",
        "completed_dist",
    },
}
COURSE_AND_SPEED = [
    {"BHV_Waypoint"},
    {"BHV_StationKeep"},
    {"BHV_FullStop"},
    {"BHV_FixedTurn"},
    {"BHV_ConstantHeading", "BHV_ConstantSpeed"},
]
NUMBER = r"-?\d+(\.\d+)?"
VALUES = {
    "points": rf"{NUMBER},{NUMBER}(\s*:\s*{NUMBER},{NUMBER})*",
    "save_poly": rf"{NUMBER},{NUMBER}(\s*:\s*{NUMBER},{NUMBER}){{2,}}",
}
WORDS = {
    "center_activate": "true",
    "perpetual": "true",
    "turn_dir": "star|port",
    "templating": "spawn",
    "updates": r"OBSTACLE_ALERT_\d+",
}
FLAG = re.compile(r'(?P<name>[A-Z][A-Z0-9_]*) = (?P<value>"[^"]*"|\S+)$')


@dataclass(frozen=True)
class Behaviour:
    kind: str
    settings: list[tuple[str, str]]

    def all(self, key: str) -> list[str]:
        return [value for name, value in self.settings if name == key]

    def one(self, key: str) -> str:
        (value,) = self.all(key)
        return value

    @property
    def name(self) -> str:
        return self.one("name")

    def flags(self, key: str) -> list[tuple[str, str]]:
        return [flag(value) for value in self.all(key)]

    def corners(self, key: str = "points") -> list[tuple[float, float]]:
        parts = [part.split(",") for part in self.one(key).split(":")]
        return [(float(x), float(y)) for x, y in parts]


@dataclass(frozen=True)
class File:
    variables: dict[str, str]
    behaviours: list[Behaviour]

    def moving(self) -> list[Behaviour]:
        """Behaviours of movements, without those that guard them."""
        return [
            one
            for one in self.behaviours
            if one.kind not in ("BHV_OpRegionV24", "BHV_AvoidObstacleV24")
        ]


def flag(text: str) -> tuple[str, str]:
    found = FLAG.match(text)
    assert found, text
    return found["name"], found["value"].strip('"')


def read(text: str) -> File:
    """The content of a behaviour file. Fails on whatever the helm would not take, or would take as
    something else.
    """
    variables: dict[str, str] = {}
    behaviours: list[Behaviour] = []
    lines = iter(statements(text))
    for line in lines:
        if line.startswith("initialize "):
            name, value = flag(line.removeprefix("initialize "))
            variables[name] = value
            continue
        kind, brace = line.removeprefix("Behavior = "), next(lines)
        assert line.startswith("Behavior = ") and kind in SETTINGS and brace == "{", line
        settings = []
        while (inner := next(lines)) != "}":
            key, _equals, value = inner.partition(" = ")
            settings.append((key, value))
        behaviours.append(Behaviour(kind, settings))
        _check(behaviours[-1])
    names = [behaviour.name for behaviour in behaviours]
    assert not [
        (one, other)
        for one in names
        for other in names
        if one is not other and other.startswith(one)
    ]
    return File(variables, behaviours)


def statements(text: str) -> list[str]:
    """Lines that say something, joined where they are continued, without comments."""
    assert all(
        len(line) <= LONGEST and not re.search(r"[\x00-\x09\x0b-\x1f\x7f]", line)
        for line in text.split("\n")
    )
    joined = re.sub(r"\\[ \t]*\n", "", text).split("\n")
    assert not any(line.startswith("#") or re.search(r"[$%][\[({]", line) for line in joined)
    return [said for line in joined if (said := line.split("//")[0].strip())]


def _check(behaviour: Behaviour) -> None:
    unknown = {key for key, _value in behaviour.settings} - GENERAL - SETTINGS[behaviour.kind]
    assert not unknown, unknown
    for key, value in behaviour.settings:
        if key == "condition":
            assert re.fullmatch(
                r"DEPLOY = true|MISSION_STEP = \d+|\(MISSION_STEP >= \d+\) and \(MISSION_STEP <="
                r" \d+\)",
                value,
            ), value
        elif key.endswith("flag"):
            flag(value)
            assert "[if]" not in value
        elif key == "name":
            assert re.fullmatch(r"\w+", value)
        else:
            assert re.fullmatch(VALUES.get(key, WORDS.get(key, NUMBER)), value), (key, value)


class Helm:
    """Runs a file, one movement after the other. `log` lists the movements, and the flags as they
    are posted.

    A movement that nothing ends is ended from outside, as whoever sees that it is over does.
    """

    def __init__(self, file: File) -> None:
        self.file, self.values, self.log = file, dict(file.variables), list[str]()
        self.values["DEPLOY"] = "true"

    def running(self) -> list[Behaviour]:
        return [
            one
            for one in self.file.behaviours
            if all(self._holds(condition) for condition in one.all("condition"))
        ]

    def run(self) -> list[str]:
        while moving := [one for one in self.running() if one in self.file.moving()]:
            assert {one.kind for one in moving} in COURSE_AND_SPEED
            first = moving[0]
            self.log.append(first.name)
            self._post(first.flags("activeflag"))
            if not any(name == "MISSION_STEP" for name, _value in first.flags("endflag")):
                assert first.one("perpetual") == "true" and not first.all("duration")
                self._post(
                    [
                        ("MISSION_STEP", str(int(self.values["MISSION_STEP"]) + 1)),
                        *first.flags("idleflag"),
                    ]
                )
            self._post(first.flags("endflag"))
        return self.log

    def _post(self, flags: list[tuple[str, str]]) -> None:
        self.values.update(flags)
        self.log += [f"{name}={value}" for name, value in flags if name.startswith("SKILL_")]

    def _holds(self, condition: str) -> bool:
        parts = re.findall(r"(\w+) (>=|<=|=) (\w+)", condition)
        step = int(self.values["MISSION_STEP"])
        tests = {
            "=": lambda name, value: self.values[name] == value,
            ">=": lambda _name, value: step >= int(value),
            "<=": lambda _name, value: step <= int(value),
        }
        return all(tests[sign](name, value) for name, sign, value in parts)
