"""The phrase bank compiled: each phrase with its slots, ready to be filled."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache, cached_property

from planner_ft.data.mission.synthetic.bank import BANK

HELD = {
    "ThermalTimeLapse": (
        "hold at {target} for {duration} taking thermal readings every {interval}",
        "stay {duration} at {target} taking a thermal reading every {interval}",
        "hold position by {target} for {duration} while you log thermal readings",
        "keep station at {target} for {duration} while the thermal camera takes a reading every {interval}",
        "sit at {target} for {duration} with the thermal camera logging every {interval}",
        "stay at {target} while you take thermal readings every {interval} for {duration}",
    ),
    "FeatureStare": (
        "hold at {target} for {duration} while you film {feature_type}",
        "stay {duration} at {target} filming {feature_type}",
        "stop at {target} for {duration} filming {feature_type}",
        "keep station at {target} for {duration} with the camera locked on {feature_type}",
        "hold still by {target} for {duration}, camera on {feature_type}",
    ),
    "HorizontalPanorama": (
        "hold at {target} while you take a panorama",
        "stay at {target} for a panorama",
        "keep still at {target} and shoot a panorama in {sectors} sectors",
    ),
    "ThermalHotspotLocalizer": (
        "hold at {target} while you look for its hottest spot",
        "stay at {target} and sweep {scan_width_degrees} for the hottest spot",
    ),
}
"""Phrases in which holding serves a sensor alone (rule 8), beside those of the bank."""

_SLOT = re.compile(r"\{(\w+)\}")
# A self-going task whose phrase says "proceed to" would need a Transit of its own (rule 4).
_GOES = re.compile(r"\b(?:proceed|get) to \{(?:start|target)\} (?:and|on)\b")
_PLACE = re.compile(r" (?:of|on|at|from|beside|off|to|in) \{target\}(?=$| )")
_OWNED = re.compile(r"\{(?:feature_type|target_feature)\} (?:of|on|at) \{target\}")
_OF = re.compile(r"\b(?:of|on) \{target\}")
_THERE = re.compile(r"\b(?:at|to|in|into) \{target\}")


@dataclass(frozen=True)
class Template:
    """A phrase as literals and slot names in turn."""

    text: str

    @cached_property
    def parts(self) -> list[str]:
        return _SLOT.split(self.text)

    @cached_property
    def slots(self) -> frozenset[str]:
        return frozenset(self.parts[1::2])

    @cached_property
    def there(self) -> Template:
        """The phrase with "there" in place of "at {target}" and the like."""
        return Template(_THERE.sub("there", self.text).replace("from {target}", "from there"))

    @cached_property
    def placeless(self) -> Template:
        """The phrase without its place, where that leaves a phrase."""
        return Template(_PLACE.sub("", self.text))

    @cached_property
    def possessive(self) -> Template:
        """The phrase with "the barge's ladder" in place of "the ladder of the barge"; the feature's
        bare name is `own_feature`.
        """
        return Template(_OWNED.sub("{target}'s {own_feature}", self.text))

    @cached_property
    def at_place(self) -> Template:
        """The phrase for a bare position: what a thing has or is "of" stands "at" a position."""
        return Template(_OF.sub("at {target}", self.text))

    def fill(self, values: dict[str, str]) -> str:
        parts = self.parts
        return "".join(part if index % 2 == 0 else values[part] for index, part in enumerate(parts))


@dataclass(frozen=True)
class Forms:
    """The phrases of one task by mood; a mood is imp, np or ger."""

    full: dict[str, tuple[Template, ...]]
    valued: dict[str, tuple[Template, ...]]
    bare: dict[str, tuple[Template, ...]]
    here: tuple[Template, ...]
    adjuncts: dict[str, tuple[Template, ...]]


@cache
def forms(title: str) -> Forms:
    """The compiled phrases of a task."""
    phrases = BANK[title]
    return Forms(
        full={
            "imp": _compiled(phrases.imperatives),
            "np": _compiled(phrases.noun_phrases),
            "ger": _compiled(phrases.gerunds),
        },
        valued={
            "imp": _compiled(phrases.valued_imperatives + HELD.get(title, ())),
            "np": _compiled(phrases.valued_noun_phrases),
            "ger": (),
        },
        bare={
            "imp": _compiled(phrases.bare_imperatives),
            "np": _compiled(phrases.bare_noun_phrases),
            "ger": _compiled(phrases.bare_gerunds),
        },
        here=_compiled(phrases.here_imperatives),
        adjuncts={name: _compiled(texts) for name, texts in phrases.adjuncts.items()},
    )


def _compiled(texts: tuple[str, ...]) -> tuple[Template, ...]:
    return tuple(Template(text) for text in texts if not _GOES.search(text))
