"""One intent as a clause: core phrase, target and adjuncts, in the mood that the sentence needs."""

from __future__ import annotations

from dataclasses import replace
from random import Random

from planner_ft.data.mission.synthetic.bank import BANK_RETURN
from planner_ft.data.mission.synthetic.clause_words import (
    AT_A_POINT,
    GOING,
    HERE,
    HOLDS,
    PAIR_INTROS,
    RETRACTIONS,
    RETURN_GERUNDS,
    RETURN_NOUNS,
    SAME,
    SENSOR_TASKS,
    THERE,
    UNPLACED,
    VAGUE,
)
from planner_ft.data.mission.synthetic.filling import Filler, Mood
from planner_ft.data.mission.synthetic.frames import RULED_OUT_FIRST
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.mentions import (
    AREA_AGAIN,
    TRACK_AGAIN,
    full_mention,
    indefinite,
    plural,
    short_mention,
    spoken_identity,
)
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.positions import say_position
from planner_ft.data.mission.synthetic.templates import forms

__all__ = ["Mood", "Teller"]


class Teller(Filler):
    """Tells the intents of one command; it keeps in mind which target was spoken of last."""

    def __init__(
        self, rng: Random, style: Style, *, clipped: bool = False, spoken: bool = False
    ) -> None:
        super().__init__(rng, style, clipped=clipped, spoken=spoken)
        self.known: set[int] = set()
        self.left: dict[int, str] = {}
        self.wrong: dict[int, str] = {}

    def tell(self, intent: Intent, mood: Mood = "imp", *, explicit: bool = False) -> str:
        """The clause for `intent`; `explicit` makes it name its place even where the one before
        leaves no doubt.
        """
        if intent.home:
            return self.rng.choice(
                {"imp": BANK_RETURN, "np": RETURN_NOUNS, "ger": RETURN_GERUNDS}[mood]
            )
        if (
            intent.title == "SmartDataHarvest"
            and "target_list" not in intent.parameters
            and mood == "ger"
        ):
            return "uploading your data"
        if (
            intent.instead is not None
            and mood == "imp"
            and intent.target is not None
            and self.rng.random() < 0.4
        ):
            return self._not_that(intent, intent.instead)
        text = (
            self._retracted(intent.instead) if intent.instead is not None and mood == "imp" else ""
        )
        text += self._several(intent, mood) if intent.also else self._told(intent, mood, explicit)
        if (
            intent.title == "DockingApproach"
            and mood == "imp"
            and self.rng.random() < 0.14
            and not text.startswith(("come", "return", "head", "go", "get"))
        ):
            # A return that ends at a berth is the docking alone (rule 5).
            text = f"{self.rng.choice(BANK_RETURN)}{self.rng.choice((' and ', ' and ', ', then ', ' and then '))}{text}"
        text += self._vague(intent)
        if intent.purpose:
            ahead = (
                mood == "imp"
                and intent.purpose.startswith(("to ", "for ", "because ", "since ", "as "))
                and self.rng.random() < 0.3
            )
            text = f"{intent.purpose}, {text}" if ahead else f"{text} {intent.purpose}"
        if intent.target is not None:
            for target in (intent.target, *intent.also):
                self.introduce_silently(target)
            if intent.title in ("BathymetryGridSurvey", "SubseaCableTrack"):
                self.left[intent.target.key] = intent.title
        return text

    def _not_that(self, intent: Intent, wrong: Intent) -> str:
        """What is not wanted is said beside what is: "don't circle it, survey it"."""
        pattern = self.rng.choice(RULED_OUT_FIRST)
        told: dict[str, str] = {}
        for name in sorted(
            ("right", "ger" if "{ger}" in pattern else "wrong"),
            key=lambda name: pattern.index(f"{{{name}}}"),
        ):
            told[name] = (
                self._told(intent, "imp", False)
                if name == "right"
                else self._told(wrong, "ger" if name == "ger" else "imp", False)
            )
            if intent.target is not None:
                self.introduce_silently(intent.target)
        return pattern.format(**told)

    def _retracted(self, intent: Intent) -> str:
        text = self._told(intent, "imp", False)
        if intent.target is not None:
            self.introduce_silently(intent.target)
        return text + self.rng.choice(RETRACTIONS)

    def _several(self, intent: Intent, mood: Mood) -> str:
        """The same for several targets: "circle the red buoy, then the green one, 12 m off
        each".
        """
        rng, first = self.rng, intent.target
        assert first is not None
        if rng.random() < 0.5:
            text = self._named(replace(intent, also=()), mood, self._first_of(first))
            for target in intent.also:
                text += (
                    rng.choice((", then ", ", and then ", " and ", ", after that ", ", and "))
                    + self._full(target).rstrip(",")
                    + rng.choice(SAME)
                )
            return text
        names = [
            self._first_of(first).rstrip(","),
            *(self._full(target).rstrip(",") for target in intent.also),
        ]
        mention = rng.choice((" and ", " and then ", ", then ", " and after that ")).join(
            (", ".join(names[:-1]), names[-1])
        )
        if len(names) == 2 and rng.random() < 0.15:
            mention = f"both {names[0]} and {names[1]}"
        text = self._named(replace(intent, also=()), mood, mention)
        return text + (
            rng.choice((" each", " each time", " in each case", " every time"))
            if intent.said and rng.random() < 0.4
            else ""
        )

    def pair(self, intent: Intent) -> list[str]:
        """Two things of a kind are named, then "the red one" and "the other one"."""
        rng, first, second = self.rng, intent.target, intent.also[0]
        assert first is not None
        looks = [
            (target.description or "").removesuffix(f" {first.noun}") for target in (first, second)
        ]
        places = [
            (
                f" at {say_position(target.position, rng, self.style, spoken=self.spoken)}"
                if target.position
                else ""
            )
            for target in (first, second)
        ]
        opening = rng.choice(PAIR_INTROS).format(
            many=plural(first.noun),
            first=f"{indefinite(looks[0])} one{places[0]}",
            second=f"{indefinite(looks[1])} one{places[1]}",
        )
        text = self._named(replace(intent, also=(), instead=None), "imp", f"the {looks[0]} one")
        text += (
            rng.choice((", then ", " and then ", ", after that ", " and "))
            + rng.choice(("the other one", "the other one", "the other"))
            + rng.choice((*SAME, "", "", ""))
        )
        for target in (first, second):
            self.introduce_silently(target)
        return [opening, text]

    def _first_of(self, target: Target) -> str:
        return (
            short_mention(target, self.rng, self.style, spoken=self.spoken)
            if target.key in self.known
            else self._full(target)
        )

    def _vague(self, intent: Intent) -> str:
        """Something vague where a value could stand; it is no value, and the plan has none."""
        if self.rng.random() > 0.05:
            return ""
        pool = [
            text
            for name, texts in VAGUE.get(intent.title, {}).items()
            if name not in intent.parameters
            for text in texts
        ]
        return self.rng.choice(("", ",")) + f" {self.rng.choice(pool)}" if pool else ""

    def introduce(self, target: Target) -> str:
        """Names the target ahead of the clause that uses it, which then says "it" or "there"."""
        text = self._full(target)
        self.introduce_silently(target)
        return text

    def _told(self, intent: Intent, mood: Mood, explicit: bool) -> str:
        target, rng = intent.target, self.rng
        if (
            target is None
            and intent.parameters.keys() & {"target_list", "target_feature"}
            and intent.title not in PLACE_TASKS
        ):
            return self._filled(intent, self._core(intent, mood, named=True), {}, mood)
        if target is None:
            unsaid = self.focus is None and intent.title in UNPLACED and rng.random() < 0.35
            place = rng.choice(HERE) if intent.title in PLACE_TASKS and not unsaid else ""
            return self._bare(intent, mood, place, here=bool(place))
        again = target.key in self.known
        if again and self.left.pop(target.key, None) is not None:
            return self._named(
                intent, mood, rng.choice(TRACK_AGAIN if target.noun == "cable" else AREA_AGAIN)
            )
        if again and target.key == self.focus:
            return self._again(intent, mood, explicit)
        mention = short_mention(target, rng, self.style, spoken=self.spoken) if again else None
        if again and intent.title == "KeepStation" and rng.random() < 0.3:
            return (
                self._named(intent, mood, mention or "").replace("hold", "go back and hold", 1)
                if mood == "imp"
                else self._named(intent, mood, mention or "")
            )
        return self._named(intent, mood, mention)

    def _full(self, target: Target) -> str:
        return full_mention(
            target,
            self.rng,
            self.style,
            clipped=self.clipped,
            spoken=self.spoken,
            wrong=self.wrong.pop(target.key, ""),
        )

    def _named(self, intent: Intent, mood: Mood, mention: str | None) -> str:
        """The clause with its target named; `mention` None stands for the full mention."""
        target, rng = intent.target, self.rng
        assert target is not None
        if mood == "imp" and mention is None and intent.title in PLACE_TASKS:
            roll = rng.random()
            lead = (
                HOLDS
                if roll < 0.11 and intent.title in SENSOR_TASKS
                else GOING
                if roll < 0.25
                else None
            )
            if lead:
                text = rng.choice(lead)
                self.introduce_silently(target)
                named = self._full(target)
                return text.replace("{target}", named).replace(
                    "{clause}", self._again(intent, mood, False)
                )
        if (
            target.description
            in (intent.parameters.get("feature_type"), intent.parameters.get("target_feature"))
            and target.description is not None
        ):
            return self._bare(intent, mood, "", feature=mention or self._full(target))
        if intent.title == "FollowTarget" and target.identity is not None:
            mention = spoken_identity(target)
        if intent.title == "SubseaCableTrack":
            return self._cable(intent, mood, mention)
        mention = mention or (
            self._sought(target) if intent.title == "SearchAndDetect" else self._full(target)
        )
        if intent.part:
            mention = f"the {intent.part} of {mention}"
        template = self._core(intent, mood, named=True)
        if target.description is None and intent.title in AT_A_POINT:
            template = template.at_place
        values = {"target": mention, "target_description": mention}
        feature = next(
            (name for name in ("feature_type", "target_feature") if name in intent.parameters), None
        )
        if (
            feature is not None
            and target.position is None
            and not target.whereabouts
            and rng.random() < 0.18
        ):
            template = template.possessive
            values["own_feature"] = str(intent.parameters[feature])
        return self._filled(intent, template, values, mood)

    def introduce_silently(self, target: Target) -> None:
        """From here on the target is known, without words of its own."""
        self.known.add(target.key)
        self.focus = target.key

    def _sought(self, target: Target) -> str:
        text = self._full(target)
        return (
            indefinite(text[4:])
            if text.startswith("the ")
            and self.rng.random() < 0.12
            and not any(mark.isupper() or mark.isdigit() for mark in text)
            else text
        )

    def _cable(self, intent: Intent, mood: Mood, mention: str | None) -> str:
        target, rng = intent.target, self.rng
        assert target is not None
        name = mention or f"{'' if self.clipped else 'the '}{target.said_as or target.description}"
        values = {"cable": name, "target": name}
        if target.position is not None:
            values["start"] = self.wrong.pop(target.key, "") + say_position(
                target.position, rng, self.style, spoken=self.spoken
            )
        return self._filled(
            intent, self._core(intent, mood, named=True, extra=values), values, mood
        )

    def _again(self, intent: Intent, mood: Mood, explicit: bool) -> str:
        """The target is the one spoken of last: "it", "there" or nothing."""
        rng, target = self.rng, intent.target
        assert target is not None
        bare = forms(intent.title).bare[mood]
        own = target.description is not None and target.description in (
            intent.parameters.get("feature_type"),
            intent.parameters.get("target_feature"),
        )
        if own:
            return self._bare(intent, mood, "", feature="it")
        if (
            bare
            and not intent.part
            and (
                rng.random() < 0.55
                or intent.title in ("FeatureStare", "GlareFreeApproach")
                or (
                    target.description is None
                    and intent.title not in ("PerformOrbit", "SurveyTarget")
                )
            )
        ):
            place = rng.choice(THERE) if explicit or rng.random() < 0.3 else ""
            return self._bare(intent, mood, f" {place}" if place else "")
        template = self._core(intent, mood, named=True)
        if target.description is None and intent.title in AT_A_POINT:
            template = template.at_place
        if intent.part:
            return self._filled(intent, template, {"target": f"its {intent.part}"}, mood)
        it = (
            "it"
            if target.description is not None or intent.title in ("PerformOrbit", "SurveyTarget")
            else "that point"
        )
        return self._filled(
            intent, template.there, {"target": it, "target_description": it, "cable": it}, mood
        )

    def _bare(
        self,
        intent: Intent,
        mood: Mood,
        place: str,
        *,
        here: bool = False,
        feature: str | None = None,
    ) -> str:
        rng = self.rng
        shapes = forms(intent.title)
        if here and mood == "imp" and shapes.here and rng.random() < 0.6:
            return self._filled(intent, rng.choice(shapes.here), {}, mood)
        pool = shapes.bare[mood] or (
            shapes.full[mood] if intent.target is None and intent.title not in PLACE_TASKS else ()
        )
        valued = [
            item
            for item in shapes.valued[mood]
            if "target" not in item.slots and item.slots <= self._words(intent, {}).keys()
        ]
        if valued and feature is None and rng.random() < 0.2:
            pool = tuple(valued)
        values = {"feature_type": feature, "target_feature": feature} if feature else {}
        usable = [item for item in pool if item.slots <= self._words(intent, {}).keys()] or [
            item for item in pool if not item.slots
        ]
        if intent.target is None:
            usable = [item for item in usable if "there" not in item.text]
        if usable:
            return self._filled(
                intent,
                rng.choice(usable),
                {name: text for name, text in values.items() if text},
                mood,
                place,
            )
        known = {name: text for name, text in values.items() if text}
        for _ in range(8):
            template = self._core(intent, mood, named=True).placeless
            if "target" not in template.slots:
                return self._filled(intent, template, known, mood, place)
        return (
            self._bare(intent, "imp", place, here=here, feature=feature)
            if mood != "imp"
            else self._filled(intent, template.there, {"target": "it", **known}, mood)
        )
