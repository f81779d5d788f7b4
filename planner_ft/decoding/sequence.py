"""The state of one sequence: the tokens that are fed to the model, and those that its logits
decide.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Literal

import numpy as np
import torch
from torch import Tensor

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.lookup import LONGEST_DRAFT, Lookup
from planner_ft.decoding.odds import Odds, Score, score
from planner_ft.decoding.sampling import Sampler

if TYPE_CHECKING:
    from planner_ft.decoding.constraints.answer import Answer

RELEASE = 3.0
"""Nats by which the model must prefer its own value to every one with evidence to keep it."""
LONGEST_RUN = 16
"""Tokens in a row, of two kinds at most, behind which an enforced text ends: a small model can
write "ggg" for ever.
"""
LONGEST_FORCED = 31
"""Tokens that must follow and are fed with the choice before them: nothing of them is taken back,
but for a value that is released.
"""
FinishReason = Literal["stop", "length", "error"]


class SequenceState:
    """An answer of at most `longest` tokens to a prompt, which begins with the tokens `begun`.

    `ids` is the answer so far; its last tokens, which the model has not been fed yet, are
    `pending`, and `draft` stands behind them: with `fast_forward` what the constraint says must
    follow, then what `lookup` finds likely. Choices are the most probable tokens, or drawn by
    `sampler`. `diverged` is the place of the first token that the model without the constraint
    would not have chosen. `scores` are those of `ids`, None where no pass has decided a token, and
    `decided` is how many tokens the last one did. Where `enough(ids)` holds, the answer stays.
    """

    def __init__(
        self,
        prompt: Sequence[int],
        limits: Limits,
        longest: int,
        constraint: Answer | None = None,
        lookup: Lookup | None = None,
        *,
        fast_forward: bool = True,
        sampler: Sampler | None = None,
        begun: Sequence[int] = (),
        enough: Callable[[Sequence[int]], bool] | None = None,
    ) -> None:
        self.end_ids, self.longest = limits.end_ids, longest
        self.constraint, self.lookup, self.sampler = constraint, lookup, sampler
        self.fast_forward, self._enough, self._wide = fast_forward, enough, True
        self.ids: list[int] = []
        self.scores: list[Score | None] = []
        self.decided = 0
        self.finished: FinishReason | None = None
        self.diverged: int | None = None
        self.forward_passes = 0
        for token in begun:
            self._add(token)
        self.pending, self.draft = [*prompt, *begun], list[int]()
        self._propose()

    def feed(self, *, wide: bool) -> tuple[list[int], int]:
        """The tokens of the next pass, and how many logits at their end are wanted. Nothing is
        drafted for a sequence that is not `wide`.
        """
        self.forward_passes += 1
        self._wide = wide
        if not wide:
            self.draft.clear()
        return self.pending + self.draft, 1 + len(self.draft)

    def choose(self, best: Sequence[int], logits: Tensor) -> int:
        """Take what the pass decided: the most probable tokens (`best`) of its wanted logits, shape
        (wanted, tokens), where they are allowed.

        Returns how many of the fed tokens were a wrong draft.
        """
        right, draft, self._begun = 0, self.draft, len(self.ids)
        while True:
            token = self._choice(best[right], logits[right])
            self._add(token)
            complete = self.constraint is not None and self.constraint.ended
            if complete and self.fast_forward and not self.finished:
                self._add(self.end_ids[0])
            if self.finished or draft[right : right + 1] != [token]:
                break
            right += 1
        self.pending, self.decided = [token], right + 1
        if self._enough is not None and not self.finished and self._enough(self.ids):
            self.finished = "stop"
        self._propose()
        return len(draft) - right

    def rate(self, places: Sequence[Odds], logits: Tensor) -> None:
        """Take the odds of the places that the last pass decided, and their logits."""
        for at, (place, row) in enumerate(zip(places, logits, strict=True), self._begun):
            self.scores[at] = score(self.ids[at], place, row)

    def _choice(self, best: int, logits: Tensor) -> int:
        """The token that the model takes, `best` where it may."""
        constraint = self.constraint
        if self.sampler is not None:
            allowed = constraint.mask() if constraint else None
            return self.sampler.draw(len(self.ids), logits, allowed)
        if constraint is None:
            return best
        latest = {best, *self.ids[-LONGEST_RUN:]}
        token = constraint.ends_text() if len(latest) <= 2 and len(self.ids) > LONGEST_RUN else None
        if token is None and constraint.admits([best]):
            return best
        if token is None:
            token = _best_allowed(constraint, logits)
            doubt = float(logits[best]) - float(logits[token])
            if doubt > RELEASE and constraint.release(best):
                return best
        self.diverged = len(self.ids) if self.diverged is None else self.diverged
        return token

    def _add(self, token: int) -> None:
        """A token joins the answer."""
        self.ids.append(token)
        self.scores.append(None)
        if self.constraint is not None:
            self.constraint.accept(token)
        if token in self.end_ids:
            self.finished = "stop"
        elif len(self.ids) >= self.longest:
            self.finished = "length"
        if self.lookup is not None:
            self.lookup.extend(token)

    def _propose(self) -> None:
        """Draft what may follow."""
        room = self.longest - len(self.ids) - 1 if self._wide and not self.finished else 0
        constraint, draft = self.constraint, list[int]()
        if constraint is not None and self.fast_forward:
            draft = constraint.expected()[: min(LONGEST_FORCED, room)]
        if self.lookup is not None:
            draft += self.lookup.propose(min(LONGEST_DRAFT, room) - len(draft), draft)
        self.draft = draft[: constraint.admits(draft)] if constraint and draft else draft


def _best_allowed(constraint: Answer, logits: Tensor) -> int:
    """The most probable token of those allowed, even where logits are infinite or no numbers."""
    bits = np.unpackbits(constraint.mask().view(np.uint8), bitorder="little")[: len(logits)]
    allowed = torch.from_numpy(np.flatnonzero(bits)).to(logits.device)
    if not len(allowed):
        raise RuntimeError("the constraint allows no token")
    return int(allowed[logits[allowed].argmax()])
