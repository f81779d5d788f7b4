"""Training samples from reviewed plans: the command with the plan that a person corrected and
approved.

Only what the labelling rules allow becomes a sample, and nothing that validation, test or challenge
holds already; everything else is left out with the reason.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.data.completeness import completeness_problems
from planner_ft.data.leakage import near_duplicate
from planner_ft.data.lexicon import is_known
from planner_ft.data.mission.source import find_source
from planner_ft.data.stated import states_position
from planner_ft.data.validation import canonical_record, record_problems
from planner_ft.data.words import says
from planner_ft.decoding.constraints.facts import read
from planner_ft.decoding.constraints.grounded import TOO_LONG
from planner_ft.document import PlanDocument, read_document
from planner_ft.document.differences import compare
from planner_ft.document.files import vocabulary_of
from planner_ft.planning.agents import CUT_NOTE
from planner_ft.planning.planner import new_file
from planner_ft.review.log import existing_log, log_beside
from planner_ft.review.verify import Approval, approval_of
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl, sha256_text, write_text
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import TASK_KEYS

HELD_OUT = ("validation", "test", "challenge")
"""Files of the curated set that no sample may come near to."""
LOCATED = "located"

HeldOut = dict[str, list[dict[str, Any]]]
"""Records by the name of their file."""


class LeftOutError(PlannerError):
    """Why a plan gives no sample."""


@dataclass(frozen=True)
class Harvest:
    """Samples by the plan that each is from, why the other plans gave none, and where the samples
    were written.
    """

    samples: dict[Path, dict[str, Any]]
    left_out: dict[Path, str]
    out: Path

    def lines(self) -> Iterator[str]:
        """What came of each plan, for people."""
        for path, sample in self.samples.items():
            yield f"{path}: {sample['id']}: {'; '.join(sample['provenance']['corrected'])}"
        yield from (f"{path}: left out: {reason}" for path, reason in self.left_out.items())
        count = len(self.samples)
        yield (
            f"{self.out}: {count} sample{'s' if count > 1 else ''}; train with plannerft train"
            f" --level mission --corrections {self.out}"
        )


def harvest_files(
    plans: Sequence[Path],
    log: Path | None,
    out: Path | None,
    *,
    overwrite: bool = False,
    vocabulary: str | None = None,
) -> Harvest:
    """Write the samples of the plans to `out`; `log` is by default that beside each plan.

    Raises PlannerError without plans or `out`, for a file that is there already, a broken log, and
    where no plan gives a sample.
    """
    if not plans or out is None:
        raise PlannerError(
            "--harvest needs plans and --out, such as plannerft review --harvest plan.json --out"
            " corrections.jsonl"
        )
    new_file(out, overwrite=overwrite)
    known = load_vocabulary(vocabulary) if vocabulary else None
    held_out, found, left_out = (
        held_out_records(),
        dict[Path, tuple[dict[str, Any], Vocabulary]](),
        dict[Path, str](),
    )
    for path in plans:
        try:
            document = read_document(path, known)
            definition = known or vocabulary_of(document, path)
            found[path] = (
                _sample_of(
                    document, existing_log(log) if log else log_beside(path), held_out, definition
                ),
                definition,
            )
        except LeftOutError as error:
            left_out[path] = str(error)
    _leave_out_older(found, left_out)
    if not found:
        reasons = "; ".join(f"{path}: {reason}" for path, reason in left_out.items())
        raise PlannerError(f"no plan gives a sample ({reasons}); correct and approve one first")
    write_text(
        out,
        "".join(
            f"{canonical_record('mission', sample, definition)}\n"
            for sample, definition in found.values()
        ),
    )
    return Harvest({path: sample for path, (sample, _definition) in found.items()}, left_out, out)


def held_out_records() -> HeldOut:
    """The curated records that no sample may come near to. Raises PlannerError where the curated
    set is not there.
    """
    folder = find_source()
    return {
        name: read_jsonl(folder / f"{name}.jsonl")
        for name in HELD_OUT
        if (folder / f"{name}.jsonl").is_file()
    }


def _sample_of(
    document: PlanDocument, log: Path, held_out: HeldOut, vocabulary: Vocabulary
) -> dict[str, Any]:
    approval = approval_of(document, log)
    if approval.status != "approved":
        raise LeftOutError(approval.text)
    return sample(document, approval, held_out, vocabulary)


def sample(
    document: PlanDocument, approval: Approval, held_out: HeldOut, vocabulary: Vocabulary
) -> dict[str, Any]:
    """The mission sample of an approved document. Raises LeftOutError that says why there is
    none.
    """
    reviewed, proposed = (
        _commanded(plan["tasks"], document["command"], vocabulary)
        for plan in (document, document["proposed"])
    )
    corrected = [
        found.text
        for found in compare({"tasks": proposed, LOCATED: {}}, {"tasks": reviewed, LOCATED: {}})
        if found.kind != "skills"
    ]
    if not corrected:
        raise LeftOutError(
            "the tasks are as the model proposed them, so there is nothing to learn from"
        )
    provenance = {key: getattr(approval, key) for key in ("digest", "sequence", "reviewer", "time")}
    record = {
        "id": f"harvest-{approval.digest[:16]}",
        "family": f"harvest-{sha256_text(document['command'])[:16]}",
        "prompt": document["command"],
        "expected": _expected(document, reviewed, vocabulary),
        "provenance": {**provenance, "corrected": corrected},
    }
    problems = record_problems("mission", record, vocabulary) or list(
        completeness_problems("mission", record, vocabulary)
    )
    problems = problems or list(text_problems(record, _texts_of(proposed)))
    if problems:
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise LeftOutError(f"it breaks a labelling rule: {problems[0]}{more}")
    for name, records in held_out.items():
        if (near := near_duplicate(document["command"], records)) is not None:
            raise LeftOutError(
                f"the command is a near duplicate of {near} in the {name} set, which nothing is"
                " trained on"
            )
    return record


def text_problems(record: dict[str, Any], proposed: Sequence[str]) -> Iterator[str]:
    """Texts of a sample that speak of what is not in it: of a text value that was `proposed` and
    taken out, or in words that nobody knows.

    A reviewer reads values before sentences, and a small model misspells names in sentences that it
    spelt rightly in a value.
    """
    expected = record["expected"]
    values = _texts_of(expected["tasks"])
    said = " ".join([record["prompt"], *values])
    # What the command itself names may be spoken of, unless it is a part of another name.
    gone = [
        name
        for name in dict.fromkeys(proposed)
        if name not in values
        and (name not in record["prompt"] or any(name in value for value in values))
    ]
    for text in [
        *(task["task_prompt"] for task in expected["tasks"]),
        *expected["assumptions"],
        *expected["constraints"],
    ]:
        unknown = [
            word
            for word in says(said, text, misspelt=False)
            if len(word) > 1 and not all(map(is_known, re.findall(r"[^\W\d_]+", word)))
        ]
        if unknown:
            yield f"{text!r} has a word that neither the command nor the lexicon has: {unknown[0]}"
        # A value that stays may have the other one's words in it.
        rest = functools.reduce(
            lambda left, value: left.replace(value, ""), sorted(values, key=len, reverse=True), text
        )
        yield from (
            f"{text!r} speaks of {name!r}, which was taken out" for name in gone if name in rest
        )


def _texts_of(tasks: Sequence[dict[str, Any]]) -> list[str]:
    """The text values of tasks."""
    values = [value for task in tasks for value in task["parameters"].values()]
    return [
        text
        for value in values
        for text in (value if isinstance(value, list) else [value])
        if isinstance(text, str)
    ]


def _commanded(
    tasks: Sequence[dict[str, Any]], command: str, vocabulary: Vocabulary
) -> list[dict[str, Any]]:
    """The tasks as the command alone gives them: places that only the operator knew are open
    again.
    """
    return [{**task, "parameters": _said(task, command, vocabulary)} for task in tasks]


def _said(task: dict[str, Any], command: str, vocabulary: Vocabulary) -> dict[str, Any]:
    unsaid = [
        name
        for name in task.get(LOCATED, {})
        if not states_position(command, task["parameters"][name])
    ]
    return {**task["parameters"], **{name: list(vocabulary.unresolved) for name in unsaid}}


def _expected(
    document: PlanDocument, tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary
) -> dict[str, Any]:
    """The mission plan. Assumptions are the model's; what the decoding noted about its own reading
    of the command is none.
    """
    notes = {*read(document["command"], vocabulary).notes, TOO_LONG}
    return {
        "tasks": [{key: task[key] for key in TASK_KEYS} for task in tasks],
        "assumptions": [
            text
            for text in dict.fromkeys(document["assumptions"])
            if text not in notes and not text.startswith(CUT_NOTE)
        ],
        "constraints": list(dict.fromkeys(document["constraints"])),
    }


def _leave_out_older(
    found: dict[Path, tuple[dict[str, Any], Vocabulary]], left_out: dict[Path, str]
) -> None:
    """Keep one sample of a command: that of the last approval."""
    last: dict[str, Path] = {}
    for path in sorted(
        found,
        key=lambda path: (
            found[path][0]["provenance"]["time"],
            found[path][0]["provenance"]["sequence"],
        ),
    ):
        prompt = found[path][0]["prompt"]
        if prompt in last:
            left_out[last[prompt]] = f"a plan of the same command was approved later: {path}"
            del found[last[prompt]]
        last[prompt] = path
