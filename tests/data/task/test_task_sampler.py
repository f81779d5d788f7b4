"""What the task sampler writes."""

import functools
import itertools
import json
import os
import re
import subprocess
import sys

import pytest

from planner_ft.data.task import sampler
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import BUNDLED, load_vocabulary
from planner_ft.vocabulary.plans import canonical_plan, named_entries, plan_problems

USV = load_vocabulary("usv")


def sampled(split, count, seed=3):
    return list(sample_tasks(USV, seed, count, split))


def test_records_are_canonical_and_strictly_valid():
    for record in sampled("train", 800):
        assert list(record) == ["id", "family", "task", "parameters", "prompt", "expected"]
        assert plan_problems("task", record["expected"], USV, strict=True) == []
        assert compact_json(canonical_plan("task", record["expected"], USV)) == compact_json(
            record["expected"]
        )
        task = {
            "title": record["task"],
            "parameters": record["parameters"],
            "task_prompt": record["prompt"],
        }
        assert (
            plan_problems(
                "mission", {"tasks": [task], "assumptions": [], "constraints": []}, USV, strict=True
            )
            == []
        )


def test_prompts_are_tidy():
    for record in [*sampled("train", 800), *sampled("test_unseen", 200)]:
        prompt = record["prompt"]
        assert not re.search(r"[\x02\x03{}~]|  | [.,;](?!\.\.)|^\s|\s$", prompt), prompt


def test_same_seed_same_bytes():
    assert compact_json(sampled("test", 50)) == compact_json(sampled("test", 50))
    assert compact_json(sampled("test", 50)) != compact_json(sampled("test", 50, seed=4))


def test_all_tasks_and_skills_occur():
    records = sampled("train", 2000)
    assert {record["task"] for record in records} == set(USV.task)
    assert {
        name
        for record in records
        for name, _parameters in named_entries("task", record["expected"])
    } == set(USV.skill)


def test_splits_share_no_prompt_even_with_numbers_masked():
    seen = {}
    for split in sampler.SPLITS:
        for record in sampled(split, 300):
            key = (record["task"], re.sub(r"\d+(\.\d+)?", "0", record["prompt"].lower()))
            assert seen.setdefault(key, split) == split


def test_a_vehicle_whose_texts_are_all_in_train_is_told_so(monkeypatch):
    monkeypatch.setattr(sampler, "forms", lambda prompt: ("one text", prompt))
    with pytest.raises(PlannerError, match=r"test has fewer than 9 .* that are not in train; ask"):
        next(sample_tasks(USV, 3, 9, "test", apart={"one text"}))


def test_unseen_families_occur_nowhere_else():
    unseen = {record["family"] for record in sampled("test_unseen", 300)}
    assert not unseen & {
        record["family"]
        for split in ("train", "validation", "test")
        for record in sampled(split, 300)
    }


def test_endless_stream_continues_the_counted_one():
    endless = list(itertools.islice(sample_tasks(USV, 3, None, "train"), 60))
    assert endless == sampled("train", 60)


def test_samples_do_not_depend_on_the_order_of_sets():
    code = (
        "import itertools, json, zlib; from planner_ft.data.task.sampler import sample_tasks; from"
        " planner_ft.vocabulary import load_vocabulary; "
    )
    code += (
        "print(zlib.crc32(json.dumps(list(itertools.islice(sample_tasks(load_vocabulary(), 7, None,"
        " 'train'), 380))).encode()))"
    )
    runs = [
        subprocess.run(
            [sys.executable, "-c", code],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            check=True,
        )
        for seed in ("0", "1")
    ]
    assert runs[0].stdout == runs[1].stdout


def test_numbers_have_two_decimals_at_most():
    for record in sampled("train", 500):
        for number in re.findall(r"-?\d+\.\d+", json.dumps(record["expected"])):
            assert len(number.split(".")[1]) <= 2


def test_unknown_split_is_refused():
    with pytest.raises(PlannerError, match="train, validation"):
        next(sample_tasks(USV, 0, 1, "dev"))


@pytest.mark.parametrize("split", ["train", "test_unseen"])
def test_another_vehicle_needs_no_other_code(split):
    drone = load_vocabulary("inspection_drone")
    records = list(sample_tasks(drone, 0, 400, split))
    names = {
        name
        for record in records
        for name, _parameters in named_entries("task", record["expected"])
    }
    assert {record["task"] for record in records} == set(drone.task) and len(drone.task) == 8
    assert names == set(drone.skill) and len(drone.skill) == 12
    assert not any(
        plan_problems("task", record["expected"], drone, strict=True) for record in records
    )


def test_a_definition_without_phrases_falls_back_on_names(tmp_path):
    plain = tmp_path / "rover.toml"
    plain.write_text((BUNDLED / "inspection_drone.toml").read_text())
    records = list(sample_tasks(load_vocabulary(str(plain)), 0, 300, "train"))
    assert any("run fly to xy with position [" in record["prompt"].lower() for record in records)


@functools.cache
def composed():
    """Records that are no template's, drawn as they are asked for and kept."""
    records = sample_tasks(USV, 5, 60_000, "train")
    return [], (one for one in records if not one["family"].startswith("template/"))


def label(prompt_part):
    """The first composed record whose prompt has the text, so that the label can be checked against
    the words; templates may mean something else by them.
    """
    kept, more = composed()
    for record in itertools.chain(kept, (kept.append(one) or one for one in more)):
        if re.search(prompt_part, record["prompt"]):
            return record
    raise AssertionError(prompt_part)


def navigation(record):
    return [step["navigation_skill"] for step in record["expected"]["skill_sequence"]]


def test_left_is_negative():
    record = label(
        r"^(?:Nudge|Pan|Turn|Yaw) (?:(?!arc\b)[a-z]+ )*\d+ degrees (?:left|to port)\b[^.]*\.$"
    )
    degrees = int(re.search(r"(\d+) degrees (?:left|to port)", record["prompt"]).group(1))
    assert navigation(record)[0] == {"name": "NudgeYaw", "parameters": {"delta_yaw": -degrees}}


def test_a_referred_value_comes_from_the_task_parameters():
    record = label(
        r"^(?:Hold|Drift)\b(?![^.]*\b(?:not|no|then)\b)[^.]* for the (?:planned|given|ordered|set)"
        r" (?:time|duration)[^.]*\.$"
    )
    assert navigation(record)[0]["parameters"]["time"] == record["parameters"]["duration"]


def test_a_prompt_without_a_movement_holds_position():
    for record in sampled("train", 400):
        if record["family"].startswith("no_movement/"):
            assert navigation(record) == [{"name": "StationKeep", "parameters": {}}]


def test_refused_skills_are_not_planned():
    record = label(r"\b(?:Do not|Don't|need not|no need to) [^.]*\bgeotag[^.]*\.$")
    steps = record["expected"]["skill_sequence"]
    assert "VerifyGeotagQuality" not in {
        skill["name"] for step in steps for skill in step["perception_skills"]
    }


@pytest.mark.parametrize(
    ("phrase", "message"),
    [
        ("~go (to {xy}", "not closed"),
        ("~go to {xy} at {speed}", "no parameter speed"),
        ("~go to the {_castle}", "castle"),
    ],
)
def test_a_bad_phrase_is_named(tmp_path, phrase, message):
    (tmp_path / "rover.toml").write_text((BUNDLED / "inspection_drone.toml").read_text())
    (tmp_path / "rover.phrases.toml").write_text(f'[skill.FlyToXY]\nphrases = ["{phrase}"]\n')
    with pytest.raises(PlannerError, match=message):
        next(sample_tasks(load_vocabulary(str(tmp_path / "rover.toml")), 0, 1, "train"))


def test_subjects_draw_from_their_templates_alone():
    """Every record comes from a whole prompt; a subject that no file has is refused."""
    drawn = sample_tasks(USV, 3, 20, "train", ["turns_and_legs"])
    assert all(record["family"].startswith("template/") for record in drawn)
    with pytest.raises(PlannerError, match="prompt templates of weather"):
        next(sample_tasks(USV, 3, 1, "train", ["weather"]))
