"""Which filter and perception skills the words of a task input can ask for, and which they ask for
beyond doubt.
"""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.skills.evidence import required, spoken_of
from planner_ft.decoding.constraints.reading.telegrams import in_small_letters
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


def expected_skills(record: dict[str, Any]) -> set[str]:
    """The filter and perception skills of a record's plan."""
    steps = record["expected"]["skill_sequence"]
    return {
        skill["name"]
        for step in steps
        for key in ("filter_skills", "perception_skills")
        for skill in step[key]
    }


@pytest.mark.parametrize(
    ("text", "skills"),
    [
        ("LIDAR PROFILE STOP", {"LogLidarSlice"}),
        (
            "Proceed to the target position, wait until she is steady, then turn to due south.",
            set(),
        ),
        ("Hold for ninety seconds within 5 m.", set()),
        ("pos fix and env log every stop pls", {"GetGPSLocation", "LogEnvironmentState"}),
        ("hold station, get teh depht off the keel soudner", {"GetSeabedDepth"}),
        ("Detect the cable on the sonar in both steps.", {"DetectSonarFeature"}),
        (
            "Keep buoys out of it: have the detector look for swimmers, and the sonar for wrecks.",
            {"DetectObjects", "DetectSonarFeature"},
        ),
        ("A still with its position at all eight points.", {"CaptureGeoSnapshot"}),
        (
            "Depth with a position fix on every lane, bow locked.",
            {"GetSeabedDepth", "GetGPSLocation", "LockHeading"},
        ),
        ("Nothing within fifty yards of us on the way.", {"ObstacleAvoidance"}),
        ("Drift, but stay inside the polygon.", {"BoundaryEnforcement"}),
        ("Minimum LiDAR distance at bearing 90.", {"GetSectorDistance"}),
        ("LiDAR distance to the obstacle ahead, field of view 20 degrees.", {"DistanceToObstacle"}),
        ("Record the sonar under the tag net-1.", {"SetStreamRecording"}),
        ("Hold position for the given duration. No recording.", set()),
        ("Save the last thirty seconds of video from the buffer.", {"BufferLoopCapture"}),
        (
            "Run a sensor health check.",
            {
                "CheckLensClearness",
                "GetHorizonAngle",
                "GetImageQualityMetrics",
                "VerifyGeotagQuality",
            },
        ),
        (
            "Check the lens and the horizon: a health check.",
            {"CheckLensClearness", "GetHorizonAngle"},
        ),
    ],
)
def test_what_a_text_speaks_of(text: str, skills: set[str]) -> None:
    assert spoken_of(text, VOCABULARY) == skills


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Give the moorings a wide berth.", "ObstacleAvoidance"),
        ("You are confined to the rectangle from (0, 0) to (50, 40).", "BoundaryEnforcement"),
        ("How warm is the bushing?", "GetThermalStats"),
        ("Anything over 70 C on the hull?", "LocateHotspot"),
        ("How far off centre is the ladder, in px?", "CalculateVisualOffset"),
        ("What does the nameplate say?", "OCRScanning"),
        ("How much water have we got under the keel?", "GetSeabedDepth"),
        ("Bring up the thermal feed.", "SelectActiveStream"),
        ("Get it on tape.", "SetStreamRecording"),
        ("Write in the logbook: fender torn.", "RegisterObservation"),
        ("How do we sit relative to the berth?", "GetRelativePose"),
        ("On neither run without the bow locked.", "LockHeading"),
        ("I don't want the environment log interrupted anywhere.", "LogEnvironmentState"),
        ("Is the GPS good to 2 m?", "VerifyGeotagQuality"),
    ],
)
def test_other_ways_of_asking(text: str, skill: str) -> None:
    assert skill in (spoken_of(text, VOCABULARY) or ())


@pytest.mark.parametrize(
    "text",
    [
        "Fahre zum Ziel und miss unterwegs die Tiefe mit dem Echolot.",
        "Diríjase al objetivo y registre la profundidad.",
        "目標地点へ行き、水深を測れ。",
        "Zorp blarg the fnord gribble and snarf wibble.",
    ],
)
def test_what_cannot_be_read_says_nothing(text: str) -> None:
    assert spoken_of(text, VOCABULARY) is None
    assert required(text, VOCABULARY) == frozenset()


def test_another_vehicle_has_no_evidence() -> None:
    other = load_vocabulary("inspection_drone")
    assert spoken_of("Fly to (3, 4) and take a photo.", other) is None
    assert required("Fly to (3, 4) and take a photo.", other) == frozenset()


@pytest.mark.parametrize(
    ("text", "skills"),
    [
        (
            "Hold with the heading locked and a clearance of 10 m.",
            {"LockHeading", "ObstacleAvoidance"},
        ),
        (
            "Take a GPS fix. Check the image quality of cam1.",
            {"GetGPSLocation", "GetImageQualityMetrics"},
        ),
        ("Hold position. No need to check the image quality.", set()),
        ("Take soundings. Never mind the image quality.", set()),
        ("Image quality of cam1, GPS fix. That was done already.", set()),
        ("Soundings on leg one. No soundings on leg two.", set()),
        ("Take an environment snapshot.", set()),
        ("Sonar detector running for nets.", {"DetectSonarFeature"}),
    ],
)
def test_what_is_asked_for_beyond_doubt(text: str, skills: set[str]) -> None:
    assert required(text, VOCABULARY) - {"LogEnvironmentState"} == skills


def test_sampled_inputs_lose_no_skill() -> None:
    sizes, wanted = 0, 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 5, None, "train"), 400):
        spoken, expected = spoken_of(record["prompt"], VOCABULARY), expected_skills(record)
        assert spoken is None or expected <= spoken, record["prompt"]
        assert required(record["prompt"], VOCABULARY) <= expected, record["prompt"]
        sizes, wanted = sizes + len(spoken or expected), wanted + len(expected)
    assert sizes < 1.5 * wanted


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Hold a minute and find out at what angle we lie to the pontoon.", "GetRelativePose"),
        ("How are we placed against the slipway?", "GetRelativePose"),
        ("I want to know skiff-4 again from frame to frame.", "TrackObjects"),
        ("Do not mix the two swimmers up.", "TrackObjects"),
        ("Track the cable drum all along.", "TrackObjects"),
        ("Say if kayaks are anywhere in view.", "DetectObjects"),
        ("Turn north and see whether there are seals about.", "DetectObjects"),
        ("Dump the last 10 s of the buffer.", "BufferLoopCapture"),
        ("Does the hull lean against the skyline?", "GetHorizonAngle"),
        ("Is the boat sitting straight?", "GetHorizonAngle"),
        ("Tell me where on the map we are.", "GetGPSLocation"),
        ("By how much can the fix be wrong?", "VerifyGeotagQuality"),
        ("The room in front within 40 degrees, please.", "DistanceToObstacle"),
        ("What is nearest towards 200?", "GetSectorDistance"),
        ("Does the plate bow out?", "CheckPlanarity"),
        ("Does the mast camera need wiping?", "CheckLensClearness"),
        ("Is the video any use to us, or mush?", "GetImageQualityMetrics"),
        ("Infrared values of the winch.", "GetThermalStats"),
        ("Hold for 40 s, head not moving.", "LockHeading"),
        ("Dephts on all legs.", "GetSeabedDepth"),
    ],
)
def test_indirect_ways_of_asking(text: str, skill: str) -> None:
    assert skill in (spoken_of(text, VOCABULARY) or ())


@pytest.mark.parametrize(
    "text",
    [
        "Check that the fix is within one metre.",
        "Turn until the error is within the threshold.",
        "Temperatures of the black box for a minute.",
        "Cover a rectangle 60 m wide about (5, 5) in lanes.",
        "Box search by its corners: (0, 0), (0, 9), (9, 9), (9, 0).",
        "Visit [1, 2], [3, 4], [5, 6] and [7, 8] and come home.",
        "Go to the far corner at [20, 30].",
        "The text in the lower left quadrant, homeward bound.",
    ],
)
def test_no_fence_without_a_word_of_one(text: str) -> None:
    assert "BoundaryEnforcement" not in (spoken_of(text, VOCABULARY) or ())


@pytest.mark.parametrize(
    "text",
    [
        "Stay inside the rectangle (0, 0), (0, 9), (9, 9), (9, 0).",
        "The corners [0, 0], [0, 9], [9, 9] must not be crossed.",
        "Keep in the box.",
        "These points bound the water that you may use: [1, 2], [3, 4], [5, 6].",
    ],
)
def test_fences(text: str) -> None:
    assert "BoundaryEnforcement" in (spoken_of(text, VOCABULARY) or ())


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        (
            "Go to (4, 4). Tell me if there is any wreck on the sonar, nothing else.",
            "DetectSonarFeature",
        ),
        ("How deep it is on all but the first leg, please.", "GetSeabedDepth"),
        ("Hold 40 s with persistent tracking of ferry-2.", "TrackObjects"),
        ("Turn to 90 with the text in the upper half read, not in the hold.", "OCRScanning"),
        ("Let nothing come closer than 6 m.", "ObstacleAvoidance"),
        (
            "Pass it 9 m off, from end to end, and save the lidar sweep as a 2D profile.",
            "LogLidarSlice",
        ),
        ("Run down it with the bow locked.", "LockHeading"),
        ("Take a fix in the drifts, nothing in the holds.", "GetGPSLocation"),
        ("Wait until she is steady and rate the usability of the frame.", "GetImageQualityMetrics"),
        (
            (
                "Go to (4, 4) with a margin of 12 m, then to (9, 9), where the margin is no longer"
                " needed."
            ),
            "ObstacleAvoidance",
        ),
        ("HOLD TWO MINUTES STOP LOG ENVIRONMENT STOP NO REPLY", "LogEnvironmentState"),
    ],
)
def test_plain_requests_are_required(text: str, skill: str) -> None:
    assert skill in required(in_small_letters(text), VOCABULARY)


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Hold for a minute, and do not leave a mark on the map.", "CreateMapMarker"),
        ("Turn to 90. Don't bother with a margin.", "ObstacleAvoidance"),
        ("Lookout for hot spots.", "DetectObjects"),
    ],
)
def test_what_is_ruled_out_or_meant_otherwise_is_not_required(text: str, skill: str) -> None:
    assert skill not in required(text, VOCABULARY)


def test_what_one_need_not_bother_with_is_not_spoken_of() -> None:
    assert "ObstacleAvoidance" not in (
        spoken_of("Engines off, float 5 min. Don't bother with a margin.", VOCABULARY) or ()
    )


def test_what_others_do_is_not_required() -> None:
    assert not required("They are taking soundings close by. Hold for a minute.", VOCABULARY)


@pytest.mark.parametrize(
    ("text", "skill", "spoken"),
    [
        ("Sun is right on the lens. Nudge 10 degrees to port.", "CheckLensClearness", False),
        (
            "The low sun shines straight into the camera lens, so turn to 120.",
            "CheckLensClearness",
            False,
        ),
        (
            "Sun on the lens again; check the lens while you hold for a minute.",
            "CheckLensClearness",
            True,
        ),
        (
            "The harbour people now want a longer drift. Float for ten minutes.",
            "DetectObjects",
            False,
        ),
        ("Divers need the depth. Hold for a minute and take soundings.", "DetectObjects", False),
        (
            "The crew ask for a watch on swimmers. Look out for swimmers while holding.",
            "DetectObjects",
            True,
        ),
        ("Hold for a minute and detect divers.", "DetectObjects", True),
    ],
)
def test_what_a_remark_mentions_is_not_asked_for(text: str, skill: str, spoken: bool) -> None:
    assert (skill in (spoken_of(text, VOCABULARY) or ())) is spoken
