"""Things to do as composed commands tell them: the clauses of `composed/clauses.toml` with slots of
their own numbers.
"""

from __future__ import annotations

import re
import tomllib
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic.commands_format import (
    VALUE_NAMES,
    Line,
    Slot,
    base_of,
    parse_slot,
)

FOLDER = Path(__file__).parent / "composed"
CHOICE = re.compile(r"\(([^()|]*(?:\|[^()|]*)+)\)")
BRACES = re.compile(r"\{([^{}]*)\}")
VALUE = re.compile(r"\{~?(" + "|".join(sorted(VALUE_NAMES)) + r")\b")
ITEMS = 50
"""What is added to the number of a second item of one list, which clauses call M."""
AUXILIARIES = {"got": "", "has": "has been", "is": "is", "tobe": "is to be"}
"""What the moods of a passive clause put for its %."""
AHEAD, AHEAD_SHARE = ("for", "at", "from"), 0.07
"""Values that may stand before their clause, "for ten minutes hold at ...", and how often they
do.
"""
ENDINGS = (
    "Home",
    "AutoGenerateReportSummary",
    "DockingApproach",
    "SmartDataHarvest",
    "VisualDockingApproach",
)
ENDING_WEIGHTS = (36, 28, 12, 16, 8)
DONE_SOMEWHERE = {
    "KeepStation": 16,
    "DriftAudit": 12,
    "HorizontalPanorama": 12,
    "PerformOrbit": 15,
    "SurveyTarget": 16,
    "ParallelStructurePass": 8,
    "BathymetryGridSurvey": 9,
    "SubseaCableTrack": 5,
    "FeatureStare": 9,
    "GlareFreeApproach": 5,
    "ThermalTimeLapse": 7,
    "ThermalHotspotLocalizer": 7,
    "BoatLandingClearanceSweep": 5,
    "SearchAndDetect": 5,
    "Transit": 3,
    "FollowTarget": 3,
}
"""How often each task is asked for."""


@cache
def clauses() -> dict[str, Any]:
    """The forms of every task by mood."""
    return tomllib.loads((FOLDER / "clauses.toml").read_text(encoding="utf-8"))


@cache
def phrases(name: str) -> dict[str, Any]:
    """Another file of the folder: "orders" or "values"."""
    return tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8"))


def chosen(text: str, rng: Random) -> str:
    """`text` with one alternative of every `(a|b)`."""
    while "|" in text:
        text, count = CHOICE.subn(lambda match: _one(match[1].split("|"), rng), text)
        if not count:
            break
    return text


def _one(options: list[str], rng: Random) -> str:
    return options[int(rng.random() * len(options))]


@dataclass
class Wish:
    """One thing to do. `place` is the slot of its place ("T1", "P2", "ID1:..."), `shared` the
    numbers of the values that several wishes have in common.

    `values` is what follows the clause, "at {radius}"; `apart` says that it is told elsewhere;
    `said` collects the slots that were told.
    """

    title: str
    number: int
    place: str
    values: str
    shared: dict[str, int] = field(default_factory=dict)
    apart: bool = False
    said: dict[str, None] = field(default_factory=dict)

    def tell(self, rng: Random, mood: str, place: str | None = None) -> str:
        """The clause. `place` is other words for the place: "it" where it was just named."""
        form = self._form(rng, mood)
        while self.apart and VALUE.search(form):
            form = self._form(rng, mood)
        if self.values and not self.apart and not VALUE.search(form):
            ahead = (
                mood == "imp"
                and self.values.startswith(AHEAD)
                and "," not in self.values
                and rng.random() < AHEAD_SHARE
            )
            form = f"{self.values} {form}" if ahead else f"{form} {self.values}"
        return self.numbered(_placed(form, self.place_words(rng) if place is None else place))

    def _form(self, rng: Random, mood: str) -> str:
        if mood not in AUXILIARIES:
            return chosen(_one(clauses()[self.title][mood], rng), rng)
        return chosen(_one(clauses()[self.title]["pas"], rng), rng).replace("%", AUXILIARIES[mood])

    def place_words(self, rng: Random) -> str:
        """The slot of its place as text, a cable's start or an area in words that suit it."""
        if self.place.startswith("P") and self.title == "SubseaCableTrack":
            return f"the cable {_one(['from', 'from', 'starting at'], rng)} {{{self.place}}}"
        return f"{{{self.place}}}"

    def numbered(self, text: str) -> str:
        """`text` with this wish's own slots, which are remembered as told."""
        return BRACES.sub(self._number, text)

    def _number(self, match: re.Match[str]) -> str:
        text, name = numbered_slot(match[1], self.number, tuple(self.shared.items()))
        if name:
            self.said[name] = None
        return text

    def call(self, rng: Random) -> str:
        """Its short name: "the lap"."""
        return f"the {chosen(clauses()[self.title]['call'], rng)}"

    def line(self) -> Line:
        """The intent for what was told."""
        if not self.place:
            return Line(self.title, tuple(self.said))
        place = slot_of(self.place).name
        bound = (f"P{place[1:]}",) if "position" in self.shared else ()
        return Line(self.title, (place, *bound, *self.said))


@cache
def numbered_slot(slot: str, number: int, shared: tuple[tuple[str, int], ...]) -> tuple[str, str]:
    """ "~radius adj" as "{~radius3 adj}" for the number 3, and its name; slots that have a number
    keep it, and places have no name here.
    """
    if not any(letter.isdigit() for letter in slot):
        base, _, rest = slot.removeprefix("~").partition(" ")
        name = f"L{number + ITEMS}" if base == "M" else f"{base}{dict(shared).get(base, number)}"
        slot = f"{'~' if slot.startswith('~') else ''}{name} {rest}".rstrip()
    name = slot_of(slot).name
    return f"{{{slot}}}", "" if base_of(name) in ("T", "P", "ID") else name


slot_of = cache(parse_slot)


def _placed(form: str, place: str) -> str:
    if place != "it":
        return form.replace("@", place)
    return form.replace("at @", "there").replace("{F} of @", "{F} on it").replace("@", "it")


def may_say_it(wish: Wish) -> bool:
    """Whether "it" and "there" can stand for its place: a position is no "it"."""
    return wish.place.startswith("T")


def new_wish(rng: Random, number: int, title: str, place: str | None = None, **known: Any) -> Wish:
    """A wish with slots of the number; `place` is given where another wish has the same."""
    entry = clauses()[title]
    return Wish(
        title,
        number,
        _place(rng, number, entry["at"]) if place is None else place,
        chosen(_one(entry["with"], rng), rng),
        **known,
    )


def _place(rng: Random, number: int, at: str) -> str:
    roll = rng.random()
    if at in ("T", "TP"):
        return f"P{number}" if at == "TP" and roll < 0.5 else f"T{number}"
    if at == "C":
        return f"P{number}" if roll < 0.5 else f"T{number}:cable"
    if at == "I":
        return f"ID{number}" if roll < 0.6 else f"T{number}:boat"
    if at == "S":
        return f"T{number}:{('boat', 'thing', 'buoy')[int(roll * 3)]} lost"
    if at == "D":
        return f"P{number}" if roll < 0.3 else f"T{number}:dock"
    return f"P{number}" if at == "P" else ""


def draw_titles(rng: Random, count: int) -> list[str]:
    """Titles of things done somewhere, all different."""
    titles: list[str] = []
    while len(titles) < count:
        title = rng.choices(*_WEIGHTED)[0]
        if title not in titles:
            titles.append(title)
    return titles


_WEIGHTED = (tuple(DONE_SOMEWHERE), tuple(DONE_SOMEWHERE.values()))


def draw_ending(rng: Random, number: int) -> Wish:
    """A return, a docking, a report or an upload."""
    return new_wish(rng, number, rng.choices(ENDINGS, ENDING_WEIGHTS)[0])


def slots_of(text: str) -> list[str | Slot]:
    """The parts of a text that has no choices left."""
    return [slot_of(part) if index % 2 else part for index, part in enumerate(BRACES.split(text))]
