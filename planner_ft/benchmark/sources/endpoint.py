"""Answers of a server that speaks the OpenAI chat completions API, and the jobs of a run against
one.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.results import System
from planner_ft.benchmark.sampled import repeated
from planner_ft.benchmark.samples import BenchData, Sample, default_data, load_bench_data
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.benchmark.sources import Answered, Timed
from planner_ft.benchmark.sources.bounded import bounded
from planner_ft.benchmark.sources.chat_client import ChatClient, Rejected, Unanswerable
from planner_ft.benchmark.sources.chat_reply import Reply
from planner_ft.benchmark.sources.endpoint_settings import EndpointSettings
from planner_ft.benchmark.sources.served_schema import (
    FORMS,
    PROBE_SCHEMA,
    is_probe_answer,
    response_format,
    served_schema,
)
from planner_ft.candidates import Candidate, all_candidates
from planner_ft.decoding.configurations import Configuration, parse_configuration
from planner_ft.prompts.render import PROMPT_VERSION
from planner_ft.prompts.text import prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary, load_vocabulary

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan

SEED = 0
"""Sent with temperature 0, for servers that break ties by chance."""
UNPENALISED = {"repeat_penalty": 1.0}
"""llama.cpp's Python server punishes repetition unless it is told not to: no greedy decoding, and
the end of every JSON. Not all servers take the field.
"""
GREETING = "Greet me in one word."


def endpoint_plan(settings: BenchSettings, endpoint: EndpointSettings) -> Plan:
    """The jobs of a run against a server, checked; nothing is asked yet. Raises PlannerError."""
    from planner_ft.benchmark.plan import Plan

    _refuse_local_flags(settings)
    endpoint.api_key()
    vocabulary = load_vocabulary(settings.vocabulary)
    configurations = list(dict.fromkeys(_configuration(text) for text in settings.configurations))
    data = load_bench_data(
        settings.data or default_data(settings.level), settings.level, vocabulary, settings.limit
    )
    candidate = _served_candidate(endpoint)
    jobs = [_job(settings, endpoint, candidate, one, vocabulary, data) for one in configurations]
    return Plan(
        settings,
        data,
        vocabulary,
        "server",
        tuple(one for job in jobs for one in repeated(job, settings)),
    )


def _refuse_local_flags(settings: BenchSettings) -> None:
    given = {
        "--adapter": bool(settings.adapters),
        "--quantization": settings.quantization is not None,
        "--device": settings.device != "auto",
        "--planning-samples": settings.planning_samples > 0,
    }
    flags = [flag for flag, is_given in given.items() if is_given]
    if flags:
        raise PlannerError(
            f"{', '.join(flags)}: these go with models that are loaded here; leave them out when"
            " you give --endpoint"
        )


def _configuration(text: str) -> Configuration:
    configuration = parse_configuration(text)
    if configuration.strength not in ("free", "schema"):
        raise PlannerError(
            f"--configurations {configuration.name}: {configuration.strength} needs our own"
            " decoding; with --endpoint there are base, lora (a fine-tuned model, told no"
            " vocabulary), base+schema and lora+schema"
        )
    return configuration


def _served_candidate(endpoint: EndpointSettings) -> Candidate:
    """The served model; published figures stand beside one of the published names."""
    wanted = endpoint.model.lower()
    known = next(
        (
            candidate
            for candidate in all_candidates()
            if wanted in {(candidate.repo or "").lower(), candidate.name.lower()}
        ),
        None,
    )
    return Candidate(name=endpoint.model, published=known.published if known else None)


def _job(
    settings: BenchSettings,
    endpoint: EndpointSettings,
    candidate: Candidate,
    configuration: Configuration,
    vocabulary: Vocabulary,
    data: BenchData,
) -> Job:
    from planner_ft.benchmark.plan import Job

    with_vocabulary = not configuration.adapter
    parts = {
        "level": settings.level,
        "candidate": candidate.name,
        "configuration": configuration.name,
        "endpoint": endpoint.root,
        "prompt format": PROMPT_VERSION,
        "vocabulary in the prompt": with_vocabulary,
        "vocabulary": vocabulary.sha256,
        "data": data.sha256,
        "max-new-tokens": settings.token_limit,
        "sampling": {"temperature": 0, "seed": SEED},
    }
    label = f"{candidate.row_name} at {endpoint.host}"
    system = System(
        candidate.name,
        configuration.name,
        label=label,
        published=candidate.published,
        with_vocabulary=with_vocabulary,
    )
    return Job(candidate, configuration, None, "none", with_vocabulary, parts, system, None)


class EndpointSource:
    """A server. What it says of itself, and how it is asked for a schema, is found out when the
    source is opened.
    """

    def __init__(
        self,
        client: ChatClient,
        plan: Plan,
        models: list[dict[str, Any]] | None,
        fields: dict[str, Any],
        schema_form: str | None,
        seconds: float,
    ) -> None:
        self.client = client
        self.plan = plan
        self.models = models
        self.fields = fields
        self.schema_form = schema_form
        self.seconds = seconds
        self.streams = True

    @classmethod
    def open(cls, plan: Plan, jobs: Sequence[Job], endpoint: EndpointSettings) -> EndpointSource:
        """Ask the server what it serves, which fields it takes and, if a job needs it, whether it
        can hold answers to a schema. Raises PlannerError.
        """
        started = time.perf_counter()
        client = ChatClient(endpoint)
        try:
            models, fields = client.models(), _accepted_fields(client, endpoint)
            form = (
                _schema_form(client, endpoint)
                if any(job.configuration.strength == "schema" for job in jobs)
                else None
            )
        except BaseException:
            client.close()
            raise
        return cls(client, plan, models, fields, form, time.perf_counter() - started)

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Answered]]:
        """Several questions at a time; answers that came are yielded also when another question
        failed for good.
        """
        yield from bounded(
            self._answered,
            [self.request(job, sample) for sample in samples],
            self.client.settings.concurrency,
            self.client.stop,
        )

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Timed]]:
        """One question at a time, streamed where the server streams, after one that is not
        counted.
        """
        if samples:
            self._timed(self.request(job, samples[0]))
        for index, sample in enumerate(samples):
            yield index, self._timed(self.request(job, sample))

    def costs(self) -> dict[str, Any]:
        asked = {
            "endpoint": self.client.settings.root,
            "models": self.models,
            "request_fields": self.fields,
            "schema_form": self.schema_form,
        }
        return {"load_s": round(self.seconds, 3), **asked}

    def release(self) -> None:
        self.client.close()

    def request(self, job: Job, sample: Sample) -> dict[str, Any]:
        """The body of a chat completions request: greedy, or sampled where the job is a repeat,
        with the messages that the local candidates get.
        """
        level, vocabulary = self.plan.settings.level, self.plan.vocabulary
        messages = prompt_messages(
            level, sample.record, vocabulary, with_vocabulary=job.with_vocabulary
        )
        body = {
            **_body(self.client.settings, messages, self.plan.settings.token_limit),
            **self.fields,
        }
        if job.sampling is not None:
            body |= {
                "temperature": job.sampling.temperature,
                "top_p": job.sampling.top_p,
                "seed": job.sampling.seed_of(sample.id) % 2**31,
            }
        if job.configuration.strength == "schema" and self.schema_form:
            body["response_format"] = response_format(
                self.schema_form, served_schema(level, vocabulary)
            )
        return body

    def _answered(self, body: dict[str, Any]) -> Answered:
        started = time.perf_counter()
        try:
            reply = self.client.complete(body)
        except Unanswerable as problem:
            return Answered(
                "", time.perf_counter() - started, "error", tokens=0, error=str(problem)
            )
        return Answered(
            reply.text,
            reply.seconds,
            reply.finish_reason,
            reply.tokens,
            reply.prompt_tokens,
            more={"attempts": reply.attempts},
        )

    def _timed(self, body: dict[str, Any]) -> Timed:
        started = time.perf_counter()
        try:
            reply = self._streamed(body) if self.streams else self.client.complete(body)
        except Unanswerable:
            return Timed(time.perf_counter() - started, tokens=0)
        return Timed(reply.seconds, reply.tokens, first_token_s=reply.first_token_s)

    def _streamed(self, body: dict[str, Any]) -> Reply:
        try:
            return self.client.complete(body, stream=True)
        except Rejected as problem:
            if problem.status not in (400, 422):
                raise
        self.streams = False
        return self.client.complete(body)


def _body(
    endpoint: EndpointSettings, messages: list[dict[str, str]], max_tokens: int
) -> dict[str, Any]:
    return {
        "model": endpoint.model,
        "messages": messages,
        "temperature": 0,
        "seed": SEED,
        "max_tokens": max_tokens,
    }


def _accepted_fields(client: ChatClient, endpoint: EndpointSettings) -> dict[str, Any]:
    """The fields beyond the usual ones that the server takes. Raises PlannerError when it does not
    answer at all.
    """
    body = _body(endpoint, [{"role": "user", "content": GREETING}], 1)
    client.complete(body)
    return UNPENALISED if _heeded(client, {**body, **UNPENALISED}) is not None else {}


def _schema_form(client: ChatClient, endpoint: EndpointSettings) -> str:
    """The first way of asking for a schema that the server heeds. Raises PlannerError when it heeds
    none.
    """
    body = _body(endpoint, [{"role": "user", "content": GREETING}], 64)
    for form in FORMS:
        text = _heeded(client, {**body, "response_format": response_format(form, PROBE_SCHEMA)})
        if text is not None and is_probe_answer(text):
            return form
    raise PlannerError(
        f"{endpoint.root}: the server does not hold answers to a JSON schema (response_format);"
        " leave out the configurations with +schema"
    )


def _heeded(client: ChatClient, body: dict[str, Any]) -> str | None:
    """The answer to a request with a field that the server may not know, None where it fails: some
    answer even that with HTTP 500.
    """
    try:
        return client.complete(body, retries=1).text
    except (PlannerError, Unanswerable):
        return None
