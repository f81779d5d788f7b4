"""Masks allow the tokens that a tokenizer would write, and not the pieces of them that no model was
trained on.
"""

from __future__ import annotations

from typing import Any

import pytest

from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints.tokens import Tokens, allows
from planner_ft.prompts import answer_text
from planner_ft.vocabulary import load_vocabulary

from .conftest import answer_ids, make_factory, taken


@pytest.mark.parametrize("strength", ["schema", "grounded"])
def test_the_token_of_training_is_allowed_wherever_there_is_a_choice(
    tokenizer: Any, strength: Strength
) -> None:
    vocabulary = load_vocabulary()
    factory = make_factory(tokenizer, "task", vocabulary, strength)
    choices = 0
    for record in sample_tasks(vocabulary, 7, 12, "train"):
        ids = answer_ids(tokenizer, answer_text("task", record, vocabulary))
        constraint = factory.start(record, 4096)
        if taken(factory.start(record, 4096), ids) < len(ids):
            continue
        for token in ids:
            if not constraint.expected():
                choices += 1
                assert allows(constraint.mask(), token), (
                    record["prompt"],
                    tokenizer.decode([token]),
                )
            constraint.accept(token)
    assert choices > 250


class Greedy:
    """A tokenizer that takes the longest token; the last one is special."""

    def __init__(self, *tokens: str) -> None:
        self.tokens = [token.encode() for token in tokens]
        self.vocab_size = len(self.tokens)

    def is_special_token(self, token: int) -> bool:
        return token == self.vocab_size - 1

    def decode_bytes(self, ids: list[int]) -> bytes:
        return b"".join(self.tokens[token] for token in ids)

    def tokenize_bytes(self, text: bytes) -> list[int]:
        ids = list[int]()
        while text:
            begins = [token for token in self.tokens if token and text.startswith(token)]
            ids.append(self.tokens.index(max(begins, key=len)))
            text = text[len(self.tokens[ids[-1]]) :]
        return ids

    def greedy_tokenize(self, text: str) -> list[int]:
        return self.tokenize_bytes(text.encode())


class Forced:
    """A place where `text` must follow, and `behind` may follow it."""

    def __init__(self, engine: Greedy, text: str, behind: str) -> None:
        self.engine, self.text, self.all = engine, text.encode(), (text + behind).encode()

    def compute_ff_bytes(self) -> bytes:
        return self.text

    def validate_tokens(self, ids: list[int]) -> int:
        sizes = range(len(ids) + 1)
        decode = self.engine.decode_bytes
        return max(size for size in sizes if self.all.startswith(decode(ids[:size])))


WORDS = ("a", "b", "abcd", "efghi", "efghi!", "abcd!", "abcd!?", "i", "fghi", "fghi!", "e", "", "S")
A, B, ABCD, EFGHI, EFGHI_MORE, ABCD_MORE, ABCD_MOST, END, FGHI, _, E = range(11)


@pytest.mark.parametrize(
    ("before", "text", "behind", "spelt", "growing"),
    [
        # Where a longer token may take in what is left, the spelling ends before it.
        ([], "abcdefghi", "", [ABCD, EFGHI], []),
        ([], "abcdefghi", "!", [ABCD], []),
        ([], "abcdefghi", "?", [ABCD, EFGHI], []),
        ([], "abcd", "!", [], [ABCD_MORE, ABCD]),
        ([], "abcd", "!?", [], [ABCD_MORE, ABCD_MOST, ABCD]),
        ([], "abcd", "e", [ABCD], []),
        ([ABCD], "efghi", "!", [], [EFGHI_MORE, EFGHI]),
        ([A, B, END] * 3, "efghi", "", [EFGHI], []),
        # Nothing must follow; what stands before is not spelt as the tokenizer would.
        ([], "", "!", [], []),
        ([END, E, FGHI], "abcd", "", [], []),
        ([END, E, FGHI], "abcd", "!", [], [ABCD_MORE]),
    ],
)
def test_a_text_that_must_follow_is_spelt_as_the_tokenizer_would(
    before: list[int], text: str, behind: str, spelt: list[int], growing: list[int]
) -> None:
    engine: Any = Greedy(*WORDS)
    forced: Any = Forced(engine, text, behind)
    tokens = Tokens(engine, len(WORDS), (12,))
    assert tokens.spelt(before, forced) == spelt
    assert tokens.growing(before, forced) == growing


def test_signs_without_a_token_of_their_own_are_not_known() -> None:
    engine: Any = Greedy('"', "]", "},", "}", ",", "S")
    assert Tokens(engine, 6, (5,)).byte == {'"': 0, "]": 1, "}": 3, ",": 4}
    joined: Any = Greedy("<", "0", "]", '"', "}", "S")
    joined.greedy_tokenize = lambda sign: (
        [0, 1] if sign == "," else joined.tokenize_bytes(sign.encode())
    )
    assert Tokens(joined, 6, (5,)).byte == {'"': 3, "]": 2, "}": 4, ",": None}
