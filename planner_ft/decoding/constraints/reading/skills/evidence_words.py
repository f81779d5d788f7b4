"""The words that a task input can ask for a filter or perception skill by, for `evidence`. Patterns are read on text in small letters.

What a skill can be meant by is taken broadly: a word that fits two skills stands with both. Where the words behind or before make plain that another
skill is meant ("record the depth" records no stream), the pattern passes them over.
"""

from __future__ import annotations

LENGTH = r"(?:m|metres?|meters?|ft|feet|foot|yds?|yards?|fathoms?|cables?|km|kilomet\w+|miles?|nm|boat ?-?lengths?|lengths?)"
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
_GAP = r"(?:[a-z'-]+ ){0,3}"
SENSED = (
    r"(?:(?!and\b|while\b|with\b|as\b|when\b|then\b|or\b)[a-z'-]+ ){0,4}(?:env\w*|depths?|\w*position\w*|gps|gnss|tracks?|fix\w*|slices?|"
    r"profiles?|temp\w*|"
    r"therm[a-z]*\b(?! (?:cam|stream|feed|view))|horizon\w*(?! cam)|tilt|"
    r"distance\w*|sector\w*|pose|offset\w*|pixel\w*|quality|wind|weather(?! station)|conditions?|surroundings?|soundings?|obstacles?|observation\w*|"
    r"coordinates|accuracy|geo\w*|snap\w*|stills?|flat\w*|planar\w*|met|sea state|angle)\b"
)
"""What can be logged, read or measured besides a stream, with some words before it."""

_CLASSES = (
    r"people|persons|persons? (?:in|over)|swimmers|divers?|(?:life ?|jet ?)?(?:rafts|jackets|boats|skis)|kayaks|canoes|dinghies|yachts|ships|"
    r"vessels|ferries|tugs|barges|"
    r"buoys|pots|birds|gulls|seals|whales|dolphins|porpoises|turtles|debris|logs|driftwood|trunks|ropes|nets|floes|ice|weed|seaweed|oil|slicks?|"
    r"waste|"
    r"plastic|rubbish|flotsam|wreckage|cracks|corrosion|rust|dents|growth|damage|defects?|drones|containers|pontoons|surfers|windsurfers|boarders|"
    r"rowers|"
    r"trawlers|tankers|workboats|inflatables|pallets|tyres|tires|obstructions|crew|survivors?|casualt\w+|man overboard|mob|"
    r"fenders|ladders|piles|anchors|cables|hulls|cyclists|anybody|anyone|someone|animals?|fish|floating|intruders?|"
    r"lobster\w*|crab\w*|paddle\w*|liferaft\w*|lifeboat\w*|speedboats?"
)

SPOKEN: dict[str, tuple[str, ...]] = {
    "LockHeading": (
        r"(?:un)?lock(?:ed|s|ing)?\b(?! (?:gates?|on\b|onto|the (?:picture|camera|view)))|(?:heading|bow|nose|hdg) ?-?lock\w*",
        r"(?:hold|keep|maintain|fix|freez|froz|pin|steady|leav|let|preserv|retain|constant|same|present|unchang|engag|stabil|clamp|tie|secur|"
        r"rigid|stay|remain|"
        rf"guard|sav|current|lash|nail|immobil|stead|unwaver|glue)\w*[ ,]+{_GAP}{BOW}\b(?! (?:to|of|towards)\b)",
        rf"(?:hold|keep|fix|freez|pin)\w* {_GAP}(?:bow|nose|heading|head) (?:to|on) (?:its|the|her|your) ",
        rf"{BOW}\b[ :-]+(?:[a-z']+ ){{0,4}}(?:lock|hold|held|keep|kept|fix|freez|froz|pin|stead|constant|same|unchang|stay|remain|must not|not mov|"
        r"may not|not to|as it is|"
        rf"as is|where it|rigid|unmov|still\b|maintain|tied|nailed|stabil|free\b|control|clamp|preserv|retain|immobil|wander|motionless)",
        rf"(?:not|n't|never|without|no|stop|prevent)\b[^.;]{{0,25}}(?:swing|turn|chang|yaw|wander|veer|slew|twist|fall off|"
        rf"rotat)\w*[^.;]{{0,20}}{BOW}",
        rf"(?:not|n't|never|without|no|stop|prevent)\b[^.;]{{0,25}}{BOW}\b[^.;]{{0,25}}(?:swing|turn|chang|yaw|wander|veer|slew|twist|fall|rotat|"
        r"move)",
        r"(?:point|fac|look)\w*[^.;,]{0,20} (?:the same (?:way|direction)|where (?:it|she|you|we))|nose direction|heading-?hold",
        r"(?:must not|mustn't|may not|don't let (?:her|the boat|it|yourself)|never|without) (?:[a-z]+ )?(?:yaw|slew|veer)\w*|no (?:yawing|"
        r"slewing|veering)",
    ),
    "ObstacleAvoidance": (
        rf"{SIZE} (?:minimum|safe) (?:distance|separation)|minimum (?:distance|separation)(?:,| of| is)? {SIZE}",
        r"giv\w+ way\b",
        r"\w*margins?\b|marg\b|clr\b|oa\b|\w*avoid\w*|collision|collid\w+|anti-?coll\w+|evad\w+|evasi\w+|dodg\w+|proximity|skirt\w*|bump\w*|hit\b|"
        r"hitting|touch(?!down)\w*|safety",
        r"clear(?:ance|ances|ing)?\b(?! (?:of (?:drop|water|spray|salt|dirt)|lens|cam))",
        r"berth of|wide berth|(?:a|enough|good|any|some) berth|giv(?:e|es|ing) [^.;,]{0,40}berth",
        r"(?:closer|nearer)\b|(?:nearest|closest) (?:you|we|she|it|that|one|anything|to any)|(?:come|get|go|pass|approach|stray|ventur|too|so|"
        r"stay|keep)(?:s|ing|e)? (?:too |so |any |very )?(?:close|near)\b",
        r"(?:safe\w*|keep\w*|your|hold\w*|stay\w*|maintain\w*|respect\w*|leav\w*|mind|have|having) (?:(?!measur|log|monitor|sector|record|read|visual|rang|"
        r"obst|within|inside|station|position|lidar|laser|shortest)[a-z0-9.-]+ ){0,4}"
        r"(?:distance|separation|gap|space|room)\b|separation|minimum (?:safe\w* )?distance (?:of|to|from)",
        rf"{SIZE}[ -]?(?:clear|off\b|of (?:room|space|water|sea ?room|distance|separation|air)|separation|gap|buffer|between|"
        r"away (?:from )?(?:from|every|any|all|obst|other)|"
        r"(?:from|to) (?:any|every|all|obst|other|boats|traffic|neighb|the (?:near|neighb|next|wall|struct|quay|pier|face|jetty|hull|pile|tow|"
        r"landing|rocks|shore|bank)))",
        rf"(?:at least|no less than|not less than|no closer than|minimum|min\.?|a full|a good|always) (?:of |by )?{SIZE}",
        rf"(?:within|inside|under) {SIZE}(?: of| from)?(?: (?:any|us\b|you\b|her\b|the (?:boat|vessel|hull|craft)|everything|obst|other|them|me\b))",
        rf"(?:no|nothing|none|never|n't|not)\b[^.;]{{0,40}} within {SIZE}",
        r"(?:allow|leav|giv|keep|stay|maintain|have|pass|add|grant|want|hold|with)(?:e|es|s|ing|ed)? (?:(?!within|inside|radius|circle|in\b|on\b|"
        rf"to\b|at\b|by\b|over|of\b|for\b|station|position)[a-z'-]+ ){{0,3}}{SIZE}(?! (?:radius|circle|wide|long|spacing|apart))",
        rf"{SIZE} (?:all (?:a?round|the)|will (?:do|have)|is (?:the|your|enough|fine|plenty)|on (?:both|all|each|every)|min\b)",
        rf"[:=] ?{SIZE}",
        r"(?:steer|keep|stay|stand|hold)\w* (?:well )?(?:clear|away|round|around|off (?:every|any|all|the |other))|away from|off (?:everything|"
        r"anything|any|all|obst|other)",
        r"(?:keep|stay|pass|leav|hold|maintain|mind|bewar|miss|steer|heed|let|go\w* round|clear)\w*(?: (?!rang|measur|log|monitor|record|read|"
        r"watch|look)[\w,-]+){0,7} (?:obstacles?|obstructions?|hazards?|traffic|"
        r"(?:every|any)thing(?! (?:else|on|running))|other (?:boats|vessels|craft|traffic))",
        rf"bubble\b|buffer zone|buffer distance|buffer of (?:at least )?{SIZE}|sea-?room|elbow ?room|keep-?out|no-?go|in (?:the|your|our|its) way\b|"
        r"in (?:the|your) path",
    ),
    "BoundaryEnforcement": (
        r"playground",
        r"\w*fenc\w*|\w*bound(?!\b)\w*|(?:in|out of|within|of|the) bounds\b|bound (?:by|to|the|your|us|you)\b|polygon\w*|poly\b|perimeter\w*|enclos\w+|corral|"
        r"cordon\w*",
        r"(?:the|a|this|that|in|inside|within|leave|geo-?|virtual|allowed|safety|permitted|given|corner) box\b(?! (?:search|survey|\d))|"
        r"^box\b(?! search)|[.,;:] box\b"
        r"(?! search| by box)|boxed in|(?:in|inside|within|leav\w*|out of) (?:the |a |its |this )(?:pen|cage)\b|"
        r"(?:in|inside|within|to|leav\w*|out of|respect\w*|enforc\w*|apply\w*|with|under|and|by) (?:the |a |an |this |that |its )?(?:rectang\w+|"
        r"quadrilateral|trapez\w+|triang\w+)|"
        r"(?:rectang\w+|quadrilateral|trapez\w+|triang\w+)[^.;]{0,60}(?:leav|left|cross|outside|appl|enforc|observ|respect|hold|count|in force)",
        r"confin\w+|restrict\w+|hem(?:med)?\b|limit\w*(?! (?:of )?[\d.])|zones?\b|borders?\b|territor\w+|envelope|keep-?in\b|safe area|sandbox|"
        r"domain|permitted|allowed (?:area|region|water)|hard limit",
        r"(?:inside|within|outside)\b(?! (?:the |an? |your |its )?(?:given |set |stated |whole |same )?(?:threshold|tolerance|accuracy|frame|"
        r"picture|view|image|"
        r"sight|reach|range|radius|circle|watch|field|sector|hold|turn|time|angle|margin|minutes|seconds)\b)(?! (?:the |an? |your |its |about |"
        r"some )?(?:watch |tight |small )?(?:circle |"
        rf"radius )?(?:of )?(?:[\d.]+ ?-?{LENGTH}\b|"
        rf"{SIZE}|[\d.]+ ?(?:°|deg|s\b|sec|min|h\b)|(?:{COUNT} )+(?:deg|sec|min|hour)))",
        r"(?:inside|within) [^.;,]{0,40}(?:square|box|rectangle|area|strip|corridor|polygon|triangle|hexagon|block|field)\b|(?:stay|keep|remain|"
        r"hold)\w* (?:well )?(?:out of|in|to)\b (?:the (?!picture|frame|image|middle|view|cent|water|same|turn|hold|point|spot|pos|head|course|"
        r"track|line|left|right|north|south|east|west)|this (?!spot|"
        r"pos)|that|an?\b|\[|\()|(?:not|n't|never)\b[^.;]{0,30}(?:outside|beyond|past|over the)\b|(?:not|"
        r"n't|never)\b[^.;]{0,12} out of (?:the|this|that|\[|\()",
        r"(?:area|region|sector|patch|field|block|basin|harbou?r|corridor|waters?)\b[^.;\[(]{0,25}(?:leav|stay in|keep to|permit|allow|bound|"
        r"limit|confine)|(?:area|region|square|block) (?:of |with |from |between |is )?(?:the )?(?:corners )?[\[(]",
        r"(?:leav|stay|keep|remain|permit|allow|assign|restrict|designat|operat|confin|limit|bound|restrain|contain)\w* (?:(?!while|and|rang|"
        r"measur|log|search|look)[a-z]+ ){0,3}(?:area|region|square|patch|field|block|basin|harbou?r|corridor|waters)\b",
        r"(?:do not|don't|not|never|must not|mustn't|may not|without) (?:go|going|get|getting|come|drift|drifting|wander) out (?:of|from)\b",
        r"(?:do not|don't|not to|never|must not|mustn't|may not|without) (?:[a-z]+ ){0,2}(?:leav(?:e|ing)(?! (?:the )?(?:station|frame|picture|"
        r"centre))|cross\w*|exit\w*|stray\w*|depart\w*)",
        r"corners\b(?:\W+(?:at|are|is|the|being|points?|coordinates|of|its|with))*\W+[\[(x=-]*-?\d",
        r"[\[(] ?-?\d[^\])a-z]*[\])](?:[ ,;]+(?:and )?[\[(] ?-?\d[^\])a-z]*[\])]){3}",
        r"(?:x|east\w*) (?:from|between) -?\d[^.;]*(?:y|north\w*) (?:from|between) -?\d|lines?\b[^.;]{0,20}(?:cross|limit)|(?:must not|may not|"
        r"never|not) (?:be |to be )?(?:left|crossed)|(?:in|:) [\[(] ?-?\d[^\])a-z]*[\])](?:[ ,;]+(?:and )?[\[(] ?-?\d[^\])a-z]*[\])]){2}",
    ),
    "DetectObjects": (
        r"class(?:es)?\b",
        r"(?<!\bsonar )(?<!\bfeature )(?<!\btext )(?<!\bhotspot )detector\w*|objects?\b(?! \w*\d)|classif\w+|yolo|det\b|(?:object|image|"
        r"visual) recogni\w+|obj\b",
        r"look-?outs?\b|eyes?\b[^.;,]{0,20}(?:open|peeled|out\b|for\b)|(?:in|come\w* into) sight|sight(?:ed|ings?)\b|show up|pop up",
        r"(?:for|any|all|of|on|detect\w*|find\w*|spot\w*|report\w*|flag\w*|seek\w*|see|watch\w*|search\w*|classes|class|no|and|or|,|:|[.;-]) "
        rf"(?:[a-z-]+ ){{0,3}}(?<!\bother )(?<!\bfrom )(?:{_CLASSES})\b",
        rf"^(?:[a-z-]+ ){{0,2}}(?:{_CLASSES})\b",
        r"any (?:[a-z-]+ ){1,4}(?:in (?:view|sight|the (?:picture|image|frame|water))|around|about|(?:is |are |be |to be |must be )?(?:reported|"
        r"detected|flagged|found|spotted))\b",
        r"(?:search|scan|look|find|spot|watch|comb)(?:s|es|ing|ed)? (?:(?:the|through|in|around|at|over|all) ){0,2}(?:[a-z]+ )?(?:picture|image|"
        r"frame|surroundings|water|surface|video|sea)\b(?! quality)",
        r"report\w* (?:[a-z,-]+ ){1,8}(?:in|on) (?:view|sight)",
        r"(?:whether|if|should|see|are|is|for) (?:there|any|what|something|one)\b[^.;]{0,80}\b(?:about|around|in view|nearby|out there|"
        r"turns? up|show\w* up)\b",
        r"(?:anywhere|is|are|be|come\w*|comes?) in(?:to)? view|turn(?:s|ing)? up\b|mind(?:ing)? out\b|beware|(?:if|when|whether|whenever|should|"
        r"once) (?:you|we|she|it|(?:the )?(?:\w+ )?cam\w*) (?:sees?|spots?|meets?|comes? across)|what (?:else )?(?:is|swims|floats) (?:about|"
        r"around|out there|in the water)|(?:on the|keep\w*|a|your|sharp|open) (?:watch|eye|eyes|alert|look) (?:out )?(?:on|for|kept)|"
        r"a watch (?:is )?kept|alert (?:for|to)|(?:shout|call out|warn) ",
    ),
    "TrackObjects": (
        r"plots?\b|(?:box|frame|piece|item) by (?:box|frame|piece|item)\b",
        r"tracker\w*|tracked\b(?! (?:pixel|offset|pose))|(?<!\bcable )tracking\b|trk\b|identit\w+|persisten\w+|tabs on|re-?identif\w+",
        r"(?<!\bcable )(?<!\bon )(?<!\boff )(?<!\bthe )(?<!\bgps )(?<!back)(?:track|tracks)\b(?! (?:the |of the |of your |of our |your |a |"
        r"of )?(?:[a-z]+ )?(?:pixel|visual|offset|pose|relative|cable\b(?! (?:clamp|entry|drum|buoy|ferry|layer|winch))|"
        r"pipeline|straight|line|course|start|heading|bearing|length|end|leg|run\b|is\b|begins|distance|out\b|time))",
        r"(?:on the|keep|hold|maintain|have|start|put|with|run|object|continuous|no|a) (?:a |the )?track\b(?! (?:heading|length|bearing|start|"
        r"line|course|begin|end|distance|as|at|in|is|from|to|and))|(?:los\w+|hold\w*|maint\w*|keep\w*) the track",
        r"follow\w*[^.;]{0,50}(?:tracker|identity|over time|id\b)|(?<!\bheading )(?<!\bbow )(?<!\bnose )(?<!\bhdg )lock(?:ed|ing)? (?:on|onto)"
        r"\b|los(?:e|"
        r"ing) (?:sight|it|them|her|him|contact|target)|(?:eye|watch) on (?!the (?:image|pic|qual|depth|horizon|temp))",
        r"(?:ids?|mmsi) (?:of|on|constant|stays?|kept|the same)\b|(?:same|keep\w*|maintain\w*|hold\w*|persist\w*) (?:the |its |an? |same )*ids?\b|"
        r"monitor\w* (?:contact|target|object|vessel|boat|track)s?\b",
        r"over time\b|frame (?:to|by|after) frame|(?:in|across|through|over|between) (?:every|all|each|consecutive|successive|the) frames?\b|"
        r"(?:keep|know|knows|known|knowing|recogni[sz]\w*|tell|find|pick) [^.;,]{0,40}(?:again\b|apart|from the (?:others?|rest))|mix(?:ed|"
        r"ing)?\b[^.;,]{0,30} up\b|confus\w*|mistak\w*|(?:which|who) is (?:which|who)|the same (?:one|object|target|vessel|boat|swimmer)\b|"
        r"swap\w*|tack(?:s|ing)? (?:the|it|them|every|each|all|any)\b",
    ),
    "OCRScanning": (
        r"\w*ocr\w*|text\w*|letter\w*|script\w*|inscri\w+|deciph\w+|transcri\w+|character\w*|spell\w*|words?\b|caption\w*|legib\w+|alphanum\w*|"
        r"digits?\b",
        r"(?:the|any|all) writing\b|written\b|writing (?:on|in|at)\b",
        rf"(?:re-?)?read(?:s|out)?\b(?! {SENSED})(?! you )",
        rf"(?<!\bdepth )(?<!\bgps )(?<!\bthermal )(?<!\btemperature )(?<!\bhorizon )(?<!\bpose )(?<!\bdistance )(?<!\ba )reading\b(?! {SENSED})",
        r"(?:what|whatever) (?!the (?:weather|logger|sensor|log|gps|sounder))[^.;,]{0,40} (?:says?|reads|said)\b|make out|made out|making out",
        r"(?:scan|captur|extract|pick up|recogni|tell me|get|what|note)\w*[^.;,]{0,40} (?:numbers?|registration|name|serial|markings?|sign|plate|"
        r"board)\b(?! pin)",
        r"what (?:is|was|has been|they have) (?:painted|stencil\w*|printed|engraved|chalked)|which (?:name|number|letters|sign)|what (?:name|"
        r"number|sign)",
    ),
    "GetThermalStats": (
        r"(?:hot|warm|fever)\b",
        r"therm[a-z]*\b(?! (?:cam\w*|stream|feed|view|clips?|images?|videos?|picture|files?|search)\b)|thermo\w*",
        r"(?:with|by|through|using|on|in|from|via|under) (?:the )?(?:thermal|infra-?red|ir)\b(?! (?:cam|stream|feed|view))",
        r"(?<!\bhighest )\w*temper\w*|temps?\b|heat (?:of|in|on|levels?|readings?|figures?|values?|numbers?|data)|"
        r"\bir (?:stays|on|off|runs?|running)\b|heat-? ?(?:map|stat)\w*|pyro\w*|cold\w*|cool\b|hotness|warmth",
        r"(?:how|is|are|too|get|gets|getting|runs?|running) (?:hot|warm|cold|cool)\b|how (?:hot|warm|cold|cool)\b",
        r"(?<!\bdepth )(?<!\bdistance )(?<!\bhorizon )(?<!\bpose )(?<!\bgps )(?<!\bposition )(?<!\bsector )(?<!\bobstacle )readings?\b(?! "
        r"(?:the |out |off |any |"
        r"what |to obst|whatever )|the (?:lettering|text))",
        r"(?:mean|average|median|statistic\w*|stats?|max(?:imum)? and min\w*|min\w* and max\w*)\b",
        r"measur\w*\b|(?:hot\w*|therm\w*|celsius|\d ?c\b)[^.]{0,200}; (?:the )?(?:[a-z0-9-]+ ){1,5}(?:in|during|on) (?:the|each|every|all) \w+",
        r"infra-?red\b(?! (?:cam\w*|stream|feed|view|clips?|images?|videos?|picture|files?|search)\b)|\bir (?:figures|values|readings?|data|numbers)",
    ),
    "LocateHotspot": (
        r"(?:infrared|thermal|heat|temperature) (?:maximum|peak)|"
        r"\w*hot-? ?spots?\w*|hott\w+|(?<!\bhow )hot\b|warmer\b|warmest|(?<!\bhow )warm\b|heat\b(?! of)|heated|overheat\w*|burn(?:s|ing|er)?\b|"
        r"glow\w*|scorch\w*|peaks?\b|maxima\b",
        r"(?:highest|greatest|max\w*|peak|top) (?:[a-z]+ )?(?:temp\w*|heat|thermal)|thermal (?:peak|max\w*|anomal\w*|search|source|signature|"
        r"picture)",
        r"(?:anything|whatever|everything|spots?|points?|places?|parts?|patch\w*|thermal|heat\w*|temp\w*|it|one)[^.;,]{0,30}(?:above|over|beyond|"
        r"exceed\w*|hotter|warmer|from) (?:about )?\d",
        r"\d ?(?:°|º|deg\w*)? ?(?:c\b|celsius|centigrade|f\b|fahrenheit)|celsius|centigrade",
    ),
    "CheckLensClearness": (
        r"drops\b|raindrops",
        r"\w*lens\w*|droplet\w*|spray\w*|spatter\w*|splash(?:es|ed)?\b(?! deck)|wet\b|wetness|salt\w*|dirt\w*|clean\w*|smudg\w*|smear\w*|glass\b|"
        r"optics?\b|fogg\w*|misty|mist(?:ed|ing)?\b|condens\w*|obscur\w*|grime",
        r"(?:for|of|any|water|rain|no|from|by|with|are|salt) drops?\b(?! (?:the|a|pin|marker|map|another|one))|raindrops?|water on (?:it|"
        r"the (?:lens|glass|cam|optic))",
        r"cam\w*[^.;,]{0,25}\b(?:clear|dry|clean|dirty)\b|(?:clear|dry|clean|dirty) cam\w*|front element|clearness",
        r"wip(?:e|es|ed|ing|er|ers)\b|streak\w*|sprayed|rub(?:bed|bing)? (?:dry|clean)|blind(?:ed)? by",
    ),
    "GetImageQualityMetrics": (
        r"rat(?:e|ing) (?:the )?(?:[a-z]+ )?cam\w*",
        r"(?<!\bgeotag )(?<!\bgps )(?<!\bgeotagging )(?<!\bposition )(?<!\bfix )qualit\w*|\w*metrics?\b|usab\w*|useful\w*|sharp\w*|blur\w*|"
        r"crisp\w*|(?:in|"
        r"out of|check\w*|verify|test) (?:the )?focus|expos(?:ure|ed)\b(?! cable)|contrast|clarity",
        r"resolution|grain\w*|good enough|noisy|imag\w+ noise|iqm|iq\b|fit (?:to|for) use",
        r"(?:rat|scor|grad|judg|assess|evaluat|analys|analyz|apprais|inspect|how good|usable|check|test|verif|examin|watch|monitor)(?:s|e|es|ed|"
        r"ing|y|ies|ify|ifies|uat\w+)? (?:(?!and\b|while\b|with\b|then\b|for\b)[\w-]+ ){0,5}(?:picture|image|video|frame|view|footage|imagery)",
        r"(?:picture|image|video|frame|view|footage|imagery)s?\b[^.;,]{0,40}\b(?:good|usable|rat(?:ed|ing)|scor(?:ed|ing)|grad(?:ed|ing)|judg\w+|"
        r"assess\w*|evaluat\w*|analys\w*|checked|fit\b|ok\b|okay|worth|bright|dark)\b",
        r"mush\w*|enough to (?:work|use|go|be used|see)|to work with|can be used|(?:any|some|much) (?:good|use)\b|worth (?:looking|using|"
        r"keeping|having)|fuzz\w*|hazy|pin-?sharp|washed[ -]out|useable|(?:clear|decent|proper|fair) (?:picture|image|view|video)|"
        r"good for anything",
    ),
    "CalculateVisualOffset": (
        r"dx\b",
        r"\w*offset\w*|off-?set\w*|pixel\w*|px\b|displac\w*|deviat\w*|misalign\w*|(?<!\bgps )(?<!\bposition )(?<!\bhorizontal )errors?\b|"
        r"discrepan\w*",
        r"off[ -](?:the )?(?:[a-z]+ )?(?:cent\w+|middle|axis)|(?:from|to|and|between) (?:the )?(?:[a-z]+ )?(?:cent(?:re|er)|"
        r"middle) of (?:the )?(?:image|picture|frame|view|video|screen)",
        r"(?:image|picture|frame|optical|screen)[ -](?:cent(?:re|er)|middle)|relative to the (?:cent|image|picture|frame)|how (?:far|"
        r"much) [^.;]{0,40}(?:cent|middle|off\b|mid-)|how (?:far|much) (?:off|out)\b|visual(?:ly)? (?:error|off|dist\w*)",
        r"(?:out of|beside|left of|right of|away from) (?:the )?(?:[a-z]+ )?(?:cent(?:re|er)|middle)\b|mid-?(?:frame|picture|image)",
    ),
    "GetSectorDistance": (
        r"sectors?\b(?= (?:at|on|to|towards|bearing|ahead|dist|rang|measur|between|read|\d))|sectors?\b[^.;]{0,50}(?:dist|rang|lidar|clos|near|"
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
    "SelectActiveStream": (
        r"\w*stream\w*|\w*feeds?\b|active\b|actively|activat\w*|select\w*|channels?\b|choos\w*|chosen|chose|live\b|screens?\b|display\w*|"
        r"monitors\b|in use",
        r"(?<!\bfield of )(?<!\bfields of )(?<!\bin )(?<!\binto )(?<!\bwithin )(?<!\bin the )(?<!\busable the )(?<!\bhow good the )(?<!\bkeep )"
        r"(?<!\bits )"
        r"views?\b(?! of\b)|"
        r"view(?:ed|ing)? (?:through|on|from)|view of \w*cam|look\w* through|show(?:s|n|ing)? (?!up)|see through|see (?:the |what )?(?:[\w-]+ "
        r"){0,3}\w*cam\w*|focus (?:on|to|over)",
        r"(?:switch|chang|turn|cut|mov|flip|swap|toggl|hop|shift|go|over)(?:es|e|s|ed|ing|ped|ping|ting|ling)? (?:[\w-]+ ){0,3}?(?:over )?(?:to|"
        r"onto|into) (?:[\w-]+ ){0,4}?\w*(?:cam\w*|view|feed|stream|lens|channel|picture|thermal|infrared|ir)\b",
        r"(?:switch|chang|go|turn|cut|swap)(?:es|e|s|ed|ing)? (?:over )?to (?:the )?(?!x[ =]|y[ =])(?:[a-z]+[-_ ]?\d+\b|[a-z]+_\w+)",
        r"(?:put|bring|us|have|set|mak|want|need|open|call|leav)(?:e|es|s|ing|ting|ed)? (?:up )?(?:(?!from|of|with|by|on|in|to|and|for|at|a\b|"
        r"an\b|centre|the bow|lens|view|see)[\w-]+ ){0,4}?\w*(?:cam|camera|view|feed)(?:[ _-]?\w{1,3})?\b",
        r"\w*cam(?:era)?s?\w*(?: [a-z0-9]{1,3})? (?:on(?= ?[.,;]|$| and| for| while| screen| display| in| during)|up\b|active|selected|in use|"
        r"as\b|live|switched on|is on|being on)",
        r"switch(?:ed|es|ing)?\b(?! (?:on|off|the (?:heading|record|detector|object|tracker|geo|fence|sonar|obst|boundary)|heading|recording|gear|"
        r"cabinet|box))|(?:[a-z]+[_-]?\d+|\w+_\w+) (?:switched on|in use|up\b|on(?= ?[.,;]|$| and| while| screen))",
        r"(?:put|bring) (?:up )?(?!(?:a|an|the bow|another|the marker) )(?:[\w-]+ ){1,5}(?:on|up)\b(?! (?:record|the (?:map|chart)|a\b))|bring up",
    ),
    "SetStreamRecording": (
        rf"\w*record(?:s|ed|ing|ings|er|ers)?\b(?! {SENSED})(?! as (?:an? )?obs)|film\w*|(?<!\bof )(?<!\bbuffered )vide?o(?:s|ing|ed)?\b(?! "
        r"(?:buffer|"
        r"quality|frame|from the buffer|is (?:good|usable|sharp)))|(?<!\bof )(?<!\bgrade the )(?<!\bgrading the )footage|movies?\b|tap(?:e|ing|ed)\b|"
        r"rec\b|mp4|\binto ['\"“](?! )|name of the file|"
        r"(?:file|with the file|new file) (?:name|called|named) |(?:running|on), file \w|file the [\w ]+ as |keep it rolling",
        r"(?<!\bbuffer )(?<!\bbuffer on)(?:to|on|onto) (?:the )?(?:disk|disc|drive|file|storage|card|camera)\b|on tape|roll(?:ing|"
        r"s)? (?:the )?(?:tape|cam|video|film|rec)|file-? ?tags?|(?:the|with|under|with a|file|,|a|same) tags?\b|tagged|filed|writ(?:e|es|"
        r"ing)\b[^.;]{0,30}dis[ck]|clips?\b",
        r"shoot(?:s|ing)?\b(?! (?:an? |the |one |some )?(?:geo|still|pic|photo|frame|image|snap))",
        r"(?:let|have|keep|run|leave|start|turn|switch|set|put|get)\w* (?:[\w-]+ ){0,4}?\w*(?:cam\w*|sonar\w*|sensor\w*|lidar\w*|radar\w*|"
        r"sounder\w*|hydrophone\w*|multibeam\w*|mbes\w*|sss\w*|station|profiler|recorder)(?:[ _]\w{1,4})?\b[^.;,]{0,20}"
        r"\b(?:run\w*|on\b(?= ?[.,;]|$| and| as| under| for| while)|going|rolling|record\w*)",
        r"(?:run|start|roll|let)(?:s|ning|ing)? (?:the |a |your )?(?:[a-z-]+ )?(?:\w*cam(?:era)?\b|\w*cam[\w-]+|sonar\b(?! (?:feature|detect|"
        r"search))|radar\w*|lidar\b(?! log)|sensor\b(?! (?:[a-z]+ )?check| health| test)|hydrophone\w*|sss\w*|mbes\w*|weather station)|"
        r"(?:\w*cam\w*|video|camera)(?: [\w]+)? (?:on\b(?= ?[.,;]|$| and| as| under| for| while| during| in| on| all| the whole| through| from)|"
        r"runs?\b|running|rolling|going)",
        r"let(?:s|ting)? (?!ocr|the (?:object |detect|track)|her\b|the boat)(?:[\w-]+ ){1,4}run\b|(?:[a-z]+[_-]?\d+|\w+_\w+|sonar|multibeam|"
        r"lidar|radar|"
        r"station|hydrophone|sounder|profiler|camera(?: \w+)?|sensor \w+|scan) runs\b",
        r"(?:sav|stor|log|captur|keep|archiv|writ|collect|preserv|document)(?:e|es|s|ed|ing|ging)? (?:what (?!the weather sens|is in the|"
        r"is written)|everything|the (?:data|output|stream|video|sonar|radar|feed)\b(?! buffer)|all\b|video\b|"
        r"(?:the )?(?:[a-z-]+ )?\w*cam(?:era)?\w*\b|(?:the )?(?:[a-z-]+ )?\w*sonar\w*|data\b|radar|hydrophone\w*|(?:[a-z]+[_-]?\d+|\w+_\w+) to)",
    ),
    "BufferLoopCapture": (
        r"\w*buffer\w*(?! (?:zone|distance))|buf\b|(?:s|secs?|seconds?|mins?|minutes?|hours?|thirty|fifteen|half) of (?:the |buffered |"
        r"recent )?(?:video|footage|film)|loops?\b|looped|retro\w*|replay|rewind|just (?:happened|seen|filmed|shot|gone)|pre-?record\w*|dash-?cam",
        r"(?:last|past|previous|preceding|latest|recent|foregoing|prior|trailing|just gone)\b(?: (?:[a-z'-]+|\d+(?:\.\d+)?)){0,5}? ?(?:\d ?s|"
        r"\d ?h|secs?|seconds?|mins?|minutes?|hours?|quarter|half|video|footage|clips?|films?|recordings?)\b",
        r"(?:sav|keep|kept|dump|grab|secur|retain|preserv|rescu|stor|hang on)\w*[^.;]{0,30}(?:secs?|seconds?|mins?|minutes?|hours?|"
        r"\ds) (?:of (?:the )?)?(?:\w+ )?(?:video|footage|clip|film|picture|back|before)",
    ),
    "CaptureGeoSnapshot": (
        r"fotos?\b",
        r"(?<!\benvironment )(?<!\benvironmental )(?<!\benv )(?<!\bstate )snap(?:s|ped|ping)?\b|"
        r"(?<!\benvironment )(?<!\benvironmental )(?<!\benv )(?<!\bstate )(?:geo\w*)?-?snap-?shot\w*(?! of (?:the |all )?env)",
        r"(?<!\bhold )(?<!\bstay )(?<!\bkeep )(?<!\bsit )(?<!\bstand )(?<!\blie )(?<!\blying )(?<!\bbe )(?<!\bremain )(?<!\bholding )"
        r"(?<!\bkeeping )(?<!\bstaying )"
        r"(?<!\band )(?<!\bis )still\b(?! (?:for|"
        r"until|while|in|at|here|\d|and (?!a\b)))|(?:a|one|the|another|each|every|this|that|geotagged) still\b|stills\b",
        r"\w*photo\w*|pics?\b|pano\w*|imagery|imaging|geo-? ?(?:image|pic|frame|still|photo|shot)\w*|meta-?data|side-?car|jpe?gs?|shots?\b|"
        r"close-?ups?|geo-?ref\w+|"
        r"geo-? ?tagg?(?:ed|ing|s)?\b(?! qual)|shoot(?:s|ing)?\b(?! (?:a |some |the )?(?:video|footage|film))",
        r"(?:an?|one|two|three|four|another|each|every|single|more|some|few|no|tak\w+|shoot|sav\w*|captur\w*|grab|stor\w*|all|want|need|first|"
        rf"second|and) (?:[a-z-]+ ){{0,2}}{SHOT}\b(?![ -](?:cent|qual|buff|err|off|is|of the))",
        r"(?:pictures|images|frames|photographs)\b(?! (?:quality|are (?:usable|good|sharp)))|(?:picture|image|frame)s? with (?:its|the|a|"
        r"their)? ?(?:pos|coord|geo|meta|loc)\w*|(?:picture|image|frame) (?:at|from|each|on every)\b|^(?:picture|image)\b(?! qual)|"
        r"[.;,:] (?:picture|image|frame)\b(?! qual)",
    ),
    "LogLidarSlice": (
        r"(?<!\bin the )(?<!\bin that )(?<!\brange the )(?<!\branging the )slices?\b|profil(?:e|es|ed|ing)\b|cross-? ?sections?|"
        r"(?<!\bpower )cuts?\b(?! (?:the |your |all |engines?|prop|power|thrust|off|to))|2-?d\b|swath\w*|transvers\w*",
        r"(?:lidar|laser|2-?d|log\w*|sav\w*|stor\w*|keep\w*|captur\w*|archiv\w*|writ\w*|tak\w*|get\w*|record\w*) (?:(?!fit|"
        r"cylind)[a-z]+ ){0,3}scans?\b(?! (?:for|width))|scans? (?:logged|saved|stored|recorded)|scan angle|scan(?:s|ning)? the (?!sonar|text|"
        r"picture|water|surround|width|lettering|sea)",
        r"(?:lidar|laser|ladar)s?\b(?![- ](?:distance|dist\b|rang|sector|measur|cloud|return))|(?:log|sav|stor|record|keep|captur|archiv|writ|tak|"
        r"get)(?:e|es|s|ed|ing|ging|k?es?)? (?:(?!wide|turn)[a-z0-9-]+ ){0,4}(?:sweeps?\b|lidar|laser)(?! (?:dist|rang|sector))",
    ),
    "LogEnvironmentState": (
        r"\w*envi?r?o?n?m\w*|env\b|ambient|meteo\w*|met\b(?! (?:mast|tower))|atmospher\w*|humid\w*|salin\w*|air (?:temp|press)\w*|barom\w*|(?:sea|"
        r"weather|water)[ -]state|conditions?\b|weather\b(?! (?:turns|station|buoy))|surrounding\w*",
        r"(?:log|record|not|sav|stor|tak|measur|writ|report|collect|get)\w* (?:[a-z,]+ ){0,6}(?:wind\b|waves?\b(?! of)|swell|water temp\w*)|"
        r"wind (?:and|speed|data|log|plus|,)",
    ),
    "GetRelativePose": (
        r"\w*poses?\b|relativ\w*|attitude|orientat\w*|in the frame of|(?:with|in) (?:respect|relation|reference) to|(?:dock|local|body|marker|tag|"
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
        r"(?:good|true|right|correct|valid) to (?:within )?|(?:check|test)\w*:[^.;]{0,60}(?:gps|gnss)",
        r"(?:gps|gnss|fix(?:es)?|satellite\w*|receiver|position\w*)\b[^.;,]{0,30}\b(?:wrong|off|out by|err\w*|believ\w*|stand\w* up|hold\w* up|"
        r"count\w* on|rel(?:y|ied)|to the test)\b|(?:rely|relying|count|bank|depend)\w* on (?:the |our )?(?:gps|gnss|fix|sat|position)",
    ),
    "CreateMapMarker": (
        r"(?:pin|pins|pinned|pinning)\b(?! (?:the|its|your|her) (?:bow|heading|nose))|map\b|maps\b|markers?\b(?! \d)|chart(?:s|ed)?\b|flag(?:s|"
        r"ged|ging)?\b(?! any)|bookmark\w*|way-?mark\w*|plot(?:s|ted|ting)?\b|(?:drop|creat|plac|put|set|leav|add|mak|want|and|a)\w* (?:a |"
        r"the )?markers?\b",
        r"(?<!\bdocking )(?<!\bdraught )(?<!\bdraft )(?<!\bnavigation )(?<!\bscour )(?<!\btide )(?<!\bquotation )mark(?:s|ed|ing)?\b|(?:tag|"
        r"name|label) (?:the|"
        r"this|that) (?:spot|place|position|point|location)|mark-?up|label[^.;,]{0,30}(?:map|chart|spot|place)",
    ),
    "RegisterObservation": (
        r"(?<!\bwhat was )(?<!\bwhat has been )\w*observ\w*|regist(?:er|ers|ered|ering)\b|entry\b|entries\b|logger\w*|log-?book|journal|remark\w*|"
        r"jot\w*|memo\b|what (?:you|we|is|was) (?:see|saw|seen|there|found|find)\b|comment\w*|diary|minute (?:it|that|this)\b|data-? ?log\w*",
        r"enter(?:s|ed|ing)?\b(?! (?:at|from|by|on|through|the (?:area|grid|block|box|harb|lane|basin|port|dock|north|south|east|west)|it at))|"
        r"entering\b",
        r"(?:in|into|to|on|onto) (?:the |your |our )(?:[a-z]+ )?(?:log|record|logger|books?|file)\b(?!s)|(?:put|go\w*|plac\w*|tak\w*|enter\w*|"
        r"have|get|\"x\"|[a-z]+) (?:[^.;,]{1,60} )?(?:on|in) record\b|(?:put|set|tak|jot|mark|note)\w* (?:[^.;,]{1,60} )?down\b|"
        rf"writ\w* (?:[^.;,]{{1,60}} )?down\b(?! {SENSED})",
        r"(?:(?:log|record|file|save|store|report|add|enter|state|write|make|put)(?:s|d|ed|ing|ging|ting)? (?:the |a |an |that |it |in |"
        r"following )*|noted (?:as|in) |(?<!\bwith )(?<!\bwith the )(?<!\bwith a )(?<!, )(?<!\bthe )(?:note|noting) (?:the |a |that |it |as )*|"
        r"(?:log|"
        r"enter|file)(?:s|ed|"
        r"ing)? (?:it |this |that )?as )[:\"]|(?:not|log|record|report|stat|fil)\w* (?:that|as an?)\b|findings? (?:is|are|to be|logged|noted|"
        r"entered|recorded)|(?:log|enter|note|record|add)\w* (?:the |your |our |any )?findings?",
        r"(?<!\bthe )(?<!\ba )(?<!\bdata )(?<!\bto )(?<!\bgps )(?<!\bdepth )(?<!\blidar )(?<!\benvironment )(?<!\benv )(?<!\bmission )"
        r"(?<!\benvironmental )(?<!\bfor )(?:log|"
        rf"note|logging|noting)\b(?! {SENSED})(?= [a-z])(?! (?:of|on|off|from|in|at|for|is|are|the|all|to|and|every\w*|with|by|it|during|"
        r"throughout|how|sonar|lidar|radar|cam\w*|video|while|too|there|here|as|along|meanwhile|wherever|once|only|what|whatever|slices?|\w+_\w+|"
        r"\w+ to disk)\b)",
    ),
}  # fmt: skip
