"""Several processes that share one run, as `accelerate launch` or torchrun starts them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import timedelta
from typing import TypeVar

from planner_ft.benchmark.settings import BenchSettings
from planner_ft.support.resources import end_with_parent

Item = TypeVar("Item")
LONGEST_WAIT = timedelta(days=14)
"""For others that answer; one that fails ends them all through its launcher."""


@dataclass(frozen=True)
class Ranks:
    """This process's place among those that share a run. Rank 0 owns the folder; the others add
    answers to its predictions.jsonl.
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
