"""Whether enforced answers are bounded: on every set of the repository and on sampled inputs.

    python benchmarks/answer_bounds.py [--candidate embedded] [--strengths grounded] \
        [--sampled 1000] [--out FOLDER] [--batch-size 16]

For every input of both levels, greedily: an enforced answer has at most 2 x free + 2 tasks or
steps, no run of the same entry, or of entries that differ in one number alone, goes on to a bound
of the grammar, and no answer ends by its token limit. Answers are written to OUT/answers.jsonl as
they are made, and a run that was interrupted goes on there. Prints each violation and the counts.
"""

from __future__ import annotations

import argparse
import itertools
import json
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from planner_ft.candidates import resolve_candidate
from planner_ft.data.missions import sample_missions
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import STRENGTHS, parse_configuration
from planner_ft.decoding.constraints.grammar import MOST_STEPS, MOST_TASKS
from planner_ft.decoding.constraints.scripts import MOST_RUN, MOST_SAME
from planner_ft.decoding.engine import Engine, decoding_threads
from planner_ft.support.files import compact_json, read_jsonl, sha256_text, write_json
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, parse_output

SEED = 77
SETS = "data/{level}/*.jsonl", "eval/challenge/{level}*.jsonl"
BOUNDS: dict[Level, tuple[str, int]] = {
    "mission": ("tasks", MOST_TASKS),
    "task": ("skill_sequence", MOST_STEPS),
}


def inputs(level: Level, vocabulary: Vocabulary, sampled: int) -> Iterator[dict[str, Any]]:
    """Records of the repository's sets, then sampled ones, each with a name of its own."""
    for pattern in SETS:
        for path in sorted(Path().glob(pattern.format(level=level))):
            for number, record in enumerate(read_jsonl(path)):
                yield {**record, "id": _name(f"{path.stem} {number}", record)}
    drawn = (
        sample_missions(SEED)
        if level == "mission"
        else sample_tasks(vocabulary, SEED, None, "test")
    )
    for number, record in enumerate(itertools.islice(drawn, sampled)):
        yield {**record, "id": _name(f"sampled {number}", record)}


def _name(name: str, record: dict[str, Any]) -> str:
    """A name that another input does not get when sets or samplers change."""
    asked = [record.get(key) for key in ("prompt", "task", "parameters")]
    return f"{name} {sha256_text(compact_json(asked))[:12]}"


def runs_on(entries: list[Any], level: Level) -> str:
    """The bound that a run of like entries reaches; empty where there is none."""
    if len(entries) >= BOUNDS[level][1]:
        return f"{len(entries)} entries"
    moves = [entry if level == "mission" else entry["navigation_skill"] for entry in entries]
    texts = [compact_json(move) for move in moves]
    turns = [text for text in texts if '"GoToXY"' not in text]
    for like, bound in ((texts, MOST_SAME), (map(_without_numbers, turns), MOST_RUN)):
        longest = max((len(list(run)) for _text, run in itertools.groupby(like)), default=0)
        if longest >= bound:
            return f"{longest} like entries in a row"
    return ""


def _without_numbers(text: str) -> str:
    return "".join("0" if letter in "0123456789.-" else letter for letter in text)


def check(
    engine: Engine, level: Level, strength: str, records: list[Any], size: int
) -> Iterator[dict[str, Any]]:
    """A line for each input: entries of the answer and how it ended."""
    configuration = parse_configuration(f"lora+{strength}")
    queries = [engine.query(level, record) for record in records]
    count = engine.method(level, configuration).entries
    assert count is not None
    for index, answer in engine.answers(queries, configuration, batch_size=size):
        plan = parse_output(engine.text(answer)).plan or {}
        found = plan.get(BOUNDS[level][0])
        entries = found if isinstance(found, list) else []
        yield {
            "level": level,
            "strength": strength,
            "id": records[index]["id"],
            "entries": count(answer.ids),
            "run": runs_on(entries, level),
            "ended": answer.finish_reason == "stop" and not answer.cut,
            "alternatives": answer.alternatives,
        }


def violations(lines: list[dict[str, Any]]) -> Iterator[str]:
    """A sentence for each enforced answer that is not bounded."""
    free = {(line["level"], line["id"]): line for line in lines if line["strength"] == "free"}
    for line in lines:
        if line["strength"] != "free":
            name = f"{line['level']} {line['id']}, {line['strength']}: "
            beside = free[line["level"], line["id"]]
            if beside["ended"] and line["entries"] > 2 * beside["entries"] + 2:
                yield f"{name}{line['entries']} entries, free {beside['entries']}"
            if line["run"]:
                yield name + line["run"]
            if not line["ended"]:
                yield name + "ended by its limit"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--candidate", default="embedded")
    parser.add_argument("--strengths", default="grounded", help="of " + ", ".join(STRENGTHS[1:]))
    parser.add_argument("--sampled", type=int, default=1000)
    parser.add_argument("--out", type=Path, default=Path("eval/runs/answer_bounds"))
    parser.add_argument("--batch-size", type=int, default=16)
    arguments = parser.parse_args()
    vocabulary, candidate = load_vocabulary(), resolve_candidate(arguments.candidate)
    adapters = {level: Path("adapters", candidate.name, level) for level in LEVELS}
    engine = Engine.load(
        candidate,
        vocabulary,
        adapters=adapters,
        device="cpu",
        threads=decoding_threads(candidate, "cpu"),
    )
    path = arguments.out / "answers.jsonl"
    path.parent.mkdir(parents=True, exist_ok=True)
    lines = read_jsonl(path) if path.exists() else []
    done = {(line["level"], line["strength"], line["id"]) for line in lines}
    strengths = ["free", *arguments.strengths.split(",")]
    with path.open("a", encoding="utf-8") as file:
        for level, strength in itertools.product(LEVELS, strengths):
            records = [
                record
                for record in inputs(level, vocabulary, arguments.sampled)
                if (level, strength, record["id"]) not in done
            ]
            for line in check(engine, level, strength, records, arguments.batch_size):
                lines.append(line)
                file.write(json.dumps(line) + "\n")
                file.flush()
    found = sorted(violations(lines))
    print(*found, sep="\n")
    counts = Counter(f"{line['level']} {line['strength']}" for line in lines)
    again = Counter(f"{line['level']} {line['strength']}" for line in lines if line["alternatives"])
    configuration = {name: str(value) for name, value in vars(arguments).items()}
    summary = {
        "manifest": build_manifest("answer_bounds", seed=SEED, configuration=configuration),
        "answers": dict(counts),
        "compared with the free answer": dict(again),
        "violations": found,
    }
    write_json(arguments.out / "answer_bounds.json", summary)
    print(f"{len(found)} violations in {sum(counts.values())} answers: {dict(counts)}")


if __name__ == "__main__":
    main()
