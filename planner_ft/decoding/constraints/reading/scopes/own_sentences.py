"""Skills that a sentence of its own asks for, behind those of the movements: they run in every
step.

"Rate the usability of the frame on the starboard camera." at the end of an input names no movement
and no step, so that none is left out. A sentence that could say where it holds, or that another one
speaks on, is not read.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes.scope_clauses import Mark, marks_of, plain_form
from planner_ft.decoding.constraints.reading.scopes.scope_parts import EVERYWHERE, Scope
from planner_ft.decoding.constraints.reading.scopes.skill_words import SKILL_WORDS
from planner_ft.decoding.constraints.reading.skills.evidence import asks_for
from planner_ft.vocabulary import Vocabulary

SOMEWHERE = re.compile(
    rf"\b(?:{w.ORD}|one|two|three|both|each|every|either|[a-f]|steps?|parts?|stages?|legs?|runs?|turns?|holds?|halts?|stops?|stays?|drifts?|arcs?|ways?|waits?|"
    r"pauses?|lanes?|ends?|corners?|points?|waypoints?|places?|headings?|bearings?|spots?|squares?|grids?|circles?|rings?|loops?|orbits?|circuits?|sweeps?|pans?|nudges?|moves?|"
    r"out|back|home|there|then|here|once|twice|times|again|only|alone|just|rest|others?|when(?:ever)?|while|during|until|till|before|after|where(?:ver)?|as|"
    r"if|else|yet|but|except|same|arriv\w+|reach\w*|moving|turning|holding|still|it|them|that|this|those|these|nothing|none|neither|last|end\w*|"
    r"what|matter\w*|in (?!the (?:image|picture|frame|water|camera|video|point)|cent(?:re|er)))\b"
)
"""Words by which a sentence may say where something runs, or speak of what another one asks for."""
_SPOKEN_ON = re.compile(
    r"\b(?:it|that|this|them|those|these|they|both|all|ditto|likewise|same)\b|\bthe"
    r" (?:check|reading|measurement|"
    r"detector|tracker|recording)\b"
)
"""Words of a later sentence that may be about a skill asked for before."""
_SHOWN = re.compile(r"\b(?:on|of|from|with|by) cam\b")
_MEANWHILE = re.compile(r"^\W*(?:meanwhile|in the meantime|all the while)\b,?")
_LIST = re.compile(r"^\W*(?:\(?[\da-f][.)]|[-*])\s|\n")


def read_own_sentences(
    text: str, asked: Collection[str], vocabulary: Vocabulary
) -> dict[str, Scope]:
    """Those of the skills `asked` for that run in every step because a sentence of their own asks
    for them behind all movements.
    """
    plain = plain_form(text)
    names = [
        skill.name
        for role in ("filter", "perception")
        for skill in vocabulary.skills_in_role(role)
        if skill.name in SKILL_WORDS
    ]
    sentences = [sentence for sentence in w.SENTENCE.split(plain) if sentence.strip()]
    if w.CHANGED.search(plain) or _LIST.search(plain):
        return {}
    before = 0
    for number, sentence in enumerate(sentences):
        if number and before > 1 and _MEANWHILE.match(sentence):
            # All that goes on while several movements are made in the sentence before.
            sentences[number] = _MEANWHILE.sub("", sentence)
        before = sum(mark.kind == "move" for mark in marks_of(sentence, [], True))
    marks = [marks_of(sentence, names, True) for sentence in sentences]
    moved = [
        number for number, found in enumerate(marks) if any(mark.kind == "move" for mark in found)
    ]
    if not moved:
        return {}
    found = {}
    for name in asked:
        places = [
            number for number, said in enumerate(marks) if _asks(sentences[number], name, said)
        ]
        if (
            len(places) == 1
            and places[0] > moved[-1]
            and _holds_throughout(places[0], sentences, [mark.kind for mark in marks[places[0]]])
        ):
            found[name] = Scope((EVERYWHERE,), source="sentence")
    return found


def _asks(sentence: str, name: str, said: Sequence[Mark]) -> bool:
    """Whether a sentence speaks of a skill."""
    return any(mark.kind == "skill" and mark.value == name for mark in said) or asks_for(
        sentence, name
    )


def _holds_throughout(number: int, sentences: list[str], kinds: list[str]) -> bool:
    """Whether a sentence, and those behind it, name no steps."""
    said = _SHOWN.sub(" ", sentences[number])
    if "scope" in kinds or SOMEWHERE.search(said) or ":" in said or w.REFUSED.search(said):
        return False
    return not any(_SPOKEN_ON.search(sentence) for sentence in sentences[number + 1 :])
