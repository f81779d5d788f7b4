"""Which filter and perception skills a task input can ask for, by its words.

A skill of which no word speaks cannot be meant: an answer need not be able to add it. The words are
those of `evidence_words`, read as they stand and with the spelling put right in every way in which
it may be; a word that fits several skills speaks of each of them, and the model decides. Where too
few words are known to tell, nothing is said.
"""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Iterable

from planner_ft.data.lexicon import corrections, is_known, known_words
from planner_ft.data.words import edit_distance
from planner_ft.decoding.constraints.reading.skills import evidence_asked as a
from planner_ft.decoding.constraints.reading.skills import evidence_context as c
from planner_ft.decoding.constraints.reading.skills import evidence_words as w
from planner_ft.vocabulary import Vocabulary

MOST_UNKNOWN = 0.34
"""Share of the words that may be in no list; with more, a text is in another language or too far
from English to be read.
"""
HALF = 0.5
"""What an unknown word counts that can be put right."""
MOST_VARIANTS = 6
"""Spellings that a word which is in no list is tried in."""
_ELSEWHERE_YES = re.compile(r"[^.;!?]*\byes\b")
"""Behind what is not wanted in one place: "no soundings out, back yes"."""
MOST_BEHIND = 3
"""Words that may stand behind what is not wanted anywhere: more can say where it is."""
RARE = 2
"""A word that the lists have no oftener can be a misspelling that they have on purpose."""

_SIGNS = str.maketrans({"’": "'", "‘": "'", "–": "-", "—": "-", "−": "-", "‐": "-", "‑": "-"})
ENDLESS = re.compile(r"\S{60}")
"""What is no word and no number, and would be searched in every place."""
_WORD = re.compile(r"[^\W\d_]{3,}")
_QUOTED = re.compile(
    r"""["“”«»]([^"“”«»\n]{1,60})["“”«»]|(?<!\w)['‘’`]([^'‘’\n]{1,60})['‘’](?!\w)"""
)
"""A name, note or label in quotation marks: no words of the order."""
_NOT_ENGLISH = re.compile(r"[^\W\d_a-zA-Z°º]{2,}")
_SENTENCE = re.compile(r"[^.;!?\n]+(?:\.\d[^.;!?\n]*)*")
NEGATION = re.compile(
    r"\b(?:no|not|never|none|nor|neither|without|nothing|cannot|skip\w*|omit\w*|forget|forgo|cancel\w*|drop(?:ped)?"
    r" the|leave out|scratch|"
    r"disregard|ignore|except|unless|"
    r"instead|rather|less|minus|save"
    r" for|bar|off|already|earlier|yesterday|previous\w*|later|tomorrow|next time|last"
    r" (?:time|week|year|month|night)|"
    r"they|their|theirs|has been|"
    r"have been|was|were|had|would|could|might|may|if|in"
    r" case|un\w+ed|stop\w*|free|lifted|enough|spare|needless|pointless|useless|avoid "
    r"\w+ing|wait|broken|faulty|down|dead|but|upload\w*|send\w*|transmit\w*|transfer\w*|deliver\w*|ashore|correction|sorry|mean|meant|actually|"
    r"wrong)\b|n't\b|\bdont\b",
    re.IGNORECASE,
)
"""Words by which a sentence may not ask for what it names."""
TAKEN_BACK = re.compile(
    r"\b(?:scrap|scratch|cancel\w*|belay|disregard|strike (?:that|it|the)|as you were|second"
    r" thoughts?|change of plan|change your plans?|no longer|"
    r"correction|ignore|forget|never mind|(?:that|this|it|those|these|they|all)"
    r" (?:was|were|is|are|has been|have been) (?:already |all )?done|"
    r"done already|already done|drop (?:that|it|this)\b|leave (?:that|it|them) out|"
    r"take (?:[a-z]+ ){0,4}out\b|skip (?:that|it|them|this)|none of (?:that|this|it|these))\b"
)
"""Words that take back something which another sentence asks for."""
RULED_OUT = re.compile(
    r"\b(?:(?:don't|dont|do not|no need to) bother(?: with| about)?(?: a| the| any)?|nothing (?:is"
    r" |needs |has )?to be|(?:no|"
    r"without(?: any)?|never mind(?: the| about the)?|forget(?: about)?(?: the)?|skip(?: the)?|"
    r"(?:do(?:es)? not|don't|needn't|not) (?:need|want|require)"
    r"(?: to| any| a| the)?|no need (?:for|of)(?: a| any| the)?)(?: [a-z]+)?) $"
)
"""What stands before something that is not wanted at all."""
SCOPED = re.compile(
    r"\b(?:on|in|at|during|until|while|when|before|after|first|second|third|last|leg|step|turn|hold|yet|then|further|more|other|else|but|except|"
    r"only|from|there|"
    r"here|run|way|once|as|for|than|less|interrupt\w*|brok\w*|break\w*|gaps?|lost|stopp?\w*|anywhere|miss\w*)\b"
)
"""Words that may say where something is not wanted, so that elsewhere it is."""


def spoken_of(text: str, vocabulary: Vocabulary) -> frozenset[str] | None:
    """Names of the filter and perception skills that some word of the text can mean; None where it
    cannot be told.
    """
    names = {
        skill.name for role in ("filter", "perception") for skill in vocabulary.skills_in_role(role)
    }
    if not names <= w.SPOKEN.keys() or not readable(text):
        return None
    spelt = variants(text)
    found = frozenset(name for name in names if any(_speaks(variant, name) for variant in spelt))
    return (
        found
        | _implied(spelt, found - {skill.name for skill in vocabulary.skills_in_role("filter")})
        & names
    )


def mentions(text: str, name: str) -> int:
    """In how many sentences a word can mean a skill; 0 for one that no words are known of."""
    return (
        sum(
            1
            for sentence in _SENTENCE.finditer(_plain(text))
            if _spoken(name).search(sentence.group())
        )
        if name in w.SPOKEN
        else 0
    )


def required(text: str, vocabulary: Vocabulary) -> frozenset[str]:
    """Names of the filter and perception skills that the text asks for beyond doubt: a plan that
    never runs one lacks it.
    """
    names = {
        skill.name for role in ("filter", "perception") for skill in vocabulary.skills_in_role(role)
    }
    if not names <= w.SPOKEN.keys() or not readable(text):
        return frozenset()
    plain = _plain(text)
    if TAKEN_BACK.search(_PASSING.sub(" ", plain)):
        return frozenset()
    sentences = [_HARMLESS.sub(" ", match.group()) for match in _SENTENCE.finditer(plain)]
    doubtful = [sentence for sentence in sentences if NEGATION.search(_PASSING.sub(" ", sentence))]
    sure = [sentence for sentence in sentences if sentence not in doubtful]
    asked = {
        name for name in names if any(_unmistakable(name).search(sentence) for sentence in sure)
    }
    return frozenset(
        name for name in asked if not any(_spoken(name).search(sentence) for sentence in doubtful)
    )


def asks_for(sentence: str, name: str) -> bool:
    """Whether a sentence in small letters has words for a skill and no other."""
    return name in c.UNMISTAKABLE and _unmistakable(name).search(sentence) is not None


def words_for(name: str) -> re.Pattern[str]:
    """The words that can mean a skill, in small letters."""
    return _spoken(name)


def _speaks(text: str, name: str) -> bool:
    """Whether a spelling of the text can mean a skill."""
    if name == "BoundaryEnforcement" and not _FENCED.search(text):
        return any(
            not (_ruled_out(text, match) or _ROW.match(match.group()))
            for match in _spoken(name).finditer(text)
        )
    if name == "DetectSonarFeature":
        return any(
            not _only_recorded(text, match) and not _ruled_out(text, match)
            for match in _spoken(name).finditer(text)
        )
    if any(
        not (
            _ruled_out(text, match)
            or _measured_otherwise(text, match)
            or _a_place(text, match)
            or _a_remark(text, match, name)
        )
        for match in _spoken(name).finditer(text)
    ):
        return True
    return name == "DetectObjects" and any(
        not _sought_otherwise(text, match) for match in _SEEKING.finditer(text)
    )


def _ruled_out(text: str, match: re.Match[str]) -> bool:
    """Whether what a match names is not wanted anywhere: "no recording.", and no word about
    where.
    """
    before, behind = (
        text[: match.start()],
        re.split(r"[.;,:!?\n]", text[match.end() :], maxsplit=1)[0],
    )
    if _ELSEWHERE_YES.match(text[match.end() :]) or _NEGATED_TWICE.search(
        re.split(r"[.;!?]", before)[-1]
    ):
        return False
    return (
        RULED_OUT.search(before[-60:]) is not None
        and len(behind.split()) <= MOST_BEHIND
        and not SCOPED.search(behind)
    )


def _sought_otherwise(text: str, match: re.Match[str]) -> bool:
    """Whether a verb of seeking is about something that another skill finds."""
    behind, before = text[match.end() :].lstrip(), re.split(r"[.;,:]", text[: match.start()])[-1]
    return bool(
        _SOUGHT_OTHERWISE.search(behind)
        or _BY_SONAR_BEHIND.search(behind)
        or _BY_SONAR_BEFORE.search(before)
    )


def _a_remark(text: str, match: re.Match[str], name: str) -> bool:
    """Whether a match is in a remark: the sun on the lens, what some people want."""
    remarks = {"CheckLensClearness": _DAZZLED, "DetectObjects": _WISHED}.get(name)
    if remarks is None:
        return False
    last = match.end() - 1
    begin = max((end.end() for end in _SENTENCE_END.finditer(text[:last])), default=0)
    sentence = _SENTENCE_END.split(text[begin:], maxsplit=1)[0]
    return any(
        begin + found.start() <= last < begin + found.end() for found in remarks.finditer(sentence)
    ) and not _LOOKED_AT.search(sentence)


def _measured_otherwise(text: str, match: re.Match[str]) -> bool:
    """Whether a match is no more than the word of a measurement, and its clause says what is
    measured.
    """
    if not _MEASUREMENT.fullmatch(match.group()):
        return False
    before, behind = (
        _CLAUSE_END.split(text[: match.start()])[-1],
        _CLAUSE_END.split(text[match.end() :], maxsplit=1)[0],
    )
    return _MEASURED_OTHERWISE.search(f"{before}{match.group()}{behind}") is not None


def _a_place(text: str, match: re.Match[str]) -> bool:
    """Whether a position is a place to be at, or goes with a picture, and is no position to be
    logged.
    """
    if not _POSITION.fullmatch(match.group()):
        return False
    before = text[max(0, match.start() - 80) : match.start()]
    return bool(
        _PLACE_BEFORE.search(before)
        or _PLACE_BEHIND.search(text[match.end() :])
        or _OF_SHOT.search(before)
    )


def _only_recorded(text: str, match: re.Match[str]) -> bool:
    """Whether a sonar is named as what is recorded, or what takes the depth, in a sentence that
    seeks nothing.
    """
    before = re.split(r"[.;]\s", text[: match.start()])[-1]
    behind = re.split(r"[.;]\s", text[match.end() :], maxsplit=1)[0]
    recorded = _RECORDED.search(before) or _RECORDED_BEHIND.search(behind)
    return recorded is not None and not _ANY_SEEKING.search(f"{before} {match.group()} {behind}")


def _implied(variants: Iterable[str], perception: frozenset[str]) -> frozenset[str]:
    """The skills that a task's name stands for, where the text speaks of no perception or, in a
    health check, of none of its parts.
    """
    fitting = [
        names for pattern, names in _IMPLIED if any(pattern.search(text) for text in variants)
    ]
    return frozenset(
        name
        for names in fitting
        if not (perception & names if names == _HEALTH else perception)
        for name in names
    )


def _plain(text: str) -> str:
    """The text in small letters with straight quotation marks, what is quoted left out."""
    shown = _QUOTED.sub(
        lambda match: '"x"' if len(match.group()) * 2 < len(text) else match.group(), text
    )
    return re.sub(r"[ \t]+", " ", shown.translate(_SIGNS)).strip().lower()


def variants(text: str) -> list[str]:
    """The text, and it with the words that are in no list put right in some other way each time."""
    plain = _plain(text)
    places = [(match, found) for match in _WORD.finditer(plain) if (found := _meant(match.group()))]
    most = max((len(found) for _match, found in places), default=0)
    spelt = [
        _replaced(plain, [(match, found[min(number, len(found) - 1)]) for match, found in places])
        for number in range(min(most, MOST_VARIANTS))
    ]
    return list(dict.fromkeys([plain, *spelt]))


def _replaced(text: str, places: Iterable[tuple[re.Match[str], str]]) -> str:
    parts, end = [], 0
    for match, word in places:
        parts += [text[end : match.start()], word]
        end = match.end()
    return "".join([*parts, text[end:]])


@functools.lru_cache(maxsize=4096)
def _meant(word: str) -> tuple[str, ...]:
    """What a word that no list has, or that hardly ever stands there, may be meant for: words of
    the evidence first.
    """
    if known_words().get(word, 0) > RARE:
        return ()
    if len(word) < 4:
        return corrections(word, MOST_VARIANTS)
    limit = 1 if len(word) < 7 else 2
    near = sorted(
        (edit_distance(word, key, limit), key)
        for key in _keys()
        if abs(len(key) - len(word)) <= limit
    )
    likely = [key for distance, key in near if distance <= limit]
    near_words = [
        candidate
        for pair in itertools.zip_longest(likely[:2], corrections(word))
        for candidate in pair
        if candidate
    ]
    # What may be right as it stands stays so while other words are put right.
    return tuple(dict.fromkeys([word, *near_words] if is_known(word) else near_words))


@functools.cache
def _keys() -> tuple[str, ...]:
    """The words in full of all patterns that a misspelt word is compared with."""
    patterns = itertools.chain(*w.SPOKEN.values(), *c.UNMISTAKABLE.values())
    words = {word for pattern in patterns for word in re.findall(r"[a-z]{5,}", pattern)}
    words |= {f"{word}s" for word in words}
    return tuple(sorted(word for word in words if word in known_words()))


def readable(text: str) -> bool:
    """Whether enough of the words are known ones for what is missing to mean something."""
    if ENDLESS.search(text):
        return False
    plain = _plain(text)
    if _NOT_ENGLISH.search(plain):
        return False
    names = {match.group().lower() for match in _NAME.finditer(text)}
    words = [word for word in _WORD.findall(plain) if word not in names]
    if len(set(words) & _FOREIGN) > 1:
        return False
    unknown = [word for word in words if not is_known(word)]
    return sum(HALF if _meant(word) else 1 for word in unknown) <= max(1, MOST_UNKNOWN * len(words))


def _alternatives(patterns: Iterable[str]) -> re.Pattern[str]:
    return re.compile(rf"(?:(?<![a-z])|(?=[^a-z]))(?:{'|'.join(patterns)})")


@functools.cache
def _spoken(name: str) -> re.Pattern[str]:
    return _alternatives(w.SPOKEN[name])


@functools.cache
def _unmistakable(name: str) -> re.Pattern[str]:
    return re.compile(
        "|".join(rf"\b(?:{pattern})" for pattern in (*c.UNMISTAKABLE[name], *a.ASKED[name]))
    )


_NAME = re.compile(r"(?<=[a-z,] )[A-Z][a-z]+")
_FOREIGN = frozenset(
    (
        "und",
        "der",
        "die",
        "das",
        "dem",
        "den",
        "mit",
        "zum",
        "zur",
        "nach",
        "auf",
        "ist",
        "nicht",
        "wenn",
        "het",
        "een",
        "van",
        "naar",
        "les",
    )
) | frozenset(
    (
        "des",
        "une",
        "avec",
        "pour",
        "vers",
        "dans",
        "sur",
        "las",
        "los",
        "con",
        "por",
        "para",
        "del",
        "una",
        "che",
        "della",
        "och",
        "med",
    )
)
"""Small words of other languages, two of which no English text has."""
_POSITION = re.compile(
    r"positions?|posn|pos|whereabouts|locations?|latitude|longitude|coordinates?|coords?"
)
_PLACE_BEFORE, _PLACE_BEHIND, _OF_SHOT = (
    re.compile(pattern) for pattern in (c.PLACE_BEFORE, c.PLACE_BEHIND, c.OF_SHOT)
)
_MEASUREMENT = re.compile(r"measur\w*|readings?")
_NEGATED_TWICE = re.compile(r"\b(?:no|not|never|neither|none|nor|don't|nothing)\b.*\bwithout\b")
_MEASURED_OTHERWISE = re.compile(c.MEASURED_OTHERWISE)
_SENTENCE_END = re.compile(r"[.!?;](?=\s|$)")
_DAZZLED = re.compile(
    r"\b(?:sun\w*|glare|moon\w*|(?:low |bright )light)\b[^.;,]{0,40}\b(?:lens|glass|camera)\b|"
    r"\b(?:lens|glass|camera)\b[^.;,]{0,20}\b(?:sun|glare)\b"
)
_WISHED = re.compile(
    r"\b(?:[a-z-]+ ){0,3}"
    r"(?:people|crew|divers?|swimmers?|guys|folks?|owners?|skippers?|fishermen|surveyors?|scientists?)(?:"
    r" now| also| still| only| just| here)* "
    r"(?:want|need|ask|say|said|told|tell|think|would like|like"
    r" to|prefer|insist|expect|complain|require|pay|request)(?:s|ed)?\b[^.;]{0,40}"
)
"""What the sun does to a picture, and what people are said to want: nothing to look for."""
_LOOKED_AT = re.compile(
    r"\b(?:check|drops?|droplets?|clean|clear|wip\w+|wet|detect\w*|look|watch|search|spot|lookout|salt|spray)\b"
)
_CLAUSE_END = re.compile(r"[.;,:!?\n]|\b(?:and|while|then)\b")
_ROW = re.compile(r"[\[(x\d]|corners")
"""Points in a row, which are no fence unless one is spoken of."""
_FENCED = re.compile(
    r"fenc|\bbound(?!\b)|\binside\b|\bwithin\b|\bstay|\bkeep|\bremain|\bleav|\bleft\b|limit|confin|outside|\bout"
    r" of\b|\bcross|respect|enforc|"
    r"allow|permit|\bbox\b(?! search| survey)|"
    r"beyond|polygon|stray|perimeter|border|operat"
)
_SEEKING = re.compile(rf"\b{c.SEEKING}")
_SOUGHT_OTHERWISE = re.compile(c.SOUGHT_OTHERWISE)
_BY_SONAR_BEHIND, _BY_SONAR_BEFORE = re.compile(c.BY_SONAR_BEHIND), re.compile(c.BY_SONAR_BEFORE)
_RECORDED, _RECORDED_BEHIND, _ANY_SEEKING = (
    re.compile(pattern) for pattern in (c.RECORDED, c.RECORDED_BEHIND, c.ANY_SEEKING)
)
_HARMLESS = re.compile(c.HARMLESS)
_PASSING = re.compile(a.PASSING)
_HEALTH = frozenset(c.HEALTH)
_IMPLIED = tuple(
    (re.compile(rf"\b(?:{pattern})"), frozenset(names)) for pattern, names in c.IMPLIED
)
