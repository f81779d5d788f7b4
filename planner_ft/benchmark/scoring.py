"""Scoring one answer: every metric of a sample."""

import math
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
from typing import Any

from planner_ft.benchmark.metrics import answers
from planner_ft.benchmark.metrics.alignment import Alignment
from planner_ft.benchmark.metrics.answers import Answer, Parameters, compare_parameters
from planner_ft.benchmark.metrics.facts import groundedness, slot_propagation
from planner_ft.benchmark.samples import Sample
from planner_ft.confidence.parts import from_json, parts
from planner_ft.facts import read_input
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import ROLES
from planner_ft.vocabulary.plans import Level, parse_output

Value = float | bool | None  # A metric of one sample: None where the sample says nothing about it
Values = dict[str, Value]
Details = dict[str, Any]
UNPARSED = "(does not parse)"
UNPARSED_COUNTS: dict[Level, bool] = {"mission": True, "task": False}
"""Whether the published tables count an answer that does not parse as hallucinated."""


@dataclass(frozen=True)
class SampleScore:
    """The score of one answer: `values` by metric, and the kind of failure, None when names, order
    and parameters are right. `alignment` and `types` (per type of parameter: values that agree,
    values that there are) are for the tables by name and type, `details` explain values
    (`plan_logic`).
    """

    id: str
    family: str
    group: str | None
    failure: str | None
    values: Values
    alignment: Alignment = field(default=Alignment((), (), ()), repr=False)
    types: dict[str, tuple[int, int]] = field(default_factory=dict, repr=False)
    details: Details = field(default_factory=dict, repr=False)

    def to_json(self) -> dict[str, Any]:
        """A line of scores.jsonl."""
        beside = {"group": self.group, "alignment": self.alignment.to_json(), **self.details}
        named = {"id": self.id, "family": self.family}
        return {**named, **self.values, "failure": self.failure, **beside}


def score_sample(
    level: Level,
    sample: Sample,
    prediction: Mapping[str, Any] | None,
    vocabulary: Vocabulary,
    timed: Mapping[str, Any] | None = None,
) -> SampleScore:
    """Score one prediction (None: an empty output) with the sample's timed query, if any."""
    prediction, timed = prediction or {}, timed or {}
    plan = parse_output(prediction.get("output")).plan
    answer = Answer(level, plan, sample.expected, vocabulary)
    failure = answers.failure_kind(answer)
    logic, details = plan_logic(answer, sample.record)
    found = compare_parameters(answer.alignment, vocabulary)
    values = _published(answer) | _names(answer) | _parameters(found) | logic
    values |= {
        "whole_plan": failure is None,
        "whole_plan_unordered": failure is None or answers.whole_plan_unordered(answer),
        "tokens": prediction.get("tokens"),
        "latency_s": timed.get("latency_s"),
        "forward_passes": timed.get("forward_passes"),
    }
    group = sample.record.get("group")  # the kind of difficulty that the data files it under
    named = sample.id, sample.family, str(group) if group else None
    details |= _confidence(answer, prediction)
    return SampleScore(*named, failure, values, answer.alignment, found.types, details)


def _confidence(answer: Answer, prediction: Mapping[str, Any]) -> Details:
    """How sure the system is of its plan, 0 to 1 or None: `calibrated`, or else the probability of
    the plan's tokens as the model has it. What does not parse is known to be wrong.
    """
    held, text = prediction.get("confidence"), prediction.get("output")
    choices = from_json(prediction.get("logprobs"), text) if isinstance(text, str) else None
    if isinstance(held, int | float) and 0 <= held <= 1:
        return {"confidence": float(held), "calibrated": True}
    if choices is None:
        return {"confidence": None}
    if answer.plan is None:
        return {"confidence": 0.0}
    plan = parts(answer.level, str(text), choices)[0]
    return {"confidence": math.exp(plan.features()["total"])}


def _published(answer: Answer) -> Values:
    """Hallucination in both readings and validity, as the published tables have them."""
    invented = bool(answer.invented)
    counted = invented or answer.plan is None
    return {
        "parsed": answer.plan is not None,
        "invented": invented,
        "hallucination": counted if UNPARSED_COUNTS[answer.level] else invented,
        "hallucination_with_unparsed": counted,
        "hallucination_without_unparsed": invented,
        "schema_valid": answer.schema_valid,
        "strict_valid": answer.strict_valid,
    }


def _names(answer: Answer) -> Values:
    """Names as a set (the published F1) and as a multiset, and their order; at task level also per
    role, and the order of steps. Where nothing is expected, an answer that does not parse is not
    taken for one that names nothing.
    """
    task_level, steps = answer.level == "task", list(answer.sequences)
    both = [entry.name for entry in answer.given], [entry.name for entry in answer.wanted]
    if answer.plan is None and not answer.wanted:
        both, steps[0] = ([UNPARSED], []), [(UNPARSED,)]
    values: Values = {}
    ways = {"": answers.set_counts(*both), "multiset_": answers.multiset_counts(*both)}
    for prefix, counts in ways.items():
        for key in ("f1", "precision", "recall"):
            values[f"{prefix}{key}"] = getattr(counts, key)
    if task_level:
        by_role = answers.counts_by("role", answer.given, answer.wanted)
        for role in ROLES:
            values |= _pooled(role, by_role.get(role, answers.Counts(0, 0, 0)))
    flat = [[name for step in sequence for name in step] for sequence in steps]
    return values | {
        "exact_sequence": answer.exact_sequence,
        "edit_distance": answers.edit_distance(*flat),
        "step_edit_distance": answers.edit_distance(*steps) if task_level else None,
        "lcs_f1": answers.common_subsequence(*flat).f1,
        "edge_f1": answers.edge_f1(*steps),
    }


def _parameters(found: Parameters) -> Values:
    """Parameters of aligned entries: all right, keys, key-value pairs; of the whole plan, too."""
    values: Values = {"parameters_right": found.right, "parameters_matched": found.matched}
    for name in ("keys", "values", "keys_overall", "values_overall"):
        values |= _pooled(f"parameter_{name}", getattr(found, name))
    return values


def _pooled(prefix: str, counts: answers.Counts) -> Values:
    """The terms of an F1 over all samples (`catalogue`)."""
    size = (counts.predicted + counts.expected) / 2
    return {f"{prefix}_right": counts.right, f"{prefix}_size": size}


def plan_logic(answer: Answer, record: dict[str, Any]) -> tuple[Values, Details]:
    """Metrics that read the command (of the sample) and replay the plan, and details: `stop`
    (where the plan stops), `ungrounded` values, and `slots` per kind as [stated, in parameters, in
    the task prompt (null at task level)]. An answer that does not parse is not grounded, since it
    gives nothing to judge.
    """
    level, plan, vocabulary = answer.level, answer.plan, answer.vocabulary
    mission = level == "mission"
    source = read_input(record, vocabulary)
    judged, ungrounded = groundedness(answer.given, source, vocabulary)
    slots = slot_propagation(plan, answer.alignment, source, vocabulary)
    stop = answers.executable(plan, answer.expected, vocabulary) if mission else None
    stated, in_parameters, in_prompt = (sum(n[at] for n in slots.values()) for at in range(3))
    refused, impossible = (answers.refuses(level, one) for one in (plan, answer.expected))
    values: Values = {
        "executable": stop is None if mission else None,
        "grounded": plan is not None and not ungrounded,
        "values_judged": judged,
        "values_grounded": judged - len(ungrounded),
        "slots_stated": stated,
        "slots_prompted": stated if mission else None,
        "slots_in_parameters_right": in_parameters,
        "slots_in_prompt_right": in_prompt if mission else None,
        "right_refusal": refused if impossible else None,
        "wrong_refusal": None if impossible else refused,
    }
    details: Details = {
        "stop": stop and asdict(stop),
        "ungrounded": [
            {"entry": one.entry, "name": answer.given[one.entry].name}
            | {"parameter": one.parameter.name, "value": one.value}
            for one in ungrounded
        ],
        # At task level there is no task prompt to reach.
        "slots": {kind: n if mission else [*n[:2], None] for kind, n in slots.items()},
    }
    return values, details
