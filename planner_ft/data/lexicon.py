"""The known words and what a word can be a misspelling of: see `planner_ft.facts.words`."""

from planner_ft.facts.words import corrections, is_known, known_words

__all__ = ["corrections", "is_known", "known_words"]
