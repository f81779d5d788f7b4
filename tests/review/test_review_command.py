"""`plannerft review` and `plannerft verify` as they are typed."""

from __future__ import annotations

import json
import os
import pty
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from planner_ft.cli.app import app
from planner_ft.document import PlanDocument, read_document, write_document
from planner_ft.review import log_beside, read_log
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from tests.review.conftest import go, mission_document, task


def run(*arguments: object) -> Result:
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def sentence(*arguments: object) -> str:
    """The error of a call that fails with exit status 2."""
    result = run(*arguments)
    assert isinstance(result.exception, PlannerError), result.output
    return str(result.exception)


# ---------------------------------------------------------------- without a conversation


def test_the_plan_is_shown_with_what_a_reviewer_needs(plan: Path) -> None:
    result = run("review", plan)
    assert result.exit_code == 0 and "\x1b" not in result.output
    for part in (
        "not approved",
        "Command",
        "Find the green buoy",
        "GoToXY(x=0, y=0)",
        "Where values come from",
        '3 radius = 12: command ("12 m")',
        "Track",
        "Estimate",
    ):
        assert part in result.output
    assert "not located yet: green buoy" in result.output
    assert not log_beside(plan).exists()


def test_edit_approve_and_verify(plan: Path) -> None:
    assert run("verify", plan).exit_code == 1
    result = run(
        "review",
        plan,
        "--edit",
        "locate green buoy=120,-35",
        "--edit",
        "3.radius=15",
        "--approve",
        "--name",
        "Ann",
        "--acknowledge",
        "all",
    )
    assert (
        result.exit_code == 0
        and "radius 12 -> 15" in result.output
        and "approved by Ann: record 1" in result.output
    )
    result = run("verify", plan)
    assert result.exit_code == 0 and result.output.startswith("approved by Ann at ")
    run("review", plan, "--edit", "3.radius=20")
    result = run("verify", plan, "--json")
    assert result.exit_code == 1
    assert "task 3, radius: approved 15, now 20" in [
        change["text"] for change in json.loads(result.output)["changes"]
    ]
    run("review", plan, "--reject", "too wide", "--name", "Bob")
    result = run("verify", plan)
    assert (
        result.exit_code == 1 and "rejected by Bob" in result.output and "too wide" in result.output
    )


def test_edits_before_one_that_fails_are_kept_and_nothing_is_approved(plan: Path) -> None:
    result = run(
        "review",
        plan,
        "--edit",
        "3.radius=15",
        "--edit",
        "3.radius=-1",
        "--approve",
        "--name",
        "Ann",
        "--acknowledge",
        "all",
    )
    assert isinstance(result.exception, PlannerError)
    assert read_document(plan)["tasks"][2]["parameters"]["radius"] == 15 and not read_log(
        log_beside(plan)
    )


def test_approval_needs_a_name_and_the_warnings(plan: Path) -> None:
    run("review", plan, "--edit", "remove 4")
    assert "give --name" in sentence("review", plan, "--approve", "--acknowledge", "all")
    assert "not acknowledged" in sentence("review", plan, "--approve", "--name", "Ann")
    assert "exclude each other" in sentence(
        "review", plan, "--approve", "--reject", "no", "--name", "Ann"
    )
    assert "goes with --approve" in sentence("review", plan, "--acknowledge", "all")
    assert "does not go with --web" in sentence("review", plan, "--web", "--approve")
    assert "does not go with" in sentence("review", plan, "--out", "x.jsonl")
    assert "one is reviewed at a time" in sentence("review", plan, plan)


def test_a_plan_altered_by_hand_is_shown_as_such_and_can_be_adopted(plan: Path) -> None:
    run("review", plan, "--approve", "--name", "Ann", "--acknowledge", "all")
    document = json.loads(plan.read_text())
    document["tasks"][2]["parameters"]["radius"] = 20
    plan.write_text(json.dumps(document))
    shown = run("review", plan, "--show").output
    assert "altered by hand" in shown and "task 3, radius: approved 12, now 20" in shown
    assert "--adopt" in sentence(
        "review", plan, "--approve", "--name", "Ann", "--acknowledge", "all"
    )
    result = run("review", plan, "--adopt", "--approve", "--name", "Ann", "--acknowledge", "all")
    assert result.exit_code == 0 and "radius 12 -> 20" in result.output
    assert run("verify", plan).exit_code == 0


def test_the_log_alone_is_checked(plan: Path) -> None:
    log = log_beside(plan)
    assert "no such file" in sentence("verify", "--log", log)
    assert "nothing to verify" in sentence("verify")
    for name in ("Ann", "Bob"):
        run("review", plan, "--approve", "--name", name, "--acknowledge", "all")
    result = run("verify", "--log", log)
    assert result.exit_code == 0 and "2 records: nothing removed" in result.output
    log.write_bytes(log.read_bytes().replace(b"Ann", b"Eve"))
    result = run("verify", "--log", log)
    assert (
        result.exit_code == 2
        and f"{log}:1: line 1 (record 1) is not what was recorded" in result.output
    )
    assert json.loads(run("verify", "--log", log, "--json").output)["problems"][0]["line"] == 1
    assert "begin a new log" in sentence("verify", plan)
    assert "begin a new log" in sentence(
        "review", plan, "--approve", "--name", "Ann", "--acknowledge", "all"
    )


@pytest.mark.parametrize("command", ["review", "verify"])
def test_files_that_are_no_plan_are_one_sentence(plan: Path, command: str, usv: Vocabulary) -> None:
    whole = plan.read_text()
    for text in (whole[: len(whole) // 2], "", "[]", '{"tasks": []}', "\x00"):
        plan.write_text(text)
        assert "\n" not in sentence(command, plan)
    plan.write_text(whole)
    assert "vocabulary" in sentence(command, plan, "--vocabulary", "inspection_drone")
    assert "no such file" in sentence(command, plan.with_name("none.json"))


def test_markup_and_control_characters_of_a_command_are_never_interpreted(
    plan: Path, usv: Vocabulary
) -> None:
    command = (
        "[bold red]Go[/bold red] :boom: \x1b[2J\x1b]0;x\x07 home\r\x9b31m"
        " [link=http://x]y[/link]\nDROP"
    )
    write_document(
        plan,
        mission_document(
            command, [task("Transit", {"target_position": [0, 0]}, command)], {1: go((0, 0))}, usv
        ),
    )
    result = run(
        "review",
        plan,
        "--edit",
        "prompt 1 = [red]x[/red]",
        "--approve",
        "--name",
        "[bold]Ann[/bold]",
        "--acknowledge",
        "all",
    )
    shown = run("review", plan, "--show").output
    assert (
        "[bold red]Go[/bold red] :boom: \\u001b[2J" in shown
        and "[red]x[/red]" in result.output
        and "approved by [bold]Ann[/bold]" in result.output
    )
    assert not {char for char in shown + result.output if not char.isprintable()} - {"\n"}


def test_five_hundred_tasks(tmp_path: Path, usv: Vocabulary) -> None:
    tasks = [task("Transit", {"target_position": [number, -number]}) for number in range(500)]
    skills = {number: go((number - 1, 1 - number)) for number in range(1, 501)}
    write_document(tmp_path / "plan.json", mission_document("Go on and on.", tasks, skills, usv))
    result = run(
        "review",
        tmp_path / "plan.json",
        "--edit",
        "500.target_position=7,7",
        "--approve",
        "--name",
        "Ann",
        "--acknowledge",
        "all",
    )
    assert result.exit_code == 0, result.output
    assert "500 Transit(target_position=[7,7])" in run("review", tmp_path / "plan.json").output
    assert run("verify", tmp_path / "plan.json").exit_code == 0


def test_another_vehicle(tmp_path: Path) -> None:
    drone = load_vocabulary("inspection_drone")
    known = drone.task[drone.transit]
    write_document(
        tmp_path / "plan.json",
        mission_document(
            "Go home.", [task(known.title, {known.position_parameter or "": [0, 0]})], {}, drone
        ),
    )
    result = run(
        "review",
        tmp_path / "plan.json",
        "--edit",
        f"1.{known.position_parameter}=3,4",
        "--approve",
        "--name",
        "Ann",
        "--acknowledge",
        "all",
    )
    assert result.exit_code == 0, result.exception
    assert run("verify", tmp_path / "plan.json").exit_code == 0


# ---------------------------------------------------------------- in a terminal


class Terminal:
    """`plannerft review` on a pseudo-terminal."""

    def __init__(self, *arguments: object) -> None:
        self.screen, end = pty.openpty()
        command = [sys.executable, "-m", "planner_ft", *map(str, arguments)]
        environment = {
            **os.environ,
            "TERM": "xterm",
            "COLUMNS": "100",
            "LANG": "C.UTF-8",
            "PYTHONUTF8": "1",
        }
        self.process = subprocess.Popen(
            command, stdin=end, stdout=end, stderr=end, env=environment, start_new_session=True
        )
        os.close(end)
        self.text = ""

    def until(self, words: str) -> str:
        """What is printed up to these words."""
        deadline = time.monotonic() + 600
        while words not in self.text:
            ready, _, _ = select.select([self.screen], [], [], deadline - time.monotonic())
            assert ready, f"{words!r} never came: {self.text[-2000:]}"
            self.text += os.read(self.screen, 65536).decode("utf-8", "replace")
        before, self.text = self.text.split(words, 1)
        return before

    def type(self, line: str) -> None:
        os.write(self.screen, line.encode() + b"\n")

    def interrupt(self) -> None:
        """Ctrl-C, pressed again while nothing comes of it: readline misses a signal between its
        prompt and its wait.
        """
        for _ in range(10):
            os.kill(self.process.pid, signal.SIGINT)
            if select.select([self.screen], [], [], 10)[0]:
                return

    def end(self) -> int:
        code = self.process.wait(timeout=600)
        os.close(self.screen)
        return code


PROMPT = "show or quit: "


def test_a_conversation_that_edits_and_approves(plan: Path) -> None:
    terminal = Terminal("review", plan)
    assert "Find the green buoy" in terminal.until(PROMPT)
    terminal.type("3.radius=-1")
    assert "radius" in terminal.until(PROMPT)
    terminal.type("3.radius=15")
    assert "radius 12 -> 15" in terminal.until(PROMPT)
    assert read_document(plan)["tasks"][2]["parameters"]["radius"] == 15
    terminal.type("help")
    assert "move task 3 to place 1" in terminal.until(PROMPT)
    terminal.type("remove 4")
    terminal.until(PROMPT)
    terminal.type("approve")
    for warning in read_document(plan)["warnings"]:
        assert warning["text"][:20] in terminal.until("acknowledged? y or n: ")
        terminal.type("y")
    terminal.until("your name: ")
    terminal.type("Ann")
    terminal.until("approved by Ann: record 1")
    assert terminal.end() == 0
    assert run("verify", plan).exit_code == 0


def test_a_conversation_in_which_a_warning_is_not_acknowledged(plan: Path) -> None:
    run("review", plan, "--edit", "remove 4")
    terminal = Terminal("review", plan, "--name", "Ann")
    terminal.until(PROMPT)
    terminal.type("approve")
    terminal.until("acknowledged? y or n: ")
    terminal.type("n")
    assert "not approved" in terminal.until(PROMPT)
    terminal.type("reject")
    terminal.until("reason: ")
    terminal.type("no return")
    terminal.until("rejected by Ann: record 1")
    assert terminal.end() == 0
    assert [record["event"] for record in read_log(log_beside(plan))] == ["rejected"]


def test_two_terminals_on_one_plan(plan: Path) -> None:
    first, second = (
        Terminal("review", plan, "--name", "Ann"),
        Terminal("review", plan, "--name", "Bob"),
    )
    first.until(PROMPT)
    second.until(PROMPT)
    first.type("3.radius=15")
    first.until(PROMPT)
    second.type("3.radius=20")
    shown = second.until(PROMPT)
    assert "changed by somebody else" in shown and "radius=15" in shown
    assert read_document(plan)["tasks"][2]["parameters"]["radius"] == 15
    for terminal in (first, second):
        terminal.type("quit")
        assert terminal.end() == 0


def test_ctrl_c_loses_nothing(plan: Path) -> None:
    terminal = Terminal("review", plan)
    terminal.until(PROMPT)
    terminal.type("3.radius=15")
    terminal.until(PROMPT)
    terminal.interrupt()
    terminal.until("is saved")
    assert terminal.end() == 130
    assert read_document(plan)["tasks"][2]["parameters"]["radius"] == 15


def test_the_end_of_the_input_is_no_decision(plan: Path, document: PlanDocument) -> None:
    terminal = Terminal("review", plan)
    terminal.until(PROMPT)
    os.write(terminal.screen, b"\x04")
    assert terminal.end() == 0
    assert read_document(plan) == document and not read_log(log_beside(plan))
