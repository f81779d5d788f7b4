"""Plans that anybody can make without a model, to draft from: how plans of this vocabulary are
usually worded.
"""

from __future__ import annotations

import contextlib
from collections.abc import Iterator
from typing import Any

from planner_ft.data.mission.source import find_source
from planner_ft.decoding.drafting import PhraseBook
from planner_ft.prompts.text import answer_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import iterate_jsonl
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import DEFAULT
from planner_ft.vocabulary.plans import Level

TASKS = 60
"""Sampled plans in the book of the task level; 20 saved as many passes as 120."""
SEED = 1


def phrase_book(level: Level, tokenizer: Any, vocabulary: Vocabulary, end_id: int) -> PhraseBook:
    """The phrase book of a level in a tokenizer's tokens; answers end with `end_id`. No mission
    plans are known of other vocabularies than the default one.
    """
    texts = (answer_text(level, record, vocabulary) for record in _records(level, vocabulary))
    return PhraseBook([*tokenizer.encode(text, add_special_tokens=False), end_id] for text in texts)


def _records(level: Level, vocabulary: Vocabulary) -> Iterator[dict[str, Any]]:
    """Labelled training records: sampled tasks, and the curated commands where they are for this
    vocabulary and at hand.
    """
    if level == "task":
        from planner_ft.data.task.sampler import sample_tasks

        yield from sample_tasks(vocabulary, SEED, TASKS, "train")
    elif vocabulary.name == DEFAULT:
        with contextlib.suppress(PlannerError):
            yield from (
                record
                for _line, record, _problem in iterate_jsonl(find_source() / "train.jsonl")
                if record is not None
            )
