"""From log-probabilities to the probability that a part of a plan is right: a logistic regression
(Platt 1999) over the features of the part, fitted on validation data by `plannerft calibrate`.

It lies as `confidence-LEVEL-CONFIGURATION.json` beside the adapter, or in the candidate's folder.
"""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any, Literal, get_args

from planner_ft.confidence.parts import Choices, Kind, Part, parts
from planner_ft.confidence.parts import Path as PartPath
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary.plans import Level, parse_output

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
LEAST = 0.02
"""Probability from which on another token is worth a question."""
NO_LOGPROBS = "the model gives no log-probabilities that can be believed"


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
        """The parts of an answer, one JSON object, each with its probability; the plan first."""
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
        way = "make it again with plannerft calibrate --overwrite"
        raise PlannerError(f"{path}: is no calibration of this version; {way}") from None
    if not same:
        problem = "it was calibrated with other weights or settings"
        return None, f"{problem}; plannerft calibrate --overwrite does it again"
    return found, ""


# ---------------------------------------------------------------- one answer


@dataclass(frozen=True)
class Judgement:
    """Probabilities that parts of an answer are right, by path, that of the plan under (); none
    where that is not known, and then `reason` says why.

    `others` are beginnings of what the model might have written in place of a value (JSON), each
    with its probability, the likeliest first.
    """

    reason: str = ""
    parts: Mapping[PartPath, float] = field(default_factory=dict)
    others: Mapping[PartPath, tuple[tuple[str, float], ...]] = field(default_factory=dict)


NOT_JUDGED = Judgement(NO_LOGPROBS)


def judge_answer(
    calibration: Calibration | None, reason: str, text: str, choices: Choices | None
) -> Judgement:
    """The judgement of an answer, one JSON object; `reason` says why there is no calibration."""
    if choices is None:
        return Judgement(NO_LOGPROBS)
    if calibration is None:
        return Judgement(reason)
    found = calibration.probabilities(text, choices)
    others = {part.path: other_beginnings(text, part) for part, _ in found if part.kind == "value"}
    known = {path: of for path, of in others.items() if of}
    return Judgement("", {part.path: probability for part, probability in found}, known)


def other_beginnings(text: str, part: Part) -> tuple[tuple[str, float], ...]:
    """What the model might have begun to write in place of a value: from its start on to the end of
    another token, with the probability of that token.
    """
    found: dict[str, float] = {}
    before = text[: part.span.start]
    for start, choice in zip(part.starts, part.choices, strict=True):
        for token, logprob in choice.others:
            begun = text[:start] + token
            # A token that begins before the value must write the same up to there.
            if len(begun) > len(before) and begun.startswith(before) and math.exp(logprob) > LEAST:
                found.setdefault(begun[len(before) :], math.exp(logprob))
    return tuple(sorted(found.items(), key=lambda pair: -pair[1]))
