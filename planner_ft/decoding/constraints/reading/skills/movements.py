"""Which movements an input can ask for, by its words: a turn, an arc, a drift or a wait that no
word speaks of cannot be meant.

Places to go to are not told here, waypoints are read apart. An input may hold position unless it
speaks of a drift.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.skills.evidence import readable, variants
from planner_ft.vocabulary import Vocabulary

_TURNED = r"turn|rotat|swing|swung|swivel|pivot|spin|spun|yaw|veer|twist|slew|degree|\bdeg\b|°|bow\b|nose|stem\b|head\b|heading"
_PATTERNS = {
    "turn_by": (
        _TURNED,
        (
            r"nudg|\bpan|trim|shift|port\b|starboard|left|right|clockwise|angle|camera|tweak|ease|a"
            r" touch|sidew|half|quarter|round|steps?"
        ),
    ),
    "turn_to": (
        _TURNED,
        (
            r"fac(?:e|ing)|bearing|point|look|north|south|east|west|\b[nsew]{1,3}\b|\b\d{3}\b|aim|direct|compass|align|lin\w+"
            r" up|come (?:to|round|on|about)"
        ),
        r"square|orient|aspect|view|sector|panoram|steer|course|towards?|onto|pans?\b|panning",
    ),
    "arc": (
        r"\barc|curv|sweep|swept|bend|bent|circl|turn|round|around|orbit|radius|loop|swing|swung|half|quarter|degree|°|\bdeg\b|\blap|wheel|revol",
        r"ring\b|circuit|about (?:it|the|\()|bow out|wide",
    ),
    "drift": (
        (
            r"drift|float|engine|motor|propul|adrift|current|thrust|power|carr(?:y|ied)|free|idle|tide|coast|stream|wind|let"
            r" (?:go|her|it|the|yourself|your)"
        ),
        r"passive|propeller|screws?\b|shut|off\b|throttle|zero",
    ),
    "wait": (
        (
            r"stead|stab|settl|still|calm|pitch|roll|motion|rock|sway|level|quiet|wait|rest|swell|wobbl|heel|tilt|until|till|paus|mov|even"
            r" keel|heav|lively"
        ),
        r"come to|lies?\b|less than|under \d|below|within",
    ),
    "visual": (
        r"cent(?:er|re)|fram|picture|view|sight|visual|image|camera|eye|look|watch|lens|film|screen|focus|star(?:e|ing)|hold|keep|kept|lock|fix|track|follow",
        r"mark|aim|train|shot|observ|fac|stay",
    ),
    "hold": (
        r"hold|held|stay|station|keep|kept|remain|wait|stop|halt|paus|loiter|stand|park|rest\b|resting|linger|sit\b|sits|sitting|hover|place|put\b|spot|still",
        (
            r"lie\b|lying|dwell|idle|moor|anchor|position|here|there|guard|watch|hang|wherever|where"
            r" (?:you|she|it|we)|stuck|bide|motionless"
        ),
    ),
}
DRIFTS = re.compile(r"drift|float|adrift|\bengines?\b|propulsion", re.IGNORECASE)
"""Words for a movement that lasts, and is no hold."""
WORDS = {motion: re.compile("|".join(words), re.IGNORECASE) for motion, words in _PATTERNS.items()}


def spoken_movements(text: str, vocabulary: Vocabulary) -> frozenset[str] | None:
    """Names of the navigation skills that some word of the text can mean, and of all that this does
    not tell; None where the text cannot be read.
    """
    if not readable(text):
        return None
    spelt = variants(text)
    said = {motion for motion, words in WORDS.items() if any(words.search(one) for one in spelt)}
    if not any(DRIFTS.search(one) for one in spelt):
        said.add("hold")
    return frozenset(
        skill.name
        for skill in vocabulary.skills_in_role("navigation")
        if skill.motion not in WORDS or skill.motion in said
    )
