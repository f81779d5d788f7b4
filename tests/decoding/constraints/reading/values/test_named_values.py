"""Values that an input names by their kind."""

from __future__ import annotations

import itertools

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.constraints.companions import read_companions
from planner_ft.decoding.constraints.reading.values.named_values import read_named_values
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.mark.parametrize(
    ("text", "skill", "parameter", "value"),
    [
        ("Hold 20 s with stream 'dome' selected.", "SelectActiveStream", "stream_id", "dome"),
        (
            "Fit a cylinder to the cloud monopile_pts while holding.",
            "FitCylinderModel",
            "cloud_data",
            "monopile_pts",
        ),
        (
            "Read the text in the frame region 'fender band'.",
            "OCRScanning",
            "region",
            "fender band",
        ),
        (
            "Get the image quality of camera quad_2.",
            "GetImageQualityMetrics",
            "camera_id",
            "quad_2",
        ),
        ("Drop a map marker labelled kelp bed.", "CreateMapMarker", "label", "kelp bed"),
        (
            'Set a marker, label: "cable end", at the far end.',
            "CreateMapMarker",
            "label",
            "cable end",
        ),
        (
            "Sonar feature detection, type rubble, on both legs.",
            "DetectSonarFeature",
            "type",
            "rubble",
        ),
        (
            "Log the observation “all clear” in the hold.",
            "RegisterObservation",
            "observation",
            "all clear",
        ),
    ],
)
def test_what_follows_a_kind_is_its_value(
    text: str, skill: str, parameter: str, value: str
) -> None:
    assert read_named_values(text, {skill}, VOCABULARY) == {(skill, parameter): frozenset({value})}


@pytest.mark.parametrize(
    ("text", "spoken"),
    [
        # A sensor of one of two skills.
        ("Take the depth and a still with sensor cam_2.", {"GetSeabedDepth", "CaptureGeoSnapshot"}),
        ("Select the bow camera's stream now.", {"SelectActiveStream"}),
        ("Record with tag 'a1', no, make that 'a2'.", {"SetStreamRecording"}),
        ("Switch to stream cam_1. Later switch the stream over to cam_2.", {"SelectActiveStream"}),
        (
            "Keep object T-3 centred and track the pump outlet.",
            {"VisualStationKeep", "TrackObjects"},
        ),
        ("Read region 'a' there. " * 90, {"OCRScanning"}),
    ],
)
def test_what_is_not_certain_is_left_to_the_model(text: str, spoken: set[str]) -> None:
    assert read_named_values(text, spoken, VOCABULARY) == {}


def test_values_of_sampled_tasks_are_mostly_the_labels() -> None:
    """Where a skill is used with several values and one has its kind beside it, the others are
    missed.
    """
    right = wrong = 0
    for record in itertools.islice(sample_tasks(VOCABULARY, 616, None, "train"), 700):
        named = read_named_values(
            record["prompt"], read_companions(record, VOCABULARY).mentioned, VOCABULARY
        )
        steps = record["expected"]["skill_sequence"]
        for (name, parameter), values in named.items():
            used = [
                skill["parameters"]
                for step in steps
                for skill in (step["navigation_skill"], *step["perception_skills"])
                if skill["name"] == name
            ]
            given = [
                parameters[parameter] in values for parameters in used if parameter in parameters
            ]
            right, wrong = right + sum(given), wrong + given.count(False)
    assert right >= 40
    assert right >= 10 * wrong
