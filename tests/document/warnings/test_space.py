"""What the track breaks, at the bounds: limits, stand-offs, areas, reach, endurance."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document import PlanDocument, revise
from planner_ft.document.edits import apply

from ...documents import USV, document, step, task


def go(*points: tuple[float, float]) -> dict[str, Any]:
    steps = [step("GoToXY", {"x": x, "y": y}) for x, y in points]
    return task("Transit", {"target_position": [*points[-1]]}, steps, "Go.")


def told(plan: PlanDocument, kind: str) -> list[str]:
    return [one["text"] for one in plan["warnings"] if one["kind"] == kind]


def broken(text: str, *tasks: dict[str, Any]) -> list[str]:
    return told(document(tasks, constraints=[text]), "limit-broken")


INSIDE = "The vehicle stays inside [0, -10], [100, -10], [100, 50], [0, 50]."
NOTCH = "The vehicle stays inside [-5, -5], [100, -5], [100, 60], [50, 10], [-5, 60]."
OUTSIDE = "The vehicle stays outside [20, -10], [40, -10], [40, 10], [20, 10]."
HOME = "The vehicle stays within 100 m of home."
WRECK = "The vehicle stays at least {} m from the wreck at [50, 0]."


@pytest.mark.parametrize(
    ("text", "points", "how"),
    [
        (INSIDE, [(100.4, 0)], None),
        (INSIDE, [(100.6, 0)], "goes to [100.6, 0], outside of it"),
        (INSIDE, [(50, 50.4)], None),
        (INSIDE, [(50, 60)], "goes to [50, 60], outside of it"),
        (NOTCH, [(0, 40), (100, 40)], "leaves it on the way"),
        (NOTCH, [(0, 40), (50, 5), (100, 40)], None),
        (OUTSIDE, [(19, 0)], None),
        (OUTSIDE, [(20.4, 0)], None),
        (OUTSIDE, [(20.6, 0)], "enters it on the way to [20.6, 0]"),
        (OUTSIDE, [(0, 30), (60, 9)], None),
        (OUTSIDE, [(0, 9), (60, 9)], None),  # led round it
        (OUTSIDE, [(0, 9), (30, 9), (60, 9)], "enters it on the way to [30, 9]"),
        (HOME, [(100.4, 0)], None),
        (HOME, [(0, -100.6)], "goes 101 m away from home"),
        (HOME, [(99, 0), (120, 0), (130, 0)], "goes 130 m away from home"),
    ],
)
def test_a_limit_of_space_is_kept_to_half_a_metre(
    text: str, points: list[tuple[float, float]], how: str | None
) -> None:
    assert broken(text, go(*points)) == (
        [f'Task 1, Transit: {how}, against the limit "{text.rstrip(".")}".'] if how else []
    )


@pytest.mark.parametrize(
    ("command", "limit", "near"),
    [
        ("Pass pile D2 at [50, 5], 25 m off any pile being driven.", "a pile being driven", True),
        ("A round concrete dolphin stands bang in the middle (50, 5).", "the dolphin stands", True),
        (
            "A round concrete dolphin stands bang in the middle (50, 90).",
            "the dolphin stands",
            False,
        ),
        ("Pass the buoy at [50, 5], 25 m off any pile being driven.", "a pile being driven", False),
    ],
)
def test_a_limit_without_a_place_is_broken_where_what_it_names_may_be(
    command: str, limit: str, near: bool
) -> None:
    text = f"The vehicle stays at least 25 m from {limit}."
    plan = document([go((100, 0))], command=command, constraints=[text])
    assert any("[50, 5], where" in one for one in told(plan, "limit-broken")) is near


@pytest.mark.parametrize(("berth", "count"), [((50, 0), 1), ((50, 29), 1), ((50, 30), 0)])
def test_a_berth_that_a_limit_keeps_the_vehicle_from_is_told(
    berth: tuple[float, float], count: int
) -> None:
    steps = [step("GoToXY", {"x": 19, "y": 0})]
    dock = task("DockingApproach", {"goal_position": [*berth]}, steps, "Dock there.")
    assert len(broken(WRECK.format(30), dock)) == count


@pytest.mark.parametrize(
    ("radius", "name", "count"), [(15, "wreck", 1), (15, "mast", 0), (30, "wreck", 0)]
)
def test_a_round_closer_than_a_limit_is_told_before_the_thing_is_found(
    radius: float, name: str, count: int
) -> None:
    values = {"target_position": [-99, -99], "radius": radius}
    survey = task("SurveyTarget", values, None, f"Inspect the {name} once it has been found.")
    assert len(broken("The vehicle stays at least 30 m from the wreck.", survey)) == count
    assert len(broken(WRECK.format(30), survey)) == count


def test_an_area_without_an_inside_is_a_line_that_is_not_crossed() -> None:
    line = "The vehicle stays outside [50, -20], [50, -20], [50, 20]."
    assert broken(line, go((50, 0)))
    assert not broken(line, go((40, 0)))
    around = document([go((100, 0))], constraints=[line])
    assert len(around["tasks"][0]["skill_sequence"]) == 3
    assert not told(around, "limit-broken")


def test_legs_over_a_place_that_no_task_and_no_limit_has_are_told() -> None:
    def passes(command: str, *points: tuple[float, float], constraint: str = "") -> list[str]:
        plan = document([go(*points)], command=command, constraints=[constraint])
        return told(plan, "structure-close")

    rock = "Watch for the thing at 60 30 and go to [120, 60]."
    prose = "The vehicle has no task for watching at [60, 30]."
    (found,) = passes(rock, (120, 60), constraint=prose)
    assert "[60, 30], which the command names and neither a task nor a limit has" in found
    assert not passes(rock, (0, 60), (120, 60), constraint=prose)
    assert not passes("Go to [120, 60].", (120, 60))


@pytest.mark.parametrize(("radius", "count"), [(1, 1), (1.9, 1), (2, 0), (25, 0)])
def test_a_distance_is_hardly_meant_below_a_fifth_of_the_stand_off(
    radius: float, count: int
) -> None:
    turn = step("ArcTurn", {"radius": radius, "delta_yaw": 360})
    orbit = task("PerformOrbit", {"center": [60, 60], "radius": radius, "arc": 360}, [turn])
    found = told(
        document([orbit], command=f"Circle the mast at 60,60 at {radius} m."), "structure-close"
    )
    assert [f"stay {radius:g} m off" in one for one in found] == [True] * count


@pytest.mark.parametrize(
    ("x", "prompt", "count"),
    [(118, "Pass the mole.", 1), (68, "Pass the mole.", 0), (118, "Pass the pier at [110, 9].", 0)],
)
def test_a_pass_lies_where_the_plan_has_gone(x: float, prompt: str, count: int) -> None:
    steps = [step("GoToXY", {"x": x, "y": y}) for y in (-60, 140)]
    values = {"side_id": "east", "length": 200, "distance": 8}
    plan = document([go((60, 40)), task("ParallelStructurePass", values, steps, prompt)])
    away = [one for one in told(plan, "not-performed") if "its waypoints pass 58 m from" in one]
    assert len(away) == count


def test_a_limit_finds_its_thing_by_the_name_without_its_number() -> None:
    turn = step("ArcTurn", {"radius": 25, "delta_yaw": 360})
    orbit = task("PerformOrbit", {"center": [99, 9], "radius": 25, "arc": 360}, [turn])
    plan = document(
        [orbit],
        command="Orbit turbine A1 at (99, 9), radius 25. Never closer than 40 m to that turbine.",
        constraints=["The vehicle stays at least 40 m from the turbine."],
    )
    (found,) = told(plan, "limit-broken")
    assert "comes within 25 m" in found


@pytest.mark.parametrize(
    ("said", "count"), [("x = 50", 1), ("y=50", 0), ("x = 100", 0), ("100 x 50", 0)]
)
def test_a_line_that_the_plan_goes_across_is_told(said: str, count: int) -> None:
    plan = document([go((100, 0))], command=f"Go to [100, 0]. The permit ends at {said}.")
    crossed = [one for one in told(plan, "limit-lost") if "to both sides of it" in one]
    assert len(crossed) == count


def test_a_length_is_no_way_off_a_place_that_nobody_said() -> None:
    plan = document(
        [go((150.3, -37.6), (0, 0))], command="Go to 160,-40, one reading from 40 m off."
    )
    assert any("40 m" in text for text in told(plan, "value-lost"))


def off(metres: float, *points: tuple[float, float]) -> list[str]:
    """What is told of a limit around [50, 0] where no way round it is looked for."""
    plan = document([go(*points)], constraints=[WRECK.format(metres)])
    plan["tasks"][0]["skill_sequence"] = go(*points)["skill_sequence"]
    assert told(revise(plan, USV), "structure-close") == [], "the limit is told of it"
    return [one.split(",")[1].split(": ")[1] for one in told(revise(plan, USV), "limit-broken")]


def test_a_distance_that_is_kept_off_is_of_the_whole_leg() -> None:
    assert off(20, (20, 30), (80, 30)) == off(20, (0, 19.5), (100, 19.5)) == []
    assert off(20, (0, 19), (100, 19)) == ["comes within 19 m"]
    assert off(20, (0, 19), (100, 19), (100, 60), (0, 60), (10, 10)) == ["comes within 19 m"]
    hold = task("KeepStation", {}, [step("StationKeep", {"time": 9})])
    tasks = [go((0, -19)), hold, go((50, -19))]
    plan = document(tasks, constraints=[WRECK.format(20)])
    for entry, own in zip(plan["tasks"], tasks, strict=True):
        entry["skill_sequence"] = own["skill_sequence"]
    assert told(revise(plan, USV), "limit-broken")[0].startswith("Task 3, Transit: comes within")


@pytest.mark.parametrize(("x", "near"), [(202, False), (202.1, True)])
def test_a_great_distance_may_be_missed_by_half_a_hundredth(x: float, *, near: bool) -> None:
    text = "The vehicle stays at least 400 m from the wreck at [600, 0]."
    assert bool(broken(text, go((x, 0)))) is near


def test_a_plan_and_a_task_may_last_as_long_as_the_limit() -> None:
    hold = task("KeepStation", {"duration": 600}, [step("StationKeep", {"time": 600})])
    for seconds, count in ((599, 1), (600, 0), (601, 0)):
        text = f"The mission takes at most {seconds} s."
        assert len(broken(text, hold)) == count
    (found,) = broken("The mission takes at most 599 s.", hold)
    assert found.startswith("The plan takes about 600 s, against")


@pytest.mark.parametrize(("limit", "count"), [(1.4, 1), (1.5, 0), (2, 0)])
def test_a_task_may_be_as_fast_as_the_limit(limit: float, count: int) -> None:
    given = {"side_id": "west", "length": 20, "distance": 5, "speed": 1.5}
    ends = [step("GoToXY", {"x": 35, "y": y}) for y in (0, 20)]
    passing = task("ParallelStructurePass", given, ends)
    assert len(broken(f"The vehicle goes no faster than {limit} m/s.", passing)) == count


def test_what_is_recorded_near_a_thing_is_found_by_its_name() -> None:
    snap = step("StationKeep", {"time": 9})
    snap["perception_skills"] = [{"name": "CaptureGeoSnapshot", "parameters": {}}]
    near, far = (
        task("KeepStation", {}, [snap], f"Hold near the {name}.") for name in ("Marina", "pier")
    )
    looking = task("KeepStation", {}, [step("StationKeep", {"time": 9})], "Hold near the marina.")
    assert broken("Nothing is recorded near marina.", far, looking) == []
    (found,) = broken("Nothing is recorded near marina.", far, near)
    assert found.startswith("Task 2, KeepStation: records (CaptureGeoSnapshot), against")
    assert len(broken("Nothing is recorded.", looking, far)) == 1


# ---------------------------------------------------------------- boundaries, area, reach


def fenced(*points: tuple[float, float], step_of: int = 0) -> dict[str, Any]:
    one = go(*points)
    corners = [[0, -5], [50, -5], [50, 50], [0, 50]]
    own = {"name": "BoundaryEnforcement", "parameters": {"poly_coords": corners}}
    one["skill_sequence"][step_of]["filter_skills"] = [own]
    return one


def test_a_boundary_is_of_its_step_and_where_it_ends() -> None:
    def outside(*points: tuple[float, float], at: int = 0) -> list[str]:
        return told(document([fenced(*points, step_of=at)]), "outside-boundary")

    assert outside((50.4, 0)) == []
    assert outside((50.6, 0)) == [
        "Task 1, Transit goes to [50.6, 0], which is outside its boundary."
    ]
    assert outside((90, 0), (40, 0), at=1) == [], "the leg begins outside"
    assert len(outside((40, 0), (90, 0), at=1)) == 1 and outside((40, 0), (90, 0)) == []


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("The crew works inside [0, 0], [20, 0], [20, 20], [0, 20].", 1),
        ("The crew works inside (0, 0), (20, 0), (20, 20), (0, 20).", 1),
        ("The crew works inside [0, 0], [20, 0], [20, 20].", 1),
        ("The crew works inside [0, 0], [90, 0], [0, 0].", 0),
        ("The crew works inside [0, 0], [90, 0], [90, 90].", 0),
        ("The crew works at [0, 0], [20, 0], [20, 20], [0, 20].", 0),
    ],
)
def test_an_area_in_a_constraint_that_is_no_limit_is_a_boundary_too(text: str, count: int) -> None:
    plan = document([go((30, 10))], constraints=[text])
    assert len(told(plan, "outside-boundary")) == count


def test_a_way_out_of_the_vehicle_s_area_between_two_places_in_it_is_told() -> None:
    plan = document([go((0, 80)), go((90, 80)), go((0, 0))])
    bay = [[-5, -5], [100, -5], [100, 90], [60, 90], [60, 20], [40, 20], [40, 90], [-5, 90]]
    plan = revise({**plan, "vehicle": {**plan["vehicle"], "area": bay}}, USV)
    left = [text for text in told(plan, "outside-area") if "on the way" in text]
    assert [text.split(" leaves")[0] for text in left] == ["Task 2, Transit", "Task 3, Transit"]


def test_what_goes_too_far_from_home_is_the_task_that_goes_out() -> None:
    (found,) = broken(HOME, go((150, 0)), go((0, 0)))
    assert found.startswith("Task 1, Transit: goes 150 m away")


def test_a_limit_on_how_long_a_task_lasts_is_checked_for_it() -> None:
    hold = task("KeepStation", {"duration": 600}, [step("StationKeep", {"time": 600})])
    text = "The mission takes at most {} s during KeepStation."
    (found,) = broken(text.format(60), go((9, 0)), hold)
    assert found.startswith("Task 2, KeepStation: takes 600 s")
    assert broken(text.format(600), go((900, 0)), hold) == []


@pytest.mark.parametrize(
    ("x", "reach", "area"), [(100, 0, 0), (100.4, 1, 0), (100.6, 1, 1), (101, 1, 1)]
)
def test_the_reach_is_half_of_what_the_vehicle_goes_and_the_area_has_half_a_metre(
    x: float, reach: int, area: int
) -> None:
    plan = document([go((x, 0))])
    corners = [[-5, -5], [100, -5], [100, 5], [-5, 5]]
    vehicle = {**plan["vehicle"], "cruise_speed": 2, "endurance": 100, "area": corners}
    plan = revise({**plan, "vehicle": vehicle}, USV)
    assert len(told(plan, "out-of-reach")) == reach and len(told(plan, "outside-area")) == area
    plan["vehicle"] = None
    assert told(revise(plan, USV), "out-of-reach") == []


def test_the_farthest_point_is_the_one_that_is_out_of_reach() -> None:
    plan = document([go((120, 0), (0, 150), (0, -140))])
    vehicle = {**plan["vehicle"], "cruise_speed": 2, "endurance": 100}
    (found,) = told(revise({**plan, "vehicle": vehicle}, USV), "out-of-reach")
    assert "[0, 150]" in found and "150 m" in found and "100 m" in found


def test_a_task_that_waits_is_out_of_the_area_by_its_place() -> None:
    plan = document([task("PerformOrbit", {"center": [90, 0], "radius": 5}, None)])
    corners = [[-5, -5], [50, -5], [50, 5], [-5, 5]]
    plan = revise({**plan, "vehicle": {**plan["vehicle"], "area": corners}}, USV)
    assert len(told(plan, "outside-area")) == 1


# ---------------------------------------------------------------- endurance


def over(seconds: float, *tasks: dict[str, Any], endurance: float = 600) -> list[str]:
    hold = task("KeepStation", {"duration": seconds}, [step("StationKeep", {"time": seconds})])
    plan = document([hold, *tasks])
    plan = revise({**plan, "vehicle": {**plan["vehicle"], "endurance": endurance}}, USV)
    return told(plan, "over-endurance") + told(plan, "endurance-open")


OPEN = task("Transit", {"target_position": [-99, -99]}, None, "Go to the buoy.")


def test_the_time_may_be_the_endurance_and_what_is_not_known_matters_from_half_of_it() -> None:
    assert over(600) == [] and len(over(601)) == 1
    assert over(300, OPEN) == [] and len(over(301, OPEN)) == 1
    (found,) = over(601, OPEN)
    assert "11 min" in found and "10 min" in found and "not known of task 2." in found
    assert over(601) == ["The plan takes at least 11 min, and the vehicle lasts 10 min."]


def test_the_way_home_counts_from_where_the_plan_ends_and_is_named_from_a_minute() -> None:
    assert over(500, go((75, 0))) == [], "50 s out and 50 s back"
    (found,) = over(500, go((90, 0)), endurance=619)
    assert (
        "10 min and 1 min for the way home" in found and over(500, go((90, 0)), endurance=620) == []
    )
    (found,) = over(500, go((88, 0)))
    assert "for the way home" not in found
    assert over(500, go((75, 0)), go((0, 0))) == [] and len(over(501, go((75, 0)), go((0, 0)))) == 1


# ---------------------------------------------------------------- rings


def ring(at: tuple[float, float], first: tuple[float, float]) -> dict[str, Any]:
    given = {"target_position": [*at], "radius": 10}
    return task("SurveyTarget", given, [step("GoToXY", {"x": first[0], "y": first[1]})], "Survey.")


@pytest.mark.parametrize(
    ("words", "first", "lost"),
    [
        ("beginning on the north side", (60, 70), False),
        ("beginning on the north side", (66, 70), True),
        ("beginning on the north side", (70, 60), True),
        ("starting north", (70, 60), True),
        ("starting in the north-east corner", (70, 70), False),
        ("start with the north buoy", (70, 60), False),
        ("start south of it", (60, 70), True),
        ("start south of it", (60, 50), False),
        ("start at the buoy south of the pier", (60, 70), False),
    ],
)
def test_a_ring_begins_on_the_side_that_is_said(
    words: str, first: tuple[float, float], lost: bool
) -> None:
    plan = document([ring((60, 60), first)], command=f"Survey [60, 60] at 10 m, {words}.")
    assert bool(told(plan, "value-lost")) is lost


def test_a_ring_round_home_wants_words_for_home() -> None:
    plan = document([ring((0, 0), (10, 0))], command="Survey it at 10 m, then home.")
    assert len(told(plan, "value-not-said")) == 1
    plan = document([ring((0, 0), (10, 0))], command="Survey [0, 0] at 10 m.")
    assert told(plan, "value-not-said") == []


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("Moorings at 40,10 and 80,40: stay 15 m clear of both. Go to 80,40.", 0),
        ("Stay 15 m clear of the moorings at 40,10 and 80,40.", 1),
        ("Stay 15 m clear of the mooring at 40,10 and the one at 80,40.", 1),
        ("Stay 15 m clear of the mooring at 40,10 and go to 80,40.", 0),
        ("Stay 15 m clear of the mooring at 40,10. The one at 80,40 comes next.", 0),
    ],
)
def test_a_limit_at_one_place_of_a_row_is_told(command: str, count: int) -> None:
    plan = document(
        [go((80, 40))],
        command=command,
        constraints=["The vehicle stays at least 15 m from the mooring at [40, 10]."],
    )
    found = [one for one in told(plan, "limit-lost") if "one of these places" in one]
    assert len(found) == count


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("Stay inside x 0 to 50, y -10 to 30.", 0),
        ("Stay inside x 0..50 y -10..30.", 0),
        ("Stay between 0,-10 and 50,30.", 0),
        ("Stay inside 0,-10 50,-10 50,30 0,30.", 0),
        ("Stay inside the 50 by 40 m box around 25,10.", 0),
        ("Stay inside the 40 by 50 m box around 25,10.", 1),
        ("Stay inside the area between x 0 and 50, go to 40,30.", 1),
    ],
)
def test_an_area_that_nobody_said_is_told(command: str, count: int) -> None:
    area = "The vehicle stays inside [0, -10], [50, -10], [50, 30], [0, 30]."
    plan = document([go((40, 30))], command=command, constraints=[area])
    assert [area[:-1] in one for one in told(plan, "value-not-said")].count(True) == count


def test_an_area_is_as_wide_both_ways() -> None:
    area = "The vehicle stays inside [-9, -9], [9, -9], [9, 9], [-9, 9]."
    command = "Go to 4,3. Stay within -9 to 9 both ways."
    plan = document([go((4, 3))], command=command, constraints=[area])
    assert not told(plan, "value-not-said")


@pytest.mark.parametrize(
    ("command", "count"),
    [
        ("Pass the buoy at [40, 3] on its west side, on to 9,3.", 0),
        ("Pass the buoy. Go to 9,3.", 1),
    ],
)
def test_a_direction_of_a_constraint_that_nobody_said_is_told(command: str, count: int) -> None:
    text = "Stay west of the buoy at [40, 3]."
    plan = document([go((9, 3))], command=command, constraints=[text])
    found = [text[:-1] in one for one in told(plan, "value-not-said")]
    assert found.count(True) == count
    edited = apply(plan, {"kind": "constraint", "at": 1, "text": "Stay east of the pier."}, USV)
    assert not any("east of the pier" in one for one in told(edited, "value-not-said"))
