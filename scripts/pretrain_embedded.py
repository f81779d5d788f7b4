"""Make the embedded candidate again: tokenizer, corpus, pretraining, export.

    python scripts/pretrain_embedded.py --work /tmp/embedded --tokens 30000000
    python scripts/pretrain_embedded.py --work /tmp/embedded --export planner_ft/candidates/embedded

The first command can be killed and started again at any time. The second writes the newest
checkpoint as a model folder. On a GPU: --width 1024 --batch-tokens 32768 --workers 14, and
--seconds to end after a time.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
from pathlib import Path
from typing import Any

from planner_ft.pretraining.corpus import Mixture
from planner_ft.pretraining.grids import Job, grids_of, shards_of
from planner_ft.pretraining.loop import PretrainSettings
from planner_ft.support.files import write_json
from planner_ft.vocabulary import load_vocabulary


def tokenizer_of(work: Path, arguments: argparse.Namespace) -> Any:
    """The tokenizer in `work`, trained first where there is none."""
    from transformers import PreTrainedTokenizerFast

    from planner_ft.pretraining.corpus import tokenizer_texts
    from planner_ft.pretraining.tokenizer import train_tokenizer

    folder = work / "tokenizer"
    if not (folder / "tokenizer.json").is_file():
        if arguments.init:
            PreTrainedTokenizerFast.from_pretrained(arguments.init).save_pretrained(folder)
            return PreTrainedTokenizerFast.from_pretrained(folder)
        vocabulary = load_vocabulary()
        texts = tokenizer_texts(
            vocabulary, 999, arguments.tokenizer_samples, arguments.mission_share
        )
        train_tokenizer(texts, vocabulary, size=arguments.vocabulary_size).save_pretrained(folder)
    return PreTrainedTokenizerFast.from_pretrained(folder)


def mixture_of(arguments: argparse.Namespace) -> Mixture:
    """What the command line says of the samples."""
    return Mixture(
        arguments.mission_share,
        arguments.drill_share,
        arguments.unfamiliar_share,
        arguments.vehicle_share,
        arguments.vehicles,
        arguments.packs,
        arguments.own_share,
        arguments.written_share,
        tuple(arguments.commands),
        emphasis=arguments.emphasis,
        subjects=tuple(arguments.subjects),
        prompts=tuple(arguments.prompts),
    )


def jobs_of(arguments: argparse.Namespace, settings: PretrainSettings) -> list[Job]:
    """The shards of the corpus as arguments of `make_shard`."""
    work, mixture = arguments.work, mixture_of(arguments)
    drawn = (arguments.shard_samples, settings.longest, mixture)
    paths = (work / "corpus" / f"shard-{index:03d}.npz" for index in range(arguments.shards))
    return [
        (path, work / "tokenizer", arguments.corpus_seed + index, *drawn)
        for index, path in enumerate(paths)
    ]


def initialise(model: Any, init: Path) -> None:
    """Take the weights of the model folder `init`, for a further stage of pretraining; a model of
    more layers begins as that one.
    """
    from transformers import LlamaForCausalLM

    from planner_ft.pretraining.model import deepened

    weights = LlamaForCausalLM.from_pretrained(init, dtype=model.dtype).state_dict()
    try:
        model.load_state_dict(deepened(weights, model.config.num_hidden_layers))
    except ValueError as error:
        raise SystemExit(f"--layers: {error}") from None


def earlier_stages(init: Path | None) -> list[dict[str, Any]]:
    """What `init` records of its own pretraining, first stage first."""
    if init is None:
        return []
    record = json.loads((init / "pretraining.json").read_text())
    return [*record.pop("earlier_stages", []), record]


def export(
    model: Any, tokenizer: Any, settings: PretrainSettings, arguments: argparse.Namespace
) -> None:
    """Write the newest checkpoint as a bf16 model folder, averaged with the weights of `--init` or
    `--average-with` where `--init-share` asks for it.
    """
    import torch

    saved = torch.load(arguments.work / "checkpoint.pt", weights_only=True)
    weights, share, other = (
        saved["model"],
        arguments.init_share,
        arguments.average_with or arguments.init,
    )
    if share:
        if not other:
            raise SystemExit(
                "--init-share needs --init: the model folder whose weights are averaged with the"
                " checkpoint's."
            )
        initialise(model, other)
        weights = {
            name: torch.lerp(weights[name].float(), value.float(), share)
            for name, value in model.state_dict().items()
        }
    model.load_state_dict(weights)
    model.to(torch.bfloat16).save_pretrained(arguments.export)
    tokenizer.save_pretrained(arguments.export)
    record = {
        "state": saved["state"],
        "settings": dataclasses.asdict(settings),
        "init_share": share,
        "corpus": corpus_summary(arguments.work),
    }
    if arguments.average_with:
        # Averaged with an earlier stage than the one that this began from: its number, as the
        # stages are listed.
        record["averaged_with_stage"] = len(earlier_stages(arguments.average_with))
    write_json(
        arguments.export / "pretraining.json",
        {**record, "earlier_stages": earlier_stages(arguments.init)},
    )


def corpus_summary(work: Path) -> dict[str, Any]:
    """Samples and tokens of the corpus in all, and the mixtures and commits of the generators that
    wrote it: shards may be replaced while a run goes on.
    """
    parts = [json.loads(path.read_text()) for path in sorted((work / "corpus").glob("*.json"))]
    sums = {
        key: sum(part.get(key, 0) for part in parts)
        for key in ("samples", "tokens", "left_out", "drills", "packs")
    }
    mixtures = [part["mixture"] for part in parts if "mixture" in part]
    return {
        **sums,
        "mixtures": [one for at, one in enumerate(mixtures) if one not in mixtures[:at]],
        "generators": sorted({part["commit"] for part in parts if part.get("commit")}),
    }


OPTIONS: dict[str, tuple[Any, str]] = {
    "shards": (20, ""),
    "shard-samples": (12_000, ""),
    "mission-share": (0.6, ""),
    "drill-share": (0.0, "samples of sums alone, the beginnings of task answers, per sample"),
    "unfamiliar-share": (0.0, "samples whose targets go by words that the generators do not have"),
    "vehicles": (
        Path("data/vehicles"),
        "folder of other vehicles, NAME/NAME.toml with command templates beside it",
    ),
    "vehicle-share": (0.0, "missions of those vehicles among all missions"),
    "packs": (
        0.0,
        "groups of samples with a renamed vehicle's vocabulary in their prompt, per sample",
    ),
    "own-share": (0.4, "packs of the surface vehicle under other names among the packs"),
    "written-share": (
        0.0,
        "packs of commands written by hand among the packs (--commands, NAME.written.jsonl)",
    ),
    "emphasis": (0.0, "missions that are drawn from the templates of --subjects alone"),
    "corpus-seed": (1000, ""),
    "workers": (2, "processes that draw the corpus"),
    "tokenizer-samples": (20_000, ""),
    "vocabulary-size": (4096, ""),
}
"""Default and help of the options of the corpus; shares are 0 to 1."""


def parsed() -> argparse.Namespace:
    """The command line."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    add = parser.add_argument
    add("--work", type=Path, required=True, help="folder for tokenizer, corpus, checkpoint and log")
    add("--export", type=Path, help="write the newest checkpoint as a model folder here and stop")
    add("--init", type=Path, help="model folder whose weights and tokenizer a stage starts from")
    add(
        "--init-share", type=float, default=0.0, help="share of the weights of --init in the export"
    )
    add("--average-with", type=Path, help="model folder that --init-share is about, not --init")
    add("--commands", nargs="*", type=Path, default=[], help="files of commands written by hand")
    add("--subjects", nargs="*", default=[], help="subjects of command templates, for --emphasis")
    add("--prompts", nargs="*", default=[], help="subjects of prompt templates, for --emphasis")
    add("--device", default="cuda", help="where grids (--width) are trained on")
    for name, (default, text) in OPTIONS.items():
        kind = Path if isinstance(default, Path) else type(default)
        add(f"--{name}", type=kind, default=default, help=text)
    for field in dataclasses.fields(PretrainSettings):
        kind = type(field.default)
        parser.add_argument(
            f"--{field.name.replace('_', '-')}",
            type=(lambda text: text == "true") if kind is bool else kind,
            default=field.default,
        )
    return parser.parse_args()


def main() -> None:
    """Run the step that the command line asks for."""
    arguments = parsed()
    settings = PretrainSettings(
        **{
            field.name: getattr(arguments, field.name)
            for field in dataclasses.fields(PretrainSettings)
        }
    )

    from planner_ft.pretraining.loop import new_model, pretrain

    tokenizer = tokenizer_of(arguments.work, arguments)
    special = {
        "bos": tokenizer.bos_token_id,
        "eos": tokenizer.eos_token_id,
        "pad": tokenizer.pad_token_id,
    }
    model: Any = new_model(settings, len(tokenizer), special)
    if arguments.export:
        export(model, tokenizer, settings, arguments)
        return
    if arguments.init:
        initialise(model, arguments.init)
    jobs, workers = jobs_of(arguments, settings), arguments.workers
    grids = grids_of(jobs, workers, settings.width, settings.seed) if settings.width else None
    shards = [] if grids else shards_of(jobs, workers)
    if grids:
        model.to(arguments.device)
    trained = pretrain(model, shards, settings, folder=arguments.work, grids=grids)
    print(trained, flush=True)


if __name__ == "__main__":
    main()
