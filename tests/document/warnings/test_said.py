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


def orbit(arc: float, at: tuple[float, float] = (60, 60)) -> dict[str, Any]:
    return task("PerformOrbit", {"center": [*at], "radius": 20, "arc": arc}, None)


def grid(width: float, length: float) -> dict[str, Any]:
    sizes = {"width": width, "length": length, "spacing": 10}
    return task("BathymetryGridSurvey", {"center": [9, 9], **sizes}, None)


def drift() -> dict[str, Any]:
    return task("DriftAudit", {"duration": 60}, [step("DriftWithCurrent", {"time": 60})])


def along(side: str) -> dict[str, Any]:
    return task("ParallelStructurePass", {"side_id": side, "length": 50, "distance": 5}, None)


def at(x: float) -> list[dict[str, Any]]:
    return [to(x, 9), hold(60)]


def kinds(command: str, *tasks: dict[str, Any], limits: tuple[str, ...] = ()) -> set[str]:
    plan = document([*tasks], command=command, constraints=limits)
    wanted = ("limit-lost", "value-lost", "repeat-lost", "contradiction")
    return {one["kind"] for one in plan["warnings"]} & {*wanted}


def look(sectors: int) -> dict[str, Any]:
    turns = [step("RotateToHeading", {"heading": 360 / sectors * at}) for at in range(sectors)]
    return task("HorizontalPanorama", {"sectors": sectors}, turns)


SWEEP = task("BoatLandingClearanceSweep", {}, [step("StationKeep", {})])
REPORT = task("AutoGenerateReportSummary", {}, [step("StationKeep", {})])
SHUTTLE = "From 1,0 to 9,0 and back to 1,0, three times over."
ARROWS = "Shuttle 1,0 -> 9,0 and back to 1,0, THREE times in all."
NINETY = "go to eighty forty sorry no one hundred eighty forty and wait two minutes"
CORNERS = "run down to x one eighty y forty"
FOUR_SIDES = "Along the north side, then the east side, then the west side, 50 m, 5 m off."
BY_WORDS = "Map thirty wide by thirty long at 9,9, 10 m lines."
PILES = "To 9,0. Two piles on the way, 60,5 and 120,-5, give both of them 25 m."
LOST, OPEN = "limit-lost value-lost", (-99, -99)
KEPT = "The vehicle stays at least 25 m from [60, 5]."
SITES = "Out there: buoy [60, 20], pontoon [20, 60], barge [90, 90]. Hold at the buoy, then the pontoon."
REEF = "Circle it at twenty metres at sixty sixty, never nearer than forty metres to the reef, via 9,9."
OFF_REEF = "The vehicle stays at least 40 m from the reef."
LOOP = "Do the loop [4, 0], [4, 4], [0, 4] twice."
BOX = "The area is [0, 0], [200, 0], [200, 200], [0, 200]"
BACKS = [to(1, 1), to(9, -34)]
BERTHS = "Sound berths 1 and 2 at 9,9 and 9,9. Each 40 m wide x 20 m long, lines at 10 m."
RAMP = "Visit the pier at 9,9 and the ramp at 30,9. On second thoughts leave out the ramp."
AREA = "Go to 100,50 but never leave the area 0,0 200,0 200,200 0,200, then come home."
PLATFORM = "Go to [100, 0] and do not go closer than 70 m to the platform at 260,80."
KAYAK = "The vehicle stays at least 15 m from the kayak at [9, 50]."
RAFT = "The vehicle stays at least 15 m from the raft at [9, 9]."
AWAY = "The vehicle stays at least 70 m from the platform at [260, 80]."


@pytest.mark.parametrize(
    ("command", "tasks", "limits", "lost"),
    [
        ("Out to 80 40, give it five, back in.", [to(80, 40), to(0, 0)], (), "value-lost"),
        ("Out to 80 40, give it five, back in.", [to(80, 40), hold(300), to(0, 0)], (), None),
        ("Out to 80 40, pass contact 5.", [to(80, 40)], (), None),
        ("Round the mast at 60,60 at 20 m, then at 35.", [orbit(360)], (), "value-lost"),
        ("Round the mast at 60,60 at 20 m. Lunch is at nine.", [orbit(360)], (), None),
        (
            "Follow contact 8 no belay that go to 80 40 keep 35 m off",
            [to(80, 40)],
            (),
            "value-lost",
        ),
        ("Map sixty by sixty at 9,9, 10 m lines.", [grid(60, 20)], (), "value-lost"),
        ("Map sixty by twenty, no, sixty by sixty at 9,9, 10 m lines.", [grid(60, 60)], (), None),
        ("Map 50 x 50 m at 9,9, 10 m lines.", [grid(50, 50)], (), None),
        (AREA, [to(100, 50), to(0, 0)], (), "limit-lost"),
        (AREA, [to(100, 50), to(0, 0)], (FENCE,), None),
        (f"{BOX} and never leave it. Go to 9,9.", [to(9, 9)], (FENCE,), None),
        ("Go to 9,9, keep out of the box 0,0 to 200,200.", [to(9, 9)], (FENCE,), None),
        ("Go to 9,9, keep out of the box 0,0 to 90,200.", [to(9, 9)], (FENCE,), LOST),
        (AREA, [to(100, 50), to(0, 200), to(200, 0), to(0, 0)], (), "limit-lost"),
        (PLATFORM, [to(100, 0)], (), "limit-lost"),
        ("Go to 9,9; do not come within 15 of the mark.", [to(9, 9)], (), "limit-lost"),
        ("Go to 9,9; do not come within 25 of it.", [to(9, 9)], (KEPT,), None),
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
        (
            "Go to [9, 9]; I want you done within 20 minutes.",
            [to(9, 9), hold(1200)],
            (),
            "limit-lost",
        ),
        ("Hold here for at most 10 minutes.", [hold(600)], (), None),
        ("Stay away from the wreck at 9,9.", [to(9, 9)], (), "limit-lost"),
        ("Go to 100,20 and 140,60 and 20,90.", [to(100, 20), to(140, 60), to(20, 90)], (), None),
        ("Go to 100,20 and 140,60 and 20,90.", [to(100, 20), to(140, 60)], (), "value-lost"),
        ("Patrol between 9,0 and 9,200.", [to(9, 0)], (), "value-lost"),
        ("Go to 40,0 and 60,40 and 0,60.", [to(40, 0), to(0, 60)], (), "value-lost"),
        ("Go round the mast at 60,60 three times at 20 m.", [orbit(360)], (), "repeat-lost"),
        ("Go round the mast at 60,60 twice at 20 m.", [orbit(720)], (), None),
        ("Go round the mast at 60,60 twice at 20 m.", [orbit(720), orbit(720)], (), "repeat-lost"),
        ("Go round the mast at 60,60 twice at 20 m.", [orbit(360), orbit(360)], (), None),
        (
            "Once round the mast at 60,60 at 20 m, second lap at 25 m.",
            [orbit(360), {**orbit(360), "parameters": {**orbit(360)["parameters"], "radius": 25}}],
            (),
            None,
        ),
        ("Go round the mast at 60,60 twice at 20 m each.", [orbit(720), orbit(720)], (), None),
        ("Find mast and can, round both twice at 20 m.", [orbit(720, OPEN)] * 2, (), None),
        ("Go round the mast at 60,60 three times at 20 m.", [orbit(1080)], (), None),
        ("Circle the mast at 60,60 twice at 20 m.", [orbit(720)], (), None),
        ("Circle the mast at 60,60 at 20 m. Do not circle it twice.", [orbit(360)], (), None),
        ("Run from 1,0 to 9,0 two times.", [to(1, 0), to(9, 0), to(1, 0), to(9, 0)], (), None),
        ("Run from 1,0 to 9,0 two times.", [to(1, 0), to(9, 0), to(1, 0)], (), "repeat-lost"),
        (SHUTTLE, [to(1, 0), to(9, 0), to(1, 0), to(9, 0), to(1, 0)], (), "repeat-lost"),
        (SHUTTLE, [to(1, 0), *[to(9, 0), to(1, 0)] * 3], (), None),
        (ARROWS, [to(1, 0), *[to(9, 0), to(1, 0)] * 2], (), "repeat-lost"),
        (ARROWS, [to(1, 0), *[to(9, 0), to(1, 0)] * 3], (), None),
        ("Go to 9,9, speed not more two meter second.", [to(9, 9)], (), "limit-lost"),
        (NINETY, [to(180, 40), hold(120)], (), None),
        ("2x round the islet at 60,60 at 20 m pls", [orbit(360)], (), "repeat-lost"),
        ("2x round the islet at 60,60 at 20 m pls", [orbit(720)], (), None),
        (CORNERS, [to(180, 40)], (), None),
        (CORNERS, [to(80, 40)], (), "value-lost"),
        ("dock at ten minus five sorry no i mean minus ten five", [to(-10, 5)], (), None),
        ("Be back on the quay at 9,9 by 1430 sharp.", [to(9, 9)], (), "value-lost"),
        (
            "Go to 9,9, report. Forget the survey and the report.",
            [to(9, 9), REPORT],
            (),
            "contradiction",
        ),
        (FOUR_SIDES, [along("north"), along("east")], (), "value-lost"),
        ("Along the north side, no, the east side, 50 m, 5 m off.", [along("east")], (), None),
        (
            "To 9,9, a pier is at one hundred fifty so steer round that.",
            [to(9, 9)],
            (),
            "value-lost",
        ),
        ("Skip the survey and the report, go to 9,9.", [to(9, 9), REPORT], (), "contradiction"),
        ("Circle the mast at 60,60 at 20 m, so 35 m not 20 m.", [orbit(360)], (), "value-lost"),
        (BY_WORDS, [grid(30, 5)], (), "value-lost"),
        (BY_WORDS, [grid(30, 30)], (), None),
        ("Go to [9, 9], but under no circumstances leave the berth.", [to(9, 9)], (), "limit-lost"),
        ("First to ninety zero actually forget ninety zero", [to(90, 0)], (), "contradiction"),
        (
            "Along the south face - sorry, NORTH face - 50 m, 5 m off.",
            [along("south")],
            (),
            "value-lost",
        ),
        ("Along the south face - sorry, NORTH face - 50 m, 5 m off.", [along("north")], (), None),
        (NINETY, [to(80, 40), hold(120)], (), "value-lost"),
        ("Hold at 9,9 with the bow to the south-west.", [to(9, 9), hold(60)], (), "value-lost"),
        ("Head north to 9,9.", [to(9, 9)], (), None),
        ("Hold at 9,9 for 90 s, bow to the east.", [to(9, 9), hold(90)], (), "value-lost"),
        ("End at C, that is 90,10, begin at 20,70.", [to(90, 10), to(20, 70)], (), "contradiction"),
        ("End at C, that is 90,10, begin at 20,70.", [to(20, 70), to(90, 10), to(0, 0)], (), None),
        (SITES, [to(60, 20), hold(60), to(20, 60)], (), None),
        (SITES, [to(20, 60), to(60, 20), hold(60)], (), "contradiction"),
        ("go to forty fifty no forty ninety", [to(40, 90)], (), None),
        ("go to forty fifty no forty ninety", [to(40, 50)], (), "value-lost"),
        (REEF, [to(9, 9), orbit(360)], (OFF_REEF,), None),
        (REEF, [to(9, 9), orbit(360)], (), "limit-lost"),
        ("When that's done come home, first to 9,9.", [to(9, 9), to(0, 0)], (), None),
        ("Map 50 by 50 at 9,9, 40 wide 40 long, 10 m lines.", [grid(50, 50)], (), "value-lost"),
        ("Go to 9,9, a pillar is right at 30,9 so don't hit it.", [to(9, 9)], (), "limit-lost"),
        ("To 9,9, log 211234500 -- typo, it's 211234560.", [to(9, 9)], (), "value-lost"),
        (PILES, [to(9, 0), to(120, -5)], (KEPT,), "repeat-lost limit-lost"),
        ("Not a knot over 3 kn to 9,9.", [to(9, 9)], (), "limit-lost"),
        (
            "Twice up and down between 1,0 and 9,0.",
            [to(1, 0), to(9, 0), to(1, 0)],
            (),
            "repeat-lost",
        ),
        (LOOP, [to(4, 0), to(4, 4), to(0, 4), to(4, 0), to(0, 4)], (), "repeat-lost"),
        ("Out to 9,9 and home, do that twice.", [to(9, 9), to(0, 0)] * 2, (), None),
        ("Out to 9,9 and home, do that twice.", [to(9, 9), to(0, 0)] * 3, (), "repeat-lost"),
        (LOOP, [to(4, 0), to(4, 4), to(0, 4)] * 2, (), None),
        (LOOP, [*[to(4, 0), to(4, 4), to(0, 4)] * 2, to(4, 0)], (), None),
        (LOOP, [to(4, 0), to(4, 4), to(0, 4)] * 3, (), "repeat-lost"),
        (LOOP, [to(4, 0), *[to(4, 4), to(0, 4)] * 2, to(4, 0), to(0, 4)], (), "repeat-lost"),
        (
            "Hold at 1,9, 2,9 and 3,9 for a minute, twice.",
            [*at(1), *at(2), *at(3)],
            (),
            "repeat-lost",
        ),
        ("Hold at 1,9, 2,9 and 3,9 for a minute, twice.", [*at(1), *at(2), *at(3)] * 2, (), None),
        ("Map 50 by 50 m at 9,9, 10 m lines, east-west lines.", [grid(50, 50)], (), "value-lost"),
        ("Map width 18, length 50 at 9,9, 10 m lines.", [grid(50, 50)], (), "value-lost"),
        ("Map 50 by 50 m at 9,9, 10 m tracks north-south.", [grid(50, 50)], (), "value-lost"),
        ("Go to 9,9 and end there, no return.", [to(9, 9), to(0, 0)], (), "contradiction"),
        ("Go to 9,9 and end there, no return.", [to(9, 9)], (), None),
        ("Go to 9,9, do not touch the net there, home.", [to(9, 9), to(0, 0)], (), "limit-lost"),
        ("Map 50 by 50 m at 9,9, 10 m cross lines.", [grid(50, 50)], (), "value-lost"),
        ("Map 50 wide, 80 long at 9,9, lines 10 apart.", [grid(50, 50)], (), "value-lost"),
        ("Map 50 wide, 80 long at 9,9, lines 10 apart.", [grid(50, 80)], (), None),
        ("Look round in 4, no, 14 sectors.", [look(4)], (), "value-lost"),
        ("Hold at 1,9, no. 2 is at 9,9.", [*at(1), to(9, 9)], (), None),
        (
            "Start in the north-east corner and map 50 by 50 m at 9,9.",
            [grid(50, 50)],
            (),
            "value-lost",
        ),
        ("Hold, turn to 225 at 9,9.", [to(9, 9)], (), "value-lost"),
        ("Turn to face 120 at 9,9.", [to(9, 9), look(3)], (), None),
        ("Go to the north-east corner at 9,9.", [to(9, 9)], (), None),
        ("Look round in 6 sectors. Correction: 10 sectors.", [look(6)], (), "value-lost"),
        ("Look round in 6 sectors. Correction: 10 sectors.", [look(10)], (), None),
        ("Look round in 6 sectors. Wait, correction: 10.", [look(6)], (), "value-lost"),
        ("Take a 360° panorama in 6 sectors.", [look(6)], (), None),
        ("Go through 360° at 9,9.", [to(9, 9)], (), "value-lost"),
        (RAMP, [to(9, 9), to(30, 9)], (), "contradiction"),
        ("Hold at 1,9 for 10 min. No, 5. The first was right.", at(1), (), "value-lost"),
        ("Dock at 30,10. I mixed up x and y.", [to(30, 10)], (), "value-lost"),
        ("Circle the mast at 60,60 at 20 m. Double that.", [orbit(360)], (), "value-lost"),
        ("Circle the mast at 60,60. Double that to 20 m.", [orbit(360)], (), None),
        ("Go to 80,45. I meant minus 45.", [to(80, 45)], (), "value-lost"),
        ("Circle 60,60 with a radius of minus 20 m.", [orbit(360)], (), "value-lost"),
        ("Circle 60,60 with a radius of 20 m. Drop the red one.", [orbit(360)], (), None),
        ("Go to 80,45. I meant minus 45.", [to(80, -45)], (), None),
        ("Go to 80,45, then the other one, minus 30.", [to(80, 45)], (), "value-lost"),
        ("Go to 55,70. Wait, minus seventy, I meant.", [to(55, 70)], (), "value-lost"),
        ("Go to 9,9. Ah, belay all that, home.", [to(9, 9), to(0, 0)], (), "contradiction"),
        ("Go to 9,9. Ah, belay all that, 9,9 later.", [to(9, 9), to(0, 0)], (), None),
        ("Map 40 x 40, then 60 x 20 at 9,9.", [grid(40, 20), grid(60, 20)], (), "value-lost"),
        ("Map 40 x 40, then 60 x 20 at 9,9.", [grid(40, 40), grid(60, 20)], (), None),
        ("A tug is at 9,9, keep half a cable off her. Go to 5,5.", [to(5, 5)], (), "value-lost"),
        ("Hold here for half a cable watch.", [hold(60)], (), None),
        ("Go to 70,70 and never leave the berth at 0,0.", [to(70, 70)], (), "limit-lost"),
        ("Go to 9,9. The pen at 50,-50 is 50 m across.", [to(50, -50)], (), "value-lost"),
        ("Hold 20 m off it for a minute.", [hold(60)], ("Go on at 20 m.",), "value-lost"),
        ("Between x 1 y 1 and x 9 y minus thirty four times.", BACKS, (), "repeat-lost"),
        ("Go to x = 45,5 m and y = 80,25 m.", [to(45.5, 80.25)], (), None),
        ("Do not leave the berth. Go to 70,20.", [to(70, 20)], (), "limit-lost"),
        (BERTHS, [grid(40, 20)], (), "repeat-lost"),
        (BERTHS, [grid(40, 20), grid(40, 20)], (), None),
        (
            "Circle it at 15 m and come no nearer than thirty.",
            [orbit(360)],
            (),
            "limit-lost value-lost",
        ),
        ("Take a panorama. No, forget that, go to 9,9.", [look(8), to(9, 9)], (), "contradiction"),
        ("Go to 9,9, not over 3 knots.", [to(9, 9)], (), "limit-lost"),
        ("Go to 9,9. Two kayaks are tied up at 9,50, stay 15 m off.", [to(9, 9)], (KAYAK,), None),
        (
            "Go to 9,9. Two rafts are tied up at 9,50, stay 15 m off.",
            [to(9, 9)],
            (RAFT,),
            "contradiction",
        ),
        ("Go to 9,9 and stay south of the line y = 150.", [to(9, 9)], (), "value-lost"),
        (
            "A tug at 1,9 is towing a barge at 9,9, do not pass between them.",
            [to(5, 50)],
            (),
            "limit-lost",
        ),
        ("Film the pier at 9,9 with the port camera.", [to(9, 9)], (), "value-lost"),
        ("Film the pier at 9,9 with the camera.", [to(9, 9)], (), None),
        (RAMP, [to(9, 9)], (), None),
        ("Go to 9,9, the quay faces north.", [to(9, 9)], (), None),
        ("Go 100 m on bearing 090.", [to(100, 0)], (), None),
        ("Go 100 m on bearing 045.", [to(100, 0)], (), "value-lost"),
        ("Go to 5,5. Drift, hang on, skip that.", [to(5, 5), drift()], (), "contradiction"),
        ("No drift. Go to 5,5.", [to(5, 5), drift()], (), "contradiction"),
        ("Go to 9,9. A rig stands at 60,0.", [to(9, 9)], (), None),
        ("Go to 9,9. A rig stands at 60,0 for inspection.", [to(9, 9)], (), "value-lost"),
        ("Take a ten-shot panorama.", [look(8)], (), "value-lost"),
        ("Take a panorama in 8 frames.", [look(8)], (), None),
        ("From 0,9 to 20,9, stop every 10 m.", [*at(0), *at(20)], (), "value-lost"),
        ("From 0,9 to 20,9, stop every 10 m.", [*at(0), *at(10), *at(20)], (), None),
        ("Map 50 by 50 m at 9,9 with a line every 10 m.", [grid(50, 50)], (), None),
        ("Go round the mast at 60,60 until told to stop.", [orbit(360)], (), "repeat-lost"),
        ("Go round the mast at 60,60 without stopping.", [orbit(360)], (), "repeat-lost"),
        ("Hold at 9,9 until told to stop.", [to(9, 9), hold(60)], (), None),
        (
            "Drift at 5,5, but do not leave your present place.",
            [to(5, 5)],
            (),
            "contradiction limit-lost",
        ),
        ("Stay tied up.", [to(0, 0)], (), None),
        ("Start with a drift. Scratch that, go to 9,9.", [drift(), to(9, 9)], (), "contradiction"),
        ("Go to the gauge at 9,60, it runs hot.", [to(9, 60)], (), None),
        ("Nothing north of y = 50 is allowed. Go to 9,80.", [to(9, 80)], (), "limit-lost"),
        ("Hold at 1,9 and 2,9 and report.", [*at(1), *at(2), REPORT], (), None),
        ("Hold at 1,9 and report after each one.", [*at(1), REPORT], (), None),
        (
            "Hold at 1,9 and 2,9 and report after each one.",
            [*at(1), REPORT, *at(2), REPORT],
            (),
            None,
        ),
        ("Go to 1,5 and be home by 15:00.", [to(1, 5), to(0, 0)], (), "limit-lost"),
        ("Go home by way of 9,9.", [to(9, 9), to(0, 0)], (), None),
        ("Go to 9,9, do not go near the pontoon at 70,20.", [to(9, 9)], (), "limit-lost"),
        ("Go to 9,9 and don't go inside of the nets.", [to(9, 9)], (), "limit-lost"),
        (
            "Our boom lies from 4,0 to 4,9, you must not cross it. Go to 9,9.",
            [to(9, 9)],
            (),
            "limit-lost",
        ),
        (
            "My net drifts about. The boat must not touch it. Go to 9,9.",
            [to(9, 9)],
            (),
            "limit-lost",
        ),
        ("Go to 9,9, keep clear of the nets.", [to(9, 9)], ("Keep clear of the nets.",), None),
        ("Hold at 9,9, 50 s, don't come within 50 m.", [to(9, 9), hold(50)], (), "limit-lost"),
        ("Circle the mast at 60,60, radius 15.", [orbit(360)], (), "value-lost"),
        ("Map 50 by 50 m at 9,9, 10 m lines.", [grid(50, 10)], (), "value-lost"),
        ("Map 50*50 m at 9,9, 10 m lines.", [grid(50, 50)], (), None),
        ("Map 50x20 m at 9,9, no, 20 by 50 m, 10 m lines.", [grid(20, 50)], (), None),
        ("Circle the mast at 60,60, radius 20.", [orbit(360)], (), None),
        ("Circle it at 20 m. Actually 5 is enough.", [orbit(360)], (), "value-lost"),
        (
            "Circle it at 20 m, no, her anchors are out, better make it 50.",
            [orbit(360)],
            (),
            "value-lost",
        ),
        ("Circle it at 9 m, then home. Actually 20 will do.", [orbit(360), to(0, 0)], (), None),
        ("Circle it at 9 m, then home.", [orbit(360), to(0, 0)], (), "value-lost"),
        ("Drift at 5,5. No drift after all.", [to(5, 5), drift()], (), "contradiction"),
        ("Drift at 5,5, hang on, skip that, just go.", [to(5, 5), drift()], (), "contradiction"),
        ("Before you leave drift at 5,5.", [to(5, 5), drift()], (), None),
        ("Go to 55;40.", [to(5, 5)], (), "value-lost"),
        ("Go to 55;40.", [to(55, 40)], (), None),
        ("Drift at 5,5, ah, belay all that.", [to(5, 5), drift()], (), "contradiction"),
        ("Drift at 5,5. There is a rope: leave it.", [to(5, 5), drift()], (), None),
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
        ("Hold at [9, 9]. Er, [5, 5], not [9, 9].", [to(5, 5), hold(60)], (), None),
        ("Hold at [9, 9]. Not at [9, 9].", [to(9, 9), hold(60)], (), "contradiction"),
        ("Do not stop at 9,9, and come home.", [to(0, 0)], (), None),
    ],
)
def test_what_is_lost_is_told(
    command: str, tasks: list[dict[str, Any]], limits: tuple[str, ...], lost: str | None
) -> None:
    assert kinds(command, *tasks, limits=limits) == set((lost or "").split())


@pytest.mark.parametrize(
    ("prompt", "made"),
    [
        ("Inspect reliping at [9, 9].", ["reliping"]),
        ("Inspect the Durius at [9, 9].", []),
        ("Inspect the dorios.", []),
        ("Inspect the dorioz.", ["dorioz"]),
        ("Inspect the buoy.", []),
    ],
)
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


def lost(command: str, *tasks: dict[str, Any], limits: tuple[str, ...] = ()) -> list[str]:
    """The words that are lost, each with its kind."""
    plan = document([*tasks], command=command, constraints=limits)
    wanted = ("limit-lost", "value-lost", "repeat-lost", "contradiction")
    return [one["id"] for one in plan["warnings"] if one["kind"] in wanted]


HELD = [to(9, 9), hold(600)]
ROUND = "Go round the mast at 60,60 {} at 20 m."


@pytest.mark.parametrize(
    ("command", "tasks", "words"),
    [
        ("Hold 20 minutes, no, ten minutes at 9,9.", HELD, []),
        ("Hold 20 minutes, make that ten minutes at 9,9.", HELD, []),
        ("Hold 20 minutes at 9,9, oh well, now it is, no, ten minutes.", HELD, ["20 minutes"]),
        ("Hold 20 minutes, well, now make that ten minutes at 9,9.", HELD, []),
        ("Hold one hour and 20 minutes at 9,9.", [to(9, 9), hold(4800)], []),
        ("Hold one hour and 20 minutes at 9,9.", HELD, ["one hour and 20 minutes"]),
        ("Hold a second at 9,9, since 14 o'clock, at 50 % of the power.", HELD, []),
        ("Hold at 9,9 on course 95, bearing: 270.", HELD, ["95", "270"]),
        ("Hold at 9,9 on a course of 95 degrees.", HELD, ["95 degrees"]),
        ("Circle it at 9 m. Actually 20 will do. Hold 5 m.", [orbit(360)], ["5 m"]),
        (
            "Hold 5 m. Circle it at 9 m, come home by the north side. Actually 20 will do.",
            [orbit(360), to(0, 0)],
            ["5 m"],
        ),
        ("Circle it on heading 095 at 22 m, I meant to say 360.", [orbit(360)], []),
        ("Circle it at 20 m, I meant to say 360.", [orbit(360)], []),
        (
            "Circle it at 9 m, come home by the north side. Actually 360 degrees will do.",
            [orbit(360), to(0, 0)],
            ["9 m"],
        ),
        ("Hold 9 minutes at 9,9, then home. Actually 10 will do.", [*HELD, to(0, 0)], []),
        ("Hold 9 minutes at 9,9, then home. Actually 600 will do.", [*HELD, to(0, 0)], []),
        (
            "Hold 8 s at 9,9, then home. Actually 2 will do.",
            [to(9, 9), hold(7200), to(0, 0)],
            ["2"],
        ),
        (
            "Hold 8 s at 9,9, come home by the north side. Actually 10 s will do.",
            [*HELD, to(0, 0)],
            ["8 s", "10 s"],
        ),
        (
            "Hold 8 s at 9,9, come home by the north side. Actually 10 s will do.",
            [to(9, 9), hold(10), to(0, 0)],
            [],
        ),
        ("Circle the mast at 60,60, radius: 15.", [orbit(360)], ["15"]),
        ("Circle the mast at 60,60, the radius of 15.", [orbit(360)], ["15"]),
        ("Circle the mast at 60,60, no radius 15.", [orbit(360)], []),
        ("Circle the mast at 60,60, with 15 cameras.", [orbit(360)], []),
        ("Out to 9,9, give it two.", [to(9, 9)], ["two"]),
        ("Out to 9,9, give it one.", [to(9, 9)], []),
        ("Map 20x20x5 at 9,9.", [grid(20, 20)], ["5"]),
        ("Map 20 x 20 x 10 at 9,9.", [grid(20, 20)], []),
        (ROUND.format("three full revolutions"), [orbit(360)], ["three full revolutions"]),
        (ROUND.format("three full times"), [orbit(360)], ["three full times"]),
        (ROUND.format("three really full times"), [orbit(360)], []),
        (ROUND.format("two times"), [orbit(360)], ["two times"]),
        (ROUND.format("two times"), [orbit(-720)], []),
        (ROUND.format("one time"), [orbit(180)], []),
        (ROUND.format("3 m passes"), [orbit(360)], ["3 m"]),
        (ROUND.format("thrice"), [orbit(720)], ["thrice"]),
        (ROUND.format("thrice"), [orbit(1080)], []),
        ("Hold twice at 9,9.", HELD, ["twice"]),
        ("Hold twice at 9,9.", [*HELD, hold(60), hold(60)], ["twice"]),
        ("Hold at 9,9 twice.", [*HELD, to(9, 9)], []),
        ("Hold at 9,9 from 11:10 to 11:30.", HELD, ["11:10", "11:30"]),
        ("Hold at 9,9 until 11:30, not 12:30.", HELD, ["11:30"]),
        ("Hold at 9,9 until 11:30.", [to(9, 9), hold(60) | {"task_prompt": "Until 11:30."}], []),
        ("Go to 9,9. Hold a minute at 1,9 and 2,9.", [to(9, 9), *at(1), to(2, 9)], []),
        ("Go to 1,9, then 5,5.", [to(1, 9)], ["5,5"]),
        ("Do not go to [9, 9], go to [9, 9] at last.", [to(9, 9)], ["9,9"]),
        ("Go to [9, 9]. Do not go to [9, 8].", [to(9, 9)], []),
        ("Go to [9, 9]. Do not go to [8, 9].", [to(9, 9)], []),
        ("Go to [9, 9], hold ten minutes at [9, 9].", HELD, []),
        ("Go to 40,0 and 60,40 and 0,60.", [to(40, 0), to(0, 60)], ["40,0 and 60,40 and 0,60"]),
        ("Never leave 0,0 90,0 90,90 0,90.", [to(9, 9)], ["0,0 90,0 90,90 0,90"]),
        (
            "Never leave 0,0, then 90,0 and 0,90.",
            [to(90, 0), to(0, 90), to(0, 0)],
            ["0,0, then 90,0 and 0,90"],
        ),
    ],
)
def test_the_words_that_are_lost_and_no_others(
    command: str, tasks: list[dict[str, Any]], words: list[str]
) -> None:
    found = [one.split(":", 1)[1] for one in lost(command, *tasks)]
    assert [one for one in found if "mast" not in one] == words


BY = "The vehicle is back by 16:30."
SLOW = "The vehicle goes no faster than {} m/s."
NEAR = "The vehicle stays at least 70 m from the wreck at [40, 9]."


@pytest.mark.parametrize(
    ("command", "limits", "words"),
    [
        ("Go to [9, 9]. Do not exceed 2 m/s.", (SLOW.format(2),), []),
        ("Go to [9, 9]. Do not exceed 2 m/s.", (SLOW.format(3),), ["do not exceed 2 m/s"]),
        ("Go to [9, 9]. Do not exceed 2 m/s.", (), ["do not exceed 2 m/s"]),
        ("Do not exceed 2 m/s, go to [9, 9].", (), ["do not exceed 2 m/s"]),
        ("Go to [9, 9]. Speed limit 9.", (), []),
        ("Go to [9, 9]. Speed limit 9 m/s.", (), ["speed limit 9 m/s"]),
        ("Go to [9, 9]. Be back by 16:30.", (BY,), []),
        ("Go to [9, 9]. Be back by 16:30.", (SLOW.format(2),), ["be back by 16:30"]),
        ("Be back by 16:30, go to [9, 9].", (), ["be back by 16:30"]),
        ("Go to [9, 9]. Be back by 9 pm.", (SLOW.format(2),), ["be back by 9 pm"]),
        ("Go to [9, 9]. Stay away from the wreck at 40,9.", (NEAR,), []),
        (
            "Go to [9, 9]. Stay away from the wreck at 40,8.",
            (NEAR,),
            ["stay away from the wreck at 40,8"],
        ),
        ("Go to [9, 9]. Stay away from the wreck at x=40 y=9.", (NEAR,), []),
        ("Go to [9, 9]. Stay away from the wrecks.", (NEAR,), []),
        ("Go to [9, 9]. Stay away from the pontoons.", (NEAR,), ["stay away from the pontoons"]),
        ("Go to [9, 9]. Do not go beyond x = 9.", (), ["do not go beyond x = 9"]),
        ("Go to [9, 9]. Do not go beyond x = 120.", (), ["do not go beyond x = 120"]),
        ("Go to [9, 9]. Do not go beyond boat 120.", (), []),
    ],
)
def test_a_limit_is_kept_by_a_limit_or_a_value_and_else_lost(
    command: str, limits: tuple[str, ...], words: list[str]
) -> None:
    found = [one for one in lost(command, to(9, 9), limits=limits) if one.startswith("limit-lost")]
    assert [one.split(":", 1)[1] for one in found] == words


def test_a_row_is_done_everywhere_or_told() -> None:
    row = "Hold a minute at 1,9, 2,9 and 3,9."
    assert lost(row, *at(1), to(2, 9), to(3, 9)) == []
    assert lost(row, *at(1), *at(2), to(3, 9)) == ["value-lost:[3, 9]"]
    assert lost(row, to(1, 9), *at(2), *at(3)) == ["value-lost:[1, 9]"]
    look = task("FeatureStare", {"target_feature": "board"}, [step("VisualStationKeep")])
    assert lost(row, *at(1), to(2, 9), look, to(3, 9)) == []


AREA = {"center": [70, 50], "width": 100, "length": 60, "spacing": 10}


@pytest.mark.parametrize(
    ("command", "planned", "lost"),
    [
        ("Depth grid from [20, 20] to [120, 80], lines 10 m apart.", AREA, []),
        (
            "Depth grid from [20, 20] to [120, 80], lines 10 m apart.",
            AREA | {"width": 90},
            ["20", "120"],
        ),
    ],
)
def test_corners_of_the_area_that_is_planned_are_not_lost(
    command: str, planned: dict[str, Any], lost: list[str]
) -> None:
    grid = task("BathymetryGridSurvey", planned, [], "Go on.")
    plan = document([grid], command=command)
    said = [one["text"] for one in plan["warnings"] if one["kind"] == "value-lost"]
    assert len(said) == len(lost)
    assert all(any(f'"{words}' in text for text in said) for words in lost)


@pytest.mark.parametrize(
    ("command", "tasks", "count"),
    [
        ("Go to [9, 9] and sweep the boat landing.", [SWEEP, SWEEP], 1),
        ("Go to [9, 9] and sweep the boat landing.", [SWEEP], 0),
        ("Go to [9, 9] and sweep the boat landing, and again.", [SWEEP, SWEEP], 0),
    ],
)
def test_a_task_that_is_done_again_at_once_is_told(
    command: str, tasks: list[dict[str, Any]], count: int
) -> None:
    plan = document([to(9, 9), *tasks], command=command)
    assert [one["id"] for one in plan["warnings"]].count("value-not-said:t3:asked") == count


@pytest.mark.parametrize(
    ("command", "prompts", "count"),
    [
        ("Survey the mast at [60, 60]. We lost it twice.", ("Do it.", "Do it."), 1),
        ("Survey the mast at [60, 60]. Come back home.", ("Do it.", "Do it."), 1),
        ("Survey the mast at [60, 60]. Come back home.", ("North.", "South."), 0),
        ("Survey the mast at [60, 60] twice.", ("Do it.", "Do it."), 0),
        ("Survey the mast at [60, 60], then survey the mast back then.", ("Do it.", "Do it."), 0),
    ],
)
def test_words_for_doing_again_count_where_the_task_is_asked_for(
    command: str, prompts: tuple[str, str], count: int
) -> None:
    values = {"target_position": [60, 60], "radius": 9}
    plan = document([task("SurveyTarget", values, [], one) for one in prompts], command=command)
    assert [one["id"] for one in plan["warnings"]].count("value-not-said:t2:asked") == count


@pytest.mark.parametrize(
    ("command", "lost"),
    [
        ("Deliver 6 oxygen bottles to [20, 30].", ["6"]),
        ("Deliver six oxygen bottles to [20, 30].", ["six"]),
        ("Go to [20, 30] and count the 4 buoys.", ["4"]),
        ("Take a dozen bottles to [20, 30], not 6 crates.", ["a dozen"]),
        ("Go to buoy 6 at [20, 30].", []),
        ("0930 diagnostics, go to [20, 30], home by fourteen thirty.", []),
        ("Do two things: go to [20, 30] and look at the 2 cranes at [40, 50].", []),
        ("Look at the [20, 30] bottles.", []),
    ],
)
def test_a_number_of_things_that_nothing_in_the_plan_has_is_lost(
    command: str, lost: list[str]
) -> None:
    places = [to(20, 30)] + ([to(40, 50)] if "40" in command else [])
    found = document(places, command=command)["warnings"]
    told = [one for one in found if one["kind"] == "value-lost"]
    assert [one["text"].split('"')[1] for one in told] == lost


def test_a_number_of_things_that_the_plan_speaks_of_is_kept() -> None:
    prompt = "Deliver 6 oxygen bottles at [20, 30]."
    go = task("Transit", {"target_position": [20, 30]}, None, prompt)
    assert kinds("Deliver 6 oxygen bottles to [20, 30].", go) == set()


@pytest.mark.parametrize(
    ("said", "bounds"), [("20000 m", True), ("20 km", True), ("9 km", False), ("20 km/h", False)]
)
def test_a_value_beyond_its_bounds_is_told_with_them(said: str, bounds: bool) -> None:
    circle = task("PerformOrbit", {"center": [60, 40], "radius": 10}, None)
    plan = document([circle], command=f"Circle the mast at [60,40] at {said}.")
    found = [one["text"] for one in plan["warnings"] if one["kind"] == "value-lost"]
    assert ["radius is 0 to 10000 m." in one for one in found] == [bounds]
