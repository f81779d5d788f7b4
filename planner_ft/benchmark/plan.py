"""Before anything is loaded: which candidates in which configurations, all checked, and what every
answer depends on.
"""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import System
from planner_ft.benchmark.sampled import repeated
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import (
    CONFIG,
    WEIGHTS,
    adapter_folder,
    check_adapter,
    find_adapter,
)
from planner_ft.candidates.loading import compute_dtype, require_folder, resolve_device
from planner_ft.candidates.location import weights_sha256
from planner_ft.candidates.registry import Quantization
from planner_ft.decoding.configurations import Configuration, parse_configuration
from planner_ft.decoding.engine import decoding_threads
from planner_ft.decoding.sampling import Sampling
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_text, sha256_tree
from planner_ft.vocabulary import Vocabulary, load_vocabulary

TOKENIZER_FILES = (
    "tokenizer*",
    "chat_template*",
    "vocab.json",
    "merges.txt",
    "special_tokens_map.json",
    "generation_config.json",
)


@dataclass(frozen=True)
class Job:
    """One candidate in one configuration, one repeat of it where answers are sampled. `parts` is
    everything that its answers depend on, by name.
    """

    candidate: Candidate
    configuration: Configuration
    adapter: Path | None
    quantization: Quantization
    with_vocabulary: bool
    parts: dict[str, Any]
    system: System
    threads: int | None
    sampling: Sampling | None = None

    @property
    def key(self) -> str:
        """A digest of `parts`: the key for reuse of predictions."""
        return sha256_text(json.dumps(self.parts, sort_keys=True))[:20]

    @property
    def name(self) -> str:
        repeat = f" #{self.sampling.repeat}" if self.sampling else ""
        return f"{self.candidate.name} {self.configuration.name}{repeat}"


@dataclass(frozen=True)
class Plan:
    """A checked run: data, vocabulary, and jobs grouped by candidate in the order asked for."""

    settings: BenchSettings
    data: BenchData
    vocabulary: Vocabulary
    device: str
    jobs: tuple[Job, ...]

    def by_candidate(self) -> list[list[Job]]:
        """The jobs of each candidate."""
        groups: dict[str, list[Job]] = {}
        for job in self.jobs:
            groups.setdefault(job.candidate.name, []).append(job)
        return list(groups.values())


def make_plan(settings: BenchSettings) -> Plan:
    """Check everything that can be checked before a model is loaded. Raises PlannerError."""
    if settings.endpoint is not None:
        from planner_ft.benchmark.sources.endpoint import endpoint_plan

        return endpoint_plan(settings, settings.endpoint)
    vocabulary = load_vocabulary(settings.vocabulary)
    configurations = list(
        dict.fromkeys(parse_configuration(text) for text in settings.configurations)
    )
    candidates = _candidates(settings)
    adapters = (
        _adapters(settings, candidates)
        if any(configuration.adapter for configuration in configurations)
        else {}
    )
    data = load_bench_data(
        settings.data or default_data(settings.level), settings.level, vocabulary, settings.limit
    )
    device = resolve_device(settings.device)
    compute = f"{device.type} {str(compute_dtype(device)).removeprefix('torch.')}"
    jobs = []
    for candidate in candidates:
        adapter = adapters.get(candidate.name)
        if adapter is not None:
            check_adapter(adapter, candidate, level=settings.level, vocabulary=vocabulary)
        threads = decoding_threads(candidate, device.type)
        jobs += [
            _job(settings, candidate, configuration, adapter, vocabulary, data, compute, threads)
            for configuration in configurations
        ]
    return Plan(
        settings,
        data,
        vocabulary,
        str(device),
        tuple(one for job in jobs for one in repeated(job, settings)),
    )


def _candidates(settings: BenchSettings) -> list[Candidate]:
    found: dict[str, Candidate] = {}
    for text in settings.candidates:
        candidate = resolve_candidate(text)
        if found.setdefault(candidate.name, candidate).folder != candidate.folder:
            raise PlannerError(
                f"--candidates: two different folders are named {candidate.name}; rename one of"
                " them"
            )
        require_folder(candidate)
    return list(found.values())


def _adapters(settings: BenchSettings, candidates: list[Candidate]) -> dict[str, Path]:
    """The adapter folder of each candidate: from --adapter, else the one that it has, else where
    `plannerft train` would put it.
    """
    chosen: dict[str, Path] = {}
    for text in settings.adapters:
        name, separator, folder = text.partition("=")
        matching = [
            candidate.name
            for candidate in candidates
            if separator and name in (candidate.name, candidate.repo, str(candidate.folder))
        ]
        if not matching and len(candidates) > 1:
            names = ", ".join(candidate.name for candidate in candidates)
            raise PlannerError(
                f"--adapter {text}: with several candidates give NAME=DIR for each; the candidates"
                f" are {names}"
            )
        target = matching[0] if matching else candidates[0].name
        if target in chosen:
            raise PlannerError(
                f"--adapter {text}: {target} has the adapter {chosen[target]} already; give one per"
                " candidate"
            )
        chosen[target] = Path(folder if matching else text)
    level = settings.level
    found = {
        candidate.name: find_adapter(candidate, level) or adapter_folder(candidate, level)
        for candidate in candidates
    }
    return {**found, **chosen}


def _job(
    settings: BenchSettings,
    candidate: Candidate,
    configuration: Configuration,
    adapter: Path | None,
    vocabulary: Vocabulary,
    data: BenchData,
    compute: str,
    threads: int | None,
) -> Job:
    folder = require_folder(candidate)
    used = adapter if configuration.adapter else None
    # A fine-tuned model has learned the vocabulary, and so has one that was pretrained on it.
    with_vocabulary = not configuration.adapter and not candidate.knows(vocabulary)
    quantization = (
        settings.quantization or candidate.adapter_defaults(settings.level).quantization or "nf4"
    )
    parts = {
        "level": settings.level,
        "candidate": candidate.name,
        "configuration": configuration.name,
        "model": weights_sha256(folder),
        "tokenizer": sha256_tree(folder, TOKENIZER_FILES),
        "adapter": sha256_tree(used, (WEIGHTS, CONFIG)) if used else None,
        "prompt format": PROMPT_VERSION,
        "vocabulary in the prompt": with_vocabulary,
        "vocabulary": vocabulary.sha256,
        "data": data.sha256,
        "max-new-tokens": settings.token_limit,
        "quantization": quantization,
        "device": compute,
    }
    system = System(
        candidate.name,
        configuration.name,
        label=candidate.row_name,
        published=candidate.published,
        is_standin=candidate.is_standin,
        pretrained=candidate.knows(vocabulary),
        with_vocabulary=with_vocabulary,
        adapter=str(used) if used else None,
    )
    return Job(
        candidate, configuration, used, quantization, with_vocabulary, parts, system, threads
    )
