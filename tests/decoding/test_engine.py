"""One loaded base answers as both agents, with the adapter of each or none."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import adapter_record
from planner_ft.candidates.loading import load_model
from planner_ft.decoding import generate as generate_module
from planner_ft.decoding.configurations import STRENGTHS, Configuration, Strength
from planner_ft.decoding.engine import Engine
from planner_ft.decoding.passes import ModelDecoder
from planner_ft.decoding.sequence import Query
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import Level

NAME = "Qwen2.5-3B"
BASE, LORA = Configuration(False), Configuration(True)
RECORDS: dict[Level, dict[str, Any]] = {
    "mission": {"prompt": "Find the red buoy and come home."},
    "task": {
        "task": "Transit",
        "parameters": {"target_position": [3, 4]},
        "prompt": "Go to [3, 4].",
    },
}


def adapter_folder(candidate: Candidate, level: Level, seed: int, folder: Path) -> Path:
    """An untrained adapter that changes the answers."""
    from peft import LoraConfig, get_peft_model

    torch.manual_seed(seed)
    config = LoraConfig(
        r=4,
        lora_alpha=64,
        target_modules="all-linear",
        task_type="CAUSAL_LM",
        init_lora_weights=False,
    )
    get_peft_model(load_model(candidate, device="cpu", trainable=True), config).save_pretrained(
        folder, save_embedding_layers=False
    )
    write_json(folder / "manifest.json", adapter_record(candidate, level, load_vocabulary()))
    return folder


@pytest.fixture(scope="module")
def adapters(standins: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[Level, Path]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANNERFT_MODELS", str(standins))
        candidate = resolve_candidate(NAME)
        return {
            level: adapter_folder(candidate, level, seed, tmp_path_factory.mktemp(level))
            for seed, level in enumerate(RECORDS)
        }


def load(**settings: Any) -> Engine:
    return Engine.load(
        resolve_candidate(NAME), load_vocabulary(), device="cpu", max_new_tokens=12, **settings
    )


def answers(engine: Engine, level: Level, *configurations: Configuration) -> list[tuple[int, ...]]:
    return [
        engine.answer(engine.query(level, RECORDS[level]), configuration).ids
        for configuration in configurations
    ]


@pytest.mark.parametrize("lean", [False, True])
def test_one_base_serves_both_adapters_and_none(
    models: Path, adapters: dict[Level, Path], lean: bool
) -> None:
    both = load(adapters=adapters, lean=lean)
    assert set(both.lean) == ({None, "mission", "task"} if lean else set())
    of_both = {level: answers(both, level, BASE, LORA, BASE, LORA) for level in RECORDS}
    plain = load(lean=lean)
    for level, (base, lora, base_again, lora_again) in of_both.items():
        alone = load(adapters={level: adapters[level]}, lean=lean)
        assert [base] == answers(plain, level, BASE)
        assert [lora] == answers(alone, level, LORA)
        assert (base, lora) == (base_again, lora_again)
        assert base != lora


def test_a_level_without_an_adapter_has_no_lora_configuration(
    models: Path, adapters: dict[Level, Path]
) -> None:
    engine = load(adapters={"mission": adapters["mission"]})
    with pytest.raises(PlannerError, match="lora needs an adapter of the task level"):
        engine.answer(engine.query("task", RECORDS["task"]), LORA)


def test_an_adapter_of_the_other_level_is_refused(
    models: Path, adapters: dict[Level, Path]
) -> None:
    with pytest.raises(PlannerError, match="adapter of the mission level, not of the task level"):
        load(adapters={"task": adapters["mission"]})


def test_queries_of_two_levels_are_not_mixed(models: Path) -> None:
    engine = load()
    with pytest.raises(ValueError, match="one level"):
        list(engine.answers([Query("mission", {}, (1,)), Query("task", {}, (1,))], BASE))


def test_stand_ins_are_decoded_as_what_they_stand_for(models: Path) -> None:
    engine = load()
    with engine.configured("mission", BASE) as decoder:
        assert isinstance(decoder, ModelDecoder)


@pytest.fixture(scope="module")
def embedded() -> Engine:
    return Engine.load(resolve_candidate("embedded"), load_vocabulary(), device="cpu", threads=1)


@pytest.mark.parametrize("strength", STRENGTHS)
def test_what_saves_passes_changes_no_answer(embedded: Engine, strength: Strength) -> None:
    command = "Find the rusty mooring buoy, film its shackle for a minute, then come home."
    queries = [embedded.query("mission", {"prompt": command})]
    configuration = Configuration(False, strength)
    slow, forced, fast = (
        replace(embedded, fast_forward=fast_forward, drafting=drafting)
        for fast_forward, drafting in ((False, False), (True, False), (True, True))
    )
    expected = [slow.answer(query, configuration) for query in queries]
    assert all(
        answer.finish_reason == "stop" and answer.forward_passes == len(answer.ids)
        for answer in expected
    )
    for engine, most in ((forced, 1.0), (fast, 0.5)):
        answers = [engine.answer(query, configuration) for query in queries]
        assert [engine.text(answer) for answer in answers] == [
            slow.text(answer) for answer in expected
        ]
        assert sum(answer.forward_passes for answer in answers) <= most * sum(
            len(answer.ids) for answer in answers
        )
        if strength != "free" or engine is fast:
            assert any(answer.forward_passes < len(answer.ids) for answer in answers)


def test_batches_and_single_queries_give_the_same_answers(embedded: Engine) -> None:
    queries = [
        embedded.query(
            "mission", {"prompt": f"Go to [{x}, {-3 * x}]{' and look around' * (x % 4)}."}
        )
        for x in range(6)
    ]
    together = dict(embedded.answers(queries, BASE, batch_size=6))
    for index, query in enumerate(queries):
        alone = embedded.answer(query, BASE)
        assert (together[index].ids, together[index].forward_passes) == (
            alone.ids,
            alone.forward_passes,
        )


def test_latency_is_of_single_queries_after_one_that_is_not_counted(
    embedded: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    calls: list[list[Query]] = []
    generate = generate_module.generate

    def counting(*args: Any) -> Any:
        calls.append(args[1])
        return generate(*args)

    monkeypatch.setattr(generate_module, "generate", counting)
    queries = [embedded.query("mission", {"prompt": f"Go to [{x}, 5]."}) for x in (3, 4, 5)]
    measured = dict(embedded.latencies(queries, BASE))
    assert calls == [[query] for query in (queries[0], *queries)]
    assert sorted(measured) == [0, 1, 2]
    for index, one in measured.items():
        alone = embedded.answer(queries[index], BASE)
        assert one.seconds > 0
        assert (one.ids, one.forward_passes) == (alone.ids, alone.forward_passes)
    assert not list(embedded.latencies([], BASE))
