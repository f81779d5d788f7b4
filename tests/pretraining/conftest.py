"""What tests of pretraining share."""

from __future__ import annotations

import importlib.util
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from planner_ft.pretraining.corpus import Mixture, encode_shard, tokenizer_texts
from planner_ft.pretraining.tokenizer import train_tokenizer
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()


@pytest.fixture(scope="session")
def script() -> ModuleType:
    """scripts/pretrain_embedded.py as a module."""
    spec = importlib.util.spec_from_file_location(
        "pretrain_embedded", Path("scripts/pretrain_embedded.py")
    )
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="session")
def tokenizer() -> Any:
    return train_tokenizer(tokenizer_texts(VOCABULARY, 0, 300, 0.5), VOCABULARY, size=1200)


@pytest.fixture(scope="session")
def shard(tokenizer: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("corpus") / "shard.npz"
    counts = encode_shard(
        path, tokenizer, VOCABULARY, seed=1, count=80, mixture=Mixture(0.5), longest=1024
    )
    assert counts["samples"] + counts["left_out"] == 80
    return path
