"""Benchmark runs on stand-ins: what is written, what is generated, and what happens when a run is
interrupted.
"""

from __future__ import annotations

import contextlib
import json
import shutil
import signal
from pathlib import Path
from typing import Any

import pytest
import typer
from rich.console import Console
from typer.testing import CliRunner

from planner_ft.benchmark.folder import RecordLog
from planner_ft.benchmark.layout import print_warnings
from planner_ft.benchmark.plan import make_plan
from planner_ft.benchmark.runner import run_bench
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.cli.bench import bench, score
from planner_ft.data.leakage import input_digest
from planner_ft.decoding import engine as engine_module
from planner_ft.decoding import generate as generate_module
from planner_ft.decoding.engine import Engine
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import sha256_file

NAME = "Llama-3.2-1B-Instruct"
COUNT = 5
TIMED = 2


def mission_data(path: Path, count: int = COUNT) -> Path:
    records = [
        {
            "id": f"m{index}",
            "prompt": f"go to {index} {index}" + " and look around" * index,
            "expected": {"tasks": [{"title": "Transit"}]},
        }
        for index in range(count)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


def task_data(path: Path) -> Path:
    expected = {
        "skill_sequence": [
            {"navigation_skill": {"name": "StationKeep", "parameters": {"time": 60}}}
        ]
    }
    records = [
        {
            "id": f"t{index}",
            "prompt": "hold for a minute",
            "task": "KeepStation",
            "parameters": {"duration": 60},
            "expected": expected,
        }
        for index in range(2)
    ]
    path.write_text("".join(json.dumps(record) + "\n" for record in records))
    return path


@pytest.fixture(scope="session")
def adapter(standins: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A random PEFT adapter for the stand-in, as another tool would write it."""
    import peft
    import torch
    from transformers import AutoModelForCausalLM

    folder = tmp_path_factory.mktemp("adapter")
    torch.manual_seed(0)
    settings = peft.LoraConfig(
        r=4,
        lora_alpha=64,
        target_modules=["q_proj", "v_proj", "down_proj"],
        init_lora_weights=False,
    )
    model = peft.get_peft_model(
        AutoModelForCausalLM.from_pretrained(str(standins / NAME)), settings
    )
    model.save_pretrained(str(folder))
    return folder


@pytest.fixture
def data(tmp_path: Path, models: Path) -> Path:
    return mission_data(tmp_path / "data.jsonl")


@pytest.fixture
def settings(data: Path, adapter: Path, tmp_path: Path) -> Any:
    """Settings of a small run, of which a test changes what it is about."""

    def make(**changes: Any) -> BenchSettings:
        values: dict[str, Any] = {
            "level": "mission",
            "candidates": (NAME,),
            "data": data,
            "out": tmp_path / "out",
            "adapters": (str(adapter),),
            "device": "cpu",
            "batch_size": 2,
            "max_new_tokens": 6,
            "latency_samples": TIMED,
        }
        return BenchSettings(**{**values, **changes})

    return make


@pytest.fixture
def work(monkeypatch: pytest.MonkeyPatch) -> dict[str, int]:
    """Counts models loaded and rows generated."""
    counts = {"models": 0, "rows": 0}
    load, batch = engine_module.load_model, generate_module._run

    def counting_load(*args: Any, **kwargs: Any) -> Any:
        counts["models"] += 1
        return load(*args, **kwargs)

    def counting_batch(decoder: Any, rows: Any, *args: Any) -> Any:
        counts["rows"] += len(rows)
        return batch(decoder, rows, *args)

    monkeypatch.setattr(engine_module, "load_model", counting_load)
    monkeypatch.setattr(generate_module, "_run", counting_batch)
    return counts


def lines(path: Path) -> list[dict[str, Any]]:
    return [json.loads(line) for line in path.read_text().splitlines()]


def answers(folder: Path) -> dict[tuple[str, str], str]:
    return {
        (line["configuration"], line["id"]): line["output"]
        for line in lines(folder / "predictions.jsonl")
    }


class Stop:
    """Interrupts a run after some queries, as Ctrl-C does."""

    def __init__(self, after: int) -> None:
        self.left = after

    def __call__(self, label: str, done: int, total: int) -> None:
        if done:
            self.left -= 1
            if self.left == 0:
                raise KeyboardInterrupt


def test_a_run_writes_what_is_documented(
    settings: Any, tmp_path: Path, work: dict[str, int]
) -> None:
    run_bench(settings())
    folder = tmp_path / "out"
    names = {
        "predictions.jsonl",
        "latency.jsonl",
        "run.json",
        "results.json",
        "scores.jsonl",
        "baselines.jsonl",
        "table.md",
        "table.csv",
        "table.tex",
    }
    assert {path.name for path in folder.iterdir()} == names
    written = lines(folder / "predictions.jsonl")
    assert len(written) == 2 * COUNT
    assert {
        "id",
        "candidate",
        "configuration",
        "output",
        "parsed",
        "tokens",
        "time_s",
        "finish_reason",
        "error",
    } <= set(written[0])
    assert {line["finish_reason"] for line in written} == {"length"}
    assert {line["tokens"] for line in written} == {6}
    results = json.loads((folder / "results.json").read_text())
    assert [(row["candidate"], row["configuration"], row["n"]) for row in results["rows"]] == [
        (NAME, "base", COUNT),
        (NAME, "lora", COUNT),
    ]
    assert results["level"] == "mission"
    assert results["data"]["n"] == COUNT
    assert [row["with_vocabulary"] for row in results["rows"]] == [True, False]
    assert all(
        row["metrics"]["latency_s"]["value"] > 0 and row["latency_n"] == TIMED
        for row in results["rows"]
    )
    assert results["rows"][0]["metrics"]["tokens"]["value"] == 6
    timed = lines(folder / "latency.jsonl")
    assert all(0 < line["forward_passes"] <= line["tokens"] for line in [*timed, *written])
    passes = [line["forward_passes"] for line in timed if line["configuration"] == "base"]
    assert results["rows"][0]["metrics"]["forward_passes"]["value"] == sum(passes) / len(passes)
    assert "Forward passes" in (folder / "table.md").read_text()
    assert "stand-in" in (folder / "table.md").read_text()
    # One model for both configurations; every answer once; each configuration's timed queries after
    # one of warm-up.
    assert work == {"models": 1, "rows": 2 * COUNT + 2 * (TIMED + 1)}


def test_only_base_models_are_told_the_vocabulary(settings: Any, tmp_path: Path) -> None:
    run_bench(settings())
    by_configuration: dict[str, list[int]] = {"base": [], "lora": []}
    for line in lines(tmp_path / "out" / "predictions.jsonl"):
        by_configuration[line["configuration"]].append(line["prompt_tokens"])
    assert min(by_configuration["base"]) > 5 * max(by_configuration["lora"])


def test_a_candidate_pretrained_on_the_vocabulary_is_not_told_it(
    settings: Any, tmp_path: Path, models: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(models / NAME, tmp_path / "models" / "embedded")
    monkeypatch.setenv("PLANNERFT_MODELS", str(tmp_path / "models"))
    for vocabulary in ("usv", "inspection_drone"):
        data = tmp_path / "empty.jsonl"
        data.write_text(
            json.dumps({"id": "a", "prompt": "hello", "expected": {"tasks": []}}) + "\n"
        )
        out = tmp_path / vocabulary
        results = run_bench(
            settings(
                candidates=("embedded",),
                configurations=("base",),
                adapters=(),
                vocabulary=vocabulary,
                data=data,
                out=out,
            )
        )
        assert results.rows[0].with_vocabulary is (vocabulary == "inspection_drone")


def test_base_answers_are_those_of_the_bare_model(settings: Any, tmp_path: Path) -> None:
    run_bench(settings())
    run_bench(settings(configurations=("base",), adapters=(), out=tmp_path / "bare"))
    both = answers(tmp_path / "out")
    assert answers(tmp_path / "bare") == {
        key: text for key, text in both.items() if key[0] == "base"
    }
    assert [both["base", f"m{index}"] for index in range(COUNT)] != [
        both["lora", f"m{index}"] for index in range(COUNT)
    ]


@pytest.mark.parametrize("after", [1, 4, 7, 11, 13])
def test_an_interrupted_run_goes_on_and_generates_nothing_twice(
    settings: Any, tmp_path: Path, work: dict[str, int], after: int
) -> None:
    run_bench(settings(out=tmp_path / "whole"))
    work["rows"] = 0
    with pytest.raises(KeyboardInterrupt):
        run_bench(settings(), Stop(after))
    assert not (tmp_path / "out" / "results.json").exists()
    done = len(lines(tmp_path / "out" / "predictions.jsonl")) + len(
        lines(tmp_path / "out" / "latency.jsonl")
    )
    assert done == after
    before = work["rows"]
    run_bench(settings(resume=True))
    assert answers(tmp_path / "out") == answers(tmp_path / "whole")
    assert len(lines(tmp_path / "out" / "predictions.jsonl")) == 2 * COUNT
    missing_answers = max(0, 2 * COUNT - after)
    timed = 2 * TIMED - max(0, after - 2 * COUNT)
    assert work["rows"] - before == missing_answers + timed + (2 if timed > TIMED else 1)
    interrupted, whole = (
        json.loads((tmp_path / folder / "results.json").read_text())["rows"]
        for folder in ("out", "whole")
    )
    assert [row["metrics"]["f1"] for row in interrupted] == [row["metrics"]["f1"] for row in whole]
    assert [row["metrics"]["f1"]["value"] for row in whole] == [0.0, 0.0]


def test_a_run_killed_in_the_middle_of_a_line_goes_on(
    settings: Any, tmp_path: Path, work: dict[str, int]
) -> None:
    run_bench(settings(latency_samples=0))
    whole = answers(tmp_path / "out")
    path = tmp_path / "out" / "predictions.jsonl"
    path.write_bytes(path.read_bytes()[:-30])
    work["rows"] = 0
    run_bench(settings(latency_samples=0, resume=True))
    assert work["rows"] == 1
    assert answers(tmp_path / "out") == whole


def test_a_finished_run_is_scored_again_without_its_model(
    settings: Any, tmp_path: Path, work: dict[str, int]
) -> None:
    run_bench(settings())
    first = json.loads((tmp_path / "out" / "results.json").read_text())
    work["models"] = 0
    run_bench(settings(resume=True))
    assert work["models"] == 0
    assert json.loads((tmp_path / "out" / "results.json").read_text())["rows"] == first["rows"]


def test_more_samples_and_configurations_add_to_a_run(
    settings: Any, tmp_path: Path, work: dict[str, int]
) -> None:
    run_bench(settings(limit=2, configurations=("base",), latency_samples=0))
    run_bench(settings(resume=True, latency_samples=0))
    assert work["rows"] == 2 * COUNT
    assert len(lines(tmp_path / "out" / "predictions.jsonl")) == 2 * COUNT


def test_score_gives_the_same_figures_as_the_run(settings: Any, tmp_path: Path, data: Path) -> None:
    run_bench(settings())
    app = typer.Typer()
    app.command()(score)
    arguments = [
        "--level",
        "mission",
        "--predictions",
        str(tmp_path / "out" / "predictions.jsonl"),
        "--data",
        str(data),
        "--out",
        str(tmp_path / "again"),
    ]
    assert CliRunner().invoke(app, arguments).exit_code == 0
    ours, again = (
        json.loads((tmp_path / name / "results.json").read_text())["rows"]
        for name in ("out", "again")
    )
    assert [row["metrics"] for row in again] == [row["metrics"] for row in ours]
    assert [row["label"] for row in again] == [row["label"] for row in ours]
    assert (tmp_path / "again" / "table.csv").read_text() == (
        tmp_path / "out" / "table.csv"
    ).read_text()


def test_former_results_are_neither_overwritten_nor_mixed_up(
    settings: Any, tmp_path: Path, data: Path
) -> None:
    run_bench(settings(latency_samples=0))
    with pytest.raises(PlannerError, match=r"--resume .*--overwrite"):
        run_bench(settings())
    mission_data(data, COUNT + 1)
    with pytest.raises(PlannerError, match="begun with another data"):
        run_bench(settings(resume=True))
    mission_data(data)
    with pytest.raises(PlannerError, match="another max-new-tokens"):
        run_bench(settings(resume=True, max_new_tokens=7))
    (tmp_path / "out" / "run.json").unlink()
    with pytest.raises(PlannerError, match="not of this run"):
        run_bench(settings(resume=True, max_new_tokens=7))
    run_bench(settings(overwrite=True, max_new_tokens=7, latency_samples=0))
    assert {line["tokens"] for line in lines(tmp_path / "out" / "predictions.jsonl")} == {7}


def test_an_adapter_that_was_trained_on_is_another_one(
    settings: Any, tmp_path: Path, adapter: Path
) -> None:
    from safetensors.numpy import load_file, save_file

    own = shutil.copytree(adapter, tmp_path / "own")
    run_bench(settings(adapters=(str(own),), latency_samples=0))
    weights = load_file(own / "adapter_model.safetensors")
    save_file(
        {name: value * 2 for name, value in weights.items()}, own / "adapter_model.safetensors"
    )
    with pytest.raises(PlannerError, match=rf"{NAME} lora was begun with another adapter"):
        run_bench(settings(adapters=(str(own),), resume=True))
    # The same bytes elsewhere are the same adapter.
    run_bench(settings(adapters=(str(adapter),), resume=True, latency_samples=0))


def test_a_run_that_cannot_start_removes_nothing(settings: Any, tmp_path: Path) -> None:
    run_bench(settings(latency_samples=0))
    before = answers(tmp_path / "out")
    for changes in (
        {"candidates": (NAME, "nonsense")},
        {"adapters": (str(tmp_path),)},
        {"data": tmp_path / "none"},
        {"configurations": ("magic",)},
    ):
        with pytest.raises(PlannerError):
            run_bench(settings(overwrite=True, **changes))
        assert answers(tmp_path / "out") == before


@pytest.mark.parametrize("level", ["mission", "task"])
def test_every_published_candidate_runs_at_both_levels(
    settings: Any, tmp_path: Path, models: Path, level: str, data: Path
) -> None:
    names = tuple(sorted(path.name for path in models.iterdir()))
    assert len(names) == 7
    test = data if level == "mission" else task_data(tmp_path / "task.jsonl")
    results = run_bench(
        settings(
            level=level,
            candidates=names,
            configurations=("base",),
            adapters=(),
            data=test,
            latency_samples=1,
            limit=2,
        )
    )
    assert [row.candidate for row in results.rows] == list(names)
    assert all(row.is_standin and row.n == 2 for row in results.rows)
    if level == "task":
        # An answer that does not parse is no hallucination in the published table of this level.
        assert all(
            row.metrics["hallucination"].value == 0
            and row.metrics["hallucination_with_unparsed"].value == 1
            for row in results.rows
        )


def test_adapters_are_given_per_candidate(settings: Any, tmp_path: Path, adapter: Path) -> None:
    with pytest.raises(PlannerError, match="NAME=DIR for each"):
        run_bench(settings(candidates=(NAME, "Qwen2.5-3B"), adapters=(str(adapter),)))
    with pytest.raises(PlannerError, match=r"adapters/Qwen2\.5-3B/mission"):
        run_bench(settings(candidates=(NAME, "Qwen2.5-3B"), adapters=(f"{NAME}={adapter}",)))
    with pytest.raises(PlannerError, match="already"):
        run_bench(settings(adapters=(str(adapter), str(adapter))))
    with pytest.raises(PlannerError, match="Qwen"):
        run_bench(settings(candidates=("Qwen2.5-3B",), adapters=(str(adapter),)))
    assert not (tmp_path / "out" / "predictions.jsonl").exists()


def test_a_prompt_longer_than_the_context_is_recorded_as_an_error(
    settings: Any, tmp_path: Path, models: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    shutil.copytree(models / NAME, tmp_path / "models" / "short")
    config = tmp_path / "models" / "short" / "config.json"
    config.write_text(json.dumps({**json.loads(config.read_text()), "max_position_embeddings": 64}))
    results = run_bench(
        settings(
            candidates=(str(config.parent),),
            configurations=("base",),
            adapters=(),
            latency_samples=0,
        )
    )
    assert results.rows[0].finish_reasons == {"error": COUNT}
    assert all(
        "context of 64" in line["error"] and line["output"] == ""
        for line in lines(tmp_path / "out" / "predictions.jsonl")
    )


def test_a_full_disk_is_one_sentence_and_keeps_what_is_there(tmp_path: Path) -> None:
    class Full:
        def write(self, _line: bytes) -> int:
            raise OSError(28, "No space left on device")

        def close(self) -> None:
            pass

    with RecordLog(tmp_path / "predictions.jsonl") as log:
        log.append({"key": "k", "id": "a"})
        log.stream.close()
        log.stream = Full()  # type: ignore[assignment]
        with pytest.raises(PlannerError, match=r"No space left.*--resume"):
            log.append({"key": "k", "id": "b"})
    with RecordLog(tmp_path / "predictions.jsonl") as log:
        assert set(log.of_key("k")) == {"a"}


def test_a_damaged_log_is_named_by_line(tmp_path: Path) -> None:
    path = tmp_path / "predictions.jsonl"
    path.write_text('{"key":"k","id":"a"}\nrubbish\n{"key":"k","id":"b"}\n')
    with pytest.raises(PlannerError, match=r"predictions\.jsonl:2: not JSON"):
        RecordLog(path)


def test_any_text_that_a_model_writes_is_kept(tmp_path: Path) -> None:
    texts = ["\u2028\x00\x7f", '{"a": "\\ud800"}', "é🚤\n\r\n"]
    with RecordLog(tmp_path / "p.jsonl") as log:
        for index, text in enumerate(texts):
            log.append({"key": "k", "id": str(index), "output": text, "parsed": {"a": text}})
    with RecordLog(tmp_path / "p.jsonl") as log:
        assert [log.of_key("k")[str(index)]["output"] for index in range(len(texts))] == texts


def invoke(*arguments: str | Path) -> Any:
    app = typer.Typer()
    app.command()(bench)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_ctrl_c_says_how_to_go_on(
    settings: Any, tmp_path: Path, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    answering = Engine.answers

    def interrupted(self: Engine, *args: Any, **kwargs: Any) -> Any:
        for count, item in enumerate(answering(self, *args, **kwargs)):
            if count == 3:
                raise KeyboardInterrupt
            yield item

    monkeypatch.setattr(Engine, "answers", interrupted)
    monkeypatch.setattr(
        "sys.argv", ["/bin/plannerft", "bench", "--level", "mission", "--overwrite"]
    )
    arguments = (
        "--level",
        "mission",
        "--candidates",
        NAME,
        "--configurations",
        "base",
        "--data",
        data,
        "--out",
        tmp_path / "out",
        "--max-new-tokens",
        3,
    )
    result = invoke(*arguments, "--device", "cpu")
    assert result.exit_code == 130
    assert f"3 answers are kept in {tmp_path / 'out' / 'predictions.jsonl'}" in result.stderr
    assert "plannerft bench --level mission --resume" in result.stderr


def test_a_ctrl_c_that_a_library_swallows_is_not_lost(
    tmp_path: Path, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    load = engine_module.load_model

    def swallowing(*args: Any, **kwargs: Any) -> Any:
        with contextlib.suppress(KeyboardInterrupt):
            signal.raise_signal(signal.SIGINT)
        return load(*args, **kwargs)

    monkeypatch.setattr(engine_module, "load_model", swallowing)
    handler = signal.getsignal(signal.SIGINT)
    arguments = (
        "--level",
        "mission",
        "--candidates",
        NAME,
        "--configurations",
        "base",
        "--data",
        data,
        "--out",
        tmp_path / "out",
        "--max-new-tokens",
        3,
    )
    result = invoke(*arguments)
    assert result.exit_code == 130
    assert "0 answers are kept" in result.stderr
    assert signal.getsignal(signal.SIGINT) is handler


def test_the_command_prints_the_table(tmp_path: Path, data: Path) -> None:
    arguments = (
        "--level",
        "mission",
        "--candidates",
        NAME,
        "--configurations",
        "base",
        "--data",
        data,
        "--out",
        tmp_path / "out",
        "--max-new-tokens",
        3,
    )
    result = invoke(*arguments, "--limit", 1, "--latency-samples", 0, "--no-report")
    assert result.exit_code == 0
    assert "strictly" in result.stdout
    assert "(stand-in)" in result.stdout
    assert f"{NAME} base: answers 1/1" in result.stderr


@pytest.mark.parametrize(
    ("arguments", "problem"),
    [
        ((), "--level and --candidates"),
        (("--level", "mission"), "--level and --candidates"),
        (("--level", "x", "--candidates", NAME), "--level x"),
        (("--level", "mission", "--candidates", ","), "--candidates: name at least one"),
        (("--level", "mission", "--candidates", "Lama"), "unknown candidate"),
        (
            ("--level", "mission", "--candidates", NAME, "--configurations", "lora+x"),
            r"--configurations lora\+x",
        ),
        (("--level", "mission", "--candidates", NAME, "--batch-size", "0"), "--batch-size 0"),
        (
            ("--level", "mission", "--candidates", NAME, "--max-new-tokens", "99999"),
            "--max-new-tokens 99999",
        ),
        (
            ("--level", "mission", "--candidates", NAME, "--latency-samples", "-1"),
            "--latency-samples -1",
        ),
        (
            ("--level", "mission", "--candidates", NAME, "--quantization", "int3"),
            "--quantization int3",
        ),
        (
            ("--level", "mission", "--candidates", NAME, "--resume", "--overwrite"),
            "give one of them",
        ),
        (
            (
                "--level",
                "mission",
                "--candidates",
                NAME,
                "--configurations",
                "base",
                "--device",
                "tpu",
            ),
            "--device tpu",
        ),
    ],
)
def test_bad_flags_are_one_sentence(
    models: Path, tmp_path: Path, data: Path, arguments: tuple[str, ...], problem: str
) -> None:
    result = invoke(*arguments, "--data", data, "--out", tmp_path / "out")
    assert isinstance(result.exception, PlannerError)
    with pytest.raises(PlannerError, match=problem):
        raise result.exception


def test_a_limit_that_a_later_configuration_cannot_keep_is_refused_before_the_first(
    settings: Any, tmp_path: Path, work: dict[str, int]
) -> None:
    with pytest.raises(PlannerError, match="--max-new-tokens 6: at strength schema"):
        run_bench(settings(configurations=("base", "base+schema"), adapters=()))
    assert work["rows"] == 0


def test_a_read_only_or_impossible_output_folder_is_one_sentence(
    settings: Any, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(PlannerError, match="--out"):
        run_bench(settings(out=tmp_path / "file" / "out"))
    with pytest.raises(PlannerError, match="--out"):
        run_bench(settings(out=Path("/proc/none")))


def test_a_run_folder_is_scored_again_without_a_model(
    settings: Any, tmp_path: Path, data: Path, work: dict[str, int]
) -> None:
    run_bench(settings())
    done, app = dict(work), typer.Typer()
    app.command()(score)
    again = tmp_path / "again"
    assert (
        CliRunner().invoke(app, ["--run", str(tmp_path / "out"), "--out", str(again)]).exit_code
        == 0
    )
    assert work == done
    assert (again / "table.csv").read_text() == (tmp_path / "out" / "table.csv").read_text()
    first, second = (
        json.loads((folder / "results.json").read_text())["rows"]
        for folder in (tmp_path / "out", again)
    )
    assert second == first
    mission_data(data, COUNT + 1)
    result = CliRunner().invoke(app, ["--run", str(tmp_path / "out")])
    assert isinstance(result.exception, PlannerError)
    assert "is not the data that" in str(result.exception)


def test_a_folder_holds_answers_to_one_data_set(settings: Any, data: Path) -> None:
    run_bench(settings(configurations=("base",), adapters=(), latency_samples=0))
    mission_data(data, COUNT + 1)
    with pytest.raises(PlannerError, match="begun with another data"):
        run_bench(
            settings(configurations=("base+schema",), adapters=(), latency_samples=0, resume=True)
        )


def test_answers_do_not_depend_on_the_batch_size(settings: Any, tmp_path: Path) -> None:
    for size in (1, 2, 3, None):
        run_bench(settings(out=tmp_path / str(size), batch_size=size, latency_samples=0))
    assert (
        answers(tmp_path / "1")
        == answers(tmp_path / "2")
        == answers(tmp_path / "3")
        == answers(tmp_path / "None")
    )
    assert {line["batch"] for line in lines(tmp_path / "3" / "predictions.jsonl")} == {3, 2}
    assert {line["batch"] for line in lines(tmp_path / "None" / "predictions.jsonl")} == {COUNT}


def test_a_device_whose_memory_is_full_gets_smaller_batches(
    settings: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    import torch

    run_bench(settings(out=tmp_path / "whole", latency_samples=0))
    batch, sizes = generate_module._run, []

    def full(decoder: Any, rows: Any, *args: Any) -> Any:
        sizes.append(len(rows))
        if len(rows) > 1:
            raise torch.OutOfMemoryError("CUDA out of memory")
        return batch(decoder, rows, *args)

    monkeypatch.setattr(generate_module, "_run", full)
    run_bench(settings(batch_size=4, latency_samples=0))
    assert sizes == [4, 2] + [1] * 2 * COUNT
    assert answers(tmp_path / "out") == answers(tmp_path / "whole")


def test_costs_are_in_the_results(settings: Any, tmp_path: Path) -> None:
    results = run_bench(settings())
    for row in results.rows:
        assert row.costs["n"] == TIMED
        assert 0 < row.costs["first_token_s"]["value"] < row.costs["latency_s"]["p99"]["value"]
        assert row.costs["latency_s"]["median"]["value"] <= row.costs["latency_s"]["p90"]["value"]
        assert row.costs["tokens_per_s"]["value"] > 0
        assert row.costs["load_s"] > 0
        assert row.costs["adapter_swap_s"] > 0
        assert row.costs["peak_memory_bytes"] > 2**27
    assert "Adapter switch" in (tmp_path / "out" / "table.md").read_text()
    # What a run cost is kept when it is scored again.
    again = run_bench(settings(resume=True))
    assert [row.costs for row in again.rows] == [row.costs for row in results.rows]


def test_planning_is_timed_with_both_agents_and_only_once(
    tmp_path: Path, data: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from planner_ft.benchmark import runner

    monkeypatch.delenv("PLANNERFT_MODELS")
    monkeypatch.setattr(runner, "MOST", 2)
    common: dict[str, Any] = {
        "level": "mission",
        "candidates": ("embedded",),
        "configurations": ("base",),
        "data": data,
        "out": tmp_path / "out",
    }
    common |= {"limit": 1, "latency_samples": 0, "planning_samples": 1, "device": "cpu"}
    results = run_bench(BenchSettings(**common))
    written = lines(tmp_path / "out" / "planning.jsonl")
    assert [line["id"] for line in written] == ["tasks1-0", "tasks2-0"]
    assert all(line["seconds"] >= line["mission_s"] > 0 for line in written)
    assert [entry["tasks"] for entry in results.rows[0].costs["planning"]] == sorted(
        {line["tasks"] for line in written}
    )
    run_bench(BenchSettings(**common, resume=True))
    assert lines(tmp_path / "out" / "planning.jsonl") == written
    with pytest.raises(PlannerError, match="--planning-samples"):
        BenchSettings(**{**common, "level": "task"})


def test_an_adapter_that_was_trained_on_the_samples_is_said(
    settings: Any, tmp_path: Path, data: Path, adapter: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = shutil.copytree(adapter, tmp_path / "trained")
    (folder / "samples.txt").write_text(f"{input_digest('Go to 1, 1: and look  around')}\n")
    done = run_bench(settings(adapters=(str(folder),), limit=2, latency_samples=0))
    assert [one.to_json()["seen"] for one in done.rows] == [0, 1]
    said = "1 of 2 samples were in its adapter's training or validation data"
    assert said in (tmp_path / "out" / "table.md").read_text()
    print_warnings(done, Console(stderr=True))
    assert f"warning: {done.rows[1].name}: {said}" in capsys.readouterr().err
    inputs = {"training": {"path": "copied.jsonl", "sha256": sha256_file(data)}}
    (folder / "manifest.json").write_text(json.dumps({"inputs": inputs}))
    plan = make_plan(settings(adapters=(str(folder),)))
    assert [job.system.seen for job in plan.jobs] == [0, COUNT]
