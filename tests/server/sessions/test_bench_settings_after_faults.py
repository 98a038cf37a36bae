"""After every fault of a bench every setting is answered, and the server continues."""

import asyncio
from collections.abc import Iterator
from typing import Any

import httpx
import pytest

from svsa.actuators.faults import BENCH_FAULTS, LOSSES
from svsa.errors import Fault
from svsa.hardware.realtime.launch import BenchError
from svsa.hardware.realtime.memory import LoopMemory
from svsa.hardware.safety.machine import BenchStatus
from svsa.hardware.session.session import BenchSession
from svsa.inputs.data_folder import DATA_VARIABLE
from svsa_server.app import build_app
from tests.exhaustive import exhaust
from tests.server.routes.writing import list_examples
from tests.server.schema import SCHEMA
from tests.server.sessions.scripted_bench import begin_run, build_bench_session, receive, say

TICKS = 50
COUNTS = 1000
"""A request that counts the samples more often waits for samples that never arrive."""
TAGS = {"settings", "loads", "recording"}


def list_settings() -> Iterator[tuple[str, str, Any]]:
    """Return method, path below the session, and body of every setting."""
    for path, item in SCHEMA["paths"].items():
        _, found, below = path.partition("/sessions/{session}/")
        for method, operation in item.items():
            if found and method != "get" and TAGS & set(operation.get("tags", ())):
                below = below.format(lane=3, load_id=1)
                examples = list_examples(operation) if "requestBody" in operation else [None]
                for example in examples:
                    yield method, below, example


class CountedMemory:
    """Counts the queries of the number of samples."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.left, count = COUNTS, LoopMemory.count

        def count_on(memory: LoopMemory, number: int) -> int:
            self.left -= 1
            assert self.left > 0, "the server waits for samples that never come"
            return count(memory, number)

        monkeypatch.setattr(LoopMemory, "count", count_on)


def fail(session: BenchSession, monkeypatch: pytest.MonkeyPatch, code: str) -> None:
    """End a run of the bench in this fault; its loop counts ticks without samples."""
    begin_run(session, TICKS)
    say(session, BenchStatus.FAULT, fault=Fault(code, 0, TICKS + 25, 0.075, "It stopped."))
    receive(session)

    def answer(*_: Any) -> dict[str, Any]:
        if code in LOSSES:
            raise BenchError("The loop of the bench is gone.")
        return {"tick": TICKS + 25}

    processes = session.loop.processes
    monkeypatch.setattr(processes, "request", answer)
    monkeypatch.setattr(processes, "listens", code not in LOSSES)


@pytest.mark.parametrize("code", exhaust(BENCH_FAULTS, ["loop_late", "loop_lost"]))
def test_every_setting_after_a_fault_is_answered(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Any, code: str
) -> None:
    monkeypatch.setenv(DATA_VARIABLE, str(tmp_path))
    memory = CountedMemory(monkeypatch)
    session = build_bench_session(monkeypatch)
    settings = list(list_settings())
    assert len({path for _, path, _ in settings}) > 12

    async def ask() -> list[int]:
        app = build_app(shared=session)
        transport = httpx.ASGITransport(app, raise_app_exceptions=False)
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1") as client,
        ):
            while session.loop.starting:
                await asyncio.sleep(0.001)
            fail(session, monkeypatch, code)
            found = []
            for method, path, body in settings:
                memory.left = COUNTS
                answer = await client.request(
                    method, f"/api/v1/sessions/lab/{path}", json=body, timeout=None
                )
                found.append(answer.status_code)
                assert answer.status_code < 500, f"{method} {path}: {answer.text}"
            (await client.post("/api/v1/quick-stop")).raise_for_status()
            (await client.get("/api/v1/health")).raise_for_status()
            return found

    found = asyncio.run(ask())
    assert session.bench_status is BenchStatus.FAULT
    assert code in LOSSES or 200 in found, "a loop that answers takes settings"
