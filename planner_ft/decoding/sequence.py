"""The state of one sequence: tokens that are fed, and those that its logits decide.

The most probable tokens are taken, or others are drawn, for runs that ask the same thing several
times. Every token of an answer then has its own random number, which depends on seed, repeat,
sample and place alone. So an answer depends on none of what the batch holds, how large it is and
what was drafted or forced, as long as the logits do not.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor

from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.constraints.answer import Factory
from planner_ft.decoding.lookup import LONGEST_DRAFT, LONGEST_SURE, Lookup
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.plans import Level

RELEASE = 3.0
"""Nats by which the model must prefer its own value to every one with evidence to keep it."""
LONGEST_RUN, PERIODS = 16, range(1, 6)
"""Tokens in a row that end an enforced text if they are of two kinds at most, or the same few over
and over: small models write "ggggg..." and "the west of the west of the west of".
"""
LONGEST_FORCED = 31
"""Tokens that must follow and are fed with the choice before them; only a release drops them."""
LIKELIEST = 4
"""Tokens of a place whose log-probabilities are kept."""
HUGE = 1e30
FinishReason = Literal["stop", "length", "error"]


@dataclass(frozen=True)
class Sampling:
    """Tokens are drawn at `temperature` (above 0) from the most probable ones that together hold
    `top_p` of the probability.

    `repeat` counts from 1: each repeat of a sample has its own random numbers. Raises PlannerError
    for settings out of range.
    """

    temperature: float
    top_p: float = 1.0
    seed: int = 0
    repeat: int = 1

    def __post_init__(self) -> None:
        if not 0 < self.temperature <= 10:
            bounds = "must be above 0 and at most 10"
            raise PlannerError(f"--temperature {self.temperature:g}: {bounds}")
        if not 0 < self.top_p <= 1:
            raise PlannerError(f"--top-p {self.top_p:g}: must be above 0 and at most 1")

    def seed_of(self, name: str) -> int:
        """The seed of one answer, of 128 bits; `name` tells it from those to other samples."""
        digest = hashlib.sha256(f"{self.seed}\0{self.repeat}\0{name}".encode()).digest()
        return int.from_bytes(digest[:16])

    def numbers(self, name: str, longest: int) -> NDArray[np.float64]:
        """A random number in [0, 1) for every place of an answer of at most `longest` tokens."""
        return np.random.default_rng(self.seed_of(name)).random(longest)

    def draw(self, number: float, logits: Tensor, allowed: Mask | None = None) -> int:
        """The token that a random number gives from logits, shape (tokens); with `allowed`, one of
        those that a constraint allows.

        By inversion over token ids, in float64: where rounding swaps two tokens of like
        probability, what is drawn stays the same.
        """
        raw = logits.detach().double().cpu().numpy()
        scores = np.nan_to_num(raw, nan=-HUGE, posinf=HUGE, neginf=-HUGE)
        usable = np.full(len(scores), True) if allowed is None else _bits(allowed, len(scores))
        below = np.minimum(scores - scores[usable].max(), 0)
        weights = np.where(usable, np.exp(below / self.temperature), 0)
        if self.top_p < 1:
            # The smallest set of tokens that holds `top_p` (Holtzman et al. 2020), the others at 0.
            order = np.argsort(-weights, kind="stable")
            before = weights[order].cumsum() - weights[order]
            weights[order[before >= self.top_p * weights.sum()]] = 0
        cumulative = weights.cumsum()
        drawn = np.searchsorted(cumulative, number * cumulative[-1], side="right")
        # Rounding may put the number at the very end, where tokens without any weight may stand.
        return min(int(drawn), int(np.flatnonzero(weights)[-1]))


def _bits(mask: Mask, width: int) -> NDArray[np.bool_]:
    """Whether a mask allows each token; one of them at least."""
    bits = np.unpackbits(mask.view(np.uint8), bitorder="little", count=width)
    usable: NDArray[np.bool_] = bits == 1
    if not usable.any():
        raise RuntimeError("the constraint allows no token")
    return usable


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


@dataclass(frozen=True)
class Query:
    """A question to a level's agent: its record ({"prompt", ...}) and prompt ids."""

    level: Level
    record: dict[str, Any]
    prompt: tuple[int, ...]

    @property
    def name(self) -> str:
        """The record's id, or its prompt's tokens: tells the query from others."""
        return str(self.record.get("id") or self.prompt)


@dataclass(frozen=True)
class Method:
    """How tokens are chosen, and what saves forward passes; an answer depends on `constraint`,
    `sampling` and `entries` alone.

    Without `sampling` the most probable token is taken. `constraint` is enforced, and with
    `fast_forward` the tokens that must follow are fed together. With a `lookup` likely tokens are
    verified in one pass: from the prompt, the answer so far, then from it. `entries` counts the
    tasks or steps of an answer's tokens: a constrained answer with more than twice as many as the
    free one, and two, is given up.
    """

    constraint: Factory | None = None
    fast_forward: bool = True
    lookup: Lookup | None = field(default_factory=Lookup)
    sampling: Sampling | None = None
    entries: Callable[[Sequence[int]], int] | None = None


class SequenceState:
    """An answer of at most `longest` tokens and `most` entries that begins with tokens `begun`.

    `ids` is the answer so far; its last tokens, which the model has not been fed yet, are
    `pending`, and `draft` stands behind them: what the constraint says must follow, then what
    `lookup` finds likely. `diverged` is the place of the first token that the model without the
    constraint would not have chosen. `scores` are those of `ids`, None where no pass has decided a
    token. Where `enough(ids)` holds, the answer stays. Raises PlannerError when the constraint
    needs more room than `longest` tokens.
    """

    def __init__(
        self,
        query: Query,
        method: Method,
        limits: Limits,
        longest: int,
        most: int | None = None,
        begun: Sequence[int] = (),
        enough: Callable[[Sequence[int]], bool] = lambda ids: False,
    ) -> None:
        self.query, self.method, self.limits, self.longest = query, method, limits, longest
        rules, sampling, base = method.constraint, method.sampling, method.lookup
        self.constraint = rules.start(query.record, longest, most) if rules else None
        self.lookup = Lookup(query.prompt, base=base) if base else None
        self.numbers = sampling.numbers(query.name, longest) if sampling else ()
        self._enough, self.ids, self.forward_passes = enough, list[int](), 0
        self.scores: list[Score | None] = [None] * len(begun)
        self.finished: FinishReason | None = None
        self.diverged: int | None = None
        for token in begun:
            self._add(token)
        self.pending, self.draft, self._reach = [*query.prompt, *begun], list[int](), LONGEST_DRAFT

    def feed(self, *, wide: bool, alone: bool = False) -> tuple[list[int], int]:
        """The tokens to feed, and how many logits; no draft where not `wide`. A row that is `alone`
        has longer drafts as long as they are right: steps that repeat each other.
        """
        self.forward_passes += 1
        self.draft = self._likely(self._reach if alone else LONGEST_DRAFT) if wide else []
        return self.pending + self.draft, 1 + len(self.draft)

    def choose(self, best: Sequence[int], logits: Tensor) -> list[int]:
        """Take the tokens that the pass decided: the most probable ones (`best`) of its wanted
        logits, shape (wanted, tokens), where they are allowed, up to the first that the draft had
        not.
        """
        decided = list[int]()
        for place, drafted in enumerate([*self.draft, None]):
            decided.append(self._choice(best[place], logits[place]))
            self._add(decided[-1])
            complete = self.constraint is not None and self.constraint.ended
            if complete and self.method.fast_forward and not self.finished:
                self._add(self.limits.end_ids[0])
            if self.finished or decided[-1] != drafted:
                break
        right = len(decided) > len(self.draft) >= LONGEST_DRAFT
        self._reach = min(2 * self._reach, LONGEST_SURE) if right else LONGEST_DRAFT
        self.pending = decided[-1:]
        if not self.finished and self._enough(self.ids):
            self.finished = "stop"
        return decided

    def rate(self, scored: Iterable[Score]) -> None:
        """Take the scores of the tokens that the last pass decided."""
        self.scores += scored
        self.scores += [None] * (len(self.ids) - len(self.scores))

    def _choice(self, best: int, logits: Tensor) -> int:
        """The token that the model takes, `best` where it may."""
        constraint, sampling = self.constraint, self.method.sampling
        if sampling is not None:
            mask = constraint.mask() if constraint else None
            return sampling.draw(self.numbers[len(self.ids)], logits, mask)
        if constraint is None:
            return best
        token = constraint.ends_text() if self._loops(best) else None
        if token is None and constraint.allows(best):
            return best
        if token is None:
            # The most probable token of those allowed, even where logits are infinite or no numbers.
            usable = np.flatnonzero(_bits(constraint.mask(), len(logits)))
            allowed = torch.from_numpy(usable).to(logits.device)
            token = int(allowed[logits[allowed].argmax()])
            doubt = float(logits[best]) - float(logits[token])
            if doubt > RELEASE and constraint.release(best):
                return best
        self.diverged = len(self.ids) if self.diverged is None else self.diverged
        return token

    def _loops(self, token: int) -> bool:
        """Whether the last tokens and the next one say the same over and over."""
        last = [*self.ids[-LONGEST_RUN:], token]
        same = len({*last}) <= 2 or any(last[size:] == last[:-size] for size in PERIODS)
        return same and len(last) > LONGEST_RUN

    def _add(self, token: int) -> None:
        """A token joins the answer."""
        self.ids.append(token)
        if self.constraint is not None:
            self.constraint.accept(token)
        if token in self.limits.end_ids:
            self.finished = "stop"
        elif len(self.ids) >= self.longest:
            self.finished = "length"
        if self.lookup is not None:
            self.lookup.extend(token)

    def _likely(self, reach: int) -> list[int]:
        """Tokens that may follow those that are pending: `reach` of them, or all that must."""
        room, draft = self.longest - len(self.ids) - 1, list[int]()
        if self.constraint is not None and self.method.fast_forward:
            draft = self.constraint.expected()[: min(LONGEST_FORCED, room)]
        if self.lookup is not None:
            draft += self.lookup.propose(min(reach, room) - len(draft), draft)
        return draft
