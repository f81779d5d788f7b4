"""Words of a text, and how near one word is to another."""

from __future__ import annotations

import re

_WORD = re.compile(r"[^\W_]+(?:[-'’.][^\W_]+)*")


def words(text: str) -> list[str]:
    """The words of a text in lower case; hyphens, apostrophes and dots inside a word are kept."""
    return [word.lower().replace("’", "'") for word in _WORD.findall(text)]


def edit_distance(first: str, second: str, limit: int) -> int:
    """Levenshtein distance with transpositions, or `limit` + 1 as soon as it is larger than
    `limit`.
    """
    if abs(len(first) - len(second)) > limit:
        return limit + 1
    before: list[int] = []
    previous = list(range(len(second) + 1))
    for row, letter in enumerate(first, 1):
        current = [row]
        for column, other in enumerate(second, 1):
            cost = min(
                previous[column] + 1, current[-1] + 1, previous[column - 1] + (letter != other)
            )
            if row > 1 and column > 1 and letter == second[column - 2] and first[row - 2] == other:
                cost = min(cost, before[column - 2] + 1)
            current.append(cost)
        if min(current) > limit:
            return limit + 1
        before, previous = previous, current
    return previous[-1]


def says(text: str, phrase: str, *, misspelt: bool) -> list[str]:
    """Words of `phrase` that do not occur in `text`, also not with a possessive or plural ending.

    With `misspelt`, a word also counts when the text has one that differs from it as a misspelling
    or a shortening does.
    """
    said = {
        part
        for word in words(text)
        for part in (word, word.removesuffix("'s"), word.rstrip("'"), *re.split(r"[-'.]", word))
    }
    missing = []
    for word in words(phrase):
        parts = {word, *(re.split(r"[-.]", word) if "-" in word else ())}
        if (
            word in said
            or f"{word}s" in said
            or word.removesuffix("s") in said
            or (parts - {word} and parts - {word} <= said)
        ):
            continue
        if not (misspelt and any(_resembles(other, word) for other in said)):
            missing.append(word)
    return missing


def _resembles(written: str, meant: str) -> bool:
    # "T142" is no misspelling of "T143".
    if len(meant) < 3 or len(written) < 2 or any(letter.isdigit() for letter in meant):
        return False
    limit = max(1, len(meant) // 3)
    if edit_distance(written, meant, limit) <= limit:
        return True
    # Shortened as in text messages: the consonants in order, nothing else ("thrml" for thermal).
    letters = iter(meant)
    return (
        written[0] == meant[0]
        and len(written) * 2 >= len(meant)
        and all(letter in letters for letter in written)
    )


NUMBER, NAME = "#", "@"
_NUMBER_WORDS = frozenset(
    "zero one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen "  # noqa: SIM905
    "nineteen twenty thirty forty fifty sixty seventy eighty ninety hundred thousand half quarter".split()
)
_SHINGLE = re.compile(r"[#@]|-?\d+(?:\.\d+)?|[^\W\d_]+(?:['’][^\W\d_]+)?")
_CODE = re.compile(r"\b(?=\w*\d)(?=\w*[A-Za-z])[\w-]+\b")
_NAME = re.compile(r"(?<![.!?:;]\s)(?<!^)(?<![\w\"])[A-Z][\w'’-]*(?:\s+(?:[A-Z][\w'’-]*|#))*")
_NUMBER = re.compile(r"-?\d+(?:[.,]\d+)*")


def shingle_words(text: str) -> list[str]:
    """Words and numbers of a text in lower case, a sign kept with its number."""
    return _SHINGLE.findall(text.lower())


def mask(text: str) -> str:
    """The text with its numbers, in figures or words, and its names replaced: what is left is the
    phrasing.

    Names are capitalised words inside a sentence and codes of letters and digits; runs of numbers
    become one.
    """
    text = _NAME.sub(NAME, _NUMBER.sub(NUMBER, _CODE.sub(NAME, text)))
    masked = [
        NUMBER if word.lower() in _NUMBER_WORDS else word
        for word in re.findall(r"[#@]|[^\W_]+(?:['’][^\W_]+)*", text)
    ]
    return " ".join(
        word
        for index, word in enumerate(masked)
        if index == 0 or word not in (NUMBER, NAME) or word != masked[index - 1]
    )
