"""lm-evaluation-harness on our tasks: the prompts' ids, the answers and the scores of `plannerft
bench`.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

pytest.importorskip("lm_eval")
pytestmark = pytest.mark.peers

from lm_eval import simple_evaluate  # noqa: E402
from lm_eval.models.huggingface import HFLM  # noqa: E402
from lm_eval.tasks import TaskManager  # noqa: E402

from planner_ft.benchmark.samples import load_bench_data  # noqa: E402
from planner_ft.benchmark.scoring import score_sample  # noqa: E402
from planner_ft.candidates import resolve_candidate  # noqa: E402
from planner_ft.decoding.configurations import Configuration  # noqa: E402
from planner_ft.decoding.engine import Engine  # noqa: E402
from planner_ft.prompts import render_prompt  # noqa: E402
from planner_ft.vocabulary import load_vocabulary  # noqa: E402

ROOT = Path(__file__).parents[2]
TASKS = ROOT / "eval" / "lm_eval"
FILES = {
    "planner_mission_test": ("mission", "data/mission/test.jsonl"),
    "planner_mission_challenge": ("mission", "data/mission/challenge.jsonl"),
    "planner_task_challenge": ("task", "eval/challenge/task_unseen.jsonl"),
}
LIMIT = 12


def manager(**metadata: Any) -> TaskManager:
    return TaskManager(include_path=str(TASKS), include_defaults=False, metadata=metadata)


@pytest.fixture(scope="module")
def engine() -> Engine:
    """The embedded candidate in float32, where an answer depends on no kernel's rounding."""
    engine = Engine.load(
        resolve_candidate("embedded"),
        load_vocabulary(),
        device="cpu",
        quantization="none",
        threads=1,
        lean=False,
    )
    engine.model.float()
    return engine


@pytest.fixture(scope="module")
def harness(engine: Engine) -> HFLM:
    return HFLM(pretrained=engine.model, tokenizer=engine.tokenizer, batch_size=8, max_length=4096)


@pytest.mark.parametrize("task", FILES)
def test_the_same_model_answers_and_scores_the_same(
    task: str, engine: Engine, harness: HFLM
) -> None:
    level, path = FILES[task]
    data = load_bench_data(ROOT / path, level, engine.vocabulary, LIMIT)
    queries = [engine.query(level, sample.record) for sample in data.samples]
    texts = {
        index: engine.text(answer)
        for index, answer in engine.answers(queries, Configuration(adapter=False), batch_size=8)
    }
    scores = [
        score_sample(level, sample, {"output": texts[index]}, engine.vocabulary).values
        for index, sample in enumerate(data.samples)
    ]

    found = simple_evaluate(
        model=harness,
        tasks=[task],
        task_manager=manager(with_vocabulary=False),
        apply_chat_template=True,
        limit=LIMIT,
        log_samples=True,
        bootstrap_iters=0,
    )

    theirs = {sample["doc"]["id"]: sample["filtered_resps"][0] for sample in found["samples"][task]}
    assert theirs == {sample.id: texts[index] for index, sample in enumerate(data.samples)}
    assert any('"title"' in text or '"name"' in text for text in theirs.values())
    for metric in ("f1", "exact_sequence", "strict_valid"):
        assert found["results"][task][f"{metric},none"] == pytest.approx(
            sum(float(score[metric]) for score in scores) / len(scores)
        )
    matched = sum(score["parameters_matched"] for score in scores)
    assert found["results"][task]["parameters_right,none"] == pytest.approx(
        sum(score["parameters_right"] for score in scores) / matched
    )


@pytest.mark.parametrize(
    "candidate", ["Llama-3.2-1B", "Llama-3.2-1B-Instruct", "Qwen2.5-3B-Instruct"]
)
@pytest.mark.parametrize("task", FILES)
def test_prompts_have_the_ids_that_bench_gives(task: str, candidate: str, models: Path) -> None:
    level, path = FILES[task]
    model = HFLM(pretrained=str(models / candidate), device="cpu", batch_size=1)
    chat = bool(model.tokenizer.chat_template)
    (loaded,) = manager(pretrained=str(models / candidate)).load([task])["tasks"].values()
    data = load_bench_data(ROOT / path, level, load_vocabulary())
    documents = list(loaded.test_docs())
    assert [document["id"] for document in documents] == [sample.id for sample in data.samples]
    for sample, document in zip(data.samples, documents, strict=True):
        text = loaded.fewshot_context(
            document,
            0,
            apply_chat_template=chat,
            chat_template=model.apply_chat_template if chat else None,
        )
        ids, _mask = model.tok_batch_encode([text])
        assert ids[0].tolist() == render_prompt(
            level, sample.record, model.tokenizer, load_vocabulary(), with_vocabulary=True
        )


@pytest.mark.parametrize(
    ("metadata", "told"),
    [
        ({}, True),
        ({"pretrained": "planner_ft/candidates/embedded"}, False),
        ({"pretrained": "somewhere/else"}, True),
        ({"pretrained": "somewhere/else", "peft": "adapter"}, False),
        ({"pretrained": "planner_ft/candidates/embedded", "with_vocabulary": True}, True),
    ],
)
def test_the_prompt_holds_the_vocabulary_as_in_bench(
    metadata: dict[str, Any], told: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    (task,) = manager(**metadata).load(["planner_mission_test"])["tasks"].values()
    assert ("SearchAndDetect" in next(iter(task.test_docs()))["system"]) == told


def test_bad_data_and_further_instructions_are_refused_in_a_sentence(tmp_path: Path) -> None:
    from planner_ft.support.errors import PlannerError

    with pytest.raises(PlannerError, match="no such file"):
        manager(data=str(tmp_path / "none.jsonl")).load(["planner_mission_test"])
    (task,) = manager().load(["planner_mission_test"])["tasks"].values()
    with pytest.raises(PlannerError, match="num_fewshot"):
        task.fewshot_context(next(iter(task.test_docs())), 3)


def test_logged_answers_can_be_scored_by_us(tmp_path: Path) -> None:
    import runpy

    predictions = runpy.run_path(str(TASKS / "predictions.py"))["predictions"]
    log = tmp_path / "samples.jsonl"
    log.write_text(
        json.dumps({"doc": {"id": "a"}, "filtered_resps": ["{}"], "resps": [["{}"]]}) + "\n"
    )
    assert list(predictions(log)) == [{"id": "a", "output": "{}"}]
