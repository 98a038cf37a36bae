"""The start of a run: a figure of the paper, an actuator or a configuration."""

import inspect
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from svsa.actuators.installed import get_mechanism
from svsa.actuators.mechanism import Mechanism
from svsa.actuators.reach import find_only_stiffness
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.definition.design_file import read_design
from svsa.runs.definition.paper import LOAD_TIME_S, get_simulated_figure
from svsa.runs.definition.shorthand import change_configuration
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.reference.kinds.sine import SinePosition

AMPLITUDE_RAD, FREQUENCY_HZ, FADE_S = 0.5, 0.2, 1.0
"""Position reference of an actuator's experiment: A cos ωt − A, which begins at rest."""
LOAD_DEFLECTION_RAD = 0.05
"""Deflection of a linear spring of the default stiffness under the default load."""


def build_experiment(
    experiment: str | Configuration,
    parameters: Design | Path | str | None,
    changes: Mapping[str, Any],
    caller: Callable[..., Any],
) -> Configuration:
    """Build the configuration of an experiment.

    Args:
        experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
        parameters: A parameter file, such as `svsa identify` writes, or its `Design`, instead of
            the experiment's own.
        changes: Changes, as in `svsa.runs.definition.shorthand.Settings`.
        caller: The function that the user called; the error message suggests its keywords.

    Raises:
        ParameterError: If there is no such figure or setting, or a value is out of range.
    """
    if isinstance(experiment, Configuration):
        configuration = experiment
    else:
        configuration = get_simulated_figure(experiment).build_configuration()
    if parameters is not None:
        design = parameters if isinstance(parameters, Design) else read_design(parameters)
        configuration = configuration.with_design(design)
    return change_configuration(configuration, changes, inspect.signature(caller).parameters)


def choose_stiffness(mechanism: Mechanism) -> float:
    """Return the default stiffness of an actuator: the middle of its range in ln σ, N·m/rad.

    For an actuator without a stiffness motor it is the stiffness of its spring.
    """
    only = find_only_stiffness(mechanism.nominal)
    limits = mechanism.limits
    middle = math.sqrt(limits.stiffness_min_nm_per_rad * limits.stiffness_max_nm_per_rad)
    return float(f"{middle:.3g}") if only is None else only


def build_default_load(mechanism: Mechanism, start_s: float = LOAD_TIME_S) -> ConstantLoad:
    """Build the default load of an actuator: a torque on the link that its default stiffness can
    hold.

    Args:
        mechanism: The actuator.
        start_s: Onset, s.

    Returns:
        A step of `LOAD_DEFLECTION_RAD` times the default stiffness, N·m.
    """
    torque = float(f"{LOAD_DEFLECTION_RAD * choose_stiffness(mechanism):.2g}")
    return ConstantLoad(start_s=start_s, torque_nm=(torque, 0.0, 0.0))


def build_actuator_experiment(
    name: str,
    law: str,
    load: bool = True,
    actuator: Mapping[str, Any] | None = None,
    nominal: Mapping[str, Any] | None = None,
) -> Configuration:
    """Build the default experiment of an actuator: a sine at its default stiffness, then a load.

    Args:
        name: Name of the actuator, such as "qbmove".
        law: Name of the control law.
        load: Whether the default load has its onset at 5 s.
        actuator: Parameters of the plant that differ from the prototype's.
        nominal: Parameters of the nominal model that differ from the mechanism's.

    Returns:
        A run within the limits of the actuator, with its default gains and observer.

    Raises:
        ParameterError: If there is no such actuator, or a parameter is out of range.
    """
    mechanism = get_mechanism(name)
    motion = SinePosition(
        amplitude_rad=AMPLITUDE_RAD,
        frequency_hz=FREQUENCY_HZ,
        phase_rad=math.pi / 2,
        offset_rad=-AMPLITUDE_RAD,
        transition_s=FADE_S,
    )
    prototype = change_configuration(
        get_simulated_figure("4a").build_configuration(load=False),
        {
            "actuator": name,
            "law": law,
            "position": motion,
            "stiffness": choose_stiffness(mechanism),
            "loads": build_default_load(mechanism) if load else (),
        },
    )
    return change_configuration(prototype, {"actuator": actuator or {}, "nominal": nominal or {}})
