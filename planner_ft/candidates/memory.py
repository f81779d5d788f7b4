"""Estimated memory to train an adapter and to generate, in bytes, from a model's dimensions.

Sources: NF4 with double quantisation stores 4 + 8/64 + 32/(64*256) = 4.127 bits a weight (Dettmers
et al., "QLoRA", 2023, section 3). Adam keeps two float32 moments a trainable weight. What a block
keeps for the backward pass was counted with autograd's saved-tensor hooks on a 4-bit Llama and
Qwen2 with adapters (see `block_activations`); a test repeats it. The estimates are for one GPU and
leave out fragmentation; the preflight of a training run and `bench` report what was used.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from planner_ft.candidates.registry import Dimensions, Quantization

GIB = 2**30
RUNTIME = GIB // 2
"""What a CUDA context with cuBLAS and bitsandbytes workspaces takes (measured values lie between
0.3 and 0.6 GiB).
"""
NF4_BITS = 4 + 8 / 64 + 32 / (64 * 256)
TRAIN_GPU_GIB, BOARD_GPU_GIB = 12, 6
"""The published reference hardware: training on 12 GB, inference on board on 6 GB."""
TRAIN_TOKENS, INFER_TOKENS = 1024, 2048
"""Assumed lengths: a training sample without the vocabulary; a prompt with the vocabulary and its
answer.
"""
RANK = 16
"""The larger of the published LoRA ranks."""


@dataclass(frozen=True)
class MemoryEstimate:
    """Bytes by what takes them. What a use does not need is 0."""

    weights: int
    """Linear layers (4-bit or 16-bit), embeddings, output head, norms."""
    adapter: int
    """LoRA matrices in float32, as PEFT keeps them."""
    optimizer: int
    """Gradients and Adam's moments of the LoRA matrices, float32."""
    activations: int
    """What the backward pass needs, or the prefill's widest layer."""
    cache: int
    """Keys and values of the context, 16-bit."""
    logits: int
    """The output layer's values and, in training, what the loss makes of them."""
    workspace: int
    """The largest layer in 16 bits, while it is dequantised, and the CUDA runtime."""

    @property
    def total(self) -> int:
        return sum(int(getattr(self, item.name)) for item in fields(self))

    def fits(self, gib: float) -> bool:
        """Whether the total stays within a GPU of `gib` GiB."""
        return self.total <= gib * GIB


def stored_weights(dimensions: Dimensions, quantization: Quantization = "nf4") -> int:
    """Bytes of the model's weights as they lie in memory; what is not a block's linear layer takes
    16 bits.
    """
    linear = dimensions.linear_parameters * (NF4_BITS if quantization == "nf4" else 16) / 8
    return round(linear) + 2 * dimensions.other_parameters


def adapter_parameters(dimensions: Dimensions, rank: int = RANK) -> int:
    """Weights of LoRA pairs on every linear layer of every block: rank * (in + out) each (Hu et
    al., 2021).
    """
    return (
        dimensions.layers * rank * sum(rows + columns for rows, columns in dimensions.linear_shapes)
    )


def block_activations(dimensions: Dimensions, rank: int = RANK, *, dropout: bool = False) -> int:
    """Bytes a token that one block keeps for the backward pass, with LoRA on its seven linear
    layers.

    The two norms keep their input in float32 (8 hidden). Every LoRA pair keeps its input in float32
    (4 in) and its inner value (4 rank); with dropout also a mask (1 in). Attention keeps query,
    key, value and output, the gated MLP three values of its width, all in 16 bits.
    """
    inputs = sum(rows for rows, _ in dimensions.linear_shapes)
    query, key = dimensions.heads * dimensions.head_dim, dimensions.kv_heads * dimensions.head_dim
    pairs = (5 if dropout else 4) * inputs + 4 * rank * len(dimensions.linear_shapes)
    return (
        8 * dimensions.hidden + pairs + 2 * (2 * query + 2 * key) + 2 * 3 * dimensions.intermediate
    )


def training_memory(
    dimensions: Dimensions,
    *,
    quantization: Quantization = "nf4",
    rank: int = RANK,
    tokens: int = TRAIN_TOKENS,
    batch: int = 1,
    dropout: bool = False,
    checkpointing: bool = False,
) -> MemoryEstimate:
    """Memory to train an adapter with Adam on `batch` samples of `tokens` tokens.

    With gradient checkpointing a block keeps its 16-bit input alone and one block at a time is
    computed again. Of the logits there are at the peak: 16-bit values, float32 log-softmax, and the
    gradient of both: 12 bytes each.
    """
    trained = adapter_parameters(dimensions, rank)
    block = block_activations(dimensions, rank, dropout=dropout)
    kept = (
        dimensions.layers * 2 * dimensions.hidden + block
        if checkpointing
        else dimensions.layers * block
    )
    return MemoryEstimate(
        weights=stored_weights(dimensions, quantization),
        adapter=4 * trained,
        optimizer=12 * trained,
        activations=batch * tokens * kept,
        cache=0,
        logits=12 * batch * tokens * dimensions.vocabulary,
        workspace=_workspace(dimensions, quantization),
    )


def inference_memory(
    dimensions: Dimensions,
    *,
    quantization: Quantization = "nf4",
    rank: int = RANK,
    tokens: int = INFER_TOKENS,
    batch: int = 1,
) -> MemoryEstimate:
    """Memory to generate with one adapter, `tokens` of prompt and answer together in each of
    `batch` sequences.
    """
    widest = 2 * (2 * dimensions.intermediate + 2 * dimensions.hidden)
    return MemoryEstimate(
        weights=stored_weights(dimensions, quantization),
        adapter=4 * adapter_parameters(dimensions, rank),
        optimizer=0,
        activations=batch * tokens * widest,
        cache=2
        * 2
        * batch
        * tokens
        * dimensions.layers
        * dimensions.kv_heads
        * dimensions.head_dim,
        logits=4 * batch * dimensions.vocabulary,
        workspace=_workspace(dimensions, quantization),
    )


def _workspace(dimensions: Dimensions, quantization: Quantization) -> int:
    largest = max(rows * columns for rows, columns in dimensions.linear_shapes)
    return RUNTIME + (2 * largest if quantization == "nf4" else 0)
