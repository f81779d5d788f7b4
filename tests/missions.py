"""Mission plans for tests, by their tasks."""

from __future__ import annotations

from typing import Any

OPEN = [-99, -99]
Task = tuple[str, dict[str, Any]]
"""Title and parameters."""
STARE: Task = ("FeatureStare", {"feature_type": "lamp"})
REPORT: Task = ("AutoGenerateReportSummary", {})


def go(*place: float) -> Task:
    return "Transit", {"target_position": list(place)}


def find(what: str) -> Task:
    return "SearchAndDetect", {"target_description": what}


def send(*items: str) -> Task:
    return "SmartDataHarvest", {"target_list": list(items)}
