"""Bad inputs of every command: exit status 2, one sentence without a traceback, and nothing half-written."""

from __future__ import annotations

import io
import signal
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any
from unittest.mock import Mock

import pytest
import typer

from planner_ft.cli import main
from planner_ft.cli.options import interruptible

COMMANDS = """
bench --level mission --candidates embedded --seed -1 --out OUT
bench --level mission --candidates embedded --limit 0 --out OUT
bench --level mission --candidates embedded --limit -3 --out OUT
bench --level mission --candidates embedded --batch-size 0 --out OUT
bench --level mission --candidates embedded --batch-size x --out OUT
bench --level mission --candidates embedded --max-new-tokens 0 --out OUT
bench --level mission --candidates embedded --latency-samples -1 --out OUT
bench --level mission --candidates embedded --planning-samples -1 --out OUT
bench --level mission --candidates embedded --repeats 0 --out OUT
bench --level mission --candidates embedded --temperature -1 --out OUT
bench --level mission --candidates embedded --temperature nan --out OUT
bench --level mission --candidates embedded --top-p 2 --out OUT
bench --level mission --candidates embedded --device tpu --out OUT
bench --level mission --candidates embedded --quantization int8 --out OUT
bench --level mission --candidates embedded --configurations foo --out OUT
bench --level mission --candidates nobody --out OUT
bench --level mission --candidates embedded --data /nowhere.jsonl --out OUT
bench --level mission --candidates embedded --adapter /nowhere --configurations lora --out OUT
bench --level boat --candidates embedded --out OUT
bench --level mission --candidates embedded --processes 2 --out OUT
bench --level mission --candidates , --out OUT
bench --level mission --candidates embedded --vocabulary nobody --out OUT
bench --level mission --endpoint nonsense --model x --out OUT
bench --level mission --endpoint http://127.0.0.1:1 --model x --timeout -1 --out OUT
bench --level mission --endpoint http://127.0.0.1:1 --model x --retries -1 --out OUT
bench --level mission --endpoint http://127.0.0.1:1 --model x --concurrency 0 --out OUT
bench --suite /nowhere.toml --out OUT
bench --gate /nowhere.toml --out OUT
bench --suite eval/suites/ci.toml --processes 0 --out OUT
bench --suite eval/suites/ci.toml --seed -1 --out OUT
score --level mission --predictions /nowhere --out OUT
score --run /nowhere --out OUT
score --run /nowhere --seed -1 --out OUT
score --out OUT
compare /nowhere
compare /nowhere --seed -1
compare /nowhere --metric foo
report /nowhere
report /nowhere --pictures foo --out OUT
gen-data --seed -1 --out OUT
gen-data --train -1 --level task --out OUT
gen-data --train 0 --level task --out OUT
gen-data --synthetic -1 --out OUT
gen-data --level boat --out OUT
gen-data --vocabulary nobody --out OUT
gen-data --source /nowhere --level mission --out OUT
validate /nowhere
validate README.md --level boat
vocabulary --name nobody
train --level mission --candidate embedded --rank 0 --output OUT
train --level mission --candidate embedded --seed -1 --output OUT
train --level mission --candidate embedded --max-samples 0 --output OUT
train --level mission --candidate embedded --augment -1 --output OUT
train --level mission --candidate embedded --threads 0 --output OUT
train --level mission --candidate embedded --checkpoint-steps 0 --output OUT
train --level mission --candidate embedded --log-every 0 --output OUT
train --level mission --candidate embedded --warmup 2 --output OUT
train --level mission --candidate embedded --learning-rate nan --output OUT
train --level mission --candidate embedded --train-file /nowhere --output OUT
train --level mission --candidate embedded --corrections /nowhere --output OUT
train --level mission --candidate embedded --preview-id nobody --output OUT
train --recipe nobody
train --level mission --candidate embedded --report-to fax --output OUT
plan x --candidate nobody
plan x --vocabulary nobody
plan x --device tpu
plan x --quantization int8
plan x --configuration foo
plan x --vehicle /nowhere
plan x --locate foo
plan x --mission-adapter /nowhere
review /nowhere
review
review /nowhere --web --port -1
review --web --port 99999
review --web --host nowhere.invalid
review --harvest --out OUT
review /nowhere --approve
verify /nowhere
verify
verify --log /nowhere
export /nowhere --format qgc
export
export --candidate embedded
export --candidate embedded --out OUT --checks 0
export --candidate embedded --out OUT --outtype f8
export --candidate embedded --out OUT --level boat
export --candidate nobody --out OUT
export --candidate embedded --out OUT --merge --adapter /nowhere
export --candidate embedded --out OUT --check-data /nowhere
candidates nobody
candidates --nobody
doctor --nobody
nobody
bench --level mission --candidates embedded --data BINARY --out OUT
bench --level mission --candidates embedded --data EMPTY --out OUT
bench --level mission --candidates embedded --data DEEP --out OUT
bench --level mission --candidates embedded --data LIST --out OUT
bench --level mission --candidates embedded --data FOLDER --out OUT
bench --level mission --candidates embedded --configurations base --out EMPTY/x
bench --suite BINARY --out OUT
bench --suite LIST --out OUT
bench --gate BINARY --out OUT
bench --gate FOLDER --out OUT
bench --field BINARY --candidates embedded --out OUT
bench --level mission --candidates FOLDER --out OUT
score --level mission --predictions BINARY --out OUT
score --level mission --predictions LIST --out OUT
score --run FOLDER --out OUT
compare BINARY
compare FOLDER
compare LIST
report BINARY
report FOLDER
report FOLDER --card FOLDER
gen-data --level mission --source FOLDER --out OUT
gen-data --level task --out EMPTY/x
gen-data --vocabulary BINARY --out OUT
validate BINARY
validate FOLDER
vocabulary --vocabulary BINARY
vocabulary --vocabulary FOLDER
vocabulary --docs EMPTY/x
vocabulary --schemas EMPTY/x
train --level mission --candidate embedded --train-file BINARY --output OUT
train --level mission --candidate embedded --train-file EMPTY --output OUT
train --level mission --candidate embedded --train-file DEEP --output OUT
train --level mission --candidate embedded --corrections BINARY --output OUT
train --level mission --candidate embedded --output EMPTY/x
train --level mission --candidate FOLDER --output OUT
train --recipe BINARY
train --recipe LIST
plan x --vehicle BINARY
plan x --locate-file BINARY
plan x --locate-file LIST
plan x --area BINARY
plan x --area DEEP
plan x --origin 91,0
plan x --origin nan,0
plan x --out EMPTY
plan x --candidate FOLDER
plan x --vocabulary BINARY
review BINARY
review DEEP
review LIST
review FOLDER
review --harvest LIST --out OUT
verify BINARY
verify DEEP
verify --log BINARY
verify --log DEEP
export BINARY --format qgc
export DEEP --format qgc
export FOLDER --format qgc
export --candidate FOLDER --out OUT
export --candidate embedded --out EMPTY/x
plan
compare FOLDER --out LONG
compare FOLDER --out NOTHING
report FOLDER --out LONG
report FOLDER --out NOTHING
score --run LONG
score --level mission --predictions LIST --out NOTHING
gen-data --level task --out LONG
gen-data --level task --out NOTHING
vehicle new my_rover --out LONG
vehicle new my_rover --out NOTHING
train --level mission --candidate embedded --output LONG
train --level mission --candidate embedded --output NOTHING
export LONG --format qgc
export --candidate embedded --out LONG
bench --level mission --candidates embedded --out LONG
bench --level mission --candidates embedded --out NOTHING
plan x --locate-file NOTHING
simulate
simulate /nowhere
simulate /nowhere --runs 0
simulate /nowhere --runs x
simulate /nowhere --runs 1000000 --out OUT
simulate /nowhere --seed -1
simulate /nowhere --simulator gazebo
simulate /nowhere --tolerance 0
simulate /nowhere --tolerance nan
simulate /nowhere --mcap -1
simulate /nowhere --mcap 21
simulate /nowhere --start here
simulate /nowhere --start nan,0
simulate /nowhere --fault foo
simulate /nowhere --locate foo
simulate /nowhere --origin 91,0
simulate /nowhere --vocabulary nobody
simulate BINARY --out OUT
simulate EMPTY --out OUT
simulate DEEP --out OUT
simulate LIST --out OUT
simulate FOLDER --out OUT
simulate LONG --out OUT
simulate NOTHING
learning-curve --out OUT
learning-curve --level boat --candidate embedded --out OUT
learning-curve --level mission --candidate nobody --out OUT
learning-curve --level mission --candidate embedded --sizes x --out OUT
learning-curve --level mission --candidate embedded --sizes -1 --out OUT
learning-curve --level mission --candidate embedded --sizes 1000000 --out OUT
learning-curve --level mission --candidate embedded --seeds 0 --out OUT
learning-curve --level mission --candidate embedded --strength hard --out OUT
learning-curve --level mission --candidate embedded --limit 0 --out OUT
learning-curve --level mission --candidate embedded --rank 0 --out OUT
learning-curve --level mission --candidate embedded --learning-rate nan --out OUT
learning-curve --level mission --candidate embedded --vocabulary nobody --out OUT
learning-curve --level mission --candidate embedded --data /nowhere --out OUT
learning-curve --level mission --candidate embedded --data BINARY --out OUT
learning-curve --level mission --candidate embedded --data EMPTY --out OUT
learning-curve --level mission --candidate embedded --data-dir FOLDER --out OUT
learning-curve --level mission --candidate embedded --resume --overwrite --out OUT
learning-curve --level mission --candidate embedded --out EMPTY/x
learning-curve --level mission --candidate embedded --out LONG
learning-curve --level mission --candidate embedded --out NOTHING
calibrate
calibrate /nowhere --out OUT
calibrate BINARY --out OUT
calibrate EMPTY --out OUT
calibrate LIST --out OUT
calibrate DEEP --out OUT
calibrate FOLDER --out OUT
calibrate README.md --out OUT
calibrate README.md --level boat --out OUT
calibrate README.md --candidate nobody --out OUT
calibrate README.md --configuration foo --out OUT
calibrate README.md --adapter /nowhere --out OUT
calibrate README.md --vocabulary nobody --out OUT
calibrate README.md --device tpu --out OUT
calibrate README.md --quantization int8 --out OUT
calibrate README.md --out EMPTY/x
calibrate README.md --out LONG
vehicle
vehicle new
vehicle paint my_rover
vehicle new usv --out OUT
vehicle new my_rover --out FOLDER
vehicle new ../rover --out OUT
vehicle check nobody
vehicle check FOLDER
bench --field --level mission --candidates embedded --out OUT
bench --field /nowhere --candidates embedded --out OUT
bench --field --candidates embedded --resume --overwrite --out OUT
bench --level both --candidates embedded --data BINARY --out OUT
bench --level both --candidates embedded --data LIST --out OUT
bench --level both --candidates embedded --adapter x --out OUT
export DEEP --format nobody
export --candidate embedded --merge --format qgc --out OUT
plan x --temperature 1
validate
validate NOTHING
skill
skill paint hold
skill train nobody --out OUT
skill train hold --seed -1 --out OUT
skill train hold --iterations 0 --out OUT
skill train hold --environments 0 --out OUT
skill train hold --recipe nobody --out OUT
skill train hold --goto /nowhere --out OUT
skill train hold --resume --overwrite --out OUT
skill train hold --out EMPTY/x
skill train hold --seed 99999999999999999999 --out OUT
skill train hold --recipe published --out OUT
skill train hold --policy x --out OUT
skill train hold --episodes 4 --out OUT
skill train all --policy x --out OUT
skill train all --recipe published --out OUT
skill bench hold --recipe published --episodes 1 --out OUT
skill bench hold --iterations 5 --episodes 1 --out OUT
skill bench hold --environments 3 --episodes 1 --out OUT
skill bench hold --sampling l3 --episodes 1 --out OUT
skill bench hold --without progress --episodes 1 --out OUT
skill bench hold --resume --episodes 1 --out OUT
skill bench hold --goto /nowhere --episodes 1 --out OUT
skill bench nobody --out OUT
skill bench hold --episodes 0 --out OUT
skill bench hold --policy /nowhere --out OUT
skill bench hold --policy FOLDER --out OUT
simulate --suite /nowhere --out OUT
simulate --suite BINARY --out OUT
simulate --suite LIST --out OUT
"""
WORDS = {"LONG": "x" * 300, "NOTHING": ""}
"""A name that no file can have, and what an unset variable of a shell leaves."""
FILES = {"BINARY": b"\xff\xfe\x00", "EMPTY": b"", "DEEP": b"[" * 100_000, "LIST": b"[]\n"}
"""Inputs that commands name, beside FOLDER, which is empty, and OUT, which does not exist."""


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("inputs")
    for name, content in FILES.items():
        (folder / name).write_bytes(content)
    (folder / "FOLDER").mkdir()
    return folder


@pytest.mark.parametrize("command", COMMANDS.strip().splitlines())
def test_it_is_refused_with_a_sentence(
    command: str,
    inputs: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    words = [
        str(inputs / word) if word.split("/")[0] in {*FILES, "FOLDER"} else WORDS.get(word, word)
        for word in command.replace("OUT", str(tmp_path / "out")).split()
    ]
    monkeypatch.setattr(sys, "argv", ["plannerft", *words])
    with pytest.raises(SystemExit) as stop:
        main()
    said = capsys.readouterr().err
    assert stop.value.code == 2, said
    assert "Traceback" not in said and said.strip()
    assert list(tmp_path.iterdir()) == []
    assert {path.name for path in inputs.rglob("*")} == {*FILES, "FOLDER"}


@pytest.mark.parametrize(
    ("error", "status"), [(KeyboardInterrupt(), 130), (OSError(28, "No space left on device"), 2)]
)
def test_what_no_command_catches_ends_without_a_traceback(
    error: BaseException, status: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("planner_ft.cli.app.app", Mock(side_effect=error))
    monkeypatch.setattr(sys, "argv", ["plannerft", "doctor"])
    with pytest.raises(SystemExit) as stop:
        main()
    assert stop.value.code == status


def test_a_terminal_without_a_character_shows_another(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(io.BytesIO(), "ascii"))
    monkeypatch.setattr(sys, "argv", ["plannerft", "candidates"])
    with pytest.raises(SystemExit) as stop:
        main()
    assert not stop.value.code


def test_ctrl_c_inside_the_import_of_a_module_waits_for_its_end() -> None:
    importing = SimpleNamespace(f_code=SimpleNamespace(co_filename="<frozen importlib._bootstrap>"))
    with pytest.raises(typer.Exit) as stop, interruptible():
        press: Any = signal.getsignal(signal.SIGINT)
        press(signal.SIGINT, importing)
        time.sleep(60)
    assert stop.value.exit_code == 130
