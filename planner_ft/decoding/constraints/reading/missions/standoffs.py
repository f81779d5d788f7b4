"""Stand-offs, lengths and speeds that certainly belong to the one pass, orbit, survey or docking
that a command asks for: "50 m long and 6 off".
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from planner_ft.data.quantities import Quantity, quantities
from planner_ft.decoding.constraints.reading.missions.apart import PLACE, SENTENCE

Told = dict[tuple[str, str], float]
"""Per pattern and parameter of a task the value that certainly is its."""
_KINDS = {
    "pass": re.compile(
        r"\b(?:runs?|running|pass|passing|rides?|sail|go|drive|cruise|steam|travel)\b(?: \w+){0,3}? (?:along|past|parallel)\b"
        r"|\b(?:face|side|wall|parallel|close) (?:pass|run)\b|\bpass (?:of|along|by)\b|\bpass the(?: \w+){1,3} (?:wall|face|side|flank)\b"
        r"|\bgets? (?:its|a|the) (?:run|pass)\b|\bmetre (?:run|pass)\b",
        re.IGNORECASE,
    ),
    "orbit": re.compile(
        r"\b(?:orbit\w*|circl\w+|(?:go|goes|going|once|way|ride|sail|run|full|lap|half) a?round|laps?|loops?|circumnavigat\w*|arcs?)\b",
        re.IGNORECASE,
    ),
    "square": re.compile(
        r"\b(?:survey\w*|inspect\w*|examin\w*|assess\w*|apprais\w*|stud(?:y|ies)|size up|eyeball|check \w+ (?:out|over)|go over|look (?:at|over)|"
        r"look \w+ over)\b",
        re.IGNORECASE,
    ),
    "visual": re.compile(
        r"\b(?:dock|docking|berth|berthing|moor|mooring up|bring (?:you|her|it) in)\b"
        r"(?=.*\b(?:camera|visual\w*|sight|mark\w*|lens|optic\w*)\b)"
        r"|\b(?:camera|visual\w*)\b.*\b(?:dock|docking|berth|berthing|approach)\b",
        re.IGNORECASE,
    ),
}
_OTHER = re.compile(
    r"\b(?:depths?|sound\w*|bathymetr\w*|grid\w*|lanes?|lines?|cables?|panorama\w*|hott?est|thermal|film\w*|footage|video|glare\w*|drift\w*|box|area|"
    r"berth\w*|dock\w*|moor\w*|alongside|follow\w*|keep\w* (?:at least|clear|away)|stay\w*"
    r" (?:away|clear)|at least|no closer|at most|nearer|ferry|traffic|"
    r"fairway|(?<!of )both|each|either|all|other|(?<!per )(?<!a"
    r" )second|again|twice|times|back|but|last|first|plus|"
    r"respectively|height|high|deep|draught|tide|swell|wide)\b",
    re.IGNORECASE,
)
_DOCKING = re.compile(r"\b(?:berth\w*|dock\w*|moor\w*|back)\b", re.IGNORECASE)
UNSURE = re.compile(
    r"\b(?:instead|rather|sorry|scratch|strike|correct\w*|make"
    r" (?:it|that)|change\w*|amend\w*|actually|mean|meant|second thoughts?|no longer|wait|oops|hm+|"
    r"edit|new|not \d|no(?=,)|wrong|mixed up|other way|reflection|too|the same(?=[;,.]|$))\b",
    re.IGNORECASE,
)
"""Words of commands that take something back."""
_NOT = re.compile(
    r"\b(?:forget|skip|leave|cancel\w*|without|neither|nor|not|never|except|don['’]?t|minus"
    r" the|if|unless|or)\b",
    re.IGNORECASE,
)
"""Words of sentences that rule something out or leave a choice."""
_OFF_BEHIND = re.compile(
    r" ?,? ?(?:off|out|away|clear|abeam|distant|short|in front)\b(?!"
    r" (?:to|home|with|for|at|there))",
    re.IGNORECASE,
)
_STOP_BEHIND = re.compile(
    r" ?,? ?(?:off|out|away|short|in front|from|before|clear)\b", re.IGNORECASE
)
_OFF_BEFORE = re.compile(
    r"\b(?:stand-?off|distance|clearance|radius)(?: of| is|:|=|,)? $|\b(?:at|from) (?:a"
    r" (?:distance|radius|stand-?off|range) of |about |some )?$",
    re.IGNORECASE,
)
_SAME = re.compile(
    r"\b(?:at|from|with|keeping|on) (?:that|the|this) (?:very |exact )?same"
    r" (?:distance|stand-?off|range|radius|clearance)\b"
    r"|\bsame (?:distance|stand-?off|radius|range)(?: as before| again| as the"
    r" (?:orbit|circle|survey))?\b",
    re.IGNORECASE,
)
_CLAUSE = re.compile(r"[,;:]|\b(?:and|then|before|after)\b", re.IGNORECASE)
NAMES = {"pass": "distance", "orbit": "radius", "square": "radius", "visual": "distance"}
"""The parameter that holds the stand-off, by the pattern of its task."""


def read_standoffs(text: str) -> Told:
    """The values of the tasks that a text asks for once, each in a sentence about nothing else."""
    if UNSURE.search(text):
        return {}
    blank = PLACE.sub(lambda match: " " * len(match[0]), text)
    sentences = list(_sentences(blank))
    told: Told = {}
    for pattern, words in _KINDS.items():
        about = [sentence for sentence in sentences if words.search(sentence)]
        count = sum(len(words.findall(sentence)) for sentence in sentences)
        if (
            len(about) == 1
            and count == 1
            and not any(other.search(about[0]) for name, other in _KINDS.items() if name != pattern)
        ):
            told.update(_of(about[0], pattern))
    told.update(_same_distance(blank))
    return told


def _sentences(text: str) -> Iterator[str]:
    ends = [0, *(match.end() for match in SENTENCE.finditer(text)), len(text)]
    yield from (text[start:end] for start, end in pairwise(ends) if text[start:end].strip())


def _of(sentence: str, pattern: str) -> Iterator[tuple[tuple[str, str], float]]:
    """The values of a sentence about one task alone."""
    other = _DOCKING.sub(" ", sentence) if pattern == "visual" else sentence
    if _OTHER.search(other) or _NOT.search(sentence):
        return
    numbers = quantities(sentence)
    off = [number for number in numbers if _is_off(sentence, number, pattern)]
    lengths = [number for number in numbers if number.unit == "m" and number not in off]
    if len(off) == 1 and (pattern == "pass" or not lengths):
        yield (pattern, NAMES[pattern]), round(off[0].value, 4)
    if pattern == "pass" and len(off) == 1 and len(lengths) == 1:
        yield (pattern, "length"), round(lengths[0].value, 4)


def _is_off(sentence: str, number: Quantity, pattern: str) -> bool:
    """Whether a number says how far from its target the vehicle is to be."""
    word = sentence[number.start : number.end].lower()
    if (
        number.unit not in ("m", None)
        or number.said <= 0
        or (number.unit is None and word in ("one", "half", "quarter"))
    ):
        return False
    if sentence[number.start - 1 : number.start].isalnum():
        return False
    behind = _STOP_BEHIND if pattern == "visual" else _OFF_BEHIND
    before = sentence[max(0, number.start - 32) : number.start]
    return behind.match(sentence, number.end) is not None or (
        number.unit == "m" and _OFF_BEFORE.search(before) is not None
    )


def _same_distance(text: str) -> Iterator[tuple[tuple[str, str], float]]:
    """ "Survey it at that same distance": the one that the text states before."""
    match = _SAME.search(text)
    if match is None:
        return
    starts = [clause.end() for clause in _CLAUSE.finditer(text, 0, match.start())]
    clause = text[starts[-1] if starts else 0 : match.start()]
    if _NOT.search(clause):
        return
    kinds = [pattern for pattern in ("orbit", "square") if _KINDS[pattern].search(clause)]
    before = text[: match.start()]
    values = {
        round(number.value, 4)
        for number in quantities(before)
        if number.unit == "m" and _is_off(before, number, "orbit")
    }
    if len(kinds) == 1 and len(values) == 1 and len(_KINDS[kinds[0]].findall(text)) == 1:
        yield (kinds[0], NAMES[kinds[0]]), values.pop()
