"""Packs: one vocabulary and several samples that share it, one behind the other.

A sample sees the vocabulary and itself, and its positions go on where the vocabulary ends: each is
computed as if it stood alone behind that prompt, and the prompt is paid for once.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.data.missions import sample_missions
from planner_ft.data.varying import with_unfamiliar_words
from planner_ft.pretraining.views import view
from planner_ft.prompts.render import end_of_turn_ids, prompt_frame
from planner_ft.prompts.text import answer_text
from planner_ft.vocabulary import Vocabulary

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

IGNORE = -100
SAMPLES = (6, 12)
"""Samples in a pack, at least and at most."""
UNFAMILIAR = 0.35
"""Share of the samples whose targets go by words that the generators do not have."""
Ids = NDArray[np.int64]
Part = tuple[Ids, int]
"""Token ids and the length of the prompt among them; of the vocabulary, all is prompt."""
Pack = list[Part]
"""The vocabulary's prompt, then the samples behind it."""


@dataclass(frozen=True)
class Row:
    """Packs as one row: int64 arrays of shape (1, width) and `parts`, shape (n, 4): where each part
    begins and ends, and where its vocabulary does (empty for a vocabulary itself).
    """

    input_ids: Ids
    labels: Ids
    positions: Ids
    parts: Ids

    @property
    def tokens(self) -> int:
        """The number of tokens."""
        return int(self.input_ids.size)


def draw_packs(
    vehicles: Sequence[Vocabulary],
    weights: Sequence[float],
    tokenizer: PreTrainedTokenizerBase,
    seed: int,
    longest: int,
) -> Iterator[Pack]:
    """Endless packs of mission samples, each of a vehicle under other names."""
    rng = Random(f"{seed} packs")
    samples = [sample_missions(seed + 31, None, vehicle) for vehicle in vehicles]
    for index in iter(lambda: rng.choices(range(len(vehicles)), weights)[0], None):
        drawn, vehicle = itertools.islice(samples[index], rng.randint(*SAMPLES)), vehicles[index]
        records = [
            (rng.random() < UNFAMILIAR and with_unfamiliar_words(one, vehicle, rng, own=True))
            or one
            for one in drawn
        ]
        yield packed(vehicle, records, vehicles, tokenizer, rng, longest)


def packed(
    vehicle: Vocabulary,
    records: Sequence[dict[str, Any]],
    others: Sequence[Vocabulary],
    tokenizer: PreTrainedTokenizerBase,
    rng: Random,
    longest: int,
) -> Pack:
    """A pack of these records; samples of more than `longest` tokens are left out."""
    seen = view(vehicle, records, others, rng)
    before, after = prompt_frame("mission", tokenizer, seen.vocabulary, with_vocabulary=True)
    prefix = tokenizer.encode(before, add_special_tokens=False)
    behind, end = tokenizer.encode(after, add_special_tokens=False), end_of_turn_ids(tokenizer)[0]
    pack: Pack = [(np.array(prefix, dtype=np.int64), len(prefix))]
    for record in map(seen.record, records):
        user = tokenizer.encode(
            record["prompt"].strip(), add_special_tokens=False, split_special_tokens=True
        )
        text = answer_text("mission", record, seen.vocabulary)
        answer = tokenizer.encode(text, add_special_tokens=False)
        ids = [*user, *behind, *answer, end]
        if len(ids) <= longest:
            pack.append((np.array(ids, dtype=np.int64), len(user) + len(behind)))
    return pack


def arrays(packs: Sequence[Pack]) -> dict[str, Any]:
    """Packs as arrays for a shard."""
    parts = [part for pack in packs for part in pack]
    return {
        "pack_ids": np.concatenate([np.zeros(0, np.uint16), *(ids for ids, _ in parts)]).astype(
            np.uint16
        ),
        "pack_parts": np.array([(len(ids), prompt) for ids, prompt in parts], np.int32),
        "pack_sizes": np.array([len(pack) for pack in packs], np.int32),
    }


def packs_in(data: Any) -> list[Pack]:
    """The packs of a shard; none in one that was written without."""
    if "pack_sizes" not in data or not len(data["pack_sizes"]):
        return []
    lengths, prompts = data["pack_parts"].T
    ids = np.split(data["pack_ids"].astype(np.int64), np.cumsum(lengths)[:-1])
    parts = list(zip(ids, map(int, prompts), strict=True))
    ends = np.cumsum(data["pack_sizes"]).tolist()
    return [parts[start:end] for start, end in itertools.pairwise([0, *ends])]


def rows_of_packs(packs: Sequence[Pack], batch_tokens: int, rng: Any) -> list[Row]:
    """Rows of about `batch_tokens` tokens, in a drawn order."""
    rows, waiting, used = list[Row](), list[Pack](), 0
    for index in map(int, rng.permutation(len(packs))):
        waiting.append(packs[index])
        used += sum(len(ids) for ids, _prompt in packs[index])
        if used >= batch_tokens - 1000:
            rows.append(row_of(waiting))
            waiting, used = [], 0
    return rows + ([row_of(waiting)] if waiting else [])


def row_of(packs: Sequence[Pack]) -> Row:
    """These packs as one row."""
    ids, labels, positions, parts = list[Ids](), list[Ids](), list[Ids](), []
    at = 0
    for pack in packs:
        vocabulary = at, at + len(pack[0][0])
        for number, (tokens, prompt) in enumerate(pack):
            shown = vocabulary if number else (at, at)
            parts.append((at, at + len(tokens), *shown))
            target = np.full(len(tokens), IGNORE)
            target[prompt - 1 : -1] = tokens[prompt:]
            ids.append(tokens)
            labels.append(target)
            positions.append(np.arange(len(tokens)) + (shown[1] - shown[0]))
            at += len(tokens)
    found, wanted, places = (np.concatenate(one)[None] for one in (ids, labels, positions))
    return Row(found, wanted, places, np.array(parts, dtype=np.int64))
