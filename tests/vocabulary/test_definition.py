"""A definition file with mistakes is refused with all of them; another vehicle is another file."""

from __future__ import annotations

import copy
import dataclasses
import shutil
import tomllib
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import BUNDLED, build_vocabulary, bundled_vocabularies
from tests.values import changeable

DRONE: dict[str, Any] = tomllib.loads((BUNDLED / "inspection_drone.toml").read_text())


def refused(raw: dict[str, Any], phrases: dict[str, Any] | None = None) -> str:
    with pytest.raises(PlannerError) as caught:
        build_vocabulary(raw, phrases or {}, "drone.toml")
    return str(caught.value)


def changed(**vehicle: Any) -> dict[str, Any]:
    raw = copy.deepcopy(DRONE)
    raw["vehicle"].update(vehicle)
    return raw


def test_the_vehicle_has_21_tasks_and_37_skills_in_three_roles() -> None:
    usv = load_vocabulary()
    assert (len(usv.tasks), len(usv.skills)) == (21, 37)
    assert [len(usv.skills_in_role(role)) for role in ("navigation", "filter", "perception")] == [
        8,
        3,
        26,
    ]


def test_bundled_vocabularies_load_by_name_and_files_by_path(tmp_path: Path) -> None:
    assert bundled_vocabularies() == ["inspection_drone", "usv"]
    for name in ("inspection_drone.toml", "inspection_drone.phrases.toml"):
        shutil.copy(BUNDLED / name, tmp_path)
    by_path = load_vocabulary(str(tmp_path / "inspection_drone.toml"))
    assert by_path.tasks == load_vocabulary("inspection_drone").tasks
    assert by_path.phrases == load_vocabulary("inspection_drone").phrases

    assert by_path.data == tmp_path and not by_path.bundled
    assert load_vocabulary().data == Path("data") and load_vocabulary().bundled
    assert load_vocabulary("inspection_drone").data == Path("data/inspection_drone")
    unsaved = dataclasses.replace(by_path, path=None)
    assert unsaved.data == Path("data/inspection_drone") and not unsaved.bundled
    assert unsaved.beside(".phrases.toml") == {} != by_path.beside(".phrases.toml")


def test_what_is_loaded_cannot_be_changed() -> None:
    assert changeable("planner_ft.vocabulary") == []


def test_only_a_skill_that_goes_somewhere_has_coordinates() -> None:
    def names(skill: str) -> list[str]:
        return [one.name for one in usv.skill[skill].coordinates]

    usv = load_vocabulary()
    assert names("GoToXY") == ["x", "y"] and names("StationKeep") == names("ArcTurn") == []
    places = {title: usv.task[title].position_parameter for title in ("Transit", "KeepStation")}
    assert places == {"Transit": "target_position", "KeepStation": None}
    assert [task.title for task in usv.tasks if task.docks] == ["DockingApproach"]
    assert not any(one.required for one in usv.task["FollowTarget"].parameters)
    assert not usv.task["Transit"].leaves and usv.task["DriftAudit"].leaves


def test_an_unknown_vocabulary_names_the_bundled_ones() -> None:
    with pytest.raises(
        PlannerError, match=r"--vocabulary submarine: no such file, .*inspection_drone, usv"
    ):
        load_vocabulary("submarine")


@pytest.mark.parametrize(
    ("content", "message"),
    [(b"[vehicle\n", "not TOML"), (b"\xff", "not UTF-8"), (b"", r"a table \[vehicle\] is needed")],
)
def test_a_file_that_is_no_definition_is_named(
    tmp_path: Path, content: bytes, message: str
) -> None:
    path = tmp_path / "drone.toml"
    path.write_bytes(content)
    with pytest.raises(PlannerError, match=rf"drone.toml: .*{message}"):
        load_vocabulary(str(path))


def test_all_mistakes_are_reported_at_once() -> None:
    raw = copy.deepcopy(DRONE)
    raw["vehicle"].pop("home")
    raw["task"][0]["arrival"] = "teleport"
    raw["task"][1]["parameters"] = [{"name": "height", "type": "metres"}]
    raw["skill"][0]["role"] = "pilot"
    raw["skill"][1]["colour"] = "red"
    message = refused(raw)
    for part in (
        "[vehicle]: lacks home",
        "arrival = 'teleport' must be one of",
        "type = 'metres' must be one of",
        "role = 'pilot'",
        "unknown key 'colour'",
    ):
        assert part in message


JUNK = st.one_of(
    st.none(),
    st.booleans(),
    st.integers(),
    st.floats(),
    st.text(max_size=3),
    st.lists(st.integers(), max_size=2),
    st.dictionaries(st.text(max_size=2), st.none()),
)


def places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    items = (
        value.items()
        if isinstance(value, dict)
        else enumerate(value)
        if isinstance(value, list)
        else ()
    )
    return [found for key, item in items for found in [(*path, key), *places(item, (*path, key))]]


PLACES = places(DRONE)


@settings(max_examples=300)
@given(st.sampled_from(PLACES), JUNK)
def test_junk_anywhere_is_a_vocabulary_or_one_sentence(path: tuple[Any, ...], junk: Any) -> None:
    raw = copy.deepcopy(DRONE)
    value = raw
    for key in path[:-1]:
        value = value[key]
    value[path[-1]] = junk
    try:
        assert isinstance(build_vocabulary(raw, {}, "drone.toml"), Vocabulary)
    except PlannerError as error:
        assert str(error).startswith("drone.toml: ")
