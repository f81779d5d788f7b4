"""Names of tasks and skills as sets and multisets, per name and per role, and in their order; and
the parameters of aligned ones: entries all right, F1 of keys and of key-value pairs.

Every predicted name counts, also outside the vocabulary; an answer that does not parse has none.
"""

from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from rapidfuzz.distance import LCSseq, Levenshtein

from planner_ft.benchmark.metrics.alignment import Alignment, Entry, plan_entries
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, step_skills


class Counts(NamedTuple):
    """Items that are right among predicted and expected ones; of nothing, nothing is right."""

    right: int
    predicted: int
    expected: int

    @property
    def precision(self) -> float:
        return self.right / self.predicted if self.predicted else float(not self.expected)

    @property
    def recall(self) -> float:
        return self.right / self.expected if self.expected else float(not self.predicted)

    @property
    def f1(self) -> float:
        """Harmonic mean of precision and recall (van Rijsbergen 1979)."""
        total = self.predicted + self.expected
        return 2 * self.right / total if total else 1.0


def set_counts(predicted: Iterable[Hashable], expected: Iterable[Hashable]) -> Counts:
    """Distinct names, whose F1 is the published one: 1.0 when both are empty, 0.0 when one is."""
    ours, theirs = set(predicted), set(expected)
    return Counts(len(ours & theirs), len(ours), len(theirs))


def multiset_counts(predicted: Iterable[str], expected: Iterable[str]) -> Counts:
    """Occurrences of names: of three expected Transits, one predicted is one right of three."""
    ours, theirs = Counter(predicted), Counter(expected)
    return Counts((ours & theirs).total(), ours.total(), theirs.total())


def counts_by(by: str, predicted: Iterable[Entry], expected: Iterable[Entry]) -> dict[str, Counts]:
    """Occurrences by "name", or of the names by "role": a skill in another role than its own
    is wrong in both.
    """
    names: dict[str, tuple[list[str], list[str]]] = defaultdict(lambda: ([], []))
    for side, entries in ((1, expected), (0, predicted)):
        for entry in entries:
            names[getattr(entry, by)][side].append(entry.name)
    return {key: multiset_counts(*both) for key, both in names.items()}


def name_sequence(level: Level, plan: dict[str, Any]) -> list[tuple[str, ...]]:
    """The names in order: a title per task, or per step its skills with their roles, sorted."""
    if level == "mission":
        return [(entry.name,) for entry in plan_entries(level, plan)]
    steps = plan.get(list_key(level))
    return [
        tuple(sorted(f"{role} {skill.get('name')}" for role, skill in step_skills(step)))
        for step in (steps if isinstance(steps, list) else ())
    ]


def edit_distance(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> float:
    """Levenshtein distance (1966) over names or steps, by the longer length: 0.0 equal to 1.0."""
    return Levenshtein.normalized_distance(predicted, expected)


def common_subsequence(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> Counts:
    """Its length beside those of the sequences; F1 is ROUGE-L with beta 1 (Lin 2004) over names."""
    return Counts(LCSseq.similarity(predicted, expected), len(predicted), len(expected))


def edge_f1(predicted: Sequence[Hashable], expected: Sequence[Hashable]) -> float:
    """F1 between the sets of edges of two sequences (TaskBench's edge F1, Shen et al. 2023). A node
    is a name with the number of its occurrence; an edge leads from each node to the next. Where
    neither sequence has two nodes: 1.0 for equal sequences, else 0.0.
    """
    ours, theirs = _edges(predicted), _edges(expected)
    if not ours | theirs:
        return float(list(predicted) == list(expected))
    return set_counts(ours, theirs).f1


def _edges(sequence: Sequence[Hashable]) -> set[Hashable]:
    nodes = [(name, list(sequence[:at]).count(name)) for at, name in enumerate(sequence)]
    return set(pairwise(nodes))


class Parameters(NamedTuple):
    """Of the expected entries that the answer has, too (`matched`), how many have exactly the
    expected parameters (`right`): every key, every value in the form that the vehicle reads. What
    is expected without a `parameters` object is not compared.

    Keys, and key-value pairs, that are right, predicted and expected, in aligned entries and in the
    whole plan, with the keys of missing and extra entries; values agree by their content there ("5
    min" is 300 s, a list of texts a set). Where the expected plan has entries and states no
    parameters at all, nothing is compared.

    `types` has per type of parameter (position, number, text ...) the expected values of aligned
    entries that the answer gives, and how many there are.
    """

    right: int
    matched: int
    keys: Counts
    values: Counts
    keys_overall: Counts
    values_overall: Counts
    types: dict[str, tuple[int, int]]


def compare_parameters(alignment: Alignment, vocabulary: Vocabulary) -> Parameters:
    """The parameters of an answer beside the expected ones."""
    expected, predicted = alignment.expected, alignment.predicted
    pairs = [pair for pair in alignment.matched() if pair[0].stated]
    right, keys = 0, 0
    agreed, there = Counter[str](), Counter[str]()
    for ours, theirs in pairs:
        known, agreeing = ours.known(vocabulary), ours.agreeing(theirs, vocabulary)
        right += not ours.changed(theirs, vocabulary)
        keys += len(ours.parameters.keys() & theirs.parameters.keys())
        for key in ours.parameters:
            kind = known[key].type if key in known else "unknown"
            there[kind] += 1
            agreed[kind] += key in agreeing
    stated, given = (sum(len(pair[side].parameters) for pair in pairs) for side in (0, 1))
    labelled = not expected or any(entry.stated for entry in expected)
    missing = sum(len(expected[index].parameters) for index in alignment.missing)
    extra = sum(len(predicted[index].parameters) for index in alignment.extra) if labelled else 0
    types = {kind: (agreed[kind], count) for kind, count in there.items()}
    of_entries = Counts(keys, given, stated), Counts(agreed.total(), given, stated)
    sizes = given + extra, stated + missing
    overall = Counts(keys, *sizes), Counts(agreed.total(), *sizes)
    return Parameters(right, len(pairs), *of_entries, *overall, types)
