"""The bus of an emulator, its bench file, and the motion of its motors under the check's pulses."""

import pytest

from svsa.hardware.commissioning.drives import bring_up
from svsa.hardware.commissioning.motion import check_motion
from svsa.hardware.commissioning.probe import Probe
from svsa.hardware.description.file import read_bench
from tests.hardware.emulator.bus_in_time import EMULATOR_BENCH, EmulatorBus, copy_bench


@pytest.fixture
def bus():
    return EmulatorBus()


@pytest.fixture
def path(tmp_path):
    return copy_bench(tmp_path)


@pytest.fixture(scope="package")
def turns():
    """Turn each motor of the emulated bench, whose deflection rests at 0 counts."""
    bus = EmulatorBus()
    probe = Probe(read_bench(EMULATOR_BENCH), bus.open, bus.now)
    probe.open()
    bring_up(probe)
    found = {name: check_motion(probe, name)[1] for name in probe.motors}
    probe.close()
    return found
