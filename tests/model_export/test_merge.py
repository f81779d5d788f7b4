"""The exported folder is the candidate with its adapter: for plain transformers, for the benchmark,
and in its manifest.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import torch

from planner_ft.benchmark.plan import make_plan
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.registry import VOCABULARY_KEY
from planner_ft.cli import main
from planner_ft.model_export import Exported, ExportSettings, export
from planner_ft.model_export import check as check_module
from planner_ft.prompts import TODAY, render_prompt, with_fixed_date
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import manifest_schema

from .conftest import LLAMA

IDS = torch.tensor([[1, 5, 9, 200, 7]])


def test_the_folder_is_base_and_adapter_for_plain_transformers(
    exported: Callable[..., Exported], models: Path, adapters: Callable[[str], Path]
) -> None:
    from peft import PeftModel
    from transformers import AutoModelForCausalLM, AutoTokenizer

    done = exported()
    merged = AutoModelForCausalLM.from_pretrained(str(done.folder))
    assert merged.dtype == torch.float32
    base = AutoModelForCausalLM.from_pretrained(str(models / LLAMA), dtype=torch.float32)
    with torch.inference_mode():
        before = base(IDS).logits
        beside = PeftModel.from_pretrained(base, str(adapters(LLAMA)))(IDS).logits
        after = merged(IDS).logits
    assert torch.allclose(after, beside, atol=1e-4) and not torch.allclose(after, before, atol=1e-2)
    assert AutoTokenizer.from_pretrained(str(done.folder)).encode(
        "two buoys"
    ) == AutoTokenizer.from_pretrained(str(models / LLAMA)).encode("two buoys")
    assert done.check.same == done.check.count == 2 and done.check.largest_logit_difference < 1e-3


def test_the_manifest_says_what_was_put_together(exported: Callable[..., Exported]) -> None:
    done = exported()
    manifest = json.loads((done.folder / "manifest.json").read_text())
    jsonschema.Draft202012Validator(manifest_schema()).validate(manifest)
    assert (
        manifest["kind"],
        manifest["base"]["name"],
        manifest["base"]["standin"],
        manifest["check"]["same_answers"],
    ) == ("export", LLAMA, True, 2)
    card = (done.folder / "README.md").read_text()
    assert f"# Mission Agent on {LLAMA}, merged" in card and "Stand-in" in card and "2 of 2" in card


def test_an_exported_model_is_not_told_the_vocabulary_again(
    exported: Callable[..., Exported],
) -> None:
    candidate = resolve_candidate(exported().folder)
    assert candidate.knows(load_vocabulary("usv")) and not candidate.knows(
        load_vocabulary("inspection_drone")
    )
    assert candidate.is_standin
    assert VOCABULARY_KEY not in json.loads(
        (resolve_candidate(LLAMA).folder / "config.json").read_text()
    )  # type: ignore[operator]


def test_a_merged_model_is_benched_as_one_and_at_its_level_alone(
    exported: Callable[..., Exported],
) -> None:
    folder = str(exported().folder)
    how = {"device": "cpu", "quantization": "none", "limit": 2}
    (job,) = make_plan(BenchSettings("mission", (folder,), ("base+schema",), **how)).jobs
    assert job.system.merged and job.system.heading == "merged+schema"
    with pytest.raises(PlannerError, match="mission level folded in; give --level mission or"):
        make_plan(BenchSettings("task", (folder,), ("base",), **how))


def test_llama_prompts_hold_the_date_of_training_whoever_renders_them(
    exported: Callable[..., Exported], models: Path
) -> None:
    from transformers import AutoTokenizer

    tokenizer = AutoTokenizer.from_pretrained(str(exported().folder))
    messages = [{"role": "system", "content": "Hello."}, {"role": "user", "content": "Go."}]
    assert f"Today Date: {TODAY}" in tokenizer.apply_chat_template(messages, tokenize=False)
    record, vocabulary = {"prompt": "Go home."}, load_vocabulary("usv")
    ours = render_prompt(
        "mission",
        record,
        AutoTokenizer.from_pretrained(str(models / LLAMA)),
        vocabulary,
        with_vocabulary=False,
    )
    assert render_prompt("mission", record, tokenizer, vocabulary, with_vocabulary=False) == ours
    assert with_fixed_date(tokenizer.chat_template) == tokenizer.chat_template
    assert with_fixed_date("{{ messages }}") == "{{ messages }}" and with_fixed_date(None) is None


def test_nothing_is_written_when_an_answer_changes(
    exported: Callable[..., Exported], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Merging is made wrong: the adapter is dropped."""
    monkeypatch.setattr("planner_ft.model_export.run.merged", lambda model: model.unload())
    with pytest.raises(PlannerError, match=r"[12] of 2 answers differ .* nothing was written"):
        exported()
    assert list(tmp_path.iterdir()) == []


def test_an_earlier_export_is_replaced_only_when_asked_and_nothing_else_ever(
    exported: Callable[..., Exported], tmp_path: Path
) -> None:
    done = exported()
    with pytest.raises(PlannerError, match="give --overwrite"):
        exported()
    (done.folder / "old").write_text("x")
    exported(overwrite=True)
    assert not (done.folder / "old").exists() and (done.folder / "model.safetensors").is_file()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("x")
    with pytest.raises(PlannerError, match="is no exported model"):
        exported(out=tmp_path / "mine", overwrite=True)
    assert (tmp_path / "mine" / "thesis.txt").is_file()


def test_without_merge_the_base_is_exported(models: Path, tmp_path: Path) -> None:
    done = export(ExportSettings(LLAMA, tmp_path / "out", checks=1))
    assert done.check.largest_logit_difference == 0.0
    assert not resolve_candidate(done.folder).knows(load_vocabulary("usv"))


def test_commands_of_the_users_own_are_the_check(
    exported: Callable[..., Exported], tmp_path: Path
) -> None:
    data = tmp_path / "mine.jsonl"
    data.write_text(
        "".join(json.dumps({"prompt": f"go to {number}"}) + "\n" for number in range(3))
    )
    assert exported(data=data, checks=3).check.count == 3
    data.write_text('{"command": "go"}\n')
    with pytest.raises(PlannerError, match="record 1 has no prompt"):
        exported(data=data, out=tmp_path / "other")


def test_tasks_of_the_validation_split_are_checked_at_task_level() -> None:
    records = check_module.check_records("task", load_vocabulary("usv"), 3)
    assert len(records) == 3 and all(record["task"] and record["prompt"] for record in records)


@pytest.mark.parametrize(
    ("flags", "message"),
    [
        (["--adapter", "x"], "give --merge, too"),
        (["--merge", "--adapter", "nowhere"], "nowhere: no such adapter folder"),
        (["--outtype", "q4"], "--outtype q4: must be f32 or f16"),
        (["--checks", "0"], "--checks 0: must be between"),
        (["--check-data", "nowhere.jsonl"], "nowhere.jsonl: no such file"),
    ],
)
def test_mistakes_are_one_sentence(
    flags: list[str],
    message: str,
    models: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: Any,
) -> None:
    monkeypatch.setattr(
        sys,
        "argv",
        ["plannerft", "export", "--candidate", LLAMA, "--out", str(tmp_path / "out"), *flags],
    )
    with pytest.raises(SystemExit) as ended:
        main()
    said = capsys.readouterr().err
    assert ended.value.code == 2 and message in said and said.count("\n") == 1


def test_the_next_export_removes_what_a_killed_one_left(
    exported: Callable[..., Exported], tmp_path: Path
) -> None:
    left = tmp_path / ".out.1.00ff00.tmp"
    left.mkdir()
    (left / "model.safetensors").write_bytes(b"half")
    done = exported(out=tmp_path / "out")
    assert list(tmp_path.iterdir()) == [done.folder]
