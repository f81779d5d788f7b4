"""The tokenizer that is read without transformers gives the ids of theirs."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.loading import load_tokenizer
from planner_ft.candidates.weights import FileTokenizer
from planner_ft.prompts import end_of_turn_ids, render_prompt
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_jsonl, write_json
from planner_ft.vocabulary import load_vocabulary

EMBEDDED = resolve_candidate("embedded")
ODD = ["<|end|> and <|user|> are text", "  spaces , and\n\nlines ", "ü 5° → 12,5 m ½ 🚤", "", "x."]


def test_ids_and_texts_are_those_of_transformers() -> None:
    assert EMBEDDED.folder is not None
    ours, theirs = FileTokenizer.read(EMBEDDED.folder), load_tokenizer(EMBEDDED)
    assert ours is not None and len(ours) == len(theirs)
    for name in ("bos_token_id", "eos_token_id", "pad_token_id", "chat_template"):
        assert getattr(ours, name) == getattr(theirs, name)
    assert set(ours.all_special_ids) == set(theirs.all_special_ids)
    assert end_of_turn_ids(ours) == end_of_turn_ids(theirs)
    texts = [record["prompt"] for record in read_jsonl(Path("data/mission/challenge.jsonl"))[:60]]
    for text in (*texts, *ODD):
        for special in (True, False):
            ids = ours.encode(text, add_special_tokens=special)
            assert ids == theirs.encode(text, add_special_tokens=special)
        split = {"add_special_tokens": False, "split_special_tokens": True}
        assert ours.encode(text, **split) == theirs.encode(text, **split)
        assert ours.decode(ids) == theirs.decode(ids, clean_up_tokenization_spaces=False)
        rendered = [
            render_prompt("mission", {"prompt": text}, one, load_vocabulary(), with_vocabulary=True)
            for one in (ours, theirs)
        ]
        assert rendered[0] == rendered[1]


def test_a_tokenizer_of_another_class_or_with_tokens_of_its_settings_is_left_to_transformers(
    models: Path, tmp_path: Path
) -> None:
    stand_in = resolve_candidate("Qwen2.5-3B").folder
    assert stand_in is not None and FileTokenizer.read(stand_in) is None
    assert EMBEDDED.folder is not None
    folder = Path(shutil.copytree(EMBEDDED.folder, tmp_path / "embedded"))
    path = folder / "tokenizer_config.json"
    write_json(path, {**read_json(path), "extra_special_tokens": ["<|new|>"]})
    assert FileTokenizer.read(folder) is None


def test_a_corrupt_tokenizer_is_refused(tmp_path: Path) -> None:
    assert EMBEDDED.folder is not None
    folder = Path(shutil.copytree(EMBEDDED.folder, tmp_path / "embedded"))
    (folder / "tokenizer.json").write_text("{")
    with pytest.raises(PlannerError, match="the tokenizer cannot be loaded"):
        FileTokenizer.read(folder)
