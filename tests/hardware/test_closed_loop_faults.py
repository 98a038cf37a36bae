"""The controller in motion on a rig that breaks: every fault ends in zero current, and soon.

The times are those of the rig; a limit of the motion (speed, deflection) bounds the harm.
"""

import pytest

from svsa.experiment.bench_run import SampleArray
from svsa.experiment.paper import FIGURES
from svsa.hardware.machine import BenchStatus
from svsa.plant.disturbances import Load, MassLoad
from svsa.rig.faults import (
    BrownOut,
    CurrentOffset,
    DropFrames,
    FrozenEncoder,
    LateFrames,
    ReversedEncoder,
    ReversedMotor,
    RigFault,
    Silence,
    Stall,
)
from svsa.runtime.configuration import Law
from svsa.runtime.realtime.configuration import build_bench_configuration
from svsa.runtime.realtime.loop import BenchLoop
from tests.hardware.wired_bench import WiredBench

HUNG = MassLoad(mass_kg=3.0, arm_m=0.068)
FASTEST = 35.0


def break_in_motion(
    fault: RigFault, law: Law = "ndobc", load: Load | None = None, longest_s: float = 2.0
) -> tuple[str | None, float, float]:
    """Figure 4A's motion, broken after 0.8 s: fault, after how long, and the fastest axis."""
    with WiredBench() as b:
        b.make_ready()
        wanted = FIGURES["4a"].build_configuration(law)
        sink = SampleArray(5000)
        loop = BenchLoop(b.plant, b.bench, build_bench_configuration(b.bench, wanted), sink)
        b.drive(loop, 50)
        loop.start(b.now)
        if load is not None:
            b.rig.add_load(load)
        b.drive(loop, 800)
        assert b.plant.fault is None
        b.rig.inject(fault)
        begin, fastest = b.now, 0.0
        while b.plant.fault is None and b.now - begin < longest_s:
            b.drive(loop)
            x = b.rig.mechanics.read(b.rig.now_us)
            fastest = max(fastest, abs(x.dq), abs(x.dtheta1), abs(x.dtheta2))
        if b.plant.fault is None:
            assert b.plant.status is BenchStatus.RUN
            return None, longest_s, fastest
        at = b.now
        b.drive(loop, 20)
        assert b.find_zero_time(begin) <= at + 0.002
        assert [drive.target_nm for drive in b.rig.drives.values()] == [0.0, 0.0]
        return b.plant.fault.code, at - begin, fastest


@pytest.mark.parametrize("law", ["ndobc", "fl"])
@pytest.mark.parametrize(
    ("fault", "codes", "within_s"),
    [
        (FrozenEncoder(node="motor1"), {"encoder_frozen"}, 0.1),
        (FrozenEncoder(node="deflection"), {"encoder_frozen", "vibration"}, 0.6),
        (ReversedEncoder(node="motor1"), {"overspeed", "drive_zeroed"}, 0.003),
        (ReversedEncoder(node="motor2"), {"overspeed", "drive_zeroed"}, 0.003),
        (ReversedEncoder(node="deflection"), {"vibration", "implausible"}, 0.6),
        (ReversedMotor(node="motor1"), {"implausible", "overspeed"}, 0.1),
        (ReversedMotor(node="motor2"), {"overspeed", "vibration", "implausible"}, 0.5),
        (CurrentOffset(node="motor2", offset_a=5.0), {"lever_end", "overload"}, 0.5),
        (Stall(node="motor1"), {"drive_error"}, 0.102),
        (BrownOut(node="motor2"), {"stale_feedback"}, 0.022),
        (Silence(node="motor1"), {"stale_feedback"}, 0.022),
        (DropFrames(node="deflection"), {"stale_feedback"}, 0.022),
        (
            LateFrames(node="motor1", delay_s=0.008),
            {"implausible", "deflection_limit", "overspeed", "vibration"},
            0.5,
        ),
    ],
    ids=lambda value: f"{value.kind}-{value.node}" if hasattr(value, "kind") else None,
)
def test_what_breaks_in_motion_stops_it(
    fault: RigFault, codes: set[str], within_s: float, law: Law
) -> None:
    code, after_s, fastest = break_in_motion(fault, law)
    assert code in codes
    assert after_s <= within_s
    assert fastest < FASTEST


@pytest.mark.parametrize("node", ["motor1", "motor2", "deflection"])
def test_an_encoder_that_freezes_under_load_stops_it(node: str) -> None:
    fault = FrozenEncoder(node=node)  # pyright: ignore[reportArgumentType]
    code, _, fastest = break_in_motion(fault, load=HUNG)
    assert code is not None
    assert fastest < FASTEST


def test_half_of_the_frames_lost_is_borne() -> None:
    """Single frames that are lost are bridged: no false alarm, no torque taken away for long."""
    for node in ("motor1", "deflection"):
        code, _, fastest = break_in_motion(DropFrames(node=node, probability=0.5), longest_s=1.0)
        assert code is None
        assert fastest < 4.0
