"""The notebooks of the tutorials run from the first cell to the last, in a kernel."""

import os
import re
from pathlib import Path

import nbformat
import pytest
from nbclient import NotebookClient

import svsa

FOLDER = Path(__file__).parents[2] / "docs" / "tutorials"
NOTEBOOKS = sorted(FOLDER.glob("*.ipynb"))


def check_first_script(printed):
    """FL keeps an error under load; a fast observer has a smaller error and more noise."""
    steady = dict(re.findall(r"^(\w+) +steady, with load +([\d.]+)° rms", printed, re.MULTILINE))
    assert float(steady["FL"]) > 1000 * float(steady["NDOBC"])
    rows = re.findall(r"^ *\d+ +([\d.]+)° +[\d.]+° +([\d.]+) N·m$", printed, re.MULTILINE)
    ideal, noise = ([float(number) for number in column] for column in zip(*rows, strict=True))
    assert len(rows) == 4
    assert ideal == sorted(ideal, reverse=True)
    assert noise == sorted(noise)
    # The text states that the rig has encoders and a delay, and no sensor noise.
    assert svsa.RIG.encoders
    assert svsa.RIG.delay_samples
    assert svsa.RIG.noise is None


def check_own_law(printed):
    """The law of the tutorial is the lab's FL to rounding errors."""
    difference = re.search(r"largest difference in position: (\S+) rad", printed)
    assert difference
    assert float(difference[1]) < 1e-9


CLAIMS = {"first_script": check_first_script, "own_law": check_own_law}
"""Checks of what the text of a notebook states about the output of its cells."""


@pytest.mark.exhaustive
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook_runs_and_is_stored_without_output(path, tmp_path, monkeypatch):
    notebook = nbformat.read(path, as_version=4)
    cells = [cell for cell in notebook.cells if cell.cell_type == "code"]
    assert not any(cell.outputs or cell.execution_count for cell in cells)
    monkeypatch.setitem(os.environ, "SVSA_DATA", str(tmp_path / "data"))
    folder = {"metadata": {"path": str(tmp_path)}}
    NotebookClient(notebook, timeout=600, resources=folder).execute()
    shown = [kind for cell in cells for output in cell.outputs for kind in output.get("data", {})]
    assert "image/png" in shown
    errors = [output for cell in cells for output in cell.outputs if output.get("name") == "stderr"]
    assert not errors
    texts = [output.get("text", "") for cell in cells for output in cell.outputs]
    CLAIMS[path.stem]("".join(texts))
