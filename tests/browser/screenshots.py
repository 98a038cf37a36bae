"""Pictures of the page for the README: `make screenshots` starts a lab and takes them."""

import re
from pathlib import Path

from PIL import Image
from playwright.sync_api import sync_playwright

from tests.browser.conftest import ARGUMENTS, find_chromium
from tests.lab import run_lab

FOLDER = Path(__file__).parents[2] / "frontend" / "screenshots"
COLORS = 256


def take_screenshots() -> None:
    """FL beside NDOBC 4 s after the 3 kg load, light and dark."""
    FOLDER.mkdir(exist_ok=True)
    with run_lab() as lab, sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_chromium(), args=ARGUMENTS)
        for scheme in ("light", "dark"):
            lab.load_figure()
            lab.client.put(lab.session + "/lanes", json={"rivals": [{"law": "fl"}]})
            context = browser.new_context(
                viewport={"width": 1280, "height": 720}, color_scheme=scheme
            )
            page = context.new_page()
            page.goto(lab.url)
            page.wait_for_timeout(12_000)
            page.get_by_role("button", name=re.compile("Hang 3 kg")).click()
            page.wait_for_timeout(4_000)
            path = FOLDER / f"dashboard-{scheme}.png"
            page.screenshot(path=path)
            context.close()
            Image.open(path).convert("RGB").quantize(COLORS).save(path, optimize=True)
        browser.close()


if __name__ == "__main__":
    take_screenshots()
