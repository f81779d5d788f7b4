"""Sources of answers: a candidate that is loaded here, in batches whose size finds itself, or a
chat completions server, held to a plan's strict schema where that is asked. One serves the jobs of
one candidate; what it answered before it failed half-way is kept.
"""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeVar

from planner_ft.benchmark.chat_client import ChatClient, Rejected, Reply, Unanswerable
from planner_ft.benchmark.plan import SERVER_SEED, Job, Plan
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import EndpointSettings
from planner_ft.candidates.loading import resolve_device
from planner_ft.confidence.calibration import plan_confidence, read_calibration
from planner_ft.confidence.parts import as_json, known
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.engine import Engine
from planner_ft.planning.settings import Agent
from planner_ft.prompts import prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import peak_memory, reset_peak_memory
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level
from planner_ft.vocabulary.schema import NON_BLANK, Schema, plan_schema

if TYPE_CHECKING:
    from planner_ft.decoding.generate import Generation
    from planner_ft.decoding.sequence import Query

Fields = dict[str, Any]  # fields of a line; those that a source cannot know are None
Timed = tuple[float, int | None, int | None, float | None]
"""Of one query: seconds, tokens, forward passes, and seconds until the first token was known."""
Answer = TypeVar("Answer")
SWAPS = 3  # how often the adapter is put on and off to time it
FIRST, LARGEST = 16, 256
"""The size to begin with, also the largest on a CPU (larger ones gain nothing), and on a GPU."""
UNPENALISED = {"repeat_penalty": 1.0}
"""Else llama.cpp's Python server punishes repetition, and so every JSON; some refuse the field."""
LOGPROBS = {"logprobs": True, "top_logprobs": 3}
"""How servers are asked for log-probabilities; those that do not know them go without."""
GREETING = "Greet me in one word."
FORMS = ("json_schema", "json_object")
"""Ways of asking for a schema: OpenAI's (vLLM, Ollama, llama.cpp), llama.cpp's older one."""
PROBE_ANSWER = {"probe": "buoy 41"}  # an answer that no model gives unless it is held to a schema
PROBE_SCHEMA: Schema = {"type": "object", "properties": {"probe": {"const": "buoy 41"}}}
PROBE_SCHEMA |= {"required": ["probe"], "additionalProperties": False}


class EngineSource:
    """An engine with the candidate's adapter, if any job needs it. Raises PlannerError."""

    def __init__(self, plan: Plan, jobs: Sequence[Job]) -> None:
        self.plan, self.level = plan, plan.settings.level
        self.device = resolve_device(plan.device)
        reset_peak_memory(self.device)
        started = time.perf_counter()
        adapter = next((job.adapter for job in jobs if job.adapter), None)
        self.engine = Engine.load(
            jobs[0].candidate,
            plan.vocabulary,
            adapters={self.level: adapter} if adapter else None,
            device=plan.device,
            quantization=jobs[0].quantization,
            max_new_tokens=plan.settings.token_limit,
            threads=jobs[0].threads,
        )
        self.load_seconds = time.perf_counter() - started
        for job in jobs:  # a limit that a strength cannot keep is refused before the first query
            self.engine.method(self.level, job.configuration)
        # The size of batches is judged by a peak of its own, which begins here.
        self.load_peak = peak_memory(self.device)
        largest = LARGEST if plan.device.startswith("cuda") else FIRST
        asked = plan.settings.batch_size
        self.batch = BatchSize(asked, asked) if asked else BatchSize(FIRST, largest)

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Batch by batch, longest prompts first."""
        queries = self._queries(job, samples)
        lengths = [len(query.prompt) for query in queries]

        def ask(indices: list[int]) -> Iterator[tuple[int, Generation]]:
            chosen, how = [queries[index] for index in indices], {"sampling": job.sampling}
            return self.engine.answers(chosen, job.configuration, batch_size=len(indices), **how)

        calibration = None
        if job.sampling is None:
            how = job.configuration, job.adapter, job.quantization
            told = bool(job.system.with_vocabulary)
            agent = Agent(self.level, job.candidate, *how, told)
            held_for = agent.held_for(self.plan.vocabulary)
            calibration = read_calibration(agent.calibration, held_for)[0]
        for index, answer, size in in_batches(ask, lengths, self.batch, is_out_of_memory):
            text = self.engine.text(answer)
            choices = known(self.engine.choices(answer), text)
            fields = {
                "output": text,
                "tokens": len(answer.ids),
                "forward_passes": answer.forward_passes,
                "time_s": round(answer.seconds, 4),
                "finish_reason": answer.finish_reason,
                "error": answer.error,
                "prompt_tokens": lengths[index],
                "batch": size,
            }
            extra: Fields = {"alternatives": answer.alternatives}
            extra |= {"working": self.engine.working(answer), "logprobs": as_json(choices)}
            extra["confidence"] = plan_confidence(calibration, text, choices)
            more = {name: value for name, value in extra.items() if value not in (None, 0, "")}
            yield index, {**fields, **more}

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Timed]]:
        queries = self._queries(job, samples)
        for index, one in self.engine.latencies(queries, job.configuration, sampling=job.sampling):
            yield index, (one.seconds, len(one.ids), one.forward_passes, one.first_token_s)

    def costs(self) -> dict[str, Any]:
        """Seconds to load, the mean of an adapter switch, the most memory since loading."""
        swap, began = None, time.perf_counter()
        if self.level in self.engine.adapters:
            for adapter in (True, False) * SWAPS:
                with self.engine.configured(self.level, Configuration(adapter)):
                    pass
            swap = round((time.perf_counter() - began) / (2 * SWAPS), 6)
        peak = max(self.load_peak, peak_memory(self.device))
        loading = round(self.load_seconds, 3)
        return {"load_s": loading, "adapter_swap_s": swap, "peak_memory_bytes": peak}

    def release(self) -> None:
        self.engine.release()

    def _queries(self, job: Job, samples: Sequence[Sample]) -> list[Query]:
        told = bool(job.system.with_vocabulary)
        return [self.engine.query(self.level, one.record, with_vocabulary=told) for one in samples]


@dataclass
class BatchSize:
    """The queries that are generated together, and how many there may be at most."""

    size: int
    largest: int

    def used(self, count: int, *, fitted: bool) -> None:
        """Judge by a batch of `count` queries. Raises PlannerError when one alone did not fit."""
        if fitted:
            self.size = min(2 * count, self.largest) if count == self.size else self.size
        elif count == 1:
            raise PlannerError(
                "the device has too little memory for a single query; give a smaller candidate or"
                " another --device (what is done is kept for --resume)"
            )
        else:
            self.size = self.largest = count // 2


def in_batches(
    ask: Callable[[list[int]], Iterator[tuple[int, Answer]]],
    lengths: Sequence[int],
    batch: BatchSize,
    out_of_memory: Callable[[Exception], bool],
) -> Iterator[tuple[int, Answer, int]]:
    """Yield (index, answer, size of its batch), longest queries first, so that a query that does
    not fit shows at once; those that a full memory left unanswered are asked again. `ask` answers
    the queries of some indices and yields (place among them, answer).
    """
    waiting = sorted(range(len(lengths)), key=lambda index: (-lengths[index], index))
    while waiting:
        asked, done, full = waiting[: batch.size], set(), False
        try:
            for place, answer in ask(asked):
                done.add(asked[place])
                yield asked[place], answer, len(asked)
        except Exception as error:
            if not out_of_memory(error):
                raise
            full = True
        # Out of the handler: the exception held the tensors of the batch.
        batch.used(len(asked), fitted=not full)
        waiting = [index for index in waiting if index not in done]


def is_out_of_memory(error: BaseException) -> bool:
    """Whether the accelerator's memory was too small; its cached memory is given back then."""
    import torch

    found = any(isinstance(one, torch.OutOfMemoryError) for one in (error, error.__cause__))
    if found and torch.cuda.is_available():
        torch.cuda.empty_cache()
    return found


class EndpointSource:
    """A server; opening asks what it serves and heeds. Raises PlannerError."""

    def __init__(self, plan: Plan, jobs: Sequence[Job], endpoint: EndpointSettings) -> None:
        started = time.perf_counter()
        self.plan, self.endpoint = plan, endpoint
        self.client = ChatClient(endpoint)
        self.streams = True
        try:
            self.models = self.client.models()
            # A server that does not answer at all is said to be so here.
            self.client.complete(self._greeting(1))
            heeded = self._tried(self._greeting(1, **UNPENALISED))
            self.fields: dict[str, Any] = dict(UNPENALISED if heeded else {})
            # Only log-probabilities that can be believed. Streams time an answer: what is asked for
            # beside it would be timed, too.
            told = self._tried(self._greeting(4, **LOGPROBS))
            self.asked: dict[str, Any] = LOGPROBS if told and told.choices is not None else {}
            held = any(job.configuration.strength == "schema" for job in jobs)
            self.schema_form = self._accepted_form() if held else None
        except BaseException:
            self.client.close()
            raise
        self.seconds = time.perf_counter() - started

    def answers(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Fields]]:
        """Several questions at a time; answers are yielded also when another question failed."""
        bodies = [{**self.request(job, sample), **self.asked} for sample in samples]
        yield from self.client.complete_all(self._answered, bodies)

    def latencies(self, job: Job, samples: Sequence[Sample]) -> Iterator[tuple[int, Timed]]:
        """One question at a time, streamed if the server streams, after one that is not counted."""
        bodies = [self.request(job, sample) for sample in samples]
        for index, body in enumerate([*bodies[:1], *bodies], -1):
            reply = self._reply(body, stream=self.streams)
            if index >= 0:
                yield index, (reply.seconds, reply.tokens, None, reply.first_token_s)

    def costs(self) -> dict[str, Any]:
        return {
            "load_s": round(self.seconds, 3),
            "endpoint": self.endpoint.root,
            "models": self.models,
            "request_fields": {**self.fields, **self.asked},
            "schema_form": self.schema_form,
        }

    def release(self) -> None:
        self.client.close()

    def request(self, job: Job, sample: Sample) -> dict[str, Any]:
        """The body of a request, greedy or sampled, with the messages that candidates get."""
        level, vocabulary = self.plan.settings.level, self.plan.vocabulary
        told = bool(job.system.with_vocabulary)
        messages = prompt_messages(level, sample.record, vocabulary, with_vocabulary=told)
        body = {**self._body(messages, self.plan.settings.token_limit), **self.fields}
        if (drawn := job.sampling) is not None:
            body |= {"temperature": drawn.temperature, "top_p": drawn.top_p}
            body["seed"] = drawn.seed_of(sample.id) % 2**31
        if job.configuration.strength == "schema" and self.schema_form:
            schema = served_schema(level, vocabulary)
            body["response_format"] = _response_format(self.schema_form, schema)
        return body

    def _answered(self, body: dict[str, Any]) -> Fields:
        reply = self._reply(body, stream=False)
        return {
            "output": reply.text,
            "tokens": reply.tokens,
            "forward_passes": None,
            "time_s": round(reply.seconds, 4),
            "finish_reason": reply.finish_reason,
            "error": reply.problem,
            "prompt_tokens": reply.prompt_tokens,
            "attempts": reply.attempts,
            **({"logprobs": as_json(reply.choices)} if reply.choices else {}),
        }

    def _reply(self, body: dict[str, Any], *, stream: bool) -> Reply:
        """The answer, empty for a question that is too long; a server may refuse to `stream`."""
        started = time.perf_counter()
        try:
            return self.client.complete(body, stream=stream)
        except Unanswerable as problem:
            seconds = time.perf_counter() - started
            return Reply("", seconds, "error", tokens=0, problem=str(problem))
        except Rejected as problem:
            if not stream or problem.status not in (400, 422):
                raise
        self.streams = False
        return self._reply(body, stream=False)

    def _body(self, messages: list[dict[str, str]], most: int) -> dict[str, Any]:
        greedy = {"temperature": 0, "seed": SERVER_SEED, "max_tokens": most}
        return {"model": self.endpoint.model, "messages": messages, **greedy}

    def _greeting(self, max_tokens: int, **fields: Any) -> dict[str, Any]:
        return {**self._body([{"role": "user", "content": GREETING}], max_tokens), **fields}

    def _accepted_form(self) -> str:
        """The first way of asking for a schema that is heeded. Raises PlannerError without one."""
        for form in FORMS:
            wanted = _response_format(form, PROBE_SCHEMA)
            found = self._tried(self._greeting(64, response_format=wanted))
            with contextlib.suppress(ValueError):
                if found and json.loads(found.text) == PROBE_ANSWER:
                    return form
        problem = "the server does not hold answers to a JSON schema (response_format)"
        way = "leave out the configurations with +schema"
        raise PlannerError(f"{self.endpoint.root}: {problem}; {way}")

    def _tried(self, body: dict[str, Any]) -> Reply | None:
        """The answer to a request that the server may not know, None: some say HTTP 500."""
        try:
            return self.client.complete(body, retries=1)
        except (PlannerError, Unanswerable):
            return None


def served_schema(level: Level, vocabulary: Vocabulary) -> Schema:
    """The strict schema of a level's plans in the words that servers' grammar compilers understand.
    Compilers differ: llama.cpp's reads no unanchored pattern and takes `anyOf` instead of the
    properties beside it. The form here admits the same plans but for one thing: a text that must
    not be blank must only not be empty.
    """
    schema = plan_schema(level, vocabulary, strict=True).items()
    kept = {key: value for key, value in schema if key not in ("$schema", "title")}
    served: Schema = _translated(kept)
    return served


def _response_format(form: str, schema: Schema) -> dict[str, Any]:
    """The request's `response_format` field in one of FORMS."""
    if form == "json_object":
        return {"type": "json_object", "schema": schema}
    named = {"name": "plan", "strict": True, "schema": schema}
    return {"type": "json_schema", "json_schema": named}


def _translated(schema: Any) -> Any:
    if isinstance(schema, list):
        return [_translated(entry) for entry in schema]
    if not isinstance(schema, dict):
        return schema
    if schema == NON_BLANK:
        return {"type": "string", "minLength": 1}
    if "anyOf" in schema and "properties" in schema:
        rest = {key: value for key, value in schema.items() if key != "anyOf"}
        required = rest.get("required", [])
        choices = (list(dict.fromkeys([*required, *one["required"]])) for one in schema["anyOf"])
        return {"anyOf": [_translated({**rest, "required": choice}) for choice in choices]}
    return {key: _translated(value) for key, value in schema.items()}
