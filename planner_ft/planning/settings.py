"""Which candidate, adapter and configuration each agent works with."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, adapters, resolve_candidate
from planner_ft.candidates.loading import require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.candidates.registry import Quantization
from planner_ft.confidence.calibration import AGENT, calibration_file
from planner_ft.decoding.configurations import STRENGTHS, Configuration, parse_configuration
from planner_ft.prompts import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level

DEFAULT_CANDIDATE = "embedded"
OWN = ("candidate", "adapter", "configuration")
"""Settings that each agent may have for itself."""


@dataclass(frozen=True)
class PlanSettings:
    """Settings of planning; None is chosen: the strongest configuration, a trained adapter.

    Those of one agent overrule the common ones. An adapter is looked for where
    `plannerft train` writes it, then in the package. With `mission_only` there is no Task Agent.
    """

    candidate: str = DEFAULT_CANDIDATE
    mission_candidate: str | None = None
    task_candidate: str | None = None
    mission_adapter: Path | str | None = None
    task_adapter: Path | str | None = None
    configuration: str | None = None
    mission_configuration: str | None = None
    task_configuration: str | None = None
    vocabulary: str = "usv"
    device: str = "auto"
    quantization: Quantization | None = None
    mission_only: bool = False

    def __post_init__(self) -> None:
        """Raise PlannerError for a value that no setting has."""
        if self.quantization not in (None, "nf4", "none"):
            raise PlannerError(f"--quantization {self.quantization}: must be nf4 or none")


@dataclass(frozen=True)
class Agent:
    """One agent: a candidate in a configuration, its prompt with or without the vocabulary."""

    level: Level
    candidate: Candidate
    configuration: Configuration
    adapter: Path | None
    quantization: Quantization
    with_vocabulary: bool

    @property
    def base(self) -> tuple[Path | None, Quantization]:
        """What is the same for agents that one loaded base can serve."""
        return self.candidate.folder, self.quantization

    def record(self) -> dict[str, Any]:
        """Everything but command, vocabulary and device that its answers depend on."""
        folder = self.candidate.folder
        return {
            "candidate": self.candidate.name,
            "standin": self.candidate.is_standin,
            "configuration": self.configuration.name,
            "quantization": self.quantization,
            "weights_sha256": weights_sha256(folder) if folder else None,
            "adapter": str(self.adapter) if self.adapter else None,
            "adapter_sha256": self.adapter and adapters.adapter_sha256(self.adapter),
            "prompt_format": PROMPT_VERSION,
            "vocabulary_in_the_prompt": self.with_vocabulary,
        }

    @property
    def calibration(self) -> Path:
        """The file of its calibration (planner_ft.confidence), whether there is one or not."""
        folder = self.adapter or require_folder(self.candidate)
        return calibration_file(folder, self.level, self.configuration.name)

    def held_for(self, vocabulary: Vocabulary) -> dict[str, Any]:
        """What its calibration holds for."""
        fields = {**self.record(), "vocabulary_sha256": vocabulary.sha256}
        return {key: fields[key] for key in AGENT}


def choose_agents(settings: PlanSettings, vocabulary: Vocabulary) -> dict[Level, Agent]:
    """The agents of the settings, checked without loading a model. Raises PlannerError."""
    unused = [f"--task-{what}" for what in OWN if getattr(settings, f"task_{what}") is not None]
    if settings.mission_only and unused:
        problem = "there is no Task Agent with --mission-only; leave one of them out"
        raise PlannerError(f"{', '.join(unused)}: {problem}")
    levels = LEVELS[:1] if settings.mission_only else LEVELS
    return {level: _agent(level, settings, vocabulary) for level in levels}


def untrained(agents: Mapping[Level, Agent], vocabulary: Vocabulary) -> Iterator[str]:
    """A sentence per agent that nothing was trained for the vehicle: neither adapter nor base."""
    for level, agent in agents.items():
        name, what = agent.candidate.name, "steps" if level == "task" else "tasks"
        if agent.adapter is None and not agent.candidate.knows(vocabulary):
            yield (
                f"the {level} agent ({name}, without adapter) was not trained for"
                f" {vocabulary.name}: its {what} are a guess; train one with `plannerft train"
                f" --level {level} --candidate {name} --vocabulary {vocabulary.source}`"
            )


def _agent(level: Level, settings: PlanSettings, vocabulary: Vocabulary) -> Agent:
    own_candidate, own_adapter, own = (getattr(settings, f"{level}_{what}") for what in OWN)
    candidate = resolve_candidate(own_candidate or settings.candidate).serving(vocabulary)
    require_folder(candidate)
    wanted = own or settings.configuration
    configuration = parse_configuration(wanted) if wanted else None
    adapter = None
    if configuration is None or configuration.adapter:
        adapter = (
            Path(own_adapter)
            if own_adapter
            else adapters.find_adapter(candidate, level, vocabulary)
        )
    elif own_adapter:
        problem = f"configuration {configuration.name} uses no adapter; leave one of them out"
        raise PlannerError(f"--{level}-adapter {own_adapter}: {problem}")
    if adapter is not None:
        adapters.check_adapter(adapter, candidate, level=level, vocabulary=vocabulary)
    chosen = configuration or Configuration(adapter is not None, STRENGTHS[-1])
    if chosen.adapter and adapter is None:
        without = Configuration(False, chosen.strength).name
        raise PlannerError(
            f"configuration {chosen.name}: {candidate.name} has no adapter of the {level} level"
            f" here; train one with `plannerft train --level {level} --candidate {candidate.name}`,"
            f" name one with --{level}-adapter, or give --configuration {without}"
        )
    with_vocabulary = adapters.prompt_has_vocabulary(candidate, vocabulary, adapter)
    quantization = candidate.stored_as(level, settings.quantization)
    return Agent(level, candidate, chosen, adapter, quantization, with_vocabulary)
