"""Values that stand behind the words for a skill, to their end."""

from __future__ import annotations

import itertools
import time

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.reading.telegrams import in_small_letters
from planner_ft.decoding.constraints.reading.values.described_values import read_described_values
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    ("text", "skill", "parameter", "value"),
    [
        (
            "Hold a minute. Heat statistics of the boiler casing, please.",
            "GetThermalStats",
            "roi",
            "boiler casing",
        ),
        ("Tell me whether the wing wall is flat.", "CheckPlanarity", "roi", "wing wall"),
        (
            "On the sonar we are after mooring chains.",
            "DetectSonarFeature",
            "type",
            "mooring chains",
        ),
        (
            "Pixel error to the sluice lamp at both ends.",
            "CalculateVisualOffset",
            "target_id",
            "sluice lamp",
        ),
        ("The tracker stays on pilot boat 7.", "TrackObjects", "object_id", "pilot boat 7"),
        (
            "Recording on for the keel camera, file tag dawn_12.",
            "SetStreamRecording",
            "file_tag",
            "dawn_12",
        ),
        (
            "Recording of the towed array on, under run_b.",
            "SetStreamRecording",
            "file_tag",
            "run_b",
        ),
        (
            "Write the hydrophone to disk under the tag low_water.",
            "SetStreamRecording",
            "sensor_id",
            "hydrophone",
        ),
        (
            "Take a geotagged still there, note cleat 3 bent.",
            "CaptureGeoSnapshot",
            "note",
            "cleat 3 bent",
        ),
        (
            "In the hold drop a marker named berth free and log the environment.",
            "CreateMapMarker",
            "label",
            "berth free",
        ),
        (
            "Hold here with the detector on and pin the spot as likely wreck.",
            "CreateMapMarker",
            "label",
            "likely wreck",
        ),
        (
            "GO TO 10, 20 STOP SWITCH TO MAST CAMERA STOP REGARDS",
            "SelectActiveStream",
            "stream_id",
            "mast camera",
        ),
        (
            "FERRY RAMP STAYS IN CENTRE OF FRAME STOP THANKS",
            "VisualStationKeep",
            "target_id",
            "ferry ramp",
        ),
    ],
)
def test_a_value_reaches_to_its_end(text: str, skill: str, parameter: str, value: str) -> None:
    assert read_described_values(in_small_letters(text), {skill}, VOCABULARY)[
        skill, parameter
    ] == frozenset({value})


@pytest.mark.parametrize(
    ("text", "skill"),
    [
        ("Pixel error to the lamp and the ladder.", "CalculateVisualOffset"),
        ("Thermal statistics of the region.", "GetThermalStats"),
        ("Keep the camera centred on the float.", "VisualStationKeep"),
        (
            "Depth from the stern sounder. Later on sound the depth some other way.",
            "GetSeabedDepth",
        ),
        ("Horizon tilt from gyro_1, the same from gyro_2.", "GetHorizonAngle"),
        ("Temperatures of the deck, no, of the mast.", "GetThermalStats"),
    ],
)
def test_what_is_not_plain_is_left_to_the_model(text: str, skill: str) -> None:
    assert not read_described_values(text, {skill}, VOCABULARY)


def test_values_of_sampled_tasks_are_the_labels() -> None:
    right = wrong = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 4417, None, "train"), 400):
        read = read_described_values(
            record["prompt"], read_companions(record, VOCABULARY).mentioned, VOCABULARY
        )
        skills = [
            skill
            for step in record["expected"]["skill_sequence"]
            for skill in (step["navigation_skill"], *step["perception_skills"])
        ]
        given = [
            skill["parameters"].get(parameter) in values
            for (name, parameter), values in read.items()
            for skill in skills
            if skill["name"] == name
        ]
        right, wrong = right + sum(given), wrong + given.count(False)
    assert right >= 60
    assert right >= 15 * wrong


def test_long_inputs_are_read_in_no_time() -> None:
    text = ("depth from the " + "long name and " * 70)[:999]
    begun = time.perf_counter()
    read_described_values(
        text,
        {"GetSeabedDepth", "GetThermalStats", "SetStreamRecording", "CaptureGeoSnapshot"},
        VOCABULARY,
    )
    assert time.perf_counter() - begun < 0.5
