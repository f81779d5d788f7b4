"""Records in the chat form that other trainers take (`messages`), with the instruction and answer that we train on."""

from __future__ import annotations

from typing import Any

from planner_ft.prompts.text import completion_text, system_text, user_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


def chat_messages(level: Level, record: dict[str, Any], vocabulary: Vocabulary) -> list[dict[str, str]]:
    """System instruction, user message and the expected plan as the assistant's answer."""
    return [
        {"role": "system", "content": system_text(level, vocabulary, with_vocabulary=False)},
        {"role": "user", "content": user_text(level, record, vocabulary)},
        {"role": "assistant", "content": completion_text(level, record["expected"], vocabulary)},
    ]
