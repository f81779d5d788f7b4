"""Synthetic missions: commands drawn from a vehicle's command templates, with their plans.

    for record in sample_missions(seed=0, count=500): ...

The templates stand beside the vehicle's definition (`templates.records`), their word lists and the
texts of the plans in NAME.missions.toml. The plan follows from the template's intents by the
labelling rules (`mission_plan`).
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from random import Random
from typing import Any

from planner_ft.data.mission_plan import (
    DOCKING,
    Intent,
    Planned,
    PlanTexts,
    Target,
    label,
    point_text,
)
from planner_ft.data.noise import noisy
from planner_ft.data.numbers import WRITTEN, Value, digits, feet, knots, pick, position
from planner_ft.data.task.values import Draw, draw_point, value_space
from planner_ft.data.templates.grammar import (
    Argument,
    Nodes,
    Part,
    Slot,
    Step,
    TemplateError,
    all_slots,
    always,
    base_of,
    choose,
    parse_text,
)
from planner_ft.data.templates.records import Template, templates
from planner_ft.data.templates.render import PIECE, article_for, joined, plain
from planner_ft.data.wordlists import WordLists
from planner_ft.facts.geometry import Point
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Parameter, Task, Vocabulary, load_vocabulary
from planner_ft.vocabulary.definition import MISSIONS

OBJECTS = ("T", "P", "ID")
LOCATED, SOUGHT = 0.5, 0.12
"""Shares of targets said with a position, and of those that the command looks for."""
DOUBTFUL, FOREIGN, BARE, FITTING = 0.04, 0.03, 0.5, 0.6
"""Shares of positions said with doubt, lengths and speeds in feet and knots, sizes without a unit
before another size, and line spacings that divide the width.
"""
LANES = 12
PLACED = (
    *(("{}", " at {}"),) * 26,
    *(("{}", " ({})"), ("{}", ", at {},"), ("{}", " at position {}"), ("{}", " over at {}")),
    *(("{}", " out at {}"), ("{}", ", {},"), ("{}", " located at {}")),
)
DOUBTS = (
    *(("{}", " somewhere near {}"), ("{}", " at about {}"), ("{}", " at roughly {}")),
    *(("{}", ", which should be at {},"), ("{}", ", probably at {},"), ("{}", " at around {}")),
)
JOINTS = (" by ", " x ", "x", " times ")


@dataclass(frozen=True)
class Fill:
    """A parameter of a task and what fills it: a slot of the text or a literal value."""

    parameter: Parameter
    slot: str = ""
    value: Any = None


@dataclass(frozen=True)
class Line:
    """A task of a template; `task` is None for the return home."""

    task: Task | None
    label: str
    objects: tuple[str, ...]
    fills: tuple[Fill, ...]
    here: bool = False
    near: str = ""
    part: Nodes = ()


@dataclass(frozen=True)
class Bound:
    """A template for one vehicle: its tasks, what each slot fills, and the kinds of its targets."""

    lines: tuple[Line, ...]
    owners: dict[str, tuple[Task, Parameter]]
    kinds: dict[str, str]
    places: dict[str, str]


@dataclass
class Drawn:
    """What one command speaks of, by slot; `wrong` holds what is taken back."""

    targets: dict[str, Target] = field(default_factory=dict)
    values: dict[str, Value] = field(default_factory=dict)
    wrong: dict[str, list[PIECE]] = field(default_factory=dict)
    alike: list[Target] = field(default_factory=list)


def sample_missions(
    seed: int, count: int | None = None, vocabulary: Vocabulary | None = None
) -> Iterator[dict[str, Any]]:
    """Synthetic mission samples of a vehicle (usv unless told otherwise), endless when `count` is
    None; the same seed gives the same samples.

    A record is {"id", "family", "prompt", "expected", "tags"}; `family` names the subject of the
    template. Raises PlannerError for a vehicle without command templates.
    """
    sampler = mission_sampler(vocabulary or load_vocabulary())
    for number in itertools.count() if count is None else range(count):
        yield sampler.sample(Random(seed * 1_000_003 + number), f"synthetic-{seed}-{number}")


@functools.lru_cache(maxsize=8)
def mission_sampler(vocabulary: Vocabulary) -> MissionSampler:
    """The sampler of a vehicle's missions, made once."""
    return MissionSampler(vocabulary)


class MissionSampler:
    """Draws commands and their plans for one vehicle, from templates of one split."""

    def __init__(self, vocabulary: Vocabulary, split: str | None = "train") -> None:
        self.vocabulary = vocabulary
        self.config = vocabulary.beside(MISSIONS)
        self.words = WordLists(vocabulary.phrases.get("words", {}), self.config.get("words", {}))
        self.texts = PlanTexts(vocabulary, self.config)
        self.default = self.config.get("target", "thing")
        self.draws: dict[tuple[str, str], Draw] = {}
        self.groups = templates(vocabulary, "commands", split)
        if not self.groups:
            raise PlannerError(
                f"vocabulary {vocabulary.name}: there are no command templates for synthetic"
                f" missions; write {vocabulary.name}.commands.jsonl beside the definition"
            )

    def sample(self, rng: Random, name: str) -> dict[str, Any]:
        """One record."""
        group = self.groups[int(rng.random() * len(self.groups))]
        template = group[int(rng.random() * len(group))]
        text, expected = self.draw(template, rng)
        literal = frozenset(
            word
            for step in template.steps
            for argument in step.call.arguments
            if argument.kind == "literal"
            for word in str(argument.value).split()
        )
        texts = [
            str(item)
            for task in expected["tasks"]
            for value in task["parameters"].values()
            for item in (value if isinstance(value, list) else [value])
        ]
        shout = not any(text != text.lower() for text in texts)
        return {
            "id": name,
            "family": f"synthetic-{template.group.rpartition('-')[0]}",
            "prompt": plain(noisy(text, rng, keep=literal, shout=shout)),
            "expected": expected,
            "tags": [] if expected["tasks"] else ["rule.empty"],
        }

    def draw(self, template: Template, rng: Random) -> tuple[str, dict[str, Any]]:
        """The command with its values marked, and its plan. Raises PlannerError for a template that
        does not fit the vehicle.
        """
        try:
            bound = self.bound(template)
            drawing = _Drawing(self, bound, rng)
            text = drawing.text(template)
            return text, drawing.plan(template)
        except TemplateError as error:
            raise template.error(error) from None

    # ------------------------------------------------------------ binding

    def bound(self, template: Template) -> Bound:
        """The template for this vehicle. Raises TemplateError."""
        found = template.bound.get(self.vocabulary)
        if found is None:
            found = template.bound[self.vocabulary] = self._bind(template)
        return found

    def _bind(self, template: Template) -> Bound:
        slots = [slot for slot in all_slots(template.nodes) if slot.sign in ("", "~")]
        keys = {slot.key for slot in slots}
        owners: dict[str, tuple[Task, Parameter]] = {}
        lines = tuple(self._line(step, keys, owners) for step in template.steps)
        used = {key for line in lines for key in line.objects} | {
            fill.slot for line in lines for fill in line.fills
        }
        used |= {slot.key for line in lines for slot in all_slots(line.part)}
        used |= {line.near for line in lines}
        remarks = [
            slot for nodes in itertools.chain(*template.remarks) for slot in all_slots(nodes)
        ]
        noted = {slot.key for slot in remarks}
        unused = {
            str(argument.value)
            for step in template.steps
            for argument in step.call.arguments
            if argument.kind == "unused"
        }
        said = {slot.key for slot in slots if not slot.sign}
        for key in sorted((used | noted | unused) - said - {""}):
            raise TemplateError(f"{key} stands in the plan, but the text has no {{{key}}}")
        for key in sorted(keys - used - noted - unused):
            raise TemplateError(f"{{{key}}} belongs to no task; a wrong value is {{~{key}}}")
        labels = {slot.key for slot in all_slots(template.nodes) if slot.sign == "?"}
        for name in labels ^ {line.label for line in lines if line.label}:
            raise TemplateError(f"the label ?{name} stands only in the text or only in the plan")
        for slot in slots:
            self._own(slot, owners)
        for title in template.excluded:
            if title != "Home" and title not in self.vocabulary.task:
                raise TemplateError(f"there is no task {title} to rule out")
        surely = always(template.nodes)
        for line in lines:
            needed = [key for key in line.objects if base_of(key) == "T"]
            for key in needed if not line.label else ():
                if key not in surely:
                    raise TemplateError(f"{{{key}}} is needed, and not every alternative says it")
        kinds = {slot.key: slot.kind for slot in slots if slot.kind and slot.base == "T"}
        for kind in kinds.values():
            if kind not in self.words:
                raise TemplateError(f"there is no word list {kind} for targets")
        return Bound(lines, owners, kinds, self._places(lines))

    def _line(self, step: Step, keys: set[str], owners: dict[str, tuple[Task, Parameter]]) -> Line:
        call = step.call
        if step.filters or step.perceptions or step.each:
            raise TemplateError(f"{call.name}: a task has no filters and perception skills")
        if call.name == "Home":
            return Line(None, call.label, (), ())
        task = self.vocabulary.task.get(call.name)
        if task is None:
            raise TemplateError(f"there is no task {call.name}")
        objects: list[str] = []
        fills: list[Fill] = []
        here, near = False, ""
        part: Nodes = ()
        for argument in call.arguments:
            value = str(argument.value)
            if argument.kind == "unused":
                continue
            if argument.name == "near":
                near = value
            elif argument.name == "part":
                part = parse_text(value if argument.kind == "literal" else f"{{{value}}}")
            elif value == "here" and not argument.name:
                here = True
            elif not argument.name and base_of(value) in OBJECTS:
                objects.append(value)
            else:
                fill = _fill(task, argument, keys)
                fills.append(fill)
                owners.setdefault(fill.slot, (task, fill.parameter))
        if task.arrival != "none" and not objects and not here:
            raise TemplateError(f"{call.name} has no place: T1, P1, or here")
        if task.title == self.vocabulary.locate and not any(key[0] == "T" for key in objects):
            raise TemplateError(f"{call.name} needs a target, T1")
        return Line(task, call.label, tuple(objects), tuple(fills), here, near, part)

    def _own(self, slot: Slot, owners: dict[str, tuple[Task, Parameter]]) -> None:
        """What a value outside the plan is drawn for: the first parameter of that name."""
        if slot.base in OBJECTS or slot.key in owners or slot.base in self.words:
            return
        for task in self.vocabulary.tasks:
            for parameter in task.parameters:
                if parameter.name == slot.base:
                    owners[slot.key] = task, parameter
                    return
        raise TemplateError(f"{{{slot.key}}} is no target, parameter or word list")

    @staticmethod
    def _places(lines: Sequence[Line]) -> dict[str, str]:
        """The position slot of a target or id that has one: `PerformOrbit T1 P1`."""
        return {
            key: place
            for line in lines
            for place in line.objects
            if base_of(place) == "P"
            for key in line.objects
            if base_of(key) != "P"
        }

    def value(self, task: Task, parameter: Parameter, rng: Random) -> Value:
        """A value of a parameter, with its words."""
        key = task.title, parameter.name
        spaces = [
            source.get("task", {}).get(task.title, {}).get("values", {}).get(parameter.name, {})
            for source in (self.vocabulary.phrases, self.config)
        ]
        config = {**spaces[0], **spaces[1]}
        if key not in self.draws:
            self.draws[key] = value_space(parameter, config, self.words)
        if parameter.unit in ("m", "m/s") and rng.random() < FOREIGN:
            low, high = config.get("typical", (1, 60))
            foreign = knots(rng) if parameter.unit == "m/s" else feet(rng, low, high)
            return foreign or self.draws[key](rng)
        return self.draws[key](rng)


def _fill(task: Task, argument: Argument, keys: set[str]) -> Fill:
    """What an argument of a task fills. Raises TemplateError."""
    name = argument.name or base_of(str(argument.value))
    if name not in task.by_name:
        names = ", ".join(task.by_name) or "none"
        raise TemplateError(f"{task.title} has no parameter {name} (it has {names})")
    parameter = task.by_name[name]
    if argument.kind == "literal":
        number = isinstance(argument.value, float)
        value = float(argument.value) if number else argument.value
        if isinstance(value, float) and value == int(value):
            value = int(value)
        return Fill(parameter, value=value)
    if str(argument.value) not in keys:
        raise TemplateError(f"{argument.value} stands in the plan and not in the text")
    return Fill(parameter, slot=str(argument.value))


class _Drawing:
    """One command in the making."""

    def __init__(self, sampler: MissionSampler, bound: Bound, rng: Random) -> None:
        self.sampler, self.bound, self.rng = sampler, bound, rng
        self.words, self.drawn = sampler.words, Drawn()
        roll = rng.random()
        self.form = None if roll > 0.85 else WRITTEN[0] if roll < 0.3 else pick(WRITTEN, rng)
        self.lines: tuple[Line, ...] = ()
        self.said: set[str] = set()

    def text(self, template: Template) -> str:
        """The command with its values marked."""
        parts = choose(template.nodes, self.rng, [])
        slots = [part for part in parts if isinstance(part, Slot)]
        labels = {slot.key for slot in slots if slot.sign == "?"}
        self.lines = tuple(
            line for line in self.bound.lines if not line.label or line.label in labels
        )
        self.said = {slot.key for slot in slots if not slot.sign}
        for slot in sorted(slots, key=lambda slot: slot.base != "P"):
            if slot.sign != "?" and slot.key not in self.drawn.targets | self.drawn.values:
                self._draw(slot, slots, parts)
        self._agree()
        for slot in slots:
            if slot.sign == "~":
                self.drawn.wrong[slot.key] = self._wrong(slot)
        return joined(self._pieces(parts), small=_is_small(template.nodes))

    # ------------------------------------------------------------ what is spoken of

    def _draw(self, slot: Slot, slots: list[Slot], parts: list[Part]) -> None:
        key, targets = slot.key, self.drawn.targets
        if slot.base == "P":
            near = {line.near for line in self.lines}
            targets[key] = Target(key, position=self._point(), doubtful=key in near)
        elif slot.base == "T":
            targets[key] = self._target(slot, parts)
        elif slot.base == "ID":
            name = self.words.noun("identity", self.rng)
            targets[key] = Target(
                key, identity=name.value, text=name.text, position=self._bound_place(key)
            )
        else:
            self.drawn.values[key] = self._value(slot, slots)

    def _point(self) -> Point:
        while True:
            point = draw_point(self.rng)
            if point not in (self.sampler.vocabulary.home, self.sampler.vocabulary.unresolved):
                return point

    def _bound_place(self, key: str) -> Point | None:
        place = self.bound.places.get(key)
        return self.drawn.targets[place].position if place in self.drawn.targets else None

    def _target(self, slot: Slot, parts: list[Part]) -> Target:
        key, rng, bound = slot.key, self.rng, self.bound
        own = [
            (part, _owns(parts, number))
            for number, part in enumerate(parts)
            if isinstance(part, Slot) and part.key == key and not part.sign
        ]
        lines = [line for line in self.lines if key in line.objects]
        near = next((line.near for line in lines if line.near), "")
        kind = bound.kinds.get(key, self.sampler.default)
        common = any("a" in part.options for part, _ in own)
        fixed = common or any("bare" in part.options or owns for part, owns in own)
        if kind == "pair":
            target = self._alike(key)
        else:
            target = self._described(key, kind, plain_=fixed, common=common)
        if key in bound.places:
            target = replace(target, position=self._bound_place(key))
        elif not near and kind != "pair" and self._is_located(own, lines):
            doubt = rng.random() < DOUBTFUL
            target = replace(target, position=self._point(), doubtful=doubt)
        if near in self.drawn.targets:
            point = self.drawn.targets[near].position or (0, 0)
            target = replace(target, whereabouts=f"near {point_text(point)}")
        spot = any(line.task is not None and line.task.pattern == DOCKING for line in lines)
        return replace(target, spot=spot, on_site=any(line.here for line in lines))

    def _is_located(self, own: list[tuple[Slot, bool]], lines: list[Line]) -> bool:
        """Whether the command gives a position with the target: where a mention can carry it."""
        if any("lost" in part.options for part, _ in own):
            return False
        first = next(((part, owns) for part, owns in own if not part.options & {"bare"}), None)
        if first is None or first[0].options & {"a", "one", "look", "nouns"} or first[1]:
            return False
        if any("located" in part.options for part, _ in own):
            return True
        locate = self.sampler.vocabulary.locate
        sought = any(line.task is not None and line.task.title == locate for line in lines)
        return self.rng.random() < (SOUGHT if sought else LOCATED)

    def _described(self, key: str, kind: str, *, plain_: bool, common: bool) -> Target:
        """A target of a kind; `plain_` takes an article and has no "with ..." phrase, `common` no
        name.
        """
        for _ in range(20):
            value = self.words.noun(kind, self.rng)
            article = value.text != value.value
            named = not value.value.islower() or any(mark.isdigit() for mark in value.value)
            if not (plain_ and (not article or " with " in value.value)) and not (common and named):
                break
        return Target(key, value.value, article=article, text=value.value)

    def _alike(self, key: str) -> Target:
        """One of several targets with one noun that differ in their look."""
        if not self.drawn.alike:
            while (noun := self.words.entry("pair", self.rng)).endswith("y"):
                continue
            looks = self.words.entry("looks", self.rng).split("/")
            if self.rng.random() < 0.5:
                looks = [looks[1], looks[0], looks[2]]
            self.drawn.alike = [
                Target(key, f"{look} {noun}", text=look, noun=noun) for look in looks
            ]
        return replace(self.drawn.alike[int(key[1:]) - 1], key=key)

    def _value(self, slot: Slot, slots: Sequence[Slot]) -> Value:
        """A value of a slot, which differs from those of other slots of its kind."""
        options = {option for other in slots if other.key == slot.key for option in other.options}
        taken = [
            value.value for key, value in self.drawn.values.items() if base_of(key) == slot.base
        ]
        for _ in range(60):
            value = self._new(slot)
            wordings = {
                "adj": value.short,
                "num": value.short,
                "noun": value.noun,
                "way": value.way,
            }
            if all(wordings.get(option, "") is not None for option in options) and (
                value.value not in taken or slot.base not in self.words
            ):
                break
        return value

    def _new(self, slot: Slot) -> Value:
        owner = self.bound.owners.get(slot.key)
        if owner is None or owner[1].type in ("text", "texts", "id"):
            return self.words.noun(slot.base, self.rng)
        return self.sampler.value(*owner, self.rng)

    def _agree(self) -> None:
        """A series of readings has room for two; mostly, lines fit the width of their grid."""
        values = self.drawn.values
        for line in self.lines:
            slot = {fill.parameter.name: fill.slot for fill in line.fills if fill.slot in values}
            if {"interval", "duration"} <= slot.keys():
                every, whole = slot["interval"], slot["duration"]
                for _ in range(50):
                    if 2 * values[every].value <= values[whole].value:
                        break
                    values[every] = self._new(Slot(every, "interval"))
                    values[whole] = self._new(Slot(whole, "duration"))
            if {"width", "spacing"} <= slot.keys() and self.rng.random() < FITTING:
                width, lanes = values[slot["width"]].value, range(2, LANES)
                for _ in range(20):
                    if any(values[slot["spacing"]].value * count == width for count in lanes):
                        break
                    values[slot["spacing"]] = self._new(Slot(slot["spacing"], "spacing"))

    def _wrong(self, slot: Slot) -> list[PIECE]:
        """What is taken back: of the same kind, and another one."""
        key, rng = slot.key, self.rng
        if slot.base == "P":
            right = self.drawn.targets[key].position or (0, 0)
            point = self._point()
            near = (right[0], point[1]) if rng.random() < 0.5 else point
            return [(self._place(near if near != right else point), True)]
        if slot.base == "T":
            kind = self.bound.kinds.get(key, self.sampler.default)
            kind = self.sampler.default if kind == "pair" else kind
            target = self._described(key, kind, plain_=bool(slot.options), common=True)
            return self._mention(target, slot)
        if slot.base == "ID":
            return [(self.words.noun("identity", rng).text, True)]
        right_value = self.drawn.values[key]
        for _ in range(60):
            value = self._new(slot)
            if value.value != right_value.value and not ("adj" in slot.options and not value.short):
                break
        return [(self._said(value, slot), True)]

    # ------------------------------------------------------------ text

    def _pieces(self, parts: list[Part]) -> Iterator[PIECE]:
        seen: dict[tuple[str, frozenset[str]], list[PIECE]] = {}
        placed: set[str] = set()
        for number, part in enumerate(parts):
            if isinstance(part, str):
                yield part, False
            elif part.sign == "~":
                yield from self.drawn.wrong[part.key]
            elif part.sign == "?":
                continue
            elif part.base == "T":
                target = self.drawn.targets[part.key]
                with_place = not (
                    part.options & {"a", "bare", "one", "look", "nouns"}
                    or part.key in placed
                    or part.key in self.bound.places
                    or _owns(parts, number)
                )
                if with_place or "a" in part.options:
                    placed.add(part.key)
                yield from self._mention(target, part, with_place=with_place)
            else:
                key = part.key, part.options
                if key not in seen:
                    seen[key] = [(self._word(part, parts, number, seen), True)]
                yield from seen[key]

    def _word(self, slot: Slot, parts: list[Part], number: int, seen: dict[Any, Any]) -> str:
        if slot.base == "P":
            return self._place(self.drawn.targets[slot.key].position or (0, 0))
        if slot.base == "ID":
            return self.drawn.targets[slot.key].text
        value = self.drawn.values[slot.key]
        text = self._said(value, slot)
        after = _size(parts, number + 2) if parts[number + 1 : number + 2] in _JOINED else None
        if not after or not _size(parts, number) or self.rng.random() > BARE:
            return text
        # "20 by 80 ft" says that the 20 are feet.
        both = _metric(self.drawn.values[after.key].text) and _metric(text)
        return digits(value.value) if both else text

    def _said(self, value: Value, slot: Slot) -> str:
        text = value.worded(slot.options)
        return str(value.value) if text == value.text and slot.base in self.words else text

    def _place(self, point: Point) -> str:
        return position(point, self.rng, self.form).text

    def _mention(self, target: Target, slot: Slot, *, with_place: bool = False) -> list[PIECE]:
        """The target as it is spoken of; ordinary words are no values, so that they can be
        mistyped.
        """
        text, options = target.description or target.text, slot.options
        if "nouns" in options:
            return [(plural(target.noun), False)]
        if "look" in options or "one" in options:
            return [(target.text if "look" in options else f"the {target.text} one", False)]
        kept = not text.islower() or any(mark.isdigit() for mark in text) or self.rng.random() < 0.6
        if "a" in options:
            return [(f"{article_for(text)} ", False), (text, kept)]
        if "bare" in options:
            return [(text, kept)]
        named = [(f"the {text}" if target.article else text, kept)]
        if not with_place or target.position is None:
            return named
        forms = DOUBTS if target.doubtful else PLACED
        before, _brace, after = forms[int(self.rng.random() * len(forms))][1].partition("{}")
        place = self._place(target.position)
        if before.endswith("(") and place[0] in "[(":
            before, after = " at ", ""
        return [*named, (before, False), (place, True), (after, False)]

    # ------------------------------------------------------------ plan

    def plan(self, template: Template) -> dict[str, Any]:
        """The plan of what is said."""
        vocabulary, texts = self.sampler.vocabulary, self.sampler.texts
        plan: list[Planned] = label([self._intent(line) for line in self.lines], vocabulary)
        constraints, assumptions = template.remarks
        notes = [texts.excluded(title) for title in template.excluded]
        notes += [self._remark(nodes) for nodes in constraints]
        if not plan and template.excluded:
            notes.append(self.sampler.config.get("cancelled", "No task is left."))
        elif not plan and not notes:
            notes.append(self.sampler.config.get("nothing", "The command asks for no task."))
        return texts.plan(plan, notes, [self._remark(nodes) for nodes in assumptions])

    def _intent(self, line: Line) -> Intent:
        if line.task is None:
            return Intent(self.sampler.vocabulary.task[self.sampler.vocabulary.transit], home=True)
        keys = [
            key
            for base in ("ID", "T", "P")
            for key in line.objects
            if base_of(key) == base and (base != "P" or key in self.said)
        ]
        if keys and keys[0] not in self.drawn.targets:
            raise TemplateError(
                f"{line.task.title} needs {{{keys[0]}}}, which one alternative lacks"
            )
        target = self.drawn.targets[keys[0]] if keys else None
        part = self._remark(line.part, sentence=False) if line.part else ""
        return Intent(line.task, target, self._parameters(line), part=part)

    def _parameters(self, line: Line) -> dict[str, Any]:
        parameters: dict[str, Any] = {}
        for fill in line.fills:
            name, value = fill.parameter.name, fill.value
            if fill.slot in self.drawn.targets:
                value = self.drawn.targets[fill.slot].description
            elif fill.slot in self.drawn.values and fill.slot in self.said:
                value = self.drawn.values[fill.slot].value
            if value is None:
                continue
            if fill.parameter.type == "texts":
                parameters.setdefault(name, []).append(value)
            else:
                parameters.setdefault(name, value)
        order = {name: number for number, name in enumerate(line.task.by_name if line.task else ())}
        return dict(sorted(parameters.items(), key=lambda item: order[item[0]]))

    def _remark(self, nodes: Nodes, *, sentence: bool = True) -> str:
        """A remark as the plan holds it."""
        text = ""
        for part in choose(nodes, self.rng, []):
            if isinstance(part, str):
                text += part
            elif part.key in self.drawn.targets:
                target = self.drawn.targets[part.key]
                text += point_text(target.position or (0, 0)) if part.base == "P" else target.name
            elif part.key in self.drawn.values:
                value = self.drawn.values[part.key]
                text += str(value.value) if part.base in self.words else value.text
            else:
                raise TemplateError(f"a remark needs {{{part.key}}}, which one alternative lacks")
        return f"{text[0].upper()}{text[1:].rstrip('.')}." if sentence else text


def _is_small(nodes: Nodes) -> bool:
    """Whether a template begins with a small letter of its own."""
    return bool(nodes) and isinstance(nodes[0], str) and nodes[0][:1].islower()


_JOINED = [[joint] for joint in JOINTS]


def _owns(parts: Sequence[Part], number: int) -> bool:
    """Whether an apostrophe follows: "the barge's"."""
    after = parts[number + 1] if number + 1 < len(parts) else ""
    return isinstance(after, str) and after.startswith(("'s", "’s"))


def _size(parts: Sequence[Part], number: int) -> Slot | None:
    """The part where it is a width or length."""
    part = parts[number] if 0 <= number < len(parts) else ""
    plain_size = isinstance(part, Slot) and part.base in ("width", "length") and not part.options
    return part if isinstance(part, Slot) and plain_size and not part.sign else None


def _metric(text: str) -> bool:
    return text.endswith(("m", "metres", "meters")) and not text.endswith("km")


def plural(noun: str) -> str:
    """The noun, which does not end in y, for more than one."""
    return f"{noun}es" if noun.endswith(("s", "x", "ch", "sh")) else f"{noun}s"
