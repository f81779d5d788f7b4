"""Typing errors and carelessness in a small share of the prompts; values are never touched."""

from __future__ import annotations

import random
import re

from planner_ft.data.task.template import VALUE_CLOSE, VALUE_OPEN

TYPOS = 0.05
CARELESS = 0.06
# A slip in one of these could change what is asked for.
_KEPT = frozenset("north south clockwise anticlockwise counter right starboard corner first second third fourth fifth before after".split())  # noqa: SIM905
_PLAIN_WORD = re.compile(r"[a-z]{5,}")


def noisy(text: str, rng: random.Random) -> str:
    """The prompt as typed: mostly unchanged."""
    roll = rng.random()
    if roll < TYPOS:
        text = _typo(text, rng)
    elif roll < TYPOS + CARELESS:
        text = text[0].lower() + text[1:] if rng.random() < 0.6 else text
        text = text.rstrip(".") if rng.random() < 0.7 else text
    return text


def _typo(text: str, rng: random.Random) -> str:
    words = [match for match in _PLAIN_WORD.finditer(text) if match.group() not in _KEPT and not _inside_value(text, match.start())]
    if not words:
        return text
    match = words[int(rng.random() * len(words))]
    return text[: match.start()] + misspelt(match.group(), rng) + text[match.end() :]


def _inside_value(text: str, place: int) -> bool:
    return text.count(VALUE_OPEN, 0, place) > text.count(VALUE_CLOSE, 0, place)


def misspelt(word: str, rng: random.Random) -> str:
    """The word with two letters swapped, one dropped or one doubled, its first letter kept."""
    place = 1 + int(rng.random() * (len(word) - 2))
    kind = rng.random()
    if kind < 0.45:
        return word[:place] + word[place + 1] + word[place] + word[place + 2 :]
    if kind < 0.8:
        return word[:place] + word[place + 1 :]
    return word[:place] + word[place] + word[place:]
