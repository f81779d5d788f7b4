"""What planning with the embedded candidate imports and needs: the start takes longer than the
plan.
"""

from __future__ import annotations

import json
import subprocess
import sys

SCRIPT = """
import json, sys
from planner_ft.planning import Planner
light = "torch" not in sys.modules
planned = Planner.load(configuration="base+schema", device="cpu").plan("Go to [30, -12], then come home.")
print(json.dumps({"light": light, "modules": sorted(sys.modules), "valid": planned.valid, "peak": planned.peak_memory}))
"""
SLOW = (
    "torch._dynamo",
    "torch._inductor",
    "bitsandbytes",
    "peft",
    "accelerate",
    "datasets",
    "matplotlib",
    "transformers",
)


def test_the_embedded_candidate_plans_without_what_only_training_needs() -> None:
    ran = subprocess.run([sys.executable, "-c", SCRIPT], capture_output=True, text=True, check=True)
    told = json.loads(ran.stdout)
    assert told["valid"] and told["light"]
    assert [name for name in SLOW if name in told["modules"]] == []
    assert told["peak"] < 1.2e9
