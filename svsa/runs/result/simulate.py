"""Simulation of a complete run at full speed."""

from collections.abc import Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Unpack

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.control.installed import OWN_LAW
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.runs.definition.change import Change, build_commands
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design, Lane
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.definition.paper import DURATION_S
from svsa.runs.definition.shorthand import LawChoice, Settings
from svsa.runs.execution.law_object import begin_run
from svsa.runs.execution.replay import STRETCH_TICKS, play
from svsa.runs.execution.run import Run
from svsa.runs.result.progress import Follow, follow_progress
from svsa.runs.result.result import Result, build_results
from svsa.simulation.loop.stepwise import Controller

MAX_TICKS = 5_000_000
MAX_STEPS = 1000
_OWN_STRETCH_TICKS = 1_000
"""Ticks between two progress reports with a function as controller, which is slower."""


def simulate(
    experiment: str | Configuration = "4a",
    law: LawChoice | Lane | Controller | type[object] | None = None,
    *,
    duration_s: float = DURATION_S,
    steps: int = 1,
    commands: Sequence[Change] = (),
    parameters: Design | Path | str | None = None,
    progress: Follow | None = None,
    **changes: Unpack[Settings],
) -> Result:
    """Simulate a run from rest and return its result.

    Args:
        experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
        law: Name of an installed law ("ndobc", "fl", …); a `Lane`, which is a law with its
            parameters; a function (time in s, `Reference`, x̂ as `State`, ŵ as `Disturbance`) ->
            (u1, u2) in N·m, with optional arguments `measured` and
            `applied`; or a class of objects that are called in this way, one object per run. An
            object with a method `reset` is reset at the start of each run.
        duration_s: Duration of the run, s.
        steps: Runge–Kutta steps per control period.
        commands: Changes during the run, such as `svsa.Change(at_s=5.0, law="fl")`.
        parameters: Parameter file, such as `svsa identify` writes, or its `Design`, instead of
            those of the experiment.
        progress: Called with the finished share, 0 to 1. Without it, a run of more than a second
            shows a bar if standard error is a terminal.
        **changes: Fields of the configuration to replace: position, stiffness, loads, gains,
            observer, limits, actuator, nominal, comparisons, effects, seed.

    Returns:
        Samples of all ticks and metrics, also of each comparison. A run that leaves the domain of
        the model ends early: see `Result.fault`.

    Raises:
        ParameterError: If a value is out of range, or a keyword is unknown.
        StateError: If a law object without `reset` has the state of an earlier run.
        KeyboardInterrupt: At Ctrl-C.
    """
    own = law if callable(law) else None
    named = {} if law is None or own else {"law": law}
    configuration = build_experiment(experiment, parameters, {**changes, **named}, simulate)
    period = configuration.sampling.period_s
    ticks = check_size(duration_s, steps, period)
    timed = build_commands(commands, period, duration_s)
    stretch = STRETCH_TICKS if own is None else _OWN_STRETCH_TICKS
    with (
        nullcontext() if own is None else begin_run(own) as controller,
        follow_progress("Simulating", progress) as follow,
    ):
        run = Run(configuration, steps, controller)
        samples = np.empty((len(run.lanes), ticks, len(CHANNELS)))
        for reached, _ in play(run, timed, ticks, samples, stretch):
            follow(reached.tick / ticks)
    laws = [
        OWN_LAW if own else configuration.law,
        *(lane.law for lane in configuration.comparisons),
    ]
    return build_results(configuration, samples[:, : run.tick], laws, run.fault, timed, steps=steps)


def check_size(duration_s: float, steps: int, period_s: float) -> int:
    """Check the duration of a run and its Runge–Kutta steps, and return the number of its ticks.

    Args:
        duration_s: Duration, s.
        steps: Runge–Kutta steps per control period.
        period_s: Control period T, s.

    Returns:
        The number of ticks.

    Raises:
        ParameterError: If a value is out of range, or `steps` is not a whole number.
    """
    check_number("duration_s", duration_s, "s", period_s, MAX_TICKS * period_s)
    check_number("steps", steps, "", 1, MAX_STEPS)
    if not isinstance(steps, int):
        raise ParameterError(Violation("steps", steps, "", "an integer"))
    return round(duration_s / period_s)
