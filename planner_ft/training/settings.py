"""Training settings: what can be set, what is published, and where each value of a run came
from.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Iterable
from dataclasses import MISSING, Field, asdict, dataclass, field, fields
from typing import Any, Literal, get_args, get_origin, get_type_hints

from planner_ft.vocabulary.plans import Level

Schedule = Literal["cosine", "linear", "constant"]
Optimizer = Literal["adamw", "adamw-8bit", "paged-adamw-8bit"]
Checkpointing = Literal["auto", "on", "off"]
Quantization = Literal["nf4", "none"]

PUBLISHED: dict[Level, dict[str, Any]] = {
    "mission": {
        "rank": 16,
        "epochs": 5,
        "learning_rate": 2e-4,
        "batch_size": 1,
        "quantization": "nf4",
    },
    "task": {"rank": 8, "epochs": 2, "learning_rate": 2e-4, "batch_size": 1, "quantization": "nf4"},
}
"""The settings of the published study. What it leaves open has our defaults, in the fields
below.
"""

PANELS = {
    "published": "Published settings",
    "adapter": "Adapter",
    "optimisation": "Optimisation",
    "run": "Run",
}


def _about(
    panel: str,
    text: str,
    *,
    low: float | None = None,
    high: float | None = None,
    above: float | None = None,
) -> dict[str, Any]:
    """A field's help text and bounds: `low` <= value <= `high`, value > `above`."""
    return {"panel": panel, "help": text, "low": low, "high": high, "above": above}


@dataclass(frozen=True)
class TrainSettings:
    """Everything that can be set about a training run. The `run` panel does not change what is
    learned.
    """

    epochs: int = field(
        default=5,
        metadata=_about("published", "Passes over the training split (mission 5, task 2).", low=1),
    )
    rank: int = field(
        default=16, metadata=_about("published", "LoRA rank (mission 16, task 8).", low=1)
    )
    learning_rate: float = field(
        default=2e-4, metadata=_about("published", "Peak learning rate (2e-4).", above=0, high=1)
    )
    batch_size: int = field(
        default=1,
        metadata=_about("published", "Samples that go through the model together (1).", low=1),
    )
    quantization: Quantization = field(
        default="nf4",
        metadata=_about(
            "published",
            "How the base model's linear layers are stored: nf4 (4-bit) or none (16-bit).",
        ),
    )

    alpha: int | None = field(
        default=None,
        metadata=_about(
            "adapter",
            "LoRA alpha; the adapter is scaled by alpha/rank. Default: twice the rank.",
            low=1,
        ),
    )
    dropout: float = field(
        default=0.05, metadata=_about("adapter", "Dropout on the adapter's input.", low=0, high=0.9)
    )
    target_modules: str = field(
        default="all-linear",
        metadata=_about(
            "adapter",
            "Layers that get an adapter: all-linear, or names with commas (q_proj,v_proj).",
        ),
    )
    max_length: int = field(
        default=4096,
        metadata=_about(
            "adapter", "Longest sample in tokens; a longer one is an error, never cut.", low=16
        ),
    )

    gradient_accumulation: int = field(
        default=1, metadata=_about("optimisation", "Batches per optimiser step.", low=1)
    )
    schedule: Schedule = field(
        default="cosine",
        metadata=_about(
            "optimisation",
            "Learning rate after the warm-up: cosine or linear to zero, or constant.",
        ),
    )
    warmup: float = field(
        default=0.03,
        metadata=_about(
            "optimisation",
            "Share of all steps over which the learning rate rises from zero.",
            low=0,
            high=1,
        ),
    )
    weight_decay: float = field(
        default=0.0,
        metadata=_about("optimisation", "AdamW's weight decay on the adapter.", low=0, high=1),
    )
    gradient_clip: float = field(
        default=1.0, metadata=_about("optimisation", "Largest gradient norm.", above=0)
    )
    optimizer: Optimizer = field(
        default="adamw",
        metadata=_about(
            "optimisation", "adamw, or with 8-bit moments: adamw-8bit, paged-adamw-8bit (CUDA)."
        ),
    )
    gradient_checkpointing: Checkpointing = field(
        default="auto",
        metadata=_about(
            "optimisation",
            "Compute activations again in the backward pass to save memory: on, off, or auto (on"
            " from 500 million parameters).",
        ),
    )
    seed: int = field(
        default=0,
        metadata=_about(
            "optimisation",
            "Seed of adapter weights, dropout and sample order.",
            low=0,
            high=2**31 - 1,
        ),
    )
    max_samples: int | None = field(
        default=None,
        metadata=_about("optimisation", "Train on the first N samples of the file only.", low=1),
    )
    augment: int = field(
        default=0,
        metadata=_about(
            "optimisation", "Add N synthetic samples of this level to the training split.", low=0
        ),
    )
    max_steps: int | None = field(
        default=None,
        metadata=_about(
            "optimisation", "Stop after N optimiser steps; the schedule ends there, too.", low=1
        ),
    )

    device: str = field(default="auto", metadata=_about("run", "auto, cpu, cuda or cuda:N."))
    threads: int | None = field(
        default=None,
        metadata=_about(
            "run",
            "CPU threads. Default: 1 for models below 50 million parameters, else all cores.",
            low=1,
        ),
    )
    checkpoint_minutes: float = field(
        default=5.0,
        metadata=_about(
            "run", "Minutes between checkpoints; epoch ends and Ctrl-C make one as well.", above=0
        ),
    )
    checkpoint_steps: int | None = field(
        default=None, metadata=_about("run", "Also a checkpoint every N optimiser steps.", low=1)
    )
    keep_checkpoints: bool = field(
        default=False,
        metadata=_about("run", "Keep the checkpoints folder when training has finished."),
    )
    log_every: int = field(
        default=10,
        metadata=_about("run", "Without a terminal: one line of progress every N steps.", low=1),
    )
    report_to: str = field(
        default="none",
        metadata=_about("run", "Experiment trackers, with commas: tensorboard, wandb, mlflow, ..."),
    )

    @property
    def lora_alpha(self) -> int:
        """LoRA alpha with its default filled in."""
        return self.alpha if self.alpha is not None else 2 * self.rank

    @property
    def trackers(self) -> list[str]:
        """Names in `report_to`."""
        return (
            []
            if self.report_to in ("", "none")
            else [name.strip() for name in self.report_to.split(",") if name.strip()]
        )

    @property
    def targets(self) -> str | list[str]:
        """`target_modules` as PEFT takes it."""
        return (
            self.target_modules
            if self.target_modules == "all-linear"
            else [name.strip() for name in self.target_modules.split(",")]
        )

    def learned(self) -> dict[str, Any]:
        """The settings that the learned weights depend on: a run may be resumed with other values
        of the rest.
        """
        return {
            name: value
            for name, value in self.as_dict().items()
            if FIELDS[name].metadata["panel"] != "run"
        }

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "alpha": self.lora_alpha}


FIELDS: dict[str, Field[Any]] = {item.name: item for item in fields(TrainSettings)}
TYPES: dict[str, Any] = get_type_hints(TrainSettings)


@dataclass(frozen=True)
class Source:
    """Values from one place. `style` writes a setting as the user wrote it there, for error
    messages.
    """

    label: str
    values: dict[str, Any]
    flags: bool = False

    def style(self, name: str) -> str:
        return f"--{name.replace('_', '-')}" if self.flags else f"{self.label}: {name}"


@dataclass(frozen=True)
class Resolved:
    """Settings with the label of the source that each value came from ("published", "default",
    "flag", ...).
    """

    settings: TrainSettings
    origin: dict[str, str]

    def departures(self, level: Level) -> list[str]:
        """Sentences on published settings that this run does not use."""
        return [
            f"{name.replace('_', ' ')} {value} ({self.origin[name]}) instead of the published"
            f" {published}"
            for name, published in PUBLISHED[level].items()
            if (value := getattr(self.settings, name)) != published
        ]


def resolve_settings(level: Level, sources: Iterable[Source]) -> tuple[Resolved | None, list[str]]:
    """Settings from `sources`, first one first, then the published ones, then our defaults; and
    every problem found.

    A value of None counts as not given. The result is None when there are problems.
    """
    values: dict[str, Any] = {}
    origin: dict[str, str] = {}
    problems: list[str] = []
    for source in (*sources, Source("published", PUBLISHED[level])):
        for name, value in source.values.items():
            if name not in FIELDS:
                close = difflib.get_close_matches(name, FIELDS, n=1)
                hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(FIELDS)}"
                problems.append(f"{source.style(name)} is no setting; {hint}")
            elif value is not None and name not in values:
                converted, problem = check_value(name, value)
                values[name], origin[name] = converted, source.label
                if problem:
                    problems.append(f"{source.style(name)} = {value!r}: {problem}")
    if problems:
        return None, problems
    return Resolved(TrainSettings(**values), {**dict.fromkeys(FIELDS, "default"), **origin}), []


def check_value(name: str, value: Any) -> tuple[Any, str | None]:
    """The value in the field's type, and what is wrong with it or None."""
    annotation = TYPES[name]
    if get_origin(annotation) is Literal:
        choices = get_args(annotation)
        return value, None if value in choices else f"must be one of {', '.join(choices)}"
    kind = next((item for item in get_args(annotation) if item is not type(None)), annotation)
    if kind in (bool, str):
        return value, (
            None
            if isinstance(value, kind)
            else f"must be {'true or false' if kind is bool else 'text'}"
        )
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        return value, "must be a number"
    if kind is int and value != int(value):
        return value, "must be a whole number"
    return kind(value), _bounds_problem(value, FIELDS[name].metadata)


def _bounds_problem(value: float, bounds: Any) -> str | None:
    if bounds["low"] is not None and value < bounds["low"]:
        return f"must be at least {bounds['low']:g}"
    if bounds["above"] is not None and value <= bounds["above"]:
        return f"must be greater than {bounds['above']:g}"
    if bounds["high"] is not None and value > bounds["high"]:
        return f"must be at most {bounds['high']:g}"
    return None


def default_text(name: str) -> str | None:
    """The default of a setting as help texts show it, or None where the text says it."""
    item = FIELDS[name]
    if (
        item.metadata["panel"] == "published"
        or item.default in (None, MISSING)
        or isinstance(item.default, bool)
    ):
        return None
    return f"{item.default:g}" if isinstance(item.default, float) else str(item.default)
