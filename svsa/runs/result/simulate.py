"""A whole run at once, as fast as it goes."""

from collections.abc import Sequence
from pathlib import Path
from typing import Unpack

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.control.installed import OWN_LAW
from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.runs.change import Change, build_commands
from svsa.runs.configuration import Configuration, Design
from svsa.runs.experiment import build_experiment
from svsa.runs.paper import DURATION_S
from svsa.runs.replay import STRETCH_TICKS, play
from svsa.runs.result.progress import Follow, follow_progress
from svsa.runs.result.result import Result, build_results
from svsa.runs.run import Run
from svsa.runs.shorthand import LawChoice, Settings
from svsa.simulation.loop.stepwise import Controller

MAX_TICKS = 5_000_000
MAX_STEPS = 1000
_OWN_STRETCH_TICKS = 1_000
"""From one progress to the next with a function as controller, which takes longer."""


def simulate(
    experiment: str | Configuration = "4a",
    law: LawChoice | Controller | None = None,
    *,
    duration_s: float = DURATION_S,
    steps: int = 1,
    commands: Sequence[Change] = (),
    parameters: Design | Path | str | None = None,
    progress: Follow | None = None,
    **changes: Unpack[Settings],
) -> Result:
    """Simulate a run from rest and return everything that happened.

    experiment: a figure of the paper ("4a", "4b", "5") or a `Configuration`. law: the name of one
    that is installed ("ndobc", "fl", …), or a function (`Controller`): time in s, `Reference`, x̂
    as `State`, ŵ as `Disturbance` → (u1, u2) in N·m; measured and applied where it names them.
    duration_s: s. steps: Runge–Kutta steps a control period. commands: what is changed while it
    runs, such as `svsa.Change(at_s=5.0, law="fl")`. parameters: a parameter file, such as
    `svsa identify` writes, or its `Design`, instead of the experiment's own. progress: called with
    the share that is done, 0 to 1; without it, a run of more than a second shows a bar if standard
    error is a terminal. changes: fields of the configuration to replace, e.g. position, stiffness,
    loads, gains, observer, limits, actuator, nominal, comparisons, effects, seed.

    Raises `ParameterError` for a value out of range, `KeyboardInterrupt` at Ctrl-C. A run that
    leaves the domain of the model ends early: see `Result.fault`.
    """
    own = law if callable(law) else None
    named = {} if law is None or own else {"law": law}
    configuration = build_experiment(experiment, parameters, {**changes, **named}, simulate)
    period = configuration.sampling.period_s
    check_number("duration_s", duration_s, "s", period, MAX_TICKS * period)
    check_number("steps", steps, "", 1, MAX_STEPS)
    if not isinstance(steps, int):
        raise ParameterError(Violation("steps", steps, "", "a whole number"))
    given = build_commands(commands, period, duration_s)
    run = Run(configuration, steps, own)
    ticks = round(duration_s / period)
    samples = np.empty((len(run.lanes), ticks, len(CHANNELS)))
    stretch = STRETCH_TICKS if own is None else _OWN_STRETCH_TICKS
    with follow_progress("Simulating", progress) as follow:
        for reached, _ in play(run, given, ticks, samples, stretch):
            follow(reached.tick / ticks)
    laws = [
        OWN_LAW if own else configuration.law,
        *(lane.law for lane in configuration.comparisons),
    ]
    return build_results(configuration, samples[:, : run.tick], laws, run.fault, given, steps=steps)
