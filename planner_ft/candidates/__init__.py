"""Candidate language models: their registry, files, memory needs and loading."""

from planner_ft.candidates.registry import Candidate, Dimensions, all_candidates, resolve_candidate

__all__ = ["Candidate", "Dimensions", "all_candidates", "resolve_candidate"]
