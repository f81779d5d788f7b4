"""The output folder: what lies in it, whether a run may use it, and what a run there depends on."""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path
from typing import Any, Literal

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json

FolderState = Literal["empty", "complete", "unfinished", "foreign"]

MANIFEST = "manifest.json"
RUN = "checkpoints/run.json"
WRITTEN = (
    "adapter_config.json",
    "adapter_model.safetensors",
    "README.md",
    MANIFEST,
    "train_log.jsonl",
    "loss.png",
    "loss.svg",
    "checkpoints",
    "logs",
    "tokenizer.json",
    "tokenizer_config.json",
    "special_tokens_map.json",
    "added_tokens.json",
    "chat_template.jinja",
    "vocab.json",
    "merges.txt",
)
"""Everything that a run writes, and all that --overwrite removes."""


def folder_state(output: Path) -> FolderState:
    """Whether `output` holds a finished run, an unfinished one, nothing, or something else."""
    if not output.is_dir():
        return "foreign" if output.exists() else "empty"
    if (output / RUN).is_file():
        return "unfinished"
    if (output / MANIFEST).is_file():
        manifest = read_json(output / MANIFEST)
        return (
            "complete"
            if isinstance(manifest, dict) and manifest.get("kind") == "train"
            else "foreign"
        )
    return "foreign" if any(output.iterdir()) else "empty"


def folder_problems(output: Path, *, overwrite: bool, resume: bool) -> list[str]:
    """What keeps a run from using the folder."""
    state = folder_state(output)
    if state == "foreign":
        return [
            f"--output {output}: exists and is no folder of a training run; give another folder"
        ]
    if state == "complete" and not (overwrite or resume):
        return [
            f"--output {output}: holds a finished adapter; give --overwrite to train it again, or"
            " another folder"
        ]
    if state == "unfinished" and not (overwrite or resume):
        return [
            f"--output {output}: holds an unfinished run; give --resume to continue it, --overwrite"
            " to start again, or another folder"
        ]
    if state == "empty" and resume:
        return [f"--resume: {output} holds no run to continue; leave --resume out to start one"]
    return []


def writable_problem(output: Path) -> str | None:
    """Why nothing can be written to the folder (or to the one that it would be made in), or
    None.
    """
    try:
        with tempfile.TemporaryFile(dir=nearest_folder(output)):
            return None
    except OSError as error:
        return f"--output {output}: cannot be written ({error.strerror}); choose another folder"


def nearest_folder(path: Path) -> Path:
    """The folder itself, or the nearest one above that exists."""
    path = path.absolute()
    return next(folder for folder in (path, *path.parents) if folder.exists())


def clear(output: Path) -> None:
    """Remove what an earlier run wrote; other files stay."""
    for name in WRITTEN:
        path = output / name
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        else:
            path.unlink(missing_ok=True)


def write_run(output: Path, fingerprint: dict[str, Any], status: str) -> None:
    """Record what the run depends on and how it stands ("running", "interrupted", or why it
    stopped).
    """
    write_json(output / RUN, {"status": status, **fingerprint})


def stored_fingerprint(output: Path) -> dict[str, Any]:
    """What the run in `output`, finished or not, depended on."""
    path = output / RUN if (output / RUN).is_file() else output / MANIFEST
    values = read_json(path)
    if not isinstance(values, dict):
        raise PlannerError(f"{path}: a JSON object is expected; start again with --overwrite")
    return dict(values.get("fingerprint", values)) if path.name == MANIFEST else values


def fingerprint_problems(stored: dict[str, Any], current: dict[str, Any]) -> list[str]:
    """Sentences on everything that differs from the run that is to be resumed."""
    problems = []
    for key in current:
        before, now = stored.get(key), current[key]
        if key == "settings":
            before = before if isinstance(before, dict) else {}
            names = [name for name in now if before.get(name) != now[name]]
            problems += [
                f"--{name.replace('_', '-')} was {before.get(name)} and is {now[name]}"
                for name in names
            ]
        elif before != now:
            problems.append(
                f"{key.replace('_', ' ')} was {before} and is {now}"
                if len(str(now)) < 40
                else f"the {key.replace('_', ' ')} changed since"
            )
    return problems
