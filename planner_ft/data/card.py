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
from planner_ft.data.tags import TAGS, tags_of
from planner_ft.facts import words
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

Records = Sequence[Mapping[str, Any]]
Splits = Mapping[str, Records]
SIZES = ((1_000, "n<1K"), (10_000, "1K<n<10K"), (100_000, "10K<n<100K"), (1_000_000, "100K<n<1M"))
SCORES = ("f1", "sequence", "plan")
QUANTILES = (0, 50, 90, 100)
FAMILIES = 40
OVERLAP = ("split", "other", "exact", "near", "exact_masked", "near_masked", "families")


def dataset_card(
    level: Level,
    splits: Splits,
    vocabulary: Vocabulary,
    leakage: Mapping[str, Any] | None,
    seed: int | None,
    labelling: str = "",
    *,
    chat: bool = False,
) -> str:
    """The card's text: front matter, counts, coverage, lengths, diversity, leakage. Without a
    leakage report it is that of synthetic missions; `chat` names the chat form, too.
    """
    import jinja2

    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined, keep_trailing_newline=True, autoescape=False
    )
    template = environment.from_string(Path(__file__).with_name("card.md.j2").read_text("utf-8"))
    total = sum(map(len, splits.values()))
    every = {
        split: {
            "names": [name for record in records for name in plan_names(level, record["expected"])],
            "inputs": [record["task"] for record in records if "task" in record],
            "tags": [tag for record in records for tag in record.get("tags", ())],
            "pairs": [*dict.fromkeys(_pairs(level, records))],
        }
        for split, records in splits.items()
    }

    def counts(names: Iterable[str], of: str) -> list[list[Any]]:
        """Each name with how often it was found in each split."""
        found = [Counter(figures[of]) for figures in every.values()]
        return [[f"`{name}`", *(counter[name] for counter in found)] for name in names]

    known = set(every.get("train", {}).get("pairs", ()))
    figures = {split: diversity(records) for split, records in splits.items() if records}
    leaks = leakage or {"baseline": [], "overlaps": []}
    tagged = leakage and any(of_split["tags"] for of_split in every.values())
    alone = len(vocabulary.skills_in_role("navigation"))
    beside = len(vocabulary.skills) - alone
    return template.render(
        table=table,
        level=level,
        labelling=labelling,
        vocabulary=vocabulary,
        configs={"default": "", **({"chat": "chat/"} if chat else {})},
        seed=seed,
        size=next((name for limit, name in SIZES if total < limit), "n>1M"),
        splits=list(splits),
        counts=[[split, len(records)] for split, records in splits.items()],
        names=counts(vocabulary.task if level == "mission" else vocabulary.skill, "names"),
        inputs=counts(vocabulary.task, "inputs") if level == "task" else [],
        # Skills that can run at the same time: navigation with others, and others.
        possible_pairs=alone * beside + beside * (beside - 1) // 2,
        pairs=[
            [split, len(one["pairs"]), len({*one["pairs"]} - known)] for split, one in every.items()
        ],
        tags=[
            [tag, TAGS[tag[1:-1]], *found]
            for tag, *found in (counts(tags_of(vocabulary), "tags") if tagged else ())
        ],
        lengths=_lengths(level, splits),
        diverse_splits=list(figures),
        diversity=[
            [name, *(of_split[name] for of_split in figures.values())]
            for name in next(iter(figures.values()), {})
        ],
        leakage=leakage,
        overlaps=[[one[key] for key in OVERLAP] for one in leaks["overlaps"]],
        baselines=[
            [one["split"], *(f"{100 * one[key]:.1f} %" for key in SCORES), one["similarity"]]
            for one in leaks["baseline"]
        ],
        families=Counter(
            record["family"] for records in splits.values() for record in records
        ).most_common(FAMILIES),
    )


def table(header: Sequence[Any], rows: Iterable[Sequence[Any]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(str(cell) for cell in line)} |\n" for line in lines)


def _pairs(level: Level, records: Records) -> Iterator[tuple[str, str]]:
    """Titles that follow each other; at task level skills that run at the same time, sorted."""
    for record in records:
        if level == "mission":
            yield from itertools.pairwise(plan_names(level, record["expected"]))
            continue
        for step in record["expected"]["skill_sequence"]:
            names = sorted({str(skill["name"]) for _role, skill in step_skills(step)})
            yield from itertools.combinations(names, 2)


def _lengths(level: Level, splits: Splits) -> Iterator[list[Any]]:
    """[measure, split, minimum, median, 90th percentile, maximum]."""
    measures: dict[str, Callable[[Mapping[str, Any]], int]] = {
        "words in the prompt": lambda record: len(words(record["prompt"])),
        f"{'tasks' if level == 'mission' else 'steps'} in the plan": lambda record: len(
            record["expected"][list_key(level)]
        ),
        "characters in the plan": lambda record: len(compact_json(record["expected"])),
    }
    for name, measure in measures.items():
        for split, records in splits.items():
            if records:
                found = np.percentile([measure(record) for record in records], QUANTILES)
                yield [name, split, *map(round, found)]


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
