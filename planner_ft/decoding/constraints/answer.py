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


RELEASED = "A value of {name} has no evidence in the command; it is the model's."


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

    `without_facts` is the same script without the facts of the input: a part of the answer is
    released to it where the model finds no value with evidence likely.
    """

    def __init__(
        self,
        tokens: Tokens,
        script: Script,
        limit: int,
        reserve: int,
        notes: Notes = lambda _: [],
        without_facts: Script | None = None,
    ) -> None:
        self.cut = False
        self._released: dict[str, None] = {}
        self._loose_script = without_facts
        self._loose = tokens.compile(without_facts.opening()) if without_facts else None
        self._tokens, self._script, self._left, self._reserve = tokens, script, limit, reserve
        self._notes = notes
        self._matcher: LLMatcher | None = tokens.compile(script.opening())
        self._ids: list[int] = []
        self._text = b""
        self._closing = Closing(tokens)
        self._mask = tokens.new_mask()

    @property
    def notes(self) -> list[str]:
        text = b"".join(map(self._tokens.bytes_of, self._ids)).decode(errors="ignore")
        return [*self._notes(text), *(RELEASED.format(name=name) for name in self._released)]

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
        follows = self.expected()
        if not follows or self._loose is None:
            return follows
        return follows[: _common(follows, self._tokens.spelt(self._ids, self._loose))]

    def expected(self) -> list[int]:
        if self._matcher is None or self._hurried:
            return []
        return self._tokens.spelt(self._ids, self._matcher)[: self._left - self._reserve - 1]

    def release(self, token: int) -> bool:
        if self._matcher is None or self._loose is None or self._hurried:
            return False
        if not self._loose.validate_tokens([token]):
            return False
        self._matcher = self._loose.deep_copy()
        if (chosen := getattr(self._script, "chosen", None)) is not None:
            self._released[getattr(chosen, "title", None) or chosen.name] = None
        return True

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
        if self._loose is not None and not self._loose.consume_token(token):
            self._loose = None
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
        text = self._text.decode()
        following = self._script.following(text)
        loose = self._loose_script.following(text) if self._loose_script and following else None
        self._loose = None
        if loose is not None:
            self._loose = self._tokens.compile(loose[0])
        self._loose_script = loose[1] if loose else None
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
        other._loose = None if self._loose is None else self._loose.deep_copy()
        other._released = dict(self._released)
        other._ids = list(self._ids)
        other._closing = self._closing.copy()
        other._mask = self._tokens.new_mask()
        return other


def _common(one: Sequence[int], other: Sequence[int]) -> int:
    """Length of the beginning that two rows of tokens share."""
    pairs = enumerate(zip(one, other, strict=False))
    return next((at for at, (left, right) in pairs if left != right), min(len(one), len(other)))
