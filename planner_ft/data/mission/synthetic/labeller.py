"""The plan that ordered intents stand for: searches, transits and positions put in by the labelling
rules.

Which rule a line follows is said by its number: 2 located or not, 3 getting there, 4 tasks that go
there by themselves, 5 return and docking.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from planner_ft.data.mission.synthetic.intents import (
    LEAVES,
    NO_PLACE,
    PLACE_TASKS,
    POSITION_PARAMETER,
    Intent,
    Target,
)
from planner_ft.data.mission.synthetic.positions import plan_position

UNRESOLVED = [-99, -99]
HOME = [0, 0]


@dataclass(frozen=True)
class Planned:
    """A task of the plan with the intent that it serves; `inserted` when the command does not ask
    for it by name.
    """

    title: str
    parameters: dict[str, Any]
    target: Target | None
    intent: Intent
    inserted: bool = False


def label(intents: Iterable[Intent]) -> list[Planned]:
    """The tasks for `intents`, which stand in the order of execution.

    Exclusions and corrections are settled before: an intent that the command takes back is not
    among them.
    """
    plan: list[Planned] = []
    located: set[int] = set()
    intents = list(_each(intents))
    here = next(
        (
            intent.target.key
            for intent in intents
            if intent.target is not None and intent.target.on_site
        ),
        None,
    )
    for intent in intents:
        target = intent.target
        if target is not None and intent.title not in NO_PLACE:
            if _needs_search(intent, target, located):
                plan.append(_search(target, intent, inserted=intent.title != "SearchAndDetect"))
                located.add(target.key)
                here = None
            if intent.title in PLACE_TASKS and here != target.key:
                plan.append(
                    Planned(
                        "Transit",
                        {"target_position": _position(target, located)},
                        target,
                        intent,
                        inserted=True,
                    )
                )
        if intent.title == "SearchAndDetect":
            continue
        plan.append(Planned(intent.title, _parameters(intent, located), target, intent))
        here = _whereabouts_after(intent, here)
    return plan


def _each(intents: Iterable[Intent]) -> Iterator[Intent]:
    """One intent per target where one is asked for at several."""
    for intent in intents:
        yield replace(intent, also=())
        for target in intent.also:
            yield replace(intent, target=target, also=())


def _needs_search(intent: Intent, target: Target, located: set[int]) -> bool:
    # Rule 2: one search per structure, before the first task that uses it; coordinates need none
    # unless it is asked for.
    return target.key not in located and (target.must_be_found or intent.title == "SearchAndDetect")


def _search(target: Target, intent: Intent, *, inserted: bool) -> Planned:
    return Planned(
        "SearchAndDetect", {"target_description": target.description}, target, intent, inserted
    )


def _position(target: Target, located: set[int]) -> list[Any]:
    # Rule 3: after a search the place is unresolved, also where a doubtful position was looked
    # around.
    if target.position is None or target.key in located:
        return list(UNRESOLVED)
    return list(plan_position(target.position))


def _parameters(intent: Intent, located: set[int]) -> dict[str, Any]:
    if intent.home:
        return {"target_position": list(HOME)}
    target = intent.target
    parameters: dict[str, Any] = {}
    if target is not None and intent.title == "FollowTarget" and target.identity is not None:
        parameters["target_id"] = target.identity
    name = POSITION_PARAMETER.get(intent.title)
    unplaced = target is None or (target.identity is not None and target.position is None)
    if name is not None and target is not None and not unplaced:
        parameters[name] = _position(target, located)
    parameters.update(intent.parameters)
    return parameters


def _whereabouts_after(intent: Intent, here: int | None) -> int | None:
    if intent.title in NO_PLACE and intent.title != "VisualDockingApproach":
        return here
    if intent.home or intent.title in LEAVES or intent.title == "VisualDockingApproach":
        return None
    return intent.target.key if intent.target is not None else here
