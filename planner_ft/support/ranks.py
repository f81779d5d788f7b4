"""Several processes that share one run, as `accelerate launch` or torchrun starts them."""

from __future__ import annotations

import contextlib
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING, TypeVar

from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import end_with_parent

if TYPE_CHECKING:
    from torch import Tensor

Item = TypeVar("Item")
LONGEST_WAIT = timedelta(days=14)
"""A process may wait for the others as long as these answer; one that fails ends them all through
its launcher.
"""


@dataclass(frozen=True)
class Ranks:
    """This process's place among those that share a run. Rank 0 owns the folder: of the others,
    those of a benchmark add answers to its predictions.jsonl.
    """

    rank: int = 0
    world: int = 1

    @property
    def leads(self) -> bool:
        return self.rank == 0

    def wait(self) -> None:
        """Go on when every process has come here."""
        import torch.distributed

        if self.world > 1 and torch.distributed.get_backend() == "gloo":
            # A sum's tensor may outlive it in a thread, which then aborts a process that ends.
            torch.distributed.barrier()
        else:
            self.add_up(torch.zeros(1))

    def add_up(self, values: Tensor) -> Tensor:
        """The tensor with the sum over all processes in its place."""
        if self.world > 1:
            import torch.distributed

            torch.distributed.all_reduce(values)
        return values

    def share(self, items: Sequence[Item]) -> list[Item]:
        """This process's part of the items that all share."""
        return list(items[self.rank :: self.world])

    def device(self, device: str) -> str:
        """The device of this process: a GPU of its own, where there are any."""
        if self.world == 1 or device not in ("auto", "cuda"):
            return device
        import torch

        if not torch.cuda.is_available():
            return device
        return f"cuda:{self.local % torch.cuda.device_count()}"

    @contextlib.contextmanager
    def one_voice(self) -> Iterator[None]:
        """A mistake of the user that every process finds is told by the first alone, which the
        others outlive: a launcher ends all when one has ended.
        """
        try:
            yield
        except PlannerError:
            if self.leads:
                raise
            with contextlib.suppress(RuntimeError):  # The first has gone.
                self.wait()
            raise SystemExit(2) from None

    @property
    def local(self) -> int:
        """Its place on this machine."""
        return int(os.environ.get("LOCAL_RANK", self.rank))


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
    # Processes meet on the CPU; only what lies on GPUs goes by their own way.
    backend = "cpu:gloo,cuda:nccl" if torch.cuda.is_available() else "gloo"
    torch.distributed.init_process_group(backend, timeout=LONGEST_WAIT)
    atexit.register(_leave)
    return Ranks(torch.distributed.get_rank(), torch.distributed.get_world_size())


def _leave() -> None:
    import torch.distributed

    # accelerate's trackers may have left already.
    if torch.distributed.is_initialized():
        torch.distributed.destroy_process_group()
