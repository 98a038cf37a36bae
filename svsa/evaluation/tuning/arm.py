"""Trials of an arm, and their cost for the tuning: one search for every controller of an arm.

A trial is a trial of `svsa.evaluation.trials` of one family in each joint (motions,
stiffnesses, errors of the motors, rig effects with noise), with links that are up to 20 % lighter
or heavier than their model, and a load at the tip: a mass, or a force, pulse or impulse in any
direction. Cost and success are those of a single joint, with each joint as a run. The noise limit
is that of a single joint for the mean of all joints.
"""

import math
from collections.abc import Sequence
from functools import cache, partial
from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.arm.parameters import ArmParameters
from svsa.control.arm_payload import PayloadAdaptation
from svsa.control.installed import get_title
from svsa.evaluation.metrics import compute_metrics, summarize_result
from svsa.evaluation.scenario import Scenario
from svsa.evaluation.trials import (
    DURATION_S,
    FAMILIES,
    LOAD_S,
    REST_BEGIN_S,
    build_rest,
    build_trial,
    derive_key,
    get_mean_stiffness,
    start_generator,
)
from svsa.evaluation.tuning.judge import (
    Judgment,
    find_noise_limit,
    judge_summaries,
    judge_variation,
)
from svsa.evaluation.tuning.tuner import Problem
from svsa.runs.definition.arm_experiment import ARMS, build_arm_experiment
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.result.simulate_arm import simulate_arm
from svsa.simulation.plant.loads import Load
from svsa.simulation.plant.loads.tip import TipForce, TipImpulse, TipMass

ARM = "rods"
"""The arm of the published ranking."""
LINK_ERROR = 0.2
RESTS = (0, 2, 3)
"""Of `build_rest`: σ = 12, 35 and 60 N·m/rad with one sample of delay."""


class ArmController(NamedTuple):
    """A law in all joints of an arm.

    Attributes:
        law: Name of the law.
        feedforward: Whether it receives the arm feedforward.
        adaptive: Whether the payload is estimated; with feedforward.
    """

    law: str
    feedforward: bool = False
    adaptive: bool = False

    @property
    def key(self) -> str:
        """Name of its row: the law, "+ff" or "+adaptive"."""
        return self.law + ("+adaptive" if self.adaptive else "+ff" if self.feedforward else "")

    @property
    def title(self) -> str:
        """The law's title with its options."""
        option = ", adaptive payload" if self.adaptive else ", feedforward"
        return get_title(self.law) + (option if self.feedforward else "")


class ArmTrial(NamedTuple):
    """A trial: configuration under the default law, and the mean σ_d of each joint, N·m/rad."""

    configuration: Configuration
    sigmas: tuple[float, ...]

    def run(
        self, controller: ArmController, design: Design, duration_s: float, begin_s: float
    ) -> np.ndarray:
        """Simulate it: the `SUMMARY` of each joint, (joints,), measured from `begin_s` on."""
        changes = {name: getattr(design, name) for name in ("gains", "observer", "parameters")}
        changes["law"] = controller.law
        configuration = self.configuration.change_joints([changes] * len(self.sigmas))
        arm = configuration.require_arm().changed(
            feedforward=controller.feedforward,
            adaptation=PayloadAdaptation() if controller.adaptive else None,
        )
        configuration = configuration.changed(arm=arm)
        result = simulate_arm(configuration, duration_s=duration_s)
        return np.concatenate(
            [summarize_result(joint, begin_s, duration_s) for joint in result.joints]
        )


def build_arm_trials(name: str, seed: int, count: int, arm: str = ARM) -> tuple[ArmTrial, ...]:
    """Build the trials of a set, of families A and B in turns, for a named arm."""
    return tuple(build_arm_trial(name, seed, number, arm) for number in range(count))


def build_arm_trial(name: str, seed: int, number: int, arm: str = ARM) -> ArmTrial:
    """Build one trial; it does not depend on the others of its set."""
    family, links = FAMILIES[number % 2], ARMS[arm].links
    numbers = range(1, len(links.chain) + 1)
    joints = [build_trial(family, f"{name} joint {joint}", seed, number) for joint in numbers]
    random = start_generator(derive_key(f"{name} arm", seed), number)
    return _build_trial(arm, joints, _draw_links(links, random), (_draw_tip_load(random),))


@cache
def build_arm_rest(arm: str = ARM) -> tuple[ArmTrial, ...]:
    """Build runs of the hanging arm at rest, to measure torque noise."""
    rest, links = build_rest(), ARMS[arm].links
    joints = len(links.chain)
    return tuple(_build_trial(arm, (rest[number],) * joints, links, ()) for number in RESTS)


def _build_trial(
    arm: str, joints: Sequence[Scenario], links: ArmParameters, loads: tuple[Load, ...]
) -> ArmTrial:
    base = build_arm_experiment(arm, {}, {})
    settings: list[dict[str, Any]] = []
    for joint, scenario in zip(base.joints, joints, strict=True):
        ratios = {name: ratio * getattr(joint.nominal, name) for name, ratio in scenario.plant}
        settings.append(
            {
                "position": scenario.position,
                "stiffness": scenario.stiffness,
                "effects": scenario.effects,
                "seed": scenario.seed,
                "actuator": joint.actuator.changed(**ratios),
            }
        )
    settings[0]["loads"] = loads
    base = base.change_joints(settings)
    setup = base.require_arm().changed(links=links)
    return ArmTrial(base.changed(arm=setup), tuple(map(get_mean_stiffness, joints)))


def _draw_links(known: ArmParameters, random: np.random.Generator) -> ArmParameters:
    links = known
    for number, link in enumerate(known.chain, start=1):
        ratio = float(random.uniform(1.0 - LINK_ERROR, 1.0 + LINK_ERROR))
        mass, inertia = ratio * link.mass_kg, ratio * link.inertia_kg_m2
        links = links.change_link(number, mass_kg=mass, inertia_kg_m2=inertia)
    return links


def _draw_tip_load(random: np.random.Generator) -> Load:
    angle, size = float(random.uniform(0.0, 2.0 * math.pi)), float(random.uniform(0.5, 2.0))
    direction = math.cos(angle), math.sin(angle)
    x, y = size * direction[0], size * direction[1]
    match int(random.integers(0, 4)):
        case 0:
            return TipMass(mass_kg=0.1 * size, start_s=LOAD_S)
        case 1:
            return TipForce(force_n=(x, y), start_s=LOAD_S)
        case 2:
            duration = float(random.uniform(0.05, 2.0))
            return TipForce(force_n=(x, y), duration_s=duration, start_s=LOAD_S)
        case _:
            return TipImpulse(impulse_ns=(0.1 * x, 0.1 * y), start_s=LOAD_S)


def run_arm_trials(
    trials: Sequence[ArmTrial], controller: ArmController, design: Design
) -> np.ndarray:
    """Run trials: the `SUMMARY` of the joints of each, (trials, joints)."""
    return np.stack([trial.run(controller, design, DURATION_S, LOAD_S) for trial in trials])


def measure_arm_variation(controller: ArmController, design: Design, arm: str = ARM) -> float:
    """Total variation of u1 at rest, mean over joints and `build_arm_rest`, N·m/s.

    Infinite where a run ends in a fault.
    """
    duration = 2.0 * REST_BEGIN_S
    summaries_by_trial = [
        trial.run(controller, design, duration, REST_BEGIN_S) for trial in build_arm_rest(arm)
    ]
    summaries = np.concatenate(summaries_by_trial)
    if np.any(summaries["code"]):
        return math.inf
    periods = np.full(len(summaries), design.sampling.period_s)
    variation = compute_metrics(summaries, periods, REST_BEGIN_S)["torque1_variation_nm_per_s"]
    return float(np.mean(variation))


def build_arm_problem(controller: ArmController, arm: str = ARM) -> Problem:
    """The tuning of a controller of a named arm."""

    def judge(trials: tuple[ArmTrial, ...], law: str, design: Design) -> Judgment:
        variation = measure_arm_variation(controller, design, arm)
        if loud := judge_variation(variation, find_noise_limit()):
            return loud
        summaries = run_arm_trials(trials, controller, design).ravel()
        sigmas = np.ravel([trial.sigmas for trial in trials])
        return judge_summaries(summaries, sigmas, design.sampling.period_s, variation)

    return Problem(partial(build_arm_trials, arm=arm), judge)
