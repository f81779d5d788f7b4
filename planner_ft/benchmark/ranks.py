"""Several processes that share one run, as `accelerate launch` or torchrun starts them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import timedelta
from pathlib import Path
from typing import TypeVar

from planner_ft.benchmark.folder import PREDICTIONS
from planner_ft.benchmark.records import RecordLog, Tail
from planner_ft.benchmark.settings import BenchSettings
from planner_ft.support.resources import end_with_parent

Item = TypeVar("Item")
LONGEST_WAIT = timedelta(days=14)
"""A process may wait for the others as long as these answer; one that fails ends them all through
its launcher.
"""


@dataclass(frozen=True)
class Ranks:
    """This process's place among those that share a run. Rank 0 owns the folder; the others write
    parts, which it takes in.
    """

    rank: int = 0
    world: int = 1

    @property
    def leads(self) -> bool:
        return self.rank == 0

    def wait(self) -> None:
        """Go on when every process has come here."""
        if self.world > 1:
            import torch.distributed

            torch.distributed.barrier()

    def share(self, items: Sequence[Item]) -> list[Item]:
        """This process's part of the items that all share."""
        return list(items[self.rank :: self.world])

    def settings(self, settings: BenchSettings) -> BenchSettings:
        """The settings of this process: a GPU of its own, where there are any."""
        if self.world == 1 or settings.device not in ("auto", "cuda"):
            return settings
        import torch

        if not torch.cuda.is_available():
            return settings
        local = int(os.environ.get("LOCAL_RANK", self.rank))
        return replace(settings, device=f"cuda:{local % torch.cuda.device_count()}")

    def log(self, folder: Path) -> RecordLog:
        """The log that this process writes its answers to."""
        return RecordLog(folder / (PREDICTIONS if self.leads else part_name(self.rank)))


ALONE = Ranks()


def started_with_others() -> bool:
    """Whether a launcher started several processes."""
    return int(os.environ.get("WORLD_SIZE", "1")) > 1


def join_ranks() -> Ranks:
    """This process's place, after it has met the others; alone where there are none."""
    if not started_with_others():
        return ALONE
    import atexit

    import torch.distributed

    end_with_parent()
    torch.distributed.init_process_group("gloo", timeout=LONGEST_WAIT)
    atexit.register(torch.distributed.destroy_process_group)
    return Ranks(torch.distributed.get_rank(), torch.distributed.get_world_size())


def part_name(rank: int | str) -> str:
    """The file of a process's answers until rank 0 has taken them in."""
    return f"predictions.part{rank}.jsonl"


def part_files(folder: Path) -> list[Path]:
    """The parts that lie in a folder."""
    return sorted(folder.glob(part_name("*")))


def take_in(folder: Path, log: RecordLog) -> None:
    """Add the answers of the parts to the log, each once, however often this is done."""
    for _name, record in Tail(*part_files(folder)).new():
        if (record["key"], record["id"]) not in log.records:
            log.append(record)


def take_in_abandoned(folder: Path, log: RecordLog) -> None:
    """Take in and remove the parts of a run that was killed. Raises PlannerError when one is still
    being written.
    """
    for path in part_files(folder):
        RecordLog(path).close()
    take_in(folder, log)
    remove_parts(folder)


def remove_parts(folder: Path) -> None:
    """Remove parts that were taken in."""
    for path in part_files(folder):
        path.unlink()
