"""Perception and data skills: simulated openly from what the world holds, each with its noise.

A measure is a function of the scene, the number of a run and the skill's values by role. It gives
the fields of a record, or None while there is nothing to record. What a simulator has no model of
(lenses, image quality, files) is recorded as made, with `"simulated": "no model"`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from planner_ft.document.track import Point, bearing
from planner_ft.simulation.control import FIX_SIGMA
from planner_ft.simulation.fast import Bools, Floats, Runs
from planner_ft.simulation.scene import Scene
from planner_ft.simulation.skill import Job, Skill

Values = Mapping[str, Any]
Measure = Callable[[Scene, int, Values], "dict[str, Any] | None"]
SIGHT, SONAR = 60.0, 15.0
"""Metres in which camera and sonar detect: ASSUMPTION."""
WATER, HOT = 12.0, 45.0
"""Degrees C of the water and of the hottest spot of a structure: ASSUMPTION."""
VIEW, PIXELS = math.radians(60), 1280
"""The camera's field of view and width."""
NO_MODEL = {"simulated": "no model"}


class Sensor(Skill):
    """Records what its measure gives: every so many seconds, or once at the end of the step."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.measure = MEASURES.get(str(job.settings.get("measure")), record)
        self.every = float(job.settings.get("every", 0))
        self.count, self.due = np.zeros(scene.count, dtype=int), np.zeros(scene.count)
        roles = [key for key in job.settings if key not in ("measure", "every", "implementation")]
        self.values: dict[str, Any] = {role: job.value(role) for role in roles}

    def start(self, runs: Runs) -> None:
        super().start(runs)
        self.count[runs], self.due[runs] = 0, self.scene.time

    def step(self, runs: Runs, command: Floats) -> Floats:
        if self.every:
            for run in runs[self.scene.time >= self.due[runs] - 1e-9]:
                self.due[run] = self.scene.time + self.every
                self._record(int(run))
        return command

    def done(self, runs: Runs) -> Bools:
        return (self.count[runs] > 0) | (not self.every)

    def stop(self, runs: Runs) -> None:
        for run in runs if not self.every else ():
            self._record(int(run))

    def _record(self, run: int) -> None:
        values = {**self.values, "elapsed": self.elapsed(np.array([run]))[0]}
        found = self.measure(self.scene, run, values)
        if found is not None:
            self.count[run] += 1
            job = self.job
            where = {"task": job.task, "step": job.step + 1, "skill": job.skill}
            self.scene.note(run, "record", {**where, **found})


def record(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """Of a skill whose measure nobody says: that it was done."""
    return {"done": True}


def depth(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    x, y = scene.pose[run, :2]
    noise = scene.world.generator.normal(0.0, 0.05)
    return {"depth_m": round(scene.world.depth(x, y) + noise, 2)}


def fix(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    if scene.localiser.silent[run] > 2:
        return {"fix": None}
    x, y = scene.localiser.fix[run]
    latitude, longitude = scene.origin.to_geographic(float(x), float(y))
    return {"fix": [round(latitude, 7), round(longitude, 7)], "accuracy_m": FIX_SIGMA}


def accuracy(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    drift = float(scene.localiser.silent[run]) * 0.1
    found, most = FIX_SIGMA + (drift if drift > 0.2 else 0.0), values.get("threshold")
    limit = {} if most is None else {"good": found <= most}
    return {"accuracy_m": round(found, 2), **limit}


def objects(scene: Scene, run: int, values: Values) -> dict[str, Any] | None:
    """Objects of the asked names; a place that was given from outside counts beyond the sight."""
    asked = values.get("names") or values.get("name")
    names = asked if isinstance(asked, list) else [asked] if asked else list(scene.world.objects)
    found = []
    for known in filter(None, map(scene.world.find, names)):
        name, place = known
        far = math.dist(place, (scene.pose[run, 0], scene.pose[run, 1]))
        noise = scene.world.generator.normal(0.0, 0.02 * far if far < SIGHT else 0.0, 2)
        by = "camera" if far < SIGHT else "given position"
        at = [round(float(part), 1) for part in np.array(place) + noise]
        found.append({"name": name, "at": at, "distance_m": round(far, 1), "by": by})
    return {"detections": found} if found or not names else None


def text(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    near = _near(scene, run, SONAR)
    return {"text": near[0] if near else None}


def temperature(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    away = float(scene.world.nearest(scene.pose[[run], :2])[0])
    most = WATER + (HOT - WATER) * math.exp(-away / 20) + scene.world.generator.normal(0, 0.3)
    return {"mean_C": round((most + 3 * WATER) / 4, 1), "most_C": round(most, 1)}


def hotspot(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    near, least = _near(scene, run, SIGHT), values.get("threshold")
    hot = near is not None and (least or 0) <= HOT
    return {"hotspot": list(near[1]) if near and hot else None, "most_C": HOT if hot else None}


def distances(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """The least LiDAR range in a sector: of 30 degrees about a bearing, or the field of view."""
    seen, angles = scene.ranges(np.array([run]))[0], np.degrees(scene.world.ray_angles)
    middle = -float(values.get("bearing") or 0)
    view = float(values.get("view") or 30)
    inside = np.abs((angles - middle + 180) % 360 - 180) <= view / 2
    least = seen[inside].min() if inside.any() else math.inf
    return {"distance_m": round(float(least), 2) if math.isfinite(least) else None}


def profile(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    seen = scene.ranges(np.array([run]))[0]
    return {"ranges_m": [round(float(one), 2) if math.isfinite(one) else None for one in seen]}


def cylinder(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """A circle through the LiDAR's points by least squares (Kasa 1976)."""
    points = _points(scene, run)
    if len(points) < 3:
        return {"radius_m": None, "points": len(points)}
    left = np.column_stack([points, np.ones(len(points))])
    (a, b, c), *_rest = np.linalg.lstsq(left, (points**2).sum(axis=1), rcond=None)
    radius = math.sqrt(max(0.0, c + (a * a + b * b) / 4))
    middle = [round(float(a) / 2, 1), round(float(b) / 2, 1)]
    return {"radius_m": round(radius, 2), "center": middle, "points": len(points)}


def planarity(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """The root mean square distance of the LiDAR's points from the line through them."""
    points = _points(scene, run)
    if len(points) < 3:
        return {"off_plane_m": None, "points": len(points)}
    off = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1] / len(points) ** 0.5
    return {"off_plane_m": round(float(off), 3), "points": len(points)}


def sonar(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    near = _near(scene, run, SONAR)
    return {"feature": near[0] if near else None, "feature_at": list(near[1]) if near else None}


def tilt(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    return {"horizon_deg": round(float(scene.tilt(np.array([run]))[0]), 1)}


def environment(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    wind, drift = scene.world.winds(scene.time)[run], scene.localiser.drift[run]
    speeds = [round(float(np.hypot(*one)), 2) for one in (wind, drift)]
    return {"wind_m_s": speeds[0], "drift_m_s": speeds[1], "water_C": WATER}


def pose(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    place = _target(scene, run, values) or scene.world.home
    here = float(scene.position[run, 0]), float(scene.position[run, 1])
    toward = (bearing(here, place) - 90 + math.degrees(scene.yaw[run])) % 360
    return {"distance_m": round(math.dist(here, place), 1), "bearing_deg": round(toward)}


def offset(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """Pixels from the middle of the picture; null where the target is not in it."""
    place = _target(scene, run, values)
    if place is None:
        return {"offset_px": None}
    here = float(scene.position[run, 0]), float(scene.position[run, 1])
    off = (bearing(here, place) - 90 + math.degrees(scene.yaw[run]) + 180) % 360 - 180
    pixels = math.tan(math.radians(off)) / math.tan(VIEW / 2) * PIXELS / 2
    return {"offset_px": round(pixels) if abs(off) <= math.degrees(VIEW) / 2 else None}


def recording(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    return {"recorded_s": round(float(values["elapsed"]), 1), **_named(values), **NO_MODEL}


def named(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    """Of what has no model here: that it was done, and its name."""
    return {**_named(values), **NO_MODEL}


def marker(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    near = _near(scene, run, SIGHT)
    return {"label": values.get("name") or (near[0] if near else "here")}


def observation(scene: Scene, run: int, values: Values) -> dict[str, Any]:
    near = _near(scene, run, SIGHT)
    return {"observation": values.get("name") or (f"near {near[0]}" if near else "nothing near")}


def _named(values: Values) -> dict[str, Any]:
    return {"name": values["name"]} if values.get("name") else {}


def _target(scene: Scene, run: int, values: Values) -> Point | None:
    found = scene.world.find(values["name"]) if values.get("name") else _near(scene, run, SIGHT)
    return found[1] if found else None


def _near(scene: Scene, run: int, most: float) -> tuple[str, Point] | None:
    """The nearest object within metres of the true place."""
    here = float(scene.pose[run, 0]), float(scene.pose[run, 1])
    known = [(math.dist(here, place), name, place) for name, place in scene.world.objects.items()]
    far, name, place = min(known, default=(math.inf, "", here))
    return (name, place) if far <= most else None


def _points(scene: Scene, run: int) -> Floats:
    """What the LiDAR hits, as estimated places (n, 2) with 2 cm of noise."""
    seen, angles = scene.ranges(np.array([run]))[0], scene.world.ray_angles + scene.yaw[run]
    hit = np.isfinite(seen)
    far = seen[hit] + scene.world.generator.normal(0.0, 0.02, hit.sum())
    to = np.column_stack([far * np.cos(angles[hit]), far * np.sin(angles[hit])])
    return np.asarray(scene.position[run] + to, dtype=float)


MEASURES: dict[str, Measure] = {
    "depth": depth,
    "fix": fix,
    "accuracy": accuracy,
    "objects": objects,
    "text": text,
    "temperature": temperature,
    "hotspot": hotspot,
    "range": distances,
    "profile": profile,
    "cylinder": cylinder,
    "planarity": planarity,
    "sonar": sonar,
    "tilt": tilt,
    "pose": pose,
    "environment": environment,
    "offset": offset,
    "recording": recording,
    "marker": marker,
    "observation": observation,
    "image": named,
    "buffer": named,
    "stream": named,
    "lens": named,
    "quality": named,
}
"""Measures by the name that NAME.simulation.toml uses."""
