"""A training run as requested: flags, recipe file, every name resolved, every setting checked."""

from __future__ import annotations

import tomllib
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.training.samples import Split
from planner_ft.training.settings import Resolved, Source, TrainSettings, resolve_settings
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

DEFAULT_VOCABULARY = "usv"
BUNDLED = Path(__file__).parent / "recipes"
RUN_KEYS = "level candidate vocabulary data_dir train_file validation_file corrections output"
"""Flags that a recipe may set besides settings. Paths are relative to the working folder."""


@dataclass(frozen=True)
class TrainRequest:
    """The model, data, settings and output folder of a run.

    `validation_file` is None without validation, `corrections` without added corrected plans.
    """

    level: Level
    candidate: Candidate
    vocabulary: Vocabulary
    train_file: Path
    validation_file: Path | None
    output: Path
    resolved: Resolved
    overwrite: bool = False
    resume: bool = False
    corrections: Path | None = None

    @property
    def settings(self) -> TrainSettings:
        return self.resolved.settings

    def fingerprint(
        self, train: Split, validation: Split | None, base_sha256: str
    ) -> dict[str, Any]:
        """Everything that the learned weights depend on; a resumed run must have the same."""
        return {
            "level": self.level,
            "candidate": self.candidate.name,
            "base_weights": base_sha256,
            "vocabulary": self.vocabulary.sha256,
            "prompt_version": PROMPT_VERSION,
            "training_data": train.sha256,
            "validation_data": validation.sha256 if validation else None,
            "settings": self.settings.learned(),
        }


@dataclass(frozen=True)
class Recipe:
    """A recipe file (TOML): `run` holds its RUN_KEYS, `settings` the rest."""

    path: Path
    run: dict[str, str]
    settings: dict[str, Any]


def bundled_recipes() -> list[str]:
    """Names of the recipes that ship with the package."""
    return sorted(path.stem for path in BUNDLED.glob("*.toml"))


def load_recipe(name_or_path: str, problems: list[str]) -> Recipe:
    """Read a bundled recipe by name or any by path; values of a wrong type go to `problems`.

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
    run = {key: values.pop(key) for key in RUN_KEYS.split() if key in values}
    wrong = {key: value for key, value in run.items() if not isinstance(value, str)}
    problems += [f"{path}: {key} = {value!r}: must be text" for key, value in wrong.items()]
    return Recipe(path, {key: run[key] for key in run if key not in wrong}, values)


def build_request(
    run: dict[str, str | None],
    flags: dict[str, Any],
    *,
    recipe: str | None = None,
    overwrite: bool = False,
    resume: bool = False,
) -> TrainRequest:
    """Combine flags, recipe, the candidate's adapter settings, published ones and defaults.

    `run` holds RUN_KEYS, None where not given. Raises PlannerError that lists every problem.
    """
    problems: list[str] = []
    loaded: Recipe | None = None
    if recipe:
        loaded = _attempt(lambda name: load_recipe(name, problems), recipe, "", problems)
    given = {key: value for key, value in run.items() if value is not None}
    given = {**(loaded.run if loaded else {}), **given}
    if overwrite and resume:
        problems.append("--overwrite and --resume exclude each other")
    if given.get("data_dir") and given.get("train_file"):
        problems.append("--data-dir and --train-file exclude each other")
    if given.get("validation_file") and not given.get("train_file"):
        problems.append(
            "--validation-file needs --train-file; with --data-dir both files come from the folder"
        )
    missing = "--level is missing: mission or task"
    level: Level | None = _attempt(check_level, given.get("level"), missing, problems)
    missing = (
        "--candidate is missing: a name that `plannerft candidates` lists, a folder or a hub id"
    )
    name = given.get("candidate")
    candidate: Candidate | None = _attempt(resolve_candidate, name, missing, problems)
    name = given.get("vocabulary") or DEFAULT_VOCABULARY
    vocabulary: Vocabulary | None = _attempt(load_vocabulary, name, "", problems)
    sources = [Source("flag", flags, flags=True)]
    if loaded:
        sources.append(Source(str(loaded.path), loaded.settings))
    if candidate and level:
        sources.append(Source(candidate.name, asdict(candidate.adapter_defaults(level))))
    resolved, found = resolve_settings(level or "mission", sources)
    problems += found
    if problems or not (level and candidate and vocabulary and resolved):
        one = len(problems) == 1
        raise PlannerError(problems[0] if one else listed("the configuration has", problems))
    train_file, validation_file = _files(level, given)
    corrections = Path(given["corrections"]) if given.get("corrections") else None
    return TrainRequest(
        level,
        candidate,
        vocabulary,
        train_file,
        validation_file,
        Path(given.get("output") or Path("adapters") / candidate.slug / level),
        resolved,
        overwrite,
        resume,
        corrections,
    )


def listed(title: str, problems: list[str]) -> str:
    """A numbered list of problems as one message."""
    count = len(problems)
    lines = [f"  [{index}/{count}] {problem}" for index, problem in enumerate(problems, 1)]
    return "\n".join([f"{title} {count} problem{'s' if count > 1 else ''}:", *lines])


def _attempt(function: Any, value: str | None, missing: str, problems: list[str]) -> Any:
    """`function(value)`, or None with its error among the problems."""
    if value is None:
        problems.append(missing)
        return None
    try:
        return function(value)
    except PlannerError as error:
        problems.append(str(error))
        return None


def _files(level: Level, given: dict[str, str]) -> tuple[Path, Path | None]:
    if train := given.get("train_file"):
        validation = given.get("validation_file")
        return Path(train), Path(validation) if validation else None
    folder = Path(given.get("data_dir") or Path("data") / level)
    return folder / "train.jsonl", folder / "validation.jsonl"
