"""An export from beginning to end."""

import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, get_args

from planner_ft.candidates import adapters, resolve_candidate
from planner_ft.candidates.loading import load_tokenizer, require_folder
from planner_ft.candidates.location import weights_sha256
from planner_ft.candidates.registry import model_metadata
from planner_ft.model_export import check as checks
from planner_ft.model_export.check import load_full, merged, save_full
from planner_ft.model_export.gguf_file import (
    OutType,
    check_architecture,
    check_ids,
    import_gguf,
    token_table,
    write_gguf,
)
from planner_ft.prompts import prompt_messages
from planner_ft.support.alone import alone, staging
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, sha256_file, write_json, write_text, writing
from planner_ft.support.manifest import build_manifest
from planner_ft.vocabulary import load_vocabulary
from planner_ft.vocabulary.plans import LEVELS, Level, check_level

MANIFEST = "manifest.json"
KIND = "export"
AGENTS = {"mission": "Mission Agent", "task": "Task Agent"}
Say = Callable[[str], None]
Record = dict[str, Any]


@dataclass(frozen=True)
class ExportSettings:
    """An export of `candidate` into the folder `out`. `merge` folds the adapter of `level` in:
    `adapter` ("DIR" or "LEVEL=DIR"), or the candidate's own. `gguf` writes a GGUF file, too, its
    matrices in `outtype`. `checks` commands are answered before and after: those of `data`, or of
    the level's validation set.
    """

    candidate: str
    out: Path
    level: Level = "mission"
    merge: bool = False
    adapter: str | None = None
    gguf: bool = False
    outtype: OutType = "f32"
    checks: int = 8
    data: Path | None = None
    vocabulary: str = "usv"
    overwrite: bool = False

    def __post_init__(self) -> None:
        """Raise PlannerError that lists every setting that cannot be used."""
        problems = []
        if self.adapter is not None and not self.merge:
            problems.append("--adapter: an adapter is exported by folding it in; give --merge, too")
        if self.outtype not in get_args(OutType):
            problems.append(f"--outtype {self.outtype}: must be {' or '.join(get_args(OutType))}")
        if not 1 <= self.checks <= 10000:
            problems.append(f"--checks {self.checks}: must be between 1 and 10000")
        if problems:
            raise PlannerError("; ".join(problems))

    @property
    def named_adapter(self) -> tuple[Level, Path | None]:
        """The level whose agent is exported, and the adapter's folder where one is named."""
        level, separator, folder = (self.adapter or "").partition("=")
        if separator and level in LEVELS:
            return check_level(level), Path(folder)
        return self.level, Path(self.adapter) if self.adapter else None


@dataclass(frozen=True)
class Exported:
    """The folder that was written, the GGUF file in it if any, and how the answers agree."""

    folder: Path
    gguf: Path | None
    check: checks.Agreement


def export(settings: ExportSettings, say: Say = lambda _line: None) -> Exported:
    """Write a model folder and a GGUF file, nothing when answers change. Raises PlannerError."""
    out = settings.out.resolve()
    with alone(settings.out, "--out", "an export"):
        work = _Work(settings, say)
        way = "choose another folder or free some space"
        with writing(settings.out, way), staging(out) as staged, staging(out) as former:
            check = work.write_model(staged)
            gguf = work.write_gguf(staged) if settings.gguf else None
            work.write_record(staged, check, gguf)
            if out.exists():  # an earlier export is removed only now
                out.replace(former / out.name)
            staged.replace(out)
    return Exported(settings.out, settings.out / gguf["file"] if gguf else None, check)


class _Work:
    """An export; all that can be checked before a model is loaded is checked when it is made."""

    def __init__(self, settings: ExportSettings, say: Say) -> None:
        self.settings, self.say, self.begun = settings, say, time.time()
        self.level, named = settings.named_adapter
        self.vocabulary = load_vocabulary(settings.vocabulary)
        self.candidate = resolve_candidate(settings.candidate).serving(self.vocabulary)
        folder = require_folder(self.candidate)
        self.adapter = None
        if settings.merge:
            own = self.candidate, self.level
            found = named or adapters.find_adapter(*own, self.vocabulary)
            self.adapter = found or adapters.adapter_folder(*own)
            known: Record = {"level": self.level, "vocabulary": self.vocabulary}
            adapters.check_adapter(self.adapter, self.candidate, **known)
        if settings.gguf:
            import_gguf()
            check_architecture(folder)
        _check_out(settings)
        known_so = self.candidate, self.vocabulary, self.adapter
        self.with_vocabulary = adapters.prompt_has_vocabulary(*known_so)
        counted = settings.checks, settings.data
        self.records = checks.check_records(self.level, self.vocabulary, *counted)

    def write_model(self, folder: Path) -> checks.Agreement:
        """The transformers folder, read back and compared."""
        candidate, adapter, count = self.candidate, self.adapter, len(self.records)
        known, apart = (self.level, self.vocabulary), self.with_vocabulary
        answers = checks.Answers(*known, self.records, load_tokenizer(candidate), apart)
        self.say(f"loading {candidate.name}{f' with {adapter}' if adapter else ''} in float32")
        model = load_full(candidate, adapter, *known)
        self.say(f"answering {count} commands before")
        before = answers.of(model)
        logits = answers.logits(model, before)
        save_full(merged(model), candidate, None if apart else self.vocabulary, folder)
        del model
        self.say(f"answering {count} commands after")
        return answers.agreement(before, logits, load_full(resolve_candidate(folder), None, *known))

    def write_gguf(self, folder: Path) -> Record:
        """The GGUF file; returns its entry in the manifest."""
        exported, outtype = resolve_candidate(folder), self.settings.outtype
        path = folder / f"{self.settings.out.resolve().name}-{outtype}.gguf"
        assert exported.dimensions is not None  # check_architecture has read them
        table = token_table(folder / "tokenizer.json", exported.dimensions.vocabulary)
        texts: dict[str, None] = {}
        for record in checks.token_records(self.level, self.vocabulary, self.records):
            known = self.level, record, self.vocabulary
            shown = prompt_messages(*known, with_vocabulary=self.with_vocabulary)
            texts |= dict.fromkeys(message["content"] for message in shown)
        count = check_ids(folder / "tokenizer.json", table, texts)
        self.say(f"writing {path.name} (split {table.split}: same ids for {count} texts)")
        if table.long_words:
            found = f"{table.long_words} tokens are longer than 32 bytes"
            dropped = "llama-cpp-python drops them from answers, llama.cpp's own llama-server"
            self.say(f"{found}: {dropped} does not")
        write_gguf(folder, path, table, load_tokenizer(exported), self.candidate.name, outtype)
        entry: Record = {"file": path.name, "sha256": sha256_file(path), "outtype": outtype}
        entry |= {"split": table.split, "user_defined": sorted(table.added.values())}
        return {**entry, "texts_with_same_ids": count, "tokens_over_32_bytes": table.long_words}

    def write_record(self, folder: Path, check: checks.Agreement, gguf: Record | None) -> None:
        """Manifest and model card."""
        settings, adapter = self.settings, None
        if self.adapter:
            file = self.adapter / MANIFEST
            trained = read_json(file).get("configuration", {}) if file.is_file() else {}
            digest = adapters.adapter_sha256(self.adapter)
            adapter = {"sha256": digest, "trained_on": trained.get("quantization")}
        keys = ("checks", "merge", "gguf", "outtype")
        manifest = build_manifest(
            KIND,
            seed=checks.SEED,
            configuration={key: getattr(settings, key) for key in keys},
            inputs={"data": settings.data} if settings.data else {},
            **adapters.adapter_record(self.candidate, self.level, self.vocabulary),
            licence=self.candidate.licence,
            adapter=adapter,
            weights_sha256=weights_sha256(folder),
            check=check.to_json(),
            gguf=gguf,
            seconds=round(time.time() - self.begun, 1),
        )
        write_json(folder / MANIFEST, manifest)
        write_text(folder / "README.md", model_card(manifest))


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


def model_card(manifest: Record) -> str:
    """README.md of the export that a manifest describes, in the Hub's format."""
    from jinja2 import Environment, PackageLoader

    loader = PackageLoader("planner_ft.model_export", ".")
    environment = Environment(loader=loader, trim_blocks=True, keep_trailing_newline=True)
    return environment.get_template("model_card.md.j2").render(
        manifest, agent=AGENTS[manifest["level"]], metadata=model_metadata(manifest, "transformers")
    )
