"""What tests of pretraining share."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture(scope="session")
def script() -> ModuleType:
    """scripts/pretrain_embedded.py as a module."""
    spec = importlib.util.spec_from_file_location("pretrain_embedded", Path("scripts/pretrain_embedded.py"))
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module
