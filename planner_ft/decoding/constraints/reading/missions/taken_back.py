"""What a command takes back: a task that is not wanted any more ("scratch the circling"), a place
that another one takes the place of ("that berth is taken, so it will be [-7, -12]", "not home,
alongside at [1, 5]"), one of a list ("leave out the middle one").
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from planner_ft.data.numerals import signed
from planner_ft.decoding.constraints.reading.corrected import takes_back
from planner_ft.decoding.constraints.reading.missions.apart import PLACE, SENTENCE
from planner_ft.decoding.constraints.reading.missions.spoken import SAYS

Position = tuple[float, float]
_NOUNS = {
    "PerformOrbit": r"circl(?:e|ing)|circuit|orbit(?:ing)?|lap|loop|(?:going|way) round",
    "SearchAndDetect": (
        r"search(?:ing)?(?! for the hot)|looking(?: for (?:her|it|him))?|hunt(?:ing)?(?: for"
        r" (?:her|it|him))?|finding"
    ),
    "HorizontalPanorama": r"panoramas?|pano",
    "DriftAudit": r"drift(?: audit| check| test)?|drifting",
    "KeepStation": r"(?:hold|stay|wait|loiter)(?:ing)?|station[- ]keeping|keeping station",
    "ThermalHotspotLocalizer": (
        r"hot[- ]?spots?(?: sweep| search| scan)?|hott?est[- ]spot(?: sweep| search| scan)?"
    ),
    "ThermalTimeLapse": (
        r"thermal (?:series|time[- ]?lapse|lapse|readings?|watch)|time[- ]?lapse|temperature"
        r" (?:series|readings?)"
    ),
    "FeatureStare": r"steady (?:video|footage)|video|footage|film(?:ing)?|stare",
    "GlareFreeApproach": r"glare[- ]free (?:shot|picture|view|approach|photo|image|look)",
    "BoatLandingClearanceSweep": (
        r"(?:lidar|boat landing|landing|clearance)(?: clearance| boat landing)?"
        r" (?:sweep|check|scan)"
    ),
    "BathymetryGridSurvey": (
        r"(?:depth|sounding) (?:grid|survey)|soundings?|bathymetry|seabed (?:grid|survey|mapping)"
    ),
    "SubseaCableTrack": r"cable (?:track|run)(?:ing)?",
    "ParallelStructurePass": r"(?:straight |side |close |parallel )?pass",
    "FollowTarget": r"follow(?:ing)?|escort(?:ing)?|shadow(?:ing)?|chase|chasing|tail(?:ing)?",
    "AutoGenerateReportSummary": r"(?:written )?(?:report|summary)|write-up|reporting|writing up",
    "SmartDataHarvest": r"upload(?:ing)?|data transfer|transmission",
    "Diagnostics": r"(?:sensor |self-?|system )?(?:check|test)s?|diagnostics?",
    "DockingApproach": r"docking|berthing|mooring",
    "VisualDockingApproach": r"docking|berthing|mooring",
}
"""What a task is called when it is taken back."""
_NOWHERE = {"SearchAndDetect", "Diagnostics", "AutoGenerateReportSummary", "SmartDataHarvest"}
"""Tasks that are not done at one of the places of a sentence."""
_DROP = (
    r"(?:scratch|scrap|forget|forget about|drop|cancel|skip|never ?mind|strike|belay|abandon|call"
    r" off|omit|leave out|leave off)"
)
_END = (
    r"(?=\s*(?:[.,;:!)…–—]|-{2}|$|and\b|we\b|altogether|entirely|completely|after"
    r" all|please|again\b|part\b|bit\b|then\b|though\b))"
)
_OFF = (
    r"(?:(?:is|are|['’]s) (?:now |all )?(?:off|cancel?led|called"
    r" off|scrapped|scratched|dropped|unnecessary|no longer (?:needed|wanted|required|necessary)|"
    r"not (?:needed|wanted|required|necessary)(?: any ?more| any longer| now)?)|can be"
    r" (?:dropped|skipped|left out))"
)
_DROPS = {
    title: re.compile(
        rf"(?<!n't )(?<!n’t )(?<!not )(?<!never )\b{_DROP} (?:the |that |this |your |all (?:the"
        rf" |that )?|any )?(?:whole |(?:pre|post)-\w+ )?(?:{nouns}){_END}"
        rf"|\b(?:the|that) (?:{nouns}) {_OFF}{_END}",
        re.IGNORECASE,
    )
    for title, nouns in _NOUNS.items()
}
_PARTLY = re.compile(
    r"\b(?:there|here|second|first|last|other|another|both|each|again|either|third|one|two|three|tomorrow|until|till|unless|if|when|while|before|after)\b",
    re.IGNORECASE,
)
"""Words of sentences that may take back a part alone."""
_TAKEN = re.compile(
    r"\b(?:that|the|this|your|said|old|first) (?:\w+"
    r" )?(?:berth|dock|slip|mooring|place|spot|position|point|stand|pontoon|jetty|pier|slot|box|quay|one)"
    r"(?: there)?(?:['’]s| is| was| has been| will be| are)? (?:now |already |currently |still"
    r" |just )?"
    r"(?:taken|occupied|blocked|closed|full|busy|fouled|silted(?: up)?|unavailable|out of"
    r" (?:use|order|action|bounds|service)|in use|not free|no longer free|"
    r"gone|wrong|no good|shut|reserved|needed)\b",
    re.IGNORECASE,
)
_SO = re.compile(
    r"\b(?:so|use|take|go|make|instead|it(?:['’]ll| will) (?:have to )?be|yours? is|you"
    r" get|switch|try|move|dock|berth|moor|alongside|now)\b(?! (?:not|no)\b)",
    re.IGNORECASE,
)
_NOT_HOME = re.compile(
    r"(?:\b(?:instead of|rather than) (?:\w+ing )?(?:straight |right |back )?(?:to"
    r" )?(?:home|base|harbou?r|back to base)\b"
    r"|(?:[,.;:(…–—-]|\bbut|\bno|\bor|\band) ?(?:no, )?not (?:back )?(?:to"
    r" )?home(?=\s*[,;:–—-]|\s+but\b))",
    re.IGNORECASE,
)
_HOME = re.compile(r"\b(?:home|base|harbou?r|return\w*|rtb|back)\b", re.IGNORECASE)
_ONE_OF = re.compile(
    r"\b(?:leav(?:e|ing) out|leave|skip(?:ping)?|omit(?:ting)?|drop(?:ping)?|forget|miss(?:ing)?"
    r" out|pass over|without|except(?: for)?|bar|but not"
    r"|(?<!all )but|not|"
    r"all but|save|spare)(?: for)? the"
    r" (?P<which>first|second|third|fourth|middle|last|northern(?:most)?|southern(?:most)?|eastern(?:most)?|western(?:most)?|"
    r"nearest|farthest|furthest)"
    r"(?: one| of (?:them|these|those|the (?:two|three|four|five)))?(?: (?:out|alone|be|off|from"
    r" home))?(?=\s*(?:[,.;:!)–—-]|$|and\b|because\b"
    r"|since\b|as\b|this time\b|today\b))(?!,? (?:which|where|who|there))",
    re.IGNORECASE,
)
_OLD = re.compile(
    r"\b(?:(?:gave|said|named|told|mentioned) (?:you"
    r" )?(?:first|before|earlier)|(?:original|former|previous|old|other) \w+|(?:the|that) first)\b",
    re.IGNORECASE,
)
"""Words for what was taken back, which is meant after all."""
_CUE = re.compile(
    r"\b(?:sorry|scratch that|scrap that|strike that|belay"
    r" (?:that|the)|correction|amendment|negative|wrong"
    r" (?:one|place|sheet|way|line|position|point)|typo|"
    r"dropped a (?:sign|minus)|misread|misspoke|my mistake|the (?:correct|right)"
    r" (?:place|position|point|centre|center|start|one|coordinates)|"
    r"(?:is|was|been) (?:given away|wrong|mistaken)|hang on|hold on|no,? wait|i mean|should (?:have"
    r" been|read))\b",
    re.IGNORECASE,
)
_GOES_ON = re.compile(
    r"\b(?:and|then|after|afterwards|next|before|also|too|as well|go on|on to|from there)\b",
    re.IGNORECASE,
)
_ELSE = re.compile(r"\b(?:then|next|afterwards|finally)\b[^.;!?]*$", re.IGNORECASE)
_FORGET = re.compile(
    r"(?:^|[.;:!?,–—-]|\b(?:and|but|please|so|then|to)\b) ?(?:please"
    r" )?(?:forget|skip|cancel|drop|scrap|scratch|leave out|omit|never ?mind|ignore|disregard)"
    r" (?:the|that(?! \[)|this|your)"
    r" (?!.*\b(?:proceed|go|head|until|till|before|usually|instead)\b)\w[^.;:!?,\[(]{0,60}$",
    re.IGNORECASE,
)
_IS_OFF = re.compile(
    r"[ ,]{0,2}(?:is|are|was|were|has been|have been)(?: now| already| both| all)?"
    r" (?:cancel?led|off(?= *[.,;!]| *$)|called off|scrapped|dropped"
    r"|done (?:last|yesterday|already|before|by)|"
    r"surveyed (?:last|yesterday|already)|out of bounds|off limits|closed|left (?:alone|out|in"
    r" peace)|not (?:to be (?!missed|late|left)"
    r"|needed|wanted|for you)|"
    r"no longer (?:needed|wanted|required|of interest)|no concern|none of)\b|[ ,]{0,2}(?:can"
    r" go|drops out|has to go|falls away|stays undone"
    r"|can wait for (?:another|the next))(?= *[.,;!]| *$)",
    re.IGNORECASE,
)
_TIMED = re.compile(r"\b(?:until|till|when|once|if|before|after|as soon as)\b", re.IGNORECASE)
_BETWEEN = re.compile(
    r"\s*(?:,|and|, and|&|;|or)\s*(?:at |to |the one at |one at )?", re.IGNORECASE
)


def dropped_titles(text: str) -> Iterator[str]:
    """The tasks that a text asks for and takes back as a whole afterwards."""
    for title, drops in _DROPS.items():
        match = drops.search(text)
        words = SAYS.get(title)
        if match is None or (words and words.search(text, match.end())):
            continue
        start = max((end.end() for end in SENTENCE.finditer(text, 0, match.start())), default=0)
        placed = title not in _NOWHERE and PLACE.search(text, start, match.start())
        if (
            placed
            or _PARTLY.search(text, start, match.end())
            or _PARTLY.match(text, match.end() + 1)
        ):
            continue
        if words is None or len(words.findall(text[: match.start()])) <= 1:
            yield title


def places_taken_back(text: str, home: Position) -> Iterator[Position]:
    """The places that a text names and does not want the vehicle to go to."""
    found = [
        ((signed(match[1]), signed(match[2])), match.start(), match.end())
        for match in PLACE.finditer(text)
    ]
    dropped = [
        *_corrected(text, found),
        *_said_wrong(text, found),
        *_not_wanted(text, found),
        *_taken(text, found),
        *_left_out(text, found),
    ]
    for index in dict.fromkeys(dropped):
        if all(
            other[0] != found[index][0] or number in dropped for number, other in enumerate(found)
        ):
            yield found[index][0]
    denied = _NOT_HOME.search(text)
    if (
        denied
        and not _HOME.search(text, denied.end())
        and home not in [place for place, _start, _end in found]
    ):
        before = len(_HOME.findall(text, 0, denied.start()))
        if before == 0 or (before == 1 and "home" in denied[0].lower()):
            yield home


Found = Sequence[tuple[Position, int, int]]


def _corrected(text: str, found: Found) -> Iterator[int]:
    """Places that the next one takes the place of: "[40, 18] - no wait, [48, 18]"."""
    for number, (one, two) in enumerate(pairwise(found)):
        if takes_back(text[one[2] : two[1]]) and not _OLD.search(text, two[2]):
            yield number


def _said_wrong(text: str, found: Found) -> Iterator[int]:
    """Places that the next one takes the place of in a sentence about nothing else: "Sorry, wrong
    sheet: it's the pile at [80, -10]".
    """
    for number, (one, two) in enumerate(pairwise(found)):
        between = text[one[2] : two[1]]
        cue = list(_CUE.finditer(between))
        behind = between[cue[0].end() :] if cue else ""
        if not cue or len(between) > 110 or _OLD.search(text, two[2]):
            continue
        spoken = (
            any(words.search(behind) for words in SAYS.values())
            or re.search(r"\d", between) is not None
        )
        if (
            not spoken
            and not _GOES_ON.search(behind)
            and not _ELSE.search(between[: cue[0].start()])
        ):
            yield number


def _not_wanted(text: str, found: Found) -> Iterator[int]:
    """Places of which a text says that nothing is to be done there: "the panorama at [55, 0] is
    cancelled", "forget the drift at [100, 0]".
    """
    ends = [match.start() for match in SENTENCE.finditer(text)]
    for number, (_place, start, end) in enumerate(found):
        first = max(
            [0, *(stop for stop in ends if stop < start), *(other[2] for other in found[:number])]
        )
        last = min(
            [
                *(stop for stop in ends if stop >= end),
                *(other[1] for other in found[number + 1 :]),
                len(text),
            ]
        )
        before, behind = text[first:start], text[end:last]
        if (_FORGET.search(before) and not re.search(r"\bthere\b", text[end:], re.IGNORECASE)) or (
            _IS_OFF.match(behind) and not _TIMED.search(before + behind)
        ):
            yield number


def _taken(text: str, found: Found) -> Iterator[int]:
    """A place of which the next sentence or clause says that it is taken, with another one behind
    it.
    """
    for match in _TAKEN.finditer(text):
        before = [number for number, place in enumerate(found) if place[2] <= match.start()]
        behind = [place for place in found if place[1] >= match.end()]
        if (
            before
            and behind
            and "home" not in match[0].lower()
            and _SO.search(text, match.end(), behind[0][1])
            and not SENTENCE.search(text, match.end(), behind[0][1])
        ):
            yield before[-1]


def _left_out(text: str, found: Found) -> Iterator[int]:
    """One of the only list of three or more places that is left out by its number or its side."""
    rows = [[0]] if found else []
    for number, (one, two) in enumerate(pairwise(found), start=1):
        if _BETWEEN.fullmatch(text[one[2] : two[1]]):
            rows[-1].append(number)
        else:
            rows.append([number])
    rows = [row for row in rows if len(row) > 2]
    said = list(_ONE_OF.finditer(text))
    if len(rows) != 1 or len(said) != 1:
        return
    chosen = index_of(said[0]["which"].lower(), [found[number][0] for number in rows[0]])
    if chosen is not None:
        yield rows[0][chosen]


def index_of(word: str, places: Sequence[Position]) -> int | None:
    """Which of some places a word means: "middle", "second", "northernmost", "nearest"."""
    numbers = {"first": 0, "second": 1, "third": 2, "fourth": 3, "last": len(places) - 1}
    if word in numbers:
        return numbers[word] if numbers[word] < len(places) else None
    if word == "middle":
        return len(places) // 2 if len(places) % 2 else None
    axis = {"north": (1, 1), "south": (1, -1), "east": (0, 1), "west": (0, -1)}.get(
        re.sub(r"ern(?:most)?$", "", word)
    )
    if axis:
        values = [place[axis[0]] * axis[1] for place in places]
    else:
        values = [
            (place[0] ** 2 + place[1] ** 2) * (-1 if word == "nearest" else 1) for place in places
        ]
    best = max(values)
    return values.index(best) if values.count(best) == 1 else None
