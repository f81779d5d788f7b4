"""From chosen parts to a text as it arrives: articles, spaces and capitals; values are marked.

A value stands between VALUE_OPEN and VALUE_CLOSE until the text is finished, so that noise leaves
it alone and a text without its values (its skeleton) can be compared with others. Most commands and
task prompts stay clean, some arrive as keyboards, telegrams, hurry and radio leave them.
"""

import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from pathlib import Path
from random import Random
from typing import Any

from planner_ft.data.numbers import COMPASS, ONES, TENS, Draw, Value, words
from planner_ft.data.templates.grammar import Nodes, Slot, choose
from planner_ft.support.files import read_json

VALUE_OPEN, VALUE_CLOSE = "\x02", "\x03"
PIECE = tuple[str, bool]

PLAIN: frozenset[str] = frozenset()
TRIES = 60
"""Draws of a value after which any is taken."""
MARKS = ",.;:!?"
Change = Callable[[list[PIECE], Random], list[PIECE]]
LISTS: dict[str, Any] = read_json(Path(__file__).with_suffix(".json"))
_ARTICLES = ("a ", "an ", "the ")
_DETERMINERS = frozenset(words("the a an this that each every its any"))
_EVERY = frozenset(words("every each last past recent latest preceding per"))
_CONSONANT = ("uni", "use", "usu", "uti", "one ", "one-", "once", "eu", "u-")
_SPELT = frozenset(words("LED ROV RIB SAR NATO USV UAV RTK"))
_SPOKEN = frozenset([*ONES, *TENS, *COMPASS.values(), *words("the a an due half minus")])
_ABBREVIATED = frozenset(LISTS["abbreviated"])
_GAP = re.compile(r" +(?=[ ,;?!):]|\. )|(?<=\() +")
_DOUBLED = re.compile(r",+(?=[,.;:)?!])|(?<=[?!])\.")
_START = re.compile(r'(^[^\w\x02]*|\n|[^ ]*[.?!]["”)\x03]* )(\x02?)([^\W\d_][^\W\d_]*)')


def article_for(text: str) -> str:
    """ "a" or "an", by the sound of `text`."""
    word = text.split(" ", 1)[0].strip("\"'“(,.")
    if not word:
        return "a"
    if word[0].isdigit():
        number = word.split("-")[0].split(".")[0]
        return "an" if number[0] == "8" or number in ("11", "18") else "a"
    if word[0].isupper() and (len(word) == 1 or not word[1].islower()):
        spelt = word.strip("0123456789-") in _SPELT
        return "an" if word[0] in "AEFHILMNORSX" and not spelt else "a"
    low = word.lower()
    vowel = low[0] in "aeiouåøöäé" and not f"{low} ".startswith(_CONSONANT)
    return "an" if vowel or low.startswith(("hour", "honest")) else "a"


def bare(text: str) -> str:
    """The text without its article."""
    return text.partition(" ")[2] if text.startswith(_ARTICLES) else text


def _last_word(text: str) -> str:
    """The word before the space that ends the text; empty where no space does."""
    return text[-12:-1].rpartition(" ")[2] if text.endswith(" ") else ""


def after_article(text: str) -> bool:
    """Whether a determiner ends the text: "the ", "every "."""
    return _last_word(text).lower() in _DETERMINERS


def joined(pieces: Iterable[PIECE], *, small: bool = False) -> str:
    """One text of (text, whether it is a value): articles fit what follows, gaps are closed, and
    sentences begin with capitals unless the template is `small`, written without them.
    """
    text = ""
    for piece, value in pieces:
        if not piece:
            continue
        last = _last_word(text)
        low = last.lower().strip("(\"'")
        indefinite = low in _EVERY and piece.startswith(("a ", "an "))
        if value and (low in _DETERMINERS or indefinite):
            piece = bare(piece)
        if low in ("a", "an") and piece[0] != " ":
            text = f"{text[: -len(last) - 1]}{last[:-1] if low == 'an' else last}"
            text += f"{article_for(piece)[1:]} "
        text += f"{VALUE_OPEN}{piece}{VALUE_CLOSE}" if value else piece
    # No doubled spaces or commas, no space before a mark, no comma before a stop.
    text = _DOUBLED.sub("", _GAP.sub("", text)).strip(" ,")
    text = f"{text[:-2]}." if text.endswith(" .") else text
    return text if small else _START.sub(_raised, text)


def _raised(match: re.Match[str]) -> str:
    """The start of a sentence with a capital; names and other text values stay as they are."""
    before, mark, word = match.groups()
    ended = before.rstrip(f' "”){VALUE_CLOSE}').lower().lstrip("(")
    if ended in _ABBREVIATED or (len(word) == 1 and word != "a") or (mark and word not in _SPOKEN):
        return match[0]
    return f"{before}{mark}{word[0].upper()}{word[1:]}"


def plain(text: str) -> str:
    """The text without the marks."""
    return text.replace(VALUE_OPEN, "").replace(VALUE_CLOSE, "")


def segments(text: str) -> list[PIECE]:
    """The text by what is and what is not a value; values with their marks left out."""
    first, *rest = text.split(VALUE_OPEN)
    found = [(first, False)]
    for piece in rest:
        value, _close, after = piece.partition(VALUE_CLOSE)
        found += [(value, True), (after, False)]
    return [(piece, value) for piece, value in found if piece or value]


def skeleton(text: str) -> str:
    """The text with each value replaced by an underscore."""
    return "".join("_" if value else piece for piece, value in segments(text))


# ---------------------------------------------------------------- a template in the making


class Drawing:
    """A wording of a template: its `parts`, the `slots` in them, the `labels` that were chosen and
    the keys of the slots that are `said`. `draws` makes a new value of each; optional parts stand
    where their slots are `given`.
    """

    def __init__(
        self, nodes: Nodes, draws: Mapping[str, Draw], rng: Random, given: frozenset[str] = PLAIN
    ) -> None:
        self.draws, self.rng = draws, rng
        self.values: dict[str, Value] = {}
        self.parts = choose(nodes, rng, [], given)
        slots = [part for part in self.parts if isinstance(part, Slot)]
        self.slots = [slot for slot in slots if slot.sign != "?"]
        self.labels = {slot.key for slot in slots if slot.sign == "?"}
        self.said = {slot.key for slot in slots if not slot.sign}

    def new(
        self, key: str, taken: Collection[object] = (), options: frozenset[str] = PLAIN
    ) -> Value:
        """A value of a slot that is none of those taken and has the wordings that are asked for;
        any, where many draws find none.
        """
        for _ in range(TRIES):
            value = self.draws[key](self.rng)
            if value.value not in taken and value.has(options):
                break
        return value

    def asked(self, key: str) -> frozenset[str]:
        """The options of all mentions of a slot."""
        return PLAIN.union(*(slot.options for slot in self.slots if slot.key == key))

    def pieces(self) -> Iterator[PIECE]:
        """The text in pieces, each with whether it is a value."""
        for place, part in enumerate(self.parts):
            if isinstance(part, str):
                yield part, False
            elif part.sign != "?":
                yield from self.spoken(part, place)

    def spoken(self, slot: Slot, place: int) -> Iterator[PIECE]:
        """What stands for the slot at a place of the parts."""
        raise NotImplementedError


# ---------------------------------------------------------------- noise


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
        pieces, lambda one: _mistyped(one, rng) if _free(one) and rng.random() < rate else one
    )
    return small(changed, rng) if rng.random() < 0.5 else changed


def shortened(pieces: list[PIECE], rng: Random) -> list[PIECE]:
    """As it is thumbed into a telephone."""
    rate, short = rng.choice((0.3, 0.6, 0.9)), LISTS["short"]
    changed = _each(pieces, lambda one: short[one] if one in short and rng.random() < rate else one)
    return small(changed, rng) if rng.random() < 0.6 else changed


def small(pieces: list[PIECE], _rng: Random) -> list[PIECE]:
    """In small letters and without the last stop; values keep their capitals."""
    last = _each(pieces[-1:], lambda word: word.lower().rstrip("."))
    return [*_each(pieces[:-1], str.lower), *last]


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
