"""Writing a data folder: all of it or nothing, and never over other results unasked."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.support.alone import alone, staging
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, sha256_file, sha256_text, write_json, write_text

MANIFEST = "manifest.json"


@dataclass(frozen=True)
class DataFolder:
    """Files of a level by name below `folder`, and the manifest that goes with them, without its
    outputs.

    Where `source` is the folder itself, its curated files are left alone as long as they say the
    same.
    """

    folder: Path
    texts: dict[str, str]
    manifest: dict[str, Any]
    source: Path | None = None


def write_folders(folders: Sequence[DataFolder], *, overwrite: bool) -> list[bool]:
    """Write the folders; for each, whether anything was written or it was up to date.

    Raises PlannerError, before anything is written, when a file exists that says something else and
    `overwrite` is not set.
    """
    pending = [_pending(folder) for folder in folders]
    for folder, (_texts, replaced) in zip(folders, pending, strict=True):
        if replaced and not overwrite:
            raise PlannerError(
                f"{folder.folder}: {replaced[0]} exists and is different; give another --out, or"
                " --overwrite to replace it"
            )
    written = []
    for folder, (texts, _replaced) in zip(folders, pending, strict=True):
        if texts:
            _write(folder, texts)
        written.append(bool(texts))
    return written


def _pending(folder: DataFolder) -> tuple[dict[str, str], list[str]]:
    """Texts to be written, and the names of those that replace others. Raises PlannerError where
    records of the curated source itself would be cut.
    """
    in_place = folder.source is not None and folder.source.resolve() == folder.folder.resolve()
    texts, replaced = {}, []
    for name, text in folder.texts.items():
        path = folder.folder / name
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
    if not texts and _present(folder.folder / MANIFEST) is None:
        texts[MANIFEST] = ""
    return texts, replaced


def _present(path: Path) -> str | None:
    try:
        return path.read_bytes().decode("utf-8-sig", "replace") if path.exists() else None
    except OSError as error:
        raise PlannerError(f"{path}: cannot be read ({error.strerror})") from None


def _canonical(text: str) -> str:
    """The records of a curated file without white space that means nothing."""
    lines = (line for line in text.split("\n") if line.strip())
    return "".join(f"{compact_json(json.loads(line))}\n" for line in lines)


def _write(folder: DataFolder, texts: dict[str, str]) -> None:
    """Stage all files beside the target, then move them in: a full disk leaves it as it was."""
    names = [*(name for name in texts if name != MANIFEST), MANIFEST]
    digests = {
        name: sha256_text(text) if name in texts else sha256_file(folder.folder / name)
        for name, text in folder.texts.items()
    }
    try:
        with alone(folder.folder, "--out", "gen-data"), staging(folder.folder) as staged:
            for name in names[:-1]:
                write_text(staged / name, texts[name])
            write_json(staged / MANIFEST, {**folder.manifest, "outputs": digests})
            for name in names:
                (folder.folder / name).parent.mkdir(parents=True, exist_ok=True)
                (staged / name).replace(folder.folder / name)
    except OSError as error:
        raise PlannerError(
            f"{folder.folder}: cannot be written ({error.strerror or error}); choose another --out"
        ) from None
