"""Exports of stand-ins: tiny random models with the architecture of the candidates, and random
adapters.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from planner_ft.decoding.configurations import MAX_NEW_TOKENS
from planner_ft.model_export import Exported, ExportSettings, check, export

LLAMA, QWEN = "Llama-3.2-1B-Instruct", "Qwen2.5-3B-Instruct"


@pytest.fixture(autouse=True)
def _short_answers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Random models never end their answers; and drawing a thousand commands takes seconds."""
    monkeypatch.setitem(MAX_NEW_TOKENS, "mission", 6)
    monkeypatch.setattr(check, "TOKEN_CHECKS", 20)


@pytest.fixture(scope="session")
def adapters(standins: Path, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Path]:
    """Makes a random PEFT adapter for a stand-in, as another tool would write it."""
    made: dict[str, Path] = {}

    def adapter(name: str) -> Path:
        import peft
        import torch
        from transformers import AutoModelForCausalLM

        if name not in made:
            made[name] = tmp_path_factory.mktemp("adapter")
            torch.manual_seed(0)
            settings = peft.LoraConfig(
                r=4,
                lora_alpha=64,
                target_modules=["q_proj", "v_proj", "down_proj"],
                init_lora_weights=False,
            )
            peft.get_peft_model(
                AutoModelForCausalLM.from_pretrained(str(standins / name)), settings
            ).save_pretrained(str(made[name]))
        return made[name]

    return adapter


@pytest.fixture
def exported(
    models: Path, adapters: Callable[[str], Path], tmp_path: Path
) -> Callable[..., Exported]:
    """Exports a stand-in with its random adapter."""

    def run(name: str = LLAMA, **changes: object) -> Exported:
        values = {
            "candidate": name,
            "out": tmp_path / "out",
            "merge": True,
            "adapter": str(adapters(name)),
            "checks": 2,
            **changes,
        }
        return export(ExportSettings(**values))  # type: ignore[arg-type]

    return run
