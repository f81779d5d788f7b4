"""Noise on commands and task prompts: most stay clean, some arrive as keyboards, telegrams, hurry
and radio leave them.

Texts have their values marked (`render.VALUE_OPEN`), and no change touches a value.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.templates.render import PIECE, VALUE_CLOSE, VALUE_OPEN, segments
from planner_ft.support.files import read_json

Change = Callable[[list[PIECE], Random], list[PIECE]]


@functools.cache
def _lists() -> dict[str, Any]:
    return dict(read_json(Path(__file__).parent / "noise.json"))


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
            continue
        for number, word in enumerate(segment.split(" ")):
            if number:
                pieces.append((" ", False))
            if word:
                pieces.append((word, word.strip(",.;:!?") in keep))
    return pieces


def _joined(pieces: list[PIECE]) -> str:
    return "".join(piece for piece, _stays in pieces).strip(" ")


def _free(piece: PIECE) -> bool:
    """Whether a word may be mistyped: an ordinary one in small letters."""
    word = piece[0].strip(",.;:!?")
    return (
        not piece[1]
        and len(word) > 3
        and word.isalpha()
        and word.islower()
        and word not in _lists()["kept"]
    )


def mistype(word: str, rng: Random) -> str:
    """The word of four letters or more with one slip of the fingers; first letter kept."""
    roll, index = rng.random(), rng.randint(1, len(word) - 2)
    if roll < 0.4:
        return word[:index] + word[index + 1] + word[index] + word[index + 2 :]
    if roll < 0.62:
        return word[:index] + word[index + 1 :]
    if roll < 0.78:
        return word[:index] + word[index] + word[index:]
    near = _lists()["keys"].get(word[index]) if roll < 0.92 else None
    if near:
        return word[:index] + str(rng.choice(near)) + word[index + 1 :]
    return word[: index + 1] + rng.choice("aeiou") + word[index + 1 :]


def _mistyped(piece: PIECE, rng: Random) -> PIECE:
    core = piece[0].rstrip(",.;:!?")
    return mistype(core, rng) + piece[0][len(core) :], piece[1]


def slipped(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With one or two words mistyped."""
    for _ in range(1 if rng.random() < 0.65 else 2):
        free = [number for number, piece in enumerate(pieces) if _free(piece)]
        if free:
            number = rng.choice(free)
            pieces[number] = _mistyped(pieces[number], rng)
    return pieces


def garbled(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With every second to fifth word mistyped."""
    rate = rng.choice((0.2, 0.3, 0.45))
    changed = [
        _mistyped(piece, rng) if _free(piece) and rng.random() < rate else piece for piece in pieces
    ]
    return small(changed, rng) if rng.random() < 0.5 else changed


def shortened(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """As it is thumbed into a telephone."""
    rate, short = rng.choice((0.3, 0.6, 0.9)), _lists()["short"]
    changed = [
        (short[word], stays)
        if not stays and word in short and rng.random() < rate
        else (word, stays)
        for word, stays in pieces
    ]
    return small(changed, rng) if rng.random() < 0.6 else changed


def small(pieces: list[PIECE], _rng: Random) -> list[PIECE]:
    """In small letters and without the last stop; values keep their capitals."""
    changed = [(word if stays else word.lower(), stays) for word, stays in pieces]
    word, stays = changed[-1]
    return [*changed[:-1], (word if stays else word.rstrip("."), stays)]


def careless(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without its first capital, its last stop or both."""
    if rng.random() < 0.6 and not pieces[0][1]:
        pieces[0] = (pieces[0][0][0].lower() + pieces[0][0][1:], False)
    word, stays = pieces[-1]
    if not stays and rng.random() < 0.7:
        pieces[-1] = (word.rstrip("."), False)
    return pieces


def dictated(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without marks and capitals."""
    return [(word if stays else word.strip(",.;:?!"), stays) for word, stays in small(pieces, rng)]


def telegraphed(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """Without articles and "please"; with STOP for the stops now and then."""
    changed: list[PIECE] = []
    stops = rng.random() < 0.2
    for word, stays in pieces:
        if not stays and word.lower() in _lists()["little"]:
            continue
        if word == " " and (not changed or changed[-1][0] == " "):
            continue
        full = stops and not stays and len(word) > 1 and word[-1] in ".;!?"
        changed.append((f"{word[:-1]} STOP", False) if full else (word, stays))
    if changed and not changed[0][1]:
        changed[0] = (changed[0][0][:1].upper() + changed[0][0][1:], False)
    return changed or pieces


def greeted(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With a greeting ahead, unless there is one."""
    lists = _lists()
    first, stays = pieces[0]
    low = first.strip(",.!:;").lower()
    if low in lists["greeted"]:
        return pieces
    greeting = rng.choice(lists["greetings"])
    if not stays and low in lists["starts"]:
        return [(f"{greeting}, {first[0].lower()}{first[1:]}", False), *pieces[1:]]
    return [(f"{greeting}. ", False), *pieces]


def signed(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """With a word of farewell."""
    joint = " " if pieces[-1][0][-1] in ".?!" else ". "
    return [*pieces, (joint + rng.choice(_lists()["farewells"]), False)]


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
