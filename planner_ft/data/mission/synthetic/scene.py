"""Drawing what one command wants: targets, intents in the order of execution, and what else it
speaks of.
"""

from __future__ import annotations

from dataclasses import replace
from random import Random

from planner_ft.data.mission.synthetic import words
from planner_ft.data.mission.synthetic.corrections import PLACE_WEIGHTS, Scene, corrected
from planner_ft.data.mission.synthetic.intents import PLACE_TASKS, Intent, Target
from planner_ft.data.mission.synthetic.numbers import Style
from planner_ft.data.mission.synthetic.parameters import as_said, draw_task, stated
from planner_ft.data.mission.synthetic.positions import draw_position

POINT_WEIGHTS = {
    "KeepStation": 16,
    "DriftAudit": 15,
    "HorizontalPanorama": 16,
    "ThermalTimeLapse": 5,
    "ThermalHotspotLocalizer": 5,
    "SurveyTarget": 8,
    "PerformOrbit": 7,
    "Transit": 14,
    "BoatLandingClearanceSweep": 7,
    "FeatureStare": 5,
    "GlareFreeApproach": 5,
    "ParallelStructurePass": 2,
}
HERE_WEIGHTS = {
    "KeepStation": 14,
    "DriftAudit": 14,
    "HorizontalPanorama": 15,
    "ThermalHotspotLocalizer": 8,
    "ThermalTimeLapse": 9,
    "FeatureStare": 4,
    "GlareFreeApproach": 4,
    "BoatLandingClearanceSweep": 8,
}
MOVING_WEIGHTS = {
    "FollowTarget": 16,
    "KeepStation": 9,
    "SurveyTarget": 4,
    "FeatureStare": 4,
    "PerformOrbit": 4,
    "Transit": 1,
    "ThermalHotspotLocalizer": 1,
}
STOPS = (
    "structure",
    "structure",
    "located",
    "located",
    "point",
    "moving",
    "follow",
    "area",
    "cable",
)
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
        intents.insert(
            rng.randint(1, len(intents) - 1),
            rng.choice((Intent("Diagnostics"), Intent("AutoGenerateReportSummary"), _harvest(rng))),
        )
    if rng.random() < 0.035 and not any(
        intent.target is None and intent.title in PLACE_TASKS for intent in intents
    ):
        intents = _on_site(rng, style, intents)
    intents = _once(intents) or _stop(rng, style, 1, 1)
    return corrected(rng, style, Scene(tuple(intents), style))


def _on_site(rng: Random, style: Style, intents: list[Intent]) -> list[Intent]:
    """The vehicle lies at a structure already; what is done there comes first and needs neither
    search nor Transit.
    """
    target = words.structure(rng, 80, located=rng.random() < 0.3)
    target = replace(target, on_site=True, whereabouts="")
    return [
        *(
            draw_task(rng, style, title, target)
            for title in _titles(rng, HERE_WEIGHTS, rng.choice((1, 1, 2)))
        ),
        *intents[-3:],
    ]


def _once(intents: list[Intent]) -> list[Intent]:
    """Checks, reports and uploads happen once; the vehicle goes home once."""
    seen: set[str] = set()
    kept = []
    for intent in intents:
        name = "home" if intent.home else intent.title
        if name in (
            "Diagnostics",
            "AutoGenerateReportSummary",
            "SmartDataHarvest",
            "home",
            "DockingApproach",
            "VisualDockingApproach",
        ):
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
        parameters, said = stated(rng, "VisualDockingApproach", style)
        if rng.random() < 0.96:
            parameters, said = (
                {"target_feature": mark, **parameters},
                {"target_feature": as_said(mark), **said},
            )
        if rng.random() < 0.42:
            ending.append(Intent("Transit", home=True))
        ending.append(Intent("VisualDockingApproach", None, parameters, said))
    if (
        len(ending) > 1
        and rng.random() < 0.1
        and ending[-1].title not in ("AutoGenerateReportSummary", "SmartDataHarvest")
    ):
        ending.insert(0, ending.pop())
        ending = ending if ending[0].title != "VisualDockingApproach" else [*ending[1:], ending[0]]
    return ending[: max(1, wanted)] if wanted > 1 else _single(ending)


def _single(ending: list[Intent]) -> list[Intent]:
    return ending if len(ending) < 2 or ending[0].home else ending[:1]


def _dock(rng: Random) -> Target:
    if rng.random() < 0.42:
        return Target(90, None, draw_position(rng), spot=True)
    spot = words.dock_spot(rng)
    return Target(
        90,
        spot,
        draw_position(rng) if rng.random() < 0.15 else None,
        article=not spot[-1].isdigit() and not spot[-1].isupper(),
        spot=True,
    )


def _harvest(rng: Random) -> Intent:
    if rng.random() < 0.12:
        return Intent("SmartDataHarvest")
    items = list(
        dict.fromkeys(words.data_item(rng) for _ in range(rng.choice((1, 1, 2, 2, 2, 3, 3, 4))))
    )
    return Intent("SmartDataHarvest", None, {"target_list": items})


def _here(rng: Random, style: Style, count: int) -> list[Intent]:
    return [draw_task(rng, style, title, None) for title in _titles(rng, HERE_WEIGHTS, count)]


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
        return [
            Intent(
                "FollowTarget",
                Target(key, None, position, identity=identity, said_as=said_as, movable=True),
            )
        ]
    if kind == "moving":
        target = words.moving_thing(rng, key, located=rng.random() < 0.25)
        return _at_target(rng, style, target, _titles(rng, MOVING_WEIGHTS, min(count, 2)))
    if kind == "point":
        return _at_target(
            rng, style, Target(key, None, draw_position(rng)), _titles(rng, POINT_WEIGHTS, count)
        )
    target = words.structure(rng, key, located=kind == "located")
    return _at_target(
        rng,
        style,
        replace(target, doubtful=target.position is not None and rng.random() < 0.07),
        _titles(rng, PLACE_WEIGHTS, count),
    )


SHARED = (
    "SurveyTarget",
    "SurveyTarget",
    "PerformOrbit",
    "PerformOrbit",
    "Transit",
    "KeepStation",
    "HorizontalPanorama",
    "ThermalTimeLapse",
    "ThermalHotspotLocalizer",
    "DriftAudit",
    "BoatLandingClearanceSweep",
)


def _several(rng: Random, style: Style, key: int, kind: str) -> Intent:
    """One thing to be done at two or three targets."""
    title = rng.choice(SHARED)
    count = rng.choice((2, 2, 2, 3))
    if kind == "point":
        targets = [Target(key + 20 * index, None, draw_position(rng)) for index in range(count)]
    elif rng.random() < 0.55:
        base = words.noun(rng)
        looks = list(dict.fromkeys(words.adjective(rng, base) for _ in range(count)))
        targets = [
            Target(
                key + 20 * index,
                f"{look} {base}",
                draw_position(rng) if kind == "located" and rng.random() < 0.8 else None,
                noun=base,
                said_as=f"{look} one" if index else None,
            )
            for index, look in enumerate(looks)
        ]
    else:
        targets = [
            replace(
                words.structure(rng, key + 20 * index, located=kind == "located"), whereabouts=""
            )
            for index in range(count)
        ]
    if len({target.description for target in targets}) < len(targets) and kind != "point":
        targets = targets[:1]
    return replace(
        draw_task(rng, style, title, targets[0]), also=tuple(targets[1:]), part="", purpose=""
    )


def _at_target(rng: Random, style: Style, target: Target, titles: list[str]) -> list[Intent]:
    if "FollowTarget" in titles:
        titles = [*[title for title in titles if title != "FollowTarget"][:1], "FollowTarget"]
    for title in ("Transit", "SurveyTarget", "BathymetryGridSurvey"):
        if title in titles and (
            title == "Transit" or (title == "BathymetryGridSurvey" and rng.random() < 0.5)
        ):
            titles = [title, *(other for other in titles if other != title)]
    if titles == ["Transit"] and rng.random() < 0.4:
        titles = [
            "Transit",
            rng.choice(
                tuple(POINT_WEIGHTS) if target.description is None else tuple(PLACE_WEIGHTS)
            ),
        ]
    if target.position is None and (
        rng.random() < 0.22 or (len(titles) == 1 and rng.random() < 0.06)
    ):
        titles = ["SearchAndDetect", *titles]
        if rng.random() < 0.2:
            titles = titles[:1]
    elif target.description is not None and rng.random() < 0.02:
        titles = ["SearchAndDetect"]
    if "Transit" in titles and titles.count("Transit") > 1:
        titles = list(dict.fromkeys(titles))
    return [_own(rng, draw_task(rng, style, title, target)) for title in titles]


def _own(rng: Random, intent: Intent) -> Intent:
    """Now and then the thing itself is the feature that is filmed ("photograph the tide staff at
    [41, 6]").
    """
    target = intent.target
    name = {"FeatureStare": "feature_type", "GlareFreeApproach": "target_feature"}.get(intent.title)
    if (
        name is None
        or target is None
        or target.description is None
        or target.whereabouts
        or rng.random() > 0.1
    ):
        return intent
    return replace(
        intent,
        parameters={**intent.parameters, name: target.description},
        said={**intent.said, name: as_said(target.description)},
    )


def _area(rng: Random, style: Style, key: int, count: int) -> list[Intent]:
    roll = rng.random()
    if roll < 0.6:
        target = Target(key, None, draw_position(rng), area=True)
    elif roll < 0.8:
        name = (
            rng.choice(AREAS)
            if rng.random() < 0.8
            else (
                f"{words.proper_name(rng)}"
                f" {rng.choice(('basin', 'channel', 'bank', 'bight', 'reach', 'sound'))}"
            )
        )
        target = Target(key, name, draw_position(rng), area=True)
    else:
        target = replace(words.structure(rng, key, located=rng.random() < 0.3))
    intents = [draw_task(rng, style, "BathymetryGridSurvey", target)]
    if count > 1 and target.position is not None:
        intents.append(
            draw_task(
                rng,
                style,
                rng.choice(("KeepStation", "KeepStation", "HorizontalPanorama", "DriftAudit")),
                target,
            )
        )
    return intents


AREAS = (
    "turning basin",
    "harbour basin",
    "channel",
    "anchorage",
    "dredged pocket",
    "sand bar",
    "fairway bend",
    "berth pocket",
    "river mouth",
    "scour hole",
    "spoil ground",
    "north basin",
    "approach channel",
    "mooring field",
    "reef edge",
    "lock approach",
    "shoal",
    "outer harbour",
    "ferry berth",
    "dump site",
)
CABLES = (
    "export cable",
    "array cable",
    "power cable",
    "telephone cable",
    "feeder cable",
    "cable",
    "subsea cable",
    "data cable",
    "fibre cable",
    "inter-array cable",
    "old telegraph cable",
)


def _cable(rng: Random, style: Style, key: int, count: int) -> list[Intent]:
    name = rng.choice(CABLES) if rng.random() < 0.9 else f"{words.place_name(rng)} cable"
    if rng.random() < 0.8:
        intents = [
            draw_task(
                rng, style, "SubseaCableTrack", Target(key, name, draw_position(rng), noun="cable")
            )
        ]
        if count > 1 and rng.random() < 0.5:
            intents.append(
                draw_task(
                    rng,
                    style,
                    rng.choice(("KeepStation", "HorizontalPanorama", "DriftAudit")),
                    intents[0].target,
                )
            )
        return intents
    name = (
        f"{name} {words.proper_name(rng)}"
        if rng.random() < 0.5
        else f"{words.proper_name(rng)} {name}"
    )
    return [draw_task(rng, style, "SubseaCableTrack", Target(key, name, None, noun="cable"))]


def _revisit(rng: Random, style: Style, intents: list[Intent]) -> list[Intent]:
    """A last task back at a target of before."""
    targets = {
        intent.target.key: intent.target
        for intent in intents
        if intent.target is not None and intent.target.identity is None and not intent.target.area
    }
    last = intents[-1].target
    earlier = [
        target
        for target in targets.values()
        if last is not None
        and target.key != last.key
        and target.noun != "cable"
        and not target.movable
    ]
    if not earlier:
        return intents
    return [
        *intents,
        draw_task(
            rng,
            style,
            rng.choice(("KeepStation", "HorizontalPanorama", "ThermalHotspotLocalizer", "Transit")),
            rng.choice(earlier),
        ),
    ]
