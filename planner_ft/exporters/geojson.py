"""The format `geojson`: a plan for maps (RFC 7946: longitude before latitude, polygons
counter-clockwise, lines cut at the antimeridian).

Features by their property `kind`: `plan` and `task` hold everything that the plan says, `waypoint`,
`target`, `boundary`, `area`, `grid` and `stand-off` what a map shows of it. Every geometry stands
in local metres beside it (`local`).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from planner_ft.document.track import Leg, Point
from planner_ft.exporters.formats import TABLES, Format, PlanExport, Written
from planner_ft.support.files import indented_json
from planner_ft.support.geodesy import Origin

if TYPE_CHECKING:
    from shapely.geometry.base import BaseGeometry

Feature = dict[str, Any]
TABLE: dict[str, list[str]] = TABLES["geojson"]
CORNERS = 72  # of a circle
DIGITS = 9  # decimal places of degrees: a tenth of a millimetre
LAWNMOWER = "lawnmower"  # the pattern of a task that covers an area (vocabulary definition)


def write(plan: PlanExport) -> Written:
    """A FeatureCollection. Nothing is lost: all that the plan says stands in properties."""
    ledger = plan.ledger()
    for path in ledger.items:
        ledger.carry(*path)
    assert plan.origin is not None
    features = list(_Drawing(plan, plan.origin).features())
    collection = {"type": "FeatureCollection", "name": plan.name, "features": features}
    return Written(indented_json(collection), ledger.close())


class _Drawing:
    """The features of one plan."""

    def __init__(self, plan: PlanExport, origin: Origin) -> None:
        self.plan, self.document, self.origin = plan, plan.document, origin

    def features(self) -> Iterator[Feature]:
        """The plan, then its tasks with their waypoints, then the surroundings."""
        import shapely

        track, area = self.plan.track, self.document["vehicle"]["area"]
        yield self._plan()
        for number, task in enumerate(self.document["tasks"], start=1):
            legs = [leg for leg in track.legs if leg.task == task["id"] and leg.points]
            yield self._task(number, task, legs)
            for leg in legs:
                words: Feature = {"task": leg.task, "step": leg.step + 1, "skill": leg.skill}
                words |= {"motion": leg.kind, "metres": leg.metres, "seconds": leg.seconds}
                yield self._feature("waypoint", [leg.points[-1]], words)
            yield from self._grid(task, legs)
        for target in track.targets:
            points = [target.position] if target.position is not None else []
            words = {"name": target.name, "task": target.task, "located": bool(points)}
            yield self._feature("target", points, words)
        for boundary in track.boundaries:
            words = {"task": boundary.task, "step": boundary.step + 1}
            yield self._feature("boundary", boundary.polygon, words, ring=True)
        if area:
            yield self._feature("area", area, {}, ring=True)
        for circle in track.circles:
            radius = max(circle.radius, 0.001)
            disc = shapely.Point(circle.center).buffer(radius, quad_segs=CORNERS // 4)
            yield self._feature("stand-off", disc.exterior.coords[:-1], asdict(circle), ring=True)

    def _plan(self) -> Feature:
        words: Feature = {"name": self.plan.name, "approval": self.plan.mark}
        words["digest"] = self.document["digest"]
        words |= {"vocabulary": self.document["vocabulary"]["name"], "origin": asdict(self.origin)}
        words |= {key: self.document[key] for key in TABLE["plan"] if key in self.document}
        return self._feature("plan", [], words)

    def _task(self, number: int, task: dict[str, Any], legs: Sequence[Leg]) -> Feature:
        points: list[Point] = []
        for leg in legs:
            points += leg.points if leg.points[:1] != tuple(points[-1:]) else leg.points[1:]
        words = {key: task[key] for key in TABLE["task"] if key in task}
        return self._feature("task", points, {"task": task["id"], "number": number, **words})

    def _grid(self, task: dict[str, Any], legs: Sequence[Leg]) -> Iterator[Feature]:
        """The area that the lanes of a survey span."""
        import shapely

        known = self.plan.vocabulary.task.get(task["title"])
        if known and known.pattern == LAWNMOWER:
            ends = [leg.points[-1] for leg in legs if leg.kind == "go"]
            hull = shapely.MultiPoint(ends).convex_hull
            if isinstance(hull, shapely.Polygon) and not hull.is_empty:
                corners = hull.exterior.coords[:-1]
                yield self._feature("grid", corners, {"task": task["id"]}, ring=True)

    def _feature(
        self, kind: str, points: Sequence[Sequence[float]], words: Feature, *, ring: bool = False
    ) -> Feature:
        local = [list(point) for point in points]
        geometry = _geometry([self._place(x, y) for x, y in local], ring) if local else None
        properties = {"kind": kind, **words, "local": local}
        return {"type": "Feature", "geometry": geometry, "properties": properties}

    def _place(self, x: float, y: float) -> tuple[float, float]:
        """Longitude and latitude; the longitude goes on beyond 180 degrees, as the way does."""
        latitude, longitude = self.origin.to_geographic(x, y)
        turns = round((longitude - self.origin.longitude) / 360)
        return round(longitude - 360 * turns, DIGITS), round(latitude, DIGITS)


def _geometry(places: list[tuple[float, float]], ring: bool) -> dict[str, Any]:
    """A point, a line or a polygon as GeoJSON, cut at the antimeridian where it crosses it."""
    import shapely

    shape: BaseGeometry
    if ring:
        shape = shapely.orient_polygons(shapely.Polygon(places))
    elif len(set(places)) == 1:
        shape = shapely.Point(places[0])
    else:
        shape = shapely.LineString(places)
    west, _south, east, _north = shape.bounds
    inside = west >= -180 and east <= 180
    found: dict[str, Any] = shapely.geometry.mapping(shape if inside else _cut(shape))
    return found


def _cut(shape: BaseGeometry) -> BaseGeometry:
    """A geometry whose longitudes go beyond 180 degrees as its parts within -180 and 180."""
    import shapely
    from shapely.affinity import translate

    whole = shape if shape.is_valid else shapely.make_valid(shape)
    parts: list[BaseGeometry] = []
    for turn in (-1, 0, 1):
        window = shapely.box(360 * turn - 180, -90, 360 * turn + 180, 90)
        pieces = shapely.get_parts(translate(whole.intersection(window), -360 * turn))
        same = [piece for piece in pieces if piece.geom_type == shape.geom_type]
        parts += [piece for piece in same if not piece.is_empty]
    if not parts:  # a polygon without an inside
        return translate(shape, -360 * round(shape.bounds[0] / 360))
    several = getattr(shapely, f"Multi{shape.geom_type}")
    return shapely.orient_polygons(parts[0] if len(parts) == 1 else several(parts))


FORMAT = Format("geojson", ".geojson", "GeoJSON for maps", needs_origin=True, write=write)
