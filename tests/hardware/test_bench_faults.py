"""Every fault that can be caused is caused, on the emulator while it runs Figure 4A.

The emulator runs in lockstep, in this process. The tests check the commands that the emulator's
drives received, in the emulator's time, and the true motion of its mechanism. Some causes list more
than one fault, because the motion determines which of them is detected first.
"""

import math
from collections.abc import Iterator
from typing import Any

import pytest

from svsa.actuators.faults import BENCH_FAULTS
from svsa.actuators.signals import Torque
from svsa.errors import StateError
from svsa.hardware.emulator.experiment import LockstepBench, connect_bench
from svsa.hardware.emulator.faults import (
    CurrentOffset,
    DriveName,
    DropFrames,
    FrozenEncoder,
    ReversedEncoder,
    Silence,
    Unplugged,
)
from svsa.hardware.safety.machine import BenchStatus
from tests.exhaustive import exhaust
from tests.hardware.emulator.in_process_emulator import InProcessEmulator, start_in_process

from .caused_faults import (
    CASES,
    DRIVES,
    NODES,
    WRONG,
    Case,
    check_speeds,
    check_stopped,
    quick_stop,
)
from .watched_bench import FIGURE, Bench, make_ready


@pytest.fixture(scope="module")
def emulator() -> Iterator[InProcessEmulator]:
    with start_in_process() as running:
        yield running


class Place:
    """The bench of this module: READY for each test, recreated after a failed one."""

    def __init__(self, emulator: InProcessEmulator) -> None:
        self._rig = emulator
        self._bench: Bench | None = None

    def get(self) -> Bench:
        if self._bench is None or self._bench.plant.status is not BenchStatus.READY:
            self.close()
            self._bench = make_ready(self._rig)
        return self._bench

    def close(self) -> None:
        if self._bench is not None:
            self._bench.close()
            self._bench = None


@pytest.fixture(scope="module")
def place(emulator: InProcessEmulator) -> Iterator[Place]:
    made = Place(emulator)
    yield made
    made.close()


@pytest.fixture
def ready(place: Place) -> Bench:
    return place.get()


def is_shown(name: str) -> bool:
    """One node represents others with the same cause."""
    first = name.replace("motor2", "motor1").replace("deflection", "motor1")
    return first == name or first not in CASES


@pytest.mark.parametrize("name", exhaust(CASES, [*filter(is_shown, CASES)]))
def test_fault_ends_the_run_and_is_cleared_manually_only(ready: Bench, name: str) -> None:
    """Including coasting, no axis becomes much faster than permitted, unless pulled."""
    ready.run()
    begin = ready.begin_watch()
    CASES[name].cause(ready)
    check_stopped(ready, CASES[name], begin)
    if "load" not in name and "pulled" not in name:
        check_speeds(ready, 0.25 if "frozen" in name else 1.4)
    ready.recover()


@pytest.mark.parametrize("fault", [FrozenEncoder, ReversedEncoder])
@pytest.mark.parametrize("node", NODES)
def test_initially_wrong_encoder_causes_no_runaway(ready: Bench, fault: Any, node: str) -> None:
    """The worst case, without a previous correct reading: the run starts with it.

    If the deflection stays near zero, the run may continue, because there is no wrong motion.
    """
    ready.emulator.control.fault(fault(node=node))
    ready.start()
    ready.begin_watch()
    ready.tick_until_fault()
    if ready.plant.fault is None:
        assert node == "deflection"
        ready.plant.quick_stop(ready.now(), "a test")
    else:
        assert ready.plant.fault.code in WRONG
    ready.watch(100)
    assert ready.read_currents() == [0, 0]
    check_speeds(ready, 1.0)
    ready.recover()


def test_non_finite_torque_is_never_sent(ready: Bench, monkeypatch: pytest.MonkeyPatch) -> None:
    ready.run()
    begin, decide = ready.begin_watch(), ready.loop._decide
    broken = Torque(math.nan, 0.0)
    monkeypatch.setattr(ready.loop, "_decide", lambda *given: (*decide(*given)[:2], broken))
    check_stopped(ready, Case(quick_stop, {"not_finite"}), begin)
    monkeypatch.undo()
    ready.recover()


def test_run_continues_with_a_third_of_all_frames_lost(ready: Bench) -> None:
    """Within the limit of 5 ms the run continues: x̂ bridges the missing feedback."""
    for node in NODES:
        ready.emulator.control.fault(DropFrames(node=node, probability=0.3))
    ready.run(1000)
    asked = math.radians(60.0) * math.sin(2.0 * math.pi * 0.2 * 1.0)
    assert ready.emulator.control.read_state()["x"]["q"] == pytest.approx(asked, abs=0.05)
    ready.plant.quick_stop(ready.now(), "a test")
    ready.tick(2)
    ready.recover()


@pytest.mark.parametrize("node", DRIVES)
def test_disconnected_drive_holds_its_current_and_the_other_is_stopped(
    ready: Bench, node: DriveName
) -> None:
    """A limitation of any software: the emergency stop must cut the supply."""
    ready.run()
    ready.emulator.control.fault(Unplugged(node=node))
    ready.tick(30)
    assert ready.plant.fault is not None
    assert ready.plant.fault.code == "stale_feedback"
    held = ready.read_currents()
    assert held[DRIVES.index(node)] != 0
    assert held[1 - DRIVES.index(node)] == 0
    ready.recover()


def test_motor_turned_by_a_faulty_drive_at_rest_is_a_fault(ready: Bench) -> None:
    """The drive of the weak motor produces 15 A at zero command: the speed limit acts before the
    heat limit.
    """
    ready.emulator.control.fault(CurrentOffset(node="motor2", offset_a=15))
    ready.tick_until_fault()
    assert ready.plant.fault is not None
    assert ready.plant.fault.code == "overspeed"
    assert "motor2_velocity_rad_per_s" in ready.plant.fault.values
    ready.tick(2)
    assert ready.read_currents() == [0, 0]
    ready.recover()


def test_silent_drive_is_named_during_arming(ready: Bench) -> None:
    ready.emulator.control.fault(Silence(node="motor2"))
    begin = ready.now()
    ready.plant.arm(begin)
    ready.tick(round(BENCH_FAULTS["drive_silent"] / ready.bench.timing.period_s))
    assert ready.plant.fault is not None
    assert ready.plant.fault.code == "drive_silent"
    assert "supply" in ready.plant.fault.message
    assert ready.read_currents() == [0, 0]
    ready.recover()


@pytest.mark.parametrize(
    ("safety", "code"),
    [
        ({"link_speed_max_rad_per_s": 0.7}, "overspeed"),
        ({"link_position_max_rad": 0.15}, "position_limit"),
    ],
)
def test_limit_of_the_bench_file_ends_the_run(
    place: Place, emulator: InProcessEmulator, safety: dict[str, float], code: str
) -> None:
    """The figure itself exceeds a limit this low: no fault has to be injected."""
    place.close()
    bench = make_ready(emulator, **safety)
    try:
        bench.start()
        begin = bench.begin_watch()
        check_stopped(bench, Case(quick_stop, {code}), begin)
        bench.recover()
    finally:
        bench.close()


def test_silence_of_the_operator_ramps_to_zero_without_a_fault(
    place: Place, emulator: InProcessEmulator
) -> None:
    place.close()
    bench = make_ready(emulator, dead_man=True)
    try:
        bench.beats.stopped["operator"] = -1.0
        with pytest.raises(StateError, match="switch"):
            bench.start()
        bench.beats.stopped.clear()
        bench.run()
        bench.beats.stopped["operator"] = bench.now()
        bench.tick(99)
        assert bench.plant.status is BenchStatus.RUN
        bench.tick(3)
        assert bench.plant.status is BenchStatus.RAMP
        bench.tick(round(bench.bench.safety.ramp_s / 0.001))
        assert bench.plant.status is BenchStatus.READY
        assert bench.plant.fault is None
        assert bench.read_currents() == [0, 0]
    finally:
        bench.close()


def test_bench_neither_starts_before_homing_nor_arms_uncalibrated(
    place: Place, emulator: InProcessEmulator, tmp_path: Any
) -> None:
    place.close()
    bench = Bench(emulator)
    emulator.control.home()
    try:
        bench.plant.arm(bench.now())
        bench.tick_until(BenchStatus.READY)
        for step in NODES[:0:-1]:
            with pytest.raises(StateError, match="not confirmed"):
                bench.start()
            assert bench.plant.homing_step is not None, step
            bench.plant.confirm_home(bench.plant.homing_step, "a test")
        with pytest.raises(StateError, match="zero mark of motor 2 is"):
            bench.start()
    finally:
        bench.close()
    elsewhere = connect_bench(emulator).changed(path=str(tmp_path / "bench.toml"))
    bare = LockstepBench(emulator, FIGURE, 1, elsewhere)
    try:
        with pytest.raises(StateError, match="no calibration record"):
            bare.plant.arm(bare.now())
        bare.tick(5)
        assert bare.plant.status is BenchStatus.OFF
        drives = emulator.control.read_state()["drives"].values()
        assert [drive["mode"] for drive in drives] == [None, None]
    finally:
        bare.close()


def test_every_fault_was_caused_on_the_rig_with_listed_exceptions() -> None:
    """The others cannot occur in lockstep: `test_can_plant_faults`, and `test_survivors`."""
    elsewhere = {"encoder_lost", "singular_decoupling"}
    others = {"not_finite", "overload", "drive_silent", "overspeed", "position_limit"}
    caused = set().union(*(case.codes for case in CASES.values()))
    processes = {"loop_late", "loop_silent", "loop_lost", "loop_and_supervisor_lost"}
    assert caused | others | elsewhere | processes >= BENCH_FAULTS.keys()
