"""Clauses: phrases of the phrase file bound to what they stand for, a skill or a movement of
several steps, so that they are drawn as templates are.
"""

from __future__ import annotations

import re
from functools import cache, lru_cache
from random import Random

from planner_ft.data.numbers import duration, pick
from planner_ft.data.task.phrasebook import Phrasebook, phrase_text
from planner_ft.data.task.prompts.binding import XY, Bound, Source, bind
from planner_ft.data.task.values import draw_duration, draw_position
from planner_ft.data.templates.grammar import Argument, Call, Step, TemplateError, all_slots
from planner_ft.data.templates.records import Template
from planner_ft.data.wordlists import joined

PLANS = {
    "waypoints": "",
    "headings": "",
    "square": "Square point=center radius=radius start=corner start=side",
    "lawnmower": "Grid point=center width=width length=length spacing=spacing count=lanes"
    " start=corner axis=axis axis=compass",
    "orbit": "Ring point=center radius=radius count=count start=start turn=turn",
    "line": "Line point=start heading=heading length=length",
    "pass": "{goto} xy=first; {goto} xy=last",
    "sectors": "Sectors count=sectors heading=first / {hold} time=wait",
    "steps": "Turns count=count delta_yaw=delta",
    "home": "Return",
}
"""What a movement of several steps stands for; a slot counts where the phrase has it."""
PAUSE, HOW = 0.45, 0.4
"""Shares of the sectors with a pause at each, and of the shapes with words about their start."""


def _template(book: Phrasebook, phrase: str, plan: str, ing: bool) -> Template:
    where = f"vocabulary {book.vocabulary.source}: phrase {phrase!r}"
    return Template("", "train", phrase_text(phrase, ing=ing), plan, where)


def _slots(template: Template) -> list[str]:
    return list(dict.fromkeys(slot.key for slot in all_slots(template.nodes) if not slot.sign))


@cache
def skill_clause(book: Phrasebook, name: str, phrase: str, ing: bool) -> Bound:
    """The phrase for this skill."""
    entry, template = book.skills[name], _template(book, phrase, "", ing)
    skill, bound = entry.skill, Bound(template, clause=True)
    for key in _slots(template):
        draw = draw_position if key == XY else entry.draws[key]
        several = key != XY and skill.by_name[key].type == "texts"
        bound.sources[key] = Source(draw, f"{name}.{key}", several)
        bound.often[key] = entry.often.get(key, 1.0)
    call = Call(name, tuple(Argument("slot", key, key) for key in bound.sources))
    if skill.role == "navigation":
        bound.steps = [Step(call)]
    elif skill.role == "filter":
        bound.everywhere = Step(call, filters=(call,))
    else:
        bound.everywhere = Step(call, perceptions=(call,))
    return bound


@cache
def lead_clause(book: Phrasebook, title: str, phrase: str, ing: bool) -> Bound:
    """A hold in the task's own words ("search for the barge"), with the skill that it asks for."""
    entry, template = book.tasks[title], _template(book, phrase, "", ing)
    bound, skill = Bound(template, clause=True), entry.lead_skill
    bound.sources = {key: Source(entry.draws[key], f"lead.{key}") for key in _slots(template)}
    if skill:
        call = Call(skill["skill"], (Argument("slot", skill["from"], skill["parameter"]),))
        bound.everywhere = Step(call, perceptions=(call,))
    return bound


@lru_cache(maxsize=4096)
def pattern_clause(
    book: Phrasebook, title: str, pattern: str, phrase: str, plan: str, ing: bool
) -> Bound | None:
    """The phrase for a movement of several steps; None where task or vehicle lack what it needs."""
    template = _template(book, phrase, plan, ing)
    try:
        bound = bind(template, book.vocabulary.task[title], book)
    except TemplateError:
        return None
    bound.clause = True
    for key, source in bound.sources.items():
        draw = source.draw
        if key == "wait":
            draw = lambda rng: duration(draw_duration(rng, 2, 60), rng)  # noqa: E731
        bound.sources[key] = Source(draw, f"{pattern}.{key}")
    return bound


def pattern_phrase(book: Phrasebook, title: str, pattern: str, rng: Random) -> tuple[str, str]:
    """A phrase for a movement of several steps, and its plan; empty where there is none."""
    phrases, config = book.pattern(pattern, title), book.patterns.get(pattern, {})
    try:
        phrase, plan = pick(phrases, rng), PLANS[pattern].format_map(book.motions)
    except (IndexError, KeyError):
        return "", ""
    how, pause = config.get("how"), config.get("pause")
    phrase = phrase.replace("{how}", pick(how, rng) if how and rng.random() < HOW else "")
    if pause and pattern == "sectors" and rng.random() < PAUSE:
        phrase += pick(pause, rng)
    elif pattern == "sectors":
        plan = plan.partition(" / ")[0]
    if pattern == "waypoints":
        keys = [f"P{number}" for number in range(1, 3 + int(rng.random() ** 1.6 * 5))]
        said = [f"{{{key} num}}" for key in keys]
        joint = pick((" and ", ", ", " and then ", ", and then "), rng)
        phrase = phrase.replace("{points}", joined(said, joint))
        phrase = phrase.replace("{first}", said[0]).replace("{rest}", joined(said[1:], joint))
        plan = "; ".join(f"{book.motions['goto']} xy={key}" for key in keys)
    elif pattern == "headings":
        turn, form = book.motions["turn_to"], "num" if rng.random() < 0.6 else "way"
        keys = [f"heading{number}" for number in range(1, 1 + pick((2, 3, 4, 4, 5, 6), rng))]
        said = [f"{{{key} {form}}}" for key in keys]
        phrase = phrase.replace("{headings}", joined(said, pick((" and ", " and then "), rng)))
        name = book.skills[turn].skill.parameters[0].name
        plan = "; ".join(f"{turn} {name}={key}" for key in keys)
    # Of the arguments "name=slot", those whose slot the phrase has.
    words = ((word, word.rstrip(";").partition("=")[2]) for word in plan.split(" "))
    held = (word for word, key in words if not key or re.search(rf"{{{key}\b", phrase))
    return phrase, " ".join(held)
