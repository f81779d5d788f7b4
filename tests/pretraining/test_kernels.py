"""Attention and loss against torch's own."""

from typing import Any

import pytest
import torch
from torch import Tensor, nn

from planner_ft.pretraining.model import (
    CAUSAL,
    ROWS,
    register_attention,
    shared_attention,
    summed_cross_entropy,
)


def gradients(result: Tensor, upstream: Tensor, *leaves: Tensor) -> list[Tensor]:
    return list(torch.autograd.grad(result, leaves, upstream))


def test_parts_of_a_row_attend_as_if_each_stood_alone_behind_what_it_shares() -> None:
    torch.manual_seed(0)
    query, key, value = (torch.randn(1, 2, 40, 16, requires_grad=True) for _ in range(3))
    parts = torch.tensor([[0, 12, 0, 0], [12, 20, 0, 12], [20, 31, 0, 12], [31, 40, 31, 31]])
    upstream = torch.randn(2, 40, 16)
    ours = shared_attention(query, key, value, parts, 0.25)
    alone = []
    for start, end, first, last in parts.tolist():
        seen = [*range(first, last), *range(start, end)]
        hidden = torch.full((end - start, len(seen)), 0.0)
        hidden[:, last - first :].masked_fill_(
            torch.ones(end - start, end - start).triu(1) > 0, -1e9
        )
        own = query[:, :, start:end], key[:, :, seen], value[:, :, seen]
        found = nn.functional.scaled_dot_product_attention(*own, attn_mask=hidden, scale=0.25)
        alone.append(found[0])
    theirs = torch.cat(alone, 1)
    torch.testing.assert_close(ours, theirs)
    for mine, reference in zip(
        gradients(ours, upstream, query, key, value),
        gradients(theirs, upstream, query, key, value),
        strict=True,
    ):
        torch.testing.assert_close(mine, reference)


def test_the_loss_and_its_gradients_are_those_of_torch() -> None:
    torch.manual_seed(0)
    hidden, weight = (
        torch.randn(ROWS + 9, 32, requires_grad=True),
        torch.randn(50, 32, requires_grad=True),
    )
    targets = torch.randint(0, 50, (ROWS + 9,))
    ours = summed_cross_entropy(hidden, weight, targets)
    theirs = nn.functional.cross_entropy(hidden @ weight.t(), targets, reduction="sum")
    assert ours.item() == pytest.approx(theirs.item(), rel=1e-3)
    # Products are bfloat16: 8 bits.
    for mine, reference in zip(
        gradients(3 * ours, torch.ones(()), hidden, weight),
        gradients(3 * theirs, torch.ones(()), hidden, weight),
        strict=True,
    ):
        torch.testing.assert_close(
            mine, reference, rtol=0, atol=0.02 * float(reference.abs().max())
        )


def test_a_model_with_this_attention_computes_what_it_computes_with_torchs() -> None:
    from transformers import LlamaConfig, LlamaForCausalLM

    register_attention()
    shape = {
        "vocab_size": 64,
        "hidden_size": 32,
        "intermediate_size": 48,
        "num_hidden_layers": 2,
        "num_attention_heads": 2,
        "num_key_value_heads": 2,
    }
    torch.manual_seed(0)
    ours: Any = LlamaForCausalLM(LlamaConfig(**shape, attn_implementation=CAUSAL)).eval()
    theirs: Any = LlamaForCausalLM(LlamaConfig(**shape, attn_implementation="sdpa")).eval()
    theirs.load_state_dict(ours.state_dict())
    ids = torch.randint(0, 64, (2, 19))
    torch.testing.assert_close(
        ours(input_ids=ids).logits, theirs(input_ids=ids).logits, rtol=1e-4, atol=1e-4
    )
