"""From a command to a plan: Mission Agent, then Task Agent for each task, in one process.

`planner.Planner` plans, `settings` says with which candidates, `agents` runs the two on one base or
two, `locations` names and fills in the places that a plan leaves open, `result` is what comes out.
planner_ft.document makes a document of it.
"""

from planner_ft.planning.planner import Planner

__all__ = ["Planner"]
