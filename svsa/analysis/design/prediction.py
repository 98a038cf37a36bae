"""Predicted effect of gains and observer before they are applied: errors, noise, torque."""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np

from svsa.actuators.signals import CHANNELS, TORQUES, Disturbance
from svsa.analysis.design.loop_noise import LoopNoise, choose_sensing, compute_loop_noise
from svsa.analysis.design.steady_error import (
    LONGEST_S,
    SteadyError,
    compute_fl_steady_error,
    find_steady_error,
)
from svsa.control.installed import get_law, get_title, has_own_parameters
from svsa.runs.definition.command import Set
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run
from svsa.simulation.plant.effects import Effects
from svsa.simulation.plant.loads.paper import PAPER_TORQUE_NM, PaperLoad
from svsa.simulation.reference.kinds.constant import ConstantPosition

LOAD = Disturbance(PAPER_TORQUE_NM, PAPER_TORQUE_NM, PAPER_TORQUE_NM)
BEFORE_S = 1.5
AROUND_S = 1.5
LONGEST_AT_LIMIT_S = 0.1
MAX_NOISE_SHARE = 0.05
MAX_STEADY_ERROR_RAD = math.radians(20.0)

Verdict = Literal["ok", "warn", "refuse"]
Kind = Literal["note", "warn", "refuse"]
_KINDS: tuple[Kind, ...] = ("refuse", "warn", "note")


@dataclass(frozen=True)
class Reason:
    """One finding about the design.

    Attributes:
        kind: Severity.
        code: Identifier for programs.
        message: Text for users.
    """

    kind: Kind
    code: str
    message: str


@dataclass(frozen=True)
class TorqueDemand:
    """The motor torques that the load demands in the current configuration.

    Attributes:
        peak1_nm: Peak |u1| without a limit, N·m.
        peak2_nm: Peak |u2| without a limit, N·m.
        limited_s: Time during which a torque is at its limit in the limited run, s.
        fault: Fault at the end of that run, or "".
    """

    peak1_nm: float
    peak2_nm: float
    limited_s: float
    fault: str


@dataclass(frozen=True)
class Prediction:
    """The prediction for a design.

    Attributes:
        steady: Steady-state errors of the configuration's law; None if it does not come to rest.
        adds_estimate: Whether the law adds an estimate to the run's gains.
        fl: Steady-state errors with the gains alone, if `adds_estimate`; None without an
            equilibrium.
        noise: Noise of the loop; infinite if unstable.
        demand: Torque demand of the load.
        reasons: Findings.
    """

    steady: SteadyError | None
    adds_estimate: bool
    fl: SteadyError | None
    noise: LoopNoise
    demand: TorqueDemand
    reasons: tuple[Reason, ...]

    @property
    def verdict(self) -> Verdict:
        """The most severe kind among the reasons; notes count as ok."""
        kinds = {reason.kind for reason in self.reasons}
        return "refuse" if "refuse" in kinds else "warn" if "warn" in kinds else "ok"


def predict(configuration: Configuration, sigma: float) -> Prediction:
    """Predict the behaviour of the configuration's law at one stiffness.

    The load is the paper's, 2 N·m on link and motors. Noise is that of the encoders that the
    configuration has, or else of the paper's rig.

    Args:
        configuration: The run; its first lane, plant, nominal model and effects are used.
        sigma: Stiffness σ, N·m/rad.

    Returns:
        Steady-state error under load, noise of the loop, torque demand, and reasons why the design
        fails.
    """
    steady = find_steady_error(configuration, sigma, LOAD)
    law = configuration.law
    adds_estimate = not has_own_parameters(law) and get_law(law).estimate != "none"
    fl = compute_fl_steady_error(configuration, sigma, LOAD) if adds_estimate else None
    own = configuration.effects
    sensing = configuration.changed(effects=choose_sensing(own))
    noise = compute_loop_noise(sensing, sigma)
    demand = measure_demand(configuration)
    reasons = (
        *_judge_steady(configuration, steady, demand),
        *_judge_noise(configuration, noise),
        *_judge_demand(configuration, demand),
    )
    gravest_first = sorted(reasons, key=lambda reason: _KINDS.index(reason.kind))
    return Prediction(steady, adds_estimate, fl, noise, demand, tuple(gravest_first))


def measure_demand(configuration: Configuration) -> TorqueDemand:
    """Simulate the configuration for 1.5 s around the load, with and without torque limits.

    The run starts from rest and blends into the motion first, so that no jump at t = 0 counts.
    """
    limits = configuration.limits
    free, _ = _simulate_load(configuration, configuration.effects.changed(torque_limits=False))
    limited, fault = _simulate_load(configuration, configuration.effects)
    at_limit = np.any(limited >= (1.0 - 1e-9) * np.array([limits.torque1_nm, limits.torque2_nm]), 1)
    peak1, peak2 = np.max(free, axis=0, initial=0.0)
    return TorqueDemand(
        peak1_nm=float(peak1),
        peak2_nm=float(peak2),
        limited_s=float(np.count_nonzero(at_limit) * configuration.sampling.period_s),
        fault=fault,
    )


def _simulate_load(configuration: Configuration, effects: Effects) -> tuple[np.ndarray, str]:
    """Simulate |u1|, |u2| from just before the load, (ticks, 2), and the fault, or ""."""
    run = Run(
        configuration.changed(
            position=ConstantPosition(), comparisons=(), loads=(), effects=effects
        )
    )
    run.change(Set("position", configuration.position))
    period = run.period_s
    fade = configuration.position.transition_s
    rows = [_advance(run, fade + BEFORE_S)[-round(0.5 * AROUND_S / period) :]]
    if run.fault is None:
        run.add_load(PaperLoad())
        rows.append(_advance(run, 0.5 * AROUND_S))
    fault = run.fault.message if run.fault is not None else ""
    return np.abs(np.vstack(rows)[:, TORQUES]), fault


def _advance(run: Run, seconds: float) -> np.ndarray:
    samples = np.empty((1, max(1, round(seconds / run.period_s)), len(CHANNELS)))
    return samples[0, : run.advance(samples)]


def _judge_steady(
    configuration: Configuration, steady: SteadyError | None, demand: TorqueDemand
) -> list[Reason]:
    law = get_title(configuration.law)
    if steady is None and demand.fault:
        return []
    if steady is None:
        message = (
            f"With {law} the actuator does not come to rest under the load: the stiffness error"
            " or the deflection leaves the domain of the model, or there is still motion after"
            f" {LONGEST_S:g} s."
            " Choose faster poles."
        )
        return [Reason("warn", "no_rest", message)]
    if abs(steady.position) > MAX_STEADY_ERROR_RAD:
        message = (
            f"Under the load {law} has a steady-state error of"
            f" {abs(math.degrees(steady.position)):.0f}°. Choose faster poles."
        )
        return [Reason("warn", "large_error", message)]
    return []


def _judge_noise(configuration: Configuration, noise: LoopNoise) -> list[Reason]:
    is_own = configuration.effects.encoders is not None
    where = "" if is_own else "On the paper's rig, with its encoders and delay, "
    rate = 1.0 / configuration.sampling.period_s
    if noise.radius >= 1.0:
        message = (
            f"{where}the loop at {rate:g} Hz is unstable: its largest pole is |z| ="
            f" {noise.radius:.4f}, which must be below 1. Choose slower poles or a slower observer."
        )
        return [Reason("refuse" if is_own else "warn", "unstable_loop", _sentence(message))]
    limits = configuration.limits
    pairs = (("u1", noise.u1, limits.torque1_nm), ("u2", noise.u2, limits.torque2_nm))
    return [
        Reason(
            "warn",
            "noise",
            _sentence(
                f"{where}the encoder counts alone cause {rms:.2g} N·m rms of noise in {name},"
                f" {100.0 * rms / most:.0f} % of its limit: the motors chatter and heat up. Choose"
                " slower poles or a slower observer."
            ),
        )
        for name, rms, most in pairs
        if rms > MAX_NOISE_SHARE * most
    ]


def _judge_demand(configuration: Configuration, demand: TorqueDemand) -> list[Reason]:
    if demand.fault:
        message = f"Under the 3 kg load, the run ends in a fault. {demand.fault}"
        return [Reason("refuse", "fault", message)]
    if demand.limited_s == 0.0:
        return []
    limits = configuration.limits
    asked = " and ".join(
        f"{name} {peak:.3g} of {most:g} N·m"
        for name, peak, most in (
            ("u1", demand.peak1_nm, limits.torque1_nm),
            ("u2", demand.peak2_nm, limits.torque2_nm),
        )
        if peak > most
    )
    lasts = f"for {1000.0 * demand.limited_s:.0f} ms"
    if demand.limited_s > LONGEST_AT_LIMIT_S:
        message = (
            f"The load saturates a motor {lasts} ({asked}), during which the loop is open. Choose"
            " slower poles."
        )
        return [Reason("warn", "saturation", message)]
    message = (
        f"The load brings a motor to its limit {lasts} ({asked}), for a harmlessly short time."
    )
    return [Reason("note", "saturation", message)]


def _sentence(message: str) -> str:
    return message[0].upper() + message[1:]
