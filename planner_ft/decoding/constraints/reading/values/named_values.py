"""Text values that an input names by their kind: "sensor deck_cam", "the region 'top left'",
"labelled kelp bed.".

The kinds are the names of the parameters without their endings: `stream_id` is said "stream",
`cloud_data` "cloud". What follows such a word is the value where it stands in quotation marks,
looks like an identifier, or closes the clause.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Collection

from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.skills.evidence import mentions
from planner_ft.vocabulary import Parameter, Skill, Vocabulary

_ENDING = re.compile(r"_(?:id|data|list|name)$")
_LINK = r"(?:,? (?:called|named|known as|marked|is|reads?|reading|be|as|id|ID|name)\b| ?[:=]){0,2}"
_QUOTED = r"""["“«](?P<q1>[^"“”«»\n]{1,60})["”»]|(?<!\w)['‘](?P<q2>[^'‘’\n]{1,60})['’](?!\w)"""
IDENTIFIER = r"(?:[A-Za-z]+(?=[\w-]*[\d_])[\w-]*\w|\d+(?=[\w-]*[A-Za-z_])[\w-]*\w)"
_CLOSING = r"(?P<words>[a-z]+(?: [a-z]+){0,2})(?=[.;,]|$)"
_FUNCTION_WORDS = re.compile(
    r"\b(?:and|or|at|in|on|to|of|for|from|by|with|while|during|until|then|only|also|as|it|them|this|that|there|here|is|are|be|all|both|each|every|throughout|"
    r"too|well|not|no|off|again|afterwards|meanwhile|please|over|out|now|which|what|the|a|an)\b"
)
CLOSING_KINDS = frozenset({"label", "tag", "type"})
"""Kinds that a few words may follow up to the end of the clause."""
UNTOLD_KINDS = frozenset({"target"})
"""Kinds whose word names other things too, as "object" does where something is the target of
another skill.
"""
DOUBT = re.compile(
    r"\b(?:instead|rather than|scratch|scrap|correction|misread|no wait|I mean|make"
    r" that|not|never|don't|neither|wrong|belay|sorry|should read|disregard)\b",
    re.IGNORECASE,
)
SEVERAL = re.compile(
    r"\b(?:change|swap) (?:it|that|this|them)\b|\bwith it on\b|"
    r"\bfirst\b.*\b(?:second|other|last|next|latter)\b|\bformer\b.*\blatter\b|\brespectively\b|\bthe"
    r" other\b",
    re.IGNORECASE | re.DOTALL,
)
"""Words for several steps or values, each of which may have its own."""


def read_named_values(
    text: str, spoken: Collection[str], vocabulary: Vocabulary
) -> dict[tuple[str, str], frozenset[str]]:
    """By skill and parameter what its value is one of; nothing where several skills that are spoken
    of have such a parameter, or one is twice.
    """
    if len(text) > LONGEST or DOUBT.search(text) or SEVERAL.search(text):
        return {}
    owners: dict[str, list[tuple[Skill, Parameter]]] = {}
    for skill in vocabulary.skills:
        if skill.name in spoken:
            for parameter in skill.parameters:
                if parameter.type in ("text", "id"):
                    owners.setdefault(parameter.name, []).append((skill, parameter))
    found = {}
    for name, having in owners.items():
        kind, owner = _ENDING.sub("", name), having[0][0].name
        untold = (
            kind in UNTOLD_KINDS
            or (kind == "object" and "target_id" in owners)
            or (kind == "region" and "roi" in owners)
        )
        values = (
            None if untold or len(having) > 1 or mentions(text, owner) > 1 else _values(text, kind)
        )
        if values:
            found[owner, name] = values
    return found


def _values(text: str, kind: str) -> frozenset[str] | None:
    """What stands behind every mention of a kind; None where one of them names nothing."""
    values = []
    for mention in re.finditer(rf"\b{kind}(?:s|led|ged)?\b", text, re.IGNORECASE):
        match = _behind(kind).match(text, mention.end())
        if match is None:
            return None
        value = next(group for group in match.groups() if group is not None)
        if match["words"] and _FUNCTION_WORDS.search(value):
            return None
        values.append(value.strip(" .,;"))
    return frozenset(values)


@functools.cache
def _behind(kind: str) -> re.Pattern[str]:
    closing = f"|{_CLOSING}" if kind in CLOSING_KINDS else "|(?P<words>(?!))"
    return re.compile(rf"{_LINK}\s*(?:{_QUOTED}|(?P<id>{IDENTIFIER}){closing})")
