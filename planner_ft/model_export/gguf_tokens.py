"""A byte-level BPE tokenizer as llama.cpp takes it: tokens, types, merges, and how to split text.

llama.cpp knows a fixed list of ways to split text before merging ("pre-tokenizers",
`llama-vocab.cpp`). Two of them are those of Llama 3 and Qwen2. Any other tokenizer is given the one
that splits least, "superbpe" (runs of digits are cut off from the rest and into threes), since
merges of text that was learned in pieces seldom cross their borders; tokens that hold digits and
something else, which it would tear apart, become user-defined tokens: those are found in the text
before it is split. Whether the ids are the same is then tried out on commands, and a tokenizer for
which they are not is refused.
"""

from __future__ import annotations

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
SHORT = 32  # bytes: llama-cpp-python drops longer tokens from an answer's text (its issue 2362)


class Kind(IntEnum):
    """Types of tokens in a GGUF file (gguf.TokenType)."""

    NORMAL = 1
    CONTROL = 3
    USER_DEFINED = 4
    UNUSED = 5


@dataclass(frozen=True)
class TokenTable:
    """`tokens` and `kinds` by id, `merges` as "LEFT RIGHT", and `split` for tokenizer.ggml.pre;
    `added` are the texts, by id, that became user-defined tokens beyond the tokenizer's own.
    """

    tokens: tuple[str, ...]
    kinds: tuple[Kind, ...]
    merges: tuple[str, ...]
    split: str
    added: Mapping[int, str]

    @property
    def long_words(self) -> int:
        """Tokens with letters that are longer than SHORT: a character stands for a byte."""
        pairs = zip(self.tokens, self.kinds, strict=True)
        long = [token for token, kind in pairs if kind == Kind.NORMAL and len(token) > SHORT]
        return sum(any("a" <= sign <= "z" for sign in token) for token in long)


def token_table(path: Path, size: int) -> TokenTable:
    """The table for a model of `size` tokens. Raises PlannerError for no byte-level BPE."""
    settings = read_json(path)
    model, step = settings.get("model", {}), settings.get("pre_tokenizer") or {}
    steps = list(step["pretokenizers"]) if step.get("type") == "Sequence" else [step]
    bytewise = [step for step in steps if step.get("type") == "ByteLevel"]
    plain = model.get("type") == "BPE" and not model.get("byte_fallback")
    plain = plain and settings.get("normalizer") in (None, {"type": "NFC"})
    if not plain or all(step.get("add_prefix_space") for step in bytewise):
        what = "only byte-level BPE tokenizers are written as GGUF here"
        raise PlannerError(f"{path}: {what}; {CONVERTER}")
    patterns = [step["pattern"].get("Regex") for step in steps if step.get("type") == "Split"]
    split = KNOWN.get(patterns[0] or "", LEAST) if len(patterns) == 1 else LEAST
    added = _torn_apart(path, settings) if split == LEAST else {}
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
    """The number of texts, all with the same ids in both tokenizers. Raises PlannerError, with the
    first text that differs. llama.cpp's way is computed with the tokenizers library: the same
    merges after the other split.
    """
    from tokenizers import AddedToken, Regex, Tokenizer
    from tokenizers.pre_tokenizers import ByteLevel, Sequence, Split

    ours, theirs = Tokenizer.from_file(str(path)), Tokenizer.from_file(str(path))
    if table.split == LEAST:
        splits = [Split(Regex(pattern), "isolated") for pattern in LEAST_PATTERNS]
        bytewise = ByteLevel(add_prefix_space=False, use_regex=False)
        theirs.pre_tokenizer = Sequence([*splits, bytewise])
        theirs.add_tokens([AddedToken(text, normalized=False) for text in table.added.values()])
    # The library gives the added texts new ids.
    back = {theirs.token_to_id(text): number for number, text in table.added.items()}
    count = 0
    for count, text in enumerate(texts, 1):  # noqa: B007
        found = theirs.encode(text, add_special_tokens=False).ids
        expected = ours.encode(text, add_special_tokens=False).ids
        if expected != [back.get(number, number) for number in found]:
            why = "no way in which llama.cpp splits text gives this tokenizer's ids for"
            raise PlannerError(f"{path}: {why} {text[:80]!r}; {CONVERTER}, if it knows one")
    return count


def _torn_apart(path: Path, settings: dict[str, Any]) -> dict[int, str]:
    """The tokens with digits and other characters that a tokenizer itself can produce, by id."""
    from tokenizers import Tokenizer

    tokenizer = Tokenizer.from_file(str(path))
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
