"""The words that a task input can ask by for what is measured: distances, shapes, depths,
positions. Read on text in small letters.
"""

from __future__ import annotations

MEASURING: dict[str, tuple[str, ...]] = {
    "GetSectorDistance": (
        r"sectors?\b(?= (?:min|at|on|to|towards|bearing|ahead|dist|rang|measur|between|read|\d))|sectors?\b[^.;]{0,50}(?:dist|rang|lidar|clos|near|"
        r"bearing|watch|monitor|read|measur|log)",
        r"(?:dist|rang|lidar|clos|near|watch|monitor|read|measur|scan|guard|query|quer|check|log|tell|min)\w*[^.;]{0,60}sectors?\b",
        r"(?:quer|rang|check|dist|clos|near|minim|return|watch|monitor|read|measur|smallest|shortest)\w*[^.;,]{0,40}slices?\b|"
        r"slices?\b[^.;,]{0,40}(?:rang|quer|dist|return|check|monitor|read)|in (?:the|that|this|a) slice",
        r"(?:minim\w*|min\.?|short\w*|small\w*|closest|close|nearest|least|lowest) (?:[a-z0-9-]+ ){0,4}(?:distanc\w*|dist\b|rang\w+|returns?|"
        r"echo\w*|hits?\b|points?\b|thing|gap|lidar|laser)\b",
        r"(?:distance|dist|range|ranging|lidar|laser)\b(?:(?!slice|profile|cut|section|sweep|logg|logs?\b|cloud|scan|grid|"
        r"spacing)[^.;]){0,40}?(?:bearing|brg|direction|towards|\b(?:at|on|to|along) (?:the |due )?(?:\d|north|south|east|west|port|starboard|left|"
        r"right|bow|stern|beam|ahead|astern|dead))",
        r"(?:bearing|brg|direction)s?\b[^.;]{0,40}(?:distance|dist\b|range|lidar|laser|closest|nearest)",
        r"how (?:close|near) (?!the nearest obst)|closest|nearest (?:return|thing|echo|point|object)|lidar (?:distance|range|dist)s?\b(?! (?:to|"
        r"from|of) (?:the )?(?:nearest |next )?(?:obst|whatever|what|wall|structure|thing))(?! (?:ahead|in front|over|in a))",
        r"(?:port|starboard|left|right|forward|aft|ahead|astern|north|south|east|west)\w* (?:side )?(?:distance|range)\b|(?:watch|rang|quer|"
        r"monitor|guard)\w* (?:the )?(?:[a-z]+ ){0,2}(?:bearing|brg|sector)",
        r"what(?:ever)? (?:is|lies|stands|comes) (?:the )?(?:nearest|closest)|(?:nearest|closest) (?:thing |return |echo |point )?"
        r"(?:towards?|(?:at|on|in|to) (?:bearing|\d|north|south|east|west))",
        r"slices? (?:that (?:lies|points) )?(?:towards?|at|to|on|in the direction|bearing)\b|(?:laser|lidar) on (?:the |that )?(?:slice|sector|"
        r"bearing)",
    ),
    "DistanceToObstacle": (
        r"obstacle[ -](?:distance|dist|rang)\w*|(?:distance|dist|rang\w+|far|close|near|measur\w+|gap|lidar|detect\w*|watch\w*|monitor\w*|"
        r"how)\b(?: (?!horizon|level|slice|profile|and\b|while\b)[\w-]+){0,6} (?:obst\w+|ahead|in front|whatever (?:is|lies)|what (?:is|lies)|"
        r"wall|structure|hazard)",
        r"obstacles?\b[^.;]{0,40}(?:distanc|rang|measur|far\b|read|dist\b)\w*|fields? of view|fov\b|cone\b|view angle|opening angle",
        r"rang(?:e|es|ed|ing)\b(?! (?:of|the slice|that slice))|rangefinder|(?:lidar|laser) (?:distances?|dist|ranges?|measur\w*)\b(?! (?:at|on|"
        r"in|for|towards|to) (?:the )?(?:bearing|brg|sector|slice|\d|port|star|left|right|north|south|east|west))|how (?:far|close|near|"
        r"much room)\b(?! [^.;]{0,30}(?:cent|off))|distance ahead|forward distance|gap\b",
        r"(?:measur|report|get|give|log|monitor|check|read|watch|record|tak|tell|determin|find|estimat|return|what|obtain|lidar|laser|comput|"
        r"calculat|keep|not|run|ask)\w* (?:[a-z-]+ ){0,4}"
        r"(?<!\bfull )(?<!\bmax )(?<!\bmaximum )(?<!\bgiven )(?<!\bstated )(?<!\bset )(?<!\bsafe )(?<!\bsafety )(?<!\bwhole )(?<!\byour )"
        r"(?<!\bsector )(?<!\bclear )"
        r"(?<!\btrack )(?:distances?|"
        r"dist)\b(?! (?:of (?:the (?:task|track|pass|run)|\d)|in the (?:task|order)|(?:at|on|in|for|towards) (?:the |that )?(?:bearing|brg|sector|"
        r"slice|\d)))",
        r"(?<!\bsector )(?<!\bsafe )(?<!\bsafety )distances? (?:to|readings?|measure\w*|logg\w*|running|wanted|needed|off\b|between|over|ahead|"
        r"with a)\b(?! (?:the )?(?:start|task|target|end))",
        r"(?:room|space|water|way|free|clear|open|far|near|thing|next|metres|lies|is|romo)\b[^.;,]{0,25}(?:in front|ahead|before (?:us|you|her|"
        r"the bow))\b|(?:in front|ahead) (?:within|over|in) |(?:gap|room|space|far) [^.;,]{0,20}(?:to|from|until|before) (?:the |any )?(?:next|"
        r"nearest) (?:thing|object|wall|obst)",
    ),
    "FitCylinderModel": (
        r"round\?",
        r"\w*cylind\w*|cyl\b|\w*cloud\w*|pcl\w*|fit(?:s|ted|ting)?\b(?! for (?:use|purpose))|round shape|tubular|diameter|(?:large|big|the|"
        r"any) curve\b|curve (?:in|from|fit)|circle fit\w*|models?\b|modell?(?:ed|ing)|round (?:pile|column|pillar|thing)",
        r"circular|tubes?\b|(?:something|anything|whatever is) round\b|(?:round|curved) (?:object|post|thing|leg|pile|column)s?\b|curve of",
    ),
    "CheckPlanarity": (
        r"flat\w*|\w*planar\w*|planes?\b|bulg\w*|curved|curvature|warp\w*|buckl\w*|bent\b|even(?:ness)?\b(?! (?:spaced|if|when|one|though))|"
        r"uneven\w*|smooth\w*|bow(?:ed)\b|straightness|deform\w*|distort\w*|convex|concave|level (?:surface|deck|plate|wall|face)",
        r"bow(?:s|ing)? (?:out|in|inwards?|outwards?)\b|dent(?:s|ed)?\b|bump(?:s|y)?\b|wav(?:y|iness)\b|sag(?:s|ged|ging)?\b|hollow\w*|"
        r"straight or|(?:is|are|runs?|stands?|lies?|still) straight\b|(?:out of|in) true\b",
    ),
    "DetectSonarFeature": (
        r"\w*sonar\w*|side-? ?scan\w*|\w*sss\b|blobs?\b|acoustic\w*|(?<!\blaser )echo(?:es)?\b(?! ?-?sound)|multi-?beam\w*|mbes\w*|asdic|"
        r"sub-?bottom|features?\b[^.;]{0,20}(?:seabed|bottom|display|sea floor)|hydro-?acoustic\w*|ping(?:s|ing)?\b",
        r"(?:sea-?bed|sea-? ?floor|under ?water|down there|subsea)\b[^.;]{0,40}(?:search|look|detect|find|watch|scan|comb|features?|objects?|"
        r"contacts?)|(?:search|look|detect|find|watch|scan|comb|sweep|check)\w*[^.;]{0,40}"
        r"(?:sea-?bed|sea-? ?floor|bottom|under ?water|down there)\b(?! (?:left|right|half|of))",
    ),
    "GetSeabedDepth": (
        r"\w*depth\w*|depht\w*|sound(?:s|ed|ing|ings|er|ers)?\b|\w*sounder\w*|\w*bathy\w*|deep\w*|shallow\w*|keel\b|\w*sea-? ?bed\b|sea-? ?floor|fathom\w*|"
        r"altimeter\w*|ukc|dvl\w*|mbes\w*|sbes\w*|lead-? ?line|hydrograph\w*|echo[ -]?sound\w*|echo_\w*",
        r"bottom\b(?! (?:left|right|half|third|of (?:the )?(?:frame|picture|image)|edge|corner))|water (?:below|under|beneath|depth)|(?:below|"
        r"under|beneath|underneath) (?:us|you|her|the (?:boat|vessel|hull|vehicle|usv|craft))|how much water",
    ),
    "GetHorizonAngle": (
        r"sea ?-?line\b",
        r"\w*horizon(?!tal)\w*|tilt\w*|inclin\w*|(?:how|is|are|be|lies?|lying|stays?|sits?) level\b|levelness|heel(?:s|ing|ed)?\b|list(?:s|"
        r"ing)? to (?:port|starboard)|(?:any|her|much|angle of) list\b|skew\w*|slant\w*|imu\w*|gyro\w*|ahrs\w*|mru\w*|inertial\w*",
        r"sky-?line\w*|lean(?:s|ed|ing)?\b|upright|(?:even|level) keel|"
        r"(?:are|is) (?:we|she|it|the (?:boat|vessel)) level\b|lopsided|crooked|(?:sit|lie|rid|stand|float|lying)\w* (?:straight|level|"
        r"even|true)\b|(?:a|any|her|the|what) list\b(?! of)|out of level|off (?:the )?(?:level|horizontal)|(?:from|how far from) level",
    ),
    "GetGPSLocation": (
        r"positions? (?:is |are )?(?:known|wanted|asked)|where (?:exactly|precisely|on (?:the )?(?:chart|map|earth)|in the world|about) (?:you|"
        r"we|she|i|it|the (?:boat|vessel))\b",
        r"(?<!\baccuracy of the )(?<!\baccurate the )(?<!\bgood the )(?<!\bquality of the )(?<!\bthat the )(?<!\bwhether the )(?<!\bhow "
        r"accurate )(?:gps|gnss|"
        r"satnav|sat-?nav|(?<!\bexact the )(?<!\bgood the )satellites?)\b(?![- ](?:accura|qualit|error|precis|(?:is|can be|to be|are) (?:good|acc|"
        r"within|better|below|under|ok|trust|check|verif|precise|sound)))",
        r"(?:gps|gnss)[- ](?:accura\w*|quality|error|check)[^.;]{0,30}(?:and|plus|,|with) (?:[a-z]+ )?(?:fix|position|location)",
        r"(?<!\bsatellite )fix(?:es)?\b(?! (?:the|your|its|her|our|a) (?:heading|bow|nose|coordinates of the hot))(?! on the identity)|"
        r"satellite fix(?:es)?\b(?! (?:is|can))",
        r"(?:positions?|posn|pos|whereabouts|locations?|latitude|longitude|coordinates?|coords?)\b",
        r"(?:find out|know|tell\w*|log|report|say|note|record|see|check|show|work out)\w* [^.;,]{0,10}where (?:you|we|she|i|the boat)|(?:logged|"
        r"recorded) by (?:its |the )?position|(?:log|record|keep|save|store|note|gps|plot)(?:s|ging|ing|ed)? (?:of )?(?:the |a |your |"
        r"our )?(?:[a-z]+ )?tracks?\b(?! of)|tracks? (?:is |are )?(?:logged|recorded)",
        r"breadcrumb\w*|lat/?lon\w*|lat\b|lon\b|latitude|longitude|wgs\w*",
        r"(?:keep\w*|hold\w*) (?:the |a )?track of (?:our|your|the|her) positions?\b|"
        r"(?:track|trace|log|record|note|history|list|plot\w*|trac\w*|learn\w*|sav\w*|ask\w*|keep\w*|writ\w*) (?:of |down |out |"
        r"up )?(?:exactly |precisely )?where (?:you|we|she|i|the boat)|lat(?:itude)? and lon\w*|(?:what|which) (?:spot|place|point) (?:you|we|"
        r"she) ",
    ),
    "GetRelativePose": (
        r"distance and (?:angle|direction) of|place and (?:attitude|angle)|as [^.;,]{1,30} sees? (?:it|us|her)\b|\w*poses?\b|relativ\w*|attitude|"
        r"orientat\w*|in the frame of|(?:with|in) (?:respect|relation|reference) to|(?:dock|local|body|marker|tag|"
        r"berth|quay|landing) frame|6-?dof|6 ?d\b|how (?:you|we|she|it) (?:lie|sit|stand)s?|rel\b",
        r"how (?:do |does |are |is )?(?:you|we|she|it|the (?:boat|vessel|hull|bow)) (?:are |is )?(?:lie|lying|sit|stand|placed|plac|point|com|"
        r"bear|align|turned)\w*|(?:what|which) angle\b|angles? (?:to|relative|against|between|with)\b|placed (?:against|relative|to|with|"
        r"towards)|(?:position|place|placing|pos)\b[^.;,]{0,12} (?:against|as against)|in relation to|seen from (?:the|its)",
    ),
    "VerifyGeotagQuality": (
        r"(?:scatter|spread|jitter|wander)\w* (?:of|in|on) (?:the |its |your )?(?:gps|gnss|fix)|"
        r"\w*accura\w*|acc\b|precis\w*|[hp]?dop\b|exact(?!ly)\w*|trust\w*|reliab\w*|geo-? ?tags?\b(?! (?:still|snap|pic|pho|im))|"
        r"geo-? ?tag\w* (?:qual|check|verif|valid|are|is|good)\w*|horizontal(?:ly)?\b|cep\b",
        r"(?:gps|gnss|fix(?:es)?|satellite\w*)\b(?: (?!and\b|while\b)[\w,-]+){0,5} (?:quality|errors?|good|better|below|under|within|less|"
        r"valid\w*|verif\w*|check\w*|test\w*|confirm\w*|threshold|limit|to \d|for \d|down to|ok\b|sound\b|strong)|position(?:al|s)? (?:quality|error|"
        r"is (?:good|acc|right|correct|within)|are (?:good|acc)|good)",
        r"(?:verif|check|confirm|validat|test|ensur|make sure|making sure|see that|see whether|see if|prov|how good|quality of|error of|error on|"
        r"assess|monitor|limit)\w*(?: (?!and\b|while\b|lens)[\w:-]+){0,5} (?:gps|gnss|geo-? ?tag\w*|fix\b|fixes|satellite)|(?:verif|validat|"
        r"confirm)\w* (?:the |your |our )?positions?",
        r"fix\b[^.;]{0,4}\(?[\d.]+ ?m\b|(?:checklist|check)\b.*\bfix\b|(?:good|true|right|correct|valid) to (?:within )?|(?:check|"
        r"test)\w*:[^.;]{0,60}(?:gps|gnss)",
        r"(?:gps|gnss|fix(?:es)?|satellite\w*|receiver|position\w*)\b[^.;,]{0,30}\b(?:wrong|off|out by|err\w*|believ\w*|stand\w* up|hold\w* up|"
        r"count\w* on|rel(?:y|ied)|to the test)\b|(?:rely|relying|count|bank|depend)\w* on (?:the |our )?(?:gps|gnss|fix|sat|position)",
    ),
}
