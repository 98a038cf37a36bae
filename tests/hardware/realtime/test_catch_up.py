"""Frames that arrived while the loop was loaded are read before its first tick is due."""

from types import SimpleNamespace
from typing import Any

from svsa.hardware.plant.sensing import MAX_FRAMES_A_TICK
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.realtime.process import LoopProcess
from svsa.hardware.safety.machine import BenchStatus
from tests.hardware.wired_bench import AT_REST, WiredBench

LOADING_S = 2.0


def test_thousands_of_pending_frames_delay_no_tick() -> None:
    with WiredBench() as bench:
        bench.clock.wait_until(bench.clock.now() + LOADING_S)
        waiting = bench.plant_bus.queue.qsize()  # pyright: ignore
        assert waiting > 5 * MAX_FRAMES_A_TICK, "a tick would take them in parts, each late"
        bench.plant.catch_up()
        assert bench.plant_bus.recv(0) is None
        reading = bench.plant.read(bench.clock.now(), AT_REST)
        assert reading.ages_s[2] < 0.002, "what was taken last is the present"


def test_first_tick_is_due_after_the_pending_frames() -> None:
    done: list[str] = []

    def now() -> float:
        done.append("now")
        return 0.0

    winding = SimpleNamespace(heat=0.0)
    plant: Any = SimpleNamespace(
        motors=(SimpleNamespace(winding=winding),) * 2,
        status=BenchStatus.OFF,
        catch_up=lambda: done.append("catch up"),
    )
    loop: Any = SimpleNamespace(run=SimpleNamespace(period_s=0.001))
    clock: Any = SimpleNamespace(now=now)
    memory = LoopMemory.create()
    try:
        absent: Any = None
        process = LoopProcess(loop, plant, clock, 1.0, absent, memory, absent, absent)
        process._ending = True
        process.run()
    finally:
        memory.close()
    assert done == ["catch up", "now"]
