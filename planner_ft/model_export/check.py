"""Folding a LoRA adapter into the weights, in full precision, and answers before and after it."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from planner_ft.candidates import Candidate, loading
from planner_ft.candidates.adapters import check_adapter
from planner_ft.candidates.registry import VOCABULARY_KEY
from planner_ft.data.curated import curated_folder, find_source
from planner_ft.prompts import ends_of_answers, render_prompt, save_tokenizer
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json, read_jsonl, write_json
from planner_ft.vocabulary import Vocabulary, load_vocabulary
from planner_ft.vocabulary.plans import Level

LOCAL = {"local_files_only": True, "trust_remote_code": False, "use_safetensors": True}


def load_full(
    candidate: Candidate, adapter: Path | None, level: Level, vocabulary: Vocabulary
) -> Any:
    """The model in float32 on the CPU, an adapter beside its weights. Raises PlannerError."""
    import torch
    from transformers import AutoModelForCausalLM

    folder = loading.require_folder(candidate)
    if adapter is not None:
        check_adapter(adapter, candidate, level=level, vocabulary=vocabulary)
    loading.quiet_libraries()
    try:
        with loading.quiet_bars():
            options = {**LOCAL, "dtype": torch.float32}
            model = AutoModelForCausalLM.from_pretrained(str(folder), **options)
            if adapter is not None:
                from peft import PeftModel

                model = PeftModel.from_pretrained(model, str(adapter), use_safetensors=True)
    except MemoryError as error:
        way = "close other programs, or export on a larger machine"
        raise PlannerError(f"{candidate.name} does not fit the memory in float32; {way}") from error
    except (OSError, ValueError, RuntimeError) as error:
        why = f"the model cannot be loaded ({' '.join(str(error).split())[:200]})"
        raise PlannerError(f"{folder}: {why}; check its files") from error
    return model.eval()


def merged(model: Any) -> Any:
    """The model with its adapter, if any, folded in: W + alpha / r * B A. Raises PlannerError."""
    if not hasattr(model, "merge_and_unload"):
        return model
    try:
        return model.merge_and_unload(safe_merge=True)
    except ValueError as error:  # PEFT refuses weights that are no numbers
        raise PlannerError(f"the adapter cannot be merged ({error}); train it again") from error


def save_full(model: Any, candidate: Candidate, learned: Vocabulary | None, folder: Path) -> None:
    """Write weights, tokenizer, chat template and generation settings as a transformers folder.
    `learned` is the vocabulary that the model knows without a prompt; config.json names it, so that
    the benchmark does not put it into prompts.
    """
    from safetensors import SafetensorError

    try:
        with loading.quiet_bars():
            model.save_pretrained(str(folder), safe_serialization=True)
    except SafetensorError as error:  # a full disk is no OSError of this library
        way = "free some space, or choose another folder with --out"
        raise PlannerError(f"the weights cannot be written ({error}); {way}") from error
    config = folder / "config.json"
    for path in folder.glob("*.safetensors"):  # written readable for their owner alone
        path.chmod(config.stat().st_mode)
    save_tokenizer(loading.load_tokenizer(candidate), model, folder)
    if learned is not None and _is_bundled(learned):
        write_json(config, {**read_json(config), VOCABULARY_KEY: learned.name})


def _is_bundled(vocabulary: Vocabulary) -> bool:
    try:
        return load_vocabulary(vocabulary.name).sha256 == vocabulary.sha256
    except PlannerError:
        return False


SEED = 0
TOKEN_CHECKS = 1000
Record = dict[str, Any]
Records = Sequence[Record]


@dataclass(frozen=True)
class Agreement:
    """How far two models agree: `same` of `count` greedy answers, and the logits along them."""

    count: int
    same: int
    largest_logit_difference: float

    def to_json(self) -> dict[str, Any]:
        found = {"commands": self.count, "same_answers": self.same}
        largest = self.largest_logit_difference
        return {**found, "largest_logit_difference": largest, "dtype": "float32"}


def check_records(
    level: Level, vocabulary: Vocabulary, count: int, data: Path | None = None
) -> list[Record]:
    """The first records of `data`, or of the level's validation set. Raises PlannerError."""
    if data is not None:
        records = read_jsonl(data)[:count]
        needed = ("prompt",) if level == "mission" else ("prompt", "task")
        for number, record in enumerate(records, 1):
            missing = [key for key in needed if not isinstance(record.get(key), str)]
            if missing:
                hint = f"give commands of the {level} level"
                raise PlannerError(f"{data}: record {number} has no {missing[0]}; {hint}")
        return records
    if level == "mission":
        folder = curated_folder(vocabulary) or find_source()
        return read_jsonl(folder / "validation.jsonl")[:count]
    from planner_ft.data.task.sampler import sample_tasks

    return list(itertools.islice(sample_tasks(vocabulary, SEED, count, "validation"), count))


def token_records(level: Level, vocabulary: Vocabulary, records: Records) -> list[Record]:
    """These records and a thousand drawn ones, for comparing two tokenizers."""
    if level == "task":
        return [*records, *check_records(level, vocabulary, TOKEN_CHECKS)]
    from planner_ft.data.missions import sample_missions
    from planner_ft.data.templates.records import template_files

    if not template_files(vocabulary, "commands"):
        return list(records)
    return [*records, *sample_missions(SEED, TOKEN_CHECKS, vocabulary)]


class Answers:
    """Greedy answers of a float32 model, and the logits along them."""

    def __init__(
        self,
        level: Level,
        vocabulary: Vocabulary,
        records: Records,
        tokenizer: Any,
        with_vocabulary: bool,
    ) -> None:
        from planner_ft.decoding.sequence import Query

        self.level, self.tokenizer = level, tokenizer
        known: dict[str, Any] = {"vocabulary": vocabulary, "with_vocabulary": with_vocabulary}
        self.queries = [
            Query(level, record, tuple(render_prompt(level, record, tokenizer, **known)))
            for record in records
        ]

    def of(self, model: Any) -> list[tuple[int, ...]]:
        """The ids of the model's answers."""
        from planner_ft.decoding.configurations import MAX_NEW_TOKENS, Limits
        from planner_ft.decoding.generate import generate
        from planner_ft.decoding.passes import ModelDecoder

        ends = ends_of_answers(self.tokenizer, model.generation_config.eos_token_id)
        limits = Limits(tuple(ends), MAX_NEW_TOKENS[self.level])
        answers = generate(ModelDecoder(model), self.queries, limits, batch_size=1)
        return [answer.ids for answer in answers]

    def logits(self, model: Any, answers: Sequence[Sequence[int]]) -> list[Any]:
        """The logits after each position of prompt and answer: tensors (positions, tokens)."""
        import torch

        with torch.inference_mode():
            return [
                model(input_ids=torch.tensor([[*query.prompt, *ids]])).logits[0]
                for query, ids in zip(self.queries, answers, strict=True)
            ]

    def agreement(
        self, expected: Sequence[tuple[int, ...]], logits: Sequence[Any], model: Any
    ) -> Agreement:
        """Compare with another model's answers and logits. Raises PlannerError when one differs."""
        pairs = zip(logits, self.logits(model, expected), strict=True)
        largest = max(float((one - other).abs().max()) for one, other in pairs)
        same = sum(one == two for one, two in zip(expected, self.of(model), strict=True))
        count = len(expected)
        if same < count:
            raise PlannerError(
                f"{count - same} of {count} answers differ between the adapter and the merged"
                f" weights (logits by up to {largest:.3g}), so nothing was written; give other"
                " commands with --check-data, or serve base and adapter as they are"
            )
        return Agreement(count, same, largest)
