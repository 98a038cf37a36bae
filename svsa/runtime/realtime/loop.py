"""The loop on a bench, tick by tick: foresee → read → follow → decide → write → publish.

The same pieces as on the simulated plant, around a plant that is read and written. It
knows neither processes nor shared memory: a test or an experiment runs it in lockstep, the
loop's process against the clock.
"""

from typing import Any, Protocol

import numpy as np

from svsa.errors import StateError
from svsa.hardware.bench import BenchFile
from svsa.hardware.can_plant import CanPlant, Reading
from svsa.hardware.machine import BenchStatus
from svsa.runtime.command import build_command
from svsa.runtime.configuration import Configuration
from svsa.runtime.loop import AT_REST, NO_TORQUE, UNDISTURBED, decide
from svsa.runtime.measured import Actuation, follow, foresee, publish_measured
from svsa.runtime.run import Run, Start
from svsa.signals import CHANNELS, Measurement, State

STATUSES = tuple(BenchStatus)
MOVING = (BenchStatus.RUN, BenchStatus.RAMP)


class SampleSink(Protocol):
    """Where samples go: shared memory, or an array."""

    def begin_run(self, number: int) -> None:
        """Samples from now on are those of run `number`, from tick 0."""
        ...

    def get_row(self, tick: int) -> np.ndarray:
        """Where the sample of this tick goes; then `commit` it."""
        ...

    def commit(self, tick: int) -> None:
        """The row of this tick is written."""
        ...


class BenchLoop:
    """Controller and observer on a bench. `run` holds what is set; `tick` is one period.

    plant: open. configuration: its references, law, gains and observer are used; see
    `build_bench_configuration`.
    """

    def __init__(
        self, plant: CanPlant, bench: BenchFile, configuration: Configuration, sink: SampleSink
    ) -> None:
        self.plant, self.sink = plant, sink
        self.number = 0
        self.reading: Reading | None = None
        self._actuation = Actuation(bench.timing.latency_s, bench.timing.current_lag_s)
        self._mu0 = bench.home.lever_ratio
        self.run = Run(configuration, start=Start(self._mu0, AT_REST))
        self._forget()

    def _forget(self) -> None:
        """Know nothing of the state: the next measurement is where it begins."""
        self._known: State | None = None
        self._estimate = UNDISTURBED
        self._made = self._before = self._sent = NO_TORQUE

    def load(self, configuration: Configuration) -> None:
        """Use this configuration from the next start on; raises `StateError` in motion."""
        if self.plant.status in MOVING:
            raise StateError("The bench is moving: stop it before another run is loaded.")
        self.run = Run(configuration, start=Start(self._mu0, self._known or AT_REST))

    def start(self, now: float) -> Start:
        """Begin a run at tick 0 from where the bench stands; raises `StateError`.

        The references fade in from the measured position and stiffness, and ŵ begins at
        zero, so that the first torque is about zero.
        """
        if self._known is None:
            raise StateError("The bench has not been read yet: arm it and wait until READY.")
        self.plant.start(now)
        still = self._known._replace(dq=0.0, dtheta1=0.0, dtheta2=0.0)
        start = Start(self._mu0, still)
        self.run = Run(self.run.configuration, start=start)
        self._estimate = UNDISTURBED
        self.number += 1
        self.sink.begin_run(self.number)
        return start

    def change(self, kind: str, argument: Any) -> int:
        """Give the run a command of `KINDS`; returns the tick at which it holds.

        Raises `ParameterError` or `StateError`, and then nothing has changed.
        """
        command = build_command(self.run.tick, kind, argument)
        command.apply(self.run)
        return command.tick

    def warm_up(self) -> None:
        """Have every compiled piece loaded before time counts."""
        blocks, sample = self.run.blocks[0], np.empty(len(CHANNELS))
        still = Measurement(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        reference, torque = decide(blocks, self.run.inputs, AT_REST, UNDISTURBED, 0)
        rest = (AT_REST, UNDISTURBED, NO_TORQUE, NO_TORQUE, torque)
        foresee(blocks, self._actuation, *rest, (0.0, 0.0, 0.0))
        follow(blocks, self._actuation, *rest, still)
        publish_measured(blocks, reference, still, AT_REST, UNDISTURBED, torque, 0, sample)

    def tick(self, now: float, missed: int = 0) -> None:
        """One period. now: time of the plant's clock, s. missed: ticks lost before it."""
        reading = self.plant.read(now, self._foresee())
        self.reading = reading
        blocks, measurement = self.run.blocks[0], reading.measurement
        if measurement is None:
            self._forget()
        else:
            self._follow(blocks, measurement)
        known = self._known or AT_REST
        torque, moving = NO_TORQUE, self.plant.status in MOVING
        reference, asked = decide(blocks, self.run.inputs, known, self._estimate, self.run.tick)
        if moving:
            torque = asked
        sent = self.plant.write(now, torque, known, self._estimate, missed)
        self._before, self._sent = self._sent, sent
        if moving and measurement is not None:
            tick = self.run.tick
            row = self.sink.get_row(tick)
            publish_measured(blocks, reference, measurement, known, self._estimate, sent, tick, row)
            self.run.tick = tick + 1
            self.sink.commit(tick)

    def _foresee(self) -> State:
        """The state in which the bench is about to be found."""
        if self._known is None or self.reading is None:
            return AT_REST
        return foresee(
            self.run.blocks[0],
            self._actuation,
            self._known,
            self._estimate,
            self._made,
            self._before,
            self._sent,
            self.reading.ages_s,
        )

    def _follow(self, blocks: Any, measurement: Measurement) -> None:
        if self._known is None:
            y = measurement
            self._known = State(y.theta1 + y.phi, 0.0, y.theta1, 0.0, y.theta2, 0.0)
            return
        self._known, self._estimate, self._made = follow(
            blocks,
            self._actuation,
            self._known,
            self._estimate,
            self._made,
            self._before,
            self._sent,
            measurement,
        )
