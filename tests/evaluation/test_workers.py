"""A worker lowers its priority once, at any depth, and starts with imported modules."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from svsa.evaluation.workers import set_up_worker, start_workers
from svsa.numerics.separate_compilation import OOM_SCORE, build_child


def lower_priority_again() -> int:
    set_up_worker()
    return os.nice(0)


def list_read() -> set[str]:
    return set(sys.modules)


def test_worker_of_a_worker_has_its_priority() -> None:
    with start_workers(1) as pool:
        assert pool.submit(lower_priority_again).result() == max(10, os.nice(0))


READ_OOM_SCORE = "print(open('/proc/self/oom_score_adj').read())"


def read_oom_scores() -> tuple[int, int]:
    """Return the score of this process, and of one that it starts, as a grader starts a law."""
    started = subprocess.check_output([sys.executable, "-c", READ_OOM_SCORE])
    return int(Path("/proc/self/oom_score_adj").read_text()), int(started)


@pytest.mark.skipif(sys.platform != "linux", reason="a setting of Linux")
def test_kernel_ends_workers_laws_and_compilers_before_the_server() -> None:
    before = read_oom_scores()
    with start_workers(1) as pool:
        assert pool.submit(read_oom_scores).result() == (OOM_SCORE, OOM_SCORE)
    assert int(subprocess.check_output(build_child(READ_OOM_SCORE))) == OOM_SCORE
    assert read_oom_scores() == before
    assert before[0] < OOM_SCORE


@pytest.mark.skipif(sys.platform != "linux", reason="there each worker reads all for itself")
def test_worker_has_the_modules_imported_before_its_start() -> None:
    with start_workers(1) as pool:
        pool.submit(os.getpid).result()
        assert "svsa.numerics.code_cache" in pool.submit(list_read).result()


STRUCK_WHILE_IMPORTING = """
import multiprocessing.forkserver, os, signal
from svsa.evaluation.workers import start_workers

if __name__ == "__main__":
    with start_workers(1) as pool:
        os.kill(multiprocessing.forkserver._forkserver._forkserver_pid, signal.SIGINT)
        print(pool.submit(os.getpid).result() > 0)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="there no process is forked")
def test_ctrl_c_during_the_imports_of_a_worker_is_left_to_the_command() -> None:
    answer = subprocess.run(
        [sys.executable, "-c", STRUCK_WHILE_IMPORTING],
        capture_output=True,
        text=True,
        timeout=300,
        check=False,
    )
    assert (answer.stdout, answer.stderr) == ("True\n", "")
