"""The configuration of a bench: references and gains of a run, with the bench's own design."""

from collections.abc import Iterable

from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.installed import find_mechanism
from svsa.actuators.parameters import SVSA, get_mechanism_name
from svsa.control.installed import PAPERS_LAW
from svsa.errors import ParameterError, StateError, Violation
from svsa.hardware.bench.real_motors import RealMotors
from svsa.hardware.description.file import BenchFile, check_home
from svsa.hardware.safety.guard import Guard
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.definition.design_file import load_prototype, read_design
from svsa.runs.definition.experiment import build_actuator_experiment
from svsa.runs.definition.paper import get_figure
from svsa.runs.definition.shorthand import read_mechanism
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
    """Read the design of a bench, at the bench's period.

    Args:
        bench: The bench file. It names a parameter file or an actuator; else the SVSA's prototype.

    Raises:
        ParameterError: The actuator is not installed, is not that of the file, has no stiffness
            motor, or has not the stiffness coordinate of the zero mark in its range.
    """
    section, design = bench.design, load_prototype()
    if section.file:
        design = read_design(section.file)
    elif section.actuator:
        fields = read_mechanism(section.actuator, "design.actuator")
        design = design.changed(**{name: fields[name] for name in fields if name != "stiffness"})
    name = get_mechanism_name(design.actuator)
    if section.actuator not in (None, name):
        bound = f"{name}, the actuator of {section.file}, or omitted"
        raise ParameterError(Violation("design.actuator", section.actuator, "", bound))
    if not find_mechanism(design.actuator).has_stiffness_motor:
        bound = "an actuator with two motors: a bench has two drives"
        raise ParameterError(Violation("design.actuator", name, "", bound))
    if name == SVSA:
        check_home(bench)
    else:
        domain = build_domain(design.nominal, design.limits)
        check_home(bench, domain.mu_min, domain.mu_max)
    sampling = design.sampling.changed(period_s=bench.timing.period_s)
    return design.changed(sampling=sampling)


def build_bench_configuration(bench: BenchFile, request: Configuration) -> Configuration:
    """Build the configuration of a bench with `request` (law, references, loads) and its simulated
    twin as comparison.

    The twin has the known properties of the bench: counts, estimated velocities, one sample of
    delay and the lag of the current loop.

    Raises:
        ParameterError: `request` is of another actuator than the bench, or its stiffness is out of
            range.
    """
    design = read_bench_design(bench)
    mechanism, other = map(get_mechanism_name, (design.actuator, request.actuator))
    if other != mechanism:
        bound = f"{mechanism}, the actuator of this bench"
        raise ParameterError(Violation("actuator.mechanism", other, "", bound))
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
    parameters = {**design.parameters, **request.parameters}
    return Configuration(
        **dict(design.changed(parameters=parameters)),
        law=request.law,
        comparisons=(Lane(law=request.law),),
        effects=effects,
        spring=request.spring,
        position=request.position,
        stiffness=request.stiffness,
        loads=request.loads,
    )


def build_first_experiment(bench: BenchFile) -> Configuration:
    """Build the initial configuration of a session of a bench, without a load.

    Figure 4A of the paper for the SVSA, else the default experiment of the actuator.
    """
    name = get_mechanism_name(read_bench_design(bench).actuator)
    if name == SVSA:
        return get_figure("4a").build_configuration(load=False)
    return build_actuator_experiment(name, PAPERS_LAW, load=False)


def read_actuation(bench: BenchFile) -> Actuation:
    """Read delay and lag of the torque from the bench's file."""
    return Actuation(bench.timing.latency_s, bench.timing.current_lag_s)


def check_takes_no_time(reference: AnyReference) -> None:
    """Raise `StateError` for a curve that the loop cannot process between two ticks.

    A curve of 200 points takes 2 ms, one of 2000 points 7 ms, which is long enough for a fault.
    """
    curve = reference.get_shape().curve
    if curve is not None and len(curve.breaks) > MAX_POINTS_IN_MOTION:
        raise StateError(
            f"The reference has {len(curve.breaks)} points, and a bench that moves takes one of"
            f" {MAX_POINTS_IN_MOTION} at most: stop it, set the reference, and run it again."
        )


def check_loads(loads: Iterable[Load]) -> None:
    """Check that the loop of a bench can process these loads while it ticks.

    A series of 1000 points takes 1.5 ms, one of 20 000 points 30 ms, and its message exceeds the
    buffer of the link to the loop.

    Args:
        loads: Loads that are applied or planned.

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
    return Guard(
        bench,
        (design.limits.torque1_nm, design.limits.torque2_nm),
        build_domain(design.nominal, design.limits),
        build_actuator(design.nominal, bench.home.lever_ratio),
        RealMotors.of(design.nominal),
    )
