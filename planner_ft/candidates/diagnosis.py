"""What `plannerft doctor` finds out about this machine and installation."""

from __future__ import annotations

import importlib.util
import os
import platform
import shutil
import sys
import tempfile
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.candidates.libraries import quiet_libraries
from planner_ft.candidates.listing import describe
from planner_ft.candidates.location import MODELS_VARIABLE, hub_cache
from planner_ft.candidates.registry import all_candidates
from planner_ft.support.manifest import hardware, library_versions, source_commit
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import stale_schemas

GIB = 2**30
LITTLE_DISK_GIB = 5
VARIABLES = (
    "HF_HUB_OFFLINE",
    "TRANSFORMERS_OFFLINE",
    "HF_HOME",
    "HF_HUB_CACHE",
    MODELS_VARIABLE,
    "CUDA_VISIBLE_DEVICES",
    "PYTORCH_CUDA_ALLOC_CONF",
    "OMP_NUM_THREADS",
    "TOKENIZERS_PARALLELISM",
)
"""Environment variables that change what the program does. None of them holds a secret."""


@dataclass(frozen=True)
class Diagnosis:
    """Findings by section (JSON values), and what to look into, one sentence each."""

    sections: dict[str, dict[str, Any]]
    warnings: list[str]


def diagnose() -> Diagnosis:
    """Look at versions, devices, 4-bit support, disk, environment, vocabulary and candidates.
    Raises nothing.
    """
    warnings: list[str] = []
    sections = {
        "planner_ft": _installation(),
        "libraries": _libraries(warnings),
        "machine": _machine(),
        "devices": _devices(warnings),
        "4-bit": _four_bit(warnings),
        "disk": _disk(warnings),
        "environment": {name: os.environ.get(name) for name in VARIABLES},
        "vocabulary": _vocabulary(warnings),
        "candidates": _candidates(warnings),
    }
    return Diagnosis(_private(sections), _private(warnings))


def _private(value: Any) -> Any:
    """The value with the home folder written as ~: the report is pasted into public issues."""
    home = str(Path.home())
    if isinstance(value, dict):
        return {key: _private(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_private(item) for item in value]
    return (
        value.replace(home + os.sep, "~" + os.sep)
        if isinstance(value, str) and home != os.sep
        else value
    )


def _installation() -> dict[str, Any]:
    commit = source_commit()
    source = (
        f"{commit['commit'][:12]}{', with uncommitted changes' if commit['dirty'] else ''}"
        if commit["commit"]
        else "installed package"
    )
    return {
        "version": planner_ft.__version__,
        "source": source,
        "folder": str(Path(planner_ft.__file__).parent),
        "python": sys.version.split()[0],
    }


def _libraries(warnings: list[str]) -> dict[str, Any]:
    versions = library_versions()
    missing = [name for name, version in versions.items() if version is None]
    if missing:
        warnings.append(f"not installed: {', '.join(missing)}; run `pip install -e .` again")
    if importlib.util.find_spec("kernels"):
        warnings.append(
            "the package `kernels` is installed: bitsandbytes then fetches compiled code from the"
            " hub when it is imported; uninstall it to prevent that"
        )
    return dict(versions)


def _machine() -> dict[str, Any]:
    import psutil

    found = hardware()
    memory = psutil.virtual_memory()
    return {
        "platform": found["platform"],
        "processor": _processor() or found["processor"],
        "cores": found["cores"],
        "memory_gib": round(memory.total / GIB, 1),
        "available_gib": round(memory.available / GIB, 1),
    }


def _processor() -> str:
    """The processor's name, which platform.processor() does not tell on Linux."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        return platform.processor()
    return next(
        (line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")), ""
    )


def _devices(warnings: list[str]) -> dict[str, Any]:
    import torch

    from planner_ft.candidates.loading import compute_dtype, resolve_device

    chosen = resolve_device("auto")
    found: dict[str, Any] = {
        "torch": torch.__version__,
        "cuda build": torch.version.cuda,
        "threads": torch.get_num_threads(),
        "chosen by --device auto": str(chosen),
        "compute dtype": str(compute_dtype(chosen)).removeprefix("torch."),
    }
    for index in range(torch.cuda.device_count()):
        properties = torch.cuda.get_device_properties(index)
        free, total = torch.cuda.mem_get_info(index)
        capability = f"{properties.major}.{properties.minor}"
        found[f"cuda:{index}"] = (
            f"{properties.name}, capability {capability}, {free / GIB:.1f} of {total / GIB:.1f} GiB"
            " free"
        )
    if not torch.cuda.is_available() and (
        shutil.which("nvidia-smi") or Path("/proc/driver/nvidia").exists()
    ):
        warnings.append(
            f"there is an NVIDIA driver, but torch {torch.__version__} finds no CUDA device;"
            " install a CUDA build of torch (https://pytorch.org/get-started)"
        )
    return found


def _four_bit(warnings: list[str]) -> dict[str, Any]:
    import torch

    from planner_ft.candidates.probe import probe_four_bit

    quiet_libraries()
    found: dict[str, Any] = {}
    for device in ["cpu", *(f"cuda:{index}" for index in range(torch.cuda.device_count()))]:
        probe = probe_four_bit(device)
        found[device] = {
            name: round(value, 4) if isinstance(value, float) else value
            for name, value in asdict(probe).items()
        }
        if probe.problem:
            warnings.append(
                f"4-bit layers do not work on {device} ({probe.problem}); use --quantization none"
                " there, or another version of bitsandbytes"
            )
    return found


def _disk(warnings: list[str]) -> dict[str, Any]:
    places = {
        "working folder": Path.cwd(),
        "hub cache": hub_cache(),
        "temporary": Path(tempfile.gettempdir()),
    }
    found = {}
    for name, path in places.items():
        existing = next(folder for folder in (path, *path.parents) if folder.exists())
        free = shutil.disk_usage(existing).free / GIB
        found[name] = f"{path}, {free:.1f} GiB free"
        if free < LITTLE_DISK_GIB:
            warnings.append(
                f"only {free:.1f} GiB are free in the {name} ({path}); adapters, predictions and"
                " downloads need more"
            )
    return found


def _vocabulary(warnings: list[str]) -> dict[str, Any]:
    vocabulary = load_vocabulary()
    schemas = Path(planner_ft.__file__).resolve().parent.parent / "schemas"
    stale = stale_schemas(schemas, vocabulary) if schemas.is_dir() else []
    if stale:
        warnings.append(
            f"stale or missing schemas: {', '.join(stale)}; run `plannerft vocabulary --schemas"
            " schemas`"
        )
    state = (
        ("stale: " + ", ".join(stale) if stale else "current")
        if schemas.is_dir()
        else "not in this installation"
    )
    return {
        "name": vocabulary.name,
        "tasks": len(vocabulary.tasks),
        "skills": len(vocabulary.skills),
        "sha256": vocabulary.sha256[:12],
        "schemas": state,
    }


def _candidates(warnings: list[str]) -> dict[str, Any]:
    found = {}
    for description in map(describe, all_candidates()):
        where = (
            f"{description['source']}: {description['folder']}"
            if description["folder"]
            else "not here"
        )
        found[description["row"]] = where
        if description["problem"]:
            warnings.append(f"{description['name']}: {description['problem']}")
        elif not description["here"] and description["repo"] is None:
            warnings.append(f"{description['name']} is not here: {description['get']}")
    return found
