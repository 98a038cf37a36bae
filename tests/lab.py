"""A real lab for the tests: `svsa serve` in a separate process, on a free loopback port."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NamedTuple

import httpx

from tests.waiting import PATIENCE_S

PROGRAM = "from svsa.cli import main; main()"
START_TIMEOUT_S = 600.0
END_TIMEOUT_S = 60.0


class Lab(NamedTuple):
    """A running lab: address, client, process and folder. `process` is None for a lab in this
    process.
    """

    url: str
    client: httpx.Client
    process: subprocess.Popen[str] | None
    data: Path

    @property
    def session(self) -> str:
        """The path of the shared session."""
        return "/api/v1/sessions/lab"

    @property
    def stream_url(self) -> str:
        """The WebSocket of the shared session."""
        return self.url.replace("http", "ws", 1) + self.session + "/stream"

    def read(self) -> dict:
        """Return the state of the session."""
        return self.client.get(self.session).raise_for_status().json()

    def load_figure(self, figure: str = "4a", law: str = "ndobc", load: bool = False) -> dict:
        """Restart on a figure of the paper, at normal speed."""
        self.client.put(self.session + "/speed", json={"speed": 1}).raise_for_status()
        request = {"figure": figure, "law": law, "load": load}
        answer = self.client.post(self.session + "/experiment", json=request)
        return answer.raise_for_status().json()

    def restart(self) -> None:
        """On Figure 4A: one lane, no load, no recording."""
        self.client.delete(self.session + "/recording")
        self.client.put(self.session + "/lanes", json={"comparisons": []}).raise_for_status()
        self.load_figure()

    def jump(self, seconds: float) -> dict:
        """Pause, and run this session time as fast as possible, or until a fault."""
        state = self.client.post(self.session + "/pause").raise_for_status().json()
        for _ in range(round(seconds)):
            if state["status"] == "fault":
                break
            answer = self.client.post(self.session + "/step", json={"ticks": 1000})
            state = answer.raise_for_status().json()
        return state


@contextlib.contextmanager
def run_lab(
    *arguments: str,
    secret: str | None = None,
    port: int = 0,
    program: str = PROGRAM,
    within: Sequence[str] = (),
    lines: list[str] | None = None,
    **settings: str,
) -> Iterator[Lab]:
    """Start a lab, wait until it says where it is, and stop it at the end.

    program: Python code that runs `svsa`. within: a command that runs the given command. lines:
    receives what the lab prints until it is started. settings: SVSA_… variables, in lower case;
    runs are stored in a new folder unless `data` names one.
    """
    if "data" not in settings:
        with (
            tempfile.TemporaryDirectory(prefix="svsa-test-") as folder,
            run_lab(
                *arguments,
                secret=secret,
                port=port,
                program=program,
                within=within,
                lines=lines,
                data=folder,
                **settings,
            ) as lab,
        ):
            yield lab
        return
    environment = {k: v for k, v in os.environ.items() if k != "SVSA_SECRET"}
    environment |= {"PYTHONUNBUFFERED": "1", "NO_COLOR": "1", "COLUMNS": "200"}
    environment |= {f"SVSA_{name.upper()}": value for name, value in settings.items()}
    if secret is not None:
        environment["SVSA_SECRET"] = secret
    command = [*within, sys.executable, "-c", program, "serve"]
    process = subprocess.Popen(
        [*command, "--port", str(port), *arguments],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
    )
    guard = threading.Timer(START_TIMEOUT_S, process.kill)
    guard.start()
    try:
        found_port = _wait_for_port(process, [] if lines is None else lines)
        guard.cancel()
        url = f"http://127.0.0.1:{found_port}"
        headers = {"Authorization": f"Bearer {secret}"} if secret else None
        with httpx.Client(
            base_url=url, headers=headers, timeout=PATIENCE_S, trust_env=False
        ) as client:
            yield Lab(url, client, process, Path(settings["data"]))
    finally:
        guard.cancel()
        end(process)


def end(process: subprocess.Popen[str]) -> None:
    """Interrupt the process as Ctrl-C does, unless it has ended; it must end by then."""
    if process.poll() is not None:
        return
    process.send_signal(signal.SIGINT)
    try:
        assert process.wait(END_TIMEOUT_S) in (0, 130)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        raise


def _wait_for_port(process: subprocess.Popen[str], lines: list[str]) -> str:
    assert process.stdout is not None
    for line in process.stdout:
        lines.append(line)
        if found := re.search(r"SVSA Lab is at http://[^:]+:(\d+)/", line):
            return found.group(1)
    raise AssertionError("the lab did not start:\n" + "".join(lines))
