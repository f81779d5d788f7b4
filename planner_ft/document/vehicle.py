"""The vehicle's profile: figures that estimates rest on, and the area that it may be in."""

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import VEHICLE
from planner_ft.vocabulary.plans import is_number, is_position

UNITS = {
    "cruise_speed": "m/s",
    "endurance": "s",
    "turn_rate": "deg/s",
    "orbit_angle": "degrees",
    "stand_off": "m",
}
STAND_OFF = 10.0  # metres kept from a structure where nothing else is said
KINDS = ("boat", "rover", "copter")
LARGEST = 1e9
FULL_CIRCLE = 360


@dataclass(frozen=True)
class Vehicle:
    """Speed in m/s, endurance in s, turn rate in degrees/s, `area` in metres (None: anywhere).

    `orbit_angle` (degrees) is how far the vehicle goes round a target by default, `stand_off`
    (metres) what it keeps from structures. `kind`, one of KINDS, is what ground stations are told
    (None: a boat, or a copter where its movements have altitudes).
    """

    name: str
    cruise_speed: float
    endurance: float
    turn_rate: float
    orbit_angle: float
    area: tuple[tuple[float, float], ...] | None = None
    stand_off: float = STAND_OFF
    kind: str | None = None

    def as_json(self) -> dict[str, Any]:
        """The profile as it stands in a plan document, which holds no kind that is not stated."""
        profile = {**asdict(self), "area": self.area and [list(corner) for corner in self.area]}
        return {key: value for key, value in profile.items() if key != "kind" or value}


def load_vehicle(path: Path | str | None, vocabulary: Vocabulary) -> Vehicle:
    """The profile in a TOML file, completed by NAME.vehicle.toml. Raises PlannerError."""
    own, where, raw = vocabulary.beside(VEHICLE), f"{vocabulary.name}{VEHICLE}", {}
    if path is None and not own:
        stem = vocabulary.path.stem if vocabulary.path else vocabulary.name
        ways = f"write {stem}{VEHICLE} beside its definition, or give one with --vehicle FILE"
        raise PlannerError(f"vocabulary {vocabulary.name}: has no vehicle profile; {ways}")
    if path is not None:
        where, raw = str(path), read_toml(path)
    try:
        return _built({"orbit_angle": FULL_CIRCLE, "stand_off": STAND_OFF, **own, **raw})
    except PlannerError as error:
        raise PlannerError(f"{where}: {error}") from None


def check_area(corners: Any) -> tuple[tuple[float, float], ...]:
    """The corners in metres. Raises PlannerError unless they are a simple polygon."""
    from shapely import Polygon

    pairs = [list(corner) if isinstance(corner, tuple) else corner for corner in corners or ()]
    near = all(is_position(pair) and max(map(abs, pair)) <= LARGEST for pair in pairs)
    if len(pairs) < 3 or not near:
        wanted = "must be a list of at least three positions [x, y] in local metres"
        raise PlannerError(f"area = {corners!r}: {wanted}")
    area = tuple((float(x), float(y)) for x, y in pairs)
    if not Polygon(area).is_valid:
        raise PlannerError("area: its sides cross or touch each other; give its corners in order")
    return area


def _built(raw: dict[str, Any]) -> Vehicle:
    keys = ("name", *UNITS, "area", "kind")
    unknown = [key for key in raw if key not in keys]
    if unknown:
        raise PlannerError(f"unknown key {unknown[0]!r}; there is {', '.join(keys)}")
    name, area = raw.get("name"), raw.get("area")
    if not isinstance(name, str) or not name.strip():
        raise PlannerError("name must be a text")
    for key, unit in UNITS.items():
        if not is_number(raw.get(key)) or not 0 < raw[key] <= LARGEST:
            raise PlannerError(f"{key} = {raw.get(key)!r} must be a number above 0 ({unit})")
    kind = raw.get("kind")
    if kind is not None and kind not in KINDS:
        raise PlannerError(f"kind = {kind!r} must be one of {', '.join(KINDS)}, or left out")
    amounts = {key: raw[key] for key in UNITS}
    area = None if area is None else check_area(area)
    return Vehicle(name.strip(), **amounts, area=area, kind=kind)
