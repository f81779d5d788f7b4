"""The pretraining corpus: synthetic samples of both levels, rendered and tokenised.

Only the training families of the generators are drawn: the curated mission set and the task level's
`test_unseen` families never enter.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from planner_ft.data.missions import missions_with_skills, sample_missions
from planner_ft.data.task.sampler import mission_tasks, sample_tasks
from planner_ft.data.task.working import working_of
from planner_ft.data.varying import with_unfamiliar_words
from planner_ft.pretraining.packs import Pack, Part, arrays, draw_packs, packs_in
from planner_ft.prompts import answer_text, render_sample, user_text
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import atomic_writer, read_jsonl
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level, without_working

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerBase

HANDED_DOWN, HANDED_DOWN_SEED = 0.3, 50_000_000
"""Share of the task inputs that come from missions, and the seed offset of those missions."""
DRILL_SEED = 70_000_000
EMPHASIS_SEED = 90_000_000
CUT = 0.6
"""Share of the samples with a working that end behind it: the plan itself has little to teach."""


@dataclass(frozen=True)
class Encoded:
    """A rendered sample: token ids (int64, 1-D) and the length of the prompt among them.

    `worked` counts the tokens up to the plan; None where no working stands before it.
    """

    ids: NDArray[np.int64]
    prompt: int
    worked: int | None = None


Drawn = tuple[Level, dict[str, Any], Vocabulary]
"""A sample, and the vehicle that it is of."""


@dataclass(frozen=True)
class Mixture:
    """What the samples of a corpus are of, as shares of 0 to 1.

    `missions` are mission samples among all, `vehicles` those of the vehicles in `folder` (a folder
    with a definition and templates for each) among the missions. `unfamiliar` are samples of our
    vehicle whose target gets a name that the generators do not know, where it has a word that can
    be changed; `drills` come on top: sums alone, the beginnings of task answers, per sample; so do
    `packs`, groups of samples with the vocabulary in their prompt, `own` of them of our vehicle.
    `written` of the packs are commands written by hand: those of our vehicle in the files
    `commands`, those of another one in `folder` in its NAME.written.jsonl.
    `emphasis` of our vehicle's missions are drawn from the templates of these `subjects` alone, and
    of its sampled tasks from those of `prompts`.
    """

    missions: float = 0.6
    drills: float = 0.0
    unfamiliar: float = 0.0
    vehicles: float = 0.0
    folder: Path | None = None
    packs: float = 0.0
    own: float = 0.4
    written: float = 0.0
    commands: tuple[Path, ...] = ()
    emphasis: float = 0.0
    subjects: tuple[str, ...] = ()
    prompts: tuple[str, ...] = ()


def stream(vocabulary: Vocabulary, seed: int, mixture: Mixture) -> Iterator[Drawn]:
    """Endless mixed samples of both levels; some task inputs are those of synthetic missions."""
    missions = sample_missions(seed, None, vocabulary)
    tasks = sample_tasks(vocabulary, seed, None, "train")
    handed_down = mission_tasks(vocabulary, seed + HANDED_DOWN_SEED)
    fleet = vehicles_in(mixture.folder) if mixture.folder and mixture.vehicles else ()
    others = [(one, sample_missions(seed, None, one)) for one in fleet]
    draw, words = np.random.default_rng(seed), Random(f"{seed} unfamiliar")
    vehicles, emphasis = Random(f"{seed} vehicles"), Random(f"{seed} emphasis")
    stressed = missions_with_skills(seed + EMPHASIS_SEED, None, vocabulary, mixture.subjects)
    stressed_tasks = sample_tasks(vocabulary, seed + EMPHASIS_SEED, None, "train", mixture.prompts)
    while True:
        level: Level = "mission" if draw.random() < mixture.missions else "task"
        if others and level == "mission" and vehicles.random() < mixture.vehicles:
            vehicle, samples = vehicles.choice(others)
            yield level, next(samples), vehicle
            continue
        source = missions
        if level == "task":
            source = handed_down if draw.random() < HANDED_DOWN else tasks
            if source is tasks and mixture.prompts and emphasis.random() < mixture.emphasis:
                source = stressed_tasks
        elif emphasis.random() < mixture.emphasis:
            source = (record for record, _skills in stressed)
        record, changed = next(source), None
        if words.random() < mixture.unfamiliar:
            changed = with_unfamiliar_words(record, vocabulary, words)
        yield level, changed or record, vocabulary


def vehicles_in(folder: Path) -> Sequence[Vocabulary]:
    """The vehicles FOLDER/NAME/NAME.toml, by name. Raises PlannerError for a wrong definition, or
    where there are none.
    """
    paths = sorted(path for path in folder.glob("*") if path.is_dir())
    if not paths:
        raise PlannerError(f"{folder}: no vehicles; a vehicle is a folder NAME with NAME.toml")
    return [load_vocabulary(path / f"{path.name}.toml") for path in paths]


def written_commands(mixture: Mixture, others: Sequence[Vocabulary]) -> list[list[dict[str, Any]]]:
    """The commands written by hand of our vehicle, and of each of the others. Raises PlannerError
    for a line that is no record.
    """
    named = [(mixture.folder or Path()) / one.name / f"{one.name}.written.jsonl" for one in others]
    files = [mixture.commands, *((path,) if path.is_file() else () for path in named)]
    return [[record for path in paths for record in read_jsonl(path)] for paths in files]


def tokenizer_texts(vocabulary: Vocabulary, seed: int, count: int, share: float) -> Iterator[str]:
    """Texts of `count` samples, this share of them missions, to train the tokenizer on: each input
    and each answer.
    """
    samples = stream(vocabulary, seed, Mixture(share))
    for _ in range(count):
        level, record, vehicle = next(samples)
        yield user_text(level, record, vehicle)
        yield answer_text(level, record, vehicle)


def encoded(
    tokenizer: PreTrainedTokenizerBase,
    vocabulary: Vocabulary,
    level: Level,
    record: dict[str, Any],
    longest: int,
) -> Encoded | None:
    """A rendered sample; None for one of more than `longest` tokens."""
    rendered = render_sample(level, record, tokenizer, vocabulary)
    ids, prompt = np.array(rendered.input_ids, dtype=np.int64), rendered.prompt_length
    if len(ids) > longest:
        return None
    worked = _worked(tokenizer, answer_text(level, record, vocabulary), ids[prompt:])
    return Encoded(ids, prompt, worked and prompt + worked)


def drills(
    tokenizer: PreTrainedTokenizerBase, vocabulary: Vocabulary, *, seed: int, longest: int
) -> Iterator[Encoded]:
    """Endless task samples with a working; up to its end they are practice in sums."""
    for record in sample_tasks(vocabulary, seed + DRILL_SEED, None, "train"):
        if working_of(record, vocabulary):
            sample = encoded(tokenizer, vocabulary, "task", record, longest)
            if sample is not None and sample.worked is not None:
                yield sample


def _worked(tokenizer: PreTrainedTokenizerBase, answer: str, ids: NDArray[np.int64]) -> int | None:
    """Number of tokens of an answer's working; None without one, or where a token spans its end."""
    plan, working = without_working(answer)
    if not working:
        return None
    begun = tokenizer.encode(answer[: len(answer) - len(plan) + 2], add_special_tokens=False)
    return len(begun) if begun == ids[: len(begun)].tolist() else None


def encode_shard(
    path: Path,
    tokenizer: PreTrainedTokenizerBase,
    vocabulary: Vocabulary,
    seed: int,
    count: int,
    longest: int,
    mixture: Mixture,
) -> dict[str, int]:
    """Write `count` tokenised samples as one .npz file; return counts.

    Samples over `longest` tokens are left out and counted. Of those with a working, some end behind
    it (`CUT`); drills are counted apart.
    """
    draw = np.random.default_rng(seed)
    ids: list[NDArray[np.uint16]] = []
    prompts: list[int] = []
    left_out = drilled = 0
    practice = drills(tokenizer, vocabulary, seed=seed, longest=longest)
    drawn = stream(vocabulary, seed, mixture)
    for level, record, vehicle in itertools.islice(drawn, count):
        sample = encoded(tokenizer, vehicle, level, record, longest)
        if sample is None:
            left_out += 1
            continue
        kept = sample.worked if draw.random() < CUT else None
        ids.append(sample.ids[:kept].astype(np.uint16))
        prompts.append(sample.prompt)
        if draw.random() < mixture.drills:
            drill = next(practice)
            ids.append(drill.ids[: drill.worked].astype(np.uint16))
            prompts.append(drill.prompt)
            drilled += 1
    packs = list[Pack]()
    if number := round(count * mixture.packs):
        others = vehicles_in(mixture.folder) if mixture.folder else ()
        weights = [mixture.own, *[(1 - mixture.own) / max(1, len(others))] * len(others)]
        by_hand = written_commands(mixture, others) if mixture.written else ()
        vehicles = [vocabulary, *others]
        endless = draw_packs(vehicles, weights, tokenizer, seed, longest, by_hand, mixture.written)
        packs = list(itertools.islice(endless, number))
    lengths = np.array([len(item) for item in ids], dtype=np.int32)
    with atomic_writer(path, "wb") as stream_:
        at = np.array(prompts, dtype=np.int32)
        held: dict[str, Any] = {"ids": np.concatenate(ids), "lengths": lengths, "prompts": at}
        np.savez(stream_, **held, **arrays(packs))
    samples, tokens = len(ids) - drilled, int(lengths.sum())
    tokens += sum(len(part) for pack in packs for part, _prompt in pack)
    counts = {"samples": samples, "tokens": tokens, "left_out": left_out, "drills": drilled}
    return {**counts, "packs": len(packs)}


def load_shard(path: Path) -> tuple[list[Part], list[Pack]]:
    """The samples of a shard as (ids, prompt length), and its packs."""
    with np.load(path) as data:
        parts = np.split(data["ids"].astype(np.int64), np.cumsum(data["lengths"])[:-1])
        return list(zip(parts, map(int, data["prompts"]), strict=True)), packs_in(data)
