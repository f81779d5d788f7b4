"""Checkpoints of a training of a skill: what a killed one needs to go on with the same losses."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import torch
from torch import nn

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import atomic_writer, compact_json, write_text

STATE, LOG = "checkpoint.pt", "log.jsonl"
EVERY = 20
"""Iterations between two checkpoints."""


class Checkpoint:
    """The state of a training in a folder: modules, optimizers, generators and its log.

    `parts` have `state_dict` and `load_state_dict`.
    """

    def __init__(self, folder: Path, settings: dict[str, Any], *parts: Any) -> None:
        self.folder, self.settings, self.parts = folder, settings, parts
        self.log: list[dict[str, Any]] = []
        self.more: Any = None

    def add(self, line: dict[str, Any]) -> None:
        """A line of the log; written with the next checkpoint."""
        self.log.append(line)

    def due(self, done: int, total: int) -> bool:
        """Whether a checkpoint is to be written after `done` iterations of `total`."""
        return done % EVERY == 0 or done == total

    def save(self, done: int, random: torch.Generator, more: Any = None) -> None:
        """Write everything after `done` iterations."""
        state = {
            "done": done,
            "settings": self.settings,
            "parts": [part.state_dict() for part in self.parts],
            "random": random.get_state(),
            "torch": torch.get_rng_state(),
            "log": self.log,
            "more": more,
        }
        with atomic_writer(self.folder / STATE, "wb") as stream:
            torch.save(state, stream)
        lines = "".join(compact_json(line) + "\n" for line in self.log)
        write_text(self.folder / LOG, lines)

    def restore(self, random: torch.Generator) -> int:
        """Take up what was saved; iterations done. Raises PlannerError for other settings."""
        path = self.folder / STATE
        if not path.is_file():
            return 0
        try:
            state = torch.load(path, weights_only=True)
            different = [k for k, v in self.settings.items() if state["settings"].get(k) != v]
        except (RuntimeError, KeyError, EOFError, OSError) as error:
            raise PlannerError(
                f"{path}: is no checkpoint ({error}); start without --resume"
            ) from None
        if different:
            hint = "give the same settings, or another --out"
            raise PlannerError(f"{path}: was made with another {different[0]}; {hint}")
        for part, kept in zip(self.parts, state["parts"], strict=True):
            part.load_state_dict(kept)
        random.set_state(state["random"])
        torch.set_rng_state(state["torch"])
        self.log, self.more = state["log"], state["more"]
        return int(state["done"])


def weights_of(module: nn.Module) -> dict[str, torch.Tensor]:
    """The tensors of a module, contiguous, for safetensors."""
    return {name: value.detach().contiguous() for name, value in module.state_dict().items()}
