"""Settings: the published defaults, which source wins, and that every mistake is named at once."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import pytest

from planner_ft.support.errors import PlannerError
from planner_ft.training.request import BUNDLED, build_request, bundled_recipes
from planner_ft.training.settings import (
    ABOUT,
    FIELDS,
    PUBLISHED,
    Source,
    TrainSettings,
    departures,
    resolve_settings,
)


def resolved(*sources: Source, level: str = "mission"):
    problems: list[str] = []
    result = resolve_settings(level, sources, problems)
    assert problems == []
    return result


def test_the_published_settings_are_the_defaults():
    mission, task = resolved()[0], resolved(level="task")[0]
    assert (mission.rank, mission.epochs, task.rank, task.epochs) == (16, 5, 8, 2)
    for settings in (mission, task):
        assert (settings.learning_rate, settings.batch_size, settings.quantization) == (
            2e-4,
            1,
            "nf4",
        )


def test_flag_beats_recipe_beats_candidate_beats_published():
    flag, recipe = (
        Source("flag", {"rank": 2, "epochs": None}),
        Source("r.toml", {"rank": 3, "epochs": 4}),
    )
    candidate = Source("embedded", {"rank": 5, "epochs": 6.0, "learning_rate": 1e-3})
    found, origin = resolved(flag, recipe, candidate)
    assert (found.rank, found.epochs, found.learning_rate, found.batch_size) == (2, 4, 1e-3, 1)
    assert [
        origin[name] for name in ("rank", "epochs", "learning_rate", "batch_size", "dropout")
    ] == ["flag", "r.toml", "embedded", "published", "default"]


def test_departures_from_the_published_settings_are_said():
    result = resolved(Source("embedded", {"learning_rate": 1e-3}))
    assert departures("mission", *result) == [
        "learning rate 0.001 (embedded) instead of the published 0.0002"
    ]
    assert departures("mission", *resolved()) == []


def test_alpha_follows_the_rank_unless_it_is_given():
    assert resolved(Source("flag", {"rank": 4}))[0].lora_alpha == 8
    assert resolved(Source("flag", {"rank": 4, "alpha": 5}))[0].lora_alpha == 5


@pytest.mark.parametrize(
    ("name", "value", "message"),
    [
        ("rank", 0, "must be at least 1"),
        ("rank", "eight", "must be a number"),
        ("rank", True, "must be a number"),
        ("epochs", 1.5, "must be a whole number"),
        ("learning_rate", 0, "must be greater than 0"),
        ("learning_rate", float("nan"), "must be a number"),
        ("dropout", 0.95, "must be at most 0.9"),
        ("schedule", "cos", "must be one of cosine, linear, constant"),
        ("keep_checkpoints", "yes", "must be true or false"),
        ("device", 3, "must be text"),
    ],
)
def test_a_bad_value_is_named_with_its_flag(name, value, message):
    problems: list[str] = []
    resolve_settings("mission", [Source("flag", {name: value})], problems)
    assert problems == [f"--{name.replace('_', '-')} = {value!r}: {message}"]


def test_all_configuration_errors_are_reported_at_once(tmp_path: Path):
    recipe = tmp_path / "mine.toml"
    recipe.write_text('level = "misson"\nlerning_rate = 1e-4\nepochs = -1\n')
    with pytest.raises(PlannerError) as caught:
        build_request(
            {"candidate": "Llama-9"}, {"rank": 0}, recipe=str(recipe), overwrite=True, resume=True
        )
    message = str(caught.value)
    assert "--level misson" in message
    assert "unknown candidate 'Llama-9'" in message
    assert "--rank = 0: must be at least 1" in message
    assert f"{recipe}: lerning_rate is no setting; did you mean learning_rate?" in message
    assert f"{recipe}: epochs = -1: must be at least 1" in message
    assert "--overwrite and --resume exclude each other" in message
    assert "[6/6]" in message


@pytest.mark.parametrize(
    ("run", "part"),
    [
        ({}, "--level is missing"),
        ({"level": "mission"}, "--candidate is missing"),
        ({"level": "x", "candidate": "embedded"}, "--level x"),
    ],
)
def test_what_is_missing_is_named(run, part):
    with pytest.raises(PlannerError, match=part):
        build_request(run, {})


def test_a_recipe_that_is_missing_names_the_bundled_ones():
    with pytest.raises(PlannerError, match="mission-llama"):
        build_request({"level": "mission", "candidate": "embedded"}, {}, recipe="nope")


def test_data_and_output_have_places_of_their_own():
    request = build_request({"level": "task", "candidate": "Qwen2.5-3B"}, {})
    assert (request.train_file, request.validation_file) == (
        Path("data/task/train.jsonl"),
        Path("data/task/validation.jsonl"),
    )
    assert request.output == Path("adapters/Qwen2.5-3B/task")


@pytest.mark.parametrize("name", bundled_recipes())
def test_a_bundled_recipe_runs_by_its_first_line_and_says_every_setting(name):
    first = (BUNDLED / f"{name}.toml").read_text().splitlines()[0]
    assert first == f"# plannerft train --recipe {name}"
    request = build_request({}, {}, recipe=name)
    for setting in FIELDS:
        if ABOUT[setting]["panel"] != "Run" and setting not in (
            "max_samples",
            "max_steps",
            "augment",
            "vary",
            "borrow",
            "select",
            "blend",
            "validation_answers",
        ):
            assert request.origin[setting].endswith(f"{name}.toml"), setting
    assert request.departures() == []
    assert request.settings.learned() == TrainSettings(**PUBLISHED[request.level]).learned()


def test_settings_are_frozen():
    with pytest.raises(dataclasses.FrozenInstanceError):
        resolved()[0].rank = 3


def test_every_setting_is_a_flag():
    import typer

    from planner_ft.cli.train import train

    app = typer.Typer()
    app.command()(train)
    flags = {flag for parameter in typer.main.get_command(app).params for flag in parameter.opts}
    assert {f"--{name.replace('_', '-')}" for name in FIELDS} <= flags


def test_each_embedded_candidate_has_settings_of_its_own():
    run = {"level": "mission", "candidate": "embedded"}
    own, other = (
        build_request({**run, "vocabulary": name}, {}) for name in ("usv", "inspection_drone")
    )
    assert own.origin["learning_rate"] == "embedded"
    assert other.origin["learning_rate"] == "embedded-reader"
    assert other.settings.learning_rate > 10 * own.settings.learning_rate
    real = build_request({**run, "candidate": "Qwen2.5-3B", "vocabulary": "inspection_drone"}, {})
    assert real.departures() == []
