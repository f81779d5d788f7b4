"""Stand-ins: tiny, randomly initialised models with the shape of each published candidate, for
tests and rehearsals.

Same architecture class, RoPE scaling, biases, tied embeddings, special tokens, chat template,
end-of-turn tokens and file layout; a byte-level BPE tokenizer trained in the process. config.json
marks them, so that no figure made with one passes for the real candidate's.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.libraries import quiet_bars
from planner_ft.candidates.registry import STANDIN_KEY, Candidate, all_candidates
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, write_json, write_text
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.text import prompt_text

if TYPE_CHECKING:
    from tokenizers import Tokenizer

HIDDEN, INTERMEDIATE, LAYERS, HEADS, KV_HEADS, HEAD_DIM = 64, 128, 2, 4, 2, 16
VOCABULARY = 1024
"""Entries of a stand-in's byte-level BPE, special tokens apart."""

LLAMA_SPLIT = (
    r"(?i:'s|'t|'re|'ve|'m|'ll|'d)|[^\r\n\p{L}\p{N}]?\p{L}+|\p{N}{1,3}|"
    r" ?[^\s\p{L}\p{N}]+[\r\n]*|\s*[\r\n]+|\s+(?!\S)|\s+"
)
QWEN_SPLIT = LLAMA_SPLIT.replace(r"\p{N}{1,3}", r"\p{N}")
LLAMA_SPECIAL = (
    "<|begin_of_text|>",
    "<|end_of_text|>",
    "<|reserved_special_token_0|>",
    "<|reserved_special_token_1|>",
    "<|finetune_right_pad_id|>",
    "<|reserved_special_token_2|>",
    "<|start_header_id|>",
    "<|end_header_id|>",
    "<|eom_id|>",
    "<|eot_id|>",
    "<|python_tag|>",
)
"""The first special tokens of Llama 3, in the order of their ids (128000 to 128010)."""
QWEN_SPECIAL = ("<|endoftext|>", "<|im_start|>", "<|im_end|>")
"""The first special tokens of Qwen2.5, in the order of their ids (151643 to 151645)."""

LLAMA_TEMPLATE = """\
{{- bos_token }}
{%- if messages[0]['role'] == 'system' %}
    {%- set system_message = messages[0]['content']|trim %}
    {%- set messages = messages[1:] %}
{%- else %}
    {%- set system_message = "" %}
{%- endif %}
{%- if not date_string is defined %}
    {%- if strftime_now is defined %}
        {%- set date_string = strftime_now("%d %b %Y") %}
    {%- else %}
        {%- set date_string = "26 Jul 2024" %}
    {%- endif %}
{%- endif %}
{{- "<|start_header_id|>system<|end_header_id|>\\n\\n" }}
{{- "Cutting Knowledge Date: December 2023\\n" }}
{{- "Today Date: " + date_string + "\\n\\n" }}
{{- system_message }}
{{- "<|eot_id|>" }}
{%- for message in messages %}
    {{- '<|start_header_id|>' + message['role'] + '<|end_header_id|>\\n\\n' + message['content']|trim + '<|eot_id|>' }}
{%- endfor %}
{%- if add_generation_prompt %}
    {{- '<|start_header_id|>assistant<|end_header_id|>\\n\\n' }}
{%- endif %}
"""
CHATML_TEMPLATE = """\
{%%- if messages[0]['role'] != 'system' %%}
    {{- '<|im_start|>system\\n%s<|im_end|>\\n' }}
{%%- endif %%}
{%%- for message in messages %%}
    {{- '<|im_start|>' + message['role'] + '\\n' + message['content'] + '<|im_end|>' + '\\n' }}
{%%- endfor %%}
{%%- if add_generation_prompt %%}
    {{- '<|im_start|>assistant\\n' }}
{%%- endif %%}
"""


@dataclass(frozen=True)
class Family:
    """What the stand-ins of one model family have in common.

    `instruct_eos` lists the end tokens of the instruct model's generation configuration, `base_eos`
    the base model's.
    """

    architecture: str
    tokenizer_class: str
    split: str
    special: tuple[str, ...]
    bos: str | None
    pad: str | None
    base_eos: tuple[str, ...]
    instruct_eos: tuple[str, ...]
    tokenizer_eos: tuple[str, str]
    """End token of the base and of the instruct tokenizer."""
    templates: tuple[str | None, str]
    """Chat template of the base and of the instruct tokenizer."""


LLAMA = Family(
    architecture="LlamaForCausalLM",
    tokenizer_class="PreTrainedTokenizerFast",
    split=LLAMA_SPLIT,
    special=LLAMA_SPECIAL,
    bos="<|begin_of_text|>",
    pad=None,
    base_eos=("<|end_of_text|>",),
    instruct_eos=("<|end_of_text|>", "<|eom_id|>", "<|eot_id|>"),
    tokenizer_eos=("<|end_of_text|>", "<|eot_id|>"),
    templates=(None, LLAMA_TEMPLATE),
)
QWEN = Family(
    architecture="Qwen2ForCausalLM",
    tokenizer_class="Qwen2Tokenizer",
    split=QWEN_SPLIT,
    special=QWEN_SPECIAL,
    bos=None,
    pad="<|endoftext|>",
    base_eos=("<|endoftext|>",),
    instruct_eos=("<|im_end|>", "<|endoftext|>"),
    tokenizer_eos=("<|endoftext|>", "<|im_end|>"),
    templates=(
        CHATML_TEMPLATE % "You are a helpful assistant.",
        CHATML_TEMPLATE % "You are Qwen, created by Alibaba Cloud. You are a helpful assistant.",
    ),
)


def make_all_standins(folder: Path | str, seed: int = 0) -> list[Path]:
    """Write a stand-in of every published candidate into a sub-folder of its name; return the
    folders.
    """
    return [make_standin(candidate.name, folder, seed) for candidate in published_candidates()]


def published_candidates() -> list[Candidate]:
    """The candidates of the published study."""
    return [candidate for candidate in all_candidates() if candidate.published]


def make_standin(candidate_name: str, folder: Path | str, seed: int = 0) -> Path:
    """Write the stand-in of a published candidate into `folder`/`candidate_name`; return that
    folder.

    Same seed, same weights. Raises PlannerError for a name that is no published candidate's.
    """
    candidate = next(
        (candidate for candidate in published_candidates() if candidate.name == candidate_name),
        None,
    )
    if candidate is None:
        raise PlannerError(
            f"no stand-in for {candidate_name!r}: there are"
            f" {', '.join(candidate.name for candidate in published_candidates())}"
        )
    family = LLAMA if candidate.name.startswith("Llama") else QWEN
    instruct = candidate.name.endswith("-Instruct")
    target = Path(folder) / candidate.name
    ids = _write_tokenizer(family, instruct, target)
    _write_model(candidate, family, instruct, ids, target, seed)
    return target


def _write_tokenizer(family: Family, instruct: bool, folder: Path) -> dict[str, int]:
    """Write tokenizer.json and tokenizer_config.json; return the ids of all tokens."""
    tokenizer = _trained_tokenizer(family)
    write_text(folder / "tokenizer.json", tokenizer.to_str(pretty=False))
    settings: dict[str, Any] = {
        "tokenizer_class": family.tokenizer_class,
        "bos_token": family.bos,
        "eos_token": family.tokenizer_eos[instruct],
        "pad_token": family.pad,
        "model_max_length": 131072,
        "clean_up_tokenization_spaces": False,
        "added_tokens_decoder": {
            str(tokenizer.token_to_id(token)): {
                "content": token,
                "lstrip": False,
                "normalized": False,
                "rstrip": False,
                "single_word": False,
                "special": True,
            }
            for token in family.special
        },
    }
    template = family.templates[instruct]
    if template:
        settings["chat_template"] = template
    write_json(folder / "tokenizer_config.json", settings)
    ids: dict[str, int] = tokenizer.get_vocab()
    return ids


@functools.cache
def _trained_tokenizer(family: Family) -> Tokenizer:
    """A byte-level BPE tokenizer as the family's, trained on the vocabulary's text; special tokens
    follow the others.
    """
    from tokenizers import (
        AddedToken,
        Regex,
        Tokenizer,
        decoders,
        models,
        normalizers,
        pre_tokenizers,
        processors,
        trainers,
    )

    tokenizer = Tokenizer(models.BPE(ignore_merges=family is LLAMA))
    if family is QWEN:
        tokenizer.normalizer = normalizers.NFC()
    tokenizer.pre_tokenizer = pre_tokenizers.Sequence(
        [
            pre_tokenizers.Split(Regex(family.split), behavior="isolated"),
            pre_tokenizers.ByteLevel(add_prefix_space=False, use_regex=False),
        ]
    )
    tokenizer.decoder = decoders.ByteLevel()
    trainer = trainers.BpeTrainer(
        vocab_size=VOCABULARY,
        initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
        show_progress=False,
    )
    tokenizer.train_from_iterator(_training_text(), trainer)
    tokenizer.add_special_tokens(
        [AddedToken(token, normalized=False, special=True) for token in family.special]
    )
    if family.bos:
        bos = processors.TemplateProcessing(
            f"{family.bos} $A",
            f"{family.bos} $A {family.bos}:1 $B:1",
            [(family.bos, tokenizer.token_to_id(family.bos))],
        )
        tokenizer.post_processor = processors.Sequence(
            [processors.ByteLevel(trim_offsets=False), bos]
        )
    else:
        tokenizer.post_processor = processors.ByteLevel(trim_offsets=False)
    return tokenizer


def _training_text() -> list[str]:
    """Text of both prompts and of plans' JSON, from the bundled vocabulary."""
    vocabulary = load_vocabulary()
    tasks = [
        {
            "title": task.title,
            "parameters": {name: [12.5, -40.0] for name in task.by_name},
            "task_prompt": f"{task.description} at [12.5, -40.0].",
        }
        for task in vocabulary.tasks
    ]
    steps = [
        {
            "navigation_skill": {
                "name": skill.name,
                "parameters": dict.fromkeys(skill.by_name, 25),
            },
            "filter_skills": [],
            "perception_skills": [],
            "stop_conditions": [skill.stop],
            "failure_modes": [skill.failure],
            "expected_outputs": [skill.output],
        }
        for skill in vocabulary.skills
    ]
    missions = [
        compact_json({"tasks": [task], "assumptions": [], "constraints": []}) for task in tasks
    ]
    sequences = [compact_json({"skill_sequence": [step]}) for step in steps]
    return [
        prompt_text("mission", vocabulary),
        prompt_text("task", vocabulary),
        *missions,
        *sequences,
    ]


def _write_model(
    candidate: Candidate,
    family: Family,
    instruct: bool,
    ids: dict[str, int],
    folder: Path,
    seed: int,
) -> None:
    """Write config.json, generation_config.json and model.safetensors of a randomly initialised
    model in bfloat16.
    """
    import torch
    import transformers

    model_class = getattr(transformers, family.architecture)
    end = [ids[token] for token in (family.instruct_eos if instruct else family.base_eos)]
    eos: int | list[int] = end if len(end) > 1 else end[0]
    config = model_class.config_class(
        hidden_size=HIDDEN,
        intermediate_size=INTERMEDIATE,
        num_hidden_layers=LAYERS,
        num_attention_heads=HEADS,
        num_key_value_heads=KV_HEADS,
        vocab_size=max(ids.values()) + 1,
        bos_token_id=ids[family.bos] if family.bos else ids["<|endoftext|>"],
        eos_token_id=eos,
        **_architecture(candidate, family),
        **{STANDIN_KEY: True},
    )
    state = torch.random.get_rng_state()
    try:
        torch.manual_seed(seed)
        model = model_class(config).to(torch.bfloat16)
    finally:
        torch.random.set_rng_state(state)
    model.generation_config = transformers.GenerationConfig(
        bos_token_id=config.bos_token_id,
        eos_token_id=eos,
        pad_token_id=ids[family.pad] if family.pad else None,
        do_sample=True,
        temperature=0.6 if family is LLAMA else 0.7,
        top_p=0.9 if family is LLAMA else 0.8,
    )
    with quiet_bars():
        model.save_pretrained(folder)


def _architecture(candidate: Candidate, family: Family) -> dict[str, Any]:
    """Settings that the published config.json has and that do not depend on the size."""
    if candidate.dimensions is None:
        raise PlannerError(
            f"no stand-in for {candidate.name}: the registry has no dimensions for it"
        )
    common = {
        "tie_word_embeddings": candidate.dimensions.tied,
        "max_position_embeddings": candidate.dimensions.context,
    }
    if family is QWEN:
        return {
            **common,
            "rms_norm_eps": 1e-6,
            "rope_parameters": {"rope_type": "default", "rope_theta": 1e6},
        }
    scaling = {
        "rope_type": "llama3",
        "rope_theta": 5e5,
        "factor": 32.0 if candidate.name.startswith("Llama-3.2") else 8.0,
        "low_freq_factor": 1.0,
        "high_freq_factor": 4.0,
        "original_max_position_embeddings": 8192,
    }
    return {**common, "rms_norm_eps": 1e-5, "head_dim": HEAD_DIM, "rope_parameters": scaling}
