"""The page in a real headless browser, before a real server whose agents say what a test lets them
say.

Skipped where there is no chromium, chromedriver or selenium; PLANNERFT_REQUIRE_BROWSER=1 makes that
a failure.
"""

from __future__ import annotations

import json
import queue
import socket
import threading
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest
import uvicorn

from planner_ft.document import PlanDocument, apply, build, read_document, write_document
from planner_ft.exporters import run as exporting
from planner_ft.planning.planner import SkillsKnown, TasksKnown
from planner_ft.planning.result import AgentUse, Answer, Planned, PlannedTask
from planner_ft.planning.settings import PlanSettings
from planner_ft.review.web.app import web_app
from planner_ft.review.web.guard import Door
from planner_ft.review.web.planning import Planning
from planner_ft.review.web.session import Session, WebSettings
from planner_ft.simulation.run import run_live
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary
from tests.browser import headless_chromium

PATIENCE = 60
"""Seconds after which what a test waits for does not come."""
COMMAND = (
    "Find the green buoy, circle it at 12 m with video, survey depths over 20 by 20 m at [60, -30]"
    " with lanes every 10 m, come home."
)
Step = dict[str, Any]


def step(
    name: str, *filters: dict[str, Any], gather: tuple[str, ...] = (), **parameters: Any
) -> Step:
    return {
        "navigation_skill": {"name": name, "parameters": parameters},
        "filter_skills": list(filters),
        "perception_skills": [{"name": one, "parameters": {}} for one in gather],
        "stop_conditions": ["position reached"],
        "failure_modes": ["position not reachable"],
        "expected_outputs": [],
    }


def go(*corners: tuple[float, float], gather: tuple[str, ...] = ()) -> list[Step]:
    return [step("GoToXY", gather=gather, x=x, y=y) for x, y in corners]


BOX = {
    "name": "BoundaryEnforcement",
    "parameters": {"poly_coords": [[40, -50], [80, -50], [80, -10], [40, -10]]},
}
LANES = go(
    (50, -40), (50, -20), (60, -20), (60, -40), (70, -40), (70, -20), gather=("GetSeabedDepth",)
)
TASKS: list[tuple[str, dict[str, Any], str, list[Step] | None]] = [
    (
        "SearchAndDetect",
        {"target_description": "green buoy"},
        "Find the green buoy.",
        [step("StationKeep", gather=("DetectObjects",), time=30)],
    ),
    ("Transit", {"target_position": [-99, -99]}, "Go to the green buoy once it is found.", None),
    (
        "PerformOrbit",
        {"center": [-99, -99], "radius": 12, "speed": 1.2},
        "Circle the green buoy at 12 m.",
        None,
    ),
    (
        "BathymetryGridSurvey",
        {"center": [60, -30], "width": 20, "length": 20, "spacing": 10},
        "Survey the depths.",
        [{**LANES[0], "filter_skills": [BOX]}, *LANES[1:]],
    ),
    ("Transit", {"target_position": [0, 0]}, "Return home.", go((0, 0))),
]


def answer(plan: dict[str, Any] | None) -> Answer:
    return Answer("", plan, (), (), 3, 10, 6, 0.25)


def planned(
    command: str, tasks: list[tuple[str, dict[str, Any], str, list[Step] | None]]
) -> Planned:
    """What agents would give that answer with these tasks."""
    entries = [
        {"title": title, "parameters": parameters, "task_prompt": prompt}
        for title, parameters, prompt, _skills in tasks
    ]
    mission = answer(
        {
            "tasks": entries,
            "assumptions": ["Home is [0, 0]."],
            "constraints": ["The green buoy must be found first."],
        }
    )
    with_skills = tuple(
        PlannedTask(
            title,
            dict(parameters),
            prompt,
            None if skills is None else answer({"skill_sequence": skills}),
            None if skills else "green buoy",
        )
        for title, parameters, prompt, skills in tasks
    )
    usage = {"mission": AgentUse("embedded", "lora+grounded", None, 0.5, 1, 1, 1, 1, 1.0)}
    return Planned(
        command,
        mission,
        with_skills,
        (),
        usage=usage,
        manifest=build_manifest("plan", seed=None, configuration={}),
    )


def make_plan(
    command: str = COMMAND, tasks: list[tuple[str, dict[str, Any], str, list[Step] | None]] = TASKS
) -> PlanDocument:
    return build(planned(command, tasks), load_vocabulary())


@dataclass
class Agents:
    """Stands in for Planner: what a command or a task gets is put in by the test, one answer after
    the other.
    """

    answers: queue.SimpleQueue[Any] = field(default_factory=queue.SimpleQueue)

    def plan(
        self, command: str, _locations: Any, on_event: Callable[[Any], None], _origin: Any
    ) -> Planned:
        tasks = self.answers.get(timeout=PATIENCE)
        if isinstance(tasks, Exception):
            raise tasks
        result = planned(command, tasks)
        on_event(
            TasksKnown(
                tuple(
                    PlannedTask(task.title, task.parameters, task.task_prompt)
                    for task in result.tasks
                )
            )
        )
        for number, task in enumerate(result.tasks, start=1):
            if task.answer is not None:
                self.answers.get(timeout=PATIENCE)
                on_event(SkillsKnown(number, task.answer))
        self.answers.get(timeout=PATIENCE)
        return result

    def skills(self, _task: dict[str, Any], _before: list[dict[str, Any]]) -> Answer:
        return answer({"skill_sequence": self.answers.get(timeout=PATIENCE)})


@dataclass
class Review:
    """A server with a plan, and what a test does behind the page's back."""

    base: str
    door: Door
    session: Session
    path: Path
    agents: Agents

    def document(self) -> PlanDocument:
        return read_document(self.path)

    def elsewhere(self, edit: dict[str, Any]) -> None:
        """Another person changes the plan."""
        write_document(self.path, apply(self.document(), edit, load_vocabulary()))

    def decisions(self) -> list[dict[str, Any]]:
        return [json.loads(line) for line in self.session.log.read_text().splitlines()]


@pytest.fixture
def start(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[..., Review]]:
    """Call it with a plan document: a server that shows it. `why` says why there are no agents."""
    running: list[tuple[uvicorn.Server, Session, threading.Thread]] = []

    def serve(
        document: PlanDocument | None = None, why: str | None = None, reviewer: str = "Ada"
    ) -> Review:
        agents, path = Agents(), tmp_path / "plan.json"

        def load(planning: Planning) -> Agents | None:
            planning.why = why
            return agents if why is None else None

        monkeypatch.setattr(Planning, "_load", load)
        write_document(path, document or make_plan())
        listener = socket.create_server(("127.0.0.1", 0))
        door = Door("127.0.0.1", listener.getsockname()[1])
        session = Session(
            path,
            WebSettings(
                folder=tmp_path,
                reviewer=reviewer,
                planning=PlanSettings(configuration="base"),
                exporting=exporting,
                runner=run_live,
            ),
        )
        server = uvicorn.Server(
            uvicorn.Config(
                web_app(session, door),
                log_level="error",
                access_log=False,
                timeout_graceful_shutdown=1,
            )
        )
        thread = threading.Thread(target=server.run, kwargs={"sockets": [listener]}, daemon=True)
        thread.start()
        running.append((server, session, thread))
        return Review(f"http://127.0.0.1:{door.port}", door, session, path, agents)

    yield serve
    for server, session, thread in running:
        session.events.close()
        session.runs.end()
        server.should_exit = True
        thread.join(PATIENCE)


@pytest.fixture(scope="module")
def chromium() -> Iterator[Any]:
    """One browser for the tests of a module; it may not reach any host but this machine's."""
    yield from headless_chromium("127.0.0.1")


class Page:
    """The page as a person uses it."""

    def __init__(self, driver: Any, review: Review) -> None:
        self.driver, self.review = driver, review

    def run(self, script: str, *arguments: Any) -> Any:
        return self.driver.execute_script(script, *arguments)

    def all(self, selector: str) -> list[Any]:
        found: list[Any] = self.driver.find_elements("css selector", selector)
        return found

    def one(self, selector: str) -> Any:
        """The element, as soon as it is there."""
        self.until(f"return document.querySelector({json.dumps(selector)}) !== null", selector)
        return self.driver.find_element("css selector", selector)

    def text(self, selector: str) -> str:
        """The text of the first such element, empty without one; read at once, since it may be
        drawn anew at any time.
        """
        script = (
            "const one = document.querySelector(arguments[0]); return one ? (one.innerText ??"
            " one.textContent).replaceAll('\\u00a0', ' ') : ''"
        )
        found: str = self.run(script, selector)
        return found

    def until(self, script: str, what: str = "") -> None:
        from selenium.webdriver.support.ui import WebDriverWait

        WebDriverWait(self.driver, PATIENCE, poll_frequency=0.1).until(
            lambda driver: driver.execute_script(script), what or script
        )

    def says(self, selector: str, text: str) -> None:
        """Waits until an element of that kind says the text."""
        said = f"(one) => one.textContent.replaceAll('\\u00a0', ' ').includes({json.dumps(text)})"
        self.until(
            f"return [...document.querySelectorAll({json.dumps(selector)})].some({said})",
            f"{selector}: {text}",
        )

    def gone(self, selector: str) -> None:
        self.until(
            f"return document.querySelector({json.dumps(selector)}) === null", f"no {selector}"
        )

    def press(self, name: str, within: str = "body") -> None:
        """Presses the button or link that is called so, by its text or label."""
        script = """return [...document.querySelectorAll(arguments[0] + ' button, ' + arguments[0] + ' a')].find((one) => !one.disabled && one.checkVisibility()
          && [one.textContent.trim(), one.getAttribute('aria-label')].includes(arguments[1])) || null"""
        self.until(
            script.replace("arguments[0]", json.dumps(within)).replace(
                "arguments[1]", json.dumps(name)
            ),
            f"button {name}",
        )
        button = self.run(script, within, name)
        self.run("arguments[0].scrollIntoView({block: 'center'})", button)
        button.click()

    def keys(self, *keys: str) -> None:
        """Keys to whatever has the focus."""
        from selenium.webdriver.common.action_chains import ActionChains

        for key in keys:
            ActionChains(self.driver).send_keys(key).perform()

    def focused(self) -> str:
        found: str = self.run(
            "const one = document.activeElement; return one.getAttribute('aria-label') ||"
            " one.innerText || one.id || one.tagName"
        )
        return found

    def titles(self) -> list[str]:
        found: list[str] = self.run(
            "return [...document.querySelectorAll('.task .title')].map((one) => one.textContent)"
        )
        return found

    def write(self, selector: str, text: str) -> None:
        from selenium.webdriver.common.keys import Keys

        field_ = self.one(selector)
        field_.send_keys(Keys.CONTROL, "a")
        field_.send_keys(text)


@pytest.fixture
def opened(chromium: Any, start: Callable[..., Review]) -> Iterator[Callable[..., Page]]:
    """Opens the page on a plan, for a reviewer whose name is known and with the details of every
    task shown (unless `closed`). Afterwards no script may have failed and no request may have left
    the origin.
    """
    pages: list[Page] = []

    def open_page(
        document: PlanDocument | None = None,
        width: int = 1440,
        height: int = 900,
        *,
        dark: bool = False,
        why: str | None = None,
        reviewer: str = "Ada",
        closed: bool = False,
    ) -> Page:
        review = start(document, why, reviewer)
        screen = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
        chromium.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", screen)
        features = [
            {"name": "prefers-color-scheme", "value": "dark" if dark else "light"},
            {"name": "prefers-reduced-motion", "value": "reduce"},
        ]
        chromium.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        chromium.get(f"{review.base}/?token={review.door.key}")
        page = Page(chromium, review)
        page.one("main")
        pages.append(page)
        if not closed:
            page.press("Open all")
        return page

    for kind in ("browser", "performance"):
        chromium.get_log(kind)
    yield open_page
    refusals = ("status of 409", "status of 422")
    assert [
        entry
        for entry in chromium.get_log("browser")
        if not any(refusal in entry["message"] for refusal in refusals)
    ] == []
    asked = [json.loads(entry["message"])["message"] for entry in chromium.get_log("performance")]
    addresses = {
        message["params"]["request"]["url"]
        for message in asked
        if message["method"] == "Network.requestWillBeSent"
    }
    own = (*(page.review.base for page in pages), "data:", "about:")
    assert [address for address in addresses if not address.startswith(own)] == []
    assert not pages or chromium.execute_script("return window.attacked") is None
    if pages:
        chromium.execute_script("sessionStorage.clear()")
    chromium.get("about:blank")
