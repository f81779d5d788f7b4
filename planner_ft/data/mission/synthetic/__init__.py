"""Synthetic mission commands with their plans, from phrase banks and the labelling rules."""

from planner_ft.data.mission.synthetic.generate import sample_missions

__all__ = ["sample_missions"]
