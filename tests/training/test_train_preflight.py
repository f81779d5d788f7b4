"""Checks before the model loads: every problem at once, each with its way out."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from planner_ft.prompts import Rendered
from planner_ft.support.errors import PlannerError
from planner_ft.training import preflight
from planner_ft.training.preflight import Prepared, run_preflight
from planner_ft.training.run import preview_sample, train
from planner_ft.training.samples import Sample, Split


def findings(request):
    prepared = Prepared()
    return {finding.title: finding for finding in run_preflight(request, prepared)}, prepared


def problems(request) -> list[str]:
    return [problem for finding in findings(request)[0].values() for problem in finding.problems]


def test_a_sound_run_has_no_problems(ask):
    found, prepared = findings(ask())
    assert list(found) == ["candidate", "data", "rendering", "special tokens", "output", "memory"]
    assert all(not finding.problems and finding.text for finding in found.values())
    assert (len(prepared.train.samples), len(prepared.validation.samples)) == (8, 3)
    assert (
        "every answer ends with a trained <|eot_id|>; one <|begin_of_text|> at the beginning"
        in found["special tokens"].text
    )


def test_everything_wrong_is_reported_at_once_and_nothing_is_written(ask, tmp_path, quiet):
    taken = tmp_path / "taken"
    taken.mkdir()
    (taken / "thesis.txt").write_text("mine")
    request = ask(
        data_dir=str(tmp_path / "none"),
        output=str(taken),
        device="cuda:7",
        report_to="fax",
        optimizer="paged-adamw-8bit",
    )
    with pytest.raises(PlannerError) as caught:
        train(request, quiet)
    message = str(caught.value)
    for part in (
        "--device cuda:7",
        "--report-to fax: unknown",
        "plannerft gen-data --level mission",
        "is no folder of a training run",
    ):
        assert part in message
    assert [path.name for path in taken.iterdir()] == ["thesis.txt"]


def test_samples_that_would_be_cut_are_named(ask):
    found = problems(ask(max_length=150))
    assert found
    assert "mission-train-" in found[0]
    assert "would be cut at 150; raise --max-length (now 150)" in found[0]
    assert len(found) <= 6


def test_bad_records_are_named_by_line(ask, data, write, curated):
    good = curated(4)
    broken = json.loads(json.dumps(good[1])) | {"id": "b"}
    broken["expected"]["tasks"][0]["title"] = "FlyHome"
    path = write(data / "train.jsonl", [good[0], good[0], broken, {"id": "c", "prompt": "go"}])
    path.write_text(path.read_text() + "{oops\n")
    found = problems(ask())
    assert found[0] == f"{path}:2: id {good[0]['id']!r} stands in line 1 already"
    assert found[1].startswith(
        f"{path}:3: expected: tasks[0]: 'FlyHome' is no task title of the vocabulary"
    )
    assert found[2] == f"{path}:4: expected (the plan) is missing"
    assert found[3].startswith(f"{path}:5: not JSON")


@pytest.mark.parametrize(
    ("content", "part"),
    [
        (b"", "holds no records"),
        (b"\xff\xfe{}", "not UTF-8"),
        (b"[1]\n", "a JSON object is expected, not list"),
    ],
)
def test_files_of_another_kind_are_named(ask, data, content, part):
    (data / "train.jsonl").write_bytes(content)
    assert any(
        part in problem and str(data / "train.jsonl") in problem for problem in problems(ask())
    )


def test_records_of_the_other_level_are_refused(ask):
    assert any("task is missing" in problem for problem in problems(ask(level="task")))


def test_only_the_first_samples_are_trained_on_request(ask):
    _, prepared = findings(ask(max_samples=2))
    assert (len(prepared.train.samples), len(prepared.validation.samples)) == (2, 3)


def test_prompts_in_both_splits_are_pointed_out(ask, data, write, curated):
    write(
        data / "validation.jsonl",
        [{**item, "id": f"v{index}"} for index, item in enumerate(curated(2))],
    )
    found, _ = findings(ask())
    assert "2 validation prompts are in the training split" in found["data"].notes[0]


def test_a_run_without_validation_says_so(ask, data):
    found, prepared = findings(ask(data_dir=None, train_file=str(data / "train.jsonl")))
    assert prepared.validation is None
    assert "no validation split" in found["data"].notes[0]


@pytest.mark.parametrize(
    ("ids", "prompt", "part"),
    [
        ([1, 5, 6, 7], 2, "do not train the end-of-turn token"),
        ([1, 5, 9, 6, 9], 2, "hold the end-of-turn token inside the answer"),
        ([1, 1, 5, 9], 2, "begin with two beginning-of-text tokens"),
        ([1, 5, 500, 9], 2, "beyond the model's 100 embeddings"),
    ],
)
def test_special_tokens_in_wrong_places_are_found(ids, prompt, part):
    sample = Sample("s", Rendered(ids, [0] * prompt + [1] * (len(ids) - prompt), prompt))
    assert any(
        part in problem for problem in preflight.token_problems(sample, end=9, bos=1, size=100)
    )
    sound = Sample("s", Rendered([1, 5, 6, 9], [0, 0, 1, 1], 2))
    assert list(preflight.token_problems(sound, end=9, bos=1, size=100)) == []


def test_an_answer_without_trained_tokens_is_named(ask, monkeypatch):
    original = Split.rendered

    def unmasked(split, tokenizer, **shown):
        result = original(split, tokenizer, **shown)
        first = result.samples[0].rendered
        blank = Rendered(first.input_ids, [0] * len(first.input_ids), first.prompt_length)
        return dataclasses.replace(result, samples=[Sample("blank", blank)])

    monkeypatch.setattr(Split, "rendered", unmasked)
    found = problems(ask())
    assert any("sample blank has no token that is trained" in problem for problem in found)


def test_a_full_disk_is_found_before_training(ask, monkeypatch):
    monkeypatch.setattr(preflight.shutil, "disk_usage", lambda path: SimpleNamespace(free=2**20))
    assert any(
        "needed for checkpoints and 1 MiB free; choose another disk" in problem
        for problem in problems(ask())
    )


def test_a_folder_that_cannot_be_written_is_found(ask, data):
    (found,) = problems(ask(output=str(data / "train.jsonl" / "adapter")))
    assert "cannot be written" in found


def test_too_little_memory_names_the_next_lever(ask, monkeypatch):
    monkeypatch.setattr(preflight, "device_memory", lambda device: (2**20, 2**21))
    (found,) = problems(ask(batch_size=4))
    assert (
        "next: --gradient-checkpointing on; then --batch-size 2 --gradient-accumulation 2" in found
    )
    monkeypatch.setattr(preflight, "device_memory", lambda device: (2**20, 2**40))
    result, _ = findings(ask())
    assert not result["memory"].problems
    assert "close other programs" in result["memory"].notes[0]


def test_a_model_that_is_not_here_says_how_to_get_it(ask, monkeypatch, tmp_path):
    monkeypatch.setenv("PLANNERFT_MODELS", str(tmp_path))
    monkeypatch.setenv("HF_HUB_CACHE", str(tmp_path))
    found, _ = findings(ask())
    assert "hf download" in found["candidate"].problems[0]
    assert found["rendering"].skipped


def test_the_preview_marks_what_is_trained(ask):
    from planner_ft.training.samples import preview_text

    sample, tokenizer = preview_sample(ask(), None)
    text = preview_text(sample, tokenizer)
    before, rest = text.plain.split("⟦")
    trained, after = rest.split("⟧")
    assert before.startswith("<|begin_of_text|>")
    assert trained.startswith('{"tasks":[')
    assert trained.endswith("<|eot_id|>")
    assert after == ""
    styles = {text.plain[span.start : span.end]: str(span.style) for span in text.spans}
    assert styles["<|eot_id|>"] == "green reverse"
    assert styles["<|begin_of_text|>"] == "dim reverse"
    with pytest.raises(PlannerError, match="holds no record of that id"):
        preview_sample(ask(), "nobody")


def test_the_curated_set_passes(ask):
    assert problems(ask(data_dir=str(Path(__file__).parents[2] / "data" / "mission"))) == []


def test_one_file_for_training_and_validation_is_rendered_as_two_splits(ask, tmp_path):
    data = tmp_path / "data.jsonl"
    lines = (Path(__file__).parents[2] / "data" / "mission" / "train.jsonl").read_text()
    data.write_text(lines)
    request = ask(data_dir=None, train_file=str(data), validation_file=str(data), max_samples=5)
    prepared = Prepared()
    assert not [p for finding in run_preflight(request, prepared) for p in finding.problems]
    assert prepared.train and len(prepared.train.samples) == 5
    assert prepared.validation and len(prepared.validation.samples) == len(lines.splitlines())


def test_training_on_a_test_set_is_said(ask, quiet, data, curated, write, tmp_path, capsys):
    beside = [{**curated(1)[0], "prompt": f"  {curated(1)[0]['prompt'].upper()}"}, *curated(1, 20)]
    write(data / "test.jsonl", beside)
    manifest = train(ask(epochs=1, rank=1), quiet)
    assert manifest["tests_trained_on"] == {str(data / "test.jsonl"): "1 of 2"}
    warned = capsys.readouterr().err
    assert f"warning: 1 of 2 inputs of {data / 'test.jsonl'} are in the training" in warned
    assert f"1 of 2 inputs of {data / 'test.jsonl'}" in (tmp_path / "adapter/README.md").read_text()


def test_two_plans_for_one_command_are_named(ask, data, write, curated):
    first, second = curated(2)
    write(data / "train.jsonl", [first, {**second, "prompt": first["prompt"]}])
    finding = next(one for one in run_preflight(ask(), Prepared()) if one.title == "data")
    (problem,) = finding.problems
    assert f"{first['id']} and {second['id']} are the same input with different plans" in problem
    write(data / "train.jsonl", [first, {**first, "id": "again"}])
    finding = next(one for one in run_preflight(ask(), Prepared()) if one.title == "data")
    assert finding.problems == []


def test_one_sample_and_labels_of_another_vehicle(ask, data, write, curated):
    write(data / "train.jsonl", curated(1))
    assert not any(one.problems for one in run_preflight(ask(), Prepared()))
    finding = next(
        one
        for one in run_preflight(ask(vocabulary="inspection_drone"), Prepared())
        if one.title == "data"
    )
    assert "is no task title of the vocabulary" in finding.problems[0]
