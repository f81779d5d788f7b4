"""Candidate language models: their registry, files, memory needs and loading."""

from planner_ft.candidates.registry import (
    AdapterDefaults,
    Candidate,
    Dimensions,
    all_candidates,
    resolve_candidate,
)

__all__ = ["AdapterDefaults", "Candidate", "Dimensions", "all_candidates", "resolve_candidate"]
