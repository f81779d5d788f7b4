"""Where a candidate's files lie on this machine, and whether they are complete and safe to load.
Never downloads.
"""

from __future__ import annotations

import functools
import json
import os
from pathlib import Path
from typing import Any, Literal

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, sha256_text

Source = Literal["models folder", "package", "hub cache", "path"]

MODELS_VARIABLE = "PLANNERFT_MODELS"
"""Environment variable: a folder with a sub-folder per candidate name, which comes before every
other place.
"""
PACKAGE = Path(__file__).parent
PICKLED = ("*.bin", "*.pt", "*.pth", "*.ckpt", "*.pkl", "*.pickle")
TOKENIZER_FILES = ("tokenizer.json", "tokenizer.model", "vocab.json")


def find_folder(
    name: str, repo: str | None, revision: str | None
) -> tuple[Path | None, Source | None]:
    """The folder of a candidate and what kind of place it is: the models folder, the package, or
    the hub cache.
    """
    models = os.environ.get(MODELS_VARIABLE)
    if models and (Path(models).expanduser() / name / "config.json").is_file():
        return (Path(models).expanduser() / name).resolve(), "models folder"
    if repo is None:
        folder = PACKAGE / name
        return (folder, "package") if (folder / "config.json").is_file() else (None, None)
    cached = cached_snapshot(repo, revision)
    return (cached, "hub cache") if cached else (None, None)


def cached_snapshot(repo: str, revision: str | None) -> Path | None:
    """The folder of a repository's snapshot in the hub cache (HF_HUB_CACHE, HF_HOME), or None."""
    # The cache's documented layout is read directly: importing huggingface_hub would cost every
    # command half a second.
    base = hub_cache() / f"models--{repo.replace('/', '--')}"
    reference = base / "refs" / (revision or "main")
    commit = reference.read_text().strip() if reference.is_file() else revision
    folder = base / "snapshots" / commit if commit else None
    return folder if folder and (folder / "config.json").is_file() else None


def hub_cache() -> Path:
    """The hub's cache folder, found from the environment as huggingface_hub does."""
    home = Path(
        os.environ.get("HF_HOME")
        or Path(os.environ.get("XDG_CACHE_HOME") or "~/.cache") / "huggingface"
    )
    return Path(
        os.environ.get("HF_HUB_CACHE") or os.environ.get("HUGGINGFACE_HUB_CACHE") or home / "hub"
    ).expanduser()


def read_config(folder: Path, name: str = "config.json") -> dict[str, Any]:
    """A JSON file of a model folder as a dictionary, empty where it is missing or not JSON (checked
    when loading).
    """
    try:
        value = json.loads((folder / name).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def check_folder(folder: Path) -> None:
    """Raise PlannerError, in one sentence, when a model folder is incomplete, corrupt or not safe
    to load.
    """
    if not (folder / "config.json").is_file():
        raise PlannerError(
            f"{folder}: no config.json; a candidate is a folder in the transformers format"
        )
    config = read_json(folder / "config.json")
    architectures = config.get("architectures") if isinstance(config, dict) else None
    if not isinstance(architectures, list) or not any(
        str(name).endswith("ForCausalLM") for name in architectures
    ):
        raise PlannerError(
            f"{folder}/config.json: architectures is {architectures}; a causal language model"
            " (...ForCausalLM) is needed"
        )
    if not any((folder / name).is_file() for name in TOKENIZER_FILES):
        raise PlannerError(
            f"{folder}: no tokenizer.json; copy the tokenizer files of the model into the folder"
        )
    for path in weight_files(folder):
        check_safetensors(path)


def weight_files(folder: Path) -> list[Path]:
    """The safetensors files of a model folder. Raises PlannerError when there are none, or a shard
    is missing.
    """
    index = folder / "model.safetensors.index.json"
    if index.is_file():
        shards = sorted(set(read_json(index).get("weight_map", {}).values()))
        missing = [name for name in shards if not (folder / name).is_file()]
        if missing or not shards:
            raise PlannerError(
                f"{folder}: {len(missing)} of {len(shards)} weight files are missing"
                f" ({', '.join(missing[:2])} ...); finish the download"
            )
        return [folder / name for name in shards]
    if (folder / "model.safetensors").is_file():
        return [folder / "model.safetensors"]
    pickled = sorted(path.name for pattern in PICKLED for path in folder.glob(pattern))
    if pickled:
        raise PlannerError(
            f"{folder}: only pickled weights ({pickled[0]}), which are never loaded because they"
            " can run code; get the safetensors version"
        )
    raise PlannerError(
        f"{folder}: no model.safetensors; finish the download, or give the folder that holds the"
        " weights"
    )


def check_safetensors(path: Path) -> dict[str, tuple[int, ...]]:
    """Shapes by tensor name. Raises PlannerError when the file is truncated or no safetensors
    file.
    """
    from safetensors import SafetensorError, safe_open

    try:
        with safe_open(str(path), framework="np") as tensors:
            return {name: tuple(tensors.get_slice(name).get_shape()) for name in tensors.keys()}  # noqa: SIM118
    except (SafetensorError, OSError, ValueError) as error:
        raise PlannerError(
            f"{path}: corrupt or no safetensors file ({str(error).splitlines()[0]}); download it"
            " again"
        ) from None


def weights_sha256(folder: Path) -> str:
    """One SHA-256 over names and digests of a model's weight files and config.json.

    Files of the hub cache are links to blobs that are named by their SHA-256; only others are read.
    """
    lines = []
    for path in [folder / "config.json", *weight_files(folder)]:
        blob, status = path.resolve().name, path.stat()
        lines.append(
            f"{path.name}"
            f" {blob if len(blob) == 64 else _digest(path, status.st_size, status.st_mtime_ns)}"
        )
    return sha256_text("\n".join(lines))


@functools.lru_cache(maxsize=64)
def _digest(path: Path, size: int, modified: int) -> str:
    """SHA-256 of a file, computed once while its size and time stay the same."""
    return sha256_file(path)
