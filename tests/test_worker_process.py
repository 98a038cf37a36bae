"""A worker gives way once, however deep it stands."""

import multiprocessing
import os
from concurrent.futures import ProcessPoolExecutor

from svsa.worker_process import give_way


def give_way_below_one_who_did():
    give_way()
    give_way()


def test_a_workers_worker_has_its_priority():
    spawn = multiprocessing.get_context("spawn")
    with ProcessPoolExecutor(1, spawn, give_way_below_one_who_did) as pool:
        assert pool.submit(os.nice, 0).result() == max(10, os.nice(0))
