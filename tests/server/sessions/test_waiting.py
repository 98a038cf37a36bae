"""A command that waits for a bench: it ends in order, and delays no user."""

import asyncio
import threading
import time
import types
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from svsa.errors import StateError
from svsa.hardware.description.file import read_bench
from svsa.hardware.realtime import launch
from svsa.hardware.realtime.launch import BenchError, BenchProcesses
from svsa.hardware.realtime.link import Link, build_links
from svsa.hardware.session import supervised_loop
from svsa.hardware.session.supervised_loop import SupervisedLoop
from svsa.runs.definition.paper import get_figure
from svsa_server.sessions import laboratory
from svsa_server.sessions.laboratory import EmulatorOperator
from svsa_server.sessions.waiting import pause, run_waiting
from tests.hardware.wired_bench import EMULATOR_BENCH

LONG_S = 60.0


async def count_turns_of_the_loop(counted: list[int]) -> None:
    while True:
        counted[0] += 1
        await asyncio.sleep(0)


def take_in_parallel(do: Any, *arguments: Any) -> tuple[Any, int]:
    """Return the result of a locked section, and the number of event-loop iterations meanwhile."""

    async def run() -> tuple[Any, int]:
        counted = [0]
        other = asyncio.create_task(count_turns_of_the_loop(counted))
        try:
            return await run_waiting(do, *arguments), counted[0]
        finally:
            other.cancel()

    return asyncio.run(run())


def test_others_continue_while_a_section_waits() -> None:
    def wait(times: int) -> str:
        for _ in range(times):
            pause(0.005)
        return "done"

    answer, turns = take_in_parallel(wait, 10)
    assert answer == "done"
    assert turns >= 20


def test_exception_is_raised_and_cancellation_unwinds_the_section() -> None:
    def fail() -> None:
        pause(0.001)
        raise BenchError("no")

    with pytest.raises(BenchError, match="no"):
        take_in_parallel(fail)
    unwound = []

    def wait() -> None:
        try:
            pause(LONG_S)
        finally:
            unwound.append(True)

    async def cancel() -> None:
        task = asyncio.create_task(run_waiting(wait))
        await asyncio.sleep(0.01)
        task.cancel()
        await asyncio.gather(task, return_exceptions=True)

    asyncio.run(cancel())
    assert unwound == [True]


def test_waiting_outside_of_a_section_blocks_the_thread() -> None:
    begin = time.monotonic()
    pause(0.02)
    assert time.monotonic() - begin >= 0.02


def test_silent_rig_is_waited_for_in_a_limited_time(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(laboratory, "OPERATOR_TIMEOUT_S", 0.05)
    operator, answered = EmulatorOperator(1), threading.Event()
    operator._thread.submit(answered.wait, LONG_S)
    try:
        with pytest.raises(StateError, match="not set to its marks"):
            take_in_parallel(operator.set_to_marks)
    finally:
        answered.set()


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[BenchProcesses, Link]]:
    """The processes of a missing bench: the test has the loop's end of the link."""
    ours, theirs = build_links()
    theirs.send({"event": "ready", "notes": []})
    process = types.SimpleNamespace(
        poll=lambda: None, wait=lambda: 0, terminate=lambda: None, kill=lambda: None
    )
    held = types.SimpleNamespace(fileno=theirs.fileno, close=lambda: None)
    monkeypatch.setattr(launch, "build_links", lambda: (ours, held))
    monkeypatch.setattr(launch, "_start", lambda *_: process)
    monkeypatch.setattr(launch, "_watch", lambda *_: types.SimpleNamespace(stop=lambda _: None))
    monkeypatch.setattr(launch, "END_S", 0.0)
    configuration = get_figure("4a").build_configuration()
    processes = BenchProcesses(Path("bench.toml"), configuration, pause)
    processes.wait_until_ready(LONG_S, lambda *_: None)
    theirs.receive(LONG_S)
    yield processes, theirs
    theirs.close()
    processes.end()
    processes.free()


def test_event_loop_does_not_wait_for_a_silent_loop(
    asked: tuple[BenchProcesses, Link],
) -> None:
    processes, _ = asked

    def ask() -> str:
        with pytest.raises(BenchError, match="did not answer") as raised:
            processes.request("arm")
        return str(raised.value)

    _, turns = take_in_parallel(ask)
    assert turns >= 20


@pytest.mark.parametrize(("loop_s", "patience_s"), [(0.02, 0.5), (1.0, 2.0)])
def test_loop_is_silent_later_than_the_timeout_of_its_supervisor(
    monkeypatch: pytest.MonkeyPatch, loop_s: float, patience_s: float
) -> None:
    """A delay of a second, permitted by the bench file, is not abandoned after half of one."""
    asked: list[Any] = []
    nothing = types.SimpleNamespace(memory=None)
    monkeypatch.setattr(
        supervised_loop, "BenchProcesses", lambda *reported: asked.extend(reported) or nothing
    )
    bench = read_bench(EMULATOR_BENCH)
    bench = bench.changed(safety=bench.safety.changed(loop_s=loop_s))
    loop = SupervisedLoop(EMULATOR_BENCH, bench)
    loop.launch(get_figure("4a").build_configuration())
    assert asked[-1] == patience_s


def test_silent_loop_is_not_queried(
    asked: tuple[BenchProcesses, Link], monkeypatch: pytest.MonkeyPatch
) -> None:
    processes, theirs = asked
    monkeypatch.setattr(processes.beats, "age_s", lambda slot: 3.0)

    def never(seconds: float) -> None:
        raise AssertionError("it waited")

    monkeypatch.setattr(processes, "_rest", never)
    with pytest.raises(BenchError, match=r"silent for 3\.0 s"):
        processes.request("stop", "a test")
    processes.report("stop", "a test")
    assert theirs.receive() == []


def test_concurrent_requests_end_in_order(
    asked: tuple[BenchProcesses, Link],
) -> None:
    processes, theirs = asked
    processes.patience_s = LONG_S
    ended = []

    def ask(name: str) -> None:
        processes.request(name)
        ended.append(name)

    async def run() -> None:
        turns = [asyncio.create_task(run_waiting(ask, name)) for name in ("one", "two", "three")]
        numbers = []
        while len(numbers) < 3:
            await asyncio.sleep(0.001)
            numbers += [message["number"] for message in theirs.receive()]
        for number in reversed(numbers):
            theirs.send({"answer": number})
        await asyncio.gather(*turns)

    asyncio.run(run())
    assert ended == ["one", "two", "three"]
