"""The points of a learning curve, its table, and what more samples would bring, in words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from planner_ft.benchmark import folder
from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import Scores, by_system
from planner_ft.benchmark.curve.units import RESULT, Curve
from planner_ft.benchmark.paired import Comparison, Paired, adjusted, paired
from planner_ft.benchmark.scoring import SampleScore
from planner_ft.benchmark.statistics import Estimate
from planner_ft.benchmark.summary import OF_GROUPS, summarise
from planner_ft.support.files import write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.support.tables import NOTHING, Table, csv_table, markdown_table, row
from planner_ft.vocabulary.plans import Level

SEED = 0  # of the bootstrap
SHOWN = ("f1", "exact_sequence", "whole_plan")
SAMPLES: dict[Level, str] = {"mission": "commands", "task": "task inputs"}


@dataclass(frozen=True)
class Point:
    """Figures of one size, each adapter's values (`by_seed`), scores by sample id."""

    size: int
    metrics: dict[str, Estimate]
    by_seed: tuple[dict[str, float | None], ...]
    scores: Scores


def read_points(curve: Curve) -> list[Point]:
    """The figures of every size, smallest first, from the units' benchmarks."""
    found: dict[int, list[Scores]] = {}
    for unit in curve.units:
        results, _record = folder.read_results(unit.folder / "bench")
        found.setdefault(unit.size, []).extend(by_system(results.scores).values())
    return [_point(size, runs) for size, runs in sorted(found.items())]


def _point(size: int, runs: Sequence[Scores]) -> Point:
    every = {name: [line for run in runs for line in run[name]] for name in runs[0]}
    answers = [
        SampleScore(line["id"], line["family"], line["group"], line["failure"], dict(line))
        for lines in every.values()
        for line in lines
    ]
    of_runs = ([line for lines in run.values() for line in lines] for run in runs)
    by_seed = ({name: METRIC[name].value(lines) for name in OF_GROUPS} for lines in of_runs)
    figures = summarise(answers, SEED, OF_GROUPS)
    return Point(size, figures, tuple(by_seed), every)


def compared(found: Sequence[Point]) -> list[list[Comparison]]:
    """The largest size against each smaller one by SHOWN, paired, p adjusted over the three."""
    *smaller, last = found

    def against(one: Point, name: str) -> tuple[str, str, Paired]:
        pair = paired(METRIC[name], one.scores, last.scores, SEED)
        return str(one.size), str(last.size), pair

    return [adjusted([against(one, name) for name in SHOWN]) for one in smaller]


def answer(found: Sequence[Point], comparisons: Sequence[Sequence[Comparison]], what: str) -> str:
    """How many more samples (`what`) are worth writing, in words."""
    if len(found) < 2:
        return f"One size says nothing about more {what}; give --sizes at least two."
    last, before, final = found[-1].size, found[-2].size, comparisons[-1]
    step, tests = f"from {before} to {last} {what}", len(found[-1].scores)
    if better := [one for one in final if one.verdict == "better"]:
        return (
            f"Still rising: {step} brought {'; '.join(map(_gain, better))}. {last - before} more"
            " are worth writing: they bring about as much if the curve goes on as it is, less if it"
            " flattens."
        )
    if any(one.verdict == "worse" for one in final):
        return f"Falling: {step} made plans worse. Check the labels before writing more {what}."
    enough = next(
        point.size
        for point, pairs in zip(found, comparisons, strict=False)
        if not any(one.verdict == "better" for one in pairs)
    )
    if all(one.verdict == "equal" for one in final):
        return (
            f"Flat: {step} changed nothing, and {enough} do what {last} do. No more {what} like"
            " these are worth writing; other kinds may be: read which of the test set fail."
        )
    gain = max(100 * (one.paired.difference.high or 0) for one in final)
    return (
        f"Open: {step} no gain is seen ({enough} are not told apart from {last}), but {tests} test"
        f" {what} leave room for one of up to {gain:.0f} points. Test on more of them, or with more"
        " --seeds, before writing more to train on."
    )


def _gain(one: Comparison) -> str:
    return f"{METRIC[one.paired.metric].heading} {replace(one.difference(), mark='').plain()}"


def curve_table(found: Sequence[Point], what: str) -> Table:
    """A row per size: figures with intervals, and below F1 its range over the seeds."""
    rows = []
    for point in found:
        values = [one["f1"] for one in point.by_seed if one["f1"] is not None]
        spread = f"{min(values):.2f} to {max(values):.2f}" if len(values) > 1 else NOTHING
        figures = [METRIC[name].cell(point.metrics[name]) for name in OF_GROUPS]
        rows.append(row(str(point.size), *figures, spread))
    heads = (*(METRIC[name].title for name in OF_GROUPS), "F1 by seed")
    return Table(what.capitalize(), heads, rows)


def write_curve(curve: Curve) -> list[Point]:
    """Write table.md, table.csv and, last, learning_curve.json with the manifest."""
    found, what = read_points(curve), SAMPLES[curve.request.level]
    comparisons = compared(found)
    table, said = curve_table(found, what), answer(found, comparisons, what)
    how = f"95 % intervals over the answers of {curve.seeds} adapters of each size to the test set."
    write_text(curve.out / "table.md", f"{markdown_table(table)}\n{said}\n\n{how}\n")
    write_text(curve.out / "table.csv", csv_table(table))
    record: dict[str, Any] = {"level": curve.request.level, "data": curve.data.summary()}
    record |= {"answer": said, "points": [_json(point) for point in found]}
    record["comparisons"] = [one.to_json() for pairs in comparisons for one in pairs]
    write_json(curve.out / RESULT, {**record, "manifest": _manifest(curve)})
    return found


def _json(point: Point) -> dict[str, Any]:
    figures = {name: one.to_json() for name, one in point.metrics.items()}
    answers = sum(map(len, point.scores.values()))
    return {"size": point.size, "n": answers, "metrics": figures, "by_seed": list(point.by_seed)}


def _manifest(curve: Curve) -> dict[str, Any]:
    request = curve.request
    files: dict[str, Path | str] = {"training": request.train_file, "data": curve.data.path}
    files |= {"validation": request.validation_file} if request.validation_file else {}
    sizes = {"sizes": list(curve.sizes), "seeds": curve.seeds, "given": curve.settings}
    asked = {**curve.asked(), **sizes}
    return build_manifest("learning-curve", seed=SEED, configuration=asked, inputs=files)
