"""The model in training: adapter, loss on completion tokens, evaluation, levers on memory."""

import contextlib
from collections.abc import Iterator, Sequence
from typing import Any

import torch
from torch import Tensor, nn
from torch.utils.checkpoint import checkpoint

from planner_ft.candidates.loading import linear_4bit
from planner_ft.support.errors import PlannerError
from planner_ft.support.ranks import ALONE, Ranks
from planner_ft.training.batches import Batch, collate, validation_batches
from planner_ft.training.lean import lean_states
from planner_ft.training.samples import Sample
from planner_ft.training.settings import TrainSettings

LOGIT_VALUES = 2**24
"""Output-layer values that exist at one time: 16 million, 64 MiB in float32."""
SMALL_MODEL = 50_000_000
"""Weights below which one CPU thread is used: every small operation waits for the slower thread."""
PACKING_TYPES = ("llama", "qwen2")
UNPACKED_SHARE = 4
"""Weights are unpacked where they fit this often into the free memory."""
LARGE_MODEL = 500_000_000
"""Weights from which gradient checkpointing `auto` is on."""


def cpu_threads(settings: TrainSettings, parameters: int) -> int:
    """Threads that a run on the CPU uses."""
    return settings.threads or (1 if parameters < SMALL_MODEL else torch.get_num_threads())


def attach_adapter(model: Any, settings: TrainSettings, reference: str) -> Any:
    """A PeftModel with a new LoRA adapter in float32, which names `reference` as its base. Raises
    PlannerError when `target_modules` fits no layer.
    """
    from peft import LoraConfig, get_peft_model

    config = LoraConfig(
        r=settings.rank,
        lora_alpha=settings.lora_alpha,
        lora_dropout=settings.dropout,
        target_modules=settings.targets,
        bias="none",
        task_type="CAUSAL_LM",
    )
    parameters = model.num_parameters()
    model.requires_grad_(False)
    torch.manual_seed(settings.seed)
    try:
        peft_model = get_peft_model(model, config)
    except ValueError as error:
        reason = str(error).splitlines()[0]
        raise PlannerError(f"--target-modules {settings.target_modules}: {reason}") from None
    places = [name for name, _module in model.named_modules()]
    named = settings.targets if isinstance(settings.targets, list) else []
    if strange := [one for one in named if not any(f".{at}".endswith(f".{one}") for at in places)]:
        problem = f"the model has no module {', '.join(strange)}"
        raise PlannerError(f"--target-modules {settings.target_modules}: {problem}")
    for layer in peft_model.modules():
        # PEFT would copy every input to the adapter's float32, and autocast would copy it back.
        if hasattr(layer, "lora_A"):
            layer.cast_input_dtype_enabled = False
    peft_model.peft_config["default"].base_model_name_or_path = reference
    if uses_gradient_checkpointing(settings, parameters):
        peft_model.gradient_checkpointing_enable({"use_reentrant": False})
    return peft_model


def uses_gradient_checkpointing(settings: TrainSettings, parameters: int) -> bool:
    """Whether activations are computed again in the backward pass."""
    if settings.gradient_checkpointing == "auto":
        return parameters >= LARGE_MODEL
    return settings.gradient_checkpointing == "on"


def packs(model: Any) -> bool:
    """Whether samples may share a row, kept apart by their positions in every layer. transformers
    derives the mask from restarting positions for these attention implementations.
    """
    config = model.get_base_model().config
    return (
        config.model_type in PACKING_TYPES
        and config._attn_implementation in ("sdpa", "eager")
        and not getattr(config, "use_sliding_window", False)
    )


def adapter_parameters(model: Any) -> dict[str, nn.Parameter]:
    """The trainable weights by name."""
    return {name: value for name, value in model.named_parameters() if value.requires_grad}


def adapter_tensors(model: Any) -> dict[str, Tensor]:
    """A copy of the adapter's weights on the CPU."""
    values = adapter_parameters(model).items()
    return {name: value.detach().to("cpu", copy=True) for name, value in values}


def set_adapter(model: Any, tensors: dict[str, Tensor]) -> None:
    """Put weights from `adapter_tensors` into the model."""
    with torch.no_grad():
        for name, value in adapter_parameters(model).items():
            value.copy_(tensors[name])


@contextlib.contextmanager
def blended(model: Any, share: float) -> Iterator[None]:
    """In the block the adapter changes the base by this share of what it has learnt (WiSE-FT,
    Wortsman et al. 2022, arXiv 2109.01903).
    """
    before = adapter_tensors(model) if share != 1 else {}
    if before:
        set_adapter(model, scaled(before, share))
    try:
        yield
    finally:
        if before:
            set_adapter(model, before)


def scaled(tensors: dict[str, Tensor], share: float) -> dict[str, Tensor]:
    """Weights from `adapter_tensors` with this share of their change of the base."""
    return {name: value * share if "lora_B" in name else value for name, value in tensors.items()}


def autocast(device: torch.device, dtype: torch.dtype) -> torch.autocast:
    """Layers compute in `dtype` in the block."""
    return torch.autocast(device.type, dtype=dtype, enabled=dtype != torch.float32)


def loss_sum(model: Any, batch: Batch, dtype: torch.dtype) -> Tensor:
    """Cross-entropy summed over the batch's completion tokens, a float32 scalar. Layers compute in
    `dtype`. Logits exist for completion positions alone; the backward pass computes chunks again.
    """
    base = model.get_base_model()
    head = base.get_output_embeddings()
    places = {} if batch.positions is None else {"position_ids": batch.positions}
    with autocast(batch.input_ids.device, dtype):
        states = lean_states(model, batch.input_ids, batch.positions, batch.shared)
        if states is None:
            output = base.get_decoder()(input_ids=batch.input_ids, use_cache=False, **places)
            states = output.last_hidden_state
        selected = states[batch.rows, batch.columns]
        size = max(1, LOGIT_VALUES // base.config.get_text_config().vocab_size)
        if len(selected) <= size:
            return _cross_entropy(head, selected, batch.targets)
        chunks = zip(torch.split(selected, size), torch.split(batch.targets, size), strict=True)
        parts = [checkpoint(_cross_entropy, head, *chunk, use_reentrant=False) for chunk in chunks]
        return torch.stack(parts).sum()


def _cross_entropy(head: nn.Module, hidden: Tensor, targets: Tensor) -> Tensor:
    return nn.functional.cross_entropy(head(hidden).float(), targets, reduction="sum")


@contextlib.contextmanager
def evaluating(model: Any) -> Iterator[None]:
    """No dropout and no gradients in the block; the model trains on afterwards."""
    model.eval()
    try:
        with torch.no_grad():
            yield
    finally:
        model.train()


def validation_loss(
    model: Any,
    samples: Sequence[Sample],
    pad: int,
    device: torch.device,
    dtype: torch.dtype,
    ranks: Ranks = ALONE,
) -> float:
    """Mean cross-entropy over all completion tokens of `samples`, which all processes share."""
    found = torch.zeros(2, dtype=torch.float64)
    with evaluating(model):
        every = list(validation_batches([sample.length for sample in samples]))
        for indices in ranks.share(every):
            batch = collate([samples[index] for index in indices], pad).to(device)
            found += torch.tensor([float(loss_sum(model, batch, dtype)), len(batch.targets)])
    total, count = ranks.add_up(found).tolist()
    return float(total / count)


def add_gradients(model: Any, ranks: Ranks) -> None:
    """Put the sum over all processes in place of every gradient; those without a batch add 0."""
    weights = list(adapter_parameters(model).values())
    own = [torch.zeros_like(one) if one.grad is None else one.grad for one in weights]
    summed = ranks.add_up(torch.cat([one.flatten() for one in own]))
    sizes = [one.numel() for one in own]
    for one, gradient in zip(weights, torch.split(summed, sizes), strict=True):
        one.grad = gradient.view_as(one)


def make_optimizer(model: Any, settings: TrainSettings) -> torch.optim.Optimizer:
    """AdamW over the adapter, with 32-bit or 8-bit moments."""
    parameters, rate = list(adapter_parameters(model).values()), settings.learning_rate
    if settings.optimizer == "adamw":
        # One kernel a matrix; unfused, the update took a ninth of a small model's step.
        decay = settings.weight_decay
        return torch.optim.AdamW(parameters, lr=rate, weight_decay=decay, fused=True)
    import bitsandbytes

    name = "AdamW8bit" if settings.optimizer == "adamw-8bit" else "PagedAdamW8bit"
    kind: type[torch.optim.Optimizer] = getattr(bitsandbytes.optim, name)
    return kind(parameters, lr=rate, weight_decay=settings.weight_decay)  # type: ignore[call-arg]


def memory_levers(settings: TrainSettings, parameters: int, longest: int) -> str:
    """Changes to try, in order, when training does not fit the memory."""
    half = max(1, settings.batch_size // 2)
    more = settings.gradient_accumulation * settings.batch_size // half
    levers = {
        "store the base in 4 bits (--quantization nf4)": settings.quantization == "none",
        "--gradient-checkpointing on": not uses_gradient_checkpointing(settings, parameters),
        f"--batch-size {half} --gradient-accumulation {more} (same step, less memory)": (
            settings.batch_size > 1
        ),
        f"leave out the longest samples (now up to {longest} tokens; --max-length names those"
        " above a limit)": True,
        "--optimizer adamw-8bit": settings.optimizer == "adamw",
        f"a smaller --rank (now {settings.rank})": settings.rank > 4,
        "a smaller --candidate": True,
    }
    return "next: " + "; then ".join(lever for lever, applies in levers.items() if applies)


def unpack(model: Any) -> int:
    """Replace 4-bit layers by dense ones with the same weights if memory allows; return how many.
    bitsandbytes unpacks a layer in every pass; on a CPU at batch size 1 that takes as long as
    multiplying. Training computes with the very same numbers, in four times the memory.
    """
    import psutil

    layers = list(linear_4bit(model))
    needed = sum(2 * layer.in_features * layer.out_features for _name, layer in layers)
    if UNPACKED_SHARE * needed > psutil.virtual_memory().available:
        return 0
    for name, layer in layers:
        parent, _, own = name.rpartition(".")
        setattr(model.get_submodule(parent), own, _dense(layer))
    return len(layers)


def _dense(layer: Any) -> Any:
    """A linear layer with the weights that a 4-bit layer computes with."""
    from bitsandbytes.functional import dequantize_4bit

    weight = dequantize_4bit(layer.weight.data, layer.weight.quant_state)
    dense = nn.Linear(layer.in_features, layer.out_features, bias=False, device="meta")
    dense.weight = nn.Parameter(weight, requires_grad=False)
    if layer.bias is not None:
        dense.bias = nn.Parameter(layer.bias.data, requires_grad=False)
    return dense
