"""Flags in the files of a bench are true or false: 0, 1 and words are rejected."""

from pathlib import Path
from typing import Any

import pytest

from svsa.errors import ParameterError
from svsa.hardware.description.calibration import Calibration, find_calibration
from svsa.hardware.description.file import EmulatorSettings, read_bench
from svsa.hardware.encoders.can_node import CanNodeSettings
from svsa.hardware.encoders.serial_line import SerialLineSettings
from svsa.inputs.checked import Checked
from tests.hardware.wired_bench import EMULATOR_BENCH

BENCH = read_bench(EMULATOR_BENCH)
FLAGS: list[tuple[Checked, str]] = [
    *((CanNodeSettings(id=0x700), name) for name in ("extended", "big_endian", "signed")),
    (SerialLineSettings(port="/dev/ttyUSB0"), "binary"),
    (EmulatorSettings(control_port=1), "lockstep"),
    *((BENCH.safety, name) for name in ("dead_man", "needs_watcher")),
]


@pytest.mark.parametrize(("settings", "name"), FLAGS, ids=[name for _, name in FLAGS])
@pytest.mark.parametrize("value", [1, 0, "yes", "false", 1.0])
def test_flag_is_true_or_false(settings: Checked, name: str, value: Any) -> None:
    with pytest.raises(ParameterError, match=name):
        settings.changed(**{name: value})
    assert getattr(settings.changed(**{name: True}), name) is True


@pytest.mark.parametrize("value", ["1", '"true"', '"on"'])
def test_signs_are_confirmed_by_true_only(tmp_path: Path, value: str) -> None:
    """A bench with confirmed signs may arm: a typing error must not confirm them."""
    text = EMULATOR_BENCH.with_name("bench.calibration.toml").read_text(encoding="utf-8")
    assert "signs_confirmed = true" in text
    bench = BENCH.changed(path=str(tmp_path / "bench.toml"))
    record = tmp_path / "bench.calibration.toml"
    record.write_text(text, encoding="utf-8")
    assert isinstance(find_calibration(bench), Calibration)
    record.write_text(text.replace("confirmed = true", f"confirmed = {value}"), encoding="utf-8")
    with pytest.raises(ParameterError, match="signs_confirmed"):
        find_calibration(bench)
