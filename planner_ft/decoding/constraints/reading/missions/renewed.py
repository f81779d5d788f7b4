"""Values that a command gives anew: "max 600 m ... new maximum four-fifty", "the spacing goes down
to 4", "25 is too short, run 32".
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planner_ft.data.quantities import Quantity, positions, quantities
from planner_ft.decoding.constraints.reading.missions.standoffs import UNSURE

_ROLES = (
    r"max(?:imum)?",
    r"radius",
    r"distance",
    r"stand-?off",
    r"spacing",
    r"width",
    r"length",
    r"speed",
    r"duration",
    r"interval",
    r"overlap",
)
_GAP = r"(?: (?:is|of|at))?[ :=]{1,2}$"
_NAMES = {
    "spacing": r"(?:line |lane |track )?(?:spacing|gaps?)|lanes|lines",
    "radius": r"radius|stand-?off|distance|clearance|range",
    "length": r"length|run|pass",
    "overlap": r"overlap",
    "sectors": r"sectors?|sector count",
    "speed": r"speed",
    "interval": r"interval",
    "duration": r"duration|hold|time|wait",
    "maximum": r"max(?:imum)?(?: distance| length)?|limit",
    "angle": r"sweep|arc|scan(?: width)?|heading|course",
}
"""What a value is called when it is given anew."""
_BESIDE = {
    "spacing": (
        r"(?:spacing|lines|lanes|apart|gaps?)(?: of| is| at| every|:| being)?,? ?$|every $",
        (
            r" ?(?:m(?:et(?:re|er)s?)? )?(?:spacing|apart|between (?:the"
            r" )?(?:lines|lanes)|lanes?|lines?)\b"
        ),
    ),
    "radius": (
        r"(?:radius|stand-?off|distance|clearance|range)(?: of| is| at|:)? ?$",
        r" ?,? ?(?:off|out|away|clear|radius|stand-?off)\b",
    ),
    "length": (
        r"length(?: of| is|:)? ?$|\bover $",
        r" ?(?:long|in length|run|pass|of (?:the|its|her|his))\b",
    ),
    "overlap": (r"overlap(?: of| is|:)? ?$", r" ?(?:of )?overlap\b"),
    "sectors": (r"$^", r" (?:sectors?|pictures|shots|frames)\b"),
    "speed": (r"speed(?: of| is|:)? ?$", r"$^"),
    "interval": (
        r"(?:interval(?:s of| of|:)?|every|each|once (?:in|per)) ?$",
        r" (?:interval|apart)\b",
    ),
    "duration": (r"(?:for|lasting|duration(?: of|:)?) ?$", r"$^"),
    "maximum": (
        r"(?:max(?:imum)?|limit|most|no more than|up to)(?: of| is|:)? ?$",
        r" ?(?:at most|max(?:imum)?|at the most|tops)\b",
    ),
    "angle": (r"(?:sweep|arc|heading|course|scan)(?: of| is|:)? ?$", r" (?:sweep|arc|wide|scan)\b"),
}
"""Words before and behind a value that say what it is."""
_UNITS = {
    "spacing": "m",
    "radius": "m",
    "length": "m",
    "overlap": "%",
    "speed": "m/s",
    "interval": "s",
    "duration": "s",
    "maximum": "m",
    "angle": "deg",
}
_SPACED = r"spacing|lanes?|lines?"
_GRIDS = re.compile(
    r"\bgrids?\b|\bsoundings?\b|\bbathymetr\w+|\bdepth (?:survey|chart|map)|\blawnmower\b",
    re.IGNORECASE,
)
_GRIDS_APART = re.compile(
    r"\b(?:first|second|patches|boxes|areas|respectively|both|each|usual|standard|default|same|identical|then"
    r" (?:at|on|over|round)|two|other)\b",
    re.IGNORECASE,
)
_ANEW = (
    r"(?: (?:now|has to|should|is to|must|will|can))*"
    r" (?:go(?:es)?|drops?|comes?|is|be|rises?|changes?|shrinks?|grows?|becomes?|reads?|moves?|increases?|decreases?)(?:"
    r" now)?(?: (?:up|down|back|out"
    r"|in|cut|raised|reduced|changed|set))?"
    r" (?:to |now )(?:just |only )?$"
)
_SET = r"\b(?:make|change|set|cut|raise|reduce|increase|lower|shorten|lengthen|widen|tighten|adjust|correct|bring) "
_TOO = re.compile(
    r"[ ,-]{0,2}(?:m |metres |meters |minutes |seconds |degrees |per ?cent |%"
    r" )?(?:is|was|are|were|['’]s|seems?|looks?|would be"
    r"|will be)(?: (?:a (?:bit|little|touch|shade)|far|much|rather|still))? "
    r"(?:too (?:\w+)|not (?:\w+ )?enough|wrong|insufficient|excessive|overkill)(?: (?:for (?:\w+"
    r" ?){1,3}|at that \w+))?"
    r"(?:[\s,;:.–—-]+(?:(?:so|rather|better|please|then|and|just|say|it|that|let['’]?s|you|run|make|take|use|do|go|keep|try|have|want|be|should|to|of"
    r"|for|at|with|is|stay|hold)\b[ ,:]*){0,5})$",
    re.IGNORECASE,
)
_FOR_IT = re.compile(
    r"[ ,]{0,2}(?:m |metres |minutes |seconds )?(?:instead of|rather than|in place of|and no"
    r" longer|(?:and|but) not) (?:the |just |only )?$",
    re.IGNORECASE,
)
_INTO = re.compile(
    r"(?:\b(?:change|replace|swap|correct|turn|extend|shorten|raise|lower|reduce|increase|cut)"
    r" (?:the |that |those )?)$",
    re.IGNORECASE,
)
_BY = re.compile(
    r"[ ,]{0,2}(?:(?:m|metres|minutes|seconds|\w+)[ ,]{1,2})?(?:in)?(?:to|with|by|for) (?:a"
    r" |an )?$",
    re.IGNORECASE,
)
_MAKE_IT = re.compile(
    r"(?:^|[.;!?:–—-] |, |\bno,? |\bactually,? |\band |\bwait,? )(?:make (?:it|that)|let['’]?s"
    r" (?:make it|say)|better make it|call it)(?: just| only"
    r"| a full)? $",
    re.IGNORECASE,
)
_DENIED = re.compile(r"\b(?:not|than|instead of|in place of)(?: the| for)? $", re.IGNORECASE)
_CORRECTING = re.compile(
    r"(?:^|[.;!?–—…)-] ?|\n)(?:ah,? |oh,? |er,? |hm+,? )?(?:correction|sorry|no|hang on|wait|hold"
    r" on|actually|oops|scratch that|on second thoughts?|or rather|"
    r"amendment|change of plan|my mistake|make that|better)\b[^.;!?\n]{0,50}$",
    re.IGNORECASE,
)
_RESTORED = re.compile(
    r"\b(?:back to|after all|was right|as (?:I |it was )?(?:first"
    r" )?(?:said|before)|originally|leave it at|stay with|stick (?:to|with))\b",
    re.IGNORECASE,
)


def outdated(text: str) -> frozenset[float]:
    """The values for which a new value is given later, and that are said nowhere else."""
    numbers = [
        one
        for one in quantities(text)
        if not any(start <= one.start < end for _x, _y, start, end in positions(text))
    ]
    old = {
        *_under_a_name(text, numbers),
        *_of_a_kind(text, numbers),
        *_found_wrong(text, numbers),
        *_made(text, numbers),
    }
    if old and _RESTORED.search(text):
        old -= {place for place in old if not re.search(r"\bnew\b", text)}
    kept = {
        number.value
        for place, number in enumerate(numbers)
        if place not in old and not _DENIED.search(text[: number.start])
    }
    return frozenset(numbers[place].value for place in old) - kept


def read_spacing(text: str) -> float | None:
    """The spacing of the only grid of a text, which is said under that name: "lines 5 m apart", or
    given anew: "the spacing goes down to 4".
    """
    inside = [(start, end) for _x, _y, start, end in positions(text)]
    numbers = [
        one
        for one in quantities(text)
        if one.unit in ("m", None)
        and one.said > 0
        and not any(start <= one.start < end for start, end in inside)
    ]
    anew = [
        one
        for one in numbers
        if re.search(
            _named_anew("spacing"), text[max(0, one.start - 60) : one.start], re.IGNORECASE
        )
    ]
    plain = [
        one
        for one in numbers
        if _is_a(text, one, "spacing")
        and re.search(_SPACED, text[max(0, one.start - 24) : one.end + 24], re.IGNORECASE)
    ]
    found = {one.value for one in anew or ([] if UNSURE.search(text) else plain)}
    return (
        found.pop()
        if len(found) == 1 and len(_GRIDS.findall(text)) <= 1 and not _GRIDS_APART.search(text)
        else None
    )


def _named_anew(role: str) -> str:
    """Words before a value that is given anew under its name."""
    return (
        rf"\b(?:{_NAMES[role]}){_ANEW}|{_SET}(?:the |that |your )?(?:{_NAMES[role]})(?: to| be)?"
        r" (?:just |only )?$"
    )


def _under_a_name(text: str, numbers: Sequence[Quantity]) -> Iterator[int]:
    """ "Max 600 m ... new maximum four-fifty"."""
    for role in _ROLES:
        named = [
            place
            for place, number in enumerate(numbers)
            if re.search(
                rf"\b{role}{_GAP}", text[max(0, number.start - 24) : number.start], re.IGNORECASE
            )
        ]
        new = [
            place
            for place in named
            if re.search(
                rf"\bnew {role}{_GAP}",
                text[max(0, numbers[place].start - 28) : numbers[place].start],
                re.IGNORECASE,
            )
        ]
        if len(new) == 1:
            yield from (place for place in named if place < new[0])


def _of_a_kind(text: str, numbers: Sequence[Quantity]) -> Iterator[int]:
    """ "Spacing 5 ... the spacing goes down to 4", "make the radius 12", of the only such value
    that was said before.
    """
    given: set[int] = set()
    for role in _NAMES:
        for place, number in enumerate(numbers):
            before = text[max(0, number.start - 60) : number.start]
            named = re.search(_named_anew(role), before, re.IGNORECASE)
            anew = named or (_is_a(text, number, role) and _CORRECTING.search(text[: number.start]))
            if anew and not _DENIED.search(before):
                given.add(place)
                said = [
                    earlier
                    for earlier in range(place)
                    if earlier not in given
                    and _is_a(text, numbers[earlier], role)
                    and _alike(numbers[earlier], number)
                ]
                yield from said if len(said) == 1 else ()


def _is_a(text: str, number: Quantity, role: str) -> bool:
    before, behind = _BESIDE[role]
    unit = _UNITS.get(role)
    if number.unit not in (unit, None):
        return False
    found = re.search(
        rf"\b(?:{before})", text[max(0, number.start - 24) : number.start], re.IGNORECASE
    ) or re.match(behind, text[number.end :], re.IGNORECASE)
    return (
        found is not None
        or (role in ("speed", "overlap") and number.unit == unit)
        or (role == "duration" and number.unit == "s" and not _is_a(text, number, "interval"))
    )


def _found_wrong(text: str, numbers: Sequence[Quantity]) -> Iterator[int]:
    """ "25 is too short, run 32", "32 instead of 25", "change 25 into 32": what is said of the
    value that was said once before.
    """
    for place, number in enumerate(numbers):
        following = numbers[place + 1] if place + 1 < len(numbers) else None
        behind = text[number.end : following.start] if following else ""
        wrong = following is not None and len(behind) <= 120 and _TOO.match(behind) is not None
        wrong = wrong or (
            following is not None
            and _INTO.search(text[: number.start]) is not None
            and _BY.fullmatch(behind) is not None
        )
        wrong = wrong or (
            place > 0 and _FOR_IT.fullmatch(text[numbers[place - 1].end : number.start]) is not None
        )
        if wrong:
            said = [earlier for earlier in range(place) if numbers[earlier].said == number.said]
            if len(said) <= 1:
                yield from (*said, place)


def _made(text: str, numbers: Sequence[Quantity]) -> Iterator[int]:
    """ "Ten minutes ... Make it fifteen minutes": the only value with the very unit that was said
    before, else the only one of its kind.
    """
    for place, number in enumerate(numbers):
        if (
            number.unit is None
            or not number.said
            or not _MAKE_IT.search(text[max(0, number.start - 40) : number.start])
        ):
            continue
        kind = [
            earlier
            for earlier in range(place)
            if numbers[earlier].unit == number.unit and numbers[earlier].said
        ]
        very = [
            earlier
            for earlier in kind
            if abs(numbers[earlier].value / numbers[earlier].said - number.value / number.said)
            < 1e-9
        ]
        if len(kind) == 1 or len(very) == 1:
            yield (very if len(very) == 1 else kind)[0]


def _alike(one: Quantity, two: Quantity) -> bool:
    return one.value != two.value and (two.unit in (one.unit, None) or one.unit is None)
