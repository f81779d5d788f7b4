"""The tables of `skill bench`."""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from torch import nn

from planner_ft.cli import main
from planner_ft.skills import bench
from planner_ft.skills.bench import (
    CONDITIONS,
    SkillBench,
    bench_skill,
    class_table,
    condition_table,
    pooled,
)
from planner_ft.skills.episodes import Episode
from planner_ft.skills.policies import SHIPPED, Policy
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json
from planner_ft.support.tables import markdown_table


def _figures(number: int) -> tuple[float, int, float, int]:
    return 0.2 * (number + 1), 100, 9.0, number


def episodes(wins: int, family: str = "L") -> list[Episode]:
    return [
        Episode(family, "success" if number < wins else "collision", *_figures(number))
        for number in range(4)
    ]


def test_rows_are_shares_and_means_of_episodes() -> None:
    circles = [replace(one, number=one.number + 4) for one in episodes(4, "circle")]
    played = {"ours": {name: [*episodes(3), *circles] for name in CONDITIONS}}
    rows = {one.heading: one for one in class_table(played, 0).rows}
    texts = {name: [cell.text for cell in one.cells] for name, one in rows.items()}
    assert texts["all"][:0] == []
    ours = [one for one in class_table(played, 0).rows if one.kind == "measured"]
    assert [(one.heading, one.cells[0].text, one.cells[1].text) for one in ours] == [
        ("L", "75", "25"),
        ("circle", "100", "0"),
        ("all", "88", "12"),
    ]
    assert ours[0].cells[3].text == "0.50" and ours[0].cells[4].text == "100"
    by_condition = condition_table(played, 0)
    assert sum(one.kind == "section" for one in by_condition.rows) == len(CONDITIONS) == 6


def test_seeds_of_one_training_are_pooled(tmp_path: Path) -> None:
    policies, played = [], {}
    for number, (seed, without) in enumerate([(0, None), (1, None), (0, "progress")]):
        configuration = {"recipe": "published", "sampling": "l3", "without": without, "seed": seed}
        write_json(tmp_path / str(number) / "manifest.json", {"configuration": configuration})
        where = tmp_path / str(number) / "policy.safetensors"
        policies.append(Policy("survey", "published", nn.Identity(), {}, where))
        played[f"learnt, {where.parent}"] = {"calm": episodes(number), "current": episodes(0)}
    bare = Policy(
        "survey", "published", nn.Identity(), {}, tmp_path / "bare" / "policy.safetensors"
    )
    found = pooled([*policies, policies[0], bare], played)
    assert list(found) == ["learnt, published, l3, 2 seeds"]
    assert found["learnt, published, l3, 2 seeds"]["calm"] == [*episodes(0), *episodes(1)]


def test_seeds_with_the_same_objects_make_no_interval_narrower() -> None:
    one, two = (
        condition_table({"ours": {name: times * episodes(3) for name in CONDITIONS}}, 0).rows[1]
        for times in (1, 2)
    )
    assert one.cells[3:] == two.cells[3:]
    for first, second in zip(one.cells[:3], two.cells[:3], strict=True):
        narrow, wide = (np.diff(np.array(cell.bounds, float))[1:] for cell in (first, second))
        assert (wide >= narrow - 1e-9).all()


def test_published_figures_stand_beside() -> None:
    text = markdown_table(class_table({"ours": {name: episodes(4) for name in CONDITIONS}}, 0))
    assert "published: uniform" in text and "| 35 | 65 | 0 | 1.10 | 357 |" in text
    assert "published: without the progress term" in text


def test_a_bench_writes_table_episodes_and_manifest(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    conditions = {"published conditions": (("circle",), CONDITIONS["published conditions"][1])}
    monkeypatch.setattr(bench, "CONDITIONS", conditions)
    out = tmp_path / "bench"
    goto = tmp_path / "goto"
    shutil.copytree(SHIPPED / "goto", goto)
    request = SkillBench("survey", episodes=1, out=out, goto=goto)
    tables = bench_skill(request, lambda _label, _done, _total: None)
    assert len(tables) == 2
    digest = sha256_file(goto / "policy.safetensors")
    assert read_json(out / "manifest.json")["configuration"]["goto"] == {str(goto): digest}
    assert f"GoToXY: {goto}, sha256 {digest[:12]}." in tables[0].caption
    written = {path.name for path in out.iterdir()}
    assert written == {
        *("table.md", "classes.csv", "conditions.csv", "episodes.json", "manifest.json")
    }
    text = (out / "table.md").read_text(encoding="utf-8")
    for name in ("learnt, shipped", "contour follower, guidance and PID", "oracle: offset path"):
        assert name in text
    with pytest.raises(PlannerError, match="holds files; give --overwrite"):
        SkillBench("survey", episodes=1, out=out)
    assert SkillBench("goto", out=out, overwrite=True)


def test_a_bench_names_what_it_writes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "bench"
    words = "plannerft", "skill", "bench", "goto", "--episodes", "2", "--out", str(out)
    monkeypatch.setattr(sys, "argv", list(words))
    with pytest.raises(SystemExit, match="0"):
        main()
    said = capsys.readouterr().out.replace("\n", " ").split("bench: ")[-1]
    assert said.strip() == "table.md, goto.csv and manifest.json"
    assert {path.name for path in out.iterdir()} == {"table.md", "goto.csv", "manifest.json"}


@pytest.mark.parametrize(
    ("files", "named"),
    [
        ({"policy.safetensors": "", "manifest.json": '{"kind": "skill"}'}, "policy.safetensors"),
        ({"manifest.json": '{"kind": "simulation"}', "table.md": ""}, "manifest.json"),
        ({"table.md": "mine"}, "table.md"),
        ({"thesis.txt": "mine", "manifest.json": '{"kind": "skill bench"}'}, "thesis.txt"),
    ],
)
def test_a_folder_of_other_files_is_never_replaced(
    files: dict[str, str], named: str, tmp_path: Path
) -> None:
    for name, text in files.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    with pytest.raises(PlannerError, match=f"holds {named}, which is not of a bench"):
        SkillBench("goto", out=tmp_path, overwrite=True)


def test_bad_numbers_are_refused() -> None:
    with pytest.raises(PlannerError, match="--episodes 0"):
        SkillBench("goto", episodes=0)
    with pytest.raises(PlannerError, match="swim: must be one of"):
        SkillBench("swim")
