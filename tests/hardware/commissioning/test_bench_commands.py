"""The commands `svsa bench-check` and `svsa bench-home`."""

import time

import pytest
from typer import Typer
from typer.testing import CliRunner

from svsa.hardware.cli import bench_check, bench_home
from svsa.hardware.description.calibration import find_calibration
from svsa.hardware.description.file import read_bench
from svsa.hardware.emulator.launch import start_emulator
from tests.hardware.emulator.bus_in_time import copy_bench

APP = Typer()
APP.command("bench-check")(bench_check)
APP.command("bench-home")(bench_home)


def test_command_moves_nothing_without_permission(tmp_path):
    """The answer no, and no emulator on the port: the question precedes the opening of the bus."""
    result = CliRunner().invoke(
        APP, ["bench-check", str(copy_bench(tmp_path)), "--move"], input="n\n"
    )
    assert result.exit_code == 1
    assert "emergency stop" in result.output
    assert "drive 0.1" not in result.output


def test_command_ends_with_an_error_if_a_step_fails(tmp_path):
    result = CliRunner().invoke(APP, ["bench-check", str(tmp_path / "none.toml")])
    assert result.exit_code == 1
    assert "Give the path of a bench file" in result.output


def test_command_names_the_fields_of_the_bench_file_with_their_sections(tmp_path):
    path = copy_bench(tmp_path, lambda text: text.replace("sign = 1\n", "").replace("29536", "1"))
    result = CliRunner().invoke(APP, ["bench-check", str(path)])
    assert "motor1.sign is not given" in result.output
    assert "deflection.sign is not given" in " ".join(result.output.split())


@pytest.mark.exhaustive
@pytest.mark.wall_clock
def test_commands_run_over_a_socket_in_real_time(tmp_path):
    """An emulator in a separate process, with python-can: the record is written, all drives are
    off.
    """
    with start_emulator(lockstep=False) as emulator:
        path = copy_bench(tmp_path, lambda text: text.replace("29536", str(emulator.port)))
        path.with_name("bench.calibration.toml").unlink()
        homed = CliRunner().invoke(APP, ["bench-home", str(path), "--by", "Ada"], input="y\ny\ny\n")
        assert homed.exit_code == 0, homed.output
        assert "run `svsa bench-check --move`" in " ".join(homed.output.split())
        checked = CliRunner().invoke(APP, ["bench-check", str(path), "--move"], input="y\ny\ny\n")
        path.write_text(path.read_text("utf-8").replace("= 8000", "= 2000"), "utf-8")
        time.sleep(1.5)  # A drive does not respond for half a second after a reset.
        wrong = CliRunner().invoke(APP, ["bench-check", str(path), "--move"], input="y\ny\ny\n")
        drives = emulator.control.read_state()["drives"]
    assert "motor2: scale" in checked.output, checked.output
    assert checked.exit_code == 0, checked.output
    assert wrong.exit_code == 1
    assert "Set counts_per_rev in [deflection] to about" in " ".join(wrong.output.split())
    calibration = find_calibration(read_bench(path))
    assert calibration is not None and calibration.by == "Ada"
    for drive in drives.values():
        assert drive["mode"] is None and drive["commanded_ma"] == 0
