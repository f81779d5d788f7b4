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
    """Write the model beside a stand-in's tokenizer and chat template; return its folder. It never
    ends an answer but by chance.
    """
    import torch
    from transformers import Qwen2Config, Qwen2ForCausalLM

    sys.path.append(str(Path(__file__).parent.parent))
    from scripts.make_standins import make_standin

    target = make_standin("Qwen2.5-3B-Instruct", folder, seed)
    settings = json.loads((target / "config.json").read_text()) | SHAPE
    settings.pop("layer_types", None)
    torch.manual_seed(seed)
    before = torch.get_default_dtype()
    torch.set_default_dtype(torch.bfloat16)
    try:
        model = Qwen2ForCausalLM(Qwen2Config(**settings))
    finally:
        torch.set_default_dtype(before)
    model.save_pretrained(target)
    return target.rename(folder / "random-Qwen2.5-0.5B")
