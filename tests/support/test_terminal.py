"""Texts of models, servers and files on a terminal."""

from __future__ import annotations

import json

import pytest
from rich.table import Table
from rich.text import Text

from planner_ft.support.terminal import plain, show, terminal

HOSTILE = "a\x1b[2J\x00b\x9b31m\u202ec\x7f\udcffd\r"


def test_what_a_terminal_would_obey_is_escaped() -> None:
    assert plain(HOSTILE) == r"a\u001b[2J\u0000b\u009b31m\u202ec\u007f\udcffd\r"
    assert plain("95 % é\u00a0🚤\u2009m") == "95 % é\u00a0🚤\u2009m"
    assert plain("a\nb\tc", "\n\t") == "a\nb\tc"
    document = json.dumps({"text": HOSTILE}, ensure_ascii=False)
    assert json.loads(plain(document)) == {"text": HOSTILE}


def test_lines_and_tables_are_plain(capsys: pytest.CaptureFixture[str]) -> None:
    show(f"{HOSTILE}\nnext")
    show(HOSTILE, error=True)
    table = Table()
    table.add_column(HOSTILE)
    table.add_row(Text(HOSTILE))
    terminal(width=200).print("[bold]", HOSTILE, Text(HOSTILE), table)
    out, err = capsys.readouterr()
    assert out.startswith(f"{plain(HOSTILE)}\nnext\n[bold] ")
    assert out.count(r"a\u001b[2J") == 5
    assert {one for one in out + err if not one.isprintable()} == {"\n"}
