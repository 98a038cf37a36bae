"""The machine's C compiler, for what is compared with C."""

import os
import shutil

FLAGS = ("-O3", "-march=native", "-fno-math-errno", "-fno-trapping-math")


def find_c_compiler() -> str | None:
    """$CC, or cc where there is one."""
    return os.environ.get("CC") or shutil.which("cc")
