"""The loop on a bench, tick by tick: read → follow → decide → write → publish.

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
from svsa.runtime.loop import AT_REST, NO_TORQUE, UNDISTURBED
from svsa.runtime.measured import Actuation, Carried, follow_and_decide, publish_and_foresee
from svsa.runtime.run import Run, Start
from svsa.signals import CHANNELS, Measurement, Reference, State, Torque

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
        self._scratch = np.empty(len(CHANNELS))
        self._forget()

    def _forget(self) -> None:
        """Know nothing of the state: the next measurement is where it begins."""
        self._carried: Carried | None = None
        self._expected = AT_REST

    def load(self, configuration: Configuration) -> None:
        """Use this configuration from the next start on; raises `StateError` in motion."""
        if self.plant.status in MOVING:
            raise StateError("The bench is moving: stop it before another run is loaded.")
        x = self._carried.known if self._carried else AT_REST
        self.run = Run(configuration, start=Start(self._mu0, x))

    def start(self, now: float) -> Start:
        """Begin a run at tick 0 from where the bench stands; raises `StateError`.

        The references fade in from the measured position and stiffness, and ŵ begins at
        zero, so that the first torque is about zero.
        """
        if self._carried is None:
            raise StateError("The bench has not been read yet: arm it and wait until READY.")
        self.plant.start(now)
        still = self._carried.known._replace(dq=0.0, dtheta1=0.0, dtheta2=0.0)
        start = Start(self._mu0, still)
        self.run = Run(self.run.configuration, start=start)
        self._carried = self._carried._replace(estimate=UNDISTURBED)
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
        still = Measurement(0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
        carried, reference, _ = self._decide(_begin_at(still), still)
        self._publish(carried, reference, still, (0.0, 0.0, 0.0), self._scratch)

    def tick(self, now: float, missed: int = 0) -> None:
        """One period. now: time of the plant's clock, s. missed: ticks lost before it."""
        plant = self.plant
        reading = self.reading = plant.read(now, self._expected)
        measurement = reading.measurement
        if measurement is None:
            self._forget()
            plant.write(now, NO_TORQUE, AT_REST, UNDISTURBED, missed)
            return
        carried, reference, asked = self._decide(
            self._carried or _begin_at(measurement), measurement
        )
        moving = plant.status in MOVING
        torque = asked if moving else NO_TORQUE
        sent = plant.write(now, torque, carried.known, carried.estimate, missed)
        self._carried = carried = carried._replace(before=carried.sent, sent=sent)
        tick = self.run.tick
        row = self.sink.get_row(tick) if moving else self._scratch
        self._expected = self._publish(carried, reference, measurement, reading.ages_s, row)
        if moving:
            self.run.tick = tick + 1
            self.sink.commit(tick)

    def _decide(
        self, carried: Carried, measurement: Measurement
    ) -> tuple[Carried, Reference, Torque]:
        run = self.run
        return follow_and_decide(
            run.blocks[0], run.inputs, self._actuation, carried, measurement, run.tick
        )

    def _publish(
        self,
        carried: Carried,
        reference: Reference,
        measurement: Measurement,
        ages: tuple[float, float, float],
        row: np.ndarray,
    ) -> State:
        run = self.run
        return publish_and_foresee(
            run.blocks[0], self._actuation, carried, reference, measurement, ages, run.tick, row
        )


def _begin_at(y: Measurement) -> Carried:
    """At rest where the bench was measured first."""
    x = State(y.theta1 + y.phi, 0.0, y.theta1, 0.0, y.theta2, 0.0)
    return Carried(x, UNDISTURBED, NO_TORQUE, NO_TORQUE, NO_TORQUE)
