"""How much of its command a mission plan lacks."""

from __future__ import annotations

import json
from typing import Any

import pytest

from planner_ft.document.lacking import count_lacking
from planner_ft.vocabulary import load_vocabulary


def task(title: str, **parameters: Any) -> dict[str, Any]:
    return {"title": title, "parameters": parameters, "task_prompt": "Anything that says 45 m."}


GO, HOLD = task("Transit", target_position=[20, 60]), task("KeepStation", duration=600)
FIND, FOLLOW = (
    task("SearchAndDetect", target_description="red buoy"),
    task("FollowTarget", target_position=[-99, -99]),
)
ROUND = task("PerformOrbit", center=[-99, -99])
CHECK, HOME = task("Diagnostics"), task("Transit", target_position=[0, 0])


@pytest.mark.parametrize(
    ("command", "tasks", "lacking"),
    [
        ("Hold at [20, 60] for ten minutes.", [GO, HOLD], 0),
        ("Hold at [20, 60] for ten minutes.", [GO], 1),
        ("Hold at [20, 60] for ten minutes.", [HOLD], 1),
        ("Hold at [20, 60] for ten minutes, then go once round the buoy, 45 m off.", [GO, HOLD], 2),
        ("Hold at [20, 60] for 45 minutes, no, ten minutes.", [GO, HOLD], 0),
        ("Hold at [20, 60] for ten minutes. Don't circle the buoy at 45 m.", [GO, HOLD], 0),
        ("Hold at [20, 60] for ten minutes and count 45 seals.", [GO, HOLD], 0),
        ("Check your sensors and hold at [20, 60] for ten minutes.", [GO, HOLD], 1),
        (
            "Check your sensors and hold at [20, 60] for ten minutes.",
            [task("Diagnostics"), GO, HOLD],
            0,
        ),
        ("No sensor check. Hold at [20, 60] for ten minutes.", [GO, HOLD], 0),
        ("Hold at [20, 60] for ten minutes.", [GO, HOLD, HOLD], 1),
        (
            "Hold at [20, 60] for ten minutes.",
            [GO, HOLD, task("Transit", target_position=[0, 0]), HOLD],
            2,
        ),
        ("Hold at [20, 60] for ten minutes, come home and do it again.", [GO, HOLD, HOME, HOLD], 0),
        (
            "Hold at [20, 60] for ten minutes.",
            [GO, HOLD, FIND, task("Transit", target_position=[-99, -99]), HOLD],
            1,
        ),
        (
            "Hold for ten minutes at [20, 60] and at [20, 80].",
            [GO, HOLD, task("Transit", target_position=[20, 80]), HOLD],
            0,
        ),
        (
            "Hold at [20, 60] for ten minutes. That is the red buoy.",
            [FIND, task("Transit", target_position=[-99, -99]), GO, HOLD],
            1,
        ),
        (
            "Hold at [20, 60] for ten minutes and take the hot-spot.",
            [GO, HOLD, task("ThermalHotspotLocalizer"), HOME],
            1,
        ),
        ("Hold at [20, 60] for ten minutes.", [task("Diagnostics"), GO, HOLD], 1),
        (
            "Hold at [20, 60] for ten minutes with a check of the hull sensors.",
            [task("Diagnostics"), GO, HOLD],
            0,
        ),
        (
            "Hold by the buoy at [20, 60] for ten minutes.",
            [task("SearchAndDetect", target_description="buoy"), GO, HOLD],
            1,
        ),
        (
            "Find the buoy at [20, 60] and hold there for ten minutes.",
            [task("SearchAndDetect", target_description="buoy"), GO, HOLD],
            0,
        ),
        (
            "Hold at [20, 60] for ten minutes, and you needn't come back.",
            [GO, HOLD, task("Transit", target_position=[0, 0])],
            1,
        ),
        (
            "Check your sensors before leaving home, then hold at [20, 60] for ten minutes.",
            [CHECK, GO, HOLD, HOME],
            1,
        ),
        (
            "Check your sensors before leaving home, hold at [20, 60] for ten minutes and return.",
            [CHECK, GO, HOLD, HOME],
            0,
        ),
        (
            "Hold for ten minutes at [20, 60], which is closer to home, then back to base.",
            [GO, HOLD, HOME],
            0,
        ),
        ("A sensor check, then hold at [20, 60] for ten minutes.", [CHECK, GO, HOLD, CHECK], 1),
        (
            "A sensor check, then hold at [20, 60] for ten minutes and check the sensors again.",
            [CHECK, GO, HOLD, CHECK],
            0,
        ),
        (
            "Test the sensors, hold at [20, 60] for ten minutes, test the sensors.",
            [CHECK, GO, HOLD, CHECK],
            0,
        ),
        (
            "Hold at [20, 60] for ten minutes and write a report.",
            [task("AutoGenerateReportSummary"), GO, HOLD, task("AutoGenerateReportSummary")],
            1,
        ),
        (
            "Hold at [20, 60] for ten minutes, do not come back before that.",
            [GO, HOLD, task("Transit", target_position=[0, 0])],
            0,
        ),
        (
            "Find the red buoy, follow it, then the buoy is circled.",
            [FIND, FOLLOW, task("SearchAndDetect", target_description="buoy"), ROUND],
            1,
        ),
        (
            "Find the red buoy, follow it, then another buoy is circled.",
            [FIND, FOLLOW, task("SearchAndDetect", target_description="buoy"), ROUND],
            0,
        ),
        (
            "Find the red buoy and follow it for the scour inspection.",
            [FIND, FOLLOW, task("SearchAndDetect", target_description="scour inspection")],
            2,
        ),
        ("Hold at [20, 60] for ten minutes.", [], None),
        ("Hold at [20, 60] for 1.2.3 minutes.", [GO], None),
    ],
)
def test_what_no_task_answers(
    command: str, tasks: list[dict[str, Any]], lacking: int | None
) -> None:
    assert (
        count_lacking(
            command,
            json.dumps({"tasks": tasks, "assumptions": [], "constraints": []}),
            load_vocabulary(),
        )
        == lacking
    )


def test_what_is_no_plan_lacks_nothing_that_could_be_told() -> None:
    assert count_lacking("Hold at [20, 60].", '{"tasks":[', load_vocabulary()) is None
