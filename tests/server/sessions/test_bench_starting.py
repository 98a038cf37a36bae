"""A bench that starts slowly or not at all: the lab runs before it, and reports its progress."""

import asyncio
import io
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import httpx
import pytest
from rich.console import Console

from svsa.errors import StateError
from svsa.hardware.session.session import BenchSession
from svsa.runs.definition.command import Set
from svsa_server.sessions.bench_start import open_bench
from svsa_server.sessions.hosted import HostedSession
from svsa_server.sessions.state import build_state
from tests.hardware.live_bench import start_live_emulator, write_bench
from tests.lab import run_lab
from tests.server.sessions.scripted_bench import STEP, Processes, build_bench_session
from tests.waiting import wait_until

COMMANDS: dict[str, Callable[[BenchSession], Any]] = {
    "arm": lambda session: session.arm(),
    "home": lambda session: session.confirm_home("link", "Ada"),
    "run": lambda session: session.start(),
    "change": lambda session: session.change(Set("law", "fl")),
    "load": lambda session: session.load(session.run.configuration),
    "reset": lambda session: session.reset(),
    "record": lambda session: session.prepare_recording(),
}


@pytest.fixture
def starting(monkeypatch: pytest.MonkeyPatch) -> Iterator[BenchSession]:
    made = build_bench_session(monkeypatch)
    made.watched = True
    yield made
    made.close()


@pytest.mark.parametrize("name", COMMANDS)
def test_starting_bench_takes_no_command_and_states_why(starting: BenchSession, name: str) -> None:
    with pytest.raises(
        StateError, match=r"being started \(compiling .*, 12 s\): repeat the request when"
    ):
        COMMANDS[name](starting)
    starting.open()
    assert isinstance(starting.loop.processes, Processes)
    assert starting.loop.processes.reported == [], "nothing of it comes later"


def test_state_of_a_starting_bench_is_complete(starting: BenchSession) -> None:
    """No mark is confirmed, no feedback is received, and its twin is at rest."""
    starting.wake(0.0)
    state = build_state(HostedSession(starting))
    assert state.bench is not None
    assert (state.status, state.bench.status, state.fault) == ("paused", "off", None)
    loop = state.bench.loop
    assert (loop.state, loop.alive, loop.step, loop.starting_s) == ("starting", False, STEP, 12.3)
    assert state.bench.homing.next_step == "link"
    assert state.bench.current_a is None
    assert min(state.bench.ages_s) == 1000.0
    assert state.bench.emulated is None
    starting.open()
    state = build_state(HostedSession(starting))
    assert state.bench is not None
    assert (state.bench.loop.state, state.bench.loop.step) == ("ticking", None)


def test_lab_runs_and_the_console_reports_progress_during_the_start(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    seen: list[bool] = []
    session = build_bench_session(monkeypatch, is_ready=lambda: len(seen) > 2)
    console = Console(file=io.StringIO(), width=200)

    async def serve() -> None:
        opening = asyncio.create_task(open_bench(session, console))
        while not opening.done():
            seen.append(session.loop.starting)
            await asyncio.sleep(0.005)

    asyncio.run(serve())
    assert seen.count(True) > 2
    assert not session.loop.starting
    assert console.file.getvalue().splitlines() == [
        f"The bench is {STEP} (12 s) …",
        "The bench is ready: you can arm it.",
    ]
    session.close()


def test_bench_that_cannot_be_opened_is_a_fault_with_reason_and_recovery(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    session = build_bench_session(monkeypatch, refusal="No adapter is plugged in.")
    console = Console(file=io.StringIO(), width=200)
    asyncio.run(open_bench(session, console))
    said = console.file.getvalue()
    assert "The bench cannot be opened: No adapter is plugged in." in said
    assert "POST /api/v1/sessions/lab/bench/restart" in said
    session.wake(0.0)
    state = build_state(HostedSession(session))
    assert state.fault is not None and state.bench is not None
    assert "No adapter is plugged in. Restart the loop." in state.fault.message
    assert state.fault.code == "bench_not_opened", "nothing was lost that never was there"
    assert [event.label for event in state.events] == ["Bench not opened"]
    assert state.bench.loop.state == "not_opened"
    assert state.bench.emulated is None, "no user knows what is behind a bus that was not heard"
    with pytest.raises(StateError, match="No adapter"):
        session.restart()
    Processes.script.refusal = None
    session.restart()
    state = build_state(HostedSession(session))
    assert state.bench is not None
    assert (state.fault, state.bench.status, state.bench.loop.state) == (None, "off", "ticking")
    session.close()


@pytest.mark.parametrize(
    ("said", "ticks", "known"), [(1, 1, True), (0, 300, None), (0, 301, False)]
)
def test_emulation_is_known_after_listening_to_the_bus(
    starting: BenchSession, said: int, ticks: int, known: bool | None
) -> None:
    starting.open()
    starting.loop.memory.fields["emulated"], starting.loop.memory.fields["ticks"] = said, ticks
    state = build_state(HostedSession(starting))
    assert state.bench is not None
    assert state.bench.emulated is known
    if known is None:
        with pytest.raises(StateError, match="not known yet"):
            COMMANDS["record"](starting)


@pytest.mark.exhaustive
@pytest.mark.wall_clock
def test_lab_without_its_bench_is_served_and_connects_later(tmp_path: Path) -> None:
    """No process listens at the port in the bench file, until it is corrected."""
    with start_live_emulator() as emulator:
        path = write_bench(tmp_path, emulator)
        right = path.read_text(encoding="utf-8")
        path.write_text(right.replace(f"port = {emulator.port}\n", "port = 1\n"), encoding="utf-8")
        with run_lab("--bench", str(path)) as lab:
            assert lab.client.get("/").is_success
            state = lab.read()
            if state["bench"]["loop"]["state"] == "starting":
                answer = lab.client.post(lab.session + "/bench/arm")
                assert answer.status_code == 409
            wait_until(lambda: lab.read()["fault"] is not None)
            message = lab.read()["fault"]["message"]
            assert "cannot be opened" in message and "Restart the loop" in message
            path.write_text(right, encoding="utf-8")
            restart: httpx.Response = lab.client.post(lab.session + "/bench/restart")
            assert restart.is_success, restart.text
            assert lab.client.post(lab.session + "/bench/arm").is_success
            wait_until(lambda: lab.read()["bench"]["status"] == "ready")
