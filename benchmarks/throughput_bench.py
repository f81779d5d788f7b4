"""Samples a second: our benchmark beside lm-evaluation-harness's Hugging Face backend, on the same
samples, prompts and settings.

    python benchmarks/throughput_bench.py --candidate embedded --batch-sizes 1,16 \
        --out benchmarks/results/throughput_bench_embedded.json
    python benchmarks/throughput_bench.py --candidate real-shape --with-vocabulary \
        --limit 8 --max-new-tokens 128 --batch-sizes 8

Needs lm-eval (pip install -e ".[peers]"). Both sides have the base weights in the compute dtype of
the machine, decode greedily with the same limit, and score every answer with the same functions;
they take turns in one process, after an uncounted round. Loading is not counted. `real-shape` is a
random model of Qwen2.5-0.5B's shape, whose answers all run to the limit.
"""

from __future__ import annotations

import argparse
import logging
import statistics
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from real_shape import make_real_shape
from side_by_side import Turn, rates, ratios, take_turns

from planner_ft.benchmark.samples import BenchData, load_bench_data
from planner_ft.benchmark.scoring import score_sample
from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.loading import compute_dtype, resolve_device
from planner_ft.decoding.configurations import Configuration
from planner_ft.decoding.engine import Engine, decoding_threads
from planner_ft.support.files import write_json
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary

ROOT = Path(__file__).resolve().parents[1]
TASK = "planner_mission_test"
Program = Callable[[], tuple[float, Any]]


def ours(engine: Engine, data: BenchData, *, with_vocabulary: bool, batch_size: int) -> Program:
    """Prompts, answers and scores as `plannerft bench` makes them."""

    def run() -> tuple[float, dict[str, Any]]:
        queries = [
            engine.query(data.level, sample.record, with_vocabulary=with_vocabulary)
            for sample in data.samples
        ]
        answers = dict(engine.answers(queries, Configuration(adapter=False), batch_size=batch_size))
        texts = [engine.text(answers[index]) for index in range(len(queries))]
        scores = [
            score_sample(data.level, sample, {"output": text}, engine.vocabulary).values
            for sample, text in zip(data.samples, texts, strict=True)
        ]
        tokens = sum(len(answer.ids) for answer in answers.values())
        return len(texts), {
            "texts": texts,
            "tokens": tokens,
            "f1": statistics.fmean(float(score["f1"] or 0) for score in scores),
        }

    return run


def theirs(
    model: Any, limit: int, tokens: int | None, *, with_vocabulary: bool, batch_size: int
) -> Program:
    """The harness on the same task (eval/lm_eval)."""
    from lm_eval import simple_evaluate
    from lm_eval.tasks import TaskManager

    manager = TaskManager(
        include_path=str(ROOT / "eval/lm_eval"),
        include_defaults=False,
        metadata={"with_vocabulary": with_vocabulary},
    )

    def run() -> tuple[float, dict[str, Any]]:
        model.batch_size_per_gpu = batch_size
        found = simple_evaluate(
            model=model,
            tasks=[TASK],
            task_manager=manager,
            apply_chat_template=True,
            limit=limit,
            bootstrap_iters=0,
            log_samples=True,
            gen_kwargs={"max_gen_toks": tokens} if tokens else None,
        )
        texts = [
            sample["filtered_resps"][0]
            for sample in sorted(found["samples"][TASK], key=lambda sample: sample["doc_id"])
        ]
        return len(texts), {"texts": texts, "f1": found["results"][TASK]["f1,none"]}

    return run


def compare(batch_size: int, turns: dict[str, list[Turn]]) -> dict[str, Any]:
    """The figures of one batch size."""
    one, other = turns["planner_ft"][-1].found, turns["lm-eval"][-1].found
    f1 = {"planner_ft": one["f1"], "lm-eval": other["f1"]}
    same = sum(a == b for a, b in zip(one["texts"], other["texts"], strict=True))
    return {
        "batch_size": batch_size,
        "samples": len(one["texts"]),
        "tokens": one["tokens"],
        "same_answers": same,
        "f1": f1,
        "samples_per_s": {name: rates(found) for name, found in turns.items()},
        "ratio": ratios(turns["planner_ft"], turns["lm-eval"]),
    }


def load(options: argparse.Namespace, candidate: Candidate) -> tuple[Engine, Any]:
    """The candidate on both sides, in one dtype and with one number of threads."""
    import torch
    from lm_eval.models.huggingface import HFLM

    threads = decoding_threads(candidate, "cpu") or torch.get_num_threads()
    torch.set_num_threads(threads)
    engine = Engine.load(
        candidate,
        load_vocabulary(),
        device="cpu",
        quantization="none",
        max_new_tokens=options.max_new_tokens,
        threads=threads,
    )
    dtype = str(compute_dtype(resolve_device("cpu"))).removeprefix("torch.")
    return engine, HFLM(pretrained=str(candidate.folder), dtype=dtype, device="cpu", batch_size=1)


def measure(options: argparse.Namespace, candidate: Candidate) -> dict[str, Any]:
    """Every batch size, side by side."""
    data = load_bench_data(
        ROOT / "data/mission/test.jsonl", "mission", load_vocabulary(), options.limit
    )
    engine, model = load(options, candidate)
    told = {"with_vocabulary": options.with_vocabulary}
    prompt = [len(engine.query("mission", sample.record, **told).prompt) for sample in data.samples]
    rows = []
    for batch_size in options.batch_sizes:
        programs = {
            "planner_ft": ours(engine, data, batch_size=batch_size, **told),
            "lm-eval": theirs(
                model, len(data.samples), options.max_new_tokens, batch_size=batch_size, **told
            ),
        }
        print(f"batch size {batch_size}", flush=True)
        rows.append(
            compare(
                batch_size,
                take_turns(programs, options.rounds, lambda text: print(f"  {text}", flush=True)),
            )
        )
    return {
        "candidate": candidate.name,
        "parameters": engine_parameters(model),
        "prompt_tokens": statistics.fmean(prompt),
        "rows": rows,
    }


def engine_parameters(model: Any) -> int:
    """Weights of the model."""
    return sum(parameter.numel() for parameter in model.model.parameters())


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--candidate", default="embedded", help="name or folder, or real-shape")
    parser.add_argument("--with-vocabulary", action="store_true", help="the prompt of a base model")
    parser.add_argument("--limit", type=int, default=25)
    parser.add_argument("--max-new-tokens", type=int, default=None)
    parser.add_argument(
        "--batch-sizes", type=lambda text: [int(part) for part in text.split(",")], default=[1, 16]
    )
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--out", type=Path, default=None)
    return parser.parse_args()


def main() -> None:
    """Parse, measure, print and record."""
    import importlib.metadata

    options = arguments()
    logging.getLogger("lm_eval").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory() as temporary:
        real = options.candidate == "real-shape"
        candidate = resolve_candidate(
            make_real_shape(Path(temporary)) if real else options.candidate
        )
        found = measure(options, candidate)
    for row in found["rows"]:
        both = ", ".join(
            f"{name} {figures['per_cpu_second']:.2f}"
            for name, figures in row["samples_per_s"].items()
        )
        print(
            f"batch {row['batch_size']}: samples a CPU second: {both}; ratio"
            f" {row['ratio']['by_cpu']:.2f} by CPU, {row['ratio']['by_clock']:.2f} by clock"
        )
    if options.out:
        configuration = {
            name: str(value) if isinstance(value, Path) else value
            for name, value in vars(options).items()
        }
        manifest = build_manifest(
            "throughput",
            seed=0,
            configuration=configuration,
            inputs={"data": "data/mission/test.jsonl"},
        )
        manifest["versions"]["lm-eval"] = importlib.metadata.version("lm-eval")
        write_json(options.out, {**found, "manifest": manifest})


if __name__ == "__main__":
    main()
