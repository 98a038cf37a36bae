"""A deflection encoder at the counter of an NI card, with a package in the layout of nidaqmx."""

import math
import sys
import types

import pytest

from svsa.hardware.encoders.nidaqmx_counter import CounterSettings, NidaqmxCounter
from svsa.hardware.encoders.source import EncoderError

ONE_TURN = 2.0 * math.pi


class FakeError(Exception):
    """Like nidaqmx.errors.Error: the base class of the package's errors."""


class FakeChannels:
    def __init__(self, task):
        self._task = task

    def add_ci_ang_encoder_chan(
        self,
        counter,
        name_to_assign_to_channel="",
        decoding_type=None,
        zidx_enable=False,
        zidx_val=0,
        zidx_phase=None,
        units=None,
        pulses_per_rev=24,
        initial_angle=0.0,
        custom_scale_name="",
    ):
        if counter != "Dev1/ctr0":
            raise FakeError("Physical channel specified does not exist on this device.")
        self._task.asked = (decoding_type, units, pulses_per_rev, zidx_enable)
        self._task.channel = types.SimpleNamespace()
        return self._task.channel


class FakeTask:
    """The used part of nidaqmx.Task. angle: rad, None if the card is gone."""

    made: "list[FakeTask]" = []

    def __init__(self):
        self.ci_channels = FakeChannels(self)
        self.angle, self.running, self.closed = 0.0, False, False
        FakeTask.made.append(self)

    def start(self):
        self.running = True

    def read(self, number_of_samples_per_channel=None, timeout=10.0):
        assert self.running and not self.closed
        assert timeout <= 0.01
        if self.angle is None:
            raise FakeError("Device removed.")
        return self.angle

    def close(self):
        self.closed = True


@pytest.fixture
def card(monkeypatch):
    """A package in the layout of nidaqmx, with one card."""
    package, constants, errors = (
        types.ModuleType(f"nidaqmx{tail}") for tail in ("", ".constants", ".errors")
    )
    package.Task = FakeTask
    constants.AngleUnits = types.SimpleNamespace(RADIANS="radians")
    constants.EncoderType = types.SimpleNamespace(X_4="x4")
    errors.Error = FakeError
    for module in (package, constants, errors):
        monkeypatch.setitem(sys.modules, module.__name__, module)
    FakeTask.made.clear()
    return FakeTask.made


def test_counter_counts_every_edge(card):
    """2000 lines are 8000 counts per turn, read on demand, signed."""
    counter = NidaqmxCounter(CounterSettings(counter="Dev1/ctr0", lines=2000, a_terminal="PFI8"))
    counter.open()
    (task,) = card
    assert task.asked == ("x4", "radians", 2000, False)
    assert vars(task.channel) == {"ci_encoder_a_input_term": "PFI8"}
    for counts in (0, 1, -1, 8000, -123_457, 2**31 - 1, -(2**31)):
        task.angle = counts / 8000 * ONE_TURN
        assert counter.read(3.0) == (counts, 3.0)
    counter.close()
    assert task.closed
    assert counter.read(4.0) is None


def test_missing_or_lost_counter_is_reported(card):
    wrong = NidaqmxCounter(CounterSettings(counter="Dev7/ctr0", lines=2000))
    with pytest.raises(EncoderError, match=r"Dev7/ctr0.*driver"):
        wrong.open()
    assert card[0].closed
    counter = NidaqmxCounter(CounterSettings(counter="Dev1/ctr0", lines=2000))
    counter.open()
    card[1].angle = None
    with pytest.raises(EncoderError, match="Device removed"):
        counter.read(0.0)


def test_missing_package_is_reported_with_its_installation(monkeypatch):
    monkeypatch.setitem(sys.modules, "nidaqmx", None)
    counter = NidaqmxCounter(CounterSettings(counter="Dev1/ctr0", lines=2000))
    with pytest.raises(EncoderError, match=r"pip install 'svsa-lab\[nidaqmx\]'"):
        counter.open()
    counter.close()
