"""A law's row of the ranking's table, its sources and its score.

score = 0.5 robustness + 0.3 share of trials that held + 0.2 accuracy, as in the benchmark of the
double pendulum. It does not count faults, which have their own column: a run that ends in a fault
and one with an error over 1° both fail.
"""

import math
from collections.abc import Iterable, Sequence
from statistics import mean
from typing import Any

from svsa.inputs.checked import Checked, Number, Whole, quantity

TABLE = (
    "law",
    "ideal_4a",
    "rig_4a",
    "load_removal_peak_deg",
    "load_removal_faults_of_48",
    "load_removal_steady_state_deg",
    "sine_2hz_rms_deg",
    "mass_rms_deg",
    "trials_median_deg",
    "trials_faults",
    "trials_fails",
    "largest_link_step_nm",
    "score",
)
"""What `svsa ranking run --json` prints of a row."""


class FigureErrors(Checked):
    """Position errors under the paper's load; None where the run ended early."""

    before_deg: Number | None = quantity("°", "rms before the load, 1–5 s")
    peak_deg: Number | None = quantity("°", "Peak, 5–7 s")
    steady_deg: Number | None = quantity("°", "rms after it, 8–20 s")


class RecoveryErrors(FigureErrors):
    """With the time until the error stays within 2 % of its peak."""

    recovery_s: Number | None = quantity("s", "Recovery; None if it does not settle")


class Outcome(Checked):
    """How a law went through one scenario, from the load on; numbers None where it ended early."""

    scenario: str = quantity("", "Name of the scenario")
    title: str = quantity("", "The scenario in words")
    rms_deg: Number | None = quantity("°", "rms position error")
    peak_deg: Number | None = quantity("°", "Greatest position error")
    torque_change_nm: Number | None = quantity("N·m", "rms change of u1 from tick to tick")
    fault: str | None = quantity("", "Code of the fault that ended the run")


class SweepOutcome(Checked):
    """How far one thing may be wrong."""

    sweep: str = quantity("", "Name of the sweep")
    title: str = quantity("", "What is varied")
    unit: str = quantity("", "Unit of the values, 1 for a ratio")
    values: tuple[Number, ...] = quantity("", "What was tried")
    passed: tuple[Number, ...] = quantity("1", "Share of the runs that held, for each value")
    share: Number = quantity("1", "Share of all runs that held", ge=0, le=1)


class ScoreParts(Checked):
    """What the score is made of: 0.5 robustness + 0.3 trials + 0.2 accuracy."""

    robustness: Number = quantity("1", "Mean of the six sweeps' shares", ge=0, le=1)
    trials: Number = quantity("1", "Share of the trials that held", ge=0, le=1)
    accuracy: Number = quantity("1", "Mean of 1 − tanh(rms / 1°), 0 for a fault", ge=0, le=1)


class Row(Checked):
    """What a law shows, errors in degrees, rms but for peaks."""

    law: str = quantity("", "Name of the law")
    version: str = quantity("", "Version of the lab that measured it")
    ideal_4a: FigureErrors = quantity("", "Figure 4A, ideal")
    rig_4a: RecoveryErrors = quantity("", "Figure 4A on the rig")
    load_removal_peak_deg: Number | None = quantity("°", "Peak after the load is taken off")
    load_removal_faults_of_48: Whole = quantity("", "Load removals that ended in a fault", ge=0)
    load_removal_steady_state_deg: Number | None = quantity(
        "°", "rms 3–5 s after the load is taken off, worst of 48; None if one ended in a fault"
    )
    sine_2hz_rms_deg: Number | None = quantity("°", "rms under 1.5 N·m at 2 Hz")
    mass_rms_deg: Number | None = quantity("°", "rms under 3 kg")
    trials_median_deg: Number | None = quantity("°", "Median of the trials' rms, None if a fault")
    trials_faults: Whole = quantity("", "Trials that ended in a fault", ge=0)
    trials_fails: Whole = quantity(
        "", "Trials that ended in a fault, or with more than 1° in the last second", ge=0
    )
    largest_link_step_nm: Number = quantity("N·m", "Largest step on the link that is survived")
    score: Number = quantity("1", "0.5 robustness + 0.3 trials + 0.2 accuracy", ge=0, le=1)
    parts: ScoreParts = quantity("", "Parts of the score")
    sweeps: tuple[SweepOutcome, ...] = quantity("", "The six sweeps of robustness")
    outcomes: tuple[Outcome, ...] = quantity("", "Every scenario that is told by itself")
    load_removals_failed: tuple[str, ...] = quantity(
        "", "Names of the load removals that ended in a fault"
    )
    load_removal_worst: str = quantity(
        "", "Name of the load removal that settled worst; the first of those that ended in a fault"
    )
    trials_failed: tuple[str, ...] = quantity("", "Names of the trials that did not hold")
    corners_fails_of_8: Whole = quantity("", "±50 % corners that ended in a fault or above 1°")

    @property
    def faults(self) -> dict[str, str]:
        """Why a scenario ended early, by its name."""
        return {one.scenario: one.fault for one in self.outcomes if one.fault}

    def get_outcome(self, scenario: str) -> Outcome:
        """How it went through the scenario of this name."""
        return next(one for one in self.outcomes if one.scenario == scenario)

    def agrees_with(self, other: "Row") -> bool:
        """Whether it says the same, numbers to nine digits (processors differ in the last).

        Which version of the lab measured it does not count.
        """
        return _agree(*(one.model_dump(exclude={"version"}) for one in (self, other)))

    def to_json(self) -> dict[str, Any]:
        """The row as `svsa ranking run --json` prints it: `TABLE`, and nothing else."""
        return {name: value for name, value in self.model_dump().items() if name in TABLE}


def _agree(one: Any, other: Any) -> bool:
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(_agree(one[key], other[key]) for key in one)
    if isinstance(one, tuple) and isinstance(other, tuple):
        return len(one) == len(other) and all(map(_agree, one, other))
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=1e-9)
    return one == other


ROBUSTNESS, TRIALS, ACCURACY = 0.5, 0.3, 0.2
REFERENCE_DEG = 1.0


def compute_accuracy(errors_deg: Iterable[float | None]) -> float:
    """The mean of 1 − tanh(rms / 1°) over runs; one that ended early has None and counts 0."""
    return mean(0.0 if rms is None else 1.0 - math.tanh(rms / REFERENCE_DEG) for rms in errors_deg)


def build_parts(
    sweeps: Sequence[SweepOutcome], trials: int, fails: int, errors_deg: Iterable[float | None]
) -> ScoreParts:
    """The parts of a law's score. trials: how many were made, fails: of them did not hold.

    errors_deg: rms in the scenarios that are told one by one.
    """
    return ScoreParts(
        robustness=mean(sweep.share for sweep in sweeps),
        trials=1.0 - fails / trials,
        accuracy=compute_accuracy(errors_deg),
    )


def compute_score(parts: ScoreParts) -> float:
    """0.5 robustness + 0.3 trials + 0.2 accuracy, from 0 to 1."""
    return ROBUSTNESS * parts.robustness + TRIALS * parts.trials + ACCURACY * parts.accuracy
