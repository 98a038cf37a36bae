"""The emulated mechanism: the true plant, integrated on a grid of 100 µs.

The current loops accept a new target at the next point of the grid, like a current loop of 10 kHz.
All periods between two events are one compiled call.
"""

import math
from typing import NamedTuple

import numpy as np

from svsa.actuators.dynamics import build_actuator
from svsa.actuators.elasticity import AnyActuator, compute_coordinate_slope
from svsa.actuators.signals import State, Torque
from svsa.errors import StateError
from svsa.hardware.emulator.parameters import EmulatorParameters
from svsa.numerics.compilation import compiled
from svsa.numerics.packed import pack, view_field
from svsa.simulation.loop.lane import AT_REST, NO_TORQUE
from svsa.simulation.loop.measured import read_state, store_state, store_torque
from svsa.simulation.plant.effects import EffectConstants, Effects, build_effect_constants
from svsa.simulation.plant.integration import Stops, coast
from svsa.simulation.plant.load_table import (
    LoadTable,
    ScheduledLoad,
    build_load_table,
    schedule_load,
)
from svsa.simulation.plant.loads import Load

GRID_US = 100
MAX_LOADS = 100
_PERIOD_S = GRID_US * 1e-6


class _Plant(NamedTuple):
    """Constants: the true actuator, its effects, its stops."""

    actuator: AnyActuator
    bench: EffectConstants
    stops: Stops


class _Moving(NamedTuple):
    """State; actual torque of the motors, and the torque of their current loops' targets, N·m."""

    x: State = AT_REST
    torque: Torque = NO_TORQUE
    target: Torque = NO_TORQUE


@compiled
def _coast_on(
    plant: np.ndarray, moving: np.ndarray, table: LoadTable, tick: int, count: int
) -> None:
    """`coast` with a `_Plant` and a `_Moving` that are packed: cheap to call from Python."""
    # Packed constants reduced the cost of an emulated millisecond from 54 to 38 µs.
    p, m = plant[0], moving[0]
    torque, target = Torque(m.torque.u1, m.torque.u2), Torque(m.target.u1, m.target.u2)
    x, made = coast(
        p.actuator, p.bench, p.stops, read_state(m.x), torque, target, table, tick, _PERIOD_S, count
    )
    store_state(m.x, x)
    store_torque(m.torque, made)


class Mechanics:
    """The actuator, its motors' torques and its loads; starts at rest at home.

    Attributes:
        torque: Torque of the motors at the last point of the grid, u1 and u2
            of the model, N·m at the gearbox outputs.
        target: Commanded torque, likewise.
    """

    def __init__(self, parameters: EmulatorParameters) -> None:
        p = parameters
        effects = Effects(friction=p.friction, current_lag=p.current_lag, gravity=p.gravity)
        actuator = build_actuator(p.actuator, p.lever_ratio)
        slope = compute_coordinate_slope(actuator)
        low, high = sorted(
            (end - p.lever_ratio) / slope for end in (p.lever_ratio_min, p.lever_ratio_max)
        )
        plant = _Plant(
            actuator,
            build_effect_constants(effects, p.seed, p.actuator, _PERIOD_S),
            Stops(low, high, float(p.deflection_max_rad)),
        )
        self._plant, self._moving = pack(plant), pack(_Moving())
        self._state = view_field(self._moving, "x")
        self._made = view_field(self._moving, "torque")
        self._asked = view_field(self._moving, "target")
        self._tick = 0
        self._x = AT_REST
        self.torque = self.target = NO_TORQUE
        self._loads: tuple[ScheduledLoad, ...] = ()
        self._table = build_load_table(())
        self._load_count = 0
        self._coast(0)

    @property
    def load_count(self) -> int:
        """Number of active and scheduled loads."""
        return sum(load.end_tick > self._tick for load in self._loads)

    def read(self, time_us: int) -> State:
        """Return x at this time, extrapolated with its velocities between grid points."""
        self._coast(time_us // GRID_US)
        since = time_us * 1e-6 - self._tick * _PERIOD_S
        x = self._x
        if time_us == self._tick * GRID_US:
            return x
        return State(
            x.q + x.dq * since,
            x.dq,
            x.theta1 + x.dtheta1 * since,
            x.dtheta1,
            x.theta2 + x.dtheta2 * since,
            x.dtheta2,
        )

    def set_target(self, time_us: int, target: Torque) -> None:
        """Set the motors' target torque, N·m, from the next grid point on."""
        if target != self.target:
            self._coast(-(-time_us // GRID_US))
            self.target = target
            self._asked[:] = target

    def add_load(self, time_us: int, load: Load) -> int:
        """Add a load, whose `start_s` is emulator time; return its number.

        Raises:
            StateError: If there are too many loads.
        """
        if self.load_count >= MAX_LOADS:
            raise StateError(f"{MAX_LOADS} loads act on the emulator: remove some first.")
        now = max(self._tick, -(-time_us // GRID_US))
        self._load_count += 1
        loads = [*self._loads, schedule_load(self._load_count, load, now, _PERIOD_S)]
        self._loads = tuple(load for load in loads if load.end_tick > self._tick)
        self._table = build_load_table(self._loads)
        return self._load_count

    def clear_loads(self, time_us: int) -> None:
        """Remove all loads, including scheduled ones."""
        self._coast(-(-time_us // GRID_US))
        self._loads = ()
        self._table = build_load_table(())

    def home(self, time_us: int) -> None:
        """Move the mechanism to its zero marks, at rest, as an operator does by hand."""
        self._coast(-(-time_us // GRID_US))
        self._state[:] = self._x = AT_REST

    def _coast(self, tick: int) -> None:
        if tick > self._tick or self._tick == 0:
            _coast_on(self._plant, self._moving, self._table, self._tick, tick - self._tick)
            self._tick = max(tick, self._tick)
            self._x = State(*self._state.tolist())
            self.torque = Torque(*self._made.tolist())
        if not math.isfinite(sum(self._x)):
            raise StateError("The simulation of the mechanism has diverged: home it.")
