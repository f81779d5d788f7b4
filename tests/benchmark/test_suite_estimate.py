"""The time left: nothing is claimed before something was measured, and what is claimed holds."""

from __future__ import annotations

import itertools

import pytest

from planner_ft.benchmark.suite.estimate import Pace, Work, time_left

SIZES = {"small": 1_000_000, "large": 3_000_000}
SECONDS = {"answers": 2.0, "latency": 5.0}
LOADING = 30.0


def true_seconds(work: Work) -> float:
    """Of a machine whose time is in proportion to the candidate's size; lora takes half of base."""
    return (
        SECONDS[work.kind]
        * SIZES[work.candidate]
        / 1e6
        * (0.5 if work.configuration == "lora" else 1)
    )


def queue() -> list[tuple[str, list[Work]]]:
    """Processes by candidate, with their queries."""
    parts = [("mission", 25), ("task", 50)]
    return [
        (
            name,
            [
                Work(name, level, configuration, kind, count, SIZES[name])
                for configuration in ("base", "lora")
                for kind in ("answers", "latency")
            ],
        )
        for name, (level, count) in itertools.product(SIZES, parts)
    ]


def test_nothing_is_claimed_before_anything_was_measured() -> None:
    assert time_left(Pace(), [Work("small", "mission", "base", "answers", 3)], ["small"]) is None


def test_nothing_left_takes_no_time() -> None:
    assert time_left(Pace(), [Work("small", "mission", "base", "answers", 0)], []) == 0


def test_an_eta_holds_from_the_second_process_on() -> None:
    pace, left = Pace(), queue()
    while left:
        candidate, works = left.pop(0)
        pace.add_overhead(candidate, LOADING)
        for work in works:
            pace.add(work, true_seconds(work) * work.count)
        rest = [work for _candidate, works in left for work in works]
        truth = sum(true_seconds(work) * work.count for work in rest) + LOADING * len(left)
        if len(left) <= 2:
            # Both levels of the small candidate were measured: the large one's time follows from
            # its size.
            assert time_left(pace, rest, [name for name, _works in left]) == pytest.approx(truth)


def test_the_own_pace_counts_for_more_than_that_of_others() -> None:
    pace = Pace()
    pace.add(Work("small", "mission", "base", "answers", 10, SIZES["small"]), 10.0)
    pace.add(Work("large", "mission", "base", "answers", 10, SIZES["large"]), 100.0)
    assert (
        pace.seconds_per_query(Work("small", "mission", "base", "answers", 0, SIZES["small"]))
        == 1.0
    )
    assert (
        pace.seconds_per_query(Work("large", "mission", "lora", "answers", 0, SIZES["large"]))
        == 10.0
    )


def test_a_candidate_of_unknown_size_gets_the_pace_of_the_others() -> None:
    pace = Pace()
    pace.add(Work("small", "mission", "base", "answers", 4, SIZES["small"]), 8.0)
    assert pace.seconds_per_query(Work("folder", "mission", "base", "answers")) == 2.0
