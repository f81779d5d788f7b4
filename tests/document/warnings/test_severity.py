"""Severities and names of warnings."""

from __future__ import annotations

from planner_ft.document.warnings import KINDS, NOTES, SERIOUS
from planner_ft.document.warnings.case import gravest_first, meaning, quoted, warning


def test_every_kind_has_a_severity_and_a_name_of_its_own() -> None:
    found = [meaning(kind) for kind in KINDS]
    assert len({name for _severity, name in found}) == len(KINDS)
    assert {severity for severity, _name in found} == {"danger", "caution", "note"}


def test_the_gravest_stand_first_and_the_unknown_is_a_caution() -> None:
    kinds = ["endurance-open", "value-lost", "structure-close", "unresolved-location"]
    ordered = [one["kind"] for one in gravest_first([{"kind": kind} for kind in kinds])]
    assert ordered == ["structure-close", "value-lost", "unresolved-location", "endurance-open"]
    assert meaning("of-tomorrow") == ("caution", "Of tomorrow")


def test_words_are_quoted_to_120_characters_at_a_blank() -> None:
    text = "a" * 60 + " " + "b" * 59
    assert quoted(f" {text}\n") == text
    assert quoted(f"{text}b") == "a" * 60 + " ..."
    assert quoted("c" * 121) == "c" * 120 + " ..."


def test_the_id_of_a_warning_says_what_it_is_about() -> None:
    about = {"id": "t2", "number": 2, "title": "Transit"}
    made = warning("stale-skills", task=about)
    assert made["id"] == "stale-skills:t2" and made["text"].startswith(
        "Task 2, Transit was changed"
    )
    assert warning("not-planned", about="tow", words="tow")["id"] == "not-planned:tow"
    asked = warning("value-not-said", "unsaid", about, "radius", "x", name="radius", value="9 m")
    assert asked["id"] == "value-not-said:t2:radius:x"
    assert set(SERIOUS) | set(NOTES) == set(KINDS) and not set(SERIOUS) & set(NOTES)
