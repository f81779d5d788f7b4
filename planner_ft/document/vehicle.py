"""The vehicle's profile: the figures that estimates of a plan rest on, and the area that the
vehicle may be in.
"""

from __future__ import annotations

import math
import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import VEHICLE

AMOUNTS = {
    "cruise_speed": "m/s",
    "endurance": "s",
    "turn_rate": "degrees per second",
    "orbit_angle": "degrees",
}
LARGEST = 1e9
FULL_CIRCLE = 360


@dataclass(frozen=True)
class Vehicle:
    """`cruise_speed` in m/s, `endurance` in seconds, `turn_rate` in degrees per second, `area` in
    local metres (None: anywhere).

    `orbit_angle` (degrees) is how far the vehicle goes round a target when nobody says how far.
    """

    name: str
    cruise_speed: float
    endurance: float
    turn_rate: float
    orbit_angle: float
    area: tuple[tuple[float, float], ...] | None = None

    def as_json(self) -> dict[str, Any]:
        """The profile as it stands in a plan document."""
        area = None if self.area is None else [list(corner) for corner in self.area]
        return {
            "name": self.name,
            "cruise_speed": self.cruise_speed,
            "endurance": self.endurance,
            "turn_rate": self.turn_rate,
            "orbit_angle": self.orbit_angle,
            "area": area,
        }


def load_vehicle(path: Path | str | None, vocabulary: Vocabulary) -> Vehicle:
    """The profile in a TOML file; without a path NAME.vehicle.toml beside the vocabulary's
    definition. What a file leaves out is as there.

    Raises PlannerError that names the file and what is wrong.
    """
    own = vocabulary.beside(VEHICLE)
    if path is None:
        if not own:
            beside = f"{vocabulary.path.stem if vocabulary.path else vocabulary.name}{VEHICLE}"
            raise PlannerError(
                f"vocabulary {vocabulary.name}: has no vehicle profile; write {beside} beside its"
                " definition, or give one with --vehicle FILE"
            )
        return _built(own, f"{vocabulary.name}{VEHICLE}")
    try:
        raw = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None
    return _built({**own, **raw}, str(path))


def check_area(corners: Any) -> tuple[tuple[float, float], ...]:
    """The corners of an area as pairs of metres. Raises PlannerError when they are no polygon
    without crossing sides.
    """
    from shapely import Polygon

    if (
        not isinstance(corners, list | tuple)
        or len(corners) < 3
        or not all(map(_is_position, corners))
    ):
        raise PlannerError(
            f"area = {corners!r}: must be a list of at least three positions [x, y] in local metres"
        )
    area = tuple((float(x), float(y)) for x, y in corners)
    if not Polygon(area).is_valid:
        raise PlannerError("area: its sides cross or touch each other; give its corners in order")
    return area


def _built(raw: dict[str, Any], where: str) -> Vehicle:
    raw = {"orbit_angle": FULL_CIRCLE, **raw}
    unknown = [key for key in raw if key not in ("name", *AMOUNTS, "area")]
    if unknown:
        raise PlannerError(
            f"{where}: unknown key {unknown[0]!r}; there is name, {', '.join(AMOUNTS)}, area"
        )
    if not isinstance(raw.get("name"), str) or not raw["name"].strip():
        raise PlannerError(f"{where}: name must be a text")
    for key, unit in AMOUNTS.items():
        if not _is_number(raw.get(key)) or not 0 < raw[key] <= LARGEST:
            raise PlannerError(
                f"{where}: {key} = {raw.get(key)!r} must be a number above 0 ({unit})"
            )
    try:
        area = None if raw.get("area") is None else check_area(raw["area"])
    except PlannerError as error:
        raise PlannerError(f"{where}: {error}") from None
    return Vehicle(
        raw["name"].strip(),
        raw["cruise_speed"],
        raw["endurance"],
        raw["turn_rate"],
        raw["orbit_angle"],
        area,
    )


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _is_position(value: Any) -> bool:
    return (
        isinstance(value, list | tuple)
        and len(value) == 2
        and all(map(_is_number, value))
        and max(map(abs, value)) <= LARGEST
    )
