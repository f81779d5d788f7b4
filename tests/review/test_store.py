"""Files of a folder with plans, and what approvals and logs take at their bounds."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from planner_ft.document import PlanDocument, document_digest, write_document
from planner_ft.document.build import canonical
from planner_ft.review import approval_of, approve, desk, log_beside, reject
from planner_ft.review.approval import record_run
from planner_ft.review.desk import add_plan, open_desk, plan_names, settings_of, signature
from planner_ft.review.log import Head, append, head_file, read_chain, sealed
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary


def test_the_newest_200_plans_of_a_folder_are_offered(
    plan: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert desk.MOST_PLANS == 200
    for number in range(3):
        path = plan.with_name(f"more-{number}.json")
        path.write_bytes(plan.read_bytes())
        os.utime(path, (0, 1000 + number))
    os.utime(plan, (0, 0))
    (plan.parent / "folder.json").mkdir()
    for name, before in (("other", 250), ("near", 150)):
        text = " " * before + plan.read_text()
        plan.with_name(f"{name}.json").write_text(text)
        os.utime(plan.with_name(f"{name}.json"), (0, 1))
    newest = ["more-2.json", "more-1.json", "more-0.json", "near.json", "plan.json"]
    assert plan_names(plan.parent) == newest
    monkeypatch.setattr(desk, "MOST_PLANS", 2)
    assert plan_names(plan.parent) == newest[:2]


def test_plans_of_one_second_are_numbered_from_two(tmp_path: Path, document: PlanDocument) -> None:
    class Clock(desk.datetime):
        @classmethod
        def now(cls, tz: Any = None) -> Any:
            return cls(2030, 1, 2, 3, 4, 5, tzinfo=tz)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(desk, "datetime", Clock)
        names = [add_plan(tmp_path, document).name for _plan in range(3)]
    assert names == [f"plan-20300102-030405{more}.json" for more in ("", "-2", "-3")]


def test_a_signature_changes_with_the_file_and_is_none_without_one(plan: Path) -> None:
    before = signature(plan)
    assert before == signature(plan) is not None
    plan.write_bytes(plan.read_bytes() + b"\n")
    assert signature(plan) != before
    assert signature(None) is None and signature(plan.with_name("none")) is None


@pytest.mark.parametrize(
    ("name", "reason", "fits"),
    [
        ("x" * 200, "", True),
        ("x" * 201, "", False),
        ("Ann", "x" * 2000, True),
        ("Ann", "x" * 2001, False),
        ("Ann", "\ud800", False),
    ],
)
def test_names_have_200_characters_and_reasons_2000(
    plan: Path, document: PlanDocument, name: str, reason: str, *, fits: bool
) -> None:
    log = log_beside(plan)
    if fits:
        assert approve(document, log, name, ["all"], reason).record["reason"] == reason
    else:
        with pytest.raises(PlannerError):
            approve(document, log, name, ["all"], reason)
        assert not log.exists()


def test_a_run_is_recorded_without_its_plan_and_decides_nothing(
    plan: Path, document: PlanDocument
) -> None:
    log = log_beside(plan)
    approve(document, log, "Ann", ["all"], "good")
    record = record_run("run", document, log, " Bo ", "at speed 1").record
    assert (record["plan"], record["event"], record["reviewer"]) == (None, "run", "Bo")
    found = approval_of(document, log)
    assert found.status == "approved" and found.text.endswith("(record 1): good")
    with pytest.raises(PlannerError, match="needs the name"):
        record_run("run", document, log, " ", "")


def test_an_approval_of_an_earlier_version_counts_the_changes(
    plan: Path, document: PlanDocument
) -> None:
    log = log_beside(plan)
    approve(document, log, "Ann", ["all"])
    for values, count in (
        ({"valid": False}, "1 change"),
        ({"valid": False, "complete": True}, "2 changes"),
    ):
        other = {**document, **values}
        found = approval_of({**other, "digest": document_digest(other)}, log)
        assert found.status == "altered" and found.text.endswith(f"(record 1): {count}")
    reject(document, log, "Bo", "no")
    assert approval_of(document, log).text.startswith("rejected by Bo at ")
    another = {**document, "command": "x", "proposed": {}, "manifest": {}}
    assert approval_of({**another, "digest": document_digest(another)}, log).status == "unknown"
    forged = approval_of({**another, "digest": "0" * 64}, log)
    assert (forged.status, forged.reviewer) == ("altered", None)
    assert "holds no approval of it" in forged.text


# ---------------------------------------------------------------- the chain


def chain_of(count: int) -> tuple[bytes, list[Head]]:
    """The bytes of a log, and its ends from the beginning."""
    lines, ends = b"", [Head(0, "0" * 64)]
    for number in range(count):
        record = sealed({"event": "approved", "number": number}, ends[-1])
        lines += canonical(record) + b"\n"
        ends.append(Head(record["sequence"], record["hash"]))
    return lines, ends


@pytest.mark.parametrize(
    ("count", "head", "said"),
    [
        (0, None, None),
        (1, None, "head file is missing"),
        (2, None, "head file is missing"),
        (3, 3, None),
        (3, 2, None),
        (3, 1, "the head file ends at record 1, the log at record 3"),
        (1, 0, None),
        (2, 0, "the head file ends at record 0, the log at record 2"),
        (3, 4, "line 4 is missing: record 4 is known"),
        (3, 5, "line 4 is missing: records 4 to 5 are known"),
    ],
)
def test_a_head_file_may_be_one_record_behind(
    count: int, head: int | None, said: str | None
) -> None:
    lines, ends = chain_of(max(count, head or 0))
    data = b"".join(lines.splitlines(keepends=True)[:count])
    chain = read_chain(data, None if head is None else ends[head])
    assert (len(chain.records), chain.lines) == (0 if said else count, count)
    assert [said in problem.text for problem in chain.problems] == [True] * (said is not None)
    assert chain.end == (ends[0] if said else ends[count])


@pytest.mark.parametrize("count", [1, 3])
def test_a_head_of_another_record_says_which_line_was_replaced(count: int) -> None:
    lines, ends = chain_of(count)
    chain = read_chain(lines, Head(count, ends[count - 1].hash))
    assert [(one.line, one.text) for one in chain.problems] == [
        (
            count,
            f"line {count} (record {count}) is not the record that the head file knows;"
            " it was replaced",
        )
    ]


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (b"\xff", "line 2 is no UTF-8 text; it was changed"),
        (b"{", "line 2 is not JSON"),
        (b"[]", "line 2 is no record; it was changed"),
        (b'{"hash":"x"}', "line 2 is no record; it was changed"),
        (b'{"hash":"x","sequence":true}', "line 2 is no record; it was changed"),
        (b'{"hash":"x","sequence":7}', "line 2 (record 7) is not what was recorded"),
    ],
)
def test_what_is_wrong_with_a_line_is_said_once(line: bytes, said: str) -> None:
    first, _second, third = chain_of(3)[0].splitlines()
    chain = read_chain(b"\n".join([first, line, third, b""]), chain_of(3)[1][3])
    assert len(chain.problems) == 1 and chain.problems[0].text.startswith(said)
    torn = read_chain(b"\n".join([first, b"torn"]), chain_of(1)[1][1])
    assert torn.torn == b"torn" and len(torn.records) == 1 and not torn.problems


@pytest.mark.parametrize("head", ["{}", '{"sequence": -1, "hash": ""}', '{"sequence": 0}', "[]"])
def test_a_head_file_that_is_none_stops_all(plan: Path, head: str) -> None:
    log = log_beside(plan)
    append(log, {"event": "approved"})
    head_file(log).write_text(head)
    with pytest.raises(PlannerError, match="holds no sequence and hash"):
        append(log, {"event": "approved"})


# ---------------------------------------------------------------- the agents of a plan


def test_a_plan_is_gone_on_with_by_the_agents_that_made_it(
    plan: Path, document: PlanDocument, usv: Vocabulary, tmp_path: Path
) -> None:
    made = {"candidate": "Qwen", "configuration": "lora", "adapter": str(tmp_path)}
    lost = {**made, "adapter": str(tmp_path / "none")}
    planned = {**document, "manifest": {"agents": {"mission": made, "task": lost}}}
    found = settings_of(planned, usv)
    assert (found.mission_candidate, found.task_candidate) == ("Qwen", "Qwen")
    assert (found.mission_adapter, found.task_adapter) == (str(tmp_path), None)
    other = settings_of(planned, usv, "Other")
    assert other.candidate == "Other" and other.mission_candidate is None
    with pytest.raises(PlannerError, match="give the number of a task to ask for it anyway"):
        open_desk(plan, None, None, None).edit("skills")
    assert json.loads(plan.read_text())["edits"] == []


def test_a_plan_can_be_written_beside_its_log(plan: Path, document: PlanDocument) -> None:
    write_document(plan, document)
    assert log_beside(plan) == plan.parent / "approvals.jsonl"
