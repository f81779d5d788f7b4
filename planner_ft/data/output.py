"""A data folder: its card, and writing all of it or nothing, never over other results unasked.

The card (card.md.j2) is a README.md in the Hugging Face form, so that `load_dataset(FOLDER)` finds
every split, with the figures that describe the set.
"""

import contextlib
import itertools
import json
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from planner_ft.data.labels import TAGS, tags_of
from planner_ft.data.leakage import mask
from planner_ft.facts import words
from planner_ft.support import files
from planner_ft.support.alone import alone, staging
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, sha256_file, sha256_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_names, step_skills

MANIFEST = "manifest.json"
Records = Sequence[Mapping[str, Any]]
Splits = Mapping[str, Records]
SIZES = ((1_000, "n<1K"), (10_000, "1K<n<10K"), (100_000, "10K<n<100K"), (1_000_000, "100K<n<1M"))
QUANTILES = (0, 50, 90, 100)
FAMILIES = 40


@dataclass
class Generated:
    """One set: its folder, records by split, seconds by stage and whether it is new; `texts` are
    its files by name, `manifest` what goes with them, without its outputs.

    Where `source` is the folder itself, its curated files are left alone as long as they say the
    same.
    """

    level: Level
    folder: Path
    source: Path | None
    counts: dict[str, int] = field(default_factory=dict)
    texts: dict[str, str] = field(default_factory=dict)
    manifest: dict[str, Any] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    written: bool = False

    @property
    def stale(self) -> list[str]:
        """Files of a former run's chat form, which this one does not make."""
        chats = (f"chat/{split}.jsonl" for split in self.counts)
        return [one for one in chats if one not in self.texts and (self.folder / one).exists()]


def write_sets(sets: Sequence[Generated], *, overwrite: bool) -> None:
    """Write the sets that are not up to date.

    Raises PlannerError, before anything is written, when a file exists that says something else and
    `overwrite` is not set.
    """
    pending = [_pending(made) for made in sets]
    for made, (_texts, replaced) in zip(sets, pending, strict=True):
        if replaced and not overwrite:
            raise PlannerError(
                f"{made.folder}: {replaced[0]} exists and is different; give another --out, or"
                " --overwrite to replace it"
            )
    for made, (texts, _replaced) in zip(sets, pending, strict=True):
        made.written = bool(texts)
        if texts:
            _write(made, texts)


def _pending(made: Generated) -> tuple[dict[str, str], list[str]]:
    """Texts to be written, and the names of those that replace others. Raises PlannerError where
    records of the curated source itself would be cut.
    """
    in_place = made.source is not None and made.source.resolve() == made.folder.resolve()
    texts, replaced = {}, []
    for name, text in made.texts.items():
        path = made.folder / name
        present = _present(path)
        records = in_place and "/" not in name and name.endswith(".jsonl")
        if present == text or (present and records and _canonical(present) == text):
            continue
        texts[name] = text
        if present is not None:
            replaced.append(name)
            if records and present.count("\n") > text.count("\n"):
                raise PlannerError(
                    f"{path} is the curated source and would be cut; give another --out"
                )
    replaced += made.stale
    if replaced or (not texts and _present(made.folder / MANIFEST) is None):
        texts.setdefault(MANIFEST, "")
    return texts, replaced


def _present(path: Path) -> str | None:
    try:
        return path.read_bytes().decode("utf-8-sig", "replace") if path.exists() else None
    except OSError as error:
        raise PlannerError(f"{path}: cannot be read ({error.strerror})") from None


def _canonical(text: str) -> str:
    """The records of a curated file without white space that means nothing."""
    return lines_of(compact_json(json.loads(line)) for line in text.split("\n") if line.strip())


def lines_of(lines: Iterable[str]) -> str:
    """A text of these lines."""
    return "".join(f"{line}\n" for line in lines)


def _write(made: Generated, texts: dict[str, str]) -> None:
    """Stage all files beside the target, then move them in: a full disk leaves it as it was."""
    names = [*(name for name in texts if name != MANIFEST), MANIFEST]
    digests = {
        name: sha256_text(text) if name in texts else sha256_file(made.folder / name)
        for name, text in made.texts.items()
    }
    with (
        files.writing(made.folder, "choose another --out"),
        alone(made.folder, "--out", "gen-data"),
        staging(made.folder) as staged,
    ):
        for name in names[:-1]:
            files.write_text(staged / name, texts[name])
        files.write_json(staged / MANIFEST, {**made.manifest, "outputs": digests})
        for name in made.stale:
            (made.folder / name).unlink()
        with contextlib.suppress(OSError):  # not there, or holds other files
            (made.folder / "chat").rmdir()
        for name in names:
            (made.folder / name).parent.mkdir(parents=True, exist_ok=True)
            (staged / name).replace(made.folder / name)


# ---------------------------------------------------------------- the card


def dataset_card(
    level: Level,
    splits: Splits,
    vocabulary: Vocabulary,
    leakage: Mapping[str, Any] | None,
    seed: int | None,
    labelling: str = "",
    *,
    command: str,
    chat: bool = False,
) -> str:
    """The card's text: front matter, counts, coverage, lengths, diversity, leakage. Without a
    leakage report it is that of synthetic missions; `command` is what makes the set; `chat` names
    the chat form, too.
    """
    import jinja2

    environment = jinja2.Environment(undefined=jinja2.StrictUndefined, keep_trailing_newline=True)
    template = environment.from_string(Path(__file__).with_name("card.md.j2").read_text("utf-8"))
    records = list(itertools.chain(*splits.values()))
    found = {split: _found(level, of_split) for split, of_split in splits.items()}
    return template.render(
        figures=lambda key, name: [of[key][name] for of in found.values()],
        level=level,
        labelling=labelling,
        vocabulary=vocabulary,
        command=command,
        chat=chat,
        seed=seed,
        size=next((name for limit, name in SIZES if len(records) < limit), "n>1M"),
        splits=splits,
        found=found,
        tags=tags_of(vocabulary) if any(of["tags"] for of in found.values()) else [],
        rules=TAGS,
        lengths=_lengths(level, splits),
        diversity={split: diversity(of) for split, of in splits.items() if of},
        leakage=leakage,
        families=Counter(record["family"] for record in records).most_common(FAMILIES),
    )


def _found(level: Level, records: Records) -> dict[str, Counter[Any]]:
    """How often names, tasks of the input, tags and pairs (`_pairs`) occur."""
    return {
        "names": Counter(itertools.chain(*(plan_names(level, one["expected"]) for one in records))),
        "inputs": Counter(record["task"] for record in records if "task" in record),
        "tags": Counter(tag for record in records for tag in record.get("tags", ())),
        "pairs": Counter(_pairs(level, records)),
    }


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
    entries = "tasks" if level == "mission" else "steps"
    measures: dict[str, Callable[[Mapping[str, Any]], int]] = {
        "words in the prompt": lambda record: len(words(record["prompt"])),
        f"{entries} in the plan": lambda record: len(record["expected"][list_key(level)]),
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
