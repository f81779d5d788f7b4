"""Batches: longest first, doubled until memory runs out, halved then, nothing lost
and nothing asked twice without need.
"""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from planner_ft.benchmark.sources import BatchSize, in_batches
from planner_ft.support.errors import PlannerError


class Device:
    """Answers batches up to a size; of larger ones only the first answer comes before memory runs
    out.
    """

    def __init__(self, fits: int, early: int = 0) -> None:
        self.fits = fits
        self.early = early
        self.batches: list[list[int]] = []

    def ask(self, indices: list[int]) -> Iterator[tuple[int, str]]:
        self.batches.append(indices)
        for place, index in enumerate(indices):
            if len(indices) > self.fits and place == self.early:
                raise MemoryError
            yield place, f"answer {index}"

    def run(self, lengths: list[int], batch: BatchSize) -> dict[int, str]:
        found = [
            (index, answer)
            for index, answer, _size in in_batches(
                self.ask, lengths, batch, lambda error: isinstance(error, MemoryError)
            )
        ]
        assert len(found) == len(dict(found)), "an index was answered twice"
        return dict(found)


LENGTHS = [3, 9, 1, 7, 5, 2, 8, 4, 6, 0]
WHOLE = {index: f"answer {index}" for index in range(len(LENGTHS))}


def test_longest_queries_come_first() -> None:
    device = Device(fits=100)
    assert device.run(LENGTHS, BatchSize(4, 4)) == WHOLE
    assert [[LENGTHS[index] for index in batch] for batch in device.batches] == [
        [9, 8, 7, 6],
        [5, 4, 3, 2],
        [1, 0],
    ]


@pytest.mark.parametrize("early", [0, 1, 3])
def test_the_size_is_halved_until_it_fits_and_answers_that_came_are_kept(early: int) -> None:
    device, batch = Device(fits=2, early=early), BatchSize(8, 8)
    assert device.run(LENGTHS, batch) == WHOLE
    assert batch.size == 2
    assert [len(asked) for asked in device.batches[:2]] == [8, 4]
    assert all(len(asked) <= 2 for asked in device.batches[2:])
    # The answers that came before memory ran out are not asked for again.
    assert sum(len(asked) for asked in device.batches) == 8 - early + 4 - early + len(LENGTHS)


def test_a_size_that_did_not_fit_is_not_tried_again() -> None:
    device, batch = Device(fits=3), BatchSize(4, 64)
    assert device.run(LENGTHS, batch) == WHOLE
    assert [len(asked) for asked in device.batches] == [4, 2, 2, 2, 2, 2]


def test_the_size_is_doubled_up_to_the_largest() -> None:
    device = Device(fits=100)
    assert device.run([1] * 40, BatchSize(2, 8)) == {
        index: f"answer {index}" for index in range(40)
    }
    assert [len(asked) for asked in device.batches] == [2, 4, 8, 8, 8, 8, 2]


def test_the_size_is_doubled_until_memory_runs_out() -> None:
    device = Device(fits=5)
    assert len(device.run([1] * 20, BatchSize(2, 64))) == 20
    assert [len(asked) for asked in device.batches] == [2, 4, 8, 4, 4, 4, 2]


def test_a_single_query_that_does_not_fit_is_one_sentence() -> None:
    with pytest.raises(PlannerError, match="too little memory for a single query"):
        Device(fits=0).run([1, 2], BatchSize(2, 2))


def test_other_errors_are_not_taken_for_a_full_memory() -> None:
    def broken(_indices: list[int]) -> Iterator[tuple[int, str]]:
        raise ValueError("rubbish")
        yield

    with pytest.raises(ValueError, match="rubbish"):
        list(in_batches(broken, [1], BatchSize(1, 1), lambda error: isinstance(error, MemoryError)))
