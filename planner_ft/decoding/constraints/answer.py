"""The state of one constrained answer: a row of grammars, each made from the text before it; and
what starts it, for a strength.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from planner_ft.decoding.configurations import Strength
from planner_ft.decoding.constraints import RELEASED, Mask
from planner_ft.decoding.constraints import grammar as lark
from planner_ft.decoding.constraints.grounded import LONGEST_WORD, GroundedValues
from planner_ft.decoding.constraints.patterns import DECIMALS, WHOLE_DIGITS
from planner_ft.decoding.constraints.scripts import MissionScript, TaskScript
from planner_ft.decoding.constraints.tokens import Tokens, allows, tokens_of
from planner_ft.decoding.constraints.waypoints import Waypoints, read_waypoints
from planner_ft.facts import read_input
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import compact_json
from planner_ft.vocabulary import Skill, Task, Vocabulary
from planner_ft.vocabulary.plans import MISSION_KEYS, STEP_KEYS, Level

if TYPE_CHECKING:
    from llguidance import LLMatcher

_NUMBER = 2 + WHOLE_DIGITS + DECIMALS
_POSITION = 2 * _NUMBER + 3
_BYTES = {"number": _NUMBER, "integer": _NUMBER, "position": _POSITION}
_BYTES["polygon"] = 3 * (_POSITION + 1) + 1
"""Bytes that a value takes at most when everything that can be left out is."""
QUOTE = re.compile(rb'(?:\\.|[^"\\])*"', re.DOTALL)
Notes = Callable[[str], list[str]]
"""Sentences on an answer so far, given as text."""


class Answer:
    """An answer that follows a script and ends within `limit` tokens.

    The last `reserve` of them are for closing what is open: texts end, lists and objects close as
    soon as the grammar lets them; `cut` says so. `loose` is the same script without the facts of
    the input: a part of the answer is released to it where the model finds no value with evidence
    likely.
    """

    _matcher: LLMatcher | None

    def __init__(
        self,
        tokens: Tokens,
        script: lark.Script,
        limit: int,
        reserve: int,
        notes: Notes = lambda _: [],
        loose: lark.Script | None = None,
    ) -> None:
        self.cut = False
        self._tokens, self._left, self._reserve, self._notes = tokens, limit, reserve, notes
        self._script, self._loose, self._released = script, loose, dict[str, None]()
        self._ids: list[int] = []
        self._mask = tokens.mask_of(())
        self._advance()

    @property
    def notes(self) -> list[str]:
        """Sentences for the plan's assumptions: what could not be read from the command, and values
        without evidence in it that were left to the model.
        """
        text = self._text.decode(errors="ignore")
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
            return self._tokens.mask_of(self._tokens.end_ids)
        self._matcher.unsafe_compute_mask_ptr(self._mask.ctypes.data, self._mask.nbytes)
        if not self._hurried:
            growing = self._tokens.growing(self._ids, self._matcher)
            return self._tokens.mask_of(growing) if growing else self._mask
        # What leads to the end: a sign that closes, if there is one.
        signs = (self._tokens.byte[sign] for sign in ('"' if self._inside else "]},"))
        closing = [sign for sign in signs if sign is not None and allows(self._mask, sign)][:1]
        narrowed = self._tokens.mask_of(closing) if closing else self._mask
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
        if self._matcher is None or self._hurried or self._loose is None:
            return False
        before, begun = self._ids[: self._begun], self._ids[self._begun :]
        loose = self._tokens.matcher(self._loose, before)
        if loose is None or loose.validate_tokens([*begun, token]) <= len(begun):
            return False
        loose.consume_tokens(begun)
        self._matcher = loose
        name = self._tokens.text_of(before).decode().rpartition(self._script.opens)[2]
        self._released |= {name: None} if name else {}
        return True

    def allows(self, token: int) -> bool:
        """Whether a token may follow."""
        if self._matcher is None:
            return token in self._tokens.end_ids
        if self._hurried:
            return allows(self.mask(), token)
        return self._matcher.validate_tokens([token]) == 1

    def accept(self, token: int) -> None:
        """A token was chosen. Raises ValueError when it is not allowed."""
        if not self.allows(token):
            where = "behind a complete answer" if self._matcher is None else "here"
            said = self._tokens.text_of([token])
            raise ValueError(f"token {token} ({said!r}) is not allowed {where}")
        if self._matcher is not None:
            self._matcher.consume_token(token)
            self._ids.append(token)
            self._left -= 1
            if self._matcher.is_accepting():
                self._advance()

    @property
    def _text(self) -> bytes:
        return self._tokens.text_of(self._ids)

    @property
    def _hurried(self) -> bool:
        return self._left <= self._reserve

    @property
    def _inside(self) -> bool:
        """Whether the answer stands within a text."""
        return len(QUOTE.findall(self._text)) % 2 == 1

    def _advance(self) -> None:
        """Go on to the grammar of what follows."""
        self._begun = len(self._ids)
        self._matcher = self._tokens.matcher(self._script, self._ids)


@dataclass(frozen=True, eq=False)
class Factory:
    """Starts constraints of one strength, over one tokenizer, for one level and vocabulary; `limit`
    is the number of tokens that an answer may have. Raises PlannerError for a limit within which an
    answer cannot be guaranteed to end.
    """

    tokens: Tokens
    level: Level
    vocabulary: Vocabulary
    strength: Strength
    limit: int

    def __post_init__(self) -> None:
        self._check(self.limit)

    def start(
        self, record: dict[str, Any], limit: int | None = None, most: int | None = None
    ) -> Answer:
        """The state before the first token of the answer to `record` ({"prompt", ...}), which
        always ends within `limit` tokens, its end token included.

        None takes the factory's limit. With `most`, the answer has at most that many tasks or steps
        and is held to the schema alone. Raises PlannerError when `limit` is under `least_tokens`.
        """
        limit = self.limit if limit is None else limit
        self._check(limit)
        given, unresolved = record.get("parameters"), list(self.vocabulary.unresolved)
        open_place = isinstance(given, dict) and unresolved in given.values()
        logical = self.strength != "schema" and not (self.level == "task" and open_place)
        script = self._script(self.vocabulary, lark.Values(), logical and most is None)
        script = script if most is None else replace(script, most=most)
        if self.strength != "grounded" or not script.logical:
            return Answer(self.tokens, script, limit, self.reserve)
        return self._grounded(record, limit, script)

    @property
    def _script(self) -> type[MissionScript] | type[TaskScript]:
        return MissionScript if self.level == "mission" else TaskScript

    @functools.cached_property
    def reserve(self) -> int:
        """Tokens that close a plan from wherever it stands: the longest task or skill, begun where
        another one ends, and what stands behind it.

        A grammar bounds every list and text, but the sum of the bounds is far above any limit, so
        the last tokens of the limit are kept for it. No token is shorter than a byte.
        """
        mission = self.level == "mission"
        owners = self.vocabulary.tasks if mission else self.vocabulary.skills
        lists = {name: list[Any]() for name in (MISSION_KEYS[1:] if mission else STEP_KEYS)}
        rest = compact_json([lists, {"task_prompt": ""}])
        return max(map(_most_bytes, owners)) + len(rest) + LONGEST_WORD + 8

    @property
    def least_tokens(self) -> int:
        """The smallest limit within which every answer ends, beginning and end token included."""
        return self.reserve + len(self._script.begins) + 1

    def _check(self, limit: int) -> None:
        if limit < self.least_tokens:
            raise PlannerError(
                f"--max-new-tokens {limit}: at strength {self.strength} a {self.level} plan of this"
                f" vocabulary needs room for {self.least_tokens} tokens; give at least that, or a"
                " shorter prompt"
            )

    def _grounded(
        self, record: dict[str, Any], limit: int, script: MissionScript | TaskScript
    ) -> Answer:
        if isinstance(script, MissionScript):
            # A mission's places are stated or unresolved, its other values can be left out.
            source = read_input({"prompt": record.get("prompt")}, self.vocabulary)
            values = GroundedValues(source, free_waypoints=False)
            script = replace(script, values=values)
            return Answer(self.tokens, script, limit, self.reserve, lambda _: values.notes)
        found, source = read_waypoints(record, self.vocabulary), read_input(record, self.vocabulary)
        known, free = (found, []) if isinstance(found, Waypoints) else (None, [found])
        values = GroundedValues(source, free_waypoints=known is None)
        goes = [script.opens + one.name for one in self.vocabulary.skills if one.coordinates]
        # The lanes of a grid follow from the task's own parameters: the model is not left to write
        # others.
        loose = replace(script, waypoints=known if known and known.whole else None)
        script = replace(script, values=values, waypoints=known)

        def notes(text: str) -> list[str]:
            return [*values.notes, *(free if any(name in text for name in goes) else [])]

        return Answer(self.tokens, script, limit, self.reserve, notes, loose)


def constraint_factory(
    tokenizer: Any,
    level: Level,
    vocabulary: Vocabulary,
    strength: Strength,
    end_ids: tuple[int, ...],
    limit: int,
    n_vocab: int | None = None,
) -> Factory | None:
    """What answers are constrained with; None at strength free.

    `end_ids` are the tokens that may end an answer, `n_vocab` is the width of the model's logits
    (None takes the tokenizer's size). Raises PlannerError as a Factory does.
    """
    if strength == "free":
        return None
    return Factory(tokens_of(tokenizer, end_ids, n_vocab), level, vocabulary, strength, limit)


def _most_bytes(owner: Task | Skill) -> int:
    """Bytes of a name and the parameters that must be written, or the one that was begun."""
    every = owner.parameters
    sizes = [
        len(f",{lark.key(one.name)}".encode()) + _BYTES.get(one.type, LONGEST_WORD) for one in every
    ]
    needed = bool(owner.require_any) or any(item.required for item in every)
    opens = len(compact_json({"name": lark.name_of(owner), "parameters": {}}).encode())
    return opens + (sum(sizes) if needed else max(sizes, default=0))
