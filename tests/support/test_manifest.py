"""A manifest says what a result depended on, in the form of its schema."""

from pathlib import Path

import jsonschema

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
