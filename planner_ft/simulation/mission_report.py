"""The mission report of a run: what was observed where, from its records; Markdown and HTML."""

from __future__ import annotations

import base64
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from planner_ft.support.files import compact_json
from planner_ft.support.resources import clock
from planner_ft.support.templates import environment

if TYPE_CHECKING:
    from planner_ft.simulation.run import Simulated

FRAME = ("t", "kind", "at", "task", "step", "skill", "skills", "simulated")
"""Keys of a record that say when, where and by what, not what was observed."""
SHOWN = 6  # different texts of a skill that are shown
Line = Mapping[str, Any]


def report_texts(done: Simulated, picture: str) -> dict[str, str]:
    """The report of run 1 by file ending."""
    image = "data:image/svg+xml;base64," + base64.b64encode(picture.encode()).decode()
    content = {**report_content(done), "picture": image}
    texts = {}
    for ending in ("md", "html"):
        how = {"finalize": _plain} if ending == "md" else {"autoescape": True}
        found = environment("planner_ft.simulation", keep_trailing_newline=True, **how)
        texts[ending] = found.get_template(f"report.{ending}.j2").render(report=content)
    return texts


def report_content(done: Simulated) -> dict[str, Any]:
    """What the report of run 1 says, as texts."""
    lines, result = done.log, done.results[0]
    origin = done.plan.origin
    where = f"[0, 0] is {origin}." if origin else "Places are metres east and north of [0, 0]."
    why = f" ({result.reason})" if result.reason else ""
    events = [f"{_clock(one)} {one['text']}" for one in lines if one["kind"] in ("event", "end")]
    figures = (
        f"{result.length:g} m in {clock(result.seconds)}; battery left {result.charge_left:.0%};"
        f" fence violations {result.fence_violations},"
        f" clearance violations {result.clearance_violations}."
    )
    return {
        "mark": done.plan.mark,
        "run": result.run,
        "runs": len(done.results),
        "outcome": f"{result.outcome}{why}",
        "command": done.plan.document["command"],
        "began": f"{where} Times are minutes and seconds from the start.",
        "tasks": [_task(task, lines) for task in done.plan.document["tasks"]],
        "events": events,
        "figures": figures,
    }


def _task(task: Line, lines: Sequence[Line]) -> dict[str, Any]:
    own = [one for one in lines if one.get("task") == task["id"]]
    steps, records = ([one for one in own if one["kind"] == kind] for kind in ("step", "record"))
    total = len(task["skill_sequence"])
    when = f"Began at {_clock(steps[0])}; {len(steps)} of {total} steps." if steps else "Not begun."
    skills = dict.fromkeys(one["skill"] for one in records)
    rows = [_row(name, [one for one in records if one["skill"] == name]) for name in skills]
    told = {"id": task["id"], "title": task["title"], "prompt": task["task_prompt"]}
    return {**told, "when": when, "rows": rows}


def _row(skill: str, records: Sequence[Line]) -> dict[str, Any]:
    places = [one["at"] for one in records]
    xs, ys = zip(*places, strict=True)
    spread = max(xs) - min(xs) > 2 or max(ys) - min(ys) > 2
    first = f"[{places[0][0]:.1f}, {places[0][1]:.1f}]"
    where = f"{first} to [{places[-1][0]:.1f}, {places[-1][1]:.1f}]" if spread else first
    what = "; ".join(_observed(records))
    return {
        "skill": skill,
        "count": len(records),
        "first": _clock(records[0]),
        "where": where,
        "what": what,
    }


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


def _clock(line: Line) -> str:
    return clock(line["t"])


def _plain(value: Any) -> Any:
    """A text that cannot break out of its cell or line of Markdown."""
    if not isinstance(value, str):
        return value
    return " ".join(value.split()).replace("|", "\\|").replace("<", "&lt;")
