"""The embedded candidate's byte-level BPE tokenizer.

Its pre-tokenizer keeps digits apart (numbers are copied and computed digit by digit), lets the JSON
structure between two values become one token, and takes the agents' fixed instructions as one token
each. Any other text, another vehicle's names included, falls back to ordinary byte-level pieces.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from planner_ft.prompts import system_text
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import LEVELS, MISSION_KEYS, SKILL_KEYS, STEP_KEYS, TASK_KEYS

if TYPE_CHECKING:
    from transformers import PreTrainedTokenizerFast

SPECIAL_TOKENS = ("<|pad|>", "<|begin|>", "<|end|>", "<|system|>", "<|user|>", "<|assistant|>")

CHAT_TEMPLATE = (
    "<|begin|>{% for message in messages %}"
    "{% if message['role'] == 'assistant' %}<|assistant|>{{ message['content'] }}<|end|>"
    "{% else %}<|{{ message['role'] }}|>{{ message['content'] }}{% endif %}"
    "{% endfor %}{% if add_generation_prompt %}<|assistant|>{% endif %}"
)


def pre_token_pattern(vocabulary: Vocabulary) -> str:
    """The regular expression whose matches become pre-tokens."""
    keys = {*MISSION_KEYS, *TASK_KEYS, *STEP_KEYS, *SKILL_KEYS, "skill_sequence"}
    keys.update(name for task in vocabulary.tasks for name in task.by_name)
    keys.update(name for skill in vocabulary.skills for name in skill.by_name)
    alternatives = "|".join(sorted(keys, key=lambda key: (-len(key), key)))
    unresolved = re.escape(",".join(f"{value:g}" for value in vocabulary.unresolved))
    structure = rf'(?:[{{}}\[\]",]*"(?:{alternatives})":)+[{{\[]*"?'
    return (
        rf'{unresolved}|{structure}| ?\d| ?[A-Za-z]+| ?[{{}}\[\]",:]+|'
        r' ?[^\sA-Za-z\d{}\[\]",:]+|\s+'
    )


def train_tokenizer(
    texts: Iterable[str], vocabulary: Vocabulary, *, size: int = 4096
) -> PreTrainedTokenizerFast:
    """The tokenizer of `texts` (prompts and completions), the same for the same texts in order."""
    from tokenizers import AddedToken, Regex, Tokenizer, decoders, models, pre_tokenizers, trainers
    from transformers import PreTrainedTokenizerFast

    tokenizer = Tokenizer(models.BPE())
    split = pre_tokenizers.Split(Regex(pre_token_pattern(vocabulary)), "isolated")
    byte_level = pre_tokenizers.ByteLevel(add_prefix_space=False, use_regex=False)
    tokenizer.pre_tokenizer = pre_tokenizers.Sequence([split, byte_level])
    tokenizer.decoder = decoders.ByteLevel()
    trainer = trainers.BpeTrainer(
        vocab_size=size,
        special_tokens=list(SPECIAL_TOKENS),
        initial_alphabet=pre_tokenizers.ByteLevel.alphabet(),
        show_progress=False,
        max_token_length=120,
    )
    tokenizer.train_from_iterator(texts, trainer)
    instructions = [system_text(level, vocabulary, with_vocabulary=False) for level in LEVELS]
    added = [AddedToken(text, normalized=False, special=False) for text in instructions]
    tokenizer.add_tokens(added)
    fast = PreTrainedTokenizerFast(
        tokenizer_object=tokenizer,
        bos_token="<|begin|>",
        eos_token="<|end|>",
        pad_token="<|pad|>",
        clean_up_tokenization_spaces=False,
        model_max_length=4096,
    )
    fast.add_special_tokens({"additional_special_tokens": list(SPECIAL_TOKENS[3:])})
    fast.chat_template = CHAT_TEMPLATE
    return fast
