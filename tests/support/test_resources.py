"""Peak memory is that of the process, whoever started it."""

from __future__ import annotations

import subprocess
import sys

import torch

from planner_ft.support.resources import peak_memory

CPU = torch.device("cpu")
TOLD = (
    "from types import SimpleNamespace as N; from planner_ft.support.resources import peak_memory;"
    " print(peak_memory(N(type='cpu')))"
)


def test_the_peak_stays_when_memory_is_given_back() -> None:
    size = 2**28
    before = peak_memory(CPU)
    held = torch.ones(size // 4)
    assert peak_memory(CPU) >= max(before, size)
    del held
    assert peak_memory(CPU) >= max(before, size)


def test_a_process_does_not_count_what_its_parent_needed() -> None:
    held = torch.ones(2**28 // 4)
    told = int(
        subprocess.run(
            [sys.executable, "-c", TOLD], capture_output=True, text=True, check=True
        ).stdout
    )
    assert told < 2**27 < held.nbytes < peak_memory(CPU)
