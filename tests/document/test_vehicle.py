"""The vehicle's profile: what a file says, and what is refused."""

from __future__ import annotations

import shutil
from pathlib import Path

import jsonschema
import pytest

from planner_ft.document.vehicle import check_area, load_vehicle
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED
from planner_ft.vocabulary.schema import document_schema
from tests.documents import DRONE, USV, document, step, task


def test_the_bundled_profile_stands_beside_the_definition() -> None:
    assert load_vehicle(None, USV).name == "usv"
    assert load_vehicle(None, DRONE).cruise_speed > load_vehicle(None, USV).cruise_speed


def test_a_file_replaces_what_it_says(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text(
        'name = "Tern"\ncruise_speed = 3\narea = [[0, 0], [9, 0], [9, 9]]\n'
    )
    vehicle = load_vehicle(tmp_path / "mine.toml", USV)
    assert (vehicle.name, vehicle.cruise_speed, vehicle.endurance) == (
        "Tern",
        3,
        load_vehicle(None, USV).endurance,
    )
    assert vehicle.as_json()["area"] == [[0, 0], [9, 0], [9, 9]]


def test_a_kind_stands_in_the_plan_where_the_profile_states_one(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('kind = "rover"\n')
    vehicle = load_vehicle(tmp_path / "mine.toml", USV)
    assert vehicle.as_json()["kind"] == "rover"
    assert "kind" not in load_vehicle(None, USV).as_json()
    go = [task("Transit", {"target_position": [5, 5]}, [step("GoToXY", {"x": 5, "y": 5})])]
    plan = document(go, USV, command="Go to [5, 5].")
    plan = {**plan, "vehicle": vehicle.as_json()}
    jsonschema.validate(plan, document_schema(USV))
    with pytest.raises(jsonschema.ValidationError):
        jsonschema.validate(
            {**plan, "vehicle": {**plan["vehicle"], "kind": "tank"}}, document_schema(USV)
        )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("cruise_speed = 0", "cruise_speed = 0 must be a number above 0"),
        ("endurance = true", "endurance = True must be"),
        ("turn_rate = inf", "inf is no number"),
        ("speed = 3", "unknown key 'speed'"),
        ('name = ""', "name must be a text"),
        ("area = [[0, 0], [1, 1]]", "at least three positions"),
        ("area = [[0, 0], [9, 9], [9, 0], [0, 9]]", "cross or touch"),
        ('kind = "hovercraft"', "kind = 'hovercraft' must be one of boat, rover, copter"),
        ("kind = 3", "kind = 3 must be one of"),
        ("kind = []", "kind = [] must be one of"),
        ("cruise_speed =", "not TOML"),
    ],
)
def test_a_profile_with_mistakes_is_refused_by_name(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "mine.toml").write_text(text)
    with pytest.raises(PlannerError, match=r"mine\.toml: ") as caught:
        load_vehicle(tmp_path / "mine.toml", USV)
    assert said in str(caught.value)


def test_a_vehicle_without_companion_files_needs_a_profile_and_nothing_else(tmp_path: Path) -> None:
    shutil.copy(BUNDLED / "inspection_drone.toml", tmp_path / "mine.toml")
    mine = load_vocabulary(tmp_path / "mine.toml")
    with pytest.raises(
        PlannerError, match=r"no vehicle profile; write mine\.vehicle\.toml .*--vehicle"
    ):
        load_vehicle(None, mine)
    (tmp_path / "mine.vehicle.toml").write_text(
        'name = "mine"\ncruise_speed = 2\nendurance = 900\nturn_rate = 30\n'
    )
    plan = document(
        [task("FlyToPoint", {"target_position": [5, 5]}, [step("FlyToXY", {"x": 5, "y": 5})])],
        mine,
        command="Fly to [5, 5].",
    )
    assert plan["estimate"] == {"length": 0, "seconds": 0, "open": ["t1"]}
    assert plan["tasks"][0]["sources"]["target_position"]["kind"] == "command"


def test_an_area_is_a_polygon_of_metres() -> None:
    assert check_area([[0, 0], [4, 0], [4, 4]]) == ((0, 0), (4, 0), (4, 4))
    with pytest.raises(PlannerError, match="at least three"):
        check_area("0,0 1,1 2,2")


@pytest.mark.parametrize(
    ("text", "fits"),
    [
        ("endurance = 1e9", True),
        ("endurance = 1.1e9", False),
        ("endurance = 1e-9", True),
        ("endurance = -1", False),
        ("area = [[0, 0], [1e9, 0], [9, -1e9]]", True),
        ("area = [[0, 0], [1.1e9, 0], [9, 9]]", False),
        ("area = [[0, 0], [-1.1e9, 0], [9, 9]]", False),
        ("area = [[0, 0], [1, 1], [2, 0]]", True),
        ("area = [[0, 0], [1, 1], [2]]", False),
        ("name = 3", False),
        ('name = " "', False),
    ],
)
def test_figures_reach_to_a_thousand_million(tmp_path: Path, text: str, *, fits: bool) -> None:
    (tmp_path / "mine.toml").write_text(text)
    if fits:
        load_vehicle(tmp_path / "mine.toml", USV)
    else:
        with pytest.raises(PlannerError):
            load_vehicle(tmp_path / "mine.toml", USV)


def test_what_a_profile_does_not_say_is_a_full_circle_and_ten_metres(tmp_path: Path) -> None:
    shutil.copy(BUNDLED / "inspection_drone.toml", tmp_path / "mine.toml")
    figures = 'name = " mine "\ncruise_speed = 2\nendurance = 900\nturn_rate = 30\n'
    (tmp_path / "mine.vehicle.toml").write_text(figures)
    vehicle = load_vehicle(None, load_vocabulary(tmp_path / "mine.toml"))
    assert (vehicle.orbit_angle, vehicle.stand_off, vehicle.name) == (360, 10, "mine")
    assert vehicle.area is None and vehicle.as_json()["area"] is None
