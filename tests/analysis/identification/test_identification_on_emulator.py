"""Identification of the emulator, through CAN: Table 1 within 5 %."""

import pytest

import svsa
from svsa.actuators.signals import CHANNELS
from svsa.analysis.identification.excitation import EXCITATION_DURATION_S, build_commands
from svsa.analysis.identification.identify import ACTUATOR, identify
from svsa.hardware.emulator.experiment import LockstepBench
from svsa.runs.definition.paper import get_figure
from svsa.runs.records.reader import build_record
from tests.hardware.emulator.in_process_emulator import start_in_process
from tests.runs.records.records import build_header


@pytest.mark.exhaustive
def test_identifies_table_1_within_5_percent():
    """A bench does not measure its disturbance; its torques are those sent, not the actual ones."""
    ticks = round(EXCITATION_DURATION_S / 0.001)
    later = build_commands(0.001)
    with start_in_process() as emulator:
        bench = LockstepBench(emulator, get_figure("6a").build_configuration(load=False), ticks)
        try:
            bench.prepare()
            bench.start()
            written = []
            while bench.sink.done < ticks:
                assert bench.plant.fault is None, bench.plant.fault
                while later and later[0].tick <= bench.sink.done:
                    command = later.pop(0)
                    tick = bench.loop.change(command)
                    written.append((tick, command.changed(tick=tick).to_json()))
                bench.tick()
        finally:
            bench.close()
    header = build_header(
        lanes=("lane1",),
        plant="emulated",
        configuration=bench.configuration.model_dump(mode="json"),
        channels=CHANNELS,
    )
    record = build_record(header, written, 0, bench.sink.samples[:, None, :])
    found = identify(record)
    assert not found.undetermined
    truth = svsa.load_prototype().actuator
    for name in ACTUATOR:
        assert found.estimates[name].value == pytest.approx(getattr(truth, name), rel=0.05), name
