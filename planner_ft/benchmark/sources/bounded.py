"""Running a function over items in a bounded number of threads, results as they come."""

from __future__ import annotations

import queue
import threading
from collections.abc import Callable, Iterator, Sequence
from typing import TypeVar

Item = TypeVar("Item")
Result = TypeVar("Result")


def bounded(
    function: Callable[[Item], Result],
    items: Sequence[Item],
    workers: int,
    on_failure: Callable[[], None],
) -> Iterator[tuple[int, Result]]:
    """Yield (index of the item, result) as results come, at most `workers` at a time.

    When a call raises, `on_failure` is called, no further item is begun, those that were begun are
    waited for and yielded if they succeed, and then the first exception is raised: nothing that was
    paid for is lost. The threads are daemons, so that a program can end while a server hangs.
    """
    waiting: queue.SimpleQueue[int] = queue.SimpleQueue()
    for index in range(len(items)):
        waiting.put(index)
    done: queue.SimpleQueue[tuple[int, Result | None, BaseException | None]] = queue.SimpleQueue()
    failed = threading.Event()

    def work() -> None:
        while not failed.is_set():
            try:
                index = waiting.get_nowait()
            except queue.Empty:
                break
            try:
                done.put((index, function(items[index]), None))
            except BaseException as error:
                failed.set()
                on_failure()
                done.put((index, None, error))
        done.put((-1, None, None))

    running = min(workers, len(items))
    for _ in range(running):
        threading.Thread(target=work, daemon=True).start()
    failure: BaseException | None = None
    try:
        while running:
            index, result, error = done.get()
            if index < 0:
                running -= 1
            elif error is not None:
                failure = failure or error
            else:
                yield index, result  # type: ignore[misc]  # a result stands where there is no error
    finally:
        failed.set()
    if failure is not None:
        raise failure
