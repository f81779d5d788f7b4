"""What a report holds, test set by test set, and writing it: the page, which is one file that asks
nobody for anything, figures, tables; and the measured figures of an adapter in its model card, in
the Hub's format (model-index).
"""

from __future__ import annotations

import base64
import functools
import hashlib
import itertools
import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from markupsafe import Markup

from planner_ft.benchmark.catalogue import METRIC, METRICS, RIGHT, SECTIONS
from planner_ft.benchmark.contrasts import baseline_sentences, contrast_notes, legend
from planner_ft.benchmark.layout import lines, metric_table
from planner_ft.benchmark.layout import notes as table_notes
from planner_ft.benchmark.paired import p_text
from planner_ft.benchmark.results import Results, Row, heading
from planner_ft.benchmark.tables import cost_tables, detail_tables, group_tables
from planner_ft.candidates.adapters import MANIFEST, WEIGHTS, adapter_sha256
from planner_ft.report.answers import index, parts, script_json
from planner_ft.report.charts import charts, slug, system_charts
from planner_ft.report.pictures import NARROW, WIDE, inline_svg, saved
from planner_ft.report.runs import TestSet, load_test_sets, within
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, write_text
from planner_ft.support.tables import Cell, Table, csv_table, latex_table, markdown_table, row
from planner_ft.support.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

Content = dict[str, Any]  # of a test set's section
MAIN: tuple[str, ...] = ("f1", "whole_plan", "exact_sequence", "parameters", "hallucination")
MAIN += ("schema_valid", "strict_valid", "latency_s", "tokens")
"""The first table: the published five, and the metrics that show whether a plan is right."""
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


def section(tests: TestSet) -> dict[str, Any]:
    """The content of a test set's section: `summary` are sentences under the names of their
    subjects, `extra` the tables that stand open, `per_system` charts of one system each; `tables`
    and `figures` are all of them in the order of the page.
    """
    results, shown = tests.results, lines(tests.results, beside=tests.beside)
    ours = [line for line in shown if line.kind != "published"]
    of_systems = [(one.name, system_charts(tests, one)) for one in results.rows]
    taken = Counter[str]()

    def named(table: Table, name: str = "", title: str = "", caption: str = "") -> Table:
        name = f"{tests.key}-{name or slug(table.corner)[:40]}"
        taken[name] += 1
        name += f"-{taken[name]}" if taken[name] > 1 else ""
        words = title or table.corner, caption or table.caption
        return replace(table, name=name, title=words[0], caption=words[1])

    costs = {one.name: one.costs for one in results.rows if one.costs}
    brackets = "In brackets 95 % intervals."
    known = {name for names in SECTIONS.values() for name in names} | set(RIGHT)
    rest = [("Whole plan", RIGHT), ("Output", [name for name in METRICS if name not in known])]
    extra = [named(one, caption=brackets) for one in cost_tables(costs)]
    small = "Groups are small: they tell where to look, not which system is better."
    extra += [named(one, "groups", "By group", small) for one in group_tables(results.groups)]
    details = [metric_table(names, ours, corner=title) for title, names in rest]
    shown_before = {table.corner for table in extra}
    details += [one for one in detail_tables(results) if one.corner not in shown_before]
    said = set(contrast_notes(results.contrasts))
    notes = [note for note in table_notes(results) if note not in said]
    main = named(metric_table(MAIN, shown), "main", "Systems", brackets)
    compared = [named(one, "differences", "Differences") for one in _differences(results)]
    all_metrics, overall = list(map(named, details)), charts(tests)
    return {
        "tests": tests,
        "summary": list(_summary(tests)),
        "main": main,
        "legend": " ".join(legend(results.contrasts)),
        "extra": extra,
        "differences": compared,
        "all_metrics": all_metrics,
        "tables": [main, *extra, *compared, *all_metrics],
        "charts": overall,
        "per_system": [(name, found) for name, found in of_systems if found],
        "figures": [*overall, *(chart for _name, found in of_systems for chart in found)],
        "notes": list(dict.fromkeys([*notes, *tests.notes])),
    }


def _summary(tests: TestSet) -> Iterator[tuple[str, str]]:
    beaten = baseline_sentences(tests.results.contrasts)
    for system in tests.results.rows:
        compared = f"It {beaten[system.key]}" if system.key in beaten else ""
        yield f"{system.name}.", f"{_in_words(system)} {compared}".strip()
    for entry in (entry for run in tests.runs for entry in run.record.get("failed") or []):
        lead = f"{entry.get('label')}, {heading(str(entry.get('configuration')))}."
        yield lead, f"Not measured: {entry.get('reason')}."


def _in_words(system: Row) -> str:
    """How many plans are right, and why the others are not."""
    whole, n = system.figure("whole_plan"), system.n
    if whole.value is None:
        return f"{n} answers."
    span = ""
    if whole.low is not None and whole.high is not None:
        span = f", 95 % interval {100 * whole.low:.0f} to {100 * whole.high:.0f} %"
    n *= (system.repeats or {}).get("k", 1)
    right = f"{round(whole.value * n)} of {n} plans are right in every name, order and value"
    kinds = failure_words(system)
    wrong = f" Wrong: {kinds}." if kinds else ""
    return f"{right} ({100 * whole.value:.0f} %{span}).{wrong}"


def failure_words(system: Row) -> str:
    """Wrong answers by kind, the most frequent first: "wrong order 3, parameter propagation 1"."""
    order = sorted((-count, kind) for kind, count in system.failures.items() if count)
    return ", ".join(f"{kind} {-count}" for count, kind in order)


def _differences(results: Results) -> list[Table]:
    rows, names = [], {one.key: one.name for one in (*results.rows, *results.baselines)}
    for one in (one for found in results.contrasts.values() for one in found):
        ends = [names.get(key) for key in (one.second, one.first)]
        if one.difference.value is not None and all(ends):
            made, p = one.cell(), one.p_adjusted
            cells = replace(made, mark=""), Cell(p_text(p), bounds=(p, None, None))
            metric, verdict = METRIC[one.metric].heading, f"{one.mark} {one.verdict}"
            rows.append(row(" against ".join(map(str, ends)), metric, *cells, verdict.strip()))
    caption = "First minus second, paired by sample, with its 95 % interval; p adjusted after Holm"
    heads = ("Metric", "Difference", "p", "Verdict")
    table = Table("Systems", heads, rows, texts=1, caption=f"{caption} for each question.")
    return [table] if rows else []


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
    every = [(tests, one) for tests in load_test_sets(runs) for one in tests.results.rows]
    measured = [(tests, one) for tests, one in every if tests.adapters.get(one.key) == digest]
    if not measured:
        why = "no row of these runs was measured with this adapter"
        raise PlannerError(f"--card {adapter}: {why} (its weights have another digest)")
    manifest = read_json(adapter / MANIFEST) if (adapter / MANIFEST).is_file() else {}
    base, level = within(manifest, "base", "name"), manifest.get("level")
    model = f"{base} {level} adapter" if base and level else adapter.resolve().name
    text = _with_section(read_text(adapter / CARD), _card_section(measured))
    card = ModelCard(text, ignore_metadata_errors=True)
    results = [result for tests, one in measured for result in _eval_results(tests, one)]
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


def _card_section(measured: Sequence[Measured]) -> str:
    """The figures by test set, their limits, and how the wrong answers were wrong."""
    parts, sets = ["## Measured"], dict[str, tuple[TestSet, list[Row]]]()
    for tests, one in measured:
        sets.setdefault(tests.key, (tests, []))[1].append(one)
    for tests, rows in sets.values():
        how = "In brackets 95 % intervals."
        table = replace(metric_table(MAIN, rows), title=f"{tests.title}.", caption=how)
        data = f"{tests.n} samples of {Path(tests.path).name} (SHA-256 {tests.sha256[:12]}…)"
        limits = [f"- {data}: a difference smaller than the intervals is not known."]
        for one in rows:
            kinds = failure_words(one)
            words = f"wrong answers by kind: {kinds}." if kinds else "no wrong answer."
            limits.append(f"- {one.heading}: {words}")
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
