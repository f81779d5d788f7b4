"""An answer beside the expected plan: names of tasks and skills as sets and multisets, per name and
per role, and in their order; the parameters of aligned ones (entries all right, F1 of keys and of
key-value pairs); is it right as a whole, and how is a wrong one wrong (the published kinds)?

Every predicted name counts, also outside the vocabulary; an answer that does not parse has none.
"""

import functools
from collections import Counter, defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from typing import Any, Literal, NamedTuple, get_args

from rapidfuzz.distance import LCSseq, Levenshtein

from planner_ft.benchmark.metrics.alignment import Alignment, Entries, Entry, align, plan_entries
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, list_key, plan_problems, step_skills
from planner_ft.vocabulary.replay import Stop, on_board, replay

Failure = Literal[
    "prerequisite omission",
    "parameter propagation",
    "substitution",
    "hallucination",
    "omission",
    "extra step",
    "wrong order",
    "invalid output",
]
FAILURES: tuple[Failure, ...] = get_args(Failure)
PUBLISHED: dict[Failure, int] = dict(zip(FAILURES, (4, 2, 2, 1), strict=False))
"""Failures of the published mission agent in 25 answers; of the other kinds there was none."""
Plan = dict[str, Any]


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


@dataclass(frozen=True)
class Answer:
    """A plan that was answered, if any, beside the expected one, and what several metrics need."""

    level: Level
    plan: Plan | None
    expected: Plan
    vocabulary: Vocabulary

    @functools.cached_property
    def wanted(self) -> Entries:
        """The expected tasks or skills."""
        return plan_entries(self.level, self.expected)

    @functools.cached_property
    def given(self) -> Entries:
        """The predicted tasks or skills; none when the output does not parse."""
        return plan_entries(self.level, self.plan)

    @functools.cached_property
    def alignment(self) -> Alignment:
        return align(self.wanted, self.given, self.vocabulary)

    @functools.cached_property
    def strict_valid(self) -> bool:
        """Whether names, roles, types, ranges are the vocabulary's (LEVEL.strict.schema.json)."""
        return not plan_problems(self.level, self.plan, self.vocabulary, strict=True)

    @functools.cached_property
    def schema_valid(self) -> bool:
        """Whether it has a plan's structure, as published (LEVEL.schema.json)."""
        structure = self.level, self.plan, self.vocabulary
        return self.strict_valid or not plan_problems(*structure, strict=False)

    @functools.cached_property
    def invented(self) -> list[str]:
        """Names of the plan that are not in the vocabulary, in order."""
        known = self.vocabulary.task if self.level == "mission" else self.vocabulary.skill
        return [entry.name for entry in self.given if entry.name not in known]

    @functools.cached_property
    def sequences(self) -> list[list[tuple[str, ...]]]:
        """The names in order that are predicted, and those that are expected."""
        return [name_sequence(self.level, plan) for plan in (self.plan or {}, self.expected)]

    @property
    def exact_sequence(self) -> bool:
        """Whether it parses and has exactly the expected tasks, or steps, in their order."""
        return self.plan is not None and self.sequences[0] == self.sequences[1]


def refuses(level: Level, plan: Plan | None) -> bool:
    """Whether an answer is a plan without entries; one that does not parse refuses nothing."""
    return plan is not None and plan.get(list_key(level)) == []


def failure_kind(answer: Answer) -> Failure | None:
    """Why an answer is wrong, or None when names, order and parameters are all right.

    The first that holds:

    - invalid output: it does not parse, or is not schema-valid;
    - hallucination: a name outside the vocabulary;
    - parameter propagation: the right names in the right order, but a value lost, altered or
      invented;
    - prerequisite omission: the task that locates a target is missing and a place stays unresolved;
      or names are missing, none is added, and something is planned after the first that is missing
      (mission level);
    - substitution: expected names are missing and others of the vocabulary stand instead;
    - omission: names are missing, at the end or at task level;
    - extra step: names were added; where all of them hold the unresolved location it is parameter
      propagation;
    - wrong order: the right names in another order (or, at task level, in other steps or roles).
    """
    if not answer.schema_valid:
        return "invalid output"
    if answer.invented:
        return "hallucination"
    level, vocabulary = answer.level, answer.vocabulary
    if answer.exact_sequence:
        # Task by task, or step by step: the two targets of two Transits must not be swapped.
        steps = zip(_steps(answer.wanted), _steps(answer.given), strict=True)
        right = all(_step_right(*pair, vocabulary) for pair in steps)
        return None if right else "parameter propagation"
    ours, theirs = (Counter(one.name for one in side) for side in (answer.given, answer.wanted))
    missing, added, nowhere = theirs - ours, ours - theirs, list(vocabulary.unresolved)
    unresolved = Counter(one.name for one in answer.given if nowhere in one.parameters.values())
    if missing:
        pairs = zip(answer.given, answer.wanted, strict=False)
        # Something is planned after the first expected name that is missing.
        goes_on = not added and any(one.name != other.name for one, other in pairs)
        unlocated = vocabulary.locate in missing and bool(unresolved)
        if level == "mission" and (unlocated or goes_on):
            return "prerequisite omission"
        return "substitution" if added else "omission"
    if added:
        return "extra step" if added - unresolved else "parameter propagation"
    return "wrong order"


def whole_plan_unordered(answer: Answer) -> bool:
    """Whether a valid answer has the right tasks, or whole steps, as expected, in any order."""
    if not answer.schema_valid or sorted(answer.sequences[0]) != sorted(answer.sequences[1]):
        return False
    from scipy.optimize import linear_sum_assignment

    wanted, given = (_alike(entries) for entries in (answer.wanted, answer.given))
    for names, steps in wanted.items():
        right = [
            [_step_right(one, other, answer.vocabulary) for other in given[names]] for one in steps
        ]
        pairs = zip(*linear_sum_assignment(right, maximize=True), strict=True)
        if not all(right[row][column] for row, column in pairs):
            return False
    return True


def _step_right(expected: Entries, predicted: Entries, vocabulary: Vocabulary) -> bool:
    """Whether two steps with the same names have the same parameters."""
    pairs = align(expected, predicted, vocabulary).matched()
    return not any(ours.stated and ours.changed(theirs, vocabulary) for ours, theirs in pairs)


def _steps(entries: Entries) -> list[Entries]:
    return [tuple(step) for _index, step in groupby(entries, key=lambda entry: entry.step)]


def _alike(entries: Entries) -> dict[tuple[str, ...], list[Entries]]:
    """A plan's steps by their names and roles."""
    found: dict[tuple[str, ...], list[Entries]] = defaultdict(list)
    for step in _steps(entries):
        found[tuple(sorted(f"{entry.role} {entry.name}" for entry in step))].append(step)
    return found


def executable(
    plan: Mapping[str, Any] | None, expected: Mapping[str, Any], vocabulary: Vocabulary
) -> Stop | None:
    """Where the vehicle, carrying a mission answer out task by task, stops, or None when it runs to
    its end, which need not be the one that was asked for (`vocabulary.replay`).

    Data that the expected plan sends or reports without collecting it is on board from before and
    given to the answer, too. An answer that does not parse, and one without tasks where tasks are
    expected, is no plan and stops at once: refusing everything is not executable.
    """
    entries = plan.get("tasks") if plan else None
    if not isinstance(entries, list) or (not entries and expected["tasks"]):
        reason = "the answer does not parse" if plan is None else "nothing is planned"
        return Stop(0, "", "plan given", reason)
    return replay(plan or {}, vocabulary, on_board(expected, vocabulary))
