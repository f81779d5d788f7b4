"""Where a candidate's files lie here, complete and safe to load or not. Never downloads."""

import functools
import json
import os
from pathlib import Path
from typing import Any, Literal

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, sha256_text

Source = Literal["models folder", "package", "hub cache", "path"]

MODELS_VARIABLE = "PLANNERFT_MODELS"
"""Environment variable: a folder with a sub-folder per candidate, searched before other places."""
PACKAGE = Path(__file__).parent
PICKLED = ("*.bin", "*.pt", "*.pth", "*.ckpt", "*.pkl", "*.pickle")
TOKENIZER_FILES = ("tokenizer.json", "tokenizer.model", "vocab.json")


def find_folder(
    name: str, repo: str | None, revision: str | None
) -> tuple[Path | None, Source | None]:
    """The folder of a candidate and the kind of place: models folder, package or hub cache."""
    models = os.environ.get(MODELS_VARIABLE)
    if models and (Path(models).expanduser() / name / "config.json").is_file():
        return (Path(models).expanduser() / name).resolve(), "models folder"
    if repo is None:
        folder = PACKAGE / name
        return (folder, "package") if (folder / "config.json").is_file() else (None, None)
    cached = cached_snapshot(repo, revision)
    return (cached, "hub cache") if cached else (None, None)


def cached_snapshot(repo: str, revision: str | None) -> Path | None:
    """The folder of a repository's snapshot in the hub cache (HF_HUB_CACHE, HF_HOME), or None.
    Reads the cache's documented layout: importing huggingface_hub would cost half a second.
    """
    base = hub_cache() / f"models--{repo.replace('/', '--')}"
    reference = base / "refs" / (revision or "main")
    commit = reference.read_text().strip() if reference.is_file() else revision
    folder = base / "snapshots" / commit if commit else None
    return folder if folder and (folder / "config.json").is_file() else None


def hub_cache() -> Path:
    """The hub's cache folder, found from the environment as huggingface_hub does."""
    variable = os.environ.get
    home = variable("HF_HOME") or Path(variable("XDG_CACHE_HOME") or "~/.cache") / "huggingface"
    named = variable("HF_HUB_CACHE") or variable("HUGGINGFACE_HUB_CACHE")
    return Path(named or Path(home) / "hub").expanduser()


def read_config(folder: Path, name: str = "config.json") -> dict[str, Any]:
    """A JSON object of a model folder; empty where it is missing or broken (checked at loading)."""
    try:
        value = json.loads((folder / name).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def check_folder(folder: Path) -> None:
    """Raise PlannerError when a model folder is incomplete, corrupt or not safe to load."""
    if not (folder / "config.json").is_file():
        wanted = "a candidate is a folder in the transformers format"
        raise PlannerError(f"{folder}: no config.json; {wanted}")
    config = read_json(folder / "config.json")
    names = config.get("architectures") if isinstance(config, dict) else None
    if not isinstance(names, list) or not any(str(name).endswith("ForCausalLM") for name in names):
        wanted = "a causal language model (...ForCausalLM) is needed"
        raise PlannerError(f"{folder}/config.json: architectures is {names}; {wanted}")
    if not any((folder / name).is_file() for name in TOKENIZER_FILES):
        way_out = "copy the tokenizer files of the model into the folder"
        raise PlannerError(f"{folder}: no tokenizer.json; {way_out}")
    for path in weight_files(folder):
        check_safetensors(path)


def weight_files(folder: Path) -> list[Path]:
    """The safetensors files of a model folder. Raises PlannerError when one is missing."""
    index = folder / "model.safetensors.index.json"
    if not index.is_file():
        return [safe_weights(folder, "model.safetensors")]
    shards = sorted(set(read_json(index).get("weight_map", {}).values()))
    missing = [name for name in shards if not (folder / name).is_file()]
    if missing or not shards:
        lack = f"{len(missing)} of {len(shards)} weight files are missing"
        names = f"({', '.join(missing[:2])} ...)"
        raise PlannerError(f"{folder}: {lack} {names}; finish the download")
    return [folder / name for name in shards]


def safe_weights(folder: Path, name: str) -> Path:
    """A safetensors file of a folder. Raises PlannerError where it is missing or only pickled."""
    if (folder / name).is_file():
        return folder / name
    pickled = sorted(path for pattern in PICKLED for path in folder.glob(pattern))
    if pickled:
        why = "which are never loaded because they can run code; get or save them as"
        raise PlannerError(f"{folder}: only pickled weights ({pickled[0].name}), {why} {name}")
    way = "finish the download or training that writes it, or give the folder that holds the"
    raise PlannerError(f"{folder}: no {name}; {way} weights")


def check_safetensors(path: Path) -> dict[str, tuple[int, ...]]:
    """Shapes by tensor name. Raises PlannerError for a truncated or other file."""
    from safetensors import SafetensorError, safe_open

    try:
        with safe_open(str(path), framework="np") as tensors:
            names = list(tensors.keys())
            return {name: tuple(tensors.get_slice(name).get_shape()) for name in names}
    except (SafetensorError, OSError, ValueError) as error:
        why = f"corrupt or no safetensors file ({str(error).splitlines()[0]})"
        raise PlannerError(f"{path}: {why}; download it again") from None


def weights_sha256(folder: Path) -> str:
    """One SHA-256 over names and digests of a model's weight files and config.json. Files of the
    hub cache are links to blobs that are named by their SHA-256; only others are read.
    """
    lines = []
    for path in (folder / "config.json", *weight_files(folder)):
        blob = path.resolve().name
        lines.append(f"{path.name} {blob if len(blob) == 64 else file_sha256(path)}")
    return sha256_text("\n".join(lines))


def file_sha256(path: Path) -> str:
    """SHA-256 of a file, computed once while its size and time stay the same."""
    status = path.stat()
    return _digest(path, status.st_size, status.st_mtime_ns)


@functools.lru_cache(maxsize=64)
def _digest(path: Path, size: int, modified: int) -> str:
    return sha256_file(path)
