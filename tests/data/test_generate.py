"""`gen-data` writes both levels, twice the same, all or nothing."""

from __future__ import annotations

import json
import os
import re
import shutil
from pathlib import Path
from typing import Any

import datasets
import pytest
from typer.testing import CliRunner

from planner_ft.cli.app import app
from planner_ft.data.generate import GenerationSettings, generate
from planner_ft.document.own_vehicle import new_vehicle
from planner_ft.prompts import chat_messages
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl, sha256_file, write_jsonl
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED

ROOT = Path(__file__).parents[2]
CURATED = ROOT / "data" / "mission"
DRONE = ROOT / "data" / "inspection_drone" / "mission"
SMALL: dict[str, Any] = {"train": 20, "validation": 5, "test": 6}
HELD_OUT = ("validation", "test", "test_unseen")


def contents(folder: Path) -> dict[str, bytes]:
    return {
        str(path.relative_to(folder)): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def source(tmp_path: Path) -> Path:
    """A copy of the curated set that a test may spoil."""
    folder = tmp_path / "source"
    shutil.copytree(CURATED, folder)
    return folder


def test_both_levels_with_card_leakage_report_and_manifest(tmp_path: Path) -> None:
    mission, task = generate(GenerationSettings(out=tmp_path / "data", **SMALL))
    assert mission.counts == {"train": 20, "validation": 5, "test": 6}
    assert task.counts == {"train": 20, "validation": 5, "test": 6, "test_unseen": 6}
    for result in (mission, task):
        files = {*(f"{split}.jsonl" for split in result.counts), "README.md", "leakage.json"}
        assert {path.name for path in result.folder.iterdir()} == files | {"manifest.json"}
        manifest = json.loads((result.folder / "manifest.json").read_text())
        assert manifest["outputs"] == {name: sha256_file(result.folder / name) for name in files}
        assert manifest["kind"] == "data" and manifest["configuration"]["counts"] == result.counts
    assert json.loads((task.folder / "manifest.json").read_text())["seed"] == 0


def test_the_same_seed_makes_the_same_bytes_and_another_seed_others(tmp_path: Path) -> None:
    for name, seed in (("a", 3), ("b", 3), ("c", 4)):
        generate(GenerationSettings(level="task", out=tmp_path / name, seed=seed, **SMALL))
    a, b, c = (contents(tmp_path / name / "task") for name in "abc")
    a.pop("manifest.json"), b.pop("manifest.json")
    assert a == b
    assert a["train.jsonl"] != c["train.jsonl"]


def test_a_second_run_is_up_to_date_and_other_results_are_kept(tmp_path: Path) -> None:
    out = tmp_path / "data"
    assert all(result.written for result in generate(GenerationSettings(out=out, **SMALL)))
    before = contents(out)
    assert not any(result.written for result in generate(GenerationSettings(out=out, **SMALL)))
    with pytest.raises(
        PlannerError, match=r"task: train.jsonl exists and is different; .* --overwrite"
    ):
        generate(GenerationSettings(out=out, seed=1, **SMALL))
    assert contents(out) == before
    generate(GenerationSettings(out=out, seed=1, overwrite=True, **SMALL))
    assert contents(out)["task/train.jsonl"] != before["task/train.jsonl"]


def test_in_place_the_curated_source_is_left_alone(tmp_path: Path, source: Path) -> None:
    (tmp_path / "data").mkdir()
    folder = source.rename(tmp_path / "data" / "mission")
    for name in ("README.md", "leakage.json", "manifest.json"):
        (folder / name).unlink(missing_ok=True)
    before = contents(folder)
    (result,) = generate(GenerationSettings(level="mission", source=folder))
    assert result.written and {**contents(folder), **before} == contents(folder)
    with pytest.raises(PlannerError, match="is the curated source and would be cut"):
        generate(GenerationSettings(level="mission", source=folder, train=20, overwrite=True))
    assert {**contents(folder), **before} == contents(folder)


@pytest.mark.parametrize(("vehicle", "folder"), [("usv", CURATED), ("inspection_drone", DRONE)])
def test_the_committed_card_and_report_are_up_to_date(vehicle: str, folder: Path) -> None:
    settings = GenerationSettings("mission", folder.parent, vocabulary=vehicle)
    (result,) = generate(settings)
    assert not result.written, "run: plannerft gen-data --level mission --overwrite"


def test_what_is_not_canonical_is_converted(tmp_path: Path, source: Path) -> None:
    records = read_jsonl(source / "train.jsonl")
    first = records[0]["expected"]["tasks"][0]["parameters"]
    first["target_position"] = [float(value) for value in first["target_position"]]
    write_jsonl(source / "train.jsonl", [dict(reversed(record.items())) for record in records])
    generate(GenerationSettings(level="mission", out=tmp_path / "data", source=source))
    assert read_jsonl(tmp_path / "data" / "mission" / "train.jsonl") == read_jsonl(
        CURATED / "train.jsonl"
    )
    assert (tmp_path / "data" / "mission" / "train.jsonl").read_text().startswith('{"id":')


def test_the_chat_form_holds_the_answer_that_we_train_on(tmp_path: Path) -> None:
    generate(GenerationSettings(out=tmp_path, chat=True, **SMALL), messages=chat_messages)
    for level in ("mission", "task"):
        record, chat = (
            read_jsonl(tmp_path / level / name)[0] for name in ("train.jsonl", "chat/train.jsonl")
        )
        assert [message["role"] for message in chat["messages"]] == ["system", "user", "assistant"]
        assert record["prompt"] in chat["messages"][1]["content"]
        assert json.loads(chat["messages"][2]["content"]) == record["expected"]
        assert [*chat["prompt"], *chat["completion"]] == chat["messages"]
        assert [message["role"] for message in chat["completion"]] == ["assistant"]
        # By the names in the card, as from the Hub.
        folder, cache = str(tmp_path / level), str(tmp_path / "cache")
        loaded = datasets.load_dataset(folder, "chat", cache_dir=cache)
        assert {"train", "validation", "test"} <= set(loaded)
        rows = loaded["train"]
        assert len(rows) == SMALL["train"]
        assert rows.column_names == ["id", "messages", "prompt", "completion"]
        assert rows[0]["completion"] == chat["completion"]


def test_the_chat_form_of_a_former_run_is_not_left(tmp_path: Path) -> None:
    how = {"level": "task", "out": tmp_path, **SMALL}
    generate(GenerationSettings(chat=True, **how), messages=chat_messages)
    with pytest.raises(PlannerError, match="--overwrite to replace it"):
        generate(GenerationSettings(seed=1, **how))
    assert (tmp_path / "task" / "chat" / "train.jsonl").is_file()
    generate(GenerationSettings(seed=1, overwrite=True, **how))
    assert not (tmp_path / "task" / "chat").exists()
    # Others' files stay, and what an earlier version left is removed.
    write_jsonl(tmp_path / "task" / "chat" / "train.jsonl", [{}])
    write_jsonl(tmp_path / "task" / "chat" / "mine.jsonl", [{}])
    generate(GenerationSettings(seed=1, overwrite=True, **how))
    assert [one.name for one in (tmp_path / "task" / "chat").iterdir()] == ["mine.jsonl"]


def test_every_split_loads_with_datasets_at_once(tmp_path: Path) -> None:
    settings = GenerationSettings(
        out=tmp_path, **{**SMALL, "train": 80}
    )  # the first split names the columns: with too few records some are missing
    for result in generate(settings):
        files = {split: str(result.folder / f"{split}.jsonl") for split in result.counts}
        loaded = datasets.load_dataset("json", data_files=files, cache_dir=str(tmp_path / "cache"))
        assert {split: len(rows) for split, rows in loaded.items()} == result.counts
        for split, path in files.items():
            assert [row["id"] for row in loaded[split]] == [
                record["id"] for record in read_jsonl(path)
            ]
            assert loaded[split][0]["expected"] == read_jsonl(path)[0]["expected"]
    assert set(
        datasets.load_dataset(str(tmp_path / "task"), cache_dir=str(tmp_path / "cache"))
    ) == {"train", "validation", "test", "test_unseen"}


def test_another_vehicle_has_its_task_set(tmp_path: Path) -> None:
    (result,) = generate(
        GenerationSettings(level="task", out=tmp_path, vocabulary="inspection_drone", **SMALL)
    )
    titles = {record["task"] for record in read_jsonl(result.folder / "train.jsonl")}
    assert titles <= set(load_vocabulary("inspection_drone").task)
    with pytest.raises(PlannerError, match="a set for the vocabulary inspection_drone is needed"):
        generate(
            GenerationSettings(
                out=tmp_path / "all", vocabulary="inspection_drone", source=CURATED, **SMALL
            )
        )
    assert not (tmp_path / "all").exists()


def test_no_held_out_prompt_repeats_the_training_split(tmp_path: Path) -> None:
    """Neither the text nor, with its values masked, the phrasing: in a vehicle with few words many
    would.
    """
    new_vehicle("rover", tmp_path / "rover")
    source = str(tmp_path / "rover" / "rover.toml")
    (result,) = generate(
        GenerationSettings(
            "task", tmp_path, train=2000, validation=100, test=100, vocabulary=source
        )
    )
    assert result.counts == {"train": 2000, **dict.fromkeys(HELD_OUT, 100)}
    report = json.loads((result.folder / "leakage.json").read_text())
    repeated = {
        item["split"]: (item["exact"], item["exact_masked"])
        for item in report["overlaps"]
        if item["other"] == "train"
    }
    assert repeated == dict.fromkeys(HELD_OUT, (0, 0))


def test_the_second_vehicle_has_both_levels_in_its_own_folder() -> None:
    arguments = ["gen-data", "--vocabulary", "inspection_drone"]
    small = [f"--{name}={count}" for name, count in SMALL.items()]
    result = CliRunner().invoke(app, [*arguments, *small], catch_exceptions=False)
    assert result.exit_code == 0
    made = Path("data/inspection_drone")
    assert (made / "task" / "train.jsonl").is_file()
    assert read_jsonl(made / "mission" / "test.jsonl") == read_jsonl(DRONE / "test.jsonl")[:6]


def test_an_own_vehicle_has_its_set_beside_its_definition(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text((BUNDLED / "inspection_drone.toml").read_text())
    settings = GenerationSettings("mission", tmp_path, vocabulary=str(tmp_path / "mine.toml"))
    with pytest.raises(PlannerError, match=f"not in {tmp_path / 'mission'}; give its folder"):
        generate(settings)
    for split in ("train", "validation", "test"):
        records = read_jsonl(DRONE / f"{split}.jsonl")
        write_jsonl(tmp_path / "mission" / f"{split}.jsonl", records[:2])
    (result,) = generate(settings)
    assert result.counts == {"train": 2, "validation": 2, "test": 2}
    assert (tmp_path / "mission" / "README.md").is_file()


def test_another_vehicle_takes_a_mission_set_of_its_own(tmp_path: Path) -> None:
    drone = load_vocabulary("inspection_drone")
    prompts = {
        "train": "go to [4, 5]",
        "validation": "fly to [6, 7], please",
        "test": "[8, 9], over",
    }
    for split, prompt in prompts.items():
        position = [int(number) for number in re.findall(r"\d", prompt)]
        name = drone.task[drone.transit].position_parameter
        task = {
            "title": drone.transit,
            "parameters": {name: position},
            "task_prompt": f"Fly to {position}.",
        }
        expected = {"tasks": [task], "assumptions": [], "constraints": []}
        record = {
            "id": split,
            "family": split,
            "prompt": prompt,
            "expected": expected,
            "spans": [],
            "tags": [],
        }
        write_jsonl(tmp_path / "own" / f"{split}.jsonl", [record])
    (result,) = generate(
        GenerationSettings(
            level="mission",
            out=tmp_path / "data",
            vocabulary="inspection_drone",
            source=tmp_path / "own",
        )
    )
    assert result.counts == {"train": 1, "validation": 1, "test": 1}


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"level": "skills"}, "--level skills: must be mission, task or all"),
        ({"train": 0}, "--train 0: at least one record"),
        ({"seed": -1}, "--seed -1"),
        (
            {"level": "mission", "train": 126},
            "--train 126: the curated mission set has 125 records",
        ),
        ({"level": "mission", "source": Path("nowhere")}, "--source nowhere: no such folder"),
        ({"vocabulary": "submarine"}, "--vocabulary submarine: no such file"),
    ],
)
def test_mistakes_are_one_sentence(tmp_path: Path, settings: dict[str, Any], message: str) -> None:
    with pytest.raises(PlannerError, match=re.escape(message)):
        generate(GenerationSettings(**{"out": tmp_path / "data", **settings}))
    assert not (tmp_path / "data").exists()


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (None, r"train.jsonl: no such file"),
        (b"", r"train.jsonl: is empty"),
        (b"\xff\xfe", r"train.jsonl: not UTF-8"),
        (b'{"id": "a", "prompt": "go', r"train.jsonl:1: not JSON"),
        (
            b'{"id": "a", "prompt": "go"}',
            r"train.jsonl:1: .* \(and \d+ more; plannerft validate --complete",
        ),
        (b"[1]\n", r"train.jsonl:1: a JSON object is expected"),
    ],
)
def test_a_faulty_source_is_named_and_nothing_written(
    tmp_path: Path, source: Path, content: bytes | None, message: str
) -> None:
    (source / "train.jsonl").unlink()
    if content is not None:
        (source / "train.jsonl").write_bytes(content)
    with pytest.raises(PlannerError, match=message):
        generate(GenerationSettings(level="mission", out=tmp_path / "data", source=source))
    assert not (tmp_path / "data").exists()


def test_a_source_that_lacks_coverage_is_named(tmp_path: Path, source: Path) -> None:
    write_jsonl(source / "test.jsonl", read_jsonl(source / "test.jsonl")[:24])
    with pytest.raises(PlannerError, match=r"source: test: 24 records, 25 are expected"):
        generate(GenerationSettings(level="mission", out=tmp_path / "data", source=source))


def test_a_full_disk_leaves_what_was_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    out = tmp_path / "data"
    generate(GenerationSettings(level="task", out=out, **SMALL))
    before = contents(tmp_path)
    calls = iter(range(100))

    def full(_descriptor: int) -> None:
        if next(calls) == 2:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(
        PlannerError, match=r"data/task/test.jsonl: cannot be written \(No space left on device\)"
    ):
        generate(GenerationSettings(level="task", out=out, seed=9, overwrite=True, **SMALL))
    assert contents(tmp_path) == before


def test_a_folder_that_cannot_be_written_is_named_before_the_work(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PlannerError, match=r"--out file/data: .*file is a file; give a folder"):
        generate(GenerationSettings(out=Path("file") / "data"))
    monkeypatch.setattr(os, "access", lambda *_arguments: False)
    with pytest.raises(PlannerError, match=r"--out .*data: .* cannot be written"):
        generate(GenerationSettings(out=tmp_path / "data"))


def test_a_synthetic_mission_set_lies_beside_the_curated_one(tmp_path: Path) -> None:
    results = generate(GenerationSettings(level="mission", out=tmp_path, synthetic=40))
    assert [result.folder.name for result in results] == ["mission", "mission-synthetic"]
    lines = (
        (tmp_path / "mission-synthetic" / "train.jsonl").read_text(encoding="utf-8").splitlines()
    )
    assert len(lines) == 40 and "40 commands" in (
        tmp_path / "mission-synthetic" / "README.md"
    ).read_text(encoding="utf-8")
    assert (
        json.loads((tmp_path / "mission-synthetic" / "manifest.json").read_text())["configuration"][
            "synthetic"
        ]
        == 40
    )
    curated = {
        json.loads(line)["prompt"]
        for path in (tmp_path / "mission").glob("*.jsonl")
        for line in path.read_text(encoding="utf-8").splitlines()
    }
    assert not curated & {json.loads(line)["prompt"] for line in lines}


def test_a_card_names_the_options_that_its_set_was_made_with(tmp_path: Path, source: Path) -> None:
    how = {"seed": 3, "synthetic": 4, "source": source, **SMALL}
    generate(GenerationSettings(out=tmp_path / "data", chat=True, **how), messages=chat_messages)
    named = {
        "mission": f"--train 20 --validation 5 --test 6 --source {source}",
        "task": "--train 20 --validation 5 --test 6 --seed 3",
        "mission-synthetic": "--synthetic 4 --seed 3",
    }
    for name, options in named.items():
        card = (tmp_path / "data" / name / "README.md").read_text(encoding="utf-8")
        level = name.removesuffix("-synthetic")
        assert f"Written by `plannerft gen-data --level {level} {options} --chat`" in card


def test_a_synthetic_set_belongs_to_the_mission_level(tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match="--synthetic 5: it belongs to the mission level"):
        GenerationSettings(level="task", out=tmp_path, synthetic=5)


def test_the_command_that_lists_the_problems_names_the_vehicle(tmp_path: Path) -> None:
    new_vehicle("rover", tmp_path / "rover")
    source = str(tmp_path / "rover" / "rover.toml")
    path = tmp_path / "rover" / "mission" / "train.jsonl"
    path.write_text(path.read_text().replace('"tags"', '"tagz"'))
    listed = f"validate --complete --vocabulary {source} {tmp_path}/rover/mission"
    with pytest.raises(PlannerError, match=re.escape(listed)):
        generate(GenerationSettings("mission", tmp_path, vocabulary=source))
