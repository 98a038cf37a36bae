"""A study in a separate process that is ended before it is complete."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

from svsa.evaluation.studies.rows import find_missing
from svsa.evaluation.studies.store import keep_study
from svsa.evaluation.studies.stored import StoredStudy
from tests.evaluation.studies.studies import build_study

SCRIPT = """
import contextlib
import signal
import sys
import time
from pathlib import Path
from svsa.evaluation.studies.execution import run_study
from svsa.evaluation.studies.store import keep_study
from tests.evaluation.studies.studies import build_study

def tell(done, total):
    print(done, flush=True)
    if done >= 48:
        time.sleep(300)  # to be ended here

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # a shell's background ignores it
    stored = keep_study("one", build_study(runs=400), Path(sys.argv[1]))
    with contextlib.ExitStack() as stack:
        if sys.argv[2].isdigit():
            workers, run_parts = int(sys.argv[2]), None
        else:
            from svsa.evaluation.studies.cluster import open_cluster
            workers, run_parts = 0, stack.enter_context(open_cluster(sys.argv[2], 2)).run_parts
        run_study(stored, workers, 16, tell, run_parts=run_parts)
"""


def end_before_completion(root: Path, how: signal.Signals, whom: str) -> StoredStudy:
    """Return the study `one` of 400 samples in `root`, partly complete when its process was ended.

    whom: the number of workers that run it, or the address of a scheduler.
    """
    script = root / "script.py"
    script.write_text(SCRIPT)
    process = subprocess.Popen(
        [sys.executable, str(script), str(root), whom],
        stdout=subprocess.PIPE,
        env=os.environ | {"PYTHONPATH": str(Path(__file__).parents[3])},
        start_new_session=True,
    )
    assert process.stdout is not None
    for line in process.stdout:
        if int(line) >= 48:
            break
    process.send_signal(how)
    process.wait(300)
    assert process.returncode == (0 if how == signal.SIGINT else -signal.SIGKILL)
    wait_for_group_to_end(process.pid)
    stored = keep_study("one", build_study(runs=400), root)
    assert 0 < sum(stop - first for first, stop in find_missing(stored)) < 400 - 20
    return stored


def wait_for_group_to_end(group: int) -> None:
    """Wait until the workers have ended with their parent; bounded for a busy machine."""
    for _ in range(3000):
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return
        time.sleep(0.1)
    raise AssertionError("a worker outlived the study")
