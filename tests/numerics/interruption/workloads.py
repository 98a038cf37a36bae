"""Short runs of all parts of the library, which call every compiled function from Python."""

from typing import Any, cast

import svsa
from svsa.actuators.domain import build_domain
from svsa.actuators.dynamics import build_actuator
from svsa.actuators.faults import FAULT_CODES
from svsa.actuators.installed import get_mechanism
from svsa.actuators.reach import find_stiffness_range
from svsa.actuators.signals import Disturbance, State, Torque
from svsa.analysis.datasheet import measure
from svsa.analysis.design.report import build_report
from svsa.analysis.design.steady_error import compute_fl_steady_error
from svsa.analysis.identification.identify import identify
from svsa.control.installed import list_law_names
from svsa.evaluation.falsifier.trace import sample_torque
from svsa.evaluation.studies.replay import measure_samples
from svsa.evaluation.timing.benchmark import list_c_constants
from svsa.hardware.commissioning import magnitudes
from svsa.hardware.emulator.experiment import LockstepBench
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution import arm_run
from svsa.runs.execution.batch import run_configurations
from svsa.runs.execution.fault import build_fault
from svsa.runs.execution.run import Run, Start
from svsa.simulation.arm import contact
from svsa.simulation.reference.preview import sample_reference
from tests.analysis.identification.excited_run import build_configuration, build_run, play
from tests.hardware.emulator.in_process_emulator import start_in_process


def run_all() -> None:
    """Run every workload once."""
    configuration = get_figure("4a").build_configuration()
    _simulate(configuration)
    _identify()
    build_report(configuration, (15.0,), 2, lambda _: None)
    compute_fl_steady_error(configuration, 15.0, Disturbance(1.0, 0.0, 0.0))
    list_c_constants(Run(configuration))
    # An actuator defined by an elastic energy has its stiffness range checked under a constant
    # load.
    parameters = configuration.actuator
    domain = build_domain(parameters, configuration.limits)
    plant = build_actuator(parameters, 0.0)
    find_stiffness_range(plant, domain, 1.0)
    member = get_mechanism("leaf_spring")
    build_domain(member.prototype, member.limits)
    # A datasheet computes whether a motor is saturated.
    measure.are_at_limit(plant, Torque(0.0, 0.0), Torque(1.0, 1.0))
    sample_torque(configuration, 0.01)
    sample_reference(configuration.position, 4)
    # A commissioned bench compares its spring with this.
    magnitudes.compute_stiffness_of(plant, 0.5, 0.0)
    magnitudes.compute_coordinate_for_stiffness(plant, 15.0)
    _run_bench()
    wall = svsa.Wall(normal_rad=0.0, distance_m=0.0, stiffness_n_per_m=100.0)
    # A change during the run plans the references again.
    change = svsa.Change(at_s=0.005, law="fl")
    arm = svsa.simulate_arm(
        law="ndobc", feedforward=True, tip_loads=[wall], commands=[change], duration_s=0.01
    )
    _ = arm.wall_force_n
    # A change of the lanes of an arm continues with the mass at its tip.
    of_arm = arm_run.ArmRun(build_arm_experiment("rods", {}, {"law": "ndobc"}))
    arm_run.adapt_blocks(of_arm.arms[0], 0.1)
    contact.compute_effective_mass(of_arm.arms[0].arm, (0.3, -0.5), 0.0)


def _simulate(configuration: Configuration) -> None:
    for law in list_law_names():
        svsa.simulate("4a", law, duration_s=0.01)
    svsa.simulate("4a", lambda time_s, reference, x, w: (0.0, 0.0), duration_s=0.01)
    stepper = svsa.Stepper(configuration)
    stepper.reset()
    stepper.step((0.0, 0.0))
    run_configurations([configuration], 0.01)
    x = State(0.1, 0.0, 0.1, 0.0, 0.0, 0.0)
    run = Run(configuration, start=Start(0.1, x))
    for code in FAULT_CODES:
        build_fault(code, 0, 0, run.blocks[0], x)
    result = svsa.simulate(configuration, duration_s=0.01)
    measure_samples(result, 0.0, 0.01)
    _ = result.metrics


def _identify() -> None:
    """With a sine in place of the excitation: the fit takes a third of the time."""
    move = svsa.SinePosition(amplitude_rad=0.5, frequency_hz=1.0)
    configuration = build_configuration(position=move)
    samples, _ = play(configuration, [], 6.5)
    record = build_run(configuration, samples)
    identify(record)


def _run_bench():
    with start_in_process() as emulator:
        bench = LockstepBench(
            cast(Any, emulator), get_figure("6a").build_configuration(load=False), 10
        )
        try:
            bench.prepare()
            bench.start()
            bench.tick(5)
            bench.loop.tick(bench.now(), missed=1)
        finally:
            bench.close()
