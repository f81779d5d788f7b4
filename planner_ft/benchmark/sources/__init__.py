"""Sources of answers: a candidate that is loaded here, or a server. One serves the jobs of one
candidate; what it answered before it failed half-way is kept.
"""

from typing import Any

Fields = dict[str, Any]  # fields of a line; those that a source cannot know are None
Timed = tuple[float, int | None, int | None, float | None]
"""Of one query: seconds, tokens, forward passes, and seconds until the first token was known."""
