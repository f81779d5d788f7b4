"""The simulated vehicle: NAME.simulation.toml, completed by the profile of the plan."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from typing import Any, Literal

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import SIMULATION
from planner_ft.vocabulary.plans import is_number

DRIVES = ("differential", "free")
STEP = 0.2  # seconds of one step (published)
TOLERANCE = 1.0  # metres within which a position is reached (published; 2 m in the field)
FASTER = 1.5  # top speed over cruise speed, where the file says none


@dataclass(frozen=True)
class Vessel:
    """Metres, kg, m/s, rad/s, N; `drag` of surge, sway and yaw in 1/s; `thrust` of one thruster.

    `cruise` is the profile's speed, `endurance` (s) how long the battery lasts at it, `hotel` (N)
    what the electronics take as if it were thrust, `steering` (N) what turns take on average;
    `rays` is 0 without a LiDAR.
    """

    drive: Literal["differential", "free"]
    cruise: float
    endurance: float
    speed: float
    turn: float
    length: float = 1.0
    width: float = 1.0
    mass: float = 50.0
    drag: tuple[float, float, float] = (0.2, 1.0, 1.0)
    thrust: float = 50.0
    track: float = 1.0
    windage: float = 0.1
    hotel: float = 5.0
    steering: float = 5.0
    rays: int = 0
    reach: float = 0.0

    @property
    def inertia(self) -> float:
        """kg m^2 about the vertical axis, of a box."""
        return self.mass * (self.length**2 + self.width**2) / 12

    @property
    def radius(self) -> float:
        """Half the width in metres: a structure that comes closer is hit."""
        return self.width / 2

    @property
    def capacity(self) -> float:
        """N s of a full battery: thrust on a mission and hotel load over the endurance."""
        return self.endurance * self.draw

    @property
    def draw(self) -> float:
        """N that are drawn at cruise speed on a mission."""
        return self.mass * self.drag[0] * self.cruise + self.steering + self.hotel


def simulation_file(vocabulary: Vocabulary) -> dict[str, Any]:
    """NAME.simulation.toml; {} without one. Raises PlannerError for what it may not hold."""
    raw, where = vocabulary.beside(SIMULATION), f"{vocabulary.name}{SIMULATION}"
    known = ("vessel", "lidar", "skill", "task")
    if unknown := [key for key in raw if key not in known]:
        raise PlannerError(f"{where}: unknown table [{unknown[0]}]; there is {', '.join(known)}")
    if unknown := [name for name in raw.get("skill", {}) if name not in vocabulary.skill]:
        raise PlannerError(f"{where}: [skill.{unknown[0]}] is no skill of {vocabulary.name}")
    return raw


def build_vessel(vocabulary: Vocabulary, profile: Mapping[str, Any]) -> Vessel:
    """The vessel of a vocabulary with the profile of a plan document. Raises PlannerError."""
    import math

    raw, where = simulation_file(vocabulary), f"{vocabulary.name}{SIMULATION}"
    flies = any("altitude" in one.parameters for one in vocabulary.motion.skills.values())
    lidar = raw.get("lidar", {})
    values: dict[str, Any] = {
        "drive": "free" if flies else "differential",
        "speed": FASTER * profile["cruise_speed"],
        "turn": math.radians(profile["turn_rate"]),
        **raw.get("vessel", {}),
        **({"rays": lidar.get("rays"), "reach": lidar.get("range")} if lidar else {}),
    }
    names = [one.name for one in fields(Vessel) if one.name not in ("cruise", "endurance")]
    if unknown := [key for key in values if key not in names]:
        raise PlannerError(f"{where}: [vessel] has no key {unknown[0]!r}; {', '.join(names[:-2])}")
    if values["drive"] not in DRIVES:
        raise PlannerError(f"{where}: drive = {values['drive']!r} must be {' or '.join(DRIVES)}")
    for key, value in values.items():
        for one in value if key == "drag" and isinstance(value, list) else [value]:
            if key != "drive" and not (is_number(one) and one > 0):
                raise PlannerError(f"{where}: {key} = {value!r} must be above 0")
    values["drag"] = tuple(values.get("drag", Vessel.drag))
    if len(values["drag"]) != 3:
        raise PlannerError(f"{where}: drag must be three numbers: of surge, sway and yaw")
    values["turn"] = min(values["turn"], math.radians(profile["turn_rate"]))
    cruise = min(profile["cruise_speed"], values["speed"])
    return Vessel(cruise=cruise, endurance=profile["endurance"], **values)
