"""A tokenizer as the grammar engine sees it: tokens as bytes, ends, masks of tokens as bits."""

from __future__ import annotations

import copy
import functools
import itertools
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass
from operator import itemgetter
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.decoding.constraints import Mask
from planner_ft.decoding.constraints.grammar import Script
from planner_ft.support.errors import PlannerError

if TYPE_CHECKING:
    from llguidance import LLMatcher, LLTokenizer

GRAMMARS = 256
"""Compiled grammars that are kept: the states of a plan come again with every command."""

TEXT_SLICES = [rf'[^0-9"\\\x00-\x1F\x7F]{{1,{longest}}}' for longest in (10, 30)]
"""Tokens without digits, which the engine allows or refuses together: sentences whose numbers are
known allow them all.

With a vocabulary of 128k, a mask takes 0.2 ms instead of 1.5.
"""
LEAST_GROWN = 4
"""Bytes of a forced text from which on longer tokens are looked for; the engine sees fewer."""
CONTEXT = 8
"""Tokens before a forced text that it is spelt with, the whole answer where they do not do."""


@dataclass(frozen=True, eq=False)
class Tokens:
    """A tokenizer's tokens; `n_vocab` is the width of the logits, `end_ids` end an answer."""

    engine: LLTokenizer
    n_vocab: int
    end_ids: tuple[int, ...]

    @functools.cached_property
    def byte(self) -> dict[str, int | None]:
        """The token of a closing sign, or a comma; None where the tokenizer has none alone."""
        spelt = {sign: self.engine.greedy_tokenize(sign) for sign in '"]},'}
        return {sign: ids[0] if len(ids) == 1 else None for sign, ids in spelt.items()}

    @functools.cached_property
    def _by_bytes(self) -> list[tuple[bytes, int]]:
        """Ordinary tokens with their bytes, in the order of these."""
        every, special = range(self.engine.vocab_size), self.engine.is_special_token
        found = {self.text_of([token]): token for token in every if not special(token)}
        return sorted(found.items())

    def mask_of(self, ids: Iterable[int]) -> Mask:
        """The mask that allows these tokens and no others."""
        words = np.zeros(-(-self.n_vocab // 32), dtype=np.uint32)
        for token in ids:
            words[token // 32] |= np.uint32(1 << token % 32)
        return words.view(np.int32)

    def text_of(self, ids: list[int]) -> bytes:
        """What tokens add to the answer."""
        return bytes(self.engine.decode_bytes(ids))

    def spelt(self, before: list[int], matcher: LLMatcher) -> list[int]:
        """The tokens that a text which must follow is probably spelt with behind the tokens
        `before`, up to where a longer one may take in all that is left and go on behind it: a
        tokenizer may join several members of an object.
        """
        text = bytes(matcher.compute_ff_bytes())
        ids, place = self._spelling(before, text), 0
        for count, token in enumerate(ids):
            following = ([*ids[:count], longer] for longer in self._longer(text[place:]))
            if any(matcher.validate_tokens(tokens) == count + 1 for tokens in following):
                return ids[:count]
            place += len(self.text_of([token]))
        return ids

    def growing(self, before: list[int], matcher: LLMatcher) -> list[int]:
        """The tokens that can follow `before` where a text must follow and longer tokens take it in
        whole: these, and the first that it is spelt with alone.

        The engine allows a single token there, the first of its own spelling. Empty where there are
        no longer ones.
        """
        text = bytes(matcher.compute_ff_bytes())
        longer = [one for one in self._longer(text) if matcher.validate_tokens([one]) == 1]
        return [*longer, *self._spelling(before, text)[:1]] if longer else []

    def _spelling(self, before: list[int], text: bytes) -> list[int]:
        """The tokens of a text behind `before`; none where those are not spelt as the tokenizer
        would. The engine spells it as if it stood alone: a tokenizer that joins `,"sp` and `eed":`
        would be given tokens there that no training text has.
        """
        for context in (before[-CONTEXT:], before) if text else ():
            ids = self.engine.tokenize_bytes(self.text_of(context) + text)
            if ids[: len(context)] == context:
                return ids[len(context) :]
        return []

    def _longer(self, text: bytes) -> list[int]:
        """The tokens that begin with a text and go on."""
        if len(text) < LEAST_GROWN:
            return []
        first = bisect_right(self._by_bytes, text, key=itemgetter(0))
        behind = itertools.islice(self._by_bytes, first, None)
        return [one for _, one in itertools.takewhile(lambda one: one[0].startswith(text), behind)]

    def matcher(self, script: Script, ids: list[int]) -> LLMatcher | None:
        """A matcher of what a script lets follow the answer `ids`; None where that is complete."""
        grammar = script.grammar(self.text_of(ids).decode())
        return _compiled(self.engine, grammar).deep_copy() if grammar else None


def allows(mask: Mask, token: int | None) -> bool:
    """Whether a mask allows a token."""
    return token is not None and bool((int(mask[token // 32]) >> token % 32) & 1)


@functools.lru_cache(maxsize=4)
def tokens_of(tokenizer: Any, end_ids: tuple[int, ...], n_vocab: int | None = None) -> Tokens:
    """The (kept) tokens of a tokenizer. Raises PlannerError for a slow one."""
    from llguidance import LLTokenizer

    width, end = max(n_vocab or 0, len(tokenizer)), list(end_ids)
    slices = [*TEXT_SLICES, *LLTokenizer.general_slices()]
    try:
        if not hasattr(tokenizer, "backend_tokenizer"):
            raise ValueError("only fast tokenizers are supported")
        backend = copy.copy(tokenizer.backend_tokenizer)
        backend.no_padding()
        backend.no_truncation()
        engine = LLTokenizer(str(backend.to_str()), width, eos_token=end, slices=slices)
    except ValueError as error:
        way = "decode at strength free, or give a candidate with tokenizer.json"
        raise PlannerError(f"the tokenizer cannot be constrained ({error}); {way}") from error
    return Tokens(engine, width, end_ids)


@functools.lru_cache(maxsize=GRAMMARS)
def _compiled(engine: LLTokenizer, grammar: str) -> LLMatcher:
    from llguidance import LLMatcher

    matcher = LLMatcher(engine, grammar)
    if matcher.is_error():
        raise ValueError(f"the grammar does not compile: {matcher.get_error()}")
    return matcher
