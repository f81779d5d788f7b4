"""The lean forward pass computes what transformers computes, and gives each position its numbers
whatever is computed beside it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
import torch
from torch import Tensor

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import compute_dtype, load_model
from planner_ft.candidates.packing import linear_4bit
from planner_ft.decoding.dense import NotDense, dense_weight
from planner_ft.decoding.lean import LeanDecoder
from planner_ft.decoding.lean_passes import BLOCK, KEYS, attention

IDS = [(7 * step * step + 3) % 61 + 3 for step in range(300)]
LLAMA_3 = {
    "rope_type": "llama3",
    "rope_theta": 500000.0,
    "factor": 8.0,
    "low_freq_factor": 1.0,
    "high_freq_factor": 4.0,
    "original_max_position_embeddings": 64,
}
MODELS: dict[str, dict[str, Any]] = {
    "grouped heads": {},
    "one key head": {"num_key_value_heads": 1},
    "all key heads": {"num_key_value_heads": 4},
    "shared embeddings": {"tie_word_embeddings": True},
    "biases": {"attention_bias": True, "mlp_bias": True},
    "heads of another size": {"head_dim": 12},
    "Llama 3 positions": {"rope_parameters": LLAMA_3},
}


bits = pytest.mark.skipif(
    compute_dtype(torch.device("cpu")) != torch.bfloat16,
    reason="bit by bit the same only where the CPU multiplies bfloat16",
)


def lean(model: Any, adapter: Any = None) -> LeanDecoder:
    decoder = LeanDecoder.of(model, adapter)
    assert decoder is not None
    return decoder


def logits(decoder: LeanDecoder, ids: list[int], first: int, step: int) -> Tensor:
    """Logits from position `first - 1` on, fed in pieces of `step`."""
    passes = decoder.start(1)
    parts = [passes.run([ids[:first]], [1])]
    parts += [
        passes.run([piece], [len(piece)])
        for start in range(first, len(ids), step)
        for piece in [ids[start : start + step]]
    ]
    return torch.cat(parts)


def randomise(model: Any) -> Any:
    """Biases and norms that are not zero and one."""
    with torch.no_grad():
        for name, value in model.named_parameters():
            if name.endswith("bias") or "norm" in name:
                value.uniform_(0.5, 1.5)
    return model


@pytest.mark.parametrize("name", MODELS)
@torch.inference_mode()
def test_logits_are_those_of_transformers(make_llama: Callable[..., Any], name: str) -> None:
    model = randomise(make_llama(**MODELS[name]))
    expected = model(input_ids=torch.tensor([IDS])).logits[0]
    assert torch.allclose(
        lean(model).start(1).run([IDS], [len(IDS)]), expected, atol=2e-3, rtol=1e-3
    )
    assert torch.allclose(logits(lean(model), IDS, 37, 5), expected[36:], atol=2e-3, rtol=1e-3)


@torch.inference_mode()
def test_logits_of_a_qwen_are_those_of_transformers() -> None:
    from transformers import Qwen2Config, Qwen2ForCausalLM

    torch.manual_seed(0)
    sizes = {
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_hidden_layers": 2,
        "num_attention_heads": 4,
        "num_key_value_heads": 2,
    }
    model = randomise(
        Qwen2ForCausalLM(Qwen2Config(vocab_size=64, initializer_range=0.5, **sizes)).eval()
    )
    expected = model(input_ids=torch.tensor([IDS])).logits[0]
    assert torch.allclose(
        lean(model).start(1).run([IDS], [len(IDS)]), expected, atol=2e-3, rtol=1e-3
    )


@torch.inference_mode()
def test_rows_of_a_batch_have_their_own_positions(toy_model: Any) -> None:
    decoder = lean(toy_model)
    rows = [IDS[:90], IDS[40:47], IDS[100:240]]
    alone = [logits(decoder, row, 3, 1) for row in rows]
    passes = decoder.start(3)
    together = passes.run([row[:3] for row in rows], [1, 1, 1])
    assert torch.allclose(together, torch.cat([part[:1] for part in alone]), atol=1e-4)
    passes.run([row[3:5] for row in rows], [1, 1, 1])
    passes.forget([2, 1, 0])
    fed = passes.run([rows[0][3:7], rows[1][4:7], rows[2][5:12]], [4, 3, 7])
    passes.select([0, 2])
    fed = torch.cat([fed, passes.run([rows[0][7:40], rows[2][12:14]], [33, 2])])
    expected = torch.cat(
        [alone[0][1:5], alone[1][2:5], alone[2][3:10], alone[0][5:38], alone[2][10:12]]
    )
    assert torch.allclose(fed, expected, atol=1e-4)


@bits
@torch.inference_mode()
def test_in_bfloat16_a_position_has_the_same_bits_in_every_pass(
    make_llama: Callable[..., Any],
) -> None:
    decoder = lean(
        make_llama(hidden_size=128, intermediate_size=352, initializer_range=0.1).bfloat16()
    )
    one_by_one = logits(decoder, IDS, 30, 1)
    assert one_by_one.dtype == torch.bfloat16
    for first, step in ((30, 2), (30, 5), (30, 8), (30, 13), (30, 90)):
        assert torch.equal(logits(decoder, IDS, first, step), one_by_one)
    assert torch.equal(decoder.start(1).run([IDS[:70]], [41]), one_by_one[:41])
    passes = decoder.start(4)
    passes.run([IDS[:200], IDS[:30], IDS[:130], IDS[:31]], [1] * 4)
    fed = passes.run([IDS[200:204], IDS[30:37], IDS[130:131], IDS[31:33]], [4, 7, 1, 2])
    assert torch.equal(
        fed, torch.cat([one_by_one[171:175], one_by_one[1:8], one_by_one[101:102], one_by_one[2:4]])
    )


@bits
@torch.inference_mode()
def test_hidden_keys_do_not_change_a_bit_of_attention() -> None:
    torch.manual_seed(0)
    keys, values = torch.randn(2, 1, 4, 8 * KEYS, 64)
    for count in range(60, 1000, 47):
        queries = torch.randn(1, 4, BLOCK, 64)
        hidden = torch.zeros(1, 1, BLOCK, 8 * KEYS).masked_fill_(
            torch.arange(8 * KEYS) >= count, -torch.inf
        )
        reaches = range(-(-count // KEYS) * KEYS, 8 * KEYS + 1, KEYS)
        found = [
            attention(queries, (keys[:, :, :reach], values[:, :, :reach]), hidden[..., :reach])
            for reach in reaches
        ]
        assert all(torch.equal(one, found[0]) for one in found)


@torch.inference_mode()
def test_adapters_are_folded_in_and_the_base_stays_the_base(make_llama: Callable[..., Any]) -> None:
    from peft import LoraConfig, get_peft_model

    model = make_llama()
    plain = lean(model)
    model = get_peft_model(
        model,
        LoraConfig(
            r=4,
            target_modules=["q_proj", "v_proj", "o_proj", "up_proj", "down_proj"],
            init_lora_weights=False,
        ),
        "mission",
    )
    model.add_adapter(
        "task",
        LoraConfig(
            r=2, lora_alpha=9, use_rslora=True, target_modules="all-linear", init_lora_weights=False
        ),
    )
    model.eval()
    ids = torch.tensor([IDS])
    for adapter in ("mission", "task"):
        model.set_adapter(adapter)
        assert torch.allclose(
            lean(model, adapter).start(1).run([IDS], [len(IDS)]),
            model(input_ids=ids).logits[0],
            atol=5e-3,
            rtol=1e-3,
        )
    base = lean(model)
    for ours, theirs in zip(base.layers, plain.layers, strict=True):
        assert torch.equal(ours.qkv, theirs.qkv) and torch.equal(ours.down, theirs.down)


def test_4_bit_weights_are_unpacked_exactly(models: Any) -> None:
    from bitsandbytes.functional import dequantize_4bit

    model = load_model(resolve_candidate("Llama-3.2-1B"), device="cpu", trainable=True)
    for _name, layer in linear_4bit(model):
        assert torch.equal(
            dense_weight(layer, None)[0],
            dequantize_4bit(layer.weight.data, layer.weight.quant_state),
        )


def test_what_the_lean_pass_does_not_compute_has_no_lean_form(
    make_llama: Callable[..., Any],
) -> None:
    from peft import LoraConfig, get_peft_model
    from transformers import GPT2Config, GPT2LMHeadModel, Qwen2Config, Qwen2ForCausalLM

    sizes = {
        "hidden_size": 32,
        "intermediate_size": 64,
        "num_hidden_layers": 2,
        "num_attention_heads": 4,
        "num_key_value_heads": 2,
        "vocab_size": 64,
    }
    others = [
        GPT2LMHeadModel(GPT2Config(vocab_size=64, n_embd=32, n_layer=1, n_head=4)),
        Qwen2ForCausalLM(
            Qwen2Config(use_sliding_window=True, sliding_window=8, max_window_layers=1, **sizes)
        ),
        make_llama(hidden_act="gelu"),
        make_llama(rope_parameters={"rope_type": "dynamic", "rope_theta": 10000.0, "factor": 2.0}),
        get_peft_model(
            make_llama(), LoraConfig(r=2, target_modules=["q_proj"], use_dora=True), "mission"
        ),
    ]
    assert [LeanDecoder.of(other, "mission") for other in others] == [None] * len(others)
    with pytest.raises(NotDense):
        dense_weight(torch.nn.Embedding(2, 2), None)
