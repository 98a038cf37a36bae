"""The loop of the bench on the emulator in lockstep: in this process, once through sockets."""

import numpy as np
import pytest

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.control.installed import get_law, list_law_names
from svsa.hardware.emulator.experiment import LockstepBench, connect_bench
from svsa.hardware.emulator.launch import start_emulator
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.command import Set
from svsa.runs.definition.paper import FIGURES, LOAD_TIME_S, get_figure
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition
from tests.exhaustive import exhaust
from tests.hardware.emulator.in_process_emulator import start_in_process
from tests.runs.session.sessions import SHOWN_IN_BATCHES

TICKS = 3000
LOADED_S = 1.0
LOAD = ConstantLoad(torque_nm=(2.0, 0.0, 0.0))
SETTLED = slice(2000, TICKS)


def run(law, start=start_in_process):
    """Return the samples of 3 s of Figure 4A, with 2 N·m on the link from 1 s on."""
    return run_and_remember(law, start)[0]


def run_and_remember(law, start=start_in_process, load=LOAD):
    """Return the samples under this load, and the memory of the law at the end."""
    assert LOADED_S < LOAD_TIME_S
    with start() as emulator:
        bench = LockstepBench(emulator, FIGURES["4a"].build_configuration(law), TICKS)
        try:
            bench.prepare()
            bench.start()
            emulator.control.load(load, at_s=bench.now() + LOADED_S)
            bench.tick(TICKS)
            assert bench.plant.fault is None
            assert bench.plant.status is BenchStatus.RUN
            assert bench.plant.emulated
            assert bench.plant.skipped_commands == 0
            drives = emulator.control.read_state()["drives"].values()
            assert [drive["errors"] for drive in drives] == [0, 0]
            memory = bench.loop.run.lanes[0].memory.copy()
        finally:
            bench.close()
        after = emulator.control.read_state()["drives"].values()
        assert [(drive["mode"], drive["commanded_ma"]) for drive in after] == [(None, 0)] * 2
        return bench.sink.samples, memory


@pytest.fixture(scope="module")
def compensated():
    return run("ndobc")


def read_worst(samples, name):
    return float(np.max(np.abs(samples[SETTLED, CHANNEL_INDEX[name]])))


def test_loop_compensates_the_load_through_the_wire(compensated):
    """A second after the load the link follows to a tenth of a degree, and ŵ has converged."""
    assert np.all(np.isfinite(compensated[:, CHANNEL_INDEX["position_rad"]]))
    assert read_worst(compensated, "position_error_rad") < np.radians(0.2)
    seen = compensated[SETTLED, CHANNEL_INDEX["estimate_link_nm"]]
    assert np.mean(seen) == pytest.approx(2.0, abs=0.1)


def test_same_load_moves_the_link_without_compensation(compensated):
    """So that the previous test measures the effect of the observer, not a missing load."""
    plain = run("fl")
    assert read_worst(plain, "position_error_rad") > 10.0 * read_worst(
        compensated, "position_error_rad"
    )


def test_law_integrates_every_tick_of_the_bench():
    """FL + I without saturation: ∫e dt is T times the sum over all recorded ticks of q_d minus the
    q of the law, as in the simulated loop; it removes the load error without an observer.
    """
    load = ConstantLoad(torque_nm=(0.5, 0.0, 0.0))
    samples, memory = run_and_remember("fl_integral", load=load)
    limits = {"torque1_nm": 14.0, "torque2_nm": 4.5}
    assert all(np.max(np.abs(samples[:, CHANNEL_INDEX[n]])) < most for n, most in limits.items())
    reference, known = (
        samples[:, CHANNEL_INDEX[name]]
        for name in ("position_reference_rad", "position_estimate_rad")
    )
    assert memory[0] == pytest.approx(1e-3 * np.sum(reference - known), rel=1e-9)
    assert abs(memory[0]) > 1e-3, "the load has left something to remember"
    assert read_worst(samples, "position_error_rad") < np.radians(0.2)


@pytest.mark.parametrize("law", exhaust(list_law_names(), SHOWN_IN_BATCHES))
def test_every_law_is_reproducible_on_the_loop_of_the_bench(law: str) -> None:
    """A quarter of a second of Figure 4A in lockstep, without a load."""
    first, again = (play_in_lockstep(law) for _ in range(2))
    assert np.array_equal(first, again, equal_nan=True)
    assert np.any(first[:, CHANNEL_INDEX["torque1_nm"]] != 0.0)


def play_in_lockstep(law: str) -> np.ndarray:
    ticks = 250
    with start_in_process() as emulator:
        bench = LockstepBench(emulator, FIGURES["4a"].build_configuration(law), ticks)
        try:
            bench.prepare()
            bench.start()
            bench.tick(ticks)
            assert bench.plant.status is BenchStatus.RUN
        finally:
            bench.close()
        return bench.sink.samples


@pytest.mark.exhaustive
def test_run_through_sockets_gives_the_same_samples_bit_for_bit(compensated):
    """With the emulator in a separate process: results in this process apply to the wire."""
    assert np.array_equal(run("ndobc", start_emulator), compensated, equal_nan=True)


@pytest.mark.exhaustive
def test_series_and_chirp_are_followed_through_the_wire() -> None:
    """Set while the bench moves, in the packed constants of the loop; reproducible bit for bit."""
    times = [0.05 * number for number in range(21)]
    series = {
        "kind": "series",
        "time_s": times,
        "position_rad": [0.1 * (1.0 - np.cos(2.0 * np.pi * time)) for time in times],
        "transition_s": 0.2,
    }
    chirp = {"kind": "chirp", "offset_nm_per_rad": 15.0, "amplitude_nm_per_rad": 1.0}
    chirp |= {"start_hz": 0.2, "end_hz": 1.0, "duration_s": 1.0, "transition_s": 0.2}
    hold = FIGURES["4a"].build_configuration(load=False).changed(position=ConstantPosition())
    recorded = []
    for _ in range(2):
        with start_in_process() as emulator:
            bench = LockstepBench(emulator, hold, TICKS)
            try:
                bench.prepare()
                bench.start()
                bench.tick(1200)
                assert bench.loop.change(Set("position", series)) == 1200
                bench.loop.change(Set("stiffness", chirp))
                bench.tick(TICKS - 1200)
                assert bench.plant.fault is None
            finally:
                bench.close()
        recorded.append(bench.sink.samples)
    assert np.array_equal(*recorded, equal_nan=True)
    reference = recorded[0][:, CHANNEL_INDEX["position_reference_rad"]]
    assert reference[1200 + 200 + 500] == pytest.approx(0.2, abs=1e-9)
    stiffness = recorded[0][:, CHANNEL_INDEX["stiffness_reference_nm_per_rad"]]
    assert np.ptp(stiffness[1400:2400]) > 0.9
    assert np.abs(recorded[0][1200:, CHANNEL_INDEX["position_error_rad"]]).max() < np.radians(0.5)


@pytest.mark.exhaustive
def test_law_with_its_own_estimate_starts_from_the_present_one() -> None:
    """ESP after NDOBC under 2 N·m: from ŵ = 0 the torque jumped by 16 N·m, the link moved by 1.7°.

    The test uses sockets, with the emulator in a separate process.
    """
    before, ticks = 700, 1000
    hold = FIGURES["4a"].build_configuration("ndobc", load=False)
    with start_emulator() as emulator:
        bench = LockstepBench(emulator, hold.changed(position=ConstantPosition()), ticks)
        try:
            bench.prepare()
            bench.start()
            emulator.control.load(LOAD, at_s=bench.now() + 0.1)
            bench.tick(before)
            bench.loop.change(Set("law", "esp"))
            bench.tick(ticks - before)
            assert bench.plant.fault is None
        finally:
            bench.close()
    torque, error = (
        bench.sink.samples[:, CHANNEL_INDEX[name]] for name in ("torque1_nm", "position_error_rad")
    )
    assert abs(torque[before] - torque[before - 1]) < 1.0
    assert np.abs(error[before:]).max() < np.radians(0.2)


@pytest.mark.exhaustive
@pytest.mark.parametrize("law", list_law_names())
def test_law_unsuitable_for_a_moving_bench_states_it(law: str) -> None:
    """Selected after NDOBC, 2 s of Figure 4A under 2 N·m: without a fault, or its summary warns."""
    with start_in_process() as emulator:
        bench = LockstepBench(emulator, FIGURES["4a"].build_configuration("ndobc"), TICKS)
        try:
            bench.prepare()
            bench.start()
            emulator.control.load(LOAD, at_s=bench.now() + 0.2)
            bench.tick(500)
            bench.loop.change(Set("law", law))
            bench.tick(1500)
            is_ended = bench.plant.fault is not None
        finally:
            bench.close()
    summary = get_law(law).summary
    assert is_ended is (
        "with encoders it oscillates" in summary or "ends in an overspeed" in summary
    )


def test_tracking_at_500_hz_is_as_accurate() -> None:
    """At σ = 60 N·m/rad, from 1 s on; the feedback of the drives arrives every 2 ms then."""
    ticks = 1000
    with start_in_process() as emulator:
        bench = connect_bench(emulator)
        bench = bench.changed(timing=bench.timing.changed(period_s=0.002))
        wanted = get_figure("6b").build_configuration(load=False)
        loop = LockstepBench(emulator, wanted, ticks, bench=bench)
        try:
            loop.prepare()
            loop.start()
            loop.tick(ticks)
            assert loop.plant.fault is None
        finally:
            loop.close()
    errors = loop.sink.samples[ticks // 2 :, CHANNEL_INDEX["position_error_rad"]]
    assert np.degrees(np.sqrt(np.mean(errors**2))) < 0.1
