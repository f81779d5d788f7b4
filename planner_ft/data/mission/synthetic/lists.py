"""Lists of things to send, said in the order of urgency or with the order made plain."""

from __future__ import annotations

from random import Random


def say_list(items: list[str], rng: Random, *, clipped: bool = False) -> str:
    """The items in words; whatever the order of the words, the first item of `items` is the most
    urgent one.
    """
    article = "" if clipped or rng.random() < 0.2 else "the "
    named = [item if "'s " in item else f"{article}{item}" for item in items]
    if len(named) == 1:
        return named[0]
    roll = rng.random()
    if len(named) == 2:
        return rng.choice(PAIRS if roll > 0.12 else BACKWARDS).format(
            a=named[0], b=named[1], bare=items[0], other=items[1]
        )
    if roll < 0.35:
        return (
            f"{', '.join(named[:-1])} and"
            f" {named[-1]}{rng.choice(('', ' in that order', ', in that order', ', in this order of urgency'))}"
        )
    if roll < 0.6:
        return f"{named[0]} first, then {', then '.join(named[1:])}"
    if roll < 0.75:
        return f"{named[0]} first, {', '.join(named[1:-1])} next and {named[-1]} last"
    return f"{', then '.join(named)}" if roll < 0.9 else f"{', '.join(named)}"


PAIRS = (
    "{a} and {b}",
    "{a} and {b}",
    "{a} and then {b}",
    "{a}, then {b}",
    "{a} first, then {b}",
    "{a} first and {b} second",
    "{a} first, {b} after that",
    "{a} ahead of {b}",
    "{a} before {b}",
    "{a} first and {b} after",
    "{a} followed by {b}",
    "{a}, {b}",
    "{a} and after that {b}",
    "first {a}, then {b}",
    "{a} with priority and then {b}",
    "{a} and {b}, in that order",
)
BACKWARDS = (
    "{b}, but {a} first",
    "{b} after {a}",
    "{b}, but {a} ahead of that",
    "{b}, but before that {a}",
    "{b} - no, {a} first, then {b}",
    "{a} and {b}, most urgent first",
)
