"""Words that patterns for several skills are made of: numbers and lengths, the bow, single images,
and what can be measured.
"""

from __future__ import annotations

LENGTH = (
    r"(?:m|metres?|meters?|ft|feet|foot|yds?|yards?|fathoms?|cables?|km|kilomet\w+|miles?|nm|boat"
    r" ?-?lengths?|lengths?)"
)
"""A unit of length."""
COUNT = (
    r"(?:\d[\d.,]*|an?|half|one|two|three|four|five|six|seven|eight|nine|ten|eleven|twelve|\w+teen|twenty|thirty|fo?u?rty|fifty|sixty|\w+ty|"
    r"dozen|couple|few|hundred|"
    r"and|quarter)"
)
"""A word of a number."""
SIZE = rf"(?:{COUNT}[ -]?){{1,6}}{LENGTH}\b"
"""A length as it is said: "5 m", "two and a half metres"."""
BOW = r"(?:headings?|hdg|bows?|nose|prow|yaw|head|course|orientation)"
"""What points where the boat points."""
SHOT = r"(?:pictures?|images?|photos?|photographs?|frames?|shots?|stills?|pics?)"
"""A single image."""
GAP = r"(?:[a-z'-]+ ){0,3}"
SENSED = (
    r"(?:(?!and\b|while\b|with\b|as\b|when\b|then\b|or\b)[a-z'-]+"
    r" ){0,4}(?:env\w*|depths?|\w*position\w*|gps|gnss|tracks?|fix\w*|slices?|"
    r"profiles?|temp\w*|"
    r"therm[a-z]*\b(?! (?:cam|stream|feed|view))|horizon\w*(?! cam)|tilt|"
    r"distance\w*|sector\w*|pose|offset\w*|pixel\w*|quality|wind|weather(?!"
    r" station)|conditions?|surroundings?|soundings?|obstacles?|observation\w*|"
    r"coordinates|accuracy|geo\w*|snap\w*|stills?|flat\w*|planar\w*|met|sea state|angle)\b"
)
"""What can be logged, read or measured besides a stream, with some words before it."""
