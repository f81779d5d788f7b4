"""How task inputs word movements: the patterns by which rows of movements and the steps that
something runs in are read, on text in small letters.
"""

from __future__ import annotations

import re

GOTO, HOLD, FACE, NUDGE = "GoToXY", "StationKeep", "RotateToHeading", "NudgeYaw"
ARC, DRIFT, VISUAL, WAIT = "ArcTurn", "DriftWithCurrent", "VisualStationKeep", "WaitForStability"
KINDS = frozenset({GOTO, HOLD, FACE, NUDGE, ARC, DRIFT, VISUAL, WAIT})
_NO_NOUN = "".join(
    rf"(?<!{word} )"
    for word in [
        "the",
        "that",
        "this",
        "each",
        "every",
        "both",
        "first",
        "second",
        "third",
        "last",
        "two",
        "all",
        "in",
        "during",
    ]
)
_TIME = (
    r"(?:\d[\d.]*|an?|another|one|two|three|four|five|six|seven|eight|nine|ten|half|twelve|fifteen|twenty|thirty|forty|fifty|sixty|ninety|"
    r"the (?:given|planned|set|whole|full|next)|the(?= duration\b)|as long)[\w"
    r" ,.-]{0,25}?(?<![a-z])(?:seconds?|minutes?|hours?|sec|min|s|h|duration|time|"
    r"half a minute|quarter of an hour)\b(?! of (?:video|the|footage|buffer))"
)
_BOAT = (
    r"(?:the |a |an |her |him |it |you |your |yourself |boat |vessel |vehicle |usv |craft |she |as"
    r" if anchored )*"
)
_LAG = (
    r"(?:the |a |an |her |him |it |you |your |yourself |boat |vessel |vehicle |usv |craft |she |bow"
    r" |nose |heading |camera |view |round |"
    r"around |on the spot |in place )*"
)
MOVEMENTS: tuple[tuple[str, re.Pattern[str]], ...] = (
    (
        WAIT,
        re.compile(
            r"\b(?:wait|let|paus|hold on|hang on|mak|until|till|once|allow|giv)\w*\b[^.;,]{0,40}?\b(?:stead\w+|stable|stability|settl\w+|"
            r"calm\w*|pitch|roll|come to rest|motion|lies? still|rocking|"
            r"at rest|quiet)\b[^.;]{0,40}?(?=$|[.;,@]|\bthen\b|\band\b|\bwhile\b|\bwith\b)|\bsettl(?:e|es|ing)\b|\bsteady to\b|\bsteadiness\b"
        ),
    ),
    (
        VISUAL,
        re.compile(
            r"\b(?:keep|hold|lock|stay|get|centr|center|frame|fix|maintain|follow|track along|shadow|pursu|star|look)\w*\b[^.;]{0,60}?"
            r"\b(?:cent(?:red|ered|re of|er of|re|er)|in (?:the |its )?(?:picture|frame|view|image|middle)|mid-?frame|on screen|visually|"
            r"by camera|from leaving)\b"
            r"|\bvisually\b|\bcent(?:red|ered|ring|re the|er the)\b|\b(?:keep|hold|fix|lock)\w* the (?:camera|picture|frame|view|eye)\b|"
            r"\bvisual station\b|\bframe (?:the|q|\w+ and hold)\b|"
            r"\b(?:stare|lock(?:ed|ing)? on ?to)\b"
        ),
    ),
    (
        DRIFT,
        re.compile(
            rf"{_NO_NOUN}\b(?:drift(?:ing)?(?! no more)(?:[^.;,@]{{0,30}}(?:engines? (?:off|stopped)|current(?: takes? \w+)?|propulsion))?|float(?:ing)?|"
            rf"adrift)\b(?=\W*$|\W*[,.;:]|[ -](?:for|with|free|freely|in|until|till|while|and|then|passively|wherever|\d|at|as|[\w-]+ (?:s|"
            rf"sec|seconds|min|minutes|hours?))\b)|\b(?:cut|kill|stop|shut|switch|power|turn|take)\w* (?:down |off )?(?:the )?(?:engines?|"
            rf"motors?|propulsion|"
            rf"thrusters?|thrust|power)\b(?: and (?:then )?(?:drift\w*|float\w*))?(?: with the current)?|\bengines? (?:off|stopped)|"
            rf"\b(?:with|ride|rid\w+) the current\b|\bpropulsion off|\bwithout propulsion|\bno propulsion|\bcurrent takes? |\blet the (?:tide|"
            rf"current) (?:have|take|carry) (?:her|it|us|you|the boat)\b|\blet (?:her|it|the boat) float\b"
        ),
    ),
    (
        ARC,
        re.compile(
            rf"\b(?:sweeping|arc|wide) (?:turn|arc|curve)s?(?: (?:to|of) (?:port|starboard|the left|the right))?|{_NO_NOUN}\b(?:(?:sail|make|"
            rf"do|run|follow|drive|describe|turn|take|come round) )?(?:in |through )?(?:an |a )?"
            r"(?:arc|sweep|curv|bend)(?:s|e|es|ing)?\b(?!s?:| (?:the (?:bottom|view)|to|at \d|as|saved|logged))|\b(?:swing|turn|come round)(?:s|"
            r"ing)? [^.;@,]{0,40}?\b(?:on|with|at) (?:a )?(?:radius|\d[\d.]* ?(?:m|metres?|meters?)\b)|\b(?:quarter|half|full|"
            r"one) (?:a )?circle\b|\bswing wide\b"
        ),
    ),
    (
        FACE,
        re.compile(
            rf"\b(?:turn(?:s|ed|ing)?|rotat(?:e|es|ing)|pivot(?:s|ing)?|swing(?:s|ing)?|com(?:e|es|ing)|bring(?:ing)?|point(?:ing)?|"
            rf"put(?:ting)?|spin(?:ning)?|swivel|fac(?:e|es|ing)|look|square up|line up|"
            rf"go|going|tak(?:e|ing) up|set(?:ting)? the heading|chang(?:e|ing) (?:the )?heading|aim)\s+{_LAG}"
            r"(?:to|on|onto|towards?|up|until|facing|in)?\s*(?:face |a heading of |heading |bearing |the headings? |due |on )*"
            r"(?:\d{1,3}\b(?! ?(?:m|s|sec\w*|min\w*|metres?|meters?)\b)(?!\s?(?:°|degrees?)? (?:to |further to )?(?:the |your |her )?(?:left|right|port|"
            r"starboard|clockwise|anti|counter|back))|"
            r"(?:north|south|east|west)\w*(?:-\w+)*)|\bbow to (?!(?:the|its|her|your|this)\b)|"
            r"\bface (?:due|heading|one|two|three|zero|north|south|east|west|@)\b|\bturn to\b"
        ),
    ),
    (
        NUDGE,
        re.compile(
            rf"\b(?:(?:nudg|pan|twist|eas)(?:e|s|es|ning|ing)?\b(?! (?:of|on arrival))|yaw(?:ing)? (?=by\b|[^.;,]{{0,20}}(?:left|right|port|"
            rf"starboard|clockwise)))|\b(?:turn(?:s|ing)?|rotat(?:e|es|ing)|swing(?:s|ing)?|com(?:e|es|ing)|bring(?:ing)?|mov(?:e|ing)|"
            rf"correct(?:ing)?|adjust(?:ing)?|trim(?:ming)?|shift(?:ing)?|chang(?:e|ing)|offset(?:ting)?|tweak) {_LAG}(?:heading |yaw )?"
            r"(?:by |through )?[^.;,@]{0,40}?(?:degrees?|°|left|right|port|starboard|clockwise|anticlockwise|counter-?clockwise)\b|\bon the spot by\b|"
            r"\b(?:full|right) (?:turn|circle|round|rotation) on the spot|\brotation of\b"
        ),
    ),
    (
        HOLD,
        re.compile(
            rf"{_NO_NOUN}\b(?:hold(?:ing)?|keep(?:ing)?|maintain(?:ing)?|stay(?:ing)?|remain(?:ing)?|wait(?:ing)?|paus(?:e|ing)|"
            rf"stop(?:ping)?|station-?keep(?:ing)?|park|loiter|stand by|lie|sit)\s+{_BOAT}"
            rf"(?:position|station|put|there|here|still|steady|in place|in position|on station|on spot|on the spot|at the spot|where (?:you|"
            rf"it|we|she)|(?:with)?in(?:side)? (?:an? (?!fence|box|polygon|area|rectangle)|(?:no more than )?[\w.-]+ ?(?:m|met\w+|feet)\b)|"
            rf"it there|tight|the spot|"
            rf"the position|this position|for {_TIME}|{_TIME}|off the)|\b(?:do|make) a [\w .-]{{0,30}}(?:hold|stop|station keep)|\bloiter|"
            rf"\bstand by\b|\bstation[- ]keep\b|^\W*hold\W*$|"
            rf"(?:^\W*|, |(?<!ing )\band )hold(?=\W*$|[,;.])|\b(?:a|an|one) (?:(?!and )[\w.-]+ ){{0,3}}(?:hold|stop)\b|\bstay put\b|\bon the spot for\b|"
            rf"{_TIME} (?:on (?:the spot|station)|holding)\b(?: again)?|\b(?:sit|sitting) tight\b(?: for)?|\b(?:lie|stay) there\b"
        ),
    ),
    (
        GOTO,
        re.compile(
            r"(?:\b(?:go|going|driv\w+|head\w*|run\w*|steer\w*|proceed\w*|transit\w*|sail\w*|steam\w*|motor\w*|cruis\w+|mov\w+|travel\w*|"
            r"cross\w*|shift\w*|com(?:e|es|ing)|return\w*|approach\w*|"
            r"continu\w+|carry\w*|mak\w+|get\w*|bring\w*|tak\w+|set|navigat\w+|reach\w*|leav\w+|position\w*|clos\w+|back|out|up|on|over|"
            r"pass\w*|visit\w*|start|begin|stop short)"
            r"(?: (?:on|over|in|out|up|back|off|straight|directly|way|your|course|for|to|the|a|boat|vessel|vehicle|usv|craft|her|it|"
            r"yourself|point|waypoint|position|at|via|through|past|first|down|again|short|pair|towards|parallel)){0,7} @)"
            r"|\b(?:to|for|via|into) @|^\W*@|(?<=[,:;] )@|"
            r"\b(?:go|going|head\w*|come|coming|return\w*|back|sail\w*|driv\w+|run|then|steer\w*|transit\w*|(?<!out )and|finally|lastly|to|"
            r"at) (?:back |straight |over |to |directly |its |her )*(?:home|base)\b|^\W*home\b|, home\b|"
            r"\b(?:go|going|driv\w+|head\w*|run\w*|steer\w*|proceed\w*|transit\w*|sail\w*|mov\w+|com(?:e|es|ing)|return\w*|approach\w*|"
            r"continu\w+|make for|get (?:over |back |on )?to|reach\w*|back|make|ease over|dock at|go alongside|berth at) "
            r"(?:on |over |to |back |in |out |straight |directly |for )*(?:the |its )(?:\w+ )?(?:target|goal|start\w*|centre|center|berth|"
            r"dock|position|point|middle|cable|\w+ point|\w+ position)\b|"
            r"(?:^\W*|, |\band |\bthere )to the (?:\w+ )?(?:target|goal|start\w*|centre|center|berth|dock|\w+ point|\w+ position)\b|"
            r"\b(?:run|move|go|drive|sail|follow)\b(?! (?:an? |the )?(?:gps|ocr|lens|image|detector|tracker|object|position|geotag|quality|sonar))[^.;,]{0,25}?"
            r"\b\d+ ?(?:m|metres?|meters?|km|kilomet\w+)\b|"
            r"\b(?:run|cover|mow|drive|survey|sweep|follow|track(?= the cable)|inspect|work|make)(?:s|e|ing)?\b[^.;,]{0,40}?\b(?:grid|"
            r"lawn-?mower|squares?|lanes?|area|transect|cable|track|line|target|pass|waypoints|points|sides)\b|"
            r"\bwhere (?:it|the target) was\b|^\W*(?:the )?(?:start|goal|target|(?:start|goal|target) (?:point|position))\W*$"
        ),
    ),
)
"""What speaks of a movement; where two of them overlap, the former holds."""

# What a text is rid of before
QUOTED = re.compile(r"(?<![\w])['\"‘“][^'\"’”]{1,40}['\"’”]")
SENSORS = re.compile(
    r"\b(?:thermal|infrared) (?=stream|feed|view|channel)|\b(?:the"
    r" )?(?:(?!stream|feed|view|check|lens)[\w-]+ )?(?:camera|"
    r"cam)(?: ?(?:[a-z]|\d+))?\b|\b[a-z]+_?\w*cam\b|\bcam[\w-]*\d\b|(?<=from )the (?:[\w-]+"
    r" )?(?:sonar|lidar|sounder)|"
    r"(?<=from )(?:sonar|lidar)_?\w*"
)
COUNTED = re.compile(
    r"(?:steps?|parts?|stages?|legs?|lines?|headings?|bearings|through|first|last|face|facing|turn"
    r" to|bow to) (?:\d+, )*$",
    re.IGNORECASE,
)
"""What stands before numbers that are no place."""
