"""A manifest says what a result depended on, in the form of its schema."""

from pathlib import Path

import jsonschema
import pytest

from planner_ft.support.files import sha256_file
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary.schema import manifest_schema


def test_manifest_follows_its_schema_and_digests_its_inputs(tmp_path: Path) -> None:
    data = tmp_path / "train.jsonl"
    data.write_text("{}\n")
    manifest = build_manifest(
        "train", seed=3, configuration={"rank": 8}, inputs={"train": data}, seconds=1.5
    )
    jsonschema.Draft202012Validator(manifest_schema()).validate(manifest)
    assert manifest["inputs"]["train"]["sha256"] == sha256_file(data)
    assert manifest["versions"]["torch"] and manifest["seconds"] == 1.5


@pytest.mark.parametrize("program", ["/usr/bin/plannerft", "/lib/planner_ft/__main__.py"])
def test_the_command_is_one_that_a_shell_reads(
    program: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.argv", [program, "train", "--output", "my adapter"])
    command = build_manifest("train", seed=0, configuration={})["command"]
    assert command == "plannerft train --output 'my adapter'"
