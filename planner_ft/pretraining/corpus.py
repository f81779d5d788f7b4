"""The pretraining corpus: synthetic samples of both levels, rendered, tokenised and packed into rows.

Only the training families of the generators are drawn: the curated mission set and the task level's `test_unseen`
families never enter. A row holds whole samples side by side; `documents` keeps them apart in attention.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.data.mission.synthetic import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.prompts.render import render_sample
from planner_ft.prompts.text import completion_text, user_text
from planner_ft.support.files import atomic_writer
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

IGNORE = -100


@dataclass(frozen=True)
class Rows:
    """Packed rows, each array int64 of shape (rows, width); labels are IGNORE outside answers, documents -1 on padding."""

    input_ids: NDArray[np.int64]
    labels: NDArray[np.int64]
    positions: NDArray[np.int64]
    documents: NDArray[np.int64]


def stream(vocabulary: Vocabulary, seed: int, mission_share: float) -> Iterator[tuple[Level, dict[str, Any]]]:
    """Endless mixed samples of both levels."""
    missions, tasks = sample_missions(seed), sample_tasks(vocabulary, seed, None, "train")
    draw = np.random.default_rng(seed)
    while True:
        if draw.random() < mission_share:
            yield "mission", next(missions)
        else:
            yield "task", next(tasks)


def tokenizer_texts(vocabulary: Vocabulary, seed: int, count: int, mission_share: float) -> Iterator[str]:
    """Texts of `count` samples to train the tokenizer on: each input and each answer."""
    samples = stream(vocabulary, seed, mission_share)
    for _ in range(count):
        level, record = next(samples)
        yield user_text(level, record, vocabulary)
        yield completion_text(level, record["expected"], vocabulary)


def encode_shard(
    path: Path, tokenizer: PreTrainedTokenizerBase, vocabulary: Vocabulary, *, seed: int, count: int, mission_share: float, longest: int
) -> dict[str, int]:
    """Write `count` tokenised samples as one .npz file; return counts. Samples over `longest` tokens are left out."""
    samples = stream(vocabulary, seed, mission_share)
    ids: list[NDArray[np.uint16]] = []
    prompts: list[int] = []
    left_out = 0
    for _ in range(count):
        level, record = next(samples)
        rendered = render_sample(level, record, tokenizer, vocabulary)
        if len(rendered.input_ids) > longest:
            left_out += 1
            continue
        ids.append(np.array(rendered.input_ids, dtype=np.uint16))
        prompts.append(rendered.prompt_length)
    lengths = np.array([len(item) for item in ids], dtype=np.int32)
    with atomic_writer(path, "wb") as stream_:
        np.savez(stream_, ids=np.concatenate(ids), lengths=lengths, prompts=np.array(prompts, dtype=np.int32))
    return {"samples": len(ids), "tokens": int(lengths.sum()), "left_out": left_out}


def load_shard(path: Path) -> list[tuple[NDArray[np.int64], int]]:
    """The samples of a shard as (ids, prompt length)."""
    with np.load(path) as data:
        ends = np.cumsum(data["lengths"])
        ids = data["ids"].astype(np.int64)
        return [(ids[end - length : end], int(prompt)) for end, length, prompt in zip(ends, data["lengths"], data["prompts"], strict=True)]


def pack(samples: list[tuple[NDArray[np.int64], int]], width: int, pad: int, seed: int) -> Rows:
    """Pack samples of at most `width` tokens into rows, in an order drawn from `seed`, filling the first open row that fits."""
    order = np.random.default_rng(seed).permutation(len(samples))
    rows: list[list[int]] = []
    room: list[int] = []
    first_open = 0
    for index in order:
        length = len(samples[index][0])
        for row in range(first_open, len(rows)):
            if room[row] >= length:
                rows[row].append(int(index))
                room[row] -= length
                break
        else:
            rows.append([int(index)])
            room.append(width - length)
        # Only the last rows stay open: older ones have too little room to be worth looking at.
        first_open = max(first_open, len(rows) - 24)
    return _fill(rows, samples, width, pad)


def _fill(rows: list[list[int]], samples: list[tuple[NDArray[np.int64], int]], width: int, pad: int) -> Rows:
    shape = (len(rows), width)
    packed = Rows(np.full(shape, pad), np.full(shape, IGNORE), np.zeros(shape, dtype=np.int64), np.full(shape, -1))
    for row, members in enumerate(rows):
        start = 0
        for document, index in enumerate(members):
            ids, prompt = samples[index]
            end = start + len(ids)
            packed.input_ids[row, start:end] = ids
            # Labels are shifted here: position i predicts token i + 1 of its own sample.
            packed.labels[row, start + prompt - 1 : end - 1] = ids[prompt:]
            packed.positions[row, start:end] = np.arange(len(ids))
            packed.documents[row, start:end] = document
            start = end
    return packed
