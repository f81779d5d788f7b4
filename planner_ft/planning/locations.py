"""The places that a mission plan leaves open: their names, and filling them in, as from a chart.

A task at such a place holds the vocabulary's unresolved location ([-99, -99]). The place is called
by the target of the search that is to find it, a berth by words of the task prompt.
"""

import copy
import json
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.facts.geographic import read_geographic, without_geographic
from planner_ft.facts.places import read_positions
from planner_ft.planning.limits import without_limits
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.support.geodesy import Origin
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import canonical_value, is_position
from planner_ft.vocabulary.replay import target

Position = tuple[float, float]
Locations = Mapping[str, Position]

PLACE_WORDS = re.compile(
    r"(?i)\b(?:at|to|alongside|into|for|on|in)\s+(?P<place>[^[\d].*?)"
    r"(?=\s+(?:once|before|after|and|then|with|by)\b|[.,;:]|$)"
)
IN_PROMPT = "task_prompt"
"""What holds the place of a pass; other tasks have it in a parameter."""
KEPT_CLEAR = " It is kept clear of as a structure, unless its name is one of open water."
ARTICLE = re.compile(r"^(?:the|an?|our|your|that|this)\s+", re.IGNORECASE)


@dataclass(frozen=True)
class OpenPlace:
    """A place without coordinates, and the numbers (from 1) of the tasks that need it."""

    name: str
    tasks: tuple[int, ...]


def open_places(plan: Mapping[str, Any], vocabulary: Vocabulary) -> list[OpenPlace]:
    """The places that a mission plan leaves open, in the order of their first tasks."""
    needed: dict[str, list[int]] = {}
    searched: list[str] = []
    for number, entry in enumerate(plan["tasks"], start=1):
        title = entry["title"]
        if title == vocabulary.locate:
            searched.append(target(vocabulary.task[title], entry["parameters"]) or title)
        elif is_open(entry, vocabulary):
            needed.setdefault(_name_of(entry, searched, vocabulary), []).append(number)
        elif name := _told_in_degrees(entry, vocabulary) or _passed(entry, searched, vocabulary):
            needed.setdefault(name, []).append(number)
    return [OpenPlace(name, tuple(numbers)) for name, numbers in needed.items()]


def is_open(entry: Mapping[str, Any], vocabulary: Vocabulary) -> bool:
    """Whether a task is at a place that nobody has given coordinates for."""
    known = vocabulary.task.get(entry["title"])
    name = known.position_parameter if known else None
    return name is not None and entry["parameters"].get(name) == list(vocabulary.unresolved)


def parse_location(text: str) -> tuple[str, Position]:
    """Read "NAME=x,y" (metres). Raises PlannerError that says what was expected."""
    name, _equals, place = text.rpartition("=")
    try:
        x, y = map(float, place.strip().strip("[]()").split(","))
    except ValueError:
        x = y = math.nan
    if name.strip() and math.isfinite(x) and math.isfinite(y):
        return name.strip(), (x, y)
    expected = '"NAME=x,y" in metres east and north of home, such as "green buoy=120,-35"'
    raise PlannerError(f"--locate {text}: expected {expected}")


def parse_locations(texts: Sequence[str]) -> dict[str, Position]:
    """Read several "NAME=x,y". Raises PlannerError, also for a name that is given two positions."""
    locations: dict[str, Position] = {}
    for name, position in map(parse_location, texts):
        if locations.setdefault(name, position) != position:
            raise PlannerError(f"--locate {name}: two positions are given; leave one of them out")
    return locations


def resolve(plan: dict[str, Any], locations: Locations, vocabulary: Vocabulary) -> dict[str, Any]:
    """The plan with the named places filled in; names match by whole words, without case, article.

    Raises PlannerError for a name that is not open or given twice, and for the unknown position.
    """
    places = open_places(plan, vocabulary)
    filled = copy.deepcopy(plan)
    named: dict[OpenPlace, str] = {}
    for name, position in locations.items():
        at, unknown = [float(value) for value in position], list(vocabulary.unresolved)
        if at == unknown:
            problem = f"{unknown} stands for an unknown place; give where it is"
            raise PlannerError(f"--locate {name}: {problem}")
        place = _matching(name, places)
        if (other := named.setdefault(place, name)) != name:
            problem = f'"{place.name}" is located by "{other}" already; leave one of them out'
            raise PlannerError(f"--locate {name}: {problem}")
        for number in place.tasks:
            settle(filled["tasks"][number - 1], place.name, at, vocabulary)
    return filled


def place_in(entry: Mapping[str, Any], vocabulary: Vocabulary) -> tuple[str, list[float] | None]:
    """What holds the place of a task, a parameter or the task prompt, and the place, if known."""
    known = vocabulary.task[entry["title"]]
    if parameter := known.position_parameter:
        place = entry["parameters"].get(parameter)
        return parameter, None if place == list(vocabulary.unresolved) else place
    text = without_geographic(entry["task_prompt"])
    told = [place for place in read_positions(text) if place.certain]
    return IN_PROMPT, canonical_value([told[0].x, told[0].y]) if told else None


def settle(
    entry: dict[str, Any], name: str, position: Sequence[float], vocabulary: Vocabulary
) -> None:
    """Put a task at its open place, or at another one than before, in place. A pass has it in the
    prompt alone: "along the east side of the breakwater at [60, 40]".
    """
    at, (where, before) = canonical_value(list(position)), place_in(entry, vocabulary)
    prompt: str = entry["task_prompt"]
    if where != IN_PROMPT:
        entry["parameters"][where] = at
    elif before is not None:
        entry[IN_PROMPT] = prompt.replace(json.dumps(canonical_value(before)), json.dumps(at))
    elif read_geographic(name):
        entry[IN_PROMPT] = prompt.replace(name, json.dumps(at))
    else:
        end = prompt.casefold().find(name.casefold()) + len(name)
        entry[IN_PROMPT] = f"{prompt[:end]} at {json.dumps(at)}{prompt[end:]}"


def _told_in_degrees(entry: Mapping[str, Any], vocabulary: Vocabulary) -> str:
    """The geographic position of a task prompt, beside its limits: no place without an origin."""
    prompt = without_limits(entry["task_prompt"], vocabulary)
    return next((prompt[at.start : at.end].strip() for at in read_geographic(prompt)), "")


def _passed(entry: Mapping[str, Any], searched: Sequence[str], vocabulary: Vocabulary) -> str:
    """The searched target that a pass runs along, where its prompt has no place for it."""
    known, prompt = vocabulary.task.get(entry["title"]), entry["task_prompt"].casefold()
    if known is None or known.pattern != "pass" or place_in(entry, vocabulary)[1]:
        return ""
    return max((name for name in searched if name.casefold() in prompt), key=len, default="")


def fitting(
    plan: dict[str, Any], locations: Locations, vocabulary: Vocabulary
) -> tuple[dict[str, Position], list[str]]:
    """The locations that resolve takes, and a note for each of the others: they are points of the
    chart all the same, but for the unknown position. A name in full comes before a part of it.
    """
    fits, notes = dict[str, Position](), list[str]()
    full = {_plain(place.name) for place in open_places(plan, vocabulary)}
    for name, position in sorted(locations.items(), key=lambda one: _plain(one[0]) not in full):
        try:
            resolve(plan, {**fits, name: position}, vocabulary)
            fits[name] = position
        except PlannerError as problem:
            known = tuple(position) != vocabulary.unresolved
            notes.append(f"Not used for a task: {problem}.{KEPT_CLEAR if known else ''}")
    return fits, notes


def charted(chart: Locations, places: Sequence[OpenPlace]) -> dict[str, Position]:
    """The positions of a chart, by open place, that fit just one."""
    found: dict[str, Position] = {}
    for place in places:
        wanted = _plain(place.name)
        fits = [name for name in chart if _plain(name) == wanted]
        both = [(name, _plain(name)) for name in chart]
        fits = fits or [name for name, own in both if _has(wanted, own) or _has(own, wanted)]
        if len({chart[name] for name in fits}) == 1:
            found[place.name] = chart[fits[0]]
    return found


def _matching(name: str, places: Sequence[OpenPlace]) -> OpenPlace:
    wanted = _plain(name)
    exact = [place for place in places if _plain(place.name) == wanted]
    found = exact or [place for place in places if _has(_plain(place.name), wanted)]
    if len(found) == 1:
        return found[0]
    names = ", ".join(f'"{place.name}"' for place in found or places)
    problem = "fits several places" if found else "no such place is open"
    there = f"there is {names}" if places else "the plan leaves no place open"
    raise PlannerError(f"--locate {name}: {problem}; {there}")


def _name_of(entry: Mapping[str, Any], searched: Sequence[str], vocabulary: Vocabulary) -> str:
    """Degrees of the task prompt, the searched target in it or the last one; a berth in words."""
    prompt: str = entry["task_prompt"]
    if degrees := read_geographic(prompt):
        return prompt[degrees[0].start : degrees[0].end].strip()
    mentioned = [name for name in searched if name.lower() in prompt.lower()]
    if mentioned:
        return max(mentioned, key=len)
    if searched and not vocabulary.task[entry["title"]].docks:
        return searched[-1]
    words = PLACE_WORDS.search(prompt)
    return ARTICLE.sub("", words["place"]) if words else str(entry["title"])


def _plain(name: str) -> str:
    return ARTICLE.sub("", " ".join(name.lower().split()))


def _has(name: str, part: str) -> bool:
    """Whether a name has a part in whole words and numbers: "room 203" has no "room 20"."""
    return bool(re.search(rf"(?<!\w)(?<!\d[.,]){re.escape(part)}(?!\w|[.,]\d)", name))


# ---------------------------------------------------------------- places and areas of GeoJSON files


LOCAL = "local metres"
"""What "frame" says in a file whose coordinates are [x, y] in local metres."""


def read_places(path: Path, origin: Origin | None) -> dict[str, Position]:
    """The points of a GeoJSON file by their property "name". Raises PlannerError."""
    flag, places = f"--locate-file {path}", dict[str, Position]()
    content = _content(path, flag)
    local = _converter(content, origin, flag)
    for number, (properties, geometry) in enumerate(_features(content), start=1):
        name = properties.get("name")
        if geometry.get("type") != "Point":
            continue
        if not isinstance(name, str) or not name.strip():
            raise PlannerError(f'{flag}: point {number} has no "name" among its properties')
        position = local(geometry.get("coordinates"))
        if places.setdefault(name.strip(), position) != position:
            raise PlannerError(f'{flag}: two points are named "{name}"; rename one of them')
    if not places:
        needed = 'a feature with a "Point" and a "name" is needed'
        raise PlannerError(f"{flag}: has no points; {needed}")
    return places


def read_area(path: Path, origin: Origin | None) -> list[Position]:
    """The corners of the one polygon of a GeoJSON file. Raises PlannerError."""
    flag = f"--area {path}"
    content = _content(path, flag)
    local = _converter(content, origin, flag)
    shapes = [shape for _properties, shape in _features(content)]
    rings = [shape.get("coordinates") for shape in shapes if shape.get("type") == "Polygon"]
    match rings:
        case [[[_, *_] as ring]]:
            corners = [local(corner) for corner in ring]
            return corners[:-1] if corners[0] == corners[-1] else corners
    raise PlannerError(f"{flag}: must have one polygon without holes, and has {len(rings)}")


def _content(path: Path, flag: str) -> dict[str, Any]:
    if not path.is_file():
        raise PlannerError(f"{flag}: no such file")
    value = read_json(path)
    if not isinstance(value, dict) or value.get("type") not in ("FeatureCollection", "Feature"):
        raise PlannerError(f"{flag}: is no GeoJSON FeatureCollection")
    return value


def _features(content: dict[str, Any]) -> Iterator[tuple[dict[str, Any], dict[str, Any]]]:
    """Properties and geometry of every feature, each {} where it is no object."""
    found = content.get("features") if content["type"] == "FeatureCollection" else [content]
    for item in found if isinstance(found, list) else ():
        parts = (isinstance(item, dict) and item.get(key) for key in ("properties", "geometry"))
        properties, geometry = (part if isinstance(part, dict) else {} for part in parts)
        yield properties, geometry


def _converter(
    content: dict[str, Any], origin: Origin | None, flag: str
) -> Callable[[Any], Position]:
    """From a coordinate of the file to local metres."""
    in_metres = content.get("frame") == LOCAL
    if not in_metres and origin is None:
        ways = f'give --origin LAT,LON, or "frame": "{LOCAL}" in the file where they are metres'
        raise PlannerError(f"{flag}: has longitudes and latitudes; {ways}")

    def local(coordinate: Any) -> Position:
        pair = coordinate[:2] if isinstance(coordinate, list) else []
        if not is_position(pair):
            raise PlannerError(f"{flag}: {str(coordinate)[:60]} is no coordinate [x, y]")
        first, second = map(float, pair)
        if in_metres or origin is None:
            return first, second
        if abs(first) > 180 or abs(second) > 90:
            problem = "is no [longitude, latitude] in degrees"
            raise PlannerError(f"{flag}: {str(coordinate)[:60]} {problem}")
        x, y = origin.to_local(second, first)
        return round(x, 2), round(y, 2)

    return local
