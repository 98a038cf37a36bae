"""The first use of each law on a bench against the clock, with a running loop."""

import contextlib
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from svsa.control.installed import PAPERS_LAW, list_law_names
from svsa.hardware.bench.homing import STEPS
from svsa.hardware.emulator.launch import start_emulator
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.command import Set
from svsa.runs.definition.paper import get_figure
from svsa.runs.execution.run import Run
from svsa.simulation.reference.kinds.constant import ConstantPosition
from tests.hardware.live_bench import IDLE_S, write_bench

MISSED = 60
"""Late ticks of all 19 laws together: they were 300. A busy machine causes some itself."""
WAKE_S = 1.0 / 60.0
PATIENCE_S = 30.0

pytestmark = pytest.mark.wall_clock


def wake_until(session: BenchSession, status: BenchStatus) -> None:
    end = time.monotonic() + PATIENCE_S
    while session.bench_status is not status:
        assert session.fault is None, session.fault
        assert time.monotonic() < end, session.bench_status
        session.wake(time.monotonic())
        time.sleep(WAKE_S)


@contextlib.contextmanager
def open_bench(folder: Path) -> Iterator[BenchSession]:
    figure = get_figure("4a").build_configuration(load=False)
    for law in list_law_names():  # as in `svsa serve`, so that its twin does not wait for them
        Run(figure.changed(law=law))
    with start_emulator(False, IDLE_S, "--real-time") as emulator:
        path = write_bench(folder, emulator, lockstep=False)
        session = BenchSession("lab", path, figure.changed(position=ConstantPosition()))
        try:
            session.open()
            session.watched = True
            session.arm()
            wake_until(session, BenchStatus.READY)
            for step in STEPS:
                session.confirm_home(step.name, "a test")
            yield session
        finally:
            session.close()


@pytest.mark.parametrize("status", [BenchStatus.READY, BenchStatus.RUN])
def test_first_use_of_a_law_delays_no_tick(status: BenchStatus, tmp_path: Path) -> None:
    """Each for some ms: with the late feedback of a busy machine some would oscillate."""
    with open_bench(tmp_path) as session:
        if status is BenchStatus.RUN:
            session.start()
            wake_until(session, BenchStatus.RUN)
        fields = session.loop.memory.fields
        missed = {}
        for law in list_law_names():
            before = int(fields["skipped"])
            for other in (law, PAPERS_LAW):
                session.change(Set("law", other))
                session.wake(time.monotonic())
            missed[law] = int(fields["skipped"]) - before
        assert session.fault is None
        assert session.bench_status is status
    assert sum(missed.values()) < MISSED, missed
