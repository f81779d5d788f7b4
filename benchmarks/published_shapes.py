"""The seven published architectures at their real size, with random weights: memory, tokens a
second and latency of train and bench, beside the estimates of `plannerft candidates`.

    python benchmarks/published_shapes.py --work /tmp/shapes --out shapes.json      # on a GPU, 60 GB of disk
    python benchmarks/published_shapes.py --work /tmp/shapes --out shapes.json --candidates Llama-3.2-1B
    python benchmarks/published_shapes.py --work /tmp/shapes --out try.json --shrink  # tries the script

Weights decide what an answer says, not what it costs: random ones cost the same. Every answer runs
to its limit. One model lies on the disk at a time. `--shrink` makes each model tiny; its record
says so and is no measurement of anything.
"""

from __future__ import annotations

import argparse
import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from real_shape import random_model

from planner_ft.candidates import resolve_candidate
from planner_ft.candidates.costs import expected_times, memory_summary
from planner_ft.support.files import read_json, write_json
from planner_ft.support.manifest import build_manifest

NAMES = (
    *("Llama-3.2-1B", "Llama-3.2-1B-Instruct", "Llama-3.2-3B", "Llama-3.2-3B-Instruct"),
    *("Qwen2.5-3B", "Qwen2.5-3B-Instruct", "Llama-3.1-8B"),
)
SIZES = {
    "hidden_size": "hidden",
    "intermediate_size": "intermediate",
    "num_hidden_layers": "layers",
    "num_attention_heads": "heads",
    "num_key_value_heads": "kv_heads",
    "head_dim": "head_dim",
    "vocab_size": "vocabulary",
}
"""Keys of a config.json and the registry's names of them."""


def run(*words: str) -> None:
    """Run a command of planner_ft; stop with what it says when it fails."""
    subprocess.run([sys.executable, "-m", "planner_ft", *words], check=True)


def measure(name: str, options: argparse.Namespace) -> dict[str, Any]:
    """Both levels of training and the benchmark of a model of that name's shape."""
    candidate, work = resolve_candidate(name), options.work
    dimensions = candidate.dimensions
    assert dimensions is not None
    shape = {key: getattr(dimensions, field) for key, field in SIZES.items()}
    folder = random_model(name, work, {} if options.shrink else shape)
    row: dict[str, Any] = {"candidate": name, "estimates": estimates(name)}
    common = ("--device", options.device)
    try:
        for level in ("mission", "task"):
            out, data = work / f"{name}-{level}", work / "data" / level
            model = ("--level", level, *common)
            run(
                *("train", *model, "--candidate", str(folder), "--data-dir", str(data)),
                *("--output", str(out), "--overwrite", "--max-steps", str(options.steps)),
                *("--validation-answers", "0"),
            )
            result = read_json(out / "manifest.json")["result"]
            kept = ("tokens_per_s", "peak_memory_bytes", "seconds", "steps", "device")
            row[f"train_{level}"] = {key: result[key] for key in kept}
            run(
                *("bench", *model, "--candidates", str(folder), "--configurations", "lora"),
                *("--adapter", str(out), "--data", str(data / "test.jsonl"), "--limit", "4"),
                *("--latency-samples", "4", "--max-new-tokens", str(options.tokens)),
                *("--out", str(work / "bench"), "--overwrite", "--no-report"),
            )
            timed = (work / "bench" / "latency.jsonl").read_text().splitlines()
            row[f"bench_{level}"] = [
                {key: one[key] for key in ("latency_s", "tokens")} for one in map(json.loads, timed)
            ]
            shutil.rmtree(out)
    finally:
        shutil.rmtree(folder)
    return row


def estimates(name: str) -> dict[str, Any]:
    candidate = resolve_candidate(name)
    return {"memory": memory_summary(candidate), "times": expected_times(candidate)}


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--work", type=Path, required=True, help="folder for models and runs")
    parser.add_argument("--out", type=Path, required=True, help="JSON file for the record")
    parser.add_argument("--candidates", type=lambda text: text.split(","), default=NAMES)
    parser.add_argument("--steps", type=int, default=50, help="optimiser steps of a training")
    parser.add_argument("--tokens", type=int, default=256, help="tokens of an answer")
    parser.add_argument("--device", default="auto")
    parser.add_argument("--shrink", action="store_true", help="tiny models: tries the script")
    options = parser.parse_args()
    # By their paths: the candidates' own names mean real weights.
    counts = ("--train", "125", "--validation", "25", "--test", "25")
    run("gen-data", "--out", str(options.work / "data"), *counts, "--overwrite")
    rows, known = [], {key: str(value) for key, value in vars(options).items()}
    for name in options.candidates:
        rows.append(measure(name, options))
        manifest = build_manifest("published_shapes", seed=0, configuration=known)
        write_json(options.out, {"shrunk": options.shrink, "rows": rows, "manifest": manifest})


if __name__ == "__main__":
    main()
