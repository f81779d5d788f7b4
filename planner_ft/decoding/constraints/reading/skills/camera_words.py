"""The words that a task input can ask by for what is seen by camera, and how well. Read on text in
small letters.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.evidence_parts import SENSED

_CLASSES = (
    r"people|persons|persons? (?:in|over)|swimmers|divers?|(?:life ?|jet"
    r" ?)?(?:rafts|jackets|boats|skis)|kayaks|canoes|dinghies|yachts|ships|"
    r"vessels|ferries|tugs|barges|"
    r"buoys|pots|birds|gulls|seals|whales|dolphins|porpoises|turtles|debris|logs|driftwood|trunks|ropes|nets|floes|ice|weed|seaweed|oil|slicks?|"
    r"waste|"
    r"plastic|rubbish|flotsam|wreckage|cracks|corrosion|rust|dents|growth|damage|defects?|drones|containers|pontoons|surfers|windsurfers|boarders|"
    r"rowers|"
    r"trawlers|tankers|workboats|inflatables|pallets|tyres|tires|obstructions|crew|survivors?|casualt\w+|man"
    r" overboard|mob|"
    r"fenders|ladders|piles|anchors|cables|hulls|cyclists|anybody|anyone|someone|animals?|fish|floating|intruders?|"
    r"lobster\w*|crab\w*|paddle\w*|liferaft\w*|lifeboat\w*|speedboats?"
)

CAMERA: dict[str, tuple[str, ...]] = {
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
        r"(?:give|assign)\w* [^.;,]{1,40} a number\b|plots?\b|(?:box|frame|piece|item) by (?:box|frame|piece|item)\b",
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
        r"(?:hot|warm|fever)\b|(?:under|before) the thermal cam\w*|look(?:s|ing)? at [^.;]{1,40} with the thermal cam\w*",
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
        r"(?:infrared|thermal|heat|temperature) (?:maximum|peak)|max-?te\w+|"
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
        r"(?:lens|checklist)\b.*\bpicture\b|\bpicture\b.*\b(?:check|lens)",
        r"(?<!\bgeotag )(?<!\bgps )(?<!\bgeotagging )(?<!\bposition )(?<!\bfix )qualit\w*|\w*metrics?\b|usab\w*|useful\w*|sharp\w*|blur\w*|"
        r"crisp\w*|(?:in|"
        r"out of|check\w*|verify|test) (?:the )?focus|expos(?:ure|ed)\b(?! cable)|contrast|clarity",
        r"resolution|grain\w*|good enough|noisy|imag\w+ noise|iqm|iq\b|fit (?:to|for) use",
        r"(?:rat|scor|grad|judg|assess|evaluat|analys|analyz|apprais|inspect|how good|usable|check|test|verif|examin|watch|monitor)(?:s|e|es|ed|"
        r"ing|y|ies|ify|ifies|uat\w+)? (?:(?!and\b|while\b|with\b|then\b|for\b)[\w-]+ ){0,5}(?:picture|pic\b|image|video|frame|view|footage|imagery)|"
        r"how (?:good|gd|ok) (?:is )?the pic",
        r"(?:picture|image|video|frame|view|footage|imagery)s?\b[^.;,]{0,40}\b(?:good|usable|rat(?:ed|ing)|scor(?:ed|ing)|grad(?:ed|ing)|judg\w+|"
        r"assess\w*|evaluat\w*|analys\w*|checked|fit\b|ok\b|okay|worth|bright|dark)\b",
        r"mush\w*|enough to (?:work|use|go|be used|see)|to work with|can be used|(?:any|some|much) (?:good|use)\b|worth (?:looking|using|"
        r"keeping|having)|fuzz\w*|hazy|pin-?sharp|washed[ -]out|useable|(?:clear|decent|proper|fair) (?:picture|image|view|video)|"
        r"good for anything",
    ),
    "CalculateVisualOffset": (
        r"dx\b|cross-?hairs?\b",
        r"\w*offset\w*|off-?set\w*|pixel\w*|px\b|displac\w*|deviat\w*|misalign\w*|(?<!\bgps )(?<!\bposition )(?<!\bhorizontal )errors?\b|"
        r"discrepan\w*",
        r"off[ -](?:the )?(?:[a-z]+ )?(?:cent\w+|middle|axis)|(?:from|to|and|between) (?:the )?(?:[a-z]+ )?(?:cent(?:re|er)|"
        r"middle) of (?:the )?(?:image|picture|frame|view|video|screen)",
        r"(?:image|picture|frame|optical|screen)[ -](?:cent(?:re|er)|middle)|relative to the (?:cent|image|picture|frame)|how (?:far|"
        r"much) [^.;]{0,40}(?:cent|middle|off\b|mid-)|how (?:far|much) (?:off|out)\b|visual(?:ly)? (?:error|off|dist\w*)",
        r"(?:out of|beside|left of|right of|away from) (?:the )?(?:[a-z]+ )?(?:cent(?:re|er)|middle)\b|mid-?(?:frame|picture|image)",
    ),
}
