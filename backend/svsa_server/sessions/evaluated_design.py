"""A design to evaluate: a session's configuration with other gains, stable or not."""

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.control.gains import UncheckedGains
from svsa.runs.definition.arm_experiment import split_joints
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session
from svsa.simulation.reference.kinds import compute_start_value
from svsa_server.schemas.lab.stability import DesignRequest


def build_trial(session: Session, request: DesignRequest) -> tuple[Configuration, float]:
    """Build the configuration to evaluate, and σ_d, N·m/rad.

    Raises:
        ParameterError: If a value is invalid.
    """
    configuration, sigma = read_design_basis(session)
    if request.observer is not None:
        configuration = configuration.changed(observer=request.observer)
    if request.gains is not None:
        gains = request.gains.apply_to(configuration.gains, UncheckedGains)
        configuration = configuration.changed(gains=gains)
    if request.law is not None:
        configuration = configuration.changed(law=request.law)
    if request.stiffness_nm_per_rad is not None:
        sigma = request.stiffness_nm_per_rad
        configuration.limits.check_stiffness("stiffness_nm_per_rad", sigma, sigma)
    return configuration, sigma


def read_design_basis(session: Session) -> tuple[Configuration, float]:
    """Return the configuration to analyze, of an arm that of joint 1 alone, and σ_d, N·m/rad."""
    configuration = session.run.configuration
    if configuration.arm is not None:
        configuration, _ = split_joints(configuration)
    return configuration, read_stiffness(session)


def read_stiffness(session: Session) -> float:
    """Return σ_d now, N·m/rad; before the first tick its start value."""
    newest = session.journal.history.read_newest()
    if newest is None:
        return compute_start_value(session.run.configuration.stiffness)
    return float(newest[CHANNEL_INDEX["stiffness_reference_nm_per_rad"]])
