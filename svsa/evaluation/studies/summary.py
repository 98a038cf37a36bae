"""Statistics of a study: results of laws, differences of laws, sensitivities.

The error of a run that ended in a fault is not comparable with that of a complete run: in quantiles
it counts as worse than every value, and in paired differences both runs must be complete.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from svsa.errors import ParameterError, Violation
from svsa.evaluation.metrics import METRICS, RECOVERY
from svsa.evaluation.statistics import (
    Interval,
    compute_mcnemar_p,
    compute_quantiles,
    compute_signed_rank_p,
    correct_holm,
    estimate_paired_share,
    estimate_share,
    estimate_statistic,
)
from svsa.evaluation.studies.outcome import REFUSED
from svsa.evaluation.studies.rows import read_rows, select_rows
from svsa.evaluation.studies.setting import ACTUATOR
from svsa.evaluation.studies.stored import StoredStudy, StudyError
from svsa.evaluation.studies.study import Study
from svsa.evaluation.studies.work import DRAW, LAW
from svsa.inputs import arrow as pa

SHARES = (0.05, 0.5, 0.95)
SUCCEEDED = "succeeded"


class LawSummary(NamedTuple):
    """Results of a law.

    Attributes:
        law: Name of the law.
        runs: Number of runs, without rejected ones.
        refused: Number of rejected runs.
        success: Success rate.
        faults: Number of faults by code.
        quantiles: 5, 50, 95 % of each metric, infinite if they are in the runs with a fault.
    """

    law: str
    runs: int
    refused: int
    success: Interval
    faults: dict[str, int]
    quantiles: dict[str, list[float]]


class Pairing(NamedTuple):
    """The difference of two laws on the same samples.

    Attributes:
        one: Name of the first law.
        other: Name of the second law.
        pairs: Number of pairs.
        whole: Number of pairs without a fault.
        success: Difference of the success rates of all pairs, with Tango's interval.
        only_one: Number of samples on which only the first law succeeded.
        only_other: Number of samples on which only the second law succeeded.
        differences: Mean difference of each metric with its BCa interval, over the `whole` pairs in
            which both have a value (some never recover).
        success_p: P-value of McNemar's exact test, corrected by Holm's method over the pairings
            that are compared together.
        p_values: P-values of Wilcoxon's signed-rank test of each metric, corrected over the metrics
            of all these pairings; NaN if a metric has too few pairs.
    """

    one: str
    other: str
    pairs: int
    whole: int
    success: Interval
    only_one: int
    only_other: int
    differences: dict[str, Interval]
    success_p: float
    p_values: dict[str, float]


class Sensitivity(NamedTuple):
    """Sobol indices of one outcome from a base of `samples`.

    The intervals are those of a bootstrap that treats the points of the Sobol' sequence as
    independent. The sequence estimates more precisely: they are upper bounds of the uncertainty.

    Attributes:
        law: Name of the law.
        outcome: Name of the outcome.
        samples: Number of base samples.
        first_order: Share of the variance that each variation causes alone.
        total_order: Share of the variance including all its interactions.
    """

    law: str
    outcome: str
    samples: int
    first_order: dict[str, Interval]
    total_order: dict[str, Interval]


def summarize_laws(study: Study, rows: pa.Table) -> list[LawSummary]:
    """Summarize each law, in the study's order."""
    return [_summarize_law(law, study.metrics, select_rows(rows, LAW, law)) for law in study.laws]


def summarize_actuators(study: Study, rows: pa.Table) -> dict[str, list[LawSummary]]:
    """`summarize_laws` of each varied actuator of a study; empty without any."""
    return {
        name: summarize_laws(study, select_rows(rows, ACTUATOR, name))
        for name in study.varied_actuators
    }


def _summarize_law(law: str, metrics: Sequence[str], rows: pa.Table) -> LawSummary:
    faults = rows["fault"].to_pylist()
    counts = {code: faults.count(code) for code in sorted({*faults} - {None})}
    refused = counts.pop(REFUSED, 0)
    runs = len(rows) - refused
    is_run = np.array([fault != REFUSED for fault in faults], dtype=bool)
    ended = np.array([fault is not None for fault in faults], dtype=bool)
    quantiles = {
        name: compute_quantiles(_rank(name, rows, ended)[is_run], SHARES) for name in metrics
    }
    successes = int(np.sum(rows[SUCCEEDED].to_numpy()))
    return LawSummary(law, runs, refused, estimate_share(successes, runs), counts, quantiles)


def _rank(metric: str, rows: pa.Table, ended: np.ndarray) -> np.ndarray:
    """Return the metric of each run, infinite after a fault or if it never recovered."""
    values = rows[metric].to_numpy()
    never = np.isnan(values) if metric == RECOVERY else np.zeros(len(values), dtype=bool)
    return np.where(ended | never, np.inf, values)


def compare_laws(study: Study, rows: pa.Table) -> list[Pairing]:
    """Compare the study's first law with each other one on the same samples."""
    first, *others = study.laws
    sides = {law: select_rows(rows, LAW, law) for law in study.laws}
    return _correct([pair_rows(sides[first], sides[law], first, law) for law in others])


def pair_studies(first: StoredStudy, second: StoredStudy) -> list[Pairing]:
    """Compare each law that both studies have, on the same samples.

    Raises:
        StudyError: If the studies have different samples.
    """
    drawn = ("vary", "seed", "sampling")
    for name in drawn:
        if getattr(first.study, name) != getattr(second.study, name):
            raise StudyError(
                f"Studies {first.name} and {second.name} do not have the same samples ({name}):"
                " their runs cannot be paired."
            )
    tables = read_rows(first), read_rows(second)
    laws = [law for law in first.study.laws if law in second.study.laws]
    pairings = []
    for law in laws:
        sides = [select_rows(table, LAW, law) for table in tables]
        count = min(map(len, sides))
        names = f"{law} in {first.name}", f"{law} in {second.name}"
        pairings.append(pair_rows(sides[0][:count], sides[1][:count], *names))
    return _correct(pairings)


def _correct(pairings: list[Pairing]) -> list[Pairing]:
    """Correct the p-values of successes and of all metrics by Holm's method."""
    successes = correct_holm([pairing.success_p for pairing in pairings])
    metrics = iter(correct_holm([p for pairing in pairings for p in pairing.p_values.values()]))
    return [
        pairing._replace(
            success_p=success, p_values={name: next(metrics) for name in pairing.p_values}
        )
        for pairing, success in zip(pairings, successes, strict=True)
    ]


def pair_rows(rows: pa.Table, other: pa.Table, name: str, other_name: str) -> Pairing:
    """Compare rows of the same samples, in the same order; p-values uncorrected."""
    if rows[DRAW].to_pylist() != other[DRAW].to_pylist():
        raise StudyError(f"{name} and {other_name} have not run the same samples yet.")
    refused = np.zeros(len(rows), dtype=bool)
    ended = np.zeros(len(rows), dtype=bool)
    for side in (rows, other):
        faults = side["fault"].to_pylist()
        refused |= np.array([fault == REFUSED for fault in faults], dtype=bool)
        ended |= np.array([fault is not None for fault in faults], dtype=bool)
    a, b = (side[SUCCEEDED].to_numpy()[~refused] for side in (rows, other))
    only_one, only_other = int(np.sum(a & ~b)), int(np.sum(b & ~a))
    differences = {
        metric: (rows[metric].to_numpy() - other[metric].to_numpy())[~ended]
        for metric in rows.column_names
        if metric in METRICS and metric in other.column_names
    }
    return Pairing(
        one=name,
        other=other_name,
        pairs=len(a),
        whole=int(np.sum(~ended)),
        success=estimate_paired_share(only_one, only_other, len(a)),
        only_one=only_one,
        only_other=only_other,
        differences={metric: estimate_statistic(x) for metric, x in differences.items()},
        success_p=compute_mcnemar_p(only_one, only_other),
        p_values={metric: compute_signed_rank_p(x) for metric, x in differences.items()},
    )


def estimate_sensitivity(study: Study, rows: pa.Table, law: str, outcome: str) -> Sensitivity:
    """Estimate Sobol indices of a metric or of `succeeded` under a law.

    Saltelli et al. 2010 on the finished sets.

    Raises:
        StudyError: If the study was not sampled for sensitivity, a run ended in a fault or lacks
            the metric, or nothing varies.
    """
    if study.sampling != "sensitivity":
        raise StudyError("Sobol indices need a study whose sampling is sensitivity.")
    known = (SUCCEEDED, *study.metrics)
    if outcome not in known:
        bound = "one of " + ", ".join(known)
        raise ParameterError(Violation("outcome", outcome, "", bound))
    own = select_rows(rows, LAW, law)
    samples = 1 << max(len(own) // study.cells, 1).bit_length() - 1
    if samples * study.cells > len(own):
        raise StudyError("No complete set of samples is finished yet.")
    own = own[: samples * study.cells]
    ended = own.num_rows - own["fault"].null_count
    if outcome != SUCCEEDED and ended:
        raise StudyError(
            f"{ended} of {own.num_rows} runs of {law} ended in a fault and have no {outcome} to"
            f" compare: use {SUCCEEDED}."
        )
    values = own[outcome].to_numpy().astype(float).reshape(samples, study.cells).T
    if np.ptp(values) == 0.0:
        raise StudyError(f"{outcome} is the same in every run of {law}: no setting affects it.")
    sets = {"f_A": values[:1], "f_B": values[1:2], "f_AB": values[2:, None, :]}
    from scipy.stats import sobol_indices  # imported here: the import is slow

    indices: Any = sobol_indices(func=sets, n=samples, rng=np.random.default_rng(0))
    spread = indices.bootstrap(n_resamples=1000)
    names = [variation.column for variation in study.vary]
    orders = []
    for order in ("first_order", "total_order"):
        ends = getattr(spread, order).confidence_interval
        columns = (np.atleast_1d(x) for x in (getattr(indices, order), ends.low, ends.high))
        orders.append(
            {
                name: Interval(*map(float, row))
                for name, row in zip(names, zip(*columns, strict=True), strict=True)
            }
        )
    return Sensitivity(law, outcome, samples, orders[0], orders[1])
