"""The words that fill the phrases: things, parts, places, names, data, limits and talk, gathered
from the lexicon modules.
"""

from planner_ft.data.mission.synthetic.lexicon_names import PROPER_NAMES
from planner_ft.data.mission.synthetic.lexicon_parts import (
    DATA_ITEMS,
    DOCK_MARKS,
    DOCK_SPOTS,
    FEATURE_PHRASES,
    FEATURES,
    SIDES,
)
from planner_ft.data.mission.synthetic.lexicon_purposes import PURPOSES
from planner_ft.data.mission.synthetic.lexicon_requests import (
    IMPOSSIBLE_REQUESTS,
    OPERATOR_LIMITS,
    OPERATOR_LIMITS_VALUED,
)
from planner_ft.data.mission.synthetic.lexicon_talk import (
    CLOSERS,
    FILLERS,
    OPENERS,
    SMALL_TALK,
    WHEREABOUTS,
)
from planner_ft.data.mission.synthetic.lexicon_targets import (
    CALLSIGN_PATTERNS,
    MOVING_TARGETS,
    TARGET_ADJECTIVES,
    TARGET_NOUNS,
    WITH_PHRASES,
)

__all__ = [
    "CALLSIGN_PATTERNS",
    "CLOSERS",
    "DATA_ITEMS",
    "DOCK_MARKS",
    "DOCK_SPOTS",
    "FEATURES",
    "FEATURE_PHRASES",
    "FILLERS",
    "IMPOSSIBLE_REQUESTS",
    "MOVING_TARGETS",
    "OPENERS",
    "OPERATOR_LIMITS",
    "OPERATOR_LIMITS_VALUED",
    "PROPER_NAMES",
    "PURPOSES",
    "SIDES",
    "SMALL_TALK",
    "TARGET_ADJECTIVES",
    "TARGET_NOUNS",
    "WHEREABOUTS",
    "WITH_PHRASES",
]
