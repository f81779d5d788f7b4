"""Words that commands are checked by (english.toml, NAME.ontology.toml), and clauses."""

import functools
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.facts.numbers import read_numbers
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_toml
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import ONTOLOGY

ENGLISH = Path(__file__).parent / "english.toml"
GAP = r"\W{1,3}(?:[\w'’-]{1,30}\W{1,3}){0,3}?"  # the words that ... stands for: up to three.
CLAUSE_END = re.compile(
    r"(?<!\d)[.,](?=\s|$)|[.,](?=\s+[^\d\s−–-]|\s*$)|[;:!?\n]|\s(?:--|[–—-])(?=\s[a-z])"
    r"|\b(?:then|afterwards|after that|and|but)\b",
    re.IGNORECASE,
)
LAST = re.compile(r"\s*(?:[.!?;]|$)")
NOUN = re.compile(r"\s*(?:the|any)\s+[\w-]+(?:\s+[\w-]+)?\W*", re.IGNORECASE)
NO = re.compile(r"^no\W+", re.IGNORECASE)


@dataclass(frozen=True)
class Ask:
    """Words that ask for one of `tasks`; with `sends`, the clause also names what is sent.

    `named`: these words, and those that name the task where it is ruled out: "skip the report".
    `sure`: nobody asks for the task without one of these words, where they are known.
    """

    said: re.Pattern[str]
    tasks: frozenset[str]
    sends: bool
    named: re.Pattern[str]
    sure: re.Pattern[str] | None = None


@dataclass(frozen=True)
class Data:
    """Words for data, and the skills of which one gathers it (none: any that gathers).

    `ruled_out`: the words say that none of the skills is wanted.
    """

    said: re.Pattern[str]
    skills: frozenset[str]
    ruled_out: bool = False


@dataclass(frozen=True)
class Language:
    """Patterns by name, words for tasks and sensors, and the questions per missing element."""

    words: dict[str, re.Pattern[str]]
    asks: tuple[Ask, ...]
    sensors: re.Pattern[str]
    data: tuple[Data, ...]
    questions: dict[str, str]


@functools.lru_cache(maxsize=16)
def language(vocabulary: Vocabulary) -> Language:
    """The words for a vehicle. Raises PlannerError that lists what is wrong with its ontology."""
    english = read_toml(ENGLISH)
    questions = english.pop("questions")
    own = vocabulary.beside(ONTOLOGY)
    if problems := list(_problems(own, vocabulary)):
        raise PlannerError(f"{vocabulary.name}{ONTOLOGY}: " + "; ".join(problems))
    asks, data = [], []
    for entry in own.get("ask", ()):
        said, named = entry["words"], [*entry["words"], *entry.get("nouns", ())]
        sure = pattern([*named, *entry["sure"]]) if "sure" in entry else None
        tasks, sends = frozenset(entry["tasks"]), entry.get("sends", False)
        asks.append(Ask(pattern(said), tasks, sends, pattern(named), sure))
    for entry in own.get("data", ()):
        skills, ruled_out = frozenset(entry.get("skills", ())), bool(entry.get("ruled_out", False))
        data.append(Data(pattern(entry["words"]), skills, ruled_out))
    words = {name: pattern(entry["words"]) for name, entry in english.items()}
    sensors = pattern(own.get("sensor", {}).get("words", ()))
    return Language(words, tuple(asks), sensors, tuple(data), questions)


def pattern(phrases: Sequence[str]) -> re.Pattern[str]:
    """A pattern of whole words, the longest phrase first; without phrases it matches nothing."""
    written = "|".join(_phrase(phrase) for phrase in sorted(phrases, key=len, reverse=True))
    return re.compile(rf"(?<![\w-])(?:{written})(?![\w])" if written else r"(?!)", re.IGNORECASE)


def _phrase(phrase: str) -> str:
    parts = [re.escape(" ".join(part.split())) for part in phrase.split("...")]
    changes = ((r"\ ", r"[\s-]+"), (r"\*", r"\w*"), ("'", "['’]"))
    for plain, written in changes:
        parts = [part.replace(plain, written) for part in parts]
    return GAP.join(parts)


def _leads_to_a_value(no: re.Match[str], correction: re.Pattern[str]) -> bool:
    """Whether words correct what stands before them: "eighty forty, sorry, no, ninety forty"."""
    rest = no.string[no.end() :].lstrip(" ,")
    if more := correction.match(rest):
        rest = rest[more.end() :].lstrip(" ,")
    valued = any(number.start == 0 for number in read_numbers(rest))
    plain, before = no[0].casefold() == "no", no.string[: no.start()].rstrip(" ,")
    # "Forty fifty, no, forty ninety".
    between = any(number.end == len(before) for number in read_numbers(before))
    return plain and valued and (between or ends_with(correction, before))


def ends_with(words: re.Pattern[str], text: str) -> bool:
    """Whether a text ends with one of some words."""
    rest = text.rstrip(" :,")
    return any(match.end() == len(rest) for match in words.finditer(rest))


def _problems(own: dict[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    keys = ("ask", "sensor", "data", "hint")
    yield from (f"unknown key {key!r}" for key in own if key not in keys)
    sensor = own.get("sensor", {"words": ["any"]})
    if not isinstance(sensor, dict) or not _are_words(sensor.get("words")):
        yield "[sensor] needs the list words"
    for kind, needed, optional, named, known in (
        ("ask", ("words", "tasks"), ("nouns", "sure"), "tasks", vocabulary.task),
        ("data", ("words",), ("skills",), "skills", vocabulary.skill),
    ):
        entries = own.get(kind, [])
        for entry in entries if isinstance(entries, list) else [entries]:
            if not isinstance(entry, dict) or not all(_are_words(entry.get(key)) for key in needed):
                lists = "list" if len(needed) == 1 else "lists"
                yield f"every [[{kind}]] needs the {lists} {' and '.join(needed)}"
            elif wrong := [key for key in optional if not _are_words(entry.get(key, ["any"]))]:
                of = "names" if wrong[0] == named else "words"
                yield f"[[{kind}]]: {wrong[0]} must be a list of {of}"
            else:
                keys = (*needed, *optional, "sends" if kind == "ask" else "ruled_out")
                yield from (f"[[{kind}]]: unknown key {key!r}" for key in entry if key not in keys)
                unknown = [name for name in entry.get(named, ()) if name not in known]
                which = f"which is no {named.removesuffix('s')}"
                yield from (f"[[{kind}]] names {name!r}, {which}" for name in unknown)


def _are_words(value: Any) -> bool:
    words = value if isinstance(value, list) else []
    return bool(words) and all(isinstance(word, str) and word.strip() for word in words)


@dataclass(frozen=True)
class Clause:
    """A clause of a command. `corrected`: the next words take it back.

    `excluded`: where words that rule something out begin (before `start`: it only tells of it), and
    `resumed` where what they correct goes on: "contact 3, no, belay that, contact 8".
    """

    start: int
    end: int
    text: str
    excluded: int | None
    corrected: bool
    resumed: int | None = None

    def wants(self, place: int) -> bool:
        """Whether words at a place of the command are not ruled out."""
        return self.excluded is None or place <= self.excluded

    def spans(self, words: re.Pattern[str]) -> Iterator[tuple[int, int]]:
        """Where the clause says words that it does not rule out."""
        for match in words.finditer(self.text):
            if self.wants(self.start + match.start()):
                yield self.start + match.start(), self.start + match.end()


def _goes_on(command: str, last: Clause, start: int, text: str) -> bool:
    """Whether a clause is a mere noun that is ruled out with the last one."""
    joined = command[last.end : start].strip().casefold() in ("and", "or", "nor")
    return (
        joined
        and bool(NOUN.fullmatch(text))
        and last.excluded is not None
        and last.excluded >= last.start
    )


@functools.lru_cache(maxsize=64)
def read_clauses(command: str, vocabulary: Vocabulary) -> tuple[Clause, ...]:
    """The clauses of a command in order: between commas, sentence ends, "and" and "then"."""
    words = language(vocabulary).words
    ends = [(match.start(), match.end()) for match in CLAUSE_END.finditer(command)]
    starts = [0, *(end for _start, end in ends)]
    found = list[Clause]()
    for start, end in zip(starts, [*(end for end, _next in ends), len(command)], strict=True):
        text = command[start:end]
        if text.strip():
            exclusion = None if words["reminder"].search(text) else words["exclusion"].search(text)
            excluded = start + exclusion.start() if exclusion else None
            behind = command[end : end + 48].lstrip(" ,.;:!?-–—")
            corrected = any(map(words["correction"].match, (behind, NO.sub("", behind))))
            last = words["afterthought"].match(behind)
            corrected &= not (last and LAST.match(behind, last.end()))
            told = words["told"].search(text)
            behind_it = exclusion and words["correction"].search(text, exclusion.end())
            instead = exclusion and _leads_to_a_value(exclusion, words["correction"])
            behind_it = exclusion if instead else behind_it
            resumed = start + behind_it.end() if behind_it and not told else None
            excluded = start - 1 if told or instead else excluded
            # "Forget the diagnostics and the report."
            if found and _goes_on(command, found[-1], start, text):
                excluded = start
            found.append(Clause(start, end, text, excluded, corrected, resumed))
    return tuple(found)
