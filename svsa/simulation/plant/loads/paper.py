"""The load of the paper's experiment."""

from typing import Literal

import numpy as np

from svsa.inputs.checked import quantity
from svsa.simulation.plant.loads.load import W2, W6, AnyLoad

PAPER_TORQUE_NM = 2.0


class PaperLoad(AnyLoad):
    """The paper's 3 kg: w2 = w4 = w6 = 2 N·m, as printed."""

    kind: Literal["paper"] = quantity("", "Paper", default="paper")

    def describe(self) -> str:
        """Describe the load as "3 kg"."""
        return "3 kg"

    def name(self) -> str:
        """Return "3 kg load"."""
        return "3 kg load"

    def fill(self, row: np.ndarray) -> None:
        """Write the paper's torque into its row."""
        row[W2 : W6 + 1] = PAPER_TORQUE_NM
