"""The texts of a sample: system instruction, user message, answer; and its chat form."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

from planner_ft.data.task.working import working_of
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import WORKING, Level, canonical_parameters, canonical_plan
from planner_ft.vocabulary.schema import prompt_text

INSTRUCTIONS: dict[str, dict[str, str]] = tomllib.loads(
    (Path(__file__).parent / "instructions.toml").read_text(encoding="utf-8")
)
PLAIN_FORM = "{system}\n\n### Input\n{user}\n\n### Plan\n"
"""The prompt of a model without a chat template."""


def system_text(level: Level, vocabulary: Vocabulary, *, with_vocabulary: bool) -> str:
    """The instruction of an agent, for base models with the answer's form and the vocabulary."""
    instruction = INSTRUCTIONS[level]["instruction"].format(vehicle=vocabulary.title)
    if not with_vocabulary:
        return instruction
    form = INSTRUCTIONS[level]["form"].format(
        frame=vocabulary.frame,
        home=list(vocabulary.home),
        unresolved=list(vocabulary.unresolved),
        vocabulary=prompt_text(level, vocabulary),
    )
    return f"{instruction}\n{form}"


def user_text(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The agent's input: the command, or a task's title, parameters and prompt on three lines."""
    if level == "mission":
        return str(record["prompt"])
    task = vocabulary.task.get(record["task"])
    parameters = canonical_parameters(record.get("parameters", {}), task)
    return f"{record['task']}\n{compact_json(parameters)}\n{record['prompt']}"


def completion_text(level: Level, plan: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The canonical plan as compact JSON."""
    return compact_json(canonical_plan(level, plan, vocabulary))


def answer_text(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> str:
    """The answer that is trained: the sums that its waypoints need, and the `expected` plan."""
    text = completion_text(level, record["expected"], vocabulary)
    working = working_of(record, vocabulary) if level == "task" else ""
    return f"{{{compact_json(WORKING)}:{compact_json(working)},{text[1:]}" if working else text


def prompt_messages(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary, *, with_vocabulary: bool
) -> list[dict[str, str]]:
    """System instruction and user message: the text that `render_prompt` renders into ids."""
    system = system_text(level, vocabulary, with_vocabulary=with_vocabulary)
    user = user_text(level, record, vocabulary).strip()
    return [{"role": "system", "content": system}, {"role": "user", "content": user}]


def chat_messages(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary
) -> list[dict[str, str]]:
    """The prompt's messages and the expected plan as the assistant's answer, for other trainers."""
    prompt = prompt_messages(level, record, vocabulary, with_vocabulary=False)
    return [*prompt, {"role": "assistant", "content": answer_text(level, record, vocabulary)}]
