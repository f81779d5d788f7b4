"""Keeping the libraries beneath quiet about what says nothing on the user's run."""

from __future__ import annotations

import contextlib
import logging
import warnings
from collections.abc import Iterator


def quiet_libraries() -> None:
    """Silence notices of bitsandbytes and PEFT. Call it before anything imports peft."""
    # It warns that an optional package, with kernels from the hub, is not installed.
    logging.getLogger("bitsandbytes.backends.cpu.ops").setLevel(logging.ERROR)
    # PEFT asks transformers for an attribute by its former name; a user can do nothing about it.
    warnings.filterwarnings(
        "ignore", message=".*is_gradient_checkpointing.*", category=FutureWarning
    )


@contextlib.contextmanager
def quiet_bars() -> Iterator[None]:
    """Let transformers draw no progress bars in the block."""
    from transformers.utils import logging as bars

    if not bars.is_progress_bar_enabled():
        yield
        return
    bars.disable_progress_bar()
    try:
        yield
    finally:
        bars.enable_progress_bar()
