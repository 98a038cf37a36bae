"""The bench's own loop on the emulated rig, through sockets and in lockstep."""

import numpy as np
import pytest

from svsa.experiment.bench_run import LockstepBench, connect_bench
from svsa.experiment.paper import FIGURES, LOAD_TIME_S, get_figure
from svsa.hardware.machine import BenchStatus
from svsa.plant.disturbances import ConstantLoad
from svsa.rig.launch import start_rig
from svsa.signals import CHANNEL_INDEX

TICKS = 3000
LOADED_S = 1.0
LOAD = ConstantLoad(torque_nm=(2.0, 0.0, 0.0))
SETTLED = slice(2000, TICKS)


def run(law):
    """Three seconds of Figure 4A, with the cable's 2 N·m on the link from 1 s on; its samples."""
    assert LOADED_S < LOAD_TIME_S
    with start_rig(lockstep=True) as rig:
        bench = LockstepBench(rig, FIGURES["4a"].build_configuration(law), TICKS)
        try:
            bench.prepare()
            bench.start()
            rig.control.load(LOAD, at_s=bench.now() + LOADED_S)
            bench.tick(TICKS)
            assert bench.plant.fault is None
            assert bench.plant.status is BenchStatus.RUN
            assert bench.plant.emulated
            assert bench.plant.skipped_commands == 0
            drives = rig.control.read_state()["drives"].values()
            assert [drive["errors"] for drive in drives] == [0, 0]
        finally:
            bench.close()
        after = rig.control.read_state()["drives"].values()
        assert [(drive["mode"], drive["commanded_ma"]) for drive in after] == [(None, 0)] * 2
        return bench.sink.samples


@pytest.fixture(scope="module")
def compensated():
    return run("ndobc")


def read_worst(samples, name):
    return float(np.max(np.abs(samples[SETTLED, CHANNEL_INDEX[name]])))


def test_the_loop_compensates_the_load_through_the_wire(compensated):
    """A second after the load the link follows to a tenth of a degree, and ŵ knows the load."""
    assert np.all(np.isfinite(compensated[:, CHANNEL_INDEX["position_rad"]]))
    assert read_worst(compensated, "position_error_rad") < np.radians(0.2)
    seen = compensated[SETTLED, CHANNEL_INDEX["estimate_link_nm"]]
    assert np.mean(seen) == pytest.approx(2.0, abs=0.1)


def test_without_compensation_the_same_load_moves_the_link(compensated):
    """So that the test before has found the observer's work, not a load that was never there."""
    plain = run("fl")
    assert read_worst(plain, "position_error_rad") > 10.0 * read_worst(
        compensated, "position_error_rad"
    )


def test_the_same_run_gives_the_same_samples_to_the_bit(compensated):
    assert np.array_equal(run("ndobc"), compensated, equal_nan=True)


def test_500_hz_tracks_as_well() -> None:
    """At σ = 60 N·m/rad, from 1 s on; the drives' feedback comes every 2 ms then."""
    ticks = 1000
    with start_rig(lockstep=True) as rig:
        bench = connect_bench(rig)
        bench = bench.changed(timing=bench.timing.changed(period_s=0.002))
        wanted = get_figure("6b").build_configuration(load=False)
        loop = LockstepBench(rig, wanted, ticks, bench=bench)
        try:
            loop.prepare()
            loop.start()
            loop.tick(ticks)
            assert loop.plant.fault is None
        finally:
            loop.close()
    errors = loop.sink.samples[ticks // 2 :, CHANNEL_INDEX["position_error_rad"]]
    assert np.degrees(np.sqrt(np.mean(errors**2))) < 0.1
