"""A tokenizer read straight from a candidate's files.

Importing transformers takes longer than a small model needs to load. This class has what rendering
and decoding use of its tokenizers, under the same names and with the same results.
"""

from __future__ import annotations

import functools
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planner_ft.candidates.location import read_config
from planner_ft.support.errors import PlannerError
from planner_ft.support.files import read_text

NAMED = ("bos_token", "eos_token", "pad_token")


class FileTokenizer:
    """The tokenizer of a folder with tokenizer.json."""

    def __init__(self, backend: Any, settings: dict[str, Any], chat_template: str | None) -> None:
        self.backend_tokenizer, self.chat_template = backend, chat_template
        self.bos_token, self.eos_token, self.pad_token = (settings.get(name) for name in NAMED)
        self.bos_token_id, self.eos_token_id, self.pad_token_id = (
            backend.token_to_id(token) if token else None
            for token in (self.bos_token, self.eos_token, self.pad_token)
        )
        self.added_tokens_decoder = backend.get_added_tokens_decoder()
        special = (index for index, token in self.added_tokens_decoder.items() if token.special)
        self.all_special_ids = list(special)

    @classmethod
    def read(cls, folder: Path) -> FileTokenizer | None:
        """A folder's tokenizer, None where transformers must load it. Raises PlannerError."""
        from tokenizers import Tokenizer

        settings = read_config(folder, "tokenizer_config.json")
        if settings.get("tokenizer_class") != "TokenizersBackend":
            return None
        try:
            backend = Tokenizer.from_file(str(folder / "tokenizer.json"))
        except Exception as error:  # the library raises bare Exception
            why = f"the tokenizer cannot be loaded ({error}); download its files again"
            raise PlannerError(f"{folder}: {why}") from error
        named = [settings.get(name) for name in NAMED]
        more = settings.get("extra_special_tokens") or []
        known = {token.content for token in backend.get_added_tokens_decoder().values()}
        plain = all(isinstance(token, str) and token in known for token in (*named, *more))
        if not plain or settings.get("added_tokens_decoder"):
            return None
        template = folder / "chat_template.jinja"
        text = read_text(template) if template.is_file() else settings.get("chat_template")
        return cls(backend, settings, text)

    def __len__(self) -> int:
        return int(self.backend_tokenizer.get_vocab_size())

    def __call__(
        self, texts: Sequence[str], *, add_special_tokens: bool = True
    ) -> dict[str, list[list[int]]]:
        return {"input_ids": [self.encode(text, add_special_tokens) for text in texts]}

    def encode(
        self, text: str, add_special_tokens: bool = True, split_special_tokens: bool = False
    ) -> list[int]:
        """Ids of a text. With `split_special_tokens`, special tokens in it are text."""
        self.backend_tokenizer.encode_special_tokens = split_special_tokens
        encoded = self.backend_tokenizer.encode(text, add_special_tokens=add_special_tokens)
        return list(encoded.ids)

    def decode(
        self,
        ids: Sequence[int],
        *,
        skip_special_tokens: bool = False,
        clean_up_tokenization_spaces: bool = False,
    ) -> str:
        """The text of ids; spaces are never cleaned up."""
        text = self.backend_tokenizer.decode(list(ids), skip_special_tokens=skip_special_tokens)
        return str(text)

    def apply_chat_template(self, messages: Sequence[dict[str, str]], **values: Any) -> str:
        """The messages as the chat template writes them."""
        tokens = {name: getattr(self, name) for name in NAMED}
        return str(self._template.render(messages=messages, **{**tokens, **values}))

    @functools.cached_property
    def _template(self) -> Any:
        from jinja2.sandbox import ImmutableSandboxedEnvironment

        environment = ImmutableSandboxedEnvironment(
            trim_blocks=True, lstrip_blocks=True, extensions=["jinja2.ext.loopcontrols"]
        )
        return environment.from_string(self.chat_template or "")
