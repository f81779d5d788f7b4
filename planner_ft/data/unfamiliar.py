"""Targets with words that the generators' lists lack, so that copying is learnt, not the lists.

A model that knows every word of its targets misspells an operator's unknown word. Here a word that
input and plan share, the name of a thing or a proper name, is replaced in both.
"""

from __future__ import annotations

import functools
import re
import tomllib
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.wordlists import any_things, made_up_name, pseudo_word
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, named_entries

_WORD = re.compile(r"(?<![\w-])[^\W\d_]{4,}(?![\w-])")
_TABLES: dict[str, Any] = tomllib.loads(Path(__file__).with_suffix(".toml").read_text("utf-8"))
_LISTS: dict[str, list[str]] = {k: v.split() for k, v in _TABLES.items() if isinstance(v, str)}
_STAYING, _ACCENTS = frozenset(_LISTS["staying"]), dict[str, str](_TABLES["accents"])
_PARTS = re.compile(r"[A-Z]+(?![a-z])|[A-Z][a-z]+")
"""The words of a name such as CaptureGeoSnapshot."""
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
        pattern = re.compile(rf"(?<!\w)({'|'.join(map(re.escape, forms))})(?!\w)")
        changed = replaced(changed, pattern, _by(forms))
    return changed


def _by(forms: dict[str, str]) -> Callable[[re.Match[str]], str]:
    return lambda match: forms[match[0]]


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
    word = pseudo_word(rng) if roll < 0.85 else rng.choice(things) + rng.choice(_LISTS["suffixes"])
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
    texts = (
        text for _name, own_ in named_entries(level, record["expected"]) for text in _strings(own_)
    )
    found = dict.fromkeys(word for text in texts for word in _WORD.findall(text))
    shared = [word for word in found if word in prompt and word.lower() not in meant]
    return [w for w in shared if own or w in things or (w[0].isupper() and not w.isupper())]


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict | list):
        for item in value.values() if isinstance(value, dict) else value:
            yield from _strings(item)


def replaced(value: Any, pattern: re.Pattern[str], new: Callable[[re.Match[str]], str]) -> Any:
    """`value` with what the pattern finds in its strings replaced; names of tasks have no such."""
    if isinstance(value, str):
        return pattern.sub(new, value)
    if isinstance(value, dict):
        return {key: replaced(item, pattern, new) for key, item in value.items()}
    return [replaced(item, pattern, new) for item in value] if isinstance(value, list) else value
