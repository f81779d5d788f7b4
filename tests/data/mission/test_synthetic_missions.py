"""Synthetic commands: the same for the same seed, valid plans, and every stated value is found in
the command.
"""

import itertools
import json
import re
from collections import Counter
from random import Random

import pytest

from planner_ft.data.mission.synthetic import sample_missions
from planner_ft.data.mission.synthetic.generate import draw_mission
from planner_ft.data.mission.synthetic.lists import say_list
from planner_ft.data.mission.synthetic.noise import typos, unpunctuated
from planner_ft.data.mission.synthetic.numbers import (
    draw_style,
    integer_words,
    number_words,
    say_duration,
    say_heading,
    say_length,
    say_speed,
    tidy,
)
from planner_ft.data.mission.synthetic.positions import say_position
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

VOCABULARY = load_vocabulary()


@pytest.fixture(scope="module")
def samples():
    return list(sample_missions(5, 2000))


def test_same_seed_same_samples():
    assert list(sample_missions(3, 40)) == list(sample_missions(3, 40))
    assert list(itertools.islice(sample_missions(3), 40)) == list(sample_missions(3, 40))
    assert next(sample_missions(4))["prompt"] != next(sample_missions(3))["prompt"]


def test_plans_are_strictly_valid(samples):
    problems = [
        (record["prompt"], found)
        for record in samples
        if (found := plan_problems("mission", record["expected"], VOCABULARY, strict=True))
    ]
    assert problems == []


def test_every_task_and_the_share_of_empty_plans(samples):
    counts = Counter(task["title"] for record in samples for task in record["expected"]["tasks"])
    assert set(counts) == set(VOCABULARY.task)
    assert min(counts.values()) > 35
    empty = [record for record in samples if not record["expected"]["tasks"]]
    assert 0.025 < len(empty) / len(samples) < 0.07
    assert all(record["expected"]["constraints"] for record in empty)


def test_prompts_are_distinct_and_have_no_gaps_left(samples):
    prompts = [record["prompt"] for record in samples]
    assert len(set(prompts)) > 0.985 * len(prompts)
    assert not [prompt for prompt in prompts if re.search(r"[{}\x00]|  ", prompt)]
    texts = [
        text
        for record in samples
        for task in record["expected"]["tasks"]
        for text in (task["task_prompt"],)
    ]
    assert not [text for text in texts if re.search(r"[{}]|  |None", text)]


def test_copied_values_stand_in_the_command(samples):
    """Ids and codes are never misspelt: they can be learnt by copying alone."""
    for record in samples:
        for task in record["expected"]["tasks"]:
            identity = task["parameters"].get("target_id")
            if identity:
                assert identity.lower() in record["prompt"].lower()


def test_most_text_values_and_coordinates_stand_in_the_command_as_written(samples):
    found = total = 0
    for record in samples:
        for task in record["expected"]["tasks"]:
            for value in task["parameters"].values():
                if isinstance(value, str):
                    total += 1
                    found += value.lower() in record["prompt"].lower()
    assert found > 0.93 * total


def test_task_prompts_state_every_value(samples):
    for record in samples:
        for task in record["expected"]["tasks"]:
            for name, value in task["parameters"].items():
                if isinstance(value, int | float) and name != "arc":
                    assert str(value) in task["task_prompt"], task
                if (
                    isinstance(value, list)
                    and value not in ([-99, -99], [0, 0])
                    and not isinstance(value[0], str)
                ):
                    assert json.dumps(value) in task["task_prompt"], task


def test_searched_targets_have_their_assumption_and_docks_theirs(samples):
    for record in samples:
        text = " ".join(record["expected"]["assumptions"])
        for task in record["expected"]["tasks"]:
            if task["parameters"].get("goal_position") == [-99, -99]:
                assert "is filled in before docking" in text
            if task["title"] == "Transit" and task["parameters"]["target_position"] == [0, 0]:
                assert "Home is [0, 0]." in text


def test_number_words():
    assert integer_words(0) == "zero"
    assert integer_words(45, "-") == "forty-five"
    assert integer_words(117) == "one hundred and seventeen"
    assert integer_words(2003) == "two thousand and three"
    assert number_words(-12, Random(1)) == "minus twelve"
    assert number_words(0.7, Random(1)) == "zero point seven"
    assert number_words(12.5, Random(2)) in ("twelve and a half", "twelve point five")
    assert tidy(12.0) == 12 and isinstance(tidy(12.0), int)
    assert tidy(1 / 3) == 0.33


def spoken(say, seed_range=range(3000)):
    for seed in seed_range:
        rng = Random(seed)
        yield say(rng, draw_style(rng))


def test_durations_and_lengths_are_converted():
    durations = {said.text: said.value for said in spoken(say_duration)}
    assert durations["half an hour"] == 1800
    assert durations["a minute and a half"] == 90
    assert {
        text: value
        for text, value in durations.items()
        if text in ("4 min", "4 minutes", "four minutes", "2 hours", "2 h")
    }.items() <= {
        "4 min": 240,
        "4 minutes": 240,
        "four minutes": 240,
        "2 hours": 7200,
        "2 h": 7200,
    }.items()
    lengths = {
        said.text: said.value
        for said in spoken(lambda rng, style: say_length(rng, style, 100, 900, far=True))
    }
    assert lengths["half a kilometre"] == 500
    for text, value in lengths.items():
        if match := re.fullmatch(r"([\d.]+) ?(km|m|kilometres?|metres?)", text):
            assert value == pytest.approx(
                float(match[1]) * (1000 if match[2].startswith("k") else 1)
            )
    speeds = {said.text: said.value for said in spoken(say_speed)}
    assert speeds["2 knots"] == 1.03


def test_compass_words_become_degrees():
    headings = {said.text: said.value for said in spoken(say_heading)}
    assert (
        headings["north"],
        headings["north-west"],
        headings["southeast"],
        headings["due west"],
    ) == (0, 315, 135, 270)


def test_positions_keep_both_numbers():
    for seed in range(400):
        rng = Random(seed)
        text = say_position((120, -44), rng, draw_style(rng))
        digits = [abs(float(number)) for number in re.findall(r"\d+(?:\.\d+)?", text)]
        assert digits in ([120, 44], [44, 120]) or ("hundred" in text and "forty" in text), text
        if "south" not in text and "S" not in text:
            assert "-44" in text or "minus" in text, text


def test_lists_name_the_most_urgent_first():
    for seed in range(200):
        text = say_list(["drift log", "stills"], Random(seed))
        assert text.index("drift log") < text.index("stills") or re.search(
            r"but (before that )?(the )?drift log|stills after|no, (the )?drift log", text
        ), text


def test_noise_spares_what_only_copying_can_tell():
    text = typos("find the rusty barge skrimvold near the wharf", Random(1), {"skrimvold"}, 1.0)
    assert "skrimvold" in text and "rusty" not in text
    assert unpunctuated("Go to 12.5, 4. Then wait, please.") == "Go to 12.5 4 Then wait please"


def test_a_sample_names_its_form():
    record = draw_mission(Random(8), "x")
    assert set(record) == {"id", "family", "prompt", "expected", "tags"}
    assert record["family"].startswith("synthetic-")
