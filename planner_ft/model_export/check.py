"""The answers of a model before and after it is exported."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.data.curated import find_source
from planner_ft.prompts import render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

SEED = 0
TOKEN_CHECKS = 1000


@dataclass(frozen=True)
class Agreement:
    """How far two models agree: `same` of `count` greedy answers, and the largest difference of a
    logit on those answers.
    """

    count: int
    same: int
    largest_logit_difference: float

    def to_json(self) -> dict[str, Any]:
        return {
            "commands": self.count,
            "same_answers": self.same,
            "largest_logit_difference": self.largest_logit_difference,
            "dtype": "float32",
        }


def check_records(
    level: Level, vocabulary: Vocabulary, count: int, data: Path | None = None
) -> list[dict[str, Any]]:
    """The first records of `data`, or of the level's validation set: the curated commands, sampled
    tasks. Raises PlannerError.
    """
    if data is not None:
        records = read_jsonl(data)[:count]
        needed = ("prompt",) if level == "mission" else ("prompt", "task")
        for number, record in enumerate(records, 1):
            missing = [key for key in needed if not isinstance(record.get(key), str)]
            if missing:
                raise PlannerError(
                    f"{data}: record {number} has no {missing[0]}; give commands of the {level}"
                    " level"
                )
        return records
    if level == "mission":
        return read_jsonl(find_source() / "validation.jsonl")[:count]
    from planner_ft.data.task.sampler import sample_tasks

    return list(itertools.islice(sample_tasks(vocabulary, SEED, count, "validation"), count))


def token_records(
    level: Level, vocabulary: Vocabulary, records: Sequence[dict[str, Any]]
) -> list[dict[str, Any]]:
    """These records and a thousand drawn ones, to compare the ids of their prompts in two
    tokenizers.
    """
    if level == "task":
        return [*records, *check_records(level, vocabulary, TOKEN_CHECKS)]
    from planner_ft.data.missions import sample_missions
    from planner_ft.data.templates.records import template_files

    if not template_files(vocabulary, "commands"):
        return list(records)
    return [*records, *sample_missions(SEED, TOKEN_CHECKS, vocabulary)]


class Answers:
    """Greedy answers of a float32 model, and the logits along them."""

    def __init__(
        self,
        level: Level,
        records: Sequence[dict[str, Any]],
        tokenizer: Any,
        vocabulary: Vocabulary,
        *,
        with_vocabulary: bool,
    ) -> None:
        from planner_ft.decoding.generate import Query

        def query(record: dict[str, Any]) -> Query:
            ids = render_prompt(
                level, record, tokenizer, vocabulary, with_vocabulary=with_vocabulary
            )
            return Query(level, record, tuple(ids))

        self.queries = [query(record) for record in records]
        self.level, self.tokenizer = level, tokenizer

    def of(self, model: Any) -> list[tuple[int, ...]]:
        """The ids of the model's answers."""
        from planner_ft.decoding.configurations import MAX_NEW_TOKENS, Limits
        from planner_ft.decoding.engine import end_ids, named_ends
        from planner_ft.decoding.generate import generate
        from planner_ft.decoding.passes import ModelDecoder

        ends, pad = end_ids(self.tokenizer, named_ends(model)), int(self.tokenizer.pad_token_id)
        limits = Limits(ends, pad, MAX_NEW_TOKENS[self.level])
        answers = generate(ModelDecoder(model, limits.pad_id), self.queries, limits, batch_size=1)
        return [answer.ids for answer in answers]

    def logits(self, model: Any, answers: Sequence[Sequence[int]]) -> list[Any]:
        """The logits after each position of prompt and answer: tensors (positions, tokens)."""
        import torch

        with torch.inference_mode():
            return [
                model(input_ids=torch.tensor([[*query.prompt, *ids]])).logits[0]
                for query, ids in zip(self.queries, answers, strict=True)
            ]


def agreement(
    answers: Answers, expected: Sequence[tuple[int, ...]], logits: Sequence[Any], model: Any
) -> Agreement:
    """Compare a model with the answers and logits of another. Raises PlannerError when an answer
    differs.
    """
    found = answers.of(model)
    pairs = zip(logits, answers.logits(model, expected), strict=True)
    largest = max(float((one - other).abs().max()) for one, other in pairs)
    same = sum(one == other for one, other in zip(expected, found, strict=True))
    count = len(expected)
    if same < count:
        raise PlannerError(
            f"{count - same} of {count} answers differ between the adapter and the merged weights"
            f" (logits by up to {largest:.3g}), so nothing was written; give other commands with"
            " --check-data, or serve base and adapter as they are"
        )
    return Agreement(count, same, largest)
