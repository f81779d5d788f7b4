"""Filling a phrase: the words of every slot, and what the core phrase has not said as adjuncts."""

from __future__ import annotations

import re
from random import Random
from typing import Literal

from planner_ft.data.mission.synthetic.clause_words import (
    ADJOINED,
    BEARINGS,
    NAMING,
    THREE_QUARTERS,
)
from planner_ft.data.mission.synthetic.intents import Intent
from planner_ft.data.mission.synthetic.lists import say_list
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.positions import say_position
from planner_ft.data.mission.synthetic.templates import Template, forms

Mood = Literal["imp", "np", "ger"]
PLAIN_DURATION = 0.6
"""Share of durations said in the first, plain way ("for ten minutes")."""


class Filler:
    """Says the parameters of an intent. `clipped` leaves articles out, `spoken` keeps to what can
    be dictated; `focus` is the target spoken of last.
    """

    def __init__(
        self, rng: Random, style: Style, *, clipped: bool = False, spoken: bool = False
    ) -> None:
        self.rng, self.style, self.clipped, self.spoken = rng, style, clipped, spoken
        self.focus: int | None = None

    def _core(
        self, intent: Intent, mood: Mood, *, named: bool, extra: dict[str, str] | None = None
    ) -> Template:
        rng, shapes = self.rng, forms(intent.title)
        words = self._words(
            intent, {"target": "", "target_description": "", "cable": "", **(extra or {})}
        )
        if shapes.valued[mood] and rng.random() < 0.22:
            usable = [
                item
                for item in shapes.valued[mood]
                if item.slots <= words.keys() and item.slots & NAMING
            ]
            if usable:
                return rng.choice(usable)
        pool = shapes.full[mood]
        for _ in range(12):
            template = rng.choice(pool)
            if template.slots <= words.keys():
                return template
        usable = [item for item in pool if item.slots <= words.keys()]
        return rng.choice(usable or [Template("take care of {target}")])

    def _words(self, intent: Intent, values: dict[str, str]) -> dict[str, str]:
        """What can be said, by slot."""
        words = dict(values)
        for name, said in intent.said.items():
            if name not in values:
                words[name] = said.text
            if said.attributive:
                words[f"{name}_compound"] = said.attributive
        if "side_id" in intent.parameters:
            words["side_id"] = intent.parameters["side_id"]
        for name in ("feature_type", "target_feature"):
            if name in intent.parameters and name not in values:
                words[name] = self._article(
                    str(intent.parameters[name]), own=intent.target is not None
                )
        if "target_list" in intent.parameters and "target_list" not in values:
            words["target_list"] = say_list(
                intent.parameters["target_list"], self.rng, clipped=self.clipped
            )
        if intent.target is not None and intent.target.identity is not None:
            words["target_id"] = intent.target.identity
            if intent.target.position is not None:
                words["target_position"] = ""
        if "arc" in intent.said and intent.said["arc"].attributive:
            words["arc_noun"] = ""
        return words

    def _article(self, text: str, *, own: bool) -> str:
        if self.clipped:
            return text
        return (
            f"{'its' if own and self.focus is not None and self.rng.random() < 0.2 else 'the'}"
            f" {text}"
        )

    def _filled(
        self,
        intent: Intent,
        template: Template,
        values: dict[str, str],
        mood: Mood,
        place: str = "",
    ) -> str:
        rng = self.rng
        words = self._words(intent, values)
        if (
            "target_position" in words
            and intent.target is not None
            and intent.target.position is not None
        ):
            words["target_position"] = say_position(
                intent.target.position, rng, self.style, spoken=self.spoken
            )
        if "arc_noun" in template.slots:
            words["arc_noun"] = self._arc_noun(intent, words)
        used = {
            slot.removesuffix("_compound").replace("arc_noun", "arc") for slot in template.slots
        }
        text = template.fill(words)
        text += "" if re.search(r"\b(?:there|here|where you are|spot)$", text) else place
        left = [name for name in words if name in ADJOINED and name not in used]
        return self._with_adjuncts(text, intent, words, left, mood)

    def _arc_noun(self, intent: Intent, words: dict[str, str]) -> str:
        adjuncts = forms(intent.title).adjuncts
        if intent.parameters["arc"] == 270 and self.rng.random() < 0.7:
            return self.rng.choice(
                (
                    "three quarters of a circle",
                    "a three-quarter circle",
                    "three quarters of a lap",
                    "a three-quarter orbit",
                )
            )
        exact = adjuncts.get(f"arc_noun:{intent.parameters['arc']}")
        pool = exact if exact and self.rng.random() < 0.85 else adjuncts["arc_noun"]
        return self.rng.choice([item for item in pool if item.slots <= words.keys()]).fill(words)

    def _with_adjuncts(
        self, text: str, intent: Intent, words: dict[str, str], names: list[str], mood: Mood
    ) -> str:
        rng = self.rng
        adjuncts = forms(intent.title).adjuncts
        if "width" in names and "length" in names and rng.random() < 0.9:
            names = [name for name in names if name not in ("width", "length")] + ["width+length"]
        rng.shuffle(names)
        if "target_position" in names or "start" in names:
            first = "target_position" if "target_position" in names else "start"
            names.remove(first)
            names.insert(0, first)
        for index, name in enumerate(names):
            pool = self._adjuncts(adjuncts, name, intent)
            usable = [item for item in pool if item.slots <= words.keys()]
            if not usable:
                continue
            adjunct = (
                usable[0]
                if name == "duration" and rng.random() < PLAIN_DURATION
                else rng.choice(usable)
            ).fill(words)
            if (
                index == 0
                and mood == "imp"
                and name in ("duration", "radius", "distance")
                and len(names) == 1
                and rng.random() < 0.05
                and adjunct.startswith(("for ", "at "))
            ):
                text = f"{adjunct} {text}" if rng.random() < 0.5 else f"{adjunct}, {text}"
            else:
                text += (
                    ("," if self.clipped or rng.random() < _comma_share(adjunct) else "")
                    + " "
                    + adjunct
                )
        return text

    def _adjuncts(
        self, adjuncts: dict[str, tuple[Template, ...]], name: str, intent: Intent
    ) -> tuple[Template, ...]:
        if (
            name == "arc"
            and intent.parameters["arc"] == 270
            and intent.said["arc"].attributive
            and self.rng.random() < 0.7
        ):
            return THREE_QUARTERS
        if name == "arc" and self.rng.random() < 0.8:
            exact = adjuncts.get(f"arc:{intent.parameters['arc']}")
            if exact and intent.said["arc"].attributive:
                return exact
        if name == "heading":
            word = intent.said["heading"].text.replace("due ", "")
            return (
                adjuncts["heading:word"]
                if word in BEARINGS and self.rng.random() < 0.7
                else adjuncts["heading"]
            )
        return adjuncts.get(name, ())


JOINING_WORDS = (
    "at for with from in on over to every each until up keeping staying holding doing making going"
    " along through out towards taking leaving"
)
JOINING = frozenset(JOINING_WORDS.split(" "))


def _comma_share(adjunct: str) -> float:
    """How often a comma stands before an adjunct: seldom where it starts with a preposition."""
    return 0.12 if adjunct.split(" ", 1)[0] in JOINING else 0.85
