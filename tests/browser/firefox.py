"""Firefox by WebDriver BiDi over its WebSocket, without a driver."""

import base64
import contextlib
import itertools
import json
import os
import re
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, NoReturn

import pytest
from websockets.sync.client import ClientConnection, connect

LONG_S = 240.0
BETWEEN_LOOKS_S = 0.1
LARGEST_MESSAGE = 1 << 26
# No start page, and no requests to other sites.
PREFERENCES: Mapping[str, object] = {
    "app.update.disabledForTesting": True,
    "browser.aboutwelcome.enabled": False,
    "browser.shell.checkDefaultBrowser": False,
    "browser.startup.homepage_override.mstone": "ignore",
    "datareporting.policy.dataSubmissionEnabled": False,
    "network.captive-portal-service.enabled": False,
    "network.connectivity-service.enabled": False,
    "network.proxy.type": 0,
    "remote.active-protocols": 1,
    "toolkit.telemetry.reportingpolicy.firstRun": False,
    "webgl.force-enabled": True,
}

# Code points of WebDriver.
KEYS: Mapping[str, str] = {
    "Enter": "\ue007",
    "Shift": "\ue008",
    "Escape": "\ue00c",
    "PageUp": "\ue00e",
    "PageDown": "\ue00f",
    "ArrowUp": "\ue013",
    "ArrowDown": "\ue015",
    "Delete": "\ue017",
}


def find_firefox() -> str:
    """Return the path of a Firefox on this machine; skips if there is none.

    With `SVSA_MUST_FIREFOX` set, the test fails instead.
    """
    named = os.environ.get("SVSA_FIREFOX")
    path = named or shutil.which("firefox-esr") or shutil.which("firefox")
    if path is None:
        _leave_out("no Firefox: install it (Debian: `apt install firefox-esr`) for this test")
    return path


def _leave_out(reason: str) -> NoReturn:
    if os.environ.get("SVSA_MUST_FIREFOX"):
        pytest.fail(reason)
    pytest.skip(reason)


class Firefox:
    """One window of a running Firefox."""

    def __init__(self, connection: ClientConnection) -> None:
        self._connection = connection
        self._numbers = itertools.count(1)
        self._send("session.new", capabilities={})
        (tree, *_) = self._send("browsingContext.getTree")["contexts"]
        self._window = tree["context"]

    def _send(self, method: str, **parameters: object) -> dict[str, Any]:
        number = next(self._numbers)
        self._connection.send(json.dumps({"id": number, "method": method, "params": parameters}))
        while True:
            answer = json.loads(self._connection.recv(LONG_S))
            if answer.get("id") != number:
                continue  # an event
            if answer["type"] == "error":
                raise RuntimeError(f"{method}: {answer['message']}")
            return answer["result"]

    def resize(self, width: int, height: int) -> None:
        """Set the size of the page, in CSS pixels."""
        size = {"width": width, "height": height}
        self._send("browsingContext.setViewport", context=self._window, viewport=size)

    def open(self, url: str) -> None:
        """Open an address, and wait until it is loaded."""
        self._send("browsingContext.navigate", context=self._window, url=url, wait="complete")

    def evaluate(self, expression: str) -> Any:
        """Return the value of an expression in the page, or of its promise."""
        answer = self._send(
            "script.evaluate",
            expression=f"Promise.resolve({expression}).then((it) => JSON.stringify(it ?? null))",
            target={"context": self._window},
            awaitPromise=True,
        )
        if answer["type"] == "exception":
            raise RuntimeError(answer["exceptionDetails"]["text"])
        return json.loads(answer["result"]["value"])

    def wait_for(self, expression: str) -> None:
        """Wait until an expression is true in the page."""
        end = time.monotonic() + LONG_S
        while not self.evaluate(f"!!({expression})"):
            if time.monotonic() > end:
                raise AssertionError(f"not true within {LONG_S:g} s: {expression}")
            time.sleep(BETWEEN_LOOKS_S)

    def press(self, key: str) -> None:
        """Press a key such as `Shift+ArrowUp`, or type a character."""
        parts = key.split("+") if len(key) > 1 else [key]
        values = [KEYS.get(part, part) for part in parts]
        downs = [{"type": "keyDown", "value": value} for value in values]
        ups = [{"type": "keyUp", "value": value} for value in reversed(values)]
        self._act({"type": "key", "id": "keyboard", "actions": downs + ups})

    def turn_wheel(self, x: int, y: int) -> None:
        """Turn the wheel of a mouse at this place of the page by one notch, up."""
        scroll = {"type": "scroll", "x": x, "y": y, "deltaX": 0, "deltaY": -100}
        self._act({"type": "wheel", "id": "wheel", "actions": [scroll]})

    def _act(self, source: dict[str, Any]) -> None:
        self._send("input.performActions", context=self._window, actions=[source])

    def take_screenshot(self) -> bytes:
        """Return the page as PNG."""
        answer = self._send("browsingContext.captureScreenshot", context=self._window)
        return base64.b64decode(answer["data"])


@contextlib.contextmanager
def run_display() -> Iterator[str]:
    """Run a display for Firefox, which draws WebGL in a window only: the X server without a screen.

    Skips where there is no Xvfb, unless `SVSA_MUST_FIREFOX` is set.
    """
    path = shutil.which("Xvfb")
    if path is None:
        _leave_out("no Xvfb: install it (Debian: `apt install xvfb`) for WebGL in Firefox")
    reading, writing = os.pipe()
    screen = ("-screen", "0", "1600x1200x24", "-nolisten", "tcp")
    process = subprocess.Popen(
        [path, "-displayfd", str(writing), *screen], pass_fds=(writing,), stderr=subprocess.DEVNULL
    )
    os.close(writing)
    try:
        with os.fdopen(reading) as answer:
            number = answer.readline().strip()
        assert number, "Xvfb did not start"
        yield f":{number}"
    finally:
        _end(process)


@contextlib.contextmanager
def run_firefox(path: str, display: str | None = None, **preferences: object) -> Iterator[Firefox]:
    """Start Firefox with its own profile, and end it.

    display: the display of its window; without it, Firefox has no window and no WebGL. preferences:
    those of about:config, with `_` in place of each dot.
    """
    with tempfile.TemporaryDirectory(prefix="svsa-firefox-", ignore_cleanup_errors=True) as folder:
        chosen = PREFERENCES | {name.replace("_", "."): one for name, one in preferences.items()}
        lines = (f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in chosen.items())
        Path(folder, "user.js").write_text("".join(lines), encoding="utf-8")
        environment = os.environ | {"HOME": folder} | ({"DISPLAY": display} if display else {})
        command = [path, "--no-remote", "--profile", folder, *([] if display else ["--headless"])]
        process = subprocess.Popen(
            [*command, "--remote-debugging-port", "0", "about:blank"],
            env=environment,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            url = _wait_for_address(process)
            # Without pings: Firefox answers none while it is busy with a page.
            options = {"open_timeout": LONG_S, "ping_interval": None, "proxy": None}
            with connect(f"{url}/session", max_size=LARGEST_MESSAGE, **options) as connection:
                yield Firefox(connection)
        finally:
            _end(process)


def _end(process: subprocess.Popen[Any]) -> None:
    process.terminate()
    try:
        process.wait(LONG_S)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()


def _wait_for_address(process: subprocess.Popen[str]) -> str:
    lines = []
    assert process.stderr is not None
    for line in process.stderr:
        lines.append(line)
        if found := re.search(r"WebDriver BiDi listening on (ws://\S+)", line):
            return found.group(1)
    raise AssertionError("Firefox did not start:\n" + "".join(lines))
