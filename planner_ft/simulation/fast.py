"""The simulated vehicle (NAME.simulation.toml, completed by the profile of the plan), and the fast
simulator of it: three degrees of freedom in numpy, all runs at once.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields
from importlib.metadata import EntryPoint
from typing import Any, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

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
    drag = values.get("drag", Vessel.drag)
    if not isinstance(drag, list | tuple) or len(drag) != 3:
        raise PlannerError(f"{where}: drag must be three numbers: of surge, sway and yaw")
    values["drag"] = tuple(drag)
    values["turn"] = min(values["turn"], math.radians(profile["turn_rate"]))
    cruise = min(profile["cruise_speed"], values["speed"])
    return Vessel(cruise=cruise, endurance=profile["endurance"], **values)


Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]
Runs = NDArray[np.intp]  # numbers of runs, shape (n,)


class Simulator(Protocol):
    """A batch of B vehicles. `pose` (B, 4): x east, y north, z up in metres, yaw in rad
    counter-clockwise from east (REP-103). `twist` (B, 4): surge, sway to port, climb in m/s and yaw
    rate in rad/s, over ground, in the body's axes.
    """

    step_seconds: float
    pose: Floats
    twist: Floats

    def reset(self, pose: Floats) -> None:
        """Put the vehicles at rest at `pose` (B, 4)."""

    def step(self, actuators: Floats, current: Floats, wind: Floats) -> None:
        """Advance one step. `actuators` (B, 2) are port and starboard thrust in N, or (B, 4) forces
        ahead, to port and up in N and a moment in N m; `current` and `wind` (B, 2) in m/s.
        """


def turned(vector: Floats, angle: Floats) -> Floats:
    """Vectors (n, 2) turned counter-clockwise by angles (n,) in rad."""
    cosine, sine = np.cos(angle), np.sin(angle)
    x, y = vector[:, 0], vector[:, 1]
    return np.stack([cosine * x - sine * y, sine * x + cosine * y], axis=1)


def wrapped(angle: Floats) -> Floats:
    """Angles in rad between -pi and pi."""
    return (angle + np.pi) % (2 * np.pi) - np.pi


class FastSimulator:
    """A rigid body in the plane with linear drag against the water (Fossen, Handbook of Marine
    Craft Hydrodynamics and Motion Control, 2021, chapter 6, without added mass).

    Drag is taken implicitly, so that no rate makes a step unstable. A free drive climbs as well,
    with the drag of surge.
    """

    def __init__(self, vessel: Vessel, runs: int) -> None:
        self.vessel, self.step_seconds = vessel, STEP
        self.pose, self.twist = np.zeros((runs, 4)), np.zeros((runs, 4))

    def reset(self, pose: Floats) -> None:
        self.pose, self.twist = pose.astype(float), np.zeros_like(pose, dtype=float)

    def step(self, actuators: Floats, current: Floats, wind: Floats) -> None:
        own, dt, yaw = self.vessel, self.step_seconds, self.pose[:, 3]
        if own.drive == "free":
            forces = actuators.copy()  # ahead, to port, up in N, and the moment in N m
        else:
            (port, starboard), nothing = actuators.T, np.zeros(len(actuators))
            moment = (starboard - port) * own.track / 2
            forces = np.stack([port + starboard, nothing, nothing, moment], axis=1)
        over = wind - turned(self.twist[:, :2], yaw)
        gust = own.windage * np.linalg.norm(over, axis=1, keepdims=True) * over
        forces[:, :2] += turned(gust, -yaw) * (np.linalg.norm(wind, axis=1, keepdims=True) > 0)
        water = turned(current, -yaw)
        surge, sway, _climb, rate = self.twist.T
        made = forces / (own.mass, own.mass, own.mass, own.inertia)
        made[:, 0] = made[:, 0] + sway * rate + own.drag[0] * water[:, 0]
        made[:, 1] = made[:, 1] - surge * rate + own.drag[1] * water[:, 1]
        drag = np.array([own.drag[0], own.drag[1], own.drag[0], own.drag[2]])
        twist = (self.twist + dt * made) / (1 + dt * drag)
        through = np.hypot(twist[:, 0] - water[:, 0], twist[:, 1] - water[:, 1])
        twist[:, :2] -= water
        twist[:, :2] *= np.minimum(1, own.speed / np.maximum(through, 1e-9))[:, None]
        twist[:, :2] += water
        twist[:, 3] = np.clip(twist[:, 3], -own.turn, own.turn)
        self.twist = twist
        middle = yaw + dt / 2 * twist[:, 3]
        self.pose[:, :2] += dt * turned(twist[:, :2], middle)
        self.pose[:, 2] = np.maximum(0, self.pose[:, 2] + dt * twist[:, 2])
        self.pose[:, 3] = wrapped(yaw + dt * twist[:, 3])


SIMULATORS = {
    "fast": "planner_ft.simulation.fast:FastSimulator",
    "mujoco": "planner_ft.simulation.fossen:FossenSimulator",
}
"""Simulators by the name that --simulator takes."""


def build_simulator(name: str, vessel: Vessel, runs: int) -> Simulator:
    """A simulator of `runs` vehicles. Raises PlannerError where it lacks what it needs."""
    made: Simulator = EntryPoint(name, SIMULATORS[name], "").load()(vessel, runs)
    return made
