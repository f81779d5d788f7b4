"""Training samples from plans that a person corrected and approved.

A sample obeys the labelling rules and is no near duplicate of validation, test or challenge.
"""

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from operator import itemgetter
from pathlib import Path
from typing import Any

from planner_ft.data.curated import find_source
from planner_ft.data.labels import completeness_problems
from planner_ft.data.leakage import near_duplicate
from planner_ft.data.validation import canonical_record, record_problems
from planner_ft.decoding.constraints import RAN_ON, TOO_LONG, UNPAIRED
from planner_ft.document import PlanDocument
from planner_ft.document.edits import compare
from planner_ft.facts import WAYPOINT, is_known, missing_words, read, read_input
from planner_ft.planning.agents import CUT_NOTE
from planner_ft.planning.frame import frame_of
from planner_ft.planning.planner import new_file
from planner_ft.review.approval import Approval, approval_of
from planner_ft.review.desk import read_plan
from planner_ft.review.log import existing_log, log_beside
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl, sha256_text, write_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import TASK_KEYS

HELD_OUT = ("validation", "test", "challenge")
"""Files of the curated set that no sample may come near to."""
PROVENANCE = ("digest", "sequence", "reviewer", "time")

HeldOut = dict[str, list[dict[str, Any]]]
"""Records by the name of their file."""


class LeftOutError(PlannerError):
    """The reason why a plan gives no sample."""


@dataclass(frozen=True)
class Harvest:
    """Samples by plan, the reasons why other plans gave none, and the file of the samples."""

    samples: dict[Path, dict[str, Any]]
    left_out: dict[Path, str]
    out: Path

    def lines(self) -> Iterator[str]:
        """The result for each plan, for people."""
        for path, sample in self.samples.items():
            yield f"{path}: {sample['id']}: {'; '.join(sample['provenance']['corrected'])}"
        yield from (f"{path}: left out: {reason}" for path, reason in self.left_out.items())
        count = f"{len(self.samples)} sample{'s' if len(self.samples) > 1 else ''}"
        train = f"plannerft train --level mission --corrections {self.out}"
        yield f"{self.out}: {count}; train with {train}"


def harvest_files(
    plans: Sequence[Path],
    log: Path | None,
    out: Path | None,
    *,
    overwrite: bool = False,
    vocabulary: str | None = None,
) -> Harvest:
    """Write the samples of the plans to `out`; of several plans of one command the last counts.

    Raises PlannerError without plans or `out`, for an existing file, a broken log, and no sample.
    """
    if not plans or out is None:
        example = "plannerft review --harvest plan.json --out corrections.jsonl"
        raise PlannerError(f"--harvest needs plans and --out, such as {example}")
    new_file(out, overwrite=overwrite)
    samples, lines, left_out = dict[Path, dict[str, Any]](), dict[Path, str](), dict[Path, str]()
    for path in plans:
        document, known = read_plan(path, vocabulary)
        approval = approval_of(document, existing_log(log) if log else log_beside(path))
        try:
            samples[path] = sample(document, approval, held_out_records(known), known)
            lines[path] = canonical_record("mission", samples[path], known)
        except LeftOutError as error:
            left_out[path] = str(error)
    when = itemgetter("time", "sequence")
    ordered = sorted(samples, key=lambda path: when(samples[path]["provenance"]))
    latest = {samples[path]["prompt"]: path for path in ordered}
    for path in [path for path in samples if latest[samples[path]["prompt"]] != path]:
        later = latest[samples.pop(path)["prompt"]]
        left_out[path] = f"a plan of the same command was approved later: {later}"
    if not samples:
        reasons = "; ".join(f"{path}: {reason}" for path, reason in left_out.items())
        raise PlannerError(f"no plan gives a sample ({reasons}); correct and approve one first")
    write_text(out, "".join(f"{lines[path]}\n" for path in samples))
    return Harvest(samples, left_out, out)


def held_out_records(vocabulary: Vocabulary) -> HeldOut:
    """The curated records that no sample may come near to; an own vehicle may have none. Raises
    PlannerError for a bundled vehicle without its set.
    """
    own = vocabulary.data / "mission"
    folder = find_source(None, vocabulary) if vocabulary.bundled else own
    files = [folder / f"{name}.jsonl" for name in HELD_OUT]
    return {file.stem: read_jsonl(file) for file in files if file.is_file()}


def sample(
    document: PlanDocument, approval: Approval, held_out: HeldOut, vocabulary: Vocabulary
) -> dict[str, Any]:
    """The mission sample of an approved document. Raises LeftOutError with the reason for none."""
    if approval.status != "approved":
        raise LeftOutError(approval.text)
    command = frame_of(document).spoken
    reviewed, proposed = (
        [_as_commanded(task, command, vocabulary) for task in plan["tasks"]]
        for plan in (document, document["proposed"])
    )
    found = compare({"tasks": proposed, "located": {}}, {"tasks": reviewed, "located": {}})
    corrected = [difference.text for difference in found if difference.kind != "skills"]
    if not corrected:
        problem = "the tasks are as the model proposed them"
        raise LeftOutError(f"{problem}, so there is nothing to learn from")
    provenance = {key: getattr(approval, key) for key in PROVENANCE}
    record = {
        "id": f"harvest-{approval.digest[:16]}",
        "family": f"harvest-{sha256_text(command)[:16]}",
        "prompt": command,
        "expected": _expected(document, reviewed, vocabulary),
        "provenance": {**provenance, "corrected": corrected},
    }
    problems = (
        record_problems("mission", record, vocabulary)
        or list(completeness_problems(record, vocabulary))
        or list(text_problems(record, _texts_of(proposed)))
    )
    if problems:
        more = f" (and {len(problems) - 1} more)" if len(problems) > 1 else ""
        raise LeftOutError(f"it breaks a labelling rule: {problems[0]}{more}")
    for name, records in held_out.items():
        if (near := near_duplicate(command, records)) is not None:
            problem = f"the command is a near duplicate of {near} in the {name} set"
            raise LeftOutError(f"{problem}, which nothing is trained on")
    return record


def text_problems(record: dict[str, Any], proposed: Sequence[str]) -> Iterator[str]:
    """Texts that speak of a text value that was `proposed` and taken out, or in unknown words.

    A small model misspells names in sentences that it spelt rightly in a value.
    """
    expected, prompt = record["expected"], record["prompt"]
    values = sorted(_texts_of(expected["tasks"]), key=len, reverse=True)
    known = " ".join([prompt, *values])
    # The command's own names may be spoken of, unless one is a part of another name.
    removed = [name for name in dict.fromkeys(proposed) if name not in values]
    gone = [name for name in removed if name not in prompt or any(name in one for one in values)]
    prompts = [task["task_prompt"] for task in expected["tasks"]]
    for text in [*prompts, *expected["assumptions"], *expected["constraints"]]:
        words = [word for word in missing_words(known, text, misspelt=False) if len(word) > 1]
        for word in words:
            if not all(map(is_known, re.findall(r"[^\W\d_]+", word))):
                yield f"{text!r} has a word that neither the command nor the lexicon has: {word}"
                break
        rest = text
        for value in values:  # a value that stays may have the other one's words in it
            rest = rest.replace(value, "")
        found = [name for name in gone if name in rest]
        yield from (f"{text!r} speaks of {name!r}, which was taken out" for name in found)


def _texts_of(tasks: Sequence[dict[str, Any]]) -> list[str]:
    """The text values of tasks."""
    values = [value for task in tasks for value in task["parameters"].values()]
    lists = [value if isinstance(value, list) else [value] for value in values]
    return [text for items in lists for text in items if isinstance(text, str)]


def _as_commanded(task: dict[str, Any], command: str, vocabulary: Vocabulary) -> dict[str, Any]:
    """The task as the command alone gives it: the operator's places open, no vehicle's values."""
    own = task.get("defaults", {})
    given = task["parameters"].items()
    parameters = {name: value for name, value in given if (name, value) not in own.items()}
    source = read_input({"prompt": command}, vocabulary)
    for name in task.get("located", {}):
        if not source.stated(parameters[name], WAYPOINT).given:
            parameters[name] = list(vocabulary.unresolved)
    return {**task, "parameters": parameters}


def _expected(
    document: PlanDocument, tasks: Sequence[dict[str, Any]], vocabulary: Vocabulary
) -> dict[str, Any]:
    """The mission plan with the model's assumptions, without the notes of the decoding."""
    notes = {*read(document["command"]).unread, TOO_LONG, UNPAIRED, RAN_ON}
    assumptions = [
        text
        for text in dict.fromkeys(document["assumptions"])
        if text not in notes and not text.startswith(CUT_NOTE)
    ]
    return {
        "tasks": [{key: task[key] for key in TASK_KEYS} for task in tasks],
        "assumptions": assumptions,
        "constraints": list(dict.fromkeys(document["constraints"])),
    }
