"""What the command says and the plan lacks: limits, rows of positions, repeats, contradictions."""

from __future__ import annotations

from typing import Any

import pytest

from ...documents import document, step, task

HOME = {"target_position": [0, 0]}
FENCE = "The vehicle stays inside [0, 0], [200, 0], [200, 200], [0, 200]."


def to(x: float, y: float) -> dict[str, Any]:
    return task("Transit", {"target_position": [x, y]}, [step("GoToXY", {"x": x, "y": y})])


def hold(seconds: float) -> dict[str, Any]:
    return task("KeepStation", {"duration": seconds}, [step("StationKeep", {"time": seconds})])


def orbit(arc: float) -> dict[str, Any]:
    return task("PerformOrbit", {"center": [60, 60], "radius": 20, "arc": arc}, None)


def grid(width: float, length: float) -> dict[str, Any]:
    sizes = {"width": width, "length": length, "spacing": 10}
    return task("BathymetryGridSurvey", {"center": [9, 9], **sizes}, None)


def drift() -> dict[str, Any]:
    return task("DriftAudit", {"duration": 60}, [step("DriftWithCurrent", {"time": 60})])


def at(x: float) -> list[dict[str, Any]]:
    return [to(x, 9), hold(60)]


def kinds(command: str, *tasks: dict[str, Any], limits: tuple[str, ...] = ()) -> set[str]:
    plan = document([*tasks], command=command, constraints=limits)
    wanted = ("limit-lost", "value-lost", "repeat-lost", "contradiction")
    return {one["kind"] for one in plan["warnings"]} & {*wanted}


AREA = "Go to 100,50 but never leave the area 0,0 200,0 200,200 0,200, then come home."
PLATFORM = "Go to [100, 0] and do not go closer than 70 m to the platform at 260,80."
AWAY = "The vehicle stays at least 70 m from the platform at [260, 80]."


@pytest.mark.parametrize(
    ("command", "tasks", "limits", "lost"),
    [
        (AREA, [to(100, 50), to(0, 0)], (), "limit-lost"),
        (AREA, [to(100, 50), to(0, 0)], (FENCE,), None),
        (AREA, [to(100, 50), to(0, 200), to(200, 0), to(0, 0)], (), "limit-lost"),
        (PLATFORM, [to(100, 0)], (), "limit-lost"),
        (
            "Go to [0, 90]. A wreck is on your track, keep clear of it.",
            [to(0, 90)],
            (),
            "limit-lost",
        ),
        ("Go to [0, 90]. Keep clear of it.", [to(0, 90)], ("Keep clear of the wreck.",), None),
        ("Go to [9, 9], but not north of 54.3216N.", [to(9, 9)], (), "value-lost"),
        (
            "Go to [9, 9], but not north of 54.3216N.",
            [to(9, 9)],
            ("Stay south of 54.3216N.",),
            None,
        ),
        (PLATFORM, [to(100, 0)], (AWAY,), None),
        (PLATFORM, [to(100, 0)], ("Take care near the platform at 70 m.",), "limit-lost"),
        ("Go to [9, 9] and be back within 20 minutes.", [to(9, 9), hold(1200)], (), "limit-lost"),
        ("Hold here for at most 10 minutes.", [hold(600)], (), None),
        ("Stay away from the wreck at 9,9.", [to(9, 9)], (), "limit-lost"),
        ("Go to 100,20 and 140,60 and 20,90.", [to(100, 20), to(140, 60), to(20, 90)], (), None),
        ("Go to 100,20 and 140,60 and 20,90.", [to(100, 20), to(140, 60)], (), "value-lost"),
        ("Patrol between 9,0 and 9,200.", [to(9, 0)], (), "value-lost"),
        ("Go to 40,0 and 60,40 and 0,60.", [to(40, 0), to(0, 60)], (), "value-lost"),
        ("Go round the mast at 60,60 three times at 20 m.", [orbit(360)], (), "repeat-lost"),
        ("Go round the mast at 60,60 three times at 20 m.", [orbit(1080)], (), None),
        ("Circle the mast at 60,60 twice at 20 m.", [orbit(720)], (), None),
        ("Circle the mast at 60,60 at 20 m. Do not circle it twice.", [orbit(360)], (), None),
        ("Run from 1,0 to 9,0 two times.", [to(1, 0), to(9, 0), to(1, 0), to(9, 0)], (), None),
        ("Run from 1,0 to 9,0 two times.", [to(1, 0), to(9, 0), to(1, 0)], (), "repeat-lost"),
        ("Go to 1,5 and be home by 15:00.", [to(1, 5), to(0, 0)], (), "limit-lost"),
        ("Go home by way of 9,9.", [to(9, 9), to(0, 0)], (), None),
        ("Go to 9,9, do not go near the pontoon at 70,20.", [to(9, 9)], (), "limit-lost"),
        ("Go to 9,9 and don't go inside of the nets.", [to(9, 9)], (), "limit-lost"),
        ("Go to 9,9, keep clear of the nets.", [to(9, 9)], ("Keep clear of the nets.",), None),
        ("Hold at 9,9, 50 s, don't come within 50 m.", [to(9, 9), hold(50)], (), "limit-lost"),
        ("Circle the mast at 60,60, radius 15.", [orbit(360)], (), "value-lost"),
        ("Map 50 by 50 m at 9,9, 10 m lines.", [grid(50, 10)], (), "value-lost"),
        ("Map 50*50 m at 9,9, 10 m lines.", [grid(50, 50)], (), None),
        ("Map 50x20 m at 9,9, no, 20 by 50 m, 10 m lines.", [grid(20, 50)], (), None),
        ("Circle the mast at 60,60, radius 20.", [orbit(360)], (), None),
        ("Circle it at 20 m. Actually 5 is enough.", [orbit(360)], (), "value-lost"),
        ("Circle it at 9 m, then home. Actually 20 will do.", [orbit(360), to(0, 0)], (), None),
        ("Circle it at 9 m, then home.", [orbit(360), to(0, 0)], (), "value-lost"),
        ("Drift at 5,5. No drift after all.", [to(5, 5), drift()], (), "contradiction"),
        ("Drift at 5,5.", [to(5, 5), drift()], ("No drift is made.",), "contradiction"),
        ("Drift at 5,5.", [to(5, 5), drift()], ("The drift must be slow.",), None),
        ("Go to 5,5.", [to(5, 5)], ("No drift is made.",), None),
        ("Don't drift at 5,5 yet. Then drift.", [to(5, 5), drift()], (), None),
        ("Hold a minute at 1,9, 2,9 and 3,9.", [*at(1), *at(2), *at(3)], (), None),
        ("Hold a minute at 1,9, 2,9 and 3,9.", [*at(1), *at(2), to(3, 9)], (), "value-lost"),
        ("Wait until 14:30, then hold at 9,9.", [to(9, 9), hold(60)], (), "value-lost"),
        ("Hold at 9,9 from 11:10 to 11:30.", [to(9, 9), hold(1200)], (), None),
        ("Hold at 9,9 for 2:30.", [to(9, 9), hold(150)], (), None),
        ("Come home, but do not come home.", [to(0, 0)], (), "contradiction"),
        ("Go to [9, 9]. Do not go to [9, 9].", [to(9, 9)], (), "contradiction"),
        ("Do not stop at 9,9, and come home.", [to(0, 0)], (), None),
    ],
)
def test_what_is_lost_is_told(
    command: str, tasks: list[dict[str, Any]], limits: tuple[str, ...], lost: str | None
) -> None:
    assert kinds(command, *tasks, limits=limits) == ({lost} if lost else set())


@pytest.mark.parametrize(
    ("prompt", "made"),
    [("Inspect reliping at [9, 9].", ["reliping"]), ("Inspect the Durius at [9, 9].", []),
     ("Inspect the durios.", []), ("Inspect the buoy.", [])],
)  # fmt: skip
def test_words_that_nobody_said_are_told(prompt: str, made: list[str]) -> None:
    survey = task("SurveyTarget", {"target_position": [9, 9]}, None, prompt)
    plan = document([survey], command="Inspect the Durius at 9,9.")
    told = [one["text"] for one in plan["warnings"] if "its prompt says" in one["text"]]
    assert [word in "".join(told) for word in made] == [True] * len(told)


@pytest.mark.parametrize(
    ("command", "kind"),
    [
        ("Be back by 16:30.", "limit-lost"),
        ("Do not go beyond x = 120.", "limit-lost"),
        ("Go to [9, 9], make coffee, and come home.", "not-planned"),
    ],
)
def test_limits_of_time_and_axis_and_strange_instructions(command: str, kind: str) -> None:
    plan = document([to(9, 9), to(0, 0)], command=command)
    assert kind in [one["kind"] for one in plan["warnings"]]


def test_a_known_place_that_the_command_names_wants_a_task() -> None:
    command = "Inspect Kestrel and Osprey."
    for chart, lost in (({"Osprey": (88, 40)}, True), ({"Heron": (88, 40)}, False)):
        plan = document([to(40, 40)], command=command, chart=chart)
        texts = [one["text"] for one in plan["warnings"] if one["kind"] == "value-lost"]
        assert texts == (
            ["The command speaks of Osprey, and no task is at [88, 40], where that is."] * lost
        )
    plan = document([to(88, 40)], command=command, chart={"Osprey": (88, 40)})
    assert not [one for one in plan["warnings"] if one["kind"] == "value-lost"]
