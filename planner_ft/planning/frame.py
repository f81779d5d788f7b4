"""Geographic positions of a command, told to the agents in local metres.

With an origin they are converted. Without one, and far from it, the agents are told placeholders,
which become the unresolved location in the plan; the place has the words of the command as its
name.
"""

import functools
import itertools
import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from planner_ft.facts import Geographic, Span
from planner_ft.facts.geographic import read_geographic
from planner_ft.facts.spelling import fluent
from planner_ft.support.geodesy import NEAREST_POLE, Origin
from planner_ft.vocabulary import Vocabulary

_COMMA = r"\s?[=:]?\s?[-−–]?\d+,\d+"
COMMAS = re.compile(rf"(?i)(?<!\w)x{_COMMA}(?:\s?m\b)?[,;]?(?:\s+\w+)?\s+y{_COMMA}(?![\d,.]*\d)")
"""Coordinates by their axes with decimal commas."""
FAR = 100_000.0
"""Metres from the origin beyond which a position of the command makes the origin doubtful."""


@dataclass(frozen=True)
class Swap:
    """A geographic position of the command and the local one, in metres, in its place.

    `known`: it was converted; else it is a placeholder.
    """

    start: int
    end: int
    words: str
    position: tuple[float, float]
    known: bool
    bracketed: bool

    @property
    def written(self) -> str:
        """The position as the agents read it."""
        pair = f"{self.position[0]:.7g}, {self.position[1]:.7g}"
        return pair if self.bracketed else f"[{pair}]"


@dataclass(frozen=True)
class Frame:
    """A command as it was typed, and as it is in local metres."""

    command: str
    swaps: tuple[Swap, ...] = ()

    @functools.cached_property
    def spoken(self) -> str:
        """The command with every swap made, the commas of "x = 12,5 and y = 40,5" as points, and
        blanks for "uh".
        """
        parts, done = [], 0
        for swap in self.swaps:
            parts += [self.command[done : swap.start], swap.written]
            done = swap.end
        text = fluent("".join([*parts, self.command[done:]]))
        return COMMAS.sub(lambda match: match[0].replace(",", "."), text)

    def span(self, start: int, end: int) -> Span:
        """Where words of `spoken` stand in the command; those of a swap are its words."""
        first, last, shift = start, end, 0
        for swap in self.swaps:
            begin = swap.start + shift
            behind = begin + len(swap.written)
            shift += len(swap.written) - (swap.end - swap.start)
            if start >= behind:
                first = start - shift
            elif start >= begin:
                first = swap.start
            if end >= behind:
                last = end - shift
            elif end > begin:
                last = swap.end
        return first, last

    def restored(self, plan: Mapping[str, Any], vocabulary: Vocabulary) -> dict[str, Any]:
        """The plan with the unresolved location and the command's words in place of each swap."""
        unknown = list(vocabulary.unresolved)
        return {key: self._restored(value, unknown) for key, value in plan.items()}

    @property
    def _open(self) -> Iterator[Swap]:
        return (swap for swap in self.swaps if not swap.known)

    def _restored(self, value: Any, unresolved: list[float]) -> Any:
        if isinstance(value, dict):
            return {key: self._restored(item, unresolved) for key, item in value.items()}
        if isinstance(value, str):
            for swap in self._open:
                x, y = (re.escape(f"{part:g}") for part in swap.position)
                form = rf"[\[(]?\s?(?<!\d){x}\s?,\s?{y}(?!\d)\s?[\])]?"
                value = swap.words.join(re.split(form, value))
            return value
        if isinstance(value, list):
            if any(value == list(swap.position) for swap in self._open):
                return unresolved
            return [self._restored(item, unresolved) for item in value]
        return value


@functools.lru_cache(maxsize=256)
def agents_frame(command: str, origin: Origin | None) -> Frame:
    """The command as the agents are told it: a placeholder is no number that it has itself."""
    swaps, free = list[Swap](), _placeholders(command)
    for place in read_geographic(command):
        words = command[place.start : place.end].strip()
        bracketed = command[: place.start].rstrip().endswith(("[", "("))
        local = origin and _local(place, origin)
        near = local if local and math.hypot(*local) <= FAR else None
        position = near or next(free)
        swaps.append(Swap(place.start, place.end, words, position, near is not None, bracketed))
    return Frame(command, tuple(swaps))


def local_frame(command: str, origin: Origin | None) -> Frame:
    """The command with the geographic positions in metres that the origin gives."""
    swaps = agents_frame(command, origin).swaps if origin else ()
    return Frame(command, tuple(swap for swap in swaps if swap.known))


def frame_of(document: Mapping[str, Any]) -> Frame:
    """The command of a plan document in the local metres of its origin."""
    return local_frame(document["command"], origin_of(document))


def origin_of(document: Mapping[str, Any]) -> Origin | None:
    """Where [0, 0] of a plan document lies; None where nobody has said it."""
    origin = document.get("origin")
    return Origin(origin["latitude"], origin["longitude"]) if origin else None


def doubt(command: str, origin: Origin) -> str | None:
    """What speaks against an origin, in a sentence: 0,0, swapped, far from the command's places."""
    if origin.latitude == origin.longitude == 0:
        return "The origin is 0,0, in the Gulf of Guinea; is that where [0, 0] lies?"
    for place in read_geographic(command):
        local, turned = _local(place, origin), _local(place, Origin(*_turned(origin)))
        if local and math.hypot(*local) > FAR:
            words, away = command[place.start : place.end].strip(), math.hypot(*local) / 1000
            text = f"{words} is {away:.0f} km from the origin, {origin}"
            if turned and math.hypot(*turned) <= FAR:
                return f"{text}; latitude and longitude of one of them are likely swapped."
            return f"{text}; is the origin right?"
    return None


def _turned(origin: Origin) -> tuple[float, float]:
    usable = abs(origin.longitude) < NEAREST_POLE
    return (origin.longitude, origin.latitude) if usable else (origin.latitude, origin.longitude)


def _local(place: Geographic, origin: Origin) -> tuple[float, float] | None:
    """The position in metres, to a decimetre; None where a part is not said or out of range."""
    latitude, longitude = place.latitude, place.longitude
    if latitude is None or longitude is None or abs(latitude) > 90 or abs(longitude) > 180:
        return None
    x, y = origin.to_local(latitude, longitude)
    return round(x, 1) + 0.0, round(y, 1) + 0.0


def _placeholders(command: str) -> Iterator[tuple[float, float]]:
    for number in itertools.count():
        x, y = 137 + 26 * number, 94 + 17 * number
        if str(x) not in command and str(y) not in command:
            yield float(x), float(y)
