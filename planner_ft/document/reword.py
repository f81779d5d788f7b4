"""A task prompt that follows an edited parameter: the Task Agent reads both, and they must not
contradict each other.
"""

from __future__ import annotations

import re
from typing import Any

from planner_ft.data.quantities import positions
from planner_ft.support.files import compact_json


def reword(prompt: str, before: Any, after: Any) -> str:
    """The prompt with the old value replaced where it stands there once, in digits or word by word;
    else as it is.

    What stays behind is not silent: a value that a prompt says and its task does not have is a
    warning.
    """
    if before is None or isinstance(before, bool):
        return prompt
    if isinstance(before, int | float):
        return _swap(
            prompt,
            [
                match.span()
                for match in re.finditer(
                    rf"(?<![\w.,-]){re.escape(compact_json(before))}(?![\w]|[.,]\d)", prompt
                )
            ],
            compact_json(after),
        )
    if isinstance(before, str):
        return _swap(
            prompt,
            [match.span() for match in re.finditer(rf"(?<!\w){re.escape(before)}(?!\w)", prompt)],
            str(after),
        )
    if len(before) == 2 and all(isinstance(part, int | float) for part in before):
        return _swap(
            prompt,
            [
                (start, end)
                for x, y, start, end in positions(prompt)
                if [x, y] == [float(part) for part in before]
            ],
            compact_json(after),
        )
    return prompt


def _swap(text: str, spans: list[tuple[int, int]], replacement: str) -> str:
    if len(spans) != 1:
        return text
    start, end = spans[0]
    return text[:start] + replacement + text[end:]
