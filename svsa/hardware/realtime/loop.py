"""The loop on a bench, tick by tick: read, observe, control, write, publish.

It uses the functions of the simulated loop with a plant that is read and written. It is independent
of processes and shared memory: tests and experiments run it in lockstep, the loop's process runs it
in real time.
"""

import math
from collections.abc import Mapping, Sequence
from typing import Protocol

import numpy as np

from svsa.actuators.signals import CHANNELS, Disturbance, Measurement, State, Torque
from svsa.control.call import BoundLaw, build_call
from svsa.control.installed import get_law
from svsa.control.observers.spring import Spring
from svsa.errors import StateError
from svsa.hardware.bench.reading import Reading
from svsa.hardware.safety.machine import BenchStatus
from svsa.numerics.packed import pack, view_field
from svsa.runs.definition.command import Command
from svsa.runs.definition.configuration import Configuration
from svsa.runs.execution.blocks import Bind, bind_law
from svsa.runs.execution.run import Run, Start
from svsa.simulation.loop.lane import AT_REST, NO_TORQUE, UNDISTURBED, Blocks
from svsa.simulation.loop.measured import (
    Actuation,
    BenchConstants,
    BenchLoopState,
    follow_and_decide,
    pass_ticks,
    publish_and_predict,
)

STATUSES = tuple(BenchStatus)
MOVING = (BenchStatus.RUN, BenchStatus.RAMP)
MOTION = ("known", "actual", "before", "sent")
"""Fields of `BenchLoopState` at the first tick of a run."""
FARTHEST_RAD = 2.0 * math.pi
"""Bound of a position reference, rad."""
_NOTHING = pack(BenchLoopState())


class Plant(Protocol):
    """A plant that is read and written, with the states of a bench."""

    @property
    def status(self) -> BenchStatus:
        """State of the bench."""
        ...

    def start(self, now: float) -> None:
        """Enter RUN at the next tick.

        Raises:
            StateError: If that is not permitted.
        """
        ...

    def read(self, now: float, known: State) -> Reading:
        """Read the bench; `known` is the current x̂."""
        ...

    def write(
        self, now: float, limited: Torque, known: State, estimate: Disturbance, missed: int
    ) -> Torque:
        """Send the permitted part of `limited`; return the torque actually sent, N·m."""
        ...


class SampleSink(Protocol):
    """The destination of samples: shared memory, or an array."""

    def begin_run(self, number: int) -> None:
        """Start run `number`: samples from now on are its, from tick 0."""
        ...

    def get_row(self, tick: int) -> np.ndarray:
        """Return the row for this tick's sample; then `commit` it."""
        ...

    def commit(self, tick: int) -> None:
        """Mark the row of this tick as written."""
        ...

    def skip(self, first: int, ticks: int) -> None:
        """Skip missed ticks, from tick `first` on: their rows are NaN and not committed."""
        ...


class BenchLoop:
    """Controller and observer on a bench. `run` has the settings; `tick` is one period.

    Args:
        plant: The open plant.
        actuation: Delay and lag from the decision about a torque to its effect.
        mu0: Lever ratio at the zero marks, 1.
        configuration: Its references, law, gains and observer are used; see
            `build_bench_configuration`.
        bind: Binds the law of a lane.
    """

    def __init__(
        self,
        plant: Plant,
        actuation: Actuation,
        mu0: float,
        configuration: Configuration,
        sink: SampleSink,
        bind: Bind = bind_law,
    ) -> None:
        self.plant, self.sink = plant, sink
        self.number = 0
        self.reading: Reading | None = None
        self._actuation, self._mu0, self._bind = actuation, mu0, bind
        self.run = Run(configuration, start=Start(self._mu0, AT_REST), bind=bind)
        self._scratch = np.empty(len(CHANNELS))
        self._carried = _NOTHING.copy()
        self._known, self._estimate, self._limited, self._expected, self._measured, self._ages = (
            view_field(self._carried, name)
            for name in ("known", "estimate", "limited", "expected", "measured", "ages_s")
        )
        self._connected: tuple[Blocks, BoundLaw, np.ndarray] | tuple[None, None, None]
        self._connected = None, None, None
        self._constants = np.empty(0)
        self._forget()

    def _forget(self) -> None:
        """Discard the state: it restarts from the next measurement."""
        self._is_known = False
        self._carried[:] = _NOTHING
        lane = self.run.lanes[0]
        lane.memory[:] = get_law(self.run.configuration.law).start_memory()
        lane.spring[:] = pack(Spring())

    def load(self, configuration: Configuration) -> None:
        """Use this configuration from the next start on.

        Raises:
            StateError: During motion.
        """
        if self.plant.status in MOVING:
            raise StateError("The bench is moving: stop it before another run is loaded.")
        x = State(*self._known.tolist())
        # A reference cannot start farther away; `start` rejects such a run with the reason.
        near = x if abs(x.q) <= FARTHEST_RAD else AT_REST
        self.run = Run(configuration, start=Start(self._mu0, near), bind=self._bind)

    def start(self, now: float) -> Start:
        """Start a run at tick 0 from the measured position.

        The references blend in from the measured position and stiffness, and ŵ starts at zero, so
        that the first torque is about zero.

        Raises:
            StateError: If a start is not permitted.
        """
        if self.plant.status is BenchStatus.READY and not self._is_known:
            raise StateError("The bench has not been read yet: arm it and wait until READY.")
        known = State(*self._known.tolist())
        if self._is_known and abs(known.q) > FARTHEST_RAD:
            raise StateError(
                f"The link is {known.q:.1f} rad from its mark, and a run begins at most"
                f" {FARTHEST_RAD:.1f} rad from it: remove every hanging load, press Quick stop,"
                " clear"
                " the fault, set the bench to its marks, and arm it."
            )
        self.plant.start(now)
        still = known._replace(dq=0.0, dtheta1=0.0, dtheta2=0.0)
        start = Start(self._mu0, still)
        self.run = Run(self.run.configuration, start=start, bind=self._bind)
        self._estimate[:] = UNDISTURBED
        self.number += 1
        self.sink.begin_run(self.number)
        return start

    def read_motion(self) -> dict[str, list[float]]:
        """Return x̂ and the delayed torques, by the names in `MOTION`."""
        return {name: view_field(self._carried, name).tolist() for name in MOTION}

    def know(self, motion: Mapping[str, Sequence[float]]) -> None:
        """Set the state that `read_motion` returned, instead of a first measurement."""
        for name in MOTION:
            view_field(self._carried, name)[:] = motion[name]
        self._is_known = True

    def change(self, command: Command) -> int:
        """Apply a command now; return the tick at which it takes effect.

        A law with its own ŵ starts with the current one: from zero it would drop the load that it
        holds.

        Raises:
            ParameterError, StateError: If the command is rejected; nothing has changed.
        """
        before = self.run.configuration.law
        self.run.change(command)
        law = get_law(self.run.configuration.law)
        if law.name != before and law.estimate == "own" and self._is_known:
            self.run.lanes[0].memory[: len(self._estimate)] = self._estimate
        return self.run.tick

    def warm_up(self) -> None:
        """Load every compiled function before real time matters."""
        self._decide(Measurement(0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
        self._pass_ticks(1)
        self._publish(NO_TORQUE, self._scratch)
        self._forget()

    def tick(self, now: float, missed: int = 0) -> None:
        """Run one period.

        The time of a run advances with real time: a missed tick has its number, but no sample. Tick
        0 is the first tick of a run, with the state of the bench at `start`. Without a measurement
        the run does not advance: the server waits for every tick of a run.

        Args:
            now: Time of the plant's clock, s.
            missed: Number of ticks lost before it.
        """
        plant = self.plant
        begins = not self.run.tick and plant.status in MOVING
        if missed and self._is_known and not begins:
            self._pass_ticks(missed)
        reading = self.reading = plant.read(now, State(*self._expected.tolist()))
        measurement = reading.measurement
        if measurement is None:
            self._forget()
            plant.write(now, NO_TORQUE, AT_REST, UNDISTURBED, missed)
            return
        moving = plant.status in MOVING
        if missed and not begins and moving:
            self.sink.skip(self.run.tick, missed)
            self.run.tick += missed
        known, estimate, limited = self._decide(measurement, reading.ages_s)
        sent = plant.write(now, limited if moving else NO_TORQUE, known, estimate, missed)
        tick = self.run.tick
        # Computed at rest as well: its prediction assigns the next counts to their tick.
        row = self.sink.get_row(tick) if moving else self._scratch
        self._publish(sent, row)
        if moving:
            self.run.tick = tick + 1
            self.sink.commit(tick)

    def _decide(
        self, y: Measurement, ages_s: tuple[float, float, float]
    ) -> tuple[State, Disturbance, Torque]:
        """Compute x̂, ŵ and the law's limited torque. A first y gives a state at rest."""
        if not self._is_known:
            self._known[:] = (y.theta1 + y.phi, 0.0, y.theta1, 0.0, y.theta2, 0.0)
            self._is_known = True
        run = self.run
        blocks, law, memory = self._connected
        if not (run.blocks[0] is blocks and run.laws[0] is law and run.lanes[0].memory is memory):
            self._connect()
        self._measured[:], self._ages[:] = y, ages_s
        follow_and_decide(self._constants, run.inputs, self._carried, run.tick)
        known, estimate, limited = self._known, self._estimate, self._limited
        return State(*known.tolist()), Disturbance(*estimate.tolist()), Torque(*limited.tolist())

    def _connect(self) -> None:
        """Pack the constants of the current run, and its law with its memory."""
        run = self.run
        blocks, law, memory = run.blocks[0], run.laws[0], run.lanes[0].memory
        self._connected = blocks, law, memory  # owners of the memory
        self._constants = pack(BenchConstants(blocks, self._actuation, build_call(law, memory)))

    def _pass_ticks(self, missed: int) -> None:
        run = self.run
        spring = run.lanes[0].spring
        pass_ticks(self._constants, run.inputs, self._carried, spring, run.tick, missed)

    def _publish(self, sent: Torque, row: np.ndarray) -> None:
        run = self.run
        spring = run.lanes[0].spring
        publish_and_predict(self._constants, self._carried, spring, sent.u1, sent.u2, run.tick, row)
