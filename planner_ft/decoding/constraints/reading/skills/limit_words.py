"""The words that a task input can ask by for what limits a movement: the heading, clearances and
boundaries. Read on text in small letters.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.evidence_parts import (
    BOW,
    COUNT,
    GAP,
    LENGTH,
    SIZE,
)

LIMITS: dict[str, tuple[str, ...]] = {
    "LockHeading": (
        r"(?:un)?lock(?:ed|s|ing)?\b(?! (?:gates?|on\b|onto|the (?:picture|camera|view)))|(?:heading|bow|nose|hdg) ?-?lock\w*",
        r"(?:hold|keep|maintain|fix|freez|froz|pin|steady|leav|let|preserv|retain|constant|same|present|unchang|engag|stabil|clamp|tie|secur|"
        r"rigid|stay|remain|"
        rf"guard|sav|current|lash|nail|immobil|stead|unwaver|glue)\w*[ ,]+{GAP}{BOW}\b(?! (?:to|of|towards)\b)",
        rf"(?:hold|keep|fix|freez|pin)\w* {GAP}(?:bow|nose|heading|head) (?:to|on) (?:its|the|her|your) ",
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
        r"giv\w+ way\b|kept free\b",
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
        r"playground|(?:operating|working|first|second|third|other|last) box\b",
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
}
