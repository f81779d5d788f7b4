"""A byte-level BPE tokenizer as llama.cpp takes it: tokens, their types, merges, and the name of a
way to split text.

llama.cpp knows a fixed list of ways to split text before merging ("pre-tokenizers",
`llama-vocab.cpp`). Two of them are those of Llama 3 and Qwen2. Any other tokenizer is given the one
that splits least, "superbpe" (runs of digits are cut off from the rest and into threes), since
merges of text that was learned in pieces seldom cross their borders; tokens that hold digits and
something else, which it would tear apart, become user-defined tokens: those are found in the text
before it is split. Whether the ids are the same is then tried out on commands, and a tokenizer for
which they are not is refused.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any

from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_json

LLAMA_3 = (
    r"(?i:'s|'t|'re|'ve|'m|'ll|'d)|[^\r\n\p{L}\p{N}]?\p{L}+|\p{N}{1,3}|"
    r" ?[^\s\p{L}\p{N}]+[\r\n]*|\s*[\r\n]+|\s+(?!\S)|\s+"
)
QWEN_2 = LLAMA_3.replace(r"\p{N}{1,3}", r"\p{N}")
KNOWN = {LLAMA_3: "llama-bpe", QWEN_2: "qwen2"}
"""Names of llama.cpp's splits by their pattern."""
LEAST = "superbpe"
LEAST_PATTERNS = (r"\p{N}+", r"(?=(\d{3})+(?!\d))")
CONVERTER = "convert it with llama.cpp's convert_hf_to_gguf.py"
SHORT = 32
"""Bytes from which llama-cpp-python drops a token from the text of an answer (its issue 2362)."""


class Kind(IntEnum):
    """Types of tokens in a GGUF file (gguf.TokenType)."""

    NORMAL = 1
    CONTROL = 3
    USER_DEFINED = 4
    UNUSED = 5


@dataclass(frozen=True)
class TokenTable:
    """`tokens` and `kinds` by id, `merges` as "LEFT RIGHT" in order, and `split`, the name in
    tokenizer.ggml.pre.

    `added` are the texts that became user-defined tokens beyond the tokenizer's own, by id.
    """

    tokens: tuple[str, ...]
    kinds: tuple[Kind, ...]
    merges: tuple[str, ...]
    split: str
    added: Mapping[int, str]

    @property
    def long_words(self) -> int:
        """Tokens with letters that are longer than SHORT; in byte-level BPE a character stands for
        a byte.
        """
        normal = [
            token
            for token, kind in zip(self.tokens, self.kinds, strict=True)
            if kind == Kind.NORMAL
        ]
        long = [token for token in normal if len(token) > SHORT]
        return sum(any("a" <= sign <= "z" for sign in token) for token in long)


def token_table(path: Path, size: int) -> TokenTable:
    """The table of a tokenizer.json for a model with `size` tokens. Raises PlannerError when it is
    no byte-level BPE.
    """
    settings = read_json(path)
    model, steps = settings.get("model", {}), _steps(settings)
    bytewise = [step for step in steps if step.get("type") == "ByteLevel"]
    plain = model.get("type") == "BPE" and not model.get("byte_fallback")
    normalizer = settings.get("normalizer")
    if not (plain and normalizer in (None, {"type": "NFC"})) or not any(
        not step.get("add_prefix_space") for step in bytewise
    ):
        raise PlannerError(
            f"{path}: only byte-level BPE tokenizers are written as GGUF here; {CONVERTER}"
        )
    patterns = [step["pattern"].get("Regex") for step in steps if step.get("type") == "Split"]
    split = KNOWN.get(patterns[0] or "", LEAST) if len(patterns) == 1 else LEAST
    added = _torn_apart(settings) if split == LEAST else {}
    tokens, kinds = [f"[PAD{number}]" for number in range(size)], [Kind.UNUSED] * size
    entries = [(number, text, Kind.NORMAL) for text, number in model["vocab"].items()]
    entries += [
        (one["id"], one["content"], Kind.CONTROL if one["special"] else Kind.USER_DEFINED)
        for one in settings["added_tokens"]
    ]
    entries += [(number, text, Kind.USER_DEFINED) for number, text in added.items()]
    for number, text, kind in entries:
        tokens[number], kinds[number] = text, kind
    merges = [merge if isinstance(merge, str) else " ".join(merge) for merge in model["merges"]]
    return TokenTable(tuple(tokens), tuple(kinds), tuple(merges), split, added)


def check_ids(path: Path, table: TokenTable, texts: Iterable[str]) -> int:
    """The number of texts, each with the same ids in both tokenizers. Raises PlannerError, with the
    first text that differs.

    llama.cpp's way is computed with the tokenizers library: the same merges after the other split.
    """
    from tokenizers import Tokenizer

    settings = read_json(path)
    ours = Tokenizer.from_str(json.dumps(settings))
    theirs = Tokenizer.from_str(json.dumps(_with_split(settings, table)))
    # The library gives the added texts new ids.
    back = {theirs.token_to_id(text): number for number, text in table.added.items()}
    count = 0
    for count, text in enumerate(texts, 1):  # noqa: B007
        found = theirs.encode(text, add_special_tokens=False).ids
        expected = ours.encode(text, add_special_tokens=False).ids
        if expected != [back.get(number, number) for number in found]:
            raise PlannerError(
                f"{path}: no way in which llama.cpp splits text gives this tokenizer's ids for"
                f" {text[:80]!r}; {CONVERTER}, if it knows one"
            )
    return count


def _with_split(settings: dict[str, Any], table: TokenTable) -> dict[str, Any]:
    """A tokenizer.json that splits as the table says."""
    if table.split != LEAST:
        return settings
    steps: list[dict[str, Any]] = [
        {"type": "Split", "pattern": {"Regex": pattern}, "behavior": "Isolated", "invert": False}
        for pattern in LEAST_PATTERNS
    ]
    byte_level = {"add_prefix_space": False, "trim_offsets": True, "use_regex": False}
    steps.append({"type": "ByteLevel", **byte_level})
    flags = dict.fromkeys(("single_word", "lstrip", "rstrip", "normalized", "special"), False)
    more = [
        {"id": len(table.tokens) + place, "content": text, **flags}
        for place, text in enumerate(table.added.values())
    ]
    return {
        **settings,
        "pre_tokenizer": {"type": "Sequence", "pretokenizers": steps},
        "added_tokens": [*settings["added_tokens"], *more],
    }


def _torn_apart(settings: dict[str, Any]) -> dict[int, str]:
    """Tokens with digits and other characters that the tokenizer itself can produce, as text by
    id.
    """
    from tokenizers import Tokenizer

    tokenizer = Tokenizer.from_str(json.dumps(settings))
    own = {entry["content"] for entry in settings["added_tokens"]}
    found = {}
    for token, number in settings["model"]["vocab"].items():
        text = tokenizer.decode([number], skip_special_tokens=False)
        mixed = any(sign.isnumeric() for sign in text) and not text.isnumeric()
        if not mixed or "�" in text or token in own:
            continue
        if tokenizer.encode(text, add_special_tokens=False).ids == [number]:
            found[number] = text
    return found


def _steps(settings: dict[str, Any]) -> list[dict[str, Any]]:
    step = settings.get("pre_tokenizer") or {}
    return list(step["pretokenizers"]) if step.get("type") == "Sequence" else [step]
