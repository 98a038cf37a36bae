"""Compile the installed laws in the background, so that selecting one takes no time."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from svsa.control.installed import get_law, is_usable, list_law_names
from svsa.numerics.compilation import is_compiled_before

END_S = 2.0
_LOWEST_PRIORITY = 19
_COMPILE = (
    f"import os; os.nice({_LOWEST_PRIORITY}); from svsa.cli import main; main()",
    "compile",
)


def _is_compiled(control: Any) -> bool:
    return not hasattr(control, "py_func") or is_compiled_before(control)


@contextmanager
def compile_laws() -> Iterator[None]:
    """Compile every installed law into the cache, in a separate process.

    It has the least priority, and ends with what is done here at the latest.
    """
    if all(_is_compiled(get_law(name).control) for name in filter(is_usable, list_law_names())):
        yield
        return
    process = subprocess.Popen(  # noqa: S603  this program itself
        [sys.executable, "-c", *_COMPILE],
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
