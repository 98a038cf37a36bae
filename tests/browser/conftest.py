"""A real Chromium: from SVSA_CHROMIUM, or Debian's, or Playwright's own."""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Error, Locator, Page, Playwright, expect

from tests.lab import Lab
from tests.waiting import PATIENCE_S, follow_recording

# Without a graphics card: the page is composed by software, and WebGL is drawn by SwiftShader.
# Composing by SwiftShader as well took most of the CPU time of a test.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--renderer-process-limit=1",  # A new process for every page costs more.
    # Internal pages of the browser behind every window cost as much as the window itself.
    "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup",
]

# A returning user: no tour is offered, and all controls are shown.
RETURNING = """localStorage.setItem("svsa.tour", "done");
localStorage.setItem("svsa.controls", "all");"""

PATIENCE_MS = int(1000 * PATIENCE_S)
expect.set_options(timeout=PATIENCE_MS)  # a busy machine needs time

open_context = Browser.new_context


def new_context(self: Browser, **options: Any) -> BrowserContext:
    """Open a context whose actions take as long as `expect`."""
    context = open_context(self, **options)
    context.set_default_timeout(PATIENCE_MS)
    return context


Browser.new_context = new_context

press_at_once = Locator.press


def press(self: Locator, key: str, **options: Any) -> None:
    """Press by `click`, or by key where Playwright cannot click; a key on a disabled control is
    lost.
    """
    expect(self).to_be_enabled()
    press_at_once(self, key, **options)


Locator.press = press


def find_chromium() -> str | None:
    """Return the path of a Chromium on this machine, or None."""
    named = os.environ.get("SVSA_CHROMIUM")
    known = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    return named or next((path for name in known if (path := shutil.which(name))), None)


@pytest.fixture(scope="session")
def browser_type_launch_args(playwright: Playwright) -> dict:
    """Arguments of Chromium for pytest-playwright; skips with a message if there is none."""
    path = find_chromium()
    if path is None:
        try:
            own = Path(playwright.chromium.executable_path)
        except Error:
            own = Path("/nowhere")
        if not own.exists():
            message = "no Chromium: install it (Debian: `apt install chromium`) for this test"
            if os.environ.get("CI"):
                pytest.fail(message)
            pytest.skip(message)
    return {"args": ARGUMENTS} | ({"executable_path": path} if path else {})


@pytest.fixture(scope="session")
def browser_context_args() -> dict:
    """The size at which the page must be usable without scrolling."""
    return {"viewport": {"width": 1280, "height": 720}, "color_scheme": "light"}


# What it stores when it is left would remain for the next test.
FORGET = """() => {
    Storage.prototype.setItem = () => undefined;
    localStorage.clear();
    sessionStorage.clear();
}"""


class KeptPage:
    """A page that is reset between tests, since opening another takes more than 1 s.

    Not for changes that cannot be undone on a page: a script for every document, or a patched
    WebSocket. A test with such a change uses `own_page`, or `bench_page` if all tests patch the
    same.
    """

    def __init__(self, browser: Browser, arguments: dict) -> None:
        self._browser, self._arguments = browser, arguments
        self._page: Page | None = None

    def get(self) -> Page:
        if self._page is None:
            self._page = self._browser.new_context(**self._arguments).new_page()
        return self._page

    def forget(self) -> None:
        """Remove all state of the previous test, or else the page."""
        try:
            self._clean(self.get())
        except Error:
            self.close()

    def _clean(self, page: Page) -> None:
        page.unroute_all(behavior="ignoreErrors")
        page.evaluate(FORGET)
        page.goto("about:blank")
        context = page.context
        context.clear_cookies()
        context.clear_permissions()
        context.set_offline(False)
        page.set_viewport_size(self._arguments["viewport"])
        page.emulate_media(color_scheme=self._arguments["color_scheme"], reduced_motion="null")

    def close(self) -> None:
        if self._page is not None:
            self._page.context.close()
            self._page = None


@pytest.fixture(scope="session")
def kept_pages(browser: Browser, browser_context_args: dict) -> Iterator[tuple[KeptPage, KeptPage]]:
    """One page for most tests, one for those that patch a bench into it."""
    kept = KeptPage(browser, browser_context_args), KeptPage(browser, browser_context_args)
    yield kept
    for one in kept:
        one.close()


@pytest.fixture
def kept_page(kept_pages: tuple[KeptPage, KeptPage]) -> Iterator[Page]:
    """The shared page; `page` of a module that uses this fixture."""
    yield kept_pages[0].get()
    kept_pages[0].forget()


@pytest.fixture
def bench_page(kept_pages: tuple[KeptPage, KeptPage]) -> Iterator[Page]:
    """`kept_page` for tests that each patch a bench into it: the last patch counts."""
    yield kept_pages[1].get()
    kept_pages[1].forget()


@pytest.fixture
def page(request: pytest.FixtureRequest) -> Page:
    """`kept_page` or `bench_page` in a module that uses it, else a separate page."""
    kept = (name for name in ("kept_page", "bench_page") if name in request.fixturenames)
    return request.getfixturevalue(next(kept, "own_page"))


@pytest.fixture
def own_page(context: BrowserContext) -> Page:
    return context.new_page()


@pytest.fixture(scope="module")
def lab_without_runs(shared_lab: Lab) -> Lab:
    """The shared lab with one lane; the runs of other tests are in the trash."""
    client = shared_lab.client
    client.delete(shared_lab.session + "/recording")
    client.put(shared_lab.session + "/lanes", json={"comparisons": []}).raise_for_status()
    while runs := client.get("/api/v1/runs").raise_for_status().json()["runs"]:
        for run in runs:
            follow_recording(client, f"/api/v1/runs/{run['id']}")
            client.delete(f"/api/v1/runs/{run['id']}").raise_for_status()
    return shared_lab


@pytest.fixture
def still(lab: Lab) -> None:
    """The shared session, paused at 1 s: a page at rest draws nothing.

    It has run since its restart, longer on a busy machine, and begins again.
    """
    for command in ("/pause", "/reset"):
        lab.client.post(lab.session + command).raise_for_status()
    lab.jump(1)


@pytest.fixture
def still_lab(lab: Lab, still: None) -> Iterator[Lab]:
    """The shared lab, paused; the private sessions of a test end with it."""
    yield lab
    for one in lab.client.get("/api/v1/sessions").raise_for_status().json():
        if one["session"] != "lab":
            lab.client.delete(f"/api/v1/sessions/{one['session']}")


@pytest.fixture
def without_3d(request: pytest.FixtureRequest) -> None:
    """The frame of the 3D view stays empty, for tests that do not need it.

    Without a graphics card, drawing it takes most of a test's time.
    """
    names = set(request.fixturenames)
    kept = {"kept_page", "bench_page"} & names
    shown = [request.getfixturevalue(name) for name in kept]
    if not kept or {"context", "own_page"} & names:
        shown.append(request.getfixturevalue("context"))
    for one in shown:
        leave_3d_empty(one)


def leave_3d_empty(one: Page | BrowserContext) -> None:
    """`without_3d` for a page that a module opens once."""
    one.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
