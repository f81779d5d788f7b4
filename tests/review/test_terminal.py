"""What a review in the terminal shows of a plan."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

import pytest
from rich.console import Console

from planner_ft.document import PlanDocument, document_digest, write_document
from planner_ft.review.approval import Approval, Change
from planner_ft.review.desk import open_desk
from planner_ft.review.terminal import Conversation, approval_text, review_lines
from planner_ft.vocabulary import Vocabulary
from tests.review.conftest import go, mission_document, task


@pytest.mark.parametrize(
    ("holds", "shown"), [(0, "m/s; ends"), (1, "of task 2"), (2, "of tasks 2, 3")]
)
def test_the_estimate_names_the_tasks_of_unknown_time(
    usv: Vocabulary, holds: int, shown: str
) -> None:
    there = task("Transit", {"target_position": [9, 2]}, "Go to [9, 2].")
    tasks = [there, *[task("KeepStation", {}, "Hold.")] * holds]
    document = mission_document("Go to [9, 2] and hold.", tasks, {1: go((9, 2))}, usv)
    approval = Approval("unknown", "no decision", "")
    lines = [text for text, _style in review_lines(document, approval, usv)]
    (estimate,) = [text for text in lines if "at a cruise speed" in text]
    assert shown in estimate


def styled(document: PlanDocument, approval: Approval, vocabulary: Vocabulary) -> dict[str, str]:
    return dict(review_lines(document, approval, vocabulary, columns=60))


def test_lines_are_coloured_by_how_grave_they_are(document: PlanDocument, usv: Vocabulary) -> None:
    found = styled(document, Approval("unknown", "no decision", ""), usv)
    assert found["no decision"] == "" and found["What will happen"] == "bold"
    assert found["2 warnings"] == "bold yellow"
    (warning,) = [text for text in found if text.startswith(" - caution: A place is not known. ")]
    assert found[warning] == "yellow" and warning.endswith("[unresolved-location:green buoy]")
    calm = {**document, "warnings": []}
    calm = {**calm, "digest": document_digest(calm)}
    assert styled(calm, Approval("approved", "yes", ""), usv)["No warnings"] == "bold"
    assert styled(calm, Approval("approved", "yes", ""), usv)["yes"] == "bold green"
    assert styled(calm, Approval("rejected", "no", ""), usv)["no"] == "bold red"
    one = {**calm, "warnings": document["warnings"][:1]}
    assert "1 warning" in styled(one, Approval("unknown", "", ""), usv)


def test_forty_changes_are_shown_and_the_rest_is_counted() -> None:
    for count, more in ((40, []), (41, [" - ... and 1 more; plannerft verify --json shows all"])):
        changes = tuple(Change("a", 1, 2, f"{number}") for number in range(count))
        shown = approval_text(Approval("altered", "altered", "", changes=changes))
        assert shown == ["altered", *(f" - {number}" for number in range(40)), *more]


class Talk:
    """A conversation whose reviewer types these lines, and what was printed and asked."""

    def __init__(self, plan: Path, *typed: str, by: str | None = None, width: int = 1000) -> None:
        self.asked: list[str] = []
        self.desk = open_desk(plan, None, None, by)
        lines, out = iter(typed), StringIO()

        def read(prompt: str) -> str:
            self.asked.append(prompt)
            if (line := next(lines, None)) is None:
                raise EOFError
            return line

        console = Console(file=out, width=width, color_system=None)
        Conversation(self.desk, console, read).converse()
        self.left = list(lines)
        self.printed = out.getvalue().splitlines()


def test_a_plan_is_approved_when_every_warning_is_acknowledged(plan: Path) -> None:
    talk = Talk(plan, "approve", "y", "y", " Ann ", "show")
    assert talk.asked[1:] == [*["acknowledged? y or n: "] * 2, "your name: "] and talk.left == [
        "show"
    ]
    assert any(line.startswith("1/2 Where green buoy is, ") for line in talk.printed)
    assert talk.printed[-1].startswith("approved by Ann: record 1 of ")
    assert not [line for line in talk.printed if "never finished" in line]
    again = Talk(plan, "A", "YES", "y", by="Bo")
    assert again.asked[1:] == ["acknowledged? y or n: "] * 2
    assert again.printed[-1].startswith("approved by Bo: record 2 of ")


def test_a_plan_is_rejected_for_a_reason(plan: Path) -> None:
    talk = Talk(plan, "", "r", "Ann", "too wide", "quit")
    assert talk.asked[2:] == ["your name: ", "reason: "] and talk.left == ["quit"]
    assert talk.printed[-1].startswith("rejected by Ann: record 1 of ")


@pytest.mark.parametrize("answer", ["n", "", "no"])
def test_nothing_is_approved_without_a_yes(plan: Path, answer: str) -> None:
    talk = Talk(plan, "a", answer, "quit", "more", by="Ann")
    assert talk.printed[-1] == "not approved" and talk.left == ["more"]
    assert not talk.desk.log.exists()


def test_what_is_typed_is_done_until_the_reviewer_quits(plan: Path) -> None:
    talk = Talk(plan, "3.radius=15", "3.radius=15", "fly", "adopt", "h", "s", "Q", "more")
    assert talk.left == ["more"]
    at = talk.printed.index(" - task 3, PerformOrbit: radius 12 -> 15")
    assert talk.printed[at + 1].startswith(" - task 3, PerformOrbit: prompt ")
    assert talk.printed[at + 2] == "saved; 3 warnings"
    assert "nothing is different" in talk.printed
    assert any(line.startswith("'fly': is no edit") for line in talk.printed)
    assert any("was not altered by hand" in line for line in talk.printed)
    assert any(line.endswith("  take over what was changed by hand") for line in talk.printed)
    assert talk.printed.count("What will happen") == 2


def test_a_plan_that_somebody_else_changed_is_read_and_shown_again(plan: Path) -> None:
    other = open_desk(plan, None, None, "Bo")
    original = Conversation.show

    def show(self: Conversation) -> None:
        original(self)
        if not other.document["edits"]:
            other.edit("3.radius=15")

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Conversation, "show", show)
        talk = Talk(plan, "3.radius=20", "3.radius=20")
    assert any("changed by somebody else" in line for line in talk.printed)
    assert talk.printed.count("What will happen") == 2
    assert " - task 3, PerformOrbit: radius 15 -> 20" in talk.printed


@pytest.mark.parametrize(("width", "widest"), [(60, 60), (200, 120)])
def test_the_track_is_at_most_120_columns_wide(
    tmp_path: Path, usv: Vocabulary, width: int, widest: int
) -> None:
    far = mission_document(
        "Go.", [task("Transit", {"target_position": [90, 9]})], {1: go((90, 9))}, usv
    )
    write_document(tmp_path / "plan.json", far)
    printed = Talk(tmp_path / "plan.json", width=width).printed
    start = printed.index("Track") + 1
    drawn = printed[start : printed.index("Estimate") - 1]
    assert widest - 12 < max(map(len, drawn[:-1])) <= widest


def test_sources_are_numbered_by_task_and_estimates_in_metres(
    document: PlanDocument, usv: Vocabulary
) -> None:
    found = styled(document, Approval("unknown", "", ""), usv)
    assert ' 3 radius = 12: command ("12 m")' in found
    assert any(
        line.startswith(' 4 target_position = [0,0]: derived ("come home"; home)') for line in found
    )
    going = [task("Transit", {"target_position": [30, 40]})]
    plan = mission_document("Go.", going, {1: go((30, 40))}, usv)
    lines = list(styled(plan, Approval("unknown", "", ""), usv))
    assert "50 m, 0:33 at a cruise speed of 1.5 m/s; ends 50 m from home" in lines
