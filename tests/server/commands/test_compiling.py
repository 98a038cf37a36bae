"""Unused laws and the loop of other actuators are compiled in parallel with the server."""

import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from svsa_server.commands import compiling
from svsa_server.commands.compiling import compile_laws
from svsa_server.compiled_loops import is_compiled_for
from tests.benchmarks.attacks import read_memory_mb
from tests.lab import run_lab
from tests.waiting import is_running, wait_until

WAIT = "import time; time.sleep(600)"


@pytest.fixture
def started(monkeypatch):
    """The started compiling processes."""
    processes: list[subprocess.Popen[bytes]] = []

    class Noted(subprocess.Popen[bytes]):
        def __init__(self, *arguments, **options):
            super().__init__(*arguments, **options)
            processes.append(self)

    monkeypatch.setattr(subprocess, "Popen", Noted)
    return processes


def test_nothing_is_started_if_every_law_is_compiled(started):
    with compile_laws():
        assert started == []


def test_loop_of_other_actuators_is_compiled_if_every_law_is_compiled(started, monkeypatch):
    monkeypatch.setattr(compiling, "is_compiled_for", lambda actuator, law: actuator == "svsa")
    monkeypatch.setattr(compiling, "PREPARE", WAIT)
    with compile_laws():
        assert len(started) == 1


def test_compiling_process_ends_with_the_server(started, monkeypatch):
    monkeypatch.setattr(compiling, "is_compiled_before", lambda control: False)
    monkeypatch.setattr(compiling, "PREPARE", WAIT)
    with compile_laws():
        (process,) = started
        assert process.args[-1].endswith(WAIT)
        assert process.poll() is None
    assert process.poll() is not None


IGNORE = "import pathlib, signal; signal.signal(signal.SIGTERM, signal.SIG_IGN); "


def test_compiling_process_that_does_not_end_is_killed(started, monkeypatch, tmp_path):
    ready = tmp_path / "ready"
    program = f"{IGNORE}pathlib.Path({str(ready)!r}).touch(); {WAIT}"
    monkeypatch.setattr(compiling, "is_compiled_before", lambda control: False)
    monkeypatch.setattr(compiling, "PREPARE", program)
    monkeypatch.setattr(compiling, "END_S", 0.1)
    with compile_laws():
        (process,) = started
        wait_until(ready.exists)
    assert process.poll() == -signal.SIGKILL


@pytest.mark.exhaustive
def test_program_compiles_all_laws_and_the_loop_of_other_actuators():
    done = subprocess.run(
        [sys.executable, "-c", compiling.PREPARE], check=False, capture_output=True
    )
    assert done.returncode == 0, done.stderr
    assert is_compiled_for(compiling.OTHER, "ndobc")


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> tuple[str, float]:
    """The folder of compiled code of a lab that found it empty, and the memory of this lab."""
    cache = str(tmp_path_factory.mktemp("cache"))
    return cache, measure_memory_mb(cache)


def measure_memory_mb(cache: str) -> float:
    with run_lab(cache=cache) as lab:
        lab.client.post("/api/v1/sessions", json={"law": "lqi"}).raise_for_status()
        return read_memory_mb(lab)


@pytest.mark.exhaustive
def test_server_that_has_compiled_is_as_small_as_one_that_has_loaded_its_code(compiled):
    """The compiler would leave 200 MB or more; 40 MB are left for what differs between starts."""
    cache, size_mb = compiled
    assert size_mb - measure_memory_mb(cache) < 40.0


@pytest.mark.exhaustive
def test_first_session_of_an_actuator_reports_how_long_it_waits(compiled):
    """A lab answers other requests while the loop is compiled."""
    opened = []
    with run_lab(cache=compiled[0]) as lab:
        assert lab.client.get("/api/v1/actuators/qbmove").json()["compiling_s"] is None

        def open_session():
            request = {"from": "actuator", "actuator": "qbmove"}
            opened.append(lab.client.post("/api/v1/sessions", json=request, timeout=None))

        thread = threading.Thread(target=open_session)
        thread.start()
        waited = []
        while thread.is_alive():
            waited.append(lab.client.get("/api/v1/actuators/qbmove").json()["compiling_s"])
            thread.join(0.2)
        assert opened[0].status_code == 201, opened[0].text
        times_s = {compiling_s for compiling_s in waited if compiling_s is not None}
        assert len(times_s) >= 3
        assert max(times_s) > 1.0
        assert lab.client.get("/api/v1/actuators/qbmove").json()["compiling_s"] is None


@contextmanager
def started_in_a_server(kind: str, folder: Path) -> Iterator[tuple[subprocess.Popen[bytes], int]]:
    """A process that compiles like a server, and the id of the process that it has started."""
    ready = folder / "pid"
    child = f"import os; open({str(ready)!r}, 'w').write(f'{{os.getpid()}};'); {WAIT}"
    start = {
        "first law": "compiling.COMPILE_FIRST = child; is_stored = lambda *_: False;"
        " compiling.is_compiled_before = is_stored; compiling.prepare_apart(print)",
        "other laws": "compiling.PREPARE = child; compiling._is_compiled = lambda _: False\n"
        "with compiling.compile_laws(): time.sleep(600)",
        "request": "compiled_loops.COMPILE = child; asyncio.run(compiled_loops._compile('ndobc'))",
        "function": "compiling._is_compiled = lambda _: True; from svsa.numerics import"
        " separate_compilation as apart, trigonometry; apart.CHILD = child;"
        " apart.compile_in_children(print); import threading\n"
        "with compiling.compile_laws():\n"
        "    threading.Thread(target=trigonometry.cos, args=(0.0,)).start(); time.sleep(600)",
    }[kind]
    program = (
        "import asyncio, time; from svsa_server import compiled_loops;"
        f" from svsa_server.commands import compiling; child = {child!r}\n{start}"
    )
    environment = os.environ | {"SVSA_CACHE": str(folder)}
    with subprocess.Popen([sys.executable, "-c", program], env=environment) as server:
        wait_until(lambda: ready.exists() and ready.read_text().endswith(";"))
        yield server, int(ready.read_text()[:-1])


@pytest.mark.exhaustive
@pytest.mark.parametrize("kind", ["first law", "other laws", "request"])
def test_compiling_process_ends_with_a_killed_server(kind, tmp_path):
    with started_in_a_server(kind, tmp_path) as (server, process):
        server.kill()
    wait_until(lambda: not is_running(process))


@pytest.mark.exhaustive
@pytest.mark.parametrize("kind", ["first law", "other laws", "function"])
def test_compiling_process_ends_before_a_terminated_server(kind, tmp_path):
    """Otherwise it writes to the cache, or to the folder of a test, when the server has ended."""
    with started_in_a_server(kind, tmp_path) as (server, process):
        server.terminate()
    assert server.returncode == -signal.SIGTERM
    assert not is_running(process)
