"""Before anything is loaded: which candidates in which configurations, all checked, and everything
that an answer depends on.
"""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import System
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings, EndpointSettings
from planner_ft.candidates import Candidate, all_candidates, resolve_candidate
from planner_ft.candidates.adapters import (
    CONFIG,
    WEIGHTS,
    adapter_folder,
    check_adapter,
    find_adapter,
    prompt_has_vocabulary,
    seen_in_training,
)
from planner_ft.candidates.loading import (
    compute_dtype,
    load_tokenizer,
    require_folder,
    resolve_device,
)
from planner_ft.candidates.location import weights_sha256
from planner_ft.candidates.registry import Quantization
from planner_ft.confidence.calibration import Calibration, calibration_file, read_calibration
from planner_ft.data.leakage import input_digest
from planner_ft.decoding.configurations import Configuration, parse_configuration
from planner_ft.decoding.constraints.factory import constraint_factory
from planner_ft.decoding.engine import decoding_threads
from planner_ft.decoding.sampling import Sampling
from planner_ft.prompts.render import PROMPT_VERSION, end_of_turn_ids
from planner_ft.prompts.text import user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_text, sha256_tree
from planner_ft.vocabulary import Vocabulary, load_vocabulary

TOKENIZER_FILES = (
    *("tokenizer*", "chat_template*", "vocab.json", "merges.txt"),
    *("special_tokens_map.json", "generation_config.json"),
)
SERVER_SEED = 0
"""Sent to servers with temperature 0, for those that break ties by chance."""


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

    def calibration(self) -> Calibration | None:
        """What turns its log-probabilities into confidence, where it was calibrated. Raises
        PlannerError for a damaged file.
        """
        folder = self.adapter or self.candidate.folder
        if folder is None or self.sampling is not None:
            return None
        level, configuration = self.parts["level"], self.configuration.name
        agent = {
            "candidate": self.candidate.name,
            "configuration": configuration,
            "quantization": self.quantization,
            "weights_sha256": self.parts["model"],
            "adapter_sha256": self.parts["adapter"],
            "vocabulary_sha256": self.parts["vocabulary"],
        }
        return read_calibration(calibration_file(folder, level, configuration), agent)[0]

    def named(self) -> dict[str, Any]:
        """The fields of a record that name the job."""
        names = {"candidate": self.candidate.name, "configuration": self.configuration.name}
        return {**names, **({"repeat": self.sampling.repeat} if self.sampling else {})}

    def repeated(self, settings: BenchSettings) -> list[Job]:
        """The job once for every repeat, each with its own random numbers and its own key; the job
        itself where decoding is greedy.
        """
        temperature, top_p, seed = settings.temperature, settings.top_p, settings.seed
        if temperature == 0:
            return [self]
        drawn = {"temperature": temperature, "top-p": top_p, "seed": seed}
        return [
            replace(
                self,
                sampling=Sampling(temperature, top_p, seed, repeat),
                parts={**self.parts, **drawn, "repeat": repeat},
                system=replace(self.system, repeat=repeat),
            )
            for repeat in range(1, settings.repeats + 1)
        ]


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
    if settings.endpoint:
        settings.endpoint.api_key()
    vocabulary = load_vocabulary(settings.vocabulary)
    configurations = list(dict.fromkeys(map(parse_configuration, settings.configurations)))
    if settings.endpoint:
        _check_servable(configurations)
    candidates = [] if settings.endpoint else _candidates(settings)
    needs_adapter = any(configuration.adapter for configuration in configurations)
    adapters = _adapters(settings, candidates) if candidates and needs_adapter else {}
    _check_limit(settings, candidates, configurations, vocabulary)
    path = settings.data or default_data(settings.level, vocabulary)
    data = load_bench_data(path, settings.level, vocabulary, settings.limit)
    # Everything that the answers of all jobs depend on.
    common = {
        "level": settings.level,
        "prompt format": PROMPT_VERSION,
        "vocabulary": vocabulary.sha256,
        "data": data.sha256,
        "max-new-tokens": settings.token_limit,
    }
    if settings.endpoint:
        device = "server"
        jobs = [_served_job(settings.endpoint, one, common) for one in configurations]
    else:
        torch_device = resolve_device(settings.device)
        device = str(torch_device)
        dtype = str(compute_dtype(torch_device)).removeprefix("torch.")
        common["device"] = f"{torch_device.type} {dtype}"
        for candidate in candidates:
            if (adapter := adapters.get(candidate.name)) is not None:
                check_adapter(adapter, candidate, level=settings.level, vocabulary=vocabulary)
        seen = {name: _seen(folder, data, vocabulary) for name, folder in adapters.items()}
        jobs = [
            _job(settings, candidate, one, adapters.get(candidate.name), vocabulary, common, seen)
            for candidate in candidates
            for one in configurations
        ]
    every = tuple(one for job in jobs for one in job.repeated(settings))
    return Plan(settings, data, vocabulary, device, every)


def _candidates(settings: BenchSettings) -> list[Candidate]:
    found: dict[str, Candidate] = {}
    for text in settings.candidates:
        candidate = resolve_candidate(text)
        if found.setdefault(candidate.name, candidate).folder != candidate.folder:
            problem = f"two different folders are named {candidate.name}; rename one of them"
            raise PlannerError(f"--candidates: {problem}")
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
            way = "with several candidates give NAME=DIR for each"
            raise PlannerError(f"--adapter {text}: {way}; the candidates are {names}")
        target = matching[0] if matching else candidates[0].name
        if target in chosen:
            problem = f"{target} has the adapter {chosen[target]} already; give one per candidate"
            raise PlannerError(f"--adapter {text}: {problem}")
        chosen[target] = Path(folder if matching else text)
    level = settings.level
    return {
        one.name: chosen.get(one.name) or find_adapter(one, level) or adapter_folder(one, level)
        for one in candidates
    }


def _check_limit(
    settings: BenchSettings,
    candidates: list[Candidate],
    configurations: list[Configuration],
    vocabulary: Vocabulary,
) -> None:
    """Raise PlannerError where a constrained answer of a later candidate needs more tokens than the
    limit; the first candidate's are checked when it is loaded.
    """
    strengths = [one.strength for one in configurations if one.strength != "free"]
    for candidate in candidates[1:] if strengths else ():
        tokenizer = load_tokenizer(candidate)
        ends, limit = tuple(end_of_turn_ids(tokenizer)), settings.token_limit
        try:
            constraint_factory(
                tokenizer, settings.level, vocabulary, strengths[0], end_ids=ends, limit=limit
            )
        except PlannerError as error:
            raise PlannerError(f"{candidate.name}: {error}") from None


def _seen(adapter: Path, data: BenchData, vocabulary: Vocabulary) -> int:
    """How many of the samples an adapter was trained on."""
    seen, level = seen_in_training(adapter), data.level
    if data.sha256 in seen:
        return len(data.samples)
    texts = (user_text(level, sample.record, vocabulary) for sample in data.samples)
    return sum(input_digest(text) in seen for text in texts)


def _job(
    settings: BenchSettings,
    candidate: Candidate,
    configuration: Configuration,
    adapter: Path | None,
    vocabulary: Vocabulary,
    common: dict[str, Any],
    seen: dict[str, int],
) -> Job:
    folder = require_folder(candidate)
    used = adapter if configuration.adapter else None
    pretrained = candidate.knows(vocabulary)
    with_vocabulary = prompt_has_vocabulary(candidate, vocabulary, used)
    default = candidate.adapter_defaults(settings.level, vocabulary).quantization
    quantization = settings.quantization or default or "nf4"
    parts = {
        **common,
        "candidate": candidate.name,
        "configuration": configuration.name,
        "model": weights_sha256(folder),
        "tokenizer": sha256_tree(folder, TOKENIZER_FILES),
        "adapter": sha256_tree(used, (WEIGHTS, CONFIG)) if used else None,
        "vocabulary in the prompt": with_vocabulary,
        "quantization": quantization,
    }
    system = System(
        candidate.name,
        configuration.name,
        label=candidate.row_name,
        published=candidate.published,
        is_standin=candidate.is_standin,
        pretrained=pretrained,
        with_vocabulary=with_vocabulary,
        adapter=str(used) if used else None,
        seen=seen.get(candidate.name, 0) if used else 0,
    )
    threads = decoding_threads(candidate, str(common["device"]).split()[0])
    return Job(
        candidate, configuration, used, quantization, with_vocabulary, parts, system, threads
    )


def _check_servable(configurations: list[Configuration]) -> None:
    for configuration in configurations:
        if configuration.strength not in ("free", "schema"):
            problem = f"{configuration.strength} needs our own decoding"
            known = (
                "base, lora (a fine-tuned model, told no vocabulary), base+schema and lora+schema"
            )
            way = f"with --endpoint there are {known}"
            raise PlannerError(f"--configurations {configuration.name}: {problem}; {way}")


def _served_job(
    endpoint: EndpointSettings, configuration: Configuration, common: dict[str, Any]
) -> Job:
    """A job of the served model; published figures stand beside one of the published names."""
    wanted, with_vocabulary = endpoint.model.lower(), not configuration.adapter
    known = [
        one for one in all_candidates() if wanted in ((one.repo or "").lower(), one.name.lower())
    ]
    candidate = Candidate(name=endpoint.model, published=known[0].published if known else None)
    parts = {
        **common,
        "candidate": candidate.name,
        "configuration": configuration.name,
        "endpoint": endpoint.root,
        "vocabulary in the prompt": with_vocabulary,
        "sampling": {"temperature": 0, "seed": SERVER_SEED},
    }
    system = System(
        candidate.name,
        configuration.name,
        label=f"{candidate.row_name} at {endpoint.host}",
        published=candidate.published,
        with_vocabulary=with_vocabulary,
    )
    return Job(candidate, configuration, None, "none", with_vocabulary, parts, system, None)
