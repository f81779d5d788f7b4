"""Formats: which there are, adding one, and their account of random plans."""

from __future__ import annotations

from importlib.metadata import EntryPoint
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings

from planner_ft.exporters import DRAFT, Format, Origin, PlanExport, Written, formats, load_format
from planner_ft.exporters.formats import GROUP, known_formats
from planner_ft.support.errors import PlannerError

from .plans import BUOY, DRONE, MAST, USV, document, documents, step, task

OURS = Format(
    "ours",
    ".txt",
    "for our own vehicle",
    needs_origin=False,
    write=lambda plan_export: Written(plan_export.name, plan_export.ledger().close()),
)
NOT_OURS = "no format"


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> None:
    entries = [
        EntryPoint("ours", f"{__name__}:OURS", GROUP),
        EntryPoint("broken", "no_such_package:FORMAT", GROUP),
        EntryPoint("wrong", f"{__name__}:NOT_OURS", GROUP),
    ]
    monkeypatch.setattr(formats, "entry_points", lambda group: entries if group == GROUP else [])


@pytest.mark.usefixtures("added")
def test_a_lab_adds_a_format_of_its_own() -> None:
    assert list(known_formats())[-3:] == ["ours", "broken", "wrong"]
    assert load_format("ours") is OURS


@pytest.mark.usefixtures("added")
@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("broken", "cannot be loaded"),
        ("wrong", "is no planner_ft.exporters.Format"),
        ("qgcc", "must be one of qgc, waypoints"),
    ],
)
def test_a_format_that_cannot_be_used_says_why(name: str, said: str) -> None:
    with pytest.raises(PlannerError, match=said) as raised:
        load_format(name)
    assert str(raised.value).startswith(f"--format {name}: ")


def test_a_draft_is_called_one() -> None:
    plan = document(MAST)
    assert PlanExport(plan, USV).name.startswith(DRAFT) and PlanExport(plan, USV).mark == DRAFT
    approved = PlanExport(plan, USV, approval="approved by Ada")
    assert DRAFT not in approved.name and approved.mark == "approved by Ada"


def test_what_waits_for_a_place_blocks_the_rest() -> None:
    plan_export = PlanExport(document(BUOY), USV)
    assert plan_export.ready == 1
    assert plan_export.blocked is not None and 't2 waits for "green buoy"' in plan_export.blocked[1]
    assert PlanExport(document(MAST), USV).blocked is None


def test_a_task_without_skills_blocks_the_rest_unless_its_parameters_say_the_movement() -> None:
    transit, hold = (
        task("Transit", {"target_position": [5, 5]}, None),
        task("KeepStation", {"duration": 5}, None),
    )
    assert PlanExport(document([transit, transit]), USV).blocked is None
    assert PlanExport(document([transit, hold, transit]), USV).ready == 1


def test_a_step_of_unknown_movement_blocks_nothing() -> None:
    arc = task(
        "GlareFreeApproach",
        {},
        [step("ArcTurn", {"delta_yaw": 40}), step("GoToXY", {"x": 5, "y": 5})],
    )
    assert PlanExport(document([arc]), USV).blocked is None


@pytest.mark.parametrize("vocabulary", [USV, DRONE], ids=lambda vocabulary: vocabulary.name)
@pytest.mark.parametrize("name", formats.BUNDLED)
def test_nothing_is_dropped_silently(name: str, vocabulary: Any) -> None:
    @settings(max_examples=20, suppress_health_check=[HealthCheck.too_slow])
    @given(documents(vocabulary))
    def check(plan: dict[str, Any]) -> None:
        plan_export = PlanExport(plan, vocabulary, Origin(59.9, 10.7))
        try:
            account = load_format(name).write(plan_export).account
        except PlannerError as error:
            assert "nothing of the plan can be written" in str(error)
            return
        said = set(plan_export.ledger().items)
        assert (
            account.carried | account.lost_paths == said
            and not account.carried & account.lost_paths
        )
        assert account.changed_paths <= account.carried
        assert all(loss.what and loss.why for loss in (*account.lost, *account.changed))

    check()


@pytest.mark.parametrize("name", formats.BUNDLED)
def test_a_file_says_that_it_is_a_draft_and_who_approved_it(name: str) -> None:
    chosen, plan = load_format(name), document(MAST)
    draft = chosen.write(PlanExport(plan, USV, Origin(59.9, 10.7))).text
    approved = chosen.write(
        PlanExport(plan, USV, Origin(59.9, 10.7), approval="approved by Ada at noon (record 7)")
    ).text
    assert DRAFT in draft and DRAFT not in approved
    assert "approved by Ada" in approved or name == "waypoints"


@pytest.mark.parametrize("name", formats.BUNDLED)
def test_500_tasks(name: str) -> None:
    plan = document([*MAST * 125])
    assert len(load_format(name).write(PlanExport(plan, USV, Origin(59.9, 10.7))).text) > 50_000
