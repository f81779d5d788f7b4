"""The leakage report finds what was planted, and nothing else."""

from __future__ import annotations

import random
from typing import Any

import pytest

from planner_ft.data.leakage import leakage_report, mask, nearest_neighbour, set_f1

WORDS = (
    *(
        "hold",
        "the",
        "barge",
        "near",
        "quay",
        "while",
        "filming",
        "its",
        "port",
        "side",
        "with",
        "both",
        "cameras",
        "until",
        "dusk",
    ),
    *("then", "report", "home", "slowly", "by", "way", "of", "inner", "channel", "markers"),
)


def record(
    number: int, prompt: str, titles: tuple[str, ...] = ("KeepStation",), family: str = "f"
) -> dict[str, Any]:
    return {
        "id": str(number),
        "family": family,
        "prompt": prompt,
        "expected": {"tasks": [{"title": title, "parameters": {}} for title in titles]},
    }


def prompts(count: int, seed: int) -> list[str]:
    rng = random.Random(seed)
    return [" ".join(rng.choices(WORDS, k=18)) for _ in range(count)]


def overlap(report: dict[str, Any], split: str, other: str) -> dict[str, Any]:
    return next(
        item for item in report["overlaps"] if (item["split"], item["other"]) == (split, other)
    )


def test_exact_and_near_duplicates_are_counted() -> None:
    train = prompts(300, 1)
    test = prompts(40, 2)
    test[0] = train[7].upper()
    test[1] = train[8] + " please"
    report = leakage_report(
        "mission",
        {
            "train": [record(n, p) for n, p in enumerate(train)],
            "test": [record(n, p, family="g") for n, p in enumerate(test)],
        },
    )
    found = overlap(report, "test", "train")
    assert (found["exact"], found["near"], found["families"]) == (1, 2, 0)
    assert set(found["examples"]) == {("0", "7"), ("1", "8")}
    assert report["duplicates_within"] == {"train": 0, "test": 0}


def test_masked_duplicates_are_counted_apart() -> None:
    train = [
        record(
            0,
            "Please circle the platform Hilda at [10, 20] fifteen metres off and then report back"
            " to Trongate 3.",
        )
    ]
    test = [
        record(
            1,
            "Please circle the platform Marit at [-45, 7] twelve metres off and then report back to"
            " Skarv 12.",
        )
    ]
    found = overlap(leakage_report("mission", {"train": train, "test": test}), "test", "train")
    assert (found["exact"], found["near"], found["exact_masked"], found["near_masked"]) == (
        0,
        0,
        1,
        1,
    )


def test_masking_keeps_the_phrasing_alone() -> None:
    assert mask("Circle Hilda at [10, 20], then KX-07.") == mask(
        "Circle Brave Tern at [3, -4.5], then PQ-19."
    )
    assert mask("Hold for ten minutes.") == mask("Hold for 25 minutes.")
    assert mask("Hold here.") != mask("Stay here.")


def test_a_memory_test_is_called_one() -> None:
    train = [
        record(n, p, ("Transit",) if n % 2 else ("KeepStation",))
        for n, p in enumerate(prompts(100, 3))
    ]
    report = leakage_report(
        "mission",
        {"train": train, "test": train[:20], "validation": [record(1, "go", ("Diagnostics",))]},
    )
    assert report["memory_test"] == {"test": True, "validation": False}
    assert next(item for item in report["baseline"] if item["split"] == "test")["sequence"] == 1


def test_the_baseline_answers_with_the_nearest_plan() -> None:
    train = [
        record(0, "circle the buoy twice", ("Transit", "PerformOrbit")),
        record(1, "hold still at the quay", ("KeepStation",)),
    ]
    test = [
        record(2, "circle that buoy", ("Transit", "PerformOrbit")),
        record(3, "hold at the quay", ("Transit", "KeepStation")),
    ]
    baseline = nearest_neighbour("mission", "test", train, test)
    assert (baseline["f1"], baseline["sequence"]) == (pytest.approx((1 + 2 / 3) / 2, abs=1e-4), 0.5)


def test_f1_of_two_empty_sets_is_one() -> None:
    assert (set_f1([], []), set_f1(["a"], []), set_f1(["a", "a"], ["a"])) == (1, 0, 1)
