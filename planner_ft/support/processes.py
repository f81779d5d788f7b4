"""Processes that do not outlive the one that started them."""

from __future__ import annotations

import signal
import sys

DEATH_SIGNAL = 1
"""PR_SET_PDEATHSIG of Linux."""


def end_with_parent() -> None:
    """Have the system kill this process with the one that started it; on Linux alone, elsewhere
    nothing happens.
    """
    if sys.platform == "linux":
        import ctypes

        ctypes.CDLL(None).prctl(DEATH_SIGNAL, signal.SIGKILL)
