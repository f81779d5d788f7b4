"""Every option of every command has its help."""

from __future__ import annotations

import inspect
import tomllib
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

import planner_ft.cli
from planner_ft.cli import train
from planner_ft.cli.app import app

TEXTS: dict[str, Any] = tomllib.loads(
    Path(planner_ft.cli.__file__).with_name("help.toml").read_text(encoding="utf-8")
)


def options() -> dict[str, dict[str, Any]]:
    """What typer is given of each parameter, by command and name."""
    return {
        command.callback.__name__: {
            name: item.annotation.__metadata__[0]
            for name, item in inspect.signature(command.callback).parameters.items()
            if hasattr(item.annotation, "__metadata__") or name != "context"
        }
        for command in app.registered_commands
        if command.callback is not None
    }


def test_every_option_has_help() -> None:
    found = options()
    assert len(found) == 20
    assert [
        (name, key) for name, given in found.items() for key, item in given.items() if not item.help
    ] == []


def test_every_help_text_belongs_to_an_option() -> None:
    for name, given in options().items():
        texts = TEXTS.get(name, {})
        keys = [key for key, value in texts.items() if not isinstance(value, dict)]
        keys += [key for value in texts.values() if isinstance(value, dict) for key in value]
        assert set(keys) <= set(given), name
    assert set(TEXTS["about"]) <= set(options())
    assert set(TEXTS) <= {"about", "shared", "options", *options()}


@pytest.mark.parametrize("command", sorted(options()))
def test_help_is_shown(command: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Help texts are rich markup, in which "[/...]" closes a tag; every name is whole."""
    monkeypatch.setattr("typer.rich_utils.MAX_WIDTH", 80)
    result = CliRunner().invoke(app, [command.replace("_", "-"), "--help"])
    assert result.exit_code == 0, result.exception
    assert "Usage" in result.output
    assert "…" not in result.output


def test_a_setting_that_a_recipe_turns_on_is_turned_off(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "recipe.toml").write_text("keep_checkpoints = true\n")
    seen: list[bool] = []
    monkeypatch.setattr(
        train, "_train", lambda request, *_: seen.append(request.settings.keep_checkpoints)
    )
    words = ["train", "--level", "mission", "--candidate", "embedded"]
    words += ["--recipe", str(tmp_path / "recipe.toml")]
    for flags in ([], ["--no-keep-checkpoints"], ["--keep-checkpoints"]):
        assert CliRunner().invoke(app, [*words, *flags]).exit_code == 0
    assert seen == [True, False, True]
