"""Which movements an input can ask for, by its words: a turn, an arc, a drift or a wait that no word speaks of cannot be meant.

Places to go to and holds are not told here: waypoints are read apart, and an input that asks for no movement holds position.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.evidence import readable, variants
from planner_ft.vocabulary import Vocabulary

_TURNED = r"turn|rotat|swing|swung|swivel|pivot|spin|spun|yaw|veer|twist|slew|degree|\bdeg\b|°|bow\b|nose|stem\b|head\b|heading"
_PATTERNS = {
    "turn_by": (_TURNED, r"nudg|\bpan|trim|shift|port\b|starboard|left|right|clockwise|angle|camera|tweak|correct|ease|a touch|sidew|half|quarter"),
    "turn_to": (
        _TURNED,
        r"fac(?:e|ing)|bearing|point|look|north|south|east|west|\b[nsew]{1,3}\b|\b\d{3}\b|aim|direct|compass|align|lin\w+ up|come (?:to|round|on|about)",
        r"square|orient|aspect|view|sector|panoram|steer|course|towards?|onto|pans?\b|panning",
    ),
    "arc": (
        r"\barc|curv|sweep|swept|bend|bent|circl|turn|round|around|orbit|radius|loop|swing|swung|half|quarter|degree|°|\bdeg\b|\blap|wheel|revol",
        r"ring\b|circuit|about (?:it|the|\()|bow out|wide",
    ),
    "drift": (
        r"drift|float|engine|motor|propul|adrift|current|thrust|power|carr(?:y|ied)|free|idle|tide|coast|stream|wind|let (?:go|her|it|the|yourself|your)",
        r"passive|propeller|screws?\b|shut|off\b",
    ),
    "wait": (
        r"stead|stab|settl|still|calm|pitch|roll|motion|rock|sway|level|quiet|wait|rest|swell|wobbl|heel|tilt|until|till|paus|mov|even keel|heav|lively",
        r"come to|lies?\b|less than|under \d|below|within",
    ),
}
WORDS = {motion: re.compile("|".join(words), re.IGNORECASE) for motion, words in _PATTERNS.items()}


def spoken_movements(text: str, vocabulary: Vocabulary) -> frozenset[str] | None:
    """Names of the navigation skills that some word of the text can mean, and of all that this does not tell; None where the text cannot be read."""
    if not readable(text):
        return None
    spelt = variants(text)
    said = {motion for motion, words in WORDS.items() if any(words.search(one) for one in spelt)}
    return frozenset(skill.name for skill in vocabulary.skills_in_role("navigation") if skill.motion not in WORDS or skill.motion in said)
