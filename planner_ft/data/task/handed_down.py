"""Task inputs as the Mission Agent hands them down: the tasks of synthetic missions, each with the
skills that it stands for.

The sampler's prompts say what to do skill by skill; a task prompt that comes from a mission plan
says what is wanted ("Circle the met mast at [120, -35] at a stand-off of 25 m."). Unresolved places
are filled in first, as they are before the Task Agent runs. A task whose geometry its parameters
leave open (a grid without spacing, a survey without stand-off) is left out: no number is made up.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic import sample_missions
from planner_ft.data.task import geometry as g
from planner_ft.data.task.steps import plan_step
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems

Step = tuple[str, dict[str, Any]]
Skills = tuple[list[Step], list[Step]]
"""Movements in order, and the perception skills that run beside each of them."""
Values = dict[str, Any]

TRANSITS = 0.3
"""Share of the Transits that are kept: every third task of a mission is one, and all are alike."""
HEALTH = ("VerifyGeotagQuality", "GetImageQualityMetrics", "GetHorizonAngle", "CheckLensClearness")
"""What a sensor health check covers: GPS, cameras, horizon, lens (the task's own description)."""


def handed_down_tasks(vocabulary: Vocabulary, seed: int) -> Iterator[dict[str, Any]]:
    """Endless task records from synthetic missions; the same seed gives the same records.

    Raises PlannerError for a vocabulary of another vehicle.
    """
    missing = [title for title in BUILDERS if title not in vocabulary.task]
    if missing:
        raise PlannerError(
            f"vocabulary {vocabulary.name}: has no task {missing[0]}; tasks of synthetic missions"
            " can be handed down for usv alone"
        )
    for mission in sample_missions(seed):
        rng = Random(f"{seed}:{mission['id']}")
        place: list[float] = [rng.randrange(-200, 201, 5), rng.randrange(-200, 201, 5)]
        for number, entry in enumerate(mission["expected"]["tasks"]):
            if entry["title"] == "Transit" and rng.random() > TRANSITS:
                continue
            record = handed_down(
                entry, _subject(mission["expected"]["tasks"][:number]), place, vocabulary
            )
            if record is not None:
                yield {
                    "id": f"handed-down-{mission['id']}-{number}",
                    "family": f"handed-down/{entry['title']}",
                    **record,
                }


def handed_down(
    entry: dict[str, Any], subject: str | None, place: list[float], vocabulary: Vocabulary
) -> dict[str, Any] | None:
    """The record of one task of a plan, its open place filled in; None where the geometry is left
    open.

    `subject` is the target that was searched last, which a task at a place that has been found is
    about.
    """
    task = vocabulary.task[entry["title"]]
    unresolved = list(vocabulary.unresolved)
    values = {
        name: list(place) if value == unresolved else value
        for name, value in entry["parameters"].items()
    }
    skills = BUILDERS[task.title](values, subject) if task.title in BUILDERS else None
    if skills is None:
        return None
    beside = [
        {"name": name, "parameters": canonical_parameters(given, vocabulary.skill[name])}
        for name, given in skills[1]
    ]
    plan = {
        "skill_sequence": [
            plan_step(name, given, [], [dict(call) for call in beside], vocabulary)
            for name, given in skills[0]
        ]
    }
    problems = plan_problems("task", plan, vocabulary, strict=True)
    if problems:
        return None
    return {
        "task": task.title,
        "parameters": canonical_parameters(values, task),
        "prompt": entry["task_prompt"],
        "expected": plan,
    }


def _subject(before: list[dict[str, Any]]) -> str | None:
    return next(
        (
            entry["parameters"]["target_description"]
            for entry in reversed(before)
            if entry["title"] == "SearchAndDetect"
        ),
        None,
    )


def _goto(point: Any) -> Step:
    return "GoToXY", {"x": g.tidy(point[0]), "y": g.tidy(point[1])}


def _hold(values: Values, *beside: Step) -> Skills:
    return [("StationKeep", {"time": values["duration"]} if "duration" in values else {})], list(
        beside
    )


def _follow(values: Values, subject: str | None) -> Skills | None:
    way = [_goto(values["target_position"])] if "target_position" in values else []
    name = values.get("target_id", subject)
    return None if name is None else ([*way, ("VisualStationKeep", {"target_id": name})], [])


def _orbit(values: Values, _subject: str | None) -> Skills:
    given = {"radius": values["radius"]} if "radius" in values else {}
    return [("ArcTurn", {**given, **({"delta_yaw": values["arc"]} if "arc" in values else {})})], []


def _grid(values: Values, _subject: str | None) -> Skills | None:
    if (
        not {"width", "length", "spacing"} <= values.keys()
        or g.lane_count(values["width"], values["spacing"]) is None
    ):
        return None
    points = g.lawnmower(
        tuple(values["center"]), values["width"], values["length"], values["spacing"]
    )
    return (
        ([_goto(point) for point in points], [("GetSeabedDepth", {})])
        if len(points) <= 24
        else None
    )


def _survey(values: Values, _subject: str | None) -> Skills | None:
    if "radius" not in values:
        return None
    return [
        _goto(point)
        for point in g.survey_square(tuple(values["target_position"]), values["radius"])
    ], []


def _cable(values: Values, _subject: str | None) -> Skills | None:
    if not {"heading", "max_dist"} <= values.keys():
        return None
    return [
        _goto(point)
        for point in g.straight_line(tuple(values["start"]), values["heading"], values["max_dist"])
    ], [("DetectSonarFeature", {})]


def _panorama(values: Values, _subject: str | None) -> Skills | None:
    if "sectors" not in values or values["sectors"] > 12:
        return None
    steps: list[Step] = []
    for heading in g.sector_headings(values["sectors"]):
        steps.append(("RotateToHeading", {"heading": heading}))
        steps += [("StationKeep", {"time": values["wait"]})] if "wait" in values else []
    return steps, [("CaptureGeoSnapshot", {})]


def _hotspot(values: Values, _subject: str | None) -> Skills:
    width = values.get("scan_width_degrees")
    return [("NudgeYaw", {"delta_yaw": width}) if width is not None else ("StationKeep", {})], [
        ("LocateHotspot", {})
    ]


def _feature(name: str, *beside: str) -> Callable[[Values, str | None], Skills]:
    return lambda values, _subject: (
        [("VisualStationKeep", {"target_id": values[name]} if name in values else {})],
        [(skill, {}) for skill in beside],
    )


BUILDERS: dict[str, Callable[[Values, str | None], Skills | None]] = {
    "Diagnostics": lambda values, _: _hold(values, *((name, {}) for name in HEALTH)),
    "Transit": lambda values, _: ([_goto(values["target_position"])], []),
    "FollowTarget": _follow,
    "PerformOrbit": _orbit,
    "DockingApproach": lambda values, _: ([_goto(values["goal_position"])], []),
    "VisualDockingApproach": _feature("target_feature"),
    "DriftAudit": lambda values, _: (
        [("DriftWithCurrent", {"time": values["duration"]} if "duration" in values else {})],
        [],
    ),
    "KeepStation": lambda values, _: _hold(values),
    "HorizontalPanorama": _panorama,
    "ThermalHotspotLocalizer": _hotspot,
    "FeatureStare": _feature("feature_type", "SetStreamRecording"),
    "GlareFreeApproach": _feature("target_feature", "CaptureGeoSnapshot"),
    "ThermalTimeLapse": lambda values, _: _hold(values, ("GetThermalStats", {})),
    "BoatLandingClearanceSweep": lambda values, _: _hold(values, ("LogLidarSlice", {})),
    "BathymetryGridSurvey": _grid,
    "SubseaCableTrack": _cable,
    "SurveyTarget": _survey,
    "SearchAndDetect": lambda values, _: _hold(
        values, ("DetectObjects", {"class_list": [values["target_description"]]})
    ),
    "SmartDataHarvest": lambda values, _: _hold(values),
    "AutoGenerateReportSummary": lambda values, _: _hold(values),
}
"""By task title. A structure pass has no position of its own and is left to prompts that state
one.
"""
