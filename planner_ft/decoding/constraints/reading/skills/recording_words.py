"""The words that a task input can ask by for what is recorded: streams, images, logs and marks.
Read on text in small letters.
"""

from __future__ import annotations

from planner_ft.decoding.constraints.reading.skills.evidence_parts import SENSED, SHOT

RECORDING: dict[str, tuple[str, ...]] = {
    "SelectActiveStream": (
        r"pictures? of [\w-]+ (?:in front of|before) (?:me|us)\b|\w*stream\w*|\w*feeds?\b|active\b|actively|activat\w*|select\w*|channels?\b|choos\w*|"
        r"chosen|chose|live\b|screens?\b|display\w*|"
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
        r"files?\b ?[:=]|the \w*cam\w*(?: \w+)? on\)|(?:file|with the file|new file) (?:name|called|named) |(?:running|on), file \w|"
        r"file the [\w ]+ as |keep it rolling",
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
        r"recent )?(?:video|footage|film)|loops?\b|looped|retro\w*|replay|rewind|just (?:happened|seen|filmed|shot|gone|past)|pre-?record\w*|dash-?cam",
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
        r"weather (?:log|station gives)|\w*envi?r?o?n?m\w*|env\b|ambient|meteo\w*|met\b(?! (?:mast|tower))|atmospher\w*|humid\w*|salin\w*|air (?:temp|"
        r"press)\w*|barom\w*|(?:sea|"
        r"weather|water)[ -]state|conditions?\b|weather\b(?! (?:turns|station|buoy))|surrounding\w*",
        r"(?:log|record|not|sav|stor|tak|measur|writ|report|collect|get)\w* (?:[a-z,]+ ){0,6}(?:wind\b|waves?\b(?! of)|swell|water temp\w*)|"
        r"wind (?:and|speed|data|log|plus|,)",
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
        r"(?<!\bwhat was )(?<!\bwhat has been )\w*observ\w*|reg(?:ist(?:er|ers|ered|ering))?\b|entry\b|entries\b|logger\w*|log-?book|journal|remark\w*|"
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
}
