"""Words around the movements and skills of a prompt: where they run, openers and asides."""

from __future__ import annotations

import random
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.data.numbers import in_words, pick
from planner_ft.data.task.context import Context
from planner_ft.data.templates.render import PIECE
from planner_ft.data.wordlists import joined

TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))


class Scopes:
    """Words for sets of the movements of a prompt, which are its steps or parts: "in the second
    step only", "in steps 1 and 3", "throughout"; `numbered`: the prompt numbers them.
    """

    def __init__(
        self, count: int, part: str, rng: random.Random, *, numbered: bool = False
    ) -> None:
        self.count, self.part, self.rng, self.numbered = count, part, rng, numbered

    def words(self, chosen: frozenset[int]) -> str:
        """Where a skill runs, as an adverb."""
        part, places = self.part, sorted(chosen)
        plural = "s" if len(places) > 1 else ""
        if len(places) == self.count:
            every = "both" if self.count == 2 else f"all {in_words(self.count)}"
            always: list[str] = TABLES["always"]
            return pick((*always, f"in {every} {part}s"), self.rng)
        if self.numbered:
            at = pick(("in", "in", "during"), self.rng)
            return f"{at} step{plural} {joined([str(place + 1) for place in places])}"
        others = [place for place in range(self.count) if place not in chosen]
        if len(others) == 1 < len(places) and self.rng.random() < 0.5:
            nth = self.nth(others)
            return pick(
                (f"in all {part}s but the {nth}", f"in every {part} except the {nth}"), self.rng
            )
        at = pick(("in", "in", "during", "for") if len(places) == 1 else ("in",), self.rng)
        words = f"{at} the {self.nth(places)} {part}{plural}"
        return pick((words, words, f"{words} only", f"only {words}"), self.rng)

    def nth(self, places: Sequence[int]) -> str:
        """ "second", "first and third"; the last one is named so now and then."""
        last = self.count - 1 if self.rng.random() < 0.3 else None
        ordinals: list[str] = TABLES["ordinals"]
        return joined(["last" if place == last else ordinals[place] for place in places])


def opened(pieces: list[PIECE], c: Context) -> list[PIECE]:
    """The prompt with a full stop, now and then behind polite words or the task's opener."""
    command = pieces[0][0].partition(" ")[0] in c.book.verbs
    pieces = pieces if pieces[-1][0][-1:] in ".!?" else [*pieces, (".", False)]
    if c.book.unseen or not command or c.rng.random() < 0.85:
        return pieces
    own = c.entry.openers if c.rng.random() < 0.7 else []
    return [(f"{pick(own or TABLES['openers'], c.rng)} ", False), *pieces]


def aside(text: str, skills: set[str], c: Context) -> str:
    """The prompt, now and then with words that change nothing: background, a reason, a refusal."""
    book, rng, known, roll = c.book, c.rng, c.book.sentences, c.rng.random()
    if roll < 0.03 and "background" in known:
        remark = c.say(pick(known["background"], rng))
        return pick((f"{text} {remark}", f"{remark} {text}"), rng)
    if roll < 0.05 and "reason" in known:
        return f"{text[:-1]} {c.say(pick(known['reason'], rng))}."
    if roll < 0.075 and "nothing" in known and not book.unseen:
        return f"{text} {pick(known['nothing'], rng)}"
    if roll < 0.115 and not book.unseen:
        refused = [entry.none for name, entry in book.skills.items() if name not in skills]
        if phrases := [phrase for of_skill in refused for phrase in of_skill]:
            phrase = pick(phrases, rng)
            return pick(
                (f"{text} {phrase[0].upper()}{phrase[1:]}.", f"{text[:-1]}, {phrase}."), rng
            )
    elif roll < 0.14 and "negation" in known:
        idle = [name for name in c.task.skills.get("perception", ()) if name not in skills]
        if bare := [found for name in idle if (found := book.skills[name].bare)]:
            return (
                f"{text} {pick(known['negation'], rng).format(c.say(pick(pick(bare, rng), rng)))}"
            )
    return text
