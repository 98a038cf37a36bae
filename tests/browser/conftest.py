"""A real Chromium: the one that SVSA_CHROMIUM names, or Debian's, or Playwright's own."""

import os
import shutil
from pathlib import Path

import pytest
from playwright.sync_api import BrowserContext, Error, Playwright

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
]


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


@pytest.fixture
def without_3d(context: BrowserContext) -> None:
    """The frame of the 3D view stays empty, for tests that do not look at it.

    Without a graphics card, drawing it takes most of a test's time.
    """
    context.route("**/viser/**", lambda route: route.fulfill(body="<title>3D</title>"))
