"""SVSA Lab: a serial variable stiffness actuator, its control, and the paper's experiment.

    import svsa
    result = svsa.simulate("4a", "ndobc")
    result.metrics.rms_position_error_rad
    result.plot().savefig("run.png")

Units are SI; every name ends in its unit.
"""

from importlib import import_module
from typing import TYPE_CHECKING

from svsa import paper
from svsa.control.gains import Gains
from svsa.errors import FaultError, ParameterError, StateError, SvsaError
from svsa.extras import MissingExtraError
from svsa.observer.disturbance import ObserverBandwidth
from svsa.paper.reproduce import reproduce
from svsa.parameters import ActuatorParameters, Limits
from svsa.plant.disturbances import (
    ConstantLoad,
    MassLoad,
    PaperLoad,
    PulseLoad,
    PushLoad,
    SeriesLoad,
    SineLoad,
)
from svsa.plant.effects import IDEAL, RIG, Effects
from svsa.reference.chirp import ChirpPosition, ChirpStiffness
from svsa.reference.minimum_jerk import MinimumJerkPosition, MinimumJerkStiffness
from svsa.reference.preview import sample_reference
from svsa.reference.series import SeriesPosition, SeriesStiffness
from svsa.reference.series_csv import read_series
from svsa.reference.sine import ConstantPosition, ConstantStiffness, SinePosition, SineStiffness
from svsa.reference.steps import StepsPosition, StepsStiffness
from svsa.release import __version__ as __version__
from svsa.result.channels import ChannelName
from svsa.result.result import Result
from svsa.result.simulate import simulate
from svsa.run.change import Change
from svsa.run.configuration import (
    Configuration,
    Design,
    Lane,
    load_prototype,
    read_design,
    write_design,
)

if TYPE_CHECKING:
    from svsa import design, falsify
    from svsa.arena.tune import tune
    from svsa.client import connect, connect_async
    from svsa.records.catalogue.runs import Catalogue
    from svsa.result.recorded import export_run, open_run, resimulate, runs

_LATE = {
    "design": "svsa.design",
    "falsify": "svsa.falsify",
    "connect": "svsa.client",
    "connect_async": "svsa.client",
    "Catalogue": "svsa.records.catalogue.runs",
    "tune": "svsa.arena.tune",
    **dict.fromkeys(("export_run", "open_run", "resimulate", "runs"), "svsa.result.recorded"),
}


_MODULES = ("design", "falsify")


def __getattr__(name: str) -> object:
    """What a simulation does without, and what takes a while to import, when it is asked for."""
    if name not in _LATE:
        raise AttributeError(f"module 'svsa' has no attribute {name!r}")
    module = import_module(_LATE[name])
    return module if name in _MODULES else getattr(module, name)


__all__ = [
    "IDEAL",
    "RIG",
    "ActuatorParameters",
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
    "MassLoad",
    "MinimumJerkPosition",
    "MinimumJerkStiffness",
    "MissingExtraError",
    "ObserverBandwidth",
    "PaperLoad",
    "ParameterError",
    "PulseLoad",
    "PushLoad",
    "Result",
    "SeriesLoad",
    "SeriesPosition",
    "SeriesStiffness",
    "SineLoad",
    "SinePosition",
    "SineStiffness",
    "StateError",
    "StepsPosition",
    "StepsStiffness",
    "SvsaError",
    "connect",
    "connect_async",
    "design",
    "export_run",
    "falsify",
    "load_prototype",
    "open_run",
    "paper",
    "read_design",
    "read_series",
    "reproduce",
    "resimulate",
    "runs",
    "sample_reference",
    "simulate",
    "tune",
    "write_design",
]
