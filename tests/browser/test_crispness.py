"""Curves on a 2D canvas drawn by the browser's graphics pipeline: earlier samples stay sharp."""

import base64
import io
from collections.abc import Iterator

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Browser, Page, Playwright, WebSocketRoute, expect

from tests.browser.conftest import RETURNING
from tests.browser.test_page import LAST_TIME, open_page, wait_for_samples
from tests.lab import Lab

pytestmark = [pytest.mark.browser, pytest.mark.exhaustive]

HIDE_BANNERS = """() => {
  const sheet = new CSSStyleSheet();
  sheet.replaceSync(".banners { display: none; }");
  document.adoptedStyleSheets = [...document.adoptedStyleSheets, sheet];
}"""
SCROLL_S = 2.5
FRAMES = 40
"""Number of frames in which the page has drawn all its plots, for any number per frame."""
# Steep strokes, which blurring widens horizontally.
STEEP = {"kind": "sine", "amplitude_rad": 0.5, "frequency_hz": 0.8}
# The number of pixels of a curve that may differ by more than a quarter of the scale: at the ends
# of strokes, edges are smoothed slightly differently.
MAX_DIFFERENT = 0.03


PASS_FRAMES = """async (count) => {
    for (let passed = 0; passed < count; passed++) await new Promise(requestAnimationFrame);
}"""
FEATURES = """() => {
    const read = (one) => one.nodeType === Node.TEXT_NODE ? one.data :
        [...(one.shadowRoot?.childNodes ?? []), ...one.childNodes].map(read).join(" ");
    return read(document.body).replace(/\\s+/g, " ");
}"""


@pytest.fixture(scope="module")
def accelerated(playwright: Playwright, browser_type_launch_args: dict) -> Iterator[Browser]:
    """A separate browser that composes pages and canvases on a graphics card emulated in
    software.
    """
    refused = {"--disable-accelerated-2d-canvas"}
    kept = [one for one in browser_type_launch_args["args"] if one not in refused]
    arguments = {"args": [*kept, "--headless=new", "--enable-gpu-rasterization"]}
    defaults = ["--headless", "--headless=old", "--disable-gpu"]
    browser = playwright.chromium.launch(
        **(browser_type_launch_args | arguments), ignore_default_args=defaults
    )
    page = browser.new_page()
    page.goto("chrome://gpu")
    page.wait_for_function(f"() => ({FEATURES})().includes('Rasterization:')")
    features = page.evaluate(FEATURES)
    for feature in ("Canvas", "Compositing"):
        assert f"{feature}: Hardware accelerated" in features
    page.close()
    yield browser
    browser.close()


class HeldStream:
    """The stream of the lab until it is held: then the page receives nothing more."""

    def __init__(self, page: Page) -> None:
        self._is_held = False
        page.route_web_socket("**/api/v1/sessions/lab/stream**", self._pass)

    def hold(self) -> None:
        """Pass on no further messages."""
        self._is_held = True

    def _pass(self, socket: WebSocketRoute) -> None:
        def forward(message: str | bytes) -> None:
            if not self._is_held:
                socket.send(message)

        socket.connect_to_server().on_message(forward)


def read_plot(page: Page) -> np.ndarray:
    """Return the pixels of the torque plot, (height, width), dark 0 … light 255, without axes."""
    canvas = page.get_by_role("region", name="Torque plot").locator("canvas").first
    url = canvas.evaluate("one => one.toDataURL()")
    image = Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2])))
    paper = Image.new("RGBA", image.size, "white")
    pixels = np.asarray(Image.alpha_composite(paper, image.convert("RGBA")).convert("L"), float)
    _, width = pixels.shape
    return pixels[:, width // 4 : -width // 20]


def wait_until_drawn(page: Page) -> None:
    """Wait for messages that were passed on before the stream was held, and for their curves."""
    newest = None
    while newest != (newest := page.evaluate(LAST_TIME)):
        page.evaluate(PASS_FRAMES, FRAMES)


@pytest.mark.parametrize("ratio", [1.0, 1.25, 1.5, 2.0])
def test_scrolled_curves_equal_newly_drawn_ones(
    accelerated: Browser, lab: Lab, ratio: float
) -> None:
    context = accelerated.new_context(
        viewport={"width": 1280, "height": 720}, device_scale_factor=ratio
    )
    context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
    context.add_init_script(RETURNING)
    page = context.new_page()
    stream = HeldStream(page)
    lab.load_figure()
    lab.client.put(lab.session + "/position", json=STEEP).raise_for_status()
    lab.jump(22)
    lab.client.post(lab.session + "/start").raise_for_status()
    open_page(page, lab)
    # The message about the silent stream takes no space from the plots.
    page.evaluate(HIDE_BANNERS)
    wait_for_samples(page, page.evaluate(LAST_TIME) + SCROLL_S)
    stream.hold()
    wait_until_drawn(page)
    scrolled = read_plot(page)
    entry = page.get_by_role("region", name="Torque plot").locator(".legend-entry").first
    for is_shown in ("false", "true"):
        entry.click()
        expect(entry).to_have_attribute("aria-pressed", is_shown)
        page.evaluate(PASS_FRAMES, FRAMES)
    again = read_plot(page)
    context.close()
    strokes = again < 200
    assert strokes.sum() > 1000
    different = np.abs(scrolled - again)[strokes] > 64
    assert different.mean() < MAX_DIFFERENT
