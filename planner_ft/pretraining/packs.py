"""Packs: one vocabulary and several samples that share it, one behind the other.

A sample sees the vocabulary and itself, and its positions go on where the vocabulary ends: each is
computed as if it stood alone behind that prompt, and the prompt is paid for once. The vocabulary is
that of a vehicle under other names: what a model can only plan for by reading it. Titles and keys
are renamed, tasks that the samples do not need are dropped, the others stand in another order, and
home, the unresolved place and the vehicle's name are others. What a task is for stands in its
description, which stays.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.data.missions import sample_missions
from planner_ft.data.varying import with_unfamiliar_words
from planner_ft.facts.words import known_words
from planner_ft.prompts import prompt_frame, render_sample
from planner_ft.vocabulary import Task, Vocabulary

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

IGNORE = -100
SAMPLES = (6, 12)
"""Samples in a pack, at least and at most."""
UNFAMILIAR = 0.35
"""Share of the samples whose targets go by words that the generators do not have."""
Ids = NDArray[np.int64]
Part = tuple[Ids, int]
"""Token ids and the length of the prompt among them; of a vocabulary, all is prompt."""
Pack = list[Part]
"""The vocabulary's prompt, then the samples behind it."""
KEPT, DESCRIBED = 0.2, 0.65
"""Share of the names that stay, and of all that stay or are made of words of the description."""
SMALL = "a an and at by for in into is it its of off on or that the to up what with"
"""Words that no name is made of."""
STYLES: tuple[Callable[[Sequence[str]], str], ...] = (
    lambda words: "".join(word.capitalize() for word in words),
    lambda words: "".join(word.capitalize() for word in words),
    "_".join,
    lambda words: "_".join(words).upper(),
    lambda words: words[0] + "".join(word.capitalize() for word in words[1:]),
)
HOMES = ((0, 0), (0, 0), (5, 5), (-3, 12), (10, 0), (0, -20), (1, 1), (100, 50))
UNRESOLVED = ((-99, -99), (-99, -99), (-1, -1), (999, 999), (-999, -999), (9999, 9999))
_ANY = tuple(sorted(word for word in known_words() if 3 <= len(word) <= 9 and word.isascii()))


def draw_packs(
    vehicles: Sequence[Vocabulary],
    weights: Sequence[float],
    tokenizer: PreTrainedTokenizerBase,
    seed: int,
    longest: int,
    written: Sequence[Sequence[dict[str, Any]]] = (),
    share: float = 0.0,
) -> Iterator[Pack]:
    """Endless packs of mission samples, each of a vehicle under other names. This `share` of them
    are commands written by hand, of the vehicles that have some: `written`, in their order.
    """
    rng = Random(f"{seed} packs")
    samples = [sample_missions(seed + 31, None, vehicle) for vehicle in vehicles]
    known = [weight * bool(records) for weight, records in zip(weights, written, strict=False)]
    while True:
        by_hand = any(known) and rng.random() < share
        index = rng.choices(range(len(vehicles)), known if by_hand else weights)[0]
        vehicle, count = vehicles[index], rng.randint(*SAMPLES)
        drawn = [*itertools.islice(samples[index], 0 if by_hand else count)]
        if by_hand:
            drawn = rng.sample(written[index], min(count, len(written[index])))
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
    frames = (
        prompt_frame("mission", tokenizer, seen.vocabulary, with_vocabulary=shown)[0]
        for shown in (True, False)
    )
    prefix, other = (tokenizer.encode(text, add_special_tokens=False) for text in frames)
    pack: Pack = [(np.array(prefix, dtype=np.int64), len(prefix))]
    for record in map(seen.record, records):
        # All but the prefix is the same with the vocabulary and without it.
        alone = render_sample("mission", record, tokenizer, seen.vocabulary)
        ids = np.array(alone.input_ids[len(other) :], dtype=np.int64)
        if len(ids) <= longest:
            pack.append((ids, alone.prompt_length - len(other)))
    return pack


def arrays(packs: Sequence[Pack]) -> dict[str, Any]:
    """Packs as arrays for a shard."""
    parts = [part for pack in packs for part in pack]
    ids = np.concatenate([np.zeros(0), *(ids for ids, _prompt in parts)])
    return {
        "pack_ids": ids.astype(np.uint16),
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


# ---------------------------------------------------------------- other names


@dataclass(frozen=True)
class View:
    """A renamed vocabulary, and how records of the own one are put into it."""

    vocabulary: Vocabulary
    titles: dict[str, str]
    keys: dict[str, str]
    places: Mapping[tuple[float, float], tuple[float, float]]

    def record(self, record: dict[str, Any]) -> dict[str, Any]:
        """A mission record with the view's names and places."""
        expected = record["expected"]
        tasks = [
            {
                "title": self.titles[task["title"]],
                "parameters": {
                    self.keys[key]: self._placed(value) for key, value in task["parameters"].items()
                },
                "task_prompt": self._said(task["task_prompt"]),
            }
            for task in expected["tasks"]
        ]
        texts = {key: [*map(self._said, expected[key])] for key in ("assumptions", "constraints")}
        return {"prompt": record["prompt"], "expected": {"tasks": tasks, **texts}}

    def _placed(self, value: Any) -> Any:
        if isinstance(value, list) and len(value) == 2:
            return list(self.places.get((value[0], value[1]), value))
        return value

    def _said(self, text: str) -> str:
        for own, other in self.places.items():
            text = text.replace(str(list(own)), str(list(other)))
        return text


def view(
    vocabulary: Vocabulary,
    records: Sequence[dict[str, Any]],
    others: Sequence[Vocabulary],
    rng: Random,
) -> View:
    """The vehicle under other names, with the tasks of `records` and some of the rest; `others`
    lend it the name of a vehicle and of a frame.
    """
    used = {task["title"] for record in records for task in record["expected"]["tasks"]}
    share = rng.uniform(0.3, 1.0)
    tasks = [task for task in vocabulary.tasks if task.title in used or rng.random() < share]
    if rng.random() < 0.7:
        rng.shuffle(tasks)
    titles = _names([(task.title, task.description) for task in tasks], rng)
    keys = _names([(one.name, one.description) for task in tasks for one in task.parameters], rng)
    home, unresolved = rng.choice(HOMES), rng.choice(UNRESOLVED)
    renamed = replace(
        vocabulary,
        title=rng.choice(others).title,
        frame=rng.choice(others).frame,
        home=home,
        unresolved=unresolved,
        tasks=tuple(_renamed(task, titles, keys) for task in tasks),
    )
    places = {vocabulary.home: home, vocabulary.unresolved: unresolved}
    return View(renamed, titles, keys, places)


def _renamed(task: Task, titles: dict[str, str], keys: dict[str, str]) -> Task:
    parameters = tuple(replace(one, name=keys[one.name]) for one in task.parameters)
    needed = tuple(keys[name] for name in task.require_any)
    return replace(task, title=titles[task.title], parameters=parameters, require_any=needed)


def _names(described: Sequence[tuple[str, str]], rng: Random) -> dict[str, str]:
    """Other names for names with their descriptions, all different, in one style."""
    style, found = rng.choice(STYLES), dict[str, str]()
    kept = rng.choice((0.0, KEPT, KEPT, 1.0))
    for name, description in described:
        if name in found:
            continue
        other = name if rng.random() < kept else style(_words(description, rng))
        while other in found.values():
            other += rng.choice("ABCDEFGH23456789")
        found[name] = other
    return found


def _words(description: str, rng: Random) -> list[str]:
    """One to three words of a description, or others that have nothing to do with it."""
    said, small = re.findall("[a-z]{3,}", description.lower()), SMALL.split()
    own = [word for word in said if word not in small]
    count = rng.choice((1, 2, 2, 3))
    if own and rng.random() < DESCRIBED:
        places = sorted(rng.sample(range(len(own)), min(count, len(own))))
        return [own[place] for place in places]
    return [rng.choice(_ANY) for _ in range(min(count, 2))]
