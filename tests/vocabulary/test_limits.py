"""Limits are written in canonical sentences and read back from them."""

import pytest

from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.limits import (
    KINDS,
    load_limits,
    prompt_sentence,
    read_limit,
    sentence,
    written,
)

USV = load_limits(load_vocabulary("usv"))
SQUARE = [[0, 0], [200, 0], [200, 200], [0, 200.5]]
PLATFORM = {"distance": 70, "object": "the platform", "position": [260, 80]}
SENTENCES = [
    (
        "fence",
        {"polygon": SQUARE},
        "The vehicle stays inside [0, 0], [200, 0], [200, 200], [0, 200.5].",
    ),
    ("keep_out", PLATFORM, "The vehicle stays at least 70 m from the platform at [260, 80]."),
    (
        "keep_out",
        {"distance": 70, "object": "the platform"},
        "The vehicle stays at least 70 m from the platform.",
    ),
    (
        "keep_out",
        {"distance": 70, "position": [260, 80]},
        "The vehicle stays at least 70 m from [260, 80].",
    ),
    ("speed", {"speed": 1.5}, "The vehicle goes no faster than 1.5 m/s."),
    ("return", {"time": "16:30"}, "The vehicle is back by 16:30."),
    ("return", {"within": "half an hour"}, "The vehicle is back within half an hour."),
    ("no_recording", {}, "Nothing is recorded."),
    ("no_recording", {"object": "the marina"}, "Nothing is recorded near the marina."),
]
VALUES = {
    "polygon": SQUARE,
    "position": [-3.25, 80],
    "distance": 0.5,
    "speed": 1.25,
    "duration": 1200,
    "object": "the old pier",
    "time": "high water",
    "within": "two hours",
}


@pytest.mark.parametrize(("kind", "values", "text"), SENTENCES)
def test_the_sentence_is_the_documented_one(kind, values, text) -> None:
    assert sentence(kind, values, USV) == text


@pytest.mark.parametrize("vehicle", ["usv", "inspection_drone"])
def test_every_sentence_is_read_back(vehicle) -> None:
    limits = load_limits(load_vocabulary(vehicle))
    assert set(limits) == set(KINDS)
    for kind, known in limits.items():
        for write, forms in ((sentence, known.sentences), (prompt_sentence, known.prompts)):
            for form in forms:
                given = {name: value for name, value in VALUES.items() if f"{{{name}}}" in form}
                text = write(kind, given, limits)
                limit = read_limit(text, limits)
                assert (limit.kind, limit.values, limit.text) == (kind, given, text)


def test_a_limit_of_some_tasks_names_them() -> None:
    text = sentence("speed", {"speed": 1}, USV, ["SubseaCableTrack", "Transit", "Transit"])
    assert text == "The vehicle goes no faster than 1 m/s during SubseaCableTrack and Transit."
    limit = read_limit(text, USV)
    assert (limit.kind, limit.values, limit.titles) == (
        "speed",
        {"speed": 1},
        ("SubseaCableTrack", "Transit"),
    )
    assert limit.holds_for("Transit") and not limit.holds_for("KeepStation")


@pytest.mark.parametrize(
    "text",
    [
        *("The vehicle stays near [0, 0].", "Keep 70 m from it.", "", "The mission is short."),
        "The vehicle stays outside [10, 20], [30, 40].",  # Two corners are no area.
        "The vehicle stays inside [0, 0], [1e999, 0], [1, 1].",
        "The vehicle stays within 1e999 m of home.",
        "The vehicle stays within -300 m of home.",
        "The vehicle goes no faster than -1 m/s.",
        "The mission takes at most -5 s.",
    ],
)
def test_other_sentences_are_no_limits(text) -> None:
    assert read_limit(text, USV) is None


def test_powers_of_ten_are_read_in_either_case() -> None:
    limit = read_limit("The vehicle stays inside [0, 0], [1E2, 0], [1e2, -1E2].", USV)
    assert limit.values == {"polygon": [[0, 0], [100, 0], [100, -100]]}


def test_numbers_keep_their_digits() -> None:
    assert written(0.1) == "0.1"
    assert written(123456.75) == "123456.75"
    assert written([[1, 2.0], [3, 4]]) == "[1, 2], [3, 4]"
