"""The vocabulary of a vehicle: one TOML definition from which schemas, prompts, samplers and
scorers derive.
"""

from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary, load_vocabulary

__all__ = ["Parameter", "Skill", "Task", "Vocabulary", "load_vocabulary"]
