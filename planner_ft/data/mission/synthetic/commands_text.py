"""The text of a command put together from its parts: articles, capitals, spaces and the mention of
targets.
"""

from __future__ import annotations

import re
from random import Random

from planner_ft.data.mission.synthetic.intents import Target
from planner_ft.data.mission.synthetic.mentions import described, plural, spoken_identity
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.positions import say_position

ARTICLE = re.compile(r"(?:^|(?<=[\s(\"“—–-]))([Aa])n? $")
SOUNDS_VOWEL = re.compile(
    r"(?:[aeioåøöäéAEIO]|u(?!ni(?!d|n|m)|se|su|ti|ri|to|ro)|U(?![a-z]?[a-z]?i)|8|11(?!\d)|18(?!\d)|hour|honest|[FHLMNRSX](?:[A-Z0-9-]|\b(?!')))"
)
SOUNDS_CONSONANT = re.compile(r"(?:one\b|once\b|eu|Eu|one-|ROV|RIB|SAR|NATO|LED\b|USV|UAV)")
ABBREVIATED = frozenset(
    (
        "approx.",
        "no.",
        "nr.",
        "e.g.",
        "i.e.",
        "ca.",
        "vs.",
        "ref.",
        "dr.",
        "mr.",
        "ms.",
        "st.",
        "capt.",
    )
)
SENTENCE = re.compile(r"(^|[.!?]\s+|[.!?][\"”)]\s+|\n)([a-zåøöäé])(?=[\w'’-]*)")
KEEP_SMALL = re.compile(r"[a-z]\)|[xy][=: ]?-?\d|x[=: ]|[a-z]\d")

PLACED = (
    *("{text} at {place}",) * 26,
    "{text} ({place})",
    "{text}, position {place},",
    "{text}, at {place},",
    "{text} at position {place}",
    "{text} over at {place}",
    "{text} out at {place}",
    "{text}, {place},",
    "{text} located at {place}",
)
TRACKED = (
    "{text} at {place}",
    "{text} at {place}",
    "{text} starting at {place}",
    "{text} from {place}",
)
DOUBTS = (
    "{text} somewhere near {place}",
    "{text} at about {place}",
    "{text} at roughly {place}",
    "{text}, which should be at {place},",
    "{text} at {place}, I think,",
    "{text}, probably at {place},",
    "{text} at around {place}",
)


def target_words(
    target: Target, article: str, rng: Random | None = None, style: Style | None = None
) -> str:
    """A mention: `article` "a" is indefinite, "bare" has none; with `rng` and `style` it is in
    full, its position included.
    """
    text = target.description or spoken_identity(target)
    if article == "bare":
        return text
    if article in ("look", "one", "nouns"):
        look = text.removesuffix(target.noun).strip()
        return (
            plural(target.noun)
            if article == "nouns"
            else look
            if article == "look"
            else f"the {look} one"
        )
    if article == "a":
        return f"{article_for(text)} {text}"
    text = described(target, _NEVER_THAT) if target.description else text
    if rng is None or style is None or target.position is None:
        return text
    pool: tuple[str, ...] = (
        DOUBTS if target.doubtful else TRACKED if target.noun == "cable" else PLACED
    )
    place = say_position(target.position, rng, style)
    if place[0] in "[(":
        pool = tuple(form for form in pool if "({" not in form)
    return pool[int(rng.random() * len(pool))].format(text=text, place=place)


class _First(Random):
    """Never takes the rare form."""

    def random(self) -> float:
        return 0.0


_NEVER_THAT = _First()


def article_for(text: str) -> str:
    """ "a" or "an", by the sound of `text`."""
    return "an" if SOUNDS_VOWEL.match(text) and not SOUNDS_CONSONANT.match(text) else "a"


def joined(parts: list[str]) -> str:
    """The parts as one text: "a" and "an" put right where a part begins, spaces, marks and capitals
    put right.
    """
    text = ""
    for part in parts:
        if part and part[0] != " " and (match := ARTICLE.search(text)) is not None:
            text = f"{text[: match.start()]}{match[1]}{article_for(part)[1:]} "
        text += part
    return capitalised(tidied(text))


def tidied(text: str) -> str:
    """No doubled spaces or commas, no space before a mark, no comma before a stop."""
    text = re.sub(r"[ \t]{2,}", " ", text.replace("\\n", "\n"))
    text = re.sub(r" +([,;?!]|\.(?!\d|\.))", r"\1", text)
    text = re.sub(r",(?:\s*,)+", ",", text)
    text = re.sub(r",\s*([.;:?!)])", r"\1", text)
    text = re.sub(r",(?= [–—-] )", "", text)
    return re.sub(r"(?<!\.)([.?!])\.(?!\.)", r"\1", text).strip(" ,")


def capitalised(text: str) -> str:
    """A capital at the start of every sentence, but for coordinates and abbreviations."""

    def large(match: re.Match[str]) -> str:
        before = text[: match.end(1)].rstrip().lower()
        if (
            before.endswith("...")
            or before.rpartition(" ")[2].lstrip("(") in ABBREVIATED
            or KEEP_SMALL.match(text, match.start(2))
        ):
            return match[0]
        return match[1] + match[2].upper()

    return SENTENCE.sub(large, text)
