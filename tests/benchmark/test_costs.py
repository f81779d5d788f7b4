"""Cost figures against cases computed by hand."""

from __future__ import annotations

import pytest

from planner_ft.benchmark.figures import cost_figures
from planner_ft.benchmark.runner import MOST, planning_command
from planner_ft.benchmark.statistics import quantile
from planner_ft.benchmark.tables import cost_tables
from planner_ft.support.tables import markdown_table


@pytest.mark.parametrize(
    ("values", "share", "expected"),
    [
        ([3, 1, 2], 0.5, 2),
        ([4, 1, 3, 2], 0.5, 2),
        (range(1, 11), 0.9, 9),
        (range(1, 101), 0.99, 99),
        (range(1, 26), 0.99, 25),
        ([7], 0.99, 7),
    ],
)
def test_a_quantile_is_the_smallest_value_that_its_share_does_not_exceed(
    values: list[float], share: float, expected: float
) -> None:
    assert quantile(list(values), share).value == expected


def test_the_bounds_of_a_median_are_those_of_the_sign_test() -> None:
    # Table of the sign test: for n = 20 the 6th and the 15th value, for n = 10 the 2nd and the 9th;
    # below 6 values there are none.
    assert (quantile(range(1, 21), 0.5).low, quantile(range(1, 21), 0.5).high) == (6, 15)
    assert (quantile(range(1, 11), 0.5).low, quantile(range(1, 11), 0.5).high) == (2, 9)
    assert (quantile(range(1, 6), 0.5).low, quantile(range(1, 6), 0.5).high) == (None, None)


def test_25_queries_give_no_upper_bound_for_the_99th_percentile() -> None:
    found = quantile(range(1, 26), 0.99)
    assert found.high is None
    assert found.low is not None
    assert quantile(range(1, 501), 0.99).high is not None


def test_figures_of_timed_queries() -> None:
    timed = {
        f"q{index}": {"latency_s": seconds, "first_token_s": seconds / 10, "tokens": tokens}
        for index, (seconds, tokens) in enumerate([(1.0, 10), (2.0, 20), (3.0, 60)])
    }
    found = cost_figures(
        timed,
        {},
        {"load_s": 4.5, "peak_memory_bytes": 2**30, "adapter_swap_s": None, "other": 1},
        [],
        seed=0,
    )
    assert [found["latency_s"][name]["value"] for name in ("median", "p90", "p99")] == [2, 3, 3]
    assert found["first_token_s"]["value"] == pytest.approx(0.2)
    # All tokens over all seconds, not the mean of ratios.
    assert found["tokens_per_s"]["value"] == pytest.approx(15)
    assert {
        name: found.get(name)
        for name in ("load_s", "peak_memory_bytes", "n", "adapter_swap_s", "other")
    } == {"load_s": 4.5, "peak_memory_bytes": 2**30, "n": 3, "adapter_swap_s": None, "other": None}
    assert cost_figures({}, {}, {}, [], seed=0) == {}


def test_planning_time_goes_by_the_tasks_that_were_planned() -> None:
    lines = [
        {"id": "a", "tasks": 1, "seconds": 1.0, "mission_s": 0.5, "task_s": 0.4},
        {"id": "b", "tasks": 3, "seconds": 3.0, "mission_s": 1.0, "task_s": 2.0},
        {"id": "c", "tasks": 3, "seconds": 5.0, "mission_s": 2.0, "task_s": 3.0},
        {"id": "d", "tasks": None, "seconds": 9.0, "mission_s": 9.0, "task_s": 0.0},
    ]
    found = cost_figures({}, {}, {}, lines, seed=0)["planning"]
    assert [
        (entry["tasks"], entry["n"], entry["seconds"]["value"], entry["mission_s"], entry["task_s"])
        for entry in found
    ] == [(1, 1, 1.0, 0.5, 0.4), (3, 2, 4.0, 1.5, 2.5)]
    text = "\n".join(map(markdown_table, cost_tables({"embedded, Base": {"planning": found}})))
    assert "| embedded, Base | 1.00 (n = 1) | – | 4.00 (n = 2) |" in text


def test_commands_ask_for_as_many_tasks_as_they_are_named_after() -> None:
    for tasks in range(1, MOST + 1):
        commands = [planning_command(tasks, variant) for variant in range(4)]
        assert len(set(commands)) == 4
        assert all(
            command.lower().count("go to") + command.lower().count("keep station") == tasks
            for command in commands
        )
    assert (
        planning_command(3, 0)
        == "Go to (40, 10), then keep station there for 90 seconds, then go to (-35, 60)."
    )


def test_what_was_not_measured_has_no_table() -> None:
    assert list(cost_tables({})) == []
