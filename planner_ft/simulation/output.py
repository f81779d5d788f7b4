"""The files of a simulation: results, the table beside the published figures, picture, and the
mission report of a run: what was observed where, from its records, as Markdown and HTML.
"""

import base64
import io
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from planner_ft.benchmark.statistics import Estimate
from planner_ft.simulation.measures import METRICS, RunResult, broken, summary
from planner_ft.simulation.run import MANIFEST, RESULTS, Simulated
from planner_ft.simulation.world import PILE
from planner_ft.support.files import compact_json, read_csv, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.resources import clock
from planner_ft.support.tables import Cell, Table, csv_table, markdown_table, row
from planner_ft.support.templates import environment

FRAME = ("t", "kind", "at", "task", "step", "skill", "skills", "simulated")
"""Keys of a record that say when, where and by what, not what was observed."""
SHOWN = 6  # different texts of a skill that are shown
Line = Mapping[str, Any]


def report_texts(done: Simulated, picture: str) -> dict[str, str]:
    """The report of run 1 by file ending."""
    result, plan = done.results[0], done.plan
    limits = broken([result])
    outcome = result.outcome + (f" ({result.reason})" if result.reason else "")
    where = "Places are metres east and north of [0, 0]."
    events = [one for one in done.log if one["kind"] in ("event", "end")]
    content = {
        "plan": plan,
        "result": result,
        "runs": len(done.results),
        "outcome": outcome + (f"; limits of the plan broken: {limits}" if limits else ""),
        "limits": limits or "none",
        "by": _ran(done),
        "where": f"[0, 0] is {plan.origin}." if plan.origin else where,
        "tasks": [_task(task, done.log) for task in plan.document["tasks"]],
        "events": [f"{clock(one['t'])} {one['text']}" for one in events],
        "figures": f"{result.length:g} m in {clock(result.seconds)}",
        "picture": "data:image/svg+xml;base64," + base64.b64encode(picture.encode()).decode(),
    }
    texts = {}
    for ending in ("md", "html"):
        how = {"finalize": _plain} if ending == "md" else {"autoescape": True}
        found = environment("planner_ft.simulation", keep_trailing_newline=True, **how)
        texts[ending] = found.get_template(f"report.{ending}.j2").render(content)
    return texts


def _task(task: Line, lines: Sequence[Line]) -> dict[str, Any]:
    own = [one for one in lines if one.get("task") == task["id"]]
    steps, records = ([one for one in own if one["kind"] == kind] for kind in ("step", "record"))
    when = "Not begun."
    if steps:
        total = len(task["skill_sequence"])
        when = f"Began at {clock(steps[0]['t'])}; {len(steps)} of {total} steps."
    skills = dict.fromkeys(one["skill"] for one in records)
    rows = [_row(name, [one for one in records if one["skill"] == name]) for name in skills]
    return {**task, "when": when, "rows": rows}


def _row(skill: str, records: Sequence[Line]) -> dict[str, Any]:
    places = [one["at"] for one in records]
    xs, ys = zip(*places, strict=True)
    spread = max(xs) - min(xs) > 2 or max(ys) - min(ys) > 2
    first = f"[{places[0][0]:.1f}, {places[0][1]:.1f}]"
    where = f"{first} to [{places[-1][0]:.1f}, {places[-1][1]:.1f}]" if spread else first
    told = {"skill": skill, "count": len(records), "first": clock(records[0]["t"])}
    return {**told, "where": where, "what": "; ".join(_observed(records))}


def _observed(records: Sequence[Line]) -> Iterable[str]:
    """What the records of a skill say: objects, ranges of numbers, texts."""
    for key in dict.fromkeys(key for one in records for key in one if key not in FRAME):
        values = [one[key] for one in records if one.get(key) is not None]
        numbers = [one for one in values if isinstance(one, (int, float)) and one is not True]
        name = key.rpartition("_")[0].replace("_", " ") or key
        unit = key.rpartition("_")[2] if "_" in key else ""
        if key == "detections":
            yield from _detected([one for found in values for one in found])
        elif numbers and len(numbers) == len(values):
            mean = sum(numbers) / len(numbers)
            several = min(numbers) != max(numbers)
            span = f" ({min(numbers):g} to {max(numbers):g})" if several else ""
            yield f"{name} {mean:.4g} {unit}{span}".replace("  ", " ")
        elif values and isinstance(values[0], list):
            yield f"{name} {len(values)} times"
        else:
            texts = dict.fromkeys(
                one if isinstance(one, str) else compact_json(one) for one in values
            )
            more = ", ..." if len(texts) > SHOWN else ""
            yield f"{name}: {', '.join([*texts][:SHOWN]) or 'nothing'}{more}"


def _detected(found: Sequence[Line]) -> Iterable[str]:
    for name in dict.fromkeys(one["name"] for one in found):
        own = [one for one in found if one["name"] == name]
        x, y = (sum(one["at"][axis] for one in own) / len(own) for axis in (0, 1))
        by = "/".join(dict.fromkeys(one["by"] for one in own))
        yield f"{name} at [{x:.1f}, {y:.1f}] ({len(own)} times, {by})"


def _plain(value: Any) -> Any:
    """A text that cannot break out of its cell or line of Markdown."""
    if not isinstance(value, str):
        return value
    return " ".join(value.split()).replace("|", "\\|").replace("<", "&lt;")


COLUMNS = {
    "success": ("success % ↑", 100, 1),
    "steps": ("steps", 1, 0),
    "seconds": ("seconds", 1, 1),
    "waypoint_error": ("waypoint m ↓", 1, 3),
    "holding_error": ("holding m ↓", 1, 3),
    "standoff_error": ("stand-off m ↓", 1, 3),
    "fence_violations": ("fences crossed ↓", 1, 2),
    "clearance_violations": ("stand-offs cut ↓", 1, 2),
    "time_violations": ("times exceeded ↓", 1, 2),
    "speed_violations": ("speeds exceeded ↓", 1, 2),
    "energy": ("thrust kN s ↓", 1e-3, 2),
}
"""Columns by figure: heading, factor and decimals."""
CAPTION = (
    "Means over runs with 95 % intervals (success: Wilson; means: bootstrap over runs). Waypoint:"
    " distance at the end of a step that goes somewhere; holding: mean distance during a hold."
    " Published figures are quoted from the published study: its own simulator, structures and"
    " starts, so that steps and seconds depend on another distance."
)
MOST_TRACKS = 50  # tracks that are drawn: more would cover each other
SETTINGS = {"svg.hashsalt": "planner_ft", "svg.fonttype": "none", "font.size": 9}


def write_all(done: Simulated) -> None:
    """Write everything but the logs, which are there already."""
    folder, made, picture = done.settings.folder, table(done), track_svg(done)
    write_text(folder / "table.md", markdown_table(made))
    write_text(folder / "table.csv", csv_table(made))
    write_text(folder / "tracks.svg", picture)
    for ending, text in report_texts(done, picture).items():
        write_text(folder / f"report.{ending}", text)
    overall = summary(done.results, done.settings.seed)
    results = {
        "plan": done.plan.mark,
        "approved": done.plan.approval is not None,
        "command": done.plan.document["command"],
        "faults": done.settings.faults.texts,
        "overall": {name: one.to_json() for name, one in overall.items()},
        "metrics": list(METRICS),
        "runs": [{**asdict(one), "success": one.success} for one in done.results],
    }
    write_json(folder / RESULTS, results)
    write_json(folder / MANIFEST, manifest(done))


def table(done: Simulated, *, narrow: bool = False) -> Table:
    """A row per figure: of this plan, and as published for the same command, or all missions where
    it is none of theirs (`narrow`: none then).
    """
    measured = summary(done.results, done.settings.seed)
    mark = "" if done.plan.approval else ", DRAFT - NOT APPROVED"
    quoted = _published(done, narrow)
    names = [_ran(done) + mark, *(f"{one['mission']} (published)" for one in quoted)]
    rows = [row("runs", str(len(done.results)), *(one["runs"] for one in quoted))]
    for name, (heading, *_form) in COLUMNS.items():
        cells = [cell(name, Estimate(number(one, name))) for one in quoted]
        rows.append(row(heading, cell(name, measured[name]), *cells))
    return Table("", names, rows, name="simulation", caption=CAPTION)


def _ran(done: Simulated) -> str:
    """The simulator, and the faults that runs were under."""
    faults = done.settings.faults.texts
    return done.settings.simulator + (f", faults: {', '.join(faults)}" if faults else "")


def outcome_lines(results: list[RunResult]) -> list[str]:
    """How many runs ended how, in words, and which of the plan's limits they broke."""
    counts = Counter((one.outcome, one.reason) for one in results)
    lines = []
    for (outcome, reason), count in counts.most_common():
        same = [one for one in results if (one.outcome, one.reason) == (outcome, reason)]
        line = f"{count} of {len(results)} runs: {outcome}{f' ({reason})' if reason else ''}"
        if which := [one for one in same if broken([one])]:
            line += f"; {len(which)} broke limits of the plan: {broken(which)}"
        lines.append(line)
    return lines


def manifest(done: Simulated) -> dict[str, Any]:
    """What the results depend on."""
    settings, vocabulary = done.settings, done.plan.vocabulary
    names = ("runs", "simulator", "tolerance", "draft", "mcap", "goto", "survey")
    configuration = {
        **{name: getattr(settings, name) for name in names},
        "starts": [list(start) for start in settings.starts],
        "locations": {name: list(place) for name, place in settings.locations.items()},
        "outlines": {name: one.tolist() for name, one in settings.outlines.items()},
        "faults": settings.faults.texts,
        "origin": asdict(done.plan.origin) if done.plan.origin else None,
        "vessel": asdict(done.scene.vessel),
        "step_seconds": done.scene.seconds,
        "vocabulary": vocabulary.named,
    }
    inputs: dict[str, Path | str] = {"plan": settings.plan}
    about: dict[str, Any] = {"configuration": configuration, "inputs": inputs}
    return build_manifest("simulation", seed=settings.seed, **about, approval=done.plan.mark)


def cell(name: str, value: Estimate) -> Cell:
    _heading, factor, decimals = COLUMNS[name]
    return value.cell(scale=factor, decimals=decimals)


def published_missions() -> list[dict[str, str]]:
    """The lines of published.csv."""
    return read_csv(Path(__file__).with_name("published.csv"))


def _published(done: Simulated, narrow: bool) -> list[dict[str, str]]:
    """The published missions of this command, or all of them; none of another vehicle."""
    if done.plan.vocabulary.name != "usv":
        return []
    lines, command = published_missions(), done.plan.document["command"].strip()
    same = [line for line in lines if line["command"] == command]
    return same or ([] if narrow else lines)


def number(line: dict[str, str], name: str) -> float | None:
    """A published figure, a rate as a fraction; None where none was published."""
    text = line.get(name)
    return float(text) / (float(line["runs"]) if name == "success" else 1) if text else None


def track_svg(done: Simulated) -> str:
    """An SVG drawing: x east, y north, in metres."""
    import matplotlib

    with matplotlib.rc_context(SETTINGS):
        return _drawn(done)


def _drawn(done: Simulated) -> str:
    from matplotlib.backends.backend_svg import FigureCanvasSVG
    from matplotlib.figure import Figure
    from matplotlib.patches import Circle, Polygon

    figure = Figure(figsize=(8, 7), layout="constrained")
    FigureCanvasSVG(figure)
    axes = figure.add_subplot()
    edge: dict[str, Any] = {"edgecolor": "#b22", "fill": False}
    for fence in done.staging.fences:
        label = "fence" if fence.inside else "closed"
        axes.add_patch(Polygon(fence.polygon, label=label, linestyle="-.", **edge))
    for boundary in done.plan.track.boundaries:
        axes.add_patch(Polygon(boundary.polygon, linestyle=":", **edge))
    outlines = done.scene.world.outlines
    for number, structure in enumerate(done.scene.world.structures):
        at, outline = structure.position, outlines.get(number)
        solid = Circle(at, PILE) if outline is None else Polygon(outline)
        solid.set_color("#444")
        axes.add_patch(solid)
        ring: dict[str, Any] = {"fill": False, "edgecolor": "#888", "linestyle": "--"}
        axes.add_patch(Circle(at, structure.standoff, **ring))
        axes.annotate(structure.name, at, (4, 4), textcoords="offset points")
    for run, track in reversed(list(enumerate(done.tracks[:MOST_TRACKS]))):
        line: dict[str, Any] = {"color": "#06c", "linewidth": 1.6, "label": "run 1", "zorder": 4}
        if run:
            name = "other runs" if run == 1 else None
            line = {"color": "#9bc", "linewidth": 0.7, "label": name, "zorder": 3}
        axes.plot([x for x, _y in track], [y for _x, y in track], **line)
    for leg in done.plan.track.legs:
        if len(leg.points) > 1:
            axes.plot(*zip(*leg.points, strict=True), "k:", linewidth=1, zorder=5)
            axes.plot(*leg.points[-1], "k+", markersize=6, zorder=6)
    axes.plot(*done.plan.vocabulary.home, "ks", markersize=6, label="home", zorder=6)
    axes.plot([], [], "k:", label="plan")
    for told in done.log:
        if told["kind"] in ("event", "end") and told["text"] != "done":
            axes.plot(*told["at"], "rx", zorder=7)
            text = str(told["text"])[:60]
            axes.annotate(text, told["at"], (6, -10), textcoords="offset points", color="#b00")
    axes.set_aspect("equal", adjustable="datalim")
    axes.autoscale_view()
    axes.set_xlabel("x east, m")
    axes.set_ylabel("y north, m")
    axes.grid(color="#eee")
    ended = sum(one.success for one in done.results)
    title = f"{ended} of {len(done.results)} runs done; simulator {_ran(done)}"
    limits = broken(done.results)
    axes.set_title(title + (f"\nlimits of the plan broken: {limits}" if limits else ""))
    axes.legend(loc="best", fontsize=8)
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None})
    return stream.getvalue()
