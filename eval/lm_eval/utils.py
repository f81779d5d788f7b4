"""The mission and task benchmarks for lm-evaluation-harness: our prompts and our scores on whatever
model it can load.

Nothing is defined here: prompts come from `planner_ft.prompts`, samples and scores from
`planner_ft.benchmark`.
"""

from __future__ import annotations

import json
import logging
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

from datasets import Dataset
from lm_eval.api.task import ConfigurableTask

from planner_ft.benchmark.samples import BenchData, Sample, load_bench_data
from planner_ft.benchmark.scoring import score_sample
from planner_ft.candidates import all_candidates
from planner_ft.prompts import PLAIN_FORM, TODAY, completion_text, prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

ROOT = Path(__file__).resolve().parents[2]
METRICS = ("f1", "hallucination", "schema_valid", "strict_valid", "exact_sequence", "whole_plan")
"""Metrics of one sample that lm-evaluation-harness takes the mean of."""


class PlannerTask(ConfigurableTask):
    """A task whose prompt has the bytes that `plannerft bench` gives the same model."""

    def __init__(self, config: Mapping[str, Any]) -> None:
        # The loader leaves the key that names this class among the settings.
        super().__init__(config={key: value for key, value in config.items() if key != "class"})

    def fewshot_context(
        self,
        doc: Mapping[str, Any],
        num_fewshot: int,
        system_instruction: str | None = None,
        apply_chat_template: bool = False,
        fewshot_as_multiturn: bool = False,
        chat_template: Callable[..., str] | None = None,
        gen_prefix: str | None = None,
    ) -> str:
        """System instruction and user message in the model's chat template, or in the plain form of
        base models.

        Raises PlannerError for few-shot examples and further instructions: the benchmark has
        neither.
        """
        if num_fewshot or system_instruction or gen_prefix:
            raise PlannerError(
                "the planner tasks have a fixed prompt; leave out --num_fewshot,"
                " --system_instruction and a gen_prefix"
            )
        if not (apply_chat_template and chat_template):
            return PLAIN_FORM.format(system=doc["system"], user=doc["user"])
        # Llama 3 templates write today's date unless they are given one.
        arguments = getattr(getattr(chat_template, "__self__", None), "chat_template_args", None)
        if isinstance(arguments, dict):
            arguments.setdefault("date_string", TODAY)
        return chat_template([{"role": role, "content": doc[role]} for role in ("system", "user")])


def load(
    level: Level,
    file: str,
    data: str | None = None,
    vocabulary: str = "usv",
    with_vocabulary: bool | None = None,
    pretrained: Any = None,
    peft: str | None = None,
    **_: Any,
) -> dict[str, Dataset]:
    """The documents of a task: a sample's record as JSON, its prompt in two messages, and the
    expected answer.

    The samples are those of `file`, in this repository, or of `data`. `with_vocabulary` says
    whether the prompt holds the vocabulary; None decides as `plannerft bench` does: a model with an
    adapter (`peft`) has learned it, and so has one that was pretrained on it. Raises PlannerError
    for bad data.
    """
    definition = load_vocabulary(vocabulary)
    samples = _samples(data or file, level, definition)
    if with_vocabulary is None:
        with_vocabulary = not peft and not _knows(pretrained, definition)
    logging.getLogger("lm_eval").info(
        f"{samples.path}: the prompt {'holds' if with_vocabulary else 'does not hold'} the"
        " vocabulary"
    )
    documents = [
        _document(level, vocabulary, definition, sample, with_vocabulary)
        for sample in samples.samples
    ]
    return {"test": Dataset.from_list(documents)}


def score(doc: Mapping[str, Any], results: list[str]) -> dict[str, Any]:
    """Our scores of one answer: metrics of METRICS, and (right, matched) parameters for `ratio`."""
    record, level = json.loads(doc["record"]), doc["level"]
    sample = Sample(record["id"], doc["family"], record)
    values = score_sample(
        level, sample, {"output": results[0]}, load_vocabulary(doc["vocabulary"])
    ).values
    parameters = values["parameters_right"], values["parameters_matched"]
    return {name: float(values[name] or 0) for name in METRICS} | {"parameters_right": parameters}


def ratio(pairs: Iterable[tuple[float, float]]) -> float:
    """Sum of the first over sum of the second numbers."""
    right, matched = (sum(part) for part in zip(*pairs, strict=True))
    return right / matched if matched else float("nan")


def _samples(data: str, level: Level, vocabulary: Vocabulary) -> BenchData:
    path = next((path for path in (Path(data), ROOT / data) if path.is_file()), None)
    if path is None:
        raise PlannerError(
            f"{data}: no such file; write it with `plannerft gen-data --level {level}`, or give"
            " another one with --metadata '{\"data\": ...}'"
        )
    return load_bench_data(path, level, vocabulary)


def _document(
    level: Level, name: str, vocabulary: Vocabulary, sample: Sample, with_vocabulary: bool
) -> dict[str, str]:
    messages = prompt_messages(level, sample.record, vocabulary, with_vocabulary=with_vocabulary)
    texts = {message["role"]: message["content"] for message in messages}
    target = completion_text(level, sample.expected, vocabulary)
    named = {"id": sample.id, "family": sample.family, "level": level, "vocabulary": name}
    return {
        **named,
        **texts,
        "target": target,
        "record": json.dumps(sample.record, ensure_ascii=False),
    }


def _knows(pretrained: Any, vocabulary: Vocabulary) -> bool:
    """Whether a model, named or in the folder of a registered candidate, was pretrained on this
    vocabulary.
    """
    if not isinstance(pretrained, str):
        return False
    names = (pretrained, Path(pretrained).resolve())
    return any(
        candidate.knows(vocabulary)
        for candidate in all_candidates()
        if candidate.repo in names or candidate.folder in names
    )
