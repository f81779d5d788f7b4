"""The parts of an answer that can be right or wrong, and the tokens that each was written with.

A part is the whole plan, an entry (a task, or a skill of a step) with its name and parameters, or a
single value. Prose (task prompts, assumptions, stop conditions) is no part: it can be worded in
many ways, all of them right.

Log-probabilities are natural and over the model's whole vocabulary: under a constraint, too, they
are those of the unconstrained model, so that what was forced upon it is not taken for certain.
"""

import itertools
import json
import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal, NamedTuple

from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level, list_key

LOWEST = -50.0
"""Log-probabilities below it are taken for it; servers write -9999 for zero."""
ROUNDING = 1e-3
"""By how much a log-probability may be above zero, and a sum of probabilities above one."""
DECIMALS = 4
Kind = Literal["plan", "entry", "value"]
Path = tuple[str | int, ...]
"""Keys and indices from the outermost object inwards."""
PROSE = {"task_prompt", *MISSION_KEYS[1:], *STEP_KEYS[3:]}
SPACE = " \t\n\r"
_DECODER = json.JSONDecoder()


class Choice(NamedTuple):
    """A token: its characters in the answer, its log-probability, and the text and log-probability
    of the likeliest others.
    """

    length: int
    logprob: float
    others: tuple[tuple[str, float], ...] = ()

    @property
    def margin(self) -> float:
        """Nats between the token and the likeliest other one; negative where that is likelier."""
        best = max((logprob for _text, logprob in self.others), default=LOWEST)
        return self.logprob - max(best, LOWEST)


Choices = tuple[Choice, ...]


def known(choices: Sequence[Choice] | None, text: str) -> Choices | None:
    """The choices that an answer `text` was made of; None where they cannot be: not its length, no
    numbers, above zero, together more than one, or every token entirely certain.
    """
    if not choices or sum(choice.length for choice in choices) != len(text):
        return None
    for choice in choices:
        held = [choice.logprob, *(logprob for _text, logprob in choice.others)]
        if any(not isinstance(one, int | float) or math.isnan(one) for one in held):
            return None
        if max(held) > ROUNDING or sum(map(math.exp, held)) > 1 + ROUNDING * len(held):
            return None
    if all(choice.logprob == 0 for choice in choices):
        return None
    return tuple(one._replace(logprob=min(0.0, max(one.logprob, LOWEST))) for one in choices)


def as_json(choices: Choices | None) -> list[list[float]] | None:
    """Length, log-probability and margin of every token, as predictions.jsonl has them."""
    if choices is None:
        return None
    rows = ((one.length, one.logprob, one.margin) for one in choices)
    return [[length, round(held, DECIMALS), round(by, DECIMALS)] for length, held, by in rows]


def from_json(value: Any, text: str) -> Choices | None:
    """The choices of a line of predictions.jsonl; None where it holds none that can be."""
    try:
        found = [Choice(length, held, (("", held - margin),)) for length, held, margin in value]
        return known(found, text)
    except (TypeError, ValueError):
        return None


# ---------------------------------------------------------------- parts


class Span(NamedTuple):
    """Where a value stands in a text; `key` is where its key begins, or else its `start`."""

    key: int
    start: int
    end: int


@dataclass(frozen=True)
class Part:
    """A part of an answer: its tokens, `starts` in the answer. `path` is that of an entry or of a
    value's owner and name, empty for the plan.
    """

    kind: Kind
    path: Path
    span: Span
    choices: Choices
    starts: tuple[int, ...]

    def features(self) -> dict[str, float]:
        """In nats: the least likely token, all together, the least margin to another token; and
        the number of tokens that the model alone would not have chosen.
        """
        found = self.choices or (Choice(0, 0.0),)
        margins = [choice.margin for choice in found]
        return {
            "lowest": min(choice.logprob for choice in found),
            "total": sum(choice.logprob for choice in found),
            "margin": min(margins),
            "overruled": float(sum(margin < 0 for margin in margins)),
            "tokens": float(len(found)),
        }


def parts(level: Level, text: str, choices: Choices) -> list[Part]:
    """The parts of an answer that is one JSON object: the plan, then its entries in order, each
    with its name and its values behind it.
    """
    found = spans(text)
    prose = [
        (one.start + 1, one.end - 1)
        for path, one in found.items()
        if path[-1:] == ("task_prompt",) or PROSE.intersection(path[:-1])
    ]
    starts = [0, *itertools.accumulate(choice.length for choice in choices)]
    tokens = list(zip(starts, choices, strict=False))

    def part(kind: Kind, path: Path, *of: Span) -> Part:
        own = [
            (start, one)
            for start, one in tokens
            if any(span.key < start + one.length and start < span.end for span in of)
            and not any(low <= start and start + one.length <= high for low, high in prose)
        ]
        span = Span(of[0].key, of[0].start, of[-1].end)
        return Part(kind, path, span, tuple(one for _at, one in own), tuple(at for at, _ in own))

    made = [part("plan", (), found[()])]
    name = "title" if level == "mission" else "name"
    for path in entry_paths(level, found):
        given = {key: found[*path, key] for key in (name, "parameters") if (*path, key) in found}
        made += [part("entry", path, *given.values()), part("value", (*path, name), given[name])]
        members = [one for one in found if one[: len(path) + 1] == (*path, "parameters")]
        made += [part("value", one, found[one]) for one in members if len(one) == len(path) + 2]
    return made


def entry_paths(level: Level, found: dict[Path, Span]) -> list[Path]:
    """The paths of the named tasks or skills, as they stand in the text."""
    name = "title" if level == "mission" else "name"
    depths = (3,) if level == "mission" else (4, 5)
    named = [path for path in found if path[:1] == (list_key(level),) and len(path) in depths]
    return [path[:-1] for path in named if path[-1] == name]


def spans(text: str) -> dict[Path, Span]:
    """Where every value of a JSON text stands, by path. Raises ValueError for other texts."""
    found: dict[Path, Span] = {}

    def read(at: int, path: Path, key: int | None = None) -> int:
        start = at = _past(text, at)
        if text[at : at + 1] in ("{", "["):
            closing = "}" if text[at] == "{" else "]"
            at = _past(text, at + 1)
            for index in itertools.count():
                if text[at : at + 1] == closing:
                    break
                at = _past(text, at + 1) if index else at
                own, item = at, index
                if closing == "}":
                    item, at = _DECODER.raw_decode(text, at)
                    at = _past(text, at) + 1
                at = _past(text, read(at, (*path, item), own))
            at += 1
        else:
            at = _DECODER.raw_decode(text, at)[1]
        found[path] = Span(start if key is None else key, start, at)
        return at

    read(0, ())
    return found


def _past(text: str, at: int) -> int:
    """The place behind white space."""
    while text[at : at + 1] and text[at] in SPACE:
        at += 1
    return at
