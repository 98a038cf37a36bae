"""The configuration of a bench: references and gains of a run, with the bench's own design."""

from collections.abc import Iterable

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.parameters import require_svsa
from svsa.errors import StateError
from svsa.hardware.file import BenchFile
from svsa.hardware.safety.guard import Guard
from svsa.runs.configuration import Configuration, Design, Lane, load_prototype, read_design
from svsa.simulation.loop.measured import Actuation
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.effects.current_lag import CurrentLag
from svsa.simulation.plant.effects.encoders import Encoders
from svsa.simulation.plant.effects.estimation import StateEstimation
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa.simulation.reference.kinds.reference import AnyReference

MAX_POINTS_IN_MOTION = 200
MAX_LOAD_POINTS = 1000


def read_bench_design(bench: BenchFile) -> Design:
    """Read the design of a bench: its parameter file, or the prototype, at the bench's period."""
    design = read_design(bench.design.file) if bench.design.file else load_prototype()
    sampling = design.sampling.changed(period_s=bench.timing.period_s)
    return design.changed(sampling=sampling)


def build_bench_configuration(bench: BenchFile, wanted: Configuration) -> Configuration:
    """`wanted` (law, references, loads) on a bench, with its simulated twin as a comparison.

    The twin has what is known of the bench: counts, estimated velocities, a sample of
    delay and the lag of the current loop.
    """
    design = read_bench_design(bench)
    encoders = None
    motor = bench.motor1
    if motor.counts_per_rev and motor.gear_ratio and bench.deflection.counts_per_rev:
        encoders = Encoders(
            motor_counts_per_rev=motor.counts_per_rev,
            gear_ratio=motor.gear_ratio,
            deflection_counts_per_rev=bench.deflection.counts_per_rev,
        )
    lag = bench.timing.current_lag_s
    effects = Effects(
        encoders=encoders,
        estimation=StateEstimation(corner_rad_per_s=bench.design.corner_rad_per_s),
        delay_samples=1,
        current_lag=CurrentLag(time_constant_s=lag) if lag else None,
    )
    parameters = {**design.parameters, **wanted.parameters}
    return Configuration(
        **dict(design.changed(parameters=parameters)),
        law=wanted.law,
        comparisons=(Lane(law=wanted.law),),
        effects=effects,
        position=wanted.position,
        stiffness=wanted.stiffness,
        loads=wanted.loads,
    )


def read_actuation(bench: BenchFile) -> Actuation:
    """Read delay and lag of the torque from the bench's file."""
    return Actuation(bench.timing.latency_s, bench.timing.current_lag_s)


def check_takes_no_time(reference: AnyReference) -> None:
    """Raise `StateError` for a curve that the loop cannot process between two ticks.

    One of 200 points takes it 2 ms, one of 2000 points 7 ms: long enough to lose the bench.
    """
    curve = reference.get_shape().curve
    if curve is not None and len(curve.breaks) > MAX_POINTS_IN_MOTION:
        raise StateError(
            f"The reference has {len(curve.breaks)} points, and a bench that moves takes one of"
            f" {MAX_POINTS_IN_MOTION} at most: stop it, set the reference, and run it again."
        )


def check_loads(loads: Iterable[Load]) -> None:
    """Check that the loop of a bench can process these loads while it ticks.

    A series of 1000 points takes it 1.5 ms, one of 20 000 points 30 ms, and its message is longer
    than the link to the loop holds.

    Args:
        loads: That are applied or planned.

    Raises:
        StateError: If a series has more than `MAX_LOAD_POINTS` points.
    """
    for load in loads:
        if isinstance(load, SeriesLoad) and len(load.time_s) > MAX_LOAD_POINTS:
            raise StateError(
                f"The load has {len(load.time_s)} points, and a bench takes one of"
                f" {MAX_LOAD_POINTS} at most: use fewer points, or several loads one after another."
            )


def build_guard(bench: BenchFile) -> Guard:
    """Build the limits of a bench, with torques and domain of its design."""
    design = read_bench_design(bench)
    require_svsa(design.nominal, "a bench")
    return Guard(
        bench,
        (design.limits.torque1_nm, design.limits.torque2_nm),
        build_domain(design.nominal, design.limits),
        build_actuator(design.nominal, bench.home.lever_ratio),
    )
