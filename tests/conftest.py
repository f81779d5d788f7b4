"""Fixtures of more than one part."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import hypothesis
import pytest

from tests.forked import Forked

LAUNCHER = "torch.distributed.elastic.multiprocessing.subprocess_handler.subprocess_handler"

# Set before anything imports the hub's library, which reads it once: tests never touch a network.
os.environ["HF_HUB_OFFLINE"] = "1"
# A thread for each worker of the suite and for each process that a test starts, before anything
# imports torch or numpy: threads that wait for a busy core compute in circles.
for library in ("OMP", "MKL", "OPENBLAS"):
    os.environ[f"{library}_NUM_THREADS"] = "1"
# A shell starts background jobs with Ctrl-C ignored, and so would every process of a suite that
# runs in one.
signal.signal(signal.SIGINT, signal.default_int_handler)
# An example may take any time: the first call loads a library, and machines are busy. The same
# commit is tried on the same examples; `--hypothesis-profile explore` draws new ones.
hypothesis.settings.register_profile("explore", deadline=None)
hypothesis.settings.register_profile("same examples", deadline=None, derandomize=True)
hypothesis.settings.load_profile("same examples")


@pytest.fixture(scope="session")
def standins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the stand-ins of the seven published candidates, to be named by
    PLANNERFT_MODELS. Do not write to it.
    """
    from scripts.make_standins import make_all_standins

    folder = tmp_path_factory.mktemp("standins")
    make_all_standins(folder)
    return folder


@pytest.fixture
def models(standins: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The stand-ins' folder, with PLANNERFT_MODELS set: candidates resolve to their stand-ins."""
    monkeypatch.setenv("PLANNERFT_MODELS", str(standins))
    return standins


@pytest.fixture
def forked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Processes of Python that the test starts, and those that they start, are forked."""
    monkeypatch.setattr(subprocess, "Popen", Forked)
    # torch's launcher, where it is loaded already, has taken Popen by its name.
    if launcher := sys.modules.get(LAUNCHER):
        monkeypatch.setattr(launcher, "Popen", Forked)
