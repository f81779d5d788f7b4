"""From sentences to the text that arrives: capitals, stops, greetings, and the noise of the
channel.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from random import Random

from planner_ft.data.mission.synthetic import lexicon
from planner_ft.data.mission.synthetic.noise import spaced, texted, typos, unpunctuated
from planner_ft.data.mission.synthetic.numbers import COMPASS, ONES, TENS

ENDS = (*(". ",) * 22, "; ", "; ")


@dataclass(frozen=True)
class Register:
    """How one message is written: `spoken` is dictation without marks, `texting` abbreviates,
    `capitals` starts sentences with them.
    """

    spoken: bool
    texting: bool
    capitals: bool
    typo_rate: float
    fillers: int
    opened: bool
    closed: bool

    @classmethod
    def draw(cls, rng: Random, form: str) -> Register:
        spoken = rng.random() < 0.025 and form in (
            "one-sentence",
            "sentences",
            "but-first",
            "after-gerund",
            "where-first",
            "questions",
        )
        terse = form in ("radio", "telegram", "numbered")
        return cls(
            spoken=spoken,
            texting=not spoken and rng.random() < 0.015,
            capitals=rng.random() < 0.92 and not spoken,
            typo_rate=0.0 if rng.random() < 0.94 else rng.choice((0.015, 0.03, 0.06)),
            fillers=rng.choice((0, 1, 2)) if spoken else 1 if rng.random() < 0.015 else 0,
            opened=not terse and rng.random() < 0.06,
            closed=not terse and rng.random() < 0.05,
        )


def finished(sentences: list[str], rng: Random, register: Register, values: tuple[str, ...]) -> str:
    """The command as one text. Words of `values` that no lexicon has are never mistyped: only
    copying can tell them.
    """
    told = [spaced(sentence.strip().rstrip(",;")) for sentence in sentences if sentence.strip()]
    if register.fillers:
        told = _filled(told, rng, register.fillers)
    if register.opened:
        opener = rng.choice(lexicon.OPENERS)
        told = [opener, *told] if rng.random() < 0.4 else [f"{opener}, {told[0]}", *told[1:]]
    if register.closed:
        told = (
            [*told, rng.choice(lexicon.CLOSERS)]
            if rng.random() < 0.5
            else [*told[:-1], _closed(told[-1], rng)]
        )
    text = _run_together(told, rng, register)
    if register.spoken:
        text = unpunctuated(text)
    if register.typo_rate or register.texting:
        protected = protected_words(values)
        if register.texting:
            text = texted(text, rng, {word for value in values for word in value.split(" ")})
        text = typos(text, rng, protected, register.typo_rate)
    text = spaced(text)
    if (
        rng.random() < 0.004
        and not any(mark.isupper() for value in values for mark in value)
        and "°" not in text
    ):
        text = text.upper()
    return text


def _closed(sentence: str, rng: Random) -> str:
    closer = rng.choice(lexicon.CLOSERS)
    return f"{sentence.rstrip('.?!')}, {closer}" + ("?" if sentence.endswith("?") else "")


def _run_together(sentences: list[str], rng: Random, register: Register) -> str:
    end = rng.choice(ENDS)
    parts = []
    for index, sentence in enumerate(sentences):
        text = sentence
        if register.capitals and (end == ". " or index == 0 or sentences[index - 1][-1] in "?."):
            text = text[:1].upper() + text[1:]
        if index < len(sentences) - 1:
            text += " " if text[-1] in "?.!" else end
        parts.append(text)
    whole = "".join(parts)
    if whole[-1] not in ".?!" and rng.random() < (0.96 if register.capitals else 0.3):
        whole += "."
    return whole


def _filled(sentences: list[str], rng: Random, count: int) -> list[str]:
    told = list(sentences)
    for _ in range(count):
        index = rng.randrange(len(told))
        filler = rng.choice(LIGHT) if rng.random() < 0.75 else rng.choice(MANNERS)
        if filler in MANNERS:
            told[index] = f"{told[index].rstrip('.?!')}, {filler}"
        else:
            told[index] = (
                f"{filler} {told[index]}" if rng.random() < 0.6 else f"{filler}, {told[index]}"
            )
    return told


LIGHT = (
    "er",
    "um",
    "uh",
    "well",
    "ok",
    "okay",
    "so",
    "right",
    "hmm",
    "alright",
    "uh",
    "um",
    "right then",
    "so um",
    "ok so",
    "well then",
    "uh yeah",
)
MANNERS = tuple(
    text
    for text in lexicon.FILLERS
    if text
    in (
        "if you please",
        "please",
        "if you would",
        "if you can",
        "when you are ready",
        "in your own time",
        "nice and easy",
        "no rush",
        "for me",
        "for us",
        "if possible",
        "right away",
        "straight away",
        "ASAP",
        "as soon as you can",
        "pronto",
        "sharpish",
    )
)


@cache
def _known_words() -> frozenset[str]:
    texts = (
        *lexicon.TARGET_NOUNS,
        *lexicon.TARGET_ADJECTIVES,
        *lexicon.WITH_PHRASES,
        *lexicon.FEATURES,
        *lexicon.FEATURE_PHRASES,
        *lexicon.DOCK_SPOTS,
        *lexicon.DOCK_MARKS,
        *lexicon.DATA_ITEMS,
        *lexicon.MOVING_TARGETS,
    )
    return frozenset(word for text in texts for word in text.split(" "))


CODE = re.compile(r"\d|\b[A-Z]\b")
NEVER = frozenset(
    (
        *ONES,
        *TENS,
        *COMPASS,
        "hundred",
        "thousand",
        "minus",
        "half",
        "point",
        "port",
        "comma",
        "quarter",
        "inner",
        "outer",
        "upper",
        "lower",
        "left",
        "right",
        "north",
        "south",
        "east",
        "west",
    )
)


def protected_words(values: tuple[str, ...]) -> set[str]:
    """Words that are never mistyped: those that only copying can tell, codes, numbers and sides."""
    known = _known_words()
    return {
        word
        for value in values
        for word in value.split(" ")
        if word not in known or CODE.search(value)
    } | NEVER
