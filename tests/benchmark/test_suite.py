"""Suites: what runs, what is skipped, what a failure leaves, and what the tables say. The processes
are stood in for by functions that write a run folder, but for one test at the end.
"""

from __future__ import annotations

import csv
import json
import multiprocessing
import sys
import time
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
import typer
from typer.testing import CliRunner

from planner_ft.benchmark import units
from planner_ft.benchmark.definitions import load_suite
from planner_ft.benchmark.suite import combine, opened, run_suite
from planner_ft.benchmark.units import Process, State, Units
from planner_ft.cli.bench import bench
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml

FIRST, SECOND = "Llama-3.2-1B", "Qwen2.5-3B"
RIGHT = json.dumps(
    {
        "tasks": [{"title": "Transit", "parameters": {}, "task_prompt": ""}],
        "assumptions": [],
        "constraints": [],
    }
)


def write_data(path: Path, count: int) -> None:
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index} {index}",
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(count)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))


@pytest.fixture
def suite_file(tmp_path: Path, models: Path) -> Path:
    """Two candidates, one of whose weights are there, on two data sets."""
    write_data(tmp_path / "test.jsonl", 3)
    write_data(tmp_path / "more.jsonl", 2)
    path = tmp_path / "suite.toml"
    path.write_text(
        f'title = "A suite"\ncandidates = ["{FIRST}", "{SECOND}"]\nconfigurations ='
        ' ["base"]\nlatency_samples = 1\n[[parts]]\nname = "test"\nlevel = "mission"\ndata ='
        ' "test.jsonl"\n[[parts]]\nname = "more"\nlevel = "mission"\ndata = "more.jsonl"\napart ='
        " true\n"
    )
    return path


class Runs:
    """Stands in for the processes of a suite: writes what `plannerft bench` would, one line at a
    time, as the suite looks.
    """

    def __init__(self) -> None:
        self.started: list[tuple[str, str]] = []
        self.queries = 0
        self.fails: dict[tuple[str, str], str] = {}
        self.hangs = False
        self.now = 0.0
        self.running: _Run | None = None

    def __call__(self, arguments: list[str], log: Path, processes: int) -> _Run:
        pairs = arguments[1 : arguments.index("--resume")]
        values = dict(zip(pairs[::2], pairs[1::2], strict=True))
        part, candidate = Path(values["--out"]).parent.name, values["--candidates"]
        self.started.append((part, candidate))
        self.running = _Run(self, values, self.fails.get((part, candidate)))
        return self.running

    def sleep(self, seconds: float) -> None:
        self.now += seconds
        if self.running and not self.hangs:
            self.running.step()


class _Run:
    def __init__(self, runs: Runs, values: dict[str, str], failure: str | None) -> None:
        self.runs, self.values, self.failure, self.ended = runs, values, failure, False
        self.folder = Path(values["--out"])
        self.folder.mkdir(parents=True, exist_ok=True)
        self.samples = [
            json.loads(line)["id"] for line in Path(values["--data"]).read_text().splitlines()
        ]
        done = self.folder / "predictions.jsonl"
        known = (
            {json.loads(line)["id"] for line in done.read_text().splitlines()}
            if done.is_file()
            else set()
        )
        self.left = [sample for sample in self.samples if sample not in known]
        system = {
            "candidate": values["--candidates"],
            "configuration": "base",
            "label": values["--candidates"],
        }
        data = {
            "level": "mission",
            "data": values["--data"],
            "data_sha256": "",
            "limit": None,
            "vocabulary": "usv",
            "seed": 0,
        }
        record = {
            "settings": data,
            "jobs": {"j": {}},
            "keys": {"j": "k"},
            "systems": {"j": system},
            "costs": {},
        }
        (self.folder / "run.json").write_text(json.dumps(record))

    def step(self) -> None:
        if not self.left:
            return
        self.runs.queries += 1
        line = {
            "id": self.left.pop(0),
            "configuration": "base",
            "output": RIGHT,
            "time_s": 1.0,
            "tokens": 5,
            "key": "k",
        }
        with open(self.folder / "predictions.jsonl", "a") as stream:
            stream.write(json.dumps(line) + "\n")
        if self.failure is not None:
            self.ended, self.left = True, []
        elif not self.left:
            with open(self.folder / "latency.jsonl", "a") as stream:
                stream.write(
                    json.dumps(
                        {
                            "id": self.samples[0],
                            "configuration": "base",
                            "latency_s": 2.0,
                            "key": "k",
                        }
                    )
                    + "\n"
                )
            (self.folder / "results.json").write_text("{}")

    def running(self) -> bool:
        return bool(self.left) and not self.ended

    def end(self) -> None:
        self.ended = True

    def problem(self) -> str | None:
        return self.failure

    def __enter__(self) -> _Run:
        return self

    def __exit__(self, *_: object) -> None:
        self.runs.running = None


@pytest.fixture
def runs(monkeypatch: pytest.MonkeyPatch) -> Runs:
    made = Runs()
    monkeypatch.setattr(units, "Process", made)
    clock = SimpleNamespace(sleep=made.sleep, monotonic=lambda: made.now)
    monkeypatch.setattr(units, "time", clock)
    return made


@pytest.fixture
def go(suite_file: Path, tmp_path: Path) -> Callable[..., Any]:
    def run(report: Callable[[State], None] = lambda _state: None, **values: Any) -> Any:
        return run_suite(load_suite(suite_file), tmp_path / "out", {}, report, **values)

    return run


def csv_rows(path: Path) -> list[dict[str, str]]:
    """The rows of an overview without its baselines."""
    with open(path, newline="") as stream:
        return [row for row in csv.DictReader(stream) if row["status"] != "baseline"]


def test_every_candidate_is_run_on_every_data_set(go: Any, runs: Runs, tmp_path: Path) -> None:
    parts = go()
    assert runs.started == [("test", FIRST), ("more", FIRST), ("test", SECOND), ("more", SECOND)]
    assert [(part.part.name, len(part.results.rows), part.failed) for part in parts] == [
        ("test", 2, ()),
        ("more", 2, ()),
    ]
    rows = csv_rows(tmp_path / "out" / "table.csv")
    assert [
        (row["data"], row["candidate"], row["n"], row["apart"], row["status"], row["f1"])
        for row in rows
    ] == [
        ("test", FIRST, "3", "0", "measured", "1"),
        ("test", SECOND, "3", "0", "measured", "1"),
        ("more", FIRST, "2", "1", "measured", "1"),
        ("more", SECOND, "2", "1", "measured", "1"),
    ]
    for name in (
        "table.md",
        "table.csv",
        "table.tex",
        "results.json",
        "test/table.md",
        "test/results.json",
        "test/scores.jsonl",
        "more/table.tex",
    ):
        assert (tmp_path / "out" / name).stat().st_size > 0
    overview = (tmp_path / "out" / "table.md").read_text()
    assert (
        overview.index("**test: mission level")
        < overview.index("Published-size splits")
        < overview.index("**more: mission level")
        < overview.index("Reported apart")
    )


def test_the_manifest_names_every_data_set_and_unit(go: Any, runs: Runs, tmp_path: Path) -> None:
    go()
    manifest = json.loads((tmp_path / "out" / "results.json").read_text())["manifest"]
    assert set(manifest["inputs"]) == {"suite", "test", "more"}
    assert set(manifest["units"]) == {
        f"{part}, {name}" for part in ("test", "more") for name in (FIRST, SECOND)
    }
    assert "--level" in manifest["units"][f"test, {FIRST}"]["arguments"]


def test_a_failure_is_in_the_tables_and_the_others_go_on(
    go: Any, runs: Runs, tmp_path: Path
) -> None:
    runs.fails[("test", FIRST)] = "its process was ended by SIGKILL, most likely for want of memory"
    parts = go()
    assert len(runs.started) == 4
    assert [(entry["candidate"], entry["configuration"]) for entry in parts[0].failed] == [
        (FIRST, "base")
    ]
    assert "want of memory (1 of 3 answers are kept)" in parts[0].failed[0]["reason"]
    failed = [row for row in csv_rows(tmp_path / "out" / "table.csv") if row["status"] == "failed"]
    assert [(row["data"], row["candidate"], row["f1"]) for row in failed] == [("test", FIRST, "")]
    for name in ("table.md", "test/table.md", "test/table.csv", "test/table.tex", "table.tex"):
        assert "want of memory" in (tmp_path / "out" / name).read_text()
    # Once it works, the same command does only what is missing.
    runs.fails, runs.started, runs.queries = {}, [], 0
    again = go(resume=True)
    assert runs.started == [("test", FIRST)]
    assert runs.queries == 2
    assert not again[0].failed


def test_weights_and_adapters_that_are_missing_cost_only_their_own_rows(
    go: Any, runs: Runs, suite_file: Path, tmp_path: Path, models: Path
) -> None:
    suite_file.write_text(
        suite_file.read_text()
        .replace('["base"]', '["base", "lora"]')
        .replace(SECOND, "org/nowhere")
    )
    parts = go()
    assert runs.started == [("test", FIRST), ("more", FIRST)]
    reasons = {
        (entry["candidate"], entry["configuration"]): entry["reason"] for entry in parts[0].failed
    }
    assert set(reasons) == {(FIRST, "lora"), ("org/nowhere", "base"), ("org/nowhere", "lora")}
    assert "no such adapter folder" in reasons[FIRST, "lora"]
    assert "not on this machine" in reasons["org/nowhere", "base"]
    assert [row.configuration for row in parts[0].results.rows] == ["base"]


@pytest.mark.parametrize("after", [1, 2, 3, 4, 6, 8])
def test_a_suite_that_was_killed_goes_on_and_pays_nothing_twice(
    go: Any, runs: Runs, tmp_path: Path, after: int
) -> None:
    def kill(_state: State) -> None:
        if runs.queries == after:
            raise SystemExit

    with pytest.raises(SystemExit):
        go(kill)
    assert not (tmp_path / "out" / "results.json").exists()
    parts = go(resume=True)
    assert runs.queries == 2 * (3 + 2)
    assert [len(part.results.rows) for part in parts] == [2, 2]
    assert not any(part.failed for part in parts)


def test_what_is_finished_is_not_started_again(go: Any, runs: Runs, tmp_path: Path) -> None:
    go()
    before = (tmp_path / "out" / "table.csv").read_text()
    runs.started.clear()
    go(resume=True)
    assert runs.started == []
    assert (tmp_path / "out" / "table.csv").read_text() == before


def test_a_process_that_gives_no_answer_is_ended(go: Any, runs: Runs, suite_file: Path) -> None:
    suite_file.write_text("stall_minutes = 2\n" + suite_file.read_text())
    runs.hangs = True
    parts = go()
    assert 4 * 120 <= runs.now <= 4 * 130
    assert all(
        "no new answer for 2 minutes" in entry["reason"] for part in parts for entry in part.failed
    )
    assert sum(len(part.failed) for part in parts) == 4


def test_the_time_left_holds(go: Any, runs: Runs) -> None:
    claims: list[tuple[float, float | None]] = []
    go(lambda state: claims.append((runs.now, state.left)))
    end, later = runs.now, [(now, left) for now, left in claims if now > 3]
    assert claims[0][1] is None
    assert later
    # A second per answer; the timed query was not waited for, so claims may be two seconds long for
    # each of four.
    assert all(left is not None and abs(now + left - end) <= 8 for now, left in later)


def test_data_that_changed_since_the_start_is_refused(go: Any, runs: Runs, tmp_path: Path) -> None:
    go()
    write_data(tmp_path / "more.jsonl", 4)
    with pytest.raises(PlannerError, match=r"more\.jsonl: changed since"):
        go(resume=True)
    go(overwrite=True)
    assert [row["n"] for row in csv_rows(tmp_path / "out" / "table.csv")] == ["3", "3", "4", "4"]


def test_a_folder_is_not_overwritten(go: Any, runs: Runs) -> None:
    go()
    with pytest.raises(PlannerError, match=r"--resume .* --overwrite"):
        go()


def test_two_suites_do_not_share_a_folder(suite_file: Path, tmp_path: Path) -> None:
    app, out = typer.Typer(), tmp_path / "out"
    app.command()(bench)
    with alone(out, "--out", "a suite"):
        done = CliRunner().invoke(app, ["--suite", str(suite_file), "--out", str(out)])
    assert isinstance(done.exception, PlannerError)
    assert "a suite runs there" in str(done.exception)


def test_what_is_not_run_yet_is_said(suite_file: Path, runs: Runs, tmp_path: Path) -> None:
    suite = load_suite(suite_file)
    made = opened(suite, tmp_path / "out", {})
    parts, _manifest = combine(suite, made, Units(made, lambda _state: None), {})
    assert {entry["reason"] for part in parts for entry in part.failed} == {"not run yet"}


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ('title = "A suite"\n', "", "title is missing"),
        ('["base"]', '["magic"]', "configurations magic"),
        ('["base"]', "[]", "configurations is empty"),
        ('level = "mission"', 'level = "both"', r"parts\[0\]: --level both"),
        ('name = "more"', 'name = "test"', "two parts are named test"),
        ('name = "more"', 'name = "../more"', "becomes a folder"),
        ('data = "test.jsonl"', 'data = "none.jsonl"', "no such file"),
        ("latency_samples = 1", "latency_samples = -1", r"parts\[0\]: --latency-samples -1"),
        ("latency_samples = 1", "speed = 1", "unknown key 'speed'"),
        (FIRST, "Lama", "unknown candidate"),
        (FIRST, SECOND.lower(), "two candidates are named"),
        ("apart = true", 'apart = "yes"', "apart must be a bool"),
        ("[[parts]]", "[[parts]", "not TOML"),
    ],
)
def test_a_bad_suite_file_is_one_sentence(
    go: Any, runs: Runs, suite_file: Path, old: str, new: str, problem: str
) -> None:
    suite_file.write_text(suite_file.read_text().replace(old, new, 1))
    with pytest.raises(PlannerError, match=problem):
        go()
    assert runs.started == []


def test_the_shipped_suites_can_be_read() -> None:
    root = Path(__file__).parents[2] / "eval" / "suites"
    ours = [path for path in root.glob("*.toml") if "candidates" in read_toml(path)]
    suites = {path.stem: load_suite(path) for path in ours}
    assert set(suites) == {"paper", "embedded", "ci"}
    assert len(suites["paper"].candidates) == 7
    for part in (part for suite in suites.values() for part in suite.parts):
        data = part.settings.data
        assert data is not None
        assert part.apart == (data.name != "test.jsonl")
        assert data.is_file() or "data/task" in str(data)


def test_a_process_that_fails_says_why(tmp_path: Path) -> None:
    with Process(["bench", "--level", "mission"], tmp_path / "log.txt") as process:
        assert "--level and --candidates" in str(process.problem())


def test_a_process_that_is_killed_says_so(tmp_path: Path) -> None:
    with Process(["bench", "--level", "mission"], tmp_path / "log.txt") as process:
        process.child.kill()
        assert "SIGKILL" in str(process.problem())


def test_a_process_ends_with_the_suite_that_started_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(
        units,
        "command",
        lambda _arguments, _processes: [sys.executable, "-c", "import time; time.sleep(1e4)"],
    )

    def suite() -> None:
        with Process([], tmp_path / "log.txt") as process:
            (tmp_path / "pid").write_text(str(process.child.pid))
            time.sleep(1e4)

    parent = multiprocessing.get_context("fork").Process(target=suite)
    parent.start()
    while not (tmp_path / "pid").is_file() or not (tmp_path / "pid").read_text():
        time.sleep(0.01)
    child = Path("/proc") / (tmp_path / "pid").read_text() / "stat"
    assert child.is_file()
    parent.kill()
    parent.join()
    deadline = time.monotonic() + 600
    # Gone, or a zombie that nobody has collected yet.
    while (
        child.is_file()
        and child.read_text().rsplit(")", 1)[1].split()[0] != "Z"
        and time.monotonic() < deadline
    ):
        time.sleep(0.01)
    assert time.monotonic() < deadline


def test_a_suite_runs_in_real_processes(suite_file: Path, tmp_path: Path, models: Path) -> None:
    text = (
        suite_file.read_text()
        .replace(f', "{SECOND}"', "")
        .replace("latency_samples = 1", "latency_samples = 0\nmax_new_tokens = 3")
    )
    suite_file.write_text(text[: text.index('[[parts]]\nname = "more"')])
    (part,) = run_suite(
        load_suite(suite_file), tmp_path / "out", {"device": "cpu", "limit": 1}, lambda _state: None
    )
    assert not part.failed, part.failed
    assert [row.n for row in part.results.rows] == [1]
    assert part.results.rows[0].is_standin
