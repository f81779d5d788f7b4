"""Task prompts, assumptions and constraints: short plain sentences with every stated fact, in few
forms that can be learnt.
"""

from __future__ import annotations

from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.labeller import UNRESOLVED, Planned
from planner_ft.data.mission.synthetic.mentions import name_of
from planner_ft.data.mission.synthetic.positions import position_words

DONE = {
    "PerformOrbit": "circled",
    "ParallelStructurePass": "passed",
    "FeatureStare": "filmed",
    "GlareFreeApproach": "photographed",
    "ThermalHotspotLocalizer": "scanned",
    "ThermalTimeLapse": "measured",
    "SurveyTarget": "inspected",
    "FollowTarget": "followed",
    "SubseaCableTrack": "tracked",
    "Transit": "approached",
}
BEGUN = {
    "KeepStation": "the vehicle holds position there",
    "DriftAudit": "the drift begins",
    "HorizontalPanorama": "the panorama is taken",
    "BoatLandingClearanceSweep": "its boat landing is scanned",
    "BathymetryGridSurvey": "the depths are surveyed",
}
ARC_WORDS = {360: "a full circle", 180: "half a circle", 90: "a quarter circle"}


def task_prompt(planned: Planned, rng: Random) -> str:
    """The intent of one task in one sentence."""
    sentence = _PROMPTS[planned.title](planned.parameters, planned, rng)
    purpose = (
        f" {planned.intent.purpose}" if planned.intent.purpose and not planned.inserted else ""
    )
    return f"{sentence}{purpose}."


def _place(planned: Planned) -> str:
    """The target with its place: "the met mast at [120, -35]", "[45, 10]", "the green barrel"."""
    target = planned.target
    if target is None:
        return ""
    if target.description is None or target.position is None:
        return name_of(target)
    return f"{name_of(target)} at {position_words(target.position)}"


def _thing(planned: Planned) -> str:
    """The target, or the part of it that is looked at, with its place."""
    part = f"the {planned.intent.part} of " if planned.intent.part else ""
    return part + _place(planned)


def _at(planned: Planned, word: str = "at") -> str:
    return f" {word} {_place(planned)}" if planned.target is not None else " where the vehicle is"


def _of(planned: Planned) -> str:
    target = planned.target
    if target is None:
        return " where the vehicle is"
    if planned.intent.part:
        return f" of the {planned.intent.part} of {name_of(target)}"
    return f" of {name_of(target)}" if target.description is not None else f" at {name_of(target)}"


def _say(parameters: dict[str, Any], name: str, pattern: str) -> str:
    return pattern.format(parameters[name]) if name in parameters else ""


def _once_found(planned: Planned) -> str:
    return " once it has been found" if UNRESOLVED in planned.parameters.values() else ""


def _transit(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    if planned.intent.home:
        return "Return home to [0, 0]"
    return f"Go to {_place(planned)}{_once_found(planned)}"


def _search(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    assert planned.target is not None
    whereabouts = f" {planned.target.whereabouts}" if planned.target.whereabouts else ""
    if planned.target.position is not None:
        whereabouts = f" around {position_words(planned.target.position)}"
    return f"Search for {name_of(planned.target)}{whereabouts} and confirm its position"


def _follow(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    assert planned.target is not None
    if planned.target.identity is not None:
        return f"Follow {planned.target.identity}" + _last_seen(p)
    return f"Follow {_place(planned)}{_once_found(planned)}"


def _last_seen(p: dict[str, Any]) -> str:
    return (
        f", last seen at {position_words(tuple(p['target_position']))}"
        if "target_position" in p
        else ""
    )


def _orbit(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    if "arc" not in p:
        text = f"Circle {_place(planned)}"
    else:
        text = (
            f"Make {ARC_WORDS.get(p['arc'], 'an arc of {} degrees'.format(p['arc']))} around"
            f" {_place(planned)}"
        )
    return text + _say(p, "radius", " at a stand-off of {} m") + _say(p, "speed", " at {} m/s")


def _pass(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    side = f"the {p['side_id']} side of " if "side_id" in p else ""
    return (
        f"Run along {side}{_place(planned)}"
        + _say(p, "length", " for {} m")
        + _say(p, "distance", ", {} m off")
        + _say(p, "speed", ", at {} m/s")
    )


def _dock(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Dock at {_place(planned)}"


def _visual_dock(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return (
        "Dock by camera"
        + _say(p, "target_feature", " on the {}")
        + _say(p, "distance", " and stop {} m off")
    )


def _drift(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Cut the propulsion{_at(planned)} and log the drift" + _say(
        p, "duration", " for {} seconds"
    )


def _keep(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Hold position{_at(planned)}" + _say(p, "duration", " for {} seconds")


def _panorama(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    sectors = _say(p, "sectors", " in {} sectors")
    return (
        f"Take a panorama{_at(planned)}{sectors}"
        + _say(p, "overlap", " with {} percent overlap")
        + _say(p, "wait", ", waiting {} seconds at each heading")
    )


def _hotspot(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Locate the hottest spot{_of(planned)}" + _say(
        p, "scan_width_degrees", " with a scan {} degrees wide"
    )


def _feature(planned: Planned, name: str) -> str:
    feature = planned.parameters[name]
    own = planned.target is not None and feature == planned.target.description
    return (
        name_of(planned.target)
        if own and planned.target is not None
        else f"the {feature}{_of(planned)}"
    )


def _stare(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Keep the camera on {_feature(planned, 'feature_type')} and record steady video" + _say(
        p, "duration", " for {} seconds"
    )


def _glare(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Reposition and photograph {_feature(planned, 'target_feature')} without glare"


def _time_lapse(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return (
        f"Take thermal readings{_of(planned)}"
        + _say(p, "interval", " every {} seconds")
        + _say(p, "duration", " for {} seconds")
    )


def _landing(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return f"Scan the boat landing{_of(planned)} with the LiDAR for clearance"


def _bathymetry(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    size = (
        f" over {p['width']} m by {p['length']} m"
        if "width" in p and "length" in p
        else _say(p, "width", " over a width of {} m") + _say(p, "length", " over a length of {} m")
    )
    return (
        f"Survey the depths around {_place(planned)}{size}"
        + _say(p, "spacing", " with lines {} m apart")
        + _once_found(planned)
    )


def _cable(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    assert planned.target is not None
    start = (
        "where it has been found" if p["start"] == UNRESOLVED else position_words(tuple(p["start"]))
    )
    return (
        f"Track {name_of(planned.target)} by sonar from {start}"
        + _say(p, "heading", " on a heading of {} degrees")
        + _say(p, "max_dist", " for at most {} m")
    )


def _survey(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    return (
        f"Inspect {_thing(planned)}"
        + _say(p, "radius", " at a stand-off of {} m")
        + _once_found(planned)
    )


def _harvest(p: dict[str, Any], planned: Planned, rng: Random) -> str:
    if "target_list" not in p:
        return "Upload the recorded data by priority"
    items = [item if "'s " in item else f"the {item}" for item in p["target_list"]]
    return f"Upload {', then '.join(items)}"


_PROMPTS = {
    "Diagnostics": lambda p, planned, rng: "Run a sensor health check",
    "AutoGenerateReportSummary": lambda p, planned, rng: "Write a report on what was observed",
    "Transit": _transit,
    "SearchAndDetect": _search,
    "FollowTarget": _follow,
    "PerformOrbit": _orbit,
    "ParallelStructurePass": _pass,
    "DockingApproach": _dock,
    "VisualDockingApproach": _visual_dock,
    "DriftAudit": _drift,
    "KeepStation": _keep,
    "HorizontalPanorama": _panorama,
    "ThermalHotspotLocalizer": _hotspot,
    "FeatureStare": _stare,
    "GlareFreeApproach": _glare,
    "ThermalTimeLapse": _time_lapse,
    "BoatLandingClearanceSweep": _landing,
    "BathymetryGridSurvey": _bathymetry,
    "SubseaCableTrack": _cable,
    "SurveyTarget": _survey,
    "SmartDataHarvest": _harvest,
}


def assumptions(plan: list[Planned]) -> list[str]:
    """What the plan takes for granted: targets to be found, doubtful positions, docks to be filled
    in, home.
    """
    found: dict[str, None] = {}
    for planned in plan:
        target = planned.target
        if planned.intent.home:
            found["Home is [0, 0]."] = None
        if target is None:
            continue
        if planned.title == "SearchAndDetect" and target.position is None:
            found[f"The position of {name_of(target)} is unknown until it has been found."] = None
        if target.doubtful and target.position is not None:
            found[f"{position_words(target.position)} is taken as correct."] = None
        if target.on_site:
            found[f"The vehicle lies at {name_of(target)}."] = None
        if target.spot and target.position is None:
            found[f"The position of {name_of(target)} is filled in before docking."] = None
    return list(found)


def constraints(plan: list[Planned]) -> list[str]:
    """Which targets must be found before what is done with them."""
    lines = []
    for index, planned in enumerate(plan):
        if planned.title != "SearchAndDetect" or planned.target is None:
            continue
        use = next(
            (
                later
                for later in plan[index + 1 :]
                if later.target == planned.target and _is_use(later)
            ),
            None,
        )
        if use is not None:
            lines.append(_must_be_found(planned.target, use))
    return lines


def _is_use(planned: Planned) -> bool:
    return planned.title != "Transit" or not planned.inserted


def _must_be_found(target: Target, use: Planned) -> str:
    name = name_of(target)
    name = name[0].upper() + name[1:]
    feature = use.parameters.get("feature_type") or use.parameters.get("target_feature")
    subject = f"its {feature}" if feature and feature != target.description else "it"
    if use.title in BEGUN:
        return f"{name} must be found before {BEGUN[use.title]}."
    return (
        f"{name} must be found before {subject}"
        f" {'are' if feature and feature != target.description and _plural(feature) else 'is'}"
        f" {DONE[use.title]}."
    )


def _plural(text: str) -> bool:
    head = text.split(" with ")[0].split(" on the ")[0]
    return head.endswith("s") and not head.endswith("ss")
