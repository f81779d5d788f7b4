"""Values that a command gives anew under their names: "max 600 m ... new maximum four-fifty"."""

from __future__ import annotations

import re

from planner_ft.data.quantities import quantities

_ROLES = (r"max(?:imum)?", r"radius", r"distance", r"stand-?off", r"spacing", r"width", r"length", r"speed", r"duration", r"interval", r"overlap")
_GAP = r"(?: (?:is|of|at))?[ :=]{1,2}$"


def outdated(text: str) -> frozenset[float]:
    """The values that stand behind a name for which a new value is given later, and nowhere else."""
    numbers = quantities(text)
    old: set[int] = set()
    for role in _ROLES:
        named = [place for place, number in enumerate(numbers) if re.search(rf"\b{role}{_GAP}", text[max(0, number.start - 24) : number.start], re.IGNORECASE)]
        new = [place for place in named if re.search(rf"\bnew {role}{_GAP}", text[max(0, numbers[place].start - 28) : numbers[place].start], re.IGNORECASE)]
        if len(new) == 1:
            old.update(place for place in named if place < new[0])
    kept = {number.value for place, number in enumerate(numbers) if place not in old}
    return frozenset(numbers[place].value for place in old) - kept
