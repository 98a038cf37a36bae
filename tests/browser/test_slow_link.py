"""A first visit over a slow link, in a browser: samples first, and words for a slow connection."""

import signal

import pytest
from playwright.sync_api import Page, WebSocket, expect

from tests.lab import Lab, run_lab
from tests.server.blocked_lab import PROGRAM
from tests.server.test_blocked_session import blocked, end_blocked
from tests.slow_link import open_slow_link
from tests.waiting import follow_recording, wait_until

pytestmark = [pytest.mark.browser, pytest.mark.wall_clock]

RATE_BPS, ROUND_TRIP_S, LONGEST_S = 50_000, 0.4, 15.0
ROUND_TRIPS = 8
"""Start page, files and stream, each with a new connection, and two for TCP's slow start."""

WATCH = """(text) => {
    window.wasShown = false;
    const look = () => { window.wasShown ||= document.body.textContent.includes(text); };
    new MutationObserver(look)
        .observe(document.body, { childList: true, characterData: true, subtree: true });
}"""


def count_samples(page: Page) -> int:
    return page.evaluate("svsa.series('position_rad').time.length")


def test_first_visit_has_its_samples_within_the_bytes_of_15_s(page: Page, lab: Lab) -> None:
    lab.load_figure()
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]})
    lab.jump(21)
    lab.client.post(lab.session + "/start").raise_for_status()
    with open_slow_link(lab.url, RATE_BPS, ROUND_TRIP_S) as link:
        seen: list[str] = []
        delivered: list[int] = []
        sockets: list[WebSocket] = []

        def note_message(message: str | bytes) -> None:
            if isinstance(message, bytes) and not delivered:
                delivered.append(link.delivered)
                seen.append("samples")

        def watch(socket: WebSocket) -> None:
            if "/stream?" in socket.url:
                sockets.append(socket)
                socket.on("framereceived", note_message)

        page.on("request", lambda request: seen.append(request.url))
        page.on("websocket", watch)
        page.goto(link.url, wait_until="commit")
        status = page.locator(".statusbar").get_by_role("status").first
        expect(status).to_contain_text("Live")
        assert delivered[0] < RATE_BPS * (LONGEST_S - ROUND_TRIPS * ROUND_TRIP_S)
        later = seen[seen.index("samples") :]
        wait_until(lambda: count_samples(page) > 3900)
        for path in ("/api/v1/laws", "/api/v1/kinds", "/api/v1/actuators", "/viser/lab/"):
            assert [url for url in seen if path in url] == [url for url in later if path in url]
        assert sum("/api/v1/kinds" in url for url in seen) == 1
        assert len(sockets) == 1, "the history needs no second connection"

        loop = page.locator(".status-cell.is-loop")
        page.evaluate(WATCH, "Slow connection: receiving …")
        link.is_open.clear()
        wait_until(lambda: page.evaluate("wasShown"))
        expect(loop).not_to_contain_text("real time")
        link.is_open.set()
        expect(status).to_contain_text("Live")
        expect(loop).to_contain_text("real time")

        link.cut()
        expect(status).to_contain_text("Live")
        wait_until(lambda: count_samples(page) > 1000)


@pytest.mark.exhaustive
def test_blocked_session_is_not_shown_as_a_slow_connection(page: Page) -> None:
    with run_lab(program=PROGRAM) as lab:
        lab.client.post(lab.session + "/start").raise_for_status()
        page.goto(lab.url)
        status = page.locator(".statusbar").get_by_role("status").first
        expect(status).to_contain_text("Live")
        page.evaluate(WATCH, "Slow connection: receiving …")
        with blocked(lab):
            expect(status).to_contain_text("Server busy: sessions do not respond …")
            expect(status).to_contain_text("Sessions do not respond")
            expect(page.get_by_role("alert")).to_contain_text("do not respond")
        assert page.evaluate("wasShown") is False
        assert end_blocked(lab, signal.SIGINT) == 1


@pytest.mark.exhaustive
def test_controls_and_a_replay_leave_samples_and_history_to_a_slow_link(
    page: Page, lab: Lab
) -> None:
    """At 50 kB/s, and at 15 kB/s in between, so that the history arrives after the clicks."""
    lab.load_figure()
    lab.client.put(lab.session + "/lanes", json={"comparisons": [{"law": "fl"}]})
    answer = lab.client.post(lab.session + "/recording", json={"name": "Slow"}).raise_for_status()
    run = answer.json()["recording"]["run_id"]
    lab.jump(21)
    lab.client.delete(lab.session + "/recording").raise_for_status()
    follow_recording(lab.client, f"/api/v1/runs/{run}")
    lab.client.post(lab.session + "/start").raise_for_status()
    newest = "Math.max(...svsa.series('position_rad').time)"
    sockets: list[WebSocket] = []
    page.on("websocket", lambda socket: sockets.append(socket))
    with open_slow_link(lab.url, RATE_BPS, ROUND_TRIP_S) as link:
        page.goto(link.url, wait_until="commit")
        expect(page.locator(".statusbar").get_by_role("status").first).to_contain_text("Live")
        wait_until(lambda: count_samples(page) > 0)
        link.rate_bps = 15_000
        page.get_by_role("switch", name="All controls").press("Enter")
        expect(page.get_by_role("switch", name="All controls", checked=True)).to_be_attached()
        with page.expect_request("**/replay") as replay:
            page.get_by_role("navigation").get_by_role("link", name="Runs").first.press("Enter")
            page.get_by_role("link", name="Slow").first.press("Enter")
        assert count_samples(page) < 3900, "the history still arrives"
        begin = page.evaluate(newest)
        wait_until(lambda: page.evaluate(newest) > begin + 1.0)
        link.rate_bps = RATE_BPS
        assert replay.value.response().ok
        wait_until(lambda: count_samples(page) > 3900)
        end = page.evaluate(newest)
        wait_until(lambda: page.evaluate(newest) > end + 1.0)
        assert sum("/stream?" in socket.url for socket in sockets) == 1
