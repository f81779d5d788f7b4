"""The tags of the curated mission set, one per labelling rule, and the audit of what the set
covers.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import plan_names

Records = Sequence[Mapping[str, Any]]

TAGS: dict[str, str] = {
    "rule.order": "the command names tasks in another order than that of execution",
    "rule.search": "a described or named target without coordinates is searched first",
    "rule.no-search-coordinates": "a target with coordinates is not searched",
    "rule.search-on-request": "a search because the command asks to look for something",
    "rule.one-search": "a later task on the same target, or on a part of it, does not search again",
    "rule.no-search-exempt": (
        "no search for an id, a docking spot, a camera mark, or what lies where the vehicle is"
    ),
    "rule.transit": "a task performed at a known place is preceded by a transit to it",
    "rule.transit-unresolved": "after a search, the transit goes to the unresolved location",
    "rule.no-transit": "no transit: no place is named, or the vehicle is there already",
    "rule.self-going": "a task that goes to its place by itself has no transit",
    "rule.explicit-go": "a transit before a self-going task because the command says to go there",
    "rule.return": "returning home is a last transit to the origin",
    "rule.dock": "docking at a spot by position",
    "rule.visual-dock": "docking guided by the camera or a visual mark",
    "rule.diagnostics": "a check that the command asks for",
    "rule.report": "a report that the command asks for",
    "rule.question-only": "a question or a wish for confirmation is no report",
    "rule.harvest": "data to upload or send",
    "rule.exclusion": "what the command rules out is not planned",
    "rule.correction": "what the command corrects is planned as corrected",
    "rule.hold-for-sensor": "holding still that only serves a sensor is no task of its own",
    "rule.empty": "the command asks for nothing that the vocabulary can do",
    "param.units": "a value is converted to metres, seconds or metres per second",
    "param.number-words": "a number is written in words",
    "param.bearing": "a compass direction becomes degrees",
    "param.spelling": "a misspelt text value is put right",
    "param.description": (
        "a target description keeps adjectives and 'with ...' phrases and drops the rest"
    ),
    "param.feature": "a part stands in the parameter made for it",
    "param.side": "a side is one bare word",
    "param.ellipsis": "an ellipsis ('the other one') is written out",
    "param.standoff-radius": "a stand-off is the radius of an orbit or a survey",
    "param.standoff-distance": "a stand-off is the distance of a pass or a visual docking",
    "param.arc": "an angle, a full circle or a part of one is the arc of an orbit",
    "param.no-arc": "a bare circle or orbit has no arc",
    "param.width-length": (
        "the first number of an area is its width, unless the command says which is which"
    ),
    "param.overlap": "an overlap in percent",
    "param.follow-id": "a number, id or call sign to follow",
    "param.follow-target": "a target to follow that was searched",
    "param.follow-or-keep": (
        "staying with something: for a stated time it is holding a place, else following"
    ),
    "param.area-leaves": "an area survey or a track does not end at its centre or start",
    "param.doubtful-position": "a position said with doubt still counts",
    "param.list-order": "what is to be sent stands in the order of urgency",
    "param.nothing-stated": "the command leaves parameters open, and so does the plan",
    "which.thermal-time-lapse": "thermal readings over a time",
    "which.hotspot": "the hottest spot",
    "which.feature-stare": "steady footage of one feature",
    "which.panorama": "imagery all round from one place",
    "which.glare": "glare or reflections avoided",
    "which.bathymetry": "depth over an area",
    "which.orbit": "a round at a stand-off, a full circle or an arc",
    "which.pass": "a run along a side, face or wall",
    "which.survey": "an inspection of a structure, or any survey with a distance",
    "which.follow": "staying with something that moves",
    "which.keep": "holding a place, no sensor named",
}
"""Tag to what a command with it exercises. `which.*` are the rows of the table that says which task
a wording means.
"""

TASKS_OF_TAG: dict[str, tuple[str, ...]] = {
    "rule.search": ("SearchAndDetect",),
    "rule.search-on-request": ("SearchAndDetect",),
    "rule.one-search": ("SearchAndDetect",),
    "rule.transit": ("Transit",),
    "rule.transit-unresolved": ("Transit",),
    "rule.explicit-go": ("Transit",),
    "rule.dock": ("DockingApproach",),
    "rule.visual-dock": ("VisualDockingApproach",),
    "rule.diagnostics": ("Diagnostics",),
    "rule.report": ("AutoGenerateReportSummary",),
    "rule.harvest": ("SmartDataHarvest",),
    "param.side": ("ParallelStructurePass",),
    "param.standoff-radius": ("PerformOrbit", "SurveyTarget"),
    "param.standoff-distance": ("ParallelStructurePass", "VisualDockingApproach"),
    "param.arc": ("PerformOrbit",),
    "param.no-arc": ("PerformOrbit",),
    "param.width-length": ("BathymetryGridSurvey",),
    "param.overlap": ("HorizontalPanorama",),
    "param.follow-id": ("FollowTarget",),
    "param.follow-target": ("FollowTarget",),
    "param.follow-or-keep": ("FollowTarget", "KeepStation"),
    "param.area-leaves": ("BathymetryGridSurvey", "SubseaCableTrack"),
    "param.list-order": ("SmartDataHarvest",),
    "which.thermal-time-lapse": ("ThermalTimeLapse",),
    "which.hotspot": ("ThermalHotspotLocalizer",),
    "which.feature-stare": ("FeatureStare",),
    "which.panorama": ("HorizontalPanorama",),
    "which.glare": ("GlareFreeApproach",),
    "which.bathymetry": ("BathymetryGridSurvey",),
    "which.orbit": ("PerformOrbit",),
    "which.pass": ("ParallelStructurePass",),
    "which.survey": ("SurveyTarget",),
    "which.follow": ("FollowTarget",),
    "which.keep": ("KeepStation",),
}
"""A record with the tag has one of these tasks."""

ALWAYS_TAGGED: dict[str, str] = {
    "DockingApproach": "rule.dock",
    "VisualDockingApproach": "rule.visual-dock",
    "Diagnostics": "rule.diagnostics",
    "AutoGenerateReportSummary": "rule.report",
    "SmartDataHarvest": "rule.harvest",
    **{titles[0]: tag for tag, titles in TASKS_OF_TAG.items() if tag.startswith("which.")},
}
"""A record with the task has this tag."""


@dataclass(frozen=True)
class Coverage:
    """What a curated set must hold: samples per split, and how often a title and a `which.*` tag
    occur at least.
    """

    counts: tuple[tuple[str, int], ...] = (("train", 125), ("validation", 25), ("test", 25))
    titles: tuple[tuple[str, int], ...] = (("train", 8), ("validation", 1), ("test", 1))
    which: int = 1


def tag_problems(record: Mapping[str, Any], vocabulary: Vocabulary) -> Iterator[str]:
    """Unknown tags, and tags that do not agree with the tasks of the expected plan.

    The tags were made for the surface vehicle: what one says of tasks that another vehicle lacks is
    not asked of it.
    """
    tags = record.get("tags", [])
    titles = set(plan_names("mission", record.get("expected")))
    for tag in tags:
        if tag not in TAGS:
            yield f"tag {tag!r} is not known"
        elif (
            needed := set(TASKS_OF_TAG.get(tag, ())) & set(vocabulary.task)
        ) and not titles & needed:
            yield f"tag {tag} needs {' or '.join(TASKS_OF_TAG[tag])} in the plan"
    if len(set(tags)) != len(tags):
        yield "a tag stands twice"
    yield from (
        f"{title} is in the plan, but the tag {tag} is not"
        for title, tag in ALWAYS_TAGGED.items()
        if title in titles and tag not in tags
    )
    if ("rule.empty" in tags) != (not titles):
        yield "the tag rule.empty and an empty task list go together"


def coverage_problems(
    splits: Mapping[str, Records], vocabulary: Vocabulary, coverage: Coverage | None = None
) -> list[str]:
    """What a curated mission set lacks: counts, titles and `which.*` tags per split, families and
    ids that cross splits.
    """
    coverage = coverage or Coverage()
    problems = [
        f"{split}: {len(splits[split])} records, {count} are expected"
        for split, count in coverage.counts
        if len(splits[split]) != count
    ]
    for split, least in coverage.titles:
        found = Counter(
            name for record in splits[split] for name in plan_names("mission", record["expected"])
        )
        problems += [
            f"{split}: {task.title} occurs {found[task.title]} times, {least} are needed"
            for task in vocabulary.tasks
            if found[task.title] < least
        ]
    for split, records in splits.items():
        tags = Counter(tag for record in records for tag in record.get("tags", []))
        problems += [
            f"{split}: no record has the tag {tag}"
            for tag in TAGS
            if tag.startswith("which.") and tags[tag] < coverage.which
        ]
    return problems + _crossing(splits, "family") + _crossing(splits, "prompt")


def _crossing(splits: Mapping[str, Records], key: str) -> list[str]:
    homes: dict[str, str] = {}
    problems = []
    for split, records in splits.items():
        for value in dict.fromkeys(str(record[key]) for record in records):
            if value in homes:
                problems.append(f"{key} {value!r} is in {homes[value]} and in {split}")
            homes.setdefault(value, split)
    return problems
