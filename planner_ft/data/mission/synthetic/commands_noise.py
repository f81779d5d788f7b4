"""Noise on commands written by hand: most stay clean, some arrive as keyboards, telegrams, hurry
and radio leave them.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from random import Random

from planner_ft.data.mission.synthetic.noise import FREE_WORDS, mistype, texted, typos, unpunctuated
from planner_ft.data.mission.synthetic.surface import protected_words

Values = tuple[str, ...]
GREETINGS = (
    "Ok",
    "OK",
    "Okay",
    "Hi",
    "Hello",
    "Right",
    "Morning",
    "Good morning",
    "Evening",
    "Good evening",
    "Good afternoon",
    "Hi there",
    "Alright",
    "Hey",
    "Hello there",
    "Control here",
    "New task",
    "Next job",
    "Base here",
    "Right then",
    "Afternoon",
    "New job for you",
    "One more",
)
GREETED = (
    "ok",
    "hi",
    "hello",
    "hey",
    "good",
    "morning",
    "right",
    "evening",
    "alright",
    "moin",
    "dear",
    "ahoy",
    "new",
    "next",
    "afternoon",
    "control",
)
SIGN_OFFS = (
    "Thanks.",
    "Thank you.",
    "Cheers.",
    "Over.",
    "Thanks!",
    "That's all.",
    "Please confirm.",
    "Many thanks.",
    "Please acknowledge.",
    "Out.",
    "Ta.",
)
COMMON_STARTS = """
    a after all an and any around as at before begin bring can carry check circle collect come could cut do dock don't drift drop fetch film find first
    follow for from get give go grab have head here hold how i'd if in inspect it just keep kindly lead leave let let's locate look make map may maybe
    measure move no now on once one orbit our over park pass please proceed pull put record report return run sail scan search see send set shadow show
    skip slip somebody someone somewhere start station stay steer stop survey tail take that the then there there's they this time to track trail
    transit try turn two up upload wait we we'd we'll we're we've what when where while with would you you're your
"""
SMALL_AFTER_COMMA = frozenset(COMMON_STARTS.split())
BRACKETED = re.compile(r"(\[[^\]]*\])")
LITTLE = frozenset(("a", "an", "the", "please"))


def noisy(text: str, rng: Random, values: Values) -> str:
    """`text` as it arrives; words of `values` that only copying can tell are never mistyped."""
    roll = rng.random()
    for share, change in CHANGES:
        if roll < share:
            return change(text, rng, values)
        roll -= share
    return text


def greeted(text: str, rng: Random) -> str:
    """With a greeting ahead, unless there is one."""
    first = text.split(" ", 1)[0].strip(",.!:;").lower()
    if first in GREETED:
        return text
    if first in SMALL_AFTER_COMMA:
        return f"{rng.choice(GREETINGS)}, {text[0].lower()}{text[1:]}"
    return f"{rng.choice(GREETINGS)}. {text}"


def signed(text: str, rng: Random) -> str:
    """With a word of farewell."""
    return (
        f"{text} {rng.choice(SIGN_OFFS)}"
        if text[-1] in ".?!"
        else f"{text}. {rng.choice(SIGN_OFFS)}"
    )


def garbled(text: str, rng: Random, values: Values) -> str:
    """With every second to fifth word mistyped."""
    changed = typos(text, rng, protected_words(values), rng.choice((0.2, 0.3, 0.45)))
    return uncapitalised(changed, values).rstrip(".") if rng.random() < 0.5 else changed


def shortened(text: str, rng: Random, values: Values) -> str:
    """As it is thumbed into a telephone."""
    kept = {word for value in values for word in value.split(" ")}
    changed = typos(texted(text, rng, kept), rng, protected_words(values), 0.03)
    return uncapitalised(changed, values).rstrip(".") if rng.random() < 0.6 else changed


def dictated(text: str, _rng: Random, values: Values) -> str:
    """Without marks and capitals; the brackets of positions stay."""
    parts = BRACKETED.split(uncapitalised(text, values))
    return "".join(part if part.startswith("[") else unpunctuated(part) for part in parts)


def telegraphed(text: str, rng: Random, values: Values) -> str:
    """Without articles and "please", in capitals now and then where no value has any of its own;
    words of values stay.
    """
    kept = {word for value in values for word in value.split(" ")} & LITTLE
    words = [word for word in text.split(" ") if word.lower() not in LITTLE or word in kept]
    short = " ".join(words)
    if not short:
        return text
    if (
        rng.random() < 0.45
        and "\u00b0" not in text
        and not any(mark.isupper() for value in values for mark in value)
    ):
        stops = rng.random() < 0.4
        return (re.sub(r"[.;!?](?= |$)|,(?= \D)", " STOP", short) if stops else short).upper()
    return short[:1].upper() + short[1:]


def slipped(text: str, rng: Random, values: tuple[str, ...], count: int) -> str:
    """With `count` words mistyped."""
    guarded = protected_words(values)
    for _ in range(count):
        free = [match for match in FREE_WORDS.finditer(text) if match[0] not in guarded]
        if not free:
            return text
        match = rng.choice(free)
        text = text[: match.start()] + mistype(match[0], rng) + text[match.end() :]
    return text


def uncapitalised(text: str, values: tuple[str, ...]) -> str:
    """In small letters, but for names and ids, which the plan holds with their capitals."""
    small = text.lower()
    for value in values:
        if value != value.lower():
            start = small.find(value.lower())
            while start >= 0:
                small = small[:start] + value + small[start + len(value) :]
                start = small.find(value.lower(), start + len(value))
    return small


CHANGES: tuple[tuple[float, Callable[[str, Random, Values], str]], ...] = (
    (0.035, lambda text, rng, _values: greeted(text, rng)),
    (0.025, lambda text, rng, _values: signed(text, rng)),
    (0.06, lambda text, rng, values: slipped(text, rng, values, 1 if rng.random() < 0.65 else 2)),
    (0.06, lambda text, _rng, values: uncapitalised(text, values).rstrip(".")),
    (0.035, garbled),
    (0.015, shortened),
    (0.02, dictated),
    (0.03, telegraphed),
)
"""What happens to a command on its way, and to what share of them."""
