"""Which agents there are, and that never two bases are in memory."""

from __future__ import annotations

import gc
import shutil
import weakref
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.adapters import adapter_record
from planner_ft.candidates.loading import load_model
from planner_ft.decoding import engine as engine_module
from planner_ft.decoding.configurations import STRENGTHS
from planner_ft.planning.planner import Planner
from planner_ft.planning.settings import Agent, PlanSettings, choose_agents, untrained
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level

QWEN, LLAMA = "Qwen2.5-3B", "Llama-3.2-1B"
STRONGEST = STRENGTHS[-1]
RECORDS: dict[Level, dict[str, Any]] = {
    "mission": {"prompt": "go home"},
    "task": {"task": "Transit", "parameters": {}, "prompt": "go home"},
}


def choose(**settings: Any) -> dict[Level, Agent]:
    return choose_agents(
        PlanSettings(**settings), load_vocabulary(settings.get("vocabulary", "usv"))
    )


@pytest.fixture(scope="module")
def trained(standins: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder `adapters` with an adapter of each level for Qwen's stand-in."""
    from peft import LoraConfig, get_peft_model

    folder = tmp_path_factory.mktemp("work") / "adapters"
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANNERFT_MODELS", str(standins))
        candidate = resolve_candidate(QWEN)
    for seed, level in enumerate(LEVELS):
        torch.manual_seed(seed)
        config = LoraConfig(
            r=4, target_modules="all-linear", task_type="CAUSAL_LM", init_lora_weights=False
        )
        get_peft_model(load_model(candidate, device="cpu", trainable=True), config).save_pretrained(
            folder / QWEN / level, save_embedding_layers=False
        )
        write_json(
            folder / QWEN / level / "manifest.json",
            adapter_record(candidate, level, load_vocabulary()),
        )
    return folder


@pytest.fixture
def here(models: Path, trained: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A working folder with ./adapters of Qwen's stand-in."""
    shutil.copytree(trained, tmp_path / "adapters")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_the_default_is_the_strongest_decoding_with_the_adapter_where_there_is_one(
    here: Path,
) -> None:
    shutil.rmtree(here / "adapters" / QWEN / "task")
    agents = choose(candidate=QWEN)
    assert (
        agents["mission"].configuration.name == f"lora+{STRONGEST}"
        and agents["mission"].adapter == Path("adapters") / QWEN / "mission"
    )
    assert (
        agents["task"].configuration.name == f"base+{STRONGEST}" and agents["task"].adapter is None
    )
    assert [agent.with_vocabulary for agent in agents.values()] == [False, True]


def test_configurations_are_chosen_for_both_agents_or_for_one(here: Path) -> None:
    agents = choose(candidate=QWEN, configuration="lora", task_configuration="base")
    assert [agent.configuration.name for agent in agents.values()] == ["lora", "base"]
    assert agents["task"].adapter is None


def test_adapters_may_lie_anywhere(here: Path) -> None:
    (here / "adapters").rename(here / "mine")
    assert choose(candidate=QWEN)["mission"].adapter is None
    agents = choose(candidate=QWEN, mission_adapter=here / "mine" / QWEN / "mission")
    assert agents["mission"].configuration.adapter and not agents["task"].configuration.adapter


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        (
            {"candidate": LLAMA, "configuration": "lora"},
            (
                "Llama-3.2-1B has no adapter of the mission level here; train one with `plannerft"
                " train"
            ),
        ),
        (
            {"candidate": QWEN, "configuration": "base", "mission_adapter": "x"},
            "--mission-adapter x: configuration base uses no adapter",
        ),
        ({"candidate": QWEN, "mission_adapter": "x"}, "x: no such adapter folder"),
        (
            {"candidate": LLAMA, "task_adapter": f"adapters/{QWEN}/task"},
            "trained on Qwen2.5-3B (stand-in) and does not fit Llama-3.2-1B (stand-in)",
        ),
        (
            {"candidate": QWEN, "task_adapter": f"adapters/{QWEN}/mission"},
            "this is an adapter of the mission level",
        ),
        (
            {"candidate": QWEN, "mission_only": True, "task_candidate": LLAMA},
            "--task-candidate: there is no Task Agent with --mission-only",
        ),
        ({"candidate": "Qwen3"}, "unknown candidate 'Qwen3'"),
        ({"candidate": QWEN, "configuration": "best"}, "best: unknown"),
        ({"quantization": "int8"}, "--quantization int8: must be nf4 or none"),
    ],
)
def test_what_does_not_go_together_is_one_sentence(
    here: Path, settings: dict[str, Any], message: str
) -> None:
    with pytest.raises(PlannerError) as error:
        choose(**settings)
    assert message in str(error.value) and "\n" not in str(error.value)


def test_an_adapter_of_another_vocabulary_is_not_this_planners(here: Path) -> None:
    assert choose(candidate=QWEN, vocabulary="inspection_drone")["mission"].adapter is None
    with pytest.raises(PlannerError, match="trained with the vocabulary usv, not inspection_drone"):
        choose(
            candidate=QWEN,
            vocabulary="inspection_drone",
            mission_adapter=f"adapters/{QWEN}/mission",
        )


@pytest.fixture
def loads(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Folders of the bases that are loaded, in order; loading fails while an earlier one is in
    memory.
    """
    names: list[str] = []
    alive: list[weakref.ref[Any]] = []
    load: Callable[..., Any] = engine_module.load_model

    def loading(candidate: Any, **settings: Any) -> Any:
        gc.collect()
        assert not any(model() is not None for model in alive), "two bases in memory"
        model = load(candidate, **settings)
        names.append(candidate.name)
        alive.append(weakref.ref(model))
        return model

    monkeypatch.setattr(engine_module, "load_model", loading)
    return names


def ask_both(planner: Planner) -> None:
    for engine in (planner.agents.load(level) for level in LEVELS):
        engine.limits = {
            level: type(limits)(limits.end_ids, 8) for level, limits in engine.limits.items()
        }
    for level in LEVELS:
        assert not planner.agents.ask(level, RECORDS[level]).plan


def test_agents_of_one_candidate_share_a_base_with_an_adapter_each(
    here: Path, loads: list[str]
) -> None:
    planner = Planner.load(QWEN, configuration="lora", device="cpu")
    ask_both(planner)
    ask_both(planner)
    assert loads == [QWEN]
    engine = planner.agents.load("task")
    assert engine.adapters == set(LEVELS)


def test_records_are_answered_together_as_one_by_one(here: Path) -> None:
    agents = Planner.load(QWEN, configuration="lora", device="cpu").agents
    engine = agents.load("mission")
    engine.limits = {
        level: type(limits)(limits.end_ids, 8) for level, limits in engine.limits.items()
    }
    records = [{"prompt": text} for text in ("go home", "hold here for two minutes")]
    alone = [agents.ask("mission", record).text for record in records]
    answers = dict(agents.ask_each("mission", records))
    assert [answers[at].text for at in range(2)] == alone
    assert alone[0] and alone[1]


def test_a_small_model_answers_several_tasks_in_the_passes_of_one() -> None:
    agents = Planner.load().agents
    agents.load("task")
    given = [("Transit", {"target_position": [x, 20]}, f"Go to [{x}, 20].") for x in (40, 50, 60)]
    records = [{"task": task, "parameters": own, "prompt": text} for task, own, text in given]
    alone = [agents.ask("task", record) for record in records]
    ends = list(agents.ask_each("task", records))
    assert sorted(at for at, _answer in ends) == [0, 1, 2]
    assert [dict(ends)[at].text for at in range(3)] == [answer.text for answer in alone]
    assert all(answer.plan for answer in alone)
    most = max(answer.forward_passes for answer in alone)
    assert max(answer.forward_passes for _at, answer in ends) <= most + 2


def test_of_two_candidates_the_first_is_released_before_the_second_is_loaded(
    here: Path, loads: list[str]
) -> None:
    planner = Planner.load(
        configuration="base", mission_candidate=QWEN, task_candidate=LLAMA, device="cpu"
    )
    assert loads == [QWEN]
    engine = planner.agents.load("mission")
    del engine
    planner.agents.load("task")
    assert loads == [QWEN, LLAMA]
    assert planner.agents.load_seconds["mission"] > 0 and planner.agents.load_seconds["task"] > 0
    assert planner.agents.peak_memory() > 2**20


def test_two_precisions_of_one_candidate_are_two_bases(models: Path) -> None:
    four_bit, whole = (
        choose(candidate=QWEN, configuration="base", quantization=quantization)
        for quantization in ("nf4", "none")
    )
    assert four_bit["mission"].base == four_bit["task"].base != whole["task"].base


def test_with_the_mission_agent_alone_no_other_base_is_loaded(here: Path, loads: list[str]) -> None:
    planner = Planner.load(
        mission_candidate=QWEN, configuration="base", mission_only=True, device="cpu"
    )
    planner.agents.load("mission")
    assert loads == [QWEN] and list(planner.agents.agents) == ["mission"]


def test_what_is_released_can_be_loaded_again(here: Path, loads: list[str]) -> None:
    with Planner.load(QWEN, configuration="base", device="cpu") as planner:
        pass
    planner.agents.load("mission")
    assert loads == [QWEN, QWEN]


def test_the_record_of_an_agent_names_weights_and_adapter_by_their_digests(here: Path) -> None:
    before = choose(candidate=QWEN)["mission"].record()
    assert before["standin"] and before["adapter"] == f"adapters/{QWEN}/mission"
    config = here / "adapters" / QWEN / "mission" / "adapter_config.json"
    write_json(config, {**read_json(config), "lora_alpha": 99})
    after = choose(candidate=QWEN)["mission"].record()
    assert (
        after["weights_sha256"] == before["weights_sha256"]
        and after["adapter_sha256"] != before["adapter_sha256"]
    )


def test_an_agent_that_was_never_trained_for_the_vehicle_is_named() -> None:
    drone = load_vocabulary("inspection_drone")
    agents = choose(vocabulary="inspection_drone", configuration="base+schema")
    mission, task = untrained(agents, drone)
    assert mission.startswith("the mission agent (") and "its tasks are a guess" in mission
    assert "its steps are a guess; train one with `plannerft train --level task" in task
    trained = {level: replace(one, adapter=Path("any")) for level, one in agents.items()}
    assert not list(untrained(trained, drone))
    assert not list(untrained(choose(configuration="base+schema"), load_vocabulary("usv")))
