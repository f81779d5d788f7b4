"""The dataset card (card.md.j2): README.md in the Hugging Face form, so that `load_dataset(FOLDER)`
finds every split, with the figures that describe the set.
"""

from __future__ import annotations

import itertools
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from planner_ft.data.leakage import mask
from planner_ft.data.tags import TAGS
from planner_ft.facts import words
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

Records = Sequence[Mapping[str, Any]]
Splits = Mapping[str, Records]
SIZES = ((1_000, "n<1K"), (10_000, "1K<n<10K"), (100_000, "10K<n<100K"), (1_000_000, "100K<n<1M"))
QUANTILES = (0, 50, 90, 100)
OVERLAP = ("split", "other", "exact", "near", "exact_masked", "near_masked", "families")


def dataset_card(
    level: Level,
    splits: Splits,
    vocabulary: Vocabulary,
    leakage: Mapping[str, Any],
    seed: int | None,
) -> str:
    """The card's text: front matter, counts, coverage, lengths, diversity, leakage."""
    import jinja2

    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, keep_trailing_newline=True, autoescape=False
    )
    template = environment.from_string(Path(__file__).with_name("card.md.j2").read_text("utf-8"))
    named = vocabulary.task if level == "mission" else vocabulary.skill
    inputs = [
        [str(record["task"]) for record in records if "task" in record]
        for records in splits.values()
    ]
    tags = [
        [tag for record in records for tag in record.get("tags", ())] for records in splits.values()
    ]
    pairs = {split: set(_pairs(level, records)) for split, records in splits.items()}
    total = sum(map(len, splits.values()))
    figures = {split: diversity(records) for split, records in splits.items() if records}
    plans = [_names(level, records) for records in splits.values()]
    return template.render(
        table=table,
        level=level,
        vehicle=vocabulary.title,
        frame=vocabulary.frame,
        home=list(vocabulary.home),
        unresolved=list(vocabulary.unresolved),
        seed=seed,
        size=next((name for limit, name in SIZES if total < limit), "n>1M"),
        splits=list(splits),
        counts=[[split, len(records)] for split, records in splits.items()],
        names=_occurrences(named, plans),
        inputs=_occurrences(vocabulary.task, inputs) if level == "task" else [],
        possible_pairs=_possible_pairs(vocabulary),
        pairs=[
            [split, len(found), len(found - pairs.get("train", set()))]
            for split, found in pairs.items()
        ],
        tags=[
            [f"`{tag}`", TAGS[tag], *counts] for (tag, *counts) in _counted(TAGS, tags) if any(tags)
        ],
        lengths=_lengths(level, splits),
        diverse_splits=list(figures),
        diversity=[
            [name, *(of_split[name] for of_split in figures.values())]
            for name in next(iter(figures.values()), {})
        ],
        near=leakage["method"]["near"],
        overlaps=[[item[key] for key in OVERLAP] for item in leakage["overlaps"]],
        baselines=[
            [
                item["split"],
                *(f"{100 * item[key]:.1f} %" for key in ("f1", "sequence", "plan")),
                item["similarity"],
            ]
            for item in leakage["baseline"]
        ],
        memory=[split for split, found in leakage["memory_test"].items() if found],
    )


def table(header: Sequence[Any], rows: Iterable[Sequence[Any]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(str(cell) for cell in line)} |\n" for line in lines)


def _counted(names: Iterable[str], found: Sequence[Sequence[str]]) -> Iterator[list[Any]]:
    """Each name with how often it was found in each split."""
    counts = [Counter(of_split) for of_split in found]
    for name in names:
        yield [name, *(count[name] for count in counts)]


def _occurrences(names: Iterable[str], found: Sequence[Sequence[str]]) -> list[list[Any]]:
    return [[f"`{name}`", *counts] for name, *counts in _counted(names, found)]


def _names(level: Level, records: Records) -> list[str]:
    """The task titles, or skill names, of the expected plans."""
    return [name for record in records for name in plan_names(level, record["expected"])]


def _pairs(level: Level, records: Records) -> Iterator[tuple[str, str]]:
    """Mission level: titles that follow each other. Task level: skills that run at the same time,
    in alphabetical order.
    """
    for record in records:
        if level == "mission":
            yield from itertools.pairwise(plan_names(level, record["expected"]))
            continue
        for step in record["expected"]["skill_sequence"]:
            names = sorted({str(skill["name"]) for _role, skill in step_skills(step)})
            yield from itertools.combinations(names, 2)


def _possible_pairs(vocabulary: Vocabulary) -> int:
    """Skill pairs that can run at the same time: navigation with others, and others among
    themselves.
    """
    alone = len(vocabulary.skills_in_role("navigation"))
    beside = len(vocabulary.skills) - alone
    return alone * beside + beside * (beside - 1) // 2


def _lengths(level: Level, splits: Splits) -> list[list[Any]]:
    """[measure, split, minimum, median, 90th percentile, maximum]."""
    measures: dict[str, Callable[[Mapping[str, Any]], int]] = {
        "words in the prompt": lambda record: len(words(record["prompt"])),
        f"{'tasks' if level == 'mission' else 'steps'} in the plan": lambda record: len(
            record["expected"][list_key(level)]
        ),
        "characters in the plan": lambda record: len(compact_json(record["expected"])),
    }
    return [
        [
            name,
            split,
            *map(round, np.percentile([measure(record) for record in records], QUANTILES)),
        ]
        for name, measure in measures.items()
        for split, records in splits.items()
        if records
    ]


def diversity(records: Records) -> dict[str, float]:
    """Families, phrasings (prompts without numbers and names), vocabulary size, type-token ratio
    and distinct-n of the prompts.

    distinct-n is the share of word n-grams that are different (Li et al. 2016); distinct-1 is the
    type-token ratio.
    """
    tokens = [words(str(record["prompt"])) for record in records]
    different = {word for text in tokens for word in text}
    figures: dict[str, float] = {
        "families": len({record.get("family") for record in records}),
        "phrasings": len({mask(str(record["prompt"])) for record in records}),
        "different words": len(different),
        "type-token ratio": round(len(different) / max(sum(map(len, tokens)), 1), 4),
    }
    for size in (2, 3):
        starts = ((text, start) for text in tokens for start in range(len(text) - size + 1))
        grams = [tuple(text[start : start + size]) for text, start in starts]
        figures[f"distinct-{size}"] = round(len(set(grams)) / max(len(grams), 1), 4)
    return figures
