"""The score: one number of what a law bears, in the manner of the double pendulum's benchmark.

score = 0.5 robustness + 0.3 share of trials that held + 0.2 accuracy. It says nothing of faults,
which therefore stand beside it: a law that ends in a fault and one that is a degree off both fail.
"""

import math
from collections.abc import Iterable, Sequence
from statistics import mean

from svsa.evaluation.ranking.row import ScoreParts, SweepOutcome

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
    """0.5 robustness + 0.3 draws + 0.2 accuracy, from 0 to 1."""
    return ROBUSTNESS * parts.robustness + TRIALS * parts.trials + ACCURACY * parts.accuracy
