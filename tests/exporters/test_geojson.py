"""Plans on maps, validated by geojson-pydantic and read by shapely."""

from __future__ import annotations

import json
from typing import Any

import geojson_pydantic
import pytest
import shapely
from hypothesis import HealthCheck, given, settings
from shapely.geometry import shape

from planner_ft.exporters import DRAFT, Origin, PlanExport, load_format

from .plans import BUOY, DRONE, MAST, USV, document, documents, origins, step, task

ORIGIN = Origin(59.9, 10.7)


def features(
    plan: dict[str, Any],
    origin: Origin = ORIGIN,
    vocabulary: Any = USV,
    approval: str | None = None,
) -> list[dict[str, Any]]:
    text = load_format("geojson").write(PlanExport(plan, vocabulary, origin, approval)).text
    geojson_pydantic.FeatureCollection.model_validate_json(text)
    found: list[dict[str, Any]] = json.loads(text)["features"]
    return found


def of_kind(found: list[dict[str, Any]], kind: str) -> list[dict[str, Any]]:
    return [feature for feature in found if feature["properties"]["kind"] == kind]


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_all_that_a_plan_says_comes_back(vocabulary: Any) -> None:
    @settings(max_examples=15, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary), origins())
    def check(plan: dict[str, Any], origin: Origin) -> None:
        found = features(plan, origin, vocabulary)
        whole, tasks = (
            found[0]["properties"],
            [feature["properties"] for feature in of_kind(found, "task")],
        )
        assert {
            key: whole[key]
            for key in (
                "command",
                "vehicle",
                "assumptions",
                "constraints",
                "warnings",
                "open_places",
                "located",
                "digest",
            )
        } == {
            key: plan[key]
            for key in (
                "command",
                "vehicle",
                "assumptions",
                "constraints",
                "warnings",
                "open_places",
                "located",
                "digest",
            )
        }
        assert [
            {
                "id": entry["task"],
                **{key: entry[key] for key in plan["tasks"][0] if key != "id" and key in entry},
            }
            for entry in tasks
        ] == [
            {key: value for key, value in entry.items() if key in plan["tasks"][0]}
            for entry in plan["tasks"]
        ]

    check()


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
def test_every_geometry_lies_where_its_local_metres_say(vocabulary: Any) -> None:
    @settings(max_examples=15, suppress_health_check=list(HealthCheck))
    @given(documents(vocabulary), origins())
    def check(plan: dict[str, Any], origin: Origin) -> None:
        for feature in features(plan, origin, vocabulary):
            if feature["geometry"] is None:
                assert feature["properties"]["local"] == []
                continue
            read = shape(feature["geometry"])
            west, south, east, north = read.bounds
            assert -180 <= west <= east <= 180 and -90 <= south <= north <= 90
            if read.geom_type in ("Point", "LineString"):
                places = {
                    tuple(round(value, 2) for value in point)
                    for point in feature["properties"]["local"]
                }
                back = [origin.to_local(latitude, longitude) for longitude, latitude in read.coords]
                assert all(
                    any(abs(x - px) < 0.02 and abs(y - py) < 0.02 for px, py in places)
                    for x, y in back
                )
            for polygon in shapely.get_parts(read):
                assert (
                    polygon.geom_type != "Polygon"
                    or not polygon.is_valid
                    or polygon.exterior.is_ccw
                )

    check()


def test_a_map_shows_tracks_waypoints_stand_offs_boundaries_and_targets() -> None:
    found = features(document(MAST))
    assert [feature["geometry"]["type"] for feature in of_kind(found, "task")] == [
        "LineString",
        "LineString",
        "Point",
        "LineString",
    ]
    (circle,) = of_kind(found, "stand-off")
    center = shape(circle["geometry"]).centroid
    assert ORIGIN.to_local(center.y, center.x) == pytest.approx((120, -35), abs=0.01)
    assert circle["properties"]["radius"] == 25
    assert len(of_kind(found, "boundary")) == 1
    turn = of_kind(found, "waypoint")[0]["properties"]
    assert (turn["task"], turn["step"], turn["skill"], turn["local"]) == (
        "t1",
        1,
        "GoToXY",
        [[120.0, -35.0]],
    )


def test_an_unresolved_target_has_no_place() -> None:
    (target,) = of_kind(features(document(BUOY)), "target")
    assert target["geometry"] is None
    assert (target["properties"]["name"], target["properties"]["located"]) == ("green buoy", False)


def test_a_survey_shows_its_area() -> None:
    lanes = [
        step("GoToXY", {"x": x, "y": y})
        for x, y in [(0, 0), (0, 20), (10, 20), (10, 0), (20, 0), (20, 20)]
    ]
    survey = task(
        "BathymetryGridSurvey",
        {"center": [10, 10], "width": 20, "length": 20, "spacing": 10},
        lanes,
    )
    (grid,) = of_kind(features(document([survey])), "grid")
    assert sorted(grid["properties"]["local"]) == [[0, 0], [0, 20], [20, 0], [20, 20]]


def test_a_way_over_the_antimeridian_is_cut_there() -> None:
    go = task(
        "Transit",
        {"target_position": [500, 0]},
        [step("GoToXY", {"x": -500, "y": 0}), step("GoToXY", {"x": 500, "y": 0})],
    )
    found = features(
        document([go], area=[[-900, -900], [900, -900], [900, 900], [-900, 900]]),
        Origin(-17, 180.0),
    )
    way, area = (
        shape(of_kind(found, "task")[0]["geometry"]),
        shape(of_kind(found, "area")[0]["geometry"]),
    )
    assert (way.geom_type, area.geom_type) == ("MultiLineString", "MultiPolygon")
    assert all(
        max(abs(x) for x, _y in part.coords) > 179.99 and part.length < 0.01 for part in way.geoms
    )
    assert [polygon.exterior.is_ccw for polygon in area.geoms] == [True, True]


def test_what_has_no_inside_is_drawn_all_the_same() -> None:
    orbit = task(
        "PerformOrbit", {"center": [0, 0], "radius": 0}, [step("GoToXY", {"x": 0, "y": 0})]
    )
    for origin in (ORIGIN, Origin(-17, 180.0), Origin(-17, -180.0)):
        (circle,) = of_kind(features(document([orbit]), origin), "stand-off")
        west, _south, east, _north = shape(circle["geometry"]).bounds
        assert -180 <= west <= east <= 180


def test_the_collection_says_whether_it_is_approved() -> None:
    assert features(document(MAST))[0]["properties"]["approval"] == DRAFT
    assert (
        features(document(MAST), approval="approved by Ada")[0]["properties"]["approval"]
        == "approved by Ada"
    )
