"""Checks of a configuration before a run begins or changes."""

import math

import numpy as np

from svsa.actuators.domain import build_domain
from svsa.actuators.reach import check_reach
from svsa.control.installed import check_installed
from svsa.errors import ParameterError
from svsa.runs.definition.configuration import Configuration
from svsa.simulation.plant.loads.load import TORQUE, W2, D
from svsa.simulation.reference.kinds import get_range


def check_joint_laws(configuration: Configuration) -> None:
    """Raise `ParameterError` if a law of a joint is not installed."""
    for number, joint in enumerate(configuration.joints, start=1):
        try:
            check_laws(joint)
        except ParameterError as error:
            raise error.within(f"joint{number}") if configuration.arm else error from None


def check_laws(configuration: Configuration) -> None:
    """Raise `ParameterError` if a law of this joint is not installed."""
    for number, lane in enumerate(configuration.controllers):
        try:
            check_installed(lane.law)
        except ParameterError as error:
            raise error.within(f"comparisons[{number - 1}].law" if number else "law") from None


def check_lasting_loads(configuration: Configuration) -> None:
    """Raise `ParameterError` for a stiffness that is impossible under the lasting loads."""
    c, torque = configuration, 0.0
    for load in c.loads:
        if load.acts_as == TORQUE and load.factor is None and math.isinf(load.get_duration()):
            row = np.zeros(D + 1)
            load.fill(row)
            torque += float(row[W2])
    check_reach(c.actuator, build_domain(c.actuator, c.limits), torque, *get_range(c.stiffness))
