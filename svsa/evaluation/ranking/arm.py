"""The ranking of controllers of an arm: each tuned on training trials, graded on test trials."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

import numpy as np
from pydantic import field_validator

from svsa.actuators.domain import INSIDE
from svsa.control.installed import get_law, list_law_names
from svsa.errors import ParameterError, Violation
from svsa.evaluation.metrics import compute_metrics, find_held
from svsa.evaluation.ranking.results import rank_held
from svsa.evaluation.ranking.table import format_p
from svsa.evaluation.ranking.test_set import NAME
from svsa.evaluation.statistics import estimate_median, estimate_share
from svsa.evaluation.trials import LOAD_S
from svsa.evaluation.tuning.arm import (
    ARM,
    ArmController,
    ArmTrial,
    build_arm_problem,
    build_arm_trials,
    run_arm_trials,
)
from svsa.evaluation.tuning.judge import LOUD
from svsa.evaluation.tuning.tuner import Candidate, tune
from svsa.inputs.checked import Checked, Flag, Number, Whole, quantity
from svsa.runs.definition.arm_experiment import ARMS

LEFT_OUT = ("ilc", "impedance", "ndobc_k", "nmpc")
"""A law that learns over repetitions, one that yields to loads by choice, and one that takes a
thousand times as long as the others.
"""
INFEASIBLE = " †"
"""Mark of a row whose search found no parameters that are at rest below the noise limit."""
OUTPUTS = ("e [°]", "e_σ [%]")
"""Of each joint."""
HEADINGS = ("rank", "controller", "held of {trials}, % (95 %)", "faults", "p against NDOBC")


class ArmProtocol(Checked):
    """Budget and trials of an arm's ranking; rows are comparable within one protocol."""

    budget: Whole = quantity("", "Candidates of each search", ge=1, default=128)
    training: Whole = quantity("", "Training trials of each candidate", ge=1, default=24)
    validation: Whole = quantity("", "Validation trials of the best ten", ge=1, default=48)
    trials: Whole = quantity("", "Test trials", ge=1, default=96)
    seed: Whole = quantity("", "Seed of searches and trials", ge=0, default=0)
    arm: str = quantity("", "Name of the arm", default=ARM)

    @field_validator("arm")
    @classmethod
    def _check_arm(cls, name: str) -> str:
        if name not in ARMS:
            raise ParameterError(Violation("", name, "", "one of " + ", ".join(ARMS)))
        return name

    @property
    def joints(self) -> int:
        """Number of joints of the arm."""
        return len(ARMS[self.arm].links.chain)


class Median(Checked):
    """A median over the trials with its 95 % interval; None for a fault or without an interval."""

    value: Number | None
    low: Number | None
    high: Number | None


class ArmRow(Checked):
    """The result of one controller of an arm: tuned values, success, faults and errors."""

    law: str = quantity("", "Name of the law")
    feedforward: Flag = quantity("", "Whether it receives the arm feedforward")
    adaptive: Flag = quantity("", "Whether the payload is estimated")
    values: dict[str, Number] = quantity("", "Tuned values by name")
    before: Number = quantity("1", "Cost of the default parameters on the validation trials")
    after: Number = quantity("1", "Cost of the tuned parameters on the validation trials")
    held: tuple[Flag, ...] = quantity("", "Whether all joints held, of each test trial")
    faults: Whole = quantity("", "Test trials that ended in a fault", ge=0)
    outputs: tuple[Median, ...] = quantity(
        "",
        "Medians of the rms position error (°), then of the rms stiffness error (%), of each joint",
    )

    @property
    def controller(self) -> ArmController:
        """The controller of this row."""
        return ArmController(self.law, self.feedforward, self.adaptive)


class ArmResults(Checked):
    """Results of the ranking of an arm's controllers, with their protocol."""

    protocol: ArmProtocol
    rows: tuple[ArmRow, ...] = ()


class ArmTest(NamedTuple):
    """The test trials: built once for all controllers."""

    protocol: ArmProtocol
    trials: tuple[ArmTrial, ...]


def list_arm_controllers() -> list[ArmController]:
    """List every suitable law; if it takes the feedforward, also with it, and adaptive."""
    controllers = []
    for law in list_law_names():
        if law not in LEFT_OUT:
            controllers.append(ArmController(law))
            if get_law(law).takes_feedforward:
                controllers += [ArmController(law, True), ArmController(law, True, True)]
    return controllers


def build_arm_test(protocol: ArmProtocol) -> ArmTest:
    """Build the test trials of a protocol."""
    return ArmTest(protocol, build_arm_trials(NAME, protocol.seed, protocol.trials, protocol.arm))


def measure_arm_row(
    controller: ArmController,
    test: ArmTest,
    on_candidate: Callable[[Candidate], None] = lambda _: None,
) -> ArmRow:
    """Tune a controller, and grade it on the test trials.

    Args:
        controller: Law, and whether it receives feedforward and an estimated payload.
        test: Test trials and their protocol.
        on_candidate: Called with each candidate of the search.

    Returns:
        Tuned values, costs, success of each trial, and medians of the errors.
    """
    p = test.protocol
    tuned = tune(
        controller.law,
        budget=p.budget,
        trials=p.training,
        validation=p.validation,
        seed=p.seed,
        on_candidate=on_candidate,
        problem=build_arm_problem(controller, p.arm),
    )
    summaries = run_arm_trials(test.trials, controller, tuned.design)
    labels = [axis.label for axis in tuned.space.axes]
    return ArmRow(
        law=controller.law,
        feedforward=controller.feedforward,
        adaptive=controller.adaptive,
        values=dict(zip(labels, tuned.best.values, strict=True)),
        before=tuned.finals[0].judgment.cost,
        after=tuned.best.judgment.cost,
        held=tuple(bool(np.all(find_held(trial))) for trial in summaries),
        faults=int(np.sum(summaries["code"][:, 0] != INSIDE)),
        outputs=tuple(map(_describe_median, _list_errors(test, summaries))),
    )


def _list_errors(test: ArmTest, summaries: np.ndarray) -> list[np.ndarray]:
    """List rms position errors (°), then rms stiffness errors (%), of each joint.

    Each array has shape (trials,); infinite for a trial that ended in a fault.
    """
    periods = np.array([trial.configuration.sampling.period_s for trial in test.trials])
    sigmas = np.array([trial.sigmas for trial in test.trials])
    positions, stiffnesses = [], []
    for joint in range(test.protocol.joints):
        metrics = compute_metrics(summaries[:, joint], periods, LOAD_S)
        ended = summaries["code"][:, joint] != INSIDE
        share = metrics["rms_stiffness_error_nm_per_rad"] / sigmas[:, joint]
        error = np.degrees(metrics["rms_position_error_rad"])
        positions.append(np.where(ended, np.inf, error))
        stiffnesses.append(np.where(ended, np.inf, 100.0 * share))
    return positions + stiffnesses


def _describe_median(values: np.ndarray) -> Median:
    numbers = (x if np.isfinite(x) else None for x in estimate_median(values))
    value, low, high = numbers
    return Median(value=value, low=low, high=high)


def measure_arm_rows(
    controllers: Sequence[ArmController],
    protocol: ArmProtocol,
    known: Sequence[ArmRow] = (),
    report: Callable[[ArmController, float], None] = lambda controller, done: None,
) -> Iterator[ArmResults]:
    """Yield the results after each controller, with the `known` rows of the same protocol.

    `report` receives the controller and its finished share.
    """
    rows = {row.controller: row for row in known}
    test = build_arm_test(protocol)
    for controller in controllers:

        def follow(candidate: Candidate, controller: ArmController = controller) -> None:
            report(controller, min(1.0, candidate.number / protocol.budget))

        rows[controller] = measure_arm_row(controller, test, follow)
        yield order_arm_rows(list(rows.values()), protocol)


def order_arm_rows(rows: Sequence[ArmRow], protocol: ArmProtocol) -> ArmResults:
    """Order rows by success rate, the highest first, in the results of a protocol."""
    ordered = sorted(rows, key=lambda row: (-sum(row.held), row.controller.key))
    return ArmResults(protocol=protocol, rows=tuple(ordered))


def list_arm_headings(results: ArmResults) -> list[str]:
    """List the headings of the table, with the number of trials."""
    p = results.protocol
    joints = range(1, p.joints + 1)
    outputs = [f"joint {joint}: {output}" for output in OUTPUTS for joint in joints]
    return [heading.format(trials=p.trials) for heading in HEADINGS] + outputs


def list_arm_cells(results: ArmResults) -> list[list[str]]:
    """List the cells of the table, a row for each controller; see `INFEASIBLE`."""
    held = {row.controller.key: np.array(row.held) for row in results.rows}
    ranks, p_values = rank_held(held)
    table = []
    for row in results.rows:
        key = row.controller.key
        share = estimate_share(sum(row.held), len(row.held))
        percent = (f"{100.0 * number:.0f}" for number in share)
        value, low, high = percent
        title = row.controller.title + (INFEASIBLE if row.after >= LOUD else "")
        cells = [str(ranks[key]), title, f"{value} ({low}–{high})", str(row.faults)]
        cells += [format_p(p_values.get(key)), *map(format_median, row.outputs)]
        table.append(cells)
    return table


def format_median(median: Median) -> str:
    """Format a median with its interval; "fault" if the median is a fault."""
    value, low, high = (
        "fault" if number is None else f"{number:.2g}"
        for number in (median.value, median.low, median.high)
    )
    return value if value == high == low else f"{value} ({low}–{high})"


def format_arm_markdown(results: ArmResults) -> str:
    """Format the table of an arm's ranking as Markdown."""
    headings = list_arm_headings(results)
    lines = [headings, ["---"] * len(headings), *list_arm_cells(results)]
    return "\n".join(f"| {' | '.join(cells)} |" for cells in lines)
