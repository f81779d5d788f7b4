"""One metric per module: small pure functions over names, plans and the vocabulary, each with its definition."""

from planner_ft.benchmark.metrics.exact_sequence import exact_sequence
from planner_ft.benchmark.metrics.f1 import set_f1
from planner_ft.benchmark.metrics.failures import FAILURES, failure_kind
from planner_ft.benchmark.metrics.hallucination import hallucinated
from planner_ft.benchmark.metrics.parameters import Agreement, parameter_agreement
from planner_ft.benchmark.metrics.schema_valid import schema_valid
from planner_ft.benchmark.metrics.strict_valid import strict_valid

__all__ = ["FAILURES", "Agreement", "exact_sequence", "failure_kind", "hallucinated", "parameter_agreement", "schema_valid", "set_f1", "strict_valid"]
