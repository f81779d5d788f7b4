"""The plan as a document: one JSON object that review, approval, verification and export read."""

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
