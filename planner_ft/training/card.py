"""The model card of an adapter, in the Hub's format (card.md.jinja)."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from planner_ft.support.files import read_text

LICENCES = {"Apache-2.0": "apache-2.0"}
"""Licences with an identifier of the Hub; others are named in full."""
TEMPLATE = Path(__file__).parent / "card.md.jinja"


def model_card(manifest: dict[str, Any]) -> str:
    """README.md of the adapter that a training manifest describes."""
    import jinja2

    environment = jinja2.Environment(
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        undefined=jinja2.StrictUndefined,
    )
    environment.filters |= {"json": json.dumps, "name": lambda path: Path(path).name}
    template = environment.from_string(read_text(TEMPLATE))
    return template.render(
        m=manifest, s=manifest["configuration"], r=manifest["result"], licences=LICENCES
    )
