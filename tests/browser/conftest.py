"""A real Chromium: the one that SVSA_CHROMIUM names, or Debian's, or Playwright's own."""

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from playwright.sync_api import Browser, BrowserContext, Error, Locator, Page, Playwright, expect

from tests.lab import Lab
from tests.waiting import follow_recording

# Without a graphics card: the page is put together without one, WebGL is drawn by SwiftShader.
# Putting the page together by SwiftShader too took most of a test's processor time.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-gpu",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
    "--renderer-process-limit=1",  # a process again with every page that is opened costs more
    # A browser's own pages, behind every window: they cost as much as the window itself.
    "--disable-features=WebUIOmniboxPopup,WebUIOmniboxAimPopup",
]

# Of a user who has been here before: no tour is offered, and all controls are shown.
RETURNING = """localStorage.setItem("svsa.tour", "done");
localStorage.setItem("svsa.controls", "all");"""

PATIENCE_MS = 60_000
expect.set_options(timeout=PATIENCE_MS)  # a busy machine takes its time

press_at_once = Locator.press


def press(self: Locator, key: str, **options: Any) -> None:
    """As `click` does, where Playwright's own does not: a key on what is disabled is lost."""
    expect(self).to_be_enabled()
    press_at_once(self, key, **options)


Locator.press = press


def find_chromium() -> str | None:
    """The path of a Chromium on this machine, or None."""
    named = os.environ.get("SVSA_CHROMIUM")
    known = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
    return named or next((path for name in known if (path := shutil.which(name))), None)


@pytest.fixture(scope="session")
def browser_type_launch_args(playwright: Playwright) -> dict:
    """How pytest-playwright starts Chromium; skips, and says so, where there is none."""
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
    """The size at which the page has to be usable without scrolling."""
    return {"viewport": {"width": 1280, "height": 720}, "color_scheme": "light"}


# What it writes while it is left would be there for the next test.
FORGET = """() => {
    Storage.prototype.setItem = () => undefined;
    localStorage.clear();
    sessionStorage.clear();
}"""


class KeptPage:
    """A page that goes from one test to the next, as new: to open another takes 1 s and more.

    Not for what cannot be taken back from a page: a script for every document, a patched
    WebSocket. Such a test uses `own_page`, or `bench_page` where all patch the same.
    """

    def __init__(self, browser: Browser, arguments: dict) -> None:
        self._browser, self._arguments = browser, arguments
        self._page: Page | None = None

    def get(self) -> Page:
        if self._page is None:
            self._page = self._browser.new_context(**self._arguments).new_page()
            self._page.set_default_timeout(PATIENCE_MS)
        return self._page

    def forget(self) -> None:
        """Nothing of the test before is left; where that fails, nor is the page."""
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
    """One for most tests, one for those that patch a bench into it."""
    kept = KeptPage(browser, browser_context_args), KeptPage(browser, browser_context_args)
    yield kept
    for one in kept:
        one.close()


@pytest.fixture
def kept_page(kept_pages: tuple[KeptPage, KeptPage]) -> Iterator[Page]:
    """The page that other tests had before; `page` of a module that uses this fixture."""
    yield kept_pages[0].get()
    kept_pages[0].forget()


@pytest.fixture
def bench_page(kept_pages: tuple[KeptPage, KeptPage]) -> Iterator[Page]:
    """As `kept_page`, for tests that each patch a bench into it: the last patch counts."""
    yield kept_pages[1].get()
    kept_pages[1].forget()


@pytest.fixture
def page(request: pytest.FixtureRequest) -> Page:
    """`kept_page` or `bench_page` where a module uses it, else a page of the test's own."""
    kept = (name for name in ("kept_page", "bench_page") if name in request.fixturenames)
    return request.getfixturevalue(next(kept, "own_page"))


@pytest.fixture
def own_page(context: BrowserContext) -> Page:
    context.set_default_timeout(PATIENCE_MS)
    return context.new_page()


@pytest.fixture(scope="module")
def lab_without_runs(shared_lab: Lab) -> Lab:
    """The shared lab with one lane; the runs that others have recorded are in the trash."""
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
    """The shared session stands at 1 s: a page at rest draws nothing."""
    lab.jump(1)


@pytest.fixture
def still_lab(lab: Lab, still: None) -> Iterator[Lab]:
    """The shared lab, standing still; the private sessions of a test end with it."""
    yield lab
    for one in lab.client.get("/api/v1/sessions").raise_for_status().json():
        if one["session"] != "lab":
            lab.client.delete(f"/api/v1/sessions/{one['session']}")


@pytest.fixture
def without_3d(request: pytest.FixtureRequest) -> None:
    """The frame of the 3D view stays empty, for tests that do not look at it.

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
    """As `without_3d`, of a page that a module opens once."""
    one.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
