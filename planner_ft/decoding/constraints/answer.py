"""The state of one constrained answer: a row of grammars, each of which can depend on the text
before it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.constraints.budget import Closing
from planner_ft.decoding.constraints.tokens import Tokens, allows

if TYPE_CHECKING:
    from llguidance import LLMatcher


class Script(Protocol):
    """The grammars of an answer. Each one ends where nothing can follow it, at a place where no
    token spans both sides.

    A script does not change: a copy of an answer goes on with the same one.
    """

    def opening(self) -> str:
        """The first grammar."""

    def following(self, text: str) -> tuple[str, Script] | None:
        """The next grammar, and the script from there, after `text` was matched by the last one;
        None when the answer is complete.
        """


class Whole:
    """A script of one grammar."""

    def __init__(self, grammar: str) -> None:
        self._grammar = grammar

    def opening(self) -> str:
        return self._grammar

    def following(self, text: str) -> tuple[str, Script] | None:
        return None


Notes = Callable[[str], list[str]]
"""Sentences on an answer so far, given as text."""


class Answer:
    """A Constraint (see the package) that follows a script and ends within `limit` tokens, the last
    `reserve` of them for closing.
    """

    def __init__(
        self, tokens: Tokens, script: Script, limit: int, reserve: int, notes: Notes = lambda _: []
    ) -> None:
        self.cut = False
        self._tokens, self._script, self._left, self._reserve = tokens, script, limit, reserve
        self._notes = notes
        self._matcher: LLMatcher | None = tokens.compile(script.opening())
        self._ids: list[int] = []
        self._text = b""
        self._closing = Closing(tokens)
        self._mask = tokens.new_mask()

    @property
    def notes(self) -> list[str]:
        return self._notes(b"".join(map(self._tokens.bytes_of, self._ids)).decode(errors="ignore"))

    @property
    def ended(self) -> bool:
        return self._matcher is None

    def mask(self) -> Mask:
        if self._matcher is None:
            return self._tokens.ends
        self._matcher.unsafe_compute_mask_ptr(self._mask.ctypes.data, self._mask.nbytes)
        if not self._hurried:
            growing = self._tokens.growing(self._ids, self._matcher)
            return self._tokens.mask_of(tuple(growing)) if growing else self._mask
        narrowed = self._closing.narrow(self._mask, bytes(self._matcher.compute_ff_bytes()))
        self.cut = self.cut or not np.array_equal(narrowed, self._mask)
        return narrowed

    def forced(self) -> list[int]:
        if self._matcher is None or self._hurried:
            return []
        return self._tokens.spelt(self._ids, self._matcher)[: self._left - self._reserve - 1]

    def accept(self, token: int) -> None:
        if self._matcher is None:
            if token not in self._tokens.end_ids:
                raise ValueError(f"token {token} follows a complete answer")
            return
        if (self._hurried and not allows(self.mask(), token)) or not (
            self._matcher.validate_tokens([token]) and self._matcher.consume_token(token)
        ):
            raise ValueError(
                f"token {token} ({self._tokens.bytes_of(token)!r}) is not allowed here"
            )
        added = self._tokens.bytes_of(token)
        self._ids.append(token)
        self._text += added
        self._closing.read(added)
        self._left -= 1
        if self._matcher.is_accepting():
            self._advance()

    def admits(self, tokens: Sequence[int]) -> int:
        if self._matcher is None:
            return int(bool(tokens) and tokens[0] in self._tokens.end_ids)
        room = max(self._left - self._reserve - 1, 0)
        within = self._matcher.validate_tokens(list(tokens[:room]))
        if within == len(tokens):
            return within
        # Behind the end of this grammar, or near the limit: step by step, on a copy.
        ahead = self._copy()
        for count, token in enumerate(tokens):
            try:
                ahead.accept(token)
            except ValueError:
                return count
            if ahead.ended:
                return count + 1 + ahead.admits(tokens[count + 1 :][:1])
        return len(tokens)

    @property
    def _hurried(self) -> bool:
        return self._left <= self._reserve

    def _advance(self) -> None:
        following = self._script.following(self._text.decode())
        self._text = b""
        if following is None:
            self._matcher = None
            return
        grammar, self._script = following
        self._matcher = self._tokens.compile(grammar)

    def _copy(self) -> Answer:
        other = Answer.__new__(Answer)
        other.__dict__.update(self.__dict__)
        other._matcher = None if self._matcher is None else self._matcher.deep_copy()
        other._ids = list(self._ids)
        other._closing = self._closing.copy()
        other._mask = self._tokens.new_mask()
        return other
