"""The 3D view over a slow link: slow clients are served, those that receive nothing are not."""

import math
from collections.abc import Iterator

import msgspec
import pytest
from websockets.sync.client import ClientConnection, connect

from tests.benchmarks.attacks import is_held, open_websocket
from tests.lab import Lab, run_lab
from tests.server.scene.viewed_lab import CAMERA, LINK, SUBPROTOCOL, decode_scene
from tests.slow_link import SlowLink, open_slow_link
from tests.waiting import PATIENCE_S, wait_until

pytestmark = [pytest.mark.exhaustive, pytest.mark.wall_clock]

RATE_BPS = 10_000
"""Of 560 kB, which take longer than the timeouts of 20 s and of the keepalive. 350 kB of poses are
made meanwhile.
"""
MAX_OLD_BYTES = 100_000


@pytest.fixture(scope="module")
def running() -> Iterator[Lab]:
    with run_lab(silence_s="4") as lab:
        sine = {"kind": "sine", "amplitude_rad": 0.5, "frequency_hz": 0.2}
        lab.client.put(lab.session + "/position", json=sine).raise_for_status()
        yield lab


def open_view(link: SlowLink) -> ClientConnection:
    view = connect(
        link.url.replace("http", "ws", 1) + "/viser/lab/",
        subprotocols=[SUBPROTOCOL],
        compression=None,
        proxy=None,
        max_size=None,
        open_timeout=PATIENCE_S,
        ping_interval=None,
    )
    view.send(msgspec.msgpack.encode(CAMERA))
    return view


def read_angle(message: dict) -> float:
    """Return the angle of the link, rad; not a number for another message."""
    if message["type"] != "SetOrientationMessage" or message["name"] != LINK:
        return math.nan
    w, *xyz = message["wxyz"]
    return 2.0 * math.atan2(math.copysign(math.hypot(*xyz), sum(xyz)), w)


def test_slow_view_receives_the_scene_and_soon_the_newest_pose(running: Lab) -> None:
    running.client.post(running.session + "/start").raise_for_status()
    with open_slow_link(running.url, RATE_BPS, 0.4) as link, open_view(link) as view:
        received = 0

        def read() -> list[dict]:
            nonlocal received
            message = view.recv(timeout=PATIENCE_S)
            assert isinstance(message, bytes)
            received += len(message)
            return decode_scene(message)

        while not any(math.isfinite(read_angle(message)) for message in read()):
            pass
        assert received > 500_000
        running.client.post(running.session + "/pause").raise_for_status()
        angle, received = running.read()["sample"]["position_rad"], 0
        while not any(abs(abs(read_angle(message)) - abs(angle)) < 1e-5 for message in read()):
            pass
        assert received < MAX_OLD_BYTES


def test_view_that_receives_nothing_is_disconnected(running: Lab) -> None:
    protocol = f"Sec-WebSocket-Protocol: {SUBPROTOCOL}\r\n"
    view = open_websocket(running, "/viser/lab/", protocol, 4096)
    assert is_held(view)
    wait_until(lambda: not is_held(view))
    view.close()
