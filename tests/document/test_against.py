"""What a plan does against its command counts as lacking."""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.document.against import forbidden
from planner_ft.vocabulary import load_vocabulary


def task(title: str, **parameters: Any) -> dict[str, Any]:
    return {"title": title, "parameters": parameters, "task_prompt": ""}


CHECK, REPORT, HOLD = (
    task("Diagnostics"),
    task("AutoGenerateReportSummary"),
    task("KeepStation", duration=600),
)
SEND, GO = task("SmartDataHarvest", target_list=["log"]), task("Transit", target_position=[20, 60])
ROUND, FIND = (
    task("PerformOrbit", center=[20, 60]),
    task("SearchAndDetect", target_description="valve"),
)
DOCK = task("DockingApproach", goal_position=[-99, -99])


@pytest.mark.parametrize(
    ("command", "tasks", "found"),
    [
        (
            "Hold at [20, 60] for ten minutes, no report.",
            [GO, HOLD, REPORT],
            ["AutoGenerateReportSummary"],
        ),
        (
            "Hold at [20, 60] for ten minutes. We shall write the report ourselves.",
            [GO, HOLD, REPORT],
            ["AutoGenerateReportSummary"],
        ),
        (
            "Hold at [20, 60] for ten minutes. Do not circle it.",
            [GO, HOLD, ROUND],
            ["PerformOrbit"],
        ),
        (
            "Hold at [20, 60] for ten minutes, no end-of-watch report.",
            [GO, HOLD, REPORT],
            ["AutoGenerateReportSummary"],
        ),
        ("Hold at [20, 60] for ten minutes, no report before that.", [GO, HOLD, REPORT], []),
        (
            "Hold at [20, 60] for ten minutes. No report by mail, a report on the screen.",
            [GO, HOLD, REPORT],
            [],
        ),
        ("Do not forget the report.", [REPORT], []),
        (
            "Send the log, but only once the sensors have been checked.",
            [SEND, CHECK],
            ["SmartDataHarvest"],
        ),
        ("Send the log, but only once the sensors have been checked.", [CHECK, SEND], []),
        ("Send the log, but only once the sensors have been checked.", [SEND], ["Diagnostics"]),
        (
            "The upload of the log waits until you have circled the mast at [20, 60].",
            [SEND, GO, ROUND],
            ["SmartDataHarvest"],
        ),
        (
            "Circle the mast at [20, 60], the boat waits for ten minutes, then a sensor check.",
            [GO, ROUND, CHECK],
            [],
        ),
        (
            "Hold at [20, 60] and read the valve while you are there.",
            [GO, HOLD, FIND],
            ["SearchAndDetect"],
        ),
        ("Hold at [20, 60] and then find the valve there.", [GO, HOLD, FIND], []),
        ("Hold at [20, 60], then go over to the valve and hold there.", [GO, HOLD, FIND], []),
        (
            "Circle the mast at [20, 60] and then tail contact 5.",
            [GO, ROUND, task("FollowTarget", target_id="contact 5", target_position=[20, 60])],
            ["FollowTarget"],
        ),
        (
            "Tail contact 5, now at [20, 60].",
            [task("FollowTarget", target_id="contact 5", target_position=[20, 60])],
            [],
        ),
        ("Circle pier A at [20, 60].", [GO, ROUND, DOCK], ["DockingApproach"]),
        ("Circle pier A at [20, 60] and go alongside.", [GO, ROUND, DOCK], []),
    ],
)
def test_what_is_against_the_command(
    command: str, tasks: list[dict[str, Any]], found: list[str]
) -> None:
    assert list(forbidden(command, tasks, load_vocabulary())) == found
