"""Estimated memory and time to train an adapter and to answer, from a model's dimensions: never a
measurement.

Memory, in bytes: NF4 with double quantisation stores 4 + 8/64 + 32/(64*256) = 4.127 bits a weight
(Dettmers et al., "QLoRA", 2023, section 3). Adam keeps two float32 moments a trainable weight. The
tensors that a block keeps for the backward pass were counted with autograd's saved-tensor hooks on
a 4-bit Llama and Qwen2 with adapters; a test repeats it. The estimates are for one GPU without
fragmentation; training and `bench` report the memory that they used.

Answers: the study's own latencies with an adapter, divided by tokens and blocks, are 1.41 to 1.47
ms for all seven candidates, whatever the width: a block's many small kernels are started one by
one. Training: a pass through a block takes that long at least, else its multiplications and the
unpacking of its 4-bit weights on the study's GPU (NVIDIA's Ada white paper). A frozen weight is
multiplied twice a step, forwards and backwards, and a third time with gradient checkpointing.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.registry import Candidate, Dimensions, Quantization

if TYPE_CHECKING:
    import torch

GIB = 2**30
RUNTIME = GIB // 2
"""A CUDA context with cuBLAS and bitsandbytes workspaces (measured: 0.3 to 0.6 GiB)."""
NF4_BITS = 4 + 8 / 64 + 32 / (64 * 256)
TRAIN_GPU_GIB, BOARD_GPU_GIB = 12, 6
"""The published reference hardware: training on 12 GB, inference on board on 6 GB."""
TRAIN_TOKENS, INFER_TOKENS = 1024, 2048
"""Assumed lengths: a training sample without the vocabulary; prompt with vocabulary and answer."""
RANK = 16
"""The larger of the published LoRA ranks."""


@dataclass(frozen=True)
class MemoryEstimate:
    """Bytes by purpose; 0 where a use does not need it.

    Weights: linear layers (4-bit or 16-bit), embeddings, output head, norms. Adapter: LoRA matrices
    in float32, as PEFT keeps them. Optimizer: their gradients and Adam's moments. Activations:
    values kept for the backward pass, or the prefill's widest layer. Cache: keys and values of the
    context, 16-bit. Logits: values of the output layer, in training with the loss's intermediate
    ones. Workspace: the largest layer in 16 bits while it is dequantised, and the CUDA runtime.
    """

    weights: int
    adapter: int
    optimizer: int
    activations: int
    cache: int
    logits: int
    workspace: int

    @property
    def total(self) -> int:
        return sum(astuple(self))

    def fits(self, gib: float) -> bool:
        """Whether the total stays within a GPU of `gib` GiB."""
        return self.total <= gib * GIB


def stored_weights(dimensions: Dimensions, quantization: Quantization = "nf4") -> int:
    """Bytes of the weights in memory; all but the blocks' linear layers take 16 bits."""
    linear = dimensions.linear_parameters * (NF4_BITS if quantization == "nf4" else 16) / 8
    return round(linear) + 2 * dimensions.other_parameters


def adapter_parameters(dimensions: Dimensions, rank: int = RANK) -> int:
    """Weights of LoRA pairs on every linear layer: rank * (in + out) each (Hu et al., 2021)."""
    return dimensions.layers * rank * sum(map(sum, dimensions.linear_shapes))


def block_activations(dimensions: Dimensions, rank: int = RANK, *, dropout: bool = False) -> int:
    """Bytes a token that a block keeps for the backward pass, with LoRA on its seven linear layers.
    The two norms keep their input in float32 (8 hidden). Every LoRA pair keeps its input in float32
    (4 in) and its inner value (4 rank); with dropout also a mask (1 in). Attention keeps query,
    key, value and output, the gated MLP three values of its width, all in 16 bits.
    """
    inputs = sum(rows for rows, _ in dimensions.linear_shapes)
    heads = (dimensions.heads + dimensions.kv_heads) * dimensions.head_dim
    pairs = (5 if dropout else 4) * inputs + 4 * rank * len(dimensions.linear_shapes)
    return 8 * dimensions.hidden + pairs + 4 * heads + 6 * dimensions.intermediate


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
    """Memory to train an adapter with Adam on `batch` samples of `tokens` tokens. With gradient
    checkpointing a block keeps its 16-bit input alone and one block at a time is computed again.
    The logits take 12 bytes each at the peak: 16-bit values, float32 log-softmax, and the gradient
    of both.
    """
    adapter = 4 * adapter_parameters(dimensions, rank)
    block, layers = block_activations(dimensions, rank, dropout=dropout), dimensions.layers
    kept = layers * 2 * dimensions.hidden + block if checkpointing else layers * block
    weights = stored_weights(dimensions, quantization)
    logits = 12 * batch * tokens * dimensions.vocabulary
    used = (adapter, 3 * adapter, batch * tokens * kept, 0, logits)
    return MemoryEstimate(weights, *used, _workspace(dimensions, quantization))


def inference_memory(dimensions: Dimensions, rank: int = RANK, batch: int = 1) -> MemoryEstimate:
    """Memory to generate with one adapter on 4-bit weights, INFER_TOKENS a sequence."""
    tokens = INFER_TOKENS
    widest = 4 * (dimensions.intermediate + dimensions.hidden)
    keys = dimensions.layers * dimensions.kv_heads * dimensions.head_dim
    weights = stored_weights(dimensions)
    adapter, logits = 4 * adapter_parameters(dimensions, rank), 4 * batch * dimensions.vocabulary
    used = (adapter, 0, batch * tokens * widest, 4 * batch * tokens * keys, logits)
    return MemoryEstimate(weights, *used, _workspace(dimensions, "nf4"))


def _workspace(dimensions: Dimensions, quantization: Quantization) -> int:
    largest = max(rows * columns for rows, columns in dimensions.linear_shapes)
    return RUNTIME + (2 * largest if quantization == "nf4" else 0)


def memory_summary(candidate: Candidate) -> dict[str, Any] | None:
    """GiB to train and to generate, and whether they fit the reference GPUs; None: unknown."""
    dimensions = candidate.dimensions
    if dimensions is None:
        return None
    rank = max([RANK, *(settings.get("rank", 0) for settings in candidate.adapter.values())])
    train = training_memory(dimensions, rank=rank)
    saving = training_memory(dimensions, rank=rank, checkpointing=True)
    infer = inference_memory(dimensions, rank=rank)

    def trains(gib: int) -> str:
        return "yes" if train.fits(gib) else "checkpointing" if saving.fits(gib) else "no"

    gpus = (BOARD_GPU_GIB, TRAIN_GPU_GIB)
    return {
        "train_gib": round(train.total / GIB, 2),
        "train_checkpointing_gib": round(saving.total / GIB, 2),
        "infer_gib": round(infer.total / GIB, 2),
        "train_fits": {f"{gib} GB": trains(gib) for gib in gpus},
        "infer_fits": {f"{gib} GB": "yes" if infer.fits(gib) else "no" for gib in gpus},
    }


def device_memory(device: torch.device) -> tuple[int, int]:
    """Free and total memory of a device in bytes."""
    if device.type == "cuda":
        import torch

        free, total = torch.cuda.mem_get_info(device)
        return free, total
    import psutil

    memory = psutil.virtual_memory()
    return int(memory.available), int(memory.total)


GPU = "RTX 4070"
BLOCK_SECONDS = 1.43e-3
"""Of one token or one short pass, with an adapter; the seven published latencies."""
OPERATIONS, BANDWIDTH = 58.3e12, 504e9
"""Of the GPU: 16-bit tensor operations with 32-bit sums, and bytes, a second."""
EFFICIENCY = 0.4
"""Share of the operations that short samples reach; an assumption."""
PASSES = 3
ANSWER_TOKENS = 150
"""Of a curated mission plan: 467 characters at 3.2 a token."""


RUNS = {"mission": (125, 5, 270), "task": (10_000, 2, 420)}
"""Samples of the published training sets, passes over them, tokens of a sample (ours)."""


def expected_times(candidate: Candidate) -> dict[str, Any] | None:
    """Estimated seconds of the published trainings and of an answer; None: dimensions unknown."""
    dimensions = candidate.dimensions
    if dimensions is None:
        return None
    weights = dimensions.linear_parameters / dimensions.layers
    # Read packed, written unpacked, read again by the product.
    unpacking = weights * (NF4_BITS / 8 + 2 + 2) / BANDWIDTH

    def training(level: str) -> int:
        samples, epochs, tokens = RUNS[level]
        product = 2 * weights * tokens / (EFFICIENCY * OPERATIONS)
        step = PASSES * dimensions.layers * max(BLOCK_SECONDS, product + unpacking)
        return round(samples * epochs * step)

    answer = round(ANSWER_TOKENS * dimensions.layers * BLOCK_SECONDS, 1)
    return {"gpu": GPU, **{f"train_{of}_s": training(of) for of in RUNS}, "answer_s": answer}
