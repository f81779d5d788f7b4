"""How task inputs word filter and perception skills, where it is told in which steps they run; on
text in small letters.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.scopes.scope_words import whole_words

_LENS = r"lens(?:es)?\b|droplets?|the glass of|drops? on"
_PICTURE = r"(?:image|picture|video|frame)s?(?:'s)?"
SKILL_WORDS = {
    "LockHeading": whole_words(
        r"(?:bow|heading|nose|yaw)(?: \w+){0,4}? (?:lock(?:ed)?|held|fixed|where it"
        r" (?:is|points)|steady|on its heading|must not change|stays|free)|"
        r"(?:lock|fix|hold|keep|freeze|pin|maintain|leav)\w* (?:your |the |its |her |this |a"
        r" )?(?:present |same |current )?(?:bow|heading|nose)\b|"
        r"(?:heading|bow)[- ]?(?:lock|hold)|(?:locked|fixed) (?:bow|heading)|the lock|same way|the"
        r" bow swing|unlocked|locking"
    ),
    "ObstacleAvoidance": whole_words(
        r"clearances?|margins?|obstacle avoidance|collision avoidance|(?:avoid|dodge|clear of|away"
        r" from|off) (?:all )?(?:obstacles?|"
        r"everything|anything)|"
        r"(?:metres?|meters?|feet|m) (?:\w+ )?(?:clear|off|away|of room|of space|between)|keep\w*"
        r" clear|stay\w* clear|steer\w* clear|"
        r"safe(?:ty)? (?:distance|gap)|your distance|no closer|no nearer|closer than|nearer"
        r" than|not within|go within|berth of|no less than|avoid\w*|"
        r"(?:give|giving) (?:everything|all|anything)|(?<!to )(?<!far )(?<!nearest )(?<!range"
        r" )obstacles|room to|to spare|(?:will|"
        r"would) (?:have to )?do|is enough"
    ),
    "BoundaryEnforcement": whole_words(
        r"(?:geo)?-?fence[ds]?|boundar\w+|polygon|limits?|stay\w*"
        r" (?:inside|within|in)\b|(?:keep|remain)\w* (?:inside|within|in\b)|"
        r"not (?:to )?leave|box|"
        r"permitted area|outside|perimeter|square around|area bounded|inside"
    ),
    "DetectObjects": whole_words(
        r"detect\w*|detector|look(?:ing|ed)? (?:out |around )?for|look-?out|search\w* (?:\w+"
        r" ){0,3}for|watch\w* (?:out |for)|"
        r"scan\w* for|eyes? (?:out|open)|spot(?:ting)? |"
        r"check\w* for|watch for|find (?:any|the|a)\b|seek\w*|identif\w+|make out|hunt\w*|locate"
        r" (?:the|a) (?!hot)|objects in view|"
        r"in view|report any|keep\w* watch|pick\w* out|flag(?:ging)? any|see if there"
    ),
    "TrackObjects": whole_words(r"track(?:ed|er|ers|ing|s)?(?! length| \d)|identit\w+|tabs on"),
    "OCRScanning": whole_words(
        r"ocr\w*|text|lettering|writing|written|letters|inscription|read(?:ing)? (?:off |out"
        r" )|markings?|what it says|transcrib\w*|"
        r"decipher\w*|characters|lettered|read by"
    ),
    "GetThermalStats": whole_words(
        r"thermal\w*|temperatures?|infrared|thermally|how (?:hot|warm)|warmth|heat stat\w*"
    ),
    "LocateHotspot": whole_words(
        r"hot[- ]?(?:spot|point)s?|hottest|warmest|hotter|warmer|heat\b|anything"
        r" (?:above|over)|whatever is (?:above|over)|find whatever|"
        r"(?:located|locate) anything"
    ),
    "CheckLensClearness": re.compile(rf"\b(?:{_LENS}|lens-?\w*|water drops|spray|dirt|glass)\b"),
    "GetImageQualityMetrics": re.compile(
        rf"\b(?:{_PICTURE} quality|quality|usab\w+|rat(?:e|ing) the|scor(?:e|ing) the|how"
        r" good|sharp\w*|video frame|good enough|"
        rf"{_PICTURE}(?: from (?:the )?(?:\w+ )?cam)? (?:is|are))\b"
    ),
    "CalculateVisualOffset": whole_words(
        r"offsets?|pixel\w*|off[- ]cent(?:re|er)|from the (?:image |picture |frame"
        r" )?cent(?:re|er)|image cent(?:re|er)|visual error"
    ),
    "GetSectorDistance": whole_words(
        r"sectors?|(?:minimum|shortest|smallest|least) (?:lidar )?(?:distance|range)|closest"
        r" return|nearest return|how close|in that slice|"
        r"lidar (?:minimum|min)|min\.? (?:lidar )?(?:distance|range)|(?:query|check) the"
        r" lidar|lidar distance(?! to)"
    ),
    "DistanceToObstacle": whole_words(
        r"(?:obstacle|wall)"
        r" (?:distance|ranging|range)s?|(?:distance|range|ranging|far|readings)\b.{0,25}\b(?:obstacles?|ahead|wall|"
        r"structure|in front)|"
        r"how far|range (?:the |ahead|obstacles)|ranging|field of view|distance ahead"
    ),
    "FitCylinderModel": whole_words(r"cylind\w+|curve in|large curve"),
    "CheckPlanarity": whole_words(r"planar\w*|flat\w*|curvature|or curved|unevenness"),
    "DetectSonarFeature": whole_words(r"sonar\w*|blobs"),
    "GetSeabedDepth": whole_words(
        r"depths?|soundings?|how deep|sound(?:ing|s)? the (?:bottom|depth)|sounders?|echo ?sounder"
    ),
    "GetHorizonAngle": whole_words(r"horizons?|tilt\w*|how level|level the|horizontal"),
    "GetGPSLocation": whole_words(
        r"gps(?! accuracy| quality| check|"
        r" error)|gnss|fix(?:es)?|(?:log|record|note|position|save|check|determine|read|take|"
        r"get)\w* (?:the |your |its |own )?(?:current )?(?:gps )?positions?(?! hold)|"
        r"position(?:s)? (?:is |are |be |to be"
        r" )?(?:logged|logging|log|noted|recorded|fix\w*|read\w*)|coordinates|the track|"
        r"own position|the position(?= (?:on|in|at|while|during|for|as)\b|,)|^\W*position(?=:|"
        r" (?:on|in|at|while|during)\b)"
    ),
    "SelectActiveStream": whole_words(
        r"active|(?<!store the )(?<!record the )stream\w*|feed\w*|switch\w*(?! (?:the"
        r" )?(?:recording|engine|heading|object|off))|"
        r"select\w*|activat\w+|(?<!field of )view (?:on|over|through)|in use|on screen|on (?:the"
        r" )?display|channel \w+|the \w+ view|"
        r"(?:go|change|chang\w+|going) (?:over )?to (?:the )?(?:cam\w*|\w+[_ ]cam\w*)|use"
        r" cam\w*|(?<!field of )view"
    ),
    "SetStreamRecording": whole_words(
        r"(?<!environment )(?<!environmental )record(?:s|ed|ing|ings|er)?\b(?! (?:an? |the |your"
        r" |any |all )?(?:observation|gps|"
        r"position|depth|water|seabed|environment\w*|horizon|tilt|temperature\w*|thermal|lidar"
        r" (?:sl|pr|sw)|2d|sector|obstacle|distance|"
        r"wind|weather|conditions|state|current pos|geotagged|q\b|pose|fix))|run cam|cam"
        r" running|film\w*|footage|video(?! buffer|"
        r" quality| frame)|to disk|shoot\w*|store the (?:stream|data)|run the camera|(?:let|have)"
        r" (?:the )?[\w-]+(?: [\w-]+)? (?:run|"
        r"record)|tape\w*|tagged|file tag|(?<!detector )(?<!tracker )(?<!ocr )(?<!detection )runs"
    ),
    "BufferLoopCapture": whole_words(
        r"buffer\w*|(?:last|past|recent|latest) (?:[\w.]+ ){1,5}?(?:saved|kept|captured|of"
        r" video|seconds|minutes|sec|min|s|of footage)|"
        r"loop|clip|recent"
    ),
    "CaptureGeoSnapshot": whole_words(
        r"snap\w*|stills?|photo\w*|geo-?tagged|geo-?ref\w*|pictures?(?: with| taken|"
        r" from)|geotag(?! quality)|geo-?snapshots?|images?(?: with)|shots?"
    ),
    "LogLidarSlice": whole_words(
        r"(?<!check the )(?<!query the )lidar (?:slices?|profiles?|sweeps?|scan|log|cut|logging)|"
        r"(?<!in that )(?<!in the )(?<!lidar )slices?|profiles?|laser|2d"
    ),
    "LogEnvironmentState": whole_words(
        r"environment\w*|env|wind and|weather|conditions|surroundings|sea state"
    ),
    "GetRelativePose": whole_words(r"poses?|relative (?:to|position)|attitude (?:to|relative)"),
    "VerifyGeotagQuality": whole_words(
        r"gps (?:accurac\w+|error)|accurac\w+|accurate|geotag quality|geotag\w*(?: \w+)?"
        r" (?:quality|accurac\w+)|gps (?:is|quality)|"
        r"quality of the (?:gps|geotag)|geotags?"
    ),
    "CreateMapMarker": whole_words(
        r"pins?|pinn\w+|markers?|mark(?:ing|ed|s)? (?:the|this|it|on|a|q)|place"
        r" ?marks?|map\b|mark\b"
    ),
    "RegisterObservation": whole_words(
        r"observ\w+|regist\w+|not(?:e|ing|ed) (?:as|q|that|in the log)|log entr\w+|enter\w*"
        r" (?:the|q|an|in)|add(?:ing|ed)? q|finding|"
        r"entry|q (?:in|to|as an)\b|into the log|(?:store|log) q|note"
    ),
}
"""Words that speak of a skill. Better one too many: a skill that is spoken of elsewhere as well is
held to less.
"""
NEGATED = re.compile(
    r"(?:\b(?:no|without|not|nor|neither|nothing|never mind|don't|do not|need"
    r" no|stop\w*|leave|instead of|in place of|in lieu of|off|skip\w*|except|"
    r"rather than)(?: (?:a|an|any|the|that|this|be|run|take|keep|get|check|"
    r"further|other|more|second|map|geotagged|safety|heading|bow|gps|lidar|position|image|object|obstacle|need|use|log|do|measure|"
    r"record|confirm|verify))* ?)$"
)
FREE = re.compile(r"\bfree\b|unlocked")
LAPSED = re.compile(
    r"^\W{0,2}(?:is |are |\w+ )?(?:not |no longer|needn't|need not|may (?:be )?\w*"
    r" ?(?:swing|free)|free|off\b|lifted|unlocked|does not|"
    r"do not|isn't|aren't|quiet|no more|stays off|has been|"
    r"can wait|is for later|excluded)"
)
