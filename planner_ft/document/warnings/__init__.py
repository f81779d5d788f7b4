"""What a reviewer must know before approval: one plain sentence each, the most serious first.

A check is a function from a `Case` to the warnings that it finds.
"""

from collections.abc import Iterator

from planner_ft.document.track import Track
from planner_ft.document.warnings import (
    asked,
    data,
    directions,
    limits,
    picked,
    places,
    repeats,
    route,
    said,
    values,
)
from planner_ft.document.warnings.case import KINDS, NOTES, SERIOUS, Case, Check, Warning, warning
from planner_ft.planning.frame import doubt, origin_of
from planner_ft.vocabulary import Entry, Vocabulary

__all__ = ["KINDS", "NOTES", "SERIOUS", "warnings"]


def warnings(document: Entry, vocabulary: Vocabulary, path: Track) -> list[Warning]:
    """The warnings by kind, then in the plan's order; needs sources, estimate and track."""
    case = Case(document, path, vocabulary)
    found = [one for check in (CHECKS if case.tasks else EMPTY) for one in check(case)]
    unplaced = (case.wants(at.start) and not case.plan.has(at) for at in case.positions)
    if any(one["kind"] == "value-lost" for one in found) or any(unplaced):
        found += values.worked_out(case)
    # Two of one id say the same: the first stays.
    unique = {one["id"]: one for one in reversed(found)}
    kept = [one for one in found if one is unique[one["id"]]]
    return sorted(kept, key=lambda one: KINDS.index(one["kind"]))


def answers(case: Case) -> Iterator[Warning]:
    """Invalid answers, a doubtful origin, a plan without tasks, stale or missing skills."""
    document, origin = case.document, origin_of(case.document)
    if document.get("problems"):
        yield warning("invalid-answer", "mission", problem=document["problems"][0])
    elif not case.tasks:
        reason = next(iter(document.get("constraints", ())), "no reason")
        yield warning("empty-plan", reason=reason.rstrip("."))
    if origin and (reason := doubt(case.command, origin)):
        yield warning("doubtful-origin", words=reason)
    asking = [task for task in case.tasks if "asks" in task]
    for task, text in zip(asking, document.get("questions", ()), strict=False):
        yield warning("value-asked", task=task, words=text)
    for task in case.tasks:
        if task.get("problems"):
            yield warning("invalid-answer", "task", task, problem=task["problems"][0])
        elif task.get("stale"):
            yield warning("stale-skills", task=task)
        elif task.get("skill_sequence") is None and not {"waits_for", "asks"} & task.keys():
            yield warning("no-skills", task=task)


CHECKS: tuple[Check, ...] = (
    answers,
    *(limits.broken, limits.unplaced, route.close_structures, route.beside),
    *(route.open_places, route.order),
    *(route.boundaries, route.area_and_reach, route.endurance, route.missing_return),
    said.harm,
    *(
        asked.other_words,
        asked.instructions,
        asked.home_and_not,
        asked.ruled_out_still,
        picked.corrected_still,
    ),
    *(places.taken_back, picked.quoted_places, asked.against_itself, asked.conditions),
    *(
        asked.without_words,
        asked.not_planned,
        asked.left_out,
        data.data_ruled_out,
        data.data_not_planned,
        data.prompts_unheard,
        data.not_sent,
    ),
    *(route.performed, places.passed_elsewhere),
    *(places.unmoved, places.round_home, repeats.intervals, repeats.endless, repeats.to_and_fro),
    *(directions.begun_otherwise, said.measures, said.unclear, said.bare_numbers),
    said.uncounted,
    *(
        directions.sides,
        said.instead_of,
        said.crossed,
        said.clock_times,
        places.geographic,
        places.rows,
        places.uneven_rows,
    ),
    *(
        places.unvisited,
        places.positions,
        places.passed,
        limits.lost_limits,
        limits.of_a_row,
        limits.unsaid_areas,
        limits.unsaid_ways,
        repeats.repeats,
        repeats.each,
    ),
    *(said.devices, directions.laid_otherwise, directions.turned_otherwise),
    *(directions.turned_by_bearing, directions.turned_unsaid),
    *(
        places.there_and_not,
        places.turned_round,
        places.left_out,
        places.misnamed,
        picked.round_nothing,
    ),
    *(
        values.unread,
        values.unsaid,
        values.said_once,
        values.within_another,
        values.unsaid_limits,
        values.unheard,
        values.unsought,
    ),
    *(values.unmentioned, values.declined),
    *(values.unsaid_skills, repeats.done_again, picked.at_corners, picked.elsewhere),
    *(picked.named_order, picked.ends_otherwise, picked.of_another_task),
)
"""In the order in which warnings of one kind stand."""
EMPTY: tuple[Check, ...] = (answers, said.harm, asked.other_words, asked.not_planned, values.unread)
"""Those for a plan without tasks."""
