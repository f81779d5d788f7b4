"""A training run as requested: flags, recipe file, every name resolved, every setting checked."""

import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, TypeVar

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.prompts import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.support.resources import cores
from planner_ft.training.settings import Origin, Source, TrainSettings, departures, resolve_settings
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

T = TypeVar("T")
BUNDLED = Path(__file__).parent / "recipes"
LAUNCHED = {"ACCELERATE_USE_FSDP": "FSDP", "ACCELERATE_USE_DEEPSPEED": "DeepSpeed"}
"""Variables of accelerate's launcher for models in parts."""
WORTH_HELP = 600
"""Samples of all epochs from which a second process repays the ten seconds of its start."""
RUN_KEYS = (
    *("level", "candidate", "vocabulary", "data_dir", "train_file", "validation_file"),
    *("corrections", "output"),
)
"""Flags that a recipe may set besides settings. Paths are relative to the working folder."""


@dataclass(frozen=True)
class TrainRequest:
    """The model, data, settings and output folder of a run. `validation_file` is None without
    validation, `corrections` without added corrected plans.
    """

    level: Level
    candidate: Candidate
    vocabulary: Vocabulary
    train_file: Path
    validation_file: Path | None
    output: Path
    settings: TrainSettings
    origin: Origin
    overwrite: bool = False
    resume: bool = False
    corrections: Path | None = None
    processes: int = 1

    def fingerprint(
        self, training: str, validation: str | None, base_weights: str
    ) -> dict[str, Any]:
        """All that the learned weights depend on, with digests; a resumed run has the same."""
        return {
            "level": self.level,
            "candidate": self.candidate.name,
            "base_weights": base_weights,
            "vocabulary": self.vocabulary.sha256,
            "prompt_version": PROMPT_VERSION,
            "training_data": training,
            "validation_data": validation,
            "settings": self.settings.learned(),
            "processes": self.processes,
        }

    @property
    def is_helped(self) -> bool:
        """Whether a second process should do half of every batch: a small model has one CPU thread,
        and the run is long enough to repay the process's start.
        """
        from planner_ft.candidates.loading import resolve_device
        from planner_ft.training.model import SMALL_MODEL

        s, small = self.settings, (self.candidate.parameters or SMALL_MODEL) < SMALL_MODEL
        alone = s.threads or not small or s.batch_size == 1 or cores() == 1
        if alone or resolve_device(s.device).type != "cpu":
            return False
        files = [one for one in (self.train_file, self.corrections) if one and one.is_file()]
        written = sum(one.read_bytes().count(b"\n") for one in files)
        count = s.epochs * min(written * (1 + s.vary) + s.augment, s.max_samples or 10**9)
        return min(count, s.batch_size * (s.max_steps or count)) >= WORTH_HELP

    def departures(self) -> list[str]:
        """Sentences on published settings that this run does not use."""
        found = departures(self.level, self.settings, self.origin)
        each = self.settings.batch_size
        if self.processes > 1:
            shared = f"{each} for each of {self.processes} processes"
            found.append(f"batch size {each * self.processes} ({shared})")
        return found


def bundled_recipes() -> list[str]:
    """Names of the recipes that ship with the package."""
    return sorted(path.stem for path in BUNDLED.glob("*.toml"))


def load_recipe(name_or_path: str) -> tuple[str, dict[str, Any]]:
    """The path and the values of a recipe (TOML), bundled or any. Raises PlannerError."""
    bundled = BUNDLED / f"{name_or_path}.toml"
    path = bundled if bundled.is_file() else Path(name_or_path)
    if not path.is_file():
        there = ", ".join(bundled_recipes())
        problem = f"no such file, and no bundled recipe of that name ({there})"
        raise PlannerError(f"--recipe {name_or_path}: {problem}")
    return str(path), read_toml(path)


def build_request(
    run: dict[str, str | None],
    flags: dict[str, Any],
    *,
    recipe: str | None = None,
    overwrite: bool = False,
    resume: bool = False,
    ranks: Ranks = ALONE,
) -> TrainRequest:
    """Combine flags, recipe, the candidate's adapter settings, published ones and defaults. `run`
    holds RUN_KEYS, None where not given. Raises PlannerError that lists every problem.
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

    path, values = (attempt(load_recipe, recipe) if recipe else None) or ("", {})
    given = {key: values.pop(key) for key in RUN_KEYS if key in values}
    texts = {key: value for key, value in given.items() if isinstance(value, str)}
    problems += [
        f"{path}: {key} = {given[key]!r}: must be text" for key in given if key not in texts
    ]
    named = {**texts, **{key: value for key, value in run.items() if value is not None}}
    problems += _clashes(named, overwrite=overwrite, resume=resume)
    level = attempt(check_level, named.get("level"), "--level is missing: mission or task")
    names = "a name that `plannerft candidates` lists, a folder or a hub id"
    missing = f"--candidate is missing: {names}"
    candidate = attempt(resolve_candidate, named.get("candidate"), missing)
    vocabulary = attempt(load_vocabulary, named.get("vocabulary") or "usv")
    sources = [Source("flag", flags), Source(path, values)]
    if candidate and level and vocabulary:
        candidate = candidate.serving(vocabulary)
        sources.append(Source(candidate.name, candidate.adapter_defaults(level)))
    settings, origin = resolve_settings(level or "mission", sources, problems)
    if settings.select == "f1" and not settings.validation_answers:
        problems.append("--select f1 needs --validation-answers of at least 1")
    problems += launch_problems(ranks, settings)
    settings = replace(settings, device=ranks.device(settings.device))
    if problems or not (level and candidate and vocabulary):
        raise refusal("the configuration has", problems)
    output = Path(named.get("output") or Path("adapters") / candidate.slug / level)
    folder = Path(named.get("data_dir") or vocabulary.data / level)
    files: tuple[Path, Path | None] = (folder / "train.jsonl", folder / "validation.jsonl")
    if named.get("train_file"):
        files = Path(named["train_file"]), _path(named.get("validation_file"))
    corrections = _path(named.get("corrections"))
    paths, again = (*files, output), (overwrite, resume)
    return TrainRequest(
        level, candidate, vocabulary, *paths, settings, origin, *again, corrections, ranks.batches
    )


def _clashes(named: dict[str, Any], *, overwrite: bool, resume: bool) -> Iterator[str]:
    """Flags that exclude or need each other."""
    if overwrite and resume:
        yield "--overwrite and --resume exclude each other"
    if named.get("data_dir") and named.get("train_file"):
        yield "--data-dir and --train-file exclude each other"
    if named.get("validation_file") and not named.get("train_file"):
        both = "with --data-dir both files come from the folder"
        yield f"--validation-file needs --train-file; {both}"


def launch_problems(ranks: Ranks, settings: TrainSettings) -> list[str]:
    """What several processes, as a launcher started them, cannot do."""
    if ranks.world == 1:
        return []
    import torch

    problems, count = [], torch.cuda.device_count()
    if settings.device.startswith("cuda:"):
        each = "each process takes a GPU of its own; leave it out"
        problems.append(f"--device {settings.device}: {each}")
    elif settings.device != "cpu" and 0 < count <= ranks.local:
        fewer = f"start {count}, or give --device cpu"
        problems.append(f"more processes than the {count} GPUs of this machine: {fewer}")
    for name, text in LAUNCHED.items():
        if os.environ.get(name, "false").lower() in ("true", "1"):
            problems.append(f"{text}: every process holds the whole model; launch with --multi_gpu")
    asked = os.environ.get("ACCELERATE_MIXED_PRECISION", "no")
    if asked != "no":
        own = "the device's own precision is taken; launch with --mixed_precision no"
        problems.append(f"--mixed_precision {asked}: {own}")
    return problems


def refusal(title: str, problems: list[str]) -> PlannerError:
    """The error for one problem, or for a numbered list of them under a title."""
    count = len(problems)
    if count == 1:
        return PlannerError(problems[0])
    lines = [f"  [{index}/{count}] {problem}" for index, problem in enumerate(problems, 1)]
    return PlannerError("\n".join([f"{title} {count} problems:", *lines]))


def _path(name: str | None) -> Path | None:
    return Path(name) if name else None
