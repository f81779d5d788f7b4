"""The list of candidates as data: size, licence, memory, and where each lies or how to get it."""

from __future__ import annotations

from typing import Any

from planner_ft.candidates.loading import download_command, how_to_get
from planner_ft.candidates.location import check_folder
from planner_ft.candidates.memory import (
    BOARD_GPU_GIB,
    GIB,
    RANK,
    TRAIN_GPU_GIB,
    inference_memory,
    training_memory,
)
from planner_ft.candidates.registry import Candidate
from planner_ft.support.errors import PlannerError


def describe(candidate: Candidate) -> dict[str, Any]:
    """Everything `plannerft candidates` tells about one, as JSON values.

    `memory` is in GiB, None where the dimensions are unknown. `here` is true when the files are
    complete; else `problem` or `get` says what to do, and `command` downloads it.
    """
    return {
        "name": candidate.name,
        "row": candidate.row_name,
        "repo": candidate.repo,
        "parameters": candidate.parameters,
        "chat": candidate.chat,
        "licence": candidate.licence,
        "gated": candidate.gated,
        "vocabulary": candidate.vocabulary,
        "standin": candidate.is_standin,
        "memory": _memory(candidate),
        **_place(candidate),
    }


def _memory(candidate: Candidate) -> dict[str, Any] | None:
    dimensions = candidate.dimensions
    if dimensions is None:
        return None
    rank = max([RANK, *(settings.rank or 0 for settings in candidate.adapter.values())])
    train, saving = (
        training_memory(dimensions, rank=rank, checkpointing=checkpointing)
        for checkpointing in (False, True)
    )
    infer = inference_memory(dimensions, rank=rank)
    return {
        "train_gib": round(train.total / GIB, 2),
        "train_checkpointing_gib": round(saving.total / GIB, 2),
        "infer_gib": round(infer.total / GIB, 2),
        "train_fits": {
            f"{gib} GB": "yes" if train.fits(gib) else "checkpointing" if saving.fits(gib) else "no"
            for gib in (BOARD_GPU_GIB, TRAIN_GPU_GIB)
        },
        "infer_fits": {
            f"{gib} GB": "yes" if infer.fits(gib) else "no"
            for gib in (BOARD_GPU_GIB, TRAIN_GPU_GIB)
        },
    }


def _place(candidate: Candidate) -> dict[str, Any]:
    if candidate.folder is None:
        return {
            "here": False,
            "folder": None,
            "source": None,
            "problem": None,
            "get": how_to_get(candidate),
            "command": download_command(candidate),
        }
    try:
        check_folder(candidate.folder)
        problem = None
    except PlannerError as error:
        problem = str(error)
    return {
        "here": problem is None,
        "folder": str(candidate.folder),
        "source": candidate.source,
        "problem": problem,
        "get": None,
        "command": None,
    }
