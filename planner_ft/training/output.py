"""The output folder: its state, the record of an unfinished run, the finished adapter folder."""

from __future__ import annotations

import json
import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import torch

from planner_ft.candidates.adapters import CONFIG, MANIFEST, SEEN, WEIGHTS, adapter_record
from planner_ft.candidates.registry import model_metadata
from planner_ft.prompts import prompt_frame, save_tokenizer
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.resources import peak_memory
from planner_ft.support.templates import environment
from planner_ft.training.checkpoint import CHECKPOINTS, PREFIX, Run
from planner_ft.training.loop import means
from planner_ft.training.model import adapter_parameters
from planner_ft.training.report import GO_ON, LOG, TRACKED, plot_losses, read_log
from planner_ft.training.samples import tests_warnings

if TYPE_CHECKING:
    from planner_ft.training.preflight import Prepared
    from planner_ft.training.request import TrainRequest

Values = dict[str, Any]
FolderState = Literal["empty", "complete", "unfinished", "foreign"]

RUN = f"{CHECKPOINTS}/run.json"
TOKENIZER = (
    "tokenizer.json tokenizer_config.json special_tokens_map.json added_tokens.json"
    " chat_template.jinja vocab.json merges.txt generation_config.json"
)
WRITTEN = f"{CONFIG} {WEIGHTS} README.md {MANIFEST} {SEEN} {LOG} loss.png loss.svg {TOKENIZER}"
"""All files that a run writes; --overwrite removes them and the folders of checkpoints and logs."""
BEFORE = {"processes": 1}
"""What the records of earlier versions do not name."""
PROBLEMS = {
    "foreign": "exists and is no folder of a training run; give another folder",
    "complete": "holds a finished adapter; give --overwrite to train it again, or another folder",
    "unfinished": "holds an unfinished run; give --resume to continue it, --overwrite to start"
    " again, or another folder",
}


def folder_state(output: Path) -> FolderState:
    """Whether `output` holds a finished run, an unfinished one, nothing, or something else."""
    if not output.is_dir():
        return "foreign" if output.exists() else "empty"
    if (output / RUN).is_file():
        return "unfinished"
    if (output / MANIFEST).is_file():
        manifest = read_json(output / MANIFEST)
        trained = isinstance(manifest, dict) and manifest.get("kind") == "train"
        return "complete" if trained else "foreign"
    # A run that was killed while it began leaves no more than its folder of checkpoints.
    found = [path for path in output.rglob("*") if path.is_file()]
    begun = output / CHECKPOINTS
    own = all(path.parent == begun and path.name.startswith(".run.json.") for path in found)
    return "empty" if own else "foreign"


def folder_problem(output: Path, *, overwrite: bool, resume: bool) -> str | None:
    """The reason why a run may not use the folder, or None."""
    state = folder_state(output)
    if state == "empty" or (state != "foreign" and (overwrite or resume)):
        return None
    return f"--output {output}: {PROBLEMS[state]}"


def begin(output: Path, fingerprint: Values) -> None:
    """Record a new run, then remove an earlier one's files: a kill leaves what resumes."""
    for path in (output / CHECKPOINTS).glob(f"{PREFIX}*"):
        shutil.rmtree(path)
    write_run(output, fingerprint, "running")
    for name in WRITTEN.split():
        (output / name).unlink(missing_ok=True)
    shutil.rmtree(output / TRACKED, ignore_errors=True)


def write_run(output: Path, fingerprint: Values, status: str) -> None:
    """Record a run's fingerprint and status ("running", "interrupted", or the failure)."""
    write_json(output / RUN, {"status": status, **fingerprint})


def is_unfinished(output: Path, fingerprint: Values) -> bool:
    """Whether the run in `output` can be continued. Raises PlannerError when it was another one."""
    path = output / RUN if (output / RUN).is_file() else output / MANIFEST
    stored = read_json(path)
    if not isinstance(stored, dict):
        raise PlannerError(f"{path}: a JSON object is expected; start again with --overwrite")
    if found := differing(stored.get("fingerprint", stored), fingerprint):
        way = "undo that, or start again with --overwrite"
        raise PlannerError(
            f"--resume: the run in {output} was another one ({'; '.join(found)}); {way}"
        )
    return path.name != MANIFEST


def differing(stored: Values, current: Values) -> list[str]:
    """Sentences on everything that differs from the run that is to be resumed."""
    problems = []
    for key, now in current.items():
        before, name = stored.get(key, BEFORE.get(key)), key.replace("_", " ")
        if key == "settings" and isinstance(before, dict):
            problems += [
                f"--{setting.replace('_', '-')} was {before.get(setting)} and is {value}"
                for setting, value in now.items()
                if before.get(setting) != value
            ]
        elif before != now:
            short = f"{name} was {before} and is {now}"
            problems.append(short if len(str(now)) < 40 else f"the {name} changed since")
    return problems


def write_result(
    request: TrainRequest, prepared: Prepared, run: Run, fingerprint: Values
) -> Values:
    """Write the adapter folder and, last, its manifest, which is returned. Raises PlannerError when
    a file cannot be written; the checkpoints are then still there.
    """
    output, temporary = request.output, request.output / CHECKPOINTS / ".result"
    try:
        shutil.rmtree(temporary, ignore_errors=True)
        run.model.save_pretrained(temporary, save_embedding_layers=False)
        save_tokenizer(prepared.tokenizer, run.model, temporary)
        # safetensors makes files that only their owner may read; adapters are shared.
        (temporary / WEIGHTS).chmod((temporary / CONFIG).stat().st_mode)
        for path in sorted(temporary.iterdir()):
            path.replace(output / path.name)
        temporary.rmdir()
    except Exception as error:  # safetensors and tokenizers raise their own kinds for a full disk
        why = f"the adapter cannot be written ({error})"
        raise PlannerError(f"{output}: {why}; {GO_ON}") from error
    title = f"{request.candidate.row_name}, {request.level} level"
    plot_losses(read_log(output / LOG), output, title)
    seen = (digest for split in prepared.splits for digest in split.digests())
    write_text(output / SEEN, "".join(f"{digest}\n" for digest in seen))
    manifest = run_manifest(request, prepared, run, fingerprint)
    write_text(output / "README.md", model_card(manifest))
    write_json(output / MANIFEST, manifest)
    if request.settings.keep_checkpoints:
        (output / RUN).unlink(missing_ok=True)
    else:
        shutil.rmtree(output / CHECKPOINTS, ignore_errors=True)
    return manifest


def run_manifest(
    request: TrainRequest, prepared: Prepared, run: Run, fingerprint: Values
) -> Values:
    """The manifest of a finished run: its inputs, settings, outputs and result."""
    candidate, settings, output = request.candidate, request.settings, request.output
    both = {"training": prepared.train, "validation": prepared.validation}
    splits = {role: split for role, split in both.items() if split}
    inputs: dict[str, Path | str] = {role: split.path for role, split in splits.items()}
    if request.corrections:
        inputs["corrections"] = request.corrections
    files = [output / name for name in (WEIGHTS, CONFIG, SEEN, "tokenizer.json", LOG)]
    before, after = prompt_frame(
        request.level,
        prepared.tokenizer,
        request.vocabulary,
        with_vocabulary=request.settings.vocabulary_in_prompt,
    )
    return build_manifest(
        "train",
        seed=settings.seed,
        configuration={**settings.as_dict(), "origin": request.origin},
        inputs=inputs,
        outputs={path.name: sha256_file(path) for path in files if path.is_file()},
        **adapter_record(candidate, request.level, request.vocabulary),
        is_standin=candidate.is_standin,
        base_reference=candidate.reference,
        licence=candidate.licence,
        samples={role: len(split.samples) for role, split in splits.items()},
        processes=request.processes,
        departures=[*request.departures(), *tests_warnings(prepared.tests)],
        tests_trained_on=prepared.tests,
        result=_result(run, output / WEIGHTS),
        prompt={"before": before, "after": after},
        fingerprint=fingerprint,
    )


def _result(run: Run, adapter: Path) -> Values:
    """Length, speed, losses and memory of a finished run."""
    state, gpu = run.state, run.device.type == "cuda"
    judged, base, best = {}, state.base_answers, state.best_answers
    if run.judge and base and best:  # what training changed
        answers = {"n": len(best), "base": means(base), "adapter": means(best)}
        judged = {"validation_answers": answers, "change": run.judge.change(base, best)}
    return {
        "steps": state.step,
        "epochs": run.epoch,
        "tokens": state.tokens,
        "completion_tokens": state.completion_tokens,
        "seconds": round(state.seconds, 1),
        "tokens_per_s": round(state.tokens / state.seconds, 1) if state.seconds else None,
        "train_loss": state.loss,
        "validation_loss": state.best_loss,
        "best_epoch": state.best_epoch,
        "history": state.history,
        **judged,
        "peak_memory_bytes": peak_memory(run.device),
        "helped": run.ranks.divided,
        "device": torch.cuda.get_device_name(run.device) if gpu else str(run.device),
        "compute_dtype": str(run.dtype).removeprefix("torch."),
        "adapter_parameters": sum(one.numel() for one in adapter_parameters(run.model).values()),
        "adapter_bytes": adapter.stat().st_size,
    }


def model_card(manifest: Values) -> str:
    """README.md of the adapter that a training manifest describes, in the Hub's format."""
    from jinja2 import StrictUndefined

    own = {"undefined": StrictUndefined, "keep_trailing_newline": True}
    templates = environment("planner_ft.training", **own)
    templates.filters |= {"json": json.dumps, "name": lambda path: Path(path).name}
    values = {"s": manifest["configuration"], "r": manifest["result"]}
    metadata = model_metadata(manifest, "peft")
    return templates.get_template("card.md.j2").render(m=manifest, metadata=metadata, **values)
