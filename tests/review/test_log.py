"""The approval log: what is recorded stays, and what is missing or changed is named."""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import random
import shutil
import signal
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
import rfc8785
from hypothesis import given, settings
from hypothesis import strategies as st

from planner_ft.document import PlanDocument
from planner_ft.review import log as review_log
from planner_ft.review.approval import approve
from planner_ft.review.log import (
    START,
    Head,
    append,
    check_log,
    existing_log,
    head_file,
    log_beside,
    read_log,
)
from planner_ft.support.errors import PlannerError
from tests.kills import changes

RECORDS = 6


def written(log: Path, count: int = RECORDS) -> list[bytes]:
    for number in range(count):
        append(
            log,
            {
                "event": "approved",
                "reviewer": f"Änn {number}",
                "digest": f"{number:064x}",
                "plan": {"length": 12.0, "tasks": [number]},
            },
        )
    return log.read_bytes().splitlines(keepends=True)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log that is in order."""
    log = tmp_path_factory.mktemp("whole") / "approvals.jsonl"
    written(log)
    return log


@contextlib.contextmanager
def copy_of(whole: Path, change: Callable[[list[bytes]], list[bytes]]) -> Iterator[Path]:
    """A log whose lines were changed, with the head file as it was."""
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / whole.name
        log.write_bytes(b"".join(change(whole.read_bytes().splitlines(keepends=True))))
        shutil.copy(head_file(whole), head_file(log))
        yield log


def problem_of(log: Path) -> str:
    """What verify says first; a broken log refuses readers and writers alike."""
    chain = check_log(log)
    assert chain.problems and not chain.records
    for use in (lambda: read_log(log), lambda: append(log, {"event": "approved"})):
        with pytest.raises(PlannerError, match="begin a new log"):
            use()
    return chain.problems[0].text


def fork(work: Callable[[], None]) -> int:
    child = os.fork()
    if child == 0:
        try:
            work()
        finally:
            os._exit(0)
    return child


def test_hash_chain_can_be_computed_from_the_file_alone(tmp_path: Path) -> None:
    log = log_beside(tmp_path / "plan.json")
    previous = "0" * 64
    for number, line in enumerate(written(log), start=1):
        record = json.loads(line)
        claimed = record.pop("hash")
        assert record["sequence"] == number and record["previous"] == previous
        assert hashlib.sha256(rfc8785.dumps(record)).hexdigest() == claimed
        previous = claimed
    assert json.loads(head_file(log).read_text()) == {"sequence": RECORDS, "hash": previous}
    assert [record["reviewer"] for record in read_log(log)] == [
        f"Änn {number}" for number in range(RECORDS)
    ]


@pytest.mark.parametrize("number", range(RECORDS))
def test_a_removed_line_is_named(whole: Path, number: int) -> None:
    with copy_of(whole, lambda lines: lines[:number] + lines[number + 1 :]) as log:
        text = problem_of(log)
    assert f"line {number + 1} " in text and f"record {number + 1} is" in text and "removed" in text


def test_several_lines_cut_from_the_end_are_named(whole: Path) -> None:
    with copy_of(whole, lambda lines: lines[:3]) as log:
        assert "records 4 to 6 are known to the head file" in problem_of(log)
        assert [problem.line for problem in check_log(log).problems] == [4]
        log.unlink()
        assert "records 1 to 6 are known to the head file" in problem_of(log)


@settings(max_examples=100)
@given(data=st.data())
def test_every_changed_byte_is_named(whole: Path, data: st.DataObject) -> None:
    number = data.draw(st.integers(0, RECORDS - 1))

    def changed(lines: list[bytes]) -> list[bytes]:
        place = data.draw(st.integers(0, len(lines[number]) - 2))
        byte = data.draw(
            st.integers(0, 255).filter(lambda byte: byte not in (lines[number][place], ord("\n")))
        )
        return [
            *lines[:number],
            lines[number][:place] + bytes([byte]) + lines[number][place + 1 :],
            *lines[number + 1 :],
        ]

    with copy_of(whole, changed) as log:
        assert any(f"line {number + 1} " in problem.text for problem in check_log(log).problems)


@settings(max_examples=30)
@given(order=st.permutations(range(RECORDS)).filter(lambda order: order != list(range(RECORDS))))
def test_lines_that_changed_places_are_named(whole: Path, order: list[int]) -> None:
    with copy_of(whole, lambda lines: [lines[place] for place in order]) as log:
        problem = check_log(log).problems[0]
    wrong = next(place for place, number in enumerate(order) if place != number) + 1
    assert problem.line == wrong and "changed places" in problem.text


@settings(max_examples=30)
@given(number=st.integers(0, RECORDS - 1), place=st.integers(0, RECORDS))
def test_a_repeated_line_is_named(whole: Path, number: int, place: int) -> None:
    with copy_of(whole, lambda lines: [*lines[:place], lines[number], *lines[place:]]) as log:
        assert "repeated" in problem_of(log)


def test_a_line_with_a_new_hash_of_its_own_is_named(tmp_path: Path) -> None:
    log = tmp_path / "approvals.jsonl"
    lines = written(log)
    for number in (2, RECORDS - 1):
        record = json.loads(lines[number])
        del record["hash"]
        record["reviewer"] = "Eve"
        forged = (
            rfc8785.dumps({**record, "hash": hashlib.sha256(rfc8785.dumps(record)).hexdigest()})
            + b"\n"
        )
        log.write_bytes(b"".join([*lines[:number], forged, *lines[number + 1 :]]))
        text = problem_of(log)
        assert f"line {number + 1}" in text and "was replaced" in text


def test_a_head_file_that_is_missing_or_older_is_an_error(tmp_path: Path) -> None:
    log = tmp_path / "approvals.jsonl"
    written(log, 3)
    old = head_file(log).read_bytes()
    written(log, 2)
    head_file(log).write_bytes(old)
    assert "ends at record 3, the log at record 5" in problem_of(log)
    head_file(log).unlink()
    assert "head file is missing" in problem_of(log)
    assert [problem.line for problem in check_log(log).problems] == [0]
    assert existing_log(log) == log
    with pytest.raises(PlannerError, match="no such file"):
        existing_log(tmp_path / "none.jsonl")


def test_a_log_cut_to_its_first_record_without_its_head_file_is_broken(tmp_path: Path) -> None:
    log = tmp_path / "approvals.jsonl"
    log.write_bytes(written(log, 2)[0])
    head_file(log).unlink()
    assert "head file is missing" in problem_of(log)


def test_a_first_record_whose_writer_is_killed_at_any_change_leaves_a_sound_log(
    tmp_path: Path,
) -> None:
    log, last, counts = tmp_path / "approvals.jsonl", 0, set()
    while changes(lambda: append(log, {"event": "approved"}), tmp_path, last) is None:
        chain = check_log(log)
        assert not chain.problems
        counts.add(len(chain.records))
        append(log, {"event": "rejected"})
        assert len(read_log(log)) == len(chain.records) + 1
        for path in (log, head_file(log)):
            path.unlink()
        last += 1
    assert counts == {0, 1}


@pytest.mark.parametrize("count", [1, 3])
def test_a_head_one_behind_is_repaired_by_the_next_record(tmp_path: Path, count: int) -> None:
    """Its writer was killed after the record was on the disk."""
    log = tmp_path / "approvals.jsonl"
    before = json.dumps(START._asdict()).encode()
    for number in range(count):
        before = head_file(log).read_bytes() if number else before
        append(log, {"event": "approved"})
    head_file(log).write_bytes(before)
    assert not check_log(log).problems
    assert append(log, {"event": "rejected"}).record["sequence"] == count + 1
    assert [record["sequence"] for record in read_log(log)] == list(range(1, count + 2))


def test_a_second_killed_writer_leaves_the_head_no_further_behind(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    log = tmp_path / "approvals.jsonl"
    written(log, 1)
    old = head_file(log).read_bytes()
    append(log, {"event": "approved"})
    head_file(log).write_bytes(old)
    real = review_log._write_head

    def killed(log: Path, head: Head) -> None:
        if head.sequence == 3:
            raise KeyboardInterrupt
        real(log, head)

    monkeypatch.setattr(review_log, "_write_head", killed)
    with pytest.raises(KeyboardInterrupt):
        append(log, {"event": "rejected"})
    assert [record["sequence"] for record in read_log(log)] == [1, 2, 3]


@pytest.mark.parametrize("torn", [b'{"event":"appro', b"\xff\xfe", b'{"event":"approved"}'])
def test_a_line_that_was_never_finished_is_moved_aside(tmp_path: Path, torn: bytes) -> None:
    log = tmp_path / "approvals.jsonl"
    lines = written(log)
    log.write_bytes(b"".join(lines) + torn)
    assert check_log(log).torn == torn and len(read_log(log)) == RECORDS
    done = append(log, {"event": "rejected"})
    assert done.set_aside is not None and done.set_aside.read_bytes() == torn
    assert log.read_bytes().splitlines(keepends=True)[:-1] == lines
    assert [record["sequence"] for record in read_log(log)] == list(
        range(1, RECORDS + 2)
    ) and not check_log(log).torn


def test_a_confirmed_line_that_lost_its_end_is_an_error(tmp_path: Path) -> None:
    log = tmp_path / "approvals.jsonl"
    lines = written(log)
    log.write_bytes(b"".join(lines)[:-1])
    assert "record 6 is known to the head file" in problem_of(log)


def test_two_processes_append_a_hundred_records_each(tmp_path: Path) -> None:
    log = tmp_path / "approvals.jsonl"

    def hundred(name: str) -> None:
        for number in range(100):
            append(log, {"event": "approved", "reviewer": name, "digest": f"{number:064x}"})

    children = [fork(lambda name=name: hundred(name)) for name in ("Ann", "Bob")]
    assert all(os.waitpid(child, 0)[1] == 0 for child in children)
    records = read_log(log)
    assert [record["sequence"] for record in records] == list(range(1, 201))
    for name in ("Ann", "Bob"):
        assert [
            int(record["digest"], 16) for record in records if record["reviewer"] == name
        ] == list(range(100))


def test_a_killed_process_loses_no_confirmed_approval(
    tmp_path: Path, document: PlanDocument
) -> None:
    log = tmp_path / "approvals.jsonl"
    chance, confirmed = random.Random(0), 0
    for _round in range(20):
        reader, writer = os.pipe()

        def approve_on(writer: int = writer) -> None:
            while True:
                os.write(
                    writer,
                    f"{approve(document, log, 'Ann', ['all']).record['sequence']}\n".encode(),
                )

        child = fork(approve_on)
        os.close(writer)
        with os.fdopen(reader) as told:
            for _approval in range(chance.randrange(1, 4)):
                confirmed = int(told.readline())
            time.sleep(chance.uniform(0, 0.01))
            os.kill(child, signal.SIGKILL)
            os.waitpid(child, 0)
            confirmed = max([confirmed, *map(int, told.read().split())])
        assert not check_log(log).problems and len(read_log(log)) >= confirmed
    assert confirmed > 0
    assert append(log, {"event": "rejected"}).record["sequence"] > confirmed


def test_a_log_that_cannot_be_written_is_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PlannerError, match="cannot be made"):
        append(tmp_path / "file" / "approvals.jsonl", {"event": "approved"})
    (tmp_path / "folder.jsonl").mkdir()
    with pytest.raises(PlannerError, match="cannot be read"):
        read_log(tmp_path / "folder.jsonl")


def test_a_refusal_says_how_many_more_problems_there_are(whole: Path) -> None:
    seen = set()
    for broken in ([0], [0, 2], [0, 2, 3]):

        def change(lines: list[bytes], broken: list[int] = broken) -> list[bytes]:
            return [b"{}\n" if number in broken else line for number, line in enumerate(lines)]

        with copy_of(whole, change) as log:
            more = len(check_log(log).problems) - 1
            with pytest.raises(PlannerError) as caught:
                read_log(log)
        seen.add(more > 0)
        assert (f"(and {more} more; plannerft verify" in str(caught.value)) == (more > 0)
    assert True in seen
