"""Long commands that are killed at any of their changes of files: the next run ends with the files
of one that nobody killed.
"""

from __future__ import annotations

import json
import random
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from peft import LoraConfig, get_peft_model
from transformers import AutoModelForCausalLM

from planner_ft.benchmark import calibrate
from planner_ft.cli import main
from planner_ft.document import read_document, write_document
from planner_ft.review import approve, log_beside
from planner_ft.support.files import write_jsonl
from tests.documents import USV, document, step, task
from tests.kills import changes

ROOT = Path(__file__).parents[2]
KILLS = 2
STANDIN = "Llama-3.2-1B-Instruct"
SMALL = f"--candidate {STANDIN} --quantization none"
COMMANDS = {
    "gen-data of missions": "gen-data --level mission --out OUT/data --overwrite",
    "gen-data of tasks": "gen-data --level task --train 9 --validation 2 --test 2 --out OUT/data"
    " --overwrite",
    "train": f"train --level mission {SMALL} --train-file DATA --epochs 1 --checkpoint-steps 2"
    " --output OUT/adapter --resume",
    "bench": f"bench --level mission --candidates {STANDIN} --configurations base"
    " --data DATA --max-new-tokens 40 --batch-size 1 --latency-samples 0 --device cpu --out OUT/run --no-report"
    " --resume",
    "bench of field cases": "bench --field CASES --configurations lora+schema --out OUT/run --resume",
    "bench of both agents": "bench --level both --data DEMANDS --configurations lora+schema"
    " --out OUT/run --resume",
    "calibrate": "calibrate DATA --adapter OUT/adapter --configuration lora+schema --out OUT/run --overwrite",
    "simulate": "simulate PLAN --runs 2 --mcap 0 --out OUT/simulation --overwrite",
    "export": f"export --merge --candidate {STANDIN} --adapter ADAPTER --checks 1 --check-data DATA"
    " --out OUT/model --overwrite",
}
COMPARED = ("*.jsonl", "*.safetensors", "*.csv", "calibration.json")
"""Files without times; of logs what has none."""
TIMED = {"seconds", "tokens_per_s", "time_s", "latency_s", "load_seconds"}
TIMED |= {"peak_memory_bytes", "manifest", "digest"}


@pytest.fixture(scope="module")
def inputs(tmp_path_factory: pytest.TempPathFactory, standins: Path) -> dict[str, Path]:
    """Files that the commands name."""
    folder = tmp_path_factory.mktemp("inputs")
    lines = (ROOT / "data/mission/train.jsonl").read_text(encoding="utf-8").splitlines()
    (folder / "data.jsonl").write_text("\n".join(sorted(lines, key=len)[:5]) + "\n")
    go = task("Transit", {"target_position": [9, 2]}, [step("GoToXY", {"x": 9, "y": 2})])
    write_document(folder / "plan.json", document([go]))
    plan = folder / "plan.json"
    approve(read_document(plan, USV), log_beside(plan), "Ada", ["all"])
    model = AutoModelForCausalLM.from_pretrained(standins / STANDIN)
    settings = LoraConfig(r=2, target_modules=["q_proj"], init_lora_weights=False)
    get_peft_model(model, settings).save_pretrained(folder / "adapter")
    commands = "Go to [40, 20].", "Hold at [10, 5] for a minute.", "Come home."
    cases = [
        {"id": str(index), "kind": "ordinary", "command": text, "expect": [{"outcome": "home"}]}
        for index, text in enumerate(commands)
    ]
    write_jsonl(folder / "cases.jsonl", cases)
    wanted = {"skills": [{"task": "Transit", "skills": ["GoToXY"]}]}
    demands = [{"id": one["id"], "prompt": one["command"], **wanted} for one in cases]
    write_jsonl(folder / "demands.jsonl", demands)
    found = {"DATA": "data.jsonl", "CASES": "cases.jsonl", "DEMANDS": "demands.jsonl"}
    files = {key: folder / name for key, name in found.items()}
    return {**files, "PLAN": plan, "ADAPTER": folder / "adapter"}


def timeless(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: timeless(one) for key, one in value.items() if key not in TIMED}
    return [timeless(one) for one in value] if isinstance(value, list) else value


def content(folder: Path) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for path in sorted({path for one in COMPARED for path in folder.rglob(one)}):
        name = str(path.relative_to(folder))
        if path.suffix == ".jsonl":
            found[name] = [timeless(json.loads(line)) for line in path.read_text().splitlines()]
        else:
            found[name] = path.read_bytes()
    return found


@pytest.mark.parametrize("name", COMMANDS)
def test_a_killed_command_is_gone_on_with(
    name: str,
    inputs: dict[str, Path],
    models: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(calibrate, "LEAST", 2)

    def command(out: Path) -> Callable[[], None]:
        out.mkdir()
        if name == "calibrate":  # which writes beside the adapter
            shutil.copytree(ROOT / "adapters/embedded/mission", out / "adapter")
        named = {"OUT": str(out)} | {key: str(path) for key, path in inputs.items()}
        text = COMMANDS[name]
        for key, value in named.items():
            text = text.replace(key, value)

        def run() -> None:
            sys.argv = ["plannerft", *text.split()]
            main()

        return run

    whole, killed = tmp_path / "whole", tmp_path / "killed"
    total = changes(command(whole), whole)
    assert total
    again = command(killed)
    draw = random.Random(name)
    for last in sorted(draw.randrange(total) for _ in range(KILLS)):
        changes(again, killed, last)
    assert changes(again, killed) is not None
    assert content(killed) == content(whole) != {}
    if name.startswith("bench of"):
        results = [json.loads((one / "run/results.json").read_text()) for one in (killed, whole)]
        assert results[0]["rows"] == results[1]["rows"]
        assert (killed / "run/table.md").read_text() == (whole / "run/table.md").read_text()
    assert not [path for path in killed.rglob("*") if path.name.endswith(".tmp")]
