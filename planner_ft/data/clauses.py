"""Clauses of a command, limits and demands for data: what they say and what they add to a plan.

The records stand in NAME.clauses.jsonl, the sentences of limits in NAME.limits.toml and those of
demands under [demand] in NAME.missions.toml (docs/data.md, "Clauses").
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data.drawing import Drawing
from planner_ft.data.mission_binding import IT, OBJECTS, Bound
from planner_ft.data.mission_plan import Planned, Target
from planner_ft.data.numbers import Value, digits, knots, pick, polygon, position
from planner_ft.data.task.values import draw_point, draw_polygon
from planner_ft.data.templates.grammar import Call, Slot, TemplateError, all_slots, base_of
from planner_ft.data.templates.records import Template
from planner_ft.facts.geometry import Point, point, tidy
from planner_ft.vocabulary import Parameter, Task
from planner_ft.vocabulary.limits import load_limits, prompt_sentence, sentence

if TYPE_CHECKING:
    from planner_ft.data.missions import MissionSampler

LIMIT = Task(
    title="Limit",
    category="",
    description="",
    arrival="none",
    pattern="",
    parameters=(
        Parameter("distance", "number", "m"),
        Parameter("range", "number", "m"),
        Parameter("speed", "number", "m/s"),
        Parameter("duration", "number", "s"),
        Parameter("polygon", "polygon", "m"),
    ),
)
"""What the values of limits are drawn for; [task.Limit] in NAME.missions.toml has their ranges."""
SCOPES = ("mission", "task", "way", "home")
SPOKEN_IN_KNOTS, NAMED_AGAIN, BOXED = 0.5, 0.4, 0.3
"""Shares of speeds in knots, of targets that are named and not "it", of boxes by two corners."""
CORNERS = (
    *("[{x}, {y}]",) * 4,
    *("({x}, {y})",) * 3,
    *("{x},{y}",) * 4,
    *("({x},{y})", "[{x},{y}]", "{x}/{y}", "{x} {y}", "x={x} y={y}"),
)
JOINTS = (", ", ", ", " ", " - ", "; ", " and ")
Beside = tuple[str, str, dict[str, Any]]
"""A skill that runs in the steps of a task: role, name and parameters."""


@dataclass
class Effect:
    """What a clause adds to a plan: constraints, and by the task's place a sentence of its prompt
    with the skill that it stands for. `about`: the kinds of limits and the skills in it.
    """

    about: set[str] = field(default_factory=set)
    constraints: list[str] = field(default_factory=list)
    sentences: list[tuple[int, str, Beside | None]] = field(default_factory=list)


class Clause(Drawing):
    """One clause in the making; `it` is the target that it may take up again."""

    def __init__(
        self, sampler: MissionSampler, template: Template, rng: Random, it: Target | None = None
    ) -> None:
        self.it = it
        super().__init__(sampler, _bound(template, sampler), template, rng)

    def _draw(self, slot: Slot) -> None:
        if slot.base != IT:
            super()._draw(slot)
        elif self.it is not None:
            self.targets[IT] = self.it

    def _new(self, key: str) -> Value:
        rng = self.rng
        if base_of(key) == "polygon":
            return corners(rng)
        if base_of(key) == "speed" and rng.random() < SPOKEN_IN_KNOTS:
            return knots(rng)
        return super()._new(key)

    def effect(
        self, planned: Sequence[Planned], covered: set[int], *, alone: bool
    ) -> Effect | None:
        """What the clause adds to a plan of which it covers the tasks at these places; None where
        it does not fit. `alone`: these tasks are one thing that was asked for.
        """
        effect = Effect()
        titles, own = self.template.tasks, self.own(planned, covered)
        if titles and not {planned[place].task.title for place in own} & set(titles):
            return None
        for step in self.template.steps:
            call = step.call
            if call.label and call.label not in self.labels:
                continue
            given = self._given(call)
            limited = call.name in load_limits(self.vocabulary)
            add = self._limit if limited else self._demand
            if (given.get("scope", "mission") != "mission" and not alone) or not add(
                call.name, given, planned, covered, effect
            ):
                return None
        for text in self.remarks()[0]:
            effect.constraints.append(text)
            effect.sentences += [(place, text, None) for place in moving(planned)]
        return effect

    def own(self, planned: Sequence[Planned], covered: set[int]) -> list[int]:
        """The places of the tasks that were asked for by name."""
        return [
            place
            for place in sorted(covered)
            if not planned[place].inserted and not planned[place].intent.home
        ]

    def _given(self, call: Call) -> dict[str, Any]:
        """The values of a call by name; a target gives object and position."""
        found: dict[str, Any] = {}
        for argument in call.arguments:
            key = str(argument.value)
            target = self.targets.get(key) if argument.kind == "slot" else None
            if target is not None:
                found["object"] = target.identity or (target.description and target.name)
                if target.position is not None:
                    found["position"] = [tidy(number) for number in target.position]
            elif argument.kind == "slot" and key in self.values:
                value, name = self.values[key], argument.name or base_of(key)
                found[name] = value.text if name == "time" else value.value
            else:
                literal = argument.value
                found[argument.name] = tidy(literal) if isinstance(literal, float) else literal
        return found

    def _limit(
        self,
        kind: str,
        given: dict[str, Any],
        planned: Sequence[Planned],
        _covered: set[int],
        effect: Effect,
    ) -> bool:
        limits = load_limits(self.vocabulary)
        places = moving(planned)
        effect.about.add(kind)
        effect.constraints.append(sentence(kind, given, limits))
        text, rule = prompt_sentence(kind, given, limits), limits[kind]
        values = {name: given[value] for name, value in rule.parameters.items()}
        beside = ("filter", rule.filter, values) if rule.filter else None
        if kind == "return":
            places = [place for place in places if planned[place].intent.home]
        elif kind == "duration":
            return bool(moving(planned))
        effect.sentences += [(place, text, beside) for place in places]
        return bool(moving(planned))

    def _demand(
        self,
        name: str,
        given: dict[str, Any],
        planned: Sequence[Planned],
        covered: set[int],
        effect: Effect,
    ) -> bool:
        skill, titles = self.vocabulary.skill[name], self.template.tasks
        scope = given.pop("scope", "mission")
        transit = self.vocabulary.transit
        where, said = given.pop("where", ""), given.pop("say", "")
        places = []
        for place in moving(planned):
            title, home = planned[place].task.title, planned[place].intent.home
            fits = name in planned[place].task.skills.get("perception", ())
            if scope == "home":
                fits = home
            elif scope == "way":
                fits = place in covered and title == transit and not home
            elif scope == "task":
                fits = (
                    place in covered and not planned[place].inserted and (fits or title == transit)
                )
            if fits and (not titles or title in titles):
                places.append(place)
        for parameter in skill.parameters:
            if parameter.type == "texts" and isinstance(given.get(parameter.name), str):
                given[parameter.name] = [given[parameter.name]]
        text = said or _demands(self.sampler)[name]
        for parameter_name, value in given.items():
            text = text.replace(
                f"{{{parameter_name}}}",
                " and ".join(value) if isinstance(value, list) else str(value),
            )
        text = f"{text} {where}".rstrip() + "."
        effect.about.add(name)
        effect.sentences += [(place, text, (skill.role, name, given)) for place in places]
        return bool(places)


def moving(planned: Sequence[Planned]) -> list[int]:
    """The places of the tasks in which the vehicle moves or holds a place."""
    return [
        place
        for place, item in enumerate(planned)
        if item.task.arrival != "none" or item.task.pattern != "hold"
    ]


def corners(rng: Random) -> Value:
    """Three to six corners in one of many notations, or a box by two of them."""
    points, roll = draw_polygon(rng), rng.random()
    if roll < 0.2:
        width, height = 10 * rng.randrange(4, 50), 10 * rng.randrange(4, 50)
        points = [point(0, 0), point(width, 0), point(width, height), point(0, height)]
    elif roll < 0.32:
        points = _hexagon(rng)
    elif roll < 0.45:
        x, y = draw_point(rng)
        shifts = [(0, 0), (60, -10), (80, 40), (20, 70)]
        size = pick((0.5, 1, 2, 4), rng)
        points = [point(x + size * dx, y + size * dy) for dx, dy in shifts]
    listed = [list(corner) for corner in points]
    if rng.random() < 0.35:
        value = polygon(points, rng)
        if value.noun and rng.random() < BOXED:
            return Value(listed, value.noun)
        return Value(listed, value.text)
    form, joint = pick(CORNERS, rng), pick(JOINTS, rng)
    if form in ("{x} {y}", "x={x} y={y}") and joint == " ":
        joint = ", "
    texts = [form.format(x=digits(x), y=digits(y)) for x, y in points]
    if len(points) == 4 and rng.random() < BOXED and _is_box(points):
        low, high = points[0], max(points, key=sum)
        first, last = (position(corner, rng, "({x}, {y})").text for corner in (low, high))
        return Value(listed, f"{first} {pick(('to', 'and', 'up to', '-'), rng)} {last}")
    if joint == " and ":
        return Value(listed, ", ".join(texts[:-1]) + joint + texts[-1])
    return Value(listed, joint.join(texts))


def _is_box(points: Sequence[Point]) -> bool:
    """Whether the corners are those of a box that begins in the south-west."""
    xs, ys = {x for x, _y in points}, {y for _x, y in points}
    return len(xs) == len(ys) == 2 and points[0] == (min(xs), min(ys))


def _hexagon(rng: Random) -> list[Point]:
    x, y, step = 10 * rng.randrange(-15, 15), 10 * rng.randrange(-15, 15), 10 * rng.randrange(2, 12)
    shape = ((0, 0), (2, 0), (3, 1), (2, 2), (0, 2), (-1, 1))
    return [point(x + step * dx, y + step * dy) for dx, dy in shape]


def _demands(sampler: MissionSampler) -> Mapping[str, str]:
    demands: Mapping[str, str] = sampler.config.get("demand", {})
    return demands


def _bound(template: Template, sampler: MissionSampler) -> Bound:
    """The clause for this vehicle. Raises TemplateError."""
    vocabulary = sampler.vocabulary
    key = ("clause", vocabulary)
    if key in template.bound:
        found: Bound = template.bound[key]
        return found
    slots = [slot for slot in all_slots(template.nodes) if slot.sign != "?"]
    keys = {slot.key for slot in slots}
    limits, used = load_limits(vocabulary), set[str]()
    for call in (step.call for step in template.steps):
        if call.name not in limits and (
            call.name not in vocabulary.skill or call.name not in _demands(sampler)
        ):
            raise TemplateError(f"{call.name} is no kind of limit and no skill with a [demand]")
        for argument in call.arguments:
            value = str(argument.value)
            used.add(value)
            if argument.name == "scope" and value not in SCOPES:
                raise TemplateError(f"scope={value}: must be {', '.join(SCOPES)}")
            if argument.kind == "slot" and argument.name != "scope" and value not in keys:
                raise TemplateError(f"{value} stands in the plan and not in the text")
    for nodes in template.remarks[0]:
        used |= {slot.key for slot in all_slots(nodes)}
    for name in sorted(keys - used):
        raise TemplateError(f"{{{name}}} belongs to no limit and no demand")
    for title in template.tasks:
        if title not in vocabulary.task:
            raise TemplateError(f"there is no task {title}")
    kinds = {slot.key: slot.kind for slot in slots if slot.kind and slot.base == "T"}
    owners = {
        slot.key: (LIMIT, LIMIT.by_name[slot.base]) for slot in slots if slot.base in LIMIT.by_name
    }
    for slot in slots:
        known = slot.base in (*OBJECTS, IT) or slot.key in owners or slot.base in sampler.words
        if not known or kinds.get(slot.key, "thing") not in sampler.words:
            raise TemplateError(f"{{{slot.key}}} is no target, value of a limit or word list")
    template.bound[key] = Bound((), owners, kinds, {})
    return template.bound[key]
