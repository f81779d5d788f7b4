"""The mission and task benchmarks for inspect_ai: our prompts and our scores on any model that it
can ask.

inspect eval eval/inspect_ai/planner.py@mission --model openai/MODEL inspect eval
eval/inspect_ai/planner.py@task_level --model openai/MODEL -T data=data/task/test_unseen.jsonl
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from inspect_ai import Task, task
from inspect_ai.dataset import MemoryDataset
from inspect_ai.dataset import Sample as Asked
from inspect_ai.model import ChatMessage, ChatMessageSystem, ChatMessageUser, GenerateConfig
from inspect_ai.scorer import Score, Scorer, Target, mean, scorer, stderr
from inspect_ai.solver import TaskState, generate

from planner_ft.benchmark.samples import Sample, load_bench_data
from planner_ft.benchmark.scoring import score_sample
from planner_ft.decoding.configurations import MAX_NEW_TOKENS
from planner_ft.prompts import completion_text, prompt_messages
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

ROOT = Path(__file__).resolve().parents[2]
METRICS = ("f1", "hallucination", "schema_valid", "strict_valid", "exact_sequence", "whole_plan")


@task
def mission(
    data: str = "data/mission/test.jsonl", vocabulary: str = "usv", with_vocabulary: bool = True
) -> Task:
    """Commands to tasks. `with_vocabulary` is for models that have not learned it."""
    return _benchmark("mission", data, load_vocabulary(vocabulary), with_vocabulary=with_vocabulary)


@task
def task_level(
    data: str = "data/task/test.jsonl", vocabulary: str = "usv", with_vocabulary: bool = True
) -> Task:
    """Tasks to skills."""
    return _benchmark("task", data, load_vocabulary(vocabulary), with_vocabulary=with_vocabulary)


@scorer(metrics={name: [mean(), stderr()] for name in METRICS})
def plan_scorer(level: Level, samples: dict[str, Sample], vocabulary: Vocabulary) -> Scorer:
    """Our scores of one answer; one that does not parse is an empty plan."""

    async def score(state: TaskState, target: Target) -> Score:
        output = state.output.completion
        values = score_sample(
            level, samples[str(state.sample_id)], {"output": output}, vocabulary
        ).values
        return Score(value={name: float(values[name] or 0) for name in METRICS}, answer=output)

    return score


def _benchmark(level: Level, data: str, vocabulary: Vocabulary, *, with_vocabulary: bool) -> Task:
    path = Path(data) if Path(data).is_file() else ROOT / data
    samples = load_bench_data(path, level, vocabulary).samples
    asked = [_asked(level, sample, vocabulary, with_vocabulary) for sample in samples]
    return Task(
        dataset=MemoryDataset(asked, name=path.stem),
        solver=generate(),
        scorer=plan_scorer(level, {sample.id: sample for sample in samples}, vocabulary),
        config=GenerateConfig(temperature=0.0, max_tokens=MAX_NEW_TOKENS[level]),
    )


def _asked(level: Level, sample: Sample, vocabulary: Vocabulary, with_vocabulary: bool) -> Asked:
    roles: dict[str, Any] = {"system": ChatMessageSystem, "user": ChatMessageUser}
    messages = prompt_messages(level, sample.record, vocabulary, with_vocabulary=with_vocabulary)
    turns: list[ChatMessage] = [
        roles[message["role"]](content=message["content"]) for message in messages
    ]
    return Asked(
        id=sample.id, input=turns, target=completion_text(level, sample.expected, vocabulary)
    )
