"""viser under the server's own address, at /viser/{session}/.

The page is forwarded with changes: its reconnect does not wait for the focus that a frame rarely
has, viser's panels are hidden, and translators leave it. Of a browser's messages only its camera is
forwarded: viser has no roles, and any browser could otherwise change the scene for all.
"""

import asyncio
import contextlib
import gzip
import hashlib
import math
import socket
import ssl
from collections.abc import Awaitable, Callable
from typing import NamedTuple

import httpx
import msgspec
import websockets
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response
from starlette.routing import BaseRoute, Route, WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect
from websockets.asyncio.client import ClientConnection
from websockets.typing import Subprotocol

from svsa.errors import SvsaError
from svsa_server.access.origin import is_same_origin
from svsa_server.access.owned import check_owned
from svsa_server.access.permissions import OBSERVER, allow
from svsa_server.security_headers import POLICY, VIEWER_POLICY

MAX_BROWSER_MESSAGE_BYTES = 4096
MAX_SCENE_MESSAGE_BYTES = 16 * 1024 * 1024
SCENE_BUFFER_BYTES = 8 * 1024
"""Each buffer between viser and the proxy: poses in it are old when a slow browser gets them."""
_CONNECT_TIMEOUT_S = 20.0
_NO_PEER = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
"""No peer verification: the connection to a port of this machine is not encrypted."""
_SUBPROTOCOL_PREFIX = "viser-v"
_INJECTED = (
    # viser takes a server, a recording and more from its address. Only what the lab's page sets is
    # kept, before any script of viser runs.
    b"<script>history.replaceState(null,'','?'+new URLSearchParams("
    b"[...new URLSearchParams(location.search)]"
    b".filter(([name])=>/^(darkMode|initialCamera[A-Z][A-Za-z]*)$/.test(name))))</script>"
    # viser reconnects only if the document has the focus, which a frame rarely has.
    b"<script>document.hasFocus=()=>true</script>"
    b"<style>[data-dock-root]>:not(:first-child),.mantine-Paper-root,"
    b".mantine-Notifications-root{display:none!important}</style>"
)


class ViewerCamera(
    msgspec.Struct, tag="ViewerCameraMessage", tag_field="type", forbid_unknown_fields=True
):
    """viser's camera message, the only one that a browser may send."""

    wxyz: tuple[float, float, float, float]
    position: tuple[float, float, float]
    fov: float
    near: float
    far: float
    image_height: int
    image_width: int
    look_at: tuple[float, float, float]
    up_direction: tuple[float, float, float]


_camera_decoder = msgspec.msgpack.Decoder(ViewerCamera)
_camera_encoder = msgspec.msgpack.Encoder()


def filter_browser_message(message: bytes) -> bytes | None:
    """The camera message in `message`, encoded again, or None for anything else."""
    try:
        camera = _camera_decoder.decode(message)
    except (msgspec.DecodeError, UnicodeDecodeError):
        return None
    numbers = (
        *camera.wxyz,
        *camera.position,
        *camera.look_at,
        *camera.up_direction,
        camera.fov,
        camera.near,
        camera.far,
    )
    if not all(map(math.isfinite, numbers)):
        return None
    # Encoded again from its validated fields, so that no other part of the message is forwarded.
    return _camera_encoder.encode(camera)


class _Page(NamedTuple):
    """viser's page as served: plain, compressed, and its entity tag (ETag)."""

    plain: bytes
    compressed: bytes
    etag: str


class _Ending(NamedTuple):
    """How to close a browser's connection: WebSocket close code and reason."""

    code: int
    reason: str


class ViserProxy:
    """Routes under /viser/ to the viser servers on loopback ports.

    `find_port` returns the port for a session's name, or raises `SvsaError` if there is no such
    session.
    """

    def __init__(self, find_port: Callable[[str], Awaitable[int]]) -> None:
        self._find_port = find_port
        self._http: httpx.AsyncClient | None = None
        self._page: _Page | None = None

    @property
    def routes(self) -> list[BaseRoute]:
        """Routes for the application: the page, which is viser's only file, and the WebSocket."""
        return [
            Route("/viser/{session}", self._redirect, methods=["GET"]),
            WebSocketRoute("/viser/{session}", self._relay),
            Route("/viser/{session}/", self._serve_page, methods=["GET"]),
            WebSocketRoute("/viser/{session}/", self._relay),
            Route("/viser/{session}/index.html", self._redirect, methods=["GET"]),
        ]

    async def close(self) -> None:
        """Close the connections to viser; the next request opens new ones."""
        if self._http is not None:
            await self._http.aclose()
            self._http = None

    @allow(OBSERVER)
    async def _redirect(self, request: Request) -> Response:
        query = f"?{request.url.query}" if request.url.query else ""
        folder = request.url.path.removesuffix("/index.html")
        return RedirectResponse(f"{folder}/{query}")

    @allow(OBSERVER)
    async def _serve_page(self, request: Request) -> Response:
        await check_owned("session", request.path_params["session"])
        if self._page is None:
            try:
                self._page = await self._load_page(request)
            except httpx.HTTPError:
                return Response("The 3D view is not running.", 503, media_type="text/plain")
        headers = {
            "ETag": self._page.etag,
            "Cache-Control": "no-cache",
            "Vary": "Accept-Encoding",
            POLICY: VIEWER_POLICY,
        }
        if request.headers.get("if-none-match") == self._page.etag:
            return Response(status_code=304, headers=headers)
        if "gzip" in request.headers.get("accept-encoding", ""):
            headers["Content-Encoding"] = "gzip"
            return Response(self._page.compressed, headers=headers, media_type="text/html")
        return Response(self._page.plain, headers=headers, media_type="text/html")

    async def _load_page(self, request: Request) -> _Page:
        answer = await self._fetch(request)
        answer.raise_for_status()
        plain = answer.content.replace(b"<head>", b"<head>" + _INJECTED, 1)
        # A browser's translator would replace the labels, which React then fails to update.
        plain = plain.replace(b"<html", b'<html translate="no"', 1)
        etag = f'"{hashlib.sha256(plain).hexdigest()[:32]}"'
        return _Page(plain, await asyncio.to_thread(gzip.compress, plain, 6), etag)

    async def _fetch(self, request: Request) -> httpx.Response:
        port = await self._find_port(request.path_params["session"])
        address = httpx.URL(scheme="http", host="127.0.0.1", port=port, path="/")
        if self._http is None:
            self._http = httpx.AsyncClient(
                verify=_NO_PEER, trust_env=False, timeout=_CONNECT_TIMEOUT_S
            )
        return await self._http.get(address, headers={"Accept-Encoding": "identity"})

    @allow(OBSERVER)
    async def _relay(self, websocket: WebSocket) -> None:
        offered = websocket.scope.get("subprotocols", [])
        protocol = next((p for p in offered if p.startswith(_SUBPROTOCOL_PREFIX)), None)
        if protocol is None or not is_same_origin(websocket.scope):
            await websocket.close(1008)
            return
        try:
            await check_owned("session", websocket.path_params["session"])
            port = await self._find_port(websocket.path_params["session"])
            viser = await _connect(port, protocol)
        except (SvsaError, OSError, TimeoutError, websockets.WebSocketException):
            await websocket.close(1013)
            return
        async with viser:
            await websocket.accept(subprotocol=protocol)
            ending = await _relay_both_ways(websocket, viser)
            if ending is not None:
                with contextlib.suppress(RuntimeError, WebSocketDisconnect):
                    await websocket.close(ending.code, ending.reason)


async def _connect(port: int, protocol: str) -> ClientConnection:
    """Connect to viser. Neither side ends the connection because the other is busy."""
    plain = socket.socket()
    try:
        plain.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, SCENE_BUFFER_BYTES)
        plain.setblocking(False)
        await asyncio.get_running_loop().sock_connect(plain, ("127.0.0.1", port))
        return await websockets.connect(
            f"ws://127.0.0.1:{port}/",
            sock=plain,
            subprotocols=[Subprotocol(protocol)],
            compression=None,
            # A proxy from the environment must not be used for the loopback.
            proxy=None,
            max_size=MAX_SCENE_MESSAGE_BYTES,
            max_queue=4,
            open_timeout=_CONNECT_TIMEOUT_S,
            ping_interval=None,
        )
    except BaseException:
        plain.close()
        raise


async def _relay_both_ways(websocket: WebSocket, viser: ClientConnection) -> _Ending | None:
    """Forward messages until either side ends; return how to close the browser's connection, if it
    is still open.

    Each direction buffers one message: a slow browser stops the reading from viser, which keeps
    only the newest pose of each part for it.
    """
    directions = [
        asyncio.create_task(_pass_scene(websocket, viser)),
        asyncio.create_task(_pass_camera(websocket, viser)),
    ]
    try:
        done, _ = await asyncio.wait(directions, return_when=asyncio.FIRST_COMPLETED)
        return next(iter(done)).result()
    finally:
        for direction in directions:
            direction.cancel()
        await asyncio.gather(*directions, return_exceptions=True)


async def _pass_scene(websocket: WebSocket, viser: ClientConnection) -> _Ending | None:
    """Scene to browser; ends when viser closes or the browser's connection ends.

    A slow browser is not disconnected while it receives data; see `BoundWebSocket`.
    """
    try:
        while True:
            await websocket.send_bytes(await viser.recv(decode=False))
    except websockets.ConnectionClosed as closed:
        return _describe_ending(closed)
    except (WebSocketDisconnect, RuntimeError):
        return None


async def _pass_camera(websocket: WebSocket, viser: ClientConnection) -> _Ending | None:
    """Camera to viser; ends when the browser closes or sends more than a camera can be."""
    while True:
        event = await websocket.receive()
        if event["type"] != "websocket.receive":
            return None
        message = event.get("bytes") or b""
        if max(len(message), len(event.get("text") or "")) > MAX_BROWSER_MESSAGE_BYTES:
            return _Ending(1009, "message too big")
        camera = filter_browser_message(message)
        if camera is not None:
            try:
                await viser.send(camera)
            except websockets.ConnectionClosed as closed:
                return _describe_ending(closed)


def _describe_ending(closed: websockets.ConnectionClosed) -> _Ending:
    """Return the close code: 1002 for a rejected client version, as viser does, otherwise "going
    away".
    """
    if closed.rcvd is not None and closed.rcvd.code == 1002:
        return _Ending(1002, closed.rcvd.reason)
    return _Ending(1001, "")
