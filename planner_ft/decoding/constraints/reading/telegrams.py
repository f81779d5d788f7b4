"""Prompts all in capitals, and telegrams with STOP for a full stop, as they would stand in small
letters.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.wordings import NAMED_PLACE

KEPT = re.compile(r"[NESW]|[NS][NS]?[EW]|[EW][NS][EW]|[A-Z]+[_-]?\d[\w-]*|[A-Z]+_\w+")
"""Words that keep their capitals: compass points, and identifiers, whose letters nobody knows."""
WORD = re.compile(r"[^\W\d_][\w'’-]*")
FULL_STOP = re.compile(
    r"[,.]?\s+(?<!\bTO A )(?<!\bFULL )(?<!\bAND )(?<!\bTHEN )(?<!\bTO )(?<!\bNO )(?<!\bNOT"
    r" )(?<!\bTHE )(?<!\bEACH )STOP\b(?! FOR (?:AN? |"
    r"\d)| AT \d| EVERY )[.,;]?",
    re.ASCII,
)
"""STOP where it is no verb and no noun."""
SECONDS = re.compile(r"(?<=\d)S\b|(?<=\d )S\b")
EAST_WEST = re.compile(r"\d ?[EW]\b")
"""Where coordinates have their directions in letters, S is south."""
LEAST_LETTERS = 12


def in_small_letters(prompt: str) -> str:
    """The prompt, in small letters if it is all in capitals, with full stops for each STOP; as it
    stands if it is not.
    """
    letters = sum(map(str.isalpha, prompt))
    if letters < LEAST_LETTERS or sum(map(str.islower, prompt)) * 10 > letters:
        return prompt
    named = NAMED_PLACE.search(prompt) is not None
    prompt = prompt if EAST_WEST.search(prompt) else SECONDS.sub("s", prompt)

    def small(word: re.Match[str]) -> str:
        return (
            word[0] if KEPT.fullmatch(word[0]) or (named and len(word[0]) == 1) else word[0].lower()
        )

    return WORD.sub(small, FULL_STOP.sub(".", prompt))
