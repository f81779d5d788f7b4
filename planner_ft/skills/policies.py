"""The files of a skill: a policy's frozen weights as safetensors with what they are for, a card and
a manifest, and while it is trained the checkpoints of a killed training, which goes on with the
same losses.
"""

import functools
import hashlib
import json
import math
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save
from torch.nn import Module

from planner_ft.simulation.fast import Vessel
from planner_ft.skills.dynamics import Tracker, published_vessel
from planner_ft.skills.surveyor import Surveyor
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    atomic_writer,
    compact_json,
    write_json,
    write_jsonl,
    write_text,
)
from planner_ft.support.manifest import build_manifest
from planner_ft.support.templates import text_template
from planner_ft.support.terminal import Report

SHIPPED = Path(__file__).with_name("policies")
WEIGHTS, CARD, MANIFEST = "policy.safetensors", "README.md", "manifest.json"
STATE, LOG = "checkpoint.pt", "log.jsonl"
FILES = {WEIGHTS, CARD, MANIFEST, STATE, LOG}
SKILLS = ("goto", "hold", "survey")
SAME = ("drive", "mass", "drag", "thrust", "track", "length", "width")
"""What a vehicle must share with the one that a policy was trained for."""
HOW = {
    "goto": "Six numbers of the goal become commanded surge and yaw rate",
    "hold": "As GoToXY, at a place, the goal's heading against the current",
    "survey": "64 LiDAR ranges and four numbers become the next waypoint of GoToXY",
}
"""What a policy maps to what, for its card."""
EVERY = 20  # iterations between two checkpoints


@dataclass(frozen=True)
class Policy:
    """A policy that was read: `module` maps what it sees to what it does, `about` is its card."""

    skill: str
    recipe: str
    module: Module
    vessel: Mapping[str, Any]
    path: Path

    def check(self, vessel: Vessel) -> None:
        """Raise PlannerError for another vehicle than it was trained for."""
        own = json.loads(json.dumps(asdict(vessel)))
        for name in SAME:
            if own[name] != self.vessel.get(name):
                was = f"trained for a vehicle with {name} {self.vessel.get(name)}, not {own[name]}"
                way = "train one with `plannerft skill train`, or use guidance and waypoints"
                raise PlannerError(f"{self.path}: {was}; {way}")


def write_policy(
    folder: Path, skill: str, recipe: str, module: Module, settings: Any, inputs: Any, result: Any
) -> None:
    """Write weights, card and manifest: the settings of a training with their seed, the files that
    it took by their roles, and what came.
    """
    named = {"skill": skill, "recipe": recipe}
    with atomic_writer(folder / WEIGHTS, "wb") as stream:
        weights = {name: one.detach().contiguous() for name, one in module.state_dict().items()}
        stream.write(save(weights, {**named, "vessel": compact_json(asdict(published_vessel()))}))
    files = {"policy": folder / WEIGHTS, **inputs}
    about = {"configuration": {**named, **settings}, "inputs": files, "result": result}
    manifest = build_manifest("skill", seed=settings["seed"], **about)
    for one in manifest["inputs"].values():
        one["path"] = Path(one["path"]).name
    write_json(folder / MANIFEST, manifest)
    kept = ", ".join(f"{name} {value}" for name, value in {**settings, **result}.items())
    count = sum(value.numel() for value in module.parameters())
    card = text_template("planner_ft.skills", "card.md.j2")
    write_text(folder / CARD, card.render(**named, how=HOW[skill], count=count, kept=kept) + "\n")


@functools.cache
def read_policy(skill: str, folder: Path | None = None) -> Policy:
    """The policy in a folder, or the one that ships. Raises PlannerError."""
    path = (folder or SHIPPED / skill) / WEIGHTS
    if not path.is_file():
        way = "give a folder that `plannerft skill train` wrote"
        raise PlannerError(f"{path}: is not there; {way}")
    try:
        with safe_open(path, "pt") as stream:
            about = stream.metadata() or {}
            weights = {name: stream.get_tensor(name) for name in stream.keys()}  # noqa: SIM118
    except (SafetensorError, OSError) as error:
        raise PlannerError(f"{path}: is no policy ({error}); give another folder") from None
    if about.get("skill") != skill:
        found = about.get("skill") or "no skill of ours"
        raise PlannerError(f"{path}: is a policy of {found}, not of {skill}; give one of {skill}")
    module = Surveyor(about["recipe"]) if skill == "survey" else Tracker((1.0, 1.0))
    try:
        module.load_state_dict(weights)
    except RuntimeError as error:
        what = str(error).splitlines()[-1].strip()
        problem = f"its weights do not fit {skill}: {what}"
        raise PlannerError(f"{path}: {problem}; train it anew") from None
    module.eval().requires_grad_(False)
    return Policy(skill, about["recipe"], module, json.loads(about["vessel"]), path)


def check_same(path: Path, own: Mapping[str, Any], kept: Mapping[str, Any]) -> None:
    """Raise PlannerError when what was `kept` in a file was made with other settings."""
    if different := [name for name, value in own.items() if kept.get(name) != value]:
        hint = "give the same settings, or another --out"
        raise PlannerError(f"{path}: was made with another {different[0]}; {hint}")


class Checkpoint:
    """The state of a training in a folder: its settings (a dataclass with `iterations`), generator
    and `parts`, which have `state_dict` and `load_state_dict`. `goto` is the policy that drives in
    it, if any. `done` counts iterations, `log` has a line for each, `more` is what the parts do not
    hold, as it was when a killed one was saved.
    """

    def __init__(
        self,
        folder: Path,
        settings: Any,
        random: torch.Generator,
        *parts: Any,
        resume: bool,
        goto: Module | None = None,
    ) -> None:
        """Take up what was saved, if `resume`. Raises PlannerError for other settings."""
        self.folder, self.settings, self.random, self.parts = folder, settings, random, parts
        self.own = asdict(settings)
        if goto is not None:
            self.own["goto"] = hashlib.sha256(save(goto.state_dict())).hexdigest()
        self.done, self.log = 0, list[dict[str, Any]]()
        self.more: Any = None
        if resume and (folder / STATE).is_file():
            self._restore(folder / STATE)

    def advance(
        self,
        label: str,
        report: Report,
        line: Mapping[str, Any],
        more: Callable[[], Any] = lambda: None,
        *,
        every: int = 1,
        last: bool = False,
    ) -> None:
        """Note an iteration that is done, and write everything when that is due: after the `last`
        one, and `every` times as often as EVERY says.
        """
        self.done += 1
        if not math.isfinite(line["loss"]):
            problem = f"the loss of iteration {self.done} is no number"
            raise PlannerError(f"--out {self.folder}: {problem}; train with other settings")
        self.log.append({"iteration": self.done, **line})
        report(label, self.done, self.settings.iterations)
        last = last or self.done == self.settings.iterations
        if not (last or every * self.done % EVERY == 0):
            return
        state = {
            "done": self.done,
            "settings": self.own,
            "parts": [part.state_dict() for part in self.parts],
            "random": self.random.get_state(),
            "torch": torch.get_rng_state(),
            "log": self.log,
            "more": more(),
        }
        with atomic_writer(self.folder / STATE, "wb") as stream:
            torch.save(state, stream)
        write_jsonl(self.folder / LOG, self.log)

    def _restore(self, path: Path) -> None:
        try:
            state = torch.load(path, weights_only=True)
            kept = {"goto": self.own.get("goto"), **state["settings"]}  # earlier ones name no goto
            check_same(path, self.own, kept)
            for part, values in zip(self.parts, state["parts"], strict=True):
                part.load_state_dict(values)
            self.random.set_state(state["random"])
            torch.set_rng_state(state["torch"])
            self.done, self.log, self.more = int(state["done"]), state["log"], state["more"]
        except PlannerError:
            raise
        except Exception as error:  # pickles fail in every way
            problem = f"cannot be read as a checkpoint ({type(error).__name__})"
            raise PlannerError(f"{path}: {problem}; start again with --overwrite") from None
