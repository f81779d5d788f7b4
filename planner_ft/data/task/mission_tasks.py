"""Task inputs as the Mission Agent writes them: the tasks of synthetic missions, each with the
skills that it stands for.

The sampler's prompts say what to do skill by skill; a task prompt that comes from a mission plan
says what is wanted ("Circle the met mast at [120, -35] at a stand-off of 25 m."). Unresolved places
are filled in first, as they are before the Task Agent runs. A task whose geometry its parameters
leave open (a grid without spacing, a survey without stand-off) is left out: no number is made up.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from random import Random
from typing import Any

from planner_ft.data.clauses import Beside
from planner_ft.data.missions import missions_with_skills
from planner_ft.data.task.steps import Entry, Step, entry_of, plan_step
from planner_ft.facts import geometry as g
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters, plan_problems

TRANSITS = 0.3
"""Share of the Transits without clauses that are kept: every third task is one, and all are alike."""
LONGEST_GRID, MOST_SECTORS = 24, 12
HEALTH = ("VerifyGeotagQuality", "GetImageQualityMetrics", "GetHorizonAngle", "CheckLensClearness")
"""What a sensor health check covers: GPS, cameras, horizon, lens (the task's own description)."""

SINGLE: dict[str, tuple[str, dict[str, str], Sequence[str]]] = {
    "Diagnostics": ("StationKeep", {"time": "duration"}, HEALTH),
    "PerformOrbit": ("ArcTurn", {"radius": "radius", "delta_yaw": "arc"}, ()),
    "VisualDockingApproach": ("VisualStationKeep", {"target_id": "target_feature"}, ()),
    "DriftAudit": ("DriftWithCurrent", {"time": "duration"}, ()),
    "KeepStation": ("StationKeep", {"time": "duration"}, ()),
    "FeatureStare": ("VisualStationKeep", {"target_id": "feature_type"}, ["SetStreamRecording"]),
    "GlareFreeApproach": (
        "VisualStationKeep",
        {"target_id": "target_feature"},
        ["CaptureGeoSnapshot"],
    ),
    "ThermalTimeLapse": ("StationKeep", {"time": "duration"}, ["GetThermalStats"]),
    "BoatLandingClearanceSweep": ("StationKeep", {"time": "duration"}, ["LogLidarSlice"]),
    "SmartDataHarvest": ("StationKeep", {"time": "duration"}, ()),
    "AutoGenerateReportSummary": ("StationKeep", {"time": "duration"}, ()),
}
"""Tasks of one step: the movement, its parameters from the task's, and the skills beside it."""


def mission_tasks(vocabulary: Vocabulary, seed: int) -> Iterator[dict[str, Any]]:
    """Endless task records from synthetic missions; the same seed gives the same records.

    Raises PlannerError for a vocabulary of another vehicle.
    """
    missing = [title for title in SINGLE if title not in vocabulary.task]
    if missing:
        raise PlannerError(
            f"vocabulary {vocabulary.name}: has no task {missing[0]}; tasks of synthetic missions"
            " are there for usv alone"
        )
    for mission, beside in missions_with_skills(seed, None, vocabulary):
        rng = Random(f"{seed}:{mission['id']}")
        place: list[float] = [rng.randrange(-200, 201, 5), rng.randrange(-200, 201, 5)]
        subject = None
        for number, entry in enumerate(mission["expected"]["tasks"]):
            bare = entry["title"] == "Transit" and not beside[number]
            if not bare or rng.random() <= TRANSITS:
                record = task_record(entry, subject, place, vocabulary, beside[number])
                if record is not None:
                    family = f"mission-task/{entry['title']}"
                    yield {
                        "id": f"mission-task-{mission['id']}-{number}",
                        "family": family,
                        **record,
                    }
            if entry["title"] == "SearchAndDetect":
                subject = entry["parameters"]["target_description"]


def task_record(
    entry: dict[str, Any],
    subject: str | None,
    place: list[float],
    vocabulary: Vocabulary,
    added: Sequence[Beside] = (),
) -> dict[str, Any] | None:
    """The record of one task of a plan, its open place filled in; None where the geometry is left
    open.

    `subject` is the target that was searched last, which a task at a place that has been found is
    about; `added` are the skills that clauses of the command put beside the task.
    """
    task = vocabulary.task[entry["title"]]
    values = {
        name: list(place) if value == list(vocabulary.unresolved) else value
        for name, value in entry["parameters"].items()
    }
    movements, own = _skills(task.title, values, subject)
    if not movements:
        return None
    beside: dict[str, list[Entry]] = {"filter": [], "perception": []}
    for role, name, given in (*(("perception", *skill) for skill in own), *added):
        skill = entry_of(name, given, vocabulary)
        if skill not in beside[role]:
            beside[role].append(skill)
    steps = [
        plan_step(name, given, list(beside["filter"]), list(beside["perception"]), vocabulary)
        for name, given in movements
    ]
    plan = {"skill_sequence": steps}
    if plan_problems("task", plan, vocabulary, strict=True):
        return None
    return {
        "task": task.title,
        "parameters": canonical_parameters(values, task),
        "prompt": entry["task_prompt"],
        "expected": plan,
    }


def _skills(
    title: str, values: dict[str, Any], subject: str | None
) -> tuple[list[Step], list[Step]]:
    """Movements in order, none where they are left open, and what runs beside each of them. A
    structure pass has no position of its own and is left to prompts that state one.
    """
    if title in SINGLE:
        name, links, skills = SINGLE[title]
        given = {key: values[own] for key, own in links.items() if own in values}
        return [(name, given)], [(skill, {}) for skill in skills]
    if title == "SearchAndDetect":
        hold = {"time": values["duration"]} if "duration" in values else {}
        looked_for = {"class_list": [values["target_description"]]}
        return [("StationKeep", hold)], [("DetectObjects", looked_for)]
    if title == "ThermalHotspotLocalizer":
        width = values.get("scan_width_degrees")
        turn: Step = ("StationKeep", {}) if width is None else ("NudgeYaw", {"delta_yaw": width})
        return [turn], [("LocateHotspot", {})]
    if title == "FollowTarget":
        target = values.get("target_id", subject)
        way = _route([values["target_position"]] if "target_position" in values else [])
        return ([*way, ("VisualStationKeep", {"target_id": target})] if target else []), []
    if title == "HorizontalPanorama":
        count = values.get("sectors", 0)
        stop: list[Step] = [("StationKeep", {"time": values["wait"]})] if "wait" in values else []
        turns: list[Step] = []
        for heading in g.sector_headings(count) if 0 < count <= MOST_SECTORS else []:
            turns += [("RotateToHeading", {"heading": heading}), *stop]
        return turns, [("CaptureGeoSnapshot", {})]
    skill = {"BathymetryGridSurvey": "GetSeabedDepth", "SubseaCableTrack": "DetectSonarFeature"}
    return _route(_points(title, values)), [(skill[title], {})] if title in skill else []


def _points(title: str, values: dict[str, Any]) -> Sequence[Sequence[float]]:
    """The waypoints of a task that goes to some, none where its parameters leave them open."""
    if title == "Transit":
        return [values["target_position"]]
    if title == "DockingApproach":
        return [values["goal_position"]]
    if title == "BathymetryGridSurvey" and {"width", "length", "spacing"} <= values.keys():
        width, length, spacing = values["width"], values["length"], values["spacing"]
        lanes = g.lane_count(width, spacing)
        if lanes is not None and 2 * lanes <= LONGEST_GRID:
            return g.lawnmower(tuple(values["center"]), width, length, spacing)
    if title == "SurveyTarget" and "radius" in values:
        return g.survey_square(tuple(values["target_position"]), values["radius"])
    if title == "SubseaCableTrack" and {"heading", "max_dist"} <= values.keys():
        return g.straight_line(tuple(values["start"]), values["heading"], values["max_dist"])
    return []


def _route(points: Sequence[Sequence[float]]) -> list[Step]:
    return [("GoToXY", {"x": g.tidy(x), "y": g.tidy(y)}) for x, y in points]
