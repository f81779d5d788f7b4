"""Limits of a mission: their canonical sentences in NAME.limits.toml, written and read back.

A limit holds for the whole mission, or for the tasks that its sentence ends with: "The vehicle goes
no faster than 1 m/s during SubseaCableTrack."
"""

import functools
import math
import re
import string
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary.checks import Entry
from planner_ft.vocabulary.definition import LIMITS, Vocabulary

KINDS = (
    *("fence", "keep_out_area", "keep_out", "clearance", "distance"),
    *("speed", "duration", "return", "no_recording"),
)
"""What a limit can be about; a plan is checked by its kind."""
AMOUNT = r"\d+(?:\.\d+)?(?:e[+-]?\d+)?"
NUMBER = rf"-?{AMOUNT}"
POSITION = rf"\[\s*{NUMBER}\s*,\s*{NUMBER}\s*\]"
READ = {
    "polygon": rf"{POSITION}(?:\s*,\s*{POSITION}){{2,}}",
    "position": POSITION,
    "distance": AMOUNT,
    "speed": AMOUNT,
    "duration": AMOUNT,
    "object": r"[^\[\]]+?",
    "time": r".+?",
    "within": r".+?",
}
"""How the values of a limit are written, by name: positions and numbers, else words."""
NUMBERS = ("distance", "speed", "duration")
DURING, AND = " during ", " and "


@dataclass(frozen=True)
class LimitKind:
    """The sentences of a kind, and the filter skill that keeps it.

    The first sentence whose values are all given is written; `parameters` of the filter by the
    name of the limit's value that they take; `forbids` are skills that break it.
    """

    sentences: tuple[str, ...]
    prompts: tuple[str, ...]
    filter: str | None = None
    parameters: Mapping[str, str] = field(default_factory=dict)
    forbids: tuple[str, ...] = ()

    @functools.cached_property
    def readers(self) -> tuple[re.Pattern[str], ...]:
        """Patterns of the sentences, for the constraint and for the task prompt."""
        return tuple(_reader(form) for form in (*self.sentences, *self.prompts))


Limits = Mapping[str, LimitKind]


@dataclass(frozen=True)
class Limit:
    """One limit: its kind, its values by name, the sentence that it was read from, and the titles
    of the tasks that it holds for (none: all). Two of one kind with the same values are equal.
    """

    kind: str
    values: dict[str, Any]
    text: str = field(compare=False)
    titles: tuple[str, ...] = field(default=(), compare=False)

    def holds_for(self, title: str) -> bool:
        """Whether it is a limit of tasks of this title."""
        return not self.titles or title in self.titles


@functools.lru_cache(maxsize=16)
def load_limits(vocabulary: Vocabulary) -> Limits:
    """The kinds of limits of a vehicle; none without NAME.limits.toml. Raises PlannerError."""
    raw = vocabulary.beside(LIMITS)
    return {kind: _kind(kind, entry, vocabulary) for kind, entry in raw.items()}


def sentence(kind: str, values: Entry, limits: Limits, titles: Iterable[str] = ()) -> str:
    """The limit as one of the mission plan's constraints: metres, seconds, m/s, [x, y]; `titles`
    are the tasks that it holds for where it does not hold for all.
    """
    text, scope = _written(limits[kind].sentences, values), AND.join(dict.fromkeys(titles))
    return f"{text.removesuffix('.')}{DURING}{scope}." if scope else text


def prompt_sentence(kind: str, values: Entry, limits: Limits) -> str:
    """The limit as a sentence of a task prompt."""
    return _written(limits[kind].prompts, values)


def read_limit(text: str, limits: Limits) -> Limit | None:
    """The limit of a canonical sentence; None for any other sentence, as one with a negative
    distance or a number beyond all range.
    """
    line = " ".join(text.split())
    line, _during, scope = line.partition(DURING)
    titles = tuple(scope.removesuffix(".").split(AND)) if scope else ()
    for kind, known in limits.items():
        for reader in known.readers:
            if (found := reader.fullmatch(line)) and not beyond_range(line):
                values = {name: _value(name, words) for name, words in found.groupdict().items()}
                return Limit(kind, values, text, titles)
    return None


def beyond_range(text: str) -> str | None:
    """The first number of a text that no float holds."""
    found = re.findall(NUMBER, text, re.IGNORECASE)
    return next((number for number in found if math.isinf(float(number))), None)


def slots(form: str) -> list[str]:
    """The names of the values in a sentence."""
    return [name for _text, name, _spec, _conversion in string.Formatter().parse(form) if name]


def written(value: Any) -> str:
    """A value as the sentences have it: 70, [260, 80], [0, 0], [9, 0], [9, 9] or words."""
    if isinstance(value, str):
        return value
    if isinstance(value, Sequence):
        inner = ", ".join(map(written, value))
        return inner if value and isinstance(value[0], Sequence) else f"[{inner}]"
    return f"{value:g}" if float(f"{value:g}") == value else repr(value)


def _written(forms: Sequence[str], values: Entry) -> str:
    given = {name: written(value) for name, value in values.items() if value is not None}
    form = next(form for form in forms if set(slots(form)) <= given.keys())
    return form.format(**given)


def _reader(form: str) -> re.Pattern[str]:
    parts = []
    for text, name, _spec, _conversion in string.Formatter().parse(form):
        parts.append(re.escape(text))
        if name:
            parts.append(f"(?P<{name}>{READ[name]})")
    return re.compile("".join(parts).removesuffix(r"\.") + r"\.?", re.IGNORECASE)


def _value(name: str, words: str) -> Any:
    if name in NUMBERS:
        return _number(words)
    if name not in ("polygon", "position"):
        return words
    numbers = [_number(found) for found in re.findall(NUMBER, words, re.IGNORECASE)]
    points = [list(point) for point in zip(numbers[::2], numbers[1::2], strict=True)]
    return points if name == "polygon" else points[0]


def _number(words: str) -> float:
    value = float(words)
    return int(value) if value.is_integer() else value


def _kind(kind: str, entry: Entry, vocabulary: Vocabulary) -> LimitKind:
    where = f"{vocabulary.name}{LIMITS}: [{kind}]"
    if kind not in KINDS:
        raise PlannerError(f"{where}: no such kind of limit; there is {', '.join(KINDS)}")
    made = LimitKind(
        tuple(entry.get("sentences", ())),
        tuple(entry.get("prompts", ())),
        entry.get("filter"),
        entry.get("parameters", {}),
        tuple(entry.get("forbids", ())),
    )
    used = {name for form in (*made.sentences, *made.prompts) for name in slots(form)}
    if unknown := used - READ.keys():
        known = ", ".join(READ)
        raise PlannerError(f"{where}: no value {', '.join(sorted(unknown))}; there is {known}")
    if not made.sentences or not made.prompts:
        raise PlannerError(f"{where}: sentences and prompts are needed, at least one of each")
    skill = vocabulary.skill.get(made.filter) if made.filter else None
    if made.filter and (skill is None or made.parameters.keys() - skill.by_name.keys()):
        raise PlannerError(f"{where}: {made.filter} is no skill with these parameters")
    if unknown := {*made.forbids} - vocabulary.skill.keys():
        raise PlannerError(f"{where}: forbids {', '.join(sorted(unknown))}, which is no skill")
    return made
