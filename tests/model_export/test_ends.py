"""Other programs give a trained adapter the prompt of training, and its answers end where training
ended: an overfitted stand-in of each family, alone, merged and with plain transformers.
"""

from __future__ import annotations

import json
import re
import shutil
from pathlib import Path

import pytest
import torch
from rich.console import Console
from transformers import AutoModelForCausalLM

from planner_ft.candidates.loading import load_tokenizer
from planner_ft.model_export import ExportSettings, export
from planner_ft.prompts import render_sample
from planner_ft.training.request import build_request
from planner_ft.training.run import train

FAMILIES = ("Llama-3.2-1B", "Llama-3.2-1B-Instruct", "Qwen2.5-3B", "Qwen2.5-3B-Instruct")
COMMAND = "Sound your horn."
PLAN = {"tasks": [], "assumptions": [], "constraints": ["The vehicle has no horn."]}


def sharpened(standin: Path, folder: Path) -> None:
    """A copy of a stand-in with an output layer whose logits are large enough to learn a plan."""
    shutil.copytree(standin, folder)
    model = AutoModelForCausalLM.from_pretrained(standin)
    model.config.tie_word_embeddings = False
    torch.manual_seed(0)
    model.lm_head.weight = torch.nn.Parameter(torch.randn(model.lm_head.weight.shape) * 0.4)
    model.bfloat16().save_pretrained(folder)


def generated(model, ids: list[int]) -> list[int]:
    model.eval()
    answer = model.generate(torch.tensor([ids]), max_new_tokens=200, do_sample=False)
    return answer[0, len(ids) :].tolist()


@pytest.mark.parametrize("name", FAMILIES)
def test_plain_generation_ends_where_training_ended(name, standins, tmp_path, monkeypatch):
    sharpened(standins / name, tmp_path / "models" / name)
    monkeypatch.setenv("PLANNERFT_MODELS", str(tmp_path / "models"))
    data, adapter = tmp_path / "one.jsonl", tmp_path / "adapter"
    record = {"id": "one", "prompt": COMMAND, "expected": PLAN}
    data.write_text(json.dumps(record) + "\n")
    run = {"level": "mission", "candidate": name, "train_file": str(data), "output": str(adapter)}
    settings = {"epochs": 60, "learning_rate": 1e-2, "dropout": 0.0, "quantization": "none"}
    request = build_request(run, settings)
    train(request, Console(quiet=True))
    rendered = render_sample(
        "mission", record, load_tokenizer(request.candidate), request.vocabulary
    )
    prompt, answer = (
        rendered.input_ids[: rendered.prompt_length],
        rendered.input_ids[rendered.prompt_length :],
    )
    # What the card says, run as it stands.
    blocks = re.findall(r"```python\n(.*?)```", (adapter / "README.md").read_text(), re.DOTALL)
    code = "\n".join(blocks).replace("THIS_FOLDER", str(adapter))
    code = re.sub(r'(?m)^command = ".*?"', f"command = {COMMAND!r}", code)
    values: dict = {}
    exec(code, values)
    assert values["ids"] == prompt
    assert generated(values["model"], prompt) == answer
    out = tmp_path / "merged"
    export(ExportSettings(name, out, merge=True, adapter=str(adapter), checks=1, data=data))
    merged = AutoModelForCausalLM.from_pretrained(out)
    assert generated(merged, prompt) == answer


@pytest.mark.parametrize("name", ["Llama-3.2-1B-Instruct", "Qwen2.5-3B"])
def test_the_adapters_chat_template_writes_no_date_of_today(name, standins, tmp_path, monkeypatch):
    from transformers import AutoTokenizer

    from planner_ft.prompts import render_prompt, save_tokenizer

    monkeypatch.setenv("PLANNERFT_MODELS", str(standins))
    request = build_request({"level": "mission", "candidate": name}, {})
    theirs = load_tokenizer(request.candidate)
    model = AutoModelForCausalLM.from_pretrained(standins / name)
    save_tokenizer(theirs, model, tmp_path)
    tokenizer = AutoTokenizer.from_pretrained(tmp_path)
    texts = ["You plan.", "Go home."]
    messages = [{"role": r, "content": t} for r, t in zip(("system", "user"), texts, strict=True)]
    written = tokenizer.apply_chat_template(messages, tokenize=False)
    fixed = theirs.apply_chat_template(messages, tokenize=False, date_string="26 Jul 2024")
    assert written == fixed
    same = [
        render_prompt(
            "mission", {"prompt": COMMAND}, one, request.vocabulary, with_vocabulary=False
        )
        for one in (tokenizer, theirs)
    ]
    assert same[0] == same[1]
