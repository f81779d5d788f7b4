"""The sums behind waypoints."""

from __future__ import annotations

import ast
import itertools
import operator
import re
from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.data.task.working import SUM, working_of
from planner_ft.facts import geometry as g
from planner_ft.prompts import answer_text, completion_text
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import without_working

VOCABULARY = load_vocabulary()
OPERATIONS = {"+": operator.add, "-": operator.sub, "/": operator.truediv}


def record(
    points: list[g.Point], prompt: str = "Survey it.", task: str = "SurveyTarget", **parameters: Any
) -> dict[str, Any]:
    steps = [
        {"navigation_skill": {"name": "GoToXY", "parameters": {"x": x, "y": y}}} for x, y in points
    ]
    return {
        "task": task,
        "parameters": parameters,
        "prompt": prompt,
        "expected": {"skill_sequence": steps},
    }


@pytest.mark.parametrize(
    ("sample", "expected"),
    [
        (
            record(g.survey_square((33, -18), 12), target_position=[33, -18], radius=12),
            "x33+12=45;y-18+12=-6;x33-12=21;y-18-12=-30",
        ),
        (
            record(
                g.lawnmower((0, 5), 20, 30, 10),
                task="BathymetryGridSurvey",
                center=[0, 5],
                width=20,
                length=30,
                spacing=10,
            ),
            "20/2=10;x0-10=-10;30/2=15;y5-15=-10;y-10+30=20;x-10+10=0;x0+10=10",
        ),
        # Lanes from the north-east corner westward; the spacing is half the width.
        (
            record(
                g.lawnmower((0, 5), 20, 30, 10, "north-east"),
                "Lanes ten metres apart over 20 by 30 m around [0, 5].",
                "BathymetryGridSurvey",
                center=[0, 5],
            ),
            "20/2=10;x0+10=10;30/2=15;y5+15=20;y20-30=-10;x10-10=0;x0-10=-10",
        ),
        # The number of lanes stands for the spacing.
        (
            record(
                g.lawnmower((0, 0), 30, 8, 7.5),
                "5 lanes over 30 m by 8 m.",
                "BathymetryGridSurvey",
                center=[0, 0],
            ),
            "30/2=15;x0-15=-15;8/2=4;y0-4=-4;y-4+8=4;30/4=7.5;x-15+7.5=-7.5;x-7.5+7.5=0;x0+7.5=7.5;x7.5+7.5=15",
        ),
        (
            record(
                [(40, 20), (40, 5), (15, 5)], "From [40, 20] fifteen metres south, then 25 m west."
            ),
            "y20-15=5;x40-25=15",
        ),
        (
            record(
                [(102.86, -30)], "Twenty-five yards east of the target.", target_position=[80, -30]
            ),
            "x80+22.86=102.86",
        ),
        (record([(10, -30), (20, 5), (0, 0)], "To [10, -30], then [20, 5], then home."), ""),
        (
            record([(10, 20), (79.28, -20)], "80 m on 120 degrees.", target_position=[10, 20]),
            "80/2=40;y20-40=-20",
        ),
        ({**record([]), "parameters": {"radius": 5}}, ""),
        # Records that no check has seen.
        (record([(45, None), (45, -18)], target_position=[33], radius="12"), ""),  # type: ignore[list-item]
        (record([(45, -18)], target_position="x", radius=12), ""),
    ],
)
def test_sums_are_those_that_the_waypoints_need(sample: dict[str, Any], expected: str) -> None:
    assert working_of(sample, VOCABULARY) == expected


def test_sums_of_sampled_tasks_are_right_and_most_computed_coordinates_have_one() -> None:
    computed = found = 0
    for sample in itertools.islice(sample_tasks(VOCABULARY, 31, None, "train"), 400):
        working = working_of(sample, VOCABULARY)
        assert all(SUM.fullmatch(one) for one in working.split(";") if working)
        results = set()
        for one, sign, other, result in re.findall(
            r"(-?[\d.]+)([-+/])([\d.]+)=(-?[\d.]+)", working
        ):
            assert OPERATIONS[sign](float(one), float(other)) == pytest.approx(
                float(result), abs=0.0051
            ), working
            results.add(float(result))
        stated = set(
            map(float, re.findall(r"-?\d+(?:\.\d+)?", sample["prompt"] + str(sample["parameters"])))
        )
        for step in sample["expected"]["skill_sequence"]:
            movement = step["navigation_skill"]
            wanted = (
                {movement["parameters"][axis] for axis in "xy"} - stated
                if movement["name"] == "GoToXY"
                else set()
            )
            computed, found = computed + len(wanted), found + len(wanted & results)
    # Slanted lines and rings have none.
    assert computed > 200
    assert found >= 0.75 * computed


def test_a_working_stands_before_the_answer_and_comes_off_again() -> None:
    samples = [
        record([(45, -18)], target_position=[33, -18], radius=12),
        record([(33, -18)], target_position=[33, -18]),
    ]
    texts = [answer_text("task", sample, VOCABULARY) for sample in samples]
    assert texts[0].startswith('{"working":"x33+12=45","skill_sequence":[')
    assert ast.literal_eval(texts[0])["working"] == "x33+12=45"
    plain = [completion_text("task", sample["expected"], VOCABULARY) for sample in samples]
    assert [without_working(text) for text in texts] == [(plain[0], "x33+12=45"), (plain[1], "")]
    for other in (
        '{"working":7,"skill_sequence":[]}',
        '{"tasks":[],"working":"x"}',
        "",
        '{"working":"x',
    ):
        assert without_working(other) == (other, "")
