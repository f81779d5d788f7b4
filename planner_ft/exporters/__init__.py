"""An approved plan in the formats that vehicles read.

`run.export_plan` does it; `formats` says what a format is, `ledger` keeps account of what a file
holds, and a module per format writes it. `tables.toml` holds the reasons of losses.
"""

from planner_ft.exporters.formats import (
    DRAFT,
    Format,
    PlanExport,
    Written,
    format_names,
    load_format,
)
from planner_ft.exporters.geodesy import Origin, parse_origin
from planner_ft.exporters.ledger import Account, Ledger, Loss

__all__ = [
    "DRAFT",
    "Account",
    "Format",
    "Ledger",
    "Loss",
    "Origin",
    "PlanExport",
    "Written",
    "format_names",
    "load_format",
    "parse_origin",
]
