"""A worker lowers its priority once, at any depth, and starts with modules already imported."""

import os
import sys

import pytest

from svsa.evaluation.workers import give_way, start_workers


def give_way_again() -> int:
    give_way()
    return os.nice(0)


def list_read() -> set[str]:
    return set(sys.modules)


def test_a_workers_worker_has_its_priority() -> None:
    with start_workers(1) as pool:
        assert pool.submit(give_way_again).result() == max(10, os.nice(0))


@pytest.mark.skipif(sys.platform != "linux", reason="there each worker reads all for itself")
def test_a_worker_has_what_was_read_when_the_first_began() -> None:
    with start_workers(1) as pool:
        pool.submit(os.getpid).result()
        assert "svsa.numerics.code_cache" in pool.submit(list_read).result()
