"""Numbers as they are written."""

import pytest

from planner_ft.data.numerals import signed


@pytest.mark.parametrize(
    ("text", "value"), [("12.5", 12.5), ("-3", -3.0), ("−3", -3.0), ("–0.5", -0.5)]
)
def test_a_dash_can_be_a_minus(text: str, value: float) -> None:
    assert signed(text) == value


@pytest.mark.parametrize("text", ["", "twelve", "3-4"])
def test_nothing_else_is_a_number(text: str) -> None:
    with pytest.raises(ValueError, match="could not convert"):
        signed(text)
