"""Steps of a skill plan in canonical form: from the skills that run in them, and from a bound
template once its values are known; and the steps that stand for a whole shape: what each needs, its
draws, its waypoints or headings.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Collection, Mapping, Sequence
from random import Random
from typing import TYPE_CHECKING, Any

from planner_ft.data import numbers, values
from planner_ft.data.numbers import COMPASS, Draw, Value, count_text, pick
from planner_ft.data.templates.grammar import Argument, Call, fail
from planner_ft.data.templates.grammar import Step as Pattern
from planner_ft.data.values import TABLE
from planner_ft.facts import geometry as g
from planner_ft.facts.geometry import tidy
from planner_ft.vocabulary.definition import Vocabulary
from planner_ft.vocabulary.plans import canonical_parameters

if TYPE_CHECKING:
    from planner_ft.data.task.binding import Bound
    from planner_ft.data.task.phrasebook import Phrasebook

XY = "xy"
BEARINGS = {name: degrees for degrees, name in COMPASS.items()}
Step = tuple[str, dict[str, Any]]
"""A navigation skill and its parameters."""
Entry = dict[str, Any]
Beside = tuple[list[Entry], list[Entry]]
"""Filters and perception skills of a step."""
Values = Mapping[str, Any]


def _clockwise(given: Values, default: bool = False) -> bool:
    return bool(given["turn"] == "clockwise") if "turn" in given else default


def _grid(given: Values) -> list[g.Point]:
    axis: g.Axis = "x" if given.get("axis") == "x" else "y"
    width, along, start = given["width"], given["length"], given.get("start", "south-west")
    spacing = given.get("spacing")
    if spacing is None:
        spacing = (width if axis == "y" else along) / (given["count"] - 1)
    return g.lawnmower(given["point"], width, along, spacing, start, axis)


def _line(given: Values) -> list[g.Point]:
    """Start and end, or a waypoint behind every spacing, or behind each of `count` legs."""
    far = given["length"]
    legs = int(given.get("count") or round(far / given.get("spacing", far)))
    ways = (far * number / legs for number in range(1, legs + 1))
    start = g.point(*given["point"])
    return [start, *(g.offset(start, given["heading"], way) for way in ways)]


def _pass(given: Values) -> list[g.Point]:
    """Along a side of a structure, from the south or the west."""
    bearing = BEARINGS.get(given.get("side", ""), 45)
    if bearing % 90:
        raise ValueError("a pass needs one of the four sides")
    middle = g.offset(given["point"], bearing, given["distance"])
    start = g.offset(middle, (bearing + 90) % 180 + 180, given["length"] / 2)
    return g.straight_line(start, (bearing + 90) % 180, given["length"])


def _square(given: Values) -> list[g.Point]:
    start, clockwise = given.get("start", "east"), _clockwise(given)
    return g.survey_square(given["point"], given["radius"], start, clockwise=clockwise)


def _ring(given: Values) -> list[g.Point]:
    start, clockwise = BEARINGS[given.get("start", "east")], _clockwise(given)
    around = (given["point"], given["radius"], int(given["count"]))
    return g.circle(*around, start, clockwise=clockwise)


def _sectors(given: Values) -> list[float]:
    clockwise = _clockwise(given, default=True)
    return g.sector_headings(int(given["count"]), given.get("heading", 0), clockwise=clockwise)


EXPAND: Mapping[str, Callable[[Values], Sequence[Any]]] = {
    "Grid": _grid,
    "Square": _square,
    "Ring": _ring,
    "Line": _line,
    "Pass": _pass,
    "Offset": lambda of: [g.offset(of["point"], of["heading"], of["length"])],
    "Return": lambda of: [of["home"]],
    "Sectors": _sectors,
    "Turns": lambda of: [of["delta_yaw"]] * int(of["count"]),
}
"""The waypoints or headings of a shape."""


class Shape:
    """`motion` of its steps; `roles`: what it needs, with the place that a task parameter fills
    (see `links` of the phrase file); `options`: what may be said; `expand`: see EXPAND.
    """

    def __init__(self, name: str, motion: str, pattern: str, roles: str, options: str) -> None:
        pairs = (item.partition(":") for item in roles.split())
        self.roles = {role: f"{pattern}.{name or role}" for role, _colon, name in pairs}
        self.motion, self.options, self.expand = motion, frozenset(options.split()), EXPAND[name]


SHAPES = {name: Shape(name, **entry) for name, entry in TABLE["shapes"].items()}


# ---------------------------------------------------------------- values


def one_of(options: Sequence[Any]) -> Draw:
    """A draw of one of some words or counts."""

    def draw(rng: Random) -> Value:
        option = pick(options, rng)
        text = option if isinstance(option, str) else count_text(option, rng)
        return Value(option, text, str(option))

    return draw


def direction(rng: Random) -> Value:
    """A compass direction in words, mostly one of the four: "north", "due south", "south-west"."""
    degrees = 90 * rng.randrange(4) if rng.random() < 0.8 else 45 + 90 * rng.randrange(4)
    name = COMPASS[degrees]
    due = degrees % 90 == 0 and rng.random() < 0.25
    return Value(degrees, f"due {name}" if due else name, name, way=name)


DRAWS: Mapping[tuple[str, str], Draw] = {
    ("Line", "heading"): lambda rng: numbers.bearing(values.draw_bearing(rng), rng),
    ("Sectors", "heading"): lambda rng: numbers.bearing(pick((0, 0, 45, 90, 180, 270), rng), rng),
    ("Grid", "compass"): lambda rng: pick(
        (Value("y", "north-south"), Value("x", "east-west")), rng
    ),
    ("any", "radius"): lambda rng: numbers.length(values.draw_number(rng, 4, 60), rng),
    ("any", "length"): lambda rng: numbers.length(values.draw_number(rng, 5, 150), rng),
    ("any", "direction"): direction,
    ("any", "heading"): direction,
    ("any", "delta_yaw"): lambda rng: numbers.rotation(values.draw_rotation(rng, 90), rng),
    **{
        (shape, slot): one_of(options)
        for shape, slots in TABLE["draws"].items()
        for slot, options in slots.items()
    },
}
"""By shape, or "any", and slot or role."""


def value_draw(shape: str, role: str, base: str) -> Draw:
    """How the value of a slot in a shape is drawn. Raises TemplateError for one that is not."""
    by_role = ((shape, role), ("any", role)) if base != "direction" else (("any", base),)
    keys = (key for key in ((shape, base), *by_role) if key in DRAWS)
    return DRAWS[next(keys, None) or fail(f"{shape} cannot draw a {role}")]


def grid_size(rng: Random, *, free: bool) -> dict[str, float]:
    """A grid's sizes and lanes, which fit; `free`: its length is no multiple of the spacing."""
    spacing = pick(TABLE["grid"]["spacing"], rng)
    width = g.tidy(spacing * (pick(TABLE["grid"]["lanes"], rng) - 1))
    along = g.tidy(spacing * rng.randrange(1, 11))
    if free and rng.random() < 0.6:
        round_ = rng.random() < 0.7
        along = g.tidy(5 * rng.randrange(1, 31) if round_ else rng.randrange(5, 120))
    count = g.lane_count(width if free else along, spacing) or 0
    return {"width": width, "length": along, "spacing": spacing, "count": count}


def line_legs(count: int | None, rng: Random) -> dict[str, float]:
    """The length of a line and its legs, which fill it; `count`: of the legs, where it is set."""
    spacing = pick(TABLE["line"]["spacing"], rng)
    count = count or pick(TABLE["draws"]["Line"]["count"], rng)
    return {"spacing": spacing, "count": count, "length": g.tidy(spacing * count)}


# ---------------------------------------------------------------- steps


def entry_of(name: str, parameters: Mapping[str, Any], vocabulary: Vocabulary) -> Entry:
    """A skill as it stands in a plan."""
    canonical = canonical_parameters(dict(parameters), vocabulary.skill[name])
    return {"name": name, "parameters": canonical}


def plan_step(
    name: str,
    parameters: dict[str, Any],
    filters: list[Entry],
    perceptions: list[Entry],
    vocabulary: Vocabulary,
) -> Entry:
    """A step of the plan in canonical form, with the strings that its skills report."""
    running = (name, *(entry["name"] for entry in (*filters, *perceptions)))
    stops, failures, outputs = _reports(vocabulary, running)
    return {
        "navigation_skill": entry_of(name, parameters, vocabulary),
        "filter_skills": filters,
        "perception_skills": perceptions,
        "stop_conditions": list(stops),
        "failure_modes": list(failures),
        "expected_outputs": list(outputs),
    }


@functools.lru_cache(maxsize=4096)
def _reports(vocabulary: Vocabulary, running: tuple[str, ...]) -> list[list[str]]:
    """Stop condition of the first skill, failure modes and outputs of all."""
    skills = [vocabulary.skill[name] for name in running]
    failures, outputs = ([getattr(skill, key) for skill in skills] for key in ("failure", "output"))
    return [list(filter(None, dict.fromkeys(t))) for t in ([skills[0].stop], failures, outputs)]


def _stands(at: str, number: int, count: int) -> bool:
    """Whether what is marked `at` stands at waypoint `number`, counted from 0, of `count`."""
    marks = {"first": number == 0, "last": number == count - 1}
    return marks.get(at, not at or (at == "even") == bool(number % 2))


class Plan:
    """The steps of a bound template. `labels` are those that were chosen; `given` has the value of
    a slot or a task parameter, None where it was not said.
    """

    def __init__(
        self,
        bound: Bound,
        book: Phrasebook,
        labels: Collection[str],
        given: Callable[[Argument], Any],
    ) -> None:
        self.bound, self.book, self.labels, self.given = bound, book, labels, given
        self.vocabulary = book.vocabulary
        self.added: Beside = ([], [])

    def skills(self) -> list[Entry]:
        """The skills of a clause, which run in the steps of others."""
        return [self._entry(step.call) for step in self.bound.steps]

    def steps(self, added: Beside = ([], [])) -> list[Entry]:
        """The steps, in which what is added runs, too. Raises ValueError when what was chosen makes
        no plan.
        """
        self.added, everywhere = added, self.bound.everywhere
        common = self.beside(everywhere) if everywhere else ([], [])
        return [
            entry
            for step in self.bound.steps
            if not step.call.label or step.call.label in self.labels
            for entry in self._expand(step, common)
        ]

    def _expand(self, step: Pattern, common: Beside) -> list[Entry]:
        entries: list[Entry] = []
        moves = self._moves(step.call)
        for number, (name, parameters) in enumerate(moves):
            own = self.beside(step, number, len(moves))
            parts = (common, own) if self.bound.front else (own, common)
            filters, perceptions = ([*first, *then] for first, then in zip(*parts, strict=True))
            for mine, more in zip((filters, perceptions), self.added, strict=True):
                mine += [entry for entry in more if entry not in mine]
            entries.append(plan_step(name, parameters, filters, perceptions, self.vocabulary))
            if step.each and _stands(step.each.call.at, number, len(moves)):
                entries += self._expand(step.each, common)
        return entries

    def beside(self, step: Pattern, number: int = 0, count: int = 1) -> Beside:
        """Filters and perception skills at waypoint `number`, counted from 0, of `count`."""
        filters, perceptions = (
            [
                self._entry(call)
                for call in calls
                if _stands(call.at, number, count) and (not call.label or call.label in self.labels)
            ]
            for calls in (step.filters, step.perceptions)
        )
        return filters, perceptions

    def _entry(self, call: Call) -> Entry:
        return entry_of(call.name, self._parameters(call), self.vocabulary)

    def _moves(self, call: Call) -> Sequence[Step]:
        """Navigation skills with their parameters. Raises ValueError when lanes do not fill."""
        shape = SHAPES.get(call.name)
        if shape is None:
            return [(call.name, self._parameters(call))]
        name = self.book.motions[shape.motion]
        try:
            found = shape.expand({**self._values(call), "home": self.vocabulary.home})
        except KeyError as error:
            raise ValueError(f"{call.name} has no {error}") from None
        if shape.motion == "goto":
            if not all(map(self.book.within, found)):
                raise ValueError(f"{call.name} leaves the bounds of {name}")
            return [(name, {"x": x, "y": y}) for x, y in found]
        key = self.book.skills[name].skill.parameters[0].name
        return [(name, {key: value}) for value in found]

    def _parameters(self, call: Call) -> dict[str, Any]:
        values, known = self._values(call), self.vocabulary.skill[call.name].by_name
        if XY in values:
            values["x"], values["y"] = values.pop(XY)
        for name, value in values.items():
            if known[name].type == "texts" and not isinstance(value, list):
                values[name] = [value]
        return values

    def _values(self, call: Call) -> dict[str, Any]:
        """The values of a call that are given."""
        given = ((argument.name, self._value(argument)) for argument in call.arguments)
        return {name: value for name, value in given if value is not None}

    def _value(self, argument: Argument) -> Any:
        if argument.kind == "literal":
            value = argument.value
            return tidy(value) if isinstance(value, float) else value
        drawn = self.given(argument)
        return -drawn if argument.negative and drawn is not None else drawn
