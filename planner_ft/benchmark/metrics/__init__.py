"""One metric per module: small pure functions over names, plans and the vocabulary, each with its
definition.
"""

from planner_ft.benchmark.metrics.alignment import Alignment, align
from planner_ft.benchmark.metrics.common_subsequence import common_subsequence
from planner_ft.benchmark.metrics.counts import Counts
from planner_ft.benchmark.metrics.edges import edge_f1
from planner_ft.benchmark.metrics.edit_distance import edit_distance
from planner_ft.benchmark.metrics.entries import Entry, plan_entries
from planner_ft.benchmark.metrics.exact_sequence import exact_sequence
from planner_ft.benchmark.metrics.f1 import set_f1
from planner_ft.benchmark.metrics.failures import FAILURES, failure_kind
from planner_ft.benchmark.metrics.hallucination import hallucinated
from planner_ft.benchmark.metrics.names import (
    counts_by_name,
    counts_by_role,
    multiset_counts,
    set_counts,
)
from planner_ft.benchmark.metrics.parameters import (
    Agreement,
    agreement_by_type,
    parameter_agreement,
    parameter_counts,
    right_entries,
)
from planner_ft.benchmark.metrics.schema_valid import schema_valid
from planner_ft.benchmark.metrics.strict_valid import strict_valid
from planner_ft.benchmark.metrics.substitutions import substitutions
from planner_ft.benchmark.metrics.whole_plan import whole_plan_unordered

__all__ = [
    "FAILURES",
    "Agreement",
    "Alignment",
    "Counts",
    "Entry",
    "agreement_by_type",
    "align",
    "common_subsequence",
    "counts_by_name",
    "counts_by_role",
    "edge_f1",
    "edit_distance",
    "exact_sequence",
    "failure_kind",
    "hallucinated",
    "multiset_counts",
    "parameter_agreement",
    "parameter_counts",
    "plan_entries",
    "right_entries",
    "schema_valid",
    "set_counts",
    "set_f1",
    "strict_valid",
    "substitutions",
    "whole_plan_unordered",
]
