"""The page in Chromium behind Caddy, with TLS and a path: joining, stream and 3D view."""

from collections import Counter
from collections.abc import Iterator

import pytest
from playwright.sync_api import Browser, Page, WebSocket, expect

from tests.browser.conftest import PATIENCE_MS, RETURNING
from tests.server.test_behind_proxy import ROOT, find_caddy, run_proxied

pytestmark = [
    pytest.mark.browser,
    pytest.mark.exhaustive,
    pytest.mark.skipif(find_caddy() is None, reason="Caddy is not on this machine"),
]


@pytest.fixture(scope="module")
def joined_at(tmp_path_factory: pytest.TempPathFactory) -> Iterator[tuple[str, str]]:
    """The address of a class behind Caddy, and its code."""
    with run_proxied(tmp_path_factory) as proxied:
        yield f"{proxied.url}{ROOT}/", proxied.reported.code


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A browser that accepts the self-signed certificate of Caddy."""
    context = browser.new_context(ignore_https_errors=True)
    context.add_init_script(RETURNING)
    yield context.new_page()
    context.close()


def test_page_its_stream_and_the_3d_view_work_behind_a_proxy(
    page: Page, joined_at: tuple[str, str]
) -> None:
    address, code = joined_at
    received: Counter[str] = Counter()
    problems: list[str] = []

    def listen(socket: WebSocket) -> None:
        path = socket.url.partition("?")[0].replace("wss://", "https://").removeprefix(address)
        socket.on("framereceived", lambda _: received.update([path]))

    page.on("websocket", listen)
    page.on("pageerror", lambda error: problems.append(str(error)))
    page.goto(f"{address}#join={code}")
    expect(page.get_by_label("Class code")).to_have_value(code)
    page.get_by_label("Your name").fill("Ada")
    page.get_by_role("button", name="Join", exact=True).click()
    status = page.get_by_role("region", name="Status", exact=True)
    expect(status).to_contain_text("Live")
    expect(page.get_by_text("Your rejoin code:")).to_be_visible()
    wanted = {"api/v1/sessions/lab/stream", "viser/lab"}
    for _ in range(PATIENCE_MS // 200):
        if all(received[path] > 5 for path in wanted):
            break
        page.wait_for_timeout(200)
    assert wanted == set(received), received
    status.get_by_role("button", name="Request control").click()
    expect(status).to_contain_text("You")
    page.get_by_role("button", name="Pause", exact=True).click()
    expect(page.get_by_role("button", name="Run", exact=True)).to_be_enabled()
    (cookie,) = (one for one in page.context.cookies() if one["name"] == "svsa_access")
    assert (cookie["path"], cookie["secure"], cookie["httpOnly"]) == (ROOT, True, True)
    assert problems == []
