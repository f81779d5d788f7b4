"""Stand-ins have the form of the published candidates, are quick to make and the same for the same
seed.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import load_tokenizer
from planner_ft.prompts import render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_tree
from planner_ft.vocabulary import load_vocabulary
from scripts.make_standins import make_all_standins, make_standin

LLAMA = [
    "Llama-3.2-1B",
    "Llama-3.2-1B-Instruct",
    "Llama-3.2-3B",
    "Llama-3.2-3B-Instruct",
    "Llama-3.1-8B",
]
QWEN = ["Qwen2.5-3B", "Qwen2.5-3B-Instruct"]
MESSAGES = [{"role": "system", "content": "S"}, {"role": "user", "content": "U"}]


def config(folder: Path, name: str, file: str = "config.json") -> dict[str, Any]:
    value: dict[str, Any] = json.loads((folder / name / file).read_text())
    return value


def test_there_is_one_of_each_of_the_seven(tmp_path: Path) -> None:
    assert [folder.name for folder in make_all_standins(tmp_path)] == [*LLAMA[:4], *QWEN, LLAMA[4]]


def test_the_same_seed_gives_the_same_files_and_leaves_the_random_state_alone(
    tmp_path: Path, standins: Path
) -> None:
    import torch

    torch.manual_seed(7)
    expected = torch.rand(1)
    torch.manual_seed(7)
    again = make_standin("Qwen2.5-3B", tmp_path)
    assert torch.equal(torch.rand(1), expected)
    assert sha256_tree(again) == sha256_tree(standins / "Qwen2.5-3B")
    assert sha256_tree(make_standin("Qwen2.5-3B", tmp_path / "other", seed=1)) != sha256_tree(again)


def test_only_published_candidates_have_one(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="no stand-in for 'embedded': there are Llama"):
        make_standin("embedded", tmp_path)


@pytest.mark.parametrize("name", LLAMA)
def test_llama_stand_ins_have_its_architecture_and_ends(standins: Path, name: str) -> None:
    found = config(standins, name)
    assert found["architectures"] == ["LlamaForCausalLM"]
    assert found["planner_ft_standin"] is True
    assert found["rope_parameters"]["rope_type"] == "llama3"
    assert found["rope_parameters"]["factor"] == (8.0 if name == "Llama-3.1-8B" else 32.0)
    assert found["tie_word_embeddings"] == (name != "Llama-3.1-8B")
    tokenizer = load_tokenizer(resolve_candidate(standins / name))
    ends = config(standins, name, "generation_config.json")["eos_token_id"]
    if name.endswith("Instruct"):
        assert tokenizer.convert_ids_to_tokens(ends) == [
            "<|end_of_text|>",
            "<|eom_id|>",
            "<|eot_id|>",
        ]
        assert tokenizer.eos_token == "<|eot_id|>"
    else:
        assert tokenizer.convert_ids_to_tokens(ends) == tokenizer.eos_token == "<|end_of_text|>"
        assert tokenizer.chat_template is None
    start = tokenizer.convert_tokens_to_ids("<|begin_of_text|>")
    spacing = [
        tokenizer.convert_tokens_to_ids(token) - start
        for token in (
            "<|end_of_text|>",
            "<|finetune_right_pad_id|>",
            "<|start_header_id|>",
            "<|eot_id|>",
        )
    ]
    assert spacing == [1, 4, 6, 9], "the order of 128000, 128001, 128004, 128006 and 128009"
    assert tokenizer("x").input_ids[0] == start, "it begins a text by itself"


def test_the_llama_instruct_template_is_the_header_format(standins: Path) -> None:
    tokenizer = load_tokenizer(resolve_candidate(standins / "Llama-3.2-1B-Instruct"))
    text = tokenizer.apply_chat_template(
        MESSAGES, tokenize=False, add_generation_prompt=True, date_string="26 Jul 2024"
    )
    assert (
        text
        == "<|begin_of_text|><|start_header_id|>system<|end_header_id|>\n\nCutting Knowledge Date:"
        " December 2023\nToday Date: 26 Jul 2024\n\nS<|eot_id|>"
        "<|start_header_id|>user<|end_header_id|>\n\nU<|eot_id|><|start_header_id|>assistant<|end_header_id|>\n\n"
    )


def test_prompts_do_not_change_with_the_date_that_the_template_would_write(standins: Path) -> None:
    tokenizer = load_tokenizer(resolve_candidate(standins / "Llama-3.2-1B-Instruct"))
    assert "26 Jul 2024" not in tokenizer.apply_chat_template(MESSAGES, tokenize=False), (
        "left alone, it writes today's date"
    )
    ids = render_prompt(
        "mission", {"prompt": "come home"}, tokenizer, load_vocabulary(), with_vocabulary=False
    )
    assert "Today Date: 26 Jul 2024\n" in tokenizer.decode(ids)


@pytest.mark.parametrize("name", QWEN)
def test_qwen_stand_ins_have_its_architecture_template_and_ends(standins: Path, name: str) -> None:
    found = config(standins, name)
    assert found["architectures"] == ["Qwen2ForCausalLM"]
    tokenizer = load_tokenizer(resolve_candidate(standins / name))
    ends = config(standins, name, "generation_config.json")["eos_token_id"]
    instruct = name.endswith("Instruct")
    assert tokenizer.convert_ids_to_tokens(ends) == (
        ["<|im_end|>", "<|endoftext|>"] if instruct else "<|endoftext|>"
    )
    assert tokenizer.eos_token == ("<|im_end|>" if instruct else "<|endoftext|>")
    text = tokenizer.apply_chat_template(MESSAGES, tokenize=False, add_generation_prompt=True)
    assert (
        text
        == "<|im_start|>system\nS<|im_end|>\n<|im_start|>user\nU<|im_end|>\n<|im_start|>assistant\n"
    )
    default = tokenizer.apply_chat_template(MESSAGES[1:], tokenize=False)
    assert default.startswith(
        "<|im_start|>system\nYou are"
        f" {'Qwen, created by Alibaba Cloud. You are ' if instruct else ''}a helpful"
        " assistant.<|im_end|>"
    )


@pytest.mark.parametrize(("name", "digits"), [("Llama-3.2-1B", 3), ("Qwen2.5-3B", 1)])
def test_any_text_comes_back_and_numbers_split_as_the_family_does(
    standins: Path, name: str, digits: int
) -> None:
    tokenizer = load_tokenizer(resolve_candidate(standins / name))
    text = 'Go to [12345, -7.5] – "Windpark Ørsted" ⚓\n\n{"a":[]}'
    assert tokenizer.decode(tokenizer.encode(text, add_special_tokens=False)) == text
    assert (
        max(len(token) for token in tokenizer.tokenize("12.5 12 -40.0") if token.isdigit())
        <= digits
    )
