"""A whole run at once, as fast as it goes, and what came of it."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from svsa.checked import check_number
from svsa.errors import Fault, ParameterError, Violation
from svsa.experiment.paper import DURATION_S, get_figure
from svsa.extras import require_extra
from svsa.runtime.configuration import Configuration, Law
from svsa.runtime.metrics import Metrics, compute_metrics
from svsa.runtime.run import Run
from svsa.runtime.stepwise import Controller
from svsa.signals import CHANNEL_INDEX, CHANNEL_NAMES, CHANNELS

if TYPE_CHECKING:
    import pandas
    from matplotlib.figure import Figure as Picture

MOST_TICKS = 5_000_000
MOST_STEPS = 1000


@dataclass(frozen=True)
class Result:
    """A finished run, one lane of it.

    samples: (ticks, channels), float64, SI, columns as `svsa.signals.CHANNELS`. A channel is
    also an attribute: `result.position_error_rad`. fault: why the run ended early, or None.
    rivals: the results of the controllers that ran beside this one. law: what controlled,
    "own" for a function of one's own.
    """

    configuration: Configuration
    samples: np.ndarray = field(repr=False)
    fault: Fault | None = None
    rivals: "tuple[Result, ...]" = field(default=(), repr=False)
    law: str = "ndobc"

    @property
    def units(self) -> dict[str, str]:
        """The unit of every channel."""
        return {channel.name: channel.unit for channel in CHANNELS}

    @property
    def metrics(self) -> Metrics:
        """The metrics of the whole run."""
        return compute_metrics(self.samples, self.configuration.sampling.period_s)

    def __getattr__(self, name: str) -> np.ndarray:
        if name not in CHANNEL_INDEX:
            raise AttributeError(f"no channel {name!r}; there are {', '.join(CHANNEL_NAMES)}")
        return self.samples[:, CHANNEL_INDEX[name]]

    def measure(self, start_s: float, end_s: float) -> Metrics:
        """The metrics between two times of the run, s; raises `ParameterError` if empty."""
        period = self.configuration.sampling.period_s
        end = len(self.samples) * period
        check_number("start_s", start_s, "s", 0.0, end)
        check_number("end_s", end_s, "s", start_s, end)
        rows = self.samples[round(start_s / period) : round(end_s / period)]
        if not len(rows):
            bound = f"a stretch with samples between 0 and {end:g} s"
            raise ParameterError(Violation("(start_s, end_s)", (start_s, end_s), "s", bound))
        return compute_metrics(rows, period)

    def to_dataframe(self) -> "pandas.DataFrame":
        """All channels as a pandas DataFrame, one row a tick."""
        import pandas

        return pandas.DataFrame(self.samples, columns=list(CHANNEL_NAMES))

    def to_csv(self, path: Path | str) -> None:
        """Write all channels as CSV; the first row names each with its unit."""
        names = ",".join(f"{channel.name} [{channel.unit}]" for channel in CHANNELS)
        np.savetxt(path, self.samples, fmt="%.9g", delimiter=",", header=names, comments="")

    def plot(self) -> "Picture":
        """Position, its error, stiffness, torques and disturbances as a matplotlib figure."""
        require_extra("plot")
        from svsa.experiment.figures import plot_run

        return plot_run(self)


def simulate(
    experiment: str | Configuration = "4a",
    law: Law | Controller | None = None,
    *,
    duration_s: float = DURATION_S,
    steps: int = 1,
    **changes: Any,
) -> Result:
    """Simulate a run from rest and return everything that happened.

    experiment: a figure of the paper ("4a", "4b", "5") or a `Configuration`. law:
    "ndobc", "fl", or a function (`Controller`): time in s, `Reference`, x̂ as `State`, ŵ as
    `Disturbance` → (u1, u2) in N·m. duration_s: s. steps: Runge–Kutta steps a control
    period. changes: fields of the configuration to replace, e.g. position, stiffness,
    loads, gains, observer, limits, actuator, nominal, rivals, effects, seed.

    Raises `ParameterError` for a value out of range. A run that leaves the domain of the
    model ends early: see `Result.fault`.
    """
    if isinstance(experiment, Configuration):
        configuration = experiment
    else:
        configuration = get_figure(experiment).build_configuration()
    own = law if callable(law) else None
    if law is not None and own is None:
        changes["law"] = law
    if changes:
        configuration = configuration.changed(**changes)
    period = configuration.sampling.period_s
    check_number("duration_s", duration_s, "s", period, MOST_TICKS * period)
    check_number("steps", steps, "", 1, MOST_STEPS)
    if not isinstance(steps, int):
        raise ParameterError(Violation("steps", steps, "", "a whole number"))
    run = Run(configuration, steps, own)
    samples = np.empty((len(run.lanes), round(duration_s / period), len(CHANNELS)))
    done = run.advance(samples)
    laws = ["own" if own else configuration.law, *(lane.law for lane in configuration.rivals)]
    first, *rivals = (
        Result(configuration, rows[:done], run.fault, law=law)
        for rows, law in zip(samples, laws, strict=True)
    )
    return replace(first, rivals=tuple(rivals))
