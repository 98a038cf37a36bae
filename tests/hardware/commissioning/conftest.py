"""The bus of a rig, and the file of its bench."""

import pytest

from tests.hardware.emulator.bus_in_time import RigBus, copy_bench


@pytest.fixture
def bus():
    return RigBus()


@pytest.fixture
def path(tmp_path):
    return copy_bench(tmp_path)
