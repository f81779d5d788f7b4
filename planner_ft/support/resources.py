"""Time, memory and processes."""

from __future__ import annotations

import contextlib
import ctypes
import gc
import importlib.util
import os
import resource
import signal
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import torch


def peak_memory(device: torch.device) -> int:
    """Most bytes in use so far: allocated on the GPU, else resident in this process."""
    if device.type == "cuda":
        import torch

        return torch.cuda.max_memory_allocated(device)
    # ru_maxrss is kept across exec: it would be that of the program that started this one.
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
        return next(int(line.split()[1]) * 1024 for line in lines if line.startswith("VmHWM:"))
    except (OSError, StopIteration):
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        return peak if sys.platform == "darwin" else peak * 1024


def reset_peak_memory(device: torch.device) -> None:
    """Begin to measure anew, where the system lets a process do so."""
    if device.type == "cuda":
        import torch

        torch.cuda.reset_peak_memory_stats(device)
    with contextlib.suppress(OSError):
        # 5: forget the highest resident size (proc(5), clear_refs).
        Path("/proc/self/clear_refs").write_text("5")


def cores() -> int:
    """The CPU cores that this process may use."""
    allowed = getattr(os, "sched_getaffinity", None)
    return len(allowed(0)) if allowed else os.cpu_count() or 1


def clock(seconds: float) -> str:
    """A duration as h:mm:ss or m:ss."""
    whole = round(seconds)
    hours, minutes = divmod(whole // 60, 60)
    return f"{hours}:{minutes:02d}:{whole % 60:02d}" if hours else f"{minutes}:{whole % 60:02d}"


@contextlib.contextmanager
def uncollected() -> Iterator[None]:
    """In the block, Python does not look for cycles: walking objects that all live on costs time
    alone.
    """
    enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if enabled:
            gc.enable()


def open_torch() -> None:
    """Have the system open torch's library while other modules are imported, which needs none of
    Python's lock; `import torch` opens it where this cannot.
    """
    spec = importlib.util.find_spec("torch")
    for folder in spec.submodule_search_locations or () if spec else ():
        path = Path(folder, "lib", "libtorch_cpu.so")
        if path.is_file():
            threading.Thread(target=_open, args=(path,)).start()


def _open(path: Path) -> None:
    with contextlib.suppress(OSError):
        ctypes.CDLL(str(path))


def end_with_parent() -> None:
    """Have the system kill this process with the one that started it; on Linux alone."""
    if sys.platform == "linux":
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def memory_size(count: float) -> str:
    """Bytes in GiB, small amounts in MiB."""
    return f"{count / 2**30:.1f} GiB" if count >= 2**29 else f"{count / 2**20:.0f} MiB"
