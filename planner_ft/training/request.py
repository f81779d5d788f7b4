"""A training run as asked for: every name resolved, every setting checked."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.training.recipe import Recipe, load_recipe
from planner_ft.training.samples import Split
from planner_ft.training.settings import Resolved, Source, TrainSettings, resolve_settings
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, check_level

DEFAULT_VOCABULARY = "usv"


@dataclass(frozen=True)
class TrainRequest:
    """What to train, on what, with which settings, and where to.

    `validation_file` is None where there is no validation, `corrections` where nothing is added to
    the training split.
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
        """Everything that the learned weights depend on; a run is resumed only where all of it is
        as it was.
        """
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


def build_request(
    run: dict[str, str | None],
    flags: dict[str, Any],
    *,
    recipe: str | None = None,
    overwrite: bool = False,
    resume: bool = False,
) -> TrainRequest:
    """Put together flags, recipe, the candidate's own adapter settings, published settings and
    defaults, in this order.

    `run` holds level, candidate, vocabulary, data_dir, train_file, validation_file, corrections and
    output, None where not given. Raises PlannerError that lists every problem, not the first.
    """
    problems: list[str] = []
    loaded: Recipe | None = (
        _attempt(lambda name: load_recipe(name, problems), recipe, "", problems) if recipe else None
    )
    said = {
        **(loaded.run if loaded else {}),
        **{key: value for key, value in run.items() if value is not None},
    }
    if overwrite and resume:
        problems.append("--overwrite and --resume exclude each other")
    if said.get("data_dir") and said.get("train_file"):
        problems.append("--data-dir and --train-file exclude each other")
    if said.get("validation_file") and not said.get("train_file"):
        problems.append(
            "--validation-file needs --train-file; with --data-dir both files come from the folder"
        )
    level: Level | None = _attempt(
        check_level, said.get("level"), "--level is missing: mission or task", problems
    )
    missing = (
        "--candidate is missing: a name that `plannerft candidates` lists, a folder or a hub id"
    )
    candidate: Candidate | None = _attempt(
        resolve_candidate, said.get("candidate"), missing, problems
    )
    vocabulary: Vocabulary | None = _attempt(
        load_vocabulary, said.get("vocabulary") or DEFAULT_VOCABULARY, "", problems
    )
    sources = [Source("flag", flags, flags=True)] + (
        [Source(str(loaded.path), loaded.settings)] if loaded else []
    )
    if candidate and level:
        sources.append(Source(candidate.name, asdict(candidate.adapter_defaults(level))))
    resolved, found = resolve_settings(level or "mission", sources)
    problems += found
    if problems or not (level and candidate and vocabulary and resolved):
        raise PlannerError(
            problems[0] if len(problems) == 1 else listed("the configuration has", problems)
        )
    train_file, validation_file = _files(level, said)
    output = Path(said.get("output") or Path("adapters") / candidate.slug / level)
    corrections = Path(said["corrections"]) if said.get("corrections") else None
    return TrainRequest(
        level,
        candidate,
        vocabulary,
        train_file,
        validation_file,
        output,
        resolved,
        overwrite,
        resume,
        corrections,
    )


def listed(what: str, problems: list[str]) -> str:
    """A numbered list of problems as one message."""
    count = len(problems)
    lines = [f"  [{index}/{count}] {problem}" for index, problem in enumerate(problems, 1)]
    return "\n".join([f"{what} {count} problem{'s' if count > 1 else ''}:", *lines])


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


def _files(level: Level, said: dict[str, str]) -> tuple[Path, Path | None]:
    if said.get("train_file"):
        return Path(said["train_file"]), (
            Path(said["validation_file"]) if said.get("validation_file") else None
        )
    folder = Path(said.get("data_dir") or Path("data") / level)
    return folder / "train.jsonl", folder / "validation.jsonl"
