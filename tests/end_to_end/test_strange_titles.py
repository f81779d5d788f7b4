"""Vehicles whose titles are strange: templates, checks and every strength take them as any other."""

from __future__ import annotations

import itertools
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest
from transformers import AutoTokenizer

import planner_ft.candidates
from planner_ft.data.missions import sample_missions
from planner_ft.decoding.constraints.answer import constraint_factory
from planner_ft.document.own_vehicle import check_vehicle, new_vehicle
from planner_ft.prompts import answer_text, end_of_turn_ids
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems

TITLES = ("SelfCheck", "DriveTo", "Wait", "LookAround", "Find", "Report")
STRANGE = {
    "one letter": ("A", "B", "C", "D", "E", "F"),
    "German": ("Prüfe-Gerät", "Fahre_zu", "Warte", "Schau um Größe", "Süche", "Übermittle Bericht"),
    "contained": ("Go", "GoTo", "GoToPoint", "GoToPointAround", "To", "ToPoint"),
    "codes": ("T1", "T10", "T100", "RTL", "nav.wp-2", "WP"),
}


def strange(folder: Path, titles: Mapping[str, str], more: int = 0) -> Path:
    """The skeleton's vehicle with other titles, and `more` copies of its task that reports."""
    for path in new_vehicle("my_rover", folder):
        text = path.read_text(encoding="utf-8")
        if path.name == "my_rover.toml":
            block = re.search(r"\[\[task\]\]\ntitle = \"Report\".*?(?=\[\[)", text, re.S)
            assert block
            copies = [block[0].replace("Report", f"Report{at}") for at in range(more)]
            text = text.replace(block[0], block[0] + "".join(copies))
        for old, new in titles.items():
            # A name with other signs than A-Z is quoted, in TOML and in the steps of a template.
            key = new if re.fullmatch(r"\w+", new, re.ASCII) else f'"{new}"'
            step = key.replace('"', '\\"') if path.name.endswith("commands.jsonl") else key
            text = text.replace(f'"{old}"', f'"{new}"').replace(f"task.{old}]", f"task.{key}]")
            text = (
                re.sub(rf'(?<=[ "+&]){old}(?=[ ;"?])(?!\w)', step, text)
                if "jsonl" in path.name and "commands" in path.name
                else text
            )
        path.write_text(text, encoding="utf-8")
    return folder / "my_rover.toml"


def check(path: Path) -> None:
    wrong = [str(part) for part in check_vehicle(str(path)) if part.state == "wrong"]
    assert wrong == []
    vocabulary = load_vocabulary(str(path))
    tokenizer = AutoTokenizer.from_pretrained(
        Path(planner_ft.candidates.__file__).parent / "embedded"
    )
    ends = tuple(end_of_turn_ids(tokenizer))
    records: list[Any] = list(itertools.islice(sample_missions(3, 30, vocabulary), 30))
    for strength in ("schema", "state", "grounded"):
        factory = constraint_factory(
            tokenizer, "mission", vocabulary, strength, end_ids=ends, limit=1024
        )
        for record in records:
            assert plan_problems("mission", record["expected"], vocabulary, strict=True) == []
            ids = tokenizer.encode(
                answer_text("mission", record, vocabulary), add_special_tokens=False
            )
            constraint = factory.start(record, 4096)
            for token in ids:
                constraint.accept(token)


@pytest.mark.parametrize("kind", STRANGE)
def test_titles_of_any_kind(kind: str, tmp_path: Path) -> None:
    check(strange(tmp_path / "rover", dict(zip(TITLES, STRANGE[kind], strict=True))))


def test_sixty_titles(tmp_path: Path) -> None:
    path = strange(tmp_path / "rover", {}, more=54)
    assert len(load_vocabulary(str(path)).tasks) == 60
    check(path)
