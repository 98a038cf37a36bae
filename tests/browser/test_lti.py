"""A learning platform on another site launches a student, in a real browser with its cookies."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

from tests.lab import run_lab
from tests.server.lti.platform import LearningPlatform, run_platform

pytestmark = [pytest.mark.browser, pytest.mark.usefixtures("without_3d")]


@pytest.fixture(scope="module")
def platform(tmp_path_factory: pytest.TempPathFactory) -> Iterator[LearningPlatform]:
    """On localhost, which is another site for a browser than the lab's 127.0.0.1."""
    folder: Path = tmp_path_factory.mktemp("class")
    with run_platform("localhost") as platform:
        settings = str(platform.write_settings(folder))
        with run_lab("--class", data=str(folder), lti=settings) as lab:
            platform.tool_url = lab.url.rstrip("/")
            yield platform


def expect_student_at_exercise(page: Page) -> None:
    expect(page).to_have_url(re.compile(r"\?learn=mechanism"))
    expect(page.get_by_role("heading", name="The lever and the stiffness")).to_be_visible()
    expect(page.get_by_role("link", name="Next →")).to_be_visible()
    assert page.evaluate("fetch('api/v1/access').then(a => a.json())")["name"] == "Ada"


def test_link_of_the_platform_leads_to_the_exercise_logged_in(
    page: Page, platform: LearningPlatform
) -> None:
    page.goto(f"{platform.url}/course")
    page.get_by_role("link", name="Exercise").click()
    expect_student_at_exercise(page)
    page.reload()
    expect_student_at_exercise(page)
    (cookie,) = page.context.cookies()
    assert (cookie["sameSite"], cookie["httpOnly"]) == ("Strict", True)


@pytest.mark.exhaustive
def test_frame_of_the_platform_offers_a_separate_window(
    page: Page, platform: LearningPlatform
) -> None:
    page.goto(f"{platform.url}/course")
    frame = page.frame_locator("iframe")
    expect(frame.get_by_text("The lab opens in a window of its own")).to_be_visible()
    with page.expect_popup() as opened:
        frame.get_by_role("link", name="Open the lab").click()
    expect_student_at_exercise(opened.value)
