"""The comparisons that a table of results makes: configurations of one model, models with the best
one, everything with the baselines; their marks and sentences; and what enforcing rules changed.
"""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Literal

from planner_ft.benchmark.catalogue import METRIC, Metric
from planner_ft.benchmark.paired import EXPLAINED, Comparison, Score, adjusted, holm, p_text, paired
from planner_ft.support.templates import text_template

Question = Literal["configuration", "best", "baseline"]
"""configuration: a model's configurations with its first one, enforced ones with the free one of
the same weights. best: models in one configuration with the best of them. baseline: every row with
each baseline.
"""
Contrasts = Mapping[Question, Sequence[Comparison]]
System = tuple[str, str]  # candidate and configuration
Scores = dict[str, list[Score]]  # the scores of a system by sample id
Wanted = list[tuple[System, System, Metric]]

DECISIVE = ("f1", "whole_plan")
"""The metrics that say whether a baseline is beaten, and what enforcing changed."""
DEFAULTS = ("f1", "exact_sequence", "parameters", "whole_plan", "hallucination", "strict_valid")
COMPARED = (*DEFAULTS, "schema_valid")
BEST = "★"
NOT_WORSE = ("equal", "not told apart", "better")
RIGHT = "right"  # the outcome of an answer with right names, order and parameters


def contrasts(
    scores: Iterable[Mapping[str, Any]], baselines: Iterable[Mapping[str, Any]], seed: int
) -> dict[Question, list[Comparison]]:
    """All comparisons from both files of scores, adjusted after Holm within each question."""
    rows, without_model = by_system(scores), by_system(baselines)
    everything = rows | without_model
    beside = [(first, second) for second in rows for first in without_model]
    wanted: dict[Question, Wanted] = {
        "configuration": _by_metric(_configurations(list(rows)), COMPARED),
        "best": _with_best(rows),
        "baseline": _by_metric(beside, DECISIVE),
    }
    found: dict[Question, list[Comparison]] = {}
    for question, asked in wanted.items():
        pairs = []
        for first, second, metric in asked:
            names = system_key(first), system_key(second)
            pairs.append(paired(metric, everything[first], everything[second], seed, names))
        found[question] = adjusted(pairs)
    return found


def system_key(system: System) -> str:
    """How comparisons name a row: "candidate configuration"."""
    return " ".join(system)


def by_system(scores: Iterable[Mapping[str, Any]]) -> dict[System, Scores]:
    """Lines of scores.jsonl by system, then by sample id."""
    rows: dict[System, Scores] = {}
    for score in scores:
        key = str(score.get("candidate")), str(score.get("configuration"))
        rows.setdefault(key, {}).setdefault(str(score.get("id")), []).append(score)
    return rows


def _by_metric(pairs: Sequence[tuple[System, System]], names: Sequence[str]) -> Wanted:
    return [(*pair, one) for pair in pairs for name, one in METRIC.items() if name in names]


def _configurations(systems: Sequence[System]) -> list[tuple[System, System]]:
    """(reference, row) within each candidate."""
    pairs = []
    for candidate, configuration in systems:
        own = [other for name, other in systems if name == candidate]
        free = configuration.partition("+")[0]
        reference = free if free != configuration and free in own else own[0]
        if reference != configuration:
            pairs.append(((candidate, reference), (candidate, configuration)))
    return pairs


def _with_best(rows: Mapping[System, Scores]) -> Wanted:
    """Each candidate with the best one of its configuration by each metric, the first of equals."""
    found: Wanted = []
    for configuration in dict.fromkeys(configuration for _candidate, configuration in rows):
        systems = [system for system in rows if system[1] == configuration]
        for metric in (METRIC[name] for name in METRIC if name in COMPARED and len(systems) > 1):
            sign, known = -1 if metric.better == "↓" else 1, dict[System, float]()
            for system in systems:
                value = metric.value(line for lines in rows[system].values() for line in lines)
                known |= {} if value is None else {system: sign * value}
            if known:
                best = max(known, key=known.__getitem__)
                found += [(best, system, metric) for system in systems if system != best]
    return found


def marks(found: Contrasts) -> dict[tuple[str, str], str]:
    """Marks by (system, metric): the verdict beside its reference; ★: best of its column."""
    marked = {(one.second, one.metric): one.mark for one in found["configuration"]}
    best = {(one.first, one.metric) for one in found["best"]}
    best |= {(one.second, one.metric) for one in found["best"] if one.verdict in NOT_WORSE}
    return marked | {key: marked.get(key, "") + BEST for key in best}


def legend(found: Contrasts) -> list[str]:
    """The meaning of the marks that a table has."""
    return sentences("contrasts", part="legend", found=found, explained=EXPLAINED, best=BEST)


def baseline_sentences(found: Contrasts) -> dict[str, str]:
    """By system: the baselines that it beats, and those that it is not shown to beat."""
    by_system: dict[str, list[Comparison]] = {}
    for one in found["baseline"]:
        by_system.setdefault(one.second, []).append(one)
    how = {"part": "baseline", "p_text": p_text, "named": baseline_name}
    return {name: sentences("contrasts", ones=ones, **how)[0] for name, ones in by_system.items()}


def sentences(template: str, **about: Any) -> list[str]:
    """The lines of templates/TEMPLATE.txt.j2, each once, but blank ones."""
    text = text_template("planner_ft.benchmark", f"{template}.txt.j2").render(about)
    return [line for line in dict.fromkeys(text.split("\n")) if line.strip()]


def contrast_notes(found: Contrasts, baseline_notes: Sequence[str] = ()) -> list[str]:
    """The legend of the marks, and whether each row beats the baselines."""
    beside = baseline_sentences(found).items()
    return [*legend(found), *baseline_notes, *(f"{name} {text}" for name, text in beside)]


def baseline_name(name: str) -> str:
    """A baseline without its configuration."""
    return name.removesuffix(" baseline")


def changes(scores: Iterable[Mapping[str, Any]], seed: int) -> list[dict[str, Any]]:
    """Every enforced configuration against the free one of the same weights ("lora+state" against
    "lora"), over the samples that both answered, as results.json has them.

    `f1` and `whole_plan` are differences by sample (after minus before), `p` and `p_adjusted` their
    p-values, the latter after Holm over all changes of a run. `seconds` and `forward_passes` are
    ratios of the sums, None where they are not known. `outcomes` counts answers by outcome before
    and after, "right" or a kind of failure: "hallucination → substitution" is an answer that got
    valid and stayed wrong.
    """
    # Scores of earlier versions do not say whether the whole plan is right.
    systems = by_system({**score, "whole_plan": score["failure"] is None} for score in scores)
    made: list[dict[str, Any]] = []
    for candidate, configuration in systems:
        free, plus, _strength = configuration.partition("+")
        if not plus or (candidate, free) not in systems:
            continue
        before, after = systems[candidate, free], systems[candidate, configuration]
        pair = {name: paired(METRIC[name], before, after, seed) for name in DECISIVE}
        common = [name for name in before if name in after]
        answers = [both for name in common for both in zip(before[name], after[name], strict=False)]
        kinds = ([score["failure"] or RIGHT for score in both] for both in answers)
        outcomes = Counter(map(tuple, kinds)).most_common()
        made.append(
            {
                "candidate": candidate,
                "before": free,
                "after": configuration,
                "n": len(common),
                **{name: one.difference.to_json() for name, one in pair.items()},
                "seconds": _ratio(answers, "latency_s"),
                "forward_passes": _ratio(answers, "forward_passes"),
                "outcomes": [{"before": a, "after": b, "n": count} for (a, b), count in outcomes],
                "p": [one.p for one in pair.values()],
            }
        )
    ps = iter(holm([p for change in made for p in change["p"]]))
    return [{**change, "p_adjusted": [next(ps) for _ in change["p"]]} for change in made]


def _ratio(pairs: Sequence[tuple[Score, Score]], key: str) -> float | None:
    both: list[list[Any]] = [[line.get(key) for line in pair] for pair in pairs]
    known = [pair for pair in both if None not in pair]
    before, after = (sum(pair[side] for pair in known) for side in (0, 1))
    return after / before if before else None
