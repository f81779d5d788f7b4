"""Atomic writes, and errors that name file and line."""

import json
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import (
    atomic_writer,
    compact_json,
    read_json,
    read_jsonl,
    read_toml,
    sha256_tree,
    write_json,
    write_jsonl,
)


def test_an_interrupted_write_leaves_the_old_file(tmp_path: Path) -> None:
    path = tmp_path / "result.json"
    write_json(path, {"a": 1})
    with pytest.raises(RuntimeError), atomic_writer(path) as stream:
        stream.write("half")
        raise RuntimeError
    assert json.loads(path.read_text()) == {"a": 1}
    assert [path.name for path in tmp_path.iterdir()] == ["result.json"]


def test_a_full_disk_is_one_sentence(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    def full(*_arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(PlannerError, match="No space left on device"):
        write_json(tmp_path / "result.json", {"a": 1})
    assert list(tmp_path.iterdir()) == []


def test_a_link_stays_and_what_it_points_to_is_replaced(tmp_path: Path) -> None:
    link, path = tmp_path / "link.json", tmp_path / "result.json"
    write_json(path, 1)
    path.chmod(0o600)
    link.symlink_to(path)
    write_json(link, 2)
    assert link.is_symlink() and json.loads(path.read_text()) == 2
    assert path.stat().st_mode & 0o777 == 0o600


@pytest.mark.parametrize("make", [os.mkdir, os.mkfifo])
def test_what_is_no_file_is_not_replaced(make: Callable[[Path], None], tmp_path: Path) -> None:
    make(tmp_path / "result.json")
    with pytest.raises(PlannerError, match="is no file that can be replaced"):
        write_json(tmp_path / "result.json", 1)
    assert not (tmp_path / "result.json").is_file()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "holds no records"),
        (b'{"id": 1}\n{"id"', r"data.jsonl:2: not JSON"),
        (b'{"id": 1}\n[1]\n', r"data.jsonl:2: a JSON object is expected, not list"),
        (b'{"id": "\xff"}\n', "not UTF-8 text \\(byte 8\\)"),
    ],
)
def test_bad_jsonl_names_file_and_line(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "data.jsonl"
    path.write_bytes(content)
    with pytest.raises(PlannerError, match=message):
        read_jsonl(path)


def test_a_line_separator_inside_a_string_is_no_new_line(tmp_path: Path) -> None:
    write_jsonl(tmp_path / "data.jsonl", [{"id": "a\u2028b"}])
    assert read_jsonl(tmp_path / "data.jsonl") == [{"id": "a\u2028b"}]


def test_missing_and_broken_json_files(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="no such file"):
        read_json(tmp_path / "none.json")
    (tmp_path / "broken.json").write_text('{"a":\n}')
    with pytest.raises(PlannerError, match=r"broken.json:2: not JSON"):
        read_json(tmp_path / "broken.json")


@pytest.mark.parametrize("number", ["1e999", "-1e999", "9" * 301, "NaN"])
def test_a_number_beyond_all_range_is_one_sentence(tmp_path: Path, number: str) -> None:
    path = tmp_path / "large.json"
    path.write_text(f'{{"speed": {number}}}')
    with pytest.raises(PlannerError, match=r"large.json: not JSON \(.* is no .*number"):
        read_json(path)
    path.write_text(f"[1e308, {'9' * 300}]")
    assert read_json(path) == [1e308, int("9" * 300)]


def test_a_key_that_stands_twice_is_refused_where_asked(tmp_path: Path) -> None:
    path = tmp_path / "twice.json"
    path.write_text('{\n"a": [{"x": 999, "x": 30}]}')
    assert read_json(path) == {"a": [{"x": 30}]}
    with pytest.raises(PlannerError, match=r"twice.json: not JSON \(the key 'x' stands twice"):
        read_json(path, unique=True)


def test_compact_json_refuses_nan() -> None:
    assert compact_json({"a": [1, "é"]}) == '{"a":[1,"é"]}'
    with pytest.raises(ValueError):
        compact_json(float("nan"))


def test_a_folder_digest_changes_with_any_byte(tmp_path: Path) -> None:
    (tmp_path / "a.safetensors").write_bytes(b"1")
    before = sha256_tree(tmp_path, ("*.safetensors",))
    (tmp_path / "note.txt").write_text("not covered")
    assert sha256_tree(tmp_path, ("*.safetensors",)) == before
    (tmp_path / "a.safetensors").write_bytes(b"2")
    assert sha256_tree(tmp_path, ("*.safetensors",)) != before


@pytest.mark.parametrize("content", ["speed = nan", "speed = 1e400", "a = " + "[" * 100_000])
def test_toml_that_cannot_be_used_is_one_sentence(tmp_path: Path, content: str) -> None:
    (tmp_path / "a.toml").write_text(content)
    with pytest.raises(PlannerError, match=r"a\.toml: not TOML"):
        read_toml(tmp_path / "a.toml")
