"""Geographic positions of a text, a kind of their own.

They are told from local positions ("40 east, 25 north", in metres) by a degree sign with minutes or
a hemisphere, the words latitude and longitude, hemisphere letters at two numbers with decimals (at
one: two decimals), or four decimals and more, and stand in pairs unless they have minutes. UTM
coordinates are some too: a zone, six digits of easting and seven of northing.
"""

import functools
import itertools
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace

from planner_ft.facts.numbers import read_numbers
from planner_ft.support.geodesy import from_utm

DIGITS_OF_DEGREES = 4  # decimals from which a bare number is rather degrees than metres
FINE = 2  # decimals of a latitude and a longitude with their hemispheres in words
BLANK = "|"  # stands in place of what was read already
_MINUS = ("-", "−", "–")

_COORDINATE = re.compile(
    r"(?P<word>\b(?i:lat(?:itude)?\W{1,3}(?:and )?(?:lon(?:g(?:itude)?)?|lng)"
    r"|lat(?:itude)?|lon(?:g(?:itude)?)?|lng)\b[\s.:=]{0,3}(?:of |is )?)?"
    r"(?:(?P<lead>\b[NSEW]\s?)|(?<![\w.])|(?<=\d[NS])|(?<=\.\d{4})(?=[+-]\d{2,3}\.\d{4}))"
    r"(?P<sign>[-−–+])?"
    r"(?:(?P<whole>\d{2,3})[\s-]?(?P<packed>[0-5]\d(?:\.\d+|(?=[\s-]?[0-5]\d)))"
    r"(?:[\s-]?(?P<sixtieths>[0-5]\d(?:\.\d+)?))?['′’]?(?(lead)|(?=[\s,]?[NSEW](?![A-Za-z])))"
    r"|(?P<degrees>\d{1,3}(?:\.\d+|,\d{2,}(?=\s?[°º˚])|,\d{4,}(?=\s?[NSEWO]))?)(?![\d.]*\d))"
    r"(?P<ring>\s?(?:[°º˚]|(?P<spoken>(?i:deg(?:rees?)?)\b\.?))\s?"
    r"(?:(?:(?i:and) )?(?P<minutes>\d{1,2}(?:[.,]\d+)?)"
    r"\s?(?:['′’]|(?i:min(?:utes?)?)\b\.?|(?=(?i:[NSEW]|north|south|east|west)\b))\s?"
    r"(?:(?:(?i:and) )?(?P<seconds>\d{1,2}(?:[.,]\d+)?)\s?"
    r"(?:[\"″”]|''|’’|(?i:sec(?:onds?)?)\b\.?)\s?)?)?)?"
    r"(?(lead)|(?P<hemisphere>"
    r"(?:\s|(?<=\d),)?(?:[NSEW](?![A-Za-z_])|(?i:north|south|east|west|nord|süd|ost)\b))?)"
)
"""`whole` and `packed` are degrees and minutes as receivers send them (4807.038,N; 480702N) or as
they are spoken of without signs: "48 07.038 N", "48-07.0N", with seconds "48-07-02N", "48 07 02 N".
"""
_DICTATED = re.compile(r"[a-z] (?:(?:decimal|point) [a-z]|degrees? [a-z])", re.IGNORECASE)
_UTM = re.compile(
    r"(?:\bUTM\b\W{0,3})?(?:(?:\bzone\s)?\b(?P<zone>[1-9]|[1-5]\d|60)\s?(?P<band>[C-HJ-NP-X])?\b"
    r"\W{1,3}|(?<=UTM: )|(?<=UTM )|(?<=UTM, ))"
    r"(?:(?:easting|E|x)\W{0,3})?(?P<easting>\d{3}\s?\d{3}(?:\.\d+)?)(?:\s?m?E\b|\s?m\b)?"
    r"\W{1,3}(?:(?:and )?(?:northing|N|y)\W{0,3})?(?P<northing>\d\s?\d{3}\s?\d{3}(?:\.\d+)?)"
    r"(?:\s?m?N\b|\s?m\b)?",
    re.IGNORECASE,
)
"""A letter is a band of latitude, from N on in the north; S is the southern half."""
_BETWEEN_COORDINATES = re.compile(r"[\s,;/]*(?:and|by)?[\s,;/]*")


@dataclass(frozen=True)
class Geographic:
    """A geographic position in degrees, north and east positive; None for what is not said."""

    latitude: float | None
    longitude: float | None
    start: int
    end: int


@functools.lru_cache(maxsize=2048)
def read_geographic(text: str) -> tuple[Geographic, ...]:
    """The geographic positions of a text, dictated ones too: "fifty degrees six decimal two minutes
    north, ..."
    """
    written, places = _in_figures(text)
    found = _read(written)
    if not places:
        return found
    ends = ((places[one.start], places[one.end - 1] + 1) for one in found)
    return tuple(
        replace(one, start=start, end=end) for one, (start, end) in zip(found, ends, strict=True)
    )


def _in_figures(text: str) -> tuple[str, list[int]]:
    """A text with its dictated numbers in figures, and the place of each character in `text`; none
    where it has no such numbers.
    """
    if not _DICTATED.search(text):
        return text, []
    parts, places, done = list[str](), list[int](), 0
    for number in read_numbers(text):
        said = text[number.start : number.stop]
        if number.start >= done and not any(map(str.isdigit, said)):
            figures = f"{number.said:.10g}"
            parts += [text[done : number.start], figures]
            places += [*range(done, number.start), *[number.start] * (len(figures) - 1)]
            places.append(number.stop - 1)
            done = number.stop
    return "".join([*parts, text[done:]]), [*places, *range(done, len(text))]


def _read(text: str) -> tuple[Geographic, ...]:
    known = list(_COORDINATE.finditer(text))
    sure = [match for match in known if _is_degrees(match)]
    for one, two in itertools.pairwise(known):
        # "54.3 N, 10.1 E": metres have no such letters at decimals.
        pair = one, two
        lettered = all(_has_letter(match) and "." in (match["degrees"] or "") for match in pair)
        # "55.32 north 10.14 east": who speaks of metres says no centimetres, and east first.
        fine = all(_has_side(match) and _decimals(match) >= FINE for match in pair)
        fine &= not text.startswith(" of ", two.end())
        axes = [_degrees(match)[1] for match in pair]
        if (lettered and axes[0] != axes[1]) or (fine and axes == ["lat", "lon"]):
            sure += [match for match in (one, two) if match not in sure]
    # "48.123N 7.5E": what stands beside degrees with a hemisphere of its own is degrees.
    pairs = [(one, two) for one, two in itertools.pairwise(known) if {one, two} & {*sure}]
    # "Lat/long 54.25 10.5" says what both are.
    beside = {
        match
        for one, two in pairs
        if _BETWEEN_COORDINATES.fullmatch(text, one.end(), two.start())
        for match in (one, two)
        if _has_letter(match) or "lon" in (one["word"] or "").lower()[3:]
    }
    found = [match for match in known if match in beside or match in sure]
    result, skip = list[Geographic](), False
    for one, two in itertools.zip_longest(found, found[1:]):
        paired = two is not None and _BETWEEN_COORDINATES.fullmatch(text, one.end(), two.start())
        if not skip and (paired or (one["minutes"] and not one["spoken"])):
            parts = (one, two) if paired else (one,)
            (first, axis), (second, other) = [*map(_degrees, parts), (None, "")][:2]
            turned = axis == "lon" or other == "lat"
            both = (second, first) if turned else (first, second)
            result.append(Geographic(*both, one.start(), parts[-1].end()))
        skip = bool(paired) and not skip
    utm = list(_read_utm(text))
    others = (
        one for one in result if all(one.end <= at.start or at.end <= one.start for at in utm)
    )
    return tuple(sorted([*utm, *others], key=lambda one: one.start))


def _read_utm(text: str) -> Iterator[Geographic]:
    for match in _UTM.finditer(text):
        south = (match["band"] or "N").upper() in "CDEFGHJKLMS"
        easting, northing = (
            float(match[name].replace(" ", "")) for name in ("easting", "northing")
        )
        place: tuple[float | None, float | None] = None, None  # without its zone it is anywhere
        if match["zone"]:
            place = from_utm(int(match["zone"]), easting, northing, south=south)
        yield Geographic(*place, *match.span())


def lone_coordinates(text: str) -> list[tuple[int, int]]:
    """The spans of latitudes and longitudes that stand alone and are no position: "do not go north
    of 54.3216N". Whole degrees need their hemisphere.
    """
    paired = [(place.start, place.end) for place in read_geographic(text)]
    return [
        match.span()
        for match in _COORDINATE.finditer(text)
        if _is_degrees(match)
        and (match["lead"] or match["hemisphere"] or "." in match["degrees"])
        and not any(start <= match.start() < end for start, end in paired)
    ]


def _is_degrees(match: re.Match[str]) -> bool:
    decimals = _decimals(match)
    return bool(
        match["word"]
        or match["packed"]
        or (match["minutes"] and not match["spoken"])
        or (match["ring"] and _has_side(match) and (decimals or not match["spoken"]))
        or (match["minutes"] and _has_side(match))
        or decimals >= DIGITS_OF_DEGREES
        or (_has_letter(match) and decimals >= 2)
        or (_has_side(match) and decimals >= DIGITS_OF_DEGREES - 1)
    )


def _decimals(match: re.Match[str]) -> int:
    return len((match["degrees"] or "").replace(",", ".").partition(".")[2])


def _has_side(match: re.Match[str]) -> bool:
    """Whether a number has a hemisphere."""
    return bool(match["lead"] or match["hemisphere"])


def _has_letter(match: re.Match[str]) -> bool:
    """Whether a number has the letter of a hemisphere."""
    return len((match["lead"] or match["hemisphere"] or "").strip(" ,")) == 1


def _degrees(match: re.Match[str]) -> tuple[float, str]:
    """The value of a coordinate, and "lat" or "lon" where that is said."""
    letter = (match["lead"] or match["hemisphere"] or "").strip(" ,").lower()
    said = (match["word"] or letter).strip().lower()
    axis = said and ("lon" if said.startswith(("lo", "ln", "e", "w", "o")) else "lat")
    degrees, minutes = match["degrees"] or match["whole"], match["minutes"] or match["packed"] or 0
    seconds = match["seconds"] or match["sixtieths"] or 0
    parts = (str(part).replace(",", ".") for part in (degrees, minutes, seconds))
    value = sum(float(part) / 60**at for at, part in enumerate(parts))
    return -value if match["sign"] in _MINUS or letter[:1] in ("s", "w") else value, axis


def without_geographic(text: str) -> str:
    """A text of the same length with blanks for its geographic positions."""
    for place in read_geographic(text):
        text = text[: place.start] + BLANK * (place.end - place.start) + text[place.end :]
    return text
