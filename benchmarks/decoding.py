"""What decoding costs in each strength: `model.generate` beside ours, on the same queries in one
run.

    python benchmarks/decoding.py [--candidate NAME] [--adapters LEVEL=DIR ...] \
        [--levels mission,task] [--strengths free,schema,state,grounded]

Every query is answered in every way, one after the other, before the next one is: what else the
machine does falls on all alike. The first query is answered once before, uncounted. "passes" are
forward passes of the model. "a token" is what a token takes against plain `model.generate`. "same"
are answers with the text that `model.generate` gives at this strength; what the lean form saves is
compared with the lean form step by step, since the two forms round differently.
"""

from __future__ import annotations

import argparse
import contextlib
import statistics
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Any

import torch

from planner_ft.candidates import resolve_candidate
from planner_ft.data.task.sampler import sample_tasks
from planner_ft.decoding.configurations import STRENGTHS, Configuration, Strength
from planner_ft.decoding.constraints.answer import Answer as Constraint
from planner_ft.decoding.engine import Engine, decoding_threads
from planner_ft.decoding.sequence import Query
from planner_ft.support.files import read_jsonl, write_json
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

SPEEDS = {
    "step by step": {"fast_forward": False, "drafting": False},
    "fast-forward": {"fast_forward": True, "drafting": False},
    "with drafting": {"fast_forward": True, "drafting": True},
}
FORMS = {"ours": False, "ours, lean": True}
COMMANDS = Path("data/mission/validation.jsonl")


@dataclass(frozen=True)
class Answer:
    """One answer: its text, generated tokens, forward passes, and seconds on the clock and of the
    processor.
    """

    text: str
    tokens: int
    passes: int
    seconds: float
    cpu_seconds: float


@dataclass(frozen=True)
class Figures:
    """A way of decoding over all queries: means of tokens and passes, median seconds, and what a
    token takes against plain `model.generate`.
    """

    level: Level
    strength: Strength
    form: str
    way: str
    queries: int
    same: int
    tokens: float
    passes: float
    seconds: float
    cpu_seconds: float
    passes_ratio: float
    cpu_ratio: float


Way = Callable[[Query], Answer]


class Enforcing:
    """A logits processor that enforces a constraint on one answer."""

    def __init__(self, constraint: Constraint, prompt_length: int) -> None:
        self.constraint = constraint
        self.read = prompt_length

    def __call__(self, input_ids: torch.Tensor, scores: torch.Tensor) -> torch.Tensor:
        for token in input_ids[0, self.read :].tolist():
            self.constraint.accept(token)
        self.read = input_ids.shape[1]
        bits = torch.from_numpy(self.constraint.mask()).to(scores.device)[:, None] >> torch.arange(
            32, device=scores.device
        )
        return scores.masked_fill((bits & 1).reshape(1, -1)[:, : scores.shape[1]] == 0, -torch.inf)


def generated(engine: Engine, configuration: Configuration, *, enforced: bool) -> Way:
    """`model.generate`, greedy, as it comes or with a logits processor."""

    @torch.inference_mode()
    def answer(query: Query) -> Answer:
        limits = engine.limits[query.level]
        factory = engine.method(query.level, configuration).constraint
        with (
            engine.configured(query.level, configuration),
            counted(engine.model) as passes,
            timed() as spent,
        ):
            processors = (
                [Enforcing(factory.start(query.record, limits.max_new_tokens), len(query.prompt))]
                if enforced and factory
                else []
            )
            ids = torch.tensor([query.prompt], device=engine.model.device)
            output = engine.model.generate(
                input_ids=ids,
                attention_mask=torch.ones_like(ids),
                do_sample=False,
                max_new_tokens=limits.max_new_tokens,
                eos_token_id=list(limits.end_ids),
                pad_token_id=engine.tokenizer.pad_token_id,
                logits_processor=processors,
            )[0, len(query.prompt) :].tolist()
        kept = output[:-1] if output[-1] in limits.end_ids else output
        return Answer(
            engine.tokenizer.decode(kept, clean_up_tokenization_spaces=False),
            len(output),
            len(passes),
            *spent,
        )

    return answer


def decoded(engine: Engine, configuration: Configuration, speed: dict[str, bool]) -> Way:
    """Our loop."""
    engine = replace(engine, **speed)

    def answer(query: Query) -> Answer:
        with timed() as spent:
            generation = engine.answer(query, configuration)
        return Answer(
            engine.text(generation), len(generation.ids), generation.forward_passes, *spent
        )

    return answer


@contextlib.contextmanager
def counted(model: Any) -> Iterator[list[None]]:
    """A list that grows by one with every forward pass of the model."""
    passes: list[None] = []
    base = model.get_base_model() if hasattr(model, "get_base_model") else model
    hook = base.register_forward_hook(lambda *_: passes.append(None))
    try:
        yield passes
    finally:
        hook.remove()


@contextlib.contextmanager
def timed() -> Iterator[list[float]]:
    """Seconds on the clock and of the processor that the block took, once it has ended."""
    spent: list[float] = []
    clock, processor = time.perf_counter(), time.process_time()
    yield spent
    spent += [time.perf_counter() - clock, time.process_time() - processor]


def ways(engines: dict[str, Engine], configuration: Configuration) -> dict[tuple[str, str], Way]:
    """Every way of decoding by (form, way), the one that others of its form are compared with
    first.
    """
    strength, as_loaded = configuration.strength, engines["ours"]
    found = {("model.generate", "plain"): generated(as_loaded, configuration, enforced=False)}
    if strength != "free":
        found["model.generate", "logits processor"] = generated(
            as_loaded, configuration, enforced=True
        )
    for form, engine in engines.items():
        found |= {
            (form, name): decoded(engine, configuration, speed)
            for name, speed in SPEEDS.items()
            if strength != "free" or name != "fast-forward"
        }
    return found


def measure(
    engines: dict[str, Engine], queries: list[Query], configuration: Configuration
) -> list[Figures]:
    """Answer every query in every way."""
    all_ways = ways(engines, configuration)
    for way in all_ways.values():
        way(queries[0])
    answers: dict[tuple[str, str], list[Answer]] = {name: [] for name in all_ways}
    for query in queries:
        for name, way in all_ways.items():
            answers[name].append(way(query))
    return [figures(queries[0].level, configuration.strength, name, answers) for name in all_ways]


def figures(
    level: Level,
    strength: Strength,
    name: tuple[str, str],
    answers: dict[tuple[str, str], list[Answer]],
) -> Figures:
    """The figures of one way among all."""
    (form, way), slow = name, next(iter(SPEEDS))
    ours, plain = answers[name], answers["model.generate", "plain"]
    generate = (
        "model.generate",
        ("plain" if strength == "free" or way == "plain" else "logits processor"),
    )
    own = (form, slow) if form == "ours, lean" and way != slow else generate

    def mean(part: str, found: list[Answer]) -> float:
        return statistics.fmean(getattr(answer, part) for answer in found)

    def ratio(part: str) -> float:
        return mean(part, ours) / mean("tokens", ours) * mean("tokens", plain) / mean(part, plain)

    return Figures(
        level,
        strength,
        form,
        way,
        len(ours),
        sum(one.text == other.text for one, other in zip(ours, answers[own], strict=True)),
        mean("tokens", ours),
        mean("passes", ours),
        statistics.median(answer.seconds for answer in ours),
        statistics.median(answer.cpu_seconds for answer in ours),
        ratio("passes"),
        ratio("cpu_seconds"),
    )


def records(level: Level, vocabulary: Vocabulary, count: int, seed: int) -> list[dict[str, Any]]:
    """Curated commands, or sampled tasks."""
    if level == "task":
        return list(sample_tasks(vocabulary, seed, count, "validation"))
    return read_jsonl(COMMANDS)[:count]


def table(rows: list[Figures]) -> str:
    """A Markdown table."""
    heads = (
        "level",
        "strength",
        "",
        "",
        "tokens",
        "passes",
        "passes a token",
        "median s",
        "CPU s",
        "CPU a token",
        "same",
    )
    lines = [f"| {' | '.join(heads)} |", "|---|---|---|---|" + "---:|" * (len(heads) - 4)]
    for row in rows:
        lines.append(
            f"| {row.level} | {row.strength} | {row.form} | {row.way} | {row.tokens:.1f} |"
            f" {row.passes:.1f} | {row.passes_ratio:.2f} | {row.seconds:.3f} |"
            f" {row.cpu_seconds:.3f} | {row.cpu_ratio:.2f} | {row.same}/{row.queries} |"
        )
    return "\n".join(lines)


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--candidate", default="embedded", help="name or folder, a stand-in too")
    parser.add_argument(
        "--adapters",
        nargs="*",
        default=[],
        metavar="LEVEL=DIR",
        help="decode with these adapters, not as base",
    )
    parser.add_argument("--levels", default="mission,task")
    parser.add_argument("--strengths", default=",".join(STRENGTHS))
    parser.add_argument("--samples", type=int, default=25, help="queries per level")
    parser.add_argument("--max-new-tokens", type=int, default=None)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--out",
        type=Path,
        default=None,
        help="also write a JSON file with the figures and what they depend on",
    )
    return parser.parse_args()


def main() -> None:
    """Parse, measure and print."""
    options, vocabulary = arguments(), load_vocabulary()
    candidate = resolve_candidate(options.candidate)
    adapters: Any = {
        level: Path(folder)
        for level, _, folder in (text.partition("=") for text in options.adapters)
    }
    settings: dict[str, Any] = {
        "adapters": adapters,
        "max_new_tokens": options.max_new_tokens,
        "device": "cpu",
        "threads": decoding_threads(candidate, "cpu"),
    }
    loaded = {
        form: Engine.load(candidate, vocabulary, lean=lean, **settings)
        for form, lean in FORMS.items()
    }
    for engine in loaded.values():
        engine.second_look = False  # all ways give the same answer then
    engines = {form: engine for form, engine in loaded.items() if form == "ours" or engine.lean}
    rows: list[Figures] = []
    level: Any
    for level in options.levels.split(","):
        told = not adapters and not candidate.knows(vocabulary)
        queries = [
            engines["ours"].query(level, record, with_vocabulary=told)
            for record in records(level, vocabulary, options.samples, options.seed)
        ]
        strength: Any
        for strength in options.strengths.split(","):
            rows += measure(engines, queries, Configuration(level in adapters, strength))
            print(f"{level} {strength}: measured", flush=True)
    print(table(rows))
    if options.out:
        configuration = {
            name: str(value) if isinstance(value, Path) else value
            for name, value in vars(options).items()
        }
        manifest = build_manifest(
            "decoding",
            seed=options.seed,
            configuration=configuration,
            inputs={"commands": COMMANDS},
        )
        write_json(
            options.out,
            {
                "candidate": candidate.name,
                "standin": candidate.is_standin,
                "rows": [asdict(row) for row in rows],
                "manifest": manifest,
            },
        )


if __name__ == "__main__":
    main()
