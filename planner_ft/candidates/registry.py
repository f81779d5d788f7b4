"""The registry of candidates: the published ones, the embedded one, any local folder or hub id."""

from __future__ import annotations

import difflib
import functools
import re
import tomllib
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal

from planner_ft.candidates.location import Source, find_folder, read_config
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level

Chat = Literal["llama3", "chatml", "plain", "other"]
Quantization = Literal["nf4", "none"]

REGISTRY = Path(__file__).parent / "registry.toml"
HUB_ID = re.compile(r"(?P<repo>[A-Za-z0-9][\w.-]*/[A-Za-z0-9][\w.-]*)(@(?P<revision>[\w./-]+))?")
STANDIN_KEY = "planner_ft_standin"
"""Marks the config.json of a stand-in, so that its results never pass for the real candidate's."""
TAGS = {"peft": ("lora", "qlora"), "transformers": ()}
OTHERS = "a local folder (./folder) or a hub id"
VOCABULARY_KEY = "planner_ft_vocabulary"
"""In the config.json of an exported model: the bundled vocabulary that it has learned."""


@dataclass(frozen=True)
class Dimensions:
    """Sizes of a decoder-only transformer with grouped-query attention and a gated MLP."""

    hidden: int
    intermediate: int
    layers: int
    heads: int
    kv_heads: int
    head_dim: int
    vocabulary: int
    tied: bool
    context: int
    attention_bias: bool = False
    """Biases on the query, key and value projections (Qwen2)."""

    @classmethod
    def from_config(cls, config: dict[str, Any]) -> Dimensions | None:
        """The dimensions in a config.json; None for architectures without these fields."""
        try:
            heads, hidden = int(config["num_attention_heads"]), int(config["hidden_size"])
            bias = config.get("attention_bias", config.get("model_type") == "qwen2")
            return cls(
                hidden=hidden,
                intermediate=int(config["intermediate_size"]),
                layers=int(config["num_hidden_layers"]),
                heads=heads,
                kv_heads=int(config.get("num_key_value_heads") or heads),
                head_dim=int(config.get("head_dim") or hidden // heads),
                vocabulary=int(config["vocab_size"]),
                tied=bool(config.get("tie_word_embeddings", False)),
                context=int(config["max_position_embeddings"]),
                attention_bias=bool(bias),
            )
        except (KeyError, TypeError, ValueError, ZeroDivisionError):
            return None

    @property
    def linear_shapes(self) -> tuple[tuple[int, int], ...]:
        """(in, out) of a block's linear layers: query, key, value, output, gate, up, down."""
        query, key = self.heads * self.head_dim, self.kv_heads * self.head_dim
        wide = (self.hidden, self.intermediate)
        attention = ((self.hidden, query), (self.hidden, key), (self.hidden, key))
        return (*attention, (query, self.hidden), wide, wide, wide[::-1])

    @property
    def linear_parameters(self) -> int:
        """Weights of the blocks' linear layers, which 4-bit quantisation stores in 4 bits."""
        return self.layers * sum(rows * columns for rows, columns in self.linear_shapes)

    @property
    def other_parameters(self) -> int:
        """Weights that stay in 16 bits: embeddings, an untied output head, norms, biases."""
        biases = (self.heads + 2 * self.kv_heads) * self.head_dim if self.attention_bias else 0
        embeddings = self.vocabulary * self.hidden * (1 if self.tied else 2)
        return embeddings + self.layers * (2 * self.hidden + biases) + self.hidden

    @property
    def parameters(self) -> int:
        return self.linear_parameters + self.other_parameters


@dataclass(frozen=True)
class Candidate:
    """A language model that can be prompted, fine-tuned and benchmarked. `folder` is where it lies
    on this machine, None when it is not here. `vocabulary` names the vocabulary that it was
    pretrained on; for any other, the candidate named `reader` takes its place.
    """

    name: str
    repo: str | None = None
    revision: str | None = None
    published: str | None = None
    chat: Chat = "other"
    licence: str = "see its model card"
    gated: bool = False
    vocabulary: str | None = None
    reader: str | None = None
    dimensions: Dimensions | None = None
    adapter: dict[Level, dict[str, Any]] = field(default_factory=dict)
    folder: Path | None = None
    source: Source | None = None
    is_standin: bool = False
    merged: Level | None = None
    """The level whose adapter is folded in (`plannerft export --merge`)."""

    @property
    def parameters(self) -> int | None:
        """Number of weights; None where neither the registry nor a config.json has dimensions."""
        return self.dimensions.parameters if self.dimensions else None

    @property
    def row_name(self) -> str:
        """Its name in tables: the published one, with a mark for the weights of a stand-in."""
        return f"{self.published or self.name}{' (stand-in)' if self.is_standin else ''}"

    @property
    def slug(self) -> str:
        """Its name as a folder name."""
        return self.name.replace("/", "--")

    @property
    def given_as(self) -> str:
        """What resolves to it again: its folder where it was given as one, else its name."""
        return str(self.folder) if self.source == "path" else self.name

    @property
    def reference(self) -> str:
        """The hub id or folder (relative to here where it lies below) that plain PEFT loads."""
        if self.repo and self.source in (None, "hub cache"):
            return self.repo
        if self.folder is None:
            return self.name
        below = self.folder.is_relative_to(Path.cwd())
        return str(self.folder.relative_to(Path.cwd()) if below else self.folder)

    def adapter_defaults(self, level: Level) -> dict[str, Any]:
        """Its deviations from the published adapter settings at `level`."""
        return self.adapter.get(level, {})

    def serving(self, vocabulary: Vocabulary) -> Candidate:
        """The one that plans for a vehicle: itself, or its reader for one that it does not know."""
        if self.reader is None or self.knows(vocabulary):
            return self
        return resolve_candidate(self.reader)

    def stored_as(self, level: Level, asked: Quantization | None) -> Quantization:
        """The quantization that was asked for, else the one that its adapters are trained with."""
        trained: Quantization = self.adapter_defaults(level).get("quantization", "nf4")
        return asked or trained

    def knows(self, vocabulary: Vocabulary) -> bool:
        """Whether it was pretrained on exactly this vocabulary: no prompt needs to list it."""
        if self.vocabulary != vocabulary.name:
            return False
        return load_vocabulary(self.vocabulary).sha256 == vocabulary.sha256


def all_candidates() -> list[Candidate]:
    """Every registered candidate, in the order of the published tables, located on this machine."""
    return [_locate(candidate) for candidate in _registered()]


def resolve_candidate(name_or_path: str | Path) -> Candidate:
    """The candidate of a registered name, hub id ("org/name", "org/name@revision") or local folder.
    Loads nothing, and succeeds for models that are not on this machine (`folder` is None then).
    Raises PlannerError for a name that is none of these.
    """
    text = str(name_or_path).strip()
    for candidate in _registered():
        names = (candidate.name, candidate.published, candidate.repo)
        if text.lower() in {name.lower() for name in names if name}:
            return _locate(candidate)
    path = Path(text).expanduser()
    if text and path.is_dir():
        folder = path.resolve()
        vocabulary = read_config(folder).get(VOCABULARY_KEY)
        found = Candidate(name=folder.name, vocabulary=vocabulary, merged=_merged(folder))
        return _at(found, folder, "path")
    if text.startswith((".", "/", "~")):
        way_out = "give one with config.json, tokenizer and weights, or a name that"
        raise PlannerError(f"{text}: no such folder; {way_out} `plannerft candidates` lists")
    if match := HUB_ID.fullmatch(text):
        repo = match["repo"]
        known = (one for one in _registered() if (one.repo or "").lower() == repo.lower())
        found = next(known, Candidate(name=repo, repo=repo))
        return _locate(replace(found, revision=match["revision"]))
    raise PlannerError(_unknown(text))


def model_metadata(manifest: dict[str, Any], library: str) -> str:
    """Front matter of the card of a model or adapter with that manifest, as the Hub reads it."""
    from huggingface_hub import ModelCardData

    licence = manifest["licence"]
    unlisted = {"license": "other", "license_name": re.sub(r"[^a-z0-9.]+", "-", licence.lower())}
    data = ModelCardData(
        base_model=manifest["base"]["repo"],
        language="en",
        library_name=library,
        pipeline_tag="text-generation",
        tags=[*TAGS[library], "mission-planning", manifest["vocabulary"]["name"], "planner_ft"],
        **tomllib.loads(read_text(REGISTRY))["licence"].get(licence, unlisted),
    )
    return str(data.to_yaml())


def _unknown(text: str) -> str:
    by_lower = {candidate.name.lower(): candidate.name for candidate in _registered()}
    close = difflib.get_close_matches(text.lower(), by_lower, n=3, cutoff=0.5)
    if close:
        names = " or ".join(by_lower[name] for name in close)
        return f"unknown candidate {text!r}: did you mean {names}, or {OTHERS}?"
    names = ", ".join(by_lower.values())
    return f"unknown candidate {text!r}: there are {names}; {OTHERS} works, too"


@functools.cache
def _registered() -> tuple[Candidate, ...]:
    found = []
    for entry in tomllib.loads(read_text(REGISTRY))["candidate"]:
        sizes = entry.pop("dimensions", None)
        found.append(Candidate(**entry, dimensions=Dimensions(**sizes) if sizes else None))
    return tuple(found)


def _locate(candidate: Candidate) -> Candidate:
    """The candidate with its folder; the config.json there overrules the registry."""
    folder, source = find_folder(candidate.name, candidate.repo, candidate.revision)
    return candidate if folder is None else _at(candidate, folder, source)


def _at(candidate: Candidate, folder: Path, source: Source | None) -> Candidate:
    config = read_config(folder)
    dimensions = Dimensions.from_config(config) or candidate.dimensions
    here = replace(candidate, folder=folder, source=source, chat=_chat(folder))
    return replace(here, dimensions=dimensions, is_standin=bool(config.get(STANDIN_KEY)))


def _merged(folder: Path) -> Level | None:
    """The level of a merged model, by the manifest of its export."""
    manifest = read_config(folder, "manifest.json")
    level = manifest.get("level")
    merged = manifest.get("kind") == "export" and manifest.get("adapter")
    return level if merged and level in LEVELS else None


def _chat(folder: Path) -> Chat:
    """The kind of chat template in a folder, by its markers."""
    template = folder / "chat_template.jinja"
    text = str(read_config(folder, "tokenizer_config.json").get("chat_template") or "")
    text = read_text(template) if template.is_file() else text
    if not text:
        return "plain"
    if "<|start_header_id|>" in text:
        return "llama3"
    return "chatml" if "<|im_start|>" in text else "other"
