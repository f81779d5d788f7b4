"""Values that nobody said."""

import itertools
import re
from collections.abc import Iterator, Sequence
from typing import Any

from planner_ft.document.structures import structures
from planner_ft.document.warnings.asked import UNKNOWN
from planner_ft.document.warnings.case import LONGER, STEM, Case, Warning, quoted, warning
from planner_ft.facts import (
    SCORING,
    WAYPOINT,
    Evidence,
    Facts,
    Position,
    Span,
    is_number,
    is_place,
    near,
    read,
)
from planner_ft.facts.inputs import read_input
from planner_ft.facts.numbers import read_numbers
from planner_ft.facts.places import is_course, written_positions
from planner_ft.facts.units import unknown_at
from planner_ft.facts.words import edit_distance, missing_words, unknown_words, words
from planner_ft.planning.passes import pass_ends
from planner_ft.planning.shapes import SIZE, SPACING, shape_points
from planner_ft.vocabulary import Entry, Parameter, Vocabulary
from planner_ft.vocabulary.plans import step_skills

EDITS = 2  # edits by which a word of a task prompt may differ from one of the command
ANGLE = re.compile(r"\b(?:arc|through|angle|by|to|of|\w+ing)\W{1,3}$", re.IGNORECASE)
"""Stands before the degrees of a turn: "through 270"."""
BARE = re.compile(r"[-−–]?\d+(?:\.\d+)?")  # a number without a unit


def unread(case: Case) -> Iterator[Warning]:
    """A command that could not be read with certainty."""
    said = case.source.facts
    if said.unread and unknown_words(said.text)[1] < UNKNOWN:
        yield warning("unread-command")


def unsaid(case: Case) -> Iterator[Warning]:
    """Values of tasks that are the model's own, and task prompts that say another value."""
    said = case.source.facts
    timed = any(number.unit == "s" for number in said.numbers("s"))
    for task in case.tasks:
        definition = case.vocabulary.task[task["title"]]
        known, prompt = definition.by_name, read(task["task_prompt"])
        # How far round something the vehicle goes.
        turns = [one for one in known if known[one].unit == "deg" and definition.pattern == "orbit"]
        for name, source in task.get("sources", {}).items():
            if source["kind"] not in ("model", "command") or name not in known:
                continue
            value, parameter = task["parameters"][name], known[name]
            evidence, shown = said.evidence(value, parameter), _shown(value, parameter)
            bare = not timed and parameter.unit == "s" and _has_no_unit(evidence, said)
            bare = bare or (name in turns and _is_no_angle(evidence, said))
            about = {"task": task, "parameter": name, "name": name, "value": shown}
            if source["kind"] == "model":
                if evidence.given is False:
                    yield warning("value-not-said", "unsaid", **about)
            elif _is_rectangle(task, case):
                continue
            elif is_number(value) and _is_coordinate(evidence, said, case.positions):
                yield warning("value-not-said", "coordinate", **about)
            elif is_number(value) and (unit := _unknown_unit(evidence, said, parameter)):
                yield warning("value-not-said", "unknown_unit", **about, words=unit)
            elif bare:
                yield warning("value-not-said", "unit", **about)
            elif _contradicts(prompt, value, parameter):
                words = quoted(task["task_prompt"])
                yield warning("contradiction", "prompt", **about, words=words)


def within_another(case: Case) -> Iterator[Warning]:
    """Values whose words take in those of a number: "thirty ninety eight sectors" is not [30, 98]
    and 8 sectors.
    """
    said, values = case.source.facts, list[tuple[Entry, Parameter, Any, list[Span]]]()
    for task in case.tasks if not said.unread else ():
        for name, parameter in case.vocabulary.task[task["title"]].by_name.items():
            value = task["parameters"].get(name)
            if is_number(value) or is_place(value):
                mentions = said.evidence(value, parameter).mentions
                values.append((task, parameter, value, [*itertools.chain(*mentions)]))
    numbers = [one for one in values if is_number(one[2]) and one[3]]
    for taking, named, wider, spans in values:
        for _task, own, value, parts in numbers if spans else ():
            other = value not in (wider if is_place(wider) else (wider,))
            if other and all(_is_part(part, spans) for part in parts):
                about: dict[str, Any] = {"name": named.name, "value": _shown(wider, named)}
                about["other"] = f"{own.name} {value:g}"
                yield warning("value-not-said", "within", taking, named.name, **about)
                break


def _is_part(span: Span, wider: Sequence[Span]) -> bool:
    return any(one[0] <= span[0] and span[1] <= one[1] and one != span for one in wider)


def said_once(case: Case) -> Iterator[Warning]:
    """A value of a task that has the number of another one of it, which the command says once; the
    sides of a square have one number.
    """
    for task in case.tasks:
        known, given = case.vocabulary.task[task["title"]].by_name, task["parameters"]
        numbers = [one.value for one in case.numbers if not case.is_coordinate(one)]
        measured = [name for name in known if known[name].unit and is_number(given.get(name))]
        for name, other in itertools.combinations(sorted(measured, key=SPACING.__eq__), 2):
            same = known[name].unit == known[other].unit and given[name] == given[other]
            once = sum(near(one, given[name]) for one in numbers) == 1
            if same and once and {name, other} != {*SIZE}:
                value = _shown(given[name], known[name])
                yield warning("value-not-said", "unsaid", task, name, name=name, value=value)


def unsaid_limits(case: Case) -> Iterator[Warning]:
    """Limits with a number or a thing that the command does not say, and that nothing be recorded
    where no words of it rule anything out.
    """
    ruled_out = [case.words["exclusion"], case.words["limit"]]
    ruled_out += [data.said for data in case.spoken.data if data.ruled_out]
    none = not any(words.search(case.command) for words in ruled_out)
    spoken = case.source.facts.text
    places = [(at.start, at.end) for at in written_positions(case.text)]
    apart = (
        one for one in case.numbers if not any(start <= one.start < end for start, end in places)
    )
    said = [number.value for number in apart]
    for limit in case.limits:
        own = [value for value in limit["values"].values() if is_number(value)]
        unsaid = any(not any(near(value, one) for one in said) for value in own)
        unsaid |= limit["kind"] == "distance" and _keeps_away(own, case)
        thing = LONGER.findall(str(limit["values"].get("object", "")).split(" at [")[0])
        unknown = [one for one in thing if missing_words(spoken, one, misspelt=True)]
        unsaid = unsaid or (bool(thing) and unknown == thing)
        if unsaid or (limit["kind"] == "no_recording" and none):
            text = limit["text"].rstrip(".")
            yield warning("value-not-said", "limit", about=text.casefold(), limit=text)


def _keeps_away(values: Sequence[float], case: Case) -> bool:
    """Whether clauses that keep the vehicle away from something, and no others, say a value: "don't
    get within 30 m of him" is no way from home.
    """
    said = [one.start for one in case.numbers if any(near(one.value, value) for value in values)]
    clauses = [clause for place in said if (clause := case.clause_at(place))]
    away = (case.words["away"].search(one.text) for one in clauses)
    return (
        bool(clauses)
        and all(away)
        and not any(case.words["home"].search(clause.text) for clause in clauses)
    )


def unsought(case: Case) -> Iterator[Warning]:
    """Searches for what no task needs, where no word asks for one."""
    places = [one["name"] for one in case.document.get("open_places", ())]
    places = [name.casefold() for name in (*places, *case.document.get("located", {}))]
    for task in () if case.words["sought"].search(case.command) else case.tasks:
        targets = [str(value).casefold() for value in task["parameters"].values()]
        needed = any(name in target or target in name for target in targets for name in places)
        if task["title"] == case.vocabulary.locate and not needed:
            yield warning("value-not-said", "asked", task, about="asked")


def unheard(case: Case) -> Iterator[Warning]:
    """Words of proposed task prompts that are not known, nor in the command or the definition of
    the task: they may name another thing.
    """
    proposed = {own["id"]: own for own in case.document.get("proposed", {"tasks": ()})["tasks"]}
    command, spoken = case.command.casefold(), words(case.command)
    for task in (one for one in case.tasks if one["id"] in proposed):
        unknown = dict.fromkeys(unknown_words(proposed[task["id"]]["task_prompt"])[0])
        purpose, prompt = case.vocabulary.task[task["title"]].description, task["task_prompt"]
        told, said = f"{command} {purpose.casefold()}", [*spoken, *words(purpose)]
        new = (word for word in unknown if word in prompt.casefold())
        made = [word for word in new if not _is_heard(word, told, said)]
        if made:
            listed = ", ".join(f'"{word}"' for word in made)
            yield warning("value-not-said", "word", task, about=" ".join(made), words=listed)


def unmentioned(case: Case) -> Iterator[Warning]:
    """Things that stand in the water or bar a way, named in a clause without a place that asks for
    nothing, of which nothing in the plan speaks.
    """
    names = [one.name for one in structures(case.document, case.vocabulary)]
    objects = [str(limit["values"].get("object", "")) for limit in case.limits]
    known = " ".join([case.plan.words, *names, *objects]).casefold()
    asking = [case.words["verb"], case.spoken.sensors, *(ask.said for ask in case.spoken.asks)]
    for clause in (one for one in case.clauses if not one.corrected):
        spans = [at for kind in ("standing", "bars") for at in clause.spans(case.words[kind])]
        things = [case.text[start:end].casefold() for start, end in spans]
        new = [one for one in things if one[: STEM - 1] not in known]
        new = [one for one in new if not case.words["itself"].fullmatch(one)]
        placed = any(clause.start <= place.start < clause.end for place in case.positions)
        if new and not placed and not any(words.search(clause.text) for words in asking):
            said = quoted(clause.text.strip(" ,;."))
            for thing in new:
                yield warning("thing-not-mentioned", about=thing, name=thing, words=said)


def declined(case: Case) -> Iterator[Warning]:
    """Constraints by which the plan leaves out what no word of the command asks for."""
    small = [case.words["boundary"], case.words["determiner"]]
    spoken = [one for one in words(case.command) if not any(of.fullmatch(one) for of in small)]
    for line in case.document.get("constraints", ()):
        no = case.words["declined"].search(line)
        left = [one for one in words(line[no.end() :]) if LONGER.fullmatch(one)] if no else []
        if left and not any(_akin(one, other) for one in left for other in spoken):
            told = {"about": line.casefold(), "words": line.rstrip(".")}
            yield warning("value-not-said", "declined", **told)


def _akin(word: str, other: str) -> bool:
    """Whether two words begin alike: "jamming" and "jam"."""
    return min(len(word), len(other)) > 2 and word[: STEM - 1].startswith(other[: STEM - 1])


def _is_heard(word: str, told: str, said: list[str]) -> bool:
    """Whether a word stands in a text, in parts or spelt a little otherwise."""
    parts = all(part in told for part in re.split(r"[-'.]", word))
    most = min(EDITS, (len(word) - 1) // 2)
    return parts or any(edit_distance(word, other, EDITS) <= most for other in said)


def _contradicts(prompt: Facts, value: Any, parameter: Parameter) -> bool:
    """Whether a task prompt has another measure or place where the value of its task should be."""
    if is_number(value):
        unit = parameter.unit
        other = any(number.unit == unit is not None for number in prompt.numbers(unit))
    else:
        other = is_place(value) and any(place.certain for place in prompt.positions)
    return other and prompt.evidence(value, parameter, SCORING).given is False


def _is_coordinate(evidence: Evidence, said: Facts, places: Sequence[Position]) -> bool:
    """Whether a number stands in the command as a part of positions and nowhere else."""
    return bool(evidence.mentions) and all(
        BARE.fullmatch(said.text, start, end)
        and any(place.start <= start and end <= place.end for place in places)
        for spans in evidence.mentions
        for start, end in spans
    )


def _is_no_angle(evidence: Evidence, said: Facts) -> bool:
    """Whether a value stands in the command as a number that nothing tells to be an angle."""
    spans = [spans[0] for spans in evidence.mentions]
    led = (ANGLE.search(said.text, 0, start) or is_course(said.text, start) for start, _ in spans)
    return _has_no_unit(evidence, said) and not any(led)


def _has_no_unit(evidence: Evidence, said: Facts) -> bool:
    """Whether a value stands in the command as a number without a unit."""
    spans = [(spans[0][0], spans[-1][1]) for spans in evidence.mentions]
    numbers = [read_numbers(said.text[start:end]) for start, end in spans]
    bare = [bool(found) and all(one.unit is None for one in found) for found in numbers]
    return evidence.kind == "stated" and bool(bare) and all(bare)


def _unknown_unit(evidence: Evidence, said: Facts, parameter: Parameter) -> str | None:
    """What stands like a unit behind the number of a value that has one, and is none."""
    bare = _has_no_unit(evidence, said)
    return unknown_at(said.text, evidence.spans[-1][1], parameter.unit) if bare else None


def worked_out(case: Case) -> Iterator[Warning]:
    """Places that are only worked out: in a plan that lacks a value or a place of its command they
    are hardly meant.
    """
    unknown = list(case.vocabulary.unresolved)
    for task in case.tasks:
        for name, source in task.get("sources", {}).items():
            value = task["parameters"].get(name)
            known = not is_place(value) or "spans" in source or value == unknown
            if source["kind"] == "derived" and not known and not _is_rectangle(task, case):
                about = {"parameter": name, "name": name, "value": value}
                yield warning("value-not-said", "worked_out", task, **about)


def _is_rectangle(task: Entry, case: Case) -> bool:
    """Whether the area of a task is one that the command says by its corners."""
    middle = next(filter(is_place, task["parameters"].values()), None)
    own = middle and (tuple(middle), *(task["parameters"].get(name) for name in SIZE))
    return own in case.source.rectangles


def unsaid_skills(case: Case) -> Iterator[Warning]:
    """One per skill and parameter of a task, unless an operator has changed the value."""
    said, proposed = case.source.facts, case.document.get("proposed", {"tasks": ()})["tasks"]
    before = {task["id"]: task["skill_sequence"] or [] for task in reversed(proposed)}
    for task in (one for one in case.tasks if not one.get("stale")):
        own, points = task["parameters"], list[tuple[float, float]]()
        record = {"prompt": task["task_prompt"], "task": task["title"], "parameters": own}
        known = [value for value in own.values() if isinstance(value, list)]
        shape = [*(pass_ends(task, case.vocabulary) or ()), *shape_points(task, case.vocabulary)]
        known += [list(point) for point in shape]
        warned: set[str] = set()
        for skill, parameter, value in _models(task, before.get(task["id"], []), case.vocabulary):
            key = f"{skill}.{parameter.name}"
            if key in warned or value in known:
                continue
            found = read_input(record, case.vocabulary).evidence(value, parameter, SCORING, points)
            if parameter is WAYPOINT:
                points.append((value[0], value[1]))
            if found.given is False and not said.evidence(value, parameter).given:
                warned.add(key)
                words = {"skill": skill, "name": parameter.name, "value": _shown(value, parameter)}
                made = warning("skill-value-not-said", task=task, about=key, **words)
                yield {**made, "parameter": parameter.name}


Value = tuple[str, Parameter, Any]  # a skill's name, a parameter of it, and its value


def _models(task: Entry, proposed: list[dict[str, Any]], known: Vocabulary) -> Iterator[Value]:
    """The values of a task's skills that the model proposed, in steps that nobody added."""
    added = {(mark["step"], mark["name"]) for mark in task.get("added", ())}
    for number, step in enumerate(task.get("skill_sequence") or ()):
        changed = number < len(proposed) and step != proposed[number]
        models = list(_values(proposed[number], known)) if changed else []
        for entry in _values(step, known):
            if (number, entry[0]) not in added and (not changed or entry in models):
                yield entry


def _values(step: Entry, known: Vocabulary) -> Iterator[Value]:
    """Values of a step's skills with parameters; a destination's coordinates as one."""
    for _role, skill in step_skills(step):
        name, given, motion = skill["name"], skill["parameters"], known.motion.of(skill["name"])
        goes = motion if motion and motion.kind == "go" else None
        pair = [goes.parameters["x"], goes.parameters["y"]] if goes else []
        if pair and all(is_number(given.get(key)) for key in pair):
            yield name, WAYPOINT, [given[key] for key in pair]
        parameters = known.skill[name].by_name
        for key, value in given.items():
            if key not in pair and key in parameters:
                yield name, parameters[key], value


def _shown(value: Any, parameter: Parameter) -> str:
    unit = "" if parameter.unit in (None, "count") else f" {parameter.unit}"
    return f"{value:g}{unit}" if is_number(value) else str(value)[:60]
