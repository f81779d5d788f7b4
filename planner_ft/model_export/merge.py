"""Folding a LoRA adapter into the weights, in full precision."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, loading
from planner_ft.candidates.adapters import check_adapter
from planner_ft.candidates.registry import VOCABULARY_KEY
from planner_ft.prompts.render import save_tokenizer
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

LOCAL = {"local_files_only": True, "trust_remote_code": False, "use_safetensors": True}


def load_full(
    candidate: Candidate, adapter: Path | None, level: Level, vocabulary: Vocabulary
) -> Any:
    """The model in float32 on the CPU, an adapter beside its weights. Raises PlannerError."""
    import torch
    from transformers import AutoModelForCausalLM

    folder = loading.require_folder(candidate)
    if adapter is not None:
        check_adapter(adapter, candidate, level=level, vocabulary=vocabulary)
    loading.quiet_libraries()
    try:
        with loading.quiet_bars():
            options = {**LOCAL, "dtype": torch.float32}
            model = AutoModelForCausalLM.from_pretrained(str(folder), **options)
            if adapter is not None:
                from peft import PeftModel

                model = PeftModel.from_pretrained(model, str(adapter), use_safetensors=True)
    except MemoryError as error:
        way = "close other programs, or export on a larger machine"
        raise PlannerError(f"{candidate.name} does not fit the memory in float32; {way}") from error
    except (OSError, ValueError, RuntimeError) as error:
        why = f"the model cannot be loaded ({' '.join(str(error).split())[:200]})"
        raise PlannerError(f"{folder}: {why}; check its files") from error
    return model.eval()


def merged(model: Any) -> Any:
    """The model with its adapter, if any, folded in: W + alpha / r * B A. Raises PlannerError."""
    if not hasattr(model, "merge_and_unload"):
        return model
    try:
        return model.merge_and_unload(safe_merge=True)
    except ValueError as error:  # PEFT refuses weights that are no numbers
        raise PlannerError(f"the adapter cannot be merged ({error}); train it again") from error


def save_full(model: Any, candidate: Candidate, learned: Vocabulary | None, folder: Path) -> None:
    """Write weights, tokenizer, chat template and generation settings as a transformers folder.
    `learned` is the vocabulary that the model knows without a prompt; config.json names it, so that
    the benchmark does not put it into prompts.
    """
    with loading.quiet_bars():
        model.save_pretrained(str(folder), safe_serialization=True)
    config = folder / "config.json"
    for path in folder.glob("*.safetensors"):  # written readable for their owner alone
        path.chmod(config.stat().st_mode)
    save_tokenizer(loading.load_tokenizer(candidate), model, folder)
    if learned is not None and _is_bundled(learned):
        write_json(config, {**read_json(config), VOCABULARY_KEY: learned.name})


def _is_bundled(vocabulary: Vocabulary) -> bool:
    try:
        return load_vocabulary(vocabulary.name).sha256 == vocabulary.sha256
    except PlannerError:
        return False
