"""What the task sampler writes."""

import itertools
import json
import re

import pytest

from planner_ft.data.task import sampler
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary.definition import load_vocabulary
from planner_ft.vocabulary.plans import canonical_plan, named_entries, plan_problems

USV = load_vocabulary("usv")


def sampled(split, count, seed=3):
    return list(sample_tasks(USV, seed, count, split))


def test_records_are_canonical_and_strictly_valid():
    for record in sampled("train", 800):
        assert list(record) == ["id", "family", "task", "parameters", "prompt", "expected"]
        assert plan_problems("task", record["expected"], USV, strict=True) == []
        assert compact_json(canonical_plan("task", record["expected"], USV)) == compact_json(record["expected"])
        task = {"title": record["task"], "parameters": record["parameters"], "task_prompt": record["prompt"]}
        assert plan_problems("mission", {"tasks": [task], "assumptions": [], "constraints": []}, USV, strict=True) == []


def test_prompts_are_tidy():
    for record in [*sampled("train", 800), *sampled("test_unseen", 200)]:
        prompt = record["prompt"]
        assert not re.search(r"[\x02\x03{}~]|  | [.,;]|^\s|\s$", prompt), prompt


def test_same_seed_same_bytes():
    assert compact_json(sampled("test", 50)) == compact_json(sampled("test", 50))
    assert compact_json(sampled("test", 50)) != compact_json(sampled("test", 50, seed=4))


def test_all_tasks_and_skills_occur():
    records = sampled("train", 2000)
    assert {record["task"] for record in records} == set(USV.task)
    assert {name for record in records for name, _parameters in named_entries("task", record["expected"])} == set(USV.skill)


def test_splits_share_no_prompt_even_with_numbers_masked():
    seen = {}
    for split in sampler.SPLITS:
        for record in sampled(split, 300):
            key = (record["task"], re.sub(r"\d+(\.\d+)?", "0", record["prompt"].lower()))
            assert seen.setdefault(key, split) == split


def test_unseen_families_occur_nowhere_else():
    unseen = {record["family"] for record in sampled("test_unseen", 300)}
    assert not unseen & {record["family"] for split in ("train", "validation", "test") for record in sampled(split, 300)}


def test_endless_stream_continues_the_counted_one():
    endless = list(itertools.islice(sample_tasks(USV, 3, None, "train"), 60))
    assert endless == sampled("train", 60)


def test_numbers_have_two_decimals_at_most():
    for record in sampled("train", 500):
        for number in re.findall(r"-?\d+\.\d+", json.dumps(record["expected"])):
            assert len(number.split(".")[1]) <= 2


def test_unknown_split_is_refused():
    with pytest.raises(PlannerError, match="train, validation"):
        next(sample_tasks(USV, 0, 1, "dev"))
