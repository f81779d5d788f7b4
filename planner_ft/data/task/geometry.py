"""Waypoints of the movements that task plans are made of: planner_ft.facts.geometry."""

from planner_ft.facts.geometry import (
    CORNERS,
    SQUARE,
    SQUARE_STARTS,
    Axis,
    Corner,
    Point,
    circle,
    lane_count,
    lawnmower,
    offset,
    point,
    sector_headings,
    straight_line,
    survey_square,
    tidy,
)

__all__ = [
    "CORNERS",
    "SQUARE",
    "SQUARE_STARTS",
    "Axis",
    "Corner",
    "Point",
    "circle",
    "lane_count",
    "lawnmower",
    "offset",
    "point",
    "sector_headings",
    "straight_line",
    "survey_square",
    "tidy",
]
