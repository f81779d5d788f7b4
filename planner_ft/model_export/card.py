"""README.md of an exported model, in the Hub's format."""

from __future__ import annotations

import json
from typing import Any

LICENCES = {"Apache-2.0": "apache-2.0"}


def model_card(manifest: dict[str, Any]) -> str:
    """The card of the export that a manifest describes."""
    base, adapter, check = manifest["base"], manifest["adapter"], manifest["check"]
    agent = "Mission Agent" if manifest["level"] == "mission" else "Task Agent"
    parts = [
        _front_matter(manifest),
        (
            f"# {agent} on {base['name']}, merged"
            if adapter
            else f"# {base['name']}, in full precision"
        ),
        (
            "> **Stand-in.** A tiny, randomly initialised model with the architecture of the"
            " candidate, good for tests alone."
            if base["standin"]
            else ""
        ),
        _what(manifest),
        (
            f"Greedy answers to {check['commands']} commands are the same before and after"
            f" ({check['same_answers']} of {check['commands']}, float32); logits along them differ"
            f" by at most {check['largest_logit_difference']:.2g}."
        ),
        "## Use",
        (
            f"`plannerft bench --level {manifest['level']} --candidates THIS_FOLDER"
            " --configurations base --quantization none`, or any program that loads transformers"
            " folders. Prompts are the chat template over the system instruction and the command"
            " (`planner_ft.prompts`)."
        ),
        *(
            [
                f"`{manifest['gguf']['file']}` is the same model for llama.cpp (matrices in"
                f" {manifest['gguf']['outtype']})."
            ]
            if manifest.get("gguf")
            else []
        ),
        "`manifest.json` holds the digests of base, adapter and files, the check and the versions.",
    ]
    return "\n\n".join(part for part in parts if part) + "\n"


def _what(manifest: dict[str, Any]) -> str:
    adapter = manifest["adapter"]
    if not adapter:
        return "The candidate's weights in float32, as they are."
    note = (
        " The adapter was trained on a base in 4-bit NF4; here the base is in full precision, so"
        " answers can differ from those of base and adapter."
        if adapter["trained_on"] == "nf4"
        else ""
    )
    return (
        f"The LoRA adapter of the {manifest['level']} level folded into the base, in float32, for"
        f" the vocabulary `{manifest['vocabulary']['name']}`.{note}"
    )


def _front_matter(manifest: dict[str, Any]) -> str:
    licence, repo = manifest["licence"], manifest["base"]["repo"]
    known = LICENCES.get(licence)
    lines = [
        *([f"base_model: {repo}"] if repo else []),
        "library_name: transformers",
        "pipeline_tag: text-generation",
        f"license: {known or 'other'}",
        *([] if known else [f"license_name: {json.dumps(licence)}"]),
        "tags: [mission-planning, usv, planner_ft]",
    ]
    return "\n".join(["---", *lines, "---"])
