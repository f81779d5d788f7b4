"""What a reviewer does on the page: read, place, edit, ask again, approve, reject."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import pytest

from planner_ft.confidence.calibration import Judgement
from planner_ft.document import build, write_document
from planner_ft.planning.result import Doubt
from planner_ft.support.errors import PlannerError
from tests.documents import USV
from tests.review.web.page.conftest import COMMAND, TASKS, Page, go, make_plan, planned, step

pytestmark = pytest.mark.browser
Opened = Callable[..., Page]


def parameter(page: Page, task: str, name: str) -> str:
    return page.text(f'#task-{task} [data-parameter="{name}"]')


def open_value(page: Page, task: str, name: str) -> None:
    page.one(f'#task-{task} [data-parameter="{name}"] .value').click()


def test_warnings_lead_to_what_they_are_about(opened: Opened) -> None:
    page = opened(closed=True)
    page.says("#warnings-title", "to acknowledge")
    page.says(".warnings li", "green buoy")
    page.press("Show task 2, target_position", ".warnings")
    assert "target_position" in page.focused()
    assert page.run("return document.querySelector('.task.chosen').id") == "task-t2"
    assert page.all('#task-t2 .parameter.chosen[data-parameter="target_position"]')


def test_approving_needs_every_warning_and_a_name_and_says_which_is_lacking(opened: Opened) -> None:
    page = opened(reviewer="")
    page.says(".approve", "lacking")
    assert page.one(".approve").get_attribute("aria-disabled") == "true"
    page.one(".approve").click()
    assert page.run("return document.activeElement.type") == "checkbox"
    for box in page.all(".warnings input"):
        box.click()
    page.says("#warnings-title", "All warnings acknowledged")
    page.says(".approve", "Approve: your name lacking")
    page.one(".approve").click()
    page.keys("Ada Reviewer")
    page.until("return document.querySelector('.approve').textContent === 'Approve …'")
    page.one(".approve").click()
    page.says("dialog .summary", "Not checked by any program")
    assert not page.review.session.log.exists()
    page.press("Approve as Ada Reviewer", "dialog")
    page.says(".bar .state", "Approved")
    page.says(".bar .state", "Ada Reviewer")
    record = page.review.decisions()[-1]
    assert (record["event"], record["reviewer"]) == ("approved", "Ada Reviewer")
    assert {warning["id"] for warning in record["acknowledged"]} == {
        warning["id"] for warning in page.review.document()["warnings"]
    }


def test_a_question_is_answered_with_one_button(opened: Opened) -> None:
    asked = planned(COMMAND, TASKS)
    doubts = (Doubt(2, "radius", 12, (15,)),)
    held = {(): 0.4, ("tasks", 2): 0.5, ("tasks", 2, "parameters", "radius"): 0.5}
    mission = replace(asked.mission, judged=Judgement("", held))
    tasks = tuple(replace(task, answer=None) for task in asked.tasks)
    page = opened(build(replace(asked, mission=mission, tasks=tasks, doubts=doubts), USV))
    page.says(".overview", "unsure")
    page.says(".asked", "Task 3, PerformOrbit: radius 12 m or 15 m?")
    assert page.text('#task-t3 [data-parameter="radius"] .level') == "unsure"
    assert page.text("#task-t3 .head .level") == "unsure"
    page.press("Task 3, PerformOrbit: radius 12 m or 15 m? 15", ".asked")
    page.says('#task-t3 [data-parameter="radius"]', "15")
    assert not page.all(".asked")
    assert page.review.document()["tasks"][2]["parameters"]["radius"] == 15


def test_a_warning_that_changes_is_to_be_acknowledged_again(opened: Opened) -> None:
    page = opened()
    for box in page.all(".warnings input"):
        box.click()
    page.says("#warnings-title", "All warnings acknowledged")
    plan = page.review.document()
    first, *others = plan["warnings"]
    write_document(
        page.review.path,
        {**plan, "warnings": [{**first, "text": "It is worse than that."}, *others]},
    )
    page.says("#warnings-title", "1 warning to acknowledge")


def test_rejecting_asks_for_the_reason(opened: Opened) -> None:
    page = opened(reviewer="")
    page.press("Reject …")
    page.keys("The survey lies in the fairway.")
    page.press("Reject the plan")
    page.says("dialog .refusal", "name")
    assert not page.review.session.log.exists()
    page.write("dialog input", "Ada")
    page.press("Reject the plan")
    page.says(".bar .state", "Rejected")
    assert page.review.decisions()[-1]["reason"] == "The survey lies in the fairway."


def test_spans_of_the_command_are_marked_by_colour_and_by_line(opened: Opened) -> None:
    plan = make_plan()
    spans = [
        ("objective", "Find"),
        ("target", "the green buoy"),
        ("sensor", "video"),
        ("constraint", "come home"),
    ]
    elements = [
        {
            "element": name,
            "start": plan["command"].index(text),
            "end": plan["command"].index(text) + len(text),
            "text": text,
        }
        for name, text in spans
    ]
    page = opened(
        {
            **plan,
            "ontology": {
                "elements": elements,
                "missing": [],
                "questions": ["Which camera is to record?"],
            },
        }
    )
    assert page.one(".command").get_property("textContent") == plan["command"]
    styles = page.run(
        "return [...document.querySelectorAll('.command span')].map((one) => [one.textContent,"
        " getComputedStyle(one).textDecorationStyle])"
    )
    assert styles == [
        ["Find", "solid"],
        ["the green buoy", "double"],
        ["video", "dotted"],
        ["come home", "dashed"],
    ]
    page.says(".legend div", "“the green buoy”")
    page.says(".facts li", "Which camera is to record?")


def test_a_value_lights_its_words_in_the_command_also_after_an_emoji(opened: Opened) -> None:
    page = opened(make_plan("🚤🌊 circle the green buoy at 12 m and come home."))
    page.run("document.querySelector('#task-t3 [data-parameter=radius] .value').focus()")
    page.until("return document.querySelector('.command .lit') !== null")
    assert page.text(".command .lit") == "12 m"
    assert "command" in parameter(page, "t3", "radius")


def test_a_value_that_only_the_model_chose_stands_apart(opened: Opened) -> None:
    page = opened()
    assert page.text('#task-t3 [data-parameter="speed"] .source').startswith("model's own")
    assert (
        page.run("return getComputedStyle(document.querySelector('.source.of-model')).borderStyle")
        == "dashed"
    )


def test_a_value_is_edited_in_place_refused_at_its_field_and_shown_as_a_difference(
    opened: Opened,
) -> None:
    page = opened()
    open_value(page, "t3", "radius")
    page.keys("-5", "\n")
    page.says(".edit .refusal", "radius")
    assert page.run("return document.activeElement.value") == "-5"
    assert page.review.document()["tasks"][2]["parameters"]["radius"] == 12
    page.write(".edit input", "15")
    page.keys("\n")
    page.gone(".edit")
    assert "15 m" in parameter(page, "t3", "radius")
    page.says(".changes li", "3 PerformOrbit, radius")
    assert [page.text(".changes .sides del"), page.text(".changes .sides ins")] == ["12", "15"]
    assert "radius" in page.focused()
    page.press("Undo")
    page.says('#task-t3 [data-parameter="radius"]', "12 m")
    page.gone(".changes li")


def test_a_value_is_left_out_and_given_again(opened: Opened) -> None:
    page = opened()
    open_value(page, "t3", "speed")
    page.press("Leave out")
    page.gone('#task-t3 [data-parameter="speed"]')
    assert "speed" not in page.review.document()["tasks"][2]["parameters"]
    page.run(
        "const one = document.querySelector('#task-t3 .parameters .add'); one.value = 'arc';"
        " one.dispatchEvent(new Event('change', {bubbles: true}))"
    )
    page.keys("180", "\n")
    page.says('#task-t3 [data-parameter="arc"]', "180°")


def test_a_value_of_a_skill_is_edited(opened: Opened) -> None:
    page = opened()
    page.one("#task-t5 .skill .value").click()
    page.keys("3", "\n")
    page.says(".changes li", "5 Transit, steps")
    assert page.review.document()["tasks"][4]["skill_sequence"][0]["navigation_skill"][
        "parameters"
    ] == {"x": 3, "y": 0}


def test_tasks_are_moved_by_button_by_keys_and_by_dragging(opened: Opened) -> None:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.keys import Keys

    page = opened()
    before = page.titles()
    page.press("Earlier: task 4, BathymetryGridSurvey")
    page.until(
        "return document.querySelectorAll('.task .title')[2].textContent === 'BathymetryGridSurvey'"
    )
    page.until("return document.activeElement.innerText.includes('BathymetryGridSurvey')")
    ActionChains(page.driver).key_down(Keys.ALT).send_keys(Keys.ARROW_DOWN).key_up(
        Keys.ALT
    ).perform()
    page.until(
        "return document.querySelectorAll('.task .title')[3].textContent === 'BathymetryGridSurvey'"
    )
    assert page.titles() == before
    handle, goal = page.all(".task .handle")[1], page.all(".task .handle")[0]
    ActionChains(page.driver).move_to_element(handle).click_and_hold().move_to_element_with_offset(
        goal, 0, -8
    ).release().perform()
    page.until("return document.querySelectorAll('.task .title')[0].textContent === 'Transit'")
    assert [task["id"] for task in page.review.document()["tasks"]] == [
        "t2",
        "t1",
        "t3",
        "t4",
        "t5",
    ]
    page.says(".changes li", "moved")


def test_a_task_is_removed_and_brought_back(opened: Opened) -> None:
    page = opened()
    page.press("Remove task 4, BathymetryGridSurvey")
    page.gone("#task-t4")
    page.says(".changes li", "BathymetryGridSurvey removed")
    page.press("Undo")
    page.one("#task-t4")


def test_a_task_is_inserted_where_it_is_asked_for(opened: Opened) -> None:
    from selenium.webdriver.support.ui import Select

    page = opened()
    page.press("Insert a task")
    Select(page.one("dialog select")).select_by_visible_text("KeepStation")
    Select(page.all("dialog select")[1]).select_by_value("1")
    page.write("#new-duration", "soon")
    page.press("Insert", "dialog")
    page.says("dialog .refusal", "duration")
    page.write("#new-duration", "60")
    page.all("dialog textarea")[0].send_keys("Hold here for a minute.")
    page.press("Insert", "dialog")
    page.gone("dialog")
    assert page.titles()[1] == "KeepStation"
    assert page.review.document()["tasks"][1]["task_prompt"] == "Hold here for a minute."


def test_an_edited_prompt_asks_for_new_steps_of_that_task_alone(opened: Opened) -> None:
    page = opened()
    page.press("Change what the Task Agent is told of task 5, Transit")
    page.write("#task-t5 textarea", "Return home slowly.")
    page.press("Save", "#task-t5")
    page.says("#task-t5 .waits", "before this task was changed")
    page.press("Plan its steps again", "#task-t5")
    page.review.agents.answers.put([*go((5, 5)), step("StationKeep", time=10)])
    page.says("#task-t5 .fold", "2 steps")
    page.gone("#task-t5 .waits")
    assert len(page.review.document()["tasks"][4]["skill_sequence"]) == 2


def test_a_new_command_is_watched_task_by_task_and_saved_beside_the_former(opened: Opened) -> None:
    page = opened()
    page.press("New command")
    page.keys("Go home slowly.")
    page.press("Plan it")
    page.says(".progress .command", "Go home slowly.")
    answers = page.review.agents.answers
    answers.put([TASKS[4], TASKS[0]])
    page.until("return document.querySelectorAll('.draft li').length === 2")
    assert not page.all(".draft li.ready")
    answers.put("first")
    page.says(".draft li.ready", "Transit")
    assert len(page.all(".draft li.ready")) == 1
    answers.put("second")
    page.until("return document.querySelectorAll('.draft li.ready').length === 2")
    answers.put("done")
    page.gone(".progress")
    page.until("return document.querySelectorAll('.task').length === 2")
    assert page.text(".plan .command") == "Go home slowly."
    assert len(page.review.document()["tasks"]) == len(TASKS)
    assert (
        len(
            page.run(
                "return [...document.querySelectorAll('.bar select option')].map((one) =>"
                " one.value)"
            ).copy()
        )
        >= 2
    )


def test_agents_that_fail_before_the_command_is_answered_are_told(opened: Opened) -> None:
    page = opened()
    page.run(
        """const real = window.fetch;
      window.fetch = async (path, options) => { const answer = await real(path, options); if (path === '/api/plan') await new Promise((go) => { window.release = go; }); return answer; }"""
    )
    page.review.agents.answers.put(PlannerError("the agents are out of memory"))
    page.press("New command")
    page.keys("Go home slowly.")
    page.press("Plan it")
    page.says(".message.bad", "the agents are out of memory")
    page.until("return Boolean(window.release)")
    page.run("window.release()")
    page.gone("dialog")
    page.says(".message.bad", "the agents are out of memory")
    page.gone(".progress")


@pytest.mark.parametrize("button", ["New command", "Reject …"])
def test_keys_right_after_a_click_belong_to_the_dialog(opened: Opened, button: str) -> None:
    page = opened()
    focused = page.run(
        """[...document.querySelectorAll('button')].find((one) => one.textContent === arguments[0]).click();
      return Promise.resolve().then(() => null).then(() =>
        document.activeElement.closest('dialog') && document.activeElement.tagName)""",
        button,
    )
    assert focused == "TEXTAREA"


def test_another_plan_of_the_folder_is_opened(opened: Opened) -> None:
    from selenium.webdriver.support.ui import Select

    page = opened()
    write_document(page.review.path.with_name("other.json"), make_plan("Come home.", TASKS[4:]))
    page.run("location.reload()")
    page.until(
        "return [...document.querySelectorAll('.bar option')].some((one) => one.value ==="
        " 'other.json')"
    )
    Select(page.one(".bar select")).select_by_value("other.json")
    page.until("return document.querySelectorAll('.task').length === 1")
    assert page.text(".plan .command") == "Come home."


def test_without_agents_the_plan_is_reviewed_and_the_page_says_why(opened: Opened) -> None:
    page = opened(why="adapters/mission: is broken; train it anew")
    page.press("New command")
    page.says("dialog", "adapters/mission: is broken; train it anew")
    assert page.one("dialog .act").get_attribute("disabled")
    page.press("Close")
    open_value(page, "t3", "radius")
    page.keys("15", "\n")
    page.says(".changes li", "radius")


def test_a_change_that_meets_another_is_told_and_can_be_made_again(opened: Opened) -> None:
    page = opened()
    page.run(
        """const real = window.fetch; window.held = [];
      window.fetch = (path, options) => (path === '/api/state' ? new Promise((go) => window.held.push(() => go(real(path, options)))) : real(path, options))"""
    )
    page.review.elsewhere({"kind": "parameter", "task": "t4", "name": "spacing", "value": 5})
    open_value(page, "t3", "radius")
    page.keys("15", "\n")
    page.says(".message.bad", "Somebody else changed this plan")
    page.says('#task-t4 [data-parameter="spacing"]', "5 m")
    assert page.review.document()["tasks"][2]["parameters"]["radius"] == 12
    page.press("Make my change on the new plan")
    page.says(".changes li", "3 PerformOrbit, radius")
    page.gone(".message.bad")
    parameters = [task["parameters"] for task in page.review.document()["tasks"]]
    assert (parameters[2]["radius"], parameters[3]["spacing"]) == (15, 5)


def test_what_is_being_written_is_kept_when_somebody_else_changes_it(opened: Opened) -> None:
    page = opened()
    open_value(page, "t3", "radius")
    page.keys("17")
    page.review.elsewhere({"kind": "parameter", "task": "t3", "name": "radius", "value": 20})
    page.says(".meanwhile", "20 m now")
    assert page.run("return document.querySelector('.edit input').value") == "17"


def test_markup_in_a_command_is_shown_as_it_is(opened: Opened) -> None:
    command = (
        "Find <img src=x onerror='window.attacked=1'> &"
        " </script><script>window.attacked=1</script>\u202e at [1, 2]."
    )
    tasks = [
        (
            "SearchAndDetect",
            {"target_description": "<b onclick=alert(1)>buoy</b>"},
            "<svg onload='window.attacked=1'>",
            go((1, 2)),
        )
    ]
    page = opened(make_plan(command, tasks))
    assert page.one(".command").get_property("textContent") == command
    assert (
        page.text('[data-parameter="target_description"] .value') == "<b onclick=alert(1)>buoy</b>"
    )
    assert page.text(".prompt span") == "<svg onload='window.attacked=1'>"
    assert page.all("main img, main script, main b[onclick]") == []


def test_a_theme_is_remembered(opened: Opened) -> None:
    from selenium.webdriver.support.ui import Select

    page = opened()
    Select(page.all(".bar select")[1]).select_by_visible_text("Night")
    night = page.run("return getComputedStyle(document.body).backgroundColor")
    page.run("location.reload()")
    page.one("main.plan")
    assert page.run(
        "return [document.documentElement.dataset.theme,"
        " getComputedStyle(document.body).backgroundColor]"
    ) == ["night", night]
    page.run("localStorage.clear()")
