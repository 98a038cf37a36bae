"""An interrupted run in Jupyter preserves the kernel and its variables."""

import time

import pytest
from jupyter_client.manager import start_new_kernel

WAIT_S = 120.0
BEGIN = """
import svsa
kept = 42
before = svsa.simulate("4a", duration_s=0.1).samples.tobytes()
"""
LONG = """
print("running", flush=True)
while True:
    svsa.simulate("4a", duration_s=1000.0)
"""
AFTER = """
after = svsa.simulate("4a", duration_s=0.1).samples.tobytes()
print(kept, after == before)
"""


@pytest.mark.wall_clock
def test_interrupt_preserves_the_kernel_and_its_variables():
    manager, client = start_new_kernel(kernel_name="python3")
    printed = []

    def note(message):
        if message["msg_type"] == "stream" and message["content"]["name"] == "stdout":
            printed.append(message["content"]["text"])
            if printed[-1] == "running\n":
                time.sleep(0.1)
                manager.interrupt_kernel()

    def run(source):
        """Run a cell; the name of the error that it raises, or None."""
        answer = client.execute_interactive(source, output_hook=note, timeout=WAIT_S)
        return answer["content"].get("ename")

    try:
        assert run(BEGIN) is None
        for _ in range(5):
            assert run(LONG) == "KeyboardInterrupt"
        assert run(AFTER) is None
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    assert printed[-1] == "42 True\n"
