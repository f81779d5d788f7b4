"""`plannerft skill train`: from settings to a folder with policy, card, manifest and log."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields, replace
from importlib import import_module
from pathlib import Path
from typing import Any

import torch

from planner_ft.skills.policies import (
    FILES,
    MANIFEST,
    SKILLS,
    WEIGHTS,
    check_same,
    read_policy,
    write_policy,
)
from planner_ft.support.alone import alone
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import make_folder, read_json, sha256_file
from planner_ft.support.terminal import Report, under

RECIPES = ("ours", "published")
SAMPLING = ("uniform", "l3")
TERMS = ("standoff", "progress", "visibility")
MOST_SEED = 2**63 - 1  # that torch takes
NO_EXTRA = "needs torchrl, which is not installed; pip install planner_ft[sim], or --recipe ours"


@dataclass(frozen=True)
class SkillTraining:
    """What is trained, and where to. `changes` are settings other than the recipe's own."""

    skill: str
    out: Path
    recipe: str = "ours"
    seed: int = 0
    sampling: str = "uniform"
    without: str | None = None
    goto: Path | None = None
    changes: Mapping[str, int] | None = None
    resume: bool = False
    overwrite: bool = False

    def __post_init__(self) -> None:
        """Raise PlannerError for what there is not."""
        for flag, value, known in (
            ("", self.skill, SKILLS),
            ("--recipe ", self.recipe, RECIPES),
            ("--sampling ", self.sampling, SAMPLING),
            ("--without ", self.without, (None, *TERMS)),
        ):
            if value not in known:
                names = ", ".join(str(one) for one in known if one)
                raise PlannerError(f"{flag}{value}: must be one of {names}")
        if not 0 <= self.seed <= MOST_SEED:
            raise PlannerError(f"--seed {self.seed}: must be from 0 to {MOST_SEED}")
        if self.recipe != "ours" and self.skill != "survey":
            raise PlannerError("--recipe: is of `skill train survey` alone; leave it out")
        published = self.skill == "survey" and self.recipe == "published"
        if not published and (self.sampling != "uniform" or self.without):
            which = "--sampling" if self.sampling != "uniform" else "--without"
            raise PlannerError(f"{which}: is of `skill train survey --recipe published` alone")
        if self.resume and self.overwrite:
            raise PlannerError("--overwrite and --resume exclude each other")
        if self.goto and self.skill != "survey":
            raise PlannerError("--goto: is of `skill train survey` alone; leave it out")

    @property
    def module(self) -> Any:
        """The module that trains by the recipe. Raises PlannerError without what it needs."""
        name = {"ours": "imitation", "published": "ppo"}[self.recipe]
        try:
            return import_module(f"{__package__}.{name if self.skill == 'survey' else 'tracking'}")
        except ImportError:
            raise PlannerError(f"--recipe {self.recipe}: {NO_EXTRA}") from None

    def settings(self) -> Any:
        """The settings of the recipe. Raises PlannerError."""
        kind, more = self.module.Settings, {"seed": self.seed}
        known = {one.name for one in fields(kind)}
        more |= self.module.HOLD if self.skill == "hold" else {}
        more |= {name: getattr(self, name) for name in ("sampling", "without") if name in known}
        for name, value in (self.changes or {}).items():
            if name not in known:
                raise PlannerError(f"--{name}: this recipe has no such setting; leave it out")
            if value < 1:
                raise PlannerError(f"--{name} {value}: must be 1 or more")
        return replace(kind(**more), **dict(self.changes or {}))


def train_skill(request: SkillTraining, report: Report) -> dict[str, Any]:
    """Train and write everything; the result of the manifest. Raises PlannerError."""
    settings = request.settings()
    with alone(request.out, "--out", "a training"):
        make_folder(request.out)
        _check_free(request)
        torch.set_num_threads(1)  # batches are small
        trained, inputs = _train(request, settings, report)
        result = {"iterations": len(trained["losses"]), **trained.get("result", {})}
        recipe = request.recipe if request.skill == "survey" else "ours"
        made = trained["policy"], asdict(settings), inputs, result
        write_policy(request.out, request.skill, recipe, *made)
    return result


def train_all(root: Path, report: Report, *, seed: int, resume: bool, overwrite: bool) -> None:
    """Train every skill that ships from nothing, the survey on the new goto, each into its folder
    of `root`. With `resume`, finished ones stay. Raises PlannerError, for finished ones that were
    made with another seed, too.
    """
    how: dict[str, Any] = {"seed": seed, "resume": resume, "overwrite": overwrite}
    goto = {"survey": root / "goto"}
    requests = [SkillTraining(s, root / s, goto=goto.get(s), **how) for s in SKILLS]
    undone = [one for one in requests if not (resume and _is_finished(one))]
    for request in undone:
        train_skill(request, under(request.skill, report))


def _is_finished(request: SkillTraining) -> bool:
    """Whether its policy is in its folder. Raises PlannerError when it is another one."""
    path = request.out / MANIFEST
    if not (path.is_file() and (request.out / WEIGHTS).is_file()):
        return False
    manifest = read_json(path)
    own, kept = asdict(request.settings()), manifest.get("configuration", {})
    if request.goto:
        own["goto"] = sha256_file(request.goto / WEIGHTS)
        kept["goto"] = manifest.get("inputs", {}).get("goto", {}).get("sha256")
    check_same(path, own, kept)
    return True


def _train(request: SkillTraining, settings: Any, report: Report) -> Any:
    """What a recipe made, and the files that it took by their roles."""
    where, train = (request.out, request.resume, report), request.module.train
    if request.skill != "survey":
        return train(settings, *where), {}
    goto = read_policy("goto", request.goto)
    return train(settings, goto.module, *where), {"goto": goto.path}


def _check_free(request: SkillTraining) -> None:
    """Refuse a folder with another training, and with other files."""
    found = {path.name for path in request.out.iterdir() if not path.name.startswith(".")}
    if foreign := sorted(found - FILES):
        problem = f"holds {foreign[0]}, which is not of a training of a skill"
        raise PlannerError(f"--out {request.out}: {problem}; give another folder")
    if found and not (request.resume or request.overwrite):
        hint = "give --resume to go on, --overwrite to replace it, or another folder"
        raise PlannerError(f"--out {request.out}: holds a training; {hint}")
    if request.overwrite and not request.resume:
        for name in found:
            (request.out / name).unlink()
