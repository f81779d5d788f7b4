"""Where the adapter of a candidate is found without being named, and what a wheel carries."""

from __future__ import annotations

import tomllib
from pathlib import Path

import pytest

from planner_ft.candidates import adapters as adapters_module
from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.adapters import CONFIG, SHIPPED, check_adapter, find_adapter
from planner_ft.support.files import write_json
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level

ROOT = Path(__file__).parents[2]
EMBEDDED = resolve_candidate("embedded")


@pytest.fixture
def package(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """An installed package; the working folder is another, empty one."""
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    folder = tmp_path / "site" / "planner_ft"
    monkeypatch.setattr(adapters_module, "PACKAGE", folder)
    return folder


def adapter(folder: Path, vocabulary: str = "usv") -> Path:
    write_json(folder / CONFIG, {"peft_type": "LORA", "r": 4})
    write_json(
        folder / "manifest.json",
        {"vocabulary": {"name": vocabulary, "sha256": load_vocabulary(vocabulary).sha256}},
    )
    return folder


def test_without_an_adapter_anywhere_there_is_none(package: Path) -> None:
    assert find_adapter(EMBEDDED, "mission") is None


def test_an_installed_package_has_the_adapters_that_it_ships(package: Path) -> None:
    shipped = adapter(package / SHIPPED / "embedded" / "task")
    assert find_adapter(EMBEDDED, "task") == shipped
    assert find_adapter(EMBEDDED, "mission") is None


def test_a_checkout_has_its_adapters_from_wherever_it_is_run(package: Path) -> None:
    cloned = adapter(package.parent / "adapters" / "embedded" / "mission")
    assert find_adapter(EMBEDDED, "mission") is None
    (package.parent / "pyproject.toml").touch()
    assert find_adapter(EMBEDDED, "mission") == cloned


def test_ones_own_adapter_comes_before_the_shipped_one_once_it_is_trained(package: Path) -> None:
    shipped = adapter(package / SHIPPED / "embedded" / "mission")
    Path("adapters/embedded/mission/checkpoints").mkdir(parents=True)
    assert find_adapter(EMBEDDED, "mission") == shipped
    own = adapter(Path("adapters/embedded/mission"))
    assert find_adapter(EMBEDDED, "mission") == own


def test_an_adapter_of_another_vocabulary_is_passed_over(package: Path) -> None:
    shipped = adapter(package / SHIPPED / "embedded" / "mission")
    adapter(Path("adapters/embedded/mission"), "inspection_drone")
    assert find_adapter(EMBEDDED, "mission", load_vocabulary()) == shipped
    assert find_adapter(EMBEDDED, "mission", load_vocabulary("inspection_drone")) == Path(
        "adapters/embedded/mission"
    )


@pytest.mark.parametrize("level", LEVELS)
def test_what_ships_fits_the_embedded_candidate(level: Level) -> None:
    folder = ROOT / "adapters" / "embedded" / level
    if not (folder / CONFIG).is_file():
        pytest.skip("no adapter of this level ships")
    check_adapter(folder, EMBEDDED, level=level, vocabulary=load_vocabulary())
    assert find_adapter(EMBEDDED, level, load_vocabulary()) is not None


def test_a_wheel_carries_the_adapters_where_they_are_looked_for() -> None:
    included = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["hatch"]["build"][
        "targets"
    ]["wheel"]["force-include"]
    assert included["adapters/embedded"] == f"planner_ft/{SHIPPED / 'embedded'}"
    assert [source for source in included if not (ROOT / source).exists()] == []
