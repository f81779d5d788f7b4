"""Approved plans carried out in a simulator: skills, filters and sensors in closed loops.

`run.simulate` does it. A simulator is a class with reset and step over batches of runs
(`fast.FastSimulator`); a skill is a small class behind one interface (`skill.Skill`), found by the
movement or the measure that the vehicle's files give to its name. The executor knows neither.
"""
