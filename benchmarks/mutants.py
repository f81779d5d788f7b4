"""Mutation testing of a part, by a sample: small faults that its tests should notice.

    pip install coverage; python benchmarks/mutants.py 40 'planner_ft/facts/**/*.py' tests/facts

changes one operator, number or condition at a time, in a copy, and prints what no test notices.
SEED=1 and so on in the environment draws others. A change with which the tests hang is noticed.
"""

from __future__ import annotations

import argparse
import ast
import contextlib
import copy
import os
import random
import re
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import pytest

PAIRS = re.findall("[A-z]+", "Lt LtE Gt GtE Eq NotEq In NotIn Is IsNot And Or Add Sub Mult Div")
OTHER = {getattr(ast, one): getattr(ast, PAIRS[at ^ 1]) for at, one in enumerate(PAIRS)}


def mutate(node: Any) -> bool:
    """Whether the node can be changed, which is then done."""
    if isinstance(node, ast.Compare) and type(node.ops[0]) in OTHER:
        node.ops = [OTHER[type(node.ops[0])](), *node.ops[1:]]
    elif isinstance(node, ast.BinOp | ast.AugAssign | ast.BoolOp) and type(node.op) in OTHER:
        node.op = OTHER[type(node.op)]()
    elif isinstance(node, ast.If | ast.IfExp | ast.While):
        node.test = ast.UnaryOp(ast.Not(), node.test)
    elif isinstance(node, ast.Constant) and type(node.value) in (bool, int, float):
        node.value = not node.value if isinstance(node.value, bool) else node.value + 1
    else:
        return False
    return True


def places(file: Path) -> list[tuple[Path, int]]:
    """The file, and positions in `ast.walk` of its nodes that can be changed; annotations cannot."""
    nodes = list(ast.walk(ast.parse(file.read_text("utf-8"))))
    notes = (note for node in nodes if (note := getattr(node, "annotation", None)))
    kept = {id(part) for note in notes for part in ast.walk(note)}
    found = (at for at, node in enumerate(nodes) if id(node) not in kept)
    return [(file, at) for at in found if mutate(copy.copy(nodes[at]))]


class Tests:
    """A pytest plugin that has some tests run first, or has coverage note who runs which line."""

    def __init__(self, first: set[str], coverage: Any = None) -> None:
        self.first, self.coverage = first, coverage

    def pytest_collection_modifyitems(self, items: list[Any]) -> None:
        slow = {item.nodeid for item in items if item.get_closest_marker("browser")}
        items.sort(key=lambda item: (item.nodeid not in self.first, item.nodeid in slow))

    def pytest_runtest_setup(self, item: Any) -> None:
        self.coverage and self.coverage.switch_context(item.nodeid)

    def succeed(self, files: list[str], seconds: float = 0) -> bool:
        """Whether the tests of the files pass in time (0: any), in processes of their own."""
        if child := os.fork():
            passed = os.waitpid(child, 0)[1] == 0
            with contextlib.suppress(ProcessLookupError):
                os.killpg(child, signal.SIGKILL)
            return passed
        os.setpgrp()
        signal.alarm(int(seconds))
        [os.dup2(os.open(os.devnull, os.O_WRONLY), stream) for stream in (1, 2)]
        with self.coverage.collect() if self.coverage else contextlib.nullcontext():
            code = pytest.main(["-x", "-n0", "-pno:cacheprovider", *files], plugins=[self])
        os._exit(int(code) or int(bool(self.coverage and self.coverage.save())))


def survives(file: Path, at: int, tests: list[str], lines: Any, seconds: float) -> str | None:
    """The mutant in words if the tests pass with it, in so many seconds."""
    tree = ast.parse(text := file.read_text("utf-8"))
    node: Any = list(ast.walk(tree))[at]
    first = {*lines.contexts_by_lineno(str(file.resolve())).get(node.lineno, [])} - {""}
    before, _ = ast.unparse(node), mutate(node)
    file.write_text(ast.unparse(tree), "utf-8")
    alive = Tests(first).succeed(sorted({one.split("::")[0] for one in first}) or tests, seconds)
    file.write_text(text, "utf-8")
    return f"{file}:{node.lineno}: {before} -> {ast.unparse(node)}"[:200] if alive else None


if __name__ == "__main__":
    how = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=how)
    parser.add_argument("count", type=int, help="how many faults are made")
    parser.add_argument("sources", help="pattern of the files that they are made in")
    parser.add_argument("tests", nargs="+", help="folders or files of the tests")
    given = parser.parse_args()
    try:
        import coverage
    except ImportError:
        parser.error("coverage is not installed: pip install coverage")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copytree(".", f"{folder}/copy", ignore=shutil.ignore_patterns(".git", ".venv*"))
        os.chdir(f"{folder}/copy")
        os.environ["PYTHONPATH"] = sys.path[0] = f"{folder}/copy"
        sys.dont_write_bytecode = True
        files = sorted(Path().glob(given.sources))
        noted = coverage.Coverage(".lines", include=[str(file.resolve()) for file in files])
        began = time.monotonic()
        assert Tests(set(), noted).succeed(given.tests), "the tests fail without a fault"
        (lines := coverage.CoverageData(".lines")).read()
        every = [place for file in files for place in places(file)]
        drawn = random.Random(int(os.environ.get("SEED", "0"))).sample(every, given.count)
        limit = 60 + 2 * (time.monotonic() - began)
        alive = 0
        for place in drawn:
            if text := survives(*place, given.tests, lines, limit):
                print(text, flush=True)
                alive += 1
        print(f"{len(drawn) - alive} of {given.count} are noticed")
