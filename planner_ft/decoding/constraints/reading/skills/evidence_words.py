"""The words that a task input can ask for a filter or perception skill by, for `evidence`. Patterns
are read on text in small letters.

What a skill can be meant by is taken broadly: a word that fits two skills stands with both. Where
the words behind or before make plain that another skill is meant ("record the depth" records no
stream), the pattern passes them over.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.camera_words import CAMERA
from planner_ft.decoding.constraints.reading.skills.limit_words import LIMITS
from planner_ft.decoding.constraints.reading.skills.measuring_words import MEASURING
from planner_ft.decoding.constraints.reading.skills.recording_words import RECORDING

SPOKEN: dict[str, tuple[str, ...]] = {**LIMITS, **CAMERA, **MEASURING, **RECORDING}
"""The patterns of a skill's words, of which each can mean it."""
