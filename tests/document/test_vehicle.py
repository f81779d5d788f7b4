"""The vehicle's profile: what a file says, and what is refused."""

from __future__ import annotations

from pathlib import Path

import pytest

from planner_ft.document.vehicle import check_area, load_vehicle
from planner_ft.support.errors import PlannerError

from ..documents import DRONE, USV


def test_the_bundled_profile_stands_beside_the_definition() -> None:
    assert load_vehicle(None, USV).name == "usv"
    assert load_vehicle(None, DRONE).cruise_speed > load_vehicle(None, USV).cruise_speed


def test_a_file_replaces_what_it_says(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('name = "Tern"\ncruise_speed = 3\narea = [[0, 0], [9, 0], [9, 9]]\n')
    vehicle = load_vehicle(tmp_path / "mine.toml", USV)
    assert (vehicle.name, vehicle.cruise_speed, vehicle.endurance) == ("Tern", 3, load_vehicle(None, USV).endurance)
    assert vehicle.as_json()["area"] == [[0, 0], [9, 0], [9, 9]]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("cruise_speed = 0", "cruise_speed = 0 must be a number above 0"),
        ("endurance = true", "endurance = True must be"),
        ("turn_rate = inf", "turn_rate = inf must be"),
        ("speed = 3", "unknown key 'speed'"),
        ('name = ""', "name must be a text"),
        ("area = [[0, 0], [1, 1]]", "at least three positions"),
        ("area = [[0, 0], [9, 9], [9, 0], [0, 9]]", "cross or touch"),
        ("cruise_speed =", "not TOML"),
    ],
)
def test_a_profile_with_mistakes_is_refused_by_name(tmp_path: Path, text: str, said: str) -> None:
    (tmp_path / "mine.toml").write_text(text)
    with pytest.raises(PlannerError, match=r"mine\.toml: ") as caught:
        load_vehicle(tmp_path / "mine.toml", USV)
    assert said in str(caught.value)


def test_an_area_is_a_polygon_of_metres() -> None:
    assert check_area([[0, 0], [4, 0], [4, 4]]) == ((0, 0), (4, 0), (4, 4))
    with pytest.raises(PlannerError, match="at least three"):
        check_area("0,0 1,1 2,2")
