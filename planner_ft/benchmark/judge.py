"""Scored answers of a model in training to validation samples: `train` shows them with the loss."""

from __future__ import annotations

import contextlib
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from planner_ft.benchmark.catalogue import METRIC
from planner_ft.benchmark.contrasts import sentences
from planner_ft.benchmark.paired import paired
from planner_ft.benchmark.samples import Sample
from planner_ft.benchmark.scoring import score_sample
from planner_ft.decoding.configurations import Limits
from planner_ft.decoding.forward import SmallModel, small_model
from planner_ft.decoding.generate import Generation, generate
from planner_ft.decoding.passes import ModelDecoder
from planner_ft.decoding.sequence import Method, Query
from planner_ft.prompts import ends_of_answers, render_prompt
from planner_ft.training.checkpoint import JUDGED, Answer, Run
from planner_ft.training.model import SMALL_MODEL, autocast, evaluating
from planner_ft.vocabulary.plans import without_working

if TYPE_CHECKING:
    from planner_ft.training.preflight import Prepared
    from planner_ft.training.request import TrainRequest

BATCH = 8
ROOM = 1.5
"""An answer that is this many times as long as the longest expected one is cut, and wrong."""


class Judge:
    """Free answers of the run's model to validation samples, with and without the adapter."""

    def __init__(self, request: TrainRequest, prepared: Prepared, run: Run) -> None:
        assert prepared.validation and prepared.tokenizer
        self.request, self.run, self.tokenizer = request, run, prepared.tokenizer
        count = request.settings.validation_answers
        self.records = run.ranks.share(prepared.validation.records[:count])
        longest = max(one.completion_length for one in prepared.validation.samples)
        named = run.model.get_base_model().generation_config.eos_token_id
        ends = tuple(ends_of_answers(self.tokenizer, named))
        self.limits = Limits(ends, int(ROOM * longest))

    def answers(self, *, adapter: bool) -> list[Answer]:
        """The scores of the answers, which all processes share; those of the base are prompted as a
        benchmark prompts it.
        """
        model, level, vocabulary = self.run.model, self.request.level, self.request.vocabulary
        trained = self.request.settings.vocabulary_in_prompt
        told = trained if adapter else not self.request.candidate.knows(vocabulary)
        known: dict[str, Any] = {"vocabulary": vocabulary, "with_vocabulary": told}
        prompts = (render_prompt(level, one, self.tokenizer, **known) for one in self.records)
        pairs = zip(self.records, prompts, strict=True)
        queries = [Query(level, record, tuple(prompt)) for record, prompt in pairs]
        with evaluating(model):
            decoder = small_form(model, adapter=adapter) if self.run.device.type == "cpu" else None
            with contextlib.ExitStack() as stack:
                if decoder is None:
                    stack.enter_context(autocast(self.run.device, self.run.dtype))
                if decoder is None and not adapter:
                    stack.enter_context(model.disable_adapter())
                one = decoder or ModelDecoder(model)
                found = generate(one, queries, self.limits, Method(), batch_size=BATCH)
        scored = [self._scored(*pair) for pair in zip(self.records, found, strict=True)]
        return self.run.ranks.gather(scored)

    def _scored(self, record: dict[str, Any], answer: Generation) -> Answer:
        how = {"skip_special_tokens": False, "clean_up_tokenization_spaces": False}
        text = self.tokenizer.decode(list(answer.said), **how)
        sample = Sample.of(record)
        output = {"output": without_working(str(text))[0]}
        values = score_sample(self.request.level, sample, output, self.request.vocabulary).values
        judged = {name: float(values[name] or 0) for name in JUDGED}
        return {"id": sample.id, "family": sample.family, **judged}

    def change(self, base: Sequence[Answer], best: Sequence[Answer]) -> str:
        """What training changed, in a sentence, and where it is nothing, what to try next."""
        seed, first = self.run.settings.seed, {one["id"]: [one] for one in base}
        second = {one["id"]: [one] for one in best}
        f1, exact = (paired(METRIC[name], first, second, seed) for name in ("f1", "exact_sequence"))
        losses = [entry["validation_loss"] for entry in self.run.state.history]
        falling = len(losses) > 1 and losses[-1] <= min(losses)
        known = {"f1": f1, "exact": exact, "n": len(best), "settings": self.run.settings}
        known["more"] = "--vary 3" if self.request.level == "mission" else "--augment 500"
        return sentences("judge", **known, falling=falling)[0]


def small_form(model: Any, *, adapter: bool) -> SmallModel | None:
    """The lean form of a small model in training, its adapter merged; None for any other model."""
    base = model.get_base_model()
    if base.num_parameters() >= SMALL_MODEL:
        return None
    stored = base.state_dict().items()
    tensors = {name.replace(".base_layer", ""): v for name, v in stored if ".lora_" not in name}
    if adapter:
        for name, module in base.named_modules():
            if hasattr(module, "lora_A"):
                weight = tensors[f"{name}.weight"]
                merged = weight.float() + module.get_delta_weight("default").float()
                tensors[f"{name}.weight"] = merged.to(weight.dtype)
    config = base.config.to_dict()
    config.pop("quantization_config", None)
    return small_model(config, tensors)
