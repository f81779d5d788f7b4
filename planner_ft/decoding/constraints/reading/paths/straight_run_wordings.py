"""How task inputs word straight runs and the task's own track: the patterns by which
`straight_runs` reads them.
"""

from __future__ import annotations

import re

from planner_ft.decoding.constraints.reading.paths.run_wordings import COMPASS, whole_words

LINE = whole_words(
    r"from|starting|run|running|follow\w*|track\w*|trac(?:e|ing)|transect|line|pass|passing|leg|straight|go|going|sail\w*|driv\w+|steam\w*|"
    r"steer\w*|make|head|along|onwards?|proceed\w*|move|motor"
)
"""Words of a straight run."""
NO_LINE = whole_words(
    r"arc|arcs|orbit\w*|circl\w*|turn\w*|curve|rotat\w+|pan|nudge|radius|drift\w*|float\w*|round"
)
"""Words of an arc, a turn or a drift, whose lengths are no runs."""
PARALLEL = whole_words(r"ending|to the end at")
"""A run whose end is stated as a place."""
STARTING = whole_words(r"(?:start|beginn)\w*|begin\w*|from|out of")
"""The place behind is where a run starts."""
FROM_END = re.compile(r"\b(?:from|start at|starting at|beginning at)\s+(?:the )?$", re.IGNORECASE)
"""Before the place that a run starts from."""
FROM_ANY = re.compile(r"\b(?:from|starting|beginning|start|begin)\b[^.;]{0,20}§", re.IGNORECASE)
"""A run whose start is stated."""
ALONG_IT = re.compile(
    r"\b(?:follow(?:ing)?|track(?:ing)?|along|run(?:ning)? along) (?:it|the (?:[\w-]+ )?cable)\b",
    re.IGNORECASE,
)
"""A run along the cable."""

# How far
RUN_BEHIND = re.compile(
    r"^,? (?:on|along|due|to the) (?:a |the"
    r" )?(?:heading|course|bearing|\d|north|south|east|west|given|planned)",
    re.IGNORECASE,
)
"""Behind the length of a run."""
RUN_BEFORE = re.compile(r"\bfor (?:about |the )?$", re.IGNORECASE)
"""Before the length of a run."""
OFF = re.compile(r"^\s?(?:off|out|away|clear|wide|short)\b", re.IGNORECASE)
"""Behind a length that is kept off something."""
AT_SPEED = re.compile(r"\s*,?\s*for (?:about )?(?:an? |the )?", re.IGNORECASE)
"""What stands between a speed and the time for which it is kept."""

# Where to
HEADING = re.compile(
    r"\b(?:on|along|follow(?:ing)?|steer(?:ing)?|heading|course|bearing|direction)\s+(?:(?:a|an|the)\s+)?(?:(?:true"
    r" )?(?:heading|course|bearing|"
    r"direction)(?: of)?\s+)?(?:due\s+)?"
    r"(?:(\d{1,3}(?:\.\d+)?)(?![\d.]*\s?(?:m\b|met|s\b|sec|min|%|kn|km|feet|foot|ft))|((?:north|south)["
    r" -]?(?:east|west)|north|south|east|"
    r"west)(?:wards?)?\b)",
    re.IGNORECASE,
)
"""A bearing that is steered, in degrees or by its compass word."""
DUE = re.compile(
    r"\b(?:due|straight|running|run|go|sail|steer|steam|drive|to"
    rf" the|head)\s+({COMPASS})(?:wards?)?\b(?! (?:of|side|face|end|edge|wall|corner|quay))"
    rf"|\b({COMPASS})(?:wards?|erly)\b(?! (?:of|side|face|end|edge))",
    re.IGNORECASE,
)
"""A compass direction that is gone in."""
SOME_HEADING = re.compile(
    r"\b(?:on|along|headi?n?g?|bearing|course)\b[^.;§]{0,40}(?:degrees|°|\b\d{2,3}\b(?!\s?m))",
    re.IGNORECASE,
)
"""A bearing in words or with a typing error."""
ARRIVING = re.compile(
    r"\b(?:arriv\w*|final|ending|ends?|facing|finish\w*|bow|yaw|look\w*|turn\w*|pointing|pivot\w*)\b[^.;,§]{0,15}$",
    re.IGNORECASE,
)
"""Words before a bearing that the bow is to have."""
ARRIVAL = re.compile(r"§,?\s*$", re.IGNORECASE)
"""A place right before a bearing."""
PLACE_FROM = re.compile(r"\b(?:from|at|of)\s+§+,?\s*$", re.IGNORECASE)
"""A place that a run starts from, right before its bearing."""

# The task's own track
OWN_HEADING = whole_words(
    r"(?:on|along|down|by|with|at|follow(?:ing)?|of) (?:the |its"
    r" )?(?:(?:track|given|planned|stated|cable'?s?|task'?s?|set|ordered|"
    r"same) )*(?:heading|course|bearing)(?! (?:of )?(?:\d|lock|locked|north|south|east|west))"
    r"|(?:heading|bearing|course) of the (?:task|track|cable)"
)
"""The task's own heading."""
OWN_LENGTH = whole_words(
    r"(?:the |its |over the |for the"
    r" )?(?:(?:full|set|given|planned|stated|max(?:imum)?|whole|entire|total|task'?s?|required|"
    r"ordered) )+(?:of (?:the |its )?)?"
    r"(?:(?:pass|track|run|stated|given|planned)"
    r" )*(?:length|distance|maximum|extent|stretch|run)(?: of the (?:task|pass|track|run|cable))?|"
    r"(?:the (?:pass |track )?|its )(?:length|distance|maximum)(?: of the (?:task|pass|track|run)|"
    r" given| set| stated)?|"
    r"(?:from start )?to (?:its|the) end"
)
"""The task's own length, or its whole track."""
WHOLE_TRACK = whole_words(
    r"(?:follow\w*|track\w*|run\w*|trac\w+|do|doing) (?:along )?(?:the"
    r" )?(?:(?:planned|given|cable|whole|entire|set|task'?s?) )*(?:track|cable|"
    r"run|line|pass)"
    r"(?: track| run| route)?(?: (?:as (?:planned|given|stated|laid down|ordered)|from (?:its |the"
    r" )?start to (?:its |the )?end|from end to end|"
    r"for its planned length|"
    r"along its whole length))|(?:run\w*|follow\w*|do|doing) (?:the|its) (?:planned|given) (?:cable"
    r" )?(?:track|run|line|pass)"
)
"""The task's own track as a whole."""
ANY_TRACK = re.compile(
    r"\b(?:(?:run|follow|track|do) it"
    r" (?:as|from|to|once|whole|in|at|along)|(?:follow|track|run|trac|do)(?:s|ing|e|king|ning)?"
    r" (?:along |"
    r"down )?(?:the|its|your|this|that) (?:[\w'-]+ ){0,2}(?:cable|line|track|"
    r"pipe\w*)|(?:way|point)s? every|"
    r"(?:face|wall|edge|quay|jetty|pier|breakwater)\b[^.;:§]{0,30}"
    r" (?:runs|is|lies|goes|stretches|extends)\b[^.;:§]{0,30} from)\b(?! to §)",
    re.IGNORECASE,
)
"""A track or a face that is not run from one stated place to another."""
