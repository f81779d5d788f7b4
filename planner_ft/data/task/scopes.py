"""In which of its steps a skill runs, in words: "in both holds", "on the last leg only", "in steps
1 and 3", "throughout".
"""

from __future__ import annotations

import random
from collections.abc import Sequence

from planner_ft.data.numbers import in_words
from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Phrasebook

ORDINALS = ("first", "second", "third", "fourth", "fifth", "sixth", "seventh")
ALL_THE_TIME = (
    "throughout",
    "throughout",
    "the whole time",
    "all the time",
    "all the while",
    "at all times",
    "in every step",
    "from start to finish",
    "the entire time",
    "all along",
    "from beginning to end",
    "in all steps",
    "all the way through",
    "during everything",
    "for the whole task",
    "without a break",
    "in each step",
    "the whole way through",
)

# Movements that one word such as "turning" would mean alike.
GROUPS = {
    "goto": "leg",
    "waypoints": "leg",
    "line": "leg",
    "pass": "leg",
    "hold": "hold",
    "visual": "hold",
    "wait": "wait",
    "drift": "drift",
    "turn_to": "turn",
    "turn_by": "turn",
    "arc": "turn",
    "headings": "turn",
    "sectors": "turn",
    "steps": "turn",
    "full_turn": "turn",
    "swing": "turn",
    "square": "square",
    "lawnmower": "grid",
    "orbit": "ring",
}
# group -> singular, plural, and how all of them are meant at once
NOUNS = {
    "leg": (
        "leg",
        "legs",
        ("under way", "on the way", "while moving", "while driving", "when moving"),
    ),
    "hold": ("hold", "holds", ("while holding", "on station")),
    "turn": ("turn", "turns", ("while turning", "when turning")),
    "drift": ("drift", "drifts", ("while drifting", "adrift")),
    "grid": ("grid", "grids", ("on the lanes",)),
    "square": ("square", "squares", ()),
    "ring": ("circle", "circles", ()),
    "wait": ("wait", "waits", ("while waiting",)),
}


class Scopes:
    """Words for sets of movements of one prompt; `numbered`: the prompt numbers them."""

    def __init__(
        self,
        movements: Sequence[Movement],
        book: Phrasebook,
        rng: random.Random,
        *,
        numbered: bool = False,
    ) -> None:
        self.movements, self.book, self.rng, self.numbered = movements, book, rng, numbered
        self.groups = [group_of(movement) for movement in movements]
        self.part = (
            ("step", "part", "stage")
            if all(len(movement.steps) == 1 for movement in movements)
            else ("part", "stage")
        )

    def words(self, chosen: frozenset[int]) -> str:
        """Where the skill runs, as an adverb: "in the second step", "throughout"."""
        if len(chosen) == len(self.movements):
            return self._pick(self._everywhere())
        options = [words for words in self._by_group(chosen) if words]
        if not options or self.rng.random() < 0.45:
            options = self._by_number(chosen)
        return self._pick(options)

    def alone(self, chosen: frozenset[int]) -> str:
        """The same with a word that it runs nowhere else, now and then: "only in the second step",
        "on the first leg, not on the second".
        """
        text = self.words(chosen)
        if len(chosen) == len(self.movements):
            return text
        roll = self.rng.random()
        others = frozenset(range(len(self.movements))) - chosen
        if " but " in text or " except " in text or " every " in text or " each " in text:
            return text
        if roll < 0.25:
            return f"{text} {self._pick(('only', 'only', 'alone')) if len(chosen) == 1 else 'only'}"
        if roll < 0.37:
            return f"only {text}"
        if roll < 0.5 and len(others) == 1:
            return f"{text}{self._pick((', not ', ' but not ', ', and not '))}{self.words(others)}"
        return text

    def _pick(self, options: Sequence[str]) -> str:
        return options[int(self.rng.random() * len(options))]

    def _everywhere(self) -> list[str]:
        count = len(self.movements)
        part = self._pick(self.part)
        known = [*ALL_THE_TIME, f"in {'both' if count == 2 else f'all {in_words(count)}'} {part}s"]
        if set(self.groups) == {"leg"}:
            known += [
                f"on {'both' if count == 2 else 'all'} legs",
                "on every leg",
                "on each leg",
                "all the way",
                "the whole way",
            ] * 2
        return known

    def _by_number(self, chosen: frozenset[int]) -> list[str]:
        """ "in the second step", "in steps 1 and 3", "in all steps but the second"."""
        part, count = self._pick(self.part), len(self.movements)
        places = sorted(chosen)
        missing = [index for index in range(count) if index not in chosen]
        named = [self._ordinal(index, count) for index in places]
        options = [
            f"in the {_joined(named)}"
            f" {part}{'s' if len(places) > 1 and self.rng.random() < 0.5 else ''}"
        ]
        if len(places) == 1:
            options += [
                f"during the {named[0]} {part}",
                f"in the {named[0]} one" if self.rng.random() < 0.3 else options[0],
                f"for the {named[0]} {part}",
            ]
        if len(missing) == 1 and count > 2:
            lacking = self._ordinal(missing[0], count)
            options += [
                f"in all {part}s but the {lacking}",
                f"in every {part} except the {lacking}",
            ]
        if self.numbered:
            numbers, word = (
                _joined([str(index + 1) for index in places]),
                ("steps" if len(places) > 1 else "step"),
            )
            options = [
                f"in {word} {numbers}",
                f"during {word} {numbers}",
                f"in {word} {numbers}",
                options[0],
            ]
        return options

    def _by_group(self, chosen: frozenset[int]) -> list[str]:
        """ "in both holds", "on the last leg", "during the drift": where all of the chosen are of
        one group.
        """
        groups = {self.groups[index] for index in chosen}
        group = groups.pop()
        if groups or group not in NOUNS:
            return []
        same = [index for index, other in enumerate(self.groups) if other == group]
        # "while waiting" could mean a hold as well, "the second leg" one of a movement of several
        # legs
        if (group == "wait" and "hold" in self.groups) or (
            len(same) > 1 and any(len(self.movements[index].steps) > 1 for index in same)
        ):
            return []
        one, several, meant = NOUNS[group]
        on = "on" if group in ("leg", "grid", "square", "ring") else self._pick(("in", "during"))
        if len(chosen) < len(same):
            named = [self._ordinal(same.index(index), len(same)) for index in sorted(chosen)]
            return [
                f"{on} the {_joined(named)}"
                f" {several if len(named) > 1 and self.rng.random() < 0.5 else one}"
            ]
        if len(chosen) == 1:
            return [*self._during(same[0]) * 2, f"{on} the {one}", *meant]
        count = "both" if len(chosen) == 2 else f"all {in_words(len(chosen))}"
        return [
            f"{on} {count} {several}",
            f"{on} the {several}",
            f"{on} each {one}",
            f"{on} every {one}",
            *meant,
        ]

    def _during(self, index: int) -> list[str]:
        movement = self.movements[index]
        if movement.saying is None or len(movement.steps) > 1:
            return []
        slots = movement.saying.slots
        fitting = [
            template
            for template in self.book.skills[movement.steps[0][0]].during
            if template.needed <= slots.given
        ]
        return (
            [fitting[int(self.rng.random() * len(fitting))].render(slots, self.rng)]
            if fitting
            else []
        )

    def _ordinal(self, index: int, count: int) -> str:
        return (
            "last"
            if index == count - 1 and count > 1 and self.rng.random() < 0.4
            else ORDINALS[index]
        )


def group_of(movement: Movement) -> str:
    """The group of the movement; one that is a group of its own is named by its kind."""
    return GROUPS.get(movement.kind, movement.kind)


def _joined(words: Sequence[str]) -> str:
    return ", ".join(words[:-1]) + " and " + words[-1] if len(words) > 1 else words[0]
