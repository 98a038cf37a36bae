"""A design to evaluate: a session's configuration with other gains, stable or not."""

from svsa.actuators.signals import CHANNEL_INDEX
from svsa.control.gains import UncheckedGains
from svsa.runs.definition.arm_experiment import split_joints
from svsa.runs.definition.command import check_joint
from svsa.runs.definition.configuration import Configuration
from svsa.runs.session.session import Session
from svsa.simulation.reference.kinds import compute_start_value
from svsa_server.schemas.lab.design import TriedDesign
from svsa_server.schemas.lab.stability import DesignRequest


def build_trial(session: Session, request: DesignRequest) -> tuple[Configuration, float]:
    """Build the configuration to evaluate, and σ_d, N·m/rad.

    Raises:
        ParameterError: If a value is invalid.
        StateError: If the session does not have the joint of the request.
    """
    configuration, sigma = read_design_basis(session, request)
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


def read_design_basis(session: Session, request: TriedDesign) -> tuple[Configuration, float]:
    """Return the configuration to analyze, of an arm that of one joint alone, and its σ_d now,
    N·m/rad; before the first tick the start value.

    Raises:
        StateError: If the session does not have the joint of the request.
    """
    configuration, lane = session.run.configuration, 0
    check_joint(configuration, request.joint)
    if configuration.arm is not None:
        lane = (request.joint or 1) - 1
        configuration = split_joints(configuration)[lane]
    newest = session.journal.history.read_newest(lane)
    if newest is None:
        return configuration, compute_start_value(configuration.stiffness)
    return configuration, float(newest[CHANNEL_INDEX["stiffness_reference_nm_per_rad"]])
