"""What an operator sees first, what severities look like, and the way from approval to export."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from planner_ft.document import PlanDocument
from planner_ft.support.files import write_json
from tests.documents import document, step, task
from tests.review.web.page.conftest import Page, make_plan

pytestmark = pytest.mark.browser
Opened = Callable[..., Page]

FENCE = "The vehicle stays inside [-10, -10], [100, -10], [100, 100], [-10, 100]."


def transit(x: float, y: float, prompt: str = "Go on.") -> dict[str, Any]:
    return task("Transit", {"target_position": [x, y]}, [step("GoToXY", {"x": x, "y": y})], prompt)


def broken(**planned_as: Any) -> PlanDocument:
    """A plan that leaves its fence and comes home."""
    return document(
        [transit(300, 40), transit(0, 0, "Return home.")],
        command="Go to [300, 40], stay inside [[-10, -10], [100, -10], [100, 100], [-10, 100]] and"
        " come home.",
        constraints=[FENCE],
        **planned_as,
    )


def box(page: Page, selector: str) -> dict[str, float]:
    found: dict[str, float] = page.run(
        "return document.querySelector(arguments[0]).getBoundingClientRect().toJSON()", selector
    )
    return found


@pytest.mark.parametrize(("width", "height"), [(360, 740), (820, 1100), (1440, 900)])
def test_the_overview_with_dangers_and_a_line_per_task_is_above_the_fold(
    opened: Opened, width: int, height: int
) -> None:
    page = opened(broken(), width, height, closed=True)
    page.says(".verdict.danger", "1 danger: A limit is broken (task 1)")
    page.says(".figures", "at home")
    assert page.text(".head .way").endswith(" m")
    last = box(page, "#task-t2 .head")
    assert last["bottom"] < height
    assert all(box(page, f"#task-{one} .head")["height"] < 60 for one in ("t1", "t2"))
    assert box(page, "#overview")["top"] <= box(page, "#warnings")["top"]
    assert page.all(".details") == [], "one line a task until it is opened"


def test_severities_differ_in_colour_and_are_named(opened: Opened) -> None:
    page = opened(broken())
    page.says("#warnings li.danger b", "A limit is broken")
    colour = "return getComputedStyle(document.querySelector('%s')).borderLeftColor"
    danger = page.run(colour % "#warnings li.danger")
    plain = opened()
    plain.says("#warnings li.caution b", "A place is not known")
    assert plain.run(colour % "#warnings li.caution") != danger


def test_a_danger_leads_to_its_warning(opened: Opened) -> None:
    page = opened(broken(), closed=True)
    page.press("A limit is broken (task 1)", ".verdict")
    assert page.run("return document.activeElement.closest('li').className").startswith("danger")


def test_the_chart_has_fences_structures_the_end_and_latitude(opened: Opened) -> None:
    from planner_ft.support.geodesy import Origin

    page = opened(broken(origin=Origin(54.3217, 10.1412), chart={"pier": (60, 60)}))
    assert len(page.all(".fence.inside")) == 1
    page.says("text.structure", "pier, 10 m off")
    page.says(".home text", "home, end")
    page.says(".chart header", "54.32170° N, 10.14120° E")
    page.run("document.querySelector('.words').open = true")
    page.says(".words td", "54.32206° N, 10.14581° E")


def test_what_was_not_checked_is_listed(opened: Opened) -> None:
    page = opened()
    page.says(".facts li", "Wind, waves, current, depth and traffic")


def test_a_change_says_who_made_it_and_what_the_model_proposed(opened: Opened) -> None:
    page = opened(reviewer="")
    page.one('#task-t3 [data-parameter="radius"] .value').click()
    page.keys("15", "\n")
    page.says("dialog h2", "Who changes this plan?")
    page.keys("Ada Lovelace", "\n")
    page.says(
        '#task-t3 [data-parameter="radius"] .source',
        "changed by Ada Lovelace; the model proposed 12 m",
    )
    assert page.review.document()["edits"][-1]["by"] == "Ada Lovelace"


def test_without_a_name_nothing_is_changed(opened: Opened) -> None:
    from selenium.webdriver.common.keys import Keys

    page = opened(reviewer="")
    page.press("Remove task 5, Transit")
    page.one("dialog input")
    page.keys(Keys.ESCAPE)
    page.says(".message.bad", "needs the name")
    assert len(page.review.document()["tasks"]) == 5


def test_an_approved_plan_is_exported_next_and_what_stops_it_stands_first(opened: Opened) -> None:
    waits = task("KeepStation", {}, [step("StationKeep")], "Hold here.")
    page = opened(document([transit(30, 40), waits, transit(0, 0)], command="Go to [30, 40]."))
    page.run("document.querySelectorAll('#warnings input').forEach((one) => one.click())")
    page.until("return document.querySelector('.approve').textContent === 'Approve …'")
    page.press("Approve …")
    page.press("Approve as Ada", "dialog")
    page.until("return document.activeElement.textContent === 'Export …'")
    page.press("Export …")
    page.write("dialog input:not([type=checkbox])", "0,0")
    page.press("Export", "dialog")
    page.says("dialog .refusal", "Gulf of Guinea")
    assert not list(page.review.path.parent.glob("*.plan"))
    page.write("dialog input:not([type=checkbox])", "54.3,10.1")
    page.press("Export", "dialog")
    page.says("dialog .written .stops", "Waits for the operator at task 2.")
    assert page.review.path.with_suffix(".plan").is_file()


def test_a_plan_changed_outside_is_red_says_what_differs_and_cannot_be_approved(
    opened: Opened,
) -> None:
    page = opened()
    page.one(".approve")
    plan = page.review.document()
    plan["tasks"][2]["parameters"]["radius"] = 3
    write_json(page.review.path, plan)
    page.says(".tampered li", "task 3, radius: saved 12, now 3")
    page.gone(".approve")
    page.says(".standing", "cannot be approved")


def test_a_command_in_another_language_is_asked_about_before_it_is_planned(opened: Opened) -> None:
    page = opened()
    page.press("New command")
    page.keys("Fahre zur Boje, umkreise sie und komm wieder nach Hause.")
    page.press("Plan it")
    page.says("dialog .refusal", "it is not English")
    page.press("Plan what can be read", "dialog")
    page.one(".progress")


def test_a_plan_that_others_change_or_break_is_told_while_the_page_stays_open(
    opened: Opened,
) -> None:
    page = opened()
    page.review.elsewhere({"kind": "remove", "task": "t5"})
    page.until("return document.querySelectorAll('.task').length === 4")
    page.review.path.write_text("{")
    page.says(".message.bad", "plan.json")


def test_long_names_and_right_to_left_text_stay_in_their_place(opened: Opened) -> None:
    name = "buoy " * 40
    tasks: list[Any] = [
        ("SearchAndDetect", {"target_description": name[:200]}, f"Find the {name[:190]}.", None),
        ("SearchAndDetect", {"target_description": "السفينة الغارقة"}, "Find it.", None),
    ]
    page = opened(make_plan(f"Find the {name}and السفينة الغارقة.", tasks), 360, 740)
    assert page.run("return document.documentElement.scrollWidth") <= 360
    values = "return [...document.querySelectorAll('.value')].map((one) => getComputedStyle(one)"
    assert set(page.run(values + ".unicodeBidi)")) == {"isolate"}


def test_the_order_of_a_screen_reader_begins_with_the_overview(opened: Opened) -> None:
    page = opened(closed=True)
    headings = page.run("return [...document.querySelectorAll('h1, main h2')].map((h) => h.id)")
    assert headings[:4] == ["", "tasks-title", "warnings-title", "facts-title"]
    named = page.run(
        "return [...document.querySelectorAll('main section')].map((one) =>"
        " Boolean(document.getElementById(one.getAttribute('aria-labelledby'))))"
    )
    assert named and all(named)
    line = page.run("return document.querySelector('#task-t4 .head').textContent")
    assert "way" in line and "endurance used at its end" in line
