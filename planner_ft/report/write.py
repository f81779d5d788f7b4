"""Writing a report: the page, which is one file that asks nobody for anything, figures, tables; and
the measured figures of an adapter in its model card, in the Hub's format (model-index).
"""

from __future__ import annotations

import base64
import functools
import hashlib
import itertools
import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.layout import metric_table
from planner_ft.benchmark.results import Row
from planner_ft.candidates.adapters import MANIFEST, WEIGHTS, adapter_sha256
from planner_ft.report.answers import index, parts, script_json
from planner_ft.report.contents import MAIN, failure_words, section
from planner_ft.report.pictures import NARROW, WIDE, inline_svg, saved
from planner_ft.report.runs import TestSet, load_test_sets, within
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, write_text
from planner_ft.support.tables import csv_table, latex_table, markdown_table
from planner_ft.support.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

Content = dict[str, Any]  # of a test set's section
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


def _tables(sections: Sequence[Content], out: Path) -> Iterator[Path]:
    every = [table for one in sections for table in one["tables"]]
    every += [one.table for part in sections for one in part["figures"] if one.kind == "matrix"]
    for table, (suffix, writer) in itertools.product(every, WRITERS.items()):
        path = out / TABLES / f"{table.name}.{suffix}"
        write_text(path, writer(table))
        yield path


def _figures(sections: Sequence[Content], out: Path, pictures: str) -> Iterator[Path]:
    if pictures == "none":
        return
    for one in sections:
        for chart in one["figures" if pictures == "all" else "charts"]:
            yield from saved(chart, out / FIGURES)


ASSETS = Path(__file__).parent / "assets"
CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z][a-z])")


def page(sections: Sequence[Content], title: str) -> str:
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


CARD = "README.md"
START = "<!-- measured figures, written by plannerft report --card -->"
END = "<!-- end of measured figures -->"
TRAINING = "\n## Training\n"

Measured = tuple[TestSet, Row]


def write_card(adapter: Path, runs: Sequence[Path]) -> int:
    """Write what these runs measured with exactly this adapter into its card; figures of an earlier
    call are replaced. Returns how many figures were written. Raises PlannerError when the folder
    has no card, or no run measured these very weights.
    """
    from huggingface_hub import ModelCard

    if not (adapter / CARD).is_file() or not (adapter / WEIGHTS).is_file():
        expected = f"{CARD} and {WEIGHTS} are expected"
        raise PlannerError(f"--card {adapter}: no adapter with a model card there ({expected})")
    digest = adapter_sha256(adapter)
    every = [(tests, row) for tests in load_test_sets(runs) for row in tests.results.rows]
    measured = [(tests, row) for tests, row in every if tests.adapters.get(row.key) == digest]
    if not measured:
        why = "no row of these runs was measured with this adapter"
        raise PlannerError(f"--card {adapter}: {why} (its weights have another digest)")
    manifest = read_json(adapter / MANIFEST) if (adapter / MANIFEST).is_file() else {}
    base, level = within(manifest, "base", "name"), manifest.get("level")
    model = f"{base} {level} adapter" if base and level else adapter.resolve().name
    text = _with_section(read_text(adapter / CARD), _section(measured))
    card = ModelCard(text, ignore_metadata_errors=True)
    results = [result for tests, row in measured for result in _eval_results(tests, row)]
    card.data.model_name, card.data.eval_results = model, results
    write_text(adapter / CARD, str(card).rstrip("\n") + "\n")
    return len(results)


def _eval_results(tests: TestSet, row: Row) -> Iterator[Any]:
    """A row's figures as huggingface_hub.EvalResult: rates as shares, intervals as arguments."""
    from huggingface_hub import EvalResult

    vehicle = tests.vocabulary.name if tests.vocabulary else "unknown"
    for name, figure in row.metrics.items():
        interval = {"low": figure.low, "high": figure.high, "confidence": 0.95}
        if figure.value is not None:
            yield EvalResult(
                task_type="text-generation",
                task_name=f"{tests.level} planning",
                dataset_type=f"planner_ft-{vehicle}-{tests.level}",
                dataset_name=Path(tests.path).name,
                dataset_revision=tests.sha256,
                dataset_args={"samples": tests.n},
                metric_type=name,
                metric_name=METRIC[name].heading.removesuffix(" (%)") if name in METRIC else name,
                metric_value=figure.value,
                metric_config=row.configuration,
                metric_args=None if figure.low is None else interval,
                verified=False,
            )


def _section(measured: Sequence[Measured]) -> str:
    """The figures by test set, their limits, and how the wrong answers were wrong."""
    parts, sets = ["## Measured"], dict[str, tuple[TestSet, list[Row]]]()
    for tests, row in measured:
        sets.setdefault(tests.key, (tests, []))[1].append(row)
    for tests, rows in sets.values():
        how = "In brackets 95 % intervals."
        table = replace(metric_table(MAIN, rows), title=f"{tests.title}.", caption=how)
        data = f"{tests.n} samples of {Path(tests.path).name} (SHA-256 {tests.sha256[:12]}…)"
        limits = [f"- {data}: a difference smaller than the intervals is not known."]
        for row in rows:
            kinds = failure_words(row)
            words = f"wrong answers by kind: {kinds}." if kinds else "no wrong answer."
            limits.append(f"- {row.heading}: {words}")
        parts.append(markdown_table(table) + "\n".join(limits))
    return "\n\n".join(parts)


def _with_section(text: str, section: str) -> str:
    """The text with the section between the marks replaced, or put before that on training."""
    block = f"{START}\n{section}\n{END}"
    if START in text and END in text:
        return text[: text.index(START)] + block + text[text.index(END) + len(END) :]
    before, training, after = text.partition(TRAINING)
    if not training:
        return f"{text.rstrip()}\n\n{block}\n"
    return f"{before}\n{block}\n{training}{after}"
