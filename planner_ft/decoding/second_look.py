"""A second look at an answer that lacks something of what was asked for, or that is not what the
model would have written.

Greedy decoding never goes back: where a choice was nearly even, the other token may have led to the
better answer, and where all that a constraint allowed was improbable (a name that the input does
not hold), a choice before it may have been wrong. So when an answer lacks something that its input
asks for, or strayed from what the model would have chosen, its least certain choices are taken the
other way, one at a time, and each is gone on with to its end. Of all answers that are not much less
probable than the first, the one that lacks least is taken, and looked at in the same way, once.
Probabilities are those of the model before anything is forbidden.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.decoding.row import Row


@dataclass(frozen=True)
class Beginning:
    """The first tokens of an alternative, and the log probability of its choices so far."""

    ids: tuple[int, ...]
    logprob: float


@dataclass(frozen=True)
class SecondLook:
    """`lacks(record, ids)` counts what an answer lacks; None where that cannot be told, and the
    answer stays as it is.

    An answer whose choices `strayed` by more nats than this in all is looked at as well. In each of
    `rounds` at most `alternatives` are tried, and one that is less probable than the first answer
    by more than `margin` (in nats) is not taken.
    """

    lacks: Callable[[dict[str, Any], Sequence[int]], int | None]
    alternatives: int = 5
    margin: float = 4.5
    rounds: int = 2
    strayed: float = 3.0

    def asked(self, record: dict[str, Any], row: Row) -> bool:
        """Whether an answer is to be looked at."""
        lacks = self.lacks(record, row.ids)
        return lacks is not None and (
            lacks > 0 or sum(choice.strayed for choice in row.choices or ()) > self.strayed
        )

    def beginnings(self, row: Row, began: float) -> list[Beginning]:
        """Where the alternatives to an answer begin: its least certain choices, decided the other
        way. What it began with itself stays.
        """
        before, found = began, []
        for choice in row.choices or ():
            doubt = choice.logprob - choice.second_logprob
            found.append(
                (
                    doubt,
                    Beginning(
                        (*row.ids[: choice.place], choice.second), before + choice.second_logprob
                    ),
                )
            )
            before += choice.logprob
        found.sort(key=lambda item: item[0])
        return [
            beginning for doubt, beginning in found[: self.alternatives] if doubt <= self.margin
        ]

    def best(self, record: dict[str, Any], rows: Iterable[tuple[Row, float]]) -> int:
        """The index of the answer to give, among rows with the log probability of what each began
        with; the first row is the answer itself.
        """
        rated: list[tuple[int, float, int]] = []
        for index, (row, began) in enumerate(rows):
            logprob = began + sum(choice.logprob for choice in row.choices or ())
            lacks = self.lacks(record, row.ids)
            if lacks is not None and (not rated or logprob >= -rated[0][1] - self.margin):
                rated.append((lacks, -logprob, index))
        return min(rated)[2]
