"""Clauses: phrases of the phrase file bound to what they stand for, a skill or a movement of
several steps (words.toml), so that they are drawn as templates are.

`number` tells the slots of the clauses of one prompt apart.
"""

from __future__ import annotations

import re
import tomllib
from collections.abc import Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from planner_ft.data.task.phrasebook import Phrasebook, phrase_text
from planner_ft.data.task.prompts.binding import XY, Bound, Source, bind
from planner_ft.data.task.values import draw_position
from planner_ft.data.templates.grammar import Argument, Call, Step, TemplateError, all_slots
from planner_ft.data.templates.records import Template

WORDS: dict[str, Any] = tomllib.loads(Path(__file__).with_name("words.toml").read_text("utf-8"))
_SLOT = re.compile(r"(?<=[{=?])[A-Za-z]\w*")


def _template(book: Phrasebook, text: str, plan: str, number: int) -> tuple[Template, list[Any]]:
    """A phrase as a template, and its slots, each with what it is called in the phrase."""
    where, end = f"vocabulary {book.vocabulary.source}: phrase {text!r}", str(number or "")
    text, plan = (_SLOT.sub(rf"\g<0>{end}", source) for source in (text, plan))
    template = Template("", "train", text, plan, where)
    keys = dict.fromkeys(slot.key for slot in all_slots(template.nodes) if not slot.sign)
    return template, [(key, key.removesuffix(end)) for key in keys]


@cache
def skill_clause(book: Phrasebook, name: str, phrase: str, ing: bool, number: int = 0) -> Bound:
    """The phrase for this skill."""
    entry = book.skills[name]
    template, slots = _template(book, phrase_text(phrase, ing=ing), "", number)
    bound = Bound(template, nodes=template.nodes, clause=True)
    for key, own in slots:
        draw = draw_position if own == XY else entry.draws[own]
        several = own != XY and entry.skill.by_name[own].type == "texts"
        bound.sources[key] = Source(draw, f"{name}.{own}", several)
        bound.often[key] = entry.often.get(own, 1.0)
    bound.steps = [Step(Call(name, tuple(Argument("slot", key, own) for key, own in slots)))]
    return bound


@cache
def lead_clause(book: Phrasebook, title: str, phrase: str, ing: bool) -> Bound:
    """The task in its own words ("search for the barge"), with the skill that it asks for."""
    entry = book.tasks[title]
    template, slots = _template(book, phrase_text(phrase, ing=ing), "", 0)
    bound = Bound(template, nodes=template.nodes, clause=True)
    bound.sources = {key: Source(entry.draws[key], f"lead.{key}") for key, _own in slots}
    if skill := entry.lead_skill:
        argument = Argument("slot", skill["from"], skill["parameter"])
        bound.steps = [Step(Call(skill["skill"], (argument,)))]
    return bound


@lru_cache(maxsize=4096)
def pattern_clause(
    book: Phrasebook, title: str, pattern: str, phrase: str, ing: bool, number: int = 0
) -> Bound | None:
    """The phrase for a movement of several steps; None where task or vehicle lack what it needs."""
    how = book.patterns.get(pattern, {}).get("how", ())
    parts = {**WORDS["parts"].get(pattern, {}), "how": ("", _one_of(how))}
    for name, texts in parts.items():
        phrase = phrase.replace(f"{{{name}}}", _one_of(texts))
    text = phrase_text(phrase, ing=ing)
    try:
        plan = WORDS["plans"][pattern].format_map(book.motions)
        steps, _slash, _each = plan.partition(" / ")
        plan = plan if "{wait" in text else steps
        # Of the arguments "name=slot", those whose slot the phrase has.
        words = ((word, word.rstrip(";").partition("=")[2]) for word in plan.split(" "))
        held = (word for word, key in words if not key or re.search(rf"{{{key}\b", text))
        template, slots = _template(book, text, " ".join(held), number)
        bound = bind(template, book.vocabulary.task[title], book)
    except (KeyError, TemplateError):
        return None
    bound.clause = True
    for key, own in slots:
        bound.sources[key] = bound.sources[key]._replace(place=f"{pattern}.{own}")
    return bound


def _one_of(texts: Sequence[str]) -> str:
    return f"({'|'.join(texts)})" if len(texts) > 1 else "".join(texts)
