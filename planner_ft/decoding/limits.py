"""What ends an answer."""

from __future__ import annotations

from dataclasses import dataclass

from planner_ft.vocabulary.plans import Level

MAX_NEW_TOKENS: dict[Level, int] = {"mission": 1024, "task": 2048}
"""Default limits per answer. The longest expected plan takes well below half of it with the
published tokenizers.
"""


@dataclass(frozen=True)
class Limits:
    """What ends an answer: a token of `end_ids`, or `max_new_tokens`. `pad_id` fills shorter
    prompts on the left.
    """

    end_ids: tuple[int, ...]
    pad_id: int
    max_new_tokens: int
