"""The page for everybody: by keyboard alone, in both themes, on a tablet and on a phone."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from tests.report.test_browser import CONTRAST
from tests.review.web.page.conftest import Page, make_plan

pytestmark = pytest.mark.browser
Opened = Callable[..., Page]

EVERYTHING = """document.querySelectorAll('details').forEach((one) => { one.open = true; });
document.querySelectorAll('.fold[aria-expanded=false]').forEach((one) => one.click())"""
SMALL = """return [...document.querySelectorAll('button, select, input, summary, .chip, .jump a, .warnings a')]
  .filter((one) => one.checkVisibility() && !one.closest('.unseen'))
  .map((one) => [one, (one.type === 'checkbox' ? one.closest('label') : one).getBoundingClientRect()])
  .filter(([, box]) => Math.round(box.height) < 44 || Math.round(box.width) < 44).map(([one, box]) => [one.outerHTML.slice(0, 90), box.width, box.height])"""
LINES = """const part = (v) => (v /= 255) <= 0.03928 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
const luminance = (c) => c.match(/[\\d.]+/g).slice(0, 3).map(part).reduce((sum, v, i) => sum + v * [0.2126, 0.7152, 0.0722][i], 0);
const ratio = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
const water = luminance(getComputedStyle(document.querySelector('.frame')).backgroundColor);
return [...document.querySelectorAll('.leg polyline:not(.reach), .home path')]
  .map((one) => ratio(luminance(getComputedStyle(one).stroke), water)).filter((found) => found < 3)"""
OUTLINE = (
    "const s = getComputedStyle(document.activeElement); return s.outlineStyle === 'solid' &&"
    " parseFloat(s.outlineWidth) >= 2"
)


def tab_to(page: Page, name: str, key: str) -> None:
    """Presses a key until the focus is on what is called so; it must be visible on the way."""
    for _press in range(80):
        page.keys(key)
        assert page.run(OUTLINE), page.run("return document.activeElement.outerHTML.slice(0, 200)")
        if name in page.focused():
            return
    raise AssertionError(f"{name} is not reached")


def test_a_whole_review_by_keyboard(opened: Opened) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    page = opened(closed=True, reviewer="")
    page.keys(Keys.TAB)
    assert page.focused() == "Skip to the tasks"
    page.keys(Keys.TAB)
    assert page.focused() == "Skip to the warnings"
    page.keys(Keys.ENTER)
    tab_to(page, "Put green buoy on the chart", Keys.TAB)
    page.keys(Keys.ENTER)
    page.until("return document.querySelector('.aim') !== null")
    page.keys(Keys.ARROW_RIGHT, Keys.ARROW_UP, Keys.ENTER)
    page.says("dialog h2", "Who changes this plan?")
    page.keys("Ada", Keys.ENTER)
    page.one(".placed")
    page.keys("t")
    page.until("return document.activeElement.classList.contains('head')")
    page.keys(Keys.ARROW_DOWN, Keys.ARROW_DOWN)
    assert "PerformOrbit" in page.focused()
    page.keys(Keys.ENTER)
    tab_to(page, "radius: 12", Keys.TAB)
    page.keys(Keys.ENTER)
    page.until("return document.activeElement.matches('.edit input')")
    page.keys("15", Keys.ENTER)
    page.says(".changes li", "3 PerformOrbit, radius")
    page.keys("t", Keys.END)
    ActionChains(page.driver).key_down(Keys.ALT).send_keys(Keys.ARROW_UP).key_up(Keys.ALT).perform()
    page.says(".changes li", "moved")
    page.keys("u")
    page.until(
        "return ![...document.querySelectorAll('.changes li')].some((one) =>"
        " one.textContent.includes('moved'))"
    )
    page.keys("c", "+")
    page.until(
        "return document.activeElement.id === 'chart-view' && !document.querySelector('.chart"
        " header button:last-child').disabled"
    )
    for _warning in page.all(".warnings input"):
        page.keys("w", Keys.SPACE)
    page.says("#warnings-title", "All warnings acknowledged")
    page.keys("d", Keys.ENTER)
    page.until("return document.activeElement.classList.contains('summary')")
    tab_to(page, "Approve as Ada", Keys.TAB)
    page.keys(Keys.ENTER)
    page.until("return document.activeElement.textContent === 'Export …'")
    page.says(".bar .state", "Approved")
    assert page.review.document()["tasks"][2]["parameters"]["radius"] == 15
    assert page.review.decisions()[-1]["event"] == "approved"


def test_keys_are_listed_and_can_be_switched_off(opened: Opened) -> None:
    from selenium.webdriver.common.keys import Keys

    page = opened()
    page.keys("?")
    page.says("dialog", "new command")
    page.one("dialog input").click()
    page.keys(Keys.ESCAPE)
    page.gone("dialog")
    page.keys("n", "?")
    assert page.all("dialog") == []
    page.run("localStorage.clear()")


def test_every_control_has_a_name_and_what_happens_is_announced(opened: Opened) -> None:
    page = opened()
    script = """return [...document.querySelectorAll('button, input, select, textarea')].filter((one) => one.checkVisibility()).filter((one) =>
      !(one.getAttribute('aria-label') || one.innerText?.trim() || one.labels?.length)).map((one) => one.outerHTML.slice(0, 120))"""
    assert page.run(script) == []
    page.press("Remove task 5, Transit")
    page.says("[aria-live=polite]", "Saved: Transit removed.")


@pytest.mark.parametrize(("dark", "least"), [(False, 7), (True, 4.5)], ids=["sunlight", "night"])
def test_text_stands_out_from_its_background(opened: Opened, dark: bool, least: float) -> None:
    page = opened(dark=dark)
    page.one("#task-t2 .value.unresolved")
    page.run(EVERYTHING)
    page.run("document.querySelectorAll('.warnings input')[0].click()")
    page.run("document.querySelector('#task-t3 [data-parameter=radius] .value').click()")
    page.one(".edit")
    script = CONTRAST.replace("'main *, header *'", "'#page *'").replace(
        "ratio < 4.5", f"ratio < {least} && !node.closest(':disabled, .unseen, .faint')"
    )
    script = script.replace(
        "getComputedStyle(node), fill", "getComputedStyle(node), enabled = true, fill"
    )
    found = [entry for entry in page.run(script) if entry[0].lower() not in ("option", "optgroup")]
    assert found == []
    assert page.run(LINES) == []


@pytest.mark.parametrize("width", [320, 390, 768, 1024, 1280, 1440])
def test_no_width_needs_to_scroll_sideways(opened: Opened, width: int) -> None:
    page = opened(make_plan("Survey " + "abcdefghij" * 30 + " at [10, 20]."), width, 800)
    page.run(EVERYTHING)
    page.run("document.querySelector('#task-t3 [data-parameter=radius] .value').click()")
    page.one(".edit")
    assert page.run("return document.documentElement.scrollWidth") <= width
    if width >= 1280:
        assert page.run("return document.documentElement.scrollHeight") <= 800
    wide = (
        "return [...document.querySelectorAll('.panel')].filter((one) => one.scrollWidth >"
        " one.clientWidth + 1).map((one) => one.className)"
    )
    assert page.run(wide) == []


@pytest.mark.parametrize("width", [390, 768, 1024])
def test_fingers_hit_every_control(opened: Opened, width: int) -> None:
    page = opened(None, width, 800)
    page.run(EVERYTHING)
    found: list[Any] = page.run(SMALL)
    assert found == []


def test_nothing_moves_where_motion_is_to_be_reduced(opened: Opened) -> None:
    page = opened()
    script = """return [...document.querySelectorAll('*')].map((one) => getComputedStyle(one))
      .filter((style) => parseFloat(style.transitionDuration) > 0 || style.animationName !== 'none').length"""
    assert page.run(script) == 0
