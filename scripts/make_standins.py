"""Write a stand-in of every published candidate: python scripts/make_standins.py DIR

Then `PLANNERFT_MODELS=DIR plannerft train --candidate Llama-3.2-1B ...` runs as with the real
model. Stand-ins are tiny random models with the shape of each published candidate, for tests: same
architecture class, RoPE scaling, biases, tied embeddings, special tokens, chat template, ends of
turns and file layout (standins.toml); a byte-level BPE tokenizer trained in the process. config.json marks them, so that no figure made with one passes for the real candidate's.
"""

from __future__ import annotations

import argparse
import functools
import tomllib
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.loading import quiet_bars
from planner_ft.candidates.registry import STANDIN_KEY, Candidate, all_candidates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, read_text, write_json, write_text
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import prompt_text

if TYPE_CHECKING:
    from tokenizers import Tokenizer

FAMILIES = Path(__file__).parent / "standins.toml"
SIZES = {"hidden_size": 64, "intermediate_size": 128, "num_hidden_layers": 2}
SIZES |= {"num_attention_heads": 4, "num_key_value_heads": 2}
VOCABULARY = 1024
"""Entries of a stand-in's byte-level BPE, special tokens apart."""
SPLIT = (
    r"(?i:'s|'t|'re|'ve|'m|'ll|'d)|[^\r\n\p{L}\p{N}]?\p{L}+|\p{N}{DIGITS}|"
    r" ?[^\s\p{L}\p{N}]+[\r\n]*|\s*[\r\n]+|\s+(?!\S)|\s+"
)
"""How both families split text into words; DIGITS is how many digits stay together."""


def make_all_standins(folder: Path | str, seed: int = 0) -> list[Path]:
    """Write a stand-in of every published candidate into a sub-folder; return the folders."""
    return [make_standin(candidate.name, folder, seed) for candidate in published_candidates()]


def published_candidates() -> list[Candidate]:
    """The candidates of the published study."""
    return [candidate for candidate in all_candidates() if candidate.published]


def make_standin(candidate_name: str, folder: Path | str, seed: int = 0) -> Path:
    """Write the stand-in of a published candidate; return its folder. Same seed, same weights.

    Raises PlannerError for a name that is no published candidate's.
    """
    known = {candidate.name: candidate for candidate in published_candidates()}
    if candidate_name not in known:
        raise PlannerError(f"no stand-in for {candidate_name!r}: there are {', '.join(known)}")
    candidate = known[candidate_name]
    family = "Llama" if candidate.name.startswith("Llama") else "Qwen"
    turn = "instruct" if candidate.name.endswith("-Instruct") else "base"
    target = Path(folder) / candidate.name
    ids = _write_tokenizer(family, turn, target)
    _write_model(candidate, family, turn, ids, target, seed)
    return target


@functools.cache
def _families() -> dict[str, dict[str, Any]]:
    return tomllib.loads(read_text(FAMILIES))


def _write_tokenizer(family: str, turn: str, folder: Path) -> dict[str, int]:
    """Write tokenizer.json and tokenizer_config.json; return the ids of all tokens."""
    tokenizer, values = _trained_tokenizer(family), _families()[family]
    write_text(folder / "tokenizer.json", tokenizer.to_str(pretty=False))
    plain = dict.fromkeys(("lstrip", "normalized", "rstrip", "single_word"), False)
    settings: dict[str, Any] = {
        "tokenizer_class": values["tokenizer_class"],
        "bos_token": values.get("bos"),
        "eos_token": values[turn]["tokenizer_eos"],
        "pad_token": values.get("pad"),
        "model_max_length": 131072,
        "clean_up_tokenization_spaces": False,
        "added_tokens_decoder": {
            str(tokenizer.token_to_id(token)): {"content": token, **plain, "special": True}
            for token in values["special"]
        },
    }
    if "template" in values[turn]:
        settings["chat_template"] = values[turn]["template"]
    write_json(folder / "tokenizer_config.json", settings)
    ids: dict[str, int] = tokenizer.get_vocab()
    return ids


@functools.cache
def _trained_tokenizer(family: str) -> Tokenizer:
    """A byte-level BPE tokenizer as the family's, special tokens behind the others."""
    from tokenizers import (
        AddedToken,
        Regex,
        Tokenizer,
        decoders,
        models,
        normalizers,
        processors,
        trainers,
    )
    from tokenizers import pre_tokenizers as pre

    values = _families()[family]
    digits = "{1,3}" if values["digits"] == 3 else ""
    split = pre.Split(Regex(SPLIT.replace("{DIGITS}", digits)), behavior="isolated")
    tokenizer = Tokenizer(models.BPE(ignore_merges=family == "Llama"))
    if family == "Qwen":
        tokenizer.normalizer = normalizers.NFC()
    byte_level = pre.ByteLevel(add_prefix_space=False, use_regex=False)
    tokenizer.pre_tokenizer = pre.Sequence([split, byte_level])
    tokenizer.decoder = decoders.ByteLevel()
    trainer = trainers.BpeTrainer(
        vocab_size=VOCABULARY, initial_alphabet=pre.ByteLevel.alphabet(), show_progress=False
    )
    tokenizer.train_from_iterator(_training_text(), trainer)
    special = [AddedToken(token, normalized=False, special=True) for token in values["special"]]
    tokenizer.add_special_tokens(special)
    tokenizer.post_processor = processors.ByteLevel(trim_offsets=False)
    if bos := values.get("bos"):
        both = processors.TemplateProcessing(
            f"{bos} $A", f"{bos} $A {bos}:1 $B:1", [(bos, tokenizer.token_to_id(bos))]
        )
        tokenizer.post_processor = processors.Sequence([tokenizer.post_processor, both])
    return tokenizer


def _training_text() -> list[str]:
    """Text of both prompts and of plans' JSON, from the bundled vocabulary."""
    vocabulary = load_vocabulary()
    texts = [prompt_text("mission", vocabulary), prompt_text("task", vocabulary)]
    for task in vocabulary.tasks:
        places = {name: [12.5, -40.0] for name in task.by_name}
        prompt = f"{task.description} at [12.5, -40.0]."
        planned = {"title": task.title, "parameters": places, "task_prompt": prompt}
        texts.append(compact_json({"tasks": [planned], "assumptions": [], "constraints": []}))
    for skill in vocabulary.skills:
        call = {"name": skill.name, "parameters": dict.fromkeys(skill.by_name, 25)}
        step: dict[str, Any] = {
            "navigation_skill": call,
            "filter_skills": [],
            "perception_skills": [],
        }
        words = {"stop_conditions": skill.stop, "failure_modes": skill.failure}
        words["expected_outputs"] = skill.output
        step |= {key: [value] for key, value in words.items()}
        texts.append(compact_json({"skill_sequence": [step]}))
    return texts


def _write_model(
    candidate: Candidate, family: str, turn: str, ids: dict[str, int], folder: Path, seed: int
) -> None:
    """Write config.json, generation_config.json and model.safetensors in bfloat16."""
    import torch
    import transformers

    values = _families()[family]
    model_class = getattr(transformers, values["architecture"])
    end = [ids[token] for token in values[turn]["eos"]]
    ends: dict[str, Any] = {"bos_token_id": ids[values.get("bos", "<|endoftext|>")]}
    ends["eos_token_id"] = end if len(end) > 1 else end[0]
    shape = SIZES | _architecture(candidate, values) | ends
    config = model_class.config_class(vocab_size=max(ids.values()) + 1, **shape)
    setattr(config, STANDIN_KEY, True)
    with torch.random.fork_rng(devices=[]):
        torch.manual_seed(seed)
        model = model_class(config).to(torch.bfloat16)
    sampling = {name: values[name] for name in ("temperature", "top_p")}
    pad = ids[values["pad"]] if "pad" in values else None
    model.generation_config = transformers.GenerationConfig(
        **ends, **sampling, pad_token_id=pad, do_sample=True
    )
    with quiet_bars():
        model.save_pretrained(folder)


def _architecture(candidate: Candidate, family: dict[str, Any]) -> dict[str, Any]:
    """Settings of the published config.json that do not depend on the size."""
    if candidate.dimensions is None:
        raise PlannerError(f"no stand-in for {candidate.name}: the registry has no dimensions")
    rope = dict(family["rope"])
    if candidate.name.startswith("Llama-3.2"):
        rope["factor"] = 32.0
    sizes = candidate.dimensions
    shape = {"tie_word_embeddings": sizes.tied, "max_position_embeddings": sizes.context}
    return {**shape, **family["config"], "rope_parameters": rope}


if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="DIR", help="where to write the seven folders")
    parser.add_argument("--seed", type=int, default=0, help="of the random weights (default 0)")
    arguments = parser.parse_args()
    for path in make_all_standins(arguments.folder, arguments.seed):
        print(path)
