"""Synthetic samples beside those of the training file."""

from __future__ import annotations

from pathlib import Path

from planner_ft.training.preflight import Prepared, run_preflight
from planner_ft.training.samples import Split
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, plan_problems

VOCABULARY = load_vocabulary()


def split(level: Level = "mission") -> Split:
    records = [{"id": "a", "prompt": "Go home."}]
    return Split(Path("train.jsonl"), level, VOCABULARY, records, "0" * 64)


def test_synthetic_samples_join_the_training_split_and_change_its_digest(ask) -> None:
    plain, mixed = Prepared(), Prepared()
    list(run_preflight(ask(), plain))
    found = list(run_preflight(ask(augment=5), mixed))
    assert mixed.train and plain.train and mixed.validation and plain.validation
    assert (len(plain.train.samples), len(mixed.train.samples)) == (8, 13)
    assert mixed.train.sha256 != plain.train.sha256 and len(mixed.validation.samples) == len(
        plain.validation.samples
    )
    assert any("5 of the training samples synthetic" in finding.text for finding in found)


def test_the_same_seed_gives_the_same_samples_and_another_seed_others() -> None:
    first, again, other = (split().augmented(seed, 6) for seed in (1, 1, 2))
    assert first.sha256 == again.sha256 != other.sha256
    assert len({record["id"] for record in first.records}) == 7 and first.records[0]["id"] == "a"


def test_both_levels_give_strictly_valid_plans() -> None:
    for level in LEVELS:
        records = split(level).augmented(0, 8).records[1:]
        assert len(records) == 8
        assert all(
            plan_problems(level, record["expected"], VOCABULARY, strict=True) == []
            for record in records
        )
