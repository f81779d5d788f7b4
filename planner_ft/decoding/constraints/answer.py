"""The state of one constrained answer: a row of grammars, each of which can depend on the text
before it.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.constraints.budget import Closing
from planner_ft.decoding.constraints.grammar import SKILL_OPENS
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

    def closing(self) -> Script:
        """The script for an answer that must come to its end: nothing that was begun has to be gone
        on with.
        """

    def taken_back(self, text: str) -> tuple[str, str] | None:
        """Where `text`, which begins here, may not follow, but the answer could have ended: what it
        drops of its end, and what it writes for that.
        """

    def pressed(self, text: str) -> Script | None:
        """Where `text`, which begins here, would end the answer too early: the script that goes on
        with what is still asked for.
        """

    def declines(self, text: str) -> bool:
        """Whether `text`, which begins here and may not follow, would be an item of a list that
        need not have gone on.
        """

    def asks(self, text: str) -> int | None:
        """The place in a text that must follow before which the model is asked for what it means
        all the same.
        """


class Plain:
    """A script that does not depend on what the model means where it may not write it."""

    def taken_back(self, text: str) -> tuple[str, str] | None:
        return None

    def pressed(self, text: str) -> Script | None:
        return None

    def declines(self, text: str) -> bool:
        return False

    def asks(self, text: str) -> int | None:
        return None


class Whole(Plain):
    """A script of one grammar."""

    def __init__(self, grammar: str) -> None:
        self._grammar = grammar

    def opening(self) -> str:
        return self._grammar

    def following(self, text: str) -> tuple[str, Script] | None:
        return None

    def closing(self) -> Script:
        return self


class Answer:
    """A Constraint (see the package) that follows a script and ends within `limit` tokens, the last
    `reserve` of them for closing.
    """

    def __init__(
        self, tokens: Tokens, script: Script, limit: int, reserve: int, notes: Sequence[str] = ()
    ) -> None:
        self.notes = list(notes)
        self.cut = False
        self._whole = script, limit
        self._tokens, self._script, self._left, self._reserve = tokens, script, limit, reserve
        self._matcher: LLMatcher | None = tokens.compile(script.opening())
        self._ids: list[int] = []
        self._text = b""
        self._closing = Closing(tokens)
        self._mask = tokens.new_mask()

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
        forced = self._tokens.spelt(self._ids, self._matcher)[: self._left - self._reserve - 1]
        text = (self._text + bytes(self._matcher.compute_ff_bytes())).decode(errors="ignore")
        place = self._script.asks(text)
        if place is None or place < len(self._text.decode(errors="ignore")):
            return forced
        ends = itertools.accumulate(
            (len(self._tokens.bytes_of(token)) for token in forced), initial=len(self._text)
        )
        return forced[
            : sum(end <= len(text[:place].encode()) for end in itertools.islice(ends, 1, None))
        ]

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
        within = self._matcher.validate_tokens(
            list(tokens[: max(self._left - self._reserve - 1, 0)])
        )
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

    def akin(self, token: int) -> list[int]:
        return (
            [] if self._matcher is None or self._hurried else self._tokens.akin(token, self.mask())
        )

    def instead(self, token: int) -> list[int] | None:
        if self._matcher is None or self._hurried:
            return None
        meant = (self._text + self._tokens.bytes_of(token)).decode(errors="replace")
        self._script = self._script.pressed(meant) or self._script
        change = self._script.taken_back(meant)
        if change is None:
            return None
        dropped, written = (part.encode() for part in change)
        pieces = [self._tokens.bytes_of(one) for one in self._ids]
        length = sum(map(len, pieces)) - len(self._text) - len(dropped)
        kept = sum(end <= length for end in itertools.accumulate(map(len, pieces)))
        rest = b"".join(pieces[kept:])[: length - sum(map(len, pieces[:kept]))] + written
        return [*self._ids[:kept], *self._tokens.shortest(rest), self._tokens.end_ids[0]]

    def declined(self, token: int) -> list[int] | None:
        if (
            self._matcher is None
            or self._hurried
            or not self._script.declines(
                (self._text + self._tokens.bytes_of(token)).decode(errors="replace")
            )
        ):
            return None
        pieces = [self._tokens.bytes_of(one) for one in self._ids]
        text = b"".join(pieces)[: sum(map(len, pieces)) - len(self._text)].removesuffix(
            SKILL_OPENS.encode()
        )
        closed = text.removesuffix(b",") + b"]"
        kept = sum(end < len(closed) for end in itertools.accumulate(map(len, pieces)))
        earlier = Answer(self._tokens, *self._whole, self._reserve, self.notes)
        for one in self._ids[:kept]:
            earlier.accept(one)
        behind = earlier._matcher and self._tokens.begun_with(
            self._ids[:kept], closed[sum(map(len, pieces[:kept])) :], earlier._matcher
        )
        return [*self._ids[:kept], *behind] if behind else None

    @property
    def _hurried(self) -> bool:
        return self._left <= self._reserve

    def _advance(self) -> None:
        script = self._script.closing() if self._hurried else self._script
        following = script.following(self._text.decode())
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
