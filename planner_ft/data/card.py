"""The dataset card: README.md in the Hugging Face form, so that `load_dataset(FOLDER)` finds every
split.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from planner_ft.data.statistics import (
    Splits,
    diversity,
    input_tasks,
    length_rows,
    name_counts,
    pair_counts,
    possible_pairs,
)
from planner_ft.data.tags import TAGS
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

SIZES = ((1_000, "n<1K"), (10_000, "1K<n<10K"), (100_000, "10K<n<100K"), (1_000_000, "100K<n<1M"))
RECORDS: dict[Level, str] = {
    "mission": (
        "`prompt` is an operator's command, `expected` the mission plan: tasks in the order of"
        " execution with parameters and task prompt, assumptions and constraints. `family` names"
        " the phrasing family, `spans` mark the ontology elements in the command, `tags` the"
        " labelling rules that it exercises."
    ),
    "task": (
        "`task`, `parameters` and `prompt` (the task prompt) are the input, `expected` is the skill"
        " sequence: steps of one navigation skill with the filter and perception skills that run"
        " beside it. `family` names the phrasing family."
    ),
}
ORIGIN: dict[Level, str] = {
    "mission": (
        "The commands were written one by one, not from templates, in the voice of people who send"
        " vehicles out. Phrasing families do not cross splits."
    ),
    "task": (
        "The records are sampled by a program from the vocabulary; waypoints are computed from the"
        " parameters. `train`, `validation` and `test` share phrasing families, but no phrasing;"
        " the families of `test_unseen` occur in no other split."
    ),
}


def dataset_card(
    level: Level,
    splits: Splits,
    vocabulary: Vocabulary,
    leakage: Mapping[str, Any],
    seed: int | None,
) -> str:
    """The card's text: front matter, counts, coverage, lengths, diversity, leakage."""
    sections = [
        _front_matter(level, splits, vocabulary),
        _introduction(level, splits, vocabulary, seed),
        _coverage(level, splits, vocabulary),
        "## Lengths\n\n"
        + table(
            ["", "split", "min", "median", "90 %", "max"],
            [[what, split, *values] for what, split, values in length_rows(level, splits)],
        ),
        _diversity(splits),
        _leakage(leakage),
    ]
    return "\n".join(sections)


def table(header: Sequence[Any], rows: Iterable[Sequence[Any]]) -> str:
    """A Markdown table."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join(f"| {' | '.join(str(cell) for cell in line)} |\n" for line in lines)


def _front_matter(level: Level, splits: Splits, vocabulary: Vocabulary) -> str:
    total = sum(map(len, splits.values()))
    size = next((name for limit, name in SIZES if total < limit), "n>1M")
    files = "".join(f"  - split: {split}\n    path: {split}.jsonl\n" for split in splits)
    return (
        f"---\npretty_name: {vocabulary.title.capitalize()} {level} plans\nlanguage:\n-"
        " en\nlicense: apache-2.0\ntask_categories:\n- text-generation\ntags:\n- planning\n-"
        f" structured-output\n- robotics\nsize_categories:\n- {size}\nconfigs:\n- config_name:"
        f" default\n  data_files:\n{files}---\n"
    )


def _introduction(level: Level, splits: Splits, vocabulary: Vocabulary, seed: int | None) -> str:
    files = ", ".join(f'"{split}": "{split}.jsonl"' for split in splits)
    made = f"`plannerft gen-data --level {level}`" + (
        f" with seed {seed}" if seed is not None else ""
    )
    counts = table(
        ["split", "records"], [[split, len(records)] for split, records in splits.items()]
    )
    return (
        f"# {level.capitalize()} plans of the {vocabulary.title}\n\nWritten by {made};"
        " manifest.json has the SHA-256 of every file, "
        "leakage.json the full leakage report.\n\n"
        f"{counts}\n{RECORDS[level]}\n\n{ORIGIN[level]}\n\nPositions are in the {vocabulary.frame};"
        f" home is `{list(vocabulary.home)}`, and "
        f"`{list(vocabulary.unresolved)}` stands for a place that is not known yet.\n\n"
        '```python\nfrom datasets import load_dataset\n\ndata = load_dataset(\n    "json",\n'
        f"    data_files={{{files}}},\n)\n```\n"
    )


def _coverage(level: Level, splits: Splits, vocabulary: Vocabulary) -> str:
    counts = {split: name_counts(level, records) for split, records in splits.items()}
    names = (
        [task.title for task in vocabulary.tasks]
        if level == "mission"
        else [skill.name for skill in vocabulary.skills]
    )
    text = (
        f"## Coverage\n\nOccurrences of each {'task' if level == 'mission' else 'skill'} in the"
        " expected plans.\n\n"
    )
    text += table(
        ["", *splits],
        [[f"`{name}`", *(found[name] for found in counts.values())] for name in names],
    )
    if level == "task":
        inputs = {split: input_tasks(records) for split, records in splits.items()}
        rows = [
            [f"`{task.title}`", *(found[task.title] for found in inputs.values())]
            for task in vocabulary.tasks
        ]
        text += "\nRecords of each task.\n\n" + table(["", *splits], rows)
    text += "\n" + _pairs(level, splits, vocabulary)
    tagged = {
        split: [tag for record in records for tag in record.get("tags", ())]
        for split, records in splits.items()
    }
    if any(tagged.values()):
        rows = [
            [f"`{tag}`", meaning, *(found.count(tag) for found in tagged.values())]
            for tag, meaning in TAGS.items()
        ]
        text += "\nLabelling rules, by tag.\n\n" + table(["tag", "rule", *splits], rows)
    return text


def _pairs(level: Level, splits: Splits, vocabulary: Vocabulary) -> str:
    found = {split: pair_counts(level, records) for split, records in splits.items()}
    if level == "mission":
        what, possible = "Pairs of tasks that follow each other", ""
    else:
        what, possible = (
            "Pairs of skills that run at the same time",
            f" of {possible_pairs(vocabulary)} possible ones",
        )
    train = set(found.get("train", ()))
    rows = [
        [split, len(counts), sum(pair not in train for pair in counts)]
        for split, counts in found.items()
    ]
    return (
        f"{what}: different ones{possible}, and those that the training split does not have.\n\n"
        + table(["split", "pairs", "not in train"], rows)
    )


def _diversity(splits: Splits) -> str:
    figures: dict[str, dict[str, float]] = {
        split: diversity(records) for split, records in splits.items() if records
    }
    rows = [
        [name, *(of_split[name] for of_split in figures.values())]
        for name in next(iter(figures.values()), {})
    ]
    legend = (
        "A phrasing is a prompt with its numbers and names masked. distinct-n is the share of word"
        " n-grams that are different."
    )
    return f"## Diversity\n\n{legend}\n\n{table(['', *figures], rows)}"


def _leakage(leakage: Mapping[str, Any]) -> str:
    overlaps = [
        [
            item[key]
            for key in (
                "split",
                "other",
                "exact",
                "near",
                "exact_masked",
                "near_masked",
                "families",
            )
        ]
        for item in leakage["overlaps"]
    ]
    baselines = [
        [
            item["split"],
            *(f"{100 * item[key]:.1f} %" for key in ("f1", "sequence", "plan")),
            item["similarity"],
        ]
        for item in leakage["baseline"]
    ]
    memory = [split for split, found in leakage["memory_test"].items() if found]
    verdict = f"A memory test: {', '.join(memory)}." if memory else "No split is a memory test."
    return (
        "## Leakage\n\nPrompts that occur, exactly or nearly (Jaccard similarity of word pairs at"
        f" least {leakage['method']['near']}), in another split; masked: with numbers and names"
        " replaced.\n\n"
        + table(
            ["split", "in", "exact", "near", "exact, masked", "near, masked", "shared families"],
            overlaps,
        )
        + "\nWhat the expected plan of the most similar training prompt scores: mean F1 of the name"
        " sets, share of exact name sequences, share of exact plans; median similarity of that"
        " prompt.\n\n"
        + table(["split", "F1", "sequence", "plan", "similarity"], baselines)
        + f"\n{verdict}\n"
    )
