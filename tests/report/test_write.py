"""The folder of a report, and the command that writes it."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest
from typer.testing import CliRunner

from planner_ft.benchmark.folder import write_results
from planner_ft.benchmark.metrics.answers import FAILURES
from planner_ft.benchmark.results import Results, Row
from planner_ft.benchmark.samples import load_bench_data
from planner_ft.benchmark.submission import score_predictions
from planner_ft.cli.app import app
from planner_ft.report.write import report_beside, write_report
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def test_the_same_run_gives_the_same_bytes(run: Path, tmp_path: Path) -> None:
    for name in ("one", "two"):
        write_report([run], tmp_path / name, title="Report", pictures="none")
    assert contents(tmp_path / "one") == contents(tmp_path / "two")


def test_figures_become_files(run: Path, tmp_path: Path) -> None:
    written = write_report([run], tmp_path / "report", pictures="overall")
    names = {path.name.split("-", 3)[3] for path in written if path.parent.name == "figures"}
    assert names == {
        f"{kind}.{suffix}"
        for kind in ("f1", "failures", "stops", "latency", "latency-by-size")
        for suffix in ("png", "svg")
    }
    assert all(path.stat().st_size > 1000 for path in written if path.parent.name == "figures")


def test_the_main_table_holds_the_figures_of_every_system(run: Path, tmp_path: Path) -> None:
    write_report([run], tmp_path / "report", pictures="none")
    (path,) = (tmp_path / "report" / "tables").glob("*-main.csv")
    rows = {(row["Model"], row["Configuration"]): row for row in csv.DictReader(path.open("r"))}
    assert rows["good", "Base"]["F1 ↑"] == "1"
    assert float(rows["good", "Base"]["Whole plan right (%) ↑"]) == 75
    published = rows["Llama-3.2-3B-Instruct (published)", "Base"]
    assert published["F1 ↑"] and published["kind"] == "published"
    for suffix in ("md", "tex"):
        assert "good" in path.with_suffix(f".{suffix}").read_text()


def test_published_figures_stand_beside_the_test_split_alone(
    run: Path, data: Path, tmp_path: Path
) -> None:
    renamed = data.with_name("challenge.jsonl")
    data.rename(renamed)
    (run / "results.json").write_text(
        (run / "results.json").read_text().replace("test.jsonl", "challenge.jsonl")
    )
    write_report([run], tmp_path / "report", pictures="none")
    (path,) = (tmp_path / "report" / "tables").glob("*-main.md")
    assert "published" not in path.read_text()


def test_a_report_is_not_overwritten_unasked_and_files_of_the_user_stay(
    run: Path, tmp_path: Path
) -> None:
    out = tmp_path / "report"
    write_report([run], out, pictures="none")
    (out / "figures").mkdir()
    own, former = out / "figures" / "my-drawing.png", out / "figures" / "mission-test-aaaaaa-f1.png"
    own.write_bytes(b"mine")
    former.write_bytes(b"of an earlier run")
    with pytest.raises(
        PlannerError, match=r"report\.html: a report is there already; give --overwrite"
    ):
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


def test_a_failing_report_is_said_and_loses_nothing(run: Path) -> None:
    (run / "scores.jsonl").write_text("{broken\n")
    said = report_beside(run)
    assert "scores.jsonl:1: not JSON" in said
    assert "the results are complete" in said
    assert (run / "results.json").is_file()


@pytest.mark.parametrize("flags", [[], ["--no-report"]])
def test_bench_writes_a_report_beside_its_results(
    run: Path, monkeypatch: pytest.MonkeyPatch, flags: list[str]
) -> None:
    row = Row("good", "base", "good", n=4, failures=dict.fromkeys(FAILURES, 0))
    results = Results("mission", {"path": "d.jsonl", "sha256": "0" * 64, "n": 4}, (row,))
    monkeypatch.setattr("planner_ft.benchmark.runner.run_bench", lambda *_arguments: results)
    monkeypatch.setattr(
        "planner_ft.report.pictures.picture", lambda _chart: {}
    )  # drawing is tested elsewhere
    done = CliRunner().invoke(
        app, ["bench", "--level", "mission", "--candidates", "embedded", "--out", str(run), *flags]
    )
    assert done.exit_code == 0, done.output
    assert (run / "report.html").is_file() is not bool(flags)


def test_new_results_remove_the_report_of_former_ones(run: Path, data: Path) -> None:
    write_report([run], run, pictures="none")
    vocabulary = load_vocabulary("usv")
    write_results(
        run,
        score_predictions(
            run / "predictions.jsonl", load_bench_data(data, "mission", vocabulary), vocabulary
        ),
    )
    assert not (run / "report.html").exists()


def test_a_file_is_blamed_where_it_was_given(run: Path, tmp_path: Path) -> None:
    file = run / "results.json"
    for arguments, said in (
        ([str(file)], f"{file}: no results.json in it"),
        ([str(run), "--out", str(file)], f"--out {file}: is a file"),
    ):
        result = CliRunner().invoke(app, ["report", *arguments], standalone_mode=False)
        assert str(result.exception).startswith(said)
