"""The state of one sequence: tokens that are fed, and those that its logits decide."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
import torch
from torch import Tensor

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.lookup import LONGEST_DRAFT, Lookup
from planner_ft.decoding.sampling import Sampler

if TYPE_CHECKING:
    from planner_ft.decoding.constraints.answer import Answer

RELEASE = 3.0
"""Nats by which the model must prefer its own value to every one with evidence to keep it."""
LONGEST_RUN = 16
"""Tokens of two kinds at most in a row that end an enforced text: small models write "ggggg..."."""
LONGEST_FORCED = 31
"""Tokens that must follow and are fed with the choice before them; only a release drops them."""
LIKELIEST = 4
"""Tokens of a place whose log-probabilities are kept."""
FinishReason = Literal["stop", "length", "error"]


class Score(NamedTuple):
    """What the model itself holds of a token, whatever a constraint allows: its log-probability
    (nats) over the whole vocabulary, and the likeliest others with theirs.
    """

    logprob: float
    others: tuple[tuple[int, float], ...]


def scores(ids: Sequence[int], logits: Tensor) -> Iterator[Score]:
    """The scores of tokens, each at its place: logits in float32, shape (places, tokens)."""
    values, likeliest = logits.topk(min(LIKELIEST, logits.shape[-1]))
    own = logits.gather(-1, torch.tensor(ids, device=logits.device)[:, None])[:, 0]
    columns = (own, torch.logsumexp(logits, -1), likeliest, values)
    rows = zip(ids, *(column.tolist() for column in columns), strict=True)
    for token, chosen, norm, found, at in rows:
        others = ((one, value - norm) for one, value in zip(found, at, strict=True) if one != token)
        yield Score(chosen - norm, tuple(others)[: LIKELIEST - 1])


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
        """The tokens to feed, and how many logits; no draft where not `wide`."""
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

    @property
    def latest(self) -> list[int]:
        """The tokens that the last pass decided."""
        return self.ids[self._begun : self._begun + self.decided]

    def rate(self, scored: Iterator[Score]) -> None:
        """Take the scores of the latest tokens, the next ones of these."""
        self.scores[self._begun : self._begun + self.decided] = itertools.islice(
            scored, self.decided
        )

    def _choice(self, best: int, logits: Tensor) -> int:
        """The token that the model takes, `best` where it may."""
        constraint = self.constraint
        if self.sampler is not None:
            mask = constraint.mask() if constraint else None
            return self.sampler.draw(len(self.ids), logits, mask)
        if constraint is None:
            return best
        latest = {best, *self.ids[-LONGEST_RUN:]}
        token = constraint.ends_text() if len(latest) <= 2 and len(self.ids) > LONGEST_RUN else None
        if token is None and constraint.admits([best]):
            return best
        if token is None:
            # The most probable token of those allowed, even where logits are infinite or no numbers.
            bits = np.unpackbits(constraint.mask().view(np.uint8), bitorder="little")
            allowed = torch.from_numpy(np.flatnonzero(bits[: len(logits)])).to(logits.device)
            if not len(allowed):
                raise RuntimeError("the constraint allows no token")
            token = int(allowed[logits[allowed].argmax()])
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
