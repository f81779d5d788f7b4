"""Text values that an input says behind the words for a skill, to their end: "thermal stats of the
ladder rungs", "pixel error to the hatch cover".

A value is read where one phrase follows such words and its end is plain: the end of the clause, or
a word that no name goes on with. It is enforced where the skill is spoken of in as many sentences
as values are read.
"""

from __future__ import annotations

import functools
import re
from collections.abc import Collection, Sequence

from planner_ft.decoding.constraints.reading import LONGEST
from planner_ft.decoding.constraints.reading.skills.evidence import mentions, words_for
from planner_ft.decoding.constraints.reading.values.named_values import DOUBT, IDENTIFIER, SEVERAL
from planner_ft.vocabulary import Vocabulary

_FUNCTION = (
    r"(?:and|or|at|in|on|to|of|for|from|by|with|while|during|until|till|then|only|also|as|it|its|them|this|that|these|those|there|here|is|are|be|was|has|all|"
    r"both|each|every|throughout|too|well|not|no|nor|off|again|afterwards|meanwhile|please|pls|thx|over|under|out|now|which|what|where|when|whenever|the|a|an|"
    r"any|some|your|our|her|his|their|my|one|ones|other|others|same|first|second|third|last|once|but|after|before|along|into|alone|just|via|within|between|"
    r"steady|centred|centered|read|logged|tracked|recorded|recording|checked|measured|taken|watched|registered|noted|saved|active|selected|kept|held|wanted|"
    r"monitored|followed|observed|sought|inspected|verified|rated|calculated|scanned|fitted|filmed|running|visible|in-between|how|whether|"
    r"clean|clear|dry|dirty|usable|legible|drive|home|up|onward|if|i|you|we|she|he|they|given|task|task's|stated|target|feature|object|contact|using|per|minus|plus|so|because)"
)
_WORD = rf"(?!{_FUNCTION}(?![\w'’-]))(?:[A-Za-z][\w'’-]*|\d+(?=[\s.,;:!?)]|$)|{IDENTIFIER})"
_NAME = rf"(?:the |an? |our )?(?P<v>{_WORD}(?: {_WORD}){{0,4}})"
_VERB = (
    r"(?:log|get|take|check|keep|save|read|record|measure|drop|register|run|verify|tell|switch|select|detect|mark|hold|turn|then|stay|go|return|monitor|write|"
    r"note|have|let|set|put|do|use|give|pass|stop|end|come|face|wait|drift|look|film|mind|avoid|respect|lock|leave|also|\w+ing)"
)
_END = (
    r"(?=[.;,!?)]|$| (?:only|alone|in(?! (?:the"
    r" )?(?:picture|frame|image|view|water|centre|middle))|on|at|during|while|when|throughout|all|"
    r"then|for|as|with|over|until|till|to|too|please|by|under|after|before|once|along|"
    rf"every|each|both|but|is|are|has|from|steady|centred|read|logged|tracked|recorded|checked|measured|taken|watched|monitored|"
    rf"(?:as well )?and (?:then )?{_VERB})(?![\w-]))"
)
_CLAUSE = r"(?=[.;,!?)]|$)"
_SENSOR = rf"{_NAME}{_END}"
_PATTERNS: dict[tuple[str, str], tuple[str, ...]] = {
    ("GetThermalStats", "roi"): (
        (
            r"(?:thermal|temperature|heat) (?:stats|statistics|figures) (?:of|for|from|on|over)"
            rf" {_NAME}{_END}"
        ),
        rf"temperatures? (?:of|on|at) {_NAME}{_END}",
    ),
    ("CheckPlanarity", "roi"): (
        rf"(?:whether|if) {_NAME} is (?:flat|curved|even|planar|straight)\b",
        rf"\bis {_NAME} (?:flat|curved)\b",
        rf"(?:planarity|flatness)(?: check)? (?:of|on|for|over) {_NAME}{_END}",
        rf"check(?:ing)? {_NAME} for flatness\b",
    ),
    ("OCRScanning", "region"): (
        rf"(?:text|lettering|writing|letters|ocr) (?:on|in|of) {_NAME}{_END}",
    ),
    ("DetectSonarFeature", "type"): (
        (
            r"sonar(?: display)?(?: (?:search|look|looking|searching|watch|out|on|detection))?"
            rf" (?:for|after) (?:any )?{_NAME}{_END}"
        ),
        (
            r"on the sonar(?: display)?,? (?:i am|we"
            r" are|i'm|we're|look|search|watch|seek|looking|searching)(?: out)? (?:for|after)"
            rf" (?:any )?{_NAME}{_END}"
        ),
    ),
    ("CalculateVisualOffset", "target_id"): (
        (
            r"(?:pixel|visual) (?:error|offset|distance)s?(?: from (?:the )?(?:image |picture"
            rf" |frame )?cent(?:re|er))? (?:of|to) {_NAME}{_END}"
        ),
    ),
    ("GetRelativePose", "target"): (
        rf"(?:relative pose|pose relative|pose readings|pose) (?:to|of) {_NAME}{_END}",
    ),
    ("TrackObjects", "object_id"): (
        rf"tracker (?:follows|on|stays on|following|follow|keeps|holds|keeps to) {_NAME}{_END}",
        rf"(?:identity of|tabs on|tracking of) {_NAME}{_END}",
    ),
    ("VisualStationKeep", "target_id"): (
        (
            rf"\b(?:keep|hold|keeping|holding|centre) {_NAME} (?:centred|centered|in the"
            r" (?:centre|center|middle|picture|frame))\b(?! (?:centred|steady))"
        ),
        (
            rf"(?:^|[.;] ){_NAME} (?:stays|is kept|is to stay|remains) in (?:the"
            r" )?(?:centre|center|middle) of (?:the )?(?:frame|picture|image|view)\b"
        ),
    ),
    ("CheckLensClearness", "camera_id"): (rf"lens(?:es)? (?:of|on) {_SENSOR}",),
    ("GetImageQualityMetrics", "camera_id"): (
        rf"(?:image|picture|video|frame) quality (?:of|on|from) {_SENSOR}",
        rf"usability of the (?:frame|picture|image|video) (?:on|of|from) {_SENSOR}",
    ),
    ("SelectActiveStream", "stream_id"): (
        rf"(?:switch(?:ing)?|change|turn the view) (?:over )?to {_SENSOR}",
        rf"active (?:camera|stream)(?: all the time)? is {_SENSOR}",
    ),
    ("SetStreamRecording", "sensor_id"): (
        rf"\brecording (?:of|from|by|on for) {_SENSOR}",
        (
            rf"\b(?:write|record|store) {_NAME} (?:to disk|under (?:the )?(?:file )?tag|with"
            r" (?:file )?tag)\b"
        ),
    ),
    ("SetStreamRecording", "file_tag"): (
        rf"(?:file )?tag(?:ged)?(?: as| is|:|,)? (?P<v>{IDENTIFIER}){_END}",
        (
            r"\b(?:recording|record|disk|film)\b[^.;]{0,60} (?:under|as) (?:the )?(?:file"
            rf" )?(?:tag |name )?(?P<v>{IDENTIFIER}){_END}"
        ),
    ),
    ("CaptureGeoSnapshot", "note"): (
        (
            r"\b(?:stills?|pictures?|photos?|snapshots?|frames?)\b[^.;]{0,40}\bnote(?: is|:|,)?"
            rf" {_NAME}{_CLAUSE}"
        ),
    ),
    ("CaptureGeoSnapshot", "sensor_id"): (
        rf"\b(?:stills?|pictures?|photos?|snapshots?|frames?)(?: with position)?"
        rf" (?:from|with|by|through|on|off) (?:the )?(?:camera |sensor )?"
        rf"(?P<v>{IDENTIFIER}){_END}",
    ),
    ("CreateMapMarker", "label"): (
        rf"\blabel(?:led)?(?: as| is|:|,)? {_NAME}{_CLAUSE}",
        (
            r"\b(?:pin|mark)(?:ning|ing)? (?:the |this |that |its"
            rf" )(?:spot|place|position|point|location)(?: on the map)? as {_NAME}{_CLAUSE}"
        ),
        rf"(?:marker|pin) (?:named|called|labelled) {_NAME}(?:{_CLAUSE}|(?= and {_VERB}\b))",
    ),
    ("RegisterObservation", "observation"): (
        rf"\bregister(?:ing)? {_NAME} as (?:the|an) observation\b",
    ),
    ("GetSeabedDepth", "sensor_id"): (
        rf"depths?(?: under the (?:vehicle|boat|keel))? (?:from|by|with|using|off) {_SENSOR}",
        rf"with {_NAME} as (?:the )?depth sensor\b",
    ),
    ("GetHorizonAngle", "sensor_id"): (
        (
            r"(?:horizon (?:tilt|angle)|tilt of the horizon|its tilt)(?: with| from| by| off|"
            rf" using) {_SENSOR}"
        ),
    ),
}
"""What stands before a value, by skill and parameter, and ends it."""
_KIND_BEFORE = re.compile(
    r"^(?:camera|sensor|stream|cloud|region|object|target|frame|roi|feature|type|sounder|sonde)"
    rf" (?={IDENTIFIER}$)",
    re.IGNORECASE,
)
"""A word for the kind before an identifier is no part of it."""
_NO_NAME = re.compile(
    r"(?:camera|cameras|sensor|stream|region|roi|surface|frame|picture|image|way|target|feature|object|view|light|vessel|boat|position|place|spot|log|boat's)"
    r"|(?:marker|contact|roi|region|target|vessel|ship|sensor|camera|stream|cloud|object|feature|type|sounder|sonde|file) .*|"
    r"beginning|end|start|middle|rest|x \d.*|.*[- ]named\b.*|position fix|\d+(?:\.\d+)?(?:"
    r" ?(?:s|sec\w*|min\w*|m|met\w+)\b.*)?",
    re.IGNORECASE,
)
"""What is the word for a kind, or may or may not have one before its name."""
_LIKEWISE = re.compile(
    r"\bthe same (?:from|for|of|with|on|in)\b|\bsame again\b|\bthe same thing\b|\brather\b|,"
    r" no\b|\bin (?:leg |part )?one, |"
    r"\b(?:last|first|second) of (?:the|these|them|those)\b",
    re.IGNORECASE,
)
_NEAR = 20
"""Characters beside a value's words within which the skill is not spoken of once more."""
_VISUAL = re.compile(
    r"\bcent(?:re|er)\w*|\b(?:frame|picture|view|image|visual\w*)\b", re.IGNORECASE
)
"""Words for the movement that keeps a target in the picture."""


def read_described_values(
    text: str, spoken: Collection[str], vocabulary: Vocabulary
) -> dict[tuple[str, str], frozenset[str]]:
    """By skill and parameter what its value is one of, where every sentence that speaks of the
    skill says it plainly.
    """
    if len(text) > LONGEST or DOUBT.search(text) or SEVERAL.search(text):
        return {}
    if _LIKEWISE.search(text):
        return {}
    said: dict[str, dict[str, list[re.Match[str]]]] = {}
    for (name, parameter), patterns in _PATTERNS.items():
        if (
            name in spoken
            and name in vocabulary.skill
            and parameter in {item.name for item in vocabulary.skill[name].parameters}
        ):
            matches = [match for pattern in patterns for match in _compiled(pattern).finditer(text)]
            if matches:
                said.setdefault(name, {})[parameter] = matches
    return {
        (name, parameter): frozenset(values)
        for name, having in said.items()
        if not _spoken_elsewhere(
            text, name, [match for matches in having.values() for match in matches]
        )
        for parameter, matches in having.items()
        if len(matches) >= (mentions(text, name) or 1)
        and (values := _values(matches))
        and (parameter != "camera_id" or all(_CAMERA.search(value) for value in values))
    }


def _values(matches: Sequence[re.Match[str]]) -> set[str]:
    """The values of some matches; nothing where one of them is none."""
    found = {_KIND_BEFORE.sub("", match["v"]) for match in matches}
    return set() if any(_NO_NAME.fullmatch(value) for value in found) else found


_CAMERA = re.compile(rf"cam|feed|stream|eye|\b{IDENTIFIER}$", re.IGNORECASE)
"""What the name of a camera has."""


def _spoken_elsewhere(text: str, name: str, matches: Sequence[re.Match[str]]) -> bool:
    """Whether words for a skill stand apart from those that its values were read at."""
    pattern = _VISUAL if name == "VisualStationKeep" else words_for(name)
    spans = [(match.start() - _NEAR, match.end() + _NEAR) for match in matches]
    return any(
        not any(start <= word.start() < end for start, end in spans)
        for word in pattern.finditer(text.lower())
    )


@functools.cache
def _compiled(pattern: str) -> re.Pattern[str]:
    return re.compile(pattern, re.IGNORECASE)
