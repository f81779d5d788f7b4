"""Drafts: tokens that are likely to follow, proposed without the model and verified by it in one
forward pass.

A draft changes no answer. Where the model chooses another token, the rest of the draft is taken
back.
"""

from __future__ import annotations

from collections import Counter, defaultdict
from collections.abc import Callable, Hashable, Iterable, Sequence

LONGEST_MATCH = 4
"""Tokens at the end of the answer that are looked up at most. The longest match wins."""
LONGEST_DRAFT = 7
"""With the token that was chosen, eight positions: on a CPU a pass over eight costs little more
than over one.
"""
START = -1
"""Stands before an answer in the phrase book."""

Likeness = Callable[[int], Hashable]


class PhraseBook:
    """What follows what in plans of a level: the most frequent token after every one to
    LONGEST_MATCH tokens of `answers`.
    """

    def __init__(self, answers: Iterable[Sequence[int]] = ()) -> None:
        counts: dict[tuple[int, ...], Counter[int]] = defaultdict(Counter)
        for answer in answers:
            tokens = (START, *answer)
            for end in range(1, len(tokens)):
                for start in range(max(0, end - LONGEST_MATCH), end):
                    counts[tokens[start:end]][tokens[end]] += 1
        self.followers = {
            before: follower
            for before, found in counts.items()
            for follower, _count in found.most_common(1)
        }


class Drafter:
    """Drafts for one answer, from what followed its last tokens where they stood before.

    First in the prompt and the answer so far (prompt look-up): a plan copies names, phrases and
    numbers from the command and repeats its own structure. `likeness` maps a token to what is
    compared there, so that a word at the start of a string matches the one after a space. Then in
    the phrase book.
    """

    def __init__(
        self,
        prompt: Sequence[int],
        likeness: Likeness = lambda token: token,
        book: PhraseBook | None = None,
    ) -> None:
        self.likeness = likeness
        self.book = book or PhraseBook()
        self.likes: list[Hashable] = []
        self.followers: dict[tuple[Hashable, ...], int] = {}
        self.answer = [START]
        for token in prompt:
            self._read(token)

    def extend(self, token: int) -> None:
        """The answer goes on with `token`."""
        self._read(token)
        self.answer.append(token)

    def propose(self, count: int) -> list[int]:
        """At most `count` tokens that may follow."""
        likes, answer = self.likes[-LONGEST_MATCH:], self.answer[-LONGEST_MATCH:]
        draft: list[int] = []
        while len(draft) < count and (token := self._likely(likes, answer)) is not None:
            draft.append(token)
            likes = [*likes[1 - LONGEST_MATCH :], self.likeness(token)]
            answer = [*answer[1 - LONGEST_MATCH :], token]
        return draft

    def _likely(self, likes: list[Hashable], answer: list[int]) -> int | None:
        for length in range(LONGEST_MATCH, 0, -1):
            follower = self.followers.get(tuple(likes[-length:])) if length <= len(likes) else None
            if follower is None and length <= len(answer):
                follower = self.book.followers.get(tuple(answer[-length:]))
            if follower is not None:
                return follower
        return None

    def _read(self, token: int) -> None:
        for length in range(1, min(LONGEST_MATCH, len(self.likes)) + 1):
            self.followers[tuple(self.likes[-length:])] = token
        self.likes.append(self.likeness(token))
