"""What an operator wants, before it is put into words: targets and ordered intents."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from planner_ft.data.mission.synthetic.numbers import Said
from planner_ft.data.mission.synthetic.positions import Position

PLACE_TASKS = frozenset(
    (
        "PerformOrbit",
        "ParallelStructurePass",
        "KeepStation",
        "DriftAudit",
        "HorizontalPanorama",
        "ThermalHotspotLocalizer",
        "FeatureStare",
        "GlareFreeApproach",
        "ThermalTimeLapse",
        "BoatLandingClearanceSweep",
    )
)
"""Tasks performed at a place: a Transit brings the vehicle there."""

POSITION_PARAMETER = {
    "Transit": "target_position",
    "PerformOrbit": "center",
    "DockingApproach": "goal_position",
    "BathymetryGridSurvey": "center",
    "SubseaCableTrack": "start",
    "SurveyTarget": "target_position",
    "FollowTarget": "target_position",
}

NO_PLACE = frozenset(
    ("Diagnostics", "AutoGenerateReportSummary", "SmartDataHarvest", "VisualDockingApproach")
)
LEAVES = frozenset(("BathymetryGridSurvey", "SubseaCableTrack", "FollowTarget", "SearchAndDetect"))
"""Tasks after which the vehicle is not at the place that they are about."""


@dataclass(frozen=True)
class Target:
    """A place, structure or moving thing that the command speaks of; `key` tells targets of one
    command apart.

    `description` is written as in the plan, without article; `article` says whether texts put "the"
    before it. `identity` is the id or call sign of something to follow. `spot` marks a docking
    place, which is never searched. `movable` says that it can drift or be followed, `area` that it
    is a stretch of water rather than a thing. `said_as` is what the command says for the
    description ("green one" for "green buoy"). `on_site` means that the vehicle lies there already,
    by the command's own words.
    """

    key: int
    description: str | None = None
    position: Position | None = None
    article: bool = True
    identity: str | None = None
    spot: bool = False
    movable: bool = False
    area: bool = False
    doubtful: bool = False
    whereabouts: str = ""
    noun: str = ""
    said_as: str | None = None
    on_site: bool = False

    @property
    def must_be_found(self) -> bool:
        """True when only a search can tell where it is."""
        return (
            self.position is None and self.identity is None and not self.spot and not self.on_site
        )


@dataclass(frozen=True)
class Intent:
    """One thing to do: a task title, its target if it has one, and the parameters that the command
    states.

    A title of Transit or SearchAndDetect stands for a command that says "go to" or "find"; `home`
    for a return. `purpose` is why it is wanted; `instead` is what the command says first and takes
    back. `part` is the part of the target that is looked at, where no parameter holds it; `also`
    are further targets for the same. `said` holds the words of the stated parameters, `parameters`
    their values.
    """

    title: str
    target: Target | None = None
    parameters: dict[str, Any] = field(default_factory=dict)
    said: dict[str, Said] = field(default_factory=dict)
    home: bool = False
    purpose: str = ""
    instead: Intent | None = None
    part: str = ""
    also: tuple[Target, ...] = ()
