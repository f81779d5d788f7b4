"""Adapter folders: where they lie, what is recorded about the base they belong to, and the checks
before one is loaded.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.candidates.location import PICKLED, check_safetensors, weights_sha256
from planner_ft.candidates.registry import Candidate, Dimensions
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

CONFIG, WEIGHTS, MANIFEST = "adapter_config.json", "adapter_model.safetensors", "manifest.json"
ADAPTERS = Path("adapters")
"""Where `plannerft train` writes adapters: ADAPTERS/CANDIDATE/LEVEL."""
PACKAGE = Path(planner_ft.__file__).resolve().parent
SHIPPED = Path("candidates") / "shipped_adapters"
"""Where a wheel carries the embedded candidate's (tool.hatch.build.targets.wheel.force-include)."""


@dataclass(frozen=True)
class AdapterInfo:
    """What an adapter folder says about itself; fields are None where it has no manifest of
    ours.
    """

    folder: Path
    rank: int
    level: Level | None
    candidate: str | None
    vocabulary: str | None


def adapter_folder(candidate: Candidate, level: Level, root: Path = ADAPTERS) -> Path:
    """The folder of an adapter below `root`."""
    return root / candidate.slug / level


def find_adapter(
    candidate: Candidate, level: Level, vocabulary: Vocabulary | None = None
) -> Path | None:
    """The adapter that a candidate has without one being named: in ./adapters, else in the checkout
    that we run from, else in the package.

    None where there is none. With `vocabulary`, an adapter that was trained with another one is
    passed over.
    """
    checkout = PACKAGE.parent if (PACKAGE.parent / "pyproject.toml").is_file() else None
    for root in (ADAPTERS, *([checkout / ADAPTERS] if checkout else []), PACKAGE / SHIPPED):
        folder = adapter_folder(candidate, level, root)
        if (folder / CONFIG).is_file() and (
            vocabulary is None or _trained_with(folder, vocabulary)
        ):
            return folder
    return None


def _trained_with(folder: Path, vocabulary: Vocabulary) -> bool:
    return _manifest(folder).get("vocabulary", {}).get("sha256") in (None, vocabulary.sha256)


def adapter_record(candidate: Candidate, level: Level, vocabulary: Vocabulary) -> dict[str, Any]:
    """The manifest fields that tie an adapter to its base, level and vocabulary; `check_adapter`
    reads them.
    """
    return {
        "base": {
            "name": candidate.name,
            "repo": candidate.repo,
            "revision": candidate_revision(candidate),
            "standin": candidate.is_standin,
            "weights_sha256": weights_sha256(candidate.folder) if candidate.folder else None,
        },
        "level": level,
        "vocabulary": {"name": vocabulary.name, "sha256": vocabulary.sha256},
    }


def candidate_revision(candidate: Candidate) -> str | None:
    """The commit of a model in the hub cache, else the revision that was asked for."""
    return (
        candidate.folder.name
        if candidate.folder and candidate.source == "hub cache"
        else candidate.revision
    )


def check_adapter(
    folder: Path | str,
    candidate: Candidate,
    *,
    level: Level | None = None,
    vocabulary: Vocabulary | None = None,
) -> AdapterInfo:
    """Check that a PEFT adapter folder is complete, safe and made for this candidate (and level and
    vocabulary, if given).

    Raises PlannerError in one sentence. Reads no weights but their shapes.
    """
    folder = Path(folder)
    if not folder.is_dir():
        raise PlannerError(
            f"{folder}: no such adapter folder; train one with `plannerft train --candidate"
            f" {candidate.name}`"
        )
    config = _config(folder)
    shapes = check_safetensors(_weights(folder))
    manifest = _manifest(folder)
    base, trained_with = manifest.get("base", {}), manifest.get("vocabulary", {})
    if base:
        _check_base(folder, base, candidate)
    else:
        _check_reference(folder, config.get("base_model_name_or_path"), candidate)
    _check_shapes(folder, shapes, candidate.dimensions)
    info = AdapterInfo(
        folder, int(config["r"]), manifest.get("level"), base.get("name"), trained_with.get("name")
    )
    if level and info.level not in (None, level):
        raise PlannerError(
            f"{folder}: this is an adapter of the {info.level} level, not of the {level} level;"
            f" give --level {info.level} or another --adapter"
        )
    if vocabulary and trained_with:
        _check_vocabulary(folder, trained_with, vocabulary)
    return info


def _manifest(folder: Path) -> dict[str, Any]:
    """Our manifest; empty for an adapter that another program has saved."""
    if not (folder / MANIFEST).is_file():
        return {}
    manifest = read_json(folder / MANIFEST)
    if not isinstance(manifest, dict) or not all(
        isinstance(manifest.get(key, {}), dict) for key in ("base", "vocabulary")
    ):
        raise PlannerError(
            f"{folder / MANIFEST}: no manifest of an adapter; restore it, or remove it to load the"
            " folder as a plain PEFT adapter"
        )
    return manifest


def _config(folder: Path) -> dict[str, Any]:
    if not (folder / CONFIG).is_file():
        raise PlannerError(
            f"{folder}: no {CONFIG}; an adapter is a PEFT folder as `plannerft train` writes it"
        )
    config = read_json(folder / CONFIG)
    if (
        not isinstance(config, dict)
        or config.get("peft_type") != "LORA"
        or not isinstance(config.get("r"), int)
    ):
        raise PlannerError(
            f"{folder / CONFIG}: peft_type LORA and a whole number r are expected; this is no LoRA"
            " adapter"
        )
    return config


def _weights(folder: Path) -> Path:
    if (folder / WEIGHTS).is_file():
        return folder / WEIGHTS
    pickled = sorted(path.name for pattern in PICKLED for path in folder.glob(pattern))
    if pickled:
        raise PlannerError(
            f"{folder / pickled[0]}: pickled weights are never loaded because they can run code;"
            " save the adapter as safetensors"
        )
    raise PlannerError(
        f"{folder}: no {WEIGHTS}; the training that writes it has not finished, or the folder is"
        " another one"
    )


def _check_base(folder: Path, base: dict[str, Any], candidate: Candidate) -> None:
    """Compare the base that our manifest records."""
    trained = f"{base.get('name')}{' (stand-in)' if base.get('standin') else ''}"
    here = f"{candidate.name}{' (stand-in)' if candidate.is_standin else ''}"
    if trained != here:
        raise PlannerError(
            f"{folder}: this adapter was trained on {trained} and does not fit {here}; give"
            f" --candidate {base.get('name')} or another --adapter"
        )
    if candidate.folder and base.get("weights_sha256") not in (
        None,
        weights_sha256(candidate.folder),
    ):
        raise PlannerError(
            f"{folder}: this adapter was trained on other weights of {candidate.name} than those in"
            f" {candidate.folder}; train it again"
        )


def _check_reference(folder: Path, reference: str | None, candidate: Candidate) -> None:
    """Compare the base that a plain PEFT adapter names: a hub id or a path."""
    if not reference:
        return
    known = {
        text.lower()
        for text in (
            candidate.name,
            candidate.repo,
            candidate.repo and candidate.repo.split("/")[-1],
            str(candidate.folder),
        )
        if text
    }
    in_cache = (candidate.repo or "\0").replace("/", "--").lower()
    if (
        reference.lower() not in known
        and Path(reference).name.lower() not in known
        and f"models--{in_cache}/" not in reference.lower()
    ):
        raise PlannerError(
            f"{folder}: this adapter was trained on {reference}, not on {candidate.name}; give that"
            " base with --candidate, or another --adapter"
        )


def _check_shapes(
    folder: Path, shapes: dict[str, tuple[int, ...]], dimensions: Dimensions | None
) -> None:
    """Every LoRA pair must fit the layer that it is named after."""
    if not any(".lora_A." in name for name in shapes):
        raise PlannerError(f"{folder / WEIGHTS}: holds no LoRA matrices; this is no LoRA adapter")
    if dimensions is None:
        return
    names = ("q_proj", "k_proj", "v_proj", "o_proj", "gate_proj", "up_proj", "down_proj")
    for name, shape in shapes.items():
        layer = next((index for index, part in enumerate(names) if f".{part}.lora_" in name), None)
        if layer is None:
            continue
        rows, columns = dimensions.linear_shapes[layer]
        fits = shape[-1] == rows if ".lora_A." in name else shape[0] == columns
        block = next((int(part) for part in name.split(".") if part.isdigit()), 0)
        if not fits or block >= dimensions.layers:
            raise PlannerError(
                f"{folder / WEIGHTS}: {name} of shape {list(shape)} does not fit the base model;"
                " the adapter belongs to another base"
            )


def _check_vocabulary(folder: Path, recorded: dict[str, Any], vocabulary: Vocabulary) -> None:
    if recorded.get("sha256") == vocabulary.sha256:
        return
    same = recorded.get("name") == vocabulary.name
    other = (
        f"another version of the vocabulary {vocabulary.name}"
        if same
        else f"the vocabulary {recorded.get('name')}, not {vocabulary.name}"
    )
    raise PlannerError(
        f"{folder}: this adapter was trained with {other}; give that one with --vocabulary, or"
        " train again"
    )
