"""Candidates in configurations, all checked before loading, and what an answer depends on."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark.results import System
from planner_ft.benchmark.samples import BenchData, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings, EndpointSettings
from planner_ft.candidates import Candidate, adapters, all_candidates, loading, resolve_candidate
from planner_ft.candidates.location import weights_sha256
from planner_ft.candidates.registry import Quantization
from planner_ft.data.leakage import input_digest
from planner_ft.decoding.configurations import Configuration, parse_configuration
from planner_ft.decoding.constraints.answer import constraint_factory
from planner_ft.decoding.engine import decoding_threads
from planner_ft.decoding.sequence import Sampling
from planner_ft.prompts import PROMPT_VERSION, end_of_turn_ids, user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_text, sha256_tree
from planner_ft.support.resources import cores
from planner_ft.vocabulary import Vocabulary, load_vocabulary

TOKENIZER_FILES = (
    *("tokenizer*", "chat_template*", "vocab.json", "merges.txt"),
    *("special_tokens_map.json", "generation_config.json"),
)
SERVER_SEED = 0  # sent to servers with temperature 0, for those that break ties by chance
SERVED = "base, lora (a fine-tuned model, told no vocabulary), base+schema and lora+schema"
WORTH_HELP = 150
"""Answers from which a second process repays the ten seconds of its start."""
Parts = dict[str, Any]


@dataclass(frozen=True)
class Job:
    """A candidate in a configuration, once per repeat; `parts` is all that answers depend on."""

    candidate: Candidate
    configuration: Configuration
    parts: Parts
    system: System
    adapter: Path | None = None
    quantization: Quantization = "none"
    threads: int | None = None
    sampling: Sampling | None = None

    @property
    def key(self) -> str:
        """A digest of `parts`: the key for reuse of predictions."""
        return sha256_text(json.dumps(self.parts, sort_keys=True))[:20]

    @property
    def name(self) -> str:
        repeat = f" #{self.sampling.repeat}" if self.sampling else ""
        return f"{self.system.key}{repeat}"

    def named(self) -> dict[str, Any]:
        """The fields of a record that name the job."""
        names = {"candidate": self.candidate.name, "configuration": self.configuration.name}
        return {**names, **({"repeat": self.sampling.repeat} if self.sampling else {})}

    def repeated(self, settings: BenchSettings) -> list[Job]:
        """The job once per repeat, with random numbers and a key of its own; greedy: itself."""
        temperature, top_p, seed = settings.temperature, settings.top_p, settings.seed
        if temperature == 0:
            return [self]
        drawn = {**self.parts, "temperature": temperature, "top-p": top_p, "seed": seed}
        return [
            replace(
                self,
                sampling=Sampling(temperature, top_p, seed, repeat),
                parts={**drawn, "repeat": repeat},
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


def make_plan(settings: BenchSettings) -> Plan:
    """Check everything that can be checked before a model is loaded. Raises PlannerError."""
    level, server = settings.level, settings.endpoint
    if server:
        server.api_key()
    vocabulary = load_vocabulary(settings.vocabulary)
    configurations = list(dict.fromkeys(map(parse_configuration, settings.configurations)))
    if server:
        _check_servable(configurations)
    candidates = [] if server else _candidates(settings, vocabulary)
    needs_adapter = any(configuration.adapter for configuration in configurations)
    chosen = _adapters(settings, candidates) if candidates and needs_adapter else {}
    _check_limit(settings, candidates, configurations, vocabulary)
    path = settings.data or default_data(level, vocabulary)
    data = load_bench_data(path, level, vocabulary, settings.limit)
    # Everything that the answers of all jobs depend on.
    common: Parts = {"level": level, "prompt format": PROMPT_VERSION, "data": data.sha256}
    common |= {"vocabulary": vocabulary.sha256, "max-new-tokens": settings.token_limit}
    if server:
        device = "server"
        jobs = [_served_job(server, one, common) for one in configurations]
    else:
        torch_device = loading.resolve_device(settings.device)
        dtype = str(loading.compute_dtype(torch_device)).removeprefix("torch.")
        device, common["device"] = str(torch_device), f"{torch_device.type} {dtype}"
        for one in (one for one in candidates if one.name in chosen):
            adapters.check_adapter(chosen[one.name], one, level=level, vocabulary=vocabulary)
        jobs = []
        for one in candidates:
            adapter = chosen.get(one.name)
            seen = _seen(adapter, data, vocabulary) if adapter else 0
            known = settings, vocabulary, common, adapter, seen
            jobs += [_job(one, how, *known) for how in configurations]
    every = tuple(one for job in jobs for one in job.repeated(settings))
    return Plan(settings, data, vocabulary, device, every)


def is_helped(settings: BenchSettings) -> bool:
    """Whether a second process should make half of the answers: small models have one CPU thread,
    and these answers are enough to repay the process's start. Raises PlannerError as `make_plan`.
    """
    if settings.endpoint or cores() == 1:
        return False
    plan = make_plan(settings)
    small = plan.device == "cpu" and all(job.threads for job in plan.jobs)
    return small and len(plan.data.samples) * len(plan.jobs) >= WORTH_HELP


def _candidates(settings: BenchSettings, vocabulary: Vocabulary) -> list[Candidate]:
    found: dict[str, Candidate] = {}
    for text in settings.candidates:
        candidate = resolve_candidate(text).serving(vocabulary)
        if found.setdefault(candidate.name, candidate).folder != candidate.folder:
            problem = f"two different folders are named {candidate.name}; rename one of them"
            raise PlannerError(f"--candidates: {problem}")
        loading.require_folder(candidate)
        if candidate.merged not in (None, settings.level):
            other = f"has the adapter of the {candidate.merged} level folded in"
            way = f"give --level {candidate.merged} or another candidate"
            raise PlannerError(f"--candidates {text}: {other}; {way}")
    return list(found.values())


def _adapters(settings: BenchSettings, candidates: Sequence[Candidate]) -> dict[str, Path]:
    """Adapter folders: from --adapter, else the candidate's, else where `train` would write."""
    chosen: dict[str, Path] = {}
    for text in settings.adapters:
        name, separator, folder = text.partition("=")
        among = candidates if separator else ()
        named = [one.name for one in among if name in (one.name, one.repo, str(one.folder))]
        if not named and len(candidates) > 1:
            names = ", ".join(candidate.name for candidate in candidates)
            way = "with several candidates give NAME=DIR for each"
            raise PlannerError(f"--adapter {text}: {way}; the candidates are {names}")
        target = named[0] if named else candidates[0].name
        if target in chosen:
            problem = f"{target} has the adapter {chosen[target]} already; give one per candidate"
            raise PlannerError(f"--adapter {text}: {problem}")
        chosen[target] = Path(folder if named else text)
    level = settings.level
    return {
        one.name: chosen.get(one.name)
        or adapters.find_adapter(one, level)
        or adapters.adapter_folder(one, level)
        for one in candidates
    }


def _check_limit(
    settings: BenchSettings,
    candidates: Sequence[Candidate],
    configurations: Sequence[Configuration],
    vocabulary: Vocabulary,
) -> None:
    """Raise PlannerError where a later candidate's constrained answers need more tokens."""
    strengths = [one.strength for one in configurations if one.strength != "free"]
    for candidate in candidates[1:] if strengths else ():
        tokenizer = loading.load_tokenizer(candidate)
        kind, ends = (settings.level, vocabulary, strengths[0]), tuple(end_of_turn_ids(tokenizer))
        try:
            constraint_factory(tokenizer, *kind, end_ids=ends, limit=settings.token_limit)
        except PlannerError as error:
            raise PlannerError(f"{candidate.name}: {error}") from None


def _seen(adapter: Path, data: BenchData, vocabulary: Vocabulary) -> int:
    """How many of the samples an adapter was trained on."""
    seen, level = adapters.seen_in_training(adapter), data.level
    if data.sha256 in seen:
        return len(data.samples)
    texts = (user_text(level, sample.record, vocabulary) for sample in data.samples)
    return sum(input_digest(text) in seen for text in texts)


def _job(
    candidate: Candidate,
    configuration: Configuration,
    settings: BenchSettings,
    vocabulary: Vocabulary,
    common: Parts,
    adapter: Path | None,
    seen: int,
) -> Job:
    folder = loading.require_folder(candidate)
    used = adapter if configuration.adapter else None
    quantization = candidate.stored_as(settings.level, settings.quantization)
    parts = {
        "model": weights_sha256(folder),
        "tokenizer": sha256_tree(folder, TOKENIZER_FILES),
        "adapter": adapters.adapter_sha256(used) if used else None,
        "quantization": quantization,
    }
    system = System(
        *(candidate.name, configuration.name, candidate.row_name, candidate.published),
        is_standin=candidate.is_standin,
        pretrained=candidate.knows(vocabulary),
        merged=candidate.merged is not None,
        with_vocabulary=adapters.prompt_has_vocabulary(candidate, vocabulary, used),
        adapter=str(used) if used else None,
        seen=seen if used else 0,
    )
    threads = decoding_threads(candidate, str(common["device"]).split()[0])
    every = _parts(common, system, parts)
    return Job(candidate, configuration, every, system, used, quantization, threads)


def _parts(common: Parts, system: System, parts: Parts) -> Parts:
    named = {"candidate": system.candidate, "configuration": system.configuration}
    return {**common, **named, **parts, "vocabulary in the prompt": system.with_vocabulary}


def _check_servable(configurations: Sequence[Configuration]) -> None:
    for one in configurations:
        if one.strength not in ("free", "schema"):
            problem = f"{one.strength} needs our own decoding; with --endpoint there are {SERVED}"
            raise PlannerError(f"--configurations {one.name}: {problem}")


def _served_job(endpoint: EndpointSettings, configuration: Configuration, common: Parts) -> Job:
    """A job of the served model; published figures stand beside one of the published names."""
    wanted, every = endpoint.model.lower(), all_candidates()
    known = [one for one in every if wanted in ((one.repo or "").lower(), one.name.lower())]
    candidate = Candidate(name=endpoint.model, published=known[0].published if known else None)
    label = f"{candidate.row_name} at {endpoint.host}"
    named = candidate.name, configuration.name, label, candidate.published
    system = System(*named, with_vocabulary=not configuration.adapter)
    sampling = {"temperature": 0, "seed": SERVER_SEED}
    parts = _parts(common, system, {"endpoint": endpoint.root, "sampling": sampling})
    return Job(candidate, configuration, parts, system)
