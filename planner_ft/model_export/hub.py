"""Adapters and data sets on the Hugging Face Hub: which files go there, their card, the upload."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

from planner_ft.candidates.adapters import CONFIG, MANIFEST, WEIGHTS
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_text, sha256_file

Kind = Literal["model", "dataset"]

CARD = "README.md"
BESIDE = (
    *("tokenizer_config.json", "special_tokens_map.json", "added_tokens.json", "vocab.json"),
    *("chat_template.jinja", "merges.txt", "generation_config.json", "loss.png", "loss.svg"),
    "confidence-*.json",
)
"""What an adapter is loaded and judged with, beside the files whose digests its manifest has."""
REQUIRED = {
    "model": ("library_name", "pipeline_tag", "license", "tags"),
    "dataset": ("license", "task_categories", "language", "configs"),
}


@dataclass(frozen=True)
class Upload:
    """Files of `folder` for a repository; `card` is the text that goes there as README.md."""

    folder: Path
    repo: str
    kind: Kind
    card: str
    files: tuple[str, ...]
    notes: tuple[str, ...]

    @property
    def page(self) -> str:
        return f"https://huggingface.co/{'datasets/' if self.kind == 'dataset' else ''}{self.repo}"

    def sizes(self) -> Iterator[tuple[str, int]]:
        for name in self.files:
            whole = len(self.card.encode()) if name == CARD else None
            yield name, whole or (self.folder / name).stat().st_size


def prepare(folder: Path, repo: str, dataset: str | None = None) -> Upload:
    """What `folder`, written by train or gen-data, uploads into `repo`; needs no network.

    `dataset` is the repository of an adapter's training data, which its card names. Raises
    PlannerError for other folders, stand-ins, files that changed since, and cards without metadata.
    """
    for name in filter(None, (repo, dataset)):
        _check_name(name)
    file = folder / MANIFEST
    manifest = read_json(file) if file.is_file() else None
    kind = manifest.get("kind") if isinstance(manifest, dict) else None
    if not isinstance(manifest, dict) or kind not in ("train", "data"):
        way_out = "name the folder of an adapter (adapters/CANDIDATE/LEVEL) or a data set"
        raise PlannerError(f"{folder}: was not written by train or gen-data; {way_out}")
    if manifest.get("is_standin"):
        why = "its base is a stand-in with random weights: it is good for tests alone"
        raise PlannerError(f"{folder}: is not uploaded; {why}")
    adapter = kind == "train"
    if dataset and not adapter:
        raise PlannerError(f"--dataset {dataset}: {folder} is a data set itself; leave it out")
    recorded: dict[str, str] = manifest["outputs"]
    for name in (*((CONFIG, WEIGHTS) if adapter else ()), CARD, *recorded):
        _check_file(folder / name, None if name == CARD else recorded.get(name))
    beside = [path.name for pattern in BESIDE for path in folder.glob(pattern)] if adapter else []
    files = sorted({CARD, MANIFEST, *recorded, *beside})
    notes = tuple(_notes(manifest, repo, dataset)) if adapter else ()
    hub: Kind = "model" if adapter else "dataset"
    return Upload(folder, repo, hub, _card(folder / CARD, hub, dataset), tuple(files), notes)


def upload(prepared: Upload, *, private: bool) -> str:
    """Make the repository where it is not there, and add the files in one commit; its address.

    Raises PlannerError without a token or a network, and with the Hub's words where it refuses.
    """
    from huggingface_hub import CommitOperationAdd, HfApi, get_token
    from huggingface_hub.errors import HfHubHTTPError, OfflineModeIsEnabled

    token = get_token()
    if token is None:
        raise PlannerError("no access token of the Hub: run `hf auth login`, or set HF_TOKEN")
    api, repo, kind = HfApi(token=token), prepared.repo, prepared.kind
    sources = [
        (n, prepared.card.encode() if n == CARD else prepared.folder / n) for n in prepared.files
    ]
    operations = [CommitOperationAdd(name, source) for name, source in sources]
    message = f"{prepared.folder.name}, made with planner_ft"
    try:
        api.create_repo(repo, repo_type=kind, private=private or None, exist_ok=True)
        done = api.create_commit(repo, operations, commit_message=message, repo_type=kind)
    except OfflineModeIsEnabled:
        raise PlannerError("HF_HUB_OFFLINE is set: unset it, or look with --dry-run") from None
    except HfHubHTTPError as error:
        reason = error.server_message or str(error).splitlines()[0]
        raise PlannerError(f"{repo}: the Hub refuses the upload ({reason})") from None
    except Exception as error:  # its transports raise kinds of their own, by its version
        raise PlannerError(f"{repo}: the upload failed ({error})") from error
    return str(done.commit_url)


def _check_name(name: str) -> None:
    from huggingface_hub.errors import HFValidationError
    from huggingface_hub.utils import validate_repo_id

    try:
        validate_repo_id(name)
    except HFValidationError as error:
        raise PlannerError(f"{name}: no name of a repository (ORG/NAME): {error}") from None


def _check_file(path: Path, digest: str | None) -> None:
    if not path.is_file():
        raise PlannerError(f"{path}: is missing; write the folder again")
    if digest is not None and sha256_file(path) != digest:
        changed = f"differs from what {MANIFEST} recorded"
        raise PlannerError(f"{path}: {changed}; write the folder again with --overwrite")


def _card(path: Path, kind: str, dataset: str | None) -> str:
    """The card with the metadata that the Hub expects, and the training data's repository."""
    import yaml
    from huggingface_hub import DatasetCard, ModelCard

    try:
        card = (ModelCard if kind == "model" else DatasetCard)(read_text(path))
    except (ValueError, yaml.YAMLError) as error:
        problem = " ".join(str(error).split())
        raise PlannerError(f"{path}: its metadata cannot be read ({problem})") from None
    lacking = [key for key in REQUIRED[kind] if not card.data.get(key)]
    if lacking:
        raise PlannerError(f"{path}: its metadata lacks {', '.join(lacking)}; add them at the top")
    if dataset is None:
        return read_text(path)
    card.data.datasets = [dataset]
    return str(card)


def _notes(manifest: dict[str, Any], repo: str, dataset: str | None) -> Iterator[str]:
    """What its users will lack, and what the licence of the base asks for."""
    base, licence = manifest["base"], manifest["licence"]
    if not base["repo"]:
        ships = "comes with planner_ft" if base["name"] == "embedded" else "is nowhere on the Hub"
        yield f"the base {base['name']} {ships}: without it the adapter cannot be loaded"
    if licence.startswith("Llama") and not repo.split("/")[-1].startswith("Llama"):
        yield f"the {licence} asks that the model's name begins with Llama"
    if dataset is None:
        yield "the card names no training data; --dataset ORG/NAME adds it once it is on the Hub"
