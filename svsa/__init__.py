"""SVSA Lab: a serial variable stiffness actuator, its control, and the paper's experiment.

    import svsa
    result = svsa.simulate("4a", "ndobc")
    result.metrics.rms_position_error_rad
    result.plot().savefig("run.png")

Units are SI; every name ends in its unit.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from svsa.actuators.parameters import ActuatorParameters, Limits
from svsa.control.gains import Gains
from svsa.control.law_names import AnyLaw
from svsa.control.observers.disturbance import ObserverBandwidth
from svsa.control.observers.spring import SpringEstimation
from svsa.errors import FaultError, ParameterError, StateError, SvsaError
from svsa.evaluation.reproduction import reproduce
from svsa.inputs.extras import MissingExtraError
from svsa.inputs.extras import __version__ as __version__
from svsa.runs.definition import paper
from svsa.runs.definition.change import Change
from svsa.runs.definition.configuration import ArmSetup, Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.definition.design_file import load_prototype, read_design, write_design
from svsa.runs.execution.stepper import Observation, Stepper
from svsa.runs.result.channels import ChannelName
from svsa.runs.result.result import Result
from svsa.runs.result.simulate import simulate
from svsa.simulation.plant.effects import IDEAL, RIG, Effects
from svsa.simulation.plant.loads import LOADS
from svsa.simulation.plant.loads.constant import ConstantLoad
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.paper import PaperLoad
from svsa.simulation.plant.loads.pulse import PulseLoad
from svsa.simulation.plant.loads.push import PushLoad
from svsa.simulation.plant.loads.series import SeriesLoad
from svsa.simulation.plant.loads.sine import SineLoad
from svsa.simulation.plant.loads.tip import TipForce, TipImpulse, TipMass, TipPush, Wall
from svsa.simulation.reference.kinds import POSITIONS, STIFFNESSES
from svsa.simulation.reference.kinds.chirp import ChirpPosition, ChirpStiffness
from svsa.simulation.reference.kinds.constant import ConstantPosition, ConstantStiffness
from svsa.simulation.reference.kinds.minimum_jerk import MinimumJerkPosition, MinimumJerkStiffness
from svsa.simulation.reference.kinds.series import SeriesPosition, SeriesStiffness
from svsa.simulation.reference.kinds.sine import SinePosition, SineStiffness
from svsa.simulation.reference.kinds.steps import StepsPosition, StepsStiffness
from svsa.simulation.reference.preview import sample_reference
from svsa.simulation.reference.series_csv import read_series

if TYPE_CHECKING:
    from svsa.actuators.arm.parameters import ArmParameters, LinkParameters
    from svsa.analysis import design
    from svsa.analysis.exchange.robot_model import describe_robot
    from svsa.analysis.identification.measured import identify
    from svsa.client import connect, connect_async
    from svsa.control.arm_payload import PayloadAdaptation
    from svsa.evaluation import falsifier as falsify
    from svsa.evaluation.studies.run import run_study
    from svsa.evaluation.sweep import sweep
    from svsa.evaluation.tuning.tuner import tune
    from svsa.runs.execution.environment import ActuatorEnv
    from svsa.runs.records.catalogue.runs import Catalogue
    from svsa.runs.records.verdict import Tolerance
    from svsa.runs.result.arm import ArmResult
    from svsa.runs.result.recorded import (
        compare_runs,
        export_run,
        list_runs,
        open_arm_run,
        open_run,
        resimulate,
    )
    from svsa.runs.result.saved import save_run
    from svsa.runs.result.simulate_arm import simulate_arm
    from svsa.simulation.arm.tip_reference import TipEllipse, TipMove

_LATE = {
    **dict.fromkeys(("ArmParameters", "LinkParameters"), "svsa.actuators.arm.parameters"),
    "ArmResult": "svsa.runs.result.arm",
    "PayloadAdaptation": "svsa.control.arm_payload",
    "simulate_arm": "svsa.runs.result.simulate_arm",
    **dict.fromkeys(("TipEllipse", "TipMove"), "svsa.simulation.arm.tip_reference"),
    "ActuatorEnv": "svsa.runs.execution.environment",
    "describe_robot": "svsa.analysis.exchange.robot_model",
    "design": "svsa.analysis.design",
    "falsify": "svsa.evaluation.falsifier",
    "connect": "svsa.client",
    "connect_async": "svsa.client",
    "Catalogue": "svsa.runs.records.catalogue.runs",
    "Tolerance": "svsa.runs.records.verdict",
    "save_run": "svsa.runs.result.saved",
    "sweep": "svsa.evaluation.sweep",
    "tune": "svsa.evaluation.tuning.tuner",
    "identify": "svsa.analysis.identification.measured",
    "run_study": "svsa.evaluation.studies.run",
    **dict.fromkeys(
        ("compare_runs", "export_run", "open_arm_run", "open_run", "resimulate", "list_runs"),
        "svsa.runs.result.recorded",
    ),
}


_FOUND = {kind.__name__: kind for kind in (*LOADS, *POSITIONS, *STIFFNESSES)}
"""Loads and references that are found automatically and not listed here."""
_MODULES = ("design", "falsify")


def __getattr__(name: str) -> object:
    """Import modules that a simulation does not need, or that are slow to import, on first
    access.
    """
    if name in _FOUND:
        return _FOUND[name]
    if name not in _LATE:
        raise AttributeError(f"module 'svsa' has no attribute {name!r}")
    module = import_module(_LATE[name])
    return module if name in _MODULES else getattr(module, name)


__all__ = [
    "IDEAL",
    "RIG",
    "ActuatorEnv",
    "ActuatorParameters",
    "AnyLaw",
    "ArmParameters",
    "ArmResult",
    "ArmSetup",
    "Catalogue",
    "Change",
    "ChannelName",
    "ChirpPosition",
    "ChirpStiffness",
    "Configuration",
    "ConstantLoad",
    "ConstantPosition",
    "ConstantStiffness",
    "Design",
    "Effects",
    "FaultError",
    "Gains",
    "Lane",
    "Limits",
    "LinkParameters",
    "MassLoad",
    "MinimumJerkPosition",
    "MinimumJerkStiffness",
    "MissingExtraError",
    "Observation",
    "ObserverBandwidth",
    "PaperLoad",
    "ParameterError",
    "PayloadAdaptation",
    "PulseLoad",
    "PushLoad",
    "Result",
    "SeriesLoad",
    "SeriesPosition",
    "SeriesStiffness",
    "SineLoad",
    "SinePosition",
    "SineStiffness",
    "SpringEstimation",
    "StateError",
    "Stepper",
    "StepsPosition",
    "StepsStiffness",
    "SvsaError",
    "TipEllipse",
    "TipForce",
    "TipImpulse",
    "TipMass",
    "TipMove",
    "TipPush",
    "Tolerance",
    "Wall",
    "compare_runs",
    "connect",
    "connect_async",
    "describe_robot",
    "design",
    "export_run",
    "falsify",
    "identify",
    "list_runs",
    "load_prototype",
    "open_arm_run",
    "open_run",
    "paper",
    "read_design",
    "read_series",
    "reproduce",
    "resimulate",
    "run_study",
    "sample_reference",
    "save_run",
    "simulate",
    "simulate_arm",
    "sweep",
    "tune",
    "write_design",
]
