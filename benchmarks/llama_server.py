"""llama-cpp-python's server without its limit on the length of tokens: `python
benchmarks/llama_server.py FLAGS`.

Up to version 0.3.36 `LlamaModel.detokenize` reads each token into 32 bytes and drops longer ones
from the answer (https://github.com/abetlen/llama-cpp-python/issues/2362). The embedded candidate
writes a plan's structure in tokens of up to 81.
"""

from __future__ import annotations

import ctypes
import runpy
from typing import Any

LONGEST = 4096


def detokenize(self: Any, tokens: list[int], special: bool = False) -> bytes:
    """The bytes of these tokens, as llama-cpp-python's method of the same name gives them."""
    import llama_cpp

    buffer = (ctypes.c_char * LONGEST)()
    pieces = []
    for token in tokens:
        size = llama_cpp.llama_token_to_piece(
            self.vocab, llama_cpp.llama_token(token), buffer, LONGEST, 0, special
        )
        assert 0 <= size <= LONGEST, f"token {token} is longer than {LONGEST} bytes"
        pieces.append(buffer.raw[:size])
    return b"".join(pieces)


if __name__ == "__main__":
    from llama_cpp import _internals

    _internals.LlamaModel.detokenize = detokenize
    runpy.run_module("llama_cpp.server", run_name="__main__", alter_sys=True)
