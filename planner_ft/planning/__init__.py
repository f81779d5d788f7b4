"""From a command to a plan: Mission Agent, then Task Agent for each task, in one process.

`agents` runs the two agents on one base or two, `locations` names and fills in the places that a plan leaves open,
`result` is what comes out, `tree` shows it.
"""
