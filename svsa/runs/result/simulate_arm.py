"""Simulation of an arm at full speed."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Unpack

import numpy as np

from svsa.actuators.arm.parameters import ArmParameters
from svsa.actuators.signals import CHANNELS
from svsa.control.arm_payload import PayloadAdaptation
from svsa.runs.definition.arm_experiment import build_arm_experiment
from svsa.runs.definition.change import Change, build_commands
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Lane
from svsa.runs.definition.paper import DURATION_S
from svsa.runs.definition.shorthand import LawChoice, Settings
from svsa.runs.execution.arm_run import ArmRun
from svsa.runs.execution.replay import play
from svsa.runs.result.arm import ArmResult, build_arm_results
from svsa.runs.result.progress import Follow, follow_progress
from svsa.runs.result.simulate import check_size
from svsa.simulation.arm.tip_reference import AnyTipReference
from svsa.simulation.plant.loads.tip import AnyTipLoad


def simulate_arm(
    experiment: str | Configuration = "rods",
    law: LawChoice | Lane | None = None,
    *,
    duration_s: float = DURATION_S,
    steps: int = 1,
    feedforward: bool | None = None,
    adaptation: PayloadAdaptation | bool | None = None,
    tip: AnyTipReference | None = None,
    tip_loads: AnyTipLoad | Sequence[AnyTipLoad] | None = None,
    arm: ArmParameters | None = None,
    model: ArmParameters | None = None,
    joint1: Mapping[str, Any] | None = None,
    joint2: Mapping[str, Any] | None = None,
    joint3: Mapping[str, Any] | None = None,
    joint4: Mapping[str, Any] | None = None,
    commands: Iterable[Change] = (),
    progress: Follow | None = None,
    **changes: Unpack[Settings],
) -> ArmResult:
    """Simulate an arm with an actuator and a controller in each of its joints.

    Args:
        experiment: Name of an arm ("rods": two rods of 0.3 m and 0.3 kg with the SVSA, "maccepa":
            a two-link arm with MACCEPA), or the `Configuration` of an arm.
        law: Name of the installed law of all joints, or a `Lane`, which is a law with its
            parameters.
        duration_s: Duration of the run, s.
        steps: Runge–Kutta steps in a control period.
        feedforward: Whether the laws get what the arm's model explains along the references; None:
            as in the experiment.
        adaptation: Whether to estimate the mass at the tip for feedforward and nominal inertias,
            or its parameters; None: as in the experiment.
        tip: Reference of the tip, `TipEllipse` or `TipMove`, in place of those of the joints.
        tip_loads: One load at the tip or several: `TipMass`, `TipForce`, `TipImpulse`, `Wall`.
        arm: Parameters of the links, one for each joint.
        model: Parameters of the links as the feedforward knows them; by default those of the arm.
        joint1: Settings of joint 1 only, by name, as of `changes`, and `law`.
        joint2: Settings of joint 2 only.
        joint3: Settings of joint 3 only.
        joint4: Settings of joint 4 only.
        commands: Changes during the run, each of one joint or of all.
        progress: Called with the finished share instead of showing a progress bar.
        changes: Settings of all joints: position, stiffness, loads, gains, observer, limits,
            actuator, nominal, effects, seed, comparisons (of a second arm).

    Returns:
        The samples of all joints with metrics of each, and the tip. A run in which a joint leaves
        the domain of its model ends early: see `ArmResult.fault`.

    Raises:
        ParameterError: For a value out of range, or an unknown keyword.
        KeyboardInterrupt: At Ctrl-C.
    """
    every = dict(changes) if law is None else {**changes, "law": law}
    fields = {"feedforward": feedforward, "links": arm, "model": arm if model is None else model}
    fields["tip"] = tip
    arm_fields = {name: value for name, value in fields.items() if value is not None}
    if adaptation is not None:
        arm_fields["adaptation"] = PayloadAdaptation() if adaptation is True else adaptation or None
    each = [settings or {} for settings in (joint1, joint2, joint3, joint4)]
    c = build_arm_experiment(experiment, arm_fields, every, each, tip_loads)
    period = c.sampling.period_s
    ticks = check_size(duration_s, steps, period)
    run, lanes = ArmRun(c, steps), len(c.lanes)
    at_ticks = build_commands(commands, period, duration_s)
    samples = np.empty((lanes, ticks, len(CHANNELS)))
    with follow_progress("Simulating", progress) as follow:
        for reached, _ in play(run, at_ticks, ticks, samples):
            follow(reached.tick / ticks)
    return build_arm_results(c, samples[:, : run.tick], run.fault, steps, at_ticks)
