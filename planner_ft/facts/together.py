"""What numbers of a text say together: "5 minutes 30", "200 by 120 feet", "six foot two"."""

import bisect
import itertools
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

WRITTEN, BARE, IN_PAIR, AS_BEFORE, REREAD = range(5)
"""How plainly: with unit, without, half of a pair, in another's unit, in another reading."""
FOOT = 0.3048
NEIGHBOURS = 5  # characters that "and" with its blanks takes between two parts of one value
BY = re.compile(r"\s?(?:by|x|×|\*|(?:wide|broad|long|across),?\s(?:by|x|and))\s?", re.IGNORECASE)


@dataclass(frozen=True)
class Number:
    """A number of a text: `value` in `unit` (None where no unit is said), at `start` to `end`, sign
    included; `said` before conversion, 0 for a sum, ends at `stop`. A lower `rank` is a plainer way
    of saying it.

    `counts`: it is no measure, but counts things, stands for a thing, or is a heading or a part.
    """

    value: float
    rank: int
    start: int
    end: int
    unit: str | None = None
    said: float = 0.0
    counts: bool = False
    stop: int = 0
    added: float = 0.0

    @property
    def factor(self) -> float:
        """What one unit as it was said is in `unit`, beside what is `added`; 0 for a nought."""
        return (self.value - self.added) / self.said if self.said else 0.0


def with_units(text: str, numbers: list[Number]) -> list[Number]:
    """The numbers; "200 by 120 feet" and "100x60x20 m" have the unit of all behind the last."""
    lengths = {number.start: number for number in numbers if number.unit == "m" and number.factor}
    shared = list(numbers)
    for place in sorted(range(len(numbers)), key=lambda place: -numbers[place].start):
        one = numbers[place]
        by = BY.match(text, one.end) if one.unit is None else None
        if by and (two := lengths.get(by.end())):
            made = replace(one, value=one.said * two.factor, unit="m", counts=False)
            shared[place] = lengths[made.start] = made
    return shared


def neighbours(numbers: Iterable[Number], unit: str | None) -> list[Number]:
    """The values that neighbouring numbers are together: "two minutes and thirty seconds"."""
    return [total for total, _whole in sums(numbers, unit)]


def sums(numbers: Iterable[Number], unit: str | None) -> Iterator[tuple[Number, bool]]:
    """Neighbours that are one value ("5 minutes 30"), and whether their parts are none."""
    for first, second in pairs(numbers, NEIGHBOURS) if unit in ("s", "m") else ():
        gap, value = second.start - first.end, 0.0
        if first.unit != unit or gap < 0 or not first.said:
            continue
        if unit == "s" and second.unit == "s":
            value = first.value + second.value
        elif unit == "s" and second.unit is None and gap <= 1:
            value = first.value + second.value * first.factor / 60
        elif unit == "m" and abs(first.factor - FOOT) < 1e-6 and 0 < second.said < 12:
            inches = second.unit is None or abs(second.factor - FOOT / 12) < 1e-6
            value = first.value + second.said * FOOT / 12 if inches else 0.0
        if value:
            joined = unit == second.unit == "s" and gap <= 1 and first.said > 0 and second.said > 0
            whole = joined and first.factor > second.factor and second.value < first.factor
            rank = max(first.rank, second.rank) // REREAD * REREAD
            # In "hovr five seconds" the five seconds stand beside "hour five seconds".
            yield Number(value, rank, first.start, second.end, unit), whole and not rank


def pairs(numbers: Iterable[Number], most: int) -> Iterator[tuple[Number, Number]]:
    """Numbers with those that begin behind them, at most this many characters on."""
    known = sorted(numbers, key=lambda number: number.start)
    for first in known:
        begin = bisect.bisect_left(known, first.stop, key=lambda number: number.start)
        for second in itertools.islice(known, begin, None):
            if second.start > first.end + most:
                break
            yield first, second
