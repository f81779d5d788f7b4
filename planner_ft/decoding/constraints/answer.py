"""The state of one constrained answer: a row of grammars, each made from the text before it."""

from __future__ import annotations

import copy
import re
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from planner_ft.decoding.constraints import RELEASED, Mask
from planner_ft.decoding.constraints.grammar import Script, name_of
from planner_ft.decoding.constraints.tokens import Tokens, allows

if TYPE_CHECKING:
    from llguidance import LLMatcher

QUOTE = re.compile(rb'(?:\\.|[^"\\])*"', re.DOTALL)
Notes = Callable[[str], list[str]]
"""Sentences on an answer so far, given as text."""


class Answer:
    """An answer that follows a script and ends within `limit` tokens.

    The last `reserve` of them are for closing what is open: texts end, lists and objects close as
    soon as the grammar lets them; `cut` says so. `without_facts` is the same script without the
    facts of the input: a part of the answer is released to it where the model finds no value with
    evidence likely.
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
        self._tokens, self._left, self._reserve, self._notes = tokens, limit, reserve, notes
        self._script, self._loose_script = script, without_facts
        self._matcher: LLMatcher | None = tokens.compile(script.opening())
        self._loose = tokens.compile(without_facts.opening()) if without_facts else None
        self._released: dict[str, None] = {}
        self._ids: list[int] = []
        self._begun = 0
        self._mask = tokens.new_mask()

    @property
    def notes(self) -> list[str]:
        """Sentences for the plan's assumptions: what could not be read from the command, and values
        without evidence in it that were left to the model.
        """
        text = self._tokens.text_of(self._ids).decode(errors="ignore")
        return [*self._notes(text), *(RELEASED.format(name=name) for name in self._released)]

    @property
    def ended(self) -> bool:
        """The answer is complete: only an end token may follow, or has followed."""
        return self._matcher is None

    def mask(self) -> Mask:
        """The tokens that may follow; end tokens among them where the answer may end. The array is
        the caller's until the next call.
        """
        if self._matcher is None:
            return self._tokens.ends
        self._matcher.unsafe_compute_mask_ptr(self._mask.ctypes.data, self._mask.nbytes)
        if not self._hurried:
            growing = self._tokens.growing(self._ids, self._matcher)
            return self._tokens.mask_of(tuple(growing)) if growing else self._mask
        narrowed = self._closing(self._mask)
        self.cut = self.cut or not np.array_equal(narrowed, self._mask)
        return narrowed

    def expected(self) -> list[int]:
        """Tokens that probably follow, since their text must. The state is unchanged."""
        if self._matcher is None or self._hurried:
            return []
        return self._tokens.spelt(self._ids, self._matcher)[: self._left - self._reserve - 1]

    def ends_text(self) -> int | None:
        """The token that ends the text that is being written; None where none may."""
        token = self._tokens.byte['"']
        return token if self._inside and allows(self.mask(), token) else None

    def release(self, token: int) -> bool:
        """Leave the value that is being written to the model, which would go on with `token`, a
        token without evidence. False where more than evidence forbids it.
        """
        open_ = self._matcher is not None and not self._hurried
        if not open_ or self._loose is None or not self._loose.validate_tokens([token]):
            return False
        self._matcher, chosen = self._loose.deep_copy(), self._script.chosen
        if chosen is not None:
            self._released[name_of(chosen)] = None
        return True

    def accept(self, token: int) -> None:
        """A token was chosen. Raises ValueError when it is not allowed."""
        if self._matcher is None:
            if token not in self._tokens.end_ids:
                raise ValueError(f"token {token} follows a complete answer")
            return
        barred = self._hurried and not allows(self.mask(), token)
        if barred or not (
            self._matcher.validate_tokens([token]) and self._matcher.consume_token(token)
        ):
            said = self._tokens.bytes_of(token)
            raise ValueError(f"token {token} ({said!r}) is not allowed here")
        if self._loose is not None and not self._loose.consume_token(token):
            self._loose = None
        self._ids.append(token)
        self._left -= 1
        if self._matcher.is_accepting():
            self._advance()

    def admits(self, tokens: Sequence[int]) -> int:
        """How many of these tokens in a row are allowed from here. The state is unchanged."""
        if self._matcher is None:
            return int(bool(tokens) and tokens[0] in self._tokens.end_ids)
        room = max(self._left - self._reserve - 1, 0)
        within = self._matcher.validate_tokens(list(tokens[:room]))
        if within == len(tokens):
            return within
        # Behind the end of this grammar, or near the limit: step by step, on a copy.
        ahead = copy.copy(self)
        ahead._matcher, ahead._mask = self._matcher.deep_copy(), self._tokens.new_mask()
        ahead._loose = None if self._loose is None else self._loose.deep_copy()
        ahead._released, ahead._ids = dict(self._released), list(self._ids)
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

    @property
    def _inside(self) -> bool:
        """Whether the answer stands within a text."""
        return len(QUOTE.findall(self._tokens.text_of(self._ids))) % 2 == 1

    def _closing(self, mask: Mask) -> Mask:
        """The part of a mask that leads to the end: a sign that closes, if there is one."""
        for sign in '"' if self._inside else "]},":
            token = self._tokens.byte[sign]
            if token is not None and allows(mask, token):
                return self._tokens.mask_of((token,))
        return mask

    def _advance(self) -> None:
        """Go on to the next grammar, with the text that the last one matched."""
        text = self._tokens.text_of(self._ids[self._begun :]).decode()
        following = self._script.following(text)
        loose = self._loose_script.following(text) if self._loose_script and following else None
        self._loose = self._tokens.compile(loose[0]) if loose else None
        self._loose_script = loose[1] if loose else None
        self._matcher, self._begun = None, len(self._ids)
        if following is not None:
            self._matcher, self._script = self._tokens.compile(following[0]), following[1]
