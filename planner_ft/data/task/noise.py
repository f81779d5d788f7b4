"""Noise in a share of the task prompts: slips of the fingers, hurry, telegrams, dictation; values
are never touched.
"""

from __future__ import annotations

import itertools
import random
import re
from collections.abc import Callable

from planner_ft.data.mission.synthetic import commands_noise as sent
from planner_ft.data.templates.render import VALUE_CLOSE, VALUE_OPEN

# A slip in one of these, or a figure in its place, could change what is asked for.
_KEPT = (
    "north|south|clockwise|anticlockwise|counter|right|starboard|corner|first|second|third|fourth"
    "|fifth|before|after|for|to"
)
_UNTOUCHED = re.compile(rf"{VALUE_OPEN}[^{VALUE_CLOSE}]*{VALUE_CLOSE}|\b(?:{_KEPT})\b")
_HIDDEN = re.compile(f"{VALUE_OPEN}(\\d+){VALUE_CLOSE}")


def noisy(text: str, rng: random.Random, *, capitals: bool = True) -> str:
    """The prompt, its values still marked, as it arrives: mostly unchanged; `capitals`: a telegram
    may be all in capitals.
    """
    roll = rng.random()
    limits = itertools.accumulate(share for share, _change in CHANGES)
    place = next((place for place, limit in enumerate(limits) if roll < limit), None)
    if place is None:
        return text
    untouched: list[str] = []

    def hide(match: re.Match[str]) -> str:
        untouched.append(match[0])
        return f"{VALUE_OPEN}{len(untouched) - 1}{VALUE_CLOSE}"

    changed = CHANGES[place][1](_UNTOUCHED.sub(hide, text), rng)
    shouted = changed.isupper()
    if shouted and not capitals:
        return text
    restored = _HIDDEN.sub(lambda match: untouched[int(match[1])], changed)
    return restored.upper() if shouted else restored


def _careless(text: str, rng: random.Random) -> str:
    """Without its capital, its full stop or both."""
    text = text[0].lower() + text[1:] if rng.random() < 0.6 else text
    return text.rstrip(".") if rng.random() < 0.7 else text


def _greeted(text: str, rng: random.Random) -> str:
    """With a greeting ahead; "Right" would be a side here."""
    changed = sent.greeted(text, rng)
    return text if changed.startswith("Right") else changed


CHANGES: tuple[tuple[float, Callable[[str, random.Random], str]], ...] = (
    (0.05, _careless),
    (0.03, _greeted),
    (0.02, sent.signed),
    (0.06, lambda text, rng: sent.slipped(text, rng, (), 1 if rng.random() < 0.65 else 2)),
    (0.02, lambda text, rng: sent.garbled(text, rng, ())),
    (0.01, lambda text, rng: sent.shortened(text, rng, ())),
    (0.04, lambda text, _rng: sent.uncapitalised(text, ())),
    (0.01, lambda text, rng: sent.dictated(text, rng, ())),
    (0.04, lambda text, rng: sent.telegraphed(text, rng, ())),
)
"""Changes of a prompt, and the share of prompts that each is made to."""
