"""The model card of an adapter, in the Hub's format."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

LICENCES = {"Apache-2.0": "apache-2.0"}
"""Licences that the Hub knows by an identifier; others are named in full."""

USE = """```python
from peft import PeftModel
from transformers import AutoModelForCausalLM, AutoTokenizer

base = AutoModelForCausalLM.from_pretrained({reference})
model = PeftModel.from_pretrained(base, "THIS_FOLDER")
tokenizer = AutoTokenizer.from_pretrained("THIS_FOLDER")
```"""


def model_card(manifest: dict[str, Any]) -> str:
    """README.md of the adapter that a training manifest describes."""
    agent = "Mission Agent" if manifest["level"] == "mission" else "Task Agent"
    name = manifest["base"]["name"]
    parts = [
        _front_matter(manifest),
        f"# {agent} on {name}",
        _warning(manifest),
        (
            f"A LoRA adapter that turns {_task(manifest['level'])}, as JSON, for the vocabulary"
            f" `{manifest['vocabulary']['name']}`. Made with planner_ft; prompts are rendered by"
            " `planner_ft.prompts.render_prompt`, without the vocabulary."
        ),
        "## Use",
        (
            f"`plannerft bench --level {manifest['level']} --candidates {name} --adapter"
            " THIS_FOLDER`, or with plain PEFT:"
        ),
        USE.format(reference=json.dumps(manifest["base_reference"])),
        "## Training",
        _table(_training_rows(manifest)),
        *(f"- {text}" for text in manifest["departures"]),
        "![Loss curve](loss.png)",
        "## Limits",
        "\n".join(f"- {text}" for text in _limits(manifest)),
        (
            "`manifest.json` holds the whole configuration, data digests, versions and the losses"
            " of every epoch."
        ),
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _front_matter(manifest: dict[str, Any]) -> str:
    licence = manifest["licence"]
    known = LICENCES.get(licence)
    lines = [
        *([f"base_model: {manifest['base']['repo']}"] if manifest["base"]["repo"] else []),
        "library_name: peft",
        "pipeline_tag: text-generation",
        f"license: {known or 'other'}",
        *([] if known else [f"license_name: {json.dumps(licence)}"]),
        "tags: [lora, qlora, mission-planning, usv, planner_ft]",
    ]
    return "\n".join(["---", *lines, "---"])


def _warning(manifest: dict[str, Any]) -> str:
    if not manifest["is_standin"]:
        return ""
    return (
        "> **Stand-in.** The base is a tiny, randomly initialised model with the architecture of"
        " the candidate. This adapter is good for tests alone."
    )


def _task(level: str) -> str:
    return (
        "an operator's free-form command into an ordered list of tasks"
        if level == "mission"
        else "one task into steps of skills"
    )


def _training_rows(manifest: dict[str, Any]) -> list[tuple[str, Any]]:
    settings, result = manifest["configuration"], manifest["result"]
    validation = (
        f"{result['validation_loss']:.4f} (epoch {result['best_epoch']:g})"
        if result["validation_loss"] is not None
        else "none"
    )
    return [
        ("samples", ", ".join(f"{count} {role}" for role, count in manifest["samples"].items())),
        *(
            (f"{role} data", f"{Path(entry['path']).name}, SHA-256 {entry['sha256'][:12]}…")
            for role, entry in manifest.get("inputs", {}).items()
        ),
        ("epochs, steps", f"{result['epochs']:g}, {result['steps']}"),
        (
            "rank, alpha, dropout",
            f"{settings['rank']}, {settings['alpha']}, {settings['dropout']:g}",
        ),
        ("learning rate, schedule", f"{settings['learning_rate']:g}, {settings['schedule']}"),
        (
            "batch size, accumulation",
            f"{settings['batch_size']}, {settings['gradient_accumulation']}",
        ),
        (
            "base weights",
            "4-bit NF4, double quantisation" if settings["quantization"] == "nf4" else "16-bit",
        ),
        ("training loss, last epoch", f"{result['train_loss']:.4f}"),
        ("best validation loss", validation),
        ("time, device", f"{result['seconds']:.0f} s, {result['device']}"),
        ("seed", manifest["seed"]),
    ]


def _limits(manifest: dict[str, Any]) -> list[str]:
    name = manifest["vocabulary"]["name"]
    return [
        (
            f"It knows the vocabulary `{name}` alone (SHA-256"
            f" {manifest['vocabulary']['sha256'][:12]}…) and commands like those of its training,"
            " in English."
        ),
        (
            "A plan that is valid need not be right: tasks may be missing, swapped or added, and"
            " values lost. A person must approve each plan."
        ),
        (
            "A loss says nothing about plans; `plannerft bench` measures them and `plannerft report"
            " --card` writes the figures here."
        ),
    ]


def _table(rows: list[tuple[str, Any]]) -> str:
    return "\n".join(["| | |", "|---|---|", *(f"| {name} | {value} |" for name, value in rows)])
