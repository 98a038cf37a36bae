"""The Python examples of README and documentation print what these show."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.lab import Lab

ROOT = Path(__file__).parents[2]
TIMEOUT_S = 400.0


@pytest.mark.exhaustive
@pytest.mark.parametrize("page", ["README.md", "docs/grading.md", "docs/scripting.md"])
def test_the_examples_of_a_page_print_what_it_shows(page: str, lab: Lab, tmp_path: Path) -> None:
    folders = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    environment = os.environ | {"SVSA_DATA": str(tmp_path / "data"), "PATH": folders}
    environment |= {"PYTHONPATH": str(ROOT), "MPLBACKEND": "agg"}
    done = subprocess.run(
        [sys.executable, "-m", "tests.docs.executed", str(ROOT / page), lab.url],
        cwd=tmp_path,
        env=environment,
        capture_output=True,
        text=True,
        timeout=TIMEOUT_S,
    )
    assert done.returncode == 0, done.stderr[-4000:]
