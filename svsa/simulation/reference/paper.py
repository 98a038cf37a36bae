"""The references of the paper's figures, and identification of a figure by them.

Figures 4A, 4B and 5 are simulated; 6A, 6B and 7 have the same references on a bench.
"""

import math
from typing import Any, NamedTuple

from svsa.simulation.reference.kinds import PositionReference, StiffnessReference
from svsa.simulation.reference.kinds.constant import ConstantStiffness
from svsa.simulation.reference.kinds.sine import SinePosition, SineStiffness


class References(NamedTuple):
    """The references of a run: q_d and σ_d."""

    position: PositionReference
    stiffness: StiffnessReference


_MOTION = SinePosition(amplitude_rad=math.radians(60.0), frequency_hz=0.2)
FIGURE_REFERENCES = {
    "4a": References(_MOTION, ConstantStiffness(stiffness_nm_per_rad=15.0)),
    "4b": References(_MOTION, ConstantStiffness(stiffness_nm_per_rad=60.0)),
    "5": References(
        _MOTION,
        SineStiffness(
            offset_nm_per_rad=35.0,
            amplitude_nm_per_rad=1.0,
            frequency_hz=0.2,
            phase_rad=1.5 * math.pi,
        ),
    ),
}
ON_BENCH = {"4a": "6a", "4b": "6b", "5": "7"}


def find_figure(references: References, on_bench: bool = False) -> str | None:
    """Find the key of the figure with these references, whatever their transition; None for
    none.
    """
    asked = [_get_course(reference) for reference in references]
    for key, figure in FIGURE_REFERENCES.items():
        if asked == [_get_course(reference) for reference in figure]:
            return ON_BENCH[key] if on_bench else key
    return None


def _get_course(reference: PositionReference | StiffnessReference) -> dict[str, Any]:
    return reference.model_dump(exclude={"transition_s"})
