"""A sample as the model sees it, with the trained part in colour."""

from __future__ import annotations

from typing import TYPE_CHECKING

from planner_ft.training.samples import Sample

if TYPE_CHECKING:
    from rich.text import Text
    from transformers import PreTrainedTokenizerBase


def preview_text(sample: Sample, tokenizer: PreTrainedTokenizerBase) -> Text:
    """Prompt dim, completion green, special tokens reversed; the trained part stands in ⟦ ⟧, so
    that it shows without colour.
    """
    from rich.text import Text

    text = Text()
    trained = False
    # A character may consist of several tokens, so that runs of tokens are decoded together,
    # special tokens alone.
    for ids, mask, special in _runs(
        sample, set(tokenizer.all_special_ids) | set(tokenizer.added_tokens_decoder)
    ):
        if mask != trained:
            text.append("⟦" if mask else "⟧", "bold")
            trained = mask
        style = ("green" if mask else "dim") + (" reverse" if special else "")
        decoded = tokenizer.decode(
            ids, skip_special_tokens=False, clean_up_tokenization_spaces=False
        )
        text.append(str(decoded), style)
    if trained:
        text.append("⟧", "bold")
    return text


def _runs(sample: Sample, special: set[int]) -> list[tuple[list[int], bool, bool]]:
    runs: list[tuple[list[int], bool, bool]] = []
    for token, mask in zip(sample.rendered.input_ids, sample.rendered.completion_mask, strict=True):
        kind = (bool(mask), token in special)
        if runs and runs[-1][1:] == kind and not kind[1]:
            runs[-1][0].append(token)
        else:
            runs.append(([token], *kind))
    return runs


def preview_caption(sample: Sample) -> str:
    """Counts of the sample's tokens."""
    return (
        f"{sample.id}: {sample.length} tokens, {sample.completion_length} of them trained (between"
        " ⟦ and ⟧)"
    )
