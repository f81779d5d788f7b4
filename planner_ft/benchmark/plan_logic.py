"""What an answer scores by the metrics that read the command and replay the plan."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any

from planner_ft.benchmark.answer import Answer, Value
from planner_ft.benchmark.metrics.abstention import right_refusal, wrong_refusal
from planner_ft.benchmark.metrics.executability import executable
from planner_ft.benchmark.metrics.groundedness import Groundedness, groundedness
from planner_ft.benchmark.metrics.slots import KINDS, Reached, slot_propagation
from planner_ft.facts import read_input
from planner_ft.vocabulary.replay import Stop


@dataclass(frozen=True)
class PlanLogic:
    """Values that nobody gave, how far the command's facts came, and at mission level where the
    plan stops (None: nowhere).
    """

    answer: Answer
    grounded: Groundedness
    reached: Reached
    stop: Stop | None

    def values(self) -> dict[str, Value]:
        """Metrics of the sample. An answer that does not parse is not grounded, since it gives
        nothing to judge.
        """
        answer, mission = self.answer, self.answer.level == "mission"
        stated = self.reached.stated.total()
        return {
            "executable": self.stop is None if mission else None,
            "grounded": answer.plan is not None and not self.grounded.ungrounded,
            "values_judged": self.grounded.judged,
            "values_grounded": self.grounded.judged - len(self.grounded.ungrounded),
            "slots_stated": stated,
            "slots_prompted": stated if mission else None,
            "slots_in_parameters_right": self.reached.in_parameters.total(),
            "slots_in_prompt_right": self.reached.in_prompt.total() if mission else None,
            "right_refusal": right_refusal(answer.level, answer.plan, answer.expected),
            "wrong_refusal": wrong_refusal(answer.level, answer.plan, answer.expected),
        }

    def details(self) -> dict[str, Any]:
        """What explains the values: `stop`, `ungrounded` values, and `slots` per kind as [stated,
        in parameters, in the task prompt (null at task level)].
        """
        reached, mission = self.reached, self.answer.level == "mission"
        prompted = {kind: reached.in_prompt[kind] if mission else None for kind in KINDS}
        return {
            "stop": asdict(self.stop) if self.stop else None,
            "ungrounded": [
                {
                    "entry": given.entry,
                    "name": self.answer.given[given.entry].name,
                    "parameter": given.parameter.name,
                    "value": given.value,
                }
                for given in self.grounded.ungrounded
            ],
            "slots": {
                kind: [reached.stated[kind], reached.in_parameters[kind], prompted[kind]]
                for kind in KINDS
                if reached.stated[kind]
            },
        }


def plan_logic(answer: Answer) -> PlanLogic:
    """Judge an answer against its command and by itself."""
    level, vocabulary = answer.level, answer.vocabulary
    source = read_input(answer.sample.record, vocabulary)
    return PlanLogic(
        answer,
        groundedness(level, answer.given, source, vocabulary),
        slot_propagation(level, answer.plan, answer.alignment, source, vocabulary),
        executable(answer.plan, answer.expected, vocabulary) if level == "mission" else None,
    )
