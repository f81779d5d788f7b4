"""One answer in the making: what is fed to the model, and what its logits decide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
import torch
from torch import Tensor

from planner_ft.decoding.constraints import Constraint
from planner_ft.decoding.drafting import LONGEST_DRAFT, Drafter
from planner_ft.decoding.limits import Limits
from planner_ft.decoding.sampling import Sampler

LEAST_SUBSTITUTE = 0.02
"""Below this share of the probability, what is allowed is no substitute for the model's own choice
where the answer or a list could have ended instead.
"""

FinishReason = Literal["stop", "length", "error"]


@dataclass(frozen=True)
class Choice:
    """A choice of the model at a place of its answer: the token's log probability, and what came
    second of those allowed, with its own.

    `strayed` is how little of the probability, in nats, the model left to all that was allowed: 0
    where it would choose so itself.
    """

    place: int
    logprob: float
    second: int
    second_logprob: float
    strayed: float


class Row:
    """An answer of at most `longest` tokens to a prompt.

    `ids` is the answer so far; its last tokens, which the model has not been fed yet, are
    `pending`, and `draft` stands behind them. With `fast_forward`, tokens that the constraint
    forces join the answer without a choice by the model. Choices are the most probable tokens, or
    drawn by `sampler`. The answer begins with `begun`; with `remembers`, `choices` keeps the
    model's choices behind it that had an alternative. A row that `goes_back` is finished early
    where a choice before was wrong: `back` is what the answer is to begin with instead.
    """

    def __init__(
        self,
        prompt: Sequence[int],
        limits: Limits,
        longest: int,
        constraint: Constraint | None = None,
        drafter: Drafter | None = None,
        *,
        fast_forward: bool = True,
        sampler: Sampler | None = None,
        begun: Sequence[int] = (),
        remembers: bool = False,
        goes_back: bool = False,
    ) -> None:
        self.end_ids = limits.end_ids
        self.longest = longest
        self.constraint = constraint
        self.drafter = drafter
        self.fast_forward = fast_forward
        self.sampler = sampler
        self.ids: list[int] = []
        self.pending = list(prompt)
        self.draft: list[int] = []
        self.finished: FinishReason | None = None
        self.goes_back = goes_back
        self.back: list[int] | None = None
        self.forward_passes = self.forced_tokens = self.drafted_tokens = 0
        self.choices: list[Choice] | None = [] if remembers else None
        for token in begun:
            self._add(token)
        self._add_forced()
        self.pending += self.ids
        self._propose()

    def feed(self, *, wide: bool) -> tuple[list[int], int]:
        """The tokens of the next pass, and how many logits at their end are wanted.

        All rows start with their whole prompt. One that is not `wide` goes on a token at a time, so
        nothing is drafted for it.
        """
        width = len(self.pending) if wide or not self.forward_passes else 1
        fed, self.pending = self.pending[:width], self.pending[width:]
        self.forward_passes += 1
        if not wide:
            self.draft, self.drafter = [], None
        return fed + self.draft, len(self.draft) + 1

    def choose(self, best: Sequence[int], logits: Tensor) -> int:
        """Take what the pass decided: the most probable tokens (`best`) of its wanted logits, shape
        (wanted, tokens), where they are allowed.

        Returns how many of the fed tokens were a wrong draft.
        """
        if self.pending:
            return 0
        draft, right = self.draft, 0
        while True:
            added = self._add_choice(best[right], logits[right])
            matched = _common(added, draft[right:])
            right += matched
            if self.finished or matched < len(added):
                break
        self.drafted_tokens += right
        self.pending = added[matched:]
        self._propose()
        return len(draft) - right

    def _add_choice(self, best: int, logits: Tensor) -> list[int]:
        """Add the model's choice and what it forces; return both."""
        before = len(self.ids)
        if self.sampler is not None:
            token = self.sampler.draw(
                before, logits, self.constraint.mask() if self.constraint else None
            )
        elif self._allows(best):
            token = best
        elif whole := self._instead(best, logits):
            return self._end_as(whole)
        elif begun := self._declined(best, logits):
            self.back, self.finished = begun, "stop"
            return []
        else:
            token = self._best_allowed(best, logits)
        if self.choices is not None:
            self._remember(token, logits)
        self._add(token)
        self._add_forced()
        return self.ids[before:]

    def _instead(self, best: int, logits: Tensor) -> list[int] | None:
        """The answer to end with, where the model all but rules out what it would have to take for
        its own choice `best`.
        """
        whole = self.constraint.instead(best) if self.constraint is not None else None
        return whole if whole and self._no_substitute(logits) else None

    def _declined(self, best: int, logits: Tensor) -> list[int] | None:
        """What the answer is to begin with, where a list was opened for what the model means alone:
        `best`, which may not stand in it.
        """
        begun = (
            self.constraint.declined(best)
            if self.constraint is not None and self.goes_back
            else None
        )
        return begun if begun and self._no_substitute(logits) else None

    def _no_substitute(self, logits: Tensor) -> bool:
        """Whether the model all but rules out what is allowed."""
        return (
            float(torch.softmax(logits.float(), 0)[self._allowed(logits)].sum()) < LEAST_SUBSTITUTE
        )

    def _end_as(self, ids: list[int]) -> list[int]:
        """End with this answer, for which the end of the one in the making was dropped; nothing is
        left to feed.
        """
        self.ids, self.finished = ids, "stop"
        self.forced_tokens = min(self.forced_tokens, len(ids))
        return []

    def _allows(self, token: int) -> bool:
        return self.constraint is None or self.constraint.admits([token]) == 1

    def _best_allowed(self, best: int, logits: Tensor) -> int:
        """The most probable token of those that the constraint allows for the model's own choice
        `best`, even where logits are infinite or no numbers.
        """
        akin = self.constraint.akin(best) if self.constraint is not None else []
        allowed = torch.tensor(akin, device=logits.device) if akin else self._allowed(logits)
        return int(allowed[logits[allowed].argmax()])

    def _allowed(self, logits: Tensor) -> Tensor:
        """The tokens that the constraint allows."""
        if self.constraint is None:
            return torch.arange(len(logits), device=logits.device)
        bits = np.unpackbits(self.constraint.mask().view(np.uint8), bitorder="little")[
            : len(logits)
        ]
        allowed = torch.from_numpy(np.flatnonzero(bits)).to(logits.device)
        if not len(allowed):
            raise RuntimeError("the constraint allows no token")
        return allowed

    def _remember(self, token: int, logits: Tensor) -> None:
        """Keep the choice of a token, where there is an alternative."""
        assert self.choices is not None
        allowed = self._allowed(logits)
        if len(allowed) > 1:
            logprobs = torch.log_softmax(logits.float(), 0)[allowed]
            strayed = -float(logprobs.logsumexp(0))
            logprob = float(logprobs[allowed == token])
            best = logprobs.masked_fill_(allowed == token, -torch.inf).argmax()
            self.choices.append(
                Choice(len(self.ids), logprob, int(allowed[best]), float(logprobs[best]), strayed)
            )

    def _add(self, token: int) -> None:
        """A token joins the answer."""
        self.ids.append(token)
        if self.constraint is not None:
            self.constraint.accept(token)
        if token in self.end_ids:
            self.finished = "stop"
        elif len(self.ids) >= self.longest:
            self.finished = "length"
        if self.drafter is not None:
            self.drafter.extend(token)

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
        if self.drafter is not None and not self.finished:
            draft = self.drafter.propose(min(LONGEST_DRAFT, self.longest - len(self.ids) - 1))
            self.draft = (
                draft if self.constraint is None else draft[: self.constraint.admits(draft)]
            )


def _common(one: Sequence[int], other: Sequence[int]) -> int:
    """Length of the beginning that two sequences share."""
    return next(
        (
            index
            for index, (left, right) in enumerate(zip(one, other, strict=False))
            if left != right
        ),
        min(len(one), len(other)),
    )
