"""What evidence of a skill means in its surroundings, for `evidence`.

What is sought or measured for another skill, what a task's own name stands for where its input
names no perception skill, and what means a skill and no other.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.evidence_parts import COUNT, SIZE

SEEKING = (
    r"(?:detect(?:s|ed|ing|ion|ions)?\b|look(?:s|ed|ing)? (?:out |first |again |then"
    r" )?(?:for|around|about|with)|(?:be|keep|keeping|stay) "
    r"looking|locat(?:e|es|ing)\b|"
    r"discover\w*|mak(?:e|es|ing) out|"
    r"watch(?:es|ed|ing)? (?:out )?for|(?:a|keep|keeping|on) (?:close |sharp |good )?watch\b(?!"
    r" circle)|search(?!ing the (?:buffer))\w*|seek\w*|"
    r"find(?:s|ing)?\b(?! out)|"
    r"(?<!the )(?<!this )(?<!that )(?<!hot )(?<!hottest )(?<!warmest )(?<!same"
    r" )spot(?:s|ted|ting)?\b(?! (?:where|while|for|\d))|scan(?:s|ned|"
    r"ning)? (?:[a-z]+ ){0,4}for|check(?:s|ed|ing)? for|"
    r"see(?:s|ing)? (?:if|whether) (?:there|any)|identif\w+|pick(?:s|ed|ing)? (?:up|out)|flag\w*"
    r" any|sight(?:s|ing)?\b|hunt\w*|scout\w*|"
    r"recogni[sz]\w*|"
    r"survey\w* for|inspect\w* for|turn and look|comb\b)"
)
"""Verbs of seeking, which object detection is asked for by where nothing says that another sensor
seeks.
"""
SOUGHT_OTHERWISE = (
    r"^(?:(?!(?:and|while|with|then|or|as|when|meanwhile|plus) )[a-z'-]+ ){0,5}?(?:sonar\w*|side-?"
    r" ?scan|hot\w*|warm\w*|heat|droplets?|drops?|"
    r"spray|water drops|lens\w*|text|lettering|letters|writing|"
    r"writ\w*|"
    r"cylinders?|curves?|clouds?|depths?|horizon|distances?|sectors?(?!"
    r" light)|offset|pixel|quality|pose|gps|geo-?tag\w*|position|observations?|"
    r"flatness|"
    r"planarity|flat|"
    r"temperatures?|soundings?|obstacles? dist\w*|how (?:close|far|level|deep)|(?:closest|nearest)"
    r" (?:return|echo|thing|point)|round shape|return)\b"
)
"""What is sought with a sensor or for a skill of its own, just behind the verb."""
BY_SONAR_BEHIND = (
    r"^(?:(?!\band (?:[a-z]+"
    r" )?(?:detect|look|search|find|spot|watch|run|us|check|scan|mak|pick|hunt)| -"
    r" )[^.;,:]){0,70}\b(?:on|with|using|by|"
    r"in|via|through|"
    r"from|off|"
    r"under) (?:the |a |our |your )?(?:[a-z-]+ )?(?:sonar|side-? ?scan|multi-?beam|sonar"
    r" echo|sub-bottom)"
)
BY_SONAR_BEFORE = r"(?:sonar|side-? ?scan|multi-?beam)[\w ]{0,25}$"
RECORDED = (
    r"(?:record|film|log|sav|writ|stor|start|tap|let|run|sensor|tag|upload|send|transmit)\w* (?:of"
    r" |from |with |the |a |to |up )*(?:[\w-]+ ){0,2}$|"
    r"(?:depths?|soundings?|sounded|depth\w* \w+|water under the keel|read(?:ings?)?|bottom|deep it"
    r" is)\b[^.;]{0,25}(?:from|by|with|off|using|"
    r"on) (?:the )?(?:[\w-]+ ){0,2}$"
)
"""What stands before a sonar that is recorded, or that the depth is taken with."""
ANY_SEEKING = (
    r"\b(?:detect\w*|look(?:s|ed|ing)? (?:out"
    r" )?(?:for|on|at)|search\w*|find\w*|spot(?:s|ting)\b|watch\w* (?:it |the"
    r" )?(?:sonar|display|for)|"
    r"scan\w* (?:it|the|for)|features?\b|pick\w* (?:out|up)|mak\w* out|"
    r"sonar\w* (?:on )?for (?:any|the|a|an|[a-z]+s)\b|hunt\w*|seek\w*|comb\w*|blobs?)"
)
RECORDED_BEHIND = (
    r"^ (?:\w{1,2} )?(?:is |are |be |being |to be |gets? |must be |should be"
    r" )?(?:record\w*|film\w*|on record|rolling|data|files?)\b"
)
"""What stands behind a sonar that is recorded, or whose files are spoken of."""

PLACE_BEFORE = (
    r"(?:\b(?:confirm(?:s|ing)?"
    r" (?:its|their|her)|(?:hold|keep|maintain|stay|remain|retain|resum|regain|chang|reach|assum|tak|leav|shift|adjust|"
    r"correct)(?:e|es|s|ed|ing)?)|\b(?:in|on|into|to|at|from|of|for|around|round|about|over|past|near|by|within|towards|"
    r"between|through|via|is|are|target|start|starting|end|goal|given|planned|stated|last|known|located|found|same|hotspot|turning|final|finish|"
    r"hot|docking|holding|berth|waypoint|task|mooring|ordered|set|"
    r"next|first|second|third|fourth|two|three|both|other|each|every|these|those|as a|by"
    r" eye|hottest|local|this|that|present|ready|one|relative|"
    r"two|new|safe))"
    r"(?: (?:the|your|this|that|its|her|our|a|an|my|their|target|start|starting|goal|given|planned|stated|last|known|present|current|same|located|"
    r"exact|task's|first|second|third|new|final|original))* $"
)
"""What stands before a position that is a place, or that is held, and none that is logged."""
PLACE_BEHIND = (
    r"^ ?(?:\(|\[|-?\d|held|kept|maintained|of (?:the|any|it|what)|x[ =\d]|error|accura|qual|as"
    r" (?:a|the|given|\"|ordered|planned)|yourself|given|"
    r"is reached|reached|has\b|lies|near|north|south|east|west|within|until|ready|named|called|relative|with"
    r" respect|for (?:\d|(?:a|an|\w+) "
    r"(?:seconds|minutes?|hours?|mins|secs)\b)"
    r"|stated|holding|or\b)"
)
"""What stands behind one."""
OF_SHOT = (
    r"(?:still|snap|pic|photo|image|frame|shot|imagery|them|one|each)\w*[^.;]{0,40}\bwith"
    r" (?:its|their|the|a|exact|own|it's|gps|precise)?(?: "
    r"\w+)? ?$"
)
"""What stands before a position that goes with a single image."""

MEASURED_OTHERWISE = (
    r"depth|sound|distan|dist\b|rang|horizon|tilt|angle|pose|offset|pixel|quality|planar|flat|accura|sector|how"
    r" (?:far|close|deep|level|flat)|"
    r"wind|position|clearance|"
    r"obstacle|gps|fix|lidar|\bmeasur\w*"
    r" \d|cylinder|error|closest|nearest|slice|text|letter|measuring \w+ by|level"
)
"""What a measurement in the same clause is of, where it is none of a temperature."""

HEALTH = ("VerifyGeotagQuality", "GetImageQualityMetrics", "GetHorizonAngle", "CheckLensClearness")
"""What a health check covers where its input does not say."""
IMPLIED: tuple[tuple[str, tuple[str, ...]], ...] = (
    (
        r"health|self-?"
        r" ?(?:check|test)\w*|diagnos\w+|(?:sensors?|systems?|equipment|functional|instruments?)"
        r" (?:[a-z]+ )?(?:checks?|tests?)|"
        r"(?:check|test|verify|inspect|go through)\w* (?:[a-z]+"
        r" ){0,3}(?:sensors|systems?|equipment|instruments)|pre-?\w+ checks?",
        HEALTH,
    ),
    (
        (
            r"(?:follow|track|trac|survey|inspect|run along|chase|pursu|go along)\w*"
            r" [^.;]{0,40}(?:cables?|pipe\w*|umbilical)\b"
        ),
        ("DetectSonarFeature",),
    ),
    (
        r"survey\w*|grid|lawn-?mow\w*|mow\w*|mapp?(?:ing|ed)?\b|transects?|chart",
        ("GetSeabedDepth",),
    ),
    (
        (
            r"panoram\w*|pano\b|all[-"
            r" ]round|glare\w*|sectors|reflection\w*|sun\b|sunlight|dazzl\w*|views? (?:all )?round"
        ),
        ("CaptureGeoSnapshot",),
    ),
    (
        r"star(?:e|ing)\b|(?:steady|stare|stead\w+) [^.;]{0,30}(?:at|on|look|feature)",
        ("SetStreamRecording",),
    ),
    (
        r"(?:landing|ladder)[^.;]{0,30}(?:clear|sweep|scan|free|check|safe)\w*|(?:clear|sweep|scan|check)\w*[^.;]{0,40}landing",
        ("LogLidarSlice",),
    ),
    (r"heat\w*|therm\w*|infra-?red", ("LocateHotspot", "GetThermalStats")),
)
"""Words of a task's own name or purpose, and the skills that they stand for where the input names
none that could be meant.
"""

UNMISTAKABLE: dict[str, tuple[str, ...]] = {
    "LockHeading": (
        r"(?:heading|bow|nose) (?:is |stays |stay |kept |to be |must be |being |held )?(?:locked|frozen|fixed)\b",
        r"(?:lock|freeze|fix)(?:s|ing)? (?:the |your |its |her |our )?(?:heading|bow|nose)\b",
        r"(?:with )?heading lock (?:on|engaged)\b",
        r"(?:locked|fixed) (?:heading|bow)\b",
        r"(?:heading|bow)[- ]lock\b",
        r"bow (?:that is )?(?:locked|pinned)\b|(?:keep|hold)(?:ing|s)? (?:the|your|her|its) (?:bow|nose|heading) (?:pinned|locked|fixed|where it)",
    ),
    "ObstacleAvoidance": (
        rf"(?:margin|clearance) of (?:about |at least )?{SIZE}",
        rf"{SIZE}[ -](?:of )?(?:safety )?(?:margin|clearance)\b",
        rf"(?:keep|stay)(?:ing)? (?:at least )?{SIZE} (?:away from|clear of|off) (?:everything|anything|obstacles|any obstacle)",
        r"obstacle avoidance (?:on|at)\b",
        rf"(?:avoid(?:ing)?) obstacles (?:by|with) (?:a margin of |at least )?{SIZE}",
        rf"{SIZE} of (?:clear water|room|space)\b",
        rf"come closer than {SIZE}",
        rf"clearance (?:is|at) {SIZE}",
    ),
    "BoundaryEnforcement": (
        r"(?:inside|within|respect(?:ing)?|apply(?:ing)?|enforc(?:e|ing)|obser(?:ve|ving)) the (?:geo|virtual )?-?(?:fence|boundary|geofence|"
        r"polygon)\b",
        r"geo-?fence on\b|(?:fence|boundary) (?:on|enforced|applies)\b",
        r"(?:stay|keep|remain)(?:ing)? (?:inside|within) (?:the (?:box|area|polygon|fence) )?(?:with corners )?[\[(] ?-?\d",
        r"(?:stay|keep)(?:ing)? to the inside of [\[(] ?-?\d|the (?:fence|limits|boundary|box|polygon) [\[(] ?-?\d",
    ),
    "DetectObjects": (
        r"(?<!sonar )(?<!feature )(?:object )?detector (?:on|running|runs|look(?:s|ing)?)\b",
        r"run(?:ning)? (?:the )?(?:object )?detector\b",
        r"object detection (?:on|running|for)\b|run(?:ning)? object detection",
        r"(?:camera|object) detection of\b|detector on\b|look-?out for (?!the |hot)[a-z]|eyes (?:peeled|open) for\b|mind(?:ing)? out for\b|"
        r"whether there are (?:any )?[a-z, -]{3,40} about\b",
        r"when the camera sees\b|watch (?:is )?kept for\b",
    ),
    "TrackObjects": (
        r"(?:object )?tracker (?:on|running|runs|following|follow)\b|object tracking (?:on|of)\b|run(?:ning)? (?:the )?(?:object )?tracker\b",
        r"(?:persistent|object) tracking of\b|(?:keep|keeping) tabs on\b|go(?:ing)? on tracking\b|the tracker on\b|on to the id of\b|"
        r"steady track of\b|the identity of\b",
    ),
    "OCRScanning": (
        r"(?:run(?:ning)?|do(?:ing)?|us(?:e|ing)) ocr\b|ocr (?:on|of|running|runs|is run)\b|read(?:ing)? (?:the |any )?(?:text|lettering|"
        r"writing)\b",
        r"text (?:recognition|reader)\b|(?:the|any) (?:text|lettering|writing|letters) (?:in|on) the\b|what (?:is written|the lettering)\b|"
        r"which characters\b",
    ),
    "GetThermalStats": (
        r"(?<!upload the )(?<!send the )thermal (?:statistics|stats|readings)\b|(?:measur\w+|tak(?:e|ing)) (?:the )?temperatures?\b",
        r"(?:infrared|thermal) (?:figures|statistics) of\b|(?:heat|temperature) statistics\b|mean and (?:the )?max\w* temperature\b",
    ),
    "LocateHotspot": (
        r"(?<!to )(?:locat|find|pinpoint|localis|determin)\w* (?:the )?(?:hottest (?:point|spot)|hot ?-?spots?)\b",
        r"where the hottest (?:point|spot) is\b|coordinates of the (?:hottest|warmest)\b|point(?:ing)? out the (?:hottest|warmest)\b|"
        r"where it is hotter than\b",
    ),
    "CheckLensClearness": (
        r"lens check\b|check(?:ing|s)? (?:the )?lens(?:es)?\b|lens(?: of [\w -]{1,20})? (?:is |are )?(?:checked)\b|lens clearness\b",
        r"droplet check\b|(?:drops|droplets|spray|salt|salt water) on the (?:lens|glass)\b|needs wiping\b|lens (?:for (?:drops|spray|salt)|is wet)\b",
    ),
    "GetImageQualityMetrics": (
        r"(?:image|picture) quality\b",
        r"how (?:good|usable|sharp) the (?:picture|image|video)\b|usable picture\b|frames can be used\b|video quality\b",
    ),
    "CalculateVisualOffset": (
        r"(?:visual|pixel) (?:offset|error)s?\b",
        r"how many pixels\b|offset in pixels\b|off[- ]cent(?:re|er)\b|from the (?:image cent(?:re|er)|middle of the picture)\b",
    ),
    "GetSectorDistance": (
        r"sector distances?\b",
        r"(?:minimum|shortest|smallest) (?:lidar )?range\b|nearest return\b|what is nearest towards\b|nearest in the sector\b",
    ),
    "DistanceToObstacle": (
        r"obstacle distances?\b|distance to (?:the )?(?:nearest )?obstacles?\b",
        r"how far (?:off )?the next (?:obstacle|thing)\b|(?:room|distance) in front within\b|gap to the (?:next|nearest|obstacle)\b|"
        r"range (?:to|of) the (?:next |nearest )?obstacle\b",
    ),
    "FitCylinderModel": (
        r"cylinder (?:model )?fit(?:s|ting)?\b|fit(?:ting|s)? (?:a |the )?cylinder\b|cylinder (?:is )?fitted",
        r"cylinder model\b|round shape (?:in|out of|from)\b|whether a cylinder fits\b|pile model\b",
    ),
    "CheckPlanarity": (
        r"planarity\b|flatness\b",
        r"(?:whether|if|that) [\w' -]{1,40} (?:bulges|bows out|is flat|has a bulge|is (?:even|straight) or)\b|for (?:dents|bulges)\b",
    ),
    "DetectSonarFeature": (
        r"sonar (?:feature )?detect(?:ion|or)\b|detect(?:ing|s)? (?:[a-z]+ ){1,4}(?:on|with) the sonar\b|sonar (?:looking|searching|watching) "
        r"for\b",
        r"(?:any|an?) [\w -]{3,30} on the sonar\b|sonar (?:shows any|for any|picture for|pick out|detection of)\b|(?:search|watch)(?:ing)? the sonar\b",
    ),
    "GetSeabedDepth": (
        r"(?:seabed|water) depth\b|depths? (?:readings?|soundings?|log(?:ged|ging)?)\b|soundings\b|(?:log|measur|read|record|"
        r"tak)\w* (?:the )?depths?\b",
        r"how deep it is\b|how much water\b|depth (?:on|in|along|throughout)\b|line of soundings\b|how far down the bottom\b",
    ),
    "GetHorizonAngle": (
        r"horizon (?:angle|tilt)\b|(?:tilt|angle) of the horizon\b",
        r"tilt against the skyline\b|lean of the skyline\b|horizon is (?:level|tilted)\b|how level\b|far from level\b|slant of the horizon\b",
    ),
    "GetGPSLocation": (
        r"(?:gps|position) fix(?:es)?\b|tak(?:e|ing) (?:a |gps |position )?fix(?:es)?\b|(?:log|record)(?:ging|ing)? (?:the )?gps(?: "
        r"position)?\b(?! (?:acc|qual|err))",
        r"get(?:ting)? a fix\b|(?:note|log|track|plot|record|trace)(?:d|ging|ing)?(?: of)? where (?:we|she|you)\b|lat and long\b|"
        r"position (?:is |to be )?(?:logged|noted|recorded)\b|(?:jot|note|log|write|read)\w* (?:down |off )?our (?:position|coordinates)\b|"
        r"satellite position down\b",
    ),
    "SelectActiveStream": (
        r"(?:as|the|set) (?:the )?active stream\b|select(?:ing)? (?:the )?(?:stream|[a-z]+ stream|[\w-]*cam[\w-]*)\b",
        r"(?:switch|change) over to (?:the )?[\w -]{0,20}(?:stream|feed|view|cam\w*)\b|change the view to\b|the view through\b|"
        r"as the live picture\b",
    ),
    "SetStreamRecording": (
        r"(?:record|film)(?:ing)? (?:video|footage)\b|(?:start|run)(?:ning|ing)? (?:the |a )?recording\b|recording (?:on|running)\b|"
        r"record(?:ing)? (?:with )?(?:the )?(?:[a-z-]+ )?(?:cam\w*|camera|sonar|radar|sss\w*|hydrophone)\b|film(?:ing)? (?:it|everything|"
        r"the whole)\b",
        r"all on (?:video|tape)\b|camera rolling\b|shoot(?:ing)? video\b|"
        r"(?:have|keep) (?!an? )(?:the )?[\w-]+(?: [\w-]+)? (?:(?<!on )record|rolling)\b|recording of\b",
    ),
    "BufferLoopCapture": (
        rf"(?:sav|captur|grab|dump|stor|keep|secur)(?:e|ing|s)? the last (?:{COUNT}[ -]?){{1,5}}(?:s|sec\w*|min\w*|"
        r"hours?) (?:of (?:the )?)?(?:video|footage|buffer)\b|"
        r"(?:sav|dump|captur)(?:e|ing|s)? the (?:video |loop |ring )?buffer\b|(?:video|loop) buffer (?:is )?saved",
        rf"(?:last|past) (?:{COUNT}[ -]?){{1,5}}(?:s|sec\w*|min\w*) (?:of (?:video|footage)|out of the (?:video )?buffer)\b",
    ),
    "CaptureGeoSnapshot": (
        r"geo-?tagged (?:snapshots?|stills?|pictures?|photos?|images?|frames?)\b|geo-? ?snapshots?\b|(?:tak|captur|sav|shoot|get)\w* (?:a |one "
        r")?snapshots?\b(?! of (?:the )?env)",
        r"(?:still|photo|picture|frame|image)s? (?:tagged )?with (?:its|their|the)? ?(?:position|coordinates)\b|located still\b",
    ),
    "LogLidarSlice": (
        r"(?:lidar|laser) (?:slices?|profiles?) (?:logged|saved|logging|with a scan)\b|(?:log|sav|stor|record)(?:e|ging|ing)? (?:an? |the "
        r")?(?:2d )?lidar (?:slices?|profiles?|sweeps?)\b",
        r"(?:writ|stor|keep|sav|log)(?:e|ing|es|ging)? a (?:lidar|laser) (?:slice|profile|cross-section)\b|laser cross-section\b|2d profile\b",
    ),
    "LogEnvironmentState": (
        r"(?:log|record|sav)(?:e|ging|ing)? (?:the )?environment(?:al (?:state|data|conditions|sensors))?\b|"
        r"environment(?:al)? (?:log|record|snapshot|logging)\b|environment(?:al (?:state|data|conditions|sensors))? (?:is |are )?logged\b",
        r"weather log\b|(?:take|write) down (?:the conditions|wind and weather)\b|met readings\b|record of wind and weather\b|"
        r"what the environmental sensors read\b",
    ),
    "GetRelativePose": (
        r"relative pose\b|pose relative to\b",
        r"(?:our|the) pose (?:relative|against)\b|position and angle relative\b|how we (?:lie|are placed)\b|at what angle we\b|"
        r"where we are with respect to\b",
    ),
    "VerifyGeotagQuality": (
        r"geotag quality\b|gps accuracy\b|accuracy of the gps\b|gps (?:error|is (?:good|accurate))\b|horizontal (?:gps )?accuracy\b",
        r"fix(?:es)? (?:is|are) good to\b|check of the fix\b|trust the fix\b|fixes can be trusted\b|horizontal error\b|the satellite fix to the test\b",
    ),
    "CreateMapMarker": (
        r"drop(?:ping|s)? (?:a |the )?(?:map )?(?:pin|marker)\b|map marker (?:labelled|called|named)\b|(?:creat|plac|put|set|add|leav|mak)(?:e|"
        r"ting|ing)? a (?:map )?(?:pin|marker)\b|pin on the map\b",
        r"chart mark\b|flag on the (?:chart|map)\b|the spot on the (?:map|chart)\b|pin (?:named|the place|the spot)\b",
    ),
    "RegisterObservation": (
        r"(?:register|log|enter|record|note)(?:ing|s)? (?:the|an) observation\b|observation [^.;,]{0,40}(?:registered|logged|entered|recorded)"
        r"\b|regist(?:er|ering)\b",
        r"entry in the logger\b|into the logger\b|down as seen\b|log entry, \"",
    ),
}

HARMLESS = (
    r"\b(?:and |but )?(?:nothing (?:else|more|besides)(?: is needed| runs)?|otherwise nothing(?:"
    r" runs)?|nothing otherwise|nowhere else|"
    r"at no other time|no more than that|"
    r"no other sensor at any time|none before|not (?:in|on|during|before|after|between) (?:the"
    r" )?[\w-]+(?: [\w-]+)?(?=[.,;:]|$)|let nothing(?= come)|"
    r"(?:all|every\w*|each|throughout)(?: \w+)? but (?:in |on |at |for )?(?:the )?|but"
    r" (?:only|just)|"
    r"(?:find(?:ing)? out|see|tell(?: me| us)?|say|check|know|learn|ask|report|word on) if|if there"
    r" (?:is|are) any)\b"
)
"""Phrases that bound what is asked for and take none of it back."""
