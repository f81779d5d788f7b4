"""Severities and names of warnings."""

from __future__ import annotations

from planner_ft.document.warnings import KINDS
from planner_ft.document.warnings.kinds import gravest_first, meaning


def test_every_kind_has_a_severity_and_a_name_of_its_own() -> None:
    found = [meaning(kind) for kind in KINDS]
    assert len({name for _severity, name in found}) == len(KINDS)
    assert {severity for severity, _name in found} == {"danger", "caution", "note"}


def test_the_gravest_stand_first_and_the_unknown_is_a_caution() -> None:
    kinds = ["endurance-open", "value-lost", "structure-close", "unresolved-location"]
    ordered = [one["kind"] for one in gravest_first([{"kind": kind} for kind in kinds])]
    assert ordered == ["structure-close", "value-lost", "unresolved-location", "endurance-open"]
    assert meaning("of-tomorrow") == ("caution", "Of tomorrow")
