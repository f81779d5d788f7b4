"""The folder of a report, and the command that writes it."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from typer.testing import CliRunner

from planner_ft.cli.app import app
from planner_ft.report.write import write_report
from planner_ft.support.errors import PlannerError


def contents(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def test_the_same_run_gives_the_same_bytes(run: Path, tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_report([run], tmp_path / name, title="Report", pictures="none")
    assert contents(tmp_path / "one") == contents(tmp_path / "two")


def test_figures_become_files(run: Path, tmp_path: Path) -> None:
    written = write_report([run], tmp_path / "report", pictures="overall")
    names = {path.name.split("-", 3)[3] for path in written if path.parent.name == "figures"}
    assert names == {f"{kind}.{suffix}" for kind in ("f1", "failures", "stops", "latency", "latency-by-size") for suffix in ("png", "svg")}
    assert all(path.stat().st_size > 1000 for path in written if path.parent.name == "figures")


def test_the_main_table_holds_the_figures_of_every_system(run: Path, tmp_path: Path) -> None:
    write_report([run], tmp_path / "report", pictures="none")
    (path,) = (tmp_path / "report" / "tables").glob("*-main.csv")
    rows = {row["System"]: row for row in csv.DictReader(path.open(encoding="utf-8"))}
    assert rows["good, Base"]["F1 ↑"] == "1"
    assert float(rows["good, Base"]["Whole plan right (%) ↑"]) == 75
    assert rows["Llama-3.2-3B-Instruct, LoRA (published)"]["F1 ↑"] == "0.89"
    assert rows["Llama-3.2-3B-Instruct, LoRA (published)"]["kind"] == "published"
    for suffix in ("md", "tex"):
        assert "good, Base" in path.with_suffix(f".{suffix}").read_text()


def test_published_figures_stand_beside_the_test_split_alone(run: Path, data: Path, tmp_path: Path) -> None:
    renamed = data.with_name("challenge.jsonl")
    data.rename(renamed)
    (run / "results.json").write_text((run / "results.json").read_text().replace("test.jsonl", "challenge.jsonl"))
    write_report([run], tmp_path / "report", pictures="none")
    (path,) = (tmp_path / "report" / "tables").glob("*-main.md")
    assert "published" not in path.read_text()


def test_a_report_is_not_overwritten_unasked_and_files_of_the_user_stay(run: Path, tmp_path: Path) -> None:
    out = tmp_path / "report"
    write_report([run], out, pictures="none")
    (out / "figures").mkdir()
    own, former = out / "figures" / "my-drawing.png", out / "figures" / "mission-test-aaaaaa-f1.png"
    own.write_bytes(b"mine")
    former.write_bytes(b"of an earlier run")
    with pytest.raises(PlannerError, match=r"report\.html: a report is there already; give --overwrite"):
        write_report([run], out)
    write_report([run], out, overwrite=True, pictures="none")
    assert own.read_bytes() == b"mine"
    assert not former.exists()


def test_the_command_writes_into_the_run_and_says_what(run: Path) -> None:
    done = CliRunner().invoke(app, ["report", str(run), "--pictures", "none"])
    assert done.exit_code == 0, done.output
    assert "report.html" in done.output
    assert (run / "report.html").is_file()


def test_an_unknown_choice_of_pictures_is_refused(run: Path) -> None:
    failed = CliRunner().invoke(app, ["report", str(run), "--pictures", "some"])
    assert "--pictures some: must be all, overall or none" in str(failed.exception)


def test_several_runs_need_a_folder_for_the_report(run: Path, tmp_path: Path) -> None:
    failed = CliRunner().invoke(app, ["report", str(run), str(run)])
    assert isinstance(failed.exception, PlannerError)
    assert "--out is missing" in str(failed.exception)
