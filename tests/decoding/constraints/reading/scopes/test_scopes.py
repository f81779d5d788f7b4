"""In which steps filters and perception skills run, as far as a task input says so."""

from __future__ import annotations

import itertools
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.reading.scopes.scope_parts import Scope
from planner_ft.decoding.constraints.reading.scopes.scopes import read_scopes
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
GO, HOLD, FACE, NUDGE, ARC = "GoToXY", "StationKeep", "RotateToHeading", "NudgeYaw", "ArcTurn"
DRIFT, VISUAL, WAIT = "DriftWithCurrent", "VisualStationKeep", "WaitForStability"


def verdicts(scope: Scope, navigation: list[str], *, told: bool = True) -> list[bool | None]:
    """What a scope says of each step of a plan; `told`: it is known which step is the last."""
    return [
        scope.allows(
            index, name, index == len(navigation) - 1 if told else None, navigation[:index]
        )
        for index, name in enumerate(navigation)
    ]


@pytest.mark.parametrize(
    ("prompt", "skill", "navigation", "steps"),
    [
        (
            "Drive to (40, 10), then face north. Film with the mast camera in both steps.",
            "SetStreamRecording",
            [GO, FACE],
            {0, 1},
        ),
        (
            "Drift for a minute, then go to (3, 4). Keep 8 m clear from beginning to end.",
            "ObstacleAvoidance",
            [DRIFT, GO],
            {0, 1},
        ),
        (
            "Go to (9, 6), then to (9, -6). Heading locked on the second leg only.",
            "LockHeading",
            [GO, GO],
            {1},
        ),
        (
            (
                "Go to (9, 6), then to (9, -6). Margin of 3 m on the last leg only; log the depth"
                " on both legs."
            ),
            "ObstacleAvoidance",
            [GO, GO],
            {1},
        ),
        (
            (
                "Go to (9, 6), then to (9, -6). Margin of 3 m on the last leg only; log the depth"
                " on both legs."
            ),
            "GetSeabedDepth",
            [GO, GO],
            {0, 1},
        ),
        (
            (
                "Nudge 5 degrees to port, then hold. During the hold, not before, run the detector"
                " for seals."
            ),
            "DetectObjects",
            [NUDGE, HOLD],
            {1},
        ),
        (
            (
                "Wait until the boat is steady, then drift for 9 minutes; horizon angle only while"
                " drifting."
            ),
            "GetHorizonAngle",
            [WAIT, DRIFT],
            {1},
        ),
        (
            (
                "Go to (80, 20). From there keep tug-2 centred and, in that second step, save the"
                " video buffer."
            ),
            "BufferLoopCapture",
            [GO, VISUAL],
            {1},
        ),
        (
            (
                "Turn to 90 degrees, then hold for a minute, and during this hold check the lens of"
                " cam1."
            ),
            "CheckLensClearness",
            [FACE, HOLD],
            {1},
        ),
        (
            (
                "Turn to 0. Turn to 90. Turn to 180. Stills with position in every step except the"
                " last."
            ),
            "CaptureGeoSnapshot",
            [FACE, FACE, FACE],
            {0, 1},
        ),
        (
            "Phase A: hold for 30 s; take a GPS fix. Phase B: wait until steady; read the horizon.",
            "GetGPSLocation",
            [HOLD, WAIT],
            {0},
        ),
        (
            "Drive to (5, 5). Then hold for two minutes and log the environment.",
            "LogEnvironmentState",
            [GO, HOLD],
            {1},
        ),
        (
            (
                "Pan left by 30 degrees, then pan left by 30 degrees once more. In both pans fit a"
                " cylinder."
            ),
            "FitCylinderModel",
            [NUDGE, NUDGE],
            {0, 1},
        ),
    ],
)
def test_plain_scopes_are_read(
    prompt: str, skill: str, navigation: list[str], steps: set[int]
) -> None:
    assert verdicts(read_scopes(prompt, VOCABULARY)[skill], navigation) == [
        index in steps for index in range(len(navigation))
    ]


@pytest.mark.parametrize(
    ("prompt", "skill"),
    [
        (
            (
                "Go to (20, 40) and run 60 m due east. LiDAR slices on the run, not on the way to"
                " its start."
            ),
            "LogLidarSlice",
        ),
        (
            "Turn to 0, 90 and 180. 5 m of clearance on the outer two, none on the middle bearing.",
            "ObstacleAvoidance",
        ),
        ("First leg to (0, 9): bow locked. Second leg to (9, 9): as the first.", "DetectObjects"),
        ("Inspect the target. Stills at the four corners only.", "CaptureGeoSnapshot"),
        ("", "GetGPSLocation"),
    ],
)
def test_what_may_mean_several_things_is_left_to_the_model(prompt: str, skill: str) -> None:
    scope = read_scopes(prompt, VOCABULARY).get(skill)
    assert scope is None or not any(verdicts(scope, [GO, GO, GO]))


def test_the_last_step_is_known_from_the_text_where_that_is_whole() -> None:
    scope = read_scopes(
        "Turn to 90. Hold for a minute. Drift for two minutes. Take a GPS fix in the last step"
        " only.",
        VOCABULARY,
    )["GetGPSLocation"]
    assert verdicts(scope, [FACE, HOLD, DRIFT], told=False) == [False, False, True]
    # A plan that goes another way is not counted by the text.
    assert scope.allows(2, GO, None, [FACE, HOLD]) is None
    assert scope.allows(0, FACE) is False


def test_a_movement_of_several_steps_leaves_later_parts_open() -> None:
    scope = read_scopes(
        "Run the planned grid. Then hold for a minute. Depth in the second part only.", VOCABULARY
    )["GetSeabedDepth"]
    assert verdicts(scope, [GO, GO, HOLD]) == [False, None, None]


def test_a_word_for_turns_is_certain_only_where_the_text_has_one_kind() -> None:
    one = read_scopes(
        "Go to (5, 5), then arc 90 degrees to port at 20 m. Film during the turn only.", VOCABULARY
    )["SetStreamRecording"]
    assert verdicts(one, [GO, ARC]) == [False, True]
    two = read_scopes(
        "Turn to 90, then nudge 5 degrees to port. Film during the turn only.", VOCABULARY
    )["SetStreamRecording"]
    assert verdicts(two, [FACE, NUDGE]) == [None, None]


def _steps(record: dict[str, Any]) -> list[dict[str, Any]]:
    steps: list[dict[str, Any]] = record["expected"]["skill_sequence"]
    return steps


def test_sampled_prompts_are_read_as_they_are_labelled() -> None:
    right = wrong = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 4711, None, "train"), 600):
        steps = _steps(record)
        running = [
            {
                skill["name"]
                for role in ("filter_skills", "perception_skills")
                for skill in step[role]
            }
            for step in steps
        ]
        navigation = [step["navigation_skill"]["name"] for step in steps]
        for name, scope in read_scopes(record["prompt"], VOCABULARY).items():
            if not any(name in names for names in running):
                continue
            said = [
                (verdict, name in names)
                for verdict, names in zip(verdicts(scope, navigation), running, strict=True)
                if verdict is not None
            ]
            right += sum(verdict == runs for verdict, runs in said)
            wrong += sum(verdict != runs for verdict, runs in said)
    assert right > 500
    assert right / (right + wrong) > 0.975


@pytest.mark.parametrize(
    ("prompt", "skill", "navigation", "steps"),
    [
        (
            "Hold 20 s, then turn to 90, then hold 40 s. Depth everywhere but while turning.",
            "GetSeabedDepth",
            [HOLD, FACE, HOLD],
            {0, 2},
        ),
        (
            "Hold 20 s, then turn to 90, then hold 40 s. Depth everywhere but in the turn.",
            "GetSeabedDepth",
            [HOLD, FACE, HOLD],
            {0, 2},
        ),
        (
            "Hold 20 s, then turn to 90, then hold 40 s. Bow locked in all but the last hold.",
            "LockHeading",
            [HOLD, FACE, HOLD],
            {0, 1},
        ),
        (
            "Hold 20 s, then turn to 90, then hold 40 s. Bow locked in every hold but the last.",
            "LockHeading",
            [HOLD, FACE, HOLD],
            {0},
        ),
        (
            "Go to (9, 6), then to (9, -6), then to (3, 3). Depth from the second leg on.",
            "GetSeabedDepth",
            [GO, GO, GO],
            {1, 2},
        ),
        (
            "Go to (9, 6), then to (9, -6), then to (3, 3). Depth until the end of the second leg.",
            "GetSeabedDepth",
            [GO, GO, GO],
            {0, 1},
        ),
        (
            "Turn to 0. Turn to 90. Turn to 180. Stills with position at the outer two.",
            "CaptureGeoSnapshot",
            [FACE, FACE, FACE],
            {0, 2},
        ),
        (
            "Turn to 0. Turn to 90. Turn to 180. Stills with position at the middle heading.",
            "CaptureGeoSnapshot",
            [FACE, FACE, FACE],
            {1},
        ),
        (
            "Go to (9, 6), then go home. Depth on the way home only.",
            "GetSeabedDepth",
            [GO, GO],
            {1},
        ),
    ],
)
def test_scopes_told_by_the_movements(
    prompt: str, skill: str, navigation: list[str], steps: set[int]
) -> None:
    assert verdicts(read_scopes(prompt, VOCABULARY)[skill], navigation) == [
        index in steps for index in range(len(navigation))
    ]


@pytest.mark.parametrize(
    ("prompt", "skill"),
    [
        (
            "Go to (9, 6), then to (9, -6). I said depth on the first leg; make that the second.",
            "GetSeabedDepth",
        ),
        (
            "Go to (9, 6), then to (9, -6). Depth on every leg except the one home.",
            "GetSeabedDepth",
        ),
    ],
)
def test_scopes_taken_back_or_pointed_at_are_not_read(prompt: str, skill: str) -> None:
    scope = read_scopes(prompt, VOCABULARY).get(skill)
    assert scope is None or not any(verdict is not None for verdict in verdicts(scope, [GO, GO]))
