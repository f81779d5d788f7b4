"""inspect_ai on our samples, with answers that are made up: its figures are our scores."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

pytest.importorskip("inspect_ai")
pytestmark = pytest.mark.peers

from planner_ft.benchmark.samples import load_bench_data  # noqa: E402
from planner_ft.benchmark.scoring import score_sample  # noqa: E402
from planner_ft.prompts import prompt_messages  # noqa: E402
from planner_ft.vocabulary import load_vocabulary  # noqa: E402

ROOT = Path(__file__).parents[2]
FILE = str(ROOT / "eval" / "inspect_ai" / "planner.py")


async def count_words(text: str) -> int:
    return len(text.split())


@pytest.mark.parametrize(
    ("level", "name", "data"),
    [
        ("mission", "mission", "data/mission/test.jsonl"),
        ("task", "task_level", "eval/challenge/task_unseen.jsonl"),
    ],
)
def test_figures_are_our_scores(
    level: str, name: str, data: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from inspect_ai import eval
    from inspect_ai.model import ModelOutput, get_model

    vocabulary = load_vocabulary()
    samples = load_bench_data(ROOT / data, level, vocabulary).samples[:6]
    texts = [
        json.dumps(samples[0].expected),
        "no plan",
        *(json.dumps(sample.expected) for sample in samples[3:6]),
        "{}",
    ]
    model = get_model(
        "mockllm/model",
        custom_outputs=[ModelOutput.from_content("mockllm/model", text) for text in texts],
    )
    # The model that is made up would count tokens with an encoding that it downloads.
    monkeypatch.setattr(model.api, "count_text_tokens", count_words)

    (log,) = eval(
        f"{FILE}@{name}",
        model=model,
        task_args={"data": data},
        limit=6,
        max_samples=1,
        max_connections=1,
        log_dir=str(tmp_path),
        display="none",
    )

    assert log.status == "success", log.error
    expected = [
        score_sample(level, sample, {"output": text}, vocabulary).values
        for sample, text in zip(samples, texts, strict=True)
    ]
    found = {result.name: result.metrics["mean"].value for result in log.results.scores}
    for metric in ("f1", "schema_valid", "exact_sequence"):
        assert found[metric] == pytest.approx(sum(float(values[metric]) for values in expected) / 6)
    asked = [(message.role, message.content) for message in log.samples[0].messages[:2]]
    assert asked == [
        (message["role"], message["content"])
        for message in prompt_messages(level, samples[0].record, vocabulary, with_vocabulary=True)
    ]
