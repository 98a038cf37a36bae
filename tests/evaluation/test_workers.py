"""A worker lowers its priority once, at any depth, and starts with imported modules."""

import os
import sys

import pytest

from svsa.evaluation.workers import set_up_worker, start_workers


def lower_priority_again() -> int:
    set_up_worker()
    return os.nice(0)


def list_read() -> set[str]:
    return set(sys.modules)


def test_worker_of_a_worker_has_its_priority() -> None:
    with start_workers(1) as pool:
        assert pool.submit(lower_priority_again).result() == max(10, os.nice(0))


@pytest.mark.skipif(sys.platform != "linux", reason="there each worker reads all for itself")
def test_worker_has_the_modules_imported_before_its_start() -> None:
    with start_workers(1) as pool:
        pool.submit(os.getpid).result()
        assert "svsa.numerics.code_cache" in pool.submit(list_read).result()
