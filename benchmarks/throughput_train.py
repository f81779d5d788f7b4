"""Tokens a second: our training beside TRL's SFTTrainer, on the same model, samples, order and
settings.

    python benchmarks/throughput_train.py --candidate embedded --steps 40 \
        --out benchmarks/results/throughput_train_embedded.json
    python benchmarks/throughput_train.py --candidate real-shape --steps 4 --batch-sizes 1

Needs TRL (pip install -e ".[peers]"). The settings are the published ones of the mission level
(rank 16, learning rate 2e-4, 4-bit base, batch size 1) and larger batches; both sides start from
the same adapter, without dropout, at a constant learning rate, in the compute dtype of the machine.
TRL runs as it pads, and without padding (padding_free). Counted are tokens of samples, padding
never. The programs take turns in one process, after an uncounted round; loading is not counted.
`real-shape` is a random model of Qwen2.5-0.5B's shape.
"""

from __future__ import annotations

import argparse
import io
import math
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parent))

from real_shape import make_real_shape
from side_by_side import Turn, rates, ratios, take_turns

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.loading import compute_dtype, load_model, load_tokenizer, resolve_device
from planner_ft.support.files import write_json
from planner_ft.support.manifest import build_manifest
from planner_ft.training.batches import epoch_steps
from planner_ft.training.checkpoint import Run
from planner_ft.training.loop import train_loop
from planner_ft.training.model import (
    adapter_tensors,
    attach_adapter,
    cpu_threads,
    set_adapter,
    unpack,
)
from planner_ft.training.report import Report, read_log
from planner_ft.training.samples import Sample, read_split
from planner_ft.training.settings import PUBLISHED, TrainSettings
from planner_ft.vocabulary import load_vocabulary

ROOT = Path(__file__).resolve().parents[1]
TRAIN = ROOT / "data/mission/train.jsonl"
Program = Callable[[], tuple[float, Any]]


def settings_of(options: argparse.Namespace, batch_size: int) -> TrainSettings:
    """The published settings, with what the comparison needs to be the same on both sides."""
    published = {
        **PUBLISHED["mission"],
        "batch_size": batch_size,
        "quantization": options.quantization,
    }
    return TrainSettings(
        **published,
        dropout=0.0,
        schedule="constant",
        warmup=0.0,
        max_steps=options.steps,
        checkpoint_minutes=1e6,
    )


class Side:
    """A model with its adapter, to be trained again and again from the same start."""

    def __init__(self, candidate: Candidate, settings: TrainSettings, *, ours: bool) -> None:
        base = load_model(
            candidate, device="cpu", quantization=settings.quantization, trainable=True
        )
        if ours:
            unpack(base)
        self.model = attach_adapter(base, settings, candidate.reference)
        self.start = {name: value.float() for name, value in adapter_tensors(self.model).items()}

    def reset(self) -> None:
        import torch

        torch.manual_seed(0)
        set_adapter(self.model, self.start)
        self.model.train()


def ours(
    side: Side, settings: TrainSettings, samples: list[Sample], pad: int, folder: Path
) -> Program:
    """The loop of `plannerft train`, its log and last checkpoint included."""
    from rich.console import Console

    device = resolve_device("cpu")

    def run() -> tuple[float, list[float]]:

        side.reset()
        output = Path(tempfile.mkdtemp(dir=folder))
        dtype = compute_dtype(device)
        job = Run(settings, side.model, samples, [], pad, device, dtype, output)
        job.report = Report(Console(file=io.StringIO()), output, settings, "throughput")
        train_loop(job)
        job.report.close()
        return job.state.tokens, [
            record["loss"] for record in read_log(output / "train_log.jsonl") if "loss" in record
        ]

    return run


def theirs(
    side: Side,
    settings: TrainSettings,
    samples: list[Sample],
    tokenizer: Any,
    folder: Path,
    *,
    padding_free: bool,
) -> Program:
    """SFTTrainer on the same samples in the same order."""
    from datasets import Dataset
    from transformers import TrainerCallback
    from trl import SFTTrainer

    order = ordered(samples, settings)
    rows = [{"input_ids": sample.rendered.input_ids, "labels": labels(sample)} for sample in order]

    class Losses(TrainerCallback):  # type: ignore[misc]
        def __init__(self) -> None:
            self.losses: list[float] = []

        def on_log(
            self, _arguments: Any, _state: Any, _control: Any, logs: dict[str, float], **_: Any
        ) -> None:
            self.losses += [logs["loss"]] if "loss" in logs else []

    def run() -> tuple[float, list[float]]:
        side.reset()
        seen = Losses()
        arguments = trl_settings(settings, folder, padding_free=padding_free)
        trainer = SFTTrainer(
            model=side.model,
            args=arguments,
            train_dataset=Dataset.from_list(rows),
            processing_class=tokenizer,
            callbacks=[seen],
        )
        trainer.train()
        return sum(sample.length for sample in order), seen.losses

    return run


def trl_settings(settings: TrainSettings, folder: Path, *, padding_free: bool) -> Any:
    """The SFTConfig of our settings."""
    import torch
    from trl import SFTConfig

    return SFTConfig(
        output_dir=tempfile.mkdtemp(dir=folder),
        max_steps=settings.max_steps or 0,
        per_device_train_batch_size=settings.batch_size,
        learning_rate=settings.learning_rate,
        lr_scheduler_type="constant",
        max_grad_norm=settings.gradient_clip,
        weight_decay=0.0,
        optim="adamw_torch",
        bf16=compute_dtype(resolve_device("cpu")) == torch.bfloat16,
        gradient_checkpointing=False,
        logging_steps=1,
        report_to="none",
        save_strategy="no",
        use_cpu=True,
        dataloader_pin_memory=False,
        max_length=None,
        train_sampling_strategy="sequential",
        disable_tqdm=True,
        padding_free=padding_free,
        dataset_kwargs={"skip_prepare_dataset": True},
        seed=0,
    )


def labels(sample: Sample) -> list[int]:
    """Ids where the sample is trained, -100 elsewhere."""
    return [
        token if kept else -100
        for token, kept in zip(
            sample.rendered.input_ids, sample.rendered.completion_mask, strict=True
        )
    ]


def ordered(samples: list[Sample], settings: TrainSettings) -> list[Sample]:
    """The samples as our loop takes them, up to the last step."""
    lengths = [sample.length for sample in samples]
    found: list[int] = []
    epoch = 0
    wanted = (settings.max_steps or 0) * settings.batch_size
    while len(found) < wanted:
        found += [
            index
            for step in epoch_steps(lengths, settings.batch_size, 1, settings.seed, epoch)
            for batch in step
            for index in batch
        ]
        epoch += 1
    return [samples[index] for index in found[:wanted]]


def compare(batch_size: int, turns: dict[str, list[Turn]]) -> dict[str, Any]:
    """The figures of one batch size; loss differences are the largest over all steps."""
    losses = {name: found[-1].found for name, found in turns.items()}
    own = losses["planner_ft"]
    differences = {
        name: max(abs(a - b) for a, b in zip(own, found, strict=True))
        for name, found in losses.items()
        if name != "planner_ft"
    }
    others = {
        name: ratios(turns["planner_ft"], found)
        for name, found in turns.items()
        if name != "planner_ft"
    }
    tokens_per_s = {name: rates(found) for name, found in turns.items()}
    return {
        "batch_size": batch_size,
        "tokens_per_s": tokens_per_s,
        "ratio": others,
        "largest_loss_difference": differences,
        "losses": losses,
    }


def measure(options: argparse.Namespace, candidate: Candidate, folder: Path) -> dict[str, Any]:
    """Every batch size, side by side."""
    import torch

    tokenizer, vocabulary = load_tokenizer(candidate), load_vocabulary()
    problems: list[str] = []
    split = read_split(TRAIN, "mission", vocabulary, problems)
    if split is None or problems:
        raise SystemExit("; ".join(problems))
    samples = split.rendered(tokenizer).samples
    rows = []
    for batch_size in options.batch_sizes:
        settings = settings_of(options, batch_size)
        torch.set_num_threads(cpu_threads(settings, candidate.parameters or 10**9))
        mine, other = Side(candidate, settings, ours=True), Side(candidate, settings, ours=False)
        # SFTTrainer takes a batch at a time: without the remainder of an epoch both sides have the
        # same batches.
        whole = samples[: len(samples) // batch_size * batch_size]
        programs = {
            "planner_ft": ours(mine, settings, whole, tokenizer.pad_token_id, folder),
            "trl": theirs(other, settings, whole, tokenizer, folder, padding_free=False),
        }
        if batch_size > 1:
            programs["trl padding_free"] = theirs(
                other, settings, whole, tokenizer, folder, padding_free=True
            )
        print(f"batch size {batch_size}", flush=True)
        rows.append(
            compare(
                batch_size,
                take_turns(programs, options.rounds, lambda text: print(f"  {text}", flush=True)),
            )
        )
    mean = math.fsum(sample.length for sample in samples) / len(samples)
    return {
        "candidate": candidate.name,
        "parameters": mine.model.num_parameters(),
        "sample_tokens": mean,
        "rows": rows,
    }


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--candidate", default="embedded", help="name or folder, or real-shape")
    parser.add_argument("--steps", type=int, default=40, help="optimiser steps of a turn")
    parser.add_argument(
        "--batch-sizes", type=lambda text: [int(part) for part in text.split(",")], default=[1, 8]
    )
    parser.add_argument("--quantization", choices=("nf4", "none"), default="nf4")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--out", type=Path, default=None)
    return parser.parse_args()


def main() -> None:
    """Parse, measure, print and record."""
    import importlib.metadata

    options = arguments()
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        candidate = resolve_candidate(
            make_real_shape(folder) if options.candidate == "real-shape" else options.candidate
        )
        found = measure(options, candidate, folder)
    for row in found["rows"]:
        for name, ratio in row["ratio"].items():
            mine, other = (
                row["tokens_per_s"][key]["per_cpu_second"] for key in ("planner_ft", name)
            )
            print(
                f"batch {row['batch_size']}: tokens a CPU second: planner_ft {mine:.0f}, {name}"
                f" {other:.0f}; ratio {ratio['by_cpu']:.2f} by CPU, {ratio['by_clock']:.2f} by"
                f" clock; largest loss difference {row['largest_loss_difference'][name]:.4f}"
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
            inputs={"data": TRAIN.relative_to(ROOT)},
        )
        manifest["versions"]["trl"] = importlib.metadata.version("trl")
        write_json(options.out, {**found, "manifest": manifest})


if __name__ == "__main__":
    main()
