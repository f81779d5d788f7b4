"""Candidate language models: which there are, where they lie, what memory they need, and how they
are loaded.
"""

from planner_ft.candidates.registry import (
    AdapterDefaults,
    Candidate,
    Dimensions,
    all_candidates,
    resolve_candidate,
)

__all__ = ["AdapterDefaults", "Candidate", "Dimensions", "all_candidates", "resolve_candidate"]
