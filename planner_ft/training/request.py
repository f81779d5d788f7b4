"""A training run as requested: flags, recipe file, every name resolved, every setting checked."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, TypeVar

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.training.samples import Split
from planner_ft.training.settings import Resolved, Source, TrainSettings, resolve_settings
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

T = TypeVar("T")
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


def bundled_recipes() -> list[str]:
    """Names of the recipes that ship with the package."""
    return sorted(path.stem for path in BUNDLED.glob("*.toml"))


def load_recipe(name_or_path: str, problems: list[str]) -> tuple[dict[str, str], Source]:
    """The RUN_KEYS and the settings of a recipe (TOML), bundled or any; wrong types are problems.

    Raises PlannerError when the file is missing or no TOML.
    """
    bundled = BUNDLED / f"{name_or_path}.toml"
    path = bundled if bundled.is_file() else Path(name_or_path)
    if not path.is_file():
        neither = (
            f"no such file, and no bundled recipe of that name ({', '.join(bundled_recipes())})"
        )
        raise PlannerError(f"--recipe {name_or_path}: {neither}")
    try:
        values = tomllib.loads(read_text(path))
    except tomllib.TOMLDecodeError as error:
        raise PlannerError(f"{path}: not TOML: {error}") from None
    run = {key: values.pop(key) for key in RUN_KEYS.split() if key in values}
    wrong = {key: value for key, value in run.items() if not isinstance(value, str)}
    problems += [f"{path}: {key} = {value!r}: must be text" for key, value in wrong.items()]
    return {key: run[key] for key in run if key not in wrong}, Source(str(path), values)


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

    def attempt(function: Callable[[str], T], value: str | None, missing: str = "") -> T | None:
        """`function(value)`, or None with its error among the problems."""
        try:
            if value is None:
                raise PlannerError(missing)
            return function(value)
        except PlannerError as error:
            problems.append(str(error))
            return None

    loaded = attempt(lambda name: load_recipe(name, problems), recipe) if recipe else None
    given = {**(loaded[0] if loaded else {}), **{k: v for k, v in run.items() if v is not None}}
    if overwrite and resume:
        problems.append("--overwrite and --resume exclude each other")
    if given.get("data_dir") and given.get("train_file"):
        problems.append("--data-dir and --train-file exclude each other")
    if given.get("validation_file") and not given.get("train_file"):
        both = "with --data-dir both files come from the folder"
        problems.append(f"--validation-file needs --train-file; {both}")
    level = attempt(check_level, given.get("level"), "--level is missing: mission or task")
    names = "a name that `plannerft candidates` lists, a folder or a hub id"
    missing = f"--candidate is missing: {names}"
    candidate = attempt(resolve_candidate, given.get("candidate"), missing)
    vocabulary = attempt(load_vocabulary, given.get("vocabulary") or DEFAULT_VOCABULARY)
    sources = [Source("flag", flags, flags=True), *([loaded[1]] if loaded else [])]
    if candidate and level:
        sources.append(Source(candidate.name, asdict(candidate.adapter_defaults(level))))
    resolved, found = resolve_settings(level or "mission", sources)
    problems += found
    if problems or not (level and candidate and vocabulary and resolved):
        raise refusal("the configuration has", problems)
    output = Path(given.get("output") or Path("adapters") / candidate.slug / level)
    files, corrections = _files(level, given), _path(given.get("corrections"))
    return TrainRequest(
        level, candidate, vocabulary, *files, output, resolved, overwrite, resume, corrections
    )


def listed(title: str, problems: list[str]) -> str:
    """A numbered list of problems as one message."""
    count = len(problems)
    lines = [f"  [{index}/{count}] {problem}" for index, problem in enumerate(problems, 1)]
    return "\n".join([f"{title} {count} problem{'s' if count > 1 else ''}:", *lines])


def refusal(title: str, problems: list[str]) -> PlannerError:
    """The error for one problem, or for a list of them."""
    return PlannerError(problems[0] if len(problems) == 1 else listed(title, problems))


def _path(name: str | None) -> Path | None:
    return Path(name) if name else None


def _files(level: Level, given: dict[str, str]) -> tuple[Path, Path | None]:
    if train := given.get("train_file"):
        return Path(train), _path(given.get("validation_file"))
    folder = Path(given.get("data_dir") or Path("data") / level)
    return folder / "train.jsonl", folder / "validation.jsonl"
