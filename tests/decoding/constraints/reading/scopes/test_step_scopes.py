"""In which steps filters and perception skills run, told against the row of the text's
movements.
"""

from __future__ import annotations

import time

import pytest

from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.reading.rows.movement_rows import plain
from planner_ft.decoding.constraints.reading.rows.told_movements import row_of
from planner_ft.decoding.constraints.reading.scopes.step_scopes import read_step_scopes
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
NAMES = [
    skill.name for role in ("filter", "perception") for skill in VOCABULARY.skills_in_role(role)
]
GO, HOLD, FACE, NUDGE, ARC = "GoToXY", "StationKeep", "RotateToHeading", "NudgeYaw", "ArcTurn"
DRIFT, VISUAL, WAIT = "DriftWithCurrent", "VisualStationKeep", "WaitForStability"


def verdicts(text: str, skill: str, navigation: list[str]) -> str:
    """What is read for each step of a plan: + runs, - does not, ? not known."""
    scope = read_step_scopes(text, NAMES, VOCABULARY).scopes.get(skill)
    return "".join(
        {True: "+", False: "-", None: "?"}[scope.allows(navigation[: index + 1]) if scope else None]
        for index in range(len(navigation))
    )


@pytest.mark.parametrize(
    ("text", "skill", "navigation", "steps"),
    [
        (
            "To [5, 9], to [5, 40], to [30, 40]. The second leg skirts rocks: on it, and on no other, 7 m of clearance.",
            "ObstacleAvoidance",
            [GO] * 3,
            "-+-",
        ),
        (
            "The outer leg to [50, 8] is open. On the inner leg, to [9, 8], have the bow locked and the depth logged.",
            "LockHeading",
            [GO, GO],
            "-+",
        ),
        (
            "The outer leg to [50, 8] is open. On the inner leg, to [9, 8], have the bow locked and the depth logged.",
            "GetSeabedDepth",
            [GO, GO],
            "-+",
        ),
        (
            "Steam to [0, 30], then drift for 20 minutes. As long as she drifts log the environment.",
            "LogEnvironmentState",
            [GO, DRIFT],
            "-+",
        ),
        (
            "Steam to [0, 30], then drift for 20 minutes. While adrift film with the mast camera; no filming under way.",
            "SetStreamRecording",
            [GO, DRIFT],
            "-+",
        ),
        (
            "Visit [4, 4], [4, 20] and [18, 20]. At the second of these take a GPS fix.",
            "GetGPSLocation",
            [GO] * 3,
            "-+-",
        ),
        ("wp1 [3, 3] wp2 [3, 9]. gps fix @ wp2 only.", "GetGPSLocation", [GO, GO], "-+"),
        (
            "Go to [9, 9] with 12 m of clearance. There hold for a minute; the clearance no longer matters then.",
            "ObstacleAvoidance",
            [GO, HOLD],
            "+-",
        ),
        (
            "A buoy lies near the start [2, 7], so 9 m margin getting there. Then follow the cable for 60 m.",
            "ObstacleAvoidance",
            [GO, GO],
            "+-",
        ),
        (
            "Legs to [1, 0], [1, 9] and [8, 9]. Five metres of clearance on all legs but the last.",
            "ObstacleAvoidance",
            [GO] * 3,
            "++-",
        ),
        (
            "Go to [6, 6]. Keep buoy 3 in the picture there, and from that moment on track buoy 3.",
            "TrackObjects",
            [GO, VISUAL],
            "-+",
        ),
        (
            "Stop at [8, 1]; turn to 120; turn to 200. Both turns get a GPS fix, the second one a map marker too.",
            "GetGPSLocation",
            [GO, FACE, FACE],
            "-++",
        ),
        (
            "Stop at [8, 1]; turn to 120; turn to 200. Both turns get a GPS fix, the second one a map marker too.",
            "CreateMapMarker",
            [GO, FACE, FACE],
            "--+",
        ),
        (
            "Hold 30 s and take a fix meanwhile, pan 40 degrees to port, hold a minute and take a fix in it.",
            "GetGPSLocation",
            [HOLD, NUDGE, HOLD],
            "+-+",
        ),
        (
            "Go to [6, 6] and make a sweeping turn, 90 degrees to port at 12 m. For the turn, additionally, film.",
            "SetStreamRecording",
            [GO, ARC],
            "-+",
        ),
        (
            "Go to [7, 7], run to [9, 30] recording the bow camera, then hold, and in the hold drop a pin.",
            "SetStreamRecording",
            [GO, GO, HOLD],
            "-+-",
        ),
        (
            "First watch: hold 5 min and detect swimmers. Then shift to [5, 5]. Second watch: hold 5 min. No detector under way.",
            "DetectObjects",
            [HOLD, GO, HOLD],
            "+--",
        ),
        (
            "Go to [3, 3], turn to 90, hold a minute. Soundings once the turn is over.",
            "GetSeabedDepth",
            [GO, FACE, HOLD],
            "--+",
        ),
        (
            "Go to [3, 3], turn to 90, hold a minute. Soundings in the last two steps.",
            "GetSeabedDepth",
            [GO, FACE, HOLD],
            "-++",
        ),
        (
            "Drive to [1, 2], [5, 2] and [5, 9] while filming with the bow camera, then hold.",
            "SetStreamRecording",
            [GO, GO, GO, HOLD],
            "+++-",
        ),
        (
            "Go to [3, 3], turn to 120, shift to [3, 9]. A margin of 5 m holds for both moves; the turn has none.",
            "ObstacleAvoidance",
            [GO, FACE, GO],
            "+-+",
        ),
        (
            "Face south, face west, face north, in that order, with the object detector on boats.",
            "DetectObjects",
            [FACE] * 3,
            "+++",
        ),
        (
            "Go to [3, 3] and turn to 040, to 080 and to 120. Each of the three turns gets a logged lidar slice.",
            "LogLidarSlice",
            [GO, FACE, FACE, FACE],
            "-+++",
        ),
        (
            "Face south, then west, then north. Geotagged stills on the first and the last bearing.",
            "CaptureGeoSnapshot",
            [FACE] * 3,
            "+-+",
        ),
        (
            "Go [9, 0], [9, 40], [30, 40]. Middle leg passes the moorings: obstacle clearance 20 metres there. First leg, nothing.",
            "ObstacleAvoidance",
            [GO] * 3,
            "-+-",
        ),
        (
            "Go [9, 0], [9, 40], [30, 40]. Final leg with the bow locked. First leg, nothing.",
            "LockHeading",
            [GO] * 3,
            "--+",
        ),
        (
            "Go out to the raft at [60, 5], stay there five minutes, then come back as far as [9, 9]. Take a GPS fix only on the way back.",
            "GetGPSLocation",
            [GO, HOLD, GO],
            "--+",
        ),
        (
            "As far as [20, 0] you need no special care. From there to the nets at [60, 5] keep six metres of clearance.",
            "ObstacleAvoidance",
            [GO, GO],
            "-+",
        ),
        (
            "Enter via [9, 0], go on to [9, 30], and hold there a minute. Once you have reached [9, 0], and for all the rest, take GPS fixes.",
            "GetGPSLocation",
            [GO, GO, HOLD],
            "-++",
        ),
        (
            "Hold a minute with the object detector on rafts. Then turn to 75. Then a second hold, with a GPS fix in place of the detector.",
            "DetectObjects",
            [HOLD, FACE, HOLD],
            "+--",
        ),
        (
            "Drive to [5, 2], there wait until the rolling has settled, with the bow locked as long as you wait. Next keep the fender centred.",
            "LockHeading",
            [GO, WAIT, VISUAL],
            "-+-",
        ),
        (
            "Go to [5, 2], turn to 30 and keep the anode in the picture. Pixel offset to the anode during the last of these three only.",
            "CalculateVisualOffset",
            [GO, FACE, VISUAL],
            "--+",
        ),
        (
            "Hold two minutes and record nothing while you do. Afterwards face south, and for that turn record the bow camera.",
            "SetStreamRecording",
            [HOLD, FACE],
            "-+",
        ),
        (
            "From [5, 5], where you are, 60 m on bearing 000; with that leg done, go to [9, 90], bow locked for that leg alone.",
            "LockHeading",
            [GO, GO],
            "??",
        ),
        (
            "Hold a minute, turn to 90 and keep the anode in the picture. Take a GPS fix in every hold.",
            "GetGPSLocation",
            [HOLD, FACE, VISUAL],
            "???",
        ),
    ],
)
def test_scopes_of_many_wordings(text: str, skill: str, navigation: list[str], steps: str) -> None:
    assert verdicts(text, skill, navigation) == steps


@pytest.mark.parametrize(
    ("text", "steps"),
    [
        (
            (
                "Square survey of the pile at the target, clockwise from the middle of the north"
                " side. Corners: geotagged still. Mid-sides: GPS fix."
            ),
            "-+-+",
        ),
        (
            (
                "Survey square round the target. Geotagged stills at the corners only, none at the"
                " mid-sides."
            ),
            "-+-+",
        ),
        (
            (
                "Survey square round the target, starting at the north-west corner. Geotagged"
                " stills at the mid-sides only."
            ),
            "-+-+",
        ),
    ],
)
def test_corners_and_mid_sides_are_every_other_waypoint(text: str, steps: str) -> None:
    assert verdicts(text, "CaptureGeoSnapshot", [GO] * 4) == steps


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Go to [4, 4], then hold a minute, bow not locked.", "LockHeading"),
        (
            "Don't record anything, the disk is full. Go to [4, 4], then hold a minute.",
            "SetStreamRecording",
        ),
        ("Go to [4, 4], then hold a minute. No stills either.", "CaptureGeoSnapshot"),
    ],
)
def test_what_is_denied_runs_nowhere(text: str, skill: str) -> None:
    assert verdicts(text, skill, [GO, HOLD]) == "--"


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Go to [4, 4], then hold a minute. Don't forget to take a GPS fix.", "GetGPSLocation"),
        (
            "Go to [4, 4], then hold a minute. Never go within 3 m of other boats.",
            "ObstacleAvoidance",
        ),
        (
            "Go to [4, 4], then hold a minute. Never leave the box (0, 0), (9, 0), (9, 9), (0, 9).",
            "BoundaryEnforcement",
        ),
        ("Go to [4, 4], then hold a minute. Depth already on the leg.", "GetSeabedDepth"),
        (
            "Before you hold a minute, go to [4, 4]. In the second part take a GPS fix.",
            "GetGPSLocation",
        ),
        (
            (
                "Go to [4, 4], then to [9, 9], then hold. A fix on the first leg, and on the second"
                " leg as well."
            ),
            "GetGPSLocation",
        ),
    ],
)
def test_what_is_in_doubt_is_not_ruled_out(text: str, skill: str) -> None:
    assert "-" not in verdicts(text, skill, [GO, HOLD])


@pytest.mark.parametrize(
    ("text", "skill", "navigation", "steps"),
    [
        (
            "Proceed to [8, 3], then hold for the duration. Lidar slice only in the hold, a GPS fix both on the way and during the hold.",
            "GetGPSLocation",
            [GO, HOLD],
            "++",
        ),
        (
            "Proceed to [8, 3], then hold for the duration. Lidar slice only in the hold, a GPS fix both on the way and during the hold.",
            "LogLidarSlice",
            [GO, HOLD],
            "-+",
        ),
        (
            "Settle until she lies still, go to [6, 6], keep the hatch centred. Except during the wait, keep a margin of 4 m.",
            "ObstacleAvoidance",
            [WAIT, GO, VISUAL],
            "-++",
        ),
        (
            "Go to [6, 6], turn to 80 and hold a minute. Log the environment, except while turning.",
            "LogEnvironmentState",
            [GO, FACE, HOLD],
            "+-+",
        ),
        (
            "Go to [6, 6], turn to 80 and hold a minute. Take a GPS fix in every step, except during the hold.",
            "GetGPSLocation",
            [GO, FACE, HOLD],
            "++-",
        ),
        (
            "Follow the pipeline through [5, 5], [9, 9] and [30, 30]. Seabed depth on the way to the first two points; at the third no depth, drop a pin instead.",
            "GetSeabedDepth",
            [GO] * 3,
            "++-",
        ),
        (
            "Follow the pipeline through [5, 5], [9, 9] and [30, 30]. Seabed depth on the way to the first two points; at the third no depth, drop a pin instead.",
            "CreateMapMarker",
            [GO] * 3,
            "--+",
        ),
        (
            "Barges ahead: keep a 9 m margin as far as [40, 2]. From there on to the goal position the margin is not needed.",
            "ObstacleAvoidance",
            [GO, GO],
            "+-",
        ),
        (
            "Zigzag up the channel through [0, 9], [9, 20] and [0, 30] in that order, recording the bow camera for weed and wrack all the way.",
            "SetStreamRecording",
            [GO] * 3,
            "+++",
        ),
        (
            "Go to [3, 1], then turn to 210. Read the text on the sign once you're turning.",
            "OCRScanning",
            [GO, FACE],
            "-+",
        ),
        ("Turn to 10, 50 and 90. Take a GPS fix on each.", "GetGPSLocation", [FACE] * 3, "+++"),
        (
            "Go to [4, 4], hold a minute, go to [9, 4], hold a minute. A GPS fix in the first hold; in the second read the seabed depth.",
            "GetSeabedDepth",
            [GO, HOLD, GO, HOLD],
            "---+",
        ),
        (
            "Call at [1, 1], [4, 4] and [9, 9]. Seabed depth at the first two points, at the last drop a pin.",
            "CreateMapMarker",
            [GO] * 3,
            "--+",
        ),
        (
            "Run up to [1, 9] with 9 m clearance, and on the final run to the goal position log the environment.",
            "LogEnvironmentState",
            [GO, GO],
            "-+",
        ),
        (
            "Two drifts, one at [0, 5], the other at [9, 5]. The box [-9, -9], [20, -9], [20, 20], [-9, 20] holds for the drifts, not for the runs between.",
            "BoundaryEnforcement",
            [GO, DRIFT, GO, DRIFT],
            "-+-+",
        ),
    ],
)
def test_several_scopes_of_one_text(
    text: str, skill: str, navigation: list[str], steps: str
) -> None:
    assert verdicts(text, skill, navigation) == steps


@pytest.mark.parametrize(
    ("text", "skill", "navigation", "steps"),
    [
        (
            "nudge 8 deg port then keep red buoy centred then hold 2 min no recording 5 m clearance all the time tnx",
            "ObstacleAvoidance",
            [NUDGE, VISUAL, HOLD],
            "+++",
        ),
        (
            "Go to [5, 1], then hold for the duration with the bow locked.",
            "LockHeading",
            [GO, HOLD],
            "-+",
        ),
        ("Hold for ten minutes and don't let the bow swing.", "LockHeading", [HOLD], "?"),
        ("Go to [5, 1]. Pin the bow to its present heading.", "LockHeading", [GO], "?"),
        (
            "Three stops of 90 seconds, at [5, 1], [9, 1] and [9, 9]. Log the environment in all of them except the last.",
            "LogEnvironmentState",
            [GO, HOLD, GO, HOLD],
            "????",
        ),
    ],
)
def test_what_all_readers_make_of_it(
    text: str, skill: str, navigation: list[str], steps: str
) -> None:
    companions = read_companions({"prompt": text}, VOCABULARY)
    assert skill in (companions.spoken or ())
    found = [
        companions.runs(skill, name, navigation[:index]) for index, name in enumerate(navigation)
    ]
    assert "".join({True: "+", False: "-", None: "?"}[verdict] for verdict in found) == steps


def test_values_that_differ_between_steps() -> None:
    text = (
        "Leave 9 m clearance while coming in to [5, -2], and only 3 m for what follows: turn to"
        " 100, hold two minutes."
    )
    companions = read_companions({"prompt": text}, VOCABULARY)
    plan = [GO, FACE, HOLD]
    assert [
        companions.value("ObstacleAvoidance", name, plan[:index]) for index, name in enumerate(plan)
    ] == [9, 3, 3]
    assert companions.value("LockHeading", GO, []) is None
    same = read_companions(
        {"prompt": "Leave 9 m clearance while coming in to [5, -2], then hold."}, VOCABULARY
    )
    assert same.value("ObstacleAvoidance", GO, []) is None


def test_the_row_of_movements() -> None:
    row = row_of(
        plain(
            "Go to [1, 2], [3, 4] and [5, 6], follow the cable due north for 80 m, then hold two"
            " minutes."
        ),
        (),
    )
    assert [unit.kind for unit in row.units] == [GO, GO, GO, GO, HOLD]
    assert [unit.steps for unit in row.units] == [1, 1, 1, None, 1]
    assert [row.unit([GO] * count) for count in (1, 2, 3, 4, 5)] == [0, 1, 2, 3, 3]
    assert row.unit([GO, GO, GO, GO, GO, HOLD]) == 4
    # A plan that goes another way is not told by it.
    assert row.unit([HOLD]) is None


def test_long_texts_are_read_at_once() -> None:
    text = (
        "Go to [10, 20] and on the second leg, not before, keep 5 m off everything and hold while"
        " she turns and drifts, in the hold only, " * 8
    )
    begun = time.perf_counter()
    read_step_scopes(text[:1000], NAMES, VOCABULARY)
    assert time.perf_counter() - begun < 1
