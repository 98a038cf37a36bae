"""Commands print on terminals that lack Greek letters and mathematical signs."""

import os
import subprocess
import sys

import pytest

EVERY_HELP = """
import sys
import typer
from svsa.cli import app, main
from svsa.inputs.terminal import spell_missing_characters

spell_missing_characters()
group = typer.main.get_command(app)
def show(command, path):
    command.main([*path, "--help"], standalone_mode=False)
    for name, inner in getattr(command, "commands", {}).items():
        inner.main(["--help"], prog_name=f"svsa {name}", standalone_mode=False)
show(group, [])
sys.argv = ["svsa", "datasheet", "svsa"]
main()
"""


@pytest.mark.long
@pytest.mark.parametrize(
    ("encoding", "expected"),
    [
        ("ascii", "sigma at phi = 0 [N*m/rad]"),
        pytest.param("cp1252", "sigma at phi = 0 [N·m/rad]", marks=pytest.mark.exhaustive),
        pytest.param("utf-8", "σ at φ = 0 [N·m/rad]", marks=pytest.mark.exhaustive),
    ],
)
def test_help_and_tables_are_printed_in_any_encoding(encoding: str, expected: str) -> None:
    answer = subprocess.run(
        [sys.executable, "-c", EVERY_HELP],
        env=os.environ | {"PYTHONIOENCODING": encoding, "COLUMNS": "160"},
        capture_output=True,
        timeout=300,
        check=False,
    )
    assert answer.returncode == 0, answer.stderr.decode(encoding)
    assert expected in answer.stdout.decode(encoding)
