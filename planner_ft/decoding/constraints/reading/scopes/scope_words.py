"""How task inputs word skills, movements and the steps that something runs in: the patterns by which `scopes` reads them."""

from __future__ import annotations

import re

LAST = -1


def _words(pattern: str) -> re.Pattern[str]:
    return re.compile(rf"\b(?:{pattern})\b")


# ---------------------------------------------------------------- skills
_LENS = r"lens(?:es)?\b|droplets?|the glass of|drops? on"
_PICTURE = r"(?:image|picture|video|frame)s?(?:'s)?"
SKILL_WORDS = {
    "LockHeading": _words(
        r"(?:bow|heading|nose|yaw)(?: \w+){0,4}? (?:lock(?:ed)?|held|fixed|where it (?:is|points)|steady|on its heading|must not change|stays|free)|"
        r"(?:lock|fix|hold|keep|freeze|pin|maintain|leav)\w* (?:your |the |its |her |this |a )?(?:present |same |current )?(?:bow|heading|nose)\b|"
        r"(?:heading|bow)[- ]?(?:lock|hold)|(?:locked|fixed) (?:bow|heading)|the lock|same way|the bow swing|unlocked|locking"
    ),
    "ObstacleAvoidance": _words(
        r"clearances?|margins?|obstacle avoidance|collision avoidance|(?:avoid|dodge|clear of|away from|off) (?:all )?(?:obstacles?|"
        r"everything|anything)|"
        r"(?:metres?|meters?|feet|m) (?:\w+ )?(?:clear|off|away|of room|of space|between)|keep\w* clear|stay\w* clear|steer\w* clear|"
        r"safe(?:ty)? (?:distance|gap)|your distance|no closer|no nearer|closer than|nearer than|not within|go within|berth of|no less than|avoid\w*|"
        r"(?:give|giving) (?:everything|all|anything)|(?<!to )(?<!far )(?<!nearest )(?<!range )obstacles|room to|to spare|(?:will|"
        r"would) (?:have to )?do|is enough"
    ),
    "BoundaryEnforcement": _words(
        r"(?:geo)?-?fence[ds]?|boundar\w+|polygon|limits?|stay\w* (?:inside|within|in)\b|(?:keep|remain)\w* (?:inside|within|in\b)|"
        r"not (?:to )?leave|box|"
        r"permitted area|outside|perimeter|square around|area bounded|inside"
    ),
    "DetectObjects": _words(
        r"detect\w*|detector|look(?:ing|ed)? (?:out |around )?for|look-?out|search\w* (?:\w+ ){0,3}for|watch\w* (?:out |for)|"
        r"scan\w* for|eyes? (?:out|open)|spot(?:ting)? |"
        r"check\w* for|watch for|find (?:any|the|a)\b|seek\w*|identif\w+|make out|hunt\w*|locate (?:the|a) (?!hot)|objects in view|"
        r"in view|report any|keep\w* watch|pick\w* out|flag(?:ging)? any|see if there"
    ),
    "TrackObjects": _words(r"track(?:ed|er|ers|ing|s)?(?! length| \d)|identit\w+|tabs on"),
    "OCRScanning": _words(
        r"ocr\w*|text|lettering|writing|written|letters|inscription|read(?:ing)? (?:off |out )|markings?|what it says|transcrib\w*|"
        r"decipher\w*|characters|lettered|read by"
    ),
    "GetThermalStats": _words(r"thermal\w*|temperatures?|infrared|thermally|how (?:hot|warm)|warmth|heat stat\w*"),
    "LocateHotspot": _words(
        r"hot[- ]?(?:spot|point)s?|hottest|warmest|hotter|warmer|heat\b|anything (?:above|over)|whatever is (?:above|over)|find whatever|"
        r"(?:located|locate) anything"
    ),
    "CheckLensClearness": re.compile(rf"\b(?:{_LENS}|lens-?\w*|water drops|spray|dirt|glass)\b"),
    "GetImageQualityMetrics": re.compile(
        rf"\b(?:{_PICTURE} quality|quality|usab\w+|rat(?:e|ing) the|scor(?:e|ing) the|how good|sharp\w*|video frame|good enough|"
        rf"{_PICTURE}(?: from (?:the )?(?:\w+ )?cam)? (?:is|are))\b"
    ),
    "CalculateVisualOffset": _words(
        r"offsets?|pixel\w*|off[- ]cent(?:re|er)|from the (?:image |picture |frame )?cent(?:re|er)|image cent(?:re|er)|visual error"
    ),
    "GetSectorDistance": _words(
        r"sectors?|(?:minimum|shortest|smallest|least) (?:lidar )?(?:distance|range)|closest return|nearest return|how close|in that slice|"
        r"lidar (?:minimum|min)|min\.? (?:lidar )?(?:distance|range)|(?:query|check) the lidar|lidar distance(?! to)"
    ),
    "DistanceToObstacle": _words(
        r"(?:obstacle|wall) (?:distance|ranging|range)s?|(?:distance|range|ranging|far|readings)\b.{0,25}\b(?:obstacles?|ahead|wall|"
        r"structure|in front)|"
        r"how far|range (?:the |ahead|obstacles)|ranging|field of view|distance ahead"
    ),
    "FitCylinderModel": _words(r"cylind\w+|curve in|large curve"),
    "CheckPlanarity": _words(r"planar\w*|flat\w*|curvature|or curved|unevenness"),
    "DetectSonarFeature": _words(r"sonar\w*|blobs"),
    "GetSeabedDepth": _words(r"depths?|soundings?|how deep|sound(?:ing|s)? the (?:bottom|depth)|sounders?|echo ?sounder"),
    "GetHorizonAngle": _words(r"horizons?|tilt\w*|how level|level the|horizontal"),
    "GetGPSLocation": _words(
        r"gps(?! accuracy| quality| check| error)|gnss|fix(?:es)?|(?:log|record|note|position|save|check|determine|read|take|"
        r"get)\w* (?:the |your |its |own )?(?:current )?(?:gps )?positions?(?! hold)|"
        r"position(?:s)? (?:is |are |be |to be )?(?:logged|logging|log|noted|recorded|fix\w*|read\w*)|coordinates|the track|"
        r"own position|the position(?= (?:on|in|at|while|during|for|as)\b|,)|^\W*position(?=:| (?:on|in|at|while|during)\b)"
    ),
    "SelectActiveStream": _words(
        r"active|(?<!store the )(?<!record the )stream\w*|feed\w*|switch\w*(?! (?:the )?(?:recording|engine|heading|object|off))|"
        r"select\w*|activat\w+|(?<!field of )view (?:on|over|through)|in use|on screen|on (?:the )?display|channel \w+|the \w+ view|"
        r"(?:go|change|chang\w+|going) (?:over )?to (?:the )?(?:cam\w*|\w+[_ ]cam\w*)|use cam\w*|(?<!field of )view"
    ),
    "SetStreamRecording": _words(
        r"(?<!environment )(?<!environmental )record(?:s|ed|ing|ings|er)?\b(?! (?:an? |the |your |any |all )?(?:observation|gps|"
        r"position|depth|water|seabed|environment\w*|horizon|tilt|temperature\w*|thermal|lidar (?:sl|pr|sw)|2d|sector|obstacle|distance|"
        r"wind|weather|conditions|state|current pos|geotagged|q\b|pose|fix))|run cam|cam running|film\w*|footage|video(?! buffer|"
        r" quality| frame)|to disk|shoot\w*|store the (?:stream|data)|run the camera|(?:let|have) (?:the )?[\w-]+(?: [\w-]+)? (?:run|"
        r"record)|tape\w*|tagged|file tag|(?<!detector )(?<!tracker )(?<!ocr )(?<!detection )runs"
    ),
    "BufferLoopCapture": _words(
        r"buffer\w*|(?:last|past|recent|latest) (?:[\w.]+ ){1,5}?(?:saved|kept|captured|of video|seconds|minutes|sec|min|s|of footage)|"
        r"loop|clip|recent"
    ),
    "CaptureGeoSnapshot": _words(
        r"snap\w*|stills?|photo\w*|geo-?tagged|geo-?ref\w*|pictures?(?: with| taken| from)|geotag(?! quality)|geo-?snapshots?|images?(?: with)|shots?"
    ),
    "LogLidarSlice": _words(
        r"(?<!check the )(?<!query the )lidar (?:slices?|profiles?|sweeps?|scan|log|cut|logging)|"
        r"(?<!in that )(?<!in the )(?<!lidar )slices?|profiles?|laser|2d"
    ),
    "LogEnvironmentState": _words(r"environment\w*|env|wind and|weather|conditions|surroundings|sea state"),
    "GetRelativePose": _words(r"poses?|relative (?:to|position)|attitude (?:to|relative)"),
    "VerifyGeotagQuality": _words(
        r"gps (?:accurac\w+|error)|accurac\w+|accurate|geotag quality|geotag\w*(?: \w+)? (?:quality|accurac\w+)|gps (?:is|quality)|"
        r"quality of the (?:gps|geotag)|geotags?"
    ),
    "CreateMapMarker": _words(r"pins?|pinn\w+|markers?|mark(?:ing|ed|s)? (?:the|this|it|on|a|q)|place ?marks?|map\b|mark\b"),
    "RegisterObservation": _words(
        r"observ\w+|regist\w+|not(?:e|ing|ed) (?:as|q|that|in the log)|log entr\w+|enter\w* (?:the|q|an|in)|add(?:ing|ed)? q|finding|"
        r"entry|q (?:in|to|as an)\b|into the log|(?:store|log) q|note"
    ),
}
"""Words that speak of a skill. Better one too many: a skill that is spoken of elsewhere as well is held to less."""
NEGATED = re.compile(
    r"(?:\b(?:no|without|not|nor|neither|nothing|never mind|don't|do not|need no|stop\w*|leave|instead of|in place of|in lieu of|off|skip\w*|except|"
    r"rather than)(?: (?:a|an|any|the|that|this|be|run|take|keep|get|check|"
    r"further|other|more|second|map|geotagged|safety|heading|bow|gps|lidar|position|image|object|obstacle|need|use|log|do|measure|"
    r"record|confirm|verify))* ?)$"
)
FREE = re.compile(r"\bfree\b|unlocked")
CHANGED = re.compile(
    r"\b(?:i|we) (?:said|asked|told|wanted|wrote)\b|\bmake (?:that|it) (?:the|both|all|one|two)\b|\bcorrection\b|\bno, (?:while|on|in|at|during|the|only)\b|"
    r"\btake (?:that|it) back\b|\b(?:two|three|four|five|six|[2-6]) (?:stops|halts|pauses|waits) of\b|"
    r"\bas (?:at|on|in) (?:the )?(?:@|\d|first|second)|\bnothing of the sort|\b(?:arriving|waiting|leaving),|\bi mean\b|\brather not\b"
)
"""Words of texts that take a scope back, give it by what was said of another step, or by single words."""
LAPSED = re.compile(
    r"^\W{0,2}(?:is |are |\w+ )?(?:not |no longer|needn't|need not|may (?:be )?\w* ?(?:swing|free)|free|off\b|lifted|unlocked|does not|"
    r"do not|isn't|aren't|quiet|no more|stays off|has been|"
    r"can wait|is for later|excluded)"
)

# ---------------------------------------------------------------- movements
GOTO, HOLD, FACE, NUDGE = "GoToXY", "StationKeep", "RotateToHeading", "NudgeYaw"
ARC, DRIFT, VISUAL, WAIT = "ArcTurn", "DriftWithCurrent", "VisualStationKeep", "WaitForStability"
KINDS = frozenset({GOTO, HOLD, FACE, NUDGE, ARC, DRIFT, VISUAL, WAIT})
_NO_NOUN = "".join(
    rf"(?<!{word} )" for word in ["the", "that", "this", "each", "every", "both", "first", "second", "third", "last", "two", "all", "in", "during"]
)
_TIME = (
    r"(?:\d[\d.]*|an?|another|one|two|three|four|five|six|seven|eight|nine|ten|half|twelve|fifteen|twenty|thirty|forty|fifty|sixty|ninety|"
    r"the (?:given|planned|set|whole|full|next)|the(?= duration\b)|as long)[\w ,.-]{0,25}?(?<![a-z])(?:seconds?|minutes?|hours?|sec|min|s|h|duration|time|"
    r"half a minute|quarter of an hour)\b(?! of (?:video|the|footage|buffer))"
)
_BOAT = r"(?:the |a |an |her |him |it |you |your |yourself |boat |vessel |vehicle |usv |craft |she |as if anchored )*"
_LAG = (
    r"(?:the |a |an |her |him |it |you |your |yourself |boat |vessel |vehicle |usv |craft |she |bow |nose |heading |camera |view |round |"
    r"around |on the spot |in place )*"
)
MOVEMENTS: tuple[tuple[str, re.Pattern[str]], ...] = (
    (WAIT, re.compile(
        r"\b(?:wait|let|paus|hold on|hang on|mak|until|till|once|allow|giv)\w*\b[^.;,]{0,40}?\b(?:stead\w+|stable|stability|settl\w+|"
        r"calm\w*|pitch|roll|come to rest|motion|lies? still|rocking|"
        r"at rest|quiet)\b[^.;]{0,40}?(?=$|[.;,@]|\bthen\b|\band\b|\bwhile\b|\bwith\b)|\bsettl(?:e|es|ing)\b|\bsteady to\b|\bsteadiness\b"
    )),
    (VISUAL, re.compile(
        r"\b(?:keep|hold|lock|stay|get|centr|center|frame|fix|maintain|follow|track along|shadow|pursu|star|look)\w*\b[^.;]{0,60}?"
        r"\b(?:cent(?:red|ered|re of|er of|re|er)|in (?:the |its )?(?:picture|frame|view|image|middle)|mid-?frame|on screen|visually|"
        r"by camera|from leaving)\b"
        r"|\bvisually\b|\bcent(?:red|ered|ring|re the|er the)\b|\b(?:keep|hold|fix|lock)\w* the (?:camera|picture|frame|view|eye)\b|"
        r"\bvisual station\b|\bframe (?:the|q|\w+ and hold)\b|"
        r"\b(?:stare|lock(?:ed|ing)? on ?to)\b"
    )),
    (DRIFT, re.compile(
        rf"{_NO_NOUN}\b(?:drift(?:ing)?(?! no more)(?:[^.;,@]{{0,30}}(?:engines? (?:off|stopped)|current(?: takes? \w+)?|propulsion))?|float(?:ing)?|"
        rf"adrift)\b(?=\W*$|\W*[,.;:]|[ -](?:for|with|free|freely|in|until|till|while|and|then|passively|wherever|\d|at|as|[\w-]+ (?:s|"
        rf"sec|seconds|min|minutes|hours?))\b)|\b(?:cut|kill|stop|shut|switch|power|turn|take)\w* (?:down |off )?(?:the )?(?:engines?|"
        rf"motors?|propulsion|"
        rf"thrusters?|thrust|power)\b(?: and (?:then )?(?:drift\w*|float\w*))?(?: with the current)?|\bengines? (?:off|stopped)|"
        rf"\b(?:with|ride|rid\w+) the current\b|\bpropulsion off|\bwithout propulsion|\bno propulsion|\bcurrent takes? |\blet the (?:tide|"
        rf"current) (?:have|take|carry) (?:her|it|us|you|the boat)\b|\blet (?:her|it|the boat) float\b"
    )),
    (ARC, re.compile(
        rf"\b(?:sweeping|arc|wide) (?:turn|arc|curve)s?(?: (?:to|of) (?:port|starboard|the left|the right))?|{_NO_NOUN}\b(?:(?:sail|make|"
        rf"do|run|follow|drive|describe|turn|take|come round) )?(?:in |through )?(?:an |a )?"
        r"(?:arc|sweep|curv|bend)(?:s|e|es|ing)?\b(?!s?:| (?:the (?:bottom|view)|to|at \d|as|saved|logged))|\b(?:swing|turn|come round)(?:s|"
        r"ing)? [^.;@,]{0,40}?\b(?:on|with|at) (?:a )?(?:radius|\d[\d.]* ?(?:m|metres?|meters?)\b)|\b(?:quarter|half|full|"
        r"one) (?:a )?circle\b|\bswing wide\b"
    )),
    (FACE, re.compile(
        rf"\b(?:turn(?:s|ed|ing)?|rotat(?:e|es|ing)|pivot(?:s|ing)?|swing(?:s|ing)?|com(?:e|es|ing)|bring(?:ing)?|point(?:ing)?|"
        rf"put(?:ting)?|spin(?:ning)?|swivel|fac(?:e|es|ing)|look|square up|line up|"
        rf"go|going|tak(?:e|ing) up|set(?:ting)? the heading|chang(?:e|ing) (?:the )?heading|aim)\s+{_LAG}"
        r"(?:to|on|onto|towards?|up|until|facing|in)?\s*(?:face |a heading of |heading |bearing |the headings? |due |on )*"
        r"(?:\d{1,3}\b(?! ?(?:m|s|sec\w*|min\w*|metres?|meters?)\b)(?!\s?(?:°|degrees?)? (?:to |further to )?(?:the |your |her )?(?:left|right|port|"
        r"starboard|clockwise|anti|counter|back))|"
        r"(?:north|south|east|west)\w*(?:-\w+)*)|\bbow to (?!(?:the|its|her|your|this)\b)|"
        r"\bface (?:due|heading|one|two|three|zero|north|south|east|west|@)\b|\bturn to\b"
    )),
    (NUDGE, re.compile(
        rf"\b(?:(?:nudg|pan|twist|eas)(?:e|s|es|ning|ing)?\b(?! (?:of|on arrival))|yaw(?:ing)? (?=by\b|[^.;,]{{0,20}}(?:left|right|port|"
        rf"starboard|clockwise)))|\b(?:turn(?:s|ing)?|rotat(?:e|es|ing)|swing(?:s|ing)?|com(?:e|es|ing)|bring(?:ing)?|mov(?:e|ing)|"
        rf"correct(?:ing)?|adjust(?:ing)?|trim(?:ming)?|shift(?:ing)?|chang(?:e|ing)|offset(?:ting)?|tweak) {_LAG}(?:heading |yaw )?"
        r"(?:by |through )?[^.;,@]{0,40}?(?:degrees?|°|left|right|port|starboard|clockwise|anticlockwise|counter-?clockwise)\b|\bon the spot by\b|"
        r"\b(?:full|right) (?:turn|circle|round|rotation) on the spot|\brotation of\b"
    )),
    (HOLD, re.compile(
        rf"{_NO_NOUN}\b(?:hold(?:ing)?|keep(?:ing)?|maintain(?:ing)?|stay(?:ing)?|remain(?:ing)?|wait(?:ing)?|paus(?:e|ing)|"
        rf"stop(?:ping)?|station-?keep(?:ing)?|park|loiter|stand by|lie|sit)\s+{_BOAT}"
        rf"(?:position|station|put|there|here|still|steady|in place|in position|on station|on spot|on the spot|at the spot|where (?:you|"
        rf"it|we|she)|(?:with)?in(?:side)? (?:an? (?!fence|box|polygon|area|rectangle)|(?:no more than )?[\w.-]+ ?(?:m|met\w+|feet)\b)|"
        rf"it there|tight|the spot|"
        rf"the position|this position|for {_TIME}|{_TIME}|off the)|\b(?:do|make) a [\w .-]{{0,30}}(?:hold|stop|station keep)|\bloiter|"
        rf"\bstand by\b|\bstation[- ]keep\b|^\W*hold\W*$|"
        rf"(?:^\W*|, |(?<!ing )\band )hold(?=\W*$|[,;.])|\b(?:a|an|one) (?:(?!and )[\w.-]+ ){{0,3}}(?:hold|stop)\b|\bstay put\b|\bon the spot for\b|"
        rf"{_TIME} (?:on (?:the spot|station)|holding)\b(?: again)?|\b(?:sit|sitting) tight\b(?: for)?|\b(?:lie|stay) there\b"
    )),
    (GOTO, re.compile(
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
    )),
)  # fmt: skip
"""What speaks of a movement; where two of them overlap, the former holds."""
MANY = _words(
    r"grids?|lawn-?\w*|mow\w*|lanes?|lines|squares?|circle of|points|waypoints|stations|zig-?zag|spiral|triang\w+|sectors?|evenly|"
    r"steps of|in (?:\w+ ){0,2}steps|survey\w*|inspect\w*|all the way round|length|\w+ (?:equal )?"
    r"(?:rotations|pans|turns|nudges|steps)(?= (?:of|to|each|at|by)\b)|times|again|twice|repeat\w*|once more|each|headings|bearings|"
    r"pass|passes|track|transect|straight|line|all sides|one after the other|"
    r"in (?:that|this) order|in turn|along|parallel|full (?:turn|circle|rotation)|right round|work your way|strips?|rows|same|as before|"
    r"and (?:then )?(?:\w+ )?to \d+|every|alternat\w+|"
    r"hexagon\w*|octagon\w*|pentagon\w*|\w+gon|ring|round (?:it|the)|(?:four|five|six|seven|eight|nine|ten|twelve)(?! (?:min|sec|hour|"
    r"met|m\b|deg|and a half|point|hundred|thousand|or )\w*)|\d+ (?:of|pans|turns|nudges)|run \w+ (?:m|metres?|meters?)"
)
"""Words for a movement of several steps, or for one that is done again: steps cannot be counted by movements."""
UNORDERED = _words(
    r"before|after (?!that|this|which)|once|preceded|followed|precedes|comes|backwards|but first|earlier|having|until then|first of all|"
    r"last of all|alternat\w+|on the way to @|reverse"
)
ELLIPTIC = _words(
    r"as the (?:first|second|third|last|former|one)|likewise|ditto|as before|another (?:at|in|on|for|one)|"
    r"same (?:again|there|as)|and again"
)
RUNS = re.compile(r"@|\b(?:home|back|return\w*|base|target|goal|start|centre|berth)\b")
"""Words for places to go to; the same one may be named twice."""
PAUSED = re.compile(
    r"\b(?:paus|stop|hold|wait|stay|station|stand)\w*\b[^.;]{0,60}\b(?:each|every)\b|\b(?:each|every)\b[^.;]{0,40}\b(?:paus|stop|hold|wait|stay)\w*"
)
HOME = _words(r"home|base")
HOMEWARDS = _words(r"home|base|return\w*|back")
STEP = _words(r"steps?")
BARE = re.compile(r"(?:first|second|third|fourth|fifth|sixth|last|latter|former|final|1st|2nd|3rd|ones?)$")
STOPS = _words(r"stop\w*|paus\w+|wait\w*|hold(?:ing)?(?! the)")
SCOPED = _words(
    r"before|after|once|until|through|with(?= the \w+ (?:only|alone))|only|alone|rest|back|both|either|each|then|while|second|two|three|"
    r"four|five|six|first|last|in [a-d]\b|on the (?:grid|square|lanes|way)|off|the (?:drift|hold|turn|run|trip)|this|that|home|there|"
    r"next|finally|afterwards|no"
)
"""Words of texts in which a skill may be meant for some steps only."""
RUN_ON = re.compile(
    r"\b\d{1,3}(?:°| degrees)?(?:, then|, and then| and then|, | and) \d{1,3}(?:,| and| then|[.;]|$)|(?:north|south|east|"
    r"west)\w*(?:, then|, and then| and then|,| and) (?:north|south|east|west)|\b\d{2,3},? then \d{1,3}\b|\b(?:run|follow|drive|track|"
    r"pass|sail|go)\w*\b[^.;]{0,60}\bfrom @|\b(?:run|follow|track)\w*\b[^.;]{0,30}\b(?:length|distance|cable|course)\b|"
    r"\bfollow(?:ing)? (?:a |the )?(?:cable|course|heading|\d)|\d ?(?:m|metres?|meters?) (?:on|along|due)\b|"
    r"\bfollow\w*\b[^.;]{0,40}?\d+ ?(?:m|metres?)\b|@,? (?:and |then |and then )?@|\bvia @|\b(?:run|go|drive|sail|"
    r"move)\w*\b[^.;,@]{0,20}?\d+ ?(?:m|metres?|meters?|km)\b|(?:from|between) @[^.;]{0,20}?\b(?:to|and)\b @|@ (?:to|and) @|"
    r"\band back (?=by |\d)|degrees?[^.;]{0,25}?(?:,|and|then)(?: then| and)? (?:by )?[\w-]+ degrees?|°[^.;]{0,20}?(?:,|and|then)[^.;]{0,12}?\d+ ?°"
)

# ---------------------------------------------------------------- scopes
_ORDINALS = (
    ("first", "1st", "initial"), ("second", "2nd"), ("third", "3rd"), ("fourth", "4th"), ("fifth", "5th"), ("sixth", "6th"), ("seventh", "7th"),
    ("eighth", "8th"), ("ninth", "9th"), ("tenth", "10th"),
)  # fmt: skip
_NUMBERS = ("one", "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten")
ORDINAL = {word: index for index, words in enumerate(_ORDINALS) for word in words} | {
    "last": LAST,
    "final": LAST,
    "latter": LAST,
    "former": 0,
    "closing": LAST,
    "opening": 0,
}
COUNTS = {"both": 2, "two": 2, "three": 3, "four": 4, "five": 5, "2": 2, "3": 3, "4": 4, "5": 5}
BARE_COUNTS = {"both": 2, "two": 2, "three": 3, "four": 4, "five": 5, "six": 6}
CARDINAL = (
    {word: index for index, word in enumerate(_NUMBERS)}
    | {str(index + 1): index for index in range(10)}
    | {letter: index for index, letter in enumerate("abcdef")}
)
NOUNS: dict[str, tuple[frozenset[str], frozenset[str]]] = {
    r"steps?|parts?|stages?|phases?|ones?(?! (?:hundred|and a|or two|minute|second|hour|min|sec|s)\b)|moves?|movements?|manoeuvres?|of them|of these|"
    r"of those|sections?|elements?|actions?|lines?(?= \d)": (
        frozenset(),
        frozenset(),
    ),
    r"legs?|runs?|transits?|approach(?:es)?|drives?|trips?|crossings?|stretch(?:es)?|straights?|transfers?": (frozenset({GOTO}), frozenset()),
    r"lanes?": (frozenset({GOTO}), frozenset()),
    r"waypoints?|points|corners?": (frozenset({GOTO}), frozenset({HOLD})),
    r"stops?": (frozenset({HOLD}), frozenset({VISUAL, GOTO})),
    r"holds?|station[- ]keep(?:s|ing)?": (frozenset({HOLD}), frozenset({VISUAL})),
    r"pauses?": (frozenset({HOLD}), frozenset({WAIT})),
    r"visual holds?|visual station keep(?:ing)?|visual part|centring": (frozenset({VISUAL}), frozenset()),
    r"drifts?|floats?": (frozenset({DRIFT}), frozenset()),
    r"turns?|swings?": (frozenset({FACE}), frozenset({NUDGE, ARC})),
    r"rotations?": (frozenset(), frozenset({NUDGE, FACE})),
    r"headings?|bearings?|facings?": (frozenset({FACE}), frozenset({NUDGE, HOLD})),
    r"nudges?|pans?": (frozenset({NUDGE}), frozenset()),
    r"arcs?|curves?|bends?|sweeping turns?|arc turns?|quarter circles?": (frozenset({ARC}), frozenset()),
    r"sweeps?": (frozenset({ARC}), frozenset({NUDGE})),
    r"waits?|settling|waiting": (frozenset({WAIT}), frozenset({HOLD})),
}
"""Nouns of scopes, with the navigation skills that they mean and those that they may mean as well; none: any step."""
MOVEMENT_KINDS = tuple(re.compile(pattern) for pattern in NOUNS)
_NOUN = "(?:" + "|".join(NOUNS) + ")"
_KIND_NOUN = "(?:" + "|".join(pattern for pattern, (sure, maybe) in NOUNS.items() if sure or maybe) + ")"
ORD = "(?:" + "|".join(ORDINAL) + ")"
_ORDS = rf"{ORD}(?:(?:, (?:the )?{ORD})*,? (?:and|or) (?:(?:in|on|for|during) )?(?:the )?{ORD}(?! (?:is|goes|runs|has)\b))?"
_CARDS = r"(?:one|two|three|four|five|six|seven|eight|[1-9])"
_CARDLIST = rf"{_CARDS}(?:(?:, {_CARDS})*(?:,? and |\+| & |/){_CARDS})?"
_PREP = r"(?:in|on|during|for|at|through|throughout|over|of|to|with|within)"
_THE = r"(?:the |this |that |its |these |those )"
_END = (
    r"(?=\s*(?:$|[,.;:)(]|only\b|alone\b|and\b|but\b|not\b|as\b|too\b|then\b|please|is\b|are\b|goes|runs|has\b|keeps?\b|needs?\b|do\b|"
    r"may\b|just\b|you\b|i\b|tnx\b|thx\b|thanks\b|pls\b|over\b(?=\W*$)))"
)
SCOPES: tuple[tuple[str, re.Pattern[str]], ...] = (
    ("except", re.compile(
        rf"\b(?:{_PREP} )?(?:all|every(?:thing|where)?|each|any|whichever)(?: of)?(?: the| them| these)?(?: \w+)??(?: (?P<before>{_NOUN}))? ?(?:but|"
        rf"except|bar|save|apart from|is not)(?: for)?(?: {_PREP})? "
        rf"(?:the |this )?(?P<ords>{_ORDS})(?: (?P<noun>{_NOUN}))?\b"
    )),
    ("but", re.compile(
        rf"\b(?:only |just )?(?:{_PREP} )?(?:every(?:where|thing|time)?|all(?: the (?:time|while|way))?|throughout|always|anywhere) ?(?:but|except|bar|"
        rf"save|apart from)(?: for)?(?: {_PREP})?(?: the| its)? (?:(?P<noun>{_KIND_NOUN})\b(?! (?:of|to|that|between|back|from|it|out|home|up|in|on)\b)|"
        rf"(?:while |when )?(?:(?P<drift>adrift|drifting|floating|afloat)|(?P<face>turning|rotating|swinging)|(?P<hold>holding|on station|stopped)|"
        rf"(?P<goto>under way|driving|moving|sailing|running))\b)"
    )),
    ("to", re.compile(
        r"\b(?:all|every\w*|each|any|whichever)\b(?: (?!and\b|then\b)[\w-]+){0,4}? (?:but|exc\w{2,4}t|bar|save|apart from)\b[^.;,]{0,40}|"
        r"\bthe \w+ that is not the \w+"
    )),
    ("range", re.compile(
        rf"\b(?:only |just )?(?:(?P<since>from|starting (?:with|at|on)|(?:begin|start)s? (?:with|on|at)) the (?P<ord1>{ORD} )?(?P<noun1>{_NOUN})\b"
        rf"(?: (?:on(?:wards?)?(?! the)|to the (?:very )?end)\b)?|"
        rf"(?P<through>(?:until|till|up to|to|before) (?:the end of|the close of)|up to and including|ends? with|stops? with|"
        rf"through to) the (?P<ord2>{ORD} )?"
        rf"(?P<noun2>{_NOUN})\b|(?:until|till|before) the (?P<ord3>{ORD} )?(?P<noun3>{_NOUN}) is (?:over|done|finished)\b|"
        rf"(?P<behind>after|from the end of|once|as soon as|when) the (?P<ord4>{ORD} )?(?P<noun4>{_NOUN})(?: is (?:over|done|finished|through|"
        rf"behind (?:you|us)))?\b"
        rf"(?! (?:is|are|to|of|from|back|home|begins|starts)\b))"
    )),
    ("middle", re.compile(rf"\b(?:only |just )?{_PREP} the middle (?P<noun>{_NOUN})\b")),
    ("return", re.compile(
        r"\b(?:only |just )?(?:(?:on|during|for|in) (?:the|its|your) (?:way (?:back|home)|(?:leg|run|trip|drive|way) home|"
        r"(?:return|homeward) (?:leg|run|trip)|"
        r"homeward (?:leg|run|trip))|homeward bound|inbound)(?= only\b| alone\b|\W*$|[,.;:]| and (?:that|nothing|no)\b)"
    )),
    ("numbered", re.compile(
        rf"\b(?:{_PREP} )?(?P<noun>steps?|parts?|stages?|legs?|lines?) (?P<cards>{_CARDLIST})\b(?! ?(?:m|metres?|meters?|degrees?|°|s|min\w*|"
        rf"sec\w*)\b)"
    )),
    ("numbered", re.compile(r"^\W*(?:in |during )?(?P<noun>phase|part|stage|step) (?P<cards>[a-f])\b")),
    ("several", re.compile(
        rf"\b(?:(?:only |just )?{_PREP} )?(?:{_THE})?(?P<side>first|last|other|next|outer|inner|middle|final|remaining) (?P<count>two|three|"
        rf"four|five|[2-5])\b(?! ?(?:min|sec|s\b|m\b|met|hour|°|deg))(?: {_NOUN}\b)?"
    )),
    ("ordinal", re.compile(
        rf"\b(?:(?:only |just )?{_PREP} )?(?<!from )(?<!until )(?<!till )(?<!after )(?<!before )(?<!up to )(?:{_THE})(?!final approach|"
        rf"last sweep|latest)(?P<ords>{_ORDS}) (?:of (?:the |these |those )?)?(?:(?!(?:way)?points?\b|place|position|"
        rf"corner)\w+ )??(?P<noun>{_NOUN})\b(?! to (?:the )?{ORD}\b)"
    )),
    ("ordinal", re.compile(rf"(?:^\W*|\b(?:only |just )?{_PREP} )(?!final approach|last sweep|latest)(?P<ords>{_ORDS}) (?P<noun>{_NOUN})\b")),
    ("ordinal", re.compile(rf"\b(?:only |just )?(?:in|on|during|for|at) (?:{_THE})(?P<ords>{_ORDS}){_END}")),
    ("ordinal", re.compile(rf"(?:^\W*|(?<=, ))the (?P<ords>{ORD})(?= (?:goes|runs|is|has|leads|keeps|needs|takes|one|gets|lasts|to)\b)")),
    ("that", re.compile(
        rf"\b(?:in|on|during|for|throughout) (?:this|that|the same|these) (?P<noun>{_NOUN})\b|\b(?:while|when|as) (?:you are )?"
        rf"(?:doing (?:so|that|this)|you do(?: so| that| this)?)\b|\bduring (?:this|that)(?=,)|\bmeanwhile\b|\bas you do\b|\bin the meantime\b"
    )),
    ("all", re.compile(
        rf"\b(?:{_PREP} )?(?:throughout )?(?:both|all|every|each|either|each and every)(?: (?:single|of))?(?: the| them| these| those|"
        rf" its)?(?: (?:two|three|four|five|six|seven|eight|nine|ten|\d+))?(?: of)?"
        rf"(?: (?:them|these))?(?: (?!case|time|way|other|second|third|stay|with|on|at|in|to|for|of|"
        rf"by)[\w-]+)?? (?P<noun>{_NOUN})\b(?! (?:in which|where|when|that|which|but|bar|save|not the))"
    )),
    ("everywhere", re.compile(
        r"\b(?:throughout(?! the)|throughout the (?:whole|task|mission|plan|run)|(?:for |during |at )?(?:the (?:whole|entire|"
        r"full) (?:\w+ )?(?:time|task|way|way through|mission|plan|thing|trip|job)|all the (?:time|while|way)(?: through)?|"
        r"all times)|from (?:the )?(?:start to (?:the )?finish|beginning to (?:the )?end|start to (?:the )?end|"
        r"first (?:step )?to (?:the )?last(?: step)?)|all along|during everything|without a break|the whole way(?: through)?|"
        r"all through)" + _END
    )),
    ("while", re.compile(
        r"\b(?:only |but |just )?(?:while|when|whilst|as long as|for as long as|as(?= you| she| it| the))(?: only)?(?: (?:you|she|it|"
        r"the \w+|we)(?: is| are)?)?(?: only)? (?P<gerund>"
        r"(?P<goto>driv\w*|mov\w+|under way|transit\w*|sail\w*|travel\w*|steer\w*|en route)|(?P<hold>hold(?:ing|s)?|on station|"
        r"station[- ]keeping|keep\w* station|stopped|on the spot|stay(?:ing|s)?)|"
        r"(?P<visual>(?:keeping )?(?:it |the \w+ )?(?:is )?(?:centred|in (?:the )?(?:picture|frame)))|(?P<drift>drift\w*|adrift|"
        r"float\w*|afloat|(?:the )?engines? (?:are )?off)|"
        r"(?P<face>turn\w*|rotat\w+|com(?:e|es|ing) round|swing\w*)|(?P<nudge>pann?(?:ing|s)?|nudg\w+)|(?P<arc>arc\w*|sweeping|curving|"
        r"round(?:ing)? the bend)|(?P<still>l(?:ie|ies|ying) (?:still|there)|sit(?:s|ting)? (?:still|tight))|(?P<wait>wait\w*(?: for stability)?|settl\w+))\b"
        r"(?! (?:within|inside|clear|away|no|\d[\w.]*|to|for|the|on|out|at|in|by|through|an?|round|into|in a|back|up|off|and \w+ing|"
        r"recording|over|straight|directly|past|along|down|between)\b)(?! ?@)|\b(?P<goto2>under way|on the move|on the way(?! (?:in|out|back|"
        r"to|home|there|from|between|up)\b))\b|\b(?P<drift2>adrift)\b(?! for)"
    )),
    ("bare", re.compile(r"\b(?:in|on|for|during|at) (?P<bare>both|each|all(?: (?:of them|two|three|four|five|six|of these))?)" + _END)),
    ("kind", re.compile(
        rf"\b(?:(?:only |just |but )?(?:in|on|during|throughout|for the duration of|through)|(?:along|round)(?= the (?:straight|curve|"
        rf"bend|arc))|only) (?:the |your )(?:two |three |four |five |whole |single |actual )?(?P<noun>{_NOUN})\b(?! (?:of|to|that|"
        rf"between|back|from|proper|it|out|home|up|in|on)\b)"
    )),
    ("place", re.compile(r"\bonly (?:to|until|up to|as far as|from|after|before|between|at) (?:the \w+ )?@|\bout and home\b")),
    ("way", re.compile(
        r"\b(?:only |just )?(?:on|during|for|in) (?:the|its|your) (?:way|run|leg|transit|approach|drive|trip|crossing|stretch|return|"
        r"homeward \w+|outward \w+|\w+ward leg)"
        r" (?:to|of|from|back|home|out|in|there)\b(?: (?:the [\w-]+|(?!and\b|or\b)[\w-]+))?(?: @)?"
    )),
    ("place", re.compile(rf"\b(?:in|on|during|for) the (?!same|whole)[\w-]+ {_NOUN}\b")),
    ("to", re.compile(
        rf"\b(?:in|on|during|for) (?:the|its|each|every) (?:[\w-]+ )?{_NOUN} (?:of|to|that|between|back|from|proper|it|which|after|before|at|"
        rf"by)\b"
    )),
    ("to", re.compile(
        r"\b(?:on|during|for|in) the (?:hold|turn|nudge|pan|stretch|leg|part|rest|remainder) (?:to|of|from|back|home|out|between|in|"
        r"after|before)\b(?: @| the [\w-]+| \w+)?|"
        r"\b(?:as soon as|begins?\b|ends\b|until|till|up to|as far as|(?:from|until|up to|to) (?:there|then|that|here|the (?:first|second|"
        r"third|moment|turn|wait|"
        r"hold|settling|change|\w+ on))|after|before|between|past|beyond|once|homewards?|"
        r"outwards?|onwards?|(?<!in )(?<!out )there|thereafter|later|earlier|where|wherever|whenever|on it\b|at (?:the |its )?(?:very |"
        r"far )?(?:start|end|finish|"
        r"corners?|mid-?sides?|stops?|beginning)|at @|"
        r"(?:while|when) \w+ing and \w+ing|every (?:other|second|third)|alternate|(?:while|when|as) (?:it|she|you|the [\w-]+|we) (?:is |"
        r"are )?\w+|in [1-9]\b|(?:goes|go) with|belongs? to|(?:first|second|third|last|1st|2nd|3rd|each|both) times?|corners|"
        r"mid-?sides?|odd|even|middle (?:one|\w+)(?= (?:only|alone)|$|[,.])|outer|inner|(?:the|on|any) others?|neither|either|none|"
        r"nowhere|elsewhere|northward|southward|"
        r"eastward|westward|else|along the way|en route|on arrival|at rest|homeward|outward|the (?:former|latter)|now and then|"
        r"in the end|(?:first|second|other|last) half|on station|as (?:the|before)|likewise|ditto)\b"
    )),
)  # fmt: skip
"""Phrases that say in which steps something runs; "that" and "to" are scopes that are not read."""
GERUNDS = {
    "goto": (GOTO, (ARC,)),
    "hold": (HOLD, (VISUAL,)),
    "still": (HOLD, (VISUAL,)),
    "visual": (VISUAL, ()),
    "drift": (DRIFT, ()),
    "face": (FACE, (NUDGE, ARC)),
    "nudge": (NUDGE, ()),
    "arc": (ARC, ()),
    "wait": (WAIT, (HOLD,)),
    "goto2": (GOTO, (ARC,)),
    "drift2": (DRIFT, ()),
}
NOT_BEFORE = re.compile(
    r"\b(?:except|save|bar|apart from|other than|e\w{3,}e but)(?: for)?\W{0,2}$|"
    r"\b(?:not|never|nor|none|neither|no|nothing|without)(?: (?:[\w-]+|on the \w+)){0,2}\W{0,2}$"
)
JOINT = re.compile(
    r"^\s*(?:only|alone)?\s*(?:,?\s*(?:but |and )?(?:not|never|nor|neither)|and|or|as well as|as|,)?\s*(?:also |only |just )?(?:in|on|during)?\s*$"
)
"""What stands between two scopes of one phrase."""

SENTENCE = re.compile(r"[.!?](?=\s|$)|\n")
CLAUSE = re.compile(
    r";|\s[-–—]\s|,?\s*\b(?:and|but)? ?(?:(?<!by )(?<!until )(?<!till )(?<!from )(?<!since )then|next|after that|after which|afterwards|"
    r"finally|lastly)\b,?|(?:^|(?<=\s))(?:\(\d\)|\d[.)]|\*)(?=\s)|,? before (?=\w+ing\b)"
)
QUOTED = re.compile(r"(?<![\w])['\"‘“][^'\"’”]{1,40}['\"’”]")
SENSORS = re.compile(
    r"\b(?:thermal|infrared) (?=stream|feed|view|channel)|\b(?:the )?(?:(?!stream|feed|view|check|lens)[\w-]+ )?(?:camera|"
    r"cam)(?: ?(?:[a-z]|\d+))?\b|\b[a-z]+_?\w*cam\b|\bcam[\w-]*\d\b|(?<=from )the (?:[\w-]+ )?(?:sonar|lidar|sounder)|"
    r"(?<=from )(?:sonar|lidar)_?\w*"
)
PLACE = re.compile(
    r"(?:\b(?:x|minus|\+)\s*=?\s*|[\[({]|\b(?:position|waypoint|point)\s+|[-−–=]\s?(?=[-−–]?@))*@(?:[\])}]|(?: (?:north|south|east|"
    r"west))+\b|[a-z]\b)*"
)
SPACES = re.compile(r"[ \t]+([,.;:!?]?)")
IDLE = re.compile(r"^\W*(?:\d{1,2}|and|please|for the [\w ]+|over|here|roger|ok|thanks|that is all|that's all|nothing (?:else|more))?\W*$")
BESIDES = re.compile(r"^\W*(?:with|while|without|keeping|having|staying|under|\w+ing)\b")
AFTER_THAT = re.compile(r"^\W*(?:and )?(?:from there|at (?:the|its|that) (?:very |far )?end|once there|there|afterwards|thereafter|later)$")
"""Words that put a movement behind the one before and say nothing of skills."""
NO_MOVE = re.compile(r"\b(?:from|until|till) the (?:\w+ )?to the\b|\b(?:when|while) \w+ing and \w+ing\b|\band (?:after|before) (?:that|it)\b")
"""Words by which a movement is spoken of, not asked for."""
REFUSED = re.compile(r"\b(?:no|not|none|nothing|free|may|need|needn't|off)\b")
INSERTED = re.compile(r"^\s*(?:only|alone)?\s*,")
PERIOD = re.compile(
    r"\b(?:once )?every (?:[\w.]+ ){1,5}?(?:s|sec\w*|min\w*|hours?)\b|\bstraight (?:to|over|after|for|away)\b|"
    r"(?<!cable )(?<!planned )(?<!given )(?<!the )\btrack(?:ing)? (?!the cable|from|to\b)(?=\w)"
)
"""Words that `MANY` would take for movements."""
COUNTED = re.compile(r"(?:steps?|parts?|stages?|legs?|lines?|headings?|bearings|through|first|last|face|facing|turn to|bow to) (?:\d+, )*$", re.IGNORECASE)
"""What stands before numbers that are no place."""
GOES_ON = re.compile(r" (?:and|or) (?:at|near|from|until|till|after|before|on (?!board)|in|\w+ing)\b")
"""A second place for what runs in a scope, that was not read as one."""
TO_OWN_PLACE = re.compile(r" to the (?:target|goal) (?:position|point)\b")
"""What makes a movement of "the final run", where none is told beside it."""
HEADER = re.compile(r"^[^:]{0,60}:")
TWO_STEPS = re.compile(r"^\W*(?:(?:in )?(?:two|three|four|five|six|both|\d)) (?:steps?|parts?|stages?|legs?|phases?)\W*$")
