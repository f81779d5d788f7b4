"""Constrained decoding: which tokens may follow, so that an answer cannot leave the rules of its
strength.

`factory.constraint_factory` compiles once per (tokenizer, level, vocabulary, strength); `start`
gives the state of one answer, which the generation loop asks for a mask before each choice and
tells every token that was chosen.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

__all__ = ["Constraint", "ConstraintFactory", "Mask"]

Mask = NDArray[np.int32]
"""Allowed tokens as bits, ceil(n_vocab / 32) words: token t is allowed when bit t % 32 of word t //
32 is set.
"""


class Constraint(Protocol):
    """The state of one answer."""

    notes: list[str]
    """What could not be read from the command with certainty, in words for the plan's assumptions;
    complete from the start.
    """

    @property
    def ended(self) -> bool:
        """The answer is complete: only an end token may follow, or has followed."""

    @property
    def cut(self) -> bool:
        """The answer came near its limit and was led to its end by the shortest way."""

    def mask(self) -> Mask:
        """The tokens that may follow; end tokens among them where the answer may end. The array is
        the caller's until the next call.
        """

    def forced(self) -> list[int]:
        """Tokens that must follow, as the tokenizer would write them; empty where there is a
        choice. The state is unchanged.
        """

    def accept(self, token: int) -> None:
        """A token was chosen. Raises ValueError when it is not allowed."""

    def admits(self, tokens: Sequence[int]) -> int:
        """How many of these tokens in a row are allowed from here. The state is unchanged."""

    def akin(self, token: int) -> list[int]:
        """The allowed tokens that spell most of what `token`, which is not allowed, would have
        spelt; empty where any allowed token will do.

        A tokenizer that joins members of an object writes `[],"perception_skills":[{"name":"` as
        one token. Where no skill may follow, the model knows
        `[],"perception_skills":[],"stop_conditions":["`, and nothing that comes behind the pieces
        of it.
        """

    def declined(self, token: int) -> list[int] | None:
        """The beginning of the answer in which a list is closed, where the model would go on in
        that list with `token`, which is not allowed, and need not have; None to choose another
        token.
        """

    def instead(self, token: int) -> list[int] | None:
        """The whole answer to give, end token included, where the model would go on with `token`,
        which is not allowed; None to choose another token.

        The state may change: what the model means can decide what else is allowed.
        """


class ConstraintFactory(Protocol):
    """What one answer after the other is constrained with."""

    @property
    def least_tokens(self) -> int:
        """The smallest limit within which every answer ends."""

    def start(self, record: dict[str, Any], limit: int | None = None) -> Constraint:
        """The state before the first token of the answer to `record` ({"prompt", ...}), which
        always ends within `limit` tokens, its end token included.

        None takes the factory's limit. Raises PlannerError when `limit` is under `least_tokens`.
        """
