"""The exported embedded candidate in llama.cpp's server: same ids, same answers as in float32 here.

Needs llama-cpp-python, which builds from source for minutes: `make server-test` makes an
environment for it.
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

PYTHON = os.environ.get("PLANNERFT_SERVER_PYTHON")
ROOT = Path(__file__).parents[2]


@pytest.mark.server
def test_a_real_server_answers_as_we_do(tmp_path: Path) -> None:
    assert PYTHON, (
        "PLANNERFT_SERVER_PYTHON names no interpreter with llama-cpp-python[server]; run `make"
        " server-test`"
    )
    out = tmp_path / "served.json"
    command = [
        sys.executable,
        "benchmarks/served_agreement.py",
        "--server-python",
        PYTHON,
        "--limit",
        "6",
        "--schema",
        "--out",
        str(out),
    ]
    subprocess.run(command, cwd=ROOT, check=True)
    result = json.loads(out.read_text())
    assert result["prompts_with_same_ids"] == "1000 of 1000"
    # A choice between two tokens that are all but equal may fall the other way.
    assert len(result["different"]) <= 1, result
    assert abs(result["f1_served"]["lora"] - result["f1_here"]) <= 1 / 6
    assert result["complete_but_invalid_served"]["lora+schema"] == []
