"""report.html in a real headless browser: filters, keyboard, phone, dark mode, hostile answers.

Skipped where there is no chromium, chromedriver or selenium; PLANNERFT_REQUIRE_BROWSER=1 makes that
a failure.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from planner_ft.report.write import write_report
from tests.browser import SCRIPT_SECONDS, headless_chromium
from tests.report.conftest import HOSTILE

pytestmark = pytest.mark.browser

CONTRAST = """
const linear = (c) => c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
const luminance = ([r, g, b]) => [r, g, b].map((c) => linear(c / 255))
  .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
const colour = (text) => text.match(/[\\d.]+/g).map(Number);
const behind = (node) => {
  for (; node; node = node.parentElement) {
    const c = colour(getComputedStyle(node).backgroundColor);
    if (c.length < 4 || c[3] > 0.99) return c;
  }
  return [255, 255, 255];
};
const found = [];
for (const node of document.querySelectorAll('main *, header *')) {
  const isText = (child) => child.nodeType === 3 && child.data.trim();
  if (!node.checkVisibility() || ![...node.childNodes].some(isText)) continue;
  const style = getComputedStyle(node), drawn = node instanceof SVGElement;
  const paper = behind(drawn ? node.ownerSVGElement.parentElement : node);
  const a = luminance(colour(drawn ? style.fill : style.color)), b = luminance(paper);
  const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const words = [node.tagName, node.getAttribute('class'), node.textContent.slice(0, 40)];
  if (ratio < 4.5) found.push([...words, ratio.toFixed(2)]);
}
return found;
"""


@pytest.fixture(scope="module")
def report(written: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("browser")
    write_report([written / "run"], folder, pictures="none")
    return (folder / "report.html").as_uri()


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """One browser for all tests; it may not reach any host."""
    yield from headless_chromium()


@pytest.fixture
def opened(chromium: Any, report: str) -> Iterator[Callable[..., Any]]:
    """Opens the report at a width, light or dark; afterwards the console must be empty and nothing
    may have been asked for.
    """

    def open_page(width: int = 1280, *, dark: bool = False, fragment: str = "") -> Any:
        screen = {"width": width, "height": 800, "deviceScaleFactor": 1, "mobile": width < 600}
        chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
        chromium.execute_cdp_cmd(
            "Emulation.setEmulatedMedia",
            {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]},
        )
        chromium.get("about:blank")
        chromium.get(report + fragment)
        wait(chromium, lambda: any(label.text for label in find(chromium, ".filters label")))
        return chromium

    for kind in ("browser", "performance"):
        chromium.get_log(kind)
    yield open_page
    assert chromium.get_log("browser") == []
    asked = [
        entry["message"]
        for entry in chromium.get_log("performance")
        if '"Network.requestWillBeSent"' in entry["message"]
    ]
    assert [
        message for message in asked if "http" in message.split('"url":"', 1)[1].split('"', 1)[0]
    ] == []
    assert chromium.execute_script("return window.attacked") is None


def find(driver: Any, selector: str) -> list[Any]:
    found: list[Any] = driver.find_elements("css selector", selector)
    return found


def choose(driver: Any, label: str, value: str) -> None:
    from selenium.webdriver.support.ui import Select

    Select(
        next(
            field for field in find(driver, ".filters label") if field.text.startswith(label)
        ).find_element("css selector", "select")
    ).select_by_visible_text(value)


def shown(driver: Any) -> list[str]:
    """Ids of the samples in the list, read at once: it may be built anew at any time."""
    script = (
        "return [...document.querySelectorAll('.samples .id')].map((node) =>"
        " node.textContent.split(' · ')[0])"
    )
    found: list[str] = driver.execute_script(script)
    return found


def wait(driver: Any, condition: Callable[[], bool]) -> None:
    from selenium.webdriver.support.ui import WebDriverWait

    WebDriverWait(driver, SCRIPT_SECONDS).until(lambda _driver: condition())


def test_filters_narrow_the_list(opened: Callable[..., Any]) -> None:
    driver = opened()
    assert shown(driver) == ["orbit", "home", "hold", "impossible"]
    choose(driver, "System", "good, Base")
    choose(driver, "Outcome", "wrong")
    assert shown(driver) == ["hold"]
    choose(driver, "Outcome", "parameter propagation")
    assert shown(driver) == ["hold"]
    choose(driver, "System", "all")
    choose(driver, "Outcome", "right and wrong (systems differ)")
    assert shown(driver) == ["orbit", "home", "impossible"]
    choose(driver, "Group", "short")
    assert shown(driver) == ["home"]
    assert find(driver, ".status")[0].text == "1 of 4 samples"
    find(driver, ".filters .button")[0].click()
    assert len(shown(driver)) == 4


def test_search_finds_commands_and_names_in_answers(opened: Callable[..., Any]) -> None:
    driver = opened()
    search = find(driver, 'input[type="search"]')[0]
    search.send_keys("five MINUTES")
    wait(driver, lambda: shown(driver) == ["hold"])
    search.clear()
    search.send_keys("diagnostics")
    wait(driver, lambda: shown(driver) == ["hold"])


def test_an_opened_sample_shows_both_plans_and_marks_what_differs(
    opened: Callable[..., Any],
) -> None:
    driver = opened()
    choose(driver, "System", "good, Base")
    find(driver, ".samples summary")[2].click()
    wait(driver, lambda: bool(find(driver, ".plans tbody tr")))
    rows = find(driver, ".plans tbody tr")
    assert [row.get_attribute("class") for row in rows] == ["same", "changed"]
    assert [mark.text for mark in find(driver, "mark")] == ["duration=300", "duration=30"]


def test_hostile_answers_are_shown_as_they_are(opened: Callable[..., Any]) -> None:
    driver = opened()
    choose(driver, "System", "hostile, Base")
    for summary in find(driver, ".samples > li > details > summary"):
        summary.click()
    wait(driver, lambda: len(find(driver, ".body section")) == 4)
    assert HOSTILE.replace("\u2028", "") in [
        element.get_property("textContent").replace("\u2028", "")
        for element in find(driver, ".plans .name")
    ]
    assert find(driver, "main img") == []
    marks = {row.get_attribute("class") for row in find(driver, ".plans tbody tr")}
    assert {"missing", "extra", "substituted"} <= marks


def test_a_count_of_failures_shows_its_samples(opened: Callable[..., Any]) -> None:
    driver = opened()
    button = next(
        button
        for button in find(driver, ".heat button")
        if "good, Base" in button.get_attribute("aria-label")
    )
    button.click()
    assert shown(driver) == ["hold"]


def test_the_keyboard_reaches_and_opens_everything(opened: Callable[..., Any]) -> None:
    from selenium.webdriver.common.keys import Keys

    driver = opened()
    body = find(driver, "body")[0]
    body.send_keys(Keys.TAB)
    assert driver.switch_to.active_element.text == "Skip to the figures"
    outline = (
        "const s = getComputedStyle(document.activeElement); return [s.outlineStyle,"
        " parseFloat(s.outlineWidth)]"
    )
    reached = []
    for _step in range(80):
        driver.switch_to.active_element.send_keys(Keys.TAB)
        active = driver.switch_to.active_element
        if active.tag_name == "body":
            break
        style, width = driver.execute_script(outline)
        assert (style, width >= 2) == ("solid", True), active.get_attribute("outerHTML")[:200]
        reached.append(
            (active.tag_name, active.get_attribute("type"), active.get_attribute("class"))
        )
    assert {"a", "input", "select", "summary", "button", "div"} <= {
        name for name, _type, _class in reached
    }
    first = find(driver, ".samples summary")[0]
    driver.execute_script("arguments[0].focus()", first)
    first.send_keys(Keys.ENTER)
    wait(driver, lambda: bool(find(driver, ".plans")))
    first.send_keys(Keys.ARROW_DOWN)
    assert driver.switch_to.active_element == find(driver, ".samples > li > details > summary")[1]


def test_a_link_leads_to_a_sample(opened: Callable[..., Any]) -> None:
    driver = opened(fragment="#sample-0-2")
    wait(driver, lambda: bool(find(driver, ".plans")))
    assert find(driver, "#sample-0-2[open]")


def open_all(driver: Any) -> None:
    """Open all samples; the list may come later than the page."""
    script = "document.querySelectorAll('details').forEach((node) => { node.open = true; })"
    wait(driver, lambda: driver.execute_script(script) or len(find(driver, ".body section")) >= 4)


@pytest.mark.parametrize("width", [320, 375, 768, 1280])
def test_no_width_needs_to_scroll_sideways(opened: Callable[..., Any], width: int) -> None:
    driver = opened(width)
    open_all(driver)
    assert driver.execute_script("return document.documentElement.scrollWidth") <= width


def test_letters_in_charts_are_not_shrunk_on_a_phone(opened: Callable[..., Any]) -> None:
    driver = opened(375)
    scale = (
        "return [...document.querySelectorAll('svg')].filter((s) => s.checkVisibility()).map((s) =>"
        " s.getBoundingClientRect().width / s.viewBox.baseVal.width)"
    )
    scales = driver.execute_script(scale)
    assert scales
    assert min(scales) > 0.95


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
def test_text_stands_out_from_its_background(opened: Callable[..., Any], dark: bool) -> None:
    driver = opened(dark=dark)
    open_all(driver)
    assert driver.execute_script(CONTRAST) == []
    page = driver.execute_script("return getComputedStyle(document.body).backgroundColor")
    assert (page == "rgb(255, 255, 255)") is not dark
