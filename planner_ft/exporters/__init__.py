"""An approved plan in the formats that vehicles read.

`run.export_plan` does it; `formats` says what a format is, `ledger` keeps account of what a file
holds, and a module per format writes it. `tables.toml` holds the reasons of losses.
"""

from planner_ft.exporters.formats import DRAFT, Format, PlanExport, Written, load_format
from planner_ft.exporters.ledger import Account, Ledger
from planner_ft.support.geodesy import Origin, parse_origin

__all__ = ["DRAFT", "Account", "Format", "Ledger", "Origin", "PlanExport", "Written"]
__all__ += ["load_format", "parse_origin"]
