"""Commands of one or two templates with clauses of limits and demands in different places."""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from operator import itemgetter
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.drawing import Drawing
from planner_ft.data.mission_binding import CLAUSE, bind
from planner_ft.data.mission_plan import Beside, Effect, Intent, effect_of, label
from planner_ft.data.numbers import pick
from planner_ft.data.targets import Target
from planner_ft.data.templates.grammar import is_small
from planner_ft.data.templates.records import FORMS, Template
from planner_ft.data.templates.render import PIECE, joined

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

TRIES, MANY = 12, 6
DEMANDED = 0.5
"""Share of demands for data among the clauses; the others are limits."""
OPPOSED = {"no_recording", "SetStreamRecording"}, {"no_recording", "CaptureGeoSnapshot"}
BUT = (", but ", ", but ", " but ", ", and ", "; ", " and ", ", ")
BEHIND = (", ", ", ", " ", " - ", " (")
FIRST, FRONT, BODY, LAST = range(4)
"""Where a clause stands: before the whole, before or in one of the bodies, behind the whole."""
THEN = ("", "", "Then ", "After that, ", "Next: ", "And then ")
Clauses = tuple[list[Template], list[Template]]
"""Records of demands, and those of limits."""


class Command:
    """A command composed of templates: its `text` with the values marked, its plan `expected`, and
    by task the skills that its clauses put `beside` it; `clauses` counts them, which are fewer than
    asked for where none fits.
    """

    def __init__(
        self,
        sampler: MissionSampler,
        templates: Sequence[Template],
        rng: Random,
        records: Clauses,
        clauses: int,
    ) -> None:
        self.sampler, self.rng, self.records = sampler, rng, records
        self.drawings = [Drawing(sampler, bind(one, sampler), rng) for one in templates]
        self.asked = [
            [(step, drawing.intent(step, number)) for step in drawing.tasks]
            for number, drawing in enumerate(self.drawings)
        ]
        intents = (intent for _step, intent in itertools.chain(*self.asked))
        self.planned = label(intents, sampler.vocabulary)
        self.before, self.after = list[PIECE](), list[PIECE]()
        self.effects: list[tuple[int, int, Effect]] = []
        self._own_demands()
        own = len(self.effects)
        self._fill_slots()
        self.bodies = [list(drawing.pieces()) for drawing in self.drawings]
        for _ in range(clauses if len(self.planned) <= MANY else min(clauses, 1)):
            self._add(pick(range(len(self.drawings)), self.rng))
        self.text, self.clauses = self._text(), len(self.effects) - own
        self.expected, self.beside = self._plan()

    # ------------------------------------------------------------ clauses

    def _own_demands(self) -> None:
        """What the templates themselves ask for beside their tasks."""
        for number, drawing in enumerate(self.drawings):
            for step, intent in self.asked[number]:
                places = self._covered([intent], inserted=False)
                for call in filter(drawing.is_chosen, step.perceptions):
                    effect = Effect(self.sampler, self.planned)
                    effect.demand(call.name, drawing.given(call), places)
                    self.effects.append((BODY, number, effect))
            for call in filter(drawing.is_chosen, drawing.bound.limits):
                effect, given = Effect(self.sampler, self.planned), drawing.given(call)
                titles = str(given.pop("of", "")).split()
                named = [at for at, one in enumerate(self.planned) if one.task.title in titles]
                given |= {"scope": "task"} if titles else {}
                effect.limit(call.name, given, named)
                self.effects.append((BODY, number, effect))

    def _fill_slots(self) -> None:
        for number, drawing in enumerate(self.drawings):
            for slot in (slot for slot in drawing.slots if slot.base == CLAUSE):
                asked = self.asked[number]
                own = [intent for step, intent in asked if slot.key in step.call.of("clause")]
                if found := self._clause(own, (slot.kind,), alone=True):
                    drawing.clauses[slot.key], effect = found
                    self.effects.append((BODY, number, effect))

    def _covered(self, intents: Sequence[Intent], *, inserted: bool = True) -> list[int]:
        """The places in the plan of the tasks of intents."""
        return [
            place
            for place, item in enumerate(self.planned)
            if any(item.intent is one for one in intents) and (inserted or not item.inserted)
        ]

    def _clause(
        self, intents: Sequence[Intent], forms: Sequence[str], *, alone: bool
    ) -> tuple[Drawing, Effect] | None:
        """A clause of one of these forms that fits what was asked for, and what it adds."""
        covered = set(self._covered(intents))
        it = _target(intents)
        for _ in range(TRIES):
            group = self.records[self.rng.random() >= DEMANDED]
            fitting = [template for template in group if template.form in forms]
            if not fitting:
                continue
            template = pick(fitting, self.rng)
            if "{it}" in template.text and (it is None or _open_stand_off(intents)):
                continue
            bound = bind(template, self.sampler)
            clause = Drawing(self.sampler, bound, self.rng, it)
            effect = effect_of(clause, self.planned, covered, alone=alone)
            if effect and not self._clashes(effect):
                return clause, effect
        return None

    def _clashes(self, effect: Effect) -> bool:
        """Whether an earlier clause is about the same, or the opposite."""
        taken = set[str]().union(*(earlier.about for _at, _number, earlier in self.effects))
        opposed = any(taken | effect.about >= pair for pair in OPPOSED)
        return opposed or bool(taken & effect.about)

    def _add(self, number: int) -> None:
        """A clause at the end of one of the bodies, or before or behind the whole."""
        rng, asked = self.rng, [one for _step, one in self.asked[number] if not one.home]
        if (found := self._clause(asked, FORMS, alone=len(asked) == 1)) is None:
            return
        clause, effect = found
        pieces, form, roll, at = list(clause.pieces()), clause.template.form, rng.random(), BODY
        if form == "order" and roll < 0.5:
            self._attach(number, pick(BUT, rng), pieces)
        elif form == "phrase" and (roll < 0.85 or number):
            self._attach(number, pick(BEHIND, rng), pieces)
        elif form == "phrase":
            at = FRONT
            self.bodies[number] = [*pieces, (", ", False), *_lowered(self.bodies[number])]
        elif roll < 0.72 and number == len(self.bodies) - 1:
            at = LAST
            self.after += [(" ", False), *pieces, (".", False)]
        elif number == 0:
            at = FIRST
            self.before += [*pieces, (pick((". ", ". ", ". ", ": "), rng), False)]
        else:
            self._attach(number, ". ", pieces)
        self.effects.append((at, number, effect))

    def _attach(self, number: int, joint: str, pieces: list[PIECE]) -> None:
        body, mark = _open(self.bodies[number])
        closing = ")" if joint.endswith("(") else ""
        self.bodies[number] = [*body, (joint, False), *pieces, (closing + mark, False)]

    # ------------------------------------------------------------ text and plan

    def _text(self) -> str:
        pieces = list(self.before)
        for number, body in enumerate(self.bodies):
            if number:
                then = pick(THEN, self.rng)
                pieces = [*_open(pieces)[0], (". " + then, False)]
                body = _lowered(body) if then else body
            pieces += body
        if self.after:
            inner, mark = _open(pieces)
            pieces = [*inner, (mark or ".", False), *self.after]
        return joined(pieces, small=is_small(self.drawings[0].template.nodes) and not self.before)

    def _plan(self) -> tuple[dict[str, Any], list[list[Beside]]]:
        texts, config = self.sampler.texts, self.sampler.config
        excluded = [title for one in self.drawings for title in one.template.excluded]
        remarks = [drawing.remarks() for drawing in self.drawings]
        constraints, assumptions = (list(itertools.chain(*of)) for of in zip(*remarks, strict=True))
        notes = [*map(texts.excluded, excluded), *constraints]
        if not self.planned and excluded:
            notes.append(config.get("cancelled", "No task is left."))
        elif not self.planned and not notes:
            notes.append(config.get("nothing", "The command asks for no task."))
        effects = [effect for _at, _number, effect in sorted(self.effects, key=itemgetter(0, 1))]
        notes += [text for effect in effects for text in effect.constraints]
        expected = texts.plan(self.planned, notes, assumptions)
        beside: list[list[Beside]] = [[] for _ in self.planned]
        for effect in effects:
            for place, text, skill in effect.sentences:
                expected["tasks"][place]["task_prompt"] += f" {text}"
                if skill is not None:
                    beside[place].append(skill)
        return expected, beside


def _target(intents: Sequence[Intent]) -> Target | None:
    """The one thing that the intents are about, which a clause can call "it"."""
    found = {intent.target.key: intent.target for intent in intents if intent.target}
    things = [target for target in found.values() if target.description is not None]
    return things[0] if len(found) == 1 and things else None


def _open_stand_off(intents: Sequence[Intent]) -> bool:
    """Whether a task leaves its stand-off open, so that a distance to its target would be that."""
    return any(
        name in intent.task.by_name and name not in intent.parameters
        for intent in intents
        for name in ("radius", "distance")
    )


def _open(pieces: Sequence[PIECE]) -> tuple[list[PIECE], str]:
    """The text without its end mark, and the mark."""
    *inner, (last, value) = pieces
    bare = last if value else last.rstrip(" .?!")
    mark = last[len(bare) :].strip()[:1]
    return [*inner, (bare, value)], mark


def _lowered(pieces: Sequence[PIECE]) -> list[PIECE]:
    """The text as it stands in the middle of a sentence."""
    (first, value), *rest = pieces
    word = first.partition(" ")[0]
    plain = not value and word[1:].islower() and not word.startswith(("I'", "I’"))
    return [(first[:1].lower() + first[1:] if plain else first, value), *rest]
