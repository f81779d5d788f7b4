"""Whether a system knows when it is wrong, and calibration on validation data."""

from __future__ import annotations

import json
import math
import random
import shutil
from pathlib import Path
from typing import Any

import pytest
from typer.testing import CliRunner

from planner_ft.benchmark import calibrate
from planner_ft.benchmark.calibrate import LEAST, fitted
from planner_ft.benchmark.figures import confidence_figures
from planner_ft.benchmark.folder import PREDICTIONS, RUN
from planner_ft.benchmark.samples import BenchData, Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.cli.app import app
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json, read_json, read_jsonl, write_json, write_jsonl
from planner_ft.vocabulary import load_vocabulary

USV = load_vocabulary("usv")
ROOT = Path(__file__).parents[2]
CURATED = ROOT / "data" / "mission"


def plan(radius: int) -> dict[str, Any]:
    given = {"center": [4, -2], "radius": radius}
    one = {"title": "PerformOrbit", "parameters": given, "task_prompt": "Circle."}
    return {"tasks": [one], "assumptions": [], "constraints": []}


def line(name: str, radius: int, logprob: float) -> dict[str, Any]:
    """An answer whose doubt is in the radius."""
    text = compact_json(plan(radius))
    at, size = text.index(str(radius)), len(str(radius))
    margin = logprob - math.log(1 - math.exp(logprob))
    tokens = [[at, -0.001, 7.0], [size, logprob, margin], [len(text) - at - size, -0.001, 7.0]]
    return {"id": name, "output": text, "parsed": json.loads(text), "logprobs": tokens}


def answers(count: int) -> tuple[BenchData, dict[str, dict[str, Any]]]:
    """Two of three answers are right; the wrong ones are doubted, and so are a few right ones."""
    samples, lines, rng = [], {}, random.Random(1)
    for number in range(count):
        name, wrong = f"s{number}", number % 3 == 0
        samples.append(
            Sample(name, f"f{number // 2}", {"prompt": "Circle it.", "expected": plan(12)})
        )
        doubted = wrong != (rng.random() < 0.1)
        lines[name] = line(name, 15 if wrong else 12, -1.2 if doubted else -0.05)
    return BenchData(Path(), "", "mission", tuple(samples), frozenset(lines)), lines


def test_perfect_order_random_order_and_worst_order() -> None:
    right = [True] * 90 + [False] * 10
    best = confidence_figures([1 - index / 100 for index in range(100)], right)
    none = confidence_figures([0.5] * 100, right)
    worst = confidence_figures([index / 100 for index in range(100)], right)
    assert best["aurc"] < 0.01 < none["aurc"] < worst["aurc"]
    assert none["aurc"] == pytest.approx(0.1)
    assert (best["least_sure_tenth"], best["approved_99"]) == (1.0, 0.9)
    assert none["least_sure_tenth"] == pytest.approx(0.1)
    assert none["approved_99"] == worst["approved_99"] == 0.0
    assert none["aurc_random"] == 0.1


def test_the_figures_of_four_answers_by_hand() -> None:
    """The two answers of equal confidence count half wrong each: 0, 1/2, 1 and 2 wrong answers
    among the surest.
    """
    found = confidence_figures([0.8, 0.3, 0.95, 0.8], [False, False, True, True])
    assert found["bins"] == [(0.3, 0, 1), (pytest.approx(0.8), 0.5, 2), (0.95, 1, 1)]
    assert found["curve"] == pytest.approx([0, 1 / 4, 1 / 3, 2 / 4])
    assert found["ece"] == pytest.approx((0.3 + 2 * 0.3 + 0.05) / 4)
    assert found["aurc"] == pytest.approx((1 / 4 + 1 / 3 + 2 / 4) / 4)
    assert (found["n"], found["wrong"], found["aurc_random"]) == (4, 2, 0.5)
    # A tenth of four answers is none.
    assert (found["least_sure_tenth"], found["approved_99"]) == (0, 0.25)
    nothing = confidence_figures([], [])
    assert {key for key, value in nothing.items() if value is not None} == {
        *("n", "wrong", "curve", "bins")
    }
    assert confidence_figures([0.4], [True])["least_sure_tenth"] is None
    with pytest.raises(ValueError):
        confidence_figures([0.4, 0.5], [True])


def test_bins_are_tenths_and_certainty_is_in_the_last() -> None:
    bins = confidence_figures([1.0, 0.99, 0.9, 0.899, 0.1, 0.0], [True] * 6)["bins"]
    assert [(round(mean, 4), count) for mean, _share, count in bins] == [
        *((0.0, 1), (0.1, 1), (0.899, 1), (0.9633, 3))
    ]


def test_up_to_one_wrong_plan_in_a_hundred_may_be_approved() -> None:
    for count, share in ((100, 1.0), (99, 98 / 99)):
        order = [1 - place / 1000 for place in range(count)]
        right = [True] * (count - 1) + [False]
        assert confidence_figures(order, right)["approved_99"] == pytest.approx(share)
    tied = confidence_figures([0.9] * 5 + [0.5] * 15, [True] * 5 + [False] * 6 + [True] * 9)
    # Two of the fifteen doubted ones are in the last tenth, 6/15 of them wrong.
    assert tied["least_sure_tenth"] == pytest.approx(2 * 6 / 15 / 6)


def test_calibration_error_is_nothing_for_the_honest() -> None:
    right = [True, True, True, False]
    assert confidence_figures([0.75] * 4, right)["ece"] == 0
    assert confidence_figures([1.0] * 4, right)["ece"] == pytest.approx(0.25)


def test_calibration_finds_the_doubt_in_every_part_that_has_it() -> None:
    data, lines = answers(90)
    found = fitted("mission", data, lines, USV)
    assert set(found.curves) == {"plan", "entry", "value"}
    assert (found.curves["plan"].n, found.curves["plan"].right) == (90, pytest.approx(2 / 3))
    # Title and centre are always right, the radius as often as the plan.
    assert found.curves["value"].n == 270
    for kind, figures in found.manifest["held_out"].items():
        assert figures["aurc"] < 0.5 * figures["aurc_random"], kind
    assert json.loads(json.dumps(found.to_json()))["curves"]["plan"]["n"] == 90


def test_too_few_answers_or_none_with_log_probabilities_is_one_sentence() -> None:
    data, lines = answers(LEAST - 1)
    with pytest.raises(PlannerError, match=f"at least {LEAST} are needed"):
        fitted("mission", data, lines, USV)
    data, lines = answers(60)
    bare = {name: {**one, "logprobs": None} for name, one in lines.items()}
    with pytest.raises(PlannerError, match="0 of 60 answers have log-probabilities"):
        fitted("mission", data, bare, USV)


def test_answers_without_tasks_are_one_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    judge = calibrate.judge
    plans = lambda *given: [one for one in judge(*given) if one.part.kind == "plan"]  # noqa: E731
    monkeypatch.setattr(calibrate, "judge", plans)
    with pytest.raises(PlannerError, match="no answer has a part of the kind entry"):
        fitted("mission", *answers(60), USV)


def test_a_system_that_is_always_right_is_calibrated_too() -> None:
    data, lines = answers(60)
    right = {name: line(name, 12, -0.05) for name in lines}
    curve = fitted("mission", data, right, USV).curves["plan"]
    assert not curve.weights and 0 < curve.intercept < 10


@pytest.mark.parametrize(
    ("fields", "confidence"),
    [
        ({"confidence": 0.7}, 0.7),
        ({"confidence": 7}, None),
        ({"confidence": "sure"}, None),
        ({}, None),
    ],
)
def test_a_score_takes_what_can_be_believed(
    fields: dict[str, Any], confidence: float | None
) -> None:
    data, lines = answers(3)
    given = {**lines["s1"], "logprobs": None, **fields}
    found = score_sample("mission", data.samples[1], given, USV)
    assert found.details["confidence"] == confidence


def test_without_calibration_the_probability_of_the_tokens_counts() -> None:
    data, _lines = answers(3)
    sure, unsure = (
        score_sample("mission", data.samples[1], line("s1", 12, logprob), USV).details["confidence"]
        for logprob in (-0.05, -1.2)
    )
    assert unsure == pytest.approx(0.3006, abs=1e-3) and sure > 0.9


@pytest.fixture
def adapter(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An adapter that is not calibrated yet, and answers every sample rightly."""

    def run_bench(run: BenchSettings, _progress: object) -> None:
        lines = []
        for one in read_jsonl(run.data or ""):
            text = compact_json(one["expected"])
            known = {"id": one["id"], "output": text, "parsed": one["expected"]}
            lines.append({"key": "k", **known, "logprobs": [[len(text), -0.1, 7.0]]})
        write_jsonl(run.folder / PREDICTIONS, lines)
        write_json(run.folder / RUN, {"keys": {"embedded lora+schema": "k"}})

    monkeypatch.setattr(calibrate, "run_bench", run_bench)
    folder, left_out = tmp_path / "adapter", shutil.ignore_patterns("confidence*")
    shutil.copytree(ROOT / "adapters" / "embedded" / "mission", folder, ignore=left_out)
    return folder


def calibrated(adapter: Path, *words: str) -> tuple[int, str]:
    """Exit status and errors of the command."""
    how = ["--adapter", str(adapter), "--configuration", "lora+schema"]
    how += ["--out", str(adapter.parent / "out")]
    result = CliRunner().invoke(app, ["calibrate", *words, *how])
    return result.exit_code, str(result.exception or result.stderr)


def test_test_data_is_named_and_development_data_is_not(adapter: Path, tmp_path: Path) -> None:
    write_jsonl(tmp_path / "mine.jsonl", read_jsonl(CURATED / "test.jsonl"))
    status, said = calibrated(adapter, str(tmp_path / "mine.jsonl"))
    assert status == 0 and "warning: 25 of 25 inputs of" in said and "test.jsonl were" in said
    tests = read_json(adapter / "confidence-mission-lora+schema.json")["manifest"]["tests"]
    assert list(tests.values()) == ["25 of 25"]
    for of in (CURATED / "validation.jsonl", ROOT / "eval" / "challenge" / "mission.jsonl"):
        assert calibrated(adapter, str(of), "--overwrite") == (0, "")


def test_a_calibration_is_not_replaced_unasked(adapter: Path) -> None:
    data, path = str(CURATED / "validation.jsonl"), adapter / "confidence-mission-lora+schema.json"
    path.write_text("{}")
    status, said = calibrated(adapter, data)
    assert (
        status and said == f"{path}: a calibration is there already; give --overwrite to replace it"
    )
    assert calibrated(adapter, data, "--overwrite") == (0, "")


def test_errors_name_the_files_that_were_given(adapter: Path, tmp_path: Path) -> None:
    few, more = tmp_path / "few.jsonl", tmp_path / "more.jsonl"
    records = read_jsonl(CURATED / "validation.jsonl")
    write_jsonl(few, records[:2])
    write_jsonl(more, records[2:4])
    assert f"{few}, {more}: 4 of 4 answers" in calibrated(adapter, str(few), str(more))[1]
    write_jsonl(more, records[1:3])
    found = f"{more}: id '{records[1]['id']}' stands in {few} already; leave one of them out"
    assert calibrated(adapter, str(few), str(more))[1] == found
