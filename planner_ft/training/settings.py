"""Training settings: defaults, published values, and the source of each value of a run.

settings.toml has the flag text and bounds of every setting.
"""

import difflib
import math
import tomllib
from collections.abc import Iterable
from dataclasses import Field, asdict, dataclass, fields
from pathlib import Path
from typing import Any, Literal, NamedTuple, get_args, get_origin, get_type_hints

from planner_ft.vocabulary.plans import Level

_SHARED = {"learning_rate": 2e-4, "batch_size": 1, "quantization": "nf4"}
PUBLISHED: dict[Level, dict[str, Any]] = {
    "mission": {"rank": 16, "epochs": 5, **_SHARED},
    "task": {"rank": 8, "epochs": 2, **_SHARED},
}
"""The settings of the published study. The rest has our defaults, in the fields below."""
ABOUT = tomllib.loads((Path(__file__).parent / "settings.toml").read_text(encoding="utf-8"))


@dataclass(frozen=True)
class TrainSettings:
    """Everything that can be set about a training run; settings.toml describes each field."""

    epochs: int = 5
    rank: int = 16
    learning_rate: float = 2e-4
    batch_size: int = 1
    quantization: Literal["nf4", "none"] = "nf4"

    alpha: int | None = None
    dropout: float = 0.05
    target_modules: str = "all-linear"
    max_length: int = 4096

    gradient_accumulation: int = 1
    schedule: Literal["cosine", "linear", "constant"] = "cosine"
    warmup: float = 0.03
    weight_decay: float = 0.0
    gradient_clip: float = 1.0
    optimizer: Literal["adamw", "adamw-8bit", "paged-adamw-8bit"] = "adamw"
    gradient_checkpointing: Literal["auto", "on", "off"] = "auto"
    seed: int = 0
    max_samples: int | None = None
    augment: int = 0
    vary: int = 0
    borrow: int = 0
    vocabulary_in_prompt: bool = False
    max_steps: int | None = None
    select: Literal["loss", "f1", "last"] = "loss"
    blend: float = 1.0
    validation_answers: int = 25

    device: str = "auto"
    threads: int | None = None
    checkpoint_minutes: float = 5.0
    checkpoint_steps: int | None = None
    keep_checkpoints: bool = False
    log_every: int = 10
    report_to: str = "none"

    @property
    def lora_alpha(self) -> int:
        """LoRA alpha with its default filled in."""
        return self.alpha if self.alpha is not None else 2 * self.rank

    @property
    def trackers(self) -> list[str]:
        """Names in `report_to`."""
        return [] if self.report_to == "none" else _names(self.report_to)

    @property
    def targets(self) -> str | list[str]:
        """`target_modules` as PEFT takes it."""
        return "all-linear" if self.target_modules == "all-linear" else _names(self.target_modules)

    def learned(self) -> dict[str, Any]:
        """The settings that the learned weights depend on; a resumed run may change the others."""
        values = self.as_dict().items()
        return {name: value for name, value in values if ABOUT[name]["panel"] != "Run"}

    def as_dict(self) -> dict[str, Any]:
        return {**asdict(self), "alpha": self.lora_alpha}


FIELDS: dict[str, Field[Any]] = {item.name: item for item in fields(TrainSettings)}
TYPES: dict[str, Any] = get_type_hints(TrainSettings)


def _names(text: str) -> list[str]:
    return [name.strip() for name in text.split(",") if name.strip()]


class Source(NamedTuple):
    """Settings from one place: "flag", or the name that errors show."""

    label: str
    values: dict[str, Any]

    def written(self, name: str) -> str:
        """A setting as the user wrote it there."""
        flag = self.label == "flag"
        return f"--{name.replace('_', '-')}" if flag else f"{self.label}: {name}"


Origin = dict[str, str]
"""The source of each value of settings: "published", "default", "flag", ..."""


def departures(level: Level, settings: TrainSettings, origin: Origin) -> list[str]:
    """Sentences on published settings that a run does not use."""
    return [
        f"{name.replace('_', ' ')} {value} ({origin[name]}) instead of the published {published}"
        for name, published in PUBLISHED[level].items()
        if (value := getattr(settings, name)) != published
    ]


def resolve_settings(
    level: Level, sources: Iterable[Source], problems: list[str]
) -> tuple[TrainSettings, Origin]:
    """Settings from `sources`, the first one first, then published ones, then our defaults. A value
    of None counts as not given; everything wrong is added to `problems`.
    """
    values: dict[str, Any] = {}
    origin = dict.fromkeys(FIELDS, "default")
    for source in (*sources, Source("published", PUBLISHED[level])):
        for name, value in source.values.items():
            if name not in FIELDS:
                close = difflib.get_close_matches(name, FIELDS, n=1)
                hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(FIELDS)}"
                problems.append(f"{source.written(name)} is no setting; {hint}")
            elif value is not None and name not in values:
                values[name], problem = check_value(name, value)
                origin[name] = source.label
                if problem:
                    problems.append(f"{source.written(name)} = {value!r}: {problem}")
    return TrainSettings(**values), origin


def check_value(name: str, value: Any) -> tuple[Any, str | None]:
    """The value in the field's type, and the problem with it or None."""
    kind, choices = kind_of(name)
    if choices:
        return value, None if value in choices else f"must be one of {', '.join(choices)}"
    if kind in (bool, str):
        wanted = "true or false" if kind is bool else "text"
        return value, None if isinstance(value, kind) else f"must be {wanted}"
    if isinstance(value, bool) or not isinstance(value, int | float) or not math.isfinite(value):
        return value, "must be a number"
    if kind is int and value != int(value):
        return value, "must be a whole number"
    bounds = ABOUT[name]
    if value < bounds.get("low", -math.inf):
        return value, f"must be at least {bounds['low']:g}"
    if value <= bounds.get("above", -math.inf):
        return value, f"must be greater than {bounds['above']:g}"
    if value > bounds.get("high", math.inf):
        return value, f"must be at most {bounds['high']:g}"
    return kind(value), None


def kind_of(name: str) -> tuple[type, tuple[str, ...]]:
    """The type of a setting's values, and the values of one that is chosen from a list."""
    annotation = TYPES[name]
    if get_origin(annotation) is Literal:
        return str, get_args(annotation)
    kinds = get_args(annotation) or (annotation,)
    return next(kind for kind in kinds if kind is not type(None)), ()


def default_text(name: str) -> str | None:
    """The default of a setting as help texts show it; None where the text has it already."""
    default = FIELDS[name].default
    if ABOUT[name]["panel"] == "Published settings" or default is None or isinstance(default, bool):
        return None
    return f"{default:g}" if isinstance(default, float) else str(default)
