"""The limits without torque, on an emulator in a separate process."""

import pytest

from svsa.hardware.emulator.experiment import LockstepBench
from svsa.hardware.emulator.launch import start_emulator
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.paper import get_figure
from svsa.simulation.plant.loads.constant import ConstantLoad


@pytest.mark.exhaustive
def test_link_turned_by_a_load_after_a_stop_ends_in_a_fault():
    with start_emulator(lockstep=True) as emulator:
        bench = LockstepBench(emulator, get_figure("4a").build_configuration(load=False), 1000)
        try:
            bench.prepare()
            bench.start()
            bench.tick(100)
            bench.plant.stop(bench.now(), "a test")
            bench.tick_until(BenchStatus.READY)
            emulator.control.load(ConstantLoad(torque_nm=(2.0, 0.0, 0.0)))
            while bench.plant.fault is None and bench.loop.reading is not None:
                bench.tick()
                assert bench.plant.status in (BenchStatus.READY, BenchStatus.FAULT)
                assert (q := abs(bench.loop.read_motion()["known"][0])) < 4.0
            fault = bench.plant.fault
            assert fault is not None and fault.code in ("position_limit", "overspeed")
            assert q < bench.bench.safety.link_position_max_rad + 0.2
        finally:
            bench.close()
