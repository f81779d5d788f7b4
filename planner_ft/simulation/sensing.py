"""Perception and data skills: simulated openly from what the world holds, each with its noise.

A measure is a method of `Measures`. It gives the fields of a record, or None while there is nothing
to record. What a simulator has no model of (lenses, image quality, files) is recorded as made, with
`"simulated": "no model"`.
"""

import math
from typing import Any

import numpy as np

from planner_ft.document.track import Point, bearing
from planner_ft.simulation.fast import Bools, Floats, Runs
from planner_ft.simulation.scene import FIX_SIGMA, Scene
from planner_ft.simulation.skill import Job, Skill

Record = dict[str, Any]
SIGHT, SONAR = 60.0, 15.0  # metres in which camera and sonar detect: ASSUMPTION
WATER, HOT = 12.0, 45.0  # degrees C of the water and of the hottest spot of a structure: ASSUMPTION
VIEW, PIXELS = math.radians(60), 1280  # the camera's field of view and width
NO_MODEL = {"simulated": "no model"}


class Sensor(Skill):
    """Records what its measure gives: every so many seconds, or once at the end of the step."""

    def __init__(self, job: Job, scene: Scene) -> None:
        super().__init__(job, scene)
        self.measure = str(job.settings.get("measure"))
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
        measures = Measures(self.scene, run, values)
        # Of a skill whose measure nobody says: that it was done.
        found = getattr(measures, self.measure)() if self.measure in MEASURES else {"done": True}
        if found is not None:
            self.count[run] += 1
            job = self.job
            where = {"task": job.task, "step": job.step + 1, "skill": job.skill}
            self.scene.note(run, "record", {**where, **found})


class Measures:
    """What run `_run` can measure now, by the names that NAME.simulation.toml uses; `_values` are
    the skill's by role.
    """

    def __init__(self, scene: Scene, run: int, values: Record) -> None:
        self._scene, self._run, self._values = scene, run, values
        self._world, self._random = scene.world, scene.world.generator
        self._true: Point = float(scene.pose[run, 0]), float(scene.pose[run, 1])
        self._believed: Point = float(scene.position[run, 0]), float(scene.position[run, 1])

    def depth(self) -> Record:
        noise = self._random.normal(0.0, 0.05)
        return {"depth_m": round(self._world.depth(*self._true) + noise, 2)}

    def fix(self) -> Record:
        localiser = self._scene.localiser
        if localiser.silent[self._run] > 2:
            return {"fix": None}
        x, y = localiser.fix[self._run]
        latitude, longitude = self._scene.origin.to_geographic(float(x), float(y))
        return {"fix": [round(latitude, 7), round(longitude, 7)], "accuracy_m": FIX_SIGMA}

    def accuracy(self) -> Record:
        drift = float(self._scene.localiser.silent[self._run]) * 0.1
        found, most = FIX_SIGMA + (drift if drift > 0.2 else 0.0), self._values.get("threshold")
        limit = {} if most is None else {"good": found <= most}
        return {"accuracy_m": round(found, 2), **limit}

    def objects(self) -> Record | None:
        """Objects of the asked names; a place given from outside counts beyond the sight."""
        asked = self._values.get("names") or self._values.get("name")
        names = asked if isinstance(asked, list) else [asked] if asked else [*self._world.objects]
        found = []
        for name, place in filter(None, map(self._world.find, names)):
            far = math.dist(place, self._true)
            noise = self._random.normal(0.0, 0.02 * far if far < SIGHT else 0.0, 2)
            by = "camera" if far < SIGHT else "given position"
            at = [round(float(part), 1) for part in np.array(place) + noise]
            found.append({"name": name, "at": at, "distance_m": round(far, 1), "by": by})
        return {"detections": found} if found or not names else None

    def text(self) -> Record:
        near = self._near(SONAR)
        return {"text": near[0] if near else None}

    def temperature(self) -> Record:
        away = float(self._world.nearest(np.array([self._true]))[0])
        most = WATER + (HOT - WATER) * math.exp(-away / 20) + self._random.normal(0, 0.3)
        return {"mean_C": round((most + 3 * WATER) / 4, 1), "most_C": round(most, 1)}

    def hotspot(self) -> Record:
        near, least = self._near(SIGHT), self._values.get("threshold")
        hot = near is not None and (least or 0) <= HOT
        return {"hotspot": list(near[1]) if near and hot else None, "most_C": HOT if hot else None}

    def range(self) -> Record:
        """The least LiDAR range in a sector: 30 degrees about a bearing, or the field of view."""
        seen, angles = self._scan(), np.degrees(self._world.ray_angles)
        middle = -float(self._values.get("bearing") or 0)
        view = float(self._values.get("view") or 30)
        inside = np.abs((angles - middle + 180) % 360 - 180) <= view / 2
        least = seen[inside].min() if inside.any() else math.inf
        return {"distance_m": round(float(least), 2) if math.isfinite(least) else None}

    def profile(self) -> Record:
        seen = self._scan()
        return {"ranges_m": [round(float(one), 2) if math.isfinite(one) else None for one in seen]}

    def cylinder(self) -> Record:
        """A circle through the LiDAR's points by least squares (Kasa 1976)."""
        points = self._points()
        if len(points) < 3:
            return {"radius_m": None, "points": len(points)}
        left = np.column_stack([points, np.ones(len(points))])
        (a, b, c), *_rest = np.linalg.lstsq(left, (points**2).sum(axis=1), rcond=None)
        radius = math.sqrt(max(0.0, c + (a * a + b * b) / 4))
        middle = [round(float(a) / 2, 1), round(float(b) / 2, 1)]
        return {"radius_m": round(radius, 2), "center": middle, "points": len(points)}

    def planarity(self) -> Record:
        """The root mean square distance of the LiDAR's points from the line through them."""
        points = self._points()
        if len(points) < 3:
            return {"off_plane_m": None, "points": len(points)}
        off = np.linalg.svd(points - points.mean(axis=0), compute_uv=False)[-1]
        return {"off_plane_m": round(float(off / len(points) ** 0.5), 3), "points": len(points)}

    def sonar(self) -> Record:
        name, place = self._near(SONAR) or (None, None)
        return {"feature": name, "feature_at": list(place) if place else None}

    def tilt(self) -> Record:
        return {"horizon_deg": round(float(self._scene.tilt(np.array([self._run]))[0]), 1)}

    def pose(self) -> Record:
        place = self._target() or self._world.home
        toward = round(self._off_bow(place) % 360)
        return {"distance_m": round(math.dist(self._believed, place), 1), "bearing_deg": toward}

    def environment(self) -> Record:
        wind = self._world.winds(self._scene.time)[self._run]
        flows = wind, self._scene.localiser.drift[self._run]
        speeds = [round(float(np.hypot(*one)), 2) for one in flows]
        return {"wind_m_s": speeds[0], "drift_m_s": speeds[1], "water_C": WATER}

    def offset(self) -> Record:
        """Pixels from the middle of the picture; null where the target is not in it."""
        place = self._target()
        if place is None:
            return {"offset_px": None}
        off = (self._off_bow(place) + 180) % 360 - 180
        pixels = math.tan(math.radians(off)) / math.tan(VIEW / 2) * PIXELS / 2
        return {"offset_px": round(pixels) if abs(off) <= math.degrees(VIEW) / 2 else None}

    def recording(self) -> Record:
        return {"recorded_s": round(float(self._values["elapsed"]), 1), **self.image()}

    def marker(self) -> Record:
        near = self._near(SIGHT)
        return {"label": self._values.get("name") or (near[0] if near else "here")}

    def observation(self) -> Record:
        near = self._near(SIGHT)
        seen = f"near {near[0]}" if near else "nothing near"
        return {"observation": self._values.get("name") or seen}

    def image(self) -> Record:
        """Of what has no model here: that it was done, and its name."""
        named = {"name": self._values["name"]} if self._values.get("name") else {}
        return {**named, **NO_MODEL}

    buffer = stream = lens = quality = image

    def _off_bow(self, place: Point) -> float:
        """The bearing of a place from the bow, in degrees clockwise."""
        return bearing(self._believed, place) - 90 + math.degrees(self._scene.yaw[self._run])

    def _target(self) -> Point | None:
        name = self._values.get("name")
        found = self._world.find(name) if name else self._near(SIGHT)
        return found[1] if found else None

    def _near(self, most: float) -> tuple[str, Point] | None:
        """The nearest object within metres of the true place."""
        objects = self._world.objects.items()
        known = [(math.dist(self._true, place), name, place) for name, place in objects]
        far, name, place = min(known, default=(math.inf, "", self._true))
        return (name, place) if far <= most else None

    def _scan(self) -> Floats:
        """LiDAR ranges (rays,) of this step."""
        return np.asarray(self._scene.ranges(np.array([self._run]))[0])

    def _points(self) -> Floats:
        """What the LiDAR hits, as estimated places (n, 2) with 2 cm of noise."""
        seen, angles = self._scan(), self._world.ray_angles + self._scene.yaw[self._run]
        hit = np.isfinite(seen)
        far = seen[hit] + self._random.normal(0.0, 0.02, hit.sum())
        to = np.column_stack([far * np.cos(angles[hit]), far * np.sin(angles[hit])])
        return np.asarray(np.array(self._believed) + to, dtype=float)


MEASURES = [name for name in vars(Measures) if not name.startswith("_")]
"""Measures by the name that NAME.simulation.toml uses."""
