"""Drawing one task: which parameters the command states, how they are said, and what is said beside
them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from random import Random

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.intents import Intent, Target
from planner_ft.data.mission.synthetic.lexicon import PURPOSES
from planner_ft.data.mission.synthetic.numbers import (
    Said,
    Style,
    quantity,
    say_count,
    say_degrees,
    say_duration,
    say_heading,
    say_interval,
    say_length,
    say_percent,
    say_speed,
)

Sayer = Callable[[Random, Style], Said]

ARCS = (
    360,
    360,
    360,
    360,
    180,
    180,
    180,
    90,
    90,
    270,
    45,
    60,
    120,
    135,
    150,
    200,
    210,
    225,
    240,
    300,
)
SCANS = (60, 75, 80, 90, 90, 100, 110, 120, 120, 140, 150, 160, 180, 180, 45, 30, 360)


@dataclass(frozen=True)
class Parameter:
    """A parameter that a command may state, with its share of commands and how it is drawn."""

    name: str
    share: float
    say: Sayer


PARAMETERS: dict[str, tuple[Parameter, ...]] = {
    "PerformOrbit": (
        Parameter("radius", 0.78, lambda rng, style: say_length(rng, style, 4, 80)),
        Parameter("speed", 0.28, say_speed),
        Parameter("arc", 0.46, lambda rng, style: say_degrees(rng, style, ARCS)),
    ),
    "ParallelStructurePass": (
        Parameter("side_id", 0.86, lambda rng, style: as_said(words.side(rng))),
        Parameter("length", 0.6, lambda rng, style: say_length(rng, style, 15, 300)),
        Parameter("distance", 0.7, lambda rng, style: say_length(rng, style, 3, 40)),
        Parameter("speed", 0.36, say_speed),
    ),
    "KeepStation": (Parameter("duration", 0.84, say_duration),),
    "DriftAudit": (Parameter("duration", 0.84, say_duration),),
    "HorizontalPanorama": (
        Parameter("sectors", 0.66, say_count),
        Parameter("overlap", 0.42, say_percent),
        Parameter("wait", 0.38, lambda rng, style: say_wait(rng, style)),
    ),
    "ThermalHotspotLocalizer": (
        Parameter("scan_width_degrees", 0.55, lambda rng, style: say_degrees(rng, style, SCANS)),
    ),
    "FeatureStare": (
        Parameter("duration", 0.74, lambda rng, style: say_duration(rng, style, brief=True)),
    ),
    "ThermalTimeLapse": (
        Parameter("duration", 0.86, say_duration),
        Parameter("interval", 0.78, say_interval),
    ),
    "BathymetryGridSurvey": (
        Parameter("spacing", 0.68, lambda rng, style: say_length(rng, style, 2, 25)),
    ),
    "SubseaCableTrack": (
        Parameter("heading", 0.74, say_heading),
        Parameter("max_dist", 0.66, lambda rng, style: say_length(rng, style, 100, 950, far=True)),
    ),
    "SurveyTarget": (Parameter("radius", 0.55, lambda rng, style: say_length(rng, style, 4, 60)),),
    "VisualDockingApproach": (
        Parameter("distance", 0.6, lambda rng, style: say_length(rng, style, 1, 9)),
    ),
}


def say_wait(rng: Random, style: Style) -> Said:
    """A pause of seconds at each heading."""
    while True:
        said = say_duration(rng, style, brief=True)
        if isinstance(said.value, int) and said.value <= 60:
            return said


def as_said(word: str) -> Said:
    return Said(word, word, word)


def stated(rng: Random, title: str, style: Style) -> tuple[dict[str, object], dict[str, Said]]:
    said = {
        item.name: item.say(rng, style)
        for item in PARAMETERS.get(title, ())
        if rng.random() < item.share
    }
    if (
        "interval" in said
        and "duration" in said
        and float(said["interval"].value) * 2 > float(said["duration"].value)
    ):
        # A series has room for more than one reading.
        minutes, seconds = rng.randint(4, 60), rng.choice((5, 10, 15, 20, 30, 40, 60))
        said["duration"] = quantity(minutes, "minute", minutes * 60, rng, style)
        said["interval"] = quantity(seconds, "second", seconds, rng, style)
    return {name: value.value for name, value in said.items()}, said


def draw_task(rng: Random, style: Style, title: str, target: Target | None) -> Intent:
    parameters, said = stated(rng, title, style)
    if title == "FeatureStare":
        name = words.feature(rng)
        parameters, said = (
            {"feature_type": name, **parameters},
            {"feature_type": as_said(name), **said},
        )
    elif title == "GlareFreeApproach":
        name = words.feature(rng)
        parameters, said = {"target_feature": name}, {"target_feature": as_said(name)}
    elif title == "BathymetryGridSurvey" and rng.random() < 0.86:
        width, length = say_length(rng, style, 20, 300), say_length(rng, style, 20, 300)
        parameters, said = (
            {"width": width.value, "length": length.value, **parameters},
            {"width": width, "length": length, **said},
        )
    if (
        title == "KeepStation"
        and target is not None
        and target.must_be_found
        and "duration" not in parameters
    ):
        # Staying with something that may move for no stated time would be FollowTarget.
        value = say_duration(rng, style)
        parameters, said = {"duration": value.value}, {"duration": value}
    roll = rng.random()
    purpose = rng.choice(PURPOSES[title]) if roll < 0.05 and title in PURPOSES else ""
    if roll > 0.93 and title in CONFIRMED and target is not None and target.description is not None:
        purpose = rng.choice(CONFIRMS)
    elif 0.8 < roll < 0.89 and title in RIDDEN:
        purpose = rng.choice(RIDERS)
    return Intent(title, target, parameters, said, purpose=purpose, part=_part(rng, title, target))


RIDERS = (
    "with the video running",
    "with video on",
    "filming as you go",
    "with the camera on",
    "with the LiDAR running",
    "taking pictures as you go",
    "recording video all the way",
    "with the sonar on",
    "and keep the camera on it throughout",
    "with the lights on",
    "collecting LiDAR data",
    "with video and LiDAR",
    "snapping stills on the way",
    "camera rolling",
    "with the thermal camera recording",
)
RIDDEN = frozenset(("PerformOrbit", "ParallelStructurePass", "SurveyTarget"))
"""Tasks that can have a sensor run beside them, which makes no task of its own."""
CONFIRMED = frozenset(
    ("SearchAndDetect", "SurveyTarget", "PerformOrbit", "FeatureStare", "ParallelStructurePass")
)
CONFIRMS = (
    "and confirm that it is still there",
    "and confirm whether it is still afloat",
    "and confirm it is intact",
    "and see whether it has moved",
    "and check whether it is still upright",
    "and confirm that it is lit",
    "and verify that nobody is aboard",
    "and see if it is damaged",
    "and confirm it has not sunk",
    "and make sure it has not drifted",
    "and confirm that nothing is missing",
    "and see if anything hangs from it",
    "and confirm that it is the right one",
)
PARTS = (
    "{} face",
    "{} side",
    "{} wall",
    "{} end",
    "hull",
    "deck",
    "roof",
    "waterline",
    "underside",
    "stern",
    "bow",
    "legs",
    "foundation",
    "upper half",
    "machinery space",
    "engine casing",
    "top",
    "base",
)


def _part(rng: Random, title: str, target: Target | None) -> str:
    """A part of the target that the command speaks of and no parameter holds."""
    if (
        title not in ("SurveyTarget", "ThermalTimeLapse", "ThermalHotspotLocalizer")
        or target is None
        or target.description is None
        or rng.random() > 0.09
    ):
        return ""
    return rng.choice(PARTS).format(words.side(rng)) if rng.random() < 0.7 else words.feature(rng)
