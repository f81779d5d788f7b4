"""An export from beginning to end."""

from __future__ import annotations

import json
import secrets
import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, adapters, resolve_candidate
from planner_ft.candidates.loading import load_tokenizer, require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.model_export import check as checks
from planner_ft.model_export.gguf_file import check_architecture, import_gguf, write_gguf
from planner_ft.model_export.gguf_tokens import check_ids, token_table
from planner_ft.model_export.merge import load_full, merged, save_full
from planner_ft.model_export.settings import ExportSettings
from planner_ft.prompts.text import prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, sha256_tree, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

MANIFEST = "manifest.json"
KIND = "export"
AGENTS = {"mission": "Mission Agent", "task": "Task Agent"}
Say = Callable[[str], None]
Record = dict[str, Any]


@dataclass(frozen=True)
class Exported:
    """The folder that was written, the GGUF file in it if any, and how the answers agree."""

    folder: Path
    gguf: Path | None
    check: checks.Agreement


@dataclass(frozen=True)
class _Work:
    """Everything that an export depends on, checked."""

    settings: ExportSettings
    say: Say
    candidate: Candidate
    level: Level
    adapter: Path | None
    vocabulary: Vocabulary
    records: list[Record]

    @property
    def with_vocabulary(self) -> bool:
        return self.adapter is None and not self.candidate.knows(self.vocabulary)


def export(settings: ExportSettings, say: Say = lambda _line: None) -> Exported:
    """Write a candidate, with its adapter folded in, as a model folder and a GGUF file; nothing is
    written when its answers change. Raises PlannerError.
    """
    work = _prepared(settings, say)
    out = settings.out.resolve()
    temporary = out.with_name(f".{out.name}.{secrets.token_hex(4)}.tmp")
    started = time.time()
    try:
        temporary.mkdir(parents=True)
        check = _write_model(work, temporary)
        gguf = _write_gguf(work, temporary) if settings.gguf else None
        _write_record(work, temporary, check, gguf, round(time.time() - started, 1))
        if out.exists():  # an earlier export is removed only now
            shutil.rmtree(out)
        temporary.replace(out)
    except OSError as error:
        why = f"cannot be written ({error.strerror or error})"
        way = "choose another folder or free some space"
        raise PlannerError(f"{settings.out}: {why}; {way}") from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    return Exported(settings.out, settings.out / gguf["file"] if gguf else None, check)


def _prepared(settings: ExportSettings, say: Say) -> _Work:
    """Everything that can be checked before a model is loaded."""
    level, named = settings.named_adapter
    vocabulary = load_vocabulary(settings.vocabulary)
    candidate = resolve_candidate(settings.candidate)
    folder = require_folder(candidate)
    adapter = None
    if settings.merge:
        found = named or adapters.find_adapter(candidate, level, vocabulary)
        adapter = found or adapters.adapter_folder(candidate, level)
        adapters.check_adapter(adapter, candidate, level=level, vocabulary=vocabulary)
    if settings.gguf:
        import_gguf()
        check_architecture(folder)
    _check_out(settings)
    records = checks.check_records(level, vocabulary, settings.checks, settings.data)
    return _Work(settings, say, candidate, level, adapter, vocabulary, records)


def _check_out(settings: ExportSettings) -> None:
    out = settings.out
    if not out.exists() or (out.is_dir() and not any(out.iterdir())):
        return
    manifest = out / MANIFEST
    if not manifest.is_file() or read_json(manifest).get("kind") != KIND:
        raise PlannerError(f"--out {out}: exists and is no exported model; give another folder")
    if not settings.overwrite:
        way = "give --overwrite to replace it, or another folder"
        raise PlannerError(f"--out {out}: holds an exported model; {way}")


def _write_model(work: _Work, folder: Path) -> checks.Agreement:
    """The transformers folder, read back and compared."""
    candidate, adapter, records = work.candidate, work.adapter, work.records
    known, apart = (work.level, work.vocabulary), work.with_vocabulary
    tokenizer = load_tokenizer(candidate)
    answers = checks.Answers(work.level, records, tokenizer, work.vocabulary, with_vocabulary=apart)
    work.say(f"loading {candidate.name}{f' with {adapter}' if adapter else ''} in float32")
    model = load_full(candidate, adapter, *known)
    work.say(f"answering {len(records)} commands before")
    before = answers.of(model)
    logits = answers.logits(model, before)
    save_full(merged(model), candidate, None if apart else work.vocabulary, folder)
    del model
    work.say(f"answering {len(records)} commands after")
    written = load_full(resolve_candidate(folder), None, *known)
    return checks.agreement(answers, before, logits, written)


def _write_gguf(work: _Work, folder: Path) -> Record:
    """The GGUF file; returns its entry in the manifest."""
    exported, outtype = resolve_candidate(folder), work.settings.outtype
    path = folder / f"{work.settings.out.resolve().name}-{outtype}.gguf"
    assert exported.dimensions is not None  # check_architecture has read them
    table = token_table(folder / "tokenizer.json", exported.dimensions.vocabulary)
    level, vocabulary, texts = work.level, work.vocabulary, dict[str, None]()
    for record in checks.token_records(level, vocabulary, work.records):
        shown = prompt_messages(level, record, vocabulary, with_vocabulary=work.with_vocabulary)
        texts |= dict.fromkeys(message["content"] for message in shown)
    count = check_ids(folder / "tokenizer.json", table, texts)
    work.say(f"writing {path.name} (split {table.split}: same ids for {count} texts)")
    if table.long_words:
        found = f"{table.long_words} tokens are longer than 32 bytes"
        dropped = "llama-cpp-python drops them from answers, llama.cpp's own llama-server does not"
        work.say(f"{found}: {dropped}")
    write_gguf(folder, path, table, load_tokenizer(exported), work.candidate.name, outtype)
    entry: Record = {"file": path.name, "sha256": sha256_file(path), "outtype": outtype}
    entry |= {"split": table.split, "user_defined": sorted(table.added.values())}
    return {**entry, "texts_with_same_ids": count, "tokens_over_32_bytes": table.long_words}


def _write_record(
    work: _Work, folder: Path, check: checks.Agreement, gguf: Record | None, seconds: float
) -> None:
    """Manifest and model card."""
    settings, adapter = work.settings, None
    if work.adapter:
        file = work.adapter / MANIFEST
        trained = read_json(file).get("configuration", {}) if file.is_file() else {}
        digest = sha256_tree(work.adapter, (adapters.WEIGHTS, adapters.CONFIG))
        adapter = {"sha256": digest, "trained_on": trained.get("quantization")}
    keys = ("checks", "merge", "gguf", "outtype")
    manifest = build_manifest(
        KIND,
        seed=checks.SEED,
        configuration={key: getattr(settings, key) for key in keys},
        inputs={"data": settings.data} if settings.data else {},
        **adapters.adapter_record(work.candidate, work.level, work.vocabulary),
        licence=work.candidate.licence,
        adapter=adapter,
        weights_sha256=weights_sha256(folder),
        check=check.to_json(),
        gguf=gguf,
        seconds=seconds,
    )
    write_json(folder / MANIFEST, manifest)
    write_text(folder / "README.md", model_card(manifest))


def model_card(manifest: Record) -> str:
    """README.md of the export that a manifest describes, in the Hub's format."""
    from jinja2 import Environment, PackageLoader

    loader = PackageLoader("planner_ft.model_export", ".")
    environment = Environment(loader=loader, trim_blocks=True, keep_trailing_newline=True)
    return environment.get_template("model_card.md.j2").render(
        manifest, agent=AGENTS[manifest["level"]], licence_text=json.dumps(manifest["licence"])
    )
