"""Compile in the background what users may select: the laws, and the loop of other actuators."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from svsa.actuators.installed import list_mechanism_names
from svsa.actuators.parameters import SVSA
from svsa.control.installed import PAPERS_LAW, get_law, is_usable, list_law_names
from svsa.numerics.compilation import is_compiled_before
from svsa_server.compiled_loops import LOWEST_PRIORITY, is_compiled_for

OTHER = next(name for name in list_mechanism_names() if name != SVSA)
"""An actuator with the loop that all but the SVSA share."""
PREPARE = (
    f"import os; os.nice({LOWEST_PRIORITY}); from svsa.cli import prepare;"
    f" prepare(); prepare([{PAPERS_LAW!r}], {OTHER!r})"
)
END_S = 2.0


def _is_compiled(control: Any) -> bool:
    return not hasattr(control, "py_func") or is_compiled_before(control)


@contextmanager
def compile_laws() -> Iterator[None]:
    """Compile every installed law and the loop of other actuators, in a separate process.

    It has the lowest priority, and ends with the block at the latest.
    """
    laws = [get_law(name).control for name in filter(is_usable, list_law_names())]
    if all(map(_is_compiled, laws)) and is_compiled_for(OTHER, PAPERS_LAW):
        yield
        return
    process = subprocess.Popen(  # noqa: S603  this program itself
        [sys.executable, "-c", PREPARE],
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    try:
        yield
    finally:
        process.terminate()
        try:
            process.wait(END_S)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
