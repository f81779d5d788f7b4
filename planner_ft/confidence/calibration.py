"""From log-probabilities to the probability that a part of a plan is right: a logistic regression
(Platt 1999) over the features of the part, fitted on validation data by `plannerft calibrate`.

It lies as `confidence-LEVEL-CONFIGURATION.json` beside the adapter, or in the candidate's folder.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

from planner_ft.confidence.choices import Choices
from planner_ft.confidence.parts import Kind, Part, parts
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary.outputs import parse_output
from planner_ft.vocabulary.plans import Level

FORMAT, VERSION = "planner_ft confidence", 1
KINDS: tuple[Kind, ...] = get_args(Kind)
Sureness = Literal["sure", "check", "unsure"]
SURE, UNSURE = 0.95, 0.7
"""Probabilities from which on a part is called sure, and below which unsure."""
AGENT = (
    *("candidate", "configuration", "quantization"),
    *("weights_sha256", "adapter_sha256", "vocabulary_sha256"),
)
"""What a calibration holds for; it says nothing of others."""


@dataclass(frozen=True)
class Curve:
    """A logistic regression: `weights` of the logarithms of features (`log_features`), fitted on
    `n` parts of which the share `right` was right.
    """

    weights: Mapping[str, float]
    intercept: float
    n: int
    right: float

    def probability(self, part: Part) -> float:
        """Between 0 and 1."""
        found = log_features(part)
        total = self.intercept + sum(of * found[name] for name, of in self.weights.items())
        return 1 / (1 + math.exp(-max(-30.0, min(30.0, total))))


@dataclass(frozen=True)
class Calibration:
    """The curves of one agent by kind of part. `manifest` says what it was fitted on and, under
    `agent`, holds for.
    """

    level: Level
    curves: Mapping[Kind, Curve]
    manifest: Mapping[str, Any] = field(default_factory=dict)

    def probabilities(self, text: str, choices: Choices) -> list[tuple[Part, float]]:
        """The parts of an answer that is one JSON object, each with its probability, that of the
        plan first.
        """
        made = parts(self.level, text, choices)
        return [(part, self.curves[part.kind].probability(part)) for part in made]

    def to_json(self) -> dict[str, Any]:
        named = {"format": FORMAT, "version": VERSION, "level": self.level}
        curves = {kind: asdict(curve) for kind, curve in self.curves.items()}
        return {**named, "curves": curves, "manifest": dict(self.manifest)}


def log_features(part: Part) -> dict[str, float]:
    """The features as logarithms, 0 where the model was entirely certain: from one nat to two is as
    far as from ten to twenty.
    """
    found = part.features()
    return {
        "lowest": math.log1p(-100 * found["lowest"]),
        "total": math.log1p(-100 * found["total"]),
        "margin": math.asinh(found["margin"]),
        "overruled": math.log1p(found["overruled"]),
        "tokens": math.log1p(found["tokens"]),
    }


def plan_confidence(
    calibration: Calibration | None, text: str, choices: Choices | None
) -> float | None:
    """The probability that the plan of an answer is right; None where it is not known."""
    if calibration is None or choices is None or parse_output(text).plan is None:
        return None
    return round(calibration.probabilities(text, choices)[0][1], 4)


def sureness(probability: float) -> Sureness:
    """The level that a reader sees."""
    return "sure" if probability >= SURE else "check" if probability >= UNSURE else "unsure"


def calibration_file(folder: Path, level: Level, configuration: str) -> Path:
    """Where the calibration of an agent lies: `folder` is its adapter's, or its candidate's."""
    return folder / f"confidence-{level}-{configuration}.json"


def read_calibration(path: Path, agent: Mapping[str, Any]) -> tuple[Calibration | None, str]:
    """The calibration of an `agent` (its `AGENT` fields) in a file; None and why, where there is no
    file or one of another agent. Raises PlannerError for a damaged file.
    """
    if not path.is_file():
        return None, "the model is not calibrated; plannerft calibrate does it"
    value = read_json(path)
    try:
        if (value["format"], value["version"]) != (FORMAT, VERSION):
            raise ValueError
        curves = {kind: Curve(**value["curves"][kind]) for kind in KINDS}
        found = Calibration(value["level"], curves, value["manifest"])
        same = all(found.manifest["agent"].get(key) == agent.get(key) for key in AGENT)
    except (AttributeError, KeyError, TypeError, ValueError):
        way = "make it again with plannerft calibrate"
        raise PlannerError(f"{path}: is no calibration of this version; {way}") from None
    if not same:
        problem = "it was calibrated with other weights or settings"
        return None, f"{problem}; plannerft calibrate does it again"
    return found, ""
