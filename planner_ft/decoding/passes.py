"""Forward passes over the rows of a batch, their keys and values kept: for any model of
transformers. `forward` has those of small models.
"""

from __future__ import annotations

import inspect
from collections.abc import Sequence
from typing import Any

import torch
from torch import Tensor
from torch.nn.utils.rnn import pad_sequence

from planner_ft.decoding.forward import Feeds, SmallModel, begin_alike

SHARED = 16
"""Tokens that prompts must share for a pass of their own: below, it costs more than it saves."""


class ModelDecoder:
    """A transformers model with its active adapter; short prompts are padded left."""

    def __init__(self, model: Any) -> None:
        self.model = model
        self.context: int | None = getattr(model.config, "max_position_embeddings", None)
        base = model.get_base_model() if hasattr(model, "get_base_model") else model
        # The last positions' logits alone, if the model can: with a vocabulary of 128k that saves
        # gigabytes.
        self.trims_logits = "logits_to_keep" in inspect.signature(base.forward).parameters

    def start(self, rows: int) -> _ModelPasses:
        return _ModelPasses(self, rows)


Decoder = ModelDecoder | SmallModel
"""A model that batches are started on. `context` is the number of positions that it can hold, None
where it does not say; `start(rows)` gives the forward passes of a batch.
"""


class _ModelPasses:
    """The forward passes of a batch. A single row is `wide`: after its prompt, it may be fed
    several tokens at a time and have some taken back. In a batch all rows are fed one at a time, so
    that their positions stay aligned. What all prompts of it begin with is computed once.
    """

    def __init__(self, decoder: ModelDecoder, rows: int) -> None:
        from transformers import DynamicCache

        self.decoder, self.device = decoder, decoder.model.device
        self.cache = DynamicCache(config=decoder.model.config)
        # Layers that keep a window or a state cannot be taken back.
        layers = self.cache.layers
        back = (getattr(one, "is_croppable", True) and not one.is_sliding for one in layers)
        self.wide = rows == 1 and all(back)
        self.mask = torch.zeros(rows, 0, dtype=torch.long, device=self.device)

    def run(self, feeds: Feeds, wanted: Sequence[int]) -> Tensor:
        """Feed each row its next tokens; return the logits after the last `wanted` of them (at
        least 1), row by row: (sum of wanted, tokens).
        """
        if len(feeds) > 1 and not self.mask.shape[1]:
            feeds = self._begin_together(feeds)
        logits = self._forward(feeds, max(wanted))
        return torch.cat([row[-count:] for row, count in zip(logits, wanted, strict=True)])

    def forget(self, counts: Sequence[int]) -> None:
        """Take back the last tokens of each row."""
        if count := max(counts):  # of the only row
            self.cache.crop(-count)
            self.mask = self.mask[:, :-count]

    def select(self, kept: Sequence[int]) -> None:
        """Keep only these rows."""
        index = torch.tensor(kept, dtype=torch.long, device=self.device)
        self.mask = self.mask[index]
        self.cache.batch_select_indices(index)

    def _begin_together(self, feeds: Feeds) -> Feeds:
        """Compute all prompts' common beginning once; what is left of each, a token at least."""
        from transformers.cache_utils import DynamicLayer

        shared = min(begin_alike(feeds[0], feed) for feed in feeds)
        count = min(shared, min(map(len, feeds)) - 1)
        if count < SHARED or not all(type(layer) is DynamicLayer for layer in self.cache.layers):
            return feeds
        self.mask = self.mask[:1]
        self._forward([feeds[0][:count]], 1)
        self.select([0] * len(feeds))
        return [feed[count:] for feed in feeds]

    def _forward(self, feeds: Feeds, wanted: int) -> Tensor:
        """The last `wanted` logits of each row: (rows, wanted, tokens)."""
        rows = [torch.tensor(feed, device=self.device) for feed in feeds]
        left: dict[str, Any] = {"batch_first": True, "padding_side": "left"}
        ids = pad_sequence(rows, **left)
        fed = pad_sequence([torch.ones_like(row) for row in rows], **left)
        self.mask = torch.cat([self.mask, fed], 1)
        positions = (self.mask.cumsum(1) - 1).clamp(min=0)[:, -ids.shape[1] :]
        options: dict[str, Any] = {"logits_to_keep": wanted} if self.decoder.trims_logits else {}
        options |= {"past_key_values": self.cache, "use_cache": True, "position_ids": positions}
        how = {"input_ids": ids, "attention_mask": self.mask, **options}
        logits: Tensor = self.decoder.model(**how).logits
        return logits
