"""What enforcing changes, and figures per group."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.benchmark.contrasts import changes
from planner_ft.benchmark.figures import group_figures
from planner_ft.benchmark.tables import change_tables, group_tables
from planner_ft.support.tables import markdown_table


def shown(tables: Any) -> str:
    return "\n".join(map(markdown_table, tables))


def score(
    name: str, configuration: str, failure: str | None, f1: float, **more: Any
) -> dict[str, Any]:
    figures = {
        "exact_sequence": failure is None,
        "strict_valid": failure != "hallucination",
        "parameters_right": 1,
        "parameters_matched": 2,
    }
    return {
        "id": name,
        "family": name,
        "candidate": "c",
        "configuration": configuration,
        "failure": failure,
        "f1": f1,
        **figures,
        **more,
    }


SCORES = [
    score("a", "lora", "hallucination", 0.5, latency_s=2.0, group="noise"),
    score("b", "lora", None, 1.0, latency_s=2.0, group="noise"),
    score("a", "lora+schema", "substitution", 0.5, latency_s=1.0, group="noise"),
    score("b", "lora+schema", None, 1.0, latency_s=1.0, group="order"),
]


def test_an_invention_that_became_a_substitution_is_seen() -> None:
    (change,) = changes(SCORES, seed=0)
    assert (change["before"], change["after"], change["n"]) == ("lora", "lora+schema", 2)
    outcomes = {(one["before"], one["after"]): one["n"] for one in change["outcomes"]}
    assert outcomes == {("hallucination", "substitution"): 1, ("right", "right"): 1}
    assert change["f1"]["value"] == change["whole_plan"]["value"] == 0
    assert (change["seconds"], change["forward_passes"]) == (0.5, None)
    text = shown(change_tables([change]))
    assert (
        "| hallucination | substitution | 1 |" in text
        and "× 0.50" in text
        and "| right | right |" not in text
    )


def test_a_real_change_is_marked() -> None:
    scores = [
        score(f"s{index}", name, failure, f1)
        for index in range(9)
        for name, failure, f1 in (("base", "omission", 0.2), ("base+state", None, 1.0))
    ]
    (change,) = changes(scores, seed=0)
    # Nine samples, all one way: p = 2 / 2**9, twice that after Holm.
    assert change["p_adjusted"] == pytest.approx([4 / 2**9, 4 / 2**9])
    assert "+0.800 [+0.800, +0.800] ▲ | +100.0 [+100.0, +100.0] ▲" in shown(change_tables([change]))
    assert change["f1"] == {
        "value": pytest.approx(0.8),
        "low": pytest.approx(0.8),
        "high": pytest.approx(0.8),
    }


def test_only_samples_that_both_answered_are_paired() -> None:
    (change,) = changes(SCORES[:3], seed=0)
    assert change["n"] == 1


def test_an_enforced_configuration_alone_has_nothing_to_stand_against() -> None:
    assert changes(SCORES[2:], seed=0) == [] and list(change_tables([])) == []


def test_figures_per_group() -> None:
    noise = next(
        entry
        for entry in group_figures(SCORES)
        if entry["group"] == "noise" and entry["configuration"] == "lora"
    )
    assert (
        noise["n"] == 2
        and noise["f1"] == pytest.approx(0.75)
        and noise["whole_plan"] == 0.5
        and noise["parameters"] == 0.5
    )
    assert "| noise | c, lora | 2 | 0.75 | 50 | 50 | 50 | 50 |" in shown(
        group_tables(group_figures(SCORES))
    )
    assert group_figures([score("a", "lora", None, 1.0)]) == [] and list(group_tables([])) == []
