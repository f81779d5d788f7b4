"""The tables: layout, units, published figures, stand-ins."""

from __future__ import annotations

import csv
import io
from typing import Any

from rich.console import Console

from planner_ft.benchmark.published import published_rows
from planner_ft.benchmark.results import Results, Row, System
from planner_ft.benchmark.scoring import METRICS
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.tables import csv_table, latex, markdown
from planner_ft.benchmark.terminal import print_results


def results(
    *systems: System, vocabulary: str = "usv", level: Any = "mission", **changes: Any
) -> Results:
    figures = {name: Estimate(0.5, 0.25, 0.75) for name in METRICS} | {
        "tokens": Estimate(123.456, 100, 150),
        "latency_s": Estimate(0.345, 0.3, 0.4),
        "parameters": Estimate(None),
    }
    failures = dict.fromkeys(
        (
            "prerequisite omission",
            "parameter propagation",
            "substitution",
            "hallucination",
            "omission",
            "extra step",
            "wrong order",
            "invalid output",
        ),
        1,
    )
    rows = tuple(
        Row(system, 25, figures, failures, {"length": 2, "stop": 23}, latency_n=25, **changes)
        for system in systems
    )
    return Results(
        level,
        {"path": "d.jsonl", "sha256": "0" * 64, "n": 25},
        rows,
        {"configuration": {"vocabulary": {"name": vocabulary}}},
    )


BASE = System(
    "Llama-3.2-3B-Instruct", "base", "Llama-3.2-3B-Instruct", published="Llama-3.2-3B-Instruct"
)
LORA = System(
    "Llama-3.2-3B-Instruct", "lora", "Llama-3.2-3B-Instruct", published="Llama-3.2-3B-Instruct"
)
STANDIN = System(
    "Qwen2.5-3B", "base", "Qwen2.5-3B (stand-in)", published="Qwen2.5-3B", is_standin=True
)


def cells(text: str, model: str) -> list[str]:
    line = next(line for line in text.splitlines() if line.startswith(f"| {model} |"))
    return [cell.strip() for cell in line.strip("|").split("|")]


def test_base_and_lora_stand_side_by_side_with_the_published_row_below() -> None:
    text = markdown(results(BASE, LORA))
    assert text.splitlines()[0].startswith(
        "| Model | n | F1 ↑ Base | F1 ↑ LoRA | Hallucination (%) ↓ Base | Hallucination (%) ↓ LoRA"
        " | Schema valid (%) ↑ Base"
    )
    assert (
        cells(text, "Llama-3.2-3B-Instruct")[2:8]
        == ["0.50 [0.25, 0.75]"] * 2 + ["50.0 [25.0, 75.0]"] * 4
    )
    published = cells(text, "Llama-3.2-3B-Instruct (published)")
    assert published[2:8] == ["0.61", "0.89", "0.0", "4.0", "100.0", "100.0"]
    assert published[8:] == ["–", "–", "6.6", "18.7", "198.4", "472.0"]
    models = [line.split("|")[1].strip() for line in text.splitlines()[2:10]]
    assert models[:2] == ["Llama-3.2-3B-Instruct", "Llama-3.2-3B-Instruct (published)"]
    assert all(model.endswith("(published)") for model in models[1:])
    assert "not measured here" in text
    assert "2 of 25 outputs were cut" in text


def test_stand_ins_are_marked_and_not_compared_with_published_figures() -> None:
    for render in (markdown, csv_table, latex):
        text = render(results(STANDIN))
        assert "Qwen2.5-3B (stand-in)" in text
        assert "(published)" not in text
    mixed = markdown(results(STANDIN, BASE))
    models = [line.split("|")[1].strip() for line in mixed.splitlines()[2:6]]
    assert models[:3] == [
        "Qwen2.5-3B (stand-in)",
        "Llama-3.2-3B-Instruct",
        "Llama-3.2-3B-Instruct (published)",
    ]
    assert "say nothing about the real candidate" in mixed


def test_another_vehicle_stands_beside_no_published_figures() -> None:
    assert "(published)" not in markdown(results(BASE, vocabulary="inspection_drone"))


def test_a_pretrained_candidate_is_said_to_be_one() -> None:
    assert "embedded was pretrained on synthetic plans" in markdown(
        results(System("embedded", "base", "embedded", pretrained=True))
    )


def test_predictions_of_outsiders_get_a_column_beside_the_published_ones() -> None:
    header = markdown(results(System("mine", "submitted", "mine"))).splitlines()[0]
    assert "| F1 ↑ Base | F1 ↑ LoRA | F1 ↑ submitted |" in header


def test_the_csv_reads_back_in_percent() -> None:
    rows = list(csv.DictReader(io.StringIO(csv_table(results(BASE, LORA)))))
    assert (
        rows[0]["source"],
        rows[0]["f1_base"],
        rows[0]["f1_base_low"],
        rows[0]["schema_valid_lora_high"],
    ) == ("measured", "0.5", "0.25", "75")
    assert rows[0]["parameters_base"] == ""
    assert (rows[1]["source"], rows[1]["hallucination_lora"], rows[1]["tokens_lora"]) == (
        "published",
        "4",
        "472",
    )
    assert len(rows) == 8


def test_the_latex_table_is_balanced_and_escaped() -> None:
    text = latex(
        results(System("a_b&c", "base", "a_b&c 100%"), System("a_b&c", "lora", "a_b&c 100%"))
    )
    assert "a\\_b\\&c 100\\%" in text
    body = [
        line for line in text.splitlines() if line.endswith("\\\\") and "multicolumn" not in line
    ]
    assert {line.count(" & ") for line in body} == {12}
    assert text.count("\\begin{tabular}") == text.count("\\end{tabular}") == 1
    assert "–" not in "".join(body)


def test_the_terminal_table_fits_80_columns() -> None:
    console = Console(width=80, record=True, file=io.StringIO())
    print_results(results(BASE, LORA), console)
    text = console.export_text()
    assert "…" not in text
    assert "25–75" in text
    assert "0.61/0.89" in text


def test_published_figures_are_the_published_ones() -> None:
    mission, task = published_rows("mission"), published_rows("task")
    assert len(mission) == len(task) == 7
    assert mission[5].figures["hallucination", "lora"] == 0.32
    assert task[1].figures["schema_valid", "base"] == 0.436
