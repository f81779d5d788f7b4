"""The margins to obstacles that an input states: "8 m of clearance", "nothing may come closer than
ten metres".
"""

from __future__ import annotations

import re

from planner_ft.data.quantities import quantities
from planner_ft.data.stated import CABLES
from planner_ft.decoding.constraints.facts import DIGIT_BEHIND

_THINGS = (
    r"(?:everything|anything|everybody|anybody|every(?: \w+)? obstacle|any(?: \w+)?"
    r" obstacles?|all(?: the)? obstacles|obstacles|(?:all )?traffic|"
    r"other (?:boats|craft|vessels))"
)
_LED = re.compile(
    r"\b(?:(?:safety |obstacle )?(?:margin|clearance)s?|(?:safety|obstacle)"
    r" distance|(?:minimum|safe) (?:distance|separation) (?:to|from) (?:all )?obstacles|"
    rf"clear of {_THINGS} by|avoid\w* {_THINGS} (?:by|with)|nothing (?:may |is to |must |should"
    r" |shall |can )?comes? (?:closer|nearer) than|"
    rf"let nothing (?:come )?(?:closer|nearer) than)(?: (?:to|from) {_THINGS})?(?:[:,=]| of| is|"
    r" at| to be| being| by)*"
    r"(?: (?:at least|about|a minimum of|no less than|not less than))? ?$",
    re.IGNORECASE,
)
"""Words before a clearance."""
_FOLLOWED = re.compile(
    r"^,? ?(?:of |in )?(?:(?:safety |obstacle )?(?:margin|clearance)\b|clear\b|"
    r"(?:clear )?(?:room|space|water|sea ?room) (?:all |to |from |between |round|around)|to"
    r" spare\b|"
    rf"(?:at least |minimum |clear |away |or more )?(?:from|off|of|to) {_THINGS}\b|(?:away|minimum)"
    rf" (?:from|to) {_THINGS}\b)",
    re.IGNORECASE,
)
"""Words behind one."""
_BOUND_BEFORE = re.compile(
    r"\b(?:radius|radii|diameter|circle|ring|within|every|spacing|grid|box|area|patch|spaced|length|width|distance|from|over|"
    r"for|along)(?: (?:of|is|at|a|the|about))* ?$",
    re.IGNORECASE,
)
_BOUND_BEHIND = re.compile(
    r"^[ -]?(?:radius|radii|diameter|circle|ring|watch"
    r" circle|wide|long|broad|apart|spacing|deep|square|round (?:the|it)|by \d|x \d|grid|box|"
    r"line|lines|lanes|legs|tolerance|(?:to (?:the )?|due |further"
    r" )?(?:north|south|east|west|port|starboard)|ahead|astern|off (?:it|the|its|on|her)\b|"
    r"from (?:it|the|its)\b|out\b|hops|on (?:heading|course|bearing))",
    re.IGNORECASE,
)
"""Words before and behind a length that is another thing's."""
_WILL_DO = re.compile(r"^ (?:will do|is enough|are enough|is plenty|suffic\w+)", re.IGNORECASE)


def margins_only(text: str) -> set[float]:
    """The lengths that are clearances beyond doubt and said once: they are no radius."""
    found = quantities(text)
    said = [quantity.value for quantity in found]
    return {
        quantity.value
        for quantity in found
        if quantity.unit == "m"
        and said.count(quantity.value) == 1
        and not _BOUND_BEHIND.match(text[quantity.end :])
        if _LED.search(text[: quantity.start])
        or (
            _FOLLOWED.match(text[quantity.end :])
            and text[quantity.end : quantity.end + 1] != ","
            and not _BOUND_BEFORE.search(text[: quantity.start])
        )
    }


def clearances(text: str) -> set[float]:
    """The lengths that are clearances beyond doubt, with those that may be; nothing where no length
    is one.
    """
    certain, possible = set(), set()
    for quantity in quantities(text):
        before, behind = text[: quantity.start], text[quantity.end :]
        if CABLES.match(behind):
            return set()
        length = quantity.unit == "m" or (quantity.unit is None and _WILL_DO.match(behind))
        if _LED.search(before) or (length and _FOLLOWED.match(behind)):
            if DIGIT_BEHIND.match(behind) or quantity.unit not in ("m", None):
                return set()
            certain.add(quantity.value)
        elif length and not _BOUND_BEFORE.search(before) and not _BOUND_BEHIND.match(behind):
            possible.add(quantity.value)
    return certain | possible if certain else set()
