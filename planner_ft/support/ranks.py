"""Several processes that share one run, as `accelerate launch` or torchrun starts them, or as a run
starts one to help it.
"""

from __future__ import annotations

import contextlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from datetime import timedelta
from typing import TYPE_CHECKING, Any, TypeVar

from planner_ft.support.errors import PlannerError
from planner_ft.support.resources import end_with_parent

if TYPE_CHECKING:
    from torch import Tensor

Item = TypeVar("Item")
HELPED = "PLANNER_FT_HELPED"
"""A variable with the port at which a helper meets the process that it helps."""
SOON = 120.0
"""Seconds that a helper is waited for."""
ENDING = 5.0
"""Seconds in which a process that is ending ends."""
LONGEST_WAIT = timedelta(days=14)
"""A process may wait for the others as long as these answer; one that fails ends them all through
its launcher.
"""


@dataclass(frozen=True)
class Ranks:
    """This process's place among those that share a run. Rank 0 owns the folder: of the others,
    those of a benchmark add answers to its predictions.jsonl. In training each takes whole batches,
    or a part of each where they are `divided`: then steps are those of one process.
    """

    rank: int = 0
    world: int = 1
    divided: bool = False

    @property
    def leads(self) -> bool:
        return self.rank == 0

    @property
    def batches(self) -> int:
        """The batches that are trained on together."""
        return 1 if self.divided else self.world

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

    def stretch(self, items: Sequence[Item]) -> list[Item]:
        """This process's part of the items that all share, neighbours of each other."""
        ends = (len(items) * number // self.world for number in (self.rank, self.rank + 1))
        return list(items[slice(*ends)])

    def parts(self, batches: Sequence[Sequence[Item]]) -> list[Sequence[Item]]:
        """This process's part of the batches of a step."""
        if not self.divided:
            return self.share(batches)
        return [own for batch in batches if (own := batch[self.rank :: self.world])]

    def gather(self, own: list[Item]) -> list[Item]:
        """All items in their order, of which this process has its `own` share."""
        import torch.distributed

        every = [own] * self.world
        if self.world > 1:
            torch.distributed.all_gather_object(every, own)
        return [part[at] for at in range(len(every[0])) for part in every if at < len(part)]

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
    if port := os.environ.get(HELPED):
        store = _store(int(port))
        store.set(HELPED, "here")
        return _meet(store, 1)
    # Processes meet on the CPU; only what lies on GPUs goes by their own way.
    backend = "cpu:gloo,cuda:nccl" if torch.cuda.is_available() else "gloo"
    torch.distributed.init_process_group(backend, timeout=LONGEST_WAIT)
    atexit.register(_leave)
    return Ranks(torch.distributed.get_rank(), torch.distributed.get_world_size())


@contextlib.contextmanager
def helped() -> Iterator[Ranks]:
    """In the block, a second process with this one's command line does half of its work; alone
    where it does not come. Raises PlannerError where it ends before.
    """
    store = _store()
    told = {"RANK": "1", "WORLD_SIZE": "2", HELPED: str(store.port)}
    words, nothing = [sys.executable, "-m", "planner_ft", *sys.argv[1:]], subprocess.DEVNULL
    helper = subprocess.Popen(
        words, env=os.environ | told, stdin=nothing, stdout=nothing, start_new_session=True
    )
    try:
        if not _comes(store, helper):
            yield ALONE
            return
        try:
            yield _meet(store, 0)
        except RuntimeError as error:
            with contextlib.suppress(subprocess.TimeoutExpired):
                # Its connections close before it has ended.
                helper.wait(ENDING)
            if not helper.returncode:
                raise
            ended = f"the process that helped this one ended (status {helper.returncode})"
            raise PlannerError(f"{ended}; go on with --resume") from error
        finally:
            _leave()
    finally:
        helper.kill()
        helper.wait()


def _store(port: int = 0) -> Any:
    """Where two processes of this machine meet; without a port a new one."""
    from torch.distributed import TCPStore  # type: ignore[attr-defined]

    return TCPStore("127.0.0.1", port, 2, is_master=not port, wait_for_workers=False)


def _comes(store: Any, helper: subprocess.Popen[bytes]) -> bool:
    """Whether the helper comes soon."""
    until = time.monotonic() + SOON
    while (
        not (here := store.check([HELPED])) and helper.poll() is None and time.monotonic() < until
    ):
        time.sleep(0.05)
    return bool(here)


def _meet(store: Any, rank: int) -> Ranks:
    """Two processes of this machine."""
    import atexit

    import torch.distributed

    if sys.platform == "linux":
        os.environ.setdefault("GLOO_SOCKET_IFNAME", "lo")
    known = {"store": store, "rank": rank, "world_size": 2, "timeout": LONGEST_WAIT}
    torch.distributed.init_process_group("gloo", **known)
    atexit.register(_leave)
    return Ranks(rank, 2, divided=True)


def _leave() -> None:
    import torch.distributed

    # accelerate's trackers may have left already.
    if torch.distributed.is_initialized():
        torch.distributed.destroy_process_group()
