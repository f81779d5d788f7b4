"""The list of candidates, and the findings of `plannerft doctor`, which tries 4-bit layers."""

from __future__ import annotations

import importlib.util
import os
import platform
import shutil
import sys
import tempfile
import time
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import planner_ft
from planner_ft.candidates import loading
from planner_ft.candidates.costs import GIB, device_memory, expected_times, memory_summary
from planner_ft.candidates.loading import set_packing
from planner_ft.candidates.location import MODELS_VARIABLE, check_folder, hub_cache
from planner_ft.candidates.registry import Candidate, all_candidates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import nearest_folder
from planner_ft.support.manifest import hardware, library_versions, source_commit
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import stale_schemas

if TYPE_CHECKING:
    import torch

FIELDS = ("name", "repo", "parameters", "chat", "licence", "gated", "vocabulary")
LITTLE_DISK_GIB = 5
VARIABLES = (
    *("HF_HUB_OFFLINE", "TRANSFORMERS_OFFLINE", "HF_HOME", "HF_HUB_CACHE", MODELS_VARIABLE),
    *("CUDA_VISIBLE_DEVICES", "PYTORCH_CUDA_ALLOC_CONF", "OMP_NUM_THREADS"),
    "TOKENIZERS_PARALLELISM",
)
"""Environment variables that change what the program does. None of them holds a secret."""
SIZE = 256
WEIGHT_ERROR = 0.15
"""NF4 of normal weights is off by 0.09 (relative norm, measured); more means a broken kernel."""
GRADIENT_ERROR = 0.02
"""Against the same layer dequantised; bfloat16 arithmetic accounts for 0.004."""
Found = dict[str, Any]


def describe(candidate: Candidate) -> Found:
    """One row of `plannerft candidates` as JSON values: estimates of `memory` in GiB and `times` in
    seconds, None if unknown; where it is not `here`, complete, `problem` or `get` says the way out,
    and `command` downloads it.
    """
    missing, problem = candidate.folder is None, None
    try:
        if candidate.folder:
            check_folder(candidate.folder)
    except PlannerError as error:
        problem = str(error)
    return {
        **{name: getattr(candidate, name) for name in FIELDS},
        "row": candidate.row_name,
        "standin": candidate.is_standin,
        "memory": memory_summary(candidate),
        "times": expected_times(candidate),
        "here": not missing and problem is None,
        "folder": None if missing else str(candidate.folder),
        "source": candidate.source,
        "problem": problem,
        "get": loading.how_to_get(candidate) if missing else None,
        "command": loading.download_command(candidate) if missing else None,
    }


@dataclass(frozen=True)
class Diagnosis:
    """Findings by section (JSON values), and warnings, one sentence each."""

    sections: dict[str, Found]
    warnings: list[str]


def diagnose() -> Diagnosis:
    """Look at versions, devices, 4-bit support, disk, environment, vocabulary and candidates."""
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
    if isinstance(value, str) and home != os.sep:
        return value.replace(home + os.sep, "~" + os.sep)
    return value


def _installation() -> Found:
    commit = source_commit()
    changed = ", with uncommitted changes" if commit["dirty"] else ""
    return {
        "version": planner_ft.__version__,
        "source": f"{commit['commit'][:12]}{changed}" if commit["commit"] else "installed package",
        "folder": str(Path(planner_ft.__file__).parent),
        "python": sys.version.split()[0],
    }


def _libraries(warnings: list[str]) -> Found:
    versions = library_versions()
    missing = [name for name, version in versions.items() if version is None]
    if missing:
        warnings.append(f"not installed: {', '.join(missing)}; run `pip install -e .` again")
    if importlib.util.find_spec("kernels"):
        what = "bitsandbytes then fetches compiled code from the hub when it is imported"
        warnings.append(f"the package `kernels` is installed: {what}; uninstall it to prevent that")
    return dict(versions)


def _machine() -> Found:
    import psutil

    found, memory = hardware(), psutil.virtual_memory()
    try:  # platform.processor() has no name on Linux
        lines = Path("/proc/cpuinfo").read_text().splitlines()
    except OSError:
        lines = []
    names = (line.split(":")[1].strip() for line in lines if line.startswith("model name"))
    return {
        "platform": found["platform"],
        "processor": next(names, platform.processor() or found["processor"]),
        "cores": found["cores"],
        "memory_gib": round(memory.total / GIB, 1),
        "available_gib": round(memory.available / GIB, 1),
    }


def _devices(warnings: list[str]) -> Found:
    import torch

    chosen = loading.resolve_device("auto")
    found: Found = {
        "torch": torch.__version__,
        "cuda build": torch.version.cuda,
        "threads": torch.get_num_threads(),
        "chosen by --device auto": str(chosen),
        "compute dtype": str(loading.compute_dtype(chosen)).removeprefix("torch."),
    }
    for index in range(torch.cuda.device_count()):
        device = torch.cuda.get_device_properties(index)
        free, total = (size / GIB for size in device_memory(torch.device("cuda", index)))
        capability = f"{device.name}, capability {device.major}.{device.minor}"
        found[f"cuda:{index}"] = f"{capability}, {free:.1f} of {total:.1f} GiB free"
    driver = shutil.which("nvidia-smi") or Path("/proc/driver/nvidia").exists()
    if driver and not torch.cuda.is_available():
        lack = f"torch {torch.__version__} finds no CUDA device"
        way = "install a CUDA build of torch (https://pytorch.org/get-started)"
        warnings.append(f"there is an NVIDIA driver, but {lack}; {way}")
    return found


def _four_bit(warnings: list[str]) -> Found:
    import torch

    devices = ["cpu", *(f"cuda:{index}" for index in range(torch.cuda.device_count()))]
    found = {device: probe_four_bit(device) for device in devices}
    warnings += [
        f"4-bit layers do not work on {device} ({probe['problem']}); use --quantization none there,"
        " or another version of bitsandbytes"
        for device, probe in found.items()
        if probe["problem"]
    ]
    return found


def probe_four_bit(device: str = "auto") -> Found:
    """Quantise a layer to NF4, multiply with it and take a gradient through it: errors as relative
    norms, whether layers pack for decoding (AVX512-BF16 CPUs), and the problem or None.
    """
    target = loading.resolve_device(device)
    dtype = loading.compute_dtype(target)
    begun, problem = time.perf_counter(), None
    weight, gradient, packs = None, None, False
    try:
        loading.quiet_libraries()
        weight, gradient, packs = _try_layer(target, dtype)
        if not (weight < WEIGHT_ERROR and gradient < GRADIENT_ERROR):
            errors = f"error {weight:.3f} of the product, {gradient:.3f} of the gradient"
            problem = f"wrong results: {errors}"
    except Exception as error:  # anything that goes wrong in a native library is the finding
        problem = f"{type(error).__name__}: {error}".splitlines()[0][:300]
    return {
        "device": str(target),
        "dtype": str(dtype).removeprefix("torch."),
        "weight_error": weight,
        "gradient_error": gradient,
        "packs": packs,
        "seconds": round(time.perf_counter() - begun, 4),
        "problem": problem,
    }


def _try_layer(device: torch.device, dtype: torch.dtype) -> tuple[float, float, bool]:
    """Relative errors of product and gradient, and whether the layer may pack."""
    import torch
    from bitsandbytes.functional import dequantize_4bit
    from bitsandbytes.nn import Linear4bit

    def relative(value: torch.Tensor, reference: torch.Tensor) -> float:
        norm = torch.linalg.vector_norm
        return round(float(norm(value - reference) / norm(reference)), 4)

    generator = torch.Generator().manual_seed(0)
    weight = torch.randn(SIZE, SIZE, generator=generator) / SIZE**0.5
    layer = Linear4bit(SIZE, SIZE, bias=False, compute_dtype=dtype, quant_type="nf4")
    layer.load_state_dict({"weight": weight.to(dtype)})
    layer = layer.to(device)
    packs = set_packing(layer, allowed=True) > 0
    set_packing(layer, allowed=False)
    x = torch.randn(8, SIZE, generator=generator).to(device=device, dtype=dtype).requires_grad_()
    product = layer(x)
    (gradient,) = torch.autograd.grad(product.float().square().sum(), x)
    dense = dequantize_4bit(layer.weight.data, layer.weight.quant_state).to(dtype)
    expected = 2 * product.detach().float() @ dense.float()
    exact = x.detach().float() @ weight.to(device).T
    return relative(product.detach().float(), exact), relative(gradient.float(), expected), packs


def _disk(warnings: list[str]) -> Found:
    temporary = Path(tempfile.gettempdir())
    places = {"working folder": Path.cwd(), "hub cache": hub_cache(), "temporary": temporary}
    found = {}
    for name, path in places.items():
        free = shutil.disk_usage(nearest_folder(path)).free / GIB
        found[name] = f"{path}, {free:.1f} GiB free"
        if free < LITTLE_DISK_GIB:
            more = "adapters, predictions and downloads need more"
            warnings.append(f"only {free:.1f} GiB are free in the {name} ({path}); {more}")
    return found


def _vocabulary(warnings: list[str]) -> Found:
    vocabulary = load_vocabulary()
    schemas = Path(planner_ft.__file__).resolve().parent.parent / "schemas"
    state = "not in this installation"
    if schemas.is_dir():
        stale = ", ".join(stale_schemas(schemas, vocabulary))
        state = f"stale: {stale}" if stale else "current"
        if stale:
            command = "`plannerft vocabulary --schemas schemas`"
            warnings.append(f"stale or missing schemas: {stale}; run {command}")
    return {
        "name": vocabulary.name,
        "tasks": len(vocabulary.tasks),
        "skills": len(vocabulary.skills),
        "sha256": vocabulary.sha256[:12],
        "schemas": state,
    }


def _candidates(warnings: list[str]) -> Found:
    found = {}
    for row in map(describe, all_candidates()):
        found[row["row"]] = f"{row['source']}: {row['folder']}" if row["folder"] else "not here"
        if row["problem"]:
            warnings.append(f"{row['name']}: {row['problem']}")
        elif not row["here"] and row["repo"] is None:
            warnings.append(f"{row['name']} is not here: {row['get']}")
    return found
