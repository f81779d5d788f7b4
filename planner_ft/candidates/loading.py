"""Loading a candidate: tokenizer and model, 4-bit or 16-bit, with or without adapters.

Only local safetensors files are read, no remote code runs and nothing is downloaded.
"""

from __future__ import annotations

import contextlib
import logging
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.adapters import check_adapter
from planner_ft.candidates.location import MODELS_VARIABLE, check_folder, read_config
from planner_ft.candidates.registry import Candidate, Quantization
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

if TYPE_CHECKING:
    import torch
    from transformers import PreTrainedModel, PreTrainedTokenizerBase

PAD_TOKENS = ("<|finetune_right_pad_id|>", "<|endoftext|>", "<pad>", "<|pad|>")
"""Special tokens that stand for padding in the published tokenizers that name none (Llama 3)."""

PACKING_ROWS = 32
"""Output features come in multiples of this in bitsandbytes' `_convert_weight_packed_for_cpu`."""
LARGE = 2**30
"""Bytes of weights from which loading takes long enough to deserve a progress bar."""


def resolve_device(device: str = "auto") -> torch.device:
    """The torch device of "auto" (CUDA if there is one, else the CPU), "cpu", "cuda", "cuda:N"."""
    import torch

    here, count = torch.cuda.is_available(), torch.cuda.device_count()
    if device == "auto":
        return torch.device("cuda", torch.cuda.current_device()) if here else torch.device("cpu")
    problem = None
    try:
        chosen = torch.device(device)
        if chosen.type not in ("cpu", "cuda"):
            problem = "only cpu and cuda are supported"
        elif chosen.type == "cuda" and not here:
            found = f"torch {torch.__version__} finds no CUDA device"
            problem = f"{found}; use --device cpu, or see `plannerft doctor`"
        elif chosen.type == "cuda" and (chosen.index or 0) >= count:
            problem = f"there are {count} CUDA devices, numbered from 0"
    except RuntimeError:
        problem = "no such device; give auto, cpu, cuda or cuda:N"
    if problem:
        raise PlannerError(f"--device {device}: {problem}")
    return chosen


def compute_dtype(device: torch.device) -> torch.dtype:
    """bfloat16 where the hardware multiplies it, else float16 on CUDA, float32 on a CPU."""
    import torch

    if device.type == "cuda":
        ampere = torch.cuda.get_device_capability(device) >= (8, 0)
        return torch.bfloat16 if ampere else torch.float16
    if not hasattr(torch.cpu, "get_capabilities"):  # torch < 2.11
        multiplies = bool(torch.cpu._is_avx512_bf16_supported())
    else:
        found = torch.cpu.get_capabilities()
        multiplies = any(found.get(name) for name in ("avx512_bf16", "amx_bf16", "bf16"))
    return torch.bfloat16 if multiplies else torch.float32


def require_folder(candidate: Candidate) -> Path:
    """The candidate's folder, checked. Raises PlannerError that says how to get a missing model."""
    if candidate.folder is None:
        named = candidate.name == candidate.repo
        nor = f", and there is no folder {candidate.name}" if named else ""
        raise PlannerError(f"{candidate.name} is not on this machine{nor}: {how_to_get(candidate)}")
    check_folder(candidate.folder)
    return candidate.folder


def how_to_get(candidate: Candidate) -> str:
    """The steps that bring the candidate onto this machine."""
    copy = f"copy it into a folder {candidate.name} of the folder that {MODELS_VARIABLE} names"
    command = download_command(candidate)
    if command is None:
        return f"this installation lacks its weights; install the package again, or {copy}"
    run = f"run `{command}` (without a network: {copy})"
    page = f"https://huggingface.co/{candidate.repo}"
    licence = f"accept its licence at {page}, run `hf auth login`, then "
    return f"{licence}{run}" if candidate.gated else run


def download_command(candidate: Candidate) -> str | None:
    """The shell command that downloads a candidate from the hub, None for one that is not there."""
    if candidate.repo is None:
        return None
    revision = f" --revision {candidate.revision}" if candidate.revision else ""
    # The Llama repositories hold the weights a second time, pickled, in original/.
    return f'hf download {candidate.repo}{revision} --exclude "original/*"'


def load_tokenizer(candidate: Candidate) -> PreTrainedTokenizerBase:
    """The candidate's tokenizer, with a padding token, padding on the left for generation."""
    import transformers

    folder = require_folder(candidate)
    named = read_config(folder, "tokenizer_config.json").get("tokenizer_class")
    # AutoTokenizer would find this class as well, and import for it what a model needs: a second.
    backend = named == "TokenizersBackend"
    kind: Any = transformers.TokenizersBackend if backend else transformers.AutoTokenizer
    try:
        tokenizer = kind.from_pretrained(folder, local_files_only=True, trust_remote_code=False)
    except Exception as error:  # tokenizers raises bare Exception for a corrupt tokenizer.json
        why = f"the tokenizer cannot be loaded ({_one_line(error)})"
        raise PlannerError(f"{folder}: {why}; download its files again") from error
    if tokenizer.pad_token is None:
        known = (token for token in PAD_TOKENS if token in tokenizer.get_vocab())
        tokenizer.pad_token = next(known, tokenizer.eos_token)
    tokenizer.padding_side = "left"
    # Prompts that the model cannot hold are refused elsewhere, without the library's notice.
    tokenizer.deprecation_warnings["sequence-length-is-longer-than-the-specified-maximum"] = True
    return tokenizer


def load_model(
    candidate: Candidate,
    *,
    device: str = "auto",
    quantization: Quantization = "nf4",
    trainable: bool = False,
    vocabulary: Vocabulary | None = None,
    adapters: Mapping[Level, Path] | None = None,
) -> PreTrainedModel:
    """The candidate's model in eval mode, to generate or, with `trainable`, to train an adapter.

    "nf4" stores linear layers as 4-bit NormalFloat with double quantisation; embeddings, output
    head and norms stay in the compute dtype, as everything does with "none". With `adapters` the
    result is a PeftModel with these on one base, named by their levels, to be changed with
    `set_adapter`; they are checked first, against `vocabulary` too where it is given. With
    `trainable` the 4-bit layers never pack (see `set_packing`). Raises PlannerError when anything
    is missing, unsafe, corrupt, of another base or too large.
    """
    target, folder = resolve_device(device), require_folder(candidate)
    for level, path in (adapters or {}).items():
        check_adapter(path, candidate, level=level, vocabulary=vocabulary)
    quiet_libraries()
    with _loading_errors(candidate, folder, target):
        model = _load_base(folder, target, quantization)
        if adapters:
            model = _attach(model, adapters)
    if quantization == "nf4":
        set_packing(model, allowed=not trainable)
    return model.eval()


def _attach(model: Any, adapters: Mapping[Level, Path]) -> Any:
    """A PeftModel with these adapters by name, the first of them active."""
    from peft import PeftModel

    first, *others = adapters.items()
    model = PeftModel.from_pretrained(model, str(first[1]), first[0], use_safetensors=True)
    for name, adapter in others:
        model.load_adapter(str(adapter), name, use_safetensors=True)
    return model


def _load_base(folder: Path, device: torch.device, quantization: Quantization) -> Any:
    import transformers
    from transformers import CONFIG_MAPPING, AutoModelForCausalLM, BitsAndBytesConfig

    if (kind := read_config(folder).get("model_type")) not in CONFIG_MAPPING:
        known = f"transformers {transformers.__version__} has no model_type {kind!r}"
        other = "update transformers, or take another model"
        never = "(code that comes with a model is never run)"
        raise PlannerError(f"{folder}/config.json: {known}; {other} {never}")
    dtype = compute_dtype(device)
    settings: dict[str, Any] = {}
    if quantization == "nf4":
        double = {"bnb_4bit_quant_type": "nf4", "bnb_4bit_use_double_quant": True}
        packed = BitsAndBytesConfig(load_in_4bit=True, bnb_4bit_compute_dtype=dtype, **double)
        settings["quantization_config"] = packed
    large = sum(path.stat().st_size for path in folder.glob("*.safetensors")) >= LARGE
    with contextlib.nullcontext() if large else quiet_bars():
        model, report = AutoModelForCausalLM.from_pretrained(
            str(folder),
            dtype=dtype,
            device_map={"": device},
            local_files_only=True,
            trust_remote_code=False,
            use_safetensors=True,
            output_loading_info=True,
            **settings,
        )
    # transformers fills missing tensors with random numbers and only warns.
    if missing := report["missing_keys"]:
        lack = f"the weights lack {len(missing)} tensors ({min(missing)}, ...)"
        raise PlannerError(f"{folder}: {lack}; download them again")
    # It compares the shapes of 16-bit tensors alone.
    for name, layer in linear_4bit(model) if quantization == "nf4" else ():
        found, expected = layer.weight.quant_state.shape, (layer.out_features, layer.in_features)
        if tuple(found) != expected:
            other = f"{list(found)}, but config.json says {list(expected)}"
            raise PlannerError(f"{folder}: {name} has the shape {other}; download both again")
    return model


@contextlib.contextmanager
def _loading_errors(candidate: Candidate, folder: Path, device: torch.device) -> Iterator[None]:
    """One sentence for a bad model, a missing library or too little memory."""
    import torch

    try:
        yield
    except PlannerError:
        raise
    except ImportError as error:
        reason = f"a library is missing ({_one_line(error)})"
        raise PlannerError(f"{candidate.name}: {reason}; see `plannerft doctor`") from error
    except Exception as error:  # the libraries raise anything, down to bare Exception
        full = isinstance(error, torch.cuda.OutOfMemoryError | MemoryError)
        if full or "allocate memory" in str(error) or "out of memory" in str(error):
            smaller = "a smaller candidate (`plannerft candidates` estimates their memory)"
            way = f"close other programs, take {smaller} or another --device"
            problem = f"{candidate.name} does not fit the memory of {device}; {way}"
            raise PlannerError(problem) from error
        why = f"the model cannot be loaded ({_one_line(error)})"
        way = "check its config.json against its weights, or download it again"
        raise PlannerError(f"{folder}: {why}; {way}") from error


def set_packing(model: torch.nn.Module, *, allowed: bool) -> int:
    """Allow or forbid CPU packing of the model's 4-bit layers; return how many layers may pack.
    Layers whose shape the packed layout cannot hold never pack (bitsandbytes would fail on them).

    bitsandbytes (0.50, `nn.Linear4bit.forward`) rewrites the weights of a 4-bit layer into a layout
    for AVX512-BF16 kernels the first time that the layer runs on a CPU in eval mode on an input
    that needs no gradient. The packed kernel has no backward pass: an adapter below such a layer
    gets a gradient that lacks the path through the frozen weights, often zero, without an error.
    Unpacking again is lossy (the block constants were rounded to bfloat16). So a model that is
    trained never packs, not even while it is evaluated. For decoding, packing is worth having: on
    one AVX512-BF16 core a 2048 x 8192 layer takes 0.8 ms a token packed and 17.6 ms unpacked (2.1
    ms in bfloat16).

    Raises PlannerError when packing is to be forbidden and a layer is packed already: load the
    model anew with `trainable=True`.
    """
    from bitsandbytes.functional import has_avx512bf16

    allowing = 0
    for name, layer in linear_4bit(model):
        if not allowed and is_packed(layer):
            why = "is already packed for decoding and would give wrong gradients"
            raise PlannerError(f"layer {name} {why}; load the model with trainable=True")
        whole = allowed and has_avx512bf16() and layer.out_features % PACKING_ROWS == 0
        fits = whole and layer.in_features % layer.weight.quant_state.blocksize == 0
        layer.support_avx512bf16_for_cpu = bool(fits)
        allowing += layer.support_avx512bf16_for_cpu
    return allowing


def linear_4bit(model: torch.nn.Module) -> list[tuple[str, Any]]:
    """Name and module of every 4-bit linear layer."""
    from bitsandbytes.nn import Linear4bit

    named = model.named_modules()
    return [(name, module) for name, module in named if isinstance(module, Linear4bit)]


def is_packed(layer: Any) -> bool:
    """Whether a 4-bit layer's weights are in the layout without a backward pass."""
    state = getattr(layer.weight, "quant_state", None)
    return bool(getattr(state, "packing_format_for_cpu", False))


def _one_line(error: BaseException) -> str:
    return (" ".join(str(error).split()) or type(error).__name__)[:200]


def quiet_libraries() -> None:
    """Silence notices of bitsandbytes and PEFT. Call it before anything imports peft."""
    # It warns that an optional package, with kernels from the hub, is not installed.
    logging.getLogger("bitsandbytes.backends.cpu.ops").setLevel(logging.ERROR)
    # PEFT asks transformers for an attribute by its former name; a user can do nothing about it.
    message = ".*is_gradient_checkpointing.*"
    warnings.filterwarnings("ignore", message=message, category=FutureWarning)


@contextlib.contextmanager
def quiet_bars() -> Iterator[None]:
    """Let transformers draw no progress bars in the block."""
    from transformers.utils import logging as bars

    enabled = bars.is_progress_bar_enabled()
    bars.disable_progress_bar()
    try:
        yield
    finally:
        if enabled:
            bars.enable_progress_bar()
