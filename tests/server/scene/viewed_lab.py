"""A running server with the 3D view, and browsers that only speak its protocol."""

import asyncio
import contextlib
from collections.abc import AsyncIterator, Callable
from typing import Any
from unittest.mock import patch

import msgspec
import uvicorn
import viser
import websockets
import zstandard
from starlette.applications import Starlette
from websockets.asyncio.client import ClientConnection

from svsa.runs.session.session import Session
from svsa_scene import ActuatorPose
from svsa_server.scene.bridge import SceneBridge
from svsa_server.scene.scenes import Scenes
from svsa_server.scene.viser_proxy import ViserProxy
from svsa_server.sessions.laboratory import Laboratory, build_shared_session
from tests.server.scene.poses import make_pose
from tests.waiting import PATIENCE_S

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


class Lab:
    """A running server with the 3D view, and its addresses."""

    def __init__(self, laboratory: Laboratory, scenes: Scenes) -> None:
        self.http = ""
        self.laboratory = laboratory
        self.scenes = scenes
        self.poses = {"lab": make_pose()}
        self.reads = 0

    @property
    def bridge(self) -> SceneBridge:
        """Return viser of the shared session."""
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
            open_timeout=PATIENCE_S,
        )


@contextlib.asynccontextmanager
async def running_lab() -> AsyncIterator[Lab]:
    laboratory = Laboratory(build_shared_session(None), max_sessions=2, idle_s=60.0, control_s=15.0)
    scenes = Scenes(laboratory)
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
        with patch("svsa_server.scene.scenes.read_pose", lab.read_pose):
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
        async with asyncio.timeout(PATIENCE_S), running_lab() as lab:
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
