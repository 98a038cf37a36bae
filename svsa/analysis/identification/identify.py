"""Identification of the parameters of Table 1 and of friction from a recorded run."""

from typing import Any, NamedTuple

import numpy as np

from svsa.actuators.parameters import ActuatorParameters
from svsa.analysis.identification.fit import Progress, fit
from svsa.analysis.identification.initial_guess import guess_noise, guess_states
from svsa.analysis.identification.kernel import Parameters
from svsa.analysis.identification.record import Evidence, IdentificationError, read_evidence
from svsa.runs.definition.configuration import Configuration
from svsa.runs.definition.design import Design
from svsa.runs.records.reader import Record

CONFIDENCE = 0.95
LARGEST_INTERVAL = 0.5
MIN_SPEED_RAD_PER_S = 0.2
LARGEST_MISFIT = 100.0
_MIN_NOISE_RAD = 1e-6


class Estimate(NamedTuple):
    """A value and its 95 % confidence interval, in `unit`."""

    symbol: str
    unit: str
    value: float
    low: float
    high: float

    @property
    def relative_width(self) -> float:
        """Half width of the interval relative to the value; infinite for a value of 0."""
        half = 0.5 * (self.high - self.low)
        return half / abs(self.value) if self.value else float("inf")


_FOUND = {
    "link_inertia_kg_m2": ("M", "M", "kg·m²"),
    "motor1_inertia_kg_m2": ("B1", "B1", "kg·m²"),
    "motor2_inertia_kg_m2": ("B2", "B2", "kg·m²"),
    "link_damping_nms_per_rad": ("D", "D", "N·m·s/rad"),
    "motor1_damping_nms_per_rad": ("D1", "D1", "N·m·s/rad"),
    "motor2_damping_nms_per_rad": ("D2", "D2", "N·m·s/rad"),
    "spring_stiffness_n_per_m": ("K", "K_s", "N/m"),
    "coulomb1_nm": ("coulomb1", "τ_c1", "N·m"),
    "coulomb2_nm": ("coulomb2", "τ_c2", "N·m"),
    "static_ratio": ("static_ratio", "τ_s/τ_c", "1"),
    "stribeck_rad_per_s": ("stribeck", "v_s", "rad/s"),
    "link_gravity_moment_nm": ("gravity_moment", "m g r", "N·m"),
    "torque1_delay_s": ("delay1", "delay of u1", "s"),
    "torque2_delay_s": ("delay2", "delay of u2", "s"),
}
ACTUATOR = tuple(name for name in _FOUND if name in ActuatorParameters.model_fields)


class Identification(NamedTuple):
    """The result of an identification.

    Attributes:
        run_id: Id of the run.
        configuration: Configuration of the run.
        estimates: By name: those of `ACTUATOR` (Table 1), then friction, gravity moment of the link
            and delay of the recorded torque, which are estimated as well.
        residual_rad: rms residuals of θ1, θ2 and φ, rad.
        used_s: Length of the record that was used, s.
        loaded_s: Length excluded because of a load, s.
        dropped_s: Length excluded because the model explains it far worse than the rest, s.
        misfit: Residual divided by the sensor noise; about 1 if the model is right.
        undetermined: Parameters of Table 1 that the run did not excite enough.
    """

    run_id: str
    configuration: Configuration
    estimates: dict[str, Estimate]
    residual_rad: tuple[float, float, float]
    used_s: float
    loaded_s: float
    dropped_s: float
    misfit: float
    undetermined: tuple[str, ...]

    def build_design(self) -> Design:
        """Build the run's design with the identified values as actuator and as nominal model.

        Raises:
            IdentificationError: If the run does not determine a value.
        """
        if self.undetermined:
            symbols = ", ".join(self.estimates[name].symbol for name in self.undetermined)
            raise IdentificationError(
                f"Run {self.run_id} does not determine {symbols}: play the identification"
                " excitation, slow and fast, soft and stiff."
            )
        parameters = {name: self.estimates[name].value for name in ACTUATOR}
        actuator = self.configuration.actuator.changed(**parameters)
        run = self.configuration
        return Design(
            actuator=actuator,
            nominal=actuator,
            gains=run.gains,
            parameters=run.list_parameters(),
            observer=run.observer,
            limits=run.limits,
            sampling=run.sampling,
        )

    def to_json(self) -> dict[str, Any]:
        """Convert to a dict for JSON."""
        estimates = {name: estimate._asdict() for name, estimate in self.estimates.items()}
        plain = self._asdict() | {"estimates": estimates}
        del plain["configuration"]
        return plain


def identify(record: Record, progress: Progress = lambda _: None) -> Identification:
    """Identify the actuator from the first lane of a record; see `identify_evidence`."""
    return identify_evidence(read_evidence(record), record.header.run_id, progress)


def identify_evidence(
    evidence: Evidence, run_id: str, progress: Progress = lambda _: None
) -> Identification:
    """Identify the actuator by output error.

    Radius, γ, μ0 and the scale of the torques are assumed to be known. Inertias, dampings, spring
    and friction are proportional to that scale.

    Args:
        evidence: Measured angles and torques.
        run_id: The run, or the file of the measurement, for messages.
        progress: Called with the finished share.

    Raises:
        IdentificationError: If the run cannot be used.
    """
    solution = fit(evidence, progress)
    noise = np.maximum(guess_noise(evidence), _MIN_NOISE_RAD)
    misfit = float(np.max(solution.residual / noise))
    if misfit > LARGEST_MISFIT:
        raise IdentificationError(
            f"The model leaves {misfit:.0f} times the noise of the sensors unexplained in run"
            f" {run_id}: was there a load, a contact or a wrong geometry?"
        )
    from scipy.stats import t as student  # imported here: the import is slow

    factor = float(
        student.ppf(0.5 + 0.5 * CONFIDENCE, max(solution.used - len(solution.values), 1))
    )
    values = dict(zip(Parameters._fields, solution.values.tolist(), strict=True))
    deviations = dict(zip(Parameters._fields, solution.deviations.tolist(), strict=True))
    square = evidence.configuration.actuator.radius_m**2
    estimates = {}
    for name, (key, symbol, unit) in _FOUND.items():
        share = 1.0 / square if key == "K" else 1.0
        value, half = share * values[key], share * factor * deviations[key]
        estimates[name] = Estimate(symbol, unit, value, value - half, value + half)
    wide = {n for n in ACTUATOR if estimates[n].relative_width > LARGEST_INTERVAL}
    still = _find_unmoved(evidence)
    piece = evidence.length * evidence.setting.period
    theta1, theta2, phi = solution.residual.tolist()
    return Identification(
        run_id=run_id,
        configuration=evidence.configuration,
        estimates=estimates,
        residual_rad=(theta1, theta2, phi),
        used_s=solution.used * piece,
        loaded_s=evidence.loaded * evidence.setting.period,
        dropped_s=solution.dropped * piece,
        misfit=misfit,
        undetermined=tuple(name for name in ACTUATOR if name in wide | still),
    )


def _find_unmoved(evidence: Evidence) -> set[str]:
    """Find inertia and damping of bodies that hardly moved: friction dominates them."""
    speeds = np.sqrt(np.mean(guess_states(evidence)[:, 1::2] ** 2, axis=0))
    parts = ("link", "motor1", "motor2")
    return {
        name
        for part, speed in zip(parts, speeds, strict=True)
        for name in (f"{part}_inertia_kg_m2", f"{part}_damping_nms_per_rad")
        if speed < MIN_SPEED_RAD_PER_S
    }
