"""The run manifest: what a result depended on (schemas/manifest.schema.json)."""

import contextlib
import functools
import importlib.metadata
import os
import platform
import shlex
import subprocess
import sys
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.support.files import sha256_file
from planner_ft.support.resources import cores

LIBRARIES = (
    *("torch", "transformers", "peft", "bitsandbytes", "accelerate", "datasets"),
    *("tokenizers", "safetensors", "jsonschema"),
)


def library_versions() -> dict[str, str | None]:
    """Installed versions of the libraries that results depend on, without importing them."""
    versions: dict[str, str | None] = dict.fromkeys(LIBRARIES)
    for name in LIBRARIES:
        with contextlib.suppress(importlib.metadata.PackageNotFoundError):
            versions[name] = importlib.metadata.version(name)
    return versions


@functools.cache
def source_commit() -> dict[str, Any]:
    """The source tree's commit and whether it has uncommitted changes; None when installed."""
    root = Path(planner_ft.__file__).resolve().parent.parent
    with contextlib.suppress(OSError, subprocess.CalledProcessError):
        if (root / ".git").exists():
            changes = _git(root, "status", "--porcelain", "--untracked-files=no")
            return {"commit": _git(root, "rev-parse", "HEAD"), "dirty": bool(changes)}
    return {"commit": None, "dirty": None}


def _git(root: Path, *arguments: str) -> str:
    command = ["git", "-C", str(root), *arguments]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


def hardware() -> dict[str, Any]:
    """Machine description: platform, processor, cores, memory in bytes."""
    memory: int | None = None
    with contextlib.suppress(ValueError, OSError):
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    machine = platform.machine()
    return {
        # Without the kernel's release, which says more about a host than about a result.
        "platform": "-".join((platform.system(), machine, *platform.libc_ver())),
        "processor": machine,
        "cores": cores(),
        "memory_bytes": memory,
    }


def _command() -> str:
    """The command line of this process, as a shell reads it."""
    program = Path(sys.argv[0])
    ours = program.parts[-2:] == ("planner_ft", "__main__.py")  # python -m planner_ft
    return shlex.join(["plannerft" if ours else program.name, *sys.argv[1:]])


def build_manifest(
    kind: str,
    *,
    seed: int | None,
    configuration: dict[str, Any],
    inputs: dict[str, Path | str] | None = None,
    **more: Any,
) -> dict[str, Any]:
    """A manifest of `kind` ("data", "train", "bench", ...); `inputs` maps a role to a file. `more`
    adds fields of that kind of run (outputs, time, tokens, device, ...).
    """
    files = (inputs or {}).items()
    return {
        "kind": kind,
        "planner_ft": planner_ft.__version__,
        "created": datetime.now(UTC).isoformat(timespec="seconds"),
        "seed": seed,
        "configuration": configuration,
        "inputs": {role: {"path": str(p), "sha256": sha256_file(p)} for role, p in files},
        "versions": {"python": sys.version.split()[0], **library_versions()},
        **source_commit(),
        "hardware": hardware(),
        "command": _command(),
        **more,
    }
