"""Records in chat form (`messages`): what other trainers and servers take, in the words that we
train on.
"""

from __future__ import annotations

from typing import Any

from planner_ft.prompts.text import answer_text, system_text, user_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level


def chat_messages(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary
) -> list[dict[str, str]]:
    """System instruction, user message and the expected plan as the assistant's answer."""
    prompt = prompt_messages(level, record, vocabulary, with_vocabulary=False)
    return [*prompt, {"role": "assistant", "content": answer_text(level, record, vocabulary)}]


def prompt_messages(
    level: Level, record: dict[str, Any], vocabulary: Vocabulary, *, with_vocabulary: bool
) -> list[dict[str, str]]:
    """System instruction and user message, the text that `render_prompt` renders into ids.
    `with_vocabulary` is for base models.
    """
    return [
        {
            "role": "system",
            "content": system_text(level, vocabulary, with_vocabulary=with_vocabulary),
        },
        {"role": "user", "content": user_text(level, record, vocabulary).strip()},
    ]
