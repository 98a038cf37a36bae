"""Figures of independent prototypes of the laws, and how a row of the ranking stands to them.

They were measured on the same plant, limits and scenarios, to the digits given. Errors in degrees.
"""

import math
from typing import NamedTuple

from svsa.evaluation.ranking.row import Row

NEAR = 1.05
FAULT = NEVER = math.inf
UNKNOWN = math.nan


class Prototype(NamedTuple):
    """before, peak, steady: figure 4A, rms 1–5 s, peak, rms 8–20 s. rig_…: there; recovery: s.

    off: peak when the load is taken off at σ = 15. sine: rms under 1.5 N·m at 2 Hz. mass: rms
    under 3 kg. faults: of 48 load removals. step: largest on the link that is held, N·m. A run that
    ends in a fault is an error without bound; what was not measured is not a number.
    """

    before: float
    peak: float
    steady: float
    rig_peak: float
    rig_steady: float
    recovery: float
    off: float
    sine: float
    mass: float
    faults: float
    step: float


ERRORS = Prototype._fields[:9]

PROTOTYPES = {
    "fl": Prototype(0.0402, 12.06, 12.08, 12.07, 12.08, NEVER, 12.1, 5.58, 6.78, UNKNOWN, 0.0),
    "ndobc": Prototype(0.0012, 4.14, 0.0013, 5.63, 0.0072, 0.24, FAULT, 2.38, 0.314, 32, 2.0),
    "ndobc_w": Prototype(0.0002, 4.89, 0.0002, 6.15, 0.0075, 0.27, 6.7, 1.11, 0.086, 0, 8.5),
    "linear_dob": Prototype(0.0015, 4.81, 0.0022, 6.16, 0.0076, 0.28, 5.6, 2.80, 0.383, 15, 3.0),
    "adrc": Prototype(0.0028, 5.36, 0.0030, 5.49, 0.0080, 0.68, 5.1, 2.79, 0.397, 16, 3.0),
    "pi_observer": Prototype(0.0014, 5.15, 0.0015, 5.27, 0.0058, 0.18, FAULT, 2.33, 0.310, 24, 2.5),
    "super_twisting": Prototype(0.111, 4.38, 0.111, 5.38, 0.036, 14, FAULT, 1.02, 0.700, 31, 3.0),
    "fl_integral": Prototype(0.0016, 4.69, 0.0017, 5.92, 0.0072, 0.32, 5.8, 2.64, 0.351, 16, 2.0),
    "nmpc": Prototype(0.0018, 7.58, 0.0020, 7.96, 0.0101, 0.35, 8.7, 3.31, 0.461, UNKNOWN, 4.0),
    "pid": Prototype(0.0033, 16.1, 0.0093, 17.4, 0.067, 4.2, 16.7, 5.23, FAULT, UNKNOWN, 2.0),
    "esp": Prototype(0.0011, 4.41, 0.0010, 5.48, 0.0062, 0.21, 5.2, 2.23, 0.254, 16, 2.5),
    "lqi": Prototype(0.0023, 6.11, 0.0032, 7.46, 0.0090, 0.35, 7.0, 3.68, 0.488, 8, 3.0),
    "backstepping": Prototype(
        0.0080, 6.74, 0.0077, 5.53, 0.030, 11, 4.6, 1.76, 0.255, UNKNOWN, 5.0
    ),
}

KEPT = {
    "ndobc_s": Prototype(0.0001, 4.04, 0.0001, 5.19, 0.0065, 0.176, 6.1, 1.99, 0.083, 0, 9.5),
    "rbf_network": Prototype(0.0019, 5.3, 0.0124, 7.0, 0.015, 0.30, 6.3, 3.32, 0.453, 16, 2.5),
}
"""Laws without a prototype of this form: what they were measured at when they came."""


class Cell(NamedTuple):
    """A figure of a law beside its prototype's."""

    column: str
    found: float
    figure: float

    @property
    def ratio(self) -> float:
        """Found over figure, of a step the other way round: above 1 is worse."""
        if self.found == self.figure:
            return 1.0
        one, other = (self.figure, self.found) if self.column == "step" else self[1:]
        return math.inf if other == 0.0 else one / other

    @property
    def holds(self) -> bool:
        """As good as the prototype, within 5 %, or nothing to hold to."""
        return math.isnan(self.figure) or self.ratio <= NEAR


def read_figures(row: Row) -> Prototype:
    """The same figures of a row of the ranking."""
    ideal, rig = row.ideal_4a, row.rig_4a
    errors = (
        ideal.before_deg,
        ideal.peak_deg,
        ideal.steady_deg,
        rig.peak_deg,
        rig.steady_deg,
        rig.recovery_s,
        row.load_removal_peak_deg,
        row.sine_2hz_rms_deg,
        row.mass_rms_deg,
    )
    reported = (math.inf if error is None else error for error in errors)
    return Prototype(*reported, row.load_removal_faults_of_48, row.largest_link_step_nm)


def compare(row: Row) -> tuple[Cell, ...]:
    """Every figure of a law's row beside its prototype's, column by column."""
    found, figures = read_figures(row), (PROTOTYPES | KEPT)[row.law]
    return tuple(map(Cell, Prototype._fields, found, figures))
