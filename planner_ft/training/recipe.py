"""Recipe files: a training run as a TOML file, whose first line is the command that runs it."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text

BUNDLED = Path(__file__).parent / "recipes"
RUN_KEYS = (
    "level",
    "candidate",
    "vocabulary",
    "data_dir",
    "train_file",
    "validation_file",
    "corrections",
    "output",
)
"""What a recipe may say besides settings: the flags of the same names. Paths are relative to the
working folder.
"""


@dataclass(frozen=True)
class Recipe:
    """A recipe file's content: `run` holds RUN_KEYS, `settings` the rest."""

    path: Path
    run: dict[str, str]
    settings: dict[str, Any]


def bundled_recipes() -> list[str]:
    """Names of the recipes that ship with the package."""
    return sorted(path.stem for path in BUNDLED.glob("*.toml"))


def load_recipe(name_or_path: str, problems: list[str]) -> Recipe:
    """Read a bundled recipe by name or any by path. Values of the wrong type are added to
    `problems`.

    Raises PlannerError when the file is missing or no TOML.
    """
    bundled = BUNDLED / f"{name_or_path}.toml"
    path = bundled if bundled.is_file() else Path(name_or_path)
    if not path.is_file():
        raise PlannerError(
            f"--recipe {name_or_path}: no such file, and no bundled recipe of that name"
            f" ({', '.join(bundled_recipes())})"
        )
    try:
        values = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None
    run = {key: values.pop(key) for key in RUN_KEYS if key in values}
    problems.extend(
        f"{path}: {key} = {value!r}: must be text"
        for key, value in run.items()
        if not isinstance(value, str)
    )
    return Recipe(
        path, {key: value for key, value in run.items() if isinstance(value, str)}, values
    )
