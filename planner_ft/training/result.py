"""The adapter folder that a finished run leaves: PEFT files, tokenizer, manifest, model card, loss
curve.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

from planner_ft.candidates.adapters import adapter_record
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.resources import peak_memory
from planner_ft.training.card import model_card
from planner_ft.training.checkpoint import FOLDER, TrainState
from planner_ft.training.loop import Run
from planner_ft.training.model import adapter_parameters
from planner_ft.training.output import MANIFEST
from planner_ft.training.plot import plot_losses
from planner_ft.training.report import LOG, read_log
from planner_ft.training.request import TrainRequest
from planner_ft.training.samples import Split

TEMPORARY = "checkpoints/.result"


def write_result(
    request: TrainRequest,
    run: Run,
    state: TrainState,
    tokenizer: Any,
    splits: dict[str, Split],
    fingerprint: dict[str, Any],
) -> dict[str, Any]:
    """Write the adapter folder and return its manifest. The manifest comes last: where it is, the
    folder is complete.

    Raises PlannerError when a file cannot be written; the checkpoints are then still there.
    """
    output, temporary = request.output, request.output / TEMPORARY
    try:
        shutil.rmtree(temporary, ignore_errors=True)
        run.trainee.model.save_pretrained(temporary, save_embedding_layers=False)
        tokenizer.save_pretrained(temporary)
        # safetensors makes files that only their owner may read; as readable as the rest they can
        # be shared.
        (temporary / "adapter_model.safetensors").chmod(
            (temporary / "adapter_config.json").stat().st_mode
        )
        for path in sorted(temporary.iterdir()):
            path.replace(output / path.name)
        temporary.rmdir()
    except Exception as error:  # safetensors and tokenizers raise their own kinds for a full disk
        raise PlannerError(
            f"{output}: the adapter cannot be written ({error}); free some space and run the same"
            " command with --resume"
        ) from error
    plot_losses(
        read_log(output / LOG), output, f"{request.candidate.row_name}, {request.level} level"
    )
    manifest = run_manifest(request, run, state, splits, fingerprint)
    write_text(output / "README.md", model_card(manifest))
    write_json(output / MANIFEST, manifest)
    if request.settings.keep_checkpoints:
        (output / FOLDER / "run.json").unlink(missing_ok=True)
    else:
        shutil.rmtree(output / FOLDER, ignore_errors=True)
    return manifest


def run_manifest(
    request: TrainRequest,
    run: Run,
    state: TrainState,
    splits: dict[str, Split],
    fingerprint: dict[str, Any],
) -> dict[str, Any]:
    """The manifest of a finished run: what it depended on and what came out."""
    candidate, settings = request.candidate, request.settings
    outputs = ("adapter_model.safetensors", "adapter_config.json", "tokenizer.json", LOG)
    return build_manifest(
        "train",
        seed=settings.seed,
        configuration={**settings.as_dict(), "origin": request.resolved.origin},
        inputs={
            **{role: split.path for role, split in splits.items()},
            **({"corrections": request.corrections} if request.corrections else {}),
        },
        outputs={
            name: sha256_file(request.output / name)
            for name in outputs
            if (request.output / name).is_file()
        },
        **adapter_record(candidate, request.level, request.vocabulary),
        is_standin=candidate.is_standin,
        base_reference=candidate.reference,
        licence=candidate.licence,
        samples={role: len(split.samples) for role, split in splits.items()},
        departures=request.resolved.departures(request.level),
        result={
            "steps": state.step,
            "epochs": round(state.step / run.steps_per_epoch, 4),
            "tokens": state.tokens,
            "completion_tokens": state.completion_tokens,
            "seconds": round(state.seconds, 1),
            "tokens_per_s": round(state.tokens / state.seconds, 1) if state.seconds else None,
            "train_loss": state.loss,
            "validation_loss": state.best_loss,
            "best_epoch": state.best_epoch,
            "history": state.history,
            "peak_memory_bytes": peak_memory(run.device),
            "device": device_name(run.device),
            "compute_dtype": str(run.dtype).removeprefix("torch."),
            "adapter_parameters": sum(
                value.numel() for value in adapter_parameters(run.trainee.model).values()
            ),
            "adapter_bytes": (request.output / "adapter_model.safetensors").stat().st_size,
        },
        fingerprint=fingerprint,
    )


def device_name(device: Any) -> str:
    """cpu, or the GPU's name."""
    if device.type != "cuda":
        return str(device)
    import torch

    return str(torch.cuda.get_device_name(device))


def existing_result(output: Path) -> str:
    """A sentence on a finished run."""
    result = read_json(output / MANIFEST).get("result", {})
    return (
        f"{output}: this run is complete ({result.get('steps')} steps, {result.get('epochs')}"
        " epochs); nothing to resume"
    )
