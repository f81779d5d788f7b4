"""An export from beginning to end."""

from __future__ import annotations

import secrets
import shutil
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, resolve_candidate
from planner_ft.candidates.adapters import (
    CONFIG,
    WEIGHTS,
    adapter_folder,
    adapter_record,
    check_adapter,
    find_adapter,
)
from planner_ft.candidates.loading import load_tokenizer, require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.model_export.card import model_card
from planner_ft.model_export.check import (
    SEED,
    Agreement,
    Answers,
    agreement,
    check_records,
    token_records,
)
from planner_ft.model_export.gguf_file import check_architecture, import_gguf, write_gguf
from planner_ft.model_export.gguf_tokens import check_ids, token_table
from planner_ft.model_export.merge import load_full, merged, save_full
from planner_ft.model_export.settings import ExportSettings
from planner_ft.prompts.chat import prompt_messages
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, sha256_tree, write_json, write_text
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

MANIFEST = "manifest.json"
KIND = "export"
Say = Callable[[str], None]


@dataclass(frozen=True)
class Exported:
    """What was written: the folder, the GGUF file in it if one was asked for, and how the answers
    agree.
    """

    folder: Path
    gguf: Path | None
    check: Agreement


@dataclass(frozen=True)
class _Work:
    """What an export depends on, checked."""

    settings: ExportSettings
    candidate: Candidate
    level: Level
    adapter: Path | None
    vocabulary: Vocabulary
    records: list[dict[str, Any]]

    @property
    def with_vocabulary(self) -> bool:
        return self.adapter is None and not self.candidate.knows(self.vocabulary)


def export(settings: ExportSettings, say: Say = lambda _line: None) -> Exported:
    """Write a candidate, with its adapter folded in, as a model folder and a GGUF file; nothing is
    written when its answers change.

    Raises PlannerError.
    """
    work = _prepared(settings)
    out = settings.out.resolve()
    temporary = out.with_name(f".{out.name}.{secrets.token_hex(4)}.tmp")
    started = time.time()
    try:
        temporary.mkdir(parents=True)
        check = _write_model(work, temporary, say)
        gguf = _write_gguf(work, temporary, say) if settings.gguf else None
        _write_record(work, temporary, check, gguf, round(time.time() - started, 1))
        _put(temporary, settings)
    except OSError as error:
        raise PlannerError(
            f"{settings.out}: cannot be written ({error.strerror or error}); choose another folder"
            " or free some space"
        ) from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)
    return Exported(settings.out, settings.out / gguf["file"] if gguf else None, check)


def _prepared(settings: ExportSettings) -> _Work:
    """Everything that can be checked before a model is loaded."""
    level, named = settings.named_adapter
    vocabulary, candidate = (
        load_vocabulary(settings.vocabulary),
        resolve_candidate(settings.candidate),
    )
    folder = require_folder(candidate)
    adapter = None
    if settings.merge:
        adapter = (
            named or find_adapter(candidate, level, vocabulary) or adapter_folder(candidate, level)
        )
        check_adapter(adapter, candidate, level=level, vocabulary=vocabulary)
    if settings.gguf:
        import_gguf()
        check_architecture(folder)
    _check_out(settings)
    return _Work(
        settings,
        candidate,
        level,
        adapter,
        vocabulary,
        check_records(level, vocabulary, settings.checks, settings.data),
    )


def _check_out(settings: ExportSettings) -> None:
    out = settings.out
    if not out.exists() or (out.is_dir() and not any(out.iterdir())):
        return
    if (
        not out.is_dir()
        or not (out / MANIFEST).is_file()
        or read_json(out / MANIFEST).get("kind") != KIND
    ):
        raise PlannerError(f"--out {out}: exists and is no exported model; give another folder")
    if not settings.overwrite:
        raise PlannerError(
            f"--out {out}: holds an exported model; give --overwrite to replace it, or another"
            " folder"
        )


def _write_model(work: _Work, folder: Path, say: Say) -> Agreement:
    """The transformers folder, read back and compared."""
    tokenizer = load_tokenizer(work.candidate)
    answers = Answers(
        work.level, work.records, tokenizer, work.vocabulary, with_vocabulary=work.with_vocabulary
    )
    say(
        f"loading {work.candidate.name}{f' with {work.adapter}' if work.adapter else ''} in float32"
    )
    model = load_full(work.candidate, work.adapter, work.level, work.vocabulary)
    say(f"answering {len(work.records)} commands before")
    before = answers.of(model)
    logits = answers.logits(model, before)
    known = work.vocabulary if work.adapter or not work.with_vocabulary else None
    save_full(merged(model), work.candidate, known, folder)
    del model
    say(f"answering {len(work.records)} commands after")
    written = load_full(resolve_candidate(folder), None, work.level, work.vocabulary)
    return agreement(answers, before, logits, written)


def _write_gguf(work: _Work, folder: Path, say: Say) -> dict[str, Any]:
    """The GGUF file; returns what the manifest says of it."""
    exported = resolve_candidate(folder)
    path = folder / f"{work.settings.out.resolve().name}-{work.settings.outtype}.gguf"
    assert exported.dimensions is not None  # check_architecture has read them
    table = token_table(folder / "tokenizer.json", exported.dimensions.vocabulary)
    records = token_records(work.level, work.vocabulary, work.records)
    texts = [
        message["content"]
        for record in records
        for message in prompt_messages(
            work.level, record, work.vocabulary, with_vocabulary=work.with_vocabulary
        )
    ]
    count = check_ids(folder / "tokenizer.json", table, dict.fromkeys(texts))
    say(f"writing {path.name} (split {table.split}: same ids for {count} texts)")
    if table.long_words:
        say(
            f"{table.long_words} tokens are longer than 32 bytes: llama-cpp-python drops them from"
            " answers, llama.cpp's own llama-server does not"
        )
    write_gguf(
        folder,
        path,
        table,
        load_tokenizer(exported),
        name=work.candidate.name,
        outtype=work.settings.outtype,
    )
    tokens = {
        "split": table.split,
        "user_defined": sorted(table.added.values()),
        "texts_with_same_ids": count,
        "tokens_over_32_bytes": table.long_words,
    }
    return {
        "file": path.name,
        "sha256": sha256_file(path),
        "outtype": work.settings.outtype,
        **tokens,
    }


def _write_record(
    work: _Work, folder: Path, check: Agreement, gguf: dict[str, Any] | None, seconds: float
) -> None:
    """Manifest and model card."""
    candidate, adapter = work.candidate, work.adapter
    trained = read_json(adapter / MANIFEST) if adapter and (adapter / MANIFEST).is_file() else {}
    settings = {
        "checks": work.settings.checks,
        "merge": work.settings.merge,
        "gguf": work.settings.gguf,
        "outtype": work.settings.outtype,
    }
    manifest = build_manifest(
        KIND,
        seed=SEED,
        configuration=settings,
        inputs={"data": work.settings.data} if work.settings.data else {},
        **adapter_record(candidate, work.level, work.vocabulary),
        licence=candidate.licence,
        adapter=(
            {
                "sha256": sha256_tree(adapter, (WEIGHTS, CONFIG)),
                "trained_on": trained.get("configuration", {}).get("quantization"),
            }
            if adapter
            else None
        ),
        weights_sha256=weights_sha256(folder),
        check=check.to_json(),
        gguf=gguf,
        seconds=seconds,
    )
    write_json(folder / MANIFEST, manifest)
    write_text(folder / "README.md", model_card(manifest))


def _put(temporary: Path, settings: ExportSettings) -> None:
    """Move the finished folder to its place; an earlier export is removed only now."""
    out = settings.out.resolve()
    if out.exists():
        shutil.rmtree(out)
    temporary.replace(out)
