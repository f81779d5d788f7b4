"""Synthetic mission samples: a scene, its plan by the labelling rules, and a command that says
it.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from random import Random
from typing import Any

from planner_ft.data.mission.synthetic import discourse, extras, frames, lexicon, words
from planner_ft.data.mission.synthetic.clauses import Teller
from planner_ft.data.mission.synthetic.commands_sample import draw_from_templates
from planner_ft.data.mission.synthetic.composed import draw_composed
from planner_ft.data.mission.synthetic.corrections import Scene
from planner_ft.data.mission.synthetic.intents import Intent
from planner_ft.data.mission.synthetic.labeller import Planned, label
from planner_ft.data.mission.synthetic.numbers import Style, draw_style, plainer
from planner_ft.data.mission.synthetic.plan_texts import assumptions, constraints, task_prompt
from planner_ft.data.mission.synthetic.scene import draw_scene
from planner_ft.data.mission.synthetic.surface import Register, finished

Record = dict[str, Any]

COMPOSED_SHARE, TEMPLATE_SHARE = 0.10, 0.78
"""Shares of samples put together for their structure and of those drawn from commands written by
hand; the others are composed of phrases.
"""
EMPTY_SHARE = 0.07
"""Share of composed samples that lead to no task; some of the written ones do too."""
LONG = 7
FORMS = {
    "one-sentence": 28,
    "sentences": 34,
    "numbered": 4,
    "telegram": 4,
    "but-first": 9,
    "after-gerund": 7,
    "last-first": 1,
    "where-first": 12,
    "radio": 4,
    "questions": 5,
}
TWO_NEEDED = frozenset(("but-first", "after-gerund", "last-first", "numbered"))


def sample_missions(seed: int, count: int | None = None) -> Iterator[Record]:
    """Synthetic mission samples, endless when `count` is None; the same seed gives the same
    samples.

    A record is {"id", "family", "prompt", "expected", "tags"}; `family` names the form of the
    discourse.
    """
    numbers = itertools.count() if count is None else range(count)
    for number in numbers:
        yield draw_mission(Random(seed * 1_000_003 + number), f"synthetic-{seed}-{number}")


def draw_mission(rng: Random, name: str) -> Record:
    """One sample drawn from `rng`."""
    style = draw_style(rng)
    roll = rng.random()
    if roll < COMPOSED_SHARE:
        return draw_composed(rng, plainer(rng, style), name)
    if (
        roll < COMPOSED_SHARE + TEMPLATE_SHARE
        and (record := draw_from_templates(rng, plainer(rng, style), name)) is not None
    ):
        return record
    return compose_mission(rng, style, name)


def compose_mission(rng: Random, style: Style, name: str) -> Record:
    """One sample put together from phrases."""
    if rng.random() < EMPTY_SHARE:
        return _empty(rng, style, name)
    scene, plan = _scene(rng, style)
    form = _form(rng, scene)
    register = Register.draw(rng, form)
    teller = Teller(rng, style, spoken=register.spoken)
    teller.wrong = dict(scene.wrong)
    sentences = _sentences(rng, form, teller, scene)
    limits: list[str] = []
    sentences = _with_extras(rng, style, sentences, scene.intents, limits, form)
    expected = {
        "tasks": [
            {
                "title": planned.title,
                "parameters": planned.parameters,
                "task_prompt": task_prompt(planned, rng),
            }
            for planned in plan
        ],
        "assumptions": assumptions(plan),
        "constraints": [*constraints(plan), *limits],
    }
    prompt = finished(_addressed(rng, sentences, form), rng, register, _values(scene))
    return {
        "id": name,
        "family": f"synthetic-{form}",
        "prompt": prompt,
        "expected": expected,
        "tags": [],
    }


def _scene(rng: Random, style: Style) -> tuple[Scene, list[Planned]]:
    """A scene with its plan; long plans are mostly drawn again."""
    while True:
        scene = draw_scene(rng, style)
        plan = label(scene.intents)
        if len(plan) <= LONG or rng.random() < 0.12:
            return scene, plan


def _form(rng: Random, scene: Scene) -> str:
    if any(intent.target is not None and intent.target.on_site for intent in scene.intents):
        return "on-site"
    first = scene.intents[0]
    if len(first.also) == 1 and first.also[0].said_as and rng.random() < 0.5:
        return "pair"
    while True:
        form = rng.choices(tuple(FORMS), tuple(FORMS.values()))[0]
        if len(scene.intents) > 1 or form not in TWO_NEEDED:
            return form


def _sentences(rng: Random, form: str, teller: Teller, scene: Scene) -> list[str]:
    intents = scene.intents
    if form == "radio":
        return discourse.radio(
            teller, intents, words.proper_name(rng) if rng.random() < 0.7 else words.code(rng)
        )
    tell = {
        "one-sentence": discourse.one_sentence,
        "sentences": discourse.several_sentences,
        "numbered": discourse.numbered,
        "telegram": discourse.telegram,
        "but-first": discourse.but_first,
        "after-gerund": discourse.after_gerund,
        "last-first": discourse.last_first,
        "where-first": discourse.where_first,
        "questions": discourse.questions,
        "on-site": discourse.on_site,
        "pair": discourse.pair,
    }[form]
    return tell(teller, intents)


def _with_extras(
    rng: Random,
    style: Style,
    sentences: list[str],
    intents: tuple[Intent, ...],
    limits: list[str],
    form: str,
) -> list[str]:
    """The sentences with what an operator says around an order; constraints for it are added to
    `limits`.
    """
    titles = {intent.title for intent in intents}
    told = list(sentences)
    added = []
    if rng.random() < 0.09:
        drawn = (
            extras.no_thing(rng, titles)
            if rng.random() < 0.35
            else extras.exclusion(rng, titles, home=any(intent.home for intent in intents))
        )
        added += [drawn] if drawn else []
    if rng.random() < 0.08:
        added.append(extras.limit(rng, style))
    if rng.random() < 0.02:
        added.append(extras.impossible(rng))
    if rng.random() < 0.02:
        added.append(extras.left_out(rng, words.description(rng, words.noun(rng))[0]))
    if rng.random() < 0.025:
        added.append(extras.deadline(rng))
    if rng.random() < 0.025:
        added.append(extras.hazard(rng, style))
    for extra in added:
        limits.append(extra.constraint)
        told = _put(rng, told, extra.text)
    if form in ("radio", "telegram", "numbered"):
        return told
    if rng.random() < 0.015:
        told = _put(
            rng, told, rng.choice(frames.QUESTIONS) + ("" if rng.random() < 0.5 else "?"), last=True
        )
    if rng.random() < 0.03:
        talk = [
            sentence.rstrip(".")
            for sentence in rng.sample(lexicon.SMALL_TALK, rng.choice((1, 1, 2)))
        ]
        told = [*talk, *told] if rng.random() < 0.7 else [*told, *talk]
    if rng.random() < 0.03:
        told[0] = rng.choice(frames.PURPOSES).replace("{}", told[0])
    return told


def _addressed(rng: Random, sentences: list[str], form: str) -> list[str]:
    """Now and then a letter with greeting and name, or a numbered entry of a log."""
    roll = rng.random()
    if form == "radio" or roll > 0.025:
        return sentences
    if roll < 0.009:
        number = rng.choice(
            (
                str(rng.randint(1, 999)),
                f"{rng.randint(0, 23):02d}{rng.randint(0, 59):02d}",
                f"{rng.randint(1, 40)}/{rng.randint(1, 12)}",
                f"{rng.randint(0, 23)}:{rng.randint(0, 59):02d}",
            )
        )
        return [rng.choice(frames.HEADINGS).format(n=number, text=sentences[0]), *sentences[1:]]
    greeting, bye = rng.choice(frames.LETTERS)
    names = {"name": words.person(rng), "me": words.person(rng), "bye": rng.choice(frames.BYES)}
    return [f"{greeting.format(**names)}, {sentences[0]}", *sentences[1:], bye.format(**names)]


def _put(rng: Random, sentences: list[str], text: str, *, last: bool = False) -> list[str]:
    """The extra clause at the end, at the start or joined to the last sentence."""
    roll = rng.random()
    if last or roll < 0.66:
        return [*sentences, text]
    if roll < 0.78:
        joint = rng.choice((", and ", "; ", ", but ", " - "))
        return [*sentences[:-1], sentences[-1].rstrip(".?!") + joint + text]
    return [text, *sentences]


def _values(scene: Scene) -> tuple[str, ...]:
    """Text values whose words the command must hold as they are."""
    values: list[str] = []
    for intent in scene.intents:
        values += [value for value in intent.parameters.values() if isinstance(value, str)]
        values += intent.parameters.get("target_list", [])
        if intent.target is not None:
            values += [text for text in (intent.target.description, intent.target.identity) if text]
    return tuple(values)


def _empty(rng: Random, style: Style, name: str) -> Record:
    sentences, reasons, kind = extras.empty_command(rng)
    if kind == "impossible" and rng.random() < 0.15:
        sentences = [
            *(sentence.rstrip(".") for sentence in rng.sample(lexicon.SMALL_TALK, 1)),
            *sentences,
        ]
    register = Register.draw(rng, "sentences")
    prompt = finished(sentences, rng, register, ())
    return {
        "id": name,
        "family": f"synthetic-{kind}",
        "prompt": prompt,
        "expected": {"tasks": [], "assumptions": [], "constraints": reasons},
        "tags": ["rule.empty"],
    }
