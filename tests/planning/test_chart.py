"""Places and areas from GeoJSON."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.planning.locations import OpenPlace, charted, read_area, read_places
from planner_ft.support.errors import PlannerError
from planner_ft.support.geodesy import Origin

KIEL = Origin(54.32, 10.14)


def collection(path: Path, *geometries: Any, **more: Any) -> Path:
    features = [
        {
            "type": "Feature",
            "properties": {"name": name},
            "geometry": {"type": kind, "coordinates": at},
        }
        for name, kind, at in geometries
    ]
    path.write_text(json.dumps({"type": "FeatureCollection", "features": features, **more}))
    return path


def test_points_by_name(tmp_path: Path) -> None:
    file = collection(tmp_path / "t.geojson", ("green buoy", "Point", [10.1412, 54.3217]))
    assert read_places(file, KIEL)["green buoy"] == pytest.approx((78.1, 189.2), abs=0.1)
    file = collection(tmp_path / "m.geojson", ("wreck", "Point", [40, 25]), frame="local metres")
    assert read_places(file, None) == {"wreck": (40.0, 25.0)}


def test_an_area(tmp_path: Path) -> None:
    ring = [[0, 0], [200, 0], [200, 200], [0, 0]]
    file = collection(tmp_path / "a.geojson", (None, "Polygon", [ring]), frame="local metres")
    assert read_area(file, KIEL) == [(0, 0), (200, 0), (200, 200)]


def test_wrong_files_are_refused_in_one_sentence(tmp_path: Path) -> None:
    degrees = collection(tmp_path / "a.geojson", ("buoy", "Point", [10, 54]))
    nameless = collection(tmp_path / "b.geojson", (None, "Point", [10, 54]))
    twice = collection(tmp_path / "c.geojson", ("b", "Point", [1, 2]), ("b", "Point", [2, 2]))
    far = collection(tmp_path / "d.geojson", ("buoy", "Point", [500, 54]))
    broken = collection(tmp_path / "e.geojson", ("buoy", "Point", ["x", 54]))
    (tmp_path / "f.geojson").write_text("{")
    (tmp_path / "g.geojson").write_text("[]")
    odd = tmp_path / "h.geojson"
    feature = {"type": "Feature", "properties": 5, "geometry": {"type": "Point"}}
    odd.write_text(json.dumps(feature))
    (tmp_path / "i.geojson").write_text('{"type": "FeatureCollection", "features": 5}')
    rings = [
        collection(tmp_path / f"{number}.geojson", (None, "Polygon", ring))
        for number, ring in enumerate(([], [5], [[]], None))
    ]
    cases: list[tuple[Path, Origin | None, str]] = [
        (degrees, None, "--origin"),
        (nameless, KIEL, "name"),
        (twice, KIEL, "two points"),
        (far, KIEL, "degrees"),
        (broken, KIEL, "no coordinate"),
        (tmp_path / "f.geojson", KIEL, "JSON"),
        (tmp_path / "g.geojson", KIEL, "FeatureCollection"),
        (odd, KIEL, "name"),
        (tmp_path / "i.geojson", KIEL, "no points"),
        (tmp_path / "none.geojson", KIEL, "no such file"),
    ]
    for path, origin, words in cases:
        with pytest.raises(PlannerError, match=words):
            read_places(path, origin)
    for path in (degrees, *rings):
        with pytest.raises(PlannerError, match="one polygon"):
            read_area(path, KIEL)


def test_a_chart_fills_what_fits_one_place() -> None:
    places = [OpenPlace("green buoy", (1,)), OpenPlace("old wreck", (2,))]
    chart = {"The Green Buoy": (1.0, 2.0), "wreck": (3.0, 4.0), "pier": (5.0, 6.0)}
    assert charted(chart, places) == {"green buoy": (1.0, 2.0), "old wreck": (3.0, 4.0)}


def test_a_chart_fits_in_whole_words_and_numbers() -> None:
    places = [OpenPlace("room 203", (1,)), OpenPlace("room 1", (2,)), OpenPlace("lift", (3,))]
    chart = {"room 20": (1.0, 2.0), "room 11": (3.0, 4.0), "goods lift": (5.0, 6.0)}
    assert charted(chart, places) == {"lift": (5.0, 6.0)}
