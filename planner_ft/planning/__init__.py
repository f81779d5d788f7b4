"""From a command to a plan: Mission Agent, then Task Agent for each task, in one process."""

from planner_ft.planning.planner import Planner

__all__ = ["Planner"]
