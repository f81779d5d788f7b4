"""Adapter folders: where they lie, the record that ties one to its base, the checks at loading."""

import functools
from pathlib import Path
from typing import Any

import planner_ft
from planner_ft.candidates import location
from planner_ft.candidates.registry import Candidate, Dimensions
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, sha256_tree
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level

CONFIG, WEIGHTS, MANIFEST = "adapter_config.json", "adapter_model.safetensors", "manifest.json"
SEEN = "samples.txt"
"""Digests of the inputs of training and validation (`planner_ft.data.leakage.input_digest`)."""
ADAPTERS = Path("adapters")
"""Where `plannerft train` writes adapters: ADAPTERS/CANDIDATE/LEVEL."""
PACKAGE = Path(planner_ft.__file__).resolve().parent
SHIPPED = Path("candidates") / "shipped_adapters"
"""Where a wheel carries the embedded candidate's (tool.hatch.build.targets.wheel.force-include)."""
AGAIN = "copy the adapter again, or train it again"
LAYERS = ("q_proj", "k_proj", "v_proj", "o_proj", "gate_proj", "up_proj", "down_proj")


def adapter_folder(candidate: Candidate, level: Level, root: Path = ADAPTERS) -> Path:
    """The folder of an adapter below `root`."""
    return root / candidate.slug / level


def find_adapter(
    candidate: Candidate, level: Level, vocabulary: Vocabulary | None = None
) -> Path | None:
    """A candidate's adapter in ./adapters, our checkout or the package, or None; with `vocabulary`
    one that was trained with another is passed over.
    """
    checkout = PACKAGE.parent if (PACKAGE.parent / "pyproject.toml").is_file() else None
    for root in (ADAPTERS, *([checkout / ADAPTERS] if checkout else []), PACKAGE / SHIPPED):
        folder = adapter_folder(candidate, level, root)
        if not (folder / CONFIG).is_file():
            continue
        trained_with = _manifest(folder).get("vocabulary", {}).get("sha256")
        if vocabulary is None or trained_with in (None, vocabulary.sha256):
            return folder
    return None


def prompt_has_vocabulary(
    candidate: Candidate, vocabulary: Vocabulary, adapter: Path | None
) -> bool:
    """Whether a model is shown the vocabulary: without an adapter where it was not pretrained on
    it, with one where the adapter was trained so.
    """
    if adapter is None:
        return not candidate.knows(vocabulary)
    return bool(_manifest(adapter).get("configuration", {}).get("vocabulary_in_prompt"))


def seen_in_training(folder: Path) -> set[str]:
    """SHA-256 of an adapter's data files and the digests of their inputs, as far as it says."""
    inputs = _manifest(folder).get("inputs", {})
    files = {str(one.get("sha256")) for one in inputs.values() if isinstance(one, dict)}
    return files | set(read_text(folder / SEEN).split() if (folder / SEEN).is_file() else ())


def adapter_sha256(folder: Path) -> str:
    """One SHA-256 over an adapter's weights and configuration."""
    return sha256_tree(folder, (WEIGHTS, CONFIG))


def adapter_record(candidate: Candidate, level: Level, vocabulary: Vocabulary) -> dict[str, Any]:
    """The manifest fields that `check_adapter` compares: base, level and vocabulary."""
    folder = candidate.folder
    base = {
        "name": candidate.name,
        "repo": candidate.repo,
        "revision": candidate_revision(candidate),
        "standin": candidate.is_standin,
        "weights_sha256": location.weights_sha256(folder) if folder else None,
    }
    return {"base": base, "level": level, "vocabulary": vocabulary.named}


def candidate_revision(candidate: Candidate) -> str | None:
    """The commit of a model in the hub cache, else the revision that was asked for."""
    cached = candidate.folder and candidate.source == "hub cache"
    return candidate.folder.name if candidate.folder and cached else candidate.revision


def check_adapter(
    folder: Path,
    candidate: Candidate,
    level: Level | None = None,
    vocabulary: Vocabulary | None = None,
) -> None:
    """Check that a PEFT adapter folder is complete, safe and made for this candidate. Compares
    level and vocabulary too where they are given. Reads the weights once for a file that does not
    change. Raises PlannerError in one sentence.
    """
    if not folder.is_dir():
        command = f"`plannerft train --level {level or 'LEVEL'} --candidate {candidate.name}`"
        raise PlannerError(f"{folder}: no such adapter folder; train one with {command}")
    config, manifest = _config(folder), _manifest(folder)
    shapes = location.check_safetensors(location.safe_weights(folder, WEIGHTS))
    base, trained_with = manifest.get("base", {}), manifest.get("vocabulary", {})
    if base:
        _check_base(folder, base, candidate)
    else:
        _check_reference(folder, config.get("base_model_name_or_path"), candidate)
    _check_shapes(folder, shapes, candidate.dimensions)
    _check_content(folder, manifest.get("outputs", {}))
    its_level, name = manifest.get("level"), trained_with.get("name")
    if level and its_level not in (None, level):
        other = f"this is an adapter of the {its_level} level, not of the {level} level"
        raise PlannerError(f"{folder}: {other}; give --level {its_level} or another --adapter")
    if vocabulary and trained_with and trained_with.get("sha256") != vocabulary.sha256:
        other = f"the vocabulary {name}, not {vocabulary.name}"
        if name == vocabulary.name:
            other = f"another version of the vocabulary {name}"
        way = "give that one with --vocabulary, or train again"
        raise PlannerError(f"{folder}: this adapter was trained with {other}; {way}")


def _manifest(folder: Path) -> dict[str, Any]:
    """Our manifest; empty for an adapter that another program has saved."""
    if not (folder / MANIFEST).is_file():
        return {}
    manifest, parts = read_json(folder / MANIFEST), ("base", "vocabulary", "outputs", "inputs")
    if isinstance(manifest, dict) and all(isinstance(manifest.get(p, {}), dict) for p in parts):
        return manifest
    way = "restore it, or remove it to load the folder as a plain PEFT adapter"
    raise PlannerError(f"{folder / MANIFEST}: no manifest of an adapter; {way}")


def _check_content(folder: Path, digests: dict[str, str]) -> None:
    """Weights must be finite, and files those that the manifest's `outputs` name."""
    for path in (folder / WEIGHTS, folder / CONFIG):
        if digests.get(path.name) not in (None, location.file_sha256(path)):
            why = f"not the file that training wrote ({MANIFEST} has another digest)"
            raise PlannerError(f"{path}: {why}; {AGAIN}")
    status = (folder / WEIGHTS).stat()
    if name := _infinite_tensor(folder / WEIGHTS, status.st_size, status.st_mtime_ns):
        raise PlannerError(f"{folder / WEIGHTS}: {name} holds NaN or infinity; {AGAIN}")


@functools.lru_cache(maxsize=64)
def _infinite_tensor(path: Path, size: int, modified: int) -> str | None:
    """The first tensor of a safetensors file with a value that is not finite."""
    from safetensors.torch import load_file

    tensors: dict[str, Any] = load_file(path)
    return next((name for name, one in tensors.items() if not one.float().isfinite().all()), None)


def _config(folder: Path) -> dict[str, Any]:
    if not (folder / CONFIG).is_file():
        wanted = "an adapter is a PEFT folder as `plannerft train` writes it"
        raise PlannerError(f"{folder}: no {CONFIG}; {wanted}")
    config = read_json(folder / CONFIG)
    lora = isinstance(config, dict) and config.get("peft_type") == "LORA"
    if lora and isinstance(config.get("r"), int):
        return dict(config)
    wanted = "peft_type LORA and a whole number r are expected"
    raise PlannerError(f"{folder / CONFIG}: {wanted}; this is no LoRA adapter")


def _check_base(folder: Path, base: dict[str, Any], candidate: Candidate) -> None:
    """Compare the base in our manifest."""
    trained = f"{base.get('name')}{' (stand-in)' if base.get('standin') else ''}"
    here = f"{candidate.name}{' (stand-in)' if candidate.is_standin else ''}"
    if trained != here:
        way_out = f"give --candidate {base.get('name')} or another --adapter"
        other = f"this adapter was trained on {trained} and does not fit {here}"
        raise PlannerError(f"{folder}: {other}; {way_out}")
    recorded = base.get("weights_sha256")
    if candidate.folder and recorded not in (None, location.weights_sha256(candidate.folder)):
        other = f"other weights of {candidate.name} than those in {candidate.folder}"
        raise PlannerError(f"{folder}: this adapter was trained on {other}; train it again")


def _check_reference(folder: Path, reference: str | None, candidate: Candidate) -> None:
    """Compare the base that a plain PEFT adapter names: a hub id or a path."""
    if not reference:
        return
    repo = candidate.repo or ""
    names = (candidate.name, repo, repo.split("/")[-1], str(candidate.folder))
    known = {name.lower() for name in names if name}
    cached = repo and f"models--{repo.replace('/', '--')}/".lower() in reference.lower()
    if not cached and not known & {reference.lower(), Path(reference).name.lower()}:
        other = f"this adapter was trained on {reference}, not on {candidate.name}"
        way = "give that base with --candidate, or another --adapter"
        raise PlannerError(f"{folder}: {other}; {way}")


def _check_shapes(
    folder: Path, shapes: dict[str, tuple[int, ...]], dimensions: Dimensions | None
) -> None:
    """Every LoRA pair must fit the layer that it is named after."""
    if not any(".lora_A." in name for name in shapes):
        raise PlannerError(f"{folder / WEIGHTS}: holds no LoRA matrices; this is no LoRA adapter")
    sizes = dict(zip(LAYERS, dimensions.linear_shapes, strict=True)) if dimensions else {}
    for name, shape in shapes.items():
        layer = next((part for part in sizes if f".{part}.lora_" in name), None)
        if layer is None or dimensions is None:
            continue
        rows, columns = sizes[layer]
        fits = shape[-1] == rows if ".lora_A." in name else shape[0] == columns
        block = next((int(part) for part in name.split(".") if part.isdigit()), 0)
        if not fits or block >= dimensions.layers:
            why = f"{name} of shape {list(shape)} does not fit the base model"
            raise PlannerError(f"{folder / WEIGHTS}: {why}; the adapter belongs to another base")
