"""The plan as a document: one JSON object that review, approval, verification and export read.

`build` makes it of what was planned, `edits` changes it as an operator asks, `revise` recomputes
what derives (what the command lacks, where values come from, warnings, estimates, the digest),
`differences` compares it with what the model proposed, `files` reads and writes it. Whether a
document is approved stands in the approval log (planner_ft.review), never in the document.
"""

from planner_ft.document.build import build
from planner_ft.document.differences import Difference, differences
from planner_ft.document.digest import altered, document_digest
from planner_ft.document.edits import adopt, apply, undo
from planner_ft.document.files import PlanDocument, read_document, write_document
from planner_ft.document.revise import revise

__all__ = [
    "Difference",
    "PlanDocument",
    "adopt",
    "altered",
    "apply",
    "build",
    "differences",
    "document_digest",
    "read_document",
    "revise",
    "undo",
    "write_document",
]
