"""The tables: layout, units, published figures, stand-ins."""

from __future__ import annotations

import csv
import io
from dataclasses import replace
from typing import Any

from rich.console import Console

from planner_ft.benchmark.catalogue import METRICS
from planner_ft.benchmark.layout import print_results, published_rows
from planner_ft.benchmark.metrics.answers import FAILURES
from planner_ft.benchmark.results import Results, Row, System
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.tables import _counted, render_tables
from planner_ft.support.tables import Table, markdown_table, row


def results(
    *systems: System, vocabulary: str = "usv", level: Any = "mission", **changes: Any
) -> Results:
    figures = {name: Estimate(0.5, 0.25, 0.75) for name in METRICS} | {
        "tokens": Estimate(123.456, 100, 150),
        "latency_s": Estimate(0.345, 0.3, 0.4),
        "parameters": Estimate(None),
    }
    failures = dict.fromkeys(FAILURES, 1)
    rows = tuple(
        Row(
            **vars(system),
            n=25,
            metrics=figures,
            failures=failures,
            finish_reasons={"length": 2, "stop": 23},
            latency_n=25,
            **changes,
        )
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


def markdown(found: Results) -> str:
    return render_tables(found)["table.md"]


def rows_of(text: str) -> list[list[str]]:
    """The cells of the first table."""
    table = text.partition("\n\n")[0].splitlines()
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table]


def test_a_row_per_configuration_with_the_published_ones_below() -> None:
    text = markdown(results(BASE, LORA))
    heads, _rule, base, lora, *others = rows_of(text)
    assert heads[:5] == ["Model", "Configuration", "n", "F1 ↑", "Hallucination (%) ↓"]
    assert base[:2] == ["Llama-3.2-3B-Instruct", "Base"] and lora[1] == "LoRA"
    assert base[3:6] == ["0.50 [0.25, 0.75]", "50.0 [25.0, 75.0]", "50.0 [25.0, 75.0]"]
    assert others[0] == [
        *("*Llama-3.2-3B-Instruct (published)*", "Base", "25"),
        *("0.61", "0.0", "100.0", "–", "6.6", "198.4"),
    ]
    assert others[1][1:5] == ["LoRA", "25", "0.89", "4.0"]
    assert all(row[0].endswith("(published)*") for row in others)
    assert "not measured here" in text
    assert "2 of 25 outputs were cut" in text


def test_no_table_is_wider_than_a_page() -> None:
    systems = [
        System(f"c{index}", name, f"model {index}")
        for index in range(4)
        for name in ("base", "lora", "lora+state", "lora+grounded")
    ]
    lines = markdown(results(*systems, vocabulary="another")).splitlines()
    assert max(line.count("|") for line in lines) <= 12


def test_cells_are_whole_and_names_that_a_model_wrote_are_cut() -> None:
    heading, cell = "h" * 100, "c" * 100
    assert f"| {heading} | {cell} |" in markdown_table(Table("", ("",), [row(heading, cell)]))
    found = results(BASE)
    wrote = {"expected": "Transit", "predicted": "x" * 100, "n": 1}
    one = replace(found.rows[0], breakdown={"substitutions": [wrote]})
    assert _counted([one], "substitutions").rows[0].cells[0].text == "x" * 80 + "…"


def test_a_merged_model_is_no_base() -> None:
    text = markdown(results(System("merged", "base", "my model", pretrained=True, merged=True)))
    assert rows_of(text)[2][:2] == ["my model", "merged"]
    assert "my model has an adapter of the mission level folded in" in text
    assert "its Base figures" not in text


def test_stand_ins_are_marked_and_not_compared_with_published_figures() -> None:
    for text in render_tables(results(STANDIN)).values():
        assert "Qwen2.5-3B (stand-in)" in text
        assert "(published)" not in text
    mixed = markdown(results(STANDIN, BASE))
    assert [row[0] for row in rows_of(mixed)[2:5]] == [
        "Qwen2.5-3B (stand-in)",
        "Llama-3.2-3B-Instruct",
        "*Llama-3.2-3B-Instruct (published)*",
    ]
    assert "say nothing about the real candidate" in mixed


def test_another_vehicle_stands_beside_no_published_figures() -> None:
    assert "(published)" not in markdown(results(BASE, vocabulary="inspection_drone"))


def test_a_pretrained_candidate_is_said_to_be_one() -> None:
    assert "embedded was pretrained on synthetic plans" in markdown(
        results(System("embedded", "base", "embedded", pretrained=True))
    )


def test_predictions_of_outsiders_stand_beside_all_published_rows() -> None:
    rows = rows_of(markdown(results(System("mine", "submitted", "mine"))))
    assert rows[2][:2] == ["mine", "submitted"]
    assert [row[1] for row in rows[3:5]] == ["Base", "LoRA"] and len(rows) == 3 + 14


def test_the_csv_reads_back_in_percent() -> None:
    text = render_tables(results(BASE, LORA))["table.csv"]
    base, lora, theirs, other, *_rest = csv.DictReader(io.StringIO(text))
    assert (base["kind"], base["configuration"], base["f1"]) == ("measured", "Base", "0.5")
    assert (base["f1_low"], lora["schema_valid_high"], base["parameters"]) == ("0.25", "75", "")
    assert (theirs["kind"], theirs["configuration"]) == ("published", "Base")
    assert (other["hallucination"], other["tokens"]) == ("4", "472")
    assert len(_rest) == 12


def test_the_latex_table_is_balanced_and_escaped() -> None:
    text = render_tables(
        results(System("a_b&c", "base", "a_b&c 100%"), System("a_b&c", "lora", "a_b&c 100%"))
    )["table.tex"]
    assert "a\\_b\\&c 100\\%" in text
    body = [line for line in text.splitlines() if line.endswith("\\\\")]
    assert {line.count(" & ") for line in body} == {8}
    assert text.count("\\begin{tabular}") == text.count("\\end{tabular}") == 1
    assert "–" not in "".join(body)


def test_the_terminal_table_fits_80_columns() -> None:
    console = Console(width=80, record=True, file=io.StringIO())
    print_results(results(BASE, LORA), console)
    text = console.export_text()
    assert "…" not in text
    assert "25–75" in text and "brackets" not in text
    assert "0.61" in text and "(published)" in text


def test_published_figures_are_the_published_ones() -> None:
    mission, task = published_rows("mission"), published_rows("task")
    assert len(mission) == len(task) == 14
    assert mission[11].figure("hallucination").value == 0.32
    assert task[2].figure("schema_valid").value == 0.436
