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

__all__ = ["RAN_ON", "TOO_LONG", "UNPAIRED", "Constraint", "ConstraintFactory", "Mask"]

Mask = NDArray[np.int32]
"""Allowed tokens as bits, ceil(n_vocab / 32) words: token t is allowed when bit t % 32 of word t //
32 is set.
"""


TOO_LONG = "The command is too long to hold texts to its words."
UNPAIRED = "The coordinates in the command could not be read with certainty."
RAN_ON = "The facts of the command led to a plan that ran on; this one is held to the schema alone."


class Constraint(Protocol):
    """The state of one answer."""

    @property
    def notes(self) -> list[str]:
        """Sentences for the plan's assumptions: what could not be read from the command, and values
        without evidence in it that were left to the model.
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

    def expected(self) -> list[int]:
        """Tokens that must follow, those among them that the facts of the input force included; a
        draft for the model. The state is unchanged.
        """

    def release(self, token: int) -> bool:
        """Leave the value that is being written to the model, which would go on with `token`, a
        token without evidence. False where more than evidence forbids it.
        """

    def accept(self, token: int) -> None:
        """A token was chosen. Raises ValueError when it is not allowed."""

    def admits(self, tokens: Sequence[int]) -> int:
        """How many of these tokens in a row are allowed from here. The state is unchanged."""


class ConstraintFactory(Protocol):
    """What one answer after the other is constrained with."""

    @property
    def least_tokens(self) -> int:
        """The smallest limit within which every answer ends."""

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Constraint:
        """The state before the first token of the answer to `record` ({"prompt", ...}), which
        always ends within `limit` tokens, its end token included.

        None takes the factory's limit. With `most`, the answer has at most that many tasks or steps
        and is held to the schema alone. Raises PlannerError when `limit` is under `least_tokens`.
        """
