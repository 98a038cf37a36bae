"""A bench on the emulator in lockstep that follows Figure 4A and is monitored tick by tick."""

from collections.abc import Callable
from typing import Any

from svsa.hardware.emulator.experiment import LockstepBench, connect_bench
from svsa.hardware.emulator.launch import RunningEmulator
from svsa.hardware.safety.machine import BenchStatus
from svsa.runs.definition.paper import get_figure
from tests.hardware.emulator.in_process_emulator import InProcessEmulator

FIGURE = get_figure("4a").build_configuration(load=False)
MOVING_TICKS = 500
LONGEST_TICKS = 700
KEPT_TICKS = 2 * (MOVING_TICKS + LONGEST_TICKS)


class EmulatorBeats:
    """Heartbeats in the emulator's time: `stopped` is the time of the last beat of a slot, s."""

    def __init__(self) -> None:
        self.now: Callable[[], float] = lambda: 0.0
        self.stopped: dict[str, float] = {}
        self.stops = 0

    def age_s(self, slot: str) -> float:
        return self.now() - self.stopped[slot] if slot in self.stopped else 0.0


class Bench(LockstepBench):
    """A bench on the emulator in the state READY, monitored tick by tick.

    fastest, farthest: the true |dq|, |dθ1|, |dθ2| and |q| since `watch` began. last_current_s: the
    last time at which a drive that receives frames got a nonzero current, in the emulator's time.
    """

    def __init__(self, emulator: RunningEmulator | InProcessEmulator, **safety: Any) -> None:
        bench, self.beats = connect_bench(emulator), EmulatorBeats()
        bench = bench.changed(safety=bench.safety.changed(**safety))
        super().__init__(emulator, FIGURE, KEPT_TICKS, bench, self.beats)  # pyright: ignore[reportArgumentType]
        self.beats.now = self.now
        self.fastest, self.farthest = {"dq": 0.0, "dtheta1": 0.0, "dtheta2": 0.0}, 0.0
        self.last_current_s = 0.0

    def run(self, ticks: int = MOVING_TICKS) -> None:
        self.start()
        self.tick(ticks)
        assert self.plant.status is BenchStatus.RUN, self.plant.fault

    def miss(self, ticks: int) -> None:
        """Suspend the loop for this time."""
        self._deadline += ticks * self.bench.timing.period_s
        self._clock.wait_until(self._deadline)
        self.loop.tick(self.now(), ticks)

    def begin_watch(self) -> float:
        """Reset the maxima of velocity and travel; return the emulator's time, s."""
        self.fastest, self.farthest = dict.fromkeys(self.fastest, 0.0), 0.0
        self.last_current_s = self.now()
        return self.now()

    def watch(self, ticks: int = 1) -> None:
        for _ in range(ticks):
            self.tick()
            self.look()

    def tick_until_fault(self) -> None:
        for _ in range(LONGEST_TICKS):
            if self.plant.fault is None:
                self.watch()

    def look(self) -> None:
        state = self.emulator.control.read_state()
        for name in self.fastest:
            self.fastest[name] = max(self.fastest[name], abs(state["x"][name]))
        self.farthest = max(self.farthest, abs(state["x"]["q"]))
        if any(self.read_currents(state)):
            self.last_current_s = state["time_s"]

    def read_currents(self, state: dict[str, Any] | None = None) -> list[int]:
        """Return the commanded currents of both drives, mA; zero for a drive without power."""
        drives = (state or self.emulator.control.read_state())["drives"].values()
        return [drive["commanded_ma"] if drive["powered"] else 0 for drive in drives]

    def recover(self) -> None:
        """Clear the fault, repair the emulator, set it to its marks, and arm it again."""
        self.plant.clear(self.now())
        assert self.plant.status is BenchStatus.OFF
        assert self.plant.fault is None
        self.beats.stopped.clear()
        self.emulator.control.clear_faults()
        self.emulator.control.set_loads(())
        self.emulator.control.home()
        self.prepare()
        assert self.plant.status is BenchStatus.READY
        assert self.read_currents() == [0, 0]


def make_ready(emulator: RunningEmulator | InProcessEmulator, **safety: Any) -> Bench:
    bench = Bench(emulator, **safety)
    emulator.control.clear_faults()
    emulator.control.set_loads(())
    emulator.control.home()
    bench.prepare()
    return bench
