"""What a run is asked to do."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from planner_ft.benchmark.sampled import repeats_problems
from planner_ft.benchmark.sources.endpoint_settings import EndpointSettings
from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import MAX_NEW_TOKENS
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

LONGEST = 16384


@dataclass(frozen=True)
class BenchSettings:
    """A run. `None` stands for the default that depends on level or candidate.

    `candidates` are names, folders or hub ids, `configurations` as `parse_configuration` reads
    them, `adapters` folders ("DIR", or "NAME=DIR" per candidate). A `batch_size` of None finds
    itself. `latency_samples` are the samples whose queries are timed one at a time,
    `planning_samples` the missions of each length that both agents are timed on. With `endpoint` a
    server answers, and the only candidate is its model. With a `temperature` above 0 every sample
    is asked `repeats` times.
    """

    level: Level
    candidates: tuple[str, ...]
    configurations: tuple[str, ...] = ("base", "lora")
    data: Path | None = None
    out: Path | None = None
    limit: int | None = None
    adapters: tuple[str, ...] = ()
    vocabulary: str = "usv"
    device: str = "auto"
    quantization: Quantization | None = None
    batch_size: int | None = None
    max_new_tokens: int | None = None
    latency_samples: int = 50
    planning_samples: int = 0
    seed: int = 0
    resume: bool = False
    overwrite: bool = False
    repeats: int = 1
    temperature: float = 0.0
    top_p: float = 1.0
    endpoint: EndpointSettings | None = None

    def __post_init__(self) -> None:
        """Raise PlannerError that lists every setting out of its range."""
        problems = []
        if not self.candidates:
            problems.append("--candidates: name at least one; `plannerft candidates` lists them")
        if not self.configurations:
            problems.append("--configurations: name at least one")
        if self.quantization not in (None, "nf4", "none"):
            problems.append(f"--quantization {self.quantization}: must be nf4 or none")
        bounds = (
            ("batch-size", 1 if self.batch_size is None else self.batch_size, 1, 1024),
            ("max-new-tokens", self.token_limit, 1, LONGEST),
            ("latency-samples", self.latency_samples, 0, 10**9),
            ("planning-samples", self.planning_samples, 0, 1000),
        )
        problems += [
            f"--{flag} {value}: must be between {low} and {high}"
            for flag, value, low, high in bounds
            if not low <= value <= high
        ]
        problems += repeats_problems(self.repeats, self.temperature, self.top_p)
        if self.resume and self.overwrite:
            problems.append(
                "--resume keeps former predictions and --overwrite removes them: give one of them"
            )
        if self.planning_samples and (self.level != "mission" or self.endpoint or self.temperature):
            problems.append(
                "--planning-samples times both agents from the mission level on, here and greedily:"
                " leave it out"
            )
        if problems:
            raise PlannerError("; ".join(problems))

    @property
    def token_limit(self) -> int:
        """The limit of generated tokens per answer."""
        return MAX_NEW_TOKENS[self.level] if self.max_new_tokens is None else self.max_new_tokens

    @property
    def folder(self) -> Path:
        """The output folder."""
        return self.out or Path("eval/runs") / self.level
