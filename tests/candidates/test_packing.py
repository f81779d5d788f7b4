"""An evaluation between training steps leaves every adapter matrix its gradient, to the bit."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
import torch
from bitsandbytes.functional import has_avx512bf16

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import is_packed, linear_4bit, load_model, set_packing
from planner_ft.support.errors import PlannerError

needs_kernel = pytest.mark.skipif(
    not has_avx512bf16(), reason="bitsandbytes packs on AVX512-BF16 CPUs alone"
)
IDS = torch.arange(24).reshape(1, 24) + 300


def with_adapter(model: Any) -> Any:
    from peft import LoraConfig, get_peft_model

    torch.manual_seed(0)
    adapted = get_peft_model(
        model, LoraConfig(r=4, target_modules="all-linear", task_type="CAUSAL_LM")
    )
    for name, parameter in adapted.named_parameters():
        if "lora_B" in name:
            torch.nn.init.normal_(parameter, std=0.02)
    return adapted


def gradients(model: Any) -> dict[str, torch.Tensor]:
    model.train()
    model.zero_grad()
    model(input_ids=IDS, labels=IDS).loss.backward()
    return {
        name: parameter.grad.clone()
        for name, parameter in model.named_parameters()
        if parameter.requires_grad
    }


def evaluate(model: Any) -> None:
    model.eval()
    with torch.no_grad():
        model(input_ids=IDS)
        model.generate(
            input_ids=IDS,
            attention_mask=torch.ones_like(IDS),
            max_new_tokens=2,
            do_sample=False,
            pad_token_id=0,
        )


@pytest.mark.parametrize("name", ["Llama-3.2-1B", "Qwen2.5-3B"])
def test_gradients_are_the_same_after_an_evaluation(models: Path, name: str) -> None:
    model = with_adapter(load_model(resolve_candidate(name), device="cpu", trainable=True))
    before = gradients(model)
    evaluate(model)
    after = gradients(model)
    assert len(before) == 2 * 2 * 7
    assert all(gradient.abs().sum() > 0 for gradient in after.values())
    assert all(torch.equal(before[key], after[key]) for key in before)


@needs_kernel
@pytest.mark.filterwarnings("ignore:bitsandbytes..gemv_4bit")
def test_what_is_prevented_does_happen_to_a_model_loaded_for_decoding(models: Path) -> None:
    model = with_adapter(load_model(resolve_candidate("Llama-3.2-1B"), device="cpu"))
    before = gradients(model)
    evaluate(model)
    after = gradients(model)
    assert any(is_packed(layer) for _, layer in linear_4bit(model)), "decoding uses the fast layout"
    assert not all(torch.allclose(before[key], after[key], rtol=0.1, atol=1e-6) for key in before)
    with pytest.raises(PlannerError, match=r"already packed .* trainable=True"):
        set_packing(model, allowed=False)


def test_layers_whose_shape_the_packed_layout_cannot_hold_still_decode(
    tmp_path: Path, standins: Path
) -> None:
    import shutil

    from transformers import LlamaConfig, LlamaForCausalLM

    folder = tmp_path / "odd"
    shutil.copytree(standins / "Llama-3.2-1B", folder)
    sizes = {
        "hidden_size": 48,
        "intermediate_size": 80,
        "num_hidden_layers": 1,
        "num_attention_heads": 3,
        "num_key_value_heads": 1,
        "head_dim": 16,
    }
    LlamaForCausalLM(LlamaConfig(vocab_size=1035, **sizes)).save_pretrained(folder)
    model = load_model(resolve_candidate(folder), device="cpu")
    assert set_packing(model, allowed=True) == 0
    evaluate(model)
    adapted = with_adapter(load_model(resolve_candidate(folder), device="cpu", trainable=True))
    assert all(gradient.abs().sum() > 0 for gradient in gradients(adapted).values())
