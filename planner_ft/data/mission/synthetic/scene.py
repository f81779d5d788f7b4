"""Drawing what one command wants: targets, intents in the order of execution, and what else it speaks of."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from random import Random

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.lexicon import PURPOSES
from planner_ft.data.mission.synthetic.numbers import (
    Said,
    Style,
    say_count,
    say_degrees,
    say_duration,
    say_heading,
    say_interval,
    say_length,
    say_percent,
    say_speed,
)
from planner_ft.data.mission.synthetic.positions import Position, draw_coordinate, draw_position, say_position

Sayer = Callable[[Random, Style], Said]

ARCS = (360, 360, 360, 360, 180, 180, 180, 90, 90, 270, 45, 60, 120, 135, 150, 200, 210, 225, 240, 300)
SCANS = (60, 75, 80, 90, 90, 100, 110, 120, 120, 140, 150, 160, 180, 180, 45, 30, 360)


@dataclass(frozen=True)
class Parameter:
    """A parameter that a command may state, with its share of commands and how it is drawn."""

    name: str
    share: float
    say: Sayer


PARAMETERS: dict[str, tuple[Parameter, ...]] = {
    "PerformOrbit": (
        Parameter("radius", 0.78, lambda rng, style: say_length(rng, style, 4, 80)),
        Parameter("speed", 0.28, say_speed),
        Parameter("arc", 0.46, lambda rng, style: say_degrees(rng, style, ARCS)),
    ),
    "ParallelStructurePass": (
        Parameter("side_id", 0.86, lambda rng, style: _word(words.side(rng))),
        Parameter("length", 0.6, lambda rng, style: say_length(rng, style, 15, 300)),
        Parameter("distance", 0.7, lambda rng, style: say_length(rng, style, 3, 40)),
        Parameter("speed", 0.36, say_speed),
    ),
    "KeepStation": (Parameter("duration", 0.84, say_duration),),
    "DriftAudit": (Parameter("duration", 0.84, say_duration),),
    "HorizontalPanorama": (
        Parameter("sectors", 0.66, say_count),
        Parameter("overlap", 0.42, say_percent),
        Parameter("wait", 0.38, lambda rng, style: say_wait(rng, style)),
    ),
    "ThermalHotspotLocalizer": (Parameter("scan_width_degrees", 0.55, lambda rng, style: say_degrees(rng, style, SCANS)),),
    "FeatureStare": (Parameter("duration", 0.74, lambda rng, style: say_duration(rng, style, brief=True)),),
    "ThermalTimeLapse": (Parameter("duration", 0.86, say_duration), Parameter("interval", 0.78, say_interval)),
    "BathymetryGridSurvey": (Parameter("spacing", 0.68, lambda rng, style: say_length(rng, style, 2, 25)),),
    "SubseaCableTrack": (
        Parameter("heading", 0.74, say_heading),
        Parameter("max_dist", 0.66, lambda rng, style: say_length(rng, style, 100, 950, far=True)),
    ),
    "SurveyTarget": (Parameter("radius", 0.55, lambda rng, style: say_length(rng, style, 4, 60)),),
    "VisualDockingApproach": (Parameter("distance", 0.6, lambda rng, style: say_length(rng, style, 1, 9)),),
}


def say_wait(rng: Random, style: Style) -> Said:
    """A pause of seconds at each heading."""
    while True:
        said = say_duration(rng, style, brief=True)
        if isinstance(said.value, int) and said.value <= 60:
            return said


def _word(word: str) -> Said:
    return Said(word, word, word)


@dataclass(frozen=True)
class Scene:
    """One command before it is put into words; `wrong` is what is said and taken back before a target is named, by its key."""

    intents: tuple[Intent, ...]
    style: Style
    wrong: dict[int, str] = field(default_factory=dict)


PLACE_WEIGHTS = {
    "PerformOrbit": 17, "ParallelStructurePass": 13, "KeepStation": 10, "DriftAudit": 7, "HorizontalPanorama": 10, "ThermalHotspotLocalizer": 11,
    "FeatureStare": 15, "GlareFreeApproach": 13, "ThermalTimeLapse": 12, "BoatLandingClearanceSweep": 10, "SurveyTarget": 17, "Transit": 6,
    "BathymetryGridSurvey": 2,
}  # fmt: skip
POINT_WEIGHTS = {
    "KeepStation": 16, "DriftAudit": 15, "HorizontalPanorama": 16, "ThermalTimeLapse": 5, "ThermalHotspotLocalizer": 5, "SurveyTarget": 8, "PerformOrbit": 7,
    "Transit": 14, "BoatLandingClearanceSweep": 7, "FeatureStare": 5, "GlareFreeApproach": 5, "ParallelStructurePass": 2,
}  # fmt: skip
HERE_WEIGHTS = {
    "KeepStation": 14, "DriftAudit": 14, "HorizontalPanorama": 15, "ThermalHotspotLocalizer": 8, "ThermalTimeLapse": 9, "FeatureStare": 4,
    "GlareFreeApproach": 4,
    "BoatLandingClearanceSweep": 8,
}  # fmt: skip
MOVING_WEIGHTS = {"FollowTarget": 16, "KeepStation": 9, "SurveyTarget": 4, "FeatureStare": 4, "PerformOrbit": 4, "Transit": 1, "ThermalHotspotLocalizer": 1}
STOPS = ("structure", "structure", "located", "located", "point", "moving", "follow", "area", "cable")
STOP_WEIGHTS = (31, 0, 28, 0, 20, 7, 6, 10, 9)


def draw_scene(rng: Random, style: Style) -> Scene:
    """Draw the intents of one command, one to seven of them."""
    wanted = rng.choices((1, 2, 3, 4, 5, 6), (32, 30, 21, 11, 5, 1))[0]
    intents: list[Intent] = []
    if rng.random() < (0.05 if wanted == 1 else 0.15):
        intents.append(Intent("Diagnostics"))
    ending = _ending(rng, style, wanted)
    middle = max(0, wanted - len(ending) - len(intents))
    key = 0
    if middle and rng.random() < 0.11:
        intents += _here(rng, style, min(middle, rng.choice((1, 1, 2))))
        middle = max(0, wanted - len(ending) - len(intents))
    while middle > 0:
        key += 1
        stop = _stop(rng, style, key, middle)
        intents += stop
        middle -= len(stop)
    if len(intents) > 2 and rng.random() < 0.05:
        intents = _revisit(rng, style, intents)
    intents += ending
    if wanted > 2 and rng.random() < 0.06:
        intents.insert(rng.randint(1, len(intents) - 1), rng.choice((Intent("Diagnostics"), Intent("AutoGenerateReportSummary"), _harvest(rng))))
    if rng.random() < 0.035 and not any(intent.target is None and intent.title in PLACE_TASKS for intent in intents):
        intents = _on_site(rng, style, intents)
    intents = _once(intents) or _stop(rng, style, 1, 1)
    return _corrected(rng, style, Scene(tuple(intents), style))


def _on_site(rng: Random, style: Style, intents: list[Intent]) -> list[Intent]:
    """The vehicle lies at a structure already; what is done there comes first and needs neither search nor Transit."""
    target = words.structure(rng, 80, located=rng.random() < 0.3)
    target = replace(target, on_site=True, whereabouts="")
    return [*(_task(rng, style, title, target) for title in _titles(rng, HERE_WEIGHTS, rng.choice((1, 1, 2)))), *intents[-3:]]


def _once(intents: list[Intent]) -> list[Intent]:
    """Checks, reports and uploads happen once; the vehicle goes home once."""
    seen: set[str] = set()
    kept = []
    for intent in intents:
        name = "home" if intent.home else intent.title
        if name in ("Diagnostics", "AutoGenerateReportSummary", "SmartDataHarvest", "home", "DockingApproach", "VisualDockingApproach"):
            if name in seen:
                continue
            seen.add(name)
        kept.append(intent)
    return kept


def _ending(rng: Random, style: Style, wanted: int) -> list[Intent]:
    share = 0.5 if wanted == 1 else 1.0
    ending: list[Intent] = []
    if rng.random() < 0.24 * share:
        ending.append(Intent("AutoGenerateReportSummary"))
    if rng.random() < 0.17 * share:
        ending.insert(rng.randint(0, len(ending)), _harvest(rng))
    roll = rng.random()
    if roll < 0.17 * share:
        ending.append(Intent("Transit", home=True))
    elif roll < 0.29 * share:
        ending.append(Intent("DockingApproach", _dock(rng)))
    elif roll < 0.39 * share:
        mark = words.dock_mark(rng)
        parameters, said = _stated(rng, "VisualDockingApproach", style)
        if rng.random() < 0.96:
            parameters, said = {"target_feature": mark, **parameters}, {"target_feature": _word(mark), **said}
        if rng.random() < 0.42:
            ending.append(Intent("Transit", home=True))
        ending.append(Intent("VisualDockingApproach", None, parameters, said))
    if len(ending) > 1 and rng.random() < 0.1 and ending[-1].title not in ("AutoGenerateReportSummary", "SmartDataHarvest"):
        ending.insert(0, ending.pop())
        ending = ending if ending[0].title != "VisualDockingApproach" else [*ending[1:], ending[0]]
    return ending[: max(1, wanted)] if wanted > 1 else _single(ending)


def _single(ending: list[Intent]) -> list[Intent]:
    return ending if len(ending) < 2 or ending[0].home else ending[:1]


def _dock(rng: Random) -> Target:
    if rng.random() < 0.42:
        return Target(90, None, draw_position(rng), spot=True)
    spot = words.dock_spot(rng)
    return Target(90, spot, draw_position(rng) if rng.random() < 0.15 else None, article=not spot[-1].isdigit() and not spot[-1].isupper(), spot=True)


def _harvest(rng: Random) -> Intent:
    if rng.random() < 0.12:
        return Intent("SmartDataHarvest")
    items = list(dict.fromkeys(words.data_item(rng) for _ in range(rng.choice((1, 1, 2, 2, 2, 3, 3, 4)))))
    return Intent("SmartDataHarvest", None, {"target_list": items})


def _stated(rng: Random, title: str, style: Style) -> tuple[dict[str, object], dict[str, Said]]:
    said = {item.name: item.say(rng, style) for item in PARAMETERS.get(title, ()) if rng.random() < item.share}
    return {name: value.value for name, value in said.items()}, said


def _task(rng: Random, style: Style, title: str, target: Target | None) -> Intent:
    parameters, said = _stated(rng, title, style)
    if title == "FeatureStare":
        name = words.feature(rng)
        parameters, said = {"feature_type": name, **parameters}, {"feature_type": _word(name), **said}
    elif title == "GlareFreeApproach":
        name = words.feature(rng)
        parameters, said = {"target_feature": name}, {"target_feature": _word(name)}
    elif title == "BathymetryGridSurvey" and rng.random() < 0.86:
        width, length = say_length(rng, style, 20, 300), say_length(rng, style, 20, 300)
        parameters, said = {"width": width.value, "length": length.value, **parameters}, {"width": width, "length": length, **said}
    if title == "KeepStation" and target is not None and target.must_be_found and "duration" not in parameters:
        # Staying with something that may move for no stated time would be FollowTarget.
        value = say_duration(rng, style)
        parameters, said = {"duration": value.value}, {"duration": value}
    roll = rng.random()
    purpose = rng.choice(PURPOSES[title]) if roll < 0.05 and title in PURPOSES else ""
    if roll > 0.93 and title in CONFIRMED and target is not None and target.description is not None:
        purpose = rng.choice(CONFIRMS)
    return Intent(title, target, parameters, said, purpose=purpose, part=_part(rng, title, target))


CONFIRMED = frozenset(("SearchAndDetect", "SurveyTarget", "PerformOrbit", "FeatureStare", "ParallelStructurePass"))
CONFIRMS = (
    "and confirm that it is still there", "and confirm whether it is still afloat", "and confirm it is intact", "and see whether it has moved",
    "and check whether it is still upright", "and confirm that it is lit", "and verify that nobody is aboard",
    "and see if it is damaged", "and confirm it has not sunk", "and make sure it has not drifted", "and confirm that nothing is missing",
    "and see if anything hangs from it", "and confirm that it is the right one",
)  # fmt: skip
PARTS = ("{} face", "{} side", "{} wall", "{} end", "hull", "deck", "roof", "waterline", "underside", "stern", "bow", "legs", "foundation",
    "upper half", "machinery space", "engine casing", "top", "base")


def _part(rng: Random, title: str, target: Target | None) -> str:
    """A part of the target that the command speaks of and no parameter holds."""
    if title not in ("SurveyTarget", "ThermalTimeLapse", "ThermalHotspotLocalizer") or target is None or target.description is None or rng.random() > 0.09:
        return ""
    return rng.choice(PARTS).format(words.side(rng)) if rng.random() < 0.7 else words.feature(rng)


def _here(rng: Random, style: Style, count: int) -> list[Intent]:
    return [_task(rng, style, title, None) for title in _titles(rng, HERE_WEIGHTS, count)]


def _titles(rng: Random, weights: dict[str, int], count: int) -> list[str]:
    drawn = rng.choices(tuple(weights), tuple(weights.values()), k=count)
    return list(dict.fromkeys(drawn))


def _stop(rng: Random, style: Style, key: int, room: int) -> list[Intent]:
    """Intents at one target, at most `room`."""
    kind = rng.choices(STOPS, STOP_WEIGHTS)[0]
    count = min(room, rng.choices((1, 2, 3), (58, 32, 10))[0])
    if kind in ("structure", "located", "point") and rng.random() < 0.1:
        return [_several(rng, style, key, kind)]
    if kind == "area":
        return _area(rng, style, key, count)
    if kind == "cable":
        return _cable(rng, style, key, count)
    if kind == "follow":
        position = draw_position(rng) if rng.random() < 0.3 else None
        identity, said_as = words.call_sign(rng)
        return [Intent("FollowTarget", Target(key, None, position, identity=identity, said_as=said_as, movable=True))]
    if kind == "moving":
        target = words.moving_thing(rng, key, located=rng.random() < 0.25)
        return _at_target(rng, style, target, _titles(rng, MOVING_WEIGHTS, min(count, 2)))
    if kind == "point":
        return _at_target(rng, style, Target(key, None, draw_position(rng)), _titles(rng, POINT_WEIGHTS, count))
    target = words.structure(rng, key, located=kind == "located")
    return _at_target(rng, style, replace(target, doubtful=target.position is not None and rng.random() < 0.07), _titles(rng, PLACE_WEIGHTS, count))


SHARED = ("SurveyTarget", "SurveyTarget", "PerformOrbit", "PerformOrbit", "Transit", "KeepStation", "HorizontalPanorama", "ThermalTimeLapse",
    "ThermalHotspotLocalizer", "DriftAudit", "BoatLandingClearanceSweep")


def _several(rng: Random, style: Style, key: int, kind: str) -> Intent:
    """One thing to be done at two or three targets."""
    title = rng.choice(SHARED)
    count = rng.choice((2, 2, 2, 3))
    if kind == "point":
        targets = [Target(key + 20 * index, None, draw_position(rng)) for index in range(count)]
    elif rng.random() < 0.55:
        base = words.noun(rng)
        looks = list(dict.fromkeys(words.adjective(rng) for _ in range(count)))
        targets = [
            Target(key + 20 * index, f"{look} {base}", draw_position(rng) if kind == "located" and rng.random() < 0.8 else None, noun=base,
            said_as=f"{look} one" if index else None)
            for index, look in enumerate(looks)
        ]
    else:
        targets = [replace(words.structure(rng, key + 20 * index, located=kind == "located"), whereabouts="") for index in range(count)]
    if len({target.description for target in targets}) < len(targets) and kind != "point":
        targets = targets[:1]
    return replace(_task(rng, style, title, targets[0]), also=tuple(targets[1:]), part="", purpose="")


def _at_target(rng: Random, style: Style, target: Target, titles: list[str]) -> list[Intent]:
    if "FollowTarget" in titles:
        titles = [title for title in titles if title != "FollowTarget"][:1] + ["FollowTarget"]
    for title in ("Transit", "SurveyTarget", "BathymetryGridSurvey"):
        if title in titles and (title == "Transit" or (title == "BathymetryGridSurvey" and rng.random() < 0.5)):
            titles = [title, *(other for other in titles if other != title)]
    if titles == ["Transit"] and rng.random() < 0.4:
        titles = ["Transit", rng.choice(tuple(POINT_WEIGHTS) if target.description is None else tuple(PLACE_WEIGHTS))]
    if target.position is None and (rng.random() < 0.22 or (len(titles) == 1 and rng.random() < 0.06)):
        titles = ["SearchAndDetect", *titles]
        if rng.random() < 0.2:
            titles = titles[:1]
    elif target.description is not None and rng.random() < 0.02:
        titles = ["SearchAndDetect"]
    if "Transit" in titles and titles.count("Transit") > 1:
        titles = list(dict.fromkeys(titles))
    return [_own(rng, _task(rng, style, title, target)) for title in titles]


def _own(rng: Random, intent: Intent) -> Intent:
    """Now and then the thing itself is the feature that is filmed ("photograph the tide staff at [41, 6]")."""
    target = intent.target
    name = {"FeatureStare": "feature_type", "GlareFreeApproach": "target_feature"}.get(intent.title)
    if name is None or target is None or target.description is None or target.whereabouts or rng.random() > 0.1:
        return intent
    return replace(intent, parameters={**intent.parameters, name: target.description}, said={**intent.said, name: _word(target.description)})


def _area(rng: Random, style: Style, key: int, count: int) -> list[Intent]:
    roll = rng.random()
    if roll < 0.6:
        target = Target(key, None, draw_position(rng), area=True)
    elif roll < 0.8:
        name = rng.choice(AREAS) if rng.random() < 0.8 else f"{words.proper_name(rng)} {rng.choice(('basin', 'channel', 'bank', 'bight', 'reach', 'sound'))}"
        target = Target(key, name, draw_position(rng), area=True)
    else:
        target = replace(words.structure(rng, key, located=rng.random() < 0.3))
    intents = [_task(rng, style, "BathymetryGridSurvey", target)]
    if count > 1 and target.position is not None:
        intents.append(_task(rng, style, rng.choice(("KeepStation", "KeepStation", "HorizontalPanorama", "DriftAudit")), target))
    return intents


AREAS = (
    "turning basin", "harbour basin", "channel", "anchorage", "dredged pocket", "sand bar", "fairway bend", "berth pocket", "river mouth",
    "scour hole", "spoil ground",
    "north basin", "approach channel", "mooring field", "reef edge", "lock approach", "shoal", "outer harbour", "ferry berth", "dump site",
)  # fmt: skip
CABLES = ("export cable", "array cable", "power cable", "telephone cable", "feeder cable", "cable", "subsea cable", "data cable", "fibre cable",
    "inter-array cable", "old telegraph cable")


def _cable(rng: Random, style: Style, key: int, count: int) -> list[Intent]:
    name = rng.choice(CABLES) if rng.random() < 0.9 else f"{words.pseudo_word(rng)} cable"
    if rng.random() < 0.8:
        intents = [_task(rng, style, "SubseaCableTrack", Target(key, name, draw_position(rng), noun="cable"))]
        if count > 1 and rng.random() < 0.5:
            intents.append(_task(rng, style, rng.choice(("KeepStation", "HorizontalPanorama", "DriftAudit")), intents[0].target))
        return intents
    name = f"{name} {words.proper_name(rng)}" if rng.random() < 0.5 else f"{words.proper_name(rng)} {name}"
    return [_task(rng, style, "SubseaCableTrack", Target(key, name, None, noun="cable"))]


def _revisit(rng: Random, style: Style, intents: list[Intent]) -> list[Intent]:
    """A last task back at a target of before."""
    targets = {intent.target.key: intent.target for intent in intents if intent.target is not None and intent.target.identity is None and not intent.target.area}
    last = intents[-1].target
    earlier = [target for target in targets.values() if last is not None and target.key != last.key and target.noun != "cable" and not target.movable]
    if not earlier:
        return intents
    return [*intents, _task(rng, style, rng.choice(("KeepStation", "HorizontalPanorama", "ThermalHotspotLocalizer", "Transit")), rng.choice(earlier))]


def _corrected(rng: Random, style: Style, scene: Scene) -> Scene:
    """Now and then something is said wrong first and put right in mid-sentence; the plan holds the right one."""
    if rng.random() > 0.13:
        return scene
    intents = list(scene.intents)
    index = rng.randrange(len(intents))
    intent = intents[index]
    if rng.random() < 0.25:
        target = intent.target
        if target is not None and target.position is not None:
            wrong = say_position(draw_position(rng) if rng.random() < 0.4 else _near(target.position, rng), rng, style)
            return replace(scene, wrong={target.key: wrong + rng.choice(CORRECTIONS)})
        if target is not None and target.must_be_found and target.description is not None and target.article:
            wrong = f"the {words.adjective(rng)} {target.noun or words.noun(rng)}"
            return replace(scene, wrong={target.key: wrong + rng.choice(CORRECTIONS)})
    if rng.random() < 0.25 and intent.title in PLACE_TASKS | {"SurveyTarget"}:
        title = rng.choice([title for title in PLACE_WEIGHTS if title not in (intent.title, "Transit", "BathymetryGridSurvey")])
        intents[index] = replace(intent, instead=_task(rng, style, title, intent.target))
        return replace(scene, intents=tuple(intents))
    sayers = {item.name: item.say for item in PARAMETERS.get(intent.title, ()) if item.name in intent.said and item.name != "side_id"}
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
    ", no, make that ", ", no wait, ", ", sorry, ", ", correction, ", " - no, ", ", I mean ", ", no, scratch that, ", ", make it ",
    " no wait make it ", ", er, no, ",
    ", or rather ", " - sorry, make that ", ", wait, no, ", ", strike that, ", ", no, better ", ", hang on, ", " ... no, ", ", actually ",
    " I mean ", " correction ", " sorry ",
    ", my mistake, ", ", wrong, ", ", no no, ", ", let's say ", " - belay that, ", ", disregard, ",
)  # fmt: skip
