"""Samples of renamed vehicles that share a vocabulary."""

from __future__ import annotations

import itertools
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.data.missions import sample_missions
from planner_ft.document.own_vehicle import new_vehicle
from planner_ft.pretraining.corpus import Mixture, encode_shard, load_shard, written_commands
from planner_ft.pretraining.grids import grid_of, parts_of
from planner_ft.pretraining.loop import PretrainSettings, completion_loss, new_model
from planner_ft.pretraining.model import CAUSAL, register_attention
from planner_ft.pretraining.packs import IGNORE, draw_packs, packed, view
from planner_ft.prompts import render_sample
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

USV = load_vocabulary()
DRONE = load_vocabulary("inspection_drone")


def test_a_view_renames_the_plans_with_the_vocabulary() -> None:
    renamed = 0
    for seed in range(20):
        records = list(sample_missions(seed, 6, USV))
        seen = view(USV, records, [USV, DRONE], Random(seed))
        titles = [task.title for task in seen.vocabulary.tasks]
        assert len(set(titles)) == len(titles) <= len(USV.tasks)
        renamed += sum(one not in USV.task for one in titles)
        for record in records:
            plan = seen.record(record)["expected"]
            assert not plan_problems("mission", plan, seen.vocabulary, strict=True)
            assert len(plan["tasks"]) == len(record["expected"]["tasks"])
    assert renamed > 100


def test_home_and_the_unresolved_place_are_those_of_the_view() -> None:
    records = list(sample_missions(5, 30, USV))
    for seed in range(40):
        seen = view(USV, records, [USV], Random(seed))
        home, unresolved = (list(one) for one in (seen.vocabulary.home, seen.vocabulary.unresolved))
        if home == [0, 0] or unresolved == [-99, -99]:
            continue
        places = [
            value
            for record in records
            for task in seen.record(record)["expected"]["tasks"]
            for value in task["parameters"].values()
        ]
        assert home in places and unresolved in places
        assert [-99, -99] not in places
        return
    raise AssertionError("no view has another home and another unresolved place")


@pytest.fixture(scope="module")
def pack(tokenizer: Any) -> Any:
    records = list(sample_missions(3, 4, DRONE))
    return packed(DRONE, records, [DRONE], tokenizer, Random(1), 1024)


def test_a_packed_sample_is_computed_as_if_it_stood_alone(pack: Any, tokenizer: Any) -> None:
    from transformers import LlamaConfig, LlamaForCausalLM

    torch.manual_seed(0)
    sizes = {"hidden_size": 32, "intermediate_size": 64, "num_hidden_layers": 2}
    heads = {"num_attention_heads": 2, "num_key_value_heads": 2, "max_position_embeddings": 4096}
    register_attention()
    config = LlamaConfig(vocab_size=len(tokenizer), attn_implementation=CAUSAL, **sizes, **heads)
    model: Any = LlamaForCausalLM(config)
    row = parts_of(grid_of([], [pack, pack], 8192, seed=0))
    ids, _labels, positions, parts = map(torch.from_numpy, row)
    with torch.no_grad():
        given = {"input_ids": ids[None], "position_ids": positions[None], "parts": parts}
        found = model.model(**given, use_cache=False)[0]
        for number in (1, 3, len(pack) + 2):
            start, end = parts[number, :2].tolist()
            alone = np.concatenate([pack[0][0], pack[number % len(pack)][0]])
            expected = model.model(input_ids=torch.from_numpy(alone[None]), use_cache=False)[0]
            own = expected[0, len(pack[0][0]) :]
            torch.testing.assert_close(found[0, start:end], own, atol=1e-4, rtol=1e-3)


def test_answers_alone_are_learnt_and_ids_are_those_of_rendering(tokenizer: Any) -> None:
    records = list(sample_missions(9, 3, DRONE))
    rng = Random(4)
    pack = packed(DRONE, records, [DRONE], tokenizer, rng, 1024)
    seen = view(DRONE, records, [DRONE], Random(4))
    for (ids, prompt), record in zip(pack[1:], records, strict=True):
        rendered = render_sample(
            "mission", seen.record(record), tokenizer, seen.vocabulary, with_vocabulary=True
        )
        assert [*pack[0][0], *ids] == rendered.input_ids
        assert len(pack[0][0]) + prompt == rendered.prompt_length
    learnt = int((grid_of([], [pack], 8192, seed=0).labels != IGNORE).sum())
    assert learnt == sum(len(ids) - prompt for ids, prompt in pack[1:])


def test_a_shard_holds_its_packs(tokenizer: Any, tmp_path: Path) -> None:
    new_vehicle("mole", tmp_path / "mole")
    mixture = Mixture(0.5, folder=tmp_path, packs=0.2, own=0.5)
    counts = encode_shard(
        tmp_path / "a.npz", tokenizer, USV, seed=1, count=20, mixture=mixture, longest=1024
    )
    samples, packs = load_shard(tmp_path / "a.npz")
    assert len(samples) == counts["samples"] and len(packs) == counts["packs"] == 4
    assert all(prompt == len(ids) for ids, prompt in (pack[0] for pack in packs))
    assert grid_of([], packs, 8192, seed=0).tokens == sum(
        len(ids) for ids, _prompt in itertools.chain(*packs)
    )


def test_packs_are_drawn_from_commands_written_by_hand(tokenizer: Any) -> None:
    folder = Path("data/vehicles")
    robot = load_vocabulary(folder / "pool_cleaner" / "pool_cleaner.toml")
    own = (Path("data/mission/train.jsonl"),)
    written = written_commands(Mixture(folder=folder, commands=own), [DRONE, robot])
    assert [bool(records) for records in written] == [True, False, True]
    for share, by_hand in ((0.0, 0), (1.0, 5)):
        packs = draw_packs([USV, DRONE, robot], [1, 1, 1], tokenizer, 4, 1024, written, share)
        known = {record["prompt"] for records in written for record in records}
        texts = [
            [tokenizer.decode(ids[:prompt]) for ids, prompt in parts]
            for _vocabulary, *parts in itertools.islice(packs, 5)
        ]
        found = [any(one in text for text in pack for one in known) for pack in texts]
        assert sum(found) == by_hand


@pytest.mark.parametrize("path", sorted(Path("data/vehicles").glob("*/*.written.jsonl")), ids=str)
def test_commands_written_by_hand_have_valid_plans(path: Path) -> None:
    vehicle = load_vocabulary(path.with_name(path.name.replace(".written.jsonl", ".toml")))
    records = read_jsonl(path)
    assert len({record["id"] for record in records}) == len(records) == 25
    for record in records:
        assert plan_problems("mission", record["expected"], vehicle, strict=True) == []


def test_processes_share_the_packs_of_a_batch(pack: Any, tokenizer: Any) -> None:
    settings = PretrainSettings(hidden=32, layers=1, heads=2, feed_forward=64)
    model: Any = new_model(settings, len(tokenizer), {"bos": 1, "eos": 2, "pad": 0})
    grid = grid_of(pack[1:3], [pack, pack], 8192, seed=0)
    whole = completion_loss(model, model.model, grid).item()
    shares = [completion_loss(model, model.model, grid, rank, 2).item() for rank in range(2)]
    assert sum(shares) == pytest.approx(whole, rel=2e-3) and max(shares) < 0.9 * whole
