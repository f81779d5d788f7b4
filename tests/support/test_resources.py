"""Peak memory is that of the process, whoever started it; what a start need not wait for."""

from __future__ import annotations

import gc
import subprocess
import sys

import pytest
import torch

from planner_ft.support.resources import peak_memory, uncollected

CPU = torch.device("cpu")
TOLD = (
    "from types import SimpleNamespace as N; from planner_ft.support.resources import peak_memory;"
    " print(peak_memory(N(type='cpu')))"
)

OPENED = """
import sys, threading
from pathlib import Path
from planner_ft.support.resources import open_torch
open_torch()
[one.join() for one in threading.enumerate() if one is not threading.current_thread()]
print("libtorch_cpu" in Path("/proc/self/maps").read_text(), "torch" in sys.modules)
"""


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


@pytest.mark.skipif(sys.platform != "linux", reason="the library is looked for on Linux alone")
def test_the_library_of_torch_is_opened_without_importing_torch() -> None:
    ran = subprocess.run([sys.executable, "-c", OPENED], capture_output=True, text=True, check=True)
    assert ran.stdout.split() == ["True", "False"] and not ran.stderr


def test_cycles_are_looked_for_again_behind_the_block() -> None:
    with pytest.raises(ValueError), uncollected():
        assert not gc.isenabled()
        with uncollected():
            pass
        assert not gc.isenabled()
        raise ValueError
    assert gc.isenabled()
