"""Answers of a chat completions server, held to a plan's strict schema where that is asked."""

from __future__ import annotations

import contextlib
import json
import time
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.plan import SERVER_SEED
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.settings import EndpointSettings
from planner_ft.benchmark.sources import Fields, Timed
from planner_ft.benchmark.sources.chat_client import ChatClient, Rejected, Reply, Unanswerable
from planner_ft.confidence.parts import as_json
from planner_ft.prompts import prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level
from planner_ft.vocabulary.schema import NON_BLANK, Schema, plan_schema

if TYPE_CHECKING:
    from planner_ft.benchmark.plan import Job, Plan

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
