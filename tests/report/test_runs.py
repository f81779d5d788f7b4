"""Reading run folders: what is missing is said, what is damaged is refused."""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from planner_ft.report.runs import load_test_sets
from planner_ft.report.write import write_report
from planner_ft.support.errors import PlannerError
from tests.report.conftest import ANSWERS, EXPECTED, write_data, write_run


def test_a_run_is_read_with_its_answers_and_commands(run: Path) -> None:
    (tests,) = load_test_sets([run])
    assert [system.name for system in tests.results.rows] == ["good, Base", "hostile, Base"]
    assert list(tests.samples) == list(EXPECTED)
    first = tests.results.rows[0]
    assert set(tests.answers[first.key]) == set(EXPECTED) == set(tests.scores[first.key])
    assert not [note for note in tests.notes if "not shown" in note]


def test_runs_on_the_same_data_share_a_section_and_are_told_apart(
    run: Path, make_run: Callable[..., Path]
) -> None:
    other = make_run("again", {"good": ANSWERS["good"]})
    (tests,) = load_test_sets([run, other])
    assert [system.name for system in tests.results.rows] == [
        "good (run), Base",
        "hostile (run), Base",
        "good (again), Base",
    ]


def test_runs_on_other_data_have_a_section_of_their_own(run: Path, tmp_path: Path) -> None:
    challenge = write_run(
        tmp_path / "second", write_data(tmp_path, "challenge.jsonl", grouped=False), ANSWERS
    )
    assert [Path(tests.path).name for tests in load_test_sets([run, challenge])] == [
        "test.jsonl",
        "challenge.jsonl",
    ]


def test_runs_below_a_folder_are_found(run: Path) -> None:
    assert len(load_test_sets([run.parent])) == 1


def test_changed_or_missing_test_data_is_said_and_can_be_named(
    run: Path, data: Path, tmp_path: Path
) -> None:
    moved = tmp_path / "moved.jsonl"
    data.rename(moved)
    (tests,) = load_test_sets([run])
    assert tests.samples == {}
    assert any("test.jsonl is not there" in note and "--data" in note for note in tests.notes)
    assert list(load_test_sets([run], [moved])[0].samples) == list(EXPECTED)
    data.write_text("{}\n")
    (tests,) = load_test_sets([run])
    assert any("test.jsonl has changed" in note for note in tests.notes)


@pytest.mark.parametrize(
    "absent", [["predictions.jsonl"], ["scores.jsonl"], ["predictions.jsonl", "scores.jsonl"]]
)
def test_a_run_of_which_parts_are_missing_still_gives_a_report(
    run: Path, tmp_path: Path, absent: list[str]
) -> None:
    for name in absent:
        (run / name).unlink()
    write_report([run], tmp_path / "report", pictures="none")
    page = (tmp_path / "report" / "report.html").read_text()
    for name in absent:
        assert f"{name} is not there" in page


def test_an_old_run_with_the_published_metrics_alone_gives_a_report(
    run: Path, tmp_path: Path
) -> None:
    results = json.loads((run / "results.json").read_text())
    for row in results["rows"]:
        row["metrics"] = {"f1": row["metrics"]["f1"]}
    results["manifest"] = {}
    for key in ("changes", "groups"):
        results.pop(key, None)
    (run / "results.json").write_text(json.dumps(results))
    write_report([run], tmp_path / "report", pictures="none")
    assert "good, Base" in (tmp_path / "report" / "report.html").read_text()


def test_no_run_and_damaged_runs_are_refused_in_one_sentence(run: Path, tmp_path: Path) -> None:
    with pytest.raises(PlannerError, match=r"no results\.json"):
        load_test_sets([tmp_path / "nowhere"])
    with (run / "scores.jsonl").open("a") as stream:
        stream.write("{broken\n")
    with pytest.raises(PlannerError, match=r"scores\.jsonl:\d+: not JSON"):
        load_test_sets([run])
    (run / "results.json").write_text("[]")
    with pytest.raises(PlannerError, match="is no result of"):
        load_test_sets([run])


def test_a_suite_is_a_section_for_each_data_set_and_names_who_failed(
    run: Path, tmp_path: Path
) -> None:
    suite = tmp_path / "suite"
    part, empty = suite / "curated", suite / "unseen"
    (part / "embedded").mkdir(parents=True)
    empty.mkdir()
    for name in ("results.json", "scores.jsonl", "baselines.jsonl"):
        shutil.copy(run / name, part / name)
    shutil.copy(run / "predictions.jsonl", part / "embedded" / "predictions.jsonl")
    failed = [
        {
            "candidate": "big",
            "label": "Big",
            "configuration": "lora",
            "reason": "no memory for <it>",
        }
    ]
    results = json.loads((part / "results.json").read_text()) | {"failed": failed}
    (part / "results.json").write_text(json.dumps(results))
    (empty / "results.json").write_text(
        json.dumps(
            results
            | {
                "rows": [],
                "baselines": [],
                "comparisons": {},
                "data": results["data"] | {"sha256": "1" * 64},
            }
        )
    )
    (suite / "results.json").write_text(json.dumps({"title": "A suite", "parts": []}))
    sets = load_test_sets([suite])
    assert [len(tests.results.rows) for tests in sets] == [2, 0]
    assert set(sets[0].answers["good base"]) == set(EXPECTED)
    write_report([suite], tmp_path / "report", pictures="none")
    page = (tmp_path / "report" / "report.html").read_text()
    assert page.count("Big, LoRA.") == 2
    assert "Not measured: no memory for &lt;it&gt;." in page


def test_the_data_sets_of_a_suite_stand_in_its_own_order(run: Path, tmp_path: Path) -> None:
    suite = tmp_path / "suite"
    for number, name in enumerate(("apart", "published")):
        (suite / name).mkdir(parents=True)
        results = json.loads((run / "results.json").read_text())
        (suite / name / "results.json").write_text(
            json.dumps(results | {"data": results["data"] | {"sha256": str(number) * 64}})
        )
    (suite / "results.json").write_text(
        json.dumps({"title": "A suite", "parts": [{"name": "published"}, {"name": "apart"}]})
    )
    first, second = load_test_sets([suite])
    assert (first.sha256, second.sha256) == ("1" * 64, "0" * 64)
