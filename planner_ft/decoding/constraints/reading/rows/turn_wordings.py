"""Rotations and arcs told by one that was said before, in a text in one form: "the same way", "the
reciprocal of 040", "rotate eight more", "040 itself".
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.rows import turn_forms as f

_OF_THAT = r"(?: (?:of|to) (?:that|it|this)(?: (?:one|it|heading|bearing|course|direction))?\b)?"
_RECIPROCAL = f.compiled(
    rf"\b(?:the |its )?(?:reciprocal|opposite|contrary)(?: (?:heading|bearing|course|direction))?"
    rf" (?:of|to) (?:the )?(?:heading |bearing |"
    rf"course )?(?P<v>{f.V})|"
    rf"(?P<first>{f.V})(?P<between> ?,? ?(?:and|then|and then|to|,)(?: (?:onto|on|to))?)"
    r" (?:its|the) (?:reciprocal|opposite)(?: (?:heading|bearing|course|"
    rf"direction))?\b{_OF_THAT}"
)
_RECIPROCAL_OF_THAT = f.compiled(
    r"\b(?:the |its )?(?:reciprocal|opposite)(?: (?:heading|bearing|course|direction))? (?:of|to)"
    r" (?:that|this)(?: (?:one|it|heading|bearing|course|"
    r"direction))?\b"
)
"""The reciprocal of the heading that was said last, with other movements between."""
_ITSELF = f.compiled(rf"(?P<v>{f.V}) (?:itself|exactly|precisely|sharp|dead|even)\b")
_THROUGH = f.compiled(
    rf"\b(?P<verb>(?:bring|come|swing|turn|rotate|pivot|swivel|slew)(?: (?:her|it|the"
    rf" (?:bow|boat|nose)|round|about|head|bow))*) (?:through|past|via|"
    rf"by way of) "
    rf"(?:due )?C[\d.]+ (?P<to>to|onto|on to|until) (?={f.V})"
)
_SIDE = f.SIDE
_ANY_SIDE = f.compiled(_SIDE)
_SAME_SIDE = f.compiled(
    r"(?:,? ?(?:and )?(?:also |again )?(?:in )?(?:the )?(?:very )?same"
    r" (?:direction|way|sense|side|hand)(?: (?:again|as before|round))?|"
    r"(?:,? ?to )the same side)\b"
)
_OTHER_SIDE = f.compiled(
    r",? ?(?:but )?(?:(?:in )?the (?:opposite|other) (?:direction|way|sense)|to the"
    r" (?:other|opposite) side)(?: round)?\b(?! round)"
)
_MORE = f.compiled(rf"\b(?P<v>{f.D})(?: degrees)? (?:more|further|extra)\b")
_A_TIME = f.compiled(
    rf"\b(?P<verb>(?:pan|turn|nudge|rotate|swing|yaw|pivot)(?: (?:her|the bow|the boat|it|her head|"
    rf"the camera))?) (?P<side>{_SIDE}),? ?(?:N(?P<count>\d+) times,? ?"
    rf"(?P<step>{f.D})|(?P<other>{f.D}) (?:a time|each time|at a time|every time),?"
    r" ?N(?P<often>\d+) times)(?: (?:a time|each time|at a time|every time|"
    rf"each|apiece))?\b"
)


def explained(text: str) -> str:
    """The text with what refers to another rotation written out."""
    text = _THROUGH.sub(r"\g<verb> \g<to> ", _ITSELF.sub(r"\g<v>", text))
    text = _A_TIME.sub(
        lambda match: (
            f"{match['verb']} {match['side']} {match['step'] or match['other']}"
            f" N{match['count'] or match['often']} times"
        ),
        text,
    )
    text = _of_that(_RECIPROCAL.sub(_opposite, text))
    if _SAME_SIDE.search(text) or _OTHER_SIDE.search(text):
        text = _sided(text)
    return text


def _opposite(match: re.Match[str]) -> str:
    """The heading on the other side of the compass; one that is asked for itself stays before
    it.
    """
    token = match["v"] or match["first"]
    if token[1] in "+-":
        return match[0]
    other = f"{token[0] if token[0] != 'D' else 'N'}{(float(token[1:]) + 180) % 360:g}"
    return other if match["v"] else f"{match['first']}{match['between']} {other}"


def _of_that(text: str) -> str:
    """The text with the other side of the heading that was said last in place of "the reciprocal of
    that".
    """
    while match := _RECIPROCAL_OF_THAT.search(text):
        said = [*re.finditer(f.V, text[: match.start()])]
        if (
            not said
            or said[-1][0][1] in "+-"
            or re.search(rf"{f.SIDE}", text[said[-1].end() : match.start()])
        ):
            break
        token = said[-1][0]
        text = f"{text[: match.start()]}{token[0] if token[0] != 'D' else 'N'}{(float(token[1:]) + 180) % 360:g}{text[match.end() :]}"
    return text


def _sided(text: str) -> str:
    """The text with the side that was said last in place of "the same way", and the other one for
    "the opposite way".
    """
    for pattern, same in ((_SAME_SIDE, True), (_OTHER_SIDE, False)):
        made, at = "", 0
        for match in pattern.finditer(text):
            said = [one[0] for one in _ANY_SIDE.finditer(made + text[at : match.start()])]
            angle = re.search(rf"{f.D}[^.;]{{0,40}}$", text[: match.start()])
            if not said or not angle:
                continue
            side = said[-1] if same else "to port" if f.sign(said[-1]) > 0 else "to starboard"
            made, at = f"{made}{text[at : match.start()]} {side}", match.end()
        text = made + text[at:]
    return _MORE.sub(r"\g<v>", text) if made else text
