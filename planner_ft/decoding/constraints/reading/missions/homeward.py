"""Whether a command may mean the vehicle to come home: ruled out in plain words, or home is only
what something is told from.
"""

from __future__ import annotations

import re

_COMING = (
    r"(?:return(?:s|ed|ing)?|(?:com|go|gett?|head|sail|steam|driv|mak)(?:e|es|ing|ed)? (?:straight"
    r" |right |all the way )?(?:back|home)"
    r"|(?:be(?:ing)? )?(?:brought|sent|driven|taken) (?:back |straight )?home|bring(?:ing)? (?:\w+"
    r" ){1,2}?(?:back|home)|RTB|homecoming|way home)"
)
NO_RETURN = re.compile(
    rf"\b(?:do not|don['’]?t|does not|needn['’]?t|need not|no need to|not need to|without|never|not"
    rf" to|won['’]?t|not|no) (?!forget|only|until)"
    rf"(?:(?!and\b|then\b|but\b)[\w']+ ){{0,4}}?{_COMING}\b(?!"
    r" (?:until|before|till|between|without|too|late|empty|with|to"
    r" (?!home|base|port|harbou?r|shore)))",
    re.IGNORECASE,
)
HOME_MEANT = re.compile(
    r"\b(?:(?:leav\w+|left|depart\w*|quit\w*) (?:from |of )?|(?:away|off|out) (?:from|of) |"
    r"(?:near|close|far|furth)\w* (?:to |from )?|(?:north|south|east|west)\w* (?:of|from) )"
    r"(?:the |your |our )?(?:home|base|harbou?r|port)\b",
    re.IGNORECASE,
)
"""Home as what something is told from: where the vehicle leaves, what a target is near to."""
HOME = re.compile(
    r"\b(?:home\w*|hom|hme|base|back|return\w*|rt[bh]|come in|head in|in"
    r" again|harbou?r|port|berth|shore|ashore|start\w*|origin|where|\[?\(?0\s?[,/;]\s?0\b)",
    re.IGNORECASE,
)


_HOME_AT_ALL = re.compile(
    r"home|\b(?:h[aeiou]+m\w?|ho\w?e?m|hme|com\w*|cum|b\w?c?k|ba\w?k|ret\w*|in for|rtb|rth|trip|0 ?[,/;] ?0|zero,? zero|nought)\b",
    re.IGNORECASE,
)
"""Any word that may speak of home, misspelt ones too."""


def home_meant(command: str) -> bool:
    """Whether a command may mean the vehicle to go home at all."""
    return HOME.search(command) is not None or _HOME_AT_ALL.search(command) is not None


def no_way_home(command: str) -> bool:
    """Whether a command rules out the way home, or speaks of home in another sense alone ("before
    you leave home", "50 m east of home").
    """
    elsewhere, count = HOME_MEANT.subn(" ", command)
    denied = NO_RETURN.search(command)
    if denied:
        rest = f"{command[: denied.start()]} ; {command[denied.end() :]}"
        return HOME.search(HOME_MEANT.sub(" ", rest)) is None
    return bool(count) and HOME.search(elsewhere) is None
