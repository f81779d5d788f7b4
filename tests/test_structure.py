"""The packages of planner_ft import in one direction, and scoring and data need no torch."""

from __future__ import annotations

import ast
import re
import runpy
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import hypothesis
import pytest

import planner_ft

ROOT = Path(planner_ft.__file__).parent
ORDER = [
    "support",
    "vocabulary",
    "facts",
    "data",
    "confidence",
    "candidates",
    "prompts",
    "training",
    "decoding",
    "planning",
    "document",
    "review",
    "exporters",
]
ALLOWED = {package: set(ORDER[:place]) for place, package in enumerate(ORDER)} | {
    "benchmark": set(ORDER[: ORDER.index("planning") + 1]),
    "report": {*ORDER[: ORDER.index("planning") + 1], "benchmark"},
    "model_export": set(ORDER[: ORDER.index("decoding") + 1]),
    "pretraining": set(ORDER[: ORDER.index("training") + 1]),
    "simulation": {*ORDER, "benchmark"},
    "skills": {"support", "vocabulary", "simulation", "benchmark"},
    "cli": {*ORDER, "benchmark", "report", "model_export", "pretraining", "simulation", "skills"},
}
"""What each package may import of the others."""

EXCEPTIONS: set[tuple[str, str]] = set()
"""Imports against the direction that are still there: this set must shrink to nothing."""

HEAVY = {"torch", "transformers", "peft", "bitsandbytes", "accelerate"}
LIGHT = (
    "support",
    "vocabulary",
    "facts",
    "data",
    "confidence",
    "benchmark.metrics",
    "benchmark.scoring",
)


def imported(nodes: list[ast.AST], deep: bool) -> Iterator[str]:
    """Names of imported modules, and of what is imported from them; `deep` also inside functions."""
    for node in nodes:
        if isinstance(node, ast.ImportFrom) and node.module:
            yield node.module
            yield from (f"{node.module}.{item.name}" for item in node.names)
        elif isinstance(node, ast.Import):
            yield from (item.name for item in node.names)
        elif isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef | ast.ClassDef):
            if deep or isinstance(node, ast.ClassDef):
                yield from imported(list(node.body), deep)
        elif deep or not (isinstance(node, ast.If) and "TYPE_CHECKING" in ast.dump(node.test)):
            yield from imported(list(ast.iter_child_nodes(node)), deep)


@cache
def imports(deep: bool) -> dict[str, set[str]]:
    """Imported names of every module of planner_ft, both by their full dotted names."""
    found = {}
    for path in sorted(ROOT.rglob("*.py")):
        parts = path.relative_to(ROOT.parent).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found[name] = set(imported(list(ast.parse(path.read_text("utf-8")).body), deep))
    return found


def packages(names: set[str], of: str) -> set[str]:
    """Other packages of planner_ft among the imported names."""
    return {
        name.split(".")[1]
        for name in names
        if name.startswith("planner_ft.") and (ROOT / name.split(".")[1]).is_dir()
    } - {of}


def test_imports_go_one_way() -> None:
    wrong = {
        (module.split(".")[1], other): module
        for module, names in imports(deep=True).items()
        if module.count(".") >= 1 and (ROOT / module.split(".")[1]).is_dir()
        for other in packages(names, module.split(".")[1])
        if other not in ALLOWED[module.split(".")[1]]
    }
    assert not {pair: module for pair, module in wrong.items() if pair not in EXCEPTIONS}
    assert set(wrong) >= EXCEPTIONS, "an exception is no longer needed: take it out of EXCEPTIONS"


def test_every_package_has_its_place() -> None:
    folders = {path.parent.name for path in ROOT.glob("*/__init__.py")}
    assert folders <= set(ALLOWED)


@pytest.mark.parametrize("part", LIGHT)
def test_scoring_and_data_import_no_torch(part: str) -> None:
    modules = imports(deep=False)
    ready = [
        name
        for name in modules
        if name == f"planner_ft.{part}" or name.startswith(f"planner_ft.{part}.")
    ]
    seen = set(ready)
    while ready:
        module = ready.pop()
        heavy = {name.split(".")[0] for name in modules[module]} & HEAVY
        assert not heavy, f"{module} imports {', '.join(sorted(heavy))}"
        for name in modules[module] & set(modules):
            if name not in seen:
                seen.add(name)
                ready.append(name)


def test_nothing_prints_past_the_terminal() -> None:
    """`support.terminal` escapes what a terminal would obey; pretraining prints figures alone."""
    free = {ROOT / "support" / "terminal.py", *(ROOT / "pretraining").rglob("*.py")}
    calls = {
        (path.name, ast.unparse(node.func))
        for path in set(ROOT.rglob("*.py")) - free
        for node in ast.walk(ast.parse(path.read_text("utf-8")))
        if isinstance(node, ast.Call)
    }
    assert not {name for name, call in calls if call in ("print", "typer.echo", "Console")}


def test_no_property_test_has_a_deadline() -> None:
    """None may depend on the clock; the profile in conftest.py holds for all of them."""
    assert hypothesis.settings.default is not None
    assert hypothesis.settings.default.deadline is None
    files = [path for path in Path(__file__).parent.rglob("test_*.py") if path != Path(__file__)]
    assert [path.name for path in files if "deadline=" in path.read_text("utf-8")] == []


@pytest.mark.parametrize(
    ("script", "arguments", "way_out"),
    [
        ("mutants.py", ["1", "planner_ft/cli/*.py", "tests/cli"], "pip install coverage"),
        ("plan_warnings.py", [], "plannerft gen-data --level task"),
    ],
)
def test_a_benchmark_that_lacks_something_says_what(
    script: str,
    arguments: list[str],
    way_out: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setitem(sys.modules, "coverage", None)
    monkeypatch.setattr(sys, "argv", [script, *arguments])
    with pytest.raises(SystemExit) as stop:
        runpy.run_path(str(ROOT.parent / "benchmarks" / script), run_name="__main__")
    assert stop.value.code == 2 and way_out in capsys.readouterr().err


def test_pages_name_files_that_exist_and_train_beside_the_shipped_adapters() -> None:
    root = ROOT.parent
    for page in [root / "README.md", root / "CONTRIBUTING.md", *(root / "docs").glob("*.md")]:
        text = page.read_text("utf-8")
        named = re.findall(r"(?:tests|benchmarks|scripts)/[\w/]+\.py", text)
        assert [name for name in named if not (root / name).is_file()] == [], page
        trained = re.findall(r"^    plannerft train .*--candidate embedded\b.*", text, re.M)
        kept = [line for line in trained if "--output" in line or "--preview" in line]
        assert trained == kept, page
