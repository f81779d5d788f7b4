"""Samples with other values that prompt and plan share, and with fewer words.

A model that is trained on a hundred commands of a vehicle learns their values by heart, and one
that knows every word of its targets misspells an operator's unknown word. With other values in each
copy of a command it learns to copy them: numbers, which `planner_ft.facts` finds, and words that
input and plan share, the name of a thing or a proper name. So this works for any vehicle. Where
words of a command are missing it learns to do with the others ("check" or "valve"; Iyyer et al.
2015, P15-1162).
"""

import functools
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.numbers import in_words
from planner_ft.data.values import OWN, any_things, made_up_name
from planner_ft.facts.geometry import tidy
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.together import Number
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, is_number, named_entries, plan_problems

WORDS = 0.6
"""Share of the copies with another thing or name, where there is one."""
TRIES = 8
_FIGURE = re.compile(r"[-−–]?\d+(?:\.\d+)?(?![\w:/.,]*\d)")
_FIGURES = re.compile(r"(?<![\w.\-])-?\d+(?:\.\d+)?(?![\w:/]*\d)")
Said = dict[float, float]


def varied(record: dict[str, Any], vocabulary: Vocabulary, rng: Random) -> dict[str, Any] | None:
    """A mission record with other values in prompt and plan alike; None where it has none."""
    kept = {"prompt": record["prompt"], "expected": record["expected"]}
    changed = _with_other_numbers(kept, vocabulary, rng) or kept
    if rng.random() < WORDS:
        changed = with_unfamiliar_words(changed, vocabulary, rng, own=True) or changed
    if changed is kept or plan_problems("mission", changed["expected"], vocabulary, strict=True):
        return None
    return {**{key: record[key] for key in ("id", "family") if key in record}, **changed}


def _with_other_numbers(
    record: dict[str, Any], vocabulary: Vocabulary, rng: Random
) -> dict[str, Any] | None:
    """The record with all plainly written numbers changed; None where that does not fit."""
    prompt, expected = record["prompt"], record["expected"]
    numbers = read_numbers(prompt)
    own = {float(part) for place in (vocabulary.home, vocabulary.unresolved) for part in place}
    for _ in range(TRIES if numbers else 0):
        drawn: dict[float, float] = {}
        said: Said = {}
        pieces, end, clash = list[str](), 0, False
        for number in numbers:
            written = _written(prompt, number)
            new = number.said
            if written and number.said not in own:
                new = drawn.setdefault(number.said, _drawn(number.said, written, rng))
                text = in_words(int(new)) if written[0].isalpha() else str(tidy(new))
                pieces += [prompt[end : number.start], text]
                end = number.start + len(written)
            # In the plan it stands as it is said, and in the base unit.
            pairs = [(number.said, new)]
            if number.unit and number.factor not in (0.0, 1.0):
                other = new * number.factor + number.added
                pairs.append((round(number.value, 2), round(other, 2)))
            for old, now in pairs:
                clash |= said.setdefault(old, now) != now
        apart = len(set(drawn.values()) | own) == len(drawn) + len(own)
        if clash or not apart or not drawn:
            continue
        values = (task["parameters"] for task in expected["tasks"])
        numeric = filter(is_number, _leaves(list(values)))
        if any(one not in said and one not in own for one in numeric):
            return None
        changed = _changed(expected, said, own, drawn)
        if not plan_problems("mission", changed, vocabulary, strict=True):
            return {"prompt": "".join([*pieces, prompt[end:]]), "expected": changed}
    return None


def _written(prompt: str, number: Number) -> str:
    """The figure or word of a number; empty where it is put together ("half an hour", "14:30")."""
    said = number.said
    if found := _FIGURE.match(prompt, number.start):
        same = float(found[0].replace("−", "-").replace("–", "-")) == said
        return found[0] if same else ""
    word = in_words(int(said)) if said == int(said) and 2 <= said < 100 else ""
    return word if word and prompt.startswith(word, number.start) else ""


def _drawn(said: float, written: str, rng: Random) -> float:
    """Another number of about the same size, as round as the old one."""
    if written[0].isalpha():
        return rng.randrange(2, 13)
    size, decimals = abs(said), len(written.partition(".")[2])
    low, high = size / 2, 2 * size + (5 if size >= 1 and not decimals else 0)
    new = round(rng.uniform(low, high), decimals)
    if not decimals:
        step = 5 if size % 5 == 0 and rng.random() < 0.6 else 1
        new = max(step, step * round(new / step))
    return -new if said < 0 else new


def _leaves(value: Any) -> Iterator[Any]:
    """The values within a JSON value that are no object and no list."""
    if isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            yield from _leaves(item)
    else:
        yield value


def _mapped(value: Any, change: Callable[[Any], Any]) -> Any:
    """The JSON value with its leaves changed."""
    if isinstance(value, dict):
        return {key: _mapped(item, change) for key, item in value.items()}
    return [_mapped(item, change) for item in value] if isinstance(value, list) else change(value)


def _replaced(value: Any, new: dict[str, str], letter: str = r"\w") -> Any:
    """The JSON value with words of its strings replaced; none stands beside another `letter`."""
    pattern = re.compile(rf"(?<![{letter}])(?:{'|'.join(map(re.escape, new))})(?![{letter}])")

    def change(one: Any) -> Any:
        return pattern.sub(lambda word: new[word[0]], one) if isinstance(one, str) else one

    return _mapped(value, change)


def _changed(expected: dict[str, Any], said: Said, own: set[float], drawn: Said) -> dict[str, Any]:
    """The plan with its numbers changed, in parameters and texts."""

    def figure(match: re.Match[str]) -> str:
        value = float(match[0])
        return match[0] if value in own or value not in said else str(tidy(said[value]))

    def change(value: Any) -> Any:
        if isinstance(value, str):
            return _FIGURES.sub(figure, value)
        return tidy(said.get(value, value)) if is_number(value) else value

    result = _mapped(expected, change)
    whole = {old: new for old, new in drawn.items() if old == int(old) and 2 <= min(old, new) < 100}
    words = {in_words(int(old)): in_words(int(new)) for old, new in whole.items() if new < 1000}
    if words:
        words |= {old.capitalize(): new.capitalize() for old, new in words.items()}
        result = _replaced(result, words, r"\w-")
    return result  # type: ignore[no-any-return]


# ---------------------------------------------------------------- other words


_WORD = re.compile(r"(?<![\w-])[^\W\d_]{4,}(?![\w-])")
_TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
_LISTS: dict[str, list[str]] = {k: v.split() for k, v in _TABLES.items() if isinstance(v, str)}
_STAYING, _MEANING = frozenset(_LISTS["staying"]), frozenset(_LISTS["meaning"])
_ACCENTS = dict[str, str](_TABLES["accents"])
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[^\W\d_A-Z]+")
"""The words of a name such as CaptureGeoSnapshot, follow-slick or lx.level."""
_UNCLEAR = ("u", "eu", "one", "hon")
"""Beginnings after which the spelling does not tell "a" from "an"."""


def with_unfamiliar_words(
    record: dict[str, Any], vocabulary: Vocabulary, rng: Random, *, own: bool = False
) -> dict[str, Any] | None:
    """`record` with one or two words of its targets replaced everywhere; None without any.

    Words are names, and things that the lists know; with `own` any, for a vehicle of its own.
    """
    words = _shared_words(record, vocabulary, own)
    if not words:
        return None
    rng.shuffle(words)
    changed = record
    for word in words[: 1 if rng.random() < 0.7 else 2]:
        # "Trawlers" at the beginning of a sentence is the same word.
        text = unfamiliar_word(word, rng)
        forms = {word + end: text + end for end in ("", "s")}
        forms |= {form[0].upper() + form[1:]: o[0].upper() + o[1:] for form, o in forms.items()}
        changed = _replaced(changed, forms)
    return changed


def unfamiliar_word(word: str, rng: Random) -> str:
    """A made-up or foreign word in the place of `word`: a name for a name, "an" stays "an"."""
    for _ in range(50):
        found = _accented(made_up_name(rng), rng, 0.35) if word[0].isupper() else _noun(rng)
        same = (found[0].lower() in "aeio") == (word[0].lower() in "aeio")
        if same and found[0].isascii() and not found.lower().startswith(_UNCLEAR):
            return found
    return word


def _noun(rng: Random) -> str:
    things, roll = _things(), rng.random()
    if roll < 0.35:
        return rng.choice(things)
    if roll < 0.5:
        return rng.choice(things) + rng.choice(things)
    if roll < 0.65:
        begun = rng.choice(_LISTS["prefixes"]) + rng.choice(things)
        return begun + (rng.choice(_LISTS["suffixes"]) if rng.random() < 0.4 else "")
    word = (
        OWN.entry("word", rng)
        if roll < 0.85
        else rng.choice(things) + rng.choice(_LISTS["suffixes"])
    )
    return _accented(word, rng, 0.25)


def _accented(word: str, rng: Random, share: float) -> str:
    """`word`, at times with one or two letters, not the first, that English does not have."""
    if rng.random() >= share:
        return word
    letters = list(word)
    places = [index for index, letter in enumerate(letters) if index and letter in _ACCENTS]
    for index in rng.sample(places, min(len(places), rng.choice((1, 1, 1, 2)))):
        letters[index] = rng.choice(_ACCENTS[letters[index]])
    return "".join(letters)


@functools.cache
def _things() -> tuple[str, ...]:
    long = (word for word in any_things() if len(word) > 3 and word not in _STAYING)
    return tuple(word for word in long if not word.startswith(_UNCLEAR))


def _shared_words(record: dict[str, Any], vocabulary: Vocabulary, own: bool) -> list[str]:
    """Things and names in the plan's parameters that the prompt has too, in the plan's order."""
    names = [task.title for task in vocabulary.tasks] + [skill.name for skill in vocabulary.skills]
    meant = {part.lower() for name in names for part in _PARTS.findall(name)} | _STAYING
    things, prompt = frozenset(_things()), set(_WORD.findall(record["prompt"]))
    level: Level = "mission" if "tasks" in record["expected"] else "task"
    values = [parameters for _name, parameters in named_entries(level, record["expected"])]
    texts = (leaf for leaf in _leaves(values) if isinstance(leaf, str))
    found = dict.fromkeys(word for text in texts for word in _WORD.findall(text))
    # Plurals are replaced too, and titles stay.
    shared = [w for w in found if w in prompt and not {w.lower(), w.lower() + "s"} & meant]
    return [w for w in shared if own or w in things or (w[0].isupper() and not w.isupper())]


# ---------------------------------------------------------------- fewer words


_NUMBERS = frozenset(in_words(number) for number in range(100))


def with_lost_words(record: dict[str, Any], rng: Random) -> dict[str, Any] | None:
    """`record` with one or two words of its command left out, or unknown ones in their place; None
    for one of few words.

    What the plan's parameters have stays, and so do short words, numbers, and words such as "never"
    and "north" that change an order's meaning.
    """
    prompt: str = record["prompt"]
    values = [parameters for _name, parameters in named_entries("mission", record["expected"])]
    texts = (leaf.lower() for leaf in _leaves(values) if isinstance(leaf, str))
    stays = _MEANING | _NUMBERS | {word for text in texts for word in _WORD.findall(text)}
    words = [match for match in _WORD.finditer(prompt) if match[0].lower() not in stays]
    if len(words) < 2:
        return None
    for match in sorted(rng.sample(words, rng.choice((1, 1, 2))), key=lambda one: -one.start()):
        before, behind = prompt[: match.start()], prompt[match.end() :]
        prompt = before + _noun(rng) + behind if rng.random() < 0.5 else before.rstrip() + behind
    return {**record, "prompt": prompt.strip(" ,")}


def with_heading(record: dict[str, Any], rng: Random) -> dict[str, Any]:
    """`record` with a word and a number before it that say nothing: "Permit 118: "."""
    heading = f"{rng.choice(_things()).capitalize()} {rng.randint(2, 400)}"
    return {**record, "prompt": f"{heading}: {record['prompt']}"}
