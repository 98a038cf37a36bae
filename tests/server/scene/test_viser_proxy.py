"""Messages between a browser and viser: the page and a camera, and no others."""

import asyncio
import math
from typing import Any

import httpx
import msgspec
import pytest
import viser
import websockets

from svsa_server.scene.viser_proxy import filter_browser_message
from tests.server.scene.poses import make_pose
from tests.server.scene.viewed_lab import (
    CAMERA,
    LINK,
    SUBPROTOCOL,
    Lab,
    receive_until,
    run_in_lab,
    wait_for,
)
from tests.waiting import PATIENCE_S

FORGED: list[dict[str, Any]] = [
    {"type": "RemoveSceneNodeMessage", "name": LINK, "owner": ""},
    {"type": "SetPositionMessage", "name": LINK, "position": [9.0, 9.0, 9.0]},
    {"type": "GuiUpdateMessage", "uuid": "x", "updates": {"value": 1}},
    {"type": "RunJavascriptMessage", "source": "alert(1)"},
    {"type": "ShareUrlRequest"},
    {"type": "FileTransferStartUpload", "filename": "x", "size_bytes": 1, "part_count": 1},
    {**CAMERA, "name": LINK},
    {**CAMERA, "fov": math.nan},
    {**CAMERA, "position": [0.0, math.inf, 0.0]},
    {**CAMERA, "position": "xyz"},
]


def open_client(lab: Lab) -> httpx.AsyncClient:
    """Return a client of REST; the first answer waits for the start of viser."""
    return httpx.AsyncClient(base_url=lab.http, timeout=PATIENCE_S, trust_env=False)


def test_page_is_served_with_focus_injected_and_compressed_on_request() -> None:
    async def check(lab: Lab) -> None:
        async with open_client(lab) as client:
            plain = await client.get("/viser/lab/", headers={"Accept-Encoding": "identity"})
            packed = await client.get("/viser/lab/", headers={"Accept-Encoding": "gzip"})
            again = await client.get(
                "/viser/lab/", headers={"If-None-Match": plain.headers["etag"]}
            )
            short = await client.get("/viser/lab?darkMode")
            absent = await client.get("/viser/lab/absent.js")
            outside = await client.get("/viser/lab/%2e%2e/%2e%2e/__init__.py")
        assert plain.status_code == 200
        assert "document.hasFocus=()=>true" in plain.text
        assert '<html translate="no"' in plain.text
        assert plain.headers["content-type"].startswith("text/html")
        assert "content-encoding" not in plain.headers
        assert packed.headers["content-encoding"] == "gzip"
        assert packed.text == plain.text
        assert int(packed.headers["content-length"]) < len(plain.content)
        assert (again.status_code, again.content) == (304, b"")
        assert short.headers["location"] == "/viser/lab/?darkMode"
        assert absent.status_code == outside.status_code == 404

    run_in_lab(check)


def test_only_the_camera_of_a_browser_reaches_viser(monkeypatch: pytest.MonkeyPatch) -> None:
    received: list[str] = []
    original = viser.infra.WebsockMessageHandler._handle_incoming_message

    async def record(self: Any, client_id: Any, message: Any) -> None:
        received.append(type(message).__name__)
        await original(self, client_id, message)

    monkeypatch.setattr(viser.infra.WebsockMessageHandler, "_handle_incoming_message", record)

    async def check(lab: Lab) -> None:
        async with lab.connect() as browser, lab.connect() as other:
            for forged in FORGED:
                await browser.send(msgspec.msgpack.encode(forged))
            await browser.send("text")
            await browser.send(b"\xc1 not msgpack")
            await browser.send(msgspec.msgpack.encode(CAMERA))
            await other.send(msgspec.msgpack.encode(CAMERA))
            await wait_for(lambda: lab.bridge.viewers == 2)
            lab.poses["lab"] = make_pose(0.5)
            await receive_until(
                other, lambda m: m["type"] == "SetOrientationMessage" and m["name"] == LINK
            )
        assert set(received) == {"ViewerCameraMessage"}

    run_in_lab(check)


@pytest.mark.parametrize("forged", FORGED, ids=lambda message: message["type"])
def test_filter_drops_everything_but_complete_camera_messages(forged: dict[str, Any]) -> None:
    assert filter_browser_message(msgspec.msgpack.encode(forged)) is None


def test_filter_writes_the_camera_again() -> None:
    smuggled = b"\x8b" + msgspec.msgpack.encode({"type": "ShareUrlRequest"})[1:]
    smuggled += msgspec.msgpack.encode(CAMERA)[1:]
    kept = filter_browser_message(smuggled)
    assert kept is None or msgspec.msgpack.decode(kept) == CAMERA
    passed = filter_browser_message(msgspec.msgpack.encode(CAMERA))
    assert passed is not None
    assert msgspec.msgpack.decode(passed) == CAMERA


def test_other_sites_and_other_protocols_are_rejected() -> None:
    async def check(lab: Lab) -> None:
        with pytest.raises(websockets.InvalidStatus) as refused:
            async with lab.connect(origin="http://elsewhere.example"):
                pass
        assert refused.value.response.status_code == 403
        with pytest.raises(websockets.InvalidStatus):
            async with websockets.connect(
                lab.http.replace("http", "ws") + "/viser/lab/", compression=None, proxy=None
            ):
                pass
        async with lab.connect(origin=lab.http) as browser:
            assert browser.subprotocol == SUBPROTOCOL

    run_in_lab(check)


def test_oversized_message_ends_the_connection() -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect() as browser:
            await browser.send(bytes(100_000))
            with pytest.raises(websockets.ConnectionClosed) as closed:
                await receive_until(browser, lambda _: False)
            assert closed.value.rcvd is not None
            assert closed.value.rcvd.code == 1009

    run_in_lab(check)


def test_browser_is_notified_when_viser_ends() -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect() as browser:
            await receive_until(browser, lambda m: m.get("name") == LINK)
            await asyncio.to_thread(lab.bridge.stop)
            with pytest.raises(websockets.ConnectionClosed) as closed:
                await receive_until(browser, lambda _: False)
            assert closed.value.rcvd is not None
            assert closed.value.rcvd.code == 1001
        async with open_client(lab) as client:
            assert (await client.get("/viser/lab/")).status_code == 503

    run_in_lab(check)


def test_no_public_tunnel_can_be_opened() -> None:
    async def check(lab: Lab) -> None:
        await lab.scenes.open("lab")
        assert lab.bridge._viser.request_share_url() is None

    run_in_lab(check)
