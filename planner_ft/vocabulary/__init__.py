"""The vocabulary of a vehicle: a TOML definition for schemas, prompts, samplers and scorers."""

from planner_ft.vocabulary.checks import Entry as Entry
from planner_ft.vocabulary.definition import Parameter as Parameter
from planner_ft.vocabulary.definition import Skill as Skill
from planner_ft.vocabulary.definition import Task as Task
from planner_ft.vocabulary.definition import Vocabulary as Vocabulary
from planner_ft.vocabulary.definition import load_vocabulary as load_vocabulary
