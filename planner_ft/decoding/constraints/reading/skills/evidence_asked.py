"""What an input asks for in plain words, and what takes nothing of that back, for `evidence`.

Patterns are read on text in small letters, in a sentence that holds no word of doubt once PASSING
is left out.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.evidence_parts import COUNT, SIZE

_STEP = r"(?:turns?|holds?|legs?|runs?|steps?|parts?|stages?|drifts?|arcs?|waits?|stays?|halts?|pauses?|nudges?|pans?|corners?|others?|rest|way|moves?|lanes?)"
_OBSTACLES = (
    r"(?:everything|anything|every(?: \w+)? obstacle|any(?: \w+)? obstacles?|all(?: the)?"
    r" obstacles|obstacles|all traffic|all of (?:them|it))"
)
_CAMERA = r"(?:image|picture|video|frame)"
_SEEN = r"(?!\w*(?: \w+)? (?:by|on|with|from) (?:the )?(?:sonar|lidar))"

PASSING = (
    rf"\b(?:{SIZE} (?:clear )?off\b|off (?:every|any|all|the"
    rf" other)\w*|(?:move|set|cast|pull|stand|start)(?:s|ing)?[- ]off\b|{SIZE} to spare|"
    r"down (?:it|to|the"
    r" (?:line|quay|face|wall|side)|on|past|along|from|as)\b|(?:write|writing|take|note|jot|put|back|log|go|run|slide|come|head|sail|set) "
    r"(?:it |that )?down\b|"
    r"(?:no|not|never|at no) (?:any )?(?:less|more|fewer|closer|nearer|worse|further|farther)"
    r" than|(?:drifting|straying) no more\b|"
    rf"minus (?:\d|{COUNT})|"
    r"wait(?: (?:there|here))?,? (?:until|till|for|at|on station|up"
    r" to|\d)|(?:the|that|this|a|each|every|given|while you|while|you|and|then|to|stated|second|"
    r"first|last) wait\b(?!,)|"
    r"(?:the|a|an|that|this|each|every|first|second|third|last|[\w-]+-(?:second|minute))"
    r" stop\b|stop (?:at|there|for|in|on|when|here|short)\b|"
    r"free(?:ly)?[ -](?:drift|float|span)\w*|(?:drift|float)\w* free(?:ly)?\b|for the"
    r" (?:up|down)load\b|mean (?:and|or|temperature|value|of)\b|"
    r"(?:and|but|,) not (?:before|earlier|sooner|between|after|(?:for |in |on |at |during )?the"
    rf" (?:\w+ )?{_STEP})\b|"
    rf"never (?:under way|(?:in|on|during|at) (?:the )?(?:\w+ )?{_STEP})\b|nothing"
    rf" (?:in|on|during|at|for) (?:the )?(?:\w+ )?{_STEP}\b|"
    r"(?:all|every\w*|each)(?: [a-z]+){0,4} (?:but|except|save|bar)(?: (?:for|on|in|at|during))?(?:"
    r" the)? (?:first|second|third|fourth|last|\d+|one)\b|"
    r"(?:until|till|when|once) (?:all|every|each)[^.;]{0,20} (?:have|has) been\b|where"
    r" (?:we|you|she|it) (?:have|has) been\b|"
    r"(?:without|never|not|don't)(?: ever| to)? leav(?:e|ing)(?: (?:it|this|that|the"
    r" (?!mark|pin)\w+|your \w+)|(?= ?[.,;:]|$))|(?:don't|"
    r"do not|not to) (?:move|stop|turn|hurry)\b(?! (?:[a-z]+ ){0,3}(?:on|off)\b)|"
    r"(?:note|caption|labelled|label) (?:[a-z0-9]+ ){0,3}[a-z0-9]+$|leave (?:it|that|them) out"
    r" (?:at|in|on|during)\b|"
    r"where (?:the |that |a |no )?[a-z]+ (?:is|are) no longer (?:needed|wanted|required|in"
    r" force|necessary))"
)
"""Words of doubt that are none: lengths, ways, waits and stops, and what bounds where something is
done.
"""

ASKED: dict[str, tuple[str, ...]] = {
    "LockHeading": (
        r"(?:bow|heading|nose) (?:gets|is to be|has to be|must be|will be|should be|to be) (?:locked|fixed|held)\b",
        r"(?:with )?(?:your |the |its |her )?(?:bow|heading|nose) locked\b|nose where it (?:is|points)\b",
    ),
    "ObstacleAvoidance": (
        rf"{SIZE} (?:clear |away )?(?:of|from|off|to|clear of) {_OBSTACLES}\b|{SIZE} (?:at least|minimum|or more) (?:to|from|between)\b|"
        rf"{SIZE}(?: of)? (?:clearance|margin|sea ?room)\b",
        rf"(?:avoid|dodg|pass|clear)(?:ing|e)? (?:all |any )?(?:the )?obstacles?\b(?! (?:distance|rang))|clearance (?:to|from|of) {_OBSTACLES}",
        rf"(?:clearance|(?:safety |obstacle )?margin)(?:,| of| at| is| to be|:)? (?:at least )?{SIZE}|margin is to be\b",
        rf"nothing (?:may|is to|must|should|shall|can) come (?:closer|nearer)|(?:never|not|no) (?:less|closer|nearer) than {SIZE} (?:from|"
        rf"to|off|of) {_OBSTACLES}",
        rf"{SIZE} to spare\b",
    ),
    "BoundaryEnforcement": (
        r"(?:fence|geo-?fence|boundary|limits?)(?: [a-z]+){0,4}[:,]? [\[(] ?\(?-?\d",
        r"(?:inside|within|in|not leave|without leaving|never leav\w+) (?:of )?(?:the|a|an|this|that) (?:fence|geo-?fence|box|polygon|"
        r"boundary|triangle|rectangle)"
        r"(?: [a-z]+){0,4}[:,]? [\[(] ?\(?-?\d",
        r"the (?:box|polygon|triangle|rectangle) [\[(] ?\(?-?\d[^.;a-z]*(?:and )?[^.;a-z]*(?:is (?:the|its|your|her) (?:boundary|fence|limit)|binds)",
    ),
    "DetectObjects": (
        rf"(?<!sonar )(?<!feature )(?<!text )detector(?:,|:| is| to be| must be| has to be)? (?:on|running|for|look\w*|(?!off\b|does|not)[a-z ]{{3,20}},)|"
        rf"detect(?:ing)? (?!the (?:lens|hottest|text)|a curve|blobs|features|[a-z ]{{0,50}}sonar)[a-z ]{{3,40}}(?:,|and) [a-z ]{{3,30}}{_SEEN}$",
        r"(?:with|by) the detector\b|keep\w* your eyes open for\b|run(?:ning)? (?:the )?(?:object )?detection (?:of|for|on)\b|"
        r"look(?:ing)? out for (?!hot|the (?:hot|warm))",
    ),
    "TrackObjects": (
        r"tracker (?:follows|stays on|keeps|holds|locked on|has to follow|is to follow|must follow)\b|track object\b|object tracking\b",
        r"(?:keep|hold|maintain)(?:ing|s)? the (?:identity|track) of\b(?! (?:our|your|the|her|its) positions?\b)|"
        r"tracking of (?:the )?(?:object|target|contact)\b",
    ),
    "OCRScanning": (
        r"(?:with|by) (?:the )?(?:text (?:scanner|reader)|ocr)\b|text reading\b|ocr (?:covers|takes|in|for|over)\b|extract(?:ing)? the text\b",
        r"read(?:ing)? (?:off )?(?:what|whatever) (?:it|the [a-z ]{3,25}) says\b|(?:lettering|writing|text)\b[^.;,]{0,40} (?:is|has|have|are) to be read\b|"
        r"text read\b",
    ),
    "GetThermalStats": (
        r"(?:temperature|thermal|heat) (?:stats|statistics|figures|readings)\b|(?:mean|average|max\w*)(?: and [a-z]+)? temperatures? of\b",
    ),
    "LocateHotspot": (
        r"(?:the )?hottest (?:point|spot) (?:above|over|beyond|wherever|anywhere|hotter|that|in|on|of|with)\b|give me the (?:hottest|warmest)\b|"
        r"hot ?-?spot search\b(?!:)|(?:search|look)(?:ing)? for (?:hot ?-?spots?|the (?:hottest|warmest))\b",
    ),
    "CheckLensClearness": (
        r"check(?:ing)? (?:of )?(?:the )?lens(?:es)?\b|(?:whether|if|that) the lens(?: of [\w ]{1,25})? is (?:clear|clean|free|wet|dry)\b|lens checked\b",
        r"(?:check|look)(?:ing)? (?:at |for )?(?:the )?(?:droplets|drops|spray|salt|glass)\b|(?:droplets|drops|spray|salt)(?: water)? on the lens\b",
    ),
    "GetImageQualityMetrics": (
        rf"usability of the (?:[a-z]+ )?{_CAMERA}s?\b|{_CAMERA} usab\w+|quality (?:figures|metrics|score)\b|quality of the (?:{_CAMERA})s?\b",
        rf"rat(?:e|ing) the (?:{_CAMERA})s?\b|how (?:good|sharp|usable) (?:the )?(?:{_CAMERA})s? (?:is|are)\b",
    ),
    "CalculateVisualOffset": (
        r"pixel (?:error|offset|distance)s?\b|(?:error|offset|distance) between the (?:image|picture|frame) cent(?:re|er) and\b",
        r"how far [a-z0-9' -]{3,40} (?:is|lies|stands) from the (?:cent(?:re|er)|middle) of the (?:frame|picture|image)\b",
    ),
    "GetSectorDistance": (
        r"(?<!metres )(?<!meters )(?<!\dm )(?<!\d m )(?<!feet )(?<!yards )(?:minimum|shortest|smallest|least) (?:lidar |laser )?(?:distance|"
        r"range|return)\b(?! (?:to|of|from)\b)|sector distances?\b|"
        r"clos(?:est|set) (?:lidar |laser )?return\b",
    ),
    "DistanceToObstacle": (
        r"obstacle distances?\b|(?:lidar )?distance (?:straight )?(?:ahead|out)\b|distance to (?:the )?(?:nearest |next )?(?:obstacle|structure|wall)s?\b",
        r"lidar distance (?:with|over|in|at) an? \S+?[ -]degree f(?:ov|ield)|room in front\b(?! and)",
    ),
    "FitCylinderModel": (
        r"cylinder (?:fit|model|is fitted|has to be fitted)\b|fit(?:ting)? (?:of )?a cylinder\b|curve (?:search|in the (?:point )?cloud)\b",
    ),
    "CheckPlanarity": (
        r"planarity\b|for flatness\b|flatness of\b|flat or curved\b|curved or flat\b|(?:whether|if|see|how) (?:[a-z' -]{1,40} is )?flat\b",
    ),
    "DetectSonarFeature": (
        r"(?:sonar detecting|detect(?:ing|s)?) (?:the )?(?:sonar )?features?\b|sonar (?:display )?(?:for (?!the depth|depth)|search|"
        r"shall look|is to look|to look)\b|"
        r"sonar (?:feature )?detect\w*|blob (?:search|detection)\b",
        r"on the sonar(?: display)?,? (?:i am|we are|i'm|we're|look|search|watch|seek)\b",
    ),
    "GetSeabedDepth": (
        r"(?:seabed|water|bottom) depths?\b|depth (?:under|below|beneath|of water|from|with|by|off)\b(?! (?:the )?grid)|"
        r"sound(?:ing)? the depths?\b|soundings\b",
        r"(?:get|take|read|log|measure|record|want)(?:ing|s)? (?:a |the )?depths?\b|as (?:the )?depth sensor\b|sounder on\b(?! record)|water under the keel\b",
    ),
    "GetHorizonAngle": (
        r"horizon (?:tilt|angle|check)\b|(?:tilt|angle|slant) of the horizon\b|how (?:far )?tilted the horizon\b|how tilted is the horizon\b|"
        r"the horizon: its tilt\b",
    ),
    "GetGPSLocation": (
        r"(?:gps (?:fix(?:es)?|position)|satellite position)\b(?! (?:acc|qual|err))|position fix(?:es)?\b|(?:log|fix|note)(?:ging|"
        r"ing)? (?:your|our|the) position\b(?! (?:relative|against|with respect|in relation))|"
        r"coordinates from the gps\b|(?:take|get|with) (?:a )?fix(?:es)?\b",
    ),
    "SelectActiveStream": (
        r"active (?:camera|stream|view|feed)\b|switch(?:ing)? (?:over )?to (?:the )?[\w-]+(?: [\w-]+)? ?(?:stream|feed|view|camera|cam)\b|"
        r"(?:stream|feed|camera|view) (?:[\w-]+ )?(?:active|selected|on screen)\b|turn(?:ing)? the view over to\b",
    ),
    "SetStreamRecording": (
        r"recording (?:of|on|from|by)\b|record(?:ing)? (?:the )?[\w-]+(?: [\w-]+)? (?:under(?! the (?:keel|vehicle|boat|hull))|as|into|"
        r"with (?:file )?tag)\b|to disk under\b|file tag\b",
        r"(?:film|shoot)(?:ing)? (?:video|the whole|everything)\b|(?:camera|cam|sonar|radar|sounder|stream|feed|hydrophone) records\b",
    ),
    "BufferLoopCapture": (
        rf"(?:sav|captur|grab|dump|stor|keep|secur|writ)(?:e|ing|s)? (?:the )?(?:last|past|preceding|latest|previous) (?:{COUNT}[ -]?){{1,5}}(?:of an? )?"
        r"(?:s|sec\w*|min\w*|hours?)\b[^.;]{0,20}(?:video|footage|buffer|disk|tape)\b|"
        rf"(?:{COUNT}[ -]?){{1,4}}(?:second|minute|s|sec|min) clip\b|(?:loop|video|ring) buffer (?:is |to be |must be |should be |"
        rf"has to be )?(?:saved|kept|captured)",
    ),
    "CaptureGeoSnapshot": (
        r"geo-?(?:tagged|referenced) (?:snapshots?|stills?|pictures?|photos?|images?|frames?)\b|stills? with (?:its |the |"
        r"their )?(?:position|coordinates|metadata)|"
        r"(?:picture|photo|still|frame|image)s? with (?:its |the |their )?(?:position|coordinates|metadata)\b",
    ),
    "LogLidarSlice": (
        r"(?:tak|log|sav|stor|record|writ)(?:e|ing|es|s) (?:an? |the |down )?(?:2d )?(?:lidar |laser )?(?:slice|sweep|profile)s?\b|2d (?:lidar )?profile\b|"
        r"(?:lidar |laser )(?:slice|sweep|profile)s? (?:gets?|is|are|to be|is to be|being) (?:logged|saved|taken|recorded)\b|logged lidar slice\b|"
        r"lidar slices? (?:at|on|in|saved|logged)\b(?<!check lidar slice at)(?<!query lidar slice at)(?<!the lidar slice at)(?<!lidar slice on)",
    ),
    "LogEnvironmentState": (
        r"(?:log|sav|record|tak|keep|writ|captur)\w* (?:a |an |the )?(?:log of |snapshot of |record of )?(?:the )?environment(?:al)?\b|"
        r"environment(?:al)? (?:snapshots?|log|logging|sensors logged|on record)\b|environment logger\b",
    ),
    "GetRelativePose": (
        r"relative pose\b|pose (?:relative|readings?)\b|(?:your|our|her|its) pose (?:in|to|against)\b",
    ),
    "VerifyGeotagQuality": (
        r"(?:geotag|gps)(?: \w+)? (?:quality|accuracy)\b|geotags? (?:are|is) (?:good|accurate)\b|gps is (?:horizontally )?accurate\b|gps quality check\b|"
        r"accuracy of the (?:gps|geotags?)\b",
    ),
    "CreateMapMarker": (
        r"(?:pin|marker|mark) on the (?:map|chart)\b|map marker\b|mark (?:the|this) (?:map|position on the map|spot on the map|place on the map)\b|"
        r"marker (?:named|called|labelled)\b|drop(?:ping)? (?:a )?(?:pin|marker)\b",
    ),
    "RegisterObservation": (
        r"(?:register|log|enter|record|note|add|put)(?:ing)? (?:down )?[^.;,]{1,40} as (?:an|the) observation\b|an observation in the log\b|"
        r"(?:in|on|into) the (?:data )?logger\b|(?:register|add|put)(?:ing|s)? (?:the|an) observation\b|observation \"",
    ),
}
"""What means a skill and no other, besides the UNMISTAKABLE ones."""
