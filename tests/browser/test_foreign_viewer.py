"""A page of another site, with a viser server of its own, does not get into the lab.

viser's page connects to a server that its address names, and runs the JavaScript of that server.
"""

import re
import threading
from collections.abc import Iterator
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import NamedTuple

import pytest
import viser
from playwright.sync_api import Browser, Page, Route
from viser._messages import RunJavascriptMessage

from tests.lab import Lab

pytestmark = pytest.mark.browser

SCRIPT = "fetch('/api/v1/sessions/lab/pause', {method: 'POST'})"
CONNECTED = "Connected! ws"
BLOCKED = """address => new Promise((resolve) => {
    const report = (event) => resolve(event.violatedDirective);
    document.addEventListener("securitypolicyviolation", report);
    new WebSocket(address);
})"""


class Foreign(NamedTuple):
    """A viser server that sends a script to each client, and a web server with a folder."""

    viser: str
    web: str
    folder: Path
    clients: list[int]


@pytest.fixture(scope="module")
def foreign(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Foreign]:
    server = viser.ViserServer("127.0.0.1", 0, verbose=False)
    clients: list[int] = []

    @server.on_client_connect
    def attack(client: viser.ClientHandle) -> None:
        clients.append(client.client_id)
        client._websock_connection.queue_message(RunJavascriptMessage(source=SCRIPT))

    folder = tmp_path_factory.mktemp("foreign")
    handler = partial(SimpleHTTPRequestHandler, directory=str(folder))
    with ThreadingHTTPServer(("127.0.0.1", 0), handler) as web:
        threading.Thread(target=web.serve_forever, daemon=True).start()
        try:
            # By another name than the lab's, which makes it another site for the browser.
            yield Foreign(
                f"ws://127.0.0.1:{server.get_port()}",
                f"http://localhost:{web.server_address[1]}",
                folder,
                clients,
            )
        finally:
            web.shutdown()
            server.stop()


@pytest.fixture
def page(context) -> Iterator[Page]:
    page = context.new_page()
    yield page
    page.close()


def check_untouched(lab: Lab, foreign: Foreign) -> None:
    assert foreign.clients == []
    assert lab.read()["status"] == "running"


@pytest.mark.parametrize(
    "address",
    [
        "/viser/lab/index.html?websocket={viser}",
        *(
            pytest.param(address, marks=pytest.mark.exhaustive)
            for address in (
                "/viser/lab?websocket={viser}&websocket={viser}/",
                "/viser/lab/?%77ebsocket={viser}#?websocket={viser}",
                "/viser/%6cab/?darkMode&initialCameraFov=0.5&websocket={viser}",
                "/viser/lab/?playbackPath={web}/recording.viser",
                "/viser/lab/?playbackPath=javascript:alert(1)&websocket={viser}",
            )
        ),
    ],
)
def test_viewer_takes_no_server_from_its_address(
    page: Page, lab: Lab, foreign: Foreign, address: str
) -> None:
    requested: list[str] = []
    page.on("request", lambda request: requested.append(request.url))
    with page.expect_console_message(lambda message: CONNECTED in message.text) as connected:
        page.goto(lab.url + address.format(**foreign._asdict()))
    assert f"{lab.stream_url.partition('/api')[0]}/viser/" in connected.value.text
    assert [url for url in requested if not url.startswith((lab.url, "data:", "blob:"))] == []
    check_untouched(lab, foreign)


def test_policy_alone_blocks_another_server(page: Page, lab: Lab, foreign: Foreign) -> None:
    """The page is served without the script that cleans its address, but with its headers."""

    def unclean(route: Route) -> None:
        answer = route.fetch()
        assert "location.search" in answer.text()
        route.fulfill(response=answer, body=answer.text().replace("history.replaceState", "void"))

    page.route(re.compile("/viser/lab/[?]"), unclean)
    begun = f"Connecting to: {foreign.viser}"
    with page.expect_console_message(lambda message: begun in message.text):
        page.goto(f"{lab.url}/viser/lab/?websocket={foreign.viser}")
    # viser's worker has the policy of its page, but does not report that a connection is blocked.
    assert page.evaluate(BLOCKED, foreign.viser) == "connect-src"
    check_untouched(lab, foreign)


def test_clean_address_alone_blocks_another_server(
    browser: Browser, browser_context_args: dict, lab: Lab, foreign: Foreign
) -> None:
    context = browser.new_context(**browser_context_args, bypass_csp=True)
    page = context.new_page()
    with page.expect_console_message(lambda message: CONNECTED in message.text) as connected:
        page.goto(f"{lab.url}/viser/lab/?websocket={foreign.viser}")
    assert foreign.viser not in connected.value.text
    check_untouched(lab, foreign)
    context.close()


def test_page_of_another_site_cannot_frame_the_lab(page: Page, lab: Lab, foreign: Foreign) -> None:
    frames = [f"{lab.url}{path}" for path in ("/", "/docs", "/viser/lab/", "/api/v1/access")]
    (foreign.folder / "frame.html").write_text(
        "".join(f'<iframe src="{frame}?websocket={foreign.viser}"></iframe>' for frame in frames)
    )
    refused: list[str] = []
    page.on("console", lambda message: refused.append(message.text))
    page.goto(f"{foreign.web}/frame.html")
    shown = [frame.url for frame in page.frames[1:]]
    assert len(shown) == len(frames)
    assert not [url for url in shown if url.startswith(lab.url)], refused
    check_untouched(lab, foreign)
