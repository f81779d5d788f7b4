"""Policy files: frozen weights as safetensors with what they are for, a card and a manifest."""

from __future__ import annotations

import functools
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import torch
from safetensors import SafetensorError, safe_open
from safetensors.torch import save
from torch import nn

from planner_ft.simulation.vessel import Vessel
from planner_ft.skills.checkpoint import weights_of
from planner_ft.skills.surveyor import Surveyor
from planner_ft.skills.tracker import Tracker
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    atomic_writer,
    compact_json,
    sha256_file,
    write_json,
    write_text,
)
from planner_ft.support.manifest import build_manifest

SHIPPED = Path(__file__).with_name("policies")
WEIGHTS, CARD, MANIFEST = "policy.safetensors", "README.md", "manifest.json"
SKILLS = ("goto", "hold", "survey")
SAME = ("drive", "mass", "drag", "thrust", "track", "length", "width")
"""What a vehicle must share with the one that a policy was trained for."""


@dataclass(frozen=True)
class Policy:
    """A policy that was read: `module` maps what it sees to what it does, `about` is its card."""

    skill: str
    recipe: str
    module: nn.Module
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
    folder: Path, skill: str, recipe: str, module: nn.Module, vessel: Vessel, trained: Any
) -> None:
    """Write weights, card and manifest; `trained` has the settings, their seed, and what came."""
    about = {"skill": skill, "recipe": recipe, "vessel": compact_json(asdict(vessel))}
    with atomic_writer(folder / WEIGHTS, "wb") as stream:
        stream.write(save(weights_of(module), about))
    settings, result = trained["settings"], trained["result"]
    inputs: dict[str, Path | str] = {"policy": folder / WEIGHTS, **trained.get("inputs", {})}
    manifest = build_manifest(
        "skill",
        seed=settings["seed"],
        configuration={"skill": skill, "recipe": recipe, **settings},
        inputs=inputs,
        result=result,
    )
    manifest["inputs"] = {
        k: {**v, "path": Path(v["path"]).name} for k, v in manifest["inputs"].items()
    }
    write_json(folder / MANIFEST, manifest)
    write_text(folder / CARD, _card(skill, recipe, module, settings, result))


def read_policy(skill: str, folder: Path | None = None) -> Policy:
    """The policy in a folder, or the one that ships. Raises PlannerError."""
    return _read(skill, folder or SHIPPED / skill)


@functools.cache
def _read(skill: str, folder: Path) -> Policy:
    path = folder / WEIGHTS
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
        raise PlannerError(
            f"{path}: its weights do not fit {skill}: {what}; train it anew"
        ) from None
    module.eval().requires_grad_(False)
    return Policy(skill, about["recipe"], module, json.loads(about["vessel"]), path)


def digest(skill: str, folder: Path | None = None) -> str:
    """SHA-256 of a policy's weights, for manifests."""
    return sha256_file((folder or SHIPPED / skill) / WEIGHTS)


def _card(
    skill: str,
    recipe: str,
    module: nn.Module,
    settings: Mapping[str, Any],
    result: Mapping[str, Any],
) -> str:
    count = sum(value.numel() for value in module.parameters())
    kept = ", ".join(f"{name} {value}" for name, value in {**settings, **result}.items())
    how = {
        "goto": "six numbers of the goal become commanded surge and yaw rate",
        "hold": "as GoToXY, at a place, the goal's heading against the current",
        "survey": "64 LiDAR ranges and four numbers become the next waypoint of GoToXY",
    }[skill]
    return f"""# Policy of the skill {skill}

{how[0].upper()}{how[1:]}. Recipe: {recipe}; {count:,} weights, for the vehicle in the file's metadata.

Made by `plannerft skill train {skill}`: {kept}.

`plannerft skill bench {skill}` measures it beside its baselines. For simulation: nobody has tried it on the water.
"""


def torch_threads() -> None:
    """One thread: batches are small, and runs are many."""
    torch.set_num_threads(1)
