"""Light noise on commands written by hand: most stay clean, a few have a typo, lack capitals, or have a greeting or a sign-off."""

from __future__ import annotations

from random import Random

from planner_ft.data.mission.synthetic.noise import FREE_WORDS, mistype
from planner_ft.data.mission.synthetic.surface import protected_words

SMALL_SHARE, TYPO_SHARE, GREETED_SHARE, SIGNED_SHARE = 0.08, 0.07, 0.035, 0.025
GREETINGS = (
    "Ok", "OK", "Okay", "Hi", "Hello", "Right", "Morning", "Good morning", "Evening", "Good evening", "Good afternoon", "Hi there", "Alright", "Hey",
    "Hello there", "Control here", "New task", "Next job", "Base here", "Right then", "Afternoon", "New job for you", "One more",
)  # fmt: skip
GREETED = ("ok", "hi", "hello", "hey", "good", "morning", "right", "evening", "alright", "moin", "dear", "ahoy", "new", "next", "afternoon", "control")
SIGN_OFFS = ("Thanks.", "Thank you.", "Cheers.", "Over.", "Thanks!", "That's all.", "Please confirm.", "Many thanks.", "Please acknowledge.", "Out.", "Ta.")
COMMON_STARTS = """
    a after all an and any around as at before begin bring can carry check circle collect come could cut do dock don't drift drop fetch film find first
    follow for from get give go grab have head here hold how i'd if in inspect it just keep kindly lead leave let let's locate look make map may maybe
    measure move no now on once one orbit our over park pass please proceed pull put record report return run sail scan search see send set shadow show
    skip slip somebody someone somewhere start station stay steer stop survey tail take that the then there there's they this time to track trail
    transit try turn two up upload wait we we'd we'll we're we've what when where while with would you you're your
"""
SMALL_AFTER_COMMA = frozenset(COMMON_STARTS.split())


def noisy(text: str, rng: Random, values: tuple[str, ...]) -> str:
    """`text` as it arrives; words of `values` that only copying can tell are never mistyped."""
    roll = rng.random()
    if roll < GREETED_SHARE:
        return greeted(text, rng)
    if roll < GREETED_SHARE + SIGNED_SHARE:
        return signed(text, rng)
    if roll < GREETED_SHARE + SIGNED_SHARE + TYPO_SHARE:
        return slipped(text, rng, values, 1 if rng.random() < 0.65 else 2)
    if roll < GREETED_SHARE + SIGNED_SHARE + TYPO_SHARE + SMALL_SHARE:
        return uncapitalised(text, values).rstrip(".")
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
    return f"{text} {rng.choice(SIGN_OFFS)}" if text[-1] in ".?!" else f"{text}. {rng.choice(SIGN_OFFS)}"


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
