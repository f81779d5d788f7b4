"""Slips of the keyboard put right, and sounds that are no words left out."""

import functools
import importlib.resources
import re

from planner_ft.facts.words import is_known, near_words

WORD = re.compile(r"(?:(?<![\w'’@#.-])[a-z]|(?:^|(?<=[.!?] ))[A-Z])[a-z]{4,}(?![\w'’-])")
"""Words that can be slips: no names, codes or parts of others. A sentence begins with a capital."""
SOUND = re.compile(r"(?<![\w'’-])(?:uh+m?|u+m+|e+rm?)(?![\w'’-])(?:\s*,)?", re.IGNORECASE)
USUAL = 5  # times that templates have a word, at least, for which another one is a slip
PLAINER = 4  # times that it is more usual than the next one that is as near


def spelt(text: str) -> str:
    """The text with words that no list knows, each as the usual word of commands that is one edit
    away, where one word alone can be meant.
    """
    return WORD.sub(lambda match: _meant(match[0]), text)


def fluent(text: str) -> str:
    """The text with blanks in the place of every "uh" and "er": nothing else moves."""
    return SOUND.sub(lambda match: " " * len(match[0]), text)


@functools.lru_cache(maxsize=4096)
def _meant(word: str) -> str:
    plain = word.lower()
    if is_known(plain) or plain in _english():
        return word
    near = sorted(near_words(plain, 1))
    first, second = [*(-count for _edits, count, _word in near), 0, 0][:2]
    meant = near[0][2] if first >= max(USUAL, PLAINER * second) else plain
    return meant if word == plain else meant.capitalize()


@functools.cache
def _english() -> frozenset[str]:
    """The English words of SymSpell's dictionary."""
    file = importlib.resources.files("symspellpy") / "frequency_dictionary_en_82_765.txt"
    lines = file.read_text(encoding="utf-8-sig").splitlines()
    return frozenset(line.partition(" ")[0] for line in lines)
