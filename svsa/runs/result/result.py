"""The result of a run: samples by name, metrics, tables and figures."""

import base64
import html
import io
import math
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from svsa.actuators.signals import CHANNELS
from svsa.errors import Fault, ParameterError, Violation
from svsa.inputs.checked import check_number
from svsa.inputs.extras import list_missing, require_extra
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.metrics.metrics import Metrics, compute_metrics
from svsa.runs.records.header import PlantKind
from svsa.runs.result.channels import Channels
from svsa.runs.result.law_style import name_law
from svsa.runs.timeline.events import find_law

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure as Picture

PICTURE_DPI = 80


@dataclass(frozen=True, repr=False)
class Result(Channels):
    """One lane of a finished run.

    A channel is also an attribute: `result.position_error_rad`.

    Attributes:
        configuration: Configuration at tick 0.
        samples: Shape (ticks, channels), float64, SI, columns as `svsa.actuators.signals.CHANNELS`.
        fault: Fault that ended the run early, or None.
        comparisons: Results of the controllers in lanes 2 to 4.
        law: Law at the beginning, "own" for a user's function.
        commands: Changes of this lane during the run.
        name: Name of a recorded run.
        plant: Plant of the first lane.
        steps: Runge–Kutta steps per control period.
        joint: Joint of an arm, 1 or 2; None for a single joint.
    """

    configuration: Configuration
    samples: np.ndarray = field(repr=False)
    fault: Fault | None = None
    comparisons: "tuple[Result, ...]" = field(default=(), repr=False)
    law: str = "ndobc"
    commands: tuple[Command, ...] = ()
    name: str = ""
    plant: PlantKind = "simulated"
    steps: int = 1
    joint: int | None = None

    @property
    def units(self) -> dict[str, str]:
        """Unit of every channel."""
        return {channel.name: channel.unit for channel in CHANNELS}

    @property
    def metrics(self) -> Metrics:
        """The metrics of the whole run, for all laws that were in control; see `measure`.

        Raises:
            StateError: If there are no samples.
        """
        return compute_metrics(self.samples, self.configuration.sampling.period_s)

    def measure(self, start_s: float, end_s: float) -> Metrics:
        """Compute the metrics between two times of the run.

        Args:
            start_s: First time of the window, s.
            end_s: Last time of the window, s.

        Returns:
            The metrics of both outputs and of the control effort.

        Raises:
            ParameterError: If the window contains no sample.
        """
        period = self.configuration.sampling.period_s
        first = round(float(self.time_s[0]) / period) if len(self.samples) else 0
        begin, end = first * period, (first + len(self.samples)) * period
        check_number("start_s", start_s, "s", begin, end)
        check_number("end_s", end_s, "s", start_s, end)
        rows = self.samples[round(start_s / period) - first : round(end_s / period) - first]
        if not len(rows):
            bound = f"an interval with samples between {begin:g} and {end:g} s"
            raise ParameterError(Violation("(start_s, end_s)", (start_s, end_s), "s", bound))
        return compute_metrics(rows, period)

    def list_segments(self) -> list[tuple[str, slice]]:
        """List the laws that were in control, in the order of time.

        Returns:
            The name of each law, and its rows of the samples.
        """
        period, rows = self.configuration.sampling.period_s, len(self.samples)
        first = round(float(self.time_s[0]) / period) if rows else 0
        begins = [(0, self.law)]
        for command in self.commands:
            law, row = find_law(command), command.tick - first
            if law is not None and 0 < row < rows and law != begins[-1][1]:
                begins.append((row, law))
        ends = [begin for begin, _ in begins[1:]] + [rows]
        return [(law, slice(at, end)) for (at, law), end in zip(begins, ends, strict=True)]

    def to_dataframe(self) -> "pandas.DataFrame":
        """Build a pandas DataFrame of all channels; needs the extra `pandas`.

        Returns:
            One row for each tick, one column for each channel; `attrs` has the units.

        Raises:
            MissingExtraError: If pandas is not installed.
        """
        from svsa.runs.result.tables import build_dataframe

        return build_dataframe(self.samples, self._build_attributes())

    def to_xarray(self) -> "xarray.Dataset":
        """Build an xarray Dataset of all channels; needs the extra `xarray`.

        Returns:
            The channels along `time_s`, each with its unit.

        Raises:
            MissingExtraError: If xarray is not installed.
        """
        from svsa.runs.result.tables import build_dataset

        return build_dataset(self.samples, self._build_attributes())

    def to_csv(self, path: Path | str) -> None:
        """Write all channels as CSV. The first row names each channel with its unit.

        Args:
            path: The file to write.
        """
        names = ",".join(f"{channel.name} [{channel.unit}]" for channel in CHANNELS)
        np.savetxt(path, self.samples, fmt="%.9g", delimiter=",", header=names, comments="")

    def plot(self) -> "Picture":
        """Plot position, its error, stiffness, torques and disturbances; needs the extra `plot`.

        Returns:
            A matplotlib figure.

        Raises:
            MissingExtraError: If matplotlib is not installed.
        """
        require_extra("plot")
        from svsa.runs.result.plot import plot_run

        period = self.configuration.sampling.period_s
        changes_s = {command.tick * period for command in self.commands}
        return plot_run(self, self.list_segments(), changes_s)

    def __repr__(self) -> str:
        return "\n".join(self._describe())

    def _repr_html_(self) -> str:
        lines = "<br>".join(html.escape(line) for line in self._describe())
        if self._picture is None:
            return f"<p>{lines}</p>"
        picture = base64.b64encode(self._picture).decode()
        return f'<p>{lines}</p><img alt="The run" src="data:image/png;base64,{picture}">'

    def _repr_png_(self) -> bytes | None:
        return self._picture

    @cached_property
    def _picture(self) -> bytes | None:
        """Draw the figure for notebooks; None without samples or without matplotlib."""
        stream = io.BytesIO()
        if not len(self.samples) or list_missing("plot"):
            return None
        self.plot().savefig(stream, format="png", dpi=PICTURE_DPI)
        return stream.getvalue()

    def _build_attributes(self) -> dict[str, str]:
        """Describe the run as attributes that every file format can hold."""
        attributes = {"law": self.law, "configuration": self.configuration.model_dump_json()}
        if self.name:
            attributes["name"] = self.name
        if self.fault is not None:
            attributes["fault"] = self.fault.message
        return attributes

    def _describe(self) -> tuple[str, str]:
        """Describe the run in two lines: setup and outcome."""
        period = self.configuration.sampling.period_s
        comparison = (
            f" compared with {', '.join(name_law(r.law) for r in self.comparisons)}"
            if self.comparisons
            else ""
        )
        stretches = self.list_segments()
        laws = " → ".join(name_law(law) for law, _ in stretches)
        called = f"{self.name}: " if self.name else ""
        first = (
            f"{called}{laws}{comparison}, {len(self.samples) * period:g} s at"
            f" {1.0 / period:g} Hz ({len(self.samples)} samples of {len(CHANNELS)} channels)"
        )
        if not len(self.samples):
            second = "no samples"
        else:
            law, rows = stretches[-1]
            m = compute_metrics(self.samples[rows], period)
            since = f"{name_law(law)} since {self.time_s[rows.start]:g} s: " if rows.start else ""
            second = (
                f"{since}position error {math.degrees(m.rms_position_error_rad):.4g}° rms,"
                f" {math.degrees(m.peak_position_error_rad):.4g}° peak; stiffness error"
                f" {m.rms_stiffness_error_nm_per_rad:.4g} N·m/rad rms; |u| up to"
                f" {m.peak_torque1_nm:.4g} and {m.peak_torque2_nm:.4g} N·m"
            )
        ended = f"; ended early: {self.fault.message}" if self.fault is not None else ""
        return first, second + ended


def build_results(
    configuration: Configuration,
    samples: np.ndarray,
    laws: Iterable[str],
    fault: Fault | None = None,
    commands: tuple[Command, ...] = (),
    name: str = "",
    plant: PlantKind = "simulated",
    steps: int = 1,
) -> Result:
    """Build the first lane's result with those of its comparisons; samples (lanes, ticks,
    channels).
    """
    of_all = tuple(command for command in commands if command.kind != "law")
    (rows, law), *others = zip(samples, laws, strict=True)
    comparisons = tuple(Result(configuration, r, fault, (), of, of_all, name) for r, of in others)
    return Result(configuration, rows, fault, comparisons, law, commands, name, plant, steps)
