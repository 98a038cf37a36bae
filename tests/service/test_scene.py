"""The 3D view through the server's address: what reaches a browser, and what a browser may send."""

import asyncio
import contextlib
import math
from collections.abc import AsyncIterator, Callable
from typing import Any
from unittest.mock import patch

import httpx
import msgspec
import pytest
import uvicorn
import viser
import websockets
import zstandard
from starlette.applications import Starlette
from websockets.asyncio.client import ClientConnection

from svsa.experiment.paper import get_figure
from svsa.runtime.session import Session
from svsa_scene import ActuatorPose
from svsa_scene.linkage import RADIUS, compute_linkage
from svsa_server.laboratory import Laboratory, build_shared_session
from svsa_server.scene_bridge import SceneBridge
from svsa_server.scenes import Scenes
from svsa_server.viser_proxy import ViserProxy, filter_browser_message
from tests.service.poses import make_pose

SUBPROTOCOL = websockets.Subprotocol(f"viser-v{viser.__version__}")
LINK = "/a/l"
CAMERA: dict[str, Any] = {
    "type": "ViewerCameraMessage",
    "wxyz": [1, 0, 0, 0],
    "position": [3.0, 2.0, 1.0],
    "fov": 0.5,
    "near": 0.1,
    "far": 60,
    "image_height": 430,
    "image_width": 620,
    "look_at": [0, 0, 0],
    "up_direction": [0, 0, 1],
}
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


class Lab:
    """A running server with the 3D view, and how to reach it."""

    def __init__(self, laboratory: Laboratory, scenes: Scenes) -> None:
        self.http = ""
        self.laboratory = laboratory
        self.scenes = scenes
        self.poses = {"lab": make_pose()}
        self.reads = 0

    @property
    def bridge(self) -> SceneBridge:
        """viser of the shared session."""
        return self.scenes.views["lab"].bridge

    def read_pose(self, session: Session) -> ActuatorPose | None:
        self.reads += 1
        return self.poses.get(session.name)

    def connect(self, origin: str | None = None, path: str = "/viser/lab/") -> Any:
        return websockets.connect(
            self.http.replace("http", "ws") + path,
            subprotocols=[SUBPROTOCOL],
            origin=None if origin is None else websockets.Origin(origin),
            compression=None,
            proxy=None,
            max_size=None,
        )


@contextlib.asynccontextmanager
async def running_lab() -> AsyncIterator[Lab]:
    laboratory = Laboratory(
        build_shared_session(None), most_sessions=2, idle_s=60.0, control_s=15.0
    )
    scenes = Scenes(laboratory)
    await scenes.open("lab")
    proxy = ViserProxy(scenes.open)
    app = Starlette(routes=proxy.routes)
    server = uvicorn.Server(
        uvicorn.Config(app, host="127.0.0.1", port=0, log_level="warning", lifespan="off")
    )
    serving = asyncio.create_task(server.serve())
    while not server.started:
        await asyncio.sleep(0.01)
    lab = Lab(laboratory, scenes)
    lab.http = f"http://127.0.0.1:{server.servers[0].sockets[0].getsockname()[1]}"
    showing = asyncio.create_task(scenes.run())
    try:
        with patch("svsa_server.scenes.read_pose", lab.read_pose):
            yield lab
    finally:
        showing.cancel()
        await asyncio.gather(showing, return_exceptions=True)
        await scenes.close()
        laboratory.close()
        server.should_exit = True
        await serving
        await proxy.close()


def run_in_lab(check: Callable[[Lab], Any]) -> None:
    async def run() -> None:
        async with asyncio.timeout(20.0), running_lab() as lab:
            await check(lab)

    asyncio.run(run())


def decode_scene(message: bytes) -> list[dict[str, Any]]:
    size = int.from_bytes(message[:8], "little")
    packed = int.from_bytes(message[8:16], "little")
    inner = zstandard.ZstdDecompressor().decompress(message[16 : 16 + packed], size)
    return msgspec.msgpack.decode(inner)["messages"]


async def receive_until(
    connection: ClientConnection, wanted: Callable[[dict[str, Any]], bool]
) -> dict[str, Any]:
    while True:
        for message in decode_scene(await connection.recv(decode=False)):
            if wanted(message):
                return message


async def wait_for(condition: Callable[[], bool]) -> None:
    while not condition():
        await asyncio.sleep(0.01)


def test_page_is_served_with_focus_injected_and_compressed_on_request() -> None:
    async def check(lab: Lab) -> None:
        async with httpx.AsyncClient(base_url=lab.http, trust_env=False) as client:
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
        assert plain.headers["content-type"].startswith("text/html")
        assert "content-encoding" not in plain.headers
        assert packed.headers["content-encoding"] == "gzip"
        assert packed.text == plain.text
        assert int(packed.headers["content-length"]) < len(plain.content)
        assert (again.status_code, again.content) == (304, b"")
        assert short.headers["location"] == "/viser/lab/?darkMode"
        assert absent.status_code == outside.status_code == 404

    run_in_lab(check)


@pytest.mark.parametrize("path", ["/viser/lab/", "/viser/lab"])
def test_websocket_shows_the_scene_and_follows_the_pose(path: str) -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect(path=path) as browser:
            assert browser.subprotocol == SUBPROTOCOL
            await receive_until(browser, lambda m: m.get("name") == LINK)
            await browser.send(msgspec.msgpack.encode(CAMERA))
            await wait_for(lambda: lab.reads > 0)
            lab.poses["lab"] = make_pose(1.0)
            turned = await receive_until(
                browser,
                lambda m: (
                    m["type"] == "SetOrientationMessage" and m["name"] == LINK and m["wxyz"][3] > 0
                ),
            )
            assert turned["wxyz"] == pytest.approx([math.cos(0.5), 0, 0, math.sin(0.5)])
        await wait_for(lambda: lab.bridge.viewers == 0)

    run_in_lab(check)


def test_a_private_session_has_a_view_of_its_own_that_ends_with_it() -> None:
    async def check(lab: Lab) -> None:
        private = lab.laboratory.create(get_figure("4a").build_configuration()).name
        lab.poses[private] = make_pose(-1.0)
        async with lab.connect() as shared, lab.connect(path=f"/viser/{private}/") as own:
            assert set(lab.scenes.views) == {"lab", private}
            await own.send(msgspec.msgpack.encode(CAMERA))
            turned = await receive_until(
                own, lambda m: m["type"] == "SetOrientationMessage" and m["name"] == LINK
            )
            assert turned["wxyz"][3] < 0
            await receive_until(shared, lambda m: m.get("name") == LINK)
            lab.laboratory.end(private)
            with pytest.raises(websockets.ConnectionClosed):
                await receive_until(own, lambda _: False)
        assert set(lab.scenes.views) == {"lab"}
        with pytest.raises(websockets.InvalidStatus):
            async with lab.connect(path=f"/viser/{private}/"):
                pass

    run_in_lab(check)


def test_a_private_view_that_nobody_looks_at_ends(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("svsa_server.scenes.IDLE_S", 0.2)

    async def check(lab: Lab) -> None:
        private = lab.laboratory.create(get_figure("4a").build_configuration()).name
        async with lab.connect(path=f"/viser/{private}/") as own:
            await own.send(msgspec.msgpack.encode(CAMERA))
            await wait_for(lambda: lab.scenes.views[private].bridge.viewers == 1)
            await asyncio.sleep(0.5)
            assert private in lab.scenes.views
        await wait_for(lambda: set(lab.scenes.views) == {"lab"})

    run_in_lab(check)


def test_nothing_is_read_while_nobody_watches() -> None:
    async def check(lab: Lab) -> None:
        await asyncio.sleep(0.15)
        assert lab.reads == 0

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
def test_filter_drops_everything_but_a_whole_camera(forged: dict[str, Any]) -> None:
    assert filter_browser_message(msgspec.msgpack.encode(forged)) is None


def test_filter_writes_the_camera_anew() -> None:
    smuggled = b"\x8b" + msgspec.msgpack.encode({"type": "ShareUrlRequest"})[1:]
    smuggled += msgspec.msgpack.encode(CAMERA)[1:]
    kept = filter_browser_message(smuggled)
    assert kept is None or msgspec.msgpack.decode(kept) == CAMERA
    passed = filter_browser_message(msgspec.msgpack.encode(CAMERA))
    assert passed is not None
    assert msgspec.msgpack.decode(passed) == CAMERA


def test_other_sites_and_other_protocols_are_refused() -> None:
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


def test_too_long_a_message_ends_the_connection() -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect() as browser:
            await browser.send(bytes(100_000))
            with pytest.raises(websockets.ConnectionClosed) as closed:
                await receive_until(browser, lambda _: False)
            assert closed.value.rcvd is not None
            assert closed.value.rcvd.code == 1009

    run_in_lab(check)


def test_browser_is_told_when_viser_goes_away() -> None:
    async def check(lab: Lab) -> None:
        async with lab.connect() as browser:
            await receive_until(browser, lambda m: m.get("name") == LINK)
            await asyncio.to_thread(lab.bridge.stop)
            with pytest.raises(websockets.ConnectionClosed) as closed:
                await receive_until(browser, lambda _: False)
            assert closed.value.rcvd is not None
            assert closed.value.rcvd.code == 1001
        async with httpx.AsyncClient(base_url=lab.http, trust_env=False) as client:
            assert (await client.get("/viser/lab/")).status_code == 503

    run_in_lab(check)


def test_no_public_tunnel_can_be_opened() -> None:
    async def check(lab: Lab) -> None:
        assert lab.bridge._viser.request_share_url() is None

    run_in_lab(check)


def test_lever_passes_through_the_pivot_at_the_lever_ratio() -> None:
    pose = make_pose(0.3, motor1_position_rad=0.1, lever_ratio=0.6)
    linkage = compute_linkage(pose)
    assert linkage.pivot_radius == pytest.approx(0.6 * RADIUS)
    assert linkage.deflection == pytest.approx(0.2)
    pivot_x = -linkage.pivot_radius * math.cos(0.2)
    pivot_y = linkage.pivot_radius * math.sin(0.2)
    assert math.tan(linkage.lever_angle) == pytest.approx(pivot_y / (pivot_x + RADIUS))
    assert linkage.block_offset == pytest.approx(RADIUS * math.tan(linkage.lever_angle))
    assert linkage.spring_left - linkage.spring_right == pytest.approx(2 * linkage.block_offset)
