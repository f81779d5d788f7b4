"""In which steps a filter or perception skill runs, told against the row of the text's movements.

The text is cut into items at commas and conjunctions. A skill belongs to the scope of its item ("on the inner leg", "as long as she floats", "from that
moment on"), else to the movement of its item, else to what its clause leaves no choice of. Words of denial ("no detector under way") say where it does not
run. A plan that does not go by the row is told what holds for kinds of movement only.
"""

from __future__ import annotations

import itertools
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field, replace

from planner_ft.data.quantities import quantities
from planner_ft.decoding.constraints.reading.paths.itinerary import without_fences
from planner_ft.decoding.constraints.reading.rows.movement_rows import Plain, Row, plain, row_of, unread_places
from planner_ft.decoding.constraints.reading.scopes import scope_words as w
from planner_ft.decoding.constraints.reading.scopes import step_scope_words as s
from planner_ft.decoding.constraints.reading.scopes.own_sentences import SOMEWHERE
from planner_ft.decoding.constraints.reading.scopes.skill_mentions import CLEARANCE, Mention, mentions_of, sentence_at
from planner_ft.decoding.constraints.reading.scopes.step_meanings import EVERYWHERE, Anchor, Where, anchors_of, scopes_of
from planner_ft.decoding.constraints.reading.skills.evidence import NEGATION, asks_for
from planner_ft.vocabulary import Vocabulary


@dataclass(frozen=True)
class StepScope:
    """The steps in which a skill runs and those in which it does not; of the others nothing is known unless it is `closed`."""

    row: Row | None
    runs: tuple[Where, ...] = ()
    rests: tuple[Where, ...] = ()
    closed: bool = False
    values: tuple[tuple[Where, float], ...] = ()
    """The values that a skill has in some steps, where they differ."""

    def value(self, names: Sequence[str]) -> float | None:
        """The value of the skill in the last of some steps; None where it is not told for this step."""
        found = {value for where, value in self.values if where.holds(names, self.row)}
        return found.pop() if len(found) == 1 else None

    def allows(self, names: Sequence[str]) -> bool | None:
        """Whether the skill must run (True) or must not (False) in the last of some steps; None: not known."""
        rests = [where.holds(names, self.row) for where in self.rests]
        if True in rests:
            return False
        runs = [where.holds(names, self.row) for where in self.runs]
        if True in runs:
            return None if None in rests else True
        return None if None in runs or not self.closed else False


@dataclass(frozen=True)
class StepReading:
    """What an input says of the steps of its skills; `asked` are those that it asks for beyond doubt in some of them."""

    scopes: dict[str, StepScope] = field(default_factory=dict)
    asked: frozenset[str] = frozenset()


_REPEATED = re.compile(
    r"\b(?:repeat\w*|back and forth|to and fro|alternat\w+|once more|over and over|each of (?:these|them|which)|in reverse|backwards|"
    r"the other way round|scratch|"
    r"correction|make that|no wait|sorry|i mean|rather not|instead)\b"
)
"""Words of texts whose movements are not told one after the other, or are taken back."""
_PAUSED = re.compile(
    r"\b(?:hold|stop|wait|pause|stay|halt|turn|pan|nudge|face|rotate)\w*\b[^.;]{0,50}\b(?:at|on|in|after|behind|between) (?:each|every|all|both|either)\b|"
    r"\b(?:at|on|after|behind|between) (?:each|every|all|both) (?!turns?\b,? (?:get|have)|"
    r"hold)[^.;]{0,40}\b(?<!the )(?<!each )(?<!every )(?<!in )(?:hold|stop|wait|pause|stay|halt|turn|pan|face)(?:s|ing|ping)?\b"
)
_ORDER = re.compile(
    r"\bbut (?:first|before)|\bbefore (?:\w+ing\b|that|you|this|it|going|turning|the)|\bpreceded\b|\bfirst of all\b|\bafter (?:you|having|the)\b|"
    r"\bprior to\b|(?<!not )(?<!no )\bearlier\b"
)
_STRUCTURE = re.compile(
    r"\b(?:face|wall|side|quay|cable|pipe\w*|edge|breakwater|pontoon|hull|barge|jetty|line|structure|array|boom|pier|dam)\b[^.;@]{0,30}"
    r"\b(?:runs?|goes|lies|extends|stretches|starts|begins|leaves|leads)\b[^.;]{0,20}@"
)
"""A structure's course, whose places are not gone to as they are told."""
_LISTED = re.compile(r"\bthen @ in (?:that|this|the given|the stated) order\b")
"""Places in a list, of which the last may be taken for a movement of its own."""
_ACROSS = re.compile(r"\bfrom @ (?:across|over|straight|on|direct(?:ly)?) to @")
"""A run whose beginning is gone to as well."""
_LIKE_MOVEMENTS = ("FitCylinderModel", "LockHeading", "LogLidarSlice", "ObstacleAvoidance")
"""Skills whose words could be those of movements."""
_SENSOR_ONLY = re.compile(r"GetSeabedDepth|CheckLensClearness|GetGPSLocation|SetStreamRecording|DetectSonarFeature")
_CLAUSE = re.compile(
    r";|\s[-–—]\s|,?\s*\b(?:and |but )?(?:(?<!by )(?<!until )(?<!till )(?<!from )then(?=,? \w)|next(?=,)|after which|finally|lastly|subsequently)\b,?|\b\d\) "
)
_ITEM = re.compile(r"[,:()]|\b(?:and|but|while|with|without|plus|yet|so)\b")


def read_step_scopes(text: str, names: Iterable[str], vocabulary: Vocabulary) -> StepReading:
    """The steps of those of some filter and perception skills of which the text leaves no doubt."""
    said = plain(text)
    if not said.text or w.CHANGED.search(said.text) or " STOP " in text or text.endswith(" STOP"):
        return StepReading()
    if _LISTED.search(said.text):
        return StepReading()
    found = list(scopes_of(said.text))
    once = [place for place in said.places.values() if list(said.places.values()).count(place) == 1]
    # "As far as @ no care is needed": a place that nothing else leads to is gone to.
    found = [(kind, match) for kind, match in found if not (_FREELY.match(said.text[match.start() :]) and said.places.get(match.end() - 1) in once)]
    found = _scopes_only(said, found)
    masked = [match.span() for name in _LIKE_MOVEMENTS for match in w.SKILL_WORDS[name].finditer(said.text)]
    row: Row | None = row_of(said, [*(match.span() for kind, match in found if "@" not in match[0] or kind in ("upto", "beyond", "place")), *masked])
    assert row is not None
    counted = row
    if _repeated(said.text, row, found) or _PAUSED.search(said.text) or _ORDER.search(said.text) or not row.units:
        row = None
    if _ACROSS.search(said.text):
        row = None
    if row is not None and _unread_movement(said.text, row, _unresolved(found)):
        row = None
    bounds = [match.span() for kind, match in found if kind in ("upto", "beyond")]
    if row is not None and (_STRUCTURE.search(said.text) or unread_places(said, row, bounds) or _unread_leg(said.text, row)):
        row = None
    anchors = anchors_of(said, found, counted, row is not None)
    mentions = mentions_of(said.text, [name for name in names if name in w.SKILL_WORDS], anchors)
    placed: dict[str, list[tuple[Mention, Where | None, bool]]] = {}
    asked = set()
    clearances: list[tuple[Where, tuple[int, int]]] = []
    loose = _loose(said.text, mentions, anchors)
    for mention, where, item in _placed(said.text, mentions, anchors, counted):
        where = None if mention in loose else where
        if mention.name == CLEARANCE and where is not None and not mention.denied:
            clearances.append((where, item))
        plainly = asks_for(said.text[slice(*item)], mention.name) or (mention.name == "BoundaryEnforcement" and without_fences(text) != text)
        placed.setdefault(mention.name, []).append((mention, where, plainly))
        if where is not None and not mention.denied and plainly and not NEGATION.search(_without(said.text, item, anchors, mentions)):
            asked.add(mention.name)
    limits = [(anchor, *sentence_at(said.text, anchor.start)) for anchor in anchors if anchor.is_scope and anchor.where != EVERYWHERE]
    scopes = {name: scope for name, found_places in placed.items() if (scope := _scope(found_places, row, limits)) is not None}
    if CLEARANCE in scopes:
        scopes[CLEARANCE] = replace(scopes[CLEARANCE], values=_values(text, said, clearances))
    if [unit.steps for unit in counted.units] == [1] and not limits:
        # In the one step of a text everything runs: what it denies is all that is to be told.
        return StepReading({name: scope for name, scope in scopes.items() if not scope.runs})
    return StepReading(scopes, frozenset(asked & scopes.keys()))


def _scopes_only(said: Plain, found: Sequence[tuple[str, re.Match[str]]]) -> list[tuple[str, re.Match[str]]]:
    """The scopes of a text without words of order before a movement ("after that hold on") and places that nothing else leads to ("as far as @")."""
    row = row_of(said, [match.span() for kind, match in found if "@" not in match[0] or kind in ("upto", "beyond", "place")])
    places = list(said.places.values())

    def leads(kind: str, match: re.Match[str]) -> bool:
        if kind == "rest":
            begins = re.search(r"(?:^|[.;] |\band |, )$", said.text[: match.start()]) is not None
            return begins and any(unit.start - match.end() in (1, 2) and not unit.chained for unit in row.units)
        if kind == "upto" and re.match("as far|up to", match[0]):
            place = said.places.get(match.start() + match[0].find("@"))
            return places.count(place) == 1 and not any(unit.kind == w.GOTO and unit.start < match.start() for unit in row.units) if place else False
        return False

    return [(kind, match) for kind, match in found if not leads(kind, match)]


def _repeated(text: str, row: Row, found: Sequence[tuple[str, re.Match[str]]]) -> bool:
    """Whether movements are repeated or taken back. "At the third no sonar, drop a pin instead" is about skills."""
    for match in _REPEATED.finditer(text):
        begin, end = sentence_at(text, match.start())
        if match[0] != "instead" or any(begin <= unit.start < end for unit in row.units) or not any(begin <= scope.start() < end for _kind, scope in found):
            return True
    return False


_FREELY = re.compile(r"(?:up to|as far as) @ (?:you|she|we|it)\b[^.;,]{0,20}\b(?:no|not|nothing|without|freely|needn't)\b")
"""What stands at the beginning of a way on which nothing runs."""
_NOTHING = re.compile(r"^[,:]? ?(?:\w+ ){0,2}(?:nothing|none|without|no\b|not\b)")
"""What follows a scope in which nothing runs."""
_LEG = re.compile(
    r"\b\d[\d.]* ?(?:m|metres?|meters?|km|yards?|feet)\b(?: further| more| out)? (?:on (?:an? )?(?:the )?(?:bearing|course|heading)|due|"
    r"(?:to the |further )?(?:north|south|east|west)\w*)\b"
)
"""A leg by its length and bearing, that is a movement."""
_ORDERED = re.compile(r"^\W*(?:and )?(?:first(?:ly)?|second(?:ly)?|third(?:ly)?|next|then|lastly|finally|after that|afterwards|from there|on arrival)\b,?")


def _unresolved(found: Sequence[tuple[str, re.Match[str]]]) -> list[Anchor]:
    """The scopes of a text before it is known what they mean."""
    return [Anchor(match.start(), match.end(), True, None) for _kind, match in found]


def _unread_movement(text: str, row: Row, scopes: Sequence[Anchor]) -> bool:
    """Whether a sentence begins with a word of order and tells no movement that is read."""
    if len(re.findall(r"\bengines? (?:off|stopped|on)\b", text)) > 1:
        return True
    return any(
        _ORDERED.match(text[begin:end]) and not any(begin <= unit.start < end for unit in row.units) and not any(begin <= scope.start < end for scope in scopes)
        for begin, end in _pieces(text, w.SENTENCE, 0, len(text), scopes)
    )


def _unread_leg(text: str, row: Row) -> bool:
    """Whether a text tells a leg that is no movement of its row."""
    return any(not any(unit.start <= match.end() and match.start() <= unit.end + 1 for unit in row.units) for match in _LEG.finditer(text))


def _without(text: str, item: tuple[int, int], anchors: Sequence[Anchor], mentions: Sequence[Mention]) -> str:
    """An item without its scopes and movements, what it denies of other skills ("no recording") and "instead" at its end."""
    inside = [(anchor.start, anchor.end) for anchor in anchors if item[0] <= anchor.start < item[1]]
    for mention in mentions:
        refused = re.search(r"\b(?:no|without) (?:\w+ )?$", text[item[0] : mention.start]) if mention.denied and item[0] <= mention.start < item[1] else None
        if refused and not any(item[0] + refused.start() < end and start < mention.end for start, end in inside):
            inside.append((item[0] + refused.start(), mention.end))
    inside.sort()
    ends = [item[0], *(end for _start, end in inside)]
    left = " ".join(text[begin:end] for begin, end in zip(ends, [*(start for start, _end in inside), item[1]], strict=True))
    return re.sub(r"\binstead\W*$", " ", left)


def _limited(mention: Mention, scopes: Sequence[tuple[Anchor, int, int]]) -> bool:
    """Whether a scope stands in the sentence of words that deny a skill, or in words that are not read as one."""
    return any(begin <= mention.start < end for _anchor, begin, end in scopes) or mention.bound


def _values(text: str, said: Plain, items: Iterable[tuple[Where, tuple[int, int]]]) -> tuple[tuple[Where, float], ...]:
    """The clearances of items, if each has one length and they differ."""
    found: dict[tuple[int, int], tuple[Where, float]] = {}
    for where, (begin, end) in items:
        lengths = [quantity.value for quantity in quantities(text[said.origin[begin] : said.origin[end - 1] + 1]) if quantity.unit == "m"]
        if len(lengths) != 1:
            return ()
        found[begin, end] = where, lengths[0]
    return tuple(found.values()) if len({value for _where, value in found.values()}) > 1 else ()


def _scope(places: Sequence[tuple[Mention, Where | None, bool]], row: Row | None, anchors: Sequence[tuple[Anchor, int, int]]) -> StepScope | None:
    if any(where not in (None, EVERYWHERE) and not mention.denied for mention, where, _plainly in places):
        # "Use the bow sounder" says nothing of where.
        places = [place for place in places if place[1] not in (None, EVERYWHERE) or place[2] or not _SENSOR_ONLY.fullmatch(place[0].name)]
    if all(mention.denied and not _limited(mention, anchors) for mention, _where, _plainly in places):
        return StepScope(row, (), (EVERYWHERE,))
    runs = tuple(dict.fromkeys(where for mention, where, _plainly in places if where and not mention.denied))
    rests = tuple(dict.fromkeys(where for mention, where, _plainly in places if where and mention.denied))
    unread = any(where is None for _mention, where, _plainly in places)
    if not runs and not rests:
        return None
    if EVERYWHERE in runs and (unread or len(runs) > 1):
        return None
    return StepScope(row, runs, rests, closed=bool(runs) and not unread)


_GOES_ON = re.compile(
    r" (?:drop|take|log|read|check|measure|record|save|mark|pin|run|detect|track|note|get|keep|enter|register|switch|a|an|the|seabed|gps|no|nothing|only "
    r"(?:take|log|read|drop))\b"
)
"""What is done in a scope that it stands behind."""


def _pieces(text: str, pattern: re.Pattern[str], start: int, end: int, anchors: Sequence[Anchor]) -> list[tuple[int, int]]:
    """The parts of a text between separators that stand in no anchor."""
    pieces, begin = [], start
    for match in pattern.finditer(text, start, end):
        before = next((anchor for anchor in anchors if anchor.is_scope and anchor.end <= match.start() and not text[anchor.end : match.start()].strip()), None)
        behind = next((anchor for anchor in anchors if anchor.is_scope and match.end() <= anchor.start and not text[match.end() : anchor.start].strip()), None)
        joins = before is not None and behind is not None and ";" not in match[0]
        if before and behind and re.search(r"[a-z]", text[begin : before.start]) and _GOES_ON.match(text[behind.end :]):
            # "A fix at the first point and at the last drop a pin."
            joins = False
        if match.start() > begin and not joins and not any(anchor.start < match.end() and match.start() < anchor.end for anchor in anchors):
            pieces.append((begin, match.start()))
            begin = match.start() if match[0].strip().isalpha() else match.end()
    return [*pieces, (begin, end)]


def _placed(text: str, mentions: Sequence[Mention], anchors: Sequence[Anchor], row: Row) -> Iterator[tuple[Mention, Where | None, tuple[int, int]]]:
    """Each mention of a skill with the steps that are meant, and its item."""
    sentences = _pieces(text, w.SENTENCE, 0, len(text), anchors)
    for first, last in sentences:
        clauses = _pieces(text, _CLAUSE, first, last, anchors)
        head: Anchor | None = None
        for begin, end in clauses:
            items = _pieces(text, _ITEM, begin, end, anchors)
            inside = [anchor for anchor in anchors if begin <= anchor.start < end]
            colon = text.find(":", begin, end)
            if colon > 0 and inside and inside[0].is_scope and inside[0].end <= colon and not text[begin : inside[0].start].strip(" ,"):
                head = inside[0]
            for mention in mentions:
                if begin <= mention.start < end:
                    item = next((a, b) for a, b in items if a <= mention.start < b or b >= end)
                    yield mention, _where(text, mention, item, (begin, end), (first, last), inside, anchors, head, row), item


def _where(
    text: str, mention: Mention, item: tuple[int, int], clause: tuple[int, int], sentence: tuple[int, int], inside: Sequence[Anchor],
    anchors: Sequence[Anchor], head: Anchor | None, row: Row,
) -> Where | None:  # fmt: skip
    near = [anchor for anchor in inside if item[0] <= anchor.start < item[1] and (mention.denied or not anchor.denied)]
    scopes = [anchor for anchor in near if anchor.is_scope]
    if scopes and re.search(r"\b(?:already|even)\b", text[slice(*item)]):
        return None
    if scopes:
        return scopes[0].where if len(scopes) == 1 else _joined(text, scopes)
    rest = text[item[0] : item[1]]
    for anchor in near:
        rest = rest.replace(text[anchor.start : anchor.end], " ")
    if s.UNREAD.search(rest):
        return None
    if near:
        ahead = [anchor for anchor in near if anchor.end <= mention.start]
        return ahead[-1].where if ahead else near[0].where if len(near) == 1 else None
    if head is not None:
        return head.where
    usable = [anchor for anchor in inside if not anchor.denied]
    colon = text.rfind(":", sentence[0], mention.start)
    headed = [anchor for anchor in anchors if not anchor.is_scope and sentence[0] <= anchor.start < colon]
    if len(headed) > 1:
        return None
    if headed and headed[0].start >= clause[0] and not any(colon < anchor.start < mention.start for anchor in anchors):
        return headed[0].where
    left_out = [anchor for anchor in usable if anchor.kind == "except" and mention.end <= anchor.start]
    if left_out and len([anchor for anchor in usable if anchor.is_scope]) == 1 and not s.UNREAD.search(text[mention.end : left_out[0].start]):
        between = any(mention.end <= anchor.start < left_out[0].start for anchor in usable)
        return left_out[0].where if not between and re.search(r"[a-z]", text[left_out[0].end : clause[1]]) is None else None
    coming = next((anchor for anchor in usable if mention.end <= anchor.start), None)
    if coming is not None and re.fullmatch(r"[^,;:]*\b(?:while|when|as|only) (?:(?:she|you|it) )?(?:is |are )?", text[mention.end : coming.start]):
        return coming.where
    if not usable:
        return _own(text, sentence, anchors, row)
    opening = usable[0].is_scope and not re.search(r"[a-z]{3,}", re.sub(r"\b(?:and|but|with|while|so)\b", "", text[clause[0] : usable[0].start]))
    if opening:
        ahead = [anchor for anchor in usable if anchor.is_scope and anchor.end <= mention.start]
        moved = [anchor for anchor in usable if not anchor.is_scope and ahead and ahead[-1].end <= anchor.start < mention.start]
        if moved and ahead[-1].kind == "onwards" and moved[0].start - ahead[-1].end <= 2:
            # "From there on to the goal position no margin is needed."
            del moved[0]
        if not ahead or moved or s.UNREAD.search(text[ahead[-1].end : mention.start]):
            return None
        joined = [anchor for anchor in ahead if anchor is ahead[-1] or re.fullmatch(r",? ?(?:and|or|as well as) ?", text[anchor.end : ahead[-1].start])]
        return _joined(text, joined) if len(joined) > 1 else ahead[-1].where
    if len(usable) == 1:
        only = usable[0]
        if only.is_scope:
            behind = text[mention.end : only.start]
            return only.where if mention.end <= only.start and ("," not in behind or re.search(r"\band\b", behind)) else None
        if only.start < mention.start:
            return only.where
        return only.where if re.match(r"\s*(?:with|while|keeping|staying|under|\w+ing)\b", text[clause[0] : clause[1]]) else None
    behind_it = [anchor for anchor in usable if anchor.is_scope and mention.end <= anchor.start]
    if behind_it and re.fullmatch(r"[^,;:]*,? ?(?:and |but |though )?", text[mention.end : behind_it[0].start]) and _closes(text, behind_it[0]):
        return behind_it[0].where
    ahead = [anchor for anchor in usable if anchor.end <= mention.start]
    if ahead and ahead[-1].is_scope and re.search(r"(?:^|[,;:.]|\band|\bbut) ?(?:and |but )?$", text[: ahead[-1].start]):
        return ahead[-1].where
    if ahead and not ahead[-1].is_scope and "," not in text[ahead[-1].end : mention.start] and not any(anchor.is_scope for anchor in usable):
        return ahead[-1].where if re.match(r"\s*(?:with|while|and|plus)\b", text[item[0] : item[1]]) else None
    return None


def _closes(text: str, scope: Anchor) -> bool:
    """Whether a scope is the end of its clause, behind a comma, with "only" or for all of it."""
    whole = scope.kind in ("all", "everywhere") and re.fullmatch(r"all (?:the|along).*|throughout|the whole (?:way|time)", text[scope.start : scope.end])
    return re.match(r"(?: only| alone)?(?=[.;]|$)", text[scope.end :]) is not None and (
        whole is not None or re.search(r", (?:and |but )?(?:only |just )?$|, $", text[: scope.start]) is not None
    )


def _loose(text: str, mentions: Sequence[Mention], anchors: Sequence[Anchor]) -> list[Mention]:
    """The mentions that another scope behind them may go on about: "a pin in the first hold; another in the third"."""
    found = [mention for mention in mentions if mention.name == "DetectObjects" and "sonar" in text[slice(*sentence_at(text, mention.start))]]
    found += [mention for mention in mentions if mention.name == "LockHeading" and "swing" in text[max(0, mention.start - 25) : mention.end + 25]]
    for number, anchor in enumerate(anchors):
        if not anchor.is_scope or anchor.denied or anchor.kind == "thither":
            continue
        begin = max((match.end() for match in re.finditer(r"[.;:!?]\s", text[: anchor.start])), default=0)
        end = next((match.start() for match in re.finditer(r"[.;!?](?=\s|$)", text[anchor.end :])), len(text) - anchor.end) + anchor.end
        following = anchors[number + 1] if number + 1 < len(anchors) else None
        pointed = following is not None and following.kind in ("that", "then", "ordinal") and not _NOTHING.match(text[following.end :])
        moved = any(not other.is_scope and begin <= other.start < end for other in anchors)
        behind = [mention for mention in mentions if anchor.end <= mention.start < end]
        before = [mention for mention in mentions if mention.end <= anchor.start]
        near = [mention for mention in before if mention.start >= begin]
        if _NOTHING.match(text[anchor.end : end]):
            continue
        later = any(
            other.is_scope and near and near[-1].end <= other.start < anchor.start and not other.denied and not _JOINT.fullmatch(text[other.end : anchor.start])
            for other in anchors
        )
        if not behind and not pointed and not moved and before and (later or not near):
            found.append(before[-1])
        opens = [other for other in anchors if other.is_scope and begin <= other.start < end]
        ends = opens[0].kind != "except" and (opens[0].start >= end or not text[begin : opens[0].start].strip(" ,")) if opens else False
        if not behind and not moved and ends and len(opens) > 1 and opens[-1] is anchor and near:
            found.extend(near)
    return found


_JOINT = re.compile(r",? ?(?:and|or|as well as|plus)? ?(?:also )?")
"""What stands between two scopes of one phrase."""


def _joined(text: str, scopes: Sequence[Anchor]) -> Where | None:
    """Several scopes of one item, if they are one phrase."""
    for one, other in itertools.pairwise(scopes):
        if not _JOINT.fullmatch(text[one.end : other.start]):
            return None
    units = [anchor.where.units for anchor in scopes if anchor.where and anchor.where.units is not None]
    return Where(frozenset().union(*units)) if len(units) == len(scopes) else None


def _own(text: str, sentence: tuple[int, int], anchors: Sequence[Anchor], row: Row) -> Where | None:
    """A sentence of its own, that names no steps."""
    said = text[slice(*sentence)]
    if any(sentence[0] <= anchor.start < sentence[1] for anchor in anchors) or SOMEWHERE.search(said) or s.UNREAD.search(said) or ":" in said:
        return None
    return EVERYWHERE if row.units and row.units[-1].start < sentence[0] else None
