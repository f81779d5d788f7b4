"""A training run from request to adapter folder."""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.loading import load_tokenizer
from planner_ft.candidates.location import weights_sha256
from planner_ft.support.errors import PlannerError
from planner_ft.training.loop import InterruptedRunError, train_loop
from planner_ft.training.output import (
    existing_result,
    fingerprint_problems,
    folder_state,
    stored_fingerprint,
    write_result,
    write_run,
)
from planner_ft.training.preflight import CHECKS, Finding, Prepared, run_preflight
from planner_ft.training.request import TrainRequest, listed
from planner_ft.training.samples import Sample, Split, read_split, render_split
from planner_ft.training.session import limited_threads, memory_errors, open_run, ready_model

if TYPE_CHECKING:
    from rich.console import Console


def preview_sample(request: TrainRequest, sample_id: str | None) -> tuple[Sample, Any]:
    """The sample of that id (or the first one) rendered as for training, and the tokenizer."""
    problems: list[str] = []
    split = read_split(request.train_file, request.level, request.vocabulary, problems)
    if split is None or problems:
        raise PlannerError(problems[0] if len(problems) == 1 else listed("the data has", problems))
    records = [record for record in split.records if sample_id in (None, record.id)][:1]
    if not records:
        raise PlannerError(
            f"--preview-id {sample_id}: {request.train_file} holds no record of that id"
        )
    tokenizer = load_tokenizer(request.candidate)
    one = Split(split.path, split.sha256, records)
    return render_split(one, request.level, tokenizer, request.vocabulary).samples[0], tokenizer


def train(request: TrainRequest, console: Console) -> dict[str, Any] | None:
    """Run the checks, train, write the adapter folder and return its manifest.

    None when --resume finds the run complete. Raises PlannerError for anything that the user can
    put right, and InterruptedRunError after Ctrl-C.
    """
    for text in request.resolved.departures(request.level):
        _say(console, f"note: {text}")
    prepared = Prepared()
    _preflight(request, prepared, console)
    assert prepared.train and prepared.tokenizer and prepared.device and request.candidate.folder
    fingerprint = request.fingerprint(
        prepared.train, prepared.validation, weights_sha256(request.candidate.folder)
    )
    if request.resume and not _resumable(request.output, fingerprint):
        _say(console, existing_result(request.output))
        return None
    splits = {"training": prepared.train}
    if prepared.validation:
        splits["validation"] = prepared.validation
    with limited_threads(request, prepared), memory_errors(request, prepared):
        with console.status("loading the model ..."):
            model, finding = ready_model(request, prepared)
        show_finding(console, CHECKS, finding)
        _raise_problems([finding])
        with open_run(request, prepared, model, console, fingerprint) as (run, state):
            try:
                train_loop(run, state)
                return write_result(request, run, state, prepared.tokenizer, splits, fingerprint)
            except (Exception, KeyboardInterrupt) as error:
                stopped = isinstance(error, InterruptedRunError)
                status = "interrupted" if stopped else f"failed: {error!r}"
                with contextlib.suppress(PlannerError):
                    write_run(request.output, fingerprint, status)
                raise


def _preflight(request: TrainRequest, prepared: Prepared, console: Console) -> None:
    findings = []
    with console.status("checking ..."):
        for number, finding in enumerate(run_preflight(request, prepared), 1):
            findings.append(finding)
            show_finding(console, number, finding)
    _raise_problems(findings)


def _raise_problems(findings: list[Finding]) -> None:
    problems = [problem for finding in findings for problem in finding.problems]
    if problems:
        raise PlannerError(listed("the preflight found", problems))


def show_finding(console: Console, number: int, finding: Finding) -> None:
    """One line on a check, and a line for each note."""
    number_of = len(finding.problems)
    count = f"{number_of} problem{'s' if number_of > 1 else ''}" if number_of else ""
    text = "; ".join(part for part in (count, finding.text) if part)
    mark = "✗" if number_of else "-" if finding.skipped else "✓"
    line = f"[{number}/{CHECKS}] {mark} {finding.title}: {text}"
    _say(console, line, "red" if number_of else None)
    for note in finding.notes:
        _say(console, f"      note: {note}", "yellow")


def _resumable(output: Path, fingerprint: dict[str, Any]) -> bool:
    """Whether a run is unfinished. Raises PlannerError when it was another one."""
    differences = fingerprint_problems(stored_fingerprint(output), fingerprint)
    if differences:
        raise PlannerError(
            f"--resume: the run in {output} was another one ({'; '.join(differences)}); undo that,"
            " or start again with --overwrite"
        )
    return folder_state(output) == "unfinished"


def _say(console: Console, text: str, style: str | None = None) -> None:
    console.print(text, markup=False, highlight=False, soft_wrap=True, style=style)
