"""Figures of independent prototypes of the laws, and the same figures of the laws here.

They were measured with the same plant, limits and scenarios, to the given digits. Errors are in
degrees.
"""

import math
from typing import NamedTuple

import svsa
from svsa.evaluation.reproduction import compute_table_row
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.paper import FIGURES, LOAD_TIME_S, STEADY_S
from svsa.simulation.plant.effects import RIG
from svsa.simulation.plant.loads.mass import MassLoad
from svsa.simulation.plant.loads.sine import SineLoad

NEAR = 1.05
FAULT = NEVER = math.inf


class Prototype(NamedTuple):
    """before, peak, steady: figure 4A, rms 1–5 s, peak, rms 8–20 s. rig_…: there; recovery: s.

    sine: rms under 1.5 N·m at 2 Hz. mass: rms under 3 kg. The error of a run that ends in a fault
    is infinite.
    """

    before: float
    peak: float
    steady: float
    rig_peak: float
    rig_steady: float
    recovery: float
    sine: float
    mass: float


PROTOTYPES = {
    "fl": Prototype(0.0402, 12.06, 12.08, 12.07, 12.08, NEVER, 5.58, 6.78),
    "ndobc": Prototype(0.0012, 4.14, 0.0013, 5.63, 0.0072, 0.24, 2.38, 0.314),
    "ndobc_w": Prototype(0.0002, 4.89, 0.0002, 6.15, 0.0075, 0.27, 1.11, 0.086),
    "linear_dob": Prototype(0.0015, 4.81, 0.0022, 6.16, 0.0076, 0.28, 2.80, 0.383),
    "adrc": Prototype(0.0028, 5.36, 0.0030, 5.49, 0.0080, 0.68, 2.79, 0.397),
    "pi_observer": Prototype(0.0014, 5.15, 0.0015, 5.27, 0.0058, 0.18, 2.33, 0.310),
    "super_twisting": Prototype(0.111, 4.38, 0.111, 5.38, 0.036, 14, 1.02, 0.700),
    "fl_integral": Prototype(0.0016, 4.69, 0.0017, 5.92, 0.0072, 0.32, 2.64, 0.351),
    "nmpc": Prototype(0.0018, 7.58, 0.0020, 7.96, 0.0101, 0.35, 3.31, 0.461),
    "pid": Prototype(0.0033, 16.1, 0.0093, 17.4, 0.067, 4.2, 5.23, FAULT),
    "esp": Prototype(0.0011, 4.41, 0.0010, 5.48, 0.0062, 0.21, 2.23, 0.254),
    "lqi": Prototype(0.0023, 6.11, 0.0032, 7.46, 0.0090, 0.35, 3.68, 0.488),
    "backstepping": Prototype(0.0080, 6.74, 0.0077, 5.53, 0.030, 11, 1.76, 0.255),
}

KEPT = {
    "ndobc_s": Prototype(0.0001, 4.04, 0.0001, 5.19, 0.0065, 0.176, 1.99, 0.083),
    "rbf_network": Prototype(0.0019, 5.3, 0.0124, 7.0, 0.015, 0.30, 3.32, 0.453),
}
"""Laws without a prototype of this form: their figures when they were added."""


class Cell(NamedTuple):
    """A figure of a law and that of its prototype."""

    column: str
    found: float
    figure: float

    @property
    def holds(self) -> bool:
        """Whether the figure is at most 5 % worse than that of the prototype."""
        return self.found <= NEAR * self.figure or math.isinf(self.figure)


def measure_figures(law: str) -> Prototype:
    """Measure the same figures of an installed law with its defaults."""
    figure = FIGURES["4a"].build_configuration(law)
    ideal, rig = _measure_figure(figure), _measure_figure(figure.changed(effects=RIG))
    sine = SineLoad(torque_nm=(1.5, 0.0, 0.0), frequency_hz=2.0, start_s=LOAD_TIME_S)
    errors = [
        _measure_steady(figure.changed(effects=RIG, loads=(load,)))
        for load in (sine, MassLoad(start_s=LOAD_TIME_S))
    ]
    return Prototype(*ideal[:3], *rig[1:], *errors)


def _measure_figure(configuration: Configuration) -> tuple[float, float, float, float]:
    """Return before, peak, steady and recovery."""
    run = svsa.simulate(configuration)
    if run.fault is not None:
        return (FAULT,) * 4
    row = compute_table_row(run)
    names = "rms_position_before_deg", "peak_position_deg", "rms_position_steady_deg"
    before, peak, steady = (float(row[name]) for name in names)
    recovery = row["recovery_s"]
    return before, peak, steady, NEVER if recovery is None else float(recovery)


def _measure_steady(configuration: Configuration) -> float:
    run = svsa.simulate(configuration)
    if run.fault is not None:
        return FAULT
    return math.degrees(run.measure(*STEADY_S).rms_position_error_rad)


def compare(law: str) -> tuple[Cell, ...]:
    """Compare every figure of a law with that of its prototype, column by column."""
    found, figures = measure_figures(law), (PROTOTYPES | KEPT)[law]
    return tuple(map(Cell, Prototype._fields, found, figures))
