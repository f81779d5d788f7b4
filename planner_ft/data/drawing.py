"""One command in the making: what it speaks of, what it says, and what is planned for it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data import targets
from planner_ft.data.mission_binding import CLAUSE, IT, OBJECTS, Bound
from planner_ft.data.mission_plan import Intent
from planner_ft.data.numbers import WRITTEN, Value, digits, pick, position
from planner_ft.data.targets import HOME, UNPLACED, Target, is_formula, operands, worked_out
from planner_ft.data.templates import grammar, render
from planner_ft.data.templates.grammar import Argument, Call, Nodes, Slot, Step, base_of, fail
from planner_ft.data.templates.render import PIECE
from planner_ft.facts.geometry import Point, tidy
from planner_ft.vocabulary.limits import written

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

LOCATED, SOUGHT = 0.5, 0.12
"""Shares of targets said with a position, and of those that the command looks for."""
DOUBTFUL, FITTING = 0.04, 0.6
"""Shares of doubtful positions, and of the spacings that divide the width."""
LANES = 12
AT_HOME = frozenset(("x0", "y0"))
BARE = 0.5
"""Share of the sizes before another size that are said without a unit."""
JOINTS, METRES = (" by ", " x ", "x", " times "), ("m", "metres", "meters")


class Drawing(render.Drawing):
    """A wording of a command or a clause, with its targets by slot; `it` is the target that a
    clause may take up again.
    """

    def __init__(
        self, sampler: MissionSampler, bound: Bound, rng: Random, it: Target | None = None
    ) -> None:
        self.sampler, self.bound, self.template, self.it = sampler, bound, bound.template, it
        self.words, self.vocabulary = sampler.words, sampler.vocabulary
        self.targets: dict[str, Target] = {}
        self.alike: list[Target] = []
        self.clauses: dict[str, Drawing] = {}
        roll = rng.random()
        self.form = None if roll > 0.85 else WRITTEN[0] if roll < 0.3 else pick(WRITTEN, rng)
        super().__init__(self.template.nodes, bound.draws, rng)
        self.tasks = [step for step in bound.tasks if self.is_chosen(step.call)]
        self.slots.sort(key=_turn)
        for slot in self.slots:
            if slot.key not in self.targets and slot.key not in self.values:
                self._draw(slot)
        self._agree()
        for key in (key for step in self.tasks for key in step.call.of("object")):
            if is_formula(key) and operands(key) <= self.said:
                self.targets[key] = Target(key, position=worked_out(key, self._worth))

    def is_chosen(self, call: Call) -> bool:
        """Whether the alternative of the text that a call belongs to was chosen."""
        return not call.label or call.label in self.labels or call.label in self.said

    # ------------------------------------------------------------ what is spoken of

    def _draw(self, slot: Slot) -> None:
        key = slot.key
        if slot.base == "P":
            doubtful = any(key in step.call.of("near") for step in self.tasks)
            if options := self.asked(key):
                known = {target.position for target in self.targets.values()}
                there = targets.place_beside(options, self._worth, known, self.rng)
            else:
                there = self._point(*self.bound.corners.get(key, ()))
            self.targets[key] = Target(key, position=there, doubtful=doubtful)
        elif slot.base == "T":
            self.targets[key] = self._target(slot)
        elif slot.base == "ID":
            name, place = self.words.noun("identity", self.rng), self._bound_place(key)
            self.targets[key] = Target(key, identity=name.value, text=name.text, position=place)
        elif slot.base == IT and self.it is not None:
            self.targets[key] = self.it
        elif slot.base not in (CLAUSE, IT):
            others = (
                value.value for one, value in self.values.items() if base_of(one) == slot.base
            )
            taken = [*others] if slot.base in self.words else []
            self.values[key] = self.new(key, taken, self.asked(key))

    def _point(self, corner: str = "", ways: Sequence[tuple[int, int]] = ()) -> Point:
        """A position; the one opposite a corner that is said before, where one is given."""
        known = [target.position for target in self.targets.values() if target.position]
        start = self._place_of(corner) if corner in self.targets else None
        return targets.draw_place(known, self.vocabulary, self.rng, start, ways)

    def _worth(self, key: str) -> Any:
        """The position or the number of a slot."""
        if key == HOME:
            return self.vocabulary.home
        return self._place_of(key) if key in self.targets else self.values[key].value

    def _place_of(self, key: str) -> Point:
        return self.targets[key].position or (0, 0)

    def _bound_place(self, key: str) -> Point | None:
        place = self.targets.get(self.bound.places.get(key, ""))
        return place.position if place else None

    def _target(self, slot: Slot) -> Target:
        key, rng = slot.key, self.rng
        mentions = [
            (part.options, self._owns(number))
            for number, part in enumerate(self.parts)
            if isinstance(part, Slot) and part.key == key and not part.sign
        ]
        own = [step.call for step in self.tasks if key in step.call.of("object")]
        common = any("a" in options for options, _owns in mentions)
        fixed = common or any("bare" in options or owns for options, owns in mentions)
        kind = self.bound.kinds.get(key, self.sampler.default)
        near = next((near for call in own for near in call.of("near")), "")
        if kind == "pair":
            self.alike = self.alike or targets.alike(self.words, rng)
            target = replace(self.alike[int(key[1:]) - 1], key=key)
        else:
            target = targets.described(key, kind, self.words, rng, fixed=fixed, common=common)
        if key in self.bound.places:
            target = replace(target, position=self._bound_place(key))
        elif not near and kind != "pair" and self._is_located(mentions, own):
            doubt = rng.random() < DOUBTFUL
            target = replace(target, position=self._point(), doubtful=doubt)
        if near in self.targets:
            target = replace(target, whereabouts=f"near {written(self._place_of(near))}")
        spot = any(self.vocabulary.task[call.name].docks for call in own)
        return replace(target, spot=spot, on_site=any(call.of("here") for call in own))

    def _is_located(
        self, mentions: Sequence[tuple[frozenset[str], bool]], own: Sequence[Call]
    ) -> bool:
        """Whether the command gives a position with the target: where a mention can carry it."""
        first = next((mention for mention in mentions if "bare" not in mention[0]), None)
        every: frozenset[str] = frozenset().union(*(options for options, _owns in mentions))
        if "lost" in every or first is None or first[0] & UNPLACED or first[1]:
            return False
        sought = any(call.name == self.vocabulary.locate for call in own)
        return "located" in every or self.rng.random() < (SOUGHT if sought else LOCATED)

    def _agree(self) -> None:
        """A series of readings has room for two; mostly, lines fit the width of their grid."""
        values = self.values
        for call in (step.call for step in self.tasks):
            slot = {one.name: str(one.value) for one in call.arguments if one.value in values}
            if {"interval", "duration"} <= slot.keys():
                every, whole = slot["interval"], slot["duration"]
                for _ in range(50):
                    if 2 * values[every].value <= values[whole].value:
                        break
                    values[every], values[whole] = self.new(every), self.new(whole)
            if {"width", "spacing"} <= slot.keys() and self.rng.random() < FITTING:
                width, lane = values[slot["width"]].value, slot["spacing"]
                for _ in range(20):
                    if any(values[lane].value * count == width for count in range(2, LANES)):
                        break
                    values[lane] = self.new(lane)

    def _owns(self, number: int) -> bool:
        """Whether an apostrophe follows the part: "the barge's"."""
        after = self.parts[number + 1] if number + 1 < len(self.parts) else ""
        return isinstance(after, str) and after.startswith(("'s", "’s"))

    # ------------------------------------------------------------ text

    def pieces(self) -> Iterator[PIECE]:
        """The text in pieces; a value that stands twice is said twice in the same way."""
        self.wrong = {slot.key: self._wrong(slot) for slot in self.slots if slot.sign == "~"}
        self.seen = dict[tuple[str, frozenset[str]], str]()
        self.placed = set(self.bound.places)
        return super().pieces()

    def spoken(self, slot: Slot, place: int) -> Iterator[PIECE]:
        """A value, a clause or a target, whose position the first mention that can carries."""
        key = slot.key, slot.options
        if slot.sign:
            yield from self.wrong[slot.key] if slot.sign == "~" else ()
        elif slot.base == CLAUSE:
            yield from self.clauses[slot.key].pieces() if slot.key in self.clauses else ()
        elif slot.base == "T":
            unplaced = slot.options & (UNPLACED | {"bare"}) or self._owns(place)
            with_place = not unplaced and slot.key not in self.placed
            if with_place or "a" in slot.options:
                self.placed.add(slot.key)
            yield from self.targets[slot.key].mention(
                slot.options, self.rng, self.form, with_place=with_place
            )
        elif slot.base == IT:
            yield "it", False
        else:
            if key not in self.seen:
                self.seen[key] = self._word(slot, place)
            yield self.seen[key], True

    def _word(self, slot: Slot, number: int) -> str:
        if slot.base == "P":
            return position(self._place_of(slot.key), self.rng, self.form).text
        if slot.base == "ID":
            return self.targets[slot.key].text
        value, (joint, after) = self.values[slot.key], (*self.parts[number + 1 :], "", "")[:2]
        if joint in JOINTS and isinstance(after, Slot) and self.rng.random() < BARE:
            # "20 by 80 ft" says that the 20 are feet.
            sizes = [one for one in (slot, after) if one.base in ("width", "length")]
            texts = [self.values[one.key].text for one in sizes if not one.options and not one.sign]
            metric = [text.endswith(METRES) and not text.endswith("km") for text in texts]
            if metric == [True, True]:
                return digits(value.value)
        return self._worded(value, slot)

    def _worded(self, value: Value, slot: Slot) -> str:
        if "figure" in slot.options:
            return digits(value.value)
        text = value.worded(slot.options)
        return str(value.value) if text == value.text and slot.base in self.words else text

    def _wrong(self, slot: Slot) -> list[PIECE]:
        """What is taken back: of the same kind, and another one."""
        key, rng = slot.key, self.rng
        if slot.base == "P":
            right, other = self._place_of(key), self._point()
            near = (right[0], other[1]) if rng.random() < 0.5 else other
            wrong = near if near != right else other
            return [(position(wrong, rng, self.form).text, True)]
        if slot.base == "T":
            kind = self.bound.kinds.get(key, "pair")
            kind = self.sampler.default if kind == "pair" else kind
            fixed = bool(slot.options)
            target = targets.described(key, kind, self.words, rng, fixed=fixed, common=True)
            return target.mention(slot.options, rng, self.form)
        if slot.base == "ID":
            return [(self.words.noun("identity", rng).text, True)]
        value = self.new(key, [self.values[key].value], slot.options & {"adj"})
        return [(self._worded(value, slot), True)]

    # ------------------------------------------------------------ plan

    def remarks(self) -> list[list[str]]:
        """The template's own constraints, and its assumptions, as the plan holds them."""
        texts = ([self._filled(nodes) for nodes in group] for group in self.template.remarks)
        return [[f"{one[0].upper()}{one[1:].rstrip('.')}." for one in group] for group in texts]

    def intent(self, step: Step, number: int = 0) -> Intent:
        """What is asked for by a task of the plan; `number` tells the targets of the templates of a
        command apart.
        """
        call = step.call
        if call.name == HOME:
            return Intent(self.vocabulary.task[self.vocabulary.transit], home=True)
        task = self.vocabulary.task[call.name]
        rank = {kind: place for place, kind in enumerate(OBJECTS)}
        said = (key for key in call.of("object") if base_of(key) != "P" or key in self.said)
        key = min(said, key=lambda one: rank.get(base_of(one), 0), default=None)
        if key and key not in self.targets:
            fail(f"{task.title} needs {{{key}}}, which one alternative lacks")
        target = self.targets[key] if key else None
        for spot in call.of("spot"):
            target = Target(f"spot {spot}", spot, text=spot, spot=True)
        if number and target:
            target = replace(target, key=f"{number}{target.key}")
        part = "".join(self._filled(grammar.parse_text(text)) for text in call.of("part"))
        found: dict[str, Any] = {}
        for one in call.arguments:
            value = self._value(one) if one.kind in ("slot", "literal") else None
            if value is not None and task.by_name[one.name].type == "texts":
                found.setdefault(one.name, []).append(value)
            elif value is not None:
                found.setdefault(one.name, value)
        parameters = {name: found[name] for name in task.by_name if name in found}
        return Intent(task, target, parameters, part=part)

    def _value(self, argument: Argument) -> Any:
        """The value of a parameter; None where the text does not say it."""
        key = str(argument.value)
        if argument.kind == "literal":
            return argument.value
        if is_formula(key):
            return worked_out(key, self._worth) if operands(key) <= self.said else None
        if target := self.targets.get(key):
            return target.identity or target.description
        return self.values[key].value if key in self.said else None

    def given(self, call: Call) -> dict[str, Any]:
        """The values of a limit or demand by name; a target gives object and position."""
        found: dict[str, Any] = {}
        for argument in call.arguments:
            key, slot = str(argument.value), argument.kind == "slot"
            if slot and (target := self.targets.get(key)):
                found["object"] = target.identity or (target.description and target.name)
                if target.position is not None:
                    found["position"] = [tidy(number) for number in target.position]
            elif slot and key in self.values:
                value, name = self.values[key], argument.name or base_of(key)
                found[name] = value.text if name == "time" else value.value
            else:
                literal = argument.value
                found[argument.name] = tidy(literal) if isinstance(literal, float) else literal
        return found

    def _filled(self, nodes: Nodes) -> str:
        """A text of the plan with what its slots stand for."""
        parts = grammar.choose(nodes, self.rng, [])
        return "".join(part if isinstance(part, str) else self._named(part) for part in parts)

    def _named(self, slot: Slot) -> str:
        if target := self.targets.get(slot.key):
            return written(self._place_of(slot.key)) if slot.base == "P" else target.name
        if value := self.values.get(slot.key):
            return str(value.value) if slot.base in self.words else value.text
        return fail(f"a remark needs {{{slot.key}}}, which one alternative lacks")


def _turn(slot: Slot) -> tuple[int, str]:
    """Places come first; those beside others follow these, by number."""
    if slot.base != "P":
        return 2, ""
    return (1, slot.key) if slot.options - AT_HOME else (0, "")
