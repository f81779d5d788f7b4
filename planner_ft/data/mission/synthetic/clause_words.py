"""Small words and settings of clauses: leads, places, repetitions, vague values."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.numbers import COMPASS
from planner_ft.data.mission.synthetic.templates import Template

RETURN_NOUNS = (
    "a return home",
    "a return to base",
    "the trip home",
    "the run home",
    "a transit home",
    "the way back home",
)
RETURN_GERUNDS = (
    "coming home",
    "returning home",
    "heading home",
    "returning to base",
    "going back to base",
    "coming back",
    "going home",
)
SENSOR_TASKS = frozenset(
    (
        "FeatureStare",
        "GlareFreeApproach",
        "ThermalTimeLapse",
        "ThermalHotspotLocalizer",
        "HorizontalPanorama",
    )
)
UNPLACED = frozenset(
    (
        "KeepStation",
        "DriftAudit",
        "HorizontalPanorama",
        "ThermalHotspotLocalizer",
        "ThermalTimeLapse",
    )
)
"""What can be asked for without any place: it happens where the vehicle is."""
AT_A_POINT = SENSOR_TASKS | {"BoatLandingClearanceSweep", "SurveyTarget"}
HOLDS = (
    "stop beside {target} and {clause}",
    "stop at {target} and {clause}",
    "pull up next to {target} and {clause}",
    "lie off {target} and {clause}",
    "stop next to {target} and {clause}",
    "hold still beside {target} and {clause}",
    "stand off {target} and {clause}",
    "hold position off {target} while you {clause}",
    "stay beside {target} while you {clause}",
    "stop in front of {target} and {clause}",
)
PAIR_INTROS = (
    "there are two {many} out there, {first} and {second}",
    "we have two {many}, {first} and {second}",
    "two {many} to see today, {first} and {second}",
    "it's about two {many}: {first} and {second}",
    "you'll find two {many}, {first} and {second}",
    "there should be two {many}, {first} and {second}",
)
GOING = (
    "go to {target} and {clause}",
    "head over to {target} and {clause}",
    "proceed to {target} and {clause}",
    "go to {target}, {clause}",
    "make your way to {target} and {clause}",
    "move to {target} and {clause}",
    "run out to {target} and {clause}",
    "go out to {target} and {clause}",
    "go over to {target} and {clause}",
    "pop over to {target} and {clause}",
    "get yourself to {target} and {clause}",
)
HERE = (
    " where you are",
    " right here",
    " from where you are",
    " from here",
    " on the spot",
    " right where you are",
    " here",
    " at your present position",
    " from your current position",
    " where she lies now",
)
THERE = (
    "there",
    "right there",
    "on the spot",
    "from there",
    "while you are there",
    "at the same place",
    "at that spot",
)
RETRACTIONS = (
    ", no, scratch that, ",
    ", no wait, ",
    ", sorry, ",
    " - no, ",
    ", no, better ",
    ", or no, ",
    ", forget that, ",
    " ... actually no, ",
    ", correction, ",
    ", wait, no, ",
    ", belay that, ",
    ", strike that, ",
    ", hang on, no, ",
    ", I mean ",
)
SAME = (
    ", same again",
    ", same thing",
    ", likewise",
    ", in the same way",
    " too",
    ", same as before",
    ", the same way",
    ", same settings",
    " as well",
    ", ditto",
    ", same values",
    ", also like that",
)
TIME = (
    "for a while",
    "for a bit",
    "for some time",
    "until further notice",
    "as long as it takes",
    "for a little while",
    "until I call you",
    "until the ferry has passed",
    "for a moment",
)
SLOW = (
    "slowly",
    "nice and slow",
    "at a crawl",
    "at an easy pace",
    "taking your time",
    "at a moderate speed",
    "not too fast",
)
OFF = (
    "at a safe distance",
    "with plenty of room",
    "not too close",
    "close in",
    "a fair bit off",
    "from a respectful distance",
    "keeping well off",
)
VAGUE: dict[str, dict[str, tuple[str, ...]]] = {
    "FollowTarget": {
        "end": (
            "wherever it goes",
            "whatever it does",
            "until I tell you to stop",
            "until further notice",
            "until you hear from us",
            "and don't lose it",
            "until the lifeboat arrives",
        )
    },
    "KeepStation": {"duration": TIME},
    "DriftAudit": {"duration": TIME},
    "PerformOrbit": {"radius": OFF, "speed": SLOW},
    "ParallelStructurePass": {"distance": OFF, "speed": SLOW},
    "ThermalTimeLapse": {"duration": TIME, "interval": ("at regular intervals", "every so often")},
    "FeatureStare": {"duration": TIME},
    "SurveyTarget": {"radius": OFF},
    "HorizontalPanorama": {
        "overlap": ("with a good overlap", "with plenty of overlap"),
        "sectors": ("in as many sectors as you like",),
    },
    "SubseaCableTrack": {
        "max_dist": ("as far as you can", "to where it ends", "for a good stretch")
    },
    "BathymetryGridSurvey": {
        "spacing": ("with narrow lines", "with tight spacing", "in close lines")
    },
    "ThermalHotspotLocalizer": {"scan_width_degrees": ("with a wide scan", "with a narrow scan")},
    "VisualDockingApproach": {"distance": ("nice and gently", "stopping just short of it")},
}
BEARINGS = frozenset(COMPASS) | {name.replace("-", "") for name in COMPASS}

NAMING = frozenset(("target", "target_id", "target_description", "cable"))
ADJOINED = (
    "radius",
    "speed",
    "arc",
    "side_id",
    "length",
    "distance",
    "duration",
    "sectors",
    "overlap",
    "wait",
    "scan_width_degrees",
    "interval",
    "width",
    "spacing",
    "start",
    "heading",
    "max_dist",
    "target_position",
)
THREE_QUARTERS = tuple(
    Template(text)
    for text in (
        "three quarters of the way round",
        "for three quarters of a circle",
        "three quarters of a lap",
        "in a three-quarter circle",
        "for three quarters of a turn",
    )
)
