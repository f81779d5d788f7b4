"""Prompts put together: clauses of the phrase file in the slots of frames.jsonl.

A clause is a phrase bound to what it stands for, a skill or a movement of several steps
(words.toml), so that it is drawn as templates are. A frame is a template with slots for clauses,
{M1} a movement, {F1} filters and {D1} perception skills, in the form that the slot asks for
(`ing`, `with`, `passive`, `each`).
"""

import functools
import itertools
import re
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.numbers import Draw, pick
from planner_ft.data.task.binding import Bound, bind
from planner_ft.data.task.draw import Context, Drawing, Drawn, steps_of
from planner_ft.data.task.phrasebook import Phrasebook, phrase_text
from planner_ft.data.task.steps import SHAPES, XY, Entry, plan_step
from planner_ft.data.templates import grammar, render
from planner_ft.data.templates.grammar import Argument, Call, Slot, Step, all_slots
from planner_ft.data.templates.records import Template, read_templates
from planner_ft.data.templates.render import PIECE, joined
from planner_ft.vocabulary.definition import Role

WORDS: dict[str, Any] = tomllib.loads(Path(__file__).with_name("words.toml").read_text("utf-8"))


def _template(book: Phrasebook, text: str, plan: str = "") -> Template:
    where = f"vocabulary {book.vocabulary.source}: phrase {text!r}"
    return Template("", "train", text, plan, where)


def _clause(
    book: Phrasebook, phrase: str, ing: bool, draws: Mapping[str, Draw], filled: str
) -> Bound:
    """A phrase without steps whose slots are called as what is `filled` with them calls them."""
    template = _template(book, phrase_text(phrase, ing=ing))
    bound = Bound(template, nodes=template.nodes, clause=True)
    for key in (slot.key for slot in all_slots(bound.nodes) if not slot.sign):
        bound.draws[key], bound.places[key] = draws[key], f"{filled}.{key}"
    return bound


@functools.cache
def skill_clause(book: Phrasebook, name: str, phrase: str, ing: bool) -> Bound:
    """The phrase for this skill."""
    entry = book.skills[name]
    bound = _clause(book, phrase, ing, {XY: book.place, **entry.draws}, name)
    bound.often = {key: entry.often.get(key, 1.0) for key in bound.draws}
    for parameter in entry.skill.parameters:
        if parameter.type == "texts":
            bound.places[parameter.name] = ""
    bound.steps = [Step(Call(name, tuple(Argument("slot", key, key) for key in bound.draws)))]
    return bound


@functools.cache
def lead_clause(book: Phrasebook, title: str, phrase: str, ing: bool) -> Bound:
    """The task in its own words ("search for the barge"), with the skill that it asks for."""
    entry = book.tasks[title]
    bound = _clause(book, phrase, ing, entry.draws, "lead")
    if skill := entry.config.get("lead_skill"):
        argument = Argument("slot", skill["from"], skill["parameter"])
        bound.steps = [Step(Call(skill["skill"], (argument,)))]
    return bound


@functools.lru_cache(maxsize=4096)
def pattern_clause(
    book: Phrasebook, title: str, pattern: str, phrase: str, ing: bool
) -> Bound | None:
    """The phrase for a movement of several steps; None where task or vehicle lack what it needs."""
    how = book.patterns.get(pattern, {}).get("how", ())
    parts = {**WORDS["parts"].get(pattern, {}), "how": ("", _one_of(how))}
    for name, texts in parts.items():
        phrase = phrase.replace(f"{{{name}}}", _one_of(texts))
    text = phrase_text(phrase, ing=ing)
    try:
        plan = WORDS["plans"][pattern].format_map(book.motions)
        steps, _slash, _each = plan.partition(" / ")
        plan = plan if "{wait" in text else steps
        # Of the arguments "name=slot", those whose slot the phrase has.
        words = ((word, word.rstrip(";").partition("=")[2]) for word in plan.split(" "))
        held = (word for word, key in words if not key or re.search(rf"{{{key}\b", text))
        template = _template(book, text, " ".join(held))
        bound = bind(template, book.vocabulary.task[title], book)
    except (KeyError, grammar.TemplateError):
        return None
    bound.clause = True
    bound.places = {key: f"{pattern}.{key}" for key in bound.places}
    return bound


def _one_of(texts: Sequence[str]) -> str:
    return f"({'|'.join(texts)})" if len(texts) > 1 else "".join(texts)


# ---------------------------------------------------------------- frames

ROLES: dict[str, Role] = {"D": "perception", "F": "filter"}
SAID = ("with", "passive")
"""Forms that not every skill has."""
STEP = "step"
"""A slot of the frames: the word for a movement that others are told apart from."""
AGAIN = 0.08
"""Share of skills that stand a second time with other parameters."""
REPEATED = 0.08
"""Share of skills with an interval in the prompt, which no skill has as a parameter."""
PAUSE = 0.45
"""Share of the sectors with a pause at each."""


@functools.cache
def frames(*, unseen: bool) -> dict[int, list[Template]]:
    """The frames, of the unseen families or of the others, by the number of their movements."""
    found: dict[int, list[Template]] = {}
    for frame in read_templates(Path(__file__).with_name("frames.jsonl"), "prompts"):
        if (frame.split == "test") == unseen:
            moves = {slot.key for slot in all_slots(frame.nodes) if slot.base == "M"}
            found.setdefault(len(moves), []).append(frame)
    return found


def composed(context: Context) -> Drawn | None:
    """A prompt for a task; None for a draw that comes to nothing."""
    prompt = _Prompt(context)
    if not prompt.fill():
        return None
    text, steps = joined(prompt.pieces()), steps_of(prompt.steps)
    name = prompt.frame.id.rpartition("-")[0].removeprefix("unseen_")
    return Drawn(f"{name}/{prompt.kind}{max(prompt.moves, 1)}", text, steps) if steps else None


def _count(shares: Sequence[float], rng: Random) -> int:
    """How many, from 1 on, where each has its share."""
    return 1 + rng.choices(range(len(shares)), shares)[0]


class _Prompt(render.Drawing):
    """A frame with the clauses that fill its slots; `kind` names its first movement."""

    def __init__(self, context: Context) -> None:
        self.context, self.rng, self.book = context, context.rng, context.book
        self.task, self.entry = context.task, context.entry
        self.clauses: dict[str, list[Drawing]] = {}
        self.kind, self.moves = "implied", 0
        self.used: set[str] = set()
        lead = self.entry.lead if self.rng.random() < 0.8 else []
        self.lead = pick(lead, self.rng) if lead else ""
        self.frame = pick(frames(unseen=self.book.unseen)[self._movements()], self.rng)
        super().__init__(self.frame.nodes, {}, self.rng)

    def _movements(self) -> int:
        """How many movements the prompt asks for; without any, the vehicle holds its place."""
        still = 0.35 if self.task.arrival == "none" and self.task.pattern == "hold" else 0.02
        hold = "hold" in self.book.motions and self.rng.random() < (0.55 if self.lead else still)
        return 0 if hold else _count(WORDS["often"]["movements"], self.rng)

    def fill(self) -> bool:
        """Draw the clauses of all slots; whether there are some for each."""
        moves = [slot.key for slot in self.slots if slot.base == "M"]
        self.moves, main = len(moves), pick(moves, self.rng) if moves else ""
        bounds: dict[str, list[Bound]] = {}
        for slot in self.slots:
            form = "".join(slot.options)
            if slot.base == "M":
                kind, clause = self._movement(form, main=slot.key == main)
                self.kind = kind if slot.key == moves[0] else self.kind
                bounds[slot.key] = [clause]
            elif slot.base in ROLES:
                bounds[slot.key] = list(self._group(slot.base, form))
        for bound in itertools.chain(*bounds.values()):
            self.context.prepare(bound)
        for key, of_slot in bounds.items():
            self.clauses[key] = [Drawing(bound, self.context) for bound in of_slot]
        return all(bounds.values())

    def spoken(self, slot: Slot, _place: int) -> Iterator[PIECE]:
        """The clauses of a slot."""
        if slot.key == STEP:
            every = (
                clause for key in self.clauses if key[0] == "M" for clause in self.clauses[key]
            )
            steps = [step for clause in every for step in clause.bound.steps]
            long = any(step.each or step.call.name in SHAPES for step in steps)
            yield "part" if long or len(steps) > self.moves else "step", False
            return
        clauses, each = self.clauses[slot.key], "each" in slot.options
        last = ". " if each else pick((" and ", " and ", ", and "), self.rng)
        for number, clause in enumerate(clauses):
            if number:
                yield last if each or number == len(clauses) - 1 else ", ", False
            yield from clause.pieces()
            if slot.base != "M":
                yield self._repeated(clause.bound), False

    def steps(self) -> list[Entry]:
        """The steps of the movements, each with the skills beside it."""
        found: list[Entry] = []
        for step in self.frame.steps:
            filters, perceptions = (
                [
                    skill
                    for call in calls
                    for clause in self.clauses.get(call.name, ())
                    for skill in clause.plan.skills()
                ]
                for calls in (step.filters, step.perceptions)
            )
            for clause in self.clauses.get(step.call.name, ()):
                found += clause.plan.steps((filters, perceptions))
            if step.call.name not in self.clauses:
                vocabulary, hold = self.book.vocabulary, self.book.motions["hold"]
                found.append(plan_step(hold, {}, filters, perceptions, vocabulary))
        return found

    def _movement(self, form: str, *, main: bool) -> tuple[str, Bound]:
        """A movement with its kind: the task's own, mostly, if `main`."""
        rng, motions, names = self.rng, self.book.motions, self.task.skills["navigation"]
        patterns, roll = WORDS["patterns"].get(self.task.pattern, {}), rng.random()
        if main and self.lead and "hold" in motions and rng.random() < 0.7:
            return self._skill(motions["hold"], form)
        for pattern, share in (patterns if main else {pick(WORDS["beside"], rng): 0.06}).items():
            if 0 <= roll < share and (found := self._pattern(pattern, form)):
                return pattern, found
            roll -= share
        if main:
            return self._skill(names[int(rng.random() ** 1.8 * len(names))], form)
        if roll < 0.29 and "goto" in motions:
            return self._skill(motions["goto"], form)
        return self._skill(pick(names if roll < 0.59 else self.book.roles["navigation"], rng), form)

    def _pattern(self, name: str, form: str) -> Bound | None:
        phrases, title = self.book.pattern(name, self.task.title), self.task.title
        phrase = pick(phrases, self.rng) if phrases else ""
        pause = self.book.patterns.get(name, {}).get("pause")
        if pause and self.rng.random() < PAUSE:
            phrase += pick(pause, self.rng)
        return pattern_clause(self.book, title, name, phrase, form == "ing") if phrase else None

    def _skill(self, name: str, form: str) -> tuple[str, Bound]:
        """A phrase for the skill in this form, at times one of the task's own."""
        entry, task = self.book.skills[name], self.entry
        phrases: Sequence[str] = entry.phrases.get(form) or entry.phrases[""]
        own: Sequence[str] = task.phrases if name == task.config.get("phrases_for") else []
        if entry.skill.motion == "goto":
            own = self.book.pattern("goto", self.task.title)
        if own and self.rng.random() < 0.6:
            phrases = own
        clause = skill_clause(self.book, name, pick(phrases, self.rng), form == "ing")
        return entry.skill.motion or name, clause

    def _group(self, base: str, form: str) -> Iterator[Bound]:
        """Skills of a role, mostly those that fit the task; its own words come first."""
        rng, book = self.rng, self.book
        count = _count(WORDS["often"][base + ("_alone" if self.moves < 2 else "")], rng)
        if self.lead and base == "D" and form not in SAID:
            for place, name in self.entry.links.items():
                if place.startswith("lead."):
                    self.context.require(name)
            yield lead_clause(book, self.task.title, self.lead, form == "ing")
            self.lead, count = "", count - 1

        every = [
            name
            for name in book.roles[ROLES[base]]
            if (form not in SAID or book.skills[name].phrases[form])
            and (name not in self.used or book.skills[name].several)
        ]
        fitting = [name for name in self.task.skills.get(ROLES[base], ()) if name in every]
        drawn = [
            pick(fitting if fitting and rng.random() < 0.85 else every, rng)
            for _ in range(count if every else 0)
        ]
        names = list(dict.fromkeys(drawn))
        again = [name for name in names if base == "D" and book.skills[name].several]
        names += [name for name in again if rng.random() < AGAIN]
        self.used.update(names)
        yield from (self._skill(name, form)[1] for name in names)

    def _repeated(self, clause: Bound) -> str:
        repeat = self.book.sentences.get("repeat")
        repeats = any(self.book.skills[step.call.name].repeats for step in clause.steps)
        if not (repeat and repeats and self.rng.random() < REPEATED):
            return ""
        return f" {self.context.say(pick(repeat, self.rng))}"
