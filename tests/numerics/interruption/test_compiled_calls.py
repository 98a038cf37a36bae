"""A signal whose handler raises interrupts a compiled call without ending the interpreter."""

import json
import subprocess
import sys

import pytest

SECONDS_EACH = (0.1, 0.3)
"""The first interrupts every function, most of them some hundred times."""
CHECKED = {"NoneType", "Boolean", "Integer", "Float", "Array"}
"""Types that numba or `svsa.numerics.boxing` returns to Python with a check of every object."""


@pytest.mark.exhaustive
@pytest.mark.parametrize("seconds", SECONDS_EACH)
def test_signals_interrupt_every_compiled_function_called_from_python(seconds):
    process = subprocess.run(
        [sys.executable, "-m", "tests.numerics.interruption.struck", str(seconds)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert process.returncode == 0, process.stderr[-2000:]
    found = [json.loads(line) for line in process.stdout.splitlines()]
    never_called = [one["name"] for one in found if one["interruptions"] is None]
    assert not never_called, "add a call of these to tests/numerics/interruption/workloads.py"
    assert all(one["interruptions"] > 0 for one in found)
    unchecked = {one["name"]: one["returns"] for one in found if set(one["returns"]) - CHECKED}
    assert not unchecked, "svsa/numerics/boxing.py does not check how these types return to Python"
