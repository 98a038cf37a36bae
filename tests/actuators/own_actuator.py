"""The package of the tutorial on an own actuator, installed into a folder."""

import subprocess
import sys
from pathlib import Path

from tests.docs.pages import ROOT, read_blocks

TUTORIAL = ROOT / "docs" / "tutorials" / "own_actuator.md"


def install_own_actuator(folder: Path) -> Path:
    """Install what the tutorial prints; the folder for PYTHONPATH."""
    source, target = folder / "source", folder / "installed"
    source.mkdir()
    for block in read_blocks(TUTORIAL):
        if block.note == "file":
            (source / block.subject).write_text(block.text, encoding="utf-8")
    install = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    install += ["--no-build-isolation", "--disable-pip-version-check", "--target", str(target)]
    subprocess.run([*install, str(source)], check=True, timeout=300, capture_output=True)
    return target
