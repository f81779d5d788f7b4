"""Putting a script into words with the sentence frames of frames.toml.

Every part of the script is said once, in the order in which it is mentioned.
"""

from __future__ import annotations

import functools
import random
import tomllib
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from planner_ft.data.numbers import in_words, pick
from planner_ft.data.task.context import Call, Context, Movement
from planner_ft.data.task.phrase import Given, Phrase, parse_phrase, parse_phrases
from planner_ft.data.task.phrasebook import Phrasebook
from planner_ft.data.task.script import Run, Script
from planner_ft.data.wordlists import joined

TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
ORDINALS: list[str] = TABLES["ordinals"]
LOCAL = 0.5
"""Share of the skills of a single step that are said with its movement, not in a sentence of their
own.
"""

Maker = Callable[[str], str]
"""Words for a part of the script in a form ("", "ing", "with", ...)."""


@functools.cache
def _frames(table: str, given: Given) -> list[Phrase]:
    return [frame for frame in parse_phrases(TABLES[table]) if frame.fits(given)]


class _Words(dict[str, str]):
    """Slots of a frame, made when they are come to, so that the order of mention is known."""

    def __init__(self, makers: Mapping[str, Maker], constants: Mapping[str, str]) -> None:
        super().__init__(constants)
        self.makers = makers

    def __missing__(self, slot: str) -> str:
        group, _blank, form = slot.partition(" ")
        return self.makers[group](form)


class Speaker:
    """Words for a script and its parts."""

    def __init__(self, rng: random.Random, book: Phrasebook) -> None:
        self.rng, self.unseen, self.mentioned = rng, "_unseen" if book.unseen else "", 0

    def script(self, script: Script) -> tuple[str, str]:
        """The name of the frames, and the prompt with its values marked, not yet finished."""
        movement, *others = script.movements
        if others:
            return "several", self._several(script)
        name = "one" if movement.saying else "no_movement"
        data = [run.call for run in script.runs]
        filters = [run.call for run in script.runs if run.role == "filter"]
        if not filters or self.rng.random() < 0.3:
            return name, self._movement(name + self.unseen, movement, data, "")
        data = [call for call in data if call not in filters]
        if not data and not movement.saying:
            return name, self._movement(name + self.unseen, movement, filters, "")
        core = partial(self._movement, name + self.unseen, movement, data)
        makers: dict[str, Maker] = {"core": core, "filters": partial(self.calls, filters)}
        return name, self._say("filters", {"core", *_forms("filters", filters)}, makers)

    def _say(
        self,
        table: str,
        given: set[str],
        makers: Mapping[str, Maker],
        constants: Mapping[str, str] | None = None,
    ) -> str:
        """A frame of the table that says exactly what is given."""
        frame = pick(_frames(table, frozenset(given)), self.rng)
        return frame.render(_Words(makers, constants or {}), self.rng)

    def _movement(self, table: str, movement: Movement, data: Sequence[Call], _form: str) -> str:
        """A movement with what runs beside it."""
        saying, given = movement.saying, _forms("data", data)
        makers: dict[str, Maker] = {"data": partial(self.calls, data)}
        if saying is not None:
            given |= {"move", "move ing"}
            makers["move"] = lambda form: saying.render(self.rng, ing=form == "ing")
        return self._say(table, given, makers)

    def calls(self, calls: Sequence[Call], form: str) -> str:
        """Several skills in a form: "record the sonar, log the depth and take a fix"."""
        if form == "each":
            return ". ".join(self._call(call, "") for call in calls)
        last = pick((" and ", " and ", ", and "), self.rng)
        return joined([self._call(call, form) for call in calls], last)

    def _call(self, call: Call, form: str) -> str:
        self.mentioned += 1
        call.order = self.mentioned
        return call.other.get(form, call.saying).render(self.rng, ing=form == "ing")

    def _several(self, script: Script) -> str:
        movements, later = script.movements, []
        local: list[list[Call]] = [[] for _ in movements]
        for run in script.runs:
            if len(run.steps) == 1 and self.rng.random() < LOCAL:
                local[min(run.steps)].append(run.call)
            else:
                later.append(run)
        first, middle, last = pick(TABLES[f"several{self.unseen}"], self.rng)
        scopes = Scopes(movements, self.rng, numbered="{n}" in first)
        marked = any(local) or any(len(run.steps) < len(movements) for run in later)
        count, body, ahead = len(movements), "", ""
        if later and not scopes.numbered and self.rng.random() < 0.15:
            ahead = f"{self._scoped(later[:1], scopes, marked)[0]}. "
            later = later[1:]
        for place, text in enumerate((first, *[middle] * (count - 2), last)):
            constants = {
                "n": str(place + 1),
                "nth": scopes.nth([place]),
                "number": in_words(place + 1),
            }
            makers: dict[str, Maker] = {
                "clause": partial(self._clause, movements[place], local[place])
            }
            body += parse_phrase(text).render(_Words(makers, constants), self.rng)
        return ahead + ". ".join([body, *self._scoped(later, scopes, marked)])

    def _clause(self, movement: Movement, data: Sequence[Call], form: str) -> str:
        return self._movement(f"clause_{form}" if form else "clause", movement, data, "")

    def _scoped(self, runs: Sequence[Run], scopes: Scopes, marked: bool) -> list[str]:
        """A sentence for each set of steps in which something runs. `marked`: a skill that runs
        everywhere needs words for it, since others do not.
        """
        sets: dict[frozenset[int], list[Call]] = {}
        for run in runs:
            sets.setdefault(run.steps, []).append(run.call)
        sentences = []
        for steps, calls in sets.items():
            makers, given = {"data": partial(self.calls, calls)}, _forms("data", calls)
            if marked or self.rng.random() < 0.5:
                where = {"where": scopes.words(steps)}
                sentences.append(self._say("scope", {*given, "where"}, makers, where))
            else:
                sentences.append(self._say("everywhere", given, makers))
        return sentences


def _forms(group: str, calls: Sequence[Call]) -> set[str]:
    """The slots in which these skills can be said."""
    forms = [form for form in ("with", "passive") if all(form in call.other for call in calls)]
    return {group, *(f"{group} {form}" for form in ("ing", "each", *forms))} if calls else set()


class Scopes:
    """Words for sets of movements of one prompt: "in the second step only", "in steps 1 and 3",
    "throughout"; `numbered`: the prompt numbers them.
    """

    def __init__(
        self, movements: Sequence[Movement], rng: random.Random, *, numbered: bool = False
    ) -> None:
        self.count, self.rng, self.numbered = len(movements), rng, numbered
        self.part = "step" if all(len(one.steps) == 1 for one in movements) else "part"

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
        return joined(["last" if place == last else ORDINALS[place] for place in places])


def opened(text: str, c: Context) -> str:
    """The prompt with a full stop, now and then behind polite words or the task's opener."""
    command = text.partition(" ")[0] in c.book.verbs
    text = text if text[-1] in ".!?" else f"{text}."
    if c.book.unseen or not command or c.rng.random() < 0.85:
        return text
    own = c.entry.openers if c.rng.random() < 0.7 else []
    return f"{pick(own or TABLES['openers'], c.rng)} {text}"


def with_aside(text: str, skills: set[str], c: Context) -> str:
    """The prompt, now and then with words that change nothing: background, a reason, a refusal."""
    book, rng, known, roll = c.book, c.rng, c.book.sentences, c.rng.random()
    if roll < 0.03 and "background" in known:
        remark = book.say(pick(known["background"], rng), rng)
        return pick((f"{text} {remark}", f"{remark} {text}"), rng)
    if roll < 0.05 and "reason" in known:
        return f"{text[:-1]} {book.say(pick(known['reason'], rng), rng)}."
    if roll < 0.075 and "nothing" in known and not book.unseen:
        return f"{text} {pick(known['nothing'], rng)}"
    if roll < 0.115 and not book.unseen:
        refused = [entry.none for name, entry in book.skills.items() if name not in skills]
        if phrases := [phrase for of_skill in refused for phrase in of_skill]:
            phrase = pick(phrases, rng)
            return pick((f"{text} {phrase}.", f"{text[:-1]}, {phrase}."), rng)
    elif roll < 0.14 and "negation" in known:
        idle = [name for name in c.task.skills.get("perception", ()) if name not in skills]
        entries = [book.skills[name] for name in idle]
        bare = [entry.fitting(frozenset()) for entry in entries]
        bare = [found for found, entry in zip(bare, entries, strict=True) if found != entry.generic]
        if bare:
            refusal = pick(pick(bare, rng), rng).render(c.slots(), rng)
            return f"{text} {pick(known['negation'], rng).format(refusal)}"
    return text
