"""Surface noise: typing mistakes, abbreviations, missing punctuation, fillers and doubled words."""

from __future__ import annotations

import re
from random import Random

KEYS = {
    "a": "sq",
    "b": "vn",
    "c": "xv",
    "d": "sf",
    "e": "wr",
    "f": "dg",
    "g": "fh",
    "h": "gj",
    "i": "uo",
    "j": "hk",
    "k": "jl",
    "l": "k",
    "m": "n",
    "n": "bm",
    "o": "ip",
    "p": "o",
    "q": "w",
    "r": "et",
    "s": "ad",
    "t": "ry",
    "u": "yi",
    "v": "cb",
    "w": "qe",
    "x": "zc",
    "y": "tu",
    "z": "x",
}
SHORT = {
    "please": "pls",
    "you": "u",
    "your": "ur",
    "and": "n",
    "are": "r",
    "then": "thn",
    "for": "4",
    "to": "2",
    "before": "b4",
    "minutes": "mins",
    "seconds": "secs",
    "with": "w",
    "survey": "surv",
    "report": "rpt",
    "sensor": "snsr",
    "sensors": "snsrs",
    "check": "chk",
    "position": "pos",
    "camera": "cam",
    "degrees": "deg",
    "metres": "m",
    "picture": "pic",
    "pictures": "pics",
    "through": "thru",
    "around": "rnd",
    "at": "@",
    "temperature": "temp",
    "panorama": "pano",
    "video": "vid",
    "bathymetry": "bathy",
    "follow": "folw",
    "heading": "hdg",
    "bearing": "brg",
    "station": "stn",
    "location": "loc",
    "without": "w/o",
    "because": "bc",
    "thermal": "therm",
    "speed": "spd",
    "distance": "dist",
    "minute": "min",
    "second": "sec",
    "hour": "hr",
    "hours": "hrs",
    "good": "gd",
    "tomorrow": "tmrw",
    "okay": "k",
}
FREE_WORDS = re.compile(r"(?<![\w'-])[a-z]{4,}(?![\w'-])")


def mistype(word: str, rng: Random) -> str:
    """The word with one slip of the fingers; first letter kept."""
    if len(word) < 4:
        return (
            word[::-1][:1] + word[1:]
            if rng.random() < 0.1
            else word[0] + word[2:] + word[1]
            if len(word) == 3
            else word
        )
    roll, index = rng.random(), rng.randint(1, len(word) - 2)
    if roll < 0.4:
        return word[:index] + word[index + 1] + word[index] + word[index + 2 :]
    if roll < 0.62:
        return word[:index] + word[index + 1 :]
    if roll < 0.78:
        return word[:index] + word[index] + word[index:]
    if roll < 0.92 and word[index] in KEYS:
        return word[:index] + rng.choice(KEYS[word[index]]) + word[index + 1 :]
    return word[: index + 1] + rng.choice("aeiou") + word[index + 1 :]


def typos(text: str, rng: Random, protected: set[str], rate: float) -> str:
    """Mistypes words, but none of `protected`: values that only copying can tell, and numbers."""

    def slip(match: re.Match[str]) -> str:
        word = match[0]
        return word if word in protected or rng.random() > rate else mistype(word, rng)

    return FREE_WORDS.sub(slip, text)


def texted(text: str, rng: Random, protected: set[str]) -> str:
    """Abbreviations as in a text message."""
    rate = rng.choice((0.3, 0.6, 0.9))
    words = text.split(" ")
    return " ".join(
        SHORT[word] if word in SHORT and word not in protected and rng.random() < rate else word
        for word in words
    )


def unpunctuated(text: str) -> str:
    """As voice dictation writes it: no full stops, commas or capitals at the start of sentences;
    names keep theirs.
    """
    text = re.sub(r"([.?!;:]) (\w)", lambda match: f" {match[2]}", text)
    return re.sub(r"(?<!\d)[,](?!\d)|,(?= )|[.?!]$", "", text)


def spaced(text: str) -> str:
    """Punctuation put right after joining: no doubled marks, no space before a mark."""
    text = re.sub(r" +([,.;?!])(?= |$)", r"\1", text)
    text = re.sub(r",\s*,", ",", text)
    text = re.sub(r",([.;:?!])", r"\1", text)
    text = re.sub(r"([.?!])([.?!])+(?= |$)", r"\1", text)
    return re.sub(r"  +", " ", text).strip()
