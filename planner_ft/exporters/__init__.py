"""An approved plan in the formats that vehicles read.

`run.hand_over` does it: `formats` says what a format is and which there are, `ledger` keeps account
of what a file holds, `geodesy` turns local metres into latitude and longitude, and a module per
format writes it.
"""

from planner_ft.exporters.formats import DRAFT, Format, Handover, Written, format_names, load_format
from planner_ft.exporters.geodesy import Origin, parse_origin
from planner_ft.exporters.ledger import Account, Ledger, Loss

__all__ = [
    "DRAFT",
    "Account",
    "Format",
    "Handover",
    "Ledger",
    "Loss",
    "Origin",
    "Written",
    "format_names",
    "load_format",
    "parse_origin",
]
