"""The chart: what it draws, how it is moved, and how a target is placed on it."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from tests.review.web.page.conftest import Page

pytestmark = pytest.mark.browser
Opened = Callable[..., Page]

BUOY = {"kind": "locate", "name": "green buoy", "position": [40, 30]}


def test_an_open_place_is_typed_dragged_tapped_and_moved_by_keys(opened: Opened) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    page = opened()
    page.write(".tray input", "somewhere")
    page.keys("\n")
    page.says(".tray .refusal", "position")
    page.write(".tray input", "40; 30")
    page.keys("\n")
    page.says(".placed .at", "(40, 30)")
    assert page.review.document()["tasks"][1]["parameters"]["target_position"] == [40, 30]
    page.press("Undo")
    page.one(".waiting .chip")
    chart = page.one("#chart-view")
    ActionChains(page.driver).move_to_element(page.one(".chip")).click_and_hold().move_by_offset(
        20, 20
    ).move_to_element(chart).release().perform()
    page.one(".placed .at")
    dragged = page.review.document()["located"]["green buoy"]
    page.press("Undo")
    page.one(".waiting .chip").click()
    ActionChains(page.driver).move_to_element_with_offset(chart, 40, 40).click().perform()
    page.one(".placed .at")
    tapped = page.review.document()["located"]["green buoy"]
    assert tapped[0] > dragged[0]
    assert tapped[1] < dragged[1]
    page.press("Undo")
    page.one(".waiting .chip").send_keys(Keys.ENTER)
    page.until(
        "return document.activeElement.id === 'chart-view' && document.querySelector('.aim') !=="
        " null"
    )
    middle = page.text(".aim text")
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_UP)
    page.until(f"return document.querySelector('.aim text').textContent !== {middle!r}")
    aimed = page.text(".aim text")
    page.keys(Keys.ENTER)
    page.says(".placed .at", aimed)


def test_the_chart_draws_everything_and_follows_the_selection(opened: Opened) -> None:
    from selenium.webdriver.common.keys import Keys

    page = opened()
    page.review.elsewhere(BUOY)
    page.says(".places .target text", "green buoy")
    assert page.text(".circle text") == "r 12 m"
    assert len(page.all(".boundary")) == 1
    assert page.text(".home") == "home, end"
    assert len(page.all(".leg")) >= 8
    page.one("#task-t4 .head").send_keys(Keys.ENTER)
    page.until("return document.querySelector('.leg.chosen') !== null")
    assert set(
        page.run(
            "return [...document.querySelectorAll('.leg.chosen')].map((one) => one.dataset.task)"
        )
    ) == {"t4"}
    labels = page.run(
        "return [...document.querySelectorAll('.waypoints text')].map((one) => one.textContent)"
    )
    assert "4.1" in labels
    assert all(label.startswith("4.") for label in labels)
    page.run(
        """const leg = document.querySelector('.leg[data-task="t5"] polyline.reach'), box = leg.getBoundingClientRect();
      const at = {bubbles: true, button: 0, pointerId: 7, clientX: box.left + box.width / 2, clientY: box.top + box.height / 2};
      document.getElementById('chart-view').setPointerCapture = () => {};
      leg.dispatchEvent(new PointerEvent('pointerdown', at)); leg.dispatchEvent(new PointerEvent('pointerup', at))"""
    )
    page.until("return document.querySelector('.task.chosen').id === 'task-t5'")


def test_the_view_is_zoomed_by_wheel_and_keys_and_brought_back(opened: Opened) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.actions.wheel_input import ScrollOrigin

    page = opened()
    whole = page.text(".scale text")
    ActionChains(page.driver).scroll_from_origin(
        ScrollOrigin.from_element(page.one("#chart-view")), 0, -1500
    ).perform()
    page.until(f"return document.querySelector('.scale text').textContent !== {whole!r}")
    page.one("#chart-view").send_keys("0")
    page.until(f"return document.querySelector('.scale text').textContent === {whole!r}")
    page.one("#chart-view").send_keys("----------")
    page.until(f"return document.querySelector('.scale text').textContent !== {whole!r}")
    page.press("Everything")
    page.until(f"return document.querySelector('.scale text').textContent === {whole!r}")
