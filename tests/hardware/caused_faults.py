"""Faults injected into the emulator, and the fault codes that may result."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import can
import pytest

from svsa.actuators.faults import BENCH_FAULTS
from svsa.errors import StateError
from svsa.hardware.bench.emulation import ADVANCE_ID, encode_time
from svsa.hardware.drives.installed import build_stop
from svsa.hardware.emulator.faults import (
    BrownOut,
    BusErrors,
    CurrentOffset,
    DriveName,
    DropFrames,
    EmulatorFault,
    FrozenEncoder,
    LateFrames,
    Node,
    ReversedEncoder,
    ReversedMotor,
    Silence,
    Stall,
    ZeroedCounter,
)
from svsa.hardware.plant import can_plant
from svsa.hardware.safety.machine import BenchStatus
from svsa.simulation.plant.loads.constant import ConstantLoad

from .watched_bench import Bench

DRIVES: tuple[DriveName, DriveName] = ("motor1", "motor2")
NODES: tuple[Node, ...] = (*DRIVES, "deflection")
WRONG = {"implausible", "encoder_frozen", "overspeed", "vibration", "lever_end", "drive_zeroed"}
WITHOUT_VALUES = {"quick_stop", "not_finite", "bus_error", "foreign_command", "drive_silent"}
SEEN_IN_MOTION = {*WRONG, "deflection_limit", "position_limit", "overload"}


class Case(NamedTuple):
    """A cause, and the fault codes that may result."""

    cause: Callable[[Bench], Any]
    codes: set[str]


def inject(fault: EmulatorFault) -> Callable[[Bench], Any]:
    return lambda b: b.emulator.control.fault(fault)


def load(*torque_nm: Any) -> Callable[[Bench], Any]:
    return lambda b: b.emulator.control.load(ConstantLoad.model_validate({"torque_nm": torque_nm}))


def lose_supervisor(b: Bench) -> None:
    b.beats.stopped["supervisor"] = b.now()


def quick_stop(b: Bench) -> None:
    b.plant.quick_stop(b.now(), "a test")


def intrude(b: Bench) -> None:
    """Another program on the bus resets the drives; wait until the emulator has received it."""
    bus = can_plant.open_bus(b.bench.bus)
    for frame in build_stop(b.bench.motor1).reset:
        bus.send(frame)
    bus.send(can.Message(arbitration_id=ADVANCE_ID, is_extended_id=True, data=encode_time(0)))
    while (heard := bus.recv(10.0)) is not None and heard.arbitration_id != ADVANCE_ID:
        pass
    bus.shutdown()


def be_late(b: Bench) -> None:
    """The supervisor resets the drives while the loop is stopped for 0.1 s."""
    b.beats.stops += 1
    intrude(b)
    b.miss(100)


CASES = {
    **{f"no frames of {n}": Case(inject(DropFrames(node=n)), {"stale_feedback"}) for n in NODES},
    "frames of motor2 30 ms late": Case(
        inject(LateFrames(node="motor2", delay_s=0.03)), {"stale_feedback"}
    ),
    "frames of motor1 4 ms late": Case(inject(LateFrames(node="motor1", delay_s=0.004)), WRONG),
    "motor1 frozen": Case(inject(FrozenEncoder(node="motor1")), {"encoder_frozen"}),
    "motor2 frozen": Case(inject(FrozenEncoder(node="motor2")), {"encoder_frozen"}),
    "deflection frozen": Case(inject(FrozenEncoder(node="deflection")), {"encoder_frozen"}),
    **{f"{n} counts backwards": Case(inject(ReversedEncoder(node=n)), WRONG) for n in NODES},
    **{f"{n} turns backwards": Case(inject(ReversedMotor(node=n)), WRONG) for n in DRIVES},
    **{f"brown-out of {n}": Case(inject(BrownOut(node=n)), {"stale_feedback"}) for n in DRIVES},
    **{f"no power at {n}": Case(inject(Silence(node=n)), {"stale_feedback"}) for n in DRIVES},
    **{
        f"{n} stalls": Case(inject(Stall(node=n)), {"drive_error", "implausible", "encoder_frozen"})
        for n in DRIVES
    },
    **{
        f"{n} takes its position for zero": Case(inject(ZeroedCounter(node=n)), {"drive_zeroed"})
        for n in DRIVES
    },
    **{
        f"{n} makes {a} A too much": Case(
            inject(CurrentOffset(node=n, offset_a=a)), WRONG | {"overload"}
        )
        for n, a in zip(DRIVES, (15, -15), strict=True)
    },
    "error frames": Case(inject(BusErrors(count=20)), {"bus_error"}),
    "a stranger resets the drives": Case(intrude, {"foreign_command"}),
    "a late loop": Case(be_late, {"loop_late"}),
    "ticks missed": Case(lambda b: b.miss(20), {"missed_ticks"}),
    "no supervisor": Case(lose_supervisor, {"supervisor_lost"}),
    "quick stop": Case(quick_stop, {"quick_stop"}),
    "too great a load": Case(load(10.0, 0.0, 0.0), {"deflection_limit"}),
    "the lever is pulled to its end": Case(load(0.0, 0.0, 9.0), {"lever_end", "overspeed"}),
}


def check_stopped(b: Bench, case: Case, begin_s: float) -> None:
    """The fault is one of those expected, in time, latched, with its values; nothing flows.

    If the motion of the mechanism shows the fault, its time counts from the first tick that shows
    it.
    """
    b.tick_until_fault()
    fault = b.plant.fault
    assert fault is not None, "nothing was found"
    found_s = b.now()
    assert b.plant.status is BenchStatus.FAULT
    assert fault.code in case.codes
    b.look()
    b.watch(20)
    since = found_s if fault.code in SEEN_IN_MOTION else begin_s
    assert b.last_current_s - since < BENCH_FAULTS[fault.code]
    assert b.read_currents() == [0, 0]
    assert fault.message
    assert bool(fault.values) is (fault.code not in WITHOUT_VALUES)
    assert all(math.isfinite(value) for value in fault.values.values())
    assert b.loop.run.tick == b.sink.done, "the server waits for a sample of every tick"
    b.plant.quick_stop(b.now(), "a second cause")
    b.emulator.control.fault(BusErrors())
    b.watch(30)
    assert b.plant.fault is fault
    assert b.read_currents() == [0, 0]
    with pytest.raises(StateError):
        b.plant.arm(b.now())


def check_speeds(b: Bench, share: float) -> None:
    """Compare velocity and travel of the mechanism with the limits of the bench file."""
    safety = b.bench.safety
    assert b.fastest["dtheta1"] <= share * b.bench.motor1.speed_max_rad_per_s
    assert b.fastest["dtheta2"] <= share * b.bench.motor2.speed_max_rad_per_s
    assert b.fastest["dq"] <= share * safety.link_speed_max_rad_per_s
    assert b.farthest <= 1.4 * safety.link_position_max_rad
