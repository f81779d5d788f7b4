"""Ordering and joining clauses into a command: the ways in which operators put several things into
words.
"""

from __future__ import annotations

from collections.abc import Sequence
from random import Random

from planner_ft.data.mission.synthetic import frames
from planner_ft.data.mission.synthetic.clauses import Mood, Teller
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.mentions import indefinite

Sentences = list[str]


def joined(parts: Sequence[str], rng: Random) -> str:
    """Clauses of one mood as one sentence."""
    if len(parts) == 1:
        return parts[0]
    if len(parts) == 2:
        return rng.choice(frames.TWO).format(*parts)
    joint = rng.choice(frames.MANY)
    last = (
        joint if joint not in (", ", "; ") and rng.random() < 0.6 else rng.choice(frames.LAST_JOINT)
    )
    return joint.join(parts[:-1]) + last + parts[-1]


def chained(teller: Teller, intents: Sequence[Intent], mood: Mood = "imp") -> str:
    """All intents in order in one sentence."""
    parts = [teller.tell(intent, mood) for intent in intents]
    return joined(parts, teller.rng)


def framed(text: str, mood: Mood, rng: Random) -> str:
    """The sentence in a frame that suits its mood."""
    pool = (
        frames.IMPERATIVE_FRAMES
        if mood == "imp"
        else frames.NOUN_FRAMES
        if mood == "np"
        else frames.GERUND_FRAMES
    )
    return rng.choice(pool).replace("{}", text)


def one_sentence(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """Everything in one sentence, in order."""
    mood = draw_mood(teller.rng)
    parts = [teller.tell(intent, mood) for intent in intents]
    if mood != "imp" and len(parts) > 1:
        joint = teller.rng.choice((", ", ", then ", ", after that "))
        text = (
            joint.join(parts[:-1])
            + teller.rng.choice((" and ", ", then ", " and then ", ", and ", " and after that "))
            + parts[-1]
        )
    else:
        text = joined(parts, teller.rng)
    return [framed(text, mood, teller.rng)]


def draw_mood(rng: Random) -> Mood:
    roll = rng.random()
    return "imp" if roll < 0.72 else "np" if roll < 0.94 else "ger"


def several_sentences(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """One to three clauses a sentence; the later sentences say that they come after."""
    rng = teller.rng
    sentences, index = [], 0
    while index < len(intents):
        size = min(len(intents) - index, rng.choice((1, 1, 1, 2, 2, 3)))
        if index == 0 and size == len(intents) > 1:
            size -= 1
        mood: Mood = "np" if rng.random() < 0.2 else "imp"
        text = (
            joined([teller.tell(intent, mood) for intent in intents[index : index + size]], rng)
            if mood == "imp"
            else ", ".join(teller.tell(intent, mood) for intent in intents[index : index + size])
        )
        sentences.append(_placed(text, mood, index, index + size == len(intents), rng))
        index += size
    return sentences


def _placed(text: str, mood: Mood, index: int, last: bool, rng: Random) -> str:
    if index == 0:
        return (
            rng.choice(frames.FIRST).replace("{}", text)
            if mood == "imp" and rng.random() < 0.12
            else framed(text, mood, rng)
        )
    if mood == "np":
        return rng.choice(frames.NEXT_NOUN).replace("{}", text)
    return rng.choice(frames.LAST if last and rng.random() < 0.18 else frames.NEXT).replace(
        "{}", text
    )


def numbered(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """A numbered or lettered list, in order."""
    rng = teller.rng
    mood: Mood = "np" if rng.random() < 0.45 else "imp"
    style = rng.choice(
        (
            "{}. ",
            "{}) ",
            "({}) ",
            "{}: ",
            "{} ",
            "job {}: ",
            "step {}, ",
            "task {}: ",
            "- ",
            "#{} ",
            "leg {}: ",
        )
    )
    labels: Sequence[object] = range(1, len(intents) + 1)
    if style in ("{}) ", "{}. ") and rng.random() < 0.3:
        labels = "abcdefgh"
    elif style in ("job {}: ", "step {}, ", "task {}: ", "leg {}: ") and rng.random() < 0.5:
        labels = ("one", "two", "three", "four", "five", "six", "seven", "eight")
    items = [
        style.format(label) + teller.tell(intent, mood)
        for label, intent in zip(labels, intents, strict=False)
    ]
    return [rng.choice((" ", "; ", ". ", ", ", " ", "\n")).join(items)]


def telegram(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """Terse notes without articles."""
    rng = teller.rng
    teller.clipped = True
    mood: Mood = "np" if rng.random() < 0.65 else "imp"
    parts = [clip(teller.tell(intent, mood), intent) for intent in intents]
    return [rng.choice((", ", "; ", ". ", ", then ", " / ", " - ", ", ", " -> ")).join(parts)]


def clip(text: str, intent: Intent) -> str:
    """The text without its articles, but for those inside of text values, which the plan holds word
    for word.
    """
    values = [value for value in intent.parameters.values() if isinstance(value, str)]
    values += [
        target.description
        for target in (intent.target, *intent.also)
        if target is not None and target.description
    ]
    for value in values:
        text = text.replace(value, value.replace(" ", "\u00a0"))
    return " ".join(word for word in text.split(" ") if word not in ("a", "an", "the")).replace(
        "\u00a0", " "
    )


def but_first(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """What comes first is said last."""
    rng = teller.rng
    cut = 1 if rng.random() < 0.8 else rng.randint(1, len(intents) - 1)
    early, late = intents[:cut], intents[cut:]
    pattern = rng.choice(frames.BUT_FIRST)
    said: dict[str, str] = {}
    early_first = pattern.find("{early") < pattern.find("{late")
    for name, group in (
        (("early", early), ("late", late)) if early_first else (("late", late), ("early", early))
    ):
        parts = [
            teller.tell(intent, "imp", explicit=bool(said) and position == 0)
            for position, intent in enumerate(group)
        ]
        said[name] = (
            joined(parts, rng) if len(parts) < 3 else ", ".join(parts[:-1]) + " and " + parts[-1]
        )
    if (
        not early_first
        and not pattern.startswith(("before you", "don't", "make sure"))
        and rng.random() < 0.25
    ):
        said["late"] = framed(said["late"], "imp", rng).removesuffix("?")
    return [
        pattern.format(
            early=said["early"],
            late=said["late"],
            early_cap=said["early"][0].upper() + said["early"][1:],
        )
    ]


def after_gerund(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """After doing this, do that; before doing that, do this."""
    rng = teller.rng
    mood: Mood = rng.choice(("ger", "ger", "np"))
    pool = frames.AFTER_GERUND if mood == "ger" else frames.AFTER_NOUN
    pattern = rng.choice(pool if rng.random() < 0.7 else frames.BEFORE_GERUND)
    first, rest = intents[:1], intents[1:]
    if pattern in frames.BEFORE_GERUND:
        early: Mood = "imp"
        late: Mood = "ger"
        rest, tail = rest[:1], rest[1:]
    else:
        early, late, tail = mood, "imp", ()
    said: dict[str, str] = {}
    early_first = pattern.find("{early") < pattern.find("{late")
    for name in ("early", "late") if early_first else ("late", "early"):
        group, group_mood = (first, early) if name == "early" else (rest, late)
        parts = [
            teller.tell(intent, group_mood, explicit=bool(said) and index == 0)
            for index, intent in enumerate(group)
        ]
        said[name] = joined(parts, rng) if group_mood == "imp" else " and ".join(parts)
    sentences = [pattern.format(**said)]
    if tail:
        sentences += [
            _placed(
                joined(
                    [
                        teller.tell(intent, "imp", explicit=index == 0)
                        for index, intent in enumerate(tail)
                    ],
                    rng,
                ),
                "imp",
                1,
                True,
                rng,
            )
        ]
    return sentences


def last_first(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """Everything backwards, each thing said to come before the one just told."""
    rng = teller.rng
    mood: Mood = "imp" if rng.random() < 0.6 else "np"
    said = [teller.tell(intent, mood, explicit=True) for intent in reversed(intents)]
    if mood == "np":
        opening, middle, final = rng.choice(
            (
                ("the last thing is", "before that comes", "and first of all"),
                ("at the end I want", "ahead of that", "and at the very start"),
                ("last comes", "before it", "first comes"),
            )
        )
    else:
        opening, middle, final = rng.choice(
            (
                ("in the end", "before that", "and first of all"),
                ("finally", "before that", "but first"),
                ("to finish", "before that", "but to start with"),
                ("the last thing to do is to", "before that", "and first"),
            )
        )
    return [
        f"{opening} {said[0]}",
        *(f"{middle} {text}" for text in said[1:-1]),
        f"{final} {said[-1]}",
    ]


def where_first(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """The place or the thing is named before what is to be done there."""
    rng = teller.rng
    target = intents[0].target
    if (
        target is None
        or target.spot
        or intents[0].title in ("SearchAndDetect", "SubseaCableTrack")
        or target.identity is not None
        or "," in target.whereabouts
    ):
        return (
            several_sentences(teller, intents)
            if len(intents) > 1
            else one_sentence(teller, intents)
        )
    own = (
        intents[0].parameters.get("feature_type", intents[0].parameters.get("target_feature"))
        == target.description
    )
    if intents[0].title in PLACE_TASKS and not own and rng.random() < 0.5:
        pattern = rng.choice(frames.WHERE_FIRST)
    elif target.description is not None and rng.random() < 0.55:
        return _introduced(teller, target, intents)
    else:
        pattern = rng.choice(frames.COLON_FIRST)
    place = teller.introduce(target)
    same = [intent for intent in intents if intent.target is target]
    inside = intents[: max(1, len(same) if intents[: len(same)] == tuple(same) else 1)]
    text = pattern.replace("{}", place.rstrip(","), 1).replace("{}", chained(teller, inside), 1)
    rest = intents[len(inside) :]
    return [text, *([] if not rest else [_placed(chained(teller, rest), "imp", 1, True, rng)])]


def pair(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """Two things of a kind are introduced; the second is "the other one"."""
    told = teller.pair(intents[0])
    rest = several_sentences(teller, intents[1:]) if len(intents) > 1 else []
    return [told[0], framed(told[1], "imp", teller.rng), *rest]


def on_site(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """The vehicle is said to be at the place already."""
    rng = teller.rng
    target = next(
        intent.target for intent in intents if intent.target is not None and intent.target.on_site
    )
    place = teller.introduce(target).rstrip(",")
    opening = rng.choice(frames.ON_SITE)
    rest = (
        one_sentence(teller, intents)
        if rng.random() < 0.5 or len(intents) == 1
        else several_sentences(teller, intents)
    )
    if opening.endswith(",") and rest:
        return [f"{opening.format(place)} {rest[0]}", *rest[1:]]
    return [opening.format(place), *rest]


def _introduced(teller: Teller, target: Target, intents: Sequence[Intent]) -> Sentences:
    rng = teller.rng
    text = teller.introduce(target)
    plain = text.startswith("the ") and not any(mark.isupper() for mark in target.description or "")
    opening = (
        rng.choice(frames.INTROS_INDEFINITE).format(indefinite(text[4:]))
        if plain and rng.random() < 0.75
        else rng.choice(frames.INTROS_DEFINITE).format(text)
    )
    rest = (
        one_sentence(teller, intents)
        if rng.random() < 0.5 or len(intents) == 1
        else several_sentences(teller, intents)
    )
    return [opening.rstrip(","), *rest]


def radio(teller: Teller, intents: Sequence[Intent], boat: str) -> Sentences:
    """A radio message with call signs and prosigns."""
    rng = teller.rng
    station = rng.choice(frames.STATIONS)
    if rng.random() < 0.3:
        text = ". Break. ".join(teller.tell(intent) for intent in intents)
    elif rng.random() < 0.3:
        text = ". ".join(
            _capital(sentence.rstrip("?")) for sentence in several_sentences(teller, intents)
        )
    else:
        text = chained(teller, intents)
    pattern = rng.choice(frames.RADIO)
    if ". {text}" in pattern or ": {text}" in pattern:
        text = _capital(text)
    return [
        pattern.format(
            boat=boat,
            station=station if not pattern.startswith("{station}") else _capital(station),
            text=text,
        )
    ]


def _capital(text: str) -> str:
    return text[:1].upper() + text[1:]


def questions(teller: Teller, intents: Sequence[Intent]) -> Sentences:
    """Polite questions, one after the other."""
    rng = teller.rng
    asks = (
        "can you {}?",
        "could you {}?",
        "would you {}?",
        "could you please {}?",
        "can the boat {}?",
        "is it possible to {}?",
        "could we {}?",
        "might you {}?",
        "can we {}?",
        "would it be possible to {}?",
        "could someone {}?",
    )
    cut = rng.randint(1, len(intents))
    sentences = [rng.choice(asks).format(chained(teller, intents[:cut]))]
    if cut < len(intents):
        later = (
            "and then {}?",
            "and after that {}?",
            "and could you then {}?",
            "after that, can you {}?",
            "and then could you {}?",
            "then {}, please",
        )
        sentences.append(rng.choice(later).format(chained(teller, intents[cut:])))
    return sentences
