"""The start of a bench's loop: the server waits while it progresses, and handles requests."""

import io
import types

import numba
import pytest
from rich.console import Console

from svsa.hardware.realtime import launch
from svsa.hardware.realtime.launch import BenchError, BenchProcesses
from svsa.hardware.realtime.link import LinkClosedError
from svsa.numerics.compilation import watch_compilation
from svsa.runs.definition.paper import get_figure
from svsa_server.sessions.bench_start import show_steps


class ScriptedLink:
    """Sends each message at its time. is_gone: the loop has ended before it receives anything."""

    is_gone = False

    def __init__(self, messages):
        self.now, self._messages, self.sent = 0.0, list(messages), []

    def rest(self, seconds):
        self.now += seconds

    def receive(self):
        due = [message for at, message in self._messages if at <= self.now]
        self._messages = self._messages[len(due) :]
        if "closed" in due:
            raise LinkClosedError("the other side has closed")
        return due

    def send(self, message):
        self.sent.append(message)
        if message.get("do") == "end" or self.is_gone:
            raise LinkClosedError("gone")

    def close(self):
        pass


@pytest.fixture
def start(monkeypatch):
    """Start a bench whose loop sends these messages, and return the reports."""

    def begin(messages, silence_s):
        link, reported = ScriptedLink(messages), []
        theirs = types.SimpleNamespace(fileno=lambda: 0, close=lambda: None)
        process = types.SimpleNamespace(
            poll=lambda: None, wait=lambda: 0, terminate=lambda: None, kill=lambda: None
        )
        monkeypatch.setattr(launch, "build_links", lambda: (link, theirs))
        monkeypatch.setattr(launch, "_start", lambda *_: process)
        absent = types.SimpleNamespace(stop=lambda _: None)
        monkeypatch.setattr(launch, "_watch", lambda *_: absent)
        monkeypatch.setattr(launch, "time", types.SimpleNamespace(monotonic=lambda: link.now))
        configuration = get_figure("4a").build_configuration()
        processes = BenchProcesses("bench.toml", configuration, link.rest)
        assert [*link.sent[0]] == ["configuration"], "a server that starts may be long in asking"
        try:
            processes.wait_until_ready(silence_s, lambda *what: reported.append(what))
        except BenchError as error:
            assert processes.failure == str(error), "a later request gets the reason, too"
            raise
        return processes, reported

    return begin


def starting(step):
    return {"event": "starting", "step": step}


def test_progressing_loop_is_waited_for_with_its_progress(start):
    compiling = [(50.0 * n, starting(f"compiling, {n} functions")) for n in range(1, 8)]
    state = {"event": "state"}
    processes, reported = start(
        [*compiling, (380.0, {"event": "ready", "notes": []}), (380, state)], 60
    )
    assert processes.events == [state], "what it says once it is ready is kept"
    assert ("compiling, 7 functions", pytest.approx(360.0, abs=1.0)) in reported
    assert reported[0] == ("starting its process", 0.0)
    processes.end()
    processes.free()


def test_stalled_loop_is_abandoned_with_its_last_step(start):
    with pytest.raises(BenchError, match=r"not got on for 60 s.*opening the bus.*start_silence_s"):
        start([(1.0, starting("opening the bus"))], 60.0)


def test_ended_loop_is_not_waited_for(start):
    with pytest.raises(BenchError, match="ended while it was opening the bus"):
        start([(1.0, starting("opening the bus")), (2.0, "closed")], 1e9)


def test_bench_that_cannot_be_opened_reports_the_reason(start):
    with pytest.raises(BenchError, match="no adapter"):
        start([(1.0, {"event": "failed", "message": "no adapter"})], 60.0)


def test_loop_that_ended_before_the_first_message_has_its_reason(start, monkeypatch):
    monkeypatch.setattr(ScriptedLink, "is_gone", True)
    with pytest.raises(BenchError, match="no adapter"):
        start([(0.0, {"event": "failed", "message": "no adapter"})], 60.0)


def test_every_compiled_function_is_reported_once():
    @numba.njit
    def double(x):
        return 2.0 * x

    names = []
    with watch_compilation(names.append):
        double(1.0)
        double(2.0)
    assert names.count("double") == 1


def test_log_gets_a_line_every_ten_seconds():
    console = Console(file=io.StringIO(), force_terminal=False, width=100)
    report = show_steps(console)
    for second in range(25):
        report("compiling the loop", float(second))
    lines = console.file.getvalue().splitlines()
    assert [line for line in lines if line] == [
        "The bench is compiling the loop (10 s) …",
        "The bench is compiling the loop (20 s) …",
    ]
