"""Benchmarking a server that speaks the OpenAI chat completions API: what it is asked, and what is
written down.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import jsonschema
import pytest

from planner_ft.benchmark.runner import run_bench
from planner_ft.benchmark.settings import BenchSettings, EndpointSettings
from planner_ft.benchmark.sources import GREETING, PROBE_ANSWER, served_schema
from planner_ft.cli import main
from planner_ft.prompts import system_text
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import plan_schema

from .chat_server import PLAN, Body, ChatServer, Handler, asked, chat_server, completion

COUNT = 6
CURATED = Path(__file__).parents[2] / "data" / "mission" / "validation.jsonl"


@pytest.fixture
def server() -> Iterator[ChatServer]:
    with chat_server() as running:
        yield running


@pytest.fixture
def data(tmp_path: Path) -> Path:
    path = tmp_path / "data.jsonl"
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index} {index}",
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(COUNT)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


@pytest.fixture
def settings(server: ChatServer, data: Path, tmp_path: Path) -> Any:
    def make(endpoint: dict[str, Any] | None = None, **changes: Any) -> BenchSettings:
        served = EndpointSettings(
            **{"url": server.url, "model": "tiny", "timeout": 600.0, **(endpoint or {})}
        )
        values: dict[str, Any] = {
            "configurations": ("base",),
            "latency_samples": 2,
            "data": data,
            "out": tmp_path / "out",
            **changes,
        }
        return BenchSettings(level="mission", candidates=("tiny",), endpoint=served, **values)

    return make


def lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def test_a_server_is_asked_greedily_with_the_prompts_of_local_candidates(
    server: ChatServer, settings: Any, tmp_path: Path
) -> None:
    results = run_bench(settings())
    row = next(row for row in results.rows if row.key == "tiny base")
    assert (row.n, row.metrics["f1"].value, row.metrics["strict_valid"].value) == (COUNT, 1.0, 1.0)
    request = server.requests[0]
    assert (
        request["path"],
        request["model"],
        request["temperature"],
        request["seed"],
        request["max_tokens"],
    ) == ("/v1/chat/completions", "tiny", 0, 0, 2048)
    assert request["messages"][0] == {
        "role": "system",
        "content": system_text("mission", load_vocabulary("usv"), with_vocabulary=True),
    }
    assert {asked(body) for body in server.requests} == {
        f"go to {index} {index}" for index in range(COUNT)
    }
    record = lines(tmp_path / "out" / "predictions.jsonl")[0]
    assert (
        record["tokens"],
        record["prompt_tokens"],
        record["finish_reason"],
        record["attempts"],
    ) == (7, 11, "stop", 1)
    assert f"tiny at 127.0.0.1:{server.server_port}" in (tmp_path / "out" / "table.md").read_text()


@pytest.mark.parametrize("takes", [True, False])
def test_repetition_is_not_punished_where_the_server_can_be_told(
    server: ChatServer, settings: Any, tmp_path: Path, takes: bool
) -> None:
    if not takes:
        unknown = {"error": {"message": "Unrecognized request argument: repeat_penalty"}}
        server.greet = lambda handler, body: (
            "repeat_penalty" in body and (handler.send(400, unknown) or True)
        )
    run_bench(settings())
    assert {body.get("repeat_penalty") for body in server.requests} == {1.0 if takes else None}
    costs = json.loads((tmp_path / "out" / "results.json").read_text())["manifest"]["costs"]["tiny"]
    assert costs["request_fields"] == ({"repeat_penalty": 1.0} if takes else {}) and costs[
        "models"
    ] == [{"id": "tiny", "object": "model"}]


def test_a_fine_tuned_model_is_told_no_vocabulary(server: ChatServer, settings: Any) -> None:
    run_bench(settings(configurations=("lora",), latency_samples=0))
    assert server.requests[0]["messages"][0]["content"] == system_text(
        "mission", load_vocabulary("usv"), with_vocabulary=False
    )


def test_latency_is_measured_one_at_a_time_and_the_first_token_is_timed(
    server: ChatServer, settings: Any, tmp_path: Path
) -> None:
    run_bench(settings())
    timed = lines(tmp_path / "out" / "latency.jsonl")
    streamed = [body for body in server.requests if body.get("stream")]
    # A warm-up that is not counted, then every timed sample once.
    assert [asked(body) for body in streamed] == ["go to 0 0", "go to 0 0", "go to 1 1"]
    assert [(line["id"], line["tokens"]) for line in timed] == [("m0", 7), ("m1", 7)]
    assert all(0 < line["first_token_s"] <= line["latency_s"] for line in timed)


def test_a_server_that_does_not_stream_is_timed_all_the_same(
    server: ChatServer, settings: Any, tmp_path: Path
) -> None:
    def no_streams(handler: Handler, body: Body) -> bool:
        if body.get("stream"):
            handler.send(400, {"error": {"message": "stream is not supported"}})
        return bool(body.get("stream"))

    server.act = no_streams
    run_bench(settings())
    timed = lines(tmp_path / "out" / "latency.jsonl")
    assert [line["tokens"] for line in timed] == [7, 7] and not any(
        "first_token_s" in line for line in timed
    )
    assert sum(bool(body.get("stream")) for body in server.requests) == 1


@pytest.mark.parametrize("concurrency", [1, 3])
def test_no_more_questions_are_open_than_allowed(
    server: ChatServer, settings: Any, concurrency: int
) -> None:
    import threading

    meeting = threading.Barrier(concurrency)

    def meet(_handler: Handler, _body: Body) -> bool:
        meeting.wait(
            120
        )  # breaks, and fails the request, unless so many questions are open together
        return False

    server.act = meet
    run_bench(settings({"concurrency": concurrency, "retries": 0}, latency_samples=0))
    assert (server.most_open, len(server.requests)) == (concurrency, COUNT)


@pytest.mark.parametrize(
    ("form", "status"), [("json_schema", 422), ("json_object", 422), ("json_object", 500)]
)
def test_answers_are_held_to_the_schema_in_the_way_that_the_server_knows(
    server: ChatServer, settings: Any, form: str, status: int
) -> None:
    def one_form(handler: Handler, body: Body) -> bool:
        wanted = body.get("response_format")
        if wanted and wanted["type"] != form:
            handler.send(status, {"detail": "response_format"})
            return True
        if wanted and "probe" in json.dumps(wanted):
            handler.send(200, completion(json.dumps(PROBE_ANSWER)))
            return True
        return False

    server.act = one_form
    run_bench(settings(configurations=("base", "base+schema"), latency_samples=0))
    formats = [
        body["response_format"]
        for body in server.requests
        if "response_format" in body and "probe" not in json.dumps(body["response_format"])
    ]
    schema = served_schema("mission", load_vocabulary("usv"))
    expected = (
        {"type": form, "schema": schema}
        if form == "json_object"
        else {"type": form, "json_schema": {"name": "plan", "strict": True, "schema": schema}}
    )
    assert formats == [expected] * COUNT


def test_a_server_without_schemas_is_refused_before_anything_is_asked(
    server: ChatServer, settings: Any
) -> None:
    with pytest.raises(
        PlannerError,
        match=(
            r"does not hold answers to a JSON schema .* leave out the configurations with \+schema"
        ),
    ):
        run_bench(settings(configurations=("base", "base+schema")))
    assert len(server.requests) == 2


@pytest.mark.parametrize("level", ["mission", "task"])
def test_the_schema_that_is_sent_admits_the_same_plans(level: Any) -> None:
    vocabulary = load_vocabulary("usv")
    sent = jsonschema.Draft202012Validator(served_schema(level, vocabulary))
    ours = jsonschema.Draft202012Validator(plan_schema(level, vocabulary, strict=True))
    text = json.dumps(sent.schema)
    assert '"pattern"' not in text and not [
        node for node in _objects(sent.schema) if "anyOf" in node and "properties" in node
    ]
    if level == "mission":
        plans = [record["expected"] for record in lines(CURATED)]
        assert plans and all(sent.is_valid(plan) for plan in plans)
    for title, parameters in (
        ("Transit", {}),
        ("Transit", {"target_position": [1]}),
        ("Fly", {}),
        ("SearchAndDetect", {"target_description": ""}),
    ):
        plan = {
            "tasks": [{"title": title, "parameters": parameters, "task_prompt": "x"}],
            "assumptions": [],
            "constraints": [],
        }
        assert sent.is_valid(plan) is ours.is_valid(plan)


def _objects(value: Any) -> Iterator[dict[str, Any]]:
    if isinstance(value, dict):
        yield value
    for inner in (
        value.values() if isinstance(value, dict) else value if isinstance(value, list) else ()
    ):
        yield from _objects(inner)


def test_a_question_too_long_for_the_server_is_an_empty_plan(
    server: ChatServer, settings: Any, tmp_path: Path
) -> None:
    def too_long(handler: Handler, body: Body) -> bool:
        if asked(body) == "go to 2 2":
            handler.send(
                400, {"error": {"message": "This model's maximum context length is 8 tokens."}}
            )
        return asked(body) == "go to 2 2"

    server.act = too_long
    results = run_bench(settings(latency_samples=0))
    row = next(row for row in results.rows if row.key == "tiny base")
    record = next(
        line for line in lines(tmp_path / "out" / "predictions.jsonl") if line["id"] == "m2"
    )
    assert (record["output"], record["finish_reason"]) == (
        "",
        "error",
    ) and "maximum context length" in record["error"]
    assert row.n == COUNT and row.metrics["f1"].value == pytest.approx((COUNT - 1) / COUNT)


def test_a_finished_run_is_scored_again_without_the_server(
    server: ChatServer, settings: Any
) -> None:
    before = run_bench(settings())
    asked_before = len(server.requests)
    server.act = lambda handler, _body: handler.send(500, {}) or True
    after = run_bench(settings(resume=True))
    assert len(server.requests) == asked_before
    assert [row.metrics for row in after.rows] == [row.metrics for row in before.rows]


def test_another_server_is_not_mixed_in(settings: Any) -> None:
    run_bench(settings(latency_samples=0))
    with (
        chat_server() as other,
        pytest.raises(PlannerError, match="was begun with another endpoint"),
    ):
        run_bench(settings({"url": other.url}, resume=True))


def test_the_key_is_sent_and_written_nowhere(
    server: ChatServer, data: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: Any
) -> None:
    monkeypatch.setenv("THE_KEY", "sk-very-secret")
    flags = [
        "--endpoint",
        server.url,
        "--model",
        "tiny",
        "--level",
        "mission",
        "--data",
        str(data),
        "--out",
        str(tmp_path / "out"),
        "--api-key-env",
        "THE_KEY",
    ]
    monkeypatch.setattr(sys, "argv", ["plannerft", "bench", *flags])
    with pytest.raises(SystemExit) as ended:
        main()
    assert not ended.value.code
    assert {body["key"] for body in server.requests} == {"Bearer sk-very-secret"}
    shown = capsys.readouterr()
    written = (
        "".join(
            path.read_bytes().decode(errors="replace")
            for path in (tmp_path / "out").rglob("*")
            if path.is_file()
        )
        + shown.out
        + shown.err
    )
    assert server.url in written and "sk-very-secret" not in written


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--model", "tiny"], "needs both --endpoint URL and --model NAME"),
        (
            ["--endpoint", "http://u:secret@h/v1", "--model", "tiny"],
            "without user, password or query",
        ),
        (["--endpoint", "localhost:8000", "--model", "tiny"], "no http URL"),
        (
            ["--endpoint", "http://h/v1", "--model", "tiny", "--candidates", "embedded"],
            "give one of them",
        ),
        (
            ["--endpoint", "http://h/v1", "--model", "tiny", "--configurations", "base+state"],
            "state needs our own decoding",
        ),
        (
            ["--endpoint", "http://h/v1", "--model", "tiny", "--adapter", "x"],
            "--adapter: these go with models that are loaded here",
        ),
        (
            ["--endpoint", "http://h/v1", "--model", "tiny", "--concurrency", "0"],
            "--concurrency 0: must be between 1",
        ),
        (
            ["--endpoint", "http://h/v1", "--model", "tiny", "--api-key-env", "NO_SUCH_VARIABLE"],
            "not set",
        ),
    ],
)
def test_flags_that_do_not_go_together_are_one_sentence(
    flags: list[str],
    message: str,
    data: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Any,
) -> None:
    monkeypatch.setattr(
        sys,
        "argv",
        [
            "plannerft",
            "bench",
            "--level",
            "mission",
            "--data",
            str(data),
            "--out",
            str(tmp_path / "out"),
            *flags,
        ],
    )
    with pytest.raises(SystemExit) as ended:
        main()
    said = capsys.readouterr().err
    assert (
        ended.value.code == 2 and message in said and said.count("\n") == 1 and "secret" not in said
    )


def test_the_usual_answer_is_a_valid_plan() -> None:
    jsonschema.Draft202012Validator(
        plan_schema("mission", load_vocabulary("usv"), strict=True)
    ).validate(PLAN)


def told(text: str, logprob: float) -> dict[str, Any]:
    """A reply with the log-probabilities of two tokens."""
    tokens = [
        {"token": part, "logprob": logprob, "top_logprobs": [{"token": "x", "logprob": -4.0}]}
        for part in (text[:9], text[9:])
    ]
    reply = completion(text)
    reply["choices"][0]["logprobs"] = {"content": tokens}
    return reply


@pytest.mark.parametrize(
    ("logprob", "asks"), [(-0.05, True), (0.7, False), (float("nan"), False), (0.0, False)]
)
def test_log_probabilities_of_a_server_are_kept_unless_they_cannot_be(
    server: ChatServer, settings: Any, logprob: float, asks: bool
) -> None:
    def tell(handler: Handler, body: dict[str, Any]) -> bool:
        text = "Hello there!" if asked(body) == GREETING else json.dumps(PLAN)
        told_of = "logprobs" in body and not body.get("stream")
        handler.send(200, told(text, logprob) if told_of else completion(text))
        return True

    server.act = server.greet = tell
    results = run_bench(settings())
    assert {"logprobs" in body for body in server.requests if not body.get("stream")} == {asks}
    written = lines(settings().folder / "predictions.jsonl")
    assert {"logprobs" in line for line in written} == {asks}
    found = results.rows[0].breakdown.get("confidence")
    assert (found is not None) == asks
    if found:
        assert (found["n"], found["calibrated"]) == (len(written), False)


def test_a_server_that_lies_about_one_answer_alone_is_not_believed_there(
    server: ChatServer, settings: Any
) -> None:
    def tell(handler: Handler, body: dict[str, Any]) -> bool:
        honest = asked(body) == GREETING or len(server.requests) % 2
        text = "Hello there!" if asked(body) == GREETING else json.dumps(PLAN)
        handler.send(200, told(text, -0.05 if honest else 3.0))
        return True

    server.act = server.greet = tell
    found = run_bench(settings({"concurrency": 1})).rows[0].breakdown["confidence"]
    assert found["n"] and found["not_known"]
