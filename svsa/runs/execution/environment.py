"""The actuator as an environment of Gymnasium (extra `gym`)."""

# ruff: noqa: E402
from pathlib import Path
from typing import Any, Unpack

from svsa.inputs.extras import require_extra

require_extra("gym")

import gymnasium
import numpy as np

from svsa.errors import ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.definition.experiment import build_experiment
from svsa.runs.definition.paper import DURATION_S
from svsa.runs.definition.shorthand import Settings
from svsa.runs.execution.stepper import MAX_STEP_TICKS, Observation, Stepper

POSITION_SCALE_RAD = np.radians(1.0)
STIFFNESS_SCALE_NM_PER_RAD = 1.0
_SEED_END = 2**63


class ActuatorEnv(gymnasium.Env[np.ndarray, np.ndarray]):
    """Tracking of q_d and σ_d by motor torques, on the plant of `svsa.simulate`.

        env = svsa.ActuatorEnv("4a", effects=svsa.RIG, duration_s=10.0)
        observation, info = env.reset(seed=1)
        observation, reward, terminated, truncated, info = env.step(env.action_space.sample())

    Action, shape (2,): u1 and u2 divided by the motors' torque limits, −1 to 1.
    Observation, shape (14,): x̂ (q, q̇, θ1, θ̇1, θ2, θ̇2), q_d to its fourth derivative, σ_d to its
    second, in SI units.
    Reward: 1 / (1 + (e / 1°)² + (e_σ / 1 N·m/rad)²), with e = q_d − q and e_σ = σ_d − σ after the
    step. It is positive, so that ending an episode early is never better.

    An episode is terminated by a fault, and truncated at `duration_s`. `info` has `time_s`,
    `position_error_rad`, `stiffness_error_nm_per_rad`, and after a fault `fault`, its message.

    Attributes:
        stepper: The run, a `Stepper`.
    """

    def __init__(
        self,
        experiment: str | Configuration = "4a",
        *,
        duration_s: float = DURATION_S,
        action_period_s: float = 0.01,
        parameters: Design | Path | str | None = None,
        **changes: Unpack[Settings],
    ) -> None:
        """Build the environment.

        Args:
            experiment: A figure of the paper ("4a", "4b", "5") or a `Configuration`.
            duration_s: Duration of an episode, s.
            action_period_s: Duration of an action, s: an integer number of control periods.
            parameters: A parameter file or its `Design`, instead of the experiment's own.
            **changes: Fields of the configuration, as for `svsa.simulate`.

        Raises:
            ParameterError: If a value is out of range.
        """
        self.stepper = Stepper(build_experiment(experiment, parameters, changes, ActuatorEnv))
        period = self.stepper.period_s
        check_number("action_period_s", action_period_s, "s", period, MAX_STEP_TICKS * period)
        check_number("duration_s", duration_s, "s", action_period_s, MAX_STEP_TICKS * period)
        self._ticks = round(action_period_s / period)
        self._end_tick = round(duration_s / period)
        self.action_space = gymnasium.spaces.Box(-1.0, 1.0, (2,), np.float32)
        size = len(_flatten(self.stepper.reset()))
        self.observation_space = gymnasium.spaces.Box(-np.inf, np.inf, (size,), np.float64)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[np.ndarray, dict[str, Any]]:
        """Start an episode from rest.

        Args:
            seed: Seed of the environment's random numbers, from which each episode takes the seed
                of its sensor noise.
            options: Fields of the configuration to change from now on, such as loads.

        Returns:
            Observation and info.

        Raises:
            ParameterError: If an option is out of range.
        """
        super().reset(seed=seed)
        noise = int(self.np_random.integers(_SEED_END))
        changes: Any = {"seed": noise, **(options or {})}
        seen = self.stepper.reset(**changes)
        return _flatten(seen), self._describe(seen)

    def step(self, action: np.ndarray) -> tuple[np.ndarray, float, bool, bool, dict[str, Any]]:
        """Apply an action for `action_period_s`.

        Args:
            action: Torques divided by the torque limits, shape (2,), −1 to 1.

        Returns:
            Observation, reward, terminated, truncated, info.

        Raises:
            ParameterError: If the action is not in the action space.
            FaultError: If the episode was terminated: call `reset`.
        """
        shares = np.asarray(action, np.float32)
        if not self.action_space.contains(shares):
            bound = "two numbers from −1 to 1, shares of the torque limits"
            raise ParameterError(Violation("action", action, "", bound))
        limits = self.stepper.torque_limits_nm
        torque = float(shares[0]) * limits.u1, float(shares[1]) * limits.u2
        seen = self.stepper.step(torque, self._ticks)
        info = self._describe(seen)
        e = info["position_error_rad"] / POSITION_SCALE_RAD
        e_sigma = info["stiffness_error_nm_per_rad"] / STIFFNESS_SCALE_NM_PER_RAD
        reward = 1.0 / (1.0 + e * e + e_sigma * e_sigma)
        terminated = self.stepper.fault is not None
        truncated = round(seen.time_s / self.stepper.period_s) >= self._end_tick
        return _flatten(seen), float(reward), terminated, truncated, info

    def _describe(self, seen: Observation) -> dict[str, Any]:
        position, stiffness = self.stepper.compute_errors()
        info: dict[str, Any] = {
            "time_s": seen.time_s,
            "position_error_rad": position,
            "stiffness_error_nm_per_rad": stiffness,
        }
        fault = self.stepper.fault
        return info if fault is None else info | {"fault": fault.message}


def _flatten(seen: Observation) -> np.ndarray:
    return np.array([*seen.x, *seen.reference])
