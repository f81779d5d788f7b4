"""The output folder: its state, the record of an unfinished run, the finished adapter folder."""

from __future__ import annotations

import contextlib
import json
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import torch
from filelock import FileLock, Timeout

from planner_ft.candidates.adapters import CONFIG, MANIFEST, WEIGHTS, adapter_record
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    nearest_folder,
    read_json,
    read_text,
    sha256_file,
    write_json,
    write_text,
)
from planner_ft.support.manifest import build_manifest
from planner_ft.support.resources import peak_memory
from planner_ft.training.model import adapter_parameters
from planner_ft.training.report import LOG, plot_losses, read_log

if TYPE_CHECKING:
    from planner_ft.training.checkpoint import TrainState
    from planner_ft.training.loop import Run
    from planner_ft.training.preflight import Prepared
    from planner_ft.training.request import TrainRequest

Values = dict[str, Any]
FolderState = Literal["empty", "complete", "unfinished", "foreign"]

CHECKPOINTS, LOCK = "checkpoints", ".train.lock"
RUN = f"{CHECKPOINTS}/run.json"
TOKENIZER = (
    "tokenizer.json tokenizer_config.json special_tokens_map.json added_tokens.json"
    " chat_template.jinja vocab.json merges.txt"
)
WRITTEN = f"{CONFIG} {WEIGHTS} README.md {MANIFEST} {LOG} loss.png loss.svg {TOKENIZER}"
"""All files that a run writes; --overwrite removes them and the folders of checkpoints and logs."""
LICENCES = {"Apache-2.0": "apache-2.0"}
"""Licences with an identifier of the Hub; model cards name others in full."""
CARD = Path(__file__).parent / "card.md.jinja"
PROBLEMS = {
    "foreign": "exists and is no folder of a training run; give another folder",
    "complete": "holds a finished adapter; give --overwrite to train it again, or another folder",
    "unfinished": "holds an unfinished run; give --resume to continue it, --overwrite to start"
    " again, or another folder",
}


@contextlib.contextmanager
def only_run(output: Path) -> Iterator[None]:
    """Refuse a second run in `output` beside the block; a dead process holds no lock."""
    lock, existing = FileLock(output / LOCK), nearest_folder(output)
    try:
        output.mkdir(parents=True, exist_ok=True)
        lock.acquire(blocking=False)
    except Timeout:
        way_out = "wait for its end, or give another folder"
        raise PlannerError(f"--output {output}: a training runs there; {way_out}") from None
    except OSError:
        pass  # the preflight says why nothing can be written
    try:
        yield
    finally:
        lock.release()
        with contextlib.suppress(OSError):  # a run that was refused leaves no empty folders
            (output / LOCK).unlink(missing_ok=True)
            for folder in (output, *output.parents):
                if folder.absolute() == existing:
                    break
                folder.rmdir()


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
    return "foreign" if any(path.name != LOCK for path in output.iterdir()) else "empty"


def folder_problems(output: Path, *, overwrite: bool, resume: bool) -> list[str]:
    """Reasons why a run may not use the folder."""
    state = folder_state(output)
    if state == "empty" and resume:
        return [f"--resume: {output} holds no run to continue; leave --resume out to start one"]
    wanted = state == "empty" or (state != "foreign" and (overwrite or resume))
    return [] if wanted else [f"--output {output}: {PROBLEMS[state]}"]


def writable_problem(output: Path) -> str | None:
    """Why nothing can be written to the folder (or where it would be made), or None."""
    try:
        with tempfile.TemporaryFile(dir=nearest_folder(output)):
            return None
    except OSError as error:
        return f"--output {output}: cannot be written ({error.strerror}); choose another folder"


def clear(output: Path) -> None:
    """Remove the files of an earlier run; other files stay."""
    for path in (output / name for name in (*WRITTEN.split(), CHECKPOINTS, "logs")):
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)


def write_run(output: Path, fingerprint: dict[str, Any], status: str) -> None:
    """Record a run's fingerprint and status ("running", "interrupted", or the failure)."""
    write_json(output / RUN, {"status": status, **fingerprint})


def stored_fingerprint(output: Path) -> dict[str, Any]:
    """The fingerprint of the run in `output`, finished or not."""
    path = output / RUN if (output / RUN).is_file() else output / MANIFEST
    values = read_json(path)
    if not isinstance(values, dict):
        raise PlannerError(f"{path}: a JSON object is expected; start again with --overwrite")
    return dict(values.get("fingerprint", values)) if path.name == MANIFEST else values


def fingerprint_problems(stored: dict[str, Any], current: dict[str, Any]) -> list[str]:
    """Sentences on everything that differs from the run that is to be resumed."""
    problems = []
    for key, now in current.items():
        before, name = stored.get(key), key.replace("_", " ")
        if key == "settings":
            before = before if isinstance(before, dict) else {}
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
    request: TrainRequest, prepared: Prepared, run: Run, state: TrainState, fingerprint: Values
) -> Values:
    """Write the adapter folder and return its manifest, which is written last.

    Raises PlannerError when a file cannot be written; the checkpoints are then still there.
    """
    output, temporary = request.output, request.output / CHECKPOINTS / ".result"
    try:
        shutil.rmtree(temporary, ignore_errors=True)
        run.trainee.model.save_pretrained(temporary, save_embedding_layers=False)
        assert prepared.tokenizer
        prepared.tokenizer.save_pretrained(temporary)
        # safetensors makes files that only their owner may read; adapters are shared.
        (temporary / WEIGHTS).chmod((temporary / CONFIG).stat().st_mode)
        for path in sorted(temporary.iterdir()):
            path.replace(output / path.name)
        temporary.rmdir()
    except Exception as error:  # safetensors and tokenizers raise their own kinds for a full disk
        raise PlannerError(
            f"{output}: the adapter cannot be written ({error}); free some space and run the same"
            " command with --resume"
        ) from error
    title = f"{request.candidate.row_name}, {request.level} level"
    plot_losses(read_log(output / LOG), output, title)
    manifest = run_manifest(request, prepared, run, state, fingerprint)
    write_text(output / "README.md", model_card(manifest))
    write_json(output / MANIFEST, manifest)
    if request.settings.keep_checkpoints:
        (output / RUN).unlink(missing_ok=True)
    else:
        shutil.rmtree(output / CHECKPOINTS, ignore_errors=True)
    return manifest


def run_manifest(
    request: TrainRequest, prepared: Prepared, run: Run, state: TrainState, fingerprint: Values
) -> Values:
    """The manifest of a finished run: its inputs, settings, outputs and result."""
    candidate, settings, output = request.candidate, request.settings, request.output
    splits = {"training": prepared.train, "validation": prepared.validation}
    inputs = {role: split.path for role, split in splits.items() if split}
    if request.corrections:
        inputs["corrections"] = request.corrections
    files = [output / name for name in (WEIGHTS, CONFIG, "tokenizer.json", LOG)]
    return build_manifest(
        "train",
        seed=settings.seed,
        configuration={**settings.as_dict(), "origin": request.resolved.origin},
        inputs=dict(inputs),
        outputs={path.name: sha256_file(path) for path in files if path.is_file()},
        **adapter_record(candidate, request.level, request.vocabulary),
        is_standin=candidate.is_standin,
        base_reference=candidate.reference,
        licence=candidate.licence,
        samples={role: len(split.samples) for role, split in splits.items() if split},
        departures=request.resolved.departures(request.level),
        result=_result(run, state, output / WEIGHTS),
        fingerprint=fingerprint,
    )


def _result(run: Run, state: TrainState, adapter: Path) -> dict[str, Any]:
    """Length, speed, losses and memory of a finished run."""
    gpu = run.device.type == "cuda"
    sizes = [value.numel() for value in adapter_parameters(run.trainee.model).values()]
    return {
        "steps": state.step,
        "epochs": run.epoch(state.step),
        "tokens": state.tokens,
        "completion_tokens": state.completion_tokens,
        "seconds": round(state.seconds, 1),
        "tokens_per_s": round(state.tokens / state.seconds, 1) if state.seconds else None,
        "train_loss": state.loss,
        "validation_loss": state.best_loss,
        "best_epoch": state.best_epoch,
        "history": state.history,
        "peak_memory_bytes": peak_memory(run.device),
        "device": torch.cuda.get_device_name(run.device) if gpu else str(run.device),
        "compute_dtype": str(run.dtype).removeprefix("torch."),
        "adapter_parameters": sum(sizes),
        "adapter_bytes": adapter.stat().st_size,
    }


def model_card(manifest: dict[str, Any]) -> str:
    """README.md of the adapter that a training manifest describes, in the Hub's format."""
    import jinja2

    environment = jinja2.Environment(
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= {"json": json.dumps, "name": lambda path: Path(path).name}
    values = {"s": manifest["configuration"], "r": manifest["result"], "licences": LICENCES}
    return environment.from_string(read_text(CARD)).render(m=manifest, **values)


def existing_result(output: Path) -> str:
    """A sentence on a finished run."""
    result = read_json(output / MANIFEST).get("result", {})
    size = f"{result.get('steps')} steps, {result.get('epochs')} epochs"
    return f"{output}: this run is complete ({size}); nothing to resume"
