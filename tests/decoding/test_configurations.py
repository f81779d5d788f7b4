from __future__ import annotations

import pytest

from planner_ft.decoding.configurations import STRENGTHS, parse_configuration
from planner_ft.support.errors import PlannerError


def test_names_read_back() -> None:
    for weights in ("base", "lora"):
        for strength in STRENGTHS:
            name = weights if strength == "free" else f"{weights}+{strength}"
            assert parse_configuration(name).name == name
    assert parse_configuration(" lora ").adapter
    assert not parse_configuration("base").adapter


@pytest.mark.parametrize("text", ["", "LORA", "lora+", "lora+magic", "base+free+free", "+free"])
def test_an_unknown_configuration_is_named_with_what_there_is(text: str) -> None:
    with pytest.raises(PlannerError, match=r"--configurations .*base, lora"):
        parse_configuration(text)
