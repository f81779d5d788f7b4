"""One intent as a clause: core phrase, target and adjuncts, in the mood that the sentence needs."""

from __future__ import annotations

import re
from dataclasses import replace
from random import Random
from typing import Literal

from planner_ft.data.mission.synthetic.bank import BANK_RETURN
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.lists import say_list
from planner_ft.data.mission.synthetic.mentions import AREA_AGAIN, TRACK_AGAIN, full_mention, indefinite, short_mention, spoken_identity
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.positions import say_position
from planner_ft.data.mission.synthetic.templates import Template, forms

Mood = Literal["imp", "np", "ger"]

RETURN_NOUNS = ("a return home", "a return to base", "the trip home", "the run home", "a transit home", "the way back home")
RETURN_GERUNDS = ("coming home", "returning home", "heading home", "returning to base", "going back to base", "coming back", "going home")
SENSOR_TASKS = frozenset(("FeatureStare", "GlareFreeApproach", "ThermalTimeLapse", "ThermalHotspotLocalizer", "HorizontalPanorama"))
UNPLACED = frozenset(("KeepStation", "DriftAudit", "HorizontalPanorama", "ThermalHotspotLocalizer", "ThermalTimeLapse"))
"""What can be asked for without any place: it happens where the vehicle is."""
AT_A_POINT = SENSOR_TASKS | {"BoatLandingClearanceSweep", "SurveyTarget"}
HOLDS = (
    "stop beside {target} and {clause}", "stop at {target} and {clause}", "pull up next to {target} and {clause}",
    "lie off {target} and {clause}", "stop next to {target} and {clause}",
    "hold still beside {target} and {clause}", "stand off {target} and {clause}", "hold position off {target} while you {clause}",
    "stay beside {target} while you {clause}", "stop in front of {target} and {clause}",
)  # fmt: skip
GOING = (
    "go to {target} and {clause}", "head over to {target} and {clause}", "proceed to {target} and {clause}", "go to {target}, {clause}",
    "make your way to {target} and {clause}",
    "move to {target} and {clause}", "run out to {target} and {clause}", "go out to {target} and {clause}", "go over to {target} and {clause}",
    "pop over to {target} and {clause}", "get yourself to {target} and {clause}",
)  # fmt: skip
HERE = (" where you are", " right here", " from where you are", " from here", " on the spot", " right where you are", " here",
    " at your present position", " from your current position", " where she lies now")
THERE = ("there", "right there", "on the spot", "from there", "while you are there", "at the same place", "at that spot")
RETRACTIONS = (
    ", no, scratch that, ", ", no wait, ", ", sorry, ", " - no, ", ", no, better ", ", or no, ", ", forget that, ", " ... actually no, ",
    ", correction, ", ", wait, no, ", ", belay that, ", ", strike that, ", ", hang on, no, ", ", I mean ",
)  # fmt: skip
SAME = (", same again", ", same thing", ", likewise", ", in the same way", " too", ", same as before", ", the same way", ", same settings",
    " as well", ", ditto", ", same values", ", also like that")
_TIME = ("for a while", "for a bit", "for some time", "until further notice", "as long as it takes", "for a little while", "until I call you",
    "until the ferry has passed", "for a moment")
_SLOW = ("slowly", "nice and slow", "at a crawl", "at an easy pace", "taking your time", "at a moderate speed", "not too fast")
_OFF = ("at a safe distance", "with plenty of room", "not too close", "close in", "a fair bit off", "from a respectful distance", "keeping well off")
VAGUE: dict[str, dict[str, tuple[str, ...]]] = {
    "KeepStation": {"duration": _TIME}, "DriftAudit": {"duration": _TIME}, "PerformOrbit": {"radius": _OFF, "speed": _SLOW},
    "ParallelStructurePass": {"distance": _OFF, "speed": _SLOW},
    "ThermalTimeLapse": {"duration": _TIME, "interval": ("at regular intervals", "every so often")}, "FeatureStare": {"duration": _TIME},
    "SurveyTarget": {"radius": _OFF},
    "HorizontalPanorama": {"overlap": ("with a good overlap", "with plenty of overlap"), "sectors": ("in as many sectors as you like",)},
    "SubseaCableTrack": {"max_dist": ("as far as you can", "to where it ends", "for a good stretch")},
    "BathymetryGridSurvey": {"spacing": ("with narrow lines", "with tight spacing", "in close lines")},
    "ThermalHotspotLocalizer": {"scan_width_degrees": ("with a wide scan", "with a narrow scan")},
    "VisualDockingApproach": {"distance": ("nice and gently", "stopping just short of it")},
}  # fmt: skip
BEARINGS = frozenset(["north", "south", "east", "west", "northeast", "northwest", "southeast", "southwest", "north-east", "north-west", "south-east", "south-west"])


class Teller:
    """Tells the intents of one command; it keeps in mind which target was spoken of last."""

    def __init__(self, rng: Random, style: Style, *, clipped: bool = False, spoken: bool = False) -> None:
        self.rng, self.style, self.clipped, self.spoken = rng, style, clipped, spoken
        self.focus: int | None = None
        self.known: set[int] = set()
        self.left: dict[int, str] = {}
        self.wrong: dict[int, str] = {}

    def tell(self, intent: Intent, mood: Mood = "imp", *, explicit: bool = False) -> str:
        """The clause for `intent`; `explicit` makes it name its place even where the one before leaves no doubt."""
        if intent.home:
            return self.rng.choice({"imp": BANK_RETURN, "np": RETURN_NOUNS, "ger": RETURN_GERUNDS}[mood])
        if intent.title == "SmartDataHarvest" and "target_list" not in intent.parameters and mood == "ger":
            return "uploading your data"
        text = self._retracted(intent.instead) if intent.instead is not None and mood == "imp" else ""
        text += self._several(intent, mood) if intent.also else self._told(intent, mood, explicit)
        if intent.title == "DockingApproach" and mood == "imp" and self.rng.random() < 0.14 and not text.startswith(("come", "return", "head", "go", "get")):
            # A return that ends at a berth is the docking alone (rule 5).
            text = f"{self.rng.choice(BANK_RETURN)}{self.rng.choice((' and ', ' and ', ', then ', ' and then '))}{text}"
        text += self._vague(intent)
        if intent.purpose:
            text += f" {intent.purpose}"
        if intent.target is not None:
            for target in (intent.target, *intent.also):
                self.introduce_silently(target)
            if intent.title in ("BathymetryGridSurvey", "SubseaCableTrack"):
                self.left[intent.target.key] = intent.title
        return text

    def _retracted(self, intent: Intent) -> str:
        text = self._told(intent, "imp", False)
        if intent.target is not None:
            self.introduce_silently(intent.target)
        return text + self.rng.choice(RETRACTIONS)

    def _several(self, intent: Intent, mood: Mood) -> str:
        """The same for several targets: "circle the red buoy, then the green one, 12 m off each"."""
        rng, first = self.rng, intent.target
        assert first is not None
        if rng.random() < 0.5:
            text = self._named(replace(intent, also=()), mood, self._full(first))
            for target in intent.also:
                text += rng.choice((", then ", ", and then ", " and ", ", after that ", ", and ")) + self._full(target).rstrip(",") + rng.choice(SAME)
            return text
        names = [self._full(target).rstrip(",") for target in (first, *intent.also)]
        mention = rng.choice((" and ", " and then ", ", then ", " and after that ")).join((", ".join(names[:-1]), names[-1]))
        text = self._named(replace(intent, also=()), mood, mention)
        return text + (rng.choice((" each", " each time", " in each case", " every time")) if intent.said and rng.random() < 0.4 else "")

    def _vague(self, intent: Intent) -> str:
        """Something vague where a value could stand; it is no value, and the plan has none."""
        if self.rng.random() > 0.05:
            return ""
        pool = [text for name, texts in VAGUE.get(intent.title, {}).items() if name not in intent.parameters for text in texts]
        return self.rng.choice(("", ",")) + f" {self.rng.choice(pool)}" if pool else ""

    def introduce(self, target: Target) -> str:
        """Names the target ahead of the clause that uses it, which then says "it" or "there"."""
        text = self._full(target)
        self.introduce_silently(target)
        return text

    def _told(self, intent: Intent, mood: Mood, explicit: bool) -> str:
        target, rng = intent.target, self.rng
        if target is None and intent.parameters.keys() & {"target_list", "target_feature"} and intent.title not in PLACE_TASKS:
            return self._filled(intent, self._core(intent, mood, named=True), {}, mood)
        if target is None:
            unsaid = self.focus is None and intent.title in UNPLACED and rng.random() < 0.35
            place = rng.choice(HERE) if intent.title in PLACE_TASKS and not unsaid else ""
            return self._bare(intent, mood, place, here=bool(place))
        again = target.key in self.known
        if again and self.left.pop(target.key, None) is not None:
            return self._named(intent, mood, rng.choice(TRACK_AGAIN if target.noun == "cable" else AREA_AGAIN))
        if again and target.key == self.focus:
            return self._again(intent, mood, explicit)
        mention = short_mention(target, rng, self.style, spoken=self.spoken) if again else None
        if again and intent.title == "KeepStation" and rng.random() < 0.3:
            return self._named(intent, mood, mention or "").replace("hold", "go back and hold", 1) if mood == "imp" else self._named(intent, mood,
            mention or "")
        return self._named(intent, mood, mention)

    def _full(self, target: Target) -> str:
        return full_mention(target, self.rng, self.style, clipped=self.clipped, spoken=self.spoken, wrong=self.wrong.pop(target.key, ""))

    def _named(self, intent: Intent, mood: Mood, mention: str | None) -> str:
        """The clause with its target named; `mention` None stands for the full mention."""
        target, rng = intent.target, self.rng
        assert target is not None
        if mood == "imp" and mention is None and intent.title in PLACE_TASKS:
            roll = rng.random()
            lead = HOLDS if roll < 0.07 and intent.title in SENSOR_TASKS else GOING if roll < 0.22 else None
            if lead:
                text = rng.choice(lead)
                self.introduce_silently(target)
                named = self._full(target)
                return text.replace("{target}", named).replace("{clause}", self._again(intent, mood, False))
        if target.description in (intent.parameters.get("feature_type"), intent.parameters.get("target_feature")) and target.description is not None:
            return self._bare(intent, mood, "", feature=mention or self._full(target))
        if intent.title == "FollowTarget" and target.identity is not None:
            mention = spoken_identity(target)
        if intent.title == "SubseaCableTrack":
            return self._cable(intent, mood, mention)
        mention = mention or (self._sought(target) if intent.title == "SearchAndDetect" else self._full(target))
        if intent.part:
            mention = f"the {intent.part} of {mention}"
        template = self._core(intent, mood, named=True)
        if target.description is None and intent.title in AT_A_POINT:
            template = template.at_place
        return self._filled(intent, template, {"target": mention, "target_description": mention}, mood)

    def introduce_silently(self, target: Target) -> None:
        """From here on the target is known, without words of its own."""
        self.known.add(target.key)
        self.focus = target.key

    def _sought(self, target: Target) -> str:
        text = self._full(target)
        return indefinite(text[4:]) if text.startswith("the ") and self.rng.random() < 0.12 and not any(mark.isupper() or mark.isdigit() for mark in text) else text

    def _cable(self, intent: Intent, mood: Mood, mention: str | None) -> str:
        target, rng = intent.target, self.rng
        assert target is not None
        name = mention or f"{'' if self.clipped else 'the '}{target.said_as or target.description}"
        values = {"cable": name, "target": name}
        if target.position is not None:
            values["start"] = self.wrong.pop(target.key, "") + say_position(target.position, rng, self.style, spoken=self.spoken)
        return self._filled(intent, self._core(intent, mood, named=True, extra=values), values, mood)

    def _again(self, intent: Intent, mood: Mood, explicit: bool) -> str:
        """The target is the one spoken of last: "it", "there" or nothing."""
        rng, target = self.rng, intent.target
        assert target is not None
        bare = forms(intent.title).bare[mood]
        own = target.description is not None and target.description in (intent.parameters.get("feature_type"), intent.parameters.get("target_feature"))
        if own:
            return self._bare(intent, mood, "", feature="it")
        if bare and not intent.part and (rng.random() < 0.55 or intent.title in ("FeatureStare",
        "GlareFreeApproach") or (target.description is None and intent.title not in ("PerformOrbit", "SurveyTarget"))):
            place = rng.choice(THERE) if explicit or rng.random() < 0.3 else ""
            return self._bare(intent, mood, f" {place}" if place else "")
        template = self._core(intent, mood, named=True)
        if target.description is None and intent.title in AT_A_POINT:
            template = template.at_place
        if intent.part:
            return self._filled(intent, template, {"target": f"its {intent.part}"}, mood)
        it = "it" if target.description is not None or intent.title in ("PerformOrbit", "SurveyTarget") else "that point"
        return self._filled(intent, template.there, {"target": it, "target_description": it, "cable": it}, mood)

    def _bare(self, intent: Intent, mood: Mood, place: str, *, here: bool = False, feature: str | None = None) -> str:
        rng = self.rng
        shapes = forms(intent.title)
        if here and mood == "imp" and shapes.here and rng.random() < 0.6:
            return self._filled(intent, rng.choice(shapes.here), {}, mood)
        pool = shapes.bare[mood] or (shapes.full[mood] if intent.target is None and intent.title not in PLACE_TASKS else ())
        valued = [item for item in shapes.valued[mood] if "target" not in item.slots and item.slots <= self._words(intent, {}).keys()]
        if valued and feature is None and rng.random() < 0.2:
            pool = tuple(valued)
        values = {"feature_type": feature, "target_feature": feature} if feature else {}
        usable = [item for item in pool if item.slots <= self._words(intent, {}).keys()] or [item for item in pool if not item.slots]
        if usable:
            return self._filled(intent, rng.choice(usable), {name: text for name, text in values.items() if text}, mood, place)
        known = {name: text for name, text in values.items() if text}
        for _ in range(8):
            template = self._core(intent, mood, named=True).placeless
            if "target" not in template.slots:
                return self._filled(intent, template, known, mood, place)
        return self._bare(intent, "imp", place, here=here, feature=feature) if mood != "imp" else self._filled(intent, template.there,
        {"target": "it", **known}, mood)

    def _core(self, intent: Intent, mood: Mood, *, named: bool, extra: dict[str, str] | None = None) -> Template:
        rng, shapes = self.rng, forms(intent.title)
        words = self._words(intent, {"target": "", "target_description": "", "cable": "", **(extra or {})})
        if shapes.valued[mood] and rng.random() < 0.22:
            usable = [item for item in shapes.valued[mood] if item.slots <= words.keys() and item.slots & NAMING]
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
                words[name] = self._article(str(intent.parameters[name]), own=intent.target is not None)
        if "target_list" in intent.parameters and "target_list" not in values:
            words["target_list"] = say_list(intent.parameters["target_list"], self.rng, clipped=self.clipped)
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
        return f"{'its' if own and self.focus is not None and self.rng.random() < 0.2 else 'the'} {text}"

    def _filled(self, intent: Intent, template: Template, values: dict[str, str], mood: Mood, place: str = "") -> str:
        rng = self.rng
        words = self._words(intent, values)
        if "target_position" in words and intent.target is not None and intent.target.position is not None:
            words["target_position"] = say_position(intent.target.position, rng, self.style, spoken=self.spoken)
        if "arc_noun" in template.slots:
            words["arc_noun"] = self._arc_noun(intent, words)
        used = {slot.removesuffix("_compound").replace("arc_noun", "arc") for slot in template.slots}
        text = template.fill(words)
        text += "" if re.search(r"\b(?:there|here|where you are|spot)$", text) else place
        left = [name for name in words if name in ADJOINED and name not in used]
        return self._with_adjuncts(text, intent, words, left, mood)

    def _arc_noun(self, intent: Intent, words: dict[str, str]) -> str:
        adjuncts = forms(intent.title).adjuncts
        exact = adjuncts.get(f"arc_noun:{intent.parameters['arc']}")
        pool = exact if exact and self.rng.random() < 0.85 else adjuncts["arc_noun"]
        return self.rng.choice([item for item in pool if item.slots <= words.keys()]).fill(words)

    def _with_adjuncts(self, text: str, intent: Intent, words: dict[str, str], names: list[str], mood: Mood) -> str:
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
            adjunct = rng.choice(usable).fill(words)
            if index == 0 and mood == "imp" and name in ("duration", "radius",
            "distance") and len(names) == 1 and rng.random() < 0.05 and adjunct.startswith(("for ", "at ")):
                text = f"{adjunct} {text}" if rng.random() < 0.5 else f"{adjunct}, {text}"
            else:
                text += ("," if self.clipped or rng.random() < 0.25 else "") + " " + adjunct
        return text

    def _adjuncts(self, adjuncts: dict[str, tuple[Template, ...]], name: str, intent: Intent) -> tuple[Template, ...]:
        if name == "arc" and self.rng.random() < 0.8:
            exact = adjuncts.get(f"arc:{intent.parameters['arc']}")
            if exact and intent.said["arc"].attributive:
                return exact
        if name == "heading":
            word = intent.said["heading"].text.replace("due ", "")
            return adjuncts["heading:word"] if word in BEARINGS and self.rng.random() < 0.7 else adjuncts["heading"]
        return adjuncts.get(name, ())


NAMING = frozenset(("target", "target_id", "target_description", "cable"))
ADJOINED = (
    "radius", "speed", "arc", "side_id", "length", "distance", "duration", "sectors", "overlap", "wait", "scan_width_degrees", "interval", "width", "spacing",
    "start", "heading", "max_dist", "target_position",
)  # fmt: skip
