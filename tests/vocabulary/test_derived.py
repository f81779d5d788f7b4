"""What derives from the vocabulary is committed, up to date, and true of the data."""

from __future__ import annotations

import json
from pathlib import Path

import jsonschema
import pytest

from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.schema import (
    all_schemas,
    documentation_page,
    prompt_text,
    stale_page,
    stale_schemas,
    write_schemas,
)

ROOT = Path(__file__).parents[2]
USV = load_vocabulary()
REFRESH = "run: plannerft vocabulary --schemas schemas --docs docs/vocabulary.md"


def test_the_committed_schemas_and_page_are_up_to_date() -> None:
    assert stale_schemas(ROOT / "schemas", USV) == [], REFRESH
    assert not stale_page(ROOT / "docs" / "vocabulary.md", USV), REFRESH


@pytest.mark.parametrize("vocabulary", ["usv", "inspection_drone"])
def test_every_schema_is_a_schema(vocabulary: str) -> None:
    for schema in all_schemas(load_vocabulary(vocabulary)).values():
        jsonschema.Draft202012Validator.check_schema(schema)


def test_curated_records_are_valid_by_the_record_schema() -> None:
    schema = jsonschema.Draft202012Validator(all_schemas(USV)["record.schema.json"])
    for split in ("train", "validation", "test"):
        for line in (ROOT / "data" / "mission" / f"{split}.jsonl").read_text().splitlines():
            record = json.loads(line)
            schema.validate(record)
            assert not schema.is_valid({**record, "expected": {"tasks": [{"title": "Teleport"}]}})


def test_a_manifest_is_valid_by_the_manifest_schema() -> None:
    schema = jsonschema.Draft202012Validator(all_schemas(USV)["manifest.schema.json"])
    manifest = build_manifest(
        "data",
        seed=0,
        configuration={},
        inputs={"page": ROOT / "docs" / "vocabulary.md"},
        outputs={"train.jsonl": "0" * 64},
    )
    schema.validate(manifest)
    assert not schema.is_valid({**manifest, "outputs": {"train.jsonl": "short"}})


@pytest.mark.parametrize("vocabulary", ["usv", "inspection_drone"])
def test_texts_name_every_task_skill_and_parameter(vocabulary: str) -> None:
    definition = load_vocabulary(vocabulary)
    page, mission, task = (
        documentation_page(definition),
        prompt_text("mission", definition),
        prompt_text("task", definition),
    )
    for owner in definition.tasks:
        assert f"`{owner.title}`" in page and f"- {owner.title}(" in mission
        assert all(f"{parameter.name}: " in mission for parameter in owner.parameters)
    for skill in definition.skills:
        assert f"`{skill.name}`" in page and f"- {skill.name}(" in task


def test_a_changed_file_is_stale(tmp_path: Path) -> None:
    assert set(stale_schemas(tmp_path, USV)) == set(all_schemas(USV))
    written = write_schemas(tmp_path, USV)
    assert {path.name for path in written} == set(all_schemas(USV))
    assert all(path.is_file() for path in written) and stale_schemas(tmp_path, USV) == []
    (tmp_path / "mission.schema.json").write_text("{}")
    assert "mission.schema.json" in stale_schemas(tmp_path, USV)
    assert stale_page(tmp_path / "vocabulary.md", USV)
