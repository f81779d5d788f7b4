"""The notebook runs from beginning to end on a stand-in, and the container file names what is there."""

from __future__ import annotations

import re
import subprocess
import tomllib
from pathlib import Path

import nbformat
import pytest

import planner_ft

ROOT = Path(__file__).parents[1]
NOTEBOOK = ROOT / "notebooks" / "first_adapter.ipynb"


@pytest.mark.usefixtures("forked")
def test_the_notebook_runs_on_a_stand_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """In its folder of a checkout, with the package installed elsewhere."""
    notebook = nbformat.read(NOTEBOOK, as_version=4)
    nbformat.validate(notebook)
    (tmp_path / "scripts").symlink_to(ROOT / "scripts")
    (folder := tmp_path / "notebooks").mkdir()
    monkeypatch.chdir(folder)
    installed = tmp_path / "site-packages" / "planner_ft" / "__init__.py"
    monkeypatch.setenv("PLANNERFT_MODELS", "")  # put back afterwards, whatever the notebook sets
    names: dict[str, object] = {}
    for cell in notebook.cells:
        if cell.cell_type == "code":
            assert not cell.outputs and cell.execution_count is None
            with monkeypatch.context() as patch:
                if "make_standins" in cell.source:
                    patch.setattr(planner_ft, "__file__", str(installed))
                exec(compile(cell.source, str(NOTEBOOK), "exec"), names)
    shown = capsys.readouterr().out
    assert "3 steps" in shown and "stand-in" in shown and "nothing was sent" in shown
    assert (folder / "first_adapter" / "bench" / "table.md").is_file()
    assert (folder / "first_adapter" / "data" / "mission" / "chat" / "train.jsonl").is_file()


def test_the_container_file_names_files_that_are_there_and_commands_that_parse() -> None:
    text = (ROOT / "Dockerfile").read_text("utf-8").replace("\\\n", " ")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    steps = [(word, rest) for word, _space, rest in (line.partition(" ") for line in lines)]
    words = {word for word, _rest in steps}
    assert words == {"ARG", "FROM", "RUN", "ENV", "COPY", "WORKDIR", "CMD"}
    copied = [source for word, rest in steps if word == "COPY" for source in rest.split()[:-1]]
    assert all((ROOT / source).exists() for source in copied)
    for word, rest in steps:
        if word == "RUN":
            done = subprocess.run(["bash", "-n", "-c", rest], capture_output=True, text=True)
            assert not done.stderr
    # What the wheel is made of is there before it is made.
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
    wheel = project["tool"]["hatch"]["build"]["targets"]["wheel"]
    for source in (*wheel["packages"], *wheel["force-include"], project["project"]["readme"]):
        assert any(source == one or source.startswith(f"{one}/") for one in copied)
    ignored = (ROOT / ".dockerignore").read_text("utf-8").split()
    assert not set(copied) & set(ignored)


def test_the_container_files_own_commands_are_those_of_the_program() -> None:
    from planner_ft.cli.app import app

    known = {command.name for command in app.registered_commands}
    pages = [ROOT / "Dockerfile", ROOT / "README.md", NOTEBOOK]
    for page in pages:
        named = re.findall(
            r"plannerft(?:\(f?\\?[\"'])? ?([a-z]+(?:-[a-z]+)*)", page.read_text("utf-8")
        )
        assert named and set(named) <= known, page
