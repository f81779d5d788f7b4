"""Writing a report: the page, which is one file that asks nobody for anything, figures, tables."""

from __future__ import annotations

import base64
import functools
import hashlib
import itertools
import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from markupsafe import Markup

from planner_ft.report.answers import index, parts, script_json
from planner_ft.report.contents import Section, section
from planner_ft.report.pictures import NARROW, WIDE, inline_svg, picture
from planner_ft.report.runs import load_test_sets
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import atomic_writer, write_text
from planner_ft.support.tables import csv_table, latex_table, markdown_table
from planner_ft.support.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

PICTURES = ("all", "overall", "none")
PAGE, FIGURES, TABLES = "report.html", "figures", "tables"
WRITTEN = re.compile(r"(mission|task)-.*-[0-9a-f]{6}-.*\.(png|svg|md|csv|tex)")
WRITERS = {"md": markdown_table, "csv": csv_table, "tex": latex_table}


def write_report(
    runs: Sequence[Path],
    out: Path,
    *,
    data: Sequence[Path] = (),
    overwrite: bool = False,
    title: str = "",
    pictures: str = "all",
) -> list[Path]:
    """Report on these runs in `out`: report.html, figures/ and tables/. Returns what was written.
    `pictures` says which charts become files in figures/, which takes most of the time: all of
    them, those over all systems, or none. Raises PlannerError where a run cannot be read, or where
    a report is there already and `overwrite` is not given.
    """
    if pictures not in PICTURES:
        raise PlannerError(f"--pictures {pictures}: must be all, overall or none")
    if out not in runs and out.exists() and not out.is_dir():
        raise PlannerError(f"--out {out}: is a file; give a folder")
    if (out / PAGE).exists() and not overwrite:
        way = "give --overwrite or another --out"
        raise PlannerError(f"{out / PAGE}: a report is there already; {way}")
    sections = [section(tests) for tests in load_test_sets(runs, data)]
    names = dict.fromkeys(run.resolve().name for run in runs)
    shown = title or f"Benchmark report: {', '.join(names)}"
    for path in (path for name in (FIGURES, TABLES) for path in (out / name).glob("*")):
        if WRITTEN.fullmatch(path.name):  # the folders may hold files of the user's
            path.unlink()
    written = [*_tables(sections, out), *_figures(sections, out, pictures), out / PAGE]
    # Last: where the page is, all of the report is.
    write_text(out / PAGE, page(sections, shown))
    return written


def report_beside(folder: Path) -> str:
    """Write the report of a run into its folder and say so in one line. Never raises."""
    try:
        write_report([folder], folder, overwrite=True, pictures="overall")
    except Exception as error:
        why = f"{folder / PAGE}: not written ({error or type(error).__name__})"
        return f"{why}; the results are complete, try `plannerft report {folder}`"
    more = f"figures of each system: plannerft report {folder} --overwrite"
    return f"{folder / PAGE}: tables, figures and every sample; {more}"


def _tables(sections: Sequence[Section], out: Path) -> Iterator[Path]:
    every = [table for one in sections for table in one.tables]
    every += [one.table for part in sections for one in part.figures if one.kind == "matrix"]
    for table, (suffix, writer) in itertools.product(every, WRITERS.items()):
        path = out / TABLES / f"{table.name}.{suffix}"
        write_text(path, writer(table))
        yield path


def _figures(sections: Sequence[Section], out: Path, pictures: str) -> Iterator[Path]:
    if pictures == "none":
        return
    for one in sections:
        for chart in one.figures if pictures == "all" else one.charts:
            for suffix, content in picture(chart).items():
                path = out / FIGURES / f"{chart.name}.{suffix}"
                with atomic_writer(path, "wb") as stream:
                    stream.write(content)
                yield path


ASSETS = Path(__file__).parent / "assets"
CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z][a-z])")


def page(sections: Sequence[Section], title: str) -> str:
    """The whole document; its policy allows this style sheet and this script, and no loading."""
    style, script = ((ASSETS / f"report.{kind}").read_text("utf-8") for kind in ("css", "js"))
    policy = f"default-src 'none'; style-src {_hash(style)}; script-src {_hash(script)};"
    policy += " base-uri 'none'; form-action 'none'"
    trusted = {"style": Markup(style), "script": Markup(script)}
    template = templates().get_template("page.html.j2")
    return template.render(sections=sections, title=title, policy=policy, **trusted)


@functools.cache
def templates() -> Environment:
    """The templates of the page, with their filters."""
    found = environment("planner_ft.report", autoescape=True, keep_trailing_newline=True)
    found.filters |= {
        # Names in camel case may break where a capital stands.
        "breakable": lambda label: Markup("<wbr>").join(CAMEL.split(label)),
        "drawing": lambda chart, width: Markup(inline_svg(chart, width)),
        "index": lambda tests: Markup(script_json(index(tests))),
        "parts": lambda tests: map(Markup, parts(tests)),
    }
    found.globals.update(WIDE=WIDE, NARROW=NARROW)
    return found


def _hash(content: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()}'"
