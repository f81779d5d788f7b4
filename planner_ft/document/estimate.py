"""How long a plan is, in metres and seconds, as far as that is known."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planner_ft.document.track import track
from planner_ft.vocabulary import Vocabulary


def estimate(document: Mapping[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
    """{"length" in metres, "seconds", "open"}: sums over what is known, at the vehicle's cruise
    speed where a task says none.

    `open` are the tasks of which a part is not known: a place, the skills, or how long a hold
    lasts. The sums are then the least it can be.
    """
    path = track(document, vocabulary)
    untimed = {leg.task for leg in path.legs if leg.seconds is None}
    return {
        "length": round(sum(leg.metres for leg in path.legs), 1),
        "seconds": round(sum(leg.seconds or 0.0 for leg in path.legs)),
        "open": [
            task["id"]
            for task in document["tasks"]
            if task["id"] in path.open or task["id"] in untimed
        ],
    }
