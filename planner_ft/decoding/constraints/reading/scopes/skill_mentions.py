"""The words of a text that speak of filter and perception skills, and whether they deny them: "bow
not locked", "no stills either".
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.decoding.constraints.reading.scopes.where import Anchor

CLEARANCE = "ObstacleAvoidance"


@dataclass(frozen=True)
class Mention:
    """Words for a skill, whether they deny it, and the item that they stand in."""

    name: str
    start: int
    end: int
    denied: bool
    bound: bool = False
    """Whether words beside it may say where it holds."""


_DENIED_BEFORE = re.compile(
    r"\b(?:no|not|without|never|nor|neither|don't|do not|needn't|need not|no need"
    r" (?:to|for|of)|nothing to|stop|skip|forget|leave out|lift\w*|"
    r"instead of|in place of|in lieu of|rather than)"
    r"(?: (?!closer|nearer|less|leav|later|out|beyond|cross|stray|exceed|only|before|lose|losing)[\w-]+){0,2} ?$"
)
_DENIED_TWICE = re.compile(
    r"\b(?:don't|do not|never|not|without|nor) (?:to"
    r" )?(?:forget|skip|omit|stop|miss|fail|neglect|leave out|leaving out|drop|interrupt|los)\w*\b"
)
_DENIED_BEHIND = re.compile(
    r"^(?![^.;,]{0,40}\bnot (?:only|before|less))[^.;,@]{0,40}\b(?:no longer|does not|do not|is"
    r" not|are not|isn't|aren't|doesn't|don't|needn't|need not)\b|"
    r"^,? ?(?:(?:is|are|has|does|do|can|may|need|shall|should|will|must|being) )?(?:not\b(?!"
    r" (?:only|before|less))|no longer\b|no more\b|n't|"
    r"unnecessary|off\b(?! \w)|free\b(?! (?:of|from)\b)|lifted|"
    r"nothing\b|none\b|finished\b|stopped\b|ended\b|over"
    r" by\b|rests?\b|sleeps?\b|needless|dropped|released|idle|over\b(?= ?[.,;]|$)|not\b|isn't|"
    r"aren't|doesn't|don't|needn't)"
)
_DENIED_WITHIN = re.compile(
    r"\b(?:not (?!to leave|leave|within)|unlocked|free\b(?! (?:of|from)\b)|n't)"
)
_CLEAR_OF = re.compile(
    r"\d ?(?:m|metres?|meters?|feet|ft|yards?)\b[^.;,]{0,12}\b(?:from|off|of|to|clear of|away from) (?:everything|anything|"
    r"everybody|all|any)\b|"
    r"\b(?:metres?|meters?|feet|fathoms|yards) (?:of clearance|(?:clear )?(?:from|off|of|to|away from) (?:everything|anything|"
    r"everybody|all|any))\b|\bmargin\b"
)

_NOT_LEFT = re.compile(
    r"\bnot (?:to )?be"
    r" (?:left|crossed|exceeded|passed|violated|broken|overstepped|forgotten|skipped|omitted)\b|\bnot"
    r" (?:to )?(?:leave|cross|exceed)\b"
)
"""What a limit rules out, and no limit that is."""
_TITLE = re.compile(r"^ (?:(?:grid|survey|lawn\w*|track|chart|map)\b)")
"""Words behind one for a skill that are what the task is called: "a depth grid"."""
_ANOTHER = re.compile(
    r"\b(?:\d[\d.]*|two|three|four|five|six|seven|eight|nine|ten|twelve|fifteen|twenty|thirty)(?:"
    r" ?(?:m|metres?|meters?|feet|yards?))? "
    r"(?:(?:is|are|will be) (?:plenty|enough|sufficient)|will do|suffices?)\b|"
    r"\b(?:with|only|just|and|but|then) (?:only |just |at least"
    r" )?(?:\d[\d.]*|two|three|four|five|six|seven|eight|nine|ten|twelve|fifteen|twenty|"
    r"thirty) ?(?:m|metres?|meters?|feet|yards?)"
    r"(?=[.,;]|$| (?:for|on|in|during|while|from there|at"
    r" the|then|when|as|afterwards|thereafter|there)\b)"
)
"""A length that is another clearance, where one was spoken of before."""


def sentence_at(text: str, place: int) -> tuple[int, int]:
    """The sentence, or the part of one between semicolons, that a place stands in."""
    begin = max((match.end() for match in re.finditer(r"[.;!?](?=\s)", text[:place])), default=0)
    return begin, next(
        (match.start() for match in re.finditer(r"[.;!?](?=\s|$)", text) if match.start() >= place),
        len(text),
    )


def mentions_of(text: str, names: Sequence[str], anchors: Sequence[Anchor]) -> list[Mention]:
    found = []
    for name in names:
        spans: list[tuple[int, int]] = []
        matches = [match.span() for match in SKILL_WORDS[name].finditer(text)]
        if name == CLEARANCE:
            matches += [match.span() for match in _CLEAR_OF.finditer(text)]
            first = min((start for start, _end in matches), default=len(text))
            matches += [match.span() for match in _ANOTHER.finditer(text) if match.start() > first]
        for start, end in sorted(matches):
            inner = text[start:end].strip()
            if name == "GetSeabedDepth" and _TITLE.match(text[end:]):
                continue
            if any(
                anchor.start <= start and start + len(inner) <= anchor.end for anchor in anchors
            ):
                continue
            if any(start < stop and begin < end for begin, stop in spans):
                continue
            spans.append((start, end))
            begins = max(
                (match.end() for match in re.finditer(r"[.;:!?,]|\bbut\b|\band\b", text[:start])),
                default=0,
            )
            behind = re.split(r"[.;:!?]", text[end:], maxsplit=1)[0]
            denied = (
                not _DENIED_TWICE.search(text[begins:start])
                and not _NOT_LEFT.search(behind)
                and not re.search(r"outside|leav|within|closer|nearer|less|swing", text[start:end])
                and bool(
                    _DENIED_BEFORE.search(text[begins:start])
                    or _DENIED_BEHIND.search(behind)
                    or _DENIED_WITHIN.search(text[start:end])
                )
            )
            first, last = sentence_at(text, start)
            found.append(
                Mention(
                    name,
                    start,
                    end,
                    denied,
                    s.UNREAD.search(f"{text[begins:start]} {re.split('[,.;:]', text[end:last])[0]}")
                    is not None,
                )
            )
    return sorted(found, key=lambda mention: mention.start)
