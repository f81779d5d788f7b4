"""The vocabulary of a vehicle: a TOML definition for schemas, prompts, samplers and scorers."""

from planner_ft.vocabulary.definition import Parameter, Skill, Task, Vocabulary, load_vocabulary

__all__ = ["Parameter", "Skill", "Task", "Vocabulary", "load_vocabulary"]
