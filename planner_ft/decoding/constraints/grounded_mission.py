"""The values of a mission plan that its command gives to a task or a place beyond doubt."""

from __future__ import annotations

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from planner_ft.data.numerals import UNITS
from planner_ft.data.quantities import close, positions
from planner_ft.decoding.constraints.facts import multiples, usable
from planner_ft.decoding.constraints.grammar import (
    Context,
    Grammar,
    Narrowed,
    Positions,
    Values,
    written_number,
)
from planner_ft.decoding.constraints.grounded import GroundedValues, one_of
from planner_ft.decoding.constraints.reading.missions.apart import (
    Given,
    lists_of_numbers,
    read_apart,
)
from planner_ft.decoding.constraints.reading.missions.areas import read_area
from planner_ft.decoding.constraints.reading.missions.offsets import read_offsets
from planner_ft.decoding.constraints.reading.missions.orders import Orders, read_orders
from planner_ft.decoding.constraints.reading.missions.others import places_of_others
from planner_ft.decoding.constraints.reading.missions.renewed import outdated, read_spacing
from planner_ft.decoding.constraints.reading.missions.searches import (
    nothing_to_search,
    pieces_of_sought,
)
from planner_ft.decoding.constraints.reading.missions.sections import read_sections
from planner_ft.decoding.constraints.reading.missions.standoffs import read_standoffs
from planner_ft.decoding.constraints.reading.missions.taken_back import (
    dropped_titles,
    places_taken_back,
)
from planner_ft.vocabulary import Parameter, Skill, Task, Vocabulary
from planner_ft.vocabulary.replay import Progress

Position = tuple[float, float]
LONGEST = 3000
"""Characters of a command that is read for this."""
MEASURED = tuple(sorted(word for word in UNITS if len(word) > 3))
"""Words for units, which are nothing to search for."""
_PART = re.compile(
    r"\b(?:the|a|an|its|her) (?P<part>(?:[\w'-]+ ){0,2}[\w'-]+) on (?:the|its|her)"
    r" (?P<thing>(?:[\w'-]+ ){0,2}?[\w'-]+)"
    r"(?=[.;:]|$|,(?! ?[\[(]| ?-?\d+(?:\.\d+)? ?[,/]| at| position)|"
    r" (?:for|and|while|every|then|steadily|without)\b)",
    re.IGNORECASE,
)
"""A part of a thing that is no place."""


@dataclass(frozen=True)
class Told:
    """`values` by pattern and parameter of the tasks, `apart` by place; `elsewhere` are places that
    the vehicle is not to go to.

    `nothing` are words of the command that name nothing that is searched for, and there may be
    nothing of the kind at all: `placed`; `parts` are no whole features. `dropped` are tasks that
    the command takes back, `orders` is what it says of the order.
    """

    values: dict[tuple[str, str], float] = field(default_factory=dict)
    apart: Given = field(default_factory=dict)
    elsewhere: tuple[Position, ...] = ()
    nothing: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()
    placed: bool = False
    dropped: frozenset[str] = frozenset()
    orders: Orders = field(default_factory=Orders)

    def allows(self, title: str, progress: Progress) -> bool:
        """Whether a task may follow: one that is not taken back, behind all that comes before
        it.
        """
        return title not in self.dropped and all(
            before in progress.done for before in self.orders.titles_before(title)
        )

    def too_early(self, progress: Progress) -> Iterator[Position]:
        """The places that others come before."""
        orders = self.orders
        yield from (
            place for before, place in sorted(orders.places) if before not in progress.visited
        )
        yield from (place for title, place in sorted(orders.after) if title not in progress.done)

    def value(self, parameter: Parameter, owner: Task | Skill) -> float | None:
        """The value that certainly is a task's."""
        return self.values.get((owner.pattern, parameter.name)) if isinstance(owner, Task) else None


class MissionValues(GroundedValues):
    """The values that a command states, with those of its lists ("2, 4 and 6 minutes") and the
    places that it tells from others.
    """

    def __init__(self, prompt: str, vocabulary: Vocabulary) -> None:
        super().__init__(prompt, vocabulary)
        offsets, short = list(read_offsets(prompt)), len(prompt) <= LONGEST
        places = dict.fromkeys([*self._reading.places, *(offset.place for offset in offsets)])
        self._reading = replace(self._reading, places=tuple(places))
        self._listed = (
            [number for row in lists_of_numbers(prompt) for number in row] if short else []
        )
        self._outdated = outdated(prompt) if short else frozenset()
        self._multiples = multiples(prompt)
        self.told = (
            read_told(prompt, (float(vocabulary.home[0]), float(vocabulary.home[1])))
            if short and not self._reading.numbers_free
            else Told()
        )

    def _values_of(self, parameter: Parameter) -> list[float] | None:
        said = super()._values_of(parameter)
        if said is not None and parameter.unit in ("s", "m"):
            said = usable(
                (*said, *(value * factor for factor in self._multiples for value in said)),
                parameter,
            )
        listed = {number.value for number in self._listed if number.unit == parameter.unit}
        if said is None or not (listed or self._outdated):
            return said
        return usable(
            (
                value
                for value in (*said, *listed)
                if not any(close(value, old) for old in self._outdated)
            ),
            parameter,
        )


@functools.lru_cache(maxsize=64)
def read_told(prompt: str, home: Position = (0.0, 0.0)) -> Told:
    """What a command gives to a task or a place beyond doubt."""
    values = {
        ("lawnmower", name): value for name, value in read_area(prompt).items()
    } | read_standoffs(prompt)
    if (spacing := read_spacing(prompt)) is not None:
        values["lawnmower", "spacing"] = spacing
    offsets = list(read_offsets(prompt))
    said = [(float(x), float(y)) for x, y, _start, _end in positions(prompt)]
    elsewhere = [offset.base for offset in offsets if offset.bare and said.count(offset.base) == 1]
    elsewhere += [*places_taken_back(prompt, home), *places_of_others(prompt)]
    words, placed = set(re.findall(r"[a-z]+", prompt.lower())), nothing_to_search(prompt)
    nothing = [word for word in MEASURED if word in words] + list(pieces_of_sought(prompt))
    parts = dict.fromkeys(_beginnings(prompt)) if placed else {}
    return Told(
        values,
        read_apart(prompt) or read_sections(prompt),
        tuple(dict.fromkeys(elsewhere)),
        tuple(dict.fromkeys(nothing)),
        tuple(parts),
        placed,
        frozenset(dropped_titles(prompt)),
        read_orders(prompt),
    )


def _beginnings(prompt: str) -> Iterator[str]:
    """What has to go on: of a part on another thing that has no place of its own ("the shackle on
    the mooring chain") the part alone is no feature.
    """
    for match in _PART.finditer(prompt):
        words = match["part"].split()
        noun = match["thing"].split()[-1]
        if len(re.findall(rf"\b{re.escape(noun)}\b", prompt, re.IGNORECASE)) == 1:
            yield from (" ".join(words[index:]) for index in range(len(words)))
            yield from (" ".join(words[index:]).lower() for index in range(len(words)))


class ToldValues(Narrowed):
    """The values of another strength where a plan stands, as far as the command leaves a choice."""

    def __init__(self, values: Values, told: Told, progress: Progress) -> None:
        super().__init__(values)
        self._told, self._progress, self._here = told, progress, progress.here

    def parameter(
        self, grammar: Grammar, parameter: Parameter, owner: Task | Skill, context: Context
    ) -> list[tuple[str, Context]]:
        if parameter.type == "text" and isinstance(owner, Task) and self._told.parts:
            text = super().text(grammar, self._told.parts)
            return (
                [(text, context)] if text else super().parameter(grammar, parameter, owner, context)
            )
        number = parameter.type in ("number", "integer") and isinstance(owner, Task)
        value = self._told.value(parameter, owner) if number else None
        given = self._given(parameter, owner) if number else ()
        told = given or ([value] if value is not None else ())
        symbol = one_of(grammar, (written_number(one) for one in usable(told, parameter)))
        return (
            [(symbol, context)] if symbol else super().parameter(grammar, parameter, owner, context)
        )

    def needs(self, parameter: Parameter, owner: Task | Skill) -> bool:
        value = self._told.value(parameter, owner)
        return super().needs(parameter, owner) or (
            value is not None and bool(usable([value], parameter))
        )

    def position(self, grammar: Grammar, without: Positions) -> str | None:
        return super().position(
            grammar, (*without, *self._told.elsewhere, *self._told.too_early(self._progress))
        )

    def text(self, grammar: Grammar, without: Sequence[str]) -> str | None:
        return super().text(grammar, (*without, *self._told.nothing))

    def _given(self, parameter: Parameter, owner: Task | Skill) -> Sequence[float]:
        """The values that are given to the place where the vehicle is, or to the only place that a
        task can go to.
        """
        known = self._here if isinstance(owner, Task) and owner.arrival != "self" else None
        return (
            sorted(self._told.apart.get(known, {}).get(parameter.unit or "", ())) if known else ()
        )
