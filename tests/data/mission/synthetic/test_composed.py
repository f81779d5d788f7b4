"""Composed commands: the plan follows the order that is said, and every value goes to the task that
it belongs to.
"""

import re
from collections import Counter
from random import Random

import pytest

from planner_ft.data.mission.synthetic import (
    composed_orders,
    composed_targets,
    composed_values,
    sample_missions,
)
from planner_ft.data.mission.synthetic.commands_check import built_template
from planner_ft.data.mission.synthetic.commands_draw import draw_command
from planner_ft.data.mission.synthetic.commands_format import base_of
from planner_ft.data.mission.synthetic.composed import KINDS, compose_template
from planner_ft.data.mission.synthetic.composed_orders import TAG, frames, tell_order
from planner_ft.data.mission.synthetic.composed_wishes import (
    AUXILIARIES,
    VALUE,
    chosen,
    clauses,
    slots_of,
)
from planner_ft.data.mission.synthetic.numbers import draw_style
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import plan_problems


def draws(kind, count=150):
    for seed in range(count):
        rng = Random(seed)
        text, expected, _ = draw_command(compose_template(rng, kind), rng, draw_style(rng))
        yield text, expected


def drawn(told, seed):
    """The command and plan of what a teller tells."""
    rng = Random(seed)
    text, wishes = told(rng)
    return (
        text,
        wishes,
        draw_command(
            built_template(tuple(slots_of(text)), tuple(wish.line() for wish in wishes), "x"),
            rng,
            draw_style(rng),
        )[1],
    )


def own(expected):
    """The tasks with their values, without places and without those that get there."""
    tasks = [
        task for task in expected["tasks"] if task["title"] not in ("SearchAndDetect", "Transit")
    ]
    return [
        (
            task["title"],
            {name: value for name, value in task["parameters"].items() if not is_place(value)},
        )
        for task in tasks
    ]


def is_place(value):
    return isinstance(value, list) and not isinstance(value[0], str)


@pytest.mark.parametrize("kind", KINDS)
def test_plans_are_strictly_valid_and_texts_complete(kind):
    vocabulary = load_vocabulary()
    for text, expected in draws(kind):
        assert plan_problems("mission", expected, vocabulary, strict=True) == [], text
        assert not re.search(
            r"[{}<>@%|](?!\d)|  |\bX\b(?! ?-?\d)",
            re.sub(r"\d ?%", "", text).replace("X:", "").replace("X=", ""),
        ), text
        assert text[0].isupper() or not text[0].isalpha() or text[1:2] in "=: 0123456789-", text


@pytest.mark.parametrize("title", clauses())
def test_every_task_has_every_mood(title):
    entry = clauses()[title]
    for mood in ("imp", "ger", "np", "done", "pas"):
        for form in entry[mood]:
            assert ("@" in form) == bool(entry["at"]), form
            assert ("%" in form) == (mood == "pas"), form
            assert not re.search(r"[()|]", chosen(form, Random(1))), form


def test_frames_name_their_clauses_from_the_first_on():
    counts = Counter()
    for frame, _ in (*frames(turned=True), *frames(turned=False)):
        letters = sorted({match[1] for match in TAG.finditer(frame)})
        assert letters == list("ABCD"[: len(letters)]), frame
        assert all(
            match[2] in (*AUXILIARIES, "imp", "ger", "np", "done", "call")
            for match in TAG.finditer(frame)
        ), frame
        text = TAG.sub("", chosen(frame, Random(1)))
        assert not re.search(r"[()|<>]", text), frame
        counts[len(letters), frame.find("<A") > frame.find("<B")] += 1
    assert counts[2, True] >= 40
    assert counts[3, True] + counts[3, False] >= 20


@pytest.mark.parametrize(
    "frame",
    [
        "<B imp>, but only after <A ger>.",
        "Before you <B imp>, <A imp>.",
        "Leave <B np> for last; first: <A imp>.",
    ],
)
def test_what_is_said_first_may_be_done_last(frame, monkeypatch):
    monkeypatch.setattr(composed_orders, "frames", lambda turned: ((frame, False),))
    for seed in range(60):
        text, wishes, expected = drawn(tell_order, seed)
        planned = [task["title"] for task in expected["tasks"]]
        assert [
            wish.title
            for wish in wishes
            if wish.title not in ("Home", "Transit", "SearchAndDetect")
        ] == [title for title, _ in own(expected)]
        places = [wish.place for wish in wishes]
        if all(places) and len(set(places)) == len(places):
            assert text.index(f"{{{places[-1]}") < text.index(f"{{{places[0]}")
        if wishes[-1].title == "Home":
            assert planned[-1] == "Transit" and expected["tasks"][-1]["parameters"] == {
                "target_position": [0, 0]
            }


def test_the_same_at_another_place_has_the_same_values_unless_one_is_changed():
    changed = 0
    for seed in range(120):
        text, _, expected = drawn(composed_targets._same_at, seed)
        tasks = own(expected)
        half = len(tasks) // 2
        assert [title for title, _ in tasks[:half]] == [title for title, _ in tasks[half:]], text
        differing = [
            name
            for first, second in zip(tasks[:half], tasks[half:], strict=True)
            for name in first[1]
            if first[1][name] != second[1][name]
        ]
        assert len(differing) <= ("2}" in text)
        changed += len(differing)
    assert changed > 10


def test_one_thing_at_all_places_has_one_set_of_values():
    for seed in range(120):
        _, wishes, expected = drawn(composed_targets._all_alike, seed)
        tasks = own(expected)
        assert len(tasks) == len(wishes) >= 2
        assert all(task == tasks[0] for task in tasks)


def test_values_of_their_own_are_kept_apart():
    for seed in range(60):
        text, wishes, expected = drawn(composed_targets._own_values, seed)
        slots = [name for wish in wishes for name in wish.said if base_of(name) not in ("F", "S")]
        assert len(set(slots)) == len(slots) >= len(wishes) and all(
            f"{{{name}" in text for name in slots
        )
        assert len(own(expected)) == len(wishes)


def test_a_value_said_once_holds_for_every_task():
    for seed in range(60):
        _, wishes, expected = drawn(composed_values.tell_shared, seed)
        (base,) = wishes[0].shared
        values = {parameters[base] for _, parameters in own(expected)}
        assert len(values) == 1 and len(own(expected)) == len(wishes)


def test_figures_that_follow_reach_their_tasks():
    for seed in range(60):
        text, wishes, expected = drawn(composed_values.tell_apart, seed)
        for wish in wishes:
            wanted = set(VALUE.findall(wish.values))
            task = next(parameters for title, parameters in own(expected) if title == wish.title)
            assert {{"scan": "scan_width_degrees"}.get(name, name) for name in wanted} <= set(
                task
            ), text


def test_a_place_said_in_another_sentence_needs_no_search():
    for _, expected in draws("placed"):
        assert "SearchAndDetect" not in [task["title"] for task in expected["tasks"]]
        assert all(
            position != [-99, -99]
            for task in expected["tasks"]
            for position in task["parameters"].values()
        )


def test_what_is_dropped_is_not_planned_and_what_is_swapped_is():
    for seed in range(80):
        rng = Random(seed)
        text, wishes, remarks = composed_values.tell_dropped(rng)
        assert ("Not" in [line.title for line in remarks]) == (len(wishes) != 2 or bool(remarks))
        if remarks:
            assert remarks[0].slots[0] not in [wish.title for wish in wishes]
        else:
            assert re.search(r"opposite|other way|reverse|[Ss]wap|second one first", text)
            assert [wish.number for wish in wishes] == [2, 1]


def test_structures_have_their_share_of_the_samples():
    counts = Counter(record["family"] for record in sample_missions(9, 1500))
    assert sum(counts.values()) == 1500
    kinds = {kind: counts[f"synthetic-composed-{kind}"] / 1500 for kind in KINDS}
    assert kinds["order"] > 0.02 and kinds["targets"] > 0.02
    assert kinds["apart"] + kinds["shared"] + kinds["placed"] + kinds["corrected"] > 0.02
    assert 0.07 < sum(kinds.values()) < 0.14
