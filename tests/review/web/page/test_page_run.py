"""Running an approved plan on the page: the vehicle moves, an abort stops it, a replay shows it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from planner_ft.review import approve
from tests.review.web.page.conftest import Page, go, make_plan

pytestmark = pytest.mark.browser
Opened = Callable[..., Page]
AWAY = [
    ("Transit", {"target_position": [30, 0]}, "Go to [30, 0].", go((30, 0))),
    ("Transit", {"target_position": [0, 0]}, "Return home.", go((0, 0))),
]
POSE = "return document.querySelector('.vessel path')?.dataset.pose || null"
EAST = "Number(document.querySelector('.vessel path')?.dataset.pose.split(' ')[0])"


def approved(opened: Opened) -> Page:
    page = opened(make_plan("Go to [30, 0], come home.", AWAY), reviewer="Bo")
    approve(page.review.document(), page.review.session.log, "Ada", ["all"])
    page.one("#run")
    return page


def test_an_approved_plan_is_watched_and_replayed(opened: Opened) -> None:
    page = approved(opened)
    page.run(
        "const s = document.querySelector('.run select'); s.value = '50';"
        "s.dispatchEvent(new Event('change', { bubbles: true }))"
    )
    page.one("#run").click()
    page.until(f"return {EAST} > 10", "the vehicle moves")
    page.says(".run .what", "Task 2, Transit: step 1 of 1")
    assert page.run("return document.querySelector('.task.chosen').id") == "task-t2"
    assert page.text(".run .active .moving") == "GoToXY"
    page.says(".run .ended", "Done: every step ended as planned.")
    home = page.run(POSE)
    page.run(
        "const r = document.querySelector('.replay input'); r.value = 0;"
        "r.dispatchEvent(new Event('input', { bubbles: true }))"
    )
    page.until(f"return {EAST} < 5")
    page.says(".run .what", "Task 1, Transit")
    page.one("#replay").click()
    page.until(f"return {EAST} > 5", "the replay moves")
    assert home != page.run(POSE)


def test_an_abort_on_the_page_stops_the_vehicle(opened: Opened) -> None:
    page = approved(opened)
    page.run(
        "const s = document.querySelector('.run select'); s.value = '1';"
        "s.dispatchEvent(new Event('change', { bubbles: true }))"
    )
    page.one("#run").click()
    page.until(f"return {EAST} > 1", "the vehicle moves")
    page.one("#abort").click()
    page.says(".run .ended", "Ended: stopped, aborted by Bo")
    page.gone("#abort")
    at = page.run(POSE)
    page.until("return document.querySelector('#run') !== null")
    assert page.run(POSE) == at
    assert float(at.split()[0]) < 29
    told = [(one["event"], one["reviewer"]) for one in page.review.decisions()][:3]
    assert told == [("approved", "Ada"), ("run", "Bo"), ("aborted", "Bo")]
