"""A command before it is put into words, and what its speaker says wrong and puts right in
mid-sentence.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from random import Random

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent
from planner_ft.data.mission.synthetic.numbers import Said, Style
from planner_ft.data.mission.synthetic.parameters import PARAMETERS, draw_task
from planner_ft.data.mission.synthetic.positions import (
    Position,
    draw_coordinate,
    draw_position,
    say_position,
)

PLACE_WEIGHTS = {
    "PerformOrbit": 17,
    "ParallelStructurePass": 13,
    "KeepStation": 10,
    "DriftAudit": 7,
    "HorizontalPanorama": 10,
    "ThermalHotspotLocalizer": 11,
    "FeatureStare": 15,
    "GlareFreeApproach": 13,
    "ThermalTimeLapse": 12,
    "BoatLandingClearanceSweep": 10,
    "SurveyTarget": 17,
    "Transit": 6,
    "BathymetryGridSurvey": 2,
}


@dataclass(frozen=True)
class Scene:
    """One command before it is put into words; `wrong` is what is said and taken back before a
    target is named, by its key.
    """

    intents: tuple[Intent, ...]
    style: Style
    wrong: dict[int, str] = field(default_factory=dict)


def corrected(rng: Random, style: Style, scene: Scene) -> Scene:
    """Now and then something is said wrong first and put right in mid-sentence; the plan holds the
    right one.
    """
    if rng.random() > 0.13:
        return scene
    intents = list(scene.intents)
    index = rng.randrange(len(intents))
    intent = intents[index]
    if rng.random() < 0.25:
        target = intent.target
        if target is not None and target.position is not None:
            wrong = say_position(
                draw_position(rng) if rng.random() < 0.4 else _near(target.position, rng),
                rng,
                style,
            )
            return replace(scene, wrong={target.key: wrong + rng.choice(CORRECTIONS)})
        if (
            target is not None
            and target.must_be_found
            and target.description is not None
            and target.article
        ):
            wrong = f"the {words.adjective(rng, target.noun)} {target.noun or words.noun(rng)}"
            return replace(scene, wrong={target.key: wrong + rng.choice(CORRECTIONS)})
    if rng.random() < 0.25 and intent.title in PLACE_TASKS | {"SurveyTarget"}:
        title = rng.choice(
            [
                title
                for title in PLACE_WEIGHTS
                if title not in (intent.title, "Transit", "BathymetryGridSurvey")
            ]
        )
        intents[index] = replace(intent, instead=draw_task(rng, style, title, intent.target))
        return replace(scene, intents=tuple(intents))
    sayers = {
        item.name: item.say
        for item in PARAMETERS.get(intent.title, ())
        if item.name in intent.said and item.name != "side_id"
    }
    if not sayers:
        return scene
    name = rng.choice(tuple(sayers))
    right, wrong_value = intent.said[name], sayers[name](rng, style)
    if wrong_value.value == right.value:
        return scene
    text = f"{wrong_value.text}{rng.choice(CORRECTIONS)}{right.text}"
    intents[index] = replace(intent, said={**intent.said, name: Said(right.value, text, "")})
    return replace(scene, intents=tuple(intents))


def _near(position: Position, rng: Random) -> Position:
    """The position with one number wrong."""
    x, y = position
    return (x, draw_coordinate(rng)) if rng.random() < 0.5 else (draw_coordinate(rng), y)


CORRECTIONS = (
    ", no, make that ",
    ", no wait, ",
    ", sorry, ",
    ", correction, ",
    " - no, ",
    ", I mean ",
    ", no, scratch that, ",
    ", make it ",
    " no wait make it ",
    ", er, no, ",
    ", or rather ",
    " - sorry, make that ",
    ", wait, no, ",
    ", strike that, ",
    ", no, better ",
    ", hang on, ",
    " ... no, ",
    ", actually ",
    " I mean ",
    " correction ",
    " sorry ",
    ", my mistake, ",
    ", wrong, ",
    ", no no, ",
    ", let's say ",
    " - belay that, ",
    ", disregard, ",
)
