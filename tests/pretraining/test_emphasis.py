"""Which samples a further stage of pretraining keeps: the hard ones, told from their inputs."""

from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import torch

from planner_ft.pretraining.corpus import (
    encode_shard,
    encoded,
    load_shard,
    rows_of,
    tokenizer_texts,
)
from planner_ft.pretraining.emphasis import (
    FLOOR,
    Emphasis,
    Encoded,
    features,
    fit,
    token_weights,
    weighted_losses,
)
from planner_ft.pretraining.loop import PretrainSettings, completion_loss, new_model
from planner_ft.pretraining.tokenizer import train_tokenizer
from planner_ft.vocabulary import load_vocabulary

VOCABULARY = load_vocabulary()
TINY = PretrainSettings(hidden=32, layers=1, heads=2, feed_forward=64)


@pytest.fixture(scope="module")
def tokenizer() -> Any:
    return train_tokenizer(tokenizer_texts(VOCABULARY, 0, 300, 0.5), VOCABULARY, size=1200)


@pytest.fixture(scope="module")
def samples(tokenizer: Any) -> list[Encoded]:
    drawn = encoded(tokenizer, VOCABULARY, seed=5, mission_share=0.5, longest=1024)
    return [sample for sample in islice(drawn, 160) if sample is not None]


@pytest.fixture(scope="module")
def emphasis(samples: list[Encoded]) -> Emphasis:
    """Mission samples are hard here, task samples easy."""
    losses = [len(sample.ids) * (0.2 if sample.level == "mission" else 0.002) for sample in samples]
    return fit(samples, losses, 0.6)


def test_hard_samples_are_kept_more_often_and_none_is_shut_out(
    samples: list[Encoded], emphasis: Emphasis
) -> None:
    kept = {
        level: [emphasis.probability(sample) for sample in samples if sample.level == level]
        for level in ("mission", "task")
    }
    assert np.mean(kept["mission"]) > 2 * np.mean(kept["task"])
    assert min(kept["mission"] + kept["task"]) >= FLOOR and max(kept["mission"]) <= 1


def test_about_the_share_that_was_asked_for_is_kept(
    samples: list[Encoded], emphasis: Emphasis
) -> None:
    lengths = [len(sample.ids) for sample in samples]
    assert np.average(
        [emphasis.probability(sample) for sample in samples], weights=lengths
    ) == pytest.approx(0.6, abs=0.02)


def test_an_emphasis_is_read_as_it_was_written(
    samples: list[Encoded], emphasis: Emphasis, tmp_path: Path
) -> None:
    emphasis.save(tmp_path / "emphasis.npz")
    again = Emphasis.load(tmp_path / "emphasis.npz")
    assert [again.probability(sample) for sample in samples] == [
        emphasis.probability(sample) for sample in samples
    ]


def test_a_shard_has_the_samples_that_are_kept(
    tokenizer: Any, emphasis: Emphasis, tmp_path: Path
) -> None:
    settings: Any = {"seed": 5, "count": 60, "mission_share": 0.5, "longest": 1024}
    plain = encode_shard(tmp_path / "plain.npz", tokenizer, VOCABULARY, **settings)
    hard = encode_shard(tmp_path / "hard.npz", tokenizer, VOCABULARY, **settings, emphasis=emphasis)
    assert plain["passed_over"] == 0 < hard["passed_over"]
    assert (
        hard["samples"] + hard["left_out"]
        == 60
        == len(load_shard(tmp_path / "hard.npz")) + hard["left_out"]
    )


def test_words_and_their_order_are_features(samples: list[Encoded]) -> None:
    one = samples[0]
    turned = Encoded(
        one.level,
        one.text,
        np.concatenate([one.ids[: one.prompt][::-1], one.ids[one.prompt :]]),
        one.prompt,
    )
    assert features(one).shape == features(turned).shape and not np.array_equal(
        features(one), features(turned)
    )


def test_losses_are_those_of_the_training_loop(
    samples: list[Encoded], tokenizer: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    model: Any = new_model(TINY, len(tokenizer), {"bos": 1, "eos": 2, "pad": 0})
    monkeypatch.setattr(
        "planner_ft.pretraining.emphasis.token_weights",
        lambda sample, _tokenizer: np.ones(len(sample.ids) - sample.prompt),
    )
    few = samples[:12]
    found = weighted_losses(model, few, tokenizer)
    for sample, loss in zip(few, found, strict=True):
        with torch.no_grad():
            mean = completion_loss(
                model, model.model, rows_of([(sample.ids, sample.prompt)], len(sample.ids), 0)
            ).item()
        assert loss == pytest.approx(mean * (len(sample.ids) - sample.prompt), rel=0.01)


@pytest.mark.parametrize(
    ("level", "text", "answer", "light"),
    [
        (
            "mission",
            "go",
            (
                '{"tasks":[{"title":"T","task_prompt":"Go'
                ' on."}],"assumptions":[],"constraints":["Fog."]}'
            ),
            ["Go on", "Fog"],
        ),
        ("task", "go to [5, 7]", '"name":"GoToXY","parameters":{"x":5,"y":7}', []),
        ("task", "run the grid", '"name":"GoToXY","parameters":{"x":-31,"y":42}', ["31", "42"]),
    ],
)
def test_what_the_metrics_compare_counts_in_full(
    tokenizer: Any, level: Any, text: str, answer: str, light: list[str]
) -> None:
    ids = tokenizer.encode(answer, add_special_tokens=False)
    weights = token_weights(Encoded(level, text, np.array(ids), 0), tokenizer)
    pieces = [tokenizer.decode([token]) for token in ids]
    lighter = "".join(piece for piece, weight in zip(pieces, weights, strict=True) if weight < 1)
    assert all(part.replace(" ", "") in lighter.replace(" ", "") for part in light)
    assert bool(light) == bool(lighter) and "title" not in lighter and "GoToXY" not in lighter
