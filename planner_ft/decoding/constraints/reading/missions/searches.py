"""Whether a command leaves anything to search for: not where every sentence about a place states it
or speaks of the one stated before.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from planner_ft.decoding.constraints.reading.missions.apart import PLACE, SENTENCE

SEARCH = re.compile(
    r"\b(?:find|finding|found|search\w*|locat\w*|look(?:ing)?"
    r" (?:for|around|out|about)|hunt\w*|seek\w*|spot(?:ted|ting)?|detect\w*|"
    r"where|missing|lost|sweep for|somewhere|discover\w*|track(?:ing)?"
    r" down|confirm\w*|identif\w*)\b",
    re.IGNORECASE,
)
"""Words that may ask for a search."""
THERE = re.compile(
    r"(?<!get )(?<!getting )(?<!go )(?<!over )\bthere\b(?!['’]|"
    r" (?:is|are|was|were|will|may|any|an?|some|no)\b)"
    r"|\bat (?:that|the) same \w+|\b(?:same place|same spot|from that spot|on the spot)\b",
    re.IGNORECASE,
)
"""Words for the place that was stated before."""
MOVES = re.compile(
    r"\b(?:then|next|after"
    r" (?:that|which|it)|afterwards|finally|(?:go|head|move|carry|proceed|over|on) (?:on )?to)\b",
    re.IGNORECASE,
)
"""Words behind which something else may be meant."""
_WORK = re.compile(
    r"\b(?:inspect\w*|survey\w*|orbit\w*|circ\w+|round|laps?|loop\w*|arcs?|runs?|pass\w*|along|hold\w*|keep\w*|stay\w*|station|loiter\w*|wait\w*|drift\w*|float\w*|"
    r"panorama\w*|pano|film\w*|footage|video|star(?:e|ing)|shoot\w*|photo\w*|pictur\w*|imag\w*|glare\w*|reflect\w*|thermal|temperature\w*|readings?|hott?est|hot|"
    r"landings?|lidar|clearance|scan\w*|sweep\w*|examin\w*|look\w*|watch\w*|follow\w*|tail\w*|shadow\w*|escort\w*|check\w*|visit\w*|go|head|proceed|data|get|take|"
    r"do|make|give|see|monitor\w*|record\w*|measur\w*|engines?|propulsion|series|lapse)\b",
    re.IGNORECASE,
)
_PLACELESS = re.compile(
    r"\b(?:(?:check|test)\w*(?: \w+){0,2}?"
    r" (?:sensors?|lens|gps|cameras?)|sensors?|diagnost\w*|self-?(?:check|test)\w*|health|lens|gps|"
    r"report\w*|summar\w*|upload\w*|send\w*|transmit\w*|home|return\w*|back|rtb|base|dock\w*|"
    r"berth\w*|alongside|moor\w*|write\w*|written)\b",
    re.IGNORECASE,
)
_WEATHER = re.compile(
    r"\b(?:winds?|gust\w*|sea state|barometer|visibility|swell|forecast|weather|sunset|sunrise|air"
    r" pressure|humidity|"
    r"(?:water|air|sea) (?:is )?(?:at )?\d+ ?(?:degrees|°)|high water|low water|slack water)\b",
    re.IGNORECASE,
)
_ORDERED = re.compile(
    r"\b(?:go|head|proceed|hold|circle|orbit|survey|inspect|film|follow|drift|dock|take|get|make|do|send|check|track|find|"
    r"please|you|your)\b",
    re.IGNORECASE,
)
_SEVERAL = re.compile(
    r"\b(?:other|another|both|each|every|all|too|also|as"
    r" well|same|likewise|ditto|second|two|three|four|neighbour\w*|next)\b",
    re.IGNORECASE,
)
_TIMED = re.compile(r"\b(?:before|after|until|till|when|once)\b", re.IGNORECASE)
_CLAUSE = re.compile(
    r"[,:]|\b(?:and|before|after|until|till|when|once|only|while|without|so|unless|off|for|to"
    r" clear)\b",
    re.IGNORECASE,
)
_THING = re.compile(
    r"\b(?i:the|a|an|that|this|our|your|its|her|his)\b(?!"
    r" (?i:minutes?|hours?|seconds?|quarter|half|couple|full|complete|metres?))"
    r"|(?<!^)\b[A-Z][a-z]+|\b[A-Z]+["
    r" -]?\d|\b(?i:circle|orbit|round|survey|inspect|film|follow|along|past)(?:ing)? [a-z]{3,}"
)
"""A thing, or a name, in a clause without a place."""
_SOUGHT = re.compile(
    r"\b(?:find|locate|look for|search for|hunt for|seek out|go looking for)(?: me| us)?"
    r" (?:the|a|an|our|that) "
    r"(?P<thing>(?!hott?est\b|other\b)[\w'-]+(?:"
    r" (?!(?:and|or|with|at|in|on|near|by|that|which|who|then|of|for|to|from|off|is|was|somewhere|drifting|adrift|"
    r"first|last|again)\b)[\w'-]+){1,4}?)(?=,|\.(?: |$)|;|:|!|\?|$| (?:and|then)\b)",
    re.IGNORECASE,
)
"""What is searched for in plain words, up to a sign or a word that ends it."""


def pieces_of_sought(text: str) -> Iterator[str]:
    """Parts of the name of the only thing that a text says is to be found: "yellow dive" and
    "float" of "find the yellow dive float and".
    """
    found = [match["thing"].split() for match in _SOUGHT.finditer(text)]
    if len(found) == 1:
        words = found[0]
        pieces = (
            words[start:end]
            for start in range(len(words))
            for end in range(start + 1, len(words) + 1)
            if end - start < len(words)
        )
        yield from (
            form
            for piece in pieces
            for form in dict.fromkeys((" ".join(piece), " ".join(piece).lower()))
        )


def nothing_to_search(text: str) -> bool:
    """Whether a command certainly asks for no search."""
    if SEARCH.search(text) or not PLACE.search(text):
        return False
    starts = [0, *(match.end() for match in SENTENCE.finditer(text)), len(text)]
    sentences = [text[start:end] for start, end in pairwise(starts) if text[start:end].strip()]
    placed = False
    for sentence in sentences:
        places = len(PLACE.findall(sentence))
        if places == 0 and _WEATHER.search(sentence) and not _ORDERED.search(sentence):
            continue
        if places == 0:
            rest = _PLACELESS.sub(" ", sentence)
            plain = _WORK.search(rest) is None and (
                _PLACELESS.search(sentence) is not None or len(sentence.split()) <= 2
            )
            if not (placed and THERE.search(sentence) and not MOVES.search(sentence)) and not plain:
                return False
        elif not (places == 1 and _around(sentence)):
            return False
        placed = placed or places > 0
    return True


def _around(sentence: str) -> bool:
    """Whether a sentence with one place is about it alone."""
    if MOVES.search(sentence):
        return False
    if THERE.search(sentence):
        return _TIMED.search(sentence) is None
    if _SEVERAL.search(sentence):
        return False
    clauses = _CLAUSE.split(PLACE.sub(" ; ", sentence))
    return not any(
        _THING.search(_PLACELESS.sub(" ", clause)) for clause in clauses if ";" not in clause
    )
