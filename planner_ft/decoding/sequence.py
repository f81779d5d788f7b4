"""The state of one sequence: the tokens that are fed to the model, and those that its logits
decide.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np
import torch
from torch import Tensor

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.constraints import Constraint
from planner_ft.decoding.lookup import LONGEST_DRAFT, Lookup
from planner_ft.decoding.sampling import Sampler

RELEASE = 3.0
"""Nats by which the model must prefer its own value to every one with evidence to keep it."""
FinishReason = Literal["stop", "length", "error"]


class SequenceState:
    """An answer of at most `longest` tokens to a prompt, which begins with the tokens `begun`.

    `ids` is the answer so far; its last tokens, which the model has not been fed yet, are
    `pending`, and `draft` stands behind them. With `fast_forward`, tokens that the constraint
    forces join the answer without a choice by the model. Choices are the most probable tokens, or
    drawn by `sampler`. `diverged` is the place of the first token that the model without the
    constraint would not have chosen. Where `enough(ids)` holds, the answer is left as it is.
    """

    def __init__(
        self,
        prompt: Sequence[int],
        limits: Limits,
        longest: int,
        constraint: Constraint | None = None,
        lookup: Lookup | None = None,
        *,
        fast_forward: bool = True,
        sampler: Sampler | None = None,
        begun: Sequence[int] = (),
        enough: Callable[[Sequence[int]], bool] | None = None,
    ) -> None:
        self.end_ids, self.longest = limits.end_ids, longest
        self.constraint, self.lookup, self.sampler = constraint, lookup, sampler
        self.fast_forward, self._enough = fast_forward, enough
        self.ids: list[int] = []
        self.finished: FinishReason | None = None
        self.diverged: int | None = None
        self.forward_passes = self.forced_tokens = self.drafted_tokens = 0
        for token in begun:
            self._add(token)
        self._add_forced()
        self.pending = [*prompt, *self.ids]
        self.draft: list[int] = []
        self._checks = 0
        self._propose()

    @property
    def _tracks(self) -> bool:
        return self.constraint is not None and self.sampler is None and self.diverged is None

    def feed(self, *, wide: bool) -> tuple[list[int], int]:
        """The tokens of the next pass, and how many logits at their end are wanted.

        All sequences start with their whole prompt. One that is not `wide` goes on a token at a
        time, so nothing is drafted for it.
        """
        first = not self.forward_passes
        width = len(self.pending) if wide or first else 1
        self._checks = (len(self.ids) if first else width - 1) if self._tracks else 0
        fed, self.pending = self.pending[:width], self.pending[width:]
        self.forward_passes += 1
        if not wide:
            self.draft, self.lookup = [], None
        return fed + self.draft, self._checks + 1 + len(self.draft)

    def choose(self, best: Sequence[int], logits: Tensor) -> int:
        """Take what the pass decided: the most probable tokens (`best`) of its wanted logits, shape
        (wanted, tokens), where they are allowed.

        Returns how many of the fed tokens were a wrong draft.
        """
        behind = len(self.ids) - len(self.pending) - self._checks
        self._compare(behind, best[: self._checks])
        if self.pending:
            if self._tracks:
                self._compare(len(self.ids) - len(self.pending), best[-1:])
            return 0
        best, logits = best[self._checks :], logits[self._checks :]
        draft, right = self.draft, 0
        while True:
            place = len(self.ids)
            added = self._add_choice(best[right], logits[right])
            matched = _common(added, draft[right:])
            self._compare(place, best[right : right + min(matched, len(added) - 1) + 1])
            right += matched
            if self.finished or matched < len(added):
                break
        self.drafted_tokens += right
        self.pending = added[matched:]
        if self._enough is not None and not self.finished and self._enough(self.ids):
            self.finished = "stop"
        self._propose()
        return len(draft) - right

    def _compare(self, place: int, best: Sequence[int]) -> None:
        """Note where the answer first left the tokens that the model would have chosen."""
        if self._tracks:
            places = (at for at, token in enumerate(best, place) if self.ids[at] != token)
            self.diverged = next(places, None)

    def _add_choice(self, best: int, logits: Tensor) -> list[int]:
        """Add the model's choice and what it forces; return both."""
        before, constraint = len(self.ids), self.constraint
        if self.sampler is not None:
            token = self.sampler.draw(before, logits, constraint.mask() if constraint else None)
        elif constraint is None or constraint.admits([best]):
            token = best
        else:
            token = _best_allowed(constraint, logits)
            doubt = float(logits[best]) - float(logits[token])
            if doubt > RELEASE and constraint.release(best):
                token = best
        self._add(token)
        self._add_forced()
        return self.ids[before:]

    def _add(self, token: int) -> None:
        """A token joins the answer."""
        self.ids.append(token)
        if self.constraint is not None:
            self.constraint.accept(token)
        if token in self.end_ids:
            self.finished = "stop"
        elif len(self.ids) >= self.longest:
            self.finished = "length"
        if self.lookup is not None:
            self.lookup.extend(token)

    def _add_forced(self) -> None:
        """Add the tokens that need no choice."""
        if self.constraint is None or not self.fast_forward:
            return
        while not self.finished and (
            forced := self.end_ids[:1] if self.constraint.ended else self.constraint.forced()
        ):
            for token in forced[: self.longest - len(self.ids)]:
                self._add(token)
                self.forced_tokens += 1

    def _propose(self) -> None:
        """Draft what may follow."""
        self.draft = []
        if self.lookup is not None and not self.finished:
            room = min(LONGEST_DRAFT, self.longest - len(self.ids) - 1)
            expected = self.constraint.expected() if self.constraint else []
            draft = expected[:room] or self.lookup.propose(room)
            kept = len(draft) if self.constraint is None else self.constraint.admits(draft)
            self.draft = draft[:kept]


def _best_allowed(constraint: Constraint, logits: Tensor) -> int:
    """The most probable token of those allowed, even where logits are infinite or no numbers."""
    bits = np.unpackbits(constraint.mask().view(np.uint8), bitorder="little")[: len(logits)]
    allowed = torch.from_numpy(np.flatnonzero(bits)).to(logits.device)
    if not len(allowed):
        raise RuntimeError("the constraint allows no token")
    return int(allowed[logits[allowed].argmax()])


def _common(one: Sequence[int], other: Sequence[int]) -> int:
    """Length of the beginning that two sequences share."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((at for at, (left, right) in pairs if left != right), min(len(one), len(other)))
