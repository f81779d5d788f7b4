"""The plan as a document: one JSON object that review, approval, verification and export read."""

from planner_ft.document.build import PlanDocument as PlanDocument
from planner_ft.document.build import altered as altered
from planner_ft.document.build import build as build
from planner_ft.document.build import document_digest as document_digest
from planner_ft.document.build import read_document as read_document
from planner_ft.document.build import revise as revise
from planner_ft.document.build import write_document as write_document
from planner_ft.document.edits import Difference as Difference
from planner_ft.document.edits import adopt as adopt
from planner_ft.document.edits import apply as apply
from planner_ft.document.edits import differences as differences
from planner_ft.document.edits import undo as undo
