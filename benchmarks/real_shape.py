"""A random model with the shape of a real one: what its layers cost, without its weights."""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

SHAPE: dict[str, Any] = {
    "hidden_size": 896,
    "intermediate_size": 4864,
    "num_hidden_layers": 24,
    "num_attention_heads": 14,
    "num_key_value_heads": 2,
    "vocab_size": 151_936,
    "tie_word_embeddings": True,
}
"""Of Qwen2.5-0.5B-Instruct's config.json: 494 million weights."""


def make_real_shape(folder: Path, seed: int = 0) -> Path:
    """Write a model of that shape; return its folder. It never ends an answer but by chance."""
    made = random_model("Qwen2.5-3B-Instruct", folder, SHAPE, seed)
    return made.rename(folder / "random-Qwen2.5-0.5B")


def random_model(candidate: str, folder: Path, shape: dict[str, Any], seed: int = 0) -> Path:
    """Write a random model of that shape beside a stand-in's tokenizer and chat template, marked as
    a stand-in; return its folder.
    """
    import torch
    from transformers import AutoConfig, AutoModelForCausalLM

    sys.path.append(str(Path(__file__).parent.parent))
    from scripts.make_standins import make_standin

    target = make_standin(candidate, folder, seed)
    settings = json.loads((target / "config.json").read_text()) | shape
    settings.pop("layer_types", None)
    torch.manual_seed(seed)
    config = AutoConfig.for_model(settings.pop("model_type"), **settings)
    with torch.device("cuda" if torch.cuda.is_available() else "cpu"):
        model = AutoModelForCausalLM.from_config(config, dtype=torch.bfloat16)
    model.save_pretrained(target)
    return target
