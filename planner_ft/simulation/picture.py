"""The tracks of all runs over the plan, its structures and its fences, as SVG."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING, Any

from planner_ft.simulation.world import PILE

if TYPE_CHECKING:
    from planner_ft.simulation.run import Simulated

MOST_TRACKS = 50
"""Tracks that are drawn: more would cover each other."""
SETTINGS = {"svg.hashsalt": "planner_ft", "svg.fonttype": "none", "font.size": 9}


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
        solid = (
            Polygon(outlines[number]) if number in outlines else Circle(structure.position, PILE)
        )
        solid.set_color("#444")
        axes.add_patch(solid)
        ring: dict[str, Any] = {"fill": False, "edgecolor": "#888", "linestyle": "--"}
        axes.add_patch(Circle(structure.position, structure.standoff, **ring))
        axes.annotate(structure.name, structure.position, (4, 4), textcoords="offset points")
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
    axes.set_title(f"{ended} of {len(done.results)} runs done; {done.settings.simulator} simulator")
    axes.legend(loc="best", fontsize=8)
    stream = io.StringIO()
    figure.savefig(stream, format="svg", metadata={"Date": None})
    return stream.getvalue()
