"""A row of the ranking: results of a law with its parameters on trials and fixed scenarios."""

from svsa.evaluation.ranking.entry import Variant
from svsa.evaluation.tuning.tuned_law import TunedLaw
from svsa.inputs.checked import Checked, Number, Whole, quantity

QUANTILES = (0.0, 0.05, 0.1, 0.25, 0.5, 0.75, 0.9, 0.95, 1.0)
"""Shares of the trials below the values that describe a distribution."""
DIGITS = 6


class RecoveryErrors(Checked):
    """Position errors of a figure with its load at 5 s; None where the run ended early."""

    before_deg: Number | None = quantity("°", "rms before the load, 1–5 s")
    peak_deg: Number | None = quantity("°", "Peak, 5–7 s")
    steady_deg: Number | None = quantity("°", "rms after it, 8–20 s")
    recovery_s: Number | None = quantity("s", "Recovery time; None if it does not settle")


class FamilyOutcome(Checked):
    """The outcome of the trials of one family."""

    trials: Whole = quantity("", "Trials", ge=1)
    held: Whole = quantity("", "Successful trials", ge=0)
    success: Number = quantity("1", "Success rate", ge=0, le=1)
    success_low: Number = quantity("1", "Lower end of Wilson's 95 % interval", ge=0, le=1)
    success_high: Number = quantity("1", "Upper end of Wilson's 95 % interval", ge=0, le=1)
    faults: dict[str, Whole] = quantity("", "Trials that ended in a fault, by its code")
    held_bits: str = quantity("", "Whether each trial held: bits in hexadecimal, the first highest")
    metrics: dict[str, tuple[Number | None, ...]] = quantity(
        "", "Quantiles of each metric, see QUANTILES; None where a trial has no value"
    )

    def get_median(self, metric: str) -> float | None:
        """Return the median of a metric over the trials; None if it is not finite."""
        return self.metrics[metric][QUANTILES.index(0.5)]


class ScenarioOutcome(Checked):
    """The outcome of a fixed scenario over its signs and phases; None where a run ended early."""

    scenario: str = quantity("", "Name of the scenario")
    title: str = quantity("", "Title of the scenario")
    runs: Whole = quantity("", "Variants over sign and phase", ge=1)
    faults: Whole = quantity("", "Variants that ended in a fault", ge=0)
    held: Whole = quantity("", "Successful variants", ge=0)
    worst: str = quantity("", "Name of the worst variant")
    median: dict[str, Number | None] = quantity("", "Median of each metric over the variants")
    worst_values: dict[str, Number | None] = quantity("", "Worst value of each metric")


class Noise(Checked):
    """Torque at rest under the rig's effects with noise, mean of eight runs."""

    rms_nm: Number | None = quantity("N·m", "rms of u1; None for a fault at rest")
    variation_nm_per_s: Number | None = quantity("N·m/s", "Total variation of u1")


class Row(Checked):
    """Results of a law with its parameters."""

    key: str = quantity("", "Name of the row")
    law: str = quantity("", "Name of the law")
    variant: Variant = quantity("", "Parameter set")
    version: str = quantity("", "Version of the lab that measured it")
    tuning: TunedLaw | None = quantity(
        "", "Source and values of the tuned parameters", default=None
    )
    families: dict[str, FamilyOutcome] = quantity("", "Trials by family")
    scenarios: tuple[ScenarioOutcome, ...] = quantity("", "Fixed scenarios")
    noise: Noise = quantity("", "Torque at rest")
    largest_load_nm: Number = quantity(
        "N·m", "Largest torque step on the link with success for all signs and phases"
    )

    def get_outcome(self, scenario: str) -> ScenarioOutcome:
        """Return the outcome of the fixed scenario of this name."""
        return next(outcome for outcome in self.scenarios if outcome.scenario == scenario)
