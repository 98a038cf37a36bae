"""A run whose first lane is a bench; its twins are simulated."""

from typing import TYPE_CHECKING, Protocol

import numpy as np

from svsa.actuators.domain import INSIDE
from svsa.actuators.signals import CHANNEL_INDEX
from svsa.hardware.description.file import BenchFile
from svsa.hardware.drives.conversion import build_motor_scale
from svsa.hardware.realtime.configuration import read_actuation
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.run import Run, Start
from svsa.runs.records.bench_start import BenchStart
from svsa.runs.timeline.lane_origins import find_origins
from svsa.simulation.plant.load_table import ScheduledLoad

if TYPE_CHECKING:
    from svsa.errors import Fault

_MEASURED = [CHANNEL_INDEX["position_rad"], CHANNEL_INDEX["stiffness_nm_per_rad"]]
_RESIDUALS = [
    CHANNEL_INDEX["position_residual_rad"],
    CHANNEL_INDEX["stiffness_residual_nm_per_rad"],
]
TWIN = 1


class SampleSource(Protocol):
    """The source of a bench's samples, such as `LoopMemory`. number: of its current run."""

    @property
    def number(self) -> int:  # noqa: D102
        ...

    def count(self, number: int) -> int:
        """Return the number of samples of run `number`."""
        ...

    def read(self, first: int, rows: np.ndarray) -> None:
        """Copy the samples from tick `first` on into `rows` (ticks, channels)."""
        ...


class BenchRun(Run):
    """Lane 1 comes from the loop's memory; the other lanes follow it tick for tick.

    The first comparison is the bench's twin: the same law, commands and loads on the simulated
    plant. A twin that leaves the domain of the model ends, with NaN from then on; the bench
    continues. Ticks that the bench's loop missed have a time but no values in lane 1.

    Attributes:
        is_still: Whether it has no ticks, and none of the samples of the previous run.
        fault: Fault of the bench, set by the owner of its state.
    """

    is_bench = True

    def __init__(
        self,
        configuration: Configuration,
        start: Start,
        memory: SampleSource,
        is_still: bool = False,
    ) -> None:
        self._memory = memory
        self._number = None if is_still else memory.number
        self._ended: set[int] = set()
        self.fault: Fault | None = None
        super().__init__(configuration, start=start)

    def count_ready(self) -> int:
        """Return the number of samples of the bench to be read."""
        there = 0 if self._number is None else self._memory.count(self._number)
        return max(0, there - self.tick)

    def advance(self, samples: np.ndarray) -> int:
        """Read and simulate as many ticks as `samples` (lanes, ticks, channels) has.

        Returns the number done, at most that of the bench.
        """
        done = min(samples.shape[1], self.count_ready())
        self._memory.read(self.tick, samples[0, :done])
        # The rows of missed ticks are NaN, except for their time, which is known.
        samples[0, :done, 0] = (self.tick + np.arange(done)) * self.period_s
        for number in range(1, len(self.lanes)):
            self._advance_twin(number, samples[number, :done])
        if len(self.lanes) > TWIN:
            bench, twin = samples[0, :done], samples[TWIN, :done]
            bench[:, _RESIDUALS] = bench[:, _MEASURED] - twin[:, _MEASURED]
        self.tick += done
        return done

    def _advance_twin(self, number: int, rows: np.ndarray) -> None:
        ticks = 0
        if number not in self._ended:
            self.lanes[number], ticks, code = self._advance_lane(number, rows)
            if code != INSIDE:
                self._ended.add(number)
        rows[ticks:] = np.nan
        rows[ticks:, 0] = (self.tick + np.arange(ticks, len(rows))) * self.period_s

    def change(self, command: Command) -> ScheduledLoad | None:
        """Apply a command as `Run.change`; a new comparison starts from the twin's state."""
        if command.kind != "comparisons":
            return super().change(command)
        origins = find_origins(self.configuration.comparisons, command.argument)
        self.lanes[0] = self.lanes[min(TWIN, len(self.lanes) - 1)]
        super().change(command)
        self._ended = {lane for lane, origin in enumerate(origins) if origin in self._ended}
        return None


def describe_start(
    bench: BenchFile, mu0: float, motion: dict[str, list[float]], commands: int
) -> BenchStart:
    """Build the `BenchStart` of a run of this bench; the arguments are its fields."""
    actuation = read_actuation(bench)
    motors = bench.motor1, bench.motor2
    step1, step2 = (abs(build_motor_scale(motor).torque_per_ma) for motor in motors)
    return BenchStart(mu0, *actuation, (step1, step2), motion, commands)
