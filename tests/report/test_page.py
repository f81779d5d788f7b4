"""report.html: self-contained, and safe whatever a model answers. test_browser.py opens it."""

from __future__ import annotations

import base64
import gzip
import hashlib
import html
import json
import re
from pathlib import Path
from typing import Any

import pytest

from planner_ft.report.answers import script_json
from planner_ft.report.write import write_report
from tests.report.conftest import COMMANDS, HOSTILE


@pytest.fixture(scope="module")
def page(written: Path, tmp_path_factory: pytest.TempPathFactory) -> str:
    folder = tmp_path_factory.mktemp("report")
    write_report([written / "run"], folder, pictures="none")
    return (folder / "report.html").read_text(encoding="utf-8")


def embedded(page: str, name: str) -> str:
    found = re.search(rf'<script type="[a-z/]+" id="{name}">(.*?)</script>', page, re.S)
    assert found
    return found[1]


def details(page: str) -> list[Any]:
    unpacked: list[Any] = json.loads(gzip.decompress(base64.b64decode(embedded(page, "part-0-0"))))
    return unpacked


def test_nothing_is_loaded_from_anywhere(page: str) -> None:
    assert not re.findall(r"""(?:src|href)\s*=\s*["'](?!#)""", page)
    assert not re.findall(r"url\(|@import|https?://(?!www\.w3\.org/)", page)
    assert "default-src 'none'" in html.unescape(page)


def test_the_policy_allows_the_one_script_and_the_one_style_sheet(page: str) -> None:
    policy = html.unescape(
        re.findall(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page)[0]
    )
    for element, content in (
        ("style", re.findall(r"<style>(.*?)</style>", page, re.S)),
        ("script", re.findall(r"<script>(.*?)</script>", page, re.S)),
    ):
        assert len(content) == 1
        digest = base64.b64encode(hashlib.sha256(content[0].encode()).digest()).decode()
        assert f"{element}-src 'sha256-{digest}'" in policy
    assert "unsafe" not in policy


def test_hostile_answers_stay_data(page: str) -> None:
    assert "<img" not in page
    assert "\u2028" not in embedded(page, "index-0")
    assert page.count("<script") == page.count("</script>") == 3
    assert HOSTILE in json.loads(embedded(page, "index-0"))["names"]
    assert HOSTILE in [answer[3] for sample in details(page) for answer in sample[1] if answer]


def test_json_inside_a_script_reads_back_and_cannot_end_it() -> None:
    value = {"x": [HOSTILE, "&lt;", "ü", "😀"]}
    text = script_json(value)
    assert not re.search(r"[<>&\u2028\u2029]", text)
    assert json.loads(text) == value


def test_every_sample_and_answer_is_there(page: str) -> None:
    index = json.loads(embedded(page, "index-0"))
    assert [sample[:3] for sample in index["samples"]] == [
        ["orbit", COMMANDS["orbit"], "long"],
        ["home", COMMANDS["home"], "short"],
        ["hold", COMMANDS["hold"], "short"],
        ["impossible", COMMANDS["impossible"], "refuse"],
    ]
    good = index["systems"].index("good, Base")
    assert [index["outcomes"][sample[4][good][0]] for sample in index["samples"]] == [
        "right",
        "right",
        "parameter propagation",
        "right",
    ]
    expected, answers, _given = details(page)[2]
    assert [entry[0] for entry in expected] == ["Transit", "KeepStation"]
    assert answers[good][1] == [["same", 0, 0, []], ["changed", 1, 1, ["duration"]]]


def test_systems_are_summed_up_in_words_and_figures_have_tables(page: str) -> None:
    assert "3 of 4 plans are right in every name, order and value (75 %" in page
    assert "Kinds of failure" in page
    assert page.count("The same in figures") >= 4
    assert "Which differences are real" in page
