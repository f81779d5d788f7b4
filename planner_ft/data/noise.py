"""Noise on commands and task prompts: most stay clean, some arrive as keyboards, telegrams, hurry
and radio leave them.

Texts have their values marked (`render.VALUE_OPEN`), and no change touches a value.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.templates.render import PIECE, VALUE_CLOSE, VALUE_OPEN, segments
from planner_ft.support.files import read_json

MARKS = ",.;:!?"
Change = Callable[[list[PIECE], Random], list[PIECE]]
LISTS: dict[str, Any] = read_json(Path(__file__).with_suffix(".json"))


def noisy(text: str, rng: Random, *, keep: frozenset[str] = frozenset(), shout: bool = True) -> str:
    """The text with its values marked as it arrives, mostly unchanged. Words of `keep` are never
    mistyped; `shout` says whether a telegram may be in capitals.
    """
    roll = rng.random()
    for share, change in CHANGES:
        if roll < share:
            changed = _joined(change(_split(text, keep), rng))
            capitals = change is telegraphed and shout and "°" not in changed
            return changed.upper() if capitals and rng.random() < 0.45 else changed
        roll -= share
    return text


def _split(text: str, keep: frozenset[str]) -> list[PIECE]:
    """The text by words: (word or gap, whether it stays as it is)."""
    pieces: list[PIECE] = []
    for segment, value in segments(text):
        if value:
            pieces.append((VALUE_OPEN + segment + VALUE_CLOSE, True))
        else:
            words = [piece for word in segment.split(" ") for piece in (" ", word)][1:]
            pieces += [(word, word.strip(MARKS) in keep) for word in words if word]
    return pieces


def _joined(pieces: list[PIECE]) -> str:
    return "".join(piece for piece, _stays in pieces).strip(" ")


def _each(pieces: list[PIECE], change: Callable[[str], str]) -> list[PIECE]:
    """The pieces, those changed that need not stay."""
    return [(word if stays else change(word), stays) for word, stays in pieces]


def _free(word: str) -> bool:
    """Whether a word may be mistyped: an ordinary one in small letters."""
    bare = word.strip(MARKS)
    return len(bare) > 3 and bare.isalpha() and bare.islower() and bare not in LISTS["kept"]


def _mistyped(word: str, rng: Random) -> str:
    """The word of four letters or more with one slip of the fingers; first letter kept."""
    core = word.rstrip(MARKS)
    roll, index = rng.random(), rng.randint(1, len(core) - 2)
    before, letter, after = core[:index], core[index], word[index + 1 :]
    if roll < 0.4:
        return before + after[0] + letter + after[1:]
    if roll < 0.62:
        return before + after
    if roll < 0.78:
        return before + letter + letter + after
    near = LISTS["keys"].get(letter) if roll < 0.92 else None
    return before + (rng.choice(near) if near else letter + rng.choice("aeiou")) + after


def slipped(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With one or two words mistyped."""
    for _ in range(1 if rng.random() < 0.65 else 2):
        free = [at for at, (word, stays) in enumerate(pieces) if not stays and _free(word)]
        if free:
            number = rng.choice(free)
            pieces[number] = _mistyped(pieces[number][0], rng), False
    return pieces


def garbled(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With every second to fifth word mistyped."""
    rate = rng.choice((0.2, 0.3, 0.45))
    changed = _each(
        pieces, lambda word: _mistyped(word, rng) if _free(word) and rng.random() < rate else word
    )
    return small(changed, rng) if rng.random() < 0.5 else changed


def shortened(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """As it is thumbed into a telephone."""
    rate, short = rng.choice((0.3, 0.6, 0.9)), LISTS["short"]
    changed = _each(
        pieces, lambda word: short[word] if word in short and rng.random() < rate else word
    )
    return small(changed, rng) if rng.random() < 0.6 else changed


def small(pieces: list[PIECE], _rng: Random) -> list[PIECE]:
    """In small letters and without the last stop; values keep their capitals."""
    return [
        *_each(pieces[:-1], str.lower),
        *_each(pieces[-1:], lambda word: word.lower().rstrip(".")),
    ]


def careless(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without its first capital, its last stop or both."""
    if rng.random() < 0.6:
        pieces[:1] = _each(pieces[:1], lambda word: word[0].lower() + word[1:])
    if not pieces[-1][1] and rng.random() < 0.7:
        pieces[-1] = pieces[-1][0].rstrip("."), False
    return pieces


def dictated(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without marks and capitals."""
    return _each(small(pieces, rng), lambda word: word.strip(MARKS))


def telegraphed(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without articles and "please"; with STOP for the stops now and then."""
    changed: list[PIECE] = []
    stops, little = rng.random() < 0.2, LISTS["little"]
    for word, stays in pieces:
        doubled = word == " " and (not changed or changed[-1][0] == " ")
        if not doubled and (stays or word.lower() not in little):
            full = stops and not stays and len(word) > 1 and word[-1] in ".;!?"
            changed.append((f"{word[:-1]} STOP", False) if full else (word, stays))
    changed[:1] = _each(changed[:1], lambda word: word[:1].upper() + word[1:])
    return changed or pieces


def greeted(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With a greeting ahead, unless there is one."""
    first, stays = pieces[0]
    low = first.strip(",.!:;").lower()
    if low in LISTS["greeted"]:
        return pieces
    greeting = rng.choice(LISTS["greetings"])
    if not stays and low in LISTS["starts"]:
        return [(f"{greeting}, {first[0].lower()}{first[1:]}", False), *pieces[1:]]
    return [(f"{greeting}. ", False), *pieces]


def signed(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With a word of farewell."""
    joint = " " if pieces[-1][0][-1] in ".?!" else ". "
    return [*pieces, (joint + rng.choice(LISTS["farewells"]), False)]


CHANGES: tuple[tuple[float, Change], ...] = (
    (0.035, greeted),
    (0.025, signed),
    (0.06, slipped),
    (0.03, small),
    (0.03, careless),
    (0.03, garbled),
    (0.015, shortened),
    (0.02, dictated),
    (0.02, telegraphed),
)
"""What happens to a text, and to what share of them."""
