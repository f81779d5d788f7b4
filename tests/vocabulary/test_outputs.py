"""An answer is one JSON object, or a reason why it is none."""

from __future__ import annotations

import math
from typing import Any

import pytest

from planner_ft.vocabulary.plans import parse_output

DIGITS = "9" * 300


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        (None, "empty"),
        ("", "empty"),
        (" \n", "empty"),
        ("no", "not JSON (Expecting value at character 0)"),
        ("{", "not JSON (Expecting property name enclosed in double quotes at character 1)"),
        ('{"tasks": []} {"tasks": []}', "not JSON (Extra data at character 14)"),
        ('```json\n{"tasks": []}\n```', "not JSON (Expecting value at character 0)"),
        ('Here: {"tasks": []}', "not JSON (Expecting value at character 0)"),
        *((text, "JSON, but no object") for text in ("[]", '"a"', "1", "null")),
        ('{"tasks": NaN}', "not JSON (NaN is no JSON number)"),
        ('{"tasks": -Infinity}', "not JSON (-Infinity is no JSON number)"),
        ('{"tasks": 1e999}', "not JSON (1e999 is no JSON number)"),
        (f'{{"tasks": {DIGITS}.5e99}}', f"not JSON ({DIGITS[:20]} is no JSON number)"),
        (f'{{"a":{DIGITS}9}}', f"not JSON ({DIGITS[:20]}... is no JSON number)"),
        ('{"tasks": "\\ud800"}', "not JSON (half of a surrogate pair in a string)"),
        ("[" * 100_000, "not JSON (nested too deeply)"),
        ({"tasks": math.nan}, "not JSON (NaN is no JSON number)"),
    ],
)
def test_anything_but_one_json_object_is_no_plan(text: Any, problem: str) -> None:
    found = parse_output(text)
    assert (found.plan, found.problem) == (None, problem)


@pytest.mark.parametrize(
    ("text", "plan"),
    [
        (' \n{"tasks": []}\n', {"tasks": []}),
        ({"tasks": []}, {"tasks": []}),
        (f'{{"a": {DIGITS}}}', {"a": int(DIGITS)}),
        ('{"a": "\\ud83d\\ude00"}', {"a": "\N{GRINNING FACE}"}),
        ('{"working": "1+1=2", "skill_sequence": []}', {"skill_sequence": []}),
        # What is no working, or stands in another plan, is a wrong key.
        ('{"working": 2, "skill_sequence": []}', {"working": 2, "skill_sequence": []}),
        ('{"working": "1+1=2", "tasks": []}', {"working": "1+1=2", "tasks": []}),
    ],
)
def test_an_object_is_read_without_its_working(text: Any, plan: dict[str, Any]) -> None:
    found = parse_output(text)
    assert (found.plan, found.problem) == (plan, None)
