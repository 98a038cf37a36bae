"""The bus of an emulator, and the file of its bench."""

import pytest

from tests.hardware.emulator.bus_in_time import EmulatorBus, copy_bench


@pytest.fixture
def bus():
    return EmulatorBus()


@pytest.fixture
def path(tmp_path):
    return copy_bench(tmp_path)
