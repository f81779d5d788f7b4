"""Training samples from plans that were corrected and approved."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from planner_ft.data.curated import find_source
from planner_ft.data.validation import validate_file
from planner_ft.document import PlanDocument, apply, write_document
from planner_ft.facts import read
from planner_ft.planning.agents import CUT_NOTE
from planner_ft.review import approve, log_beside, reject
from planner_ft.review.commands import parse_edit
from planner_ft.review.harvest import Harvest, _as_commanded, harvest_files, text_problems
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_jsonl
from planner_ft.vocabulary import Vocabulary
from tests.review.conftest import mission_document, task

COMMAND = (
    "Before the tide turns, dig out the grey fishing smack for me, round it at 12 m and then come"
    " home."
)
ASSUMPTION = "The position of the grey fishing smack is unknown until it has been found."


def wrong(
    usv: Vocabulary, command: str = COMMAND, assumptions: tuple[str, ...] = (ASSUMPTION,)
) -> PlanDocument:
    """A plan with a radius that nobody said and without the way home."""
    tasks = [
        task(
            "SearchAndDetect",
            {"target_description": "grey fishing smack"},
            "Search for the grey fishing smack.",
        ),
        task("Transit", {"target_position": [-99, -99]}, "Go to the grey fishing smack."),
        task(
            "PerformOrbit",
            {"center": [-99, -99], "radius": 20},
            "Circle the grey fishing smack at 20 m.",
        ),
    ]
    return mission_document(command, tasks, {}, usv, assumptions)


CORRECTIONS = ("3.radius=12", "insert 4 Transit target_position=[0,0] prompt=Return home.")


def reviewed(path: Path, document: PlanDocument, usv: Vocabulary, *edits: str) -> Path:
    """The plan with these edits, approved, in a file."""
    for text in edits:
        document = apply(document, parse_edit(text, document, usv), usv)
    write_document(path, document)
    approve(document, log_beside(path), "Ann", ["all"])
    return path


def harvested(out: Path, *plans: Path) -> tuple[Harvest, list[dict[str, Any]]]:
    return harvest_files(plans, None, out), read_jsonl(out)


def refusal(out: Path, *plans: Path) -> str:
    with pytest.raises(PlannerError, match="no plan gives a sample") as caught:
        harvest_files(plans, None, out)
    assert not out.exists()
    return str(caught.value)


def test_a_corrected_plan_is_a_sample_that_validate_accepts(
    tmp_path: Path, usv: Vocabulary
) -> None:
    out = tmp_path / "corrections.jsonl"
    plan = reviewed(
        tmp_path / "plan.json", wrong(usv), usv, *CORRECTIONS, "locate grey fishing smack=120,-35"
    )
    done, (sample,) = harvested(out, plan)
    assert not validate_file(out, usv, "mission").problems and not done.left_out
    assert sample["prompt"] == COMMAND
    assert [(entry["title"], entry["parameters"]) for entry in sample["expected"]["tasks"]] == [
        ("SearchAndDetect", {"target_description": "grey fishing smack"}),
        ("Transit", {"target_position": [-99, -99]}),
        ("PerformOrbit", {"center": [-99, -99], "radius": 12}),
        ("Transit", {"target_position": [0, 0]}),
    ]
    assert sample["expected"]["tasks"][2]["task_prompt"] == "Circle the grey fishing smack at 12 m."
    assert sample["expected"]["assumptions"] == [ASSUMPTION]
    made = sample["provenance"]
    assert (made["reviewer"], made["sequence"], made["digest"]) == (
        "Ann",
        1,
        json.loads(plan.read_text())["digest"],
    )
    assert any("radius 20 -> 12" in text for text in made["corrected"]) and not any(
        "120" in text for text in made["corrected"]
    )
    assert "radius 20 -> 12" in "\n".join(done.lines()) and "--corrections" in "\n".join(
        done.lines()
    )


def test_a_place_that_the_command_does_say_stays(tmp_path: Path, usv: Vocabulary) -> None:
    command = (
        "Before the tide turns, dig out the grey fishing smack at [120, -35] for me, round it at 12"
        " m and then come home."
    )
    edits = (*CORRECTIONS, "locate grey fishing smack=120,-35", "remove 1")
    _done, (sample,) = harvested(
        tmp_path / "out.jsonl", reviewed(tmp_path / "plan.json", wrong(usv, command), usv, *edits)
    )
    assert sample["expected"]["tasks"][0]["parameters"] == {"target_position": [120, -35]}


def test_plans_that_give_no_sample_are_left_out_with_the_reason(
    tmp_path: Path, usv: Vocabulary
) -> None:
    out = tmp_path / "out.jsonl"
    unseen = tmp_path / "unseen.json"
    write_document(unseen, wrong(usv))
    assert "holds no decision" in refusal(out, unseen)
    located = reviewed(
        tmp_path / "located.json", wrong(usv), usv, "locate grey fishing smack=120,-35"
    )
    assert "as the model proposed them" in refusal(out, located)
    invented = reviewed(tmp_path / "invented.json", wrong(usv), usv, "3.radius=13")
    assert "breaks a labelling rule" in refusal(out, invented) and "13" in refusal(out, invented)
    wordless = reviewed(
        tmp_path / "wordless.json",
        wrong(usv),
        usv,
        "3.radius=12",
        "insert 4 Transit target_position=[0,0]",
    )
    assert "task_prompt is empty" in refusal(out, wordless)
    early = reviewed(tmp_path / "early.json", wrong(usv), usv, *CORRECTIONS, "move 4 1")
    assert "breaks a labelling rule" in refusal(out, early)
    good = reviewed(tmp_path / "good.json", wrong(usv), usv, *CORRECTIONS)
    done, samples = harvested(out, unseen, good, located)
    assert len(samples) == 1 and set(done.left_out) == {unseen, located}
    with pytest.raises(PlannerError, match="exists"):
        harvest_files([good], None, out)
    reject(json.loads(good.read_text()), log_beside(good), "Bob", "no")
    assert "rejected by Bob" in refusal(tmp_path / "other.jsonl", good)


@pytest.mark.parametrize("name", ["validation", "test", "challenge"])
def test_what_is_kept_for_scoring_is_refused(tmp_path: Path, usv: Vocabulary, name: str) -> None:
    record = next(
        record
        for record in read_jsonl(find_source() / f"{name}.jsonl")
        if record["expected"]["tasks"]
        and record["expected"]["tasks"][-1]["parameters"] == {"target_position": [0, 0]}
        and len(record["expected"]["tasks"]) > 1
    )
    tasks = [
        {**entry, "task_prompt": entry.get("task_prompt") or "Go."}
        for entry in record["expected"]["tasks"]
    ]
    document = mission_document(
        record["prompt"].upper(),
        tasks[:-1],
        {},
        usv,
        ("The position is unknown until it has been found.",),
    )
    plan = reviewed(
        tmp_path / "plan.json",
        document,
        usv,
        f"insert {len(tasks)} Transit target_position=[0,0] prompt=Return home.",
    )
    reason = refusal(tmp_path / "out.jsonl", plan)
    assert f"near duplicate of {record['id']} in the {name} set" in reason


def test_of_two_plans_of_one_command_the_last_approval_counts(
    tmp_path: Path, usv: Vocabulary
) -> None:
    first = reviewed(tmp_path / "first.json", wrong(usv), usv, "3.radius=12")
    second = reviewed(tmp_path / "second.json", wrong(usv), usv, *CORRECTIONS)
    done, samples = harvested(tmp_path / "out.jsonl", second, first)
    assert len(samples) == 1 and len(samples[0]["expected"]["tasks"]) == 4
    assert done.left_out == {first: f"a plan of the same command was approved later: {second}"}


def test_notes_of_the_decoding_are_no_assumptions_to_learn(tmp_path: Path, usv: Vocabulary) -> None:
    command = f"{COMMAND} Käpt'n Ωμέγα"
    notes = read(command).unread
    document = wrong(
        usv,
        command,
        (ASSUMPTION, *notes, f"{CUT_NOTE} and was ended after 9; something may be missing."),
    )
    _done, (sample,) = harvested(
        tmp_path / "out.jsonl", reviewed(tmp_path / "plan.json", document, usv, *CORRECTIONS)
    )
    assert notes and sample["expected"]["assumptions"] == [ASSUMPTION]


def test_what_is_missing_in_the_call_is_said(tmp_path: Path) -> None:
    for plans, out in (([], tmp_path / "out.jsonl"), ([tmp_path / "plan.json"], None)):
        with pytest.raises(PlannerError, match="--harvest needs plans and --out"):
            harvest_files(plans, None, out)


@pytest.mark.parametrize(
    ("assumption", "reason"),
    [
        (
            "The position of the grey fishing Inack is unknown until it has been found.",
            "has a word that neither the command nor the lexicon has: inack",
        ),
        (
            "The position of the grey fishing is unknown until it has been found.",
            "speaks of 'grey fishing', which was taken out",
        ),
    ],
)
def test_sentences_about_what_the_plan_does_not_have_are_not_learned(
    tmp_path: Path, usv: Vocabulary, assumption: str, reason: str
) -> None:
    document = wrong(usv, assumptions=(assumption,))
    searched = [
        task(
            "SearchAndDetect",
            {"target_description": "grey fishing"},
            "Search for the grey fishing smack.",
        ),
        *document["tasks"],
    ]
    entries = [
        {key: entry[key] for key in ("title", "parameters", "task_prompt")} for entry in searched
    ]
    plan = reviewed(
        tmp_path / "plan.json",
        mission_document(COMMAND, entries, {}, usv, (assumption,)),
        usv,
        "remove 1",
        *CORRECTIONS,
    )
    assert reason in refusal(tmp_path / "out.jsonl", plan)


def test_the_sentences_of_the_curated_set_are_almost_all_accepted() -> None:
    records = read_jsonl(find_source() / "train.jsonl")
    refused = [record["id"] for record in records if list(text_problems(record, []))]
    assert len(refused) <= len(records) // 50


def test_samples_and_reasons_are_a_line_each(tmp_path: Path) -> None:
    one = {"id": "a", "provenance": {"corrected": ["x", "y"]}}
    out = tmp_path / "out.jsonl"
    for count, words in ((1, "1 sample;"), (2, "2 samples;")):
        samples = {tmp_path / f"{number}.json": one for number in range(count)}
        lines = list(Harvest(samples, {tmp_path / "z.json": "why"}, out).lines())
        assert lines[0] == f"{tmp_path / '0.json'}: a: x; y"
        assert lines[-2] == f"{tmp_path / 'z.json'}: left out: why"
        assert lines[-1].startswith(f"{out}: {words} train with ") and len(lines) == count + 2


def test_an_existing_file_is_overwritten_when_that_is_asked_for(
    tmp_path: Path, usv: Vocabulary
) -> None:
    out = tmp_path / "out.jsonl"
    out.write_text("old\n")
    good = reviewed(tmp_path / "good.json", wrong(usv), usv, *CORRECTIONS)
    with pytest.raises(PlannerError, match="exists"):
        harvest_files([good], None, out)
    assert out.read_text() == "old\n"
    harvest_files([good], log_beside(good), out, overwrite=True)
    (sample,) = read_jsonl(out)
    digest = json.loads(good.read_text())["digest"]
    assert sample["id"] == f"harvest-{digest[:16]}"
    assert sample["family"].startswith("harvest-") and len(sample["family"]) == 24
    with pytest.raises(PlannerError, match="no such file"):
        harvest_files([good], tmp_path / "none.jsonl", tmp_path / "new.jsonl")


def test_the_values_of_the_vehicle_are_not_learned(usv: Vocabulary) -> None:
    own = {"parameters": {"radius": 1, "arc": 2}, "defaults": {"radius": 1, "arc": 3}}
    assert _as_commanded(own, "Go.", usv)["parameters"] == {"arc": 2}


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ("Go to the pier.", []),
        ("Go to the mast.", ["speaks of 'mast'"]),
        ("Go to the mast head.", []),
        ("Go to the qzxv.", ["has a word that neither the command nor the lexicon has: qzxv"]),
        ("Go to q.", []),
    ],
)
def test_texts_speak_of_nothing_that_was_taken_out(text: str, found: list[str]) -> None:
    entry = {"task_prompt": text, "parameters": {"a": "mast head", "b": 3, "c": ["pier", "head"]}}
    expected = {"tasks": [entry], "assumptions": [], "constraints": []}
    record = {"prompt": "Go to the pier and the mast head.", "expected": expected}
    problems = list(text_problems(record, ["mast", "pier"]))
    assert [one in problem for one, problem in zip(found, problems, strict=True)] == [True] * len(
        found
    )
