"""Putting a script into words: sentence frames (frames.toml), and words for the steps in which a
skill runs.

Every part of the script is said once, in the order in which it is mentioned. Frames whose table is
named *_unseen appear in no split but test_unseen.
"""

from __future__ import annotations

import functools
import itertools
import random
import tomllib
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from planner_ft.data.numbers import in_words, pick
from planner_ft.data.task.context import Movement
from planner_ft.data.task.phrasebook import Call, Phrasebook
from planner_ft.data.task.script import Run, Script
from planner_ft.data.task.template import MARKS, Template, compile_template
from planner_ft.data.templates.render import VALUE_OPEN
from planner_ft.data.wordlists import joined

TABLES: dict[str, Any] = tomllib.loads((Path(__file__).parent / "frames.toml").read_text("utf-8"))
SCOPES: dict[str, Any] = TABLES["scopes"]
ORDINALS: list[str] = SCOPES["ordinals"]
LOCAL = 0.5
"""Share of the skills of a single step that are said with its movement, not in a sentence of their
own.
"""

Maker = Callable[[str], str]
"""Words for a part of the script in a form ("", "ing", "with", ...)."""


@functools.cache
def _frames(table: str, can: frozenset[str]) -> tuple[list[tuple[str, Template]], list[float]]:
    """Name and template of the frames of a table that say exactly this, with their cumulative
    weights.
    """
    wanted = {slot.partition("_")[0] for slot in can}
    found, weights = [], []
    for name, frame in TABLES[table].items():
        for text in frame["phrases"]:
            template = compile_template(text)
            said = {slot.partition("_")[0] for slot in template.needed}
            if template.needed <= can and said == wanted:
                found.append((name, template))
                weights.append(frame["weight"] / len(frame["phrases"]))
    return found, list(itertools.accumulate(weights))


class _Words(dict[str, str]):
    """Slots of a frame, said when they are come to, so that the order of mention is known."""

    def __init__(self, makers: Mapping[str, Maker], constants: Mapping[str, str]) -> None:
        super().__init__({"_open": "(", "_close": ")", **constants})
        self.makers = makers

    def __missing__(self, slot: str) -> str:
        group, _, form = slot.partition("_")
        return self.makers[group](form)


class Speaker:
    """Words for a script and its parts."""

    def __init__(self, rng: random.Random, book: Phrasebook) -> None:
        self.rng, self.book, self.mentioned = rng, book, 0

    def chance(self, share: float) -> bool:
        """True in `share` of the cases."""
        return self.rng.random() < share

    def script(self, script: Script) -> tuple[str, str]:
        """The name of the frame, and the prompt with its values marked."""
        unseen = "_unseen" if self.book.unseen else ""
        if len(script.movements) > 1:
            name, text = self._several(script, f"several{unseen}")
        else:
            filters = [run.call for run in script.runs if run.role == "filter"]
            data = [run.call for run in script.runs if run.role == "perception"]
            table = "single" if script.movements[0].saying else "still"
            name, text = self._single(script.movements[0], filters, data, table + unseen)
        return name, sentences(text)

    # ------------------------------------------------------------ one movement

    def _single(
        self, movement: Movement, filters: list[Call], data: list[Call], table: str
    ) -> tuple[str, str]:
        if filters and movement.saying and self.chance(0.35):
            data, filters = (filters + data if self.chance(0.5) else data + filters), []
        if not filters:
            return self._frame(table, movement, data)
        name = ""

        def core(_form: str) -> str:
            nonlocal name
            name, text = self._frame(table, movement, data)
            return text

        makers: dict[str, Maker] = {"core": core, "filters": partial(self.calls, filters)}
        _name, text = self._draw("filters", {"core", *_forms("filters", filters)}, makers)
        return name, text

    def _frame(self, table: str, movement: Movement, data: list[Call]) -> tuple[str, str]:
        """A movement with what runs beside it."""
        saying = movement.saying
        can = _forms("data", data)
        makers: dict[str, Maker] = {"data": partial(self.calls, data)}
        if saying is not None:
            can |= {"move", "move_ing"}
            makers["move"] = lambda form: saying.render(self.rng, "ing" if form else "base")
        return self._draw(table, can, makers)

    def _draw(
        self,
        table: str,
        can: set[str],
        makers: Mapping[str, Maker],
        constants: Mapping[str, str] | None = None,
    ) -> tuple[str, str]:
        frames, weights = _frames(table, frozenset(can))
        name, template = self.rng.choices(frames, cum_weights=weights)[0]
        return name, template.render(_Words(makers, constants or {}), self.rng)

    def calls(self, calls: Sequence[Call], form: str) -> str:
        """Several skills in a form: "record the sonar, log the depth and take a fix"."""
        if form.endswith("each"):
            return ". ".join(
                self._call(call, form.removesuffix("each").strip("_")) for call in calls
            )
        together = form in ("", "ing") and self.chance(0.45)
        logged = [call for call in calls if together and "nouns" in call.other]
        verbs = self.book.sentences.get("log")
        parts = [self._call(call, form) for call in calls if len(logged) < 2 or call not in logged]
        if verbs and len(logged) > 1:
            # "log the depth and the position"
            verb = compile_template(pick(verbs, self.rng)).render(
                {}, self.rng, "ing" if form else "base"
            )
            parts.append(f"{verb} {joined([self._call(call, 'nouns') for call in logged])}")
        last = pick(
            (", ", " and ", "; ") if form == "notes" else (" and ", " and ", ", and "), self.rng
        )
        return joined(parts, last)

    def _call(self, call: Call, form: str) -> str:
        self.mentioned += 1
        call.order = self.mentioned
        if form == "notes":
            form = "with"
        if form in call.other:
            return call.other[form].render(self.rng)
        return call.saying.render(self.rng, "ing" if form == "ing" else "base")

    # ------------------------------------------------------------ several movements

    def _several(self, script: Script, table: str) -> tuple[str, str]:
        movements, later = script.movements, []
        local: list[list[Call]] = [[] for _ in movements]
        for run in script.runs:
            if len(run.steps) == 1 and self.chance(LOCAL):
                local[min(run.steps)].append(run.call)
            else:
                later.append(run)
        places = [_place(movement) for movement in movements]
        names, weights = [], []
        for name, frame in TABLES[table].items():
            if (
                frame.get("count", len(movements)) == len(movements)
                and not (frame.get("plain") and any(local))
                and not (frame.get("legs") and not all(places))
                and not (frame.get("after_goto") and movements[0].kind != "goto")
            ):
                names.append(name)
                weights.append(frame["weight"])
        name = self.rng.choices(names, weights)[0]
        scopes = Scopes(movements, self.book, self.rng, numbered=name == "numbered")
        marked = any(local) or any(len(run.steps) < len(movements) for run in later)
        front = [run for run in later if name != "numbered" and self.chance(0.15)]
        back = [run for run in later if run not in front]
        ahead = self._scoped(front, scopes, marked)
        body = self._body(TABLES[table][name], movements, local, places)
        return name, ". ".join([*ahead, body, *self._scoped(back, scopes, marked)])

    def _body(
        self,
        frame: dict[str, Any],
        movements: list[Movement],
        local: list[list[Call]],
        places: list[str],
    ) -> str:
        """All movements in one of the frame's styles."""
        first, *middle, last = pick(frame["styles"], self.rng)
        count = len(movements)
        texts = [first, *([*middle, last][0] for _ in range(count - 2)), last]
        same = (
            len({SCOPES["groups"].get(movement.kind, movement.kind) for movement in movements}) == 1
        )
        unit = pick(("step", "part", "stage", "phase"), self.rng)
        if same and movements[0].kind in ("goto", "hold", "drift") and self.chance(0.7):
            unit = {"goto": "leg"}.get(movements[0].kind, movements[0].kind)
        said = []
        order = range(count)
        for number, place in enumerate(reversed(order) if frame.get("backwards") else order, 1):
            ends = number == count and count > 1 and self.chance(0.3)
            constants = {
                "_n": str(number),
                "_nth": "last" if ends else ORDINALS[number - 1],
                "_number": in_words(number),
                "_count": in_words(count),
                "_unit": unit,
                "place": places[place],
            }
            makers = {"clause": partial(self._clause, movements[place], local[place])}
            text = compile_template(texts[number - 1]).render(_Words(makers, constants), self.rng)
            said.append(text)
        return "".join(said)

    def _clause(self, movement: Movement, calls: list[Call], form: str) -> str:
        return self._frame(f"clause_{form}" if form else "clause", movement, calls)[1]

    def _scoped(self, runs: Sequence[Run], scopes: Scopes, marked: bool) -> list[str]:
        """A sentence for each set of steps in which something runs; skills of one set share it now
        and then. `marked`: it must be said that a skill runs everywhere, since others do not.
        """
        sets: dict[frozenset[int], list[Call]] = {}
        for run in runs:
            sets.setdefault(run.steps, []).append(run.call)
        said = []
        for steps, calls in sets.items():
            for group in [calls] if self.chance(0.65) else [[call] for call in calls]:
                makers, can = {"data": partial(self.calls, group)}, _forms("data", group)
                where = scopes.alone(steps) if marked or self.chance(0.5) else ""
                if where:
                    can |= {"where_last"} if "," in where else {"where", "where_last"}
                words = {"where": where, "where_last": where}
                table = "scope" if where else "everywhere"
                said.append(self._draw(table, can, makers, words)[1])
        return said


def _forms(group: str, calls: Sequence[Call]) -> set[str]:
    """The slots in which these skills can be said."""
    if not calls:
        return set()
    forms = {group, *(f"{group}_{form}" for form in ("ing", "each", "notes", "notes_each"))}
    for form in ("with", "passive"):
        if all(form in call.other for call in calls):
            forms.add(f"{group}_{form}")
    return forms


def _place(movement: Movement) -> str:
    """Where a movement to one stated place goes, as it is said; empty for another movement, or one
    that says more than the place.
    """
    slots = movement.saying.slots if movement.saying else None
    if slots is None or movement.kind != "goto":
        return ""
    return slots.get("xy", "") if {name.rstrip(MARKS) for name in slots.given} == {"xy"} else ""


def sentences(text: str) -> str:
    """The text with capitals where its sentences begin and a full stop; a value at the beginning
    keeps its case.
    """
    text = ". ".join(_capital(part) for part in text.split(". "))
    return text if text[-1] in ".!?" else f"{text}."


def _capital(text: str) -> str:
    if text[:1] == VALUE_OPEN and text[1:].startswith(("the ", "a ", "an ")):
        return text[0] + text[1].upper() + text[2:]
    return text[:1].upper() + text[1:]


class Scopes:
    """Words for sets of movements of one prompt: "in both holds", "on the last leg only", "in steps
    1 and 3", "throughout"; `numbered`: the prompt numbers them.
    """

    def __init__(
        self,
        movements: Sequence[Movement],
        book: Phrasebook,
        rng: random.Random,
        *,
        numbered: bool = False,
    ) -> None:
        self.movements, self.book, self.rng, self.numbered = movements, book, rng, numbered
        self.groups = [SCOPES["groups"].get(item.kind, item.kind) for item in movements]
        single = all(len(movement.steps) == 1 for movement in movements)
        self.parts = ("step", "part", "stage") if single else ("part", "stage")

    def alone(self, chosen: frozenset[int]) -> str:
        """Where the skill runs, now and then with a word that it runs nowhere else: "only in the
        second step", "on the first leg, not on the second".
        """
        text, others = self.words(chosen), frozenset(range(len(self.movements))) - chosen
        open_ended = any(word in text for word in (" but ", " except ", " every ", " each "))
        roll = self.rng.random()
        if not others or open_ended or roll > 0.5:
            return text
        if roll < 0.25:
            alone = ("only", "only", "alone") if len(chosen) == 1 else ("only",)
            return f"{text} {pick(alone, self.rng)}"
        if roll < 0.37 or len(others) > 1:
            return f"only {text}"
        return f"{text}{pick((', not ', ' but not ', ', and not '), self.rng)}{self.words(others)}"

    def words(self, chosen: frozenset[int]) -> str:
        """Where the skill runs, as an adverb: "in the second step", "throughout"."""
        if len(chosen) == len(self.movements):
            options = self._everywhere()
        else:
            options = self._by_group(chosen)
            if not options or self.rng.random() < 0.45:
                options = self._by_number(chosen)
        return str(pick(options, self.rng))

    def _everywhere(self) -> list[str]:
        count = len(self.movements)
        every = "both" if count == 2 else f"all {in_words(count)}"
        legs = SCOPES["on_legs"] * 2 if set(self.groups) == {"leg"} else []
        return [*SCOPES["always"], f"in {every} {pick(self.parts, self.rng)}s", *legs]

    def _by_number(self, chosen: frozenset[int]) -> list[str]:
        """ "in the second step", "in steps 1 and 3", "in all steps but the second"."""
        part, count, places = pick(self.parts, self.rng), len(self.movements), sorted(chosen)
        several = "s" if len(places) > 1 else ""
        options = [f"in {self._nth(places, count)} {part}{pick((several, ''), self.rng)}"]
        if self.numbered:
            numbers = joined([str(place + 1) for place in places])
            return [f"{at} step{several} {numbers}" for at in ("in", "in", "during")] + options
        if len(places) == 1:
            options += [f"{at} {self._nth(places, count)} {part}" for at in ("during", "for")]
        elif count - len(places) == 1:
            other = self._nth([place for place in range(count) if place not in chosen], count)
            options += [f"in all {part}s but {other}", f"in every {part} except {other}"]
        return options

    def _by_group(self, chosen: frozenset[int]) -> list[str]:
        """ "in both holds", "on the last leg", "during the drift": where all of the chosen are of
        one group.
        """
        group = self.groups[min(chosen)]
        same = [place for place, other in enumerate(self.groups) if other == group]
        if not chosen <= set(same) or group not in SCOPES["meant"]:
            return []
        # "while waiting" could mean a hold as well, "the second leg" one of a movement of several.
        lengths = [len(self.movements[place].steps) for place in same]
        if (group == "wait" and "hold" in self.groups) or (len(same) > 1 and max(lengths) > 1):
            return []
        on = "on" if group in SCOPES["places"] else pick(("in", "during"), self.rng)
        if len(chosen) < len(same):
            named = self._nth([same.index(place) for place in sorted(chosen)], len(same))
            plural = pick((f"{group}s", group), self.rng) if len(chosen) > 1 else group
            return [f"{on} {named} {plural}"]
        meant: list[str] = SCOPES["meant"][group]
        if len(chosen) == 1:
            return [*self._during(self.movements[same[0]]) * 2, f"{on} the {group}", *meant]
        count = "both" if len(chosen) == 2 else f"all {in_words(len(chosen))}"
        return [f"{on} {which}" for which in (f"{count} {group}s", f"each {group}")] + meant

    def _during(self, movement: Movement) -> list[str]:
        if movement.saying is None or len(movement.steps) > 1:
            return []
        slots = movement.saying.slots
        templates = self.book.skills[movement.steps[0][0]].during
        fitting = [template for template in templates if template.needed <= slots.given]
        return [pick(fitting, self.rng).render(slots, self.rng)] if fitting else []

    def _nth(self, places: Sequence[int], count: int) -> str:
        """ "the second", "the first and third"; the last one is named so now and then."""
        names = [
            "last" if place == count - 1 > 0 and self.rng.random() < 0.4 else ORDINALS[place]
            for place in places
        ]
        return f"the {joined(names)}"
