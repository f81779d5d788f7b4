"""The plan as a document: one JSON object that review, approval, verification and export read.

`build` makes it of a planned command and recomputes what derives (missing elements of the command,
where values come from, warnings, estimates, the digest), `edits` changes it as an operator asks,
`differences` compares it with the model's proposal, `files` reads and writes it. Whether a
document is approved stands in the approval log (planner_ft.review), never in the document.
"""

from planner_ft.document.build import PlanDocument, altered, build, document_digest, revise
from planner_ft.document.differences import Difference, differences
from planner_ft.document.edits import adopt, apply, undo
from planner_ft.document.files import read_document, write_document

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
